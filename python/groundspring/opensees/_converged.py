"""Whether a history still moves with the steps and the springs: the same run, with each of them refined in turn."""

from __future__ import annotations

import math
import sys
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ._feet import add_feet
from ._history import said_of_forces
from ._measure import OnFeet, check_free

if TYPE_CHECKING:
    import pandas

    from .._native import Record
    from ._history import FeetHistory
    from ._stepper import Stepper

TWIN = 1e-6
"""By how much more the ground shakes under the twin."""
FEET = ("vertical at a foot", "horizontal at a foot")
"""The largest forces of the ground on a foot: they are looked at unasked."""


@dataclass(frozen=True)
class Refined:
    """One run: what was refined, the steps it took, and the largest magnitude of each quantity."""

    name: str
    steps: int
    values: tuple[float, ...]


class Convergence:
    """What changes when accuracy and longest step are halved, and the springs two and four times as stiff. Made by
    `Stepper.converged`.

    names    the quantities
    forces   the forces, those of the feet among them
    rows     `Refined`: the run as it was asked for first, then one with each refined; quantities, then forces
    history  of the feet, as it was asked for; it knows what has become of its forces
    """

    def __init__(
        self, names: Sequence[str], rows: Sequence[Refined], forces: Sequence[str], history: FeetHistory
    ) -> None:
        self.names, self.rows, self.forces, self.history = tuple(names), tuple(rows), tuple(forces), history
        history.force_changes = self.force_changes

    def changes(self) -> dict[str, dict[str, float]]:
        """Of every refinement and quantity or force: the share by which it changes against the first run."""
        first = self.rows[0].values
        return {
            row.name: {
                name: (value / base - 1.0 if base else math.inf if value else 0.0)
                for name, value, base in zip((*self.names, *self.forces), row.values, first, strict=True)
            }
            for row in self.rows[1:]
        }

    def _largest(self, name: str) -> float:
        return max(abs(row[name]) for refined, row in self.changes().items() if refined != TWIN_NAME)

    @property
    def largest(self) -> float:
        """The largest change of the quantities, as a share; without the twin's, which is no refinement,
        and the forces'."""
        return max(map(self._largest, self.names))

    @property
    def force_changes(self) -> dict[str, float]:
        """The largest change of every force, as a share. One below 5 % is the structure's own; one of 5 % or more is
        made by springs and steps, and nothing to design for."""
        return {name: self._largest(name) for name in self.forces}

    @property
    def sensitivity(self) -> float:
        """The largest change of the quantities under a ground that shakes by a millionth more, as a share. One that is
        not far below `largest` says that the motion is sensitive: no step and no spring makes it converge."""
        twin = self.changes().get(TWIN_NAME, {})
        return max((abs(twin[name]) for name in self.names if name in twin), default=math.nan)

    def to_pandas(self) -> pandas.DataFrame:
        """A row a run; changes as shares in columns that end in `_change`."""
        from .._tables import _frame

        names = (*self.names, *self.forces)
        changes = {self.rows[0].name: dict.fromkeys(names, 0.0)} | self.changes()
        rows = [
            {"run": row.name, "steps": row.steps}
            | dict(zip(names, row.values, strict=True))
            | {f"{name}_change": changes[row.name][name] for name in names}
            for row in self.rows
        ]
        return _frame(rows, "run")

    def _table(self) -> list[list[str]]:
        names, changes, first = (*self.names, *self.forces), self.changes(), self.rows[0]
        table = [["", "steps", *names], [first.name, str(first.steps), *(f"{x:.5g}" for x in first.values)]]
        return table + [
            [row.name, str(row.steps), *(f"{100.0 * changes[row.name][name]:+.3f} %" for name in names)]
            for row in self.rows[1:]
        ]

    def __repr__(self) -> str:
        return f"Convergence({', '.join(self.names)}: largest change {self.largest:.2%}, twin {self.sensitivity:.2%})"

    def __str__(self) -> str:
        table = self._table()
        widths = [max(len(row[i]) for row in table) for i in range(len(table[0]))]
        lines = [
            "  ".join(f"{x:<{w}}" if i == 0 else f"{x:>{w}}" for i, (x, w) in enumerate(zip(row, widths, strict=True)))
            for row in table
        ]
        return "\n".join([*lines, f"forces: {said_of_forces(self.force_changes)}"])

    def _repr_html_(self) -> str:
        from .._html import paragraph, table

        head, *rows = self._table()
        return table(head, rows) + paragraph(f"forces: {said_of_forces(self.force_changes)}")


TWIN_NAME = "ground a millionth more"


def converged(
    stepper: Stepper,
    record: Record,
    build: Callable[[], object],
    quantities: Mapping[str, Callable[[], float]],
    forces: Mapping[str, Callable[[], float]],
    after: Callable[[], object] | None,
    progress: bool,
    **options: Any,
) -> Convergence:
    """See `Stepper.converged`."""
    wanted = {**quantities, **forces}
    longest = 0.5 * record.dt if stepper.longest is None else stepper.longest
    as_it_was = (1.0, 1.0, 1.0, 1.0)
    runs = {
        "as asked": as_it_was,
        "accuracy halved": (0.5, 1.0, 1.0, 1.0),
        "longest step halved": (1.0, 0.5, 1.0, 1.0),
        "springs twice as stiff": (1.0, 1.0, 2.0, 1.0),
        "springs four times as stiff": (1.0, 1.0, 4.0, 1.0),
        TWIN_NAME: (1.0, 1.0, 1.0, 1.0 + TWIN),
    }
    rows, histories = [], []
    for i, (name, (finer, shorter, stiffer, stronger)) in enumerate(runs.items(), 1):
        once = _again(stepper, build, finer, shorter * longest, stiffer)
        if after is not None:
            after()
        largest = [0.0] * len(wanted)

        def look(_: float, largest: list[float] = largest) -> None:
            for i, (quantity, of) in enumerate(wanted.items()):
                largest[i] = max(largest[i], abs(_number(stepper.ops, quantity, of)))

        once.on_step = look
        scale = stronger * options.get("scale", 1.0)
        history = once.run(record, **(options | {"scale": scale}))
        histories.append(history)
        if progress:
            print(f"converged: run {i} of {len(runs)}, {name}: {once.steps.taken} steps", file=sys.stderr)
        feet = (float(np.abs(history.largest_vertical).max()), float(np.abs(history.largest_horizontal).max()))
        still = [quantity for quantity, value in zip(wanted, largest, strict=True) if value == 0.0]
        if i == 1 and still:
            raise ValueError(
                f"converged: {still[0]!r} is zero throughout, there is nothing to compare: does it ask for the right "
                "node, element and direction? Leave it out otherwise"
            )
        rows.append(Refined(name, once.steps.taken, (float(history.uplift.max()), *largest, *feet)))
    return Convergence(["uplift", *quantities], rows, [*forces, *FEET], histories[0])


def _number(ops: Any, name: str, of: Callable[[], float]) -> float:
    """A quantity, which must be a finite number."""
    try:
        value = float(of())
    except Exception as error:  # a user's function
        raise ValueError(f"converged: {name!r} is no number at t = {ops.getTime():.4g} s: {error}") from error
    if not math.isfinite(value):
        raise ValueError(f"converged: {name!r} is {value} at t = {ops.getTime():.4g} s; a quantity is a finite number")
    return value


def _again(stepper: Stepper, build: Callable[[], object], finer: float, longest: float, stiffer: float) -> Stepper:
    """The model built anew, on feet refined so, settled."""
    build()
    try:
        check_free(stepper.ops, [node for feet in stepper.groups for node in feet.nodes], "converged")
    except OnFeet as error:
        raise ValueError(
            "converged: build leaves feet in the model; it makes the model anew, from ops.wipe() on, without feet: "
            "these are put on as the stepper's were"
        ) from error
    given = stepper.given | {"accuracy": finer * stepper.accuracy, "longest": longest}
    if given["landing"] is not None:
        given["landing"] /= math.sqrt(stiffer)
    with warnings.catch_warnings():
        # what there is to tell of the feet has been told
        warnings.simplefilter("ignore")
        groups = []
        for feet in stepper.groups:
            springs = feet.springs if stiffer == 1.0 else feet.springs.stiffer(stiffer)
            groups.append(add_feet(stepper.ops, feet.nodes, springs, measure=False, **feet.options))
        once = type(stepper)(stepper.ops, groups, **given)
    once.gravity(*stepper.staged)
    return once
