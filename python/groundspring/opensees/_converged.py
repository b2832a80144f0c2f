"""Whether a history still moves with the steps and the springs: the same run, with each of them refined in turn."""

from __future__ import annotations

import functools
import inspect
import math
import sys
import warnings
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from ._checks import check_record, ends_at, is_number
from ._feet import ANOTHER, add_feet
from ._history import MOST_CHANGE, own_forces, said_of_forces
from ._measure import OnFeet, check_free
from ._springs_for import FeetSprings

if TYPE_CHECKING:
    import pandas

    from .._native import Record
    from ._history import FeetHistory
    from ._stepper import Stepper

UPLIFT = "uplift"
HARDLY = 0.1
"""Of the rise from which on a foot's motion counts: below it the uplift is that of springs, and moves with them."""
SENSITIVE = 30.0
"""Change of displacements over that of the ground from which on the motion is called sensitive."""
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
    limit    change of a displacement, as a share, up to which it converges: the accuracy asked of springs and steps
    lifts    uplift, m, of which the change of a smaller one is the share: a foot that rises by less hardly lifts
    rows     `Refined`: the run as it was asked for first, then one with each refined; quantities, then forces
    history  of the feet, as it was asked for; it knows what has become of its forces
    """

    def __init__(
        self,
        names: Sequence[str],
        rows: Sequence[Refined],
        forces: Sequence[str],
        history: FeetHistory,
        limit: float = MOST_CHANGE,
        lifts: float = 0.0,
    ) -> None:
        self.names, self.rows, self.forces, self.history = tuple(names), tuple(rows), tuple(forces), history
        self.limit, self.lifts = limit, lifts
        history.force_changes, history.moves = self.force_changes, self.moves

    def changes(self) -> dict[str, dict[str, float]]:
        """Of every refinement and quantity or force: the share by which it changes against the first run."""
        names, first = (*self.names, *self.forces), self.rows[0].values

        def change(name: str, value: float, base: float) -> float:
            scale = max(abs(base), self.lifts) if name == UPLIFT else abs(base)
            return (value - base) / scale if scale else math.inf if value else 0.0

        return {
            row.name: {
                name: change(name, value, base) for name, value, base in zip(names, row.values, first, strict=True)
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
        """The largest change of every force, as a share. One of 5 % or more is made by springs and steps, and nothing
        to design for; one below is the structure's own if displacements converge, too: `own_forces`."""
        return {name: self._largest(name) for name in self.forces}

    @property
    def converged(self) -> bool:
        """Whether no displacement changes by more than the limit, the twin's change among them."""
        return not self.moves

    @property
    def own_forces(self) -> tuple[str, ...]:
        """The forces that are the structure's own."""
        return own_forces(self.force_changes, self.moves)

    def _worst(self) -> tuple[float, str, str]:
        """The largest change of a displacement, its name and its run, the twin's among them."""
        each = [(abs(row[name]), name, run) for run, row in self.changes().items() for name in self.names]
        return max(each, key=lambda entry: entry[0])

    @property
    def moves(self) -> str:
        """The displacement that does not converge, and by how much it changes; empty if they all do."""
        change, name, run = self._worst()
        by = f"under a {run}" if run == TWIN_NAME else f"with {run}"
        return f"{name} changes by {_percent(change)} {by}" if change > self.limit else ""

    def _verdict(self) -> list[str]:
        """What is said below the table."""
        change, name, run = self._worst()
        call = "springs_for" if run.startswith("springs") else "Stepper"
        smaller = f"{call} a smaller {'longest' if run.startswith('longest') else 'accuracy'}"
        if not self.moves:
            said = f"they converge: at most {_percent(change)} ({name}), limit {_percent(self.limit)}"
        elif self.sensitivity > SENSITIVE * TWIN:
            said = (
                f"they do NOT converge: {self.moves}, limit {_percent(self.limit)}; a ground that shakes by a "
                f"millionth more changes them by {self.sensitivity / TWIN:.0f} millionths: the motion is sensitive, "
                f"and what steps and springs err grows likewise; give {smaller}; feet that walk converge only with a "
                "tie"
            )
        else:
            said = f"they do NOT converge: {self.moves}, limit {_percent(self.limit)}; give {smaller}"
        still = self.names[0] == UPLIFT and self.rows[0].values[0] < self.lifts
        hardly = f"; no foot lifts by {self.lifts:.2g} m, and changes of the uplift are shares of that" if still else ""
        forces = said_of_forces(self.force_changes, self.moves)
        return [f"displacements: {said}{hardly}", f"forces: {forces}"]

    @property
    def sensitivity(self) -> float:
        """The largest change of the quantities under a ground that shakes by a millionth more, as a share. Over
        a millionth, it is what the errors of steps and springs grow by: a sensitive motion needs them smaller."""
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
        said = "converged" if self.converged else "NOT converged"
        return (
            f"Convergence({', '.join(self.names)}: {said}, largest change {self.largest:.2%}, limit {self.limit:.2%}, "
            f"ground a millionth more {self.sensitivity:.2%}; forces of the structure: "
            f"{', '.join(self.own_forces) or 'none'})"
        )

    def __str__(self) -> str:
        table = self._table()
        widths = [max(len(row[i]) for row in table) for i in range(len(table[0]))]
        lines = [
            "  ".join(f"{x:<{w}}" if i == 0 else f"{x:>{w}}" for i, (x, w) in enumerate(zip(row, widths, strict=True)))
            for row in table
        ]
        return "\n".join([*lines, *self._verdict()])

    def _repr_html_(self) -> str:
        from .._html import paragraph, table

        head, *rows = self._table()
        return table(head, rows) + "".join(map(paragraph, self._verdict()))


def _percent(share: float) -> str:
    return f"{100.0 * share:.3g} %"


TWIN_NAME = "ground a millionth more"


def converged(
    stepper: Stepper,
    record: Record,
    build: Callable[[], object],
    quantities: Mapping[str, Callable[[], float]],
    forces: Mapping[str, Callable[[], float]],
    after: Callable[..., object] | None,
    progress: bool,
    **options: Any,
) -> Convergence:
    """See `Stepper.converged`."""
    _check(stepper, record, build, after, options["scale"])
    options["duration"] = ends_at(record, options["duration"], "converged", 3)
    displacements, wanted = dict(quantities), {**quantities, **forces}
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
        if not displacements:
            displacements = _highest(once)
            wanted = {**displacements, **forces}
        if after is not None:
            after(*[once] * _takes_stepper(after))
        largest = [0.0] * len(wanted)

        def look(_: float, largest: list[float] = largest, wanted: Mapping[str, Any] = wanted) -> None:
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
        if i == 1 and still and still[0] in {**quantities, **forces}:
            raise ValueError(
                f"converged: {still[0]!r} is zero throughout, there is nothing to compare: does it ask for the right "
                "node, element and direction? Leave it out otherwise"
            )
        rows.append(Refined(name, once.steps.taken, (float(history.uplift.max()), *largest, *feet)))
    names = [UPLIFT, *displacements]
    return Convergence(names, rows, [*forces, *FEET], histories[0], _limit(stepper), HARDLY * stepper.rise)


def _limit(stepper: Stepper) -> float:
    """Up to which change a displacement converges: the coarser of the accuracies of springs and steps, and never more
    than a force may change. Springs of a rigid body do not know theirs."""
    asked = [feet.springs.measured.accuracy for feet in stepper.groups if isinstance(feet.springs, FeetSprings)]
    return min(MOST_CHANGE, max(*asked, stepper.accuracy)) if asked else MOST_CHANGE


def _highest(stepper: Stepper) -> dict[str, Callable[[], float]]:
    """The sideways displacement of the highest node with a mass, which is looked at where no quantity is named."""
    ops = stepper.ops
    node = max(stepper._masses(), key=lambda node: float(ops.nodeCoord(node)[1]))
    return {f"node {node} sideways": functools.partial(ops.nodeDisp, node, 1)}


def _takes_stepper(after: Callable[..., object]) -> bool:
    """Whether `after` is to be given the stepper of the run: it has one argument without a default."""
    try:
        parameters = inspect.signature(after).parameters.values()
    except (TypeError, ValueError):  # of functions in C
        return False
    places = (inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD)
    return sum(one.kind in places and one.default is one.empty for one in parameters) == 1


def _check(stepper: Stepper, record: Record, build: object, after: Callable[..., object] | None, scale: float) -> None:
    check_record(record, "converged")
    if not callable(build):
        raise TypeError(
            f"converged: build is a {type(build).__name__}; give a function without arguments that makes the model "
            "anew, from ops.wipe() on, without feet; what it returns is not looked at"
        )
    if after is not None and not callable(after):
        raise TypeError(f"converged: after is a {type(after).__name__}; give a function, or leave it out")
    if not is_number(scale):
        raise ValueError(f"converged: scale is {scale!r}; give a finite number")
    if not stepper.staged:
        raise ValueError(
            "converged: gravity() of this stepper has not been called, and every run begins as it did: call "
            'stepper.gravity() first, or gravity("own") where the weight is in patterns of the model\'s own. A static '
            "analysis of your own cannot be repeated here"
        )
    if stepper.settled and not (after is not None and _takes_stepper(after)):
        raise ValueError(
            "converged: settle() of this stepper has been called since gravity(), and nothing repeats it: give an "
            "`after` that takes the stepper of the run, puts in what came in, and calls its settle()"
        )


def _number(ops: Any, name: str, of: Callable[[], float]) -> float:
    """A quantity, which must be a finite number."""
    try:
        value = float(of())
    except Exception as error:  # a user's function
        # OpenSees' own says no more than that stderr has it
        own = type(error).__module__.startswith("opensees")
        why = "OpenSees knows no such node, element or direction" if own else str(error)
        raise ValueError(f"converged: {name!r} is no number at t = {ops.getTime():.4g} s: {why}") from error
    if not math.isfinite(value):
        raise ValueError(f"converged: {name!r} is {value} at t = {ops.getTime():.4g} s; a quantity is a finite number")
    return value


def _again(stepper: Stepper, build: Callable[[], object], finer: float, longest: float, stiffer: float) -> Stepper:
    """The model built anew, on feet refined so, settled."""
    build()
    there = set(stepper.ops.getNodeTags())
    for node in (node for feet in stepper.groups for node in feet.nodes):
        if node not in there:
            raise ValueError(
                f"converged: build makes no node {node}, on which a foot of the stepper stands; it makes the stepper's "
                "model anew, from ops.wipe() on, without feet; what it returns is not looked at"
            )
    try:
        check_free(stepper.ops, [node for feet in stepper.groups for node in feet.nodes], "converged")
    except OnFeet as error:
        raise ValueError(
            "converged: build leaves feet in the model; it makes the model anew, from ops.wipe() on, without feet: "
            "these are put on as the stepper's were; what build returns is not looked at"
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
        if abs(once.built - stepper.built) > ANOTHER * stepper.built:
            raise ValueError(
                f"converged: build makes a model whose nodes have {once.built:.4g} kg, those of the stepper's model "
                f"have {stepper.built:.4g} kg: the springs are not for it; build makes the model that the stepper was "
                "made for"
            )
        assert stepper.staged is not None  # it was looked at before the first run
        once.gravity(*stepper.staged)
    return once
