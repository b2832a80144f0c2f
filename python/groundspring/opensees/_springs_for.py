"""Springs for the feet of a model of one's own, by what lands at each and by what the structure gives."""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from numbers import Real
from typing import TYPE_CHECKING, Any, overload

import numpy as np

from .._native import GroundspringWarning, Springs, _units_for
from ._measure import Model, NotMeasured, check_free, check_plane, node_tags

if TYPE_CHECKING:
    from ._feet import Feet

UNTIED = 1e-3
"""Feet are tied if they move apart by no more than this share of their distance under a foot's share of the weight."""
GIVE = 0.1
"""Give of the stance over the accuracy: where the search for springs of an elastic structure begins, too."""


@dataclass(frozen=True)
class Measured:
    """What springs were asked for and measured with.

    accuracy     asked of displacements and uplift
    total        mass of the structure on these feet, kg
    omega        at which what lands was measured, rad/s
    constraints  handler of the model's constraints between nodes
    """

    accuracy: float
    total: float
    omega: float
    constraints: str


class FeetSprings(Sequence[Springs]):
    """Units under every foot, in the order of the nodes. Made by `springs_for`, taken by `add_feet`. A slice is for the
    feet in it.

    nodes           tags of the feet
    lands           mass of what lands at each foot, kg: what it feels vertically within 1/Omega_n
    parts           feet that belong to one rigid part: tuples of tags
    give            energy in the springs, k1 and k2, over that in the structure's own elements, under its weight put on
                    sideways and upwards, without unit. The vertical k1 have a tenth of the accuracy; k2, which is
                    softer, has most of the rest
    measured        what they were asked for and measured with: accuracy, mass of the structure
    k               k2/k1 of the vertical units, without unit
    landing_speed   of a foot that fell from half of what overturns, m/s
    """

    def __init__(
        self,
        nodes: Sequence[int],
        units: Sequence[Springs],
        lands: Sequence[float],
        parts: Sequence[tuple[int, ...]],
        give: float,
        k: float,
        landing_speed: float,
        measured: Measured,
    ) -> None:
        self.nodes, self._units, self.lands = tuple(nodes), tuple(units), tuple(lands)
        self.parts, self.give, self.k, self.landing_speed = tuple(parts), give, k, landing_speed
        self.measured = measured

    def __len__(self) -> int:
        return len(self._units)

    @overload
    def __getitem__(self, index: int) -> Springs: ...
    @overload
    def __getitem__(self, index: slice) -> FeetSprings: ...
    def __getitem__(self, index: int | slice) -> Springs | FeetSprings:
        if not isinstance(index, slice):
            return self._units[index]
        nodes = self.nodes[index]
        if not nodes:
            raise ValueError(f"springs: {index} takes none of the {len(self)} feet; feet are counted from 0")
        parts = [kept for part in self.parts if (kept := tuple(node for node in part if node in nodes))]
        return self._with(nodes=nodes, units=self._units[index], lands=self.lands[index], parts=parts)

    def __iter__(self) -> Iterator[Springs]:
        return iter(self._units)

    def stiffer(self, factor: float) -> FeetSprings:
        """The same, `factor` times as stiff, landing alike: `Springs.stiffer` of each."""
        return self._with(units=[unit.stiffer(factor) for unit in self._units], give=self.give / factor)

    def _with(self, **changed: Any) -> FeetSprings:
        # what __init__ takes, under its names
        return FeetSprings(**({name.lstrip("_"): value for name, value in vars(self).items()} | changed))

    @property
    def landings(self) -> tuple[float, ...]:
        """1/Omega_n of what lands at each foot, s."""
        return tuple(math.sqrt(mass / unit.vertical.k1) for mass, unit in zip(self.lands, self._units, strict=True))

    def __repr__(self) -> str:
        each = ", ".join(
            f"node {node}: {mass:.4g} kg on {unit.vertical.k1:.3g} N/m"
            for node, mass, unit in zip(self.nodes, self.lands, self._units, strict=True)
        )
        return (
            f"FeetSprings({each}; for accuracy {self.measured.accuracy:g}: their energy under the weight is "
            f"{100.0 * self.give:.2g} % of the structure's)"
        )


def springs_for(ops: Any, nodes: Sequence[int], accuracy: float = 0.01, *, constraints: str = "Plain") -> FeetSprings:
    """Springs for nodes of a plane frame model, by what is measured on the model itself.

    ops          openseespy.opensees, with a model of ndm 2 and ndf 3 that has no feet yet
    nodes        the nodes that stand on the ground
    accuracy     wanted of displacements and uplift, as a share of their largest
    constraints  handler, "Plain" unless the model has constraints between nodes

    The units are those of what lands at each node: the mass that moves along with it in the time of a landing, and the
    other end of the same footing if there is one. k1 is so stiff that under the structure's weight, put on sideways and
    upwards, the k1's take a tenth of the accuracy asked of the structure's own elastic energy; k2/k1 is the balance of
    `docs/elastic.md`. What the history then misses is to be seen by `Stepper.converged`.

    The model's mass and stiffness are assembled as they stand, before or after loads; nothing of it is changed, but
    OpenSees' analysis objects are wiped.

    ValueError: nodes that are fixed, without mass, or on feet already; feet that carry none of the structure; more than
    3,000 equations; accuracy not between 1e-4 and 0.1. UntiedFeetWarning: three or more feet that nothing holds
    together.
    """
    nodes = node_tags(nodes, "springs_for")
    if not (isinstance(accuracy, Real) and 1e-4 <= accuracy <= 0.1):
        raise ValueError(
            f"springs_for: accuracy is {accuracy!r}; give a share of the largest displacement from 1e-4 to 0.1"
        )
    there = set(ops.getNodeTags())
    if not nodes or len(set(nodes)) < len(nodes) or not there.issuperset(nodes):
        raise ValueError(f"springs_for: nodes are {nodes}; give the tags of nodes that are in the model, each once")
    check_plane(ops, nodes, "springs_for")
    check_free(ops, nodes, "springs_for")
    try:
        model = Model(ops, nodes, constraints)
        found = _found(model, float(accuracy), constraints)
        tell_untied(model, 2)
    except NotMeasured as error:
        raise ValueError(f"springs_for: {error}") from error
    return found


def _found(model: Model, accuracy: float, constraints: str) -> FeetSprings:
    """Springs whose vertical k1 alone give a tenth of the accuracy."""
    give = GIVE * accuracy
    held = model.held()
    # k1 by the give of the vertical k1 alone, as `Standing` has it
    k1 = sum(float((h.reactions[:, 1] ** 2).sum()) / h.work for h in held) / give
    omega = math.sqrt(k1 / model.total)
    # stiffer springs land faster, and less comes along
    for _ in range(50):
        lands = model.effective(omega)
        before, omega = omega, math.sqrt(k1 / min(lands))
        if abs(omega / before - 1.0) < 1e-6:
            break
    massless = model.springlike(omega)
    if massless:
        node = massless[0]
        raise NotMeasured(
            f"node {node} has no mass that lands; give it that of its base plate or footing, ops.mass({node}, m, m, "
            "0.0), and a footing that turns a rotational inertia or mass at its ends"
        )
    speed = model.landing_speed()
    w = model.inertia(omega)
    parts = []
    for part in model.parts(w):
        rows = [2 * i + k for i in part for k in (0, 1)]
        width = float(abs(model.places[part[-1], 0] - model.places[part[0], 0]))
        parts.append((part, w[rows][:, rows].ravel().tolist(), width))
    first, second = ((h.reactions.tolist(), h.work, h.omega) for h in held)
    k, total, units = _units_for(model.total, (first, second), parts, give, speed)
    tags = [tuple(model.nodes[i] for i in part) for part, _, _ in parts]
    measured = Measured(accuracy, model.total, omega, constraints)
    return FeetSprings(model.nodes, units, lands.tolist(), tags, total, k, speed, measured)


class UntiedFeetWarning(GroundspringWarning):
    """Three or more feet of one structure that nothing holds together: its histories hardly converge."""


def tell_untied(model: Model, level: int) -> None:
    """Warn of three or more feet that nothing holds together: the reason why such histories hardly converge."""
    count = len(model.nodes)
    if count < 3:
        return
    spread, apart = model.spread(), float(np.ptp(model.places[:, 0])) / (count - 1)
    if spread.max() > UNTIED * apart:
        # the first of those that are equal but for rounding
        order, at = np.argsort(model.places[:, 0]), int(np.argmax(spread > (1.0 - 1e-6) * spread.max()))
        left, right = (model.nodes[int(i)] for i in order[at : at + 2])
        text = (
            f"{count} feet, and what ties nodes {left} and {right} gives {1e3 * spread.max():.3g} mm under a foot's "
            "share of the weight: a foot in the air hangs where its column lets it and lands there, and where it "
            "stands decides what the others carry. Under strong shaking small changes grow from landing to landing, "
            "whatever the springs and steps: tie the feet (a grade beam), "
            "or see by Stepper.converged what can be foretold"
        )
        warnings.warn(text, UntiedFeetWarning, stacklevel=level + 1)


def tell_untied_groups(ops: Any, groups: Sequence[Feet], constraints: str, level: int) -> None:
    """The same where no call of `springs_for` or `add_feet` has seen all feet of a structure."""
    if sum(len(group.nodes) for group in groups) < 3:
        return
    absorbers = dict(pair for group in groups for pair in group.pairs)
    left = list(absorbers)
    try:
        while left:
            model = Model(ops, left[:1], constraints, absorbers)
            together = [node for node in left if node in model.there]
            left = [node for node in left if node not in together]
            if not any(group.measured and set(together) <= set(group.nodes) for group in groups):
                tell_untied(Model(ops, together, constraints, absorbers), level + 1)
    except NotMeasured:
        return
