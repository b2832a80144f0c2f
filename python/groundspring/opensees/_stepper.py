"""Steps that follow feet touching and leaving the ground: the decks' routine, on a model of one's own."""

from __future__ import annotations

import itertools
import math
import sys
import warnings
from collections.abc import Callable, Mapping, Sequence
from typing import Any

import numpy as np

from .._native import GroundspringWarning, Record
from ._account import Books
from ._checks import check_constraints, check_feet, check_record, check_supports, ends_at, is_number
from ._converged import FEET, Convergence, converged
from ._feet import FIRST_TAG, Feet, _radius, take
from ._history import FeetHistory, Watch
from ._springs_for import FeetSprings, tell_untied_groups
from ._staging import Staging, StepError
from ._steps import Watched, routine

MANY_STEPS = 50_000
STEPS_A_SECOND = 20_000.0
"""Of a motion, from which on a run of many steps is told: landings on springs of springs_for take some thousand."""


def _topples(ops: Any, feet: Feet) -> float:
    """How high a foot is where a rigid body of the model's masses would topple, 2 b alpha, m."""
    places = [ops.nodeCoord(node) for node in feet.nodes]
    half = max((max(x for x, _ in places) - min(x for x, _ in places)) / 2.0, 1e-3 * _radius(ops, list(feet.nodes)))
    masses = [
        (ops.nodeMass(node, 2), ops.nodeCoord(node)[1]) for node in ops.getNodeTags() if node not in feet.absorbers
    ]
    total = math.fsum(mass for mass, _ in masses)
    height = math.fsum(mass * (y - places[0][1]) for mass, y in masses) / total if total > 0.0 else 0.0
    return float(2.0 * half * math.atan2(half, height))


class Stepper(Staging):
    """A transient analysis of a model with feet.

    ops          openseespy.opensees
    feet         of `add_feet`, or several of them: all structures of the model
    accuracy     wanted of the history, as a normalised error; halve it to see what the steps do
    longest      step, s; half of a record's sampling interval unless given.
                 Shorter ones follow vibrations of the structure
    landing      s, what a landing takes: 1/Omega_n of the vertical k1 unless given
    rise         of a foot, m, from which on its motion counts; a hundredth of where the structure topples unless given
    tolerance    of Newton's iteration: norm of the displacements' change, m; 1e-12 of the model's size unless given
    constraints  handler, "Plain" unless the model has constraints between nodes
    analysis     set up the solver (UmfPack, Newton, TRBDF2); False if the model has its own, which must be TRBDF2

    Nothing of the model is wiped. The analysis objects, of which OpenSees has one set, are the stepper's from here on;
    recorders go on recording, at every step.

    UntiedFeetWarning: three or more feet of one structure that nothing holds together, if neither `springs_for` nor
    `add_feet` saw them all.
    """

    def __init__(
        self,
        ops: Any,
        feet: Feet | Sequence[Feet],
        *,
        accuracy: float = 0.002,
        longest: float | None = None,
        landing: float | None = None,
        rise: float | None = None,
        tolerance: float | None = None,
        constraints: str = "Plain",
        analysis: bool = True,
    ) -> None:
        self.ops = ops
        self.groups = [feet] if isinstance(feet, Feet) else check_feet(feet, Feet)
        if not (is_number(accuracy) and 1e-6 <= accuracy <= 0.1):
            raise ValueError(f"Stepper: accuracy is {accuracy!r}; give a normalised error from 1e-6 to 0.1")
        for name, value in (("longest", longest), ("landing", landing), ("rise", rise), ("tolerance", tolerance)):
            if value is not None and not (is_number(value) and value > 0.0):
                raise ValueError(f"Stepper: {name} is {value!r}; give a finite number greater than zero")
        check_constraints(self.groups, constraints)
        self.accuracy, self.longest, self.analysis, self.constraints = accuracy, longest, analysis, constraints
        self.landing = min(group.landing for group in self.groups) if landing is None else landing
        self.rise = min(_topples(ops, group) for group in self.groups) / 100.0 if rise is None else rise
        nodes = [node for group in self.groups for node in group.nodes]
        self.tolerance = 1e-12 * _radius(ops, nodes) if tolerance is None else tolerance
        self.built = math.fsum(self._masses().values())  # kg, of the nodes, as the stepper was made
        self._free = itertools.count(max([FIRST_TAG, *ops.getNodeTags(), *ops.getEleTags()]) + 1)
        self.given: dict[str, Any] = {
            "landing": landing,
            "rise": rise,
            "tolerance": tolerance,
            "constraints": constraints,
        }
        self.given["analysis"] = analysis
        self.steps: Any = None
        self._from = 0.0
        self.on_step: Callable[[float], None] | None = None
        self._watch: Watch | None = None
        self._books: Books | None = None
        self._weight = False
        self._told = self._began = 0
        self._known = None
        self._ran: tuple[Any, ...] = ()
        if analysis:  # which is wiped for it
            tell_untied_groups(ops, self.groups, constraints, 2)

    def advance_to(self, t: float) -> None:
        """To time t, s, in steps that end there.

        StepError: Newton's iteration gives up. The model stands where the last step that succeeded ended.
        """
        if self.steps is None:
            self._begin(t - self.ops.getTime())
        if not self.steps.advance(t):
            raise StepError(self._account())

    def run(
        self,
        record: Record,
        *,
        scale: float = 1.0,
        duration: float | None = None,
        on_sample: Callable[[int, float], None] | None = None,
        progress: bool = False,
        account: bool = False,
        vertical: Record | None = None,
    ) -> FeetHistory:
        """Shake the model with a record, from the time it stands at; what the feet went through.

        on_sample  called with the index and the time of every sample, the first before any step
        progress   a line on stderr for every tenth
        account    keep the energies of the whole structure, too: `FeetHistory.account`
        vertical   ground acceleration at the record's times, positive upwards, if not that of the record

        Every mass is shaken, those of elements and of the absorbers too.
        ValueError: a foot was fixed, or its ground freed, after `add_feet`. GroundspringWarning: an event was met in
        too long a step; the duration is longer than the record, with which the run ends.
        """
        ops = self.ops
        check_record(record, "run")
        if vertical is not None:
            check_record(vertical, "run", "vertical")
        check_supports(ops, self.groups, "run")
        if not any((group.forces()[:, 1] > 0.0).any() for group in self.groups):
            raise ValueError("run: no foot presses on the ground; call stepper.gravity() first")
        self._check_added()
        if not is_number(scale):
            raise ValueError(f"run: scale is {scale!r}; give a finite number")
        if account and self.staged is not None and self.staged[0] == "own":
            text = (
                "run: the account has the work of the weight that gravity() puts on, not that of the model's own "
                "patterns, which is in its residual; for an account that adds up put the masses on nodes and call "
                "gravity()"
            )
            warnings.warn(text, GroundspringWarning, stacklevel=2)
        lasts = ends_at(record, duration, "run", 2)
        dt, start = record.dt, ops.getTime()
        both = record if vertical is None else record.with_vertical(vertical)
        shaken = both if scale == 1.0 else both.scaled(scale)
        if lasts is not None:
            shaken = shaken.truncated(lasts)  # a later run is not to be shaken by what is left of it
        self._ground(shaken, 1, start)
        if shaken.vertical is not None:
            self._ground(shaken.vertical, 2, start)
        count = len(shaken)
        if self.steps is None:
            self._begin(0.5 * dt)
        elif self.analysis:  # springs_for, or the user, may have made another one since the last run
            self._analyse()
        self._told, self._began, self._from, self.steps.changes = 0, self.steps.taken, start, 0
        watch = self._watch = Watch(self.groups)
        books = Books(ops, self.groups, shaken, start, self._weight) if account else None
        self._books = books
        try:
            for i in range(count):
                if i > 0:
                    self.advance_to(start + i * dt)
                watch.sample(ops.getTime())
                if books is not None:
                    books.sample()
                if on_sample is not None:
                    on_sample(i, ops.getTime())
                if progress and i * 10 // max(count - 1, 1) != (i - 1) * 10 // max(count - 1, 1):
                    print(
                        f"{ops.getTime():.2f} s of {start + (count - 1) * dt:.2f} s: {self.report()}", file=sys.stderr
                    )
        finally:
            self._watch = self._books = None
            self.history = watch.history()
            self._ran = record, scale, duration, vertical
            if books is not None:
                self.history.account = books.account(self.history.work.sum(axis=1))
        self._check_standing()
        if self.steps is not None and self.steps.late:
            warnings.warn(f"run: {self.report()}", GroundspringWarning, stacklevel=2)
        return self.history

    def converged(
        self,
        record: Record,
        build: Callable[[], object],
        quantities: Mapping[str, Callable[[], float]] | None = None,
        *,
        forces: Mapping[str, Callable[[], float]] | None = None,
        after: Callable[[], object] | Callable[[Stepper], object] | None = None,
        scale: float = 1.0,
        duration: float | None = None,
        vertical: Record | None = None,
        progress: bool = False,
    ) -> Convergence:
        """Run the record again with accuracy and longest step halved, and the springs two and four times as stiff, in
        turn; what that changes.

        build       makes the model anew, without feet, from `ops.wipe()` on, and returns nothing that is looked at:
                    OpenSees cannot be taken back to where it began
        quantities  displacements that are compared beside the uplift, by name: functions of the live model, such as
                    `lambda: ops.nodeDisp(5, 1)`; the largest magnitude over all steps counts. Unless given, that of the
                    highest node with a mass, sideways
        forces      the same of forces and moments, such as `lambda: ops.eleForce(3)[2]`: one that changes by less than
                    5 % is the structure's own, if all quantities converge, too; any other that of springs and steps.
                    The feet's are looked at unasked
        after       called after gravity: what comes into the model unstressed. One that takes an argument is given the
                    stepper of the run: for its `settle`
        scale, duration, vertical   as for `run`
        progress    a line on stderr for every run, with its steps

        Quantities converge if they change by no more than the accuracy that springs_for was asked for (or that of the
        steps, if it is larger; 5 % at most), the uplift as a share of a thousandth of where the structure topples if it
        is less than that. Feet, gravity and options are those of this stepper. A last run, whose ground shakes by a
        millionth more, says how much of a change is the motion's own sensitivity. Six runs in all; the model is left as
        the last one left it. The history that `run` gave of the same record learns which of its forces are the
        structure's.

            roof, base = lambda: ops.nodeDisp(5, 1), lambda: ops.eleForce(3)[2]
            print(stepper.converged(record, build, {"roof": roof}, forces={"base moment": base}))

        ValueError: gravity() has not been called; build makes another model; a quantity is no number, or zero.
        """
        for name, given in (("quantities", quantities), ("forces", forces)):
            if not isinstance(given, Mapping | None):
                raise TypeError(
                    f"converged: {name} is a {type(given).__name__}; give functions by name, "
                    '{"roof": lambda: ops.nodeDisp(5, 1)}'
                )
        wanted, loads = dict(quantities or {}), dict(forces or {})
        if not all(map(callable, (*wanted.values(), *loads.values()))):
            raise ValueError(
                "converged: a quantity is not a function; give name: lambda: ops.nodeDisp(5, 1), and its like"
            )
        names = ["uplift", *FEET, *wanted, *loads]
        for name in (*wanted, *loads):
            if names.count(name) > 1:
                raise ValueError(f"converged: the name {name!r} is there already; give another one")
        options = {"scale": scale, "duration": duration, "vertical": vertical}
        found = converged(self, record, build, wanted, loads, after, progress, **options)
        if self._ran == (record, scale, duration, vertical):
            ours, theirs = self.history.uplift, found.history.uplift
            # another `build` or `after` would be another history
            if ours.shape == theirs.shape and np.allclose(ours, theirs, rtol=1e-6, atol=1e-9):
                self.history.force_changes, self.history.moves = found.force_changes, found.moves
            else:
                text = (
                    "converged: its first run is not the history that run gave: largest uplift "
                    f"{theirs.max():.4g} m, and {ours.max():.4g} m there. Do build and after make the same model? What "
                    "is said of forces is of build's"
                )
                warnings.warn(text, GroundspringWarning, stacklevel=2)
        return found

    def _check_count(self) -> None:
        """Tell of a number of steps out of all proportion, and of its cause, once."""
        steps = self.steps
        if steps is None or self._told or steps.taken % 1000 or steps.taken - self._began < MANY_STEPS:
            return
        taken, time = steps.taken - self._began, self.ops.getTime() - self._from
        if taken < STEPS_A_SECOND * time:
            return
        self._told = 1
        changes = steps.changes / max(time, 1e-9)
        if changes > 200.0 * len(steps.closed):
            cause = (
                f"feet touch and lift {changes:.0f} times a second: the springs throw back what lands, as they do if "
                "they are for more than lands there; take springs_for(ops, nodes)"
            )
        elif steps.refused > 0.01 * taken:
            cause = f"{steps.refused} pairs of steps had to be repeated shorter: look at the structure's own elements"
        else:
            cause = (
                f"parts at the feet vibrate faster than the steps between landings ({self.landing:.1e} s) can pass "
                "over; damp them, take them for rigid (equalDOF), or ask for less: a larger accuracy, softer springs"
            )
        text = f"run: {taken} steps for {time:.3g} s of motion: {cause}"
        warnings.warn(text, GroundspringWarning, stacklevel=2)

    def _check_standing(self) -> None:
        """Note and warn where a structure fell over."""
        history, column = self.history, 0
        if history.uplift.ndim != 2:
            return
        for group in self.groups:
            places = [self.ops.nodeCoord(node)[0] for node in group.nodes]
            width = max(places) - min(places)
            risen = history.uplift[:, column : column + len(places)].max(axis=1, initial=0.0)
            column += len(places)
            # from 45 degrees on nothing brings it back
            fallen = np.flatnonzero(risen > 0.7 * width)
            if width > 0.0 and fallen.size:
                time = float(history.t[fallen[0]])
                history.overturned = min(time, math.inf if history.overturned is None else history.overturned)
                text = (
                    f"run: a foot rose by {risen.max():.3g} m, the feet are {width:.3g} m apart: the structure has "
                    f"overturned by {time:.2f} s, what follows means nothing"
                )
                warnings.warn(text, GroundspringWarning, stacklevel=3)

    def __repr__(self) -> str:
        return f"Stepper({self.report()})"

    def report(self) -> str:
        """Steps taken, the shortest, pairs repeated, and whether events were met too late."""
        return str(self.steps.report()) if self.steps is not None else "no steps yet"

    def _begin(self, longest: float) -> None:
        if self.analysis:
            self._analyse()
        pairs = tuple(pair for group in self.groups for pair in group.pairs)
        longest = longest if self.longest is None else self.longest
        elastic = any(isinstance(group.springs, FeetSprings) for group in self.groups)
        make = routine(Watched(self.ops, self._stepped), elastic)
        self.steps = make(pairs, landing=self.landing, longest=longest, rise=self.rise, accuracy=self.accuracy)

    def _analyse(self) -> None:
        self.ops.wipeAnalysis()
        self._solver("TRBDF2", kind="Transient")

    def _stepped(self, h: float) -> None:
        if self._watch is not None:
            self._watch.step(h)
        if self._books is not None:
            self._books.step()
        self._check_count()
        if self.on_step is not None:
            self.on_step(h)

    def _solver(self, *integrator: Any, kind: str) -> None:
        ops = self.ops
        ops.constraints(self.constraints)
        ops.numberer("RCM")
        ops.system("UmfPack")
        # by displacement: forces of stiff springs never meet a sensible force tolerance
        ops.test("NormDispIncr", self.tolerance, 30, 0)
        ops.algorithm("Newton")
        ops.integrator(*integrator)
        ops.analysis(kind)

    def _ground(self, record: Record, direction: int, start: float) -> None:
        """The record as ground acceleration, to the right (1) or upwards (2)."""
        ops = self.ops
        values = record.accel.tolist()
        path = ("-dt", record.dt, "-startTime", start, "-values", *values)
        series = take(self._free, lambda tag: ops.timeSeries("Path", tag, *path))
        ops.pattern("UniformExcitation", self._pattern(), direction, "-accel", series)

    def _account(self) -> str:
        feet = [
            f"node {node} {'presses' if gap <= 0.0 else 'is in the air'} (gap {gap:.2e} m)"
            for group in self.groups
            for node, gap in zip(group.nodes, group.gaps(), strict=True)
        ]
        return (
            f"stopped at t = {self.ops.getTime():.6f} s: Newton's iteration gives up however short the step "
            f"({self.report()}); {', '.join(feet)}; check the structure's own elements there, or give a larger "
            f"tolerance than {self.tolerance:.1e} m"
        )
