"""What the feet went through, at every sample of a record."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

if TYPE_CHECKING:
    import pandas
    from matplotlib.axes import Axes

    from ._account import Account
    from ._feet import Array

MOST_CHANGE = 0.05
"""A force that changes by this share or more with steps and springs is not the structure's, as the program has it."""


def own_forces(changes: Mapping[str, float] | None, moves: str) -> tuple[str, ...]:
    """The forces that are the structure's own: none unless they are checked, and displacements converge."""
    return () if moves else tuple(name for name, change in (changes or {}).items() if change < MOST_CHANGE)


def said_of_forces(changes: Mapping[str, float] | None, moves: str) -> str:
    """Which forces are the structure's own, by their largest changes with steps and springs; none if there is a
    displacement that moves with these."""
    if changes is None:
        return "not checked"
    if moves:
        each = ", ".join(f"{name} ({100.0 * change:.1f} %)" for name, change in changes.items())
        return f"none is the structure's, as displacements do not converge ({moves}): {each}"
    own = [f"{name} ({100.0 * change:.1f} %)" for name, change in changes.items() if change < MOST_CHANGE]
    other = [f"{name} ({100.0 * change:.1f} %)" for name, change in changes.items() if not change < MOST_CHANGE]
    said = [f"the structure's: {', '.join(own)}"] if own else []
    return "; ".join(
        [*said, *([f"not the structure's, but of springs and steps: {', '.join(other)}"] if other else [])]
    )


@dataclass(repr=False)
class FeetHistory:
    """Feet at the samples, the first at the start of the run. Arrays of the feet have a column a foot.

    t                   time, s
    nodes               the feet's nodes, in the order of the columns
    horizontal          the ground's force on the foot, to the right, N
    vertical            the same, up
    largest_horizontal  of largest magnitude since the sample before, N: a landing is over before the next sample
    largest_vertical    the same, up
    uplift              height of the foot above the unloaded ground, m
    gap                 opening of the gap, m
    anchor              horizontal displacement at which the foot is held without shear, m
    work                what the structure has done on the feet, J
    stored              energy in the feet's springs and absorbers, J
    dissipated          energy taken by their dashpots, J
    account             energies of the whole structure, if the run kept them
    force_changes       largest change of every force that `Stepper.converged` found, as a share; None: not checked
    moves               the displacement that `Stepper.converged` found not to converge, and by how much it changes;
                        empty if they all do
    overturned          when a structure has leant by 45 degrees, s: what follows means nothing; None: all stand

    A force is the structure's own only where `Stepper.converged` has shown that it changes by less than 5 % with steps
    and springs, and that displacements converge: `own_forces`. Elsewhere it may be that of the springs: in a landing
    they make it as large as they are stiff.
    """

    nodes: tuple[int, ...]
    t: Array = field(default_factory=lambda: np.empty(0))
    horizontal: Array = field(default_factory=lambda: np.empty(0))
    vertical: Array = field(default_factory=lambda: np.empty(0))
    largest_horizontal: Array = field(default_factory=lambda: np.empty(0))
    largest_vertical: Array = field(default_factory=lambda: np.empty(0))
    uplift: Array = field(default_factory=lambda: np.empty(0))
    gap: Array = field(default_factory=lambda: np.empty(0))
    anchor: Array = field(default_factory=lambda: np.empty(0))
    work: Array = field(default_factory=lambda: np.empty(0))
    stored: Array = field(default_factory=lambda: np.empty(0))
    dissipated: Array = field(default_factory=lambda: np.empty(0))
    account: Account | None = None
    force_changes: Mapping[str, float] | None = None
    moves: str = ""
    overturned: float | None = None

    def __repr__(self) -> str:
        if not len(self.t):
            return "FeetHistory(no samples)"
        went = f"{len(self.t)} samples to {self.t[-1]:.2f} s"
        if self.overturned is not None:
            went += f"; OVERTURNED at {self.overturned:.2f} s"
        else:
            went += f"; largest uplift {self.uplift.max():.4g} m"
        forces = said_of_forces(self.force_changes, self.moves)
        return f"FeetHistory(nodes {', '.join(map(str, self.nodes))}; {went}; forces: {forces})"

    @property
    def own_forces(self) -> tuple[str, ...]:
        """Names of the forces that `Stepper.converged` found to be the structure's own."""
        return own_forces(self.force_changes, self.moves)

    @property
    def base_shear(self) -> Array:
        """The ground's horizontal force on all feet, N."""
        total: Array = self.horizontal.sum(axis=1)
        return total

    @property
    def released(self) -> Array:
        """What the springs let go where a foot lifts while it is loaded to the side, and what the steps lose, J: the
        work that is neither stored nor taken by dashpots."""
        gained: Array = self.stored - self.stored[0]
        return self.work - gained - self.dissipated

    def plot(self, axes: Axes | None = None) -> Axes:
        """Uplift of every foot, mm, over time, s; a line a foot."""
        from .._plots import _axes

        axes = _axes(axes)
        for node, uplift in zip(self.nodes, self.uplift.T, strict=True):
            axes.plot(self.t, 1e3 * uplift, linewidth=0.8, label=f"node {node}")
        axes.set_xlabel("time [s]")
        axes.set_ylabel("uplift [mm]")
        axes.legend()
        return axes

    def to_pandas(self) -> pandas.DataFrame:
        """A row a sample; columns of a foot end in its node's tag."""
        from .._tables import _frame

        columns = {"t": self.t, "base_shear": self.base_shear}
        for name in _NAMES:
            values = getattr(self, name)
            columns |= {f"{name}_{node}": values[:, i] for i, node in enumerate(self.nodes)}
        return _frame(columns, "t")


_NAMES = (
    "horizontal", "vertical", "largest_horizontal", "largest_vertical", "uplift", "gap", "anchor",
    "work", "stored", "dissipated",
)  # fmt: skip


class Watch:
    """Sums over the steps of one or more groups of feet, and rows at the samples."""

    def __init__(self, groups: list[Feet]) -> None:
        self.groups = groups
        self.rows: list[tuple[float, Array]] = []
        self.before = self._now()
        n = sum(len(feet.nodes) for feet in groups)
        self.work, self.dissipated = np.zeros(n), np.zeros(n)
        self.largest = self.before[0].copy()

    def _now(self) -> tuple[Array, Array, Array]:
        """Forces, places and damping of every foot."""
        forces = np.concatenate([feet.forces() for feet in self.groups])
        disp = [[feet.ops.nodeDisp(node, dof) for dof in (1, 2)] for feet in self.groups for node in feet.nodes]
        return forces, np.array(disp), np.concatenate([feet.damping() for feet in self.groups])

    def step(self, h: float) -> None:
        """A step of h was taken."""
        now = self._now()
        for_work = -0.5 * (self.before[0] + now[0]) * (now[1] - self.before[1])
        self.work += for_work.sum(axis=1)
        self.dissipated += 0.5 * h * (self.before[2] + now[2])
        self.largest = np.where(np.abs(now[0]) > np.abs(self.largest), now[0], self.largest)
        self.before = now

    def sample(self, t: float) -> None:
        """The model stands at a sample."""
        of = [feet.uplifts() for feet in self.groups], [feet.gaps() for feet in self.groups]
        more = [feet.anchors() for feet in self.groups], [feet.stored() for feet in self.groups]
        uplift, gap, anchor, stored = (np.concatenate(values) for values in (*of, *more))
        forces = self.before[0]
        row = [*forces.T, *self.largest.T, uplift, gap, anchor, self.work.copy(), stored, self.dissipated.copy()]
        self.rows.append((t, np.array(row)))
        self.largest = np.zeros_like(self.largest)

    def history(self) -> FeetHistory:
        """All samples so far."""
        nodes = tuple(node for feet in self.groups for node in feet.nodes)
        columns = np.array([row for _, row in self.rows]).transpose(1, 0, 2)
        return FeetHistory(nodes, np.array([t for t, _ in self.rows]), *columns)


if TYPE_CHECKING:
    from ._feet import Feet
