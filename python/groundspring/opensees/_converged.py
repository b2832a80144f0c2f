"""Whether a history still moves with the steps and the springs: the same run, with each of them refined in turn."""

from __future__ import annotations

import math
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from ._feet import add_feet

if TYPE_CHECKING:
    import pandas

    from .._native import Record
    from ._stepper import Stepper

TWIN = 1e-6
"""By how much more the ground shakes under the twin."""


@dataclass(frozen=True)
class Refined:
    """One run: what was refined, the steps it took, and the largest magnitude of each quantity."""

    name: str
    steps: int
    values: tuple[float, ...]


class Convergence:
    """What changes when accuracy, longest step and the springs' softness are halved. Made by `Stepper.converged`.

    names    the quantities
    rows     `Refined`: the run as it was asked for first, then one with each refined
    """

    def __init__(self, names: Sequence[str], rows: Sequence[Refined]) -> None:
        self.names, self.rows = tuple(names), tuple(rows)

    def changes(self) -> dict[str, dict[str, float]]:
        """Of every refinement and quantity: the share by which it changes against the first run."""
        first = self.rows[0].values
        return {
            row.name: {
                name: (value / base - 1.0 if base else math.inf if value else 0.0)
                for name, value, base in zip(self.names, row.values, first, strict=True)
            }
            for row in self.rows[1:]
        }

    @property
    def largest(self) -> float:
        """The largest change, as a share; the twin's is no refinement, and not among them."""
        changes = self.changes()
        return max(abs(x) for name, row in changes.items() if name != TWIN_NAME for x in row.values())

    @property
    def sensitivity(self) -> float:
        """The largest change under a ground that shakes by a millionth more, as a share. One that is not far below `largest`
        says that the motion is sensitive: no step and no spring makes it converge."""
        return max((abs(x) for x in self.changes().get(TWIN_NAME, {}).values()), default=math.nan)

    def to_pandas(self) -> pandas.DataFrame:
        """A row a run; changes as shares in columns that end in `_change`."""
        from .._tables import _frame

        changes = {self.rows[0].name: dict.fromkeys(self.names, 0.0)} | self.changes()
        rows = [
            {"run": row.name, "steps": row.steps}
            | dict(zip(self.names, row.values, strict=True))
            | {f"{name}_change": changes[row.name][name] for name in self.names}
            for row in self.rows
        ]
        return _frame(rows, "run")

    def __repr__(self) -> str:
        return f"Convergence({', '.join(self.names)}: largest change {self.largest:.2%}, twin {self.sensitivity:.2%})"

    def __str__(self) -> str:
        changes = self.changes()
        table = [["", "steps", *self.names]]
        table += [[self.rows[0].name, str(self.rows[0].steps), *(f"{x:.5g}" for x in self.rows[0].values)]]
        table += [
            [row.name, str(row.steps), *(f"{100.0 * changes[row.name][name]:+.3f} %" for name in self.names)]
            for row in self.rows[1:]
        ]
        widths = [max(len(row[i]) for row in table) for i in range(len(table[0]))]
        return "\n".join("  ".join(f"{x:<{w}}" if i == 0 else f"{x:>{w}}" for i, (x, w) in enumerate(zip(row, widths, strict=True)))
                         for row in table)

    def _repr_html_(self) -> str:
        from .._html import table

        changes = self.changes()
        head = [[self.rows[0].name, str(self.rows[0].steps), *(f"{x:.5g}" for x in self.rows[0].values)]]
        rest = self.rows[1:]
        rows = [[row.name, str(row.steps), *(f"{100.0 * changes[row.name][n]:+.3f} %" for n in self.names)] for row in rest]
        return table(["", "steps", *self.names], head + rows)


TWIN_NAME = "ground a millionth more"


def converged(
    stepper: Stepper,
    record: Record,
    build: Callable[[], object],
    quantities: Mapping[str, Callable[[], float]] | None,
    after: Callable[[], object] | None,
    **options: Any,
) -> Convergence:
    """See `Stepper.converged`."""
    wanted = {} if quantities is None else dict(quantities)
    longest = 0.5 * record.dt if stepper.longest is None else stepper.longest
    as_it_was = (1.0, 1.0, 1.0, 1.0)
    runs = {
        "as asked": as_it_was,
        "accuracy halved": (0.5, 1.0, 1.0, 1.0),
        "longest step halved": (1.0, 0.5, 1.0, 1.0),
        "springs twice as stiff": (1.0, 1.0, 2.0, 1.0),
        TWIN_NAME: (1.0, 1.0, 1.0, 1.0 + TWIN),
    }
    rows = []
    for name, (finer, shorter, stiffer, stronger) in runs.items():
        once = _again(stepper, build, finer, shorter * longest, stiffer)
        if after is not None:
            after()
        largest = [0.0] * len(wanted)

        def look(_: float, largest: list[float] = largest) -> None:
            for i, quantity in enumerate(wanted.values()):
                largest[i] = max(largest[i], abs(float(quantity())))

        once.on_step = look
        scale = stronger * options.get("scale", 1.0)
        history = once.run(record, **(options | {"scale": scale}))
        rows.append(Refined(name, once.steps.taken, (float(history.uplift.max()), *largest)))
    return Convergence(["uplift", *wanted], rows)


def _again(stepper: Stepper, build: Callable[[], object], finer: float, longest: float, stiffer: float) -> Stepper:
    """The model built anew, on feet refined so, settled."""
    build()
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
