"""What a structure bears before it is shaken, stage by stage: weight, prestress, what is put in unstressed."""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterator
from typing import Any

from .._native import GRAVITY, GroundspringWarning
from ._checks import check_supports, tell_resting, tell_shaken_twice, tell_turn
from ._feet import FIRST_TAG, Feet, take

PART = 0.01
"""Share of the weight from which on a load too many, or one too few, is told."""


class StepError(RuntimeError):
    """Newton's iteration gives up however short the step; the message says where the model stands."""


class Staging:
    """The static stages of a `Stepper`."""

    ops: Any
    groups: list[Feet]
    steps: Any
    _free: Iterator[int]
    _weight: bool
    _known: set[int] | None
    """Elements that were there at the last static stage."""
    staged: tuple[str, int] | None = None
    """How `gravity` was called."""
    settled: bool = False
    """Whether `settle` was called since."""
    weight: float = 0.0
    """What presses down on the structure, N: all vertical loads of the last static stage."""
    prestress: float = 0.0
    """By how much more the feet carry, N: what tendons pull them down with."""

    def gravity(self, loads: str = "weight", steps: int = 10) -> None:
        """Let the structure settle under its weight and its prestress; the time is zero after it. Once.

        loads  "weight": that of every nodal mass but the absorbers', put on here; "own": the model's patterns as they
               are, with the weight among them
        steps  in which the loads grow

        Prestress of elements (initial strain or stress) acts as it is; patterns of the model are put on with the
        weight. What comes in later and is to settle, too: `settle`. What comes in unstressed needs nothing: a `Truss`
        or `zeroLength` put in now is as long as it stands.

        ValueError: the feet carry something already; a foot was fixed, or its ground freed, after `add_feet`; the
        model's own patterns have no weight.
        GroundspringWarning: the loads are more than the nodal masses weigh, or, of the model's own, less; elements have
        mass, whose weight is not put on, or which OpenSees shakes twice; a foot cannot turn.
        """
        if loads not in ("weight", "own"):
            raise ValueError(f'gravity: loads is {loads!r}; give "weight" or "own"')
        self._check_static("gravity", steps)
        ops, masses = self.ops, self._masses()
        weighs = GRAVITY * math.fsum(masses.values())
        carried = self._carried()
        if abs(carried) > 1e-6 * max(weighs, 1.0):
            raise ValueError(
                f"gravity: the feet carry {carried:.4g} N already, and a second call would put the weight on twice; "
                "settle() lets what has come in since come to rest, run() shakes the model as it stands"
            )
        tell_turn(ops, self.groups, "gravity")
        if loads == "weight":
            series = take(self._free, lambda tag: ops.timeSeries("Linear", tag))
            ops.pattern("Plain", self._pattern(), series)
            for node, mass in masses.items():
                # a node of ndf 2 (a brick, a truss) takes two numbers
                ops.load(node, 0.0, -mass * GRAVITY, *[0.0] * (len(ops.nodeDisp(node)) - 2))
            self._weight = True
        self._static("gravity", steps)
        self.staged = loads, steps
        self._check_loads(loads, weighs)

    def settle(self, steps: int = 10) -> None:
        """Let what has come in since `gravity` come to rest with the rest: a tendon with an initial strain, a pattern
        of loads. The time is zero after it.

        ValueError: gravity() has not been called, or the model has moved since.
        """
        if self._known is None:
            raise ValueError("settle: gravity() comes first")
        self._check_static("settle", steps)
        self._static("settle", steps)
        self.settled = True
        self._measure_loads()

    def _check_static(self, name: str, steps: int) -> None:
        """Before anything is put on: a call that is refused may be made again."""
        ops = self.ops
        if ops.getTime() != 0.0:
            raise ValueError(
                f"{name}: the model's time is {ops.getTime():.4g}; loads have been put on or it has been shaken. After "
                'a static analysis of your own call ops.loadConst("-time", 0.0), then run()'
            )
        if not (isinstance(steps, int) and steps > 0):
            raise ValueError(f"{name}: steps is {steps!r}; give a whole number above zero")
        check_supports(ops, self.groups, name)

    def _static(self, name: str, steps: int) -> None:
        ops = self.ops
        ops.wipeAnalysis()
        self._solver("LoadControl", 1.0 / steps, kind="Static")
        if ops.analyze(steps) != 0:
            raise StepError(
                f"{name} did not converge at {ops.getTime():.0%} of the load; check that the structure can stand"
            )
        ops.loadConst("-time", 0.0)
        ops.wipeAnalysis()
        self.steps = None
        self._known = set(ops.getEleTags())

    def _solver(self, *integrator: Any, kind: str) -> None:
        raise NotImplementedError

    def _carried(self) -> float:
        return math.fsum(float(group.forces()[:, 1].sum()) for group in self.groups)

    def _masses(self) -> dict[int, float]:
        """Vertical nodal masses but the absorbers', kg."""
        own = {absorber for group in self.groups for absorber in group.absorbers}
        masses = {node: self.ops.nodeMass(node, 2) for node in self.ops.getNodeTags() if node not in own}
        return {node: mass for node, mass in masses.items() if mass > 0.0}

    def _measure_loads(self) -> None:
        """Equilibrium: what the feet and all other supports bear is what was put on,
        whatever is prestressed in between."""
        ops = self.ops
        grounds = {ground for group in self.groups for ground in group.grounds}
        ops.reactions()
        held = [node for node in ops.getFixedNodes() or [] if node not in grounds and 2 in ops.getFixedDOFs(node)]
        carried = self._carried()
        self.weight = carried + math.fsum(ops.nodeReaction(node, 2) for node in held)
        self.prestress = carried - self.weight

    def _check_loads(self, loads: str, weighs: float) -> None:
        self._measure_loads()
        if loads == "own" and self.weight <= 0.0:
            raise ValueError(
                f'gravity("own"): the model\'s own patterns put {self.weight:.4g} N on the structure, and no foot '
                "presses on the ground: put a pattern with the weight on first, or call gravity() for that of nodal "
                "masses"
            )
        tell_resting(self.ops, self.groups, "gravity")
        tell_shaken_twice(self.ops, self.groups, "gravity")
        unweighed = GRAVITY * max(group.element_mass for group in self.groups)
        if loads == "weight" and unweighed > PART * weighs:
            text = (
                f"gravity: elements have {unweighed / GRAVITY:.4g} kg of mass (-mass, -rho) beside the "
                f"{weighs / GRAVITY:.4g} kg of the nodes; the ground shakes it, but gravity() gives weight to nodal "
                'masses alone: put it on the nodes, or the weight into a pattern, and call gravity("own")'
            )
            warnings.warn(text, GroundspringWarning, stacklevel=3)
        over = self.weight - weighs
        if loads == "weight" and over > PART * weighs:
            text = (
                f"gravity: {self.weight:.4g} N press down in all, the nodal masses weigh {weighs:.4g} N: the model's "
                f"own patterns put on {over:.4g} N. If that is the weight, it is on twice: begin anew and call "
                'gravity("own")'
            )
        elif loads == "own" and over < -PART * weighs:
            text = (
                f'gravity("own"): the model\'s patterns put on {self.weight:.4g} N, the nodal masses '
                f"weigh {weighs:.4g} N: {-over:.4g} N of weight are missing; call gravity() to have it put on, or add "
                "it to the patterns"
            )
        else:
            return
        warnings.warn(text, GroundspringWarning, stacklevel=3)

    def _check_added(self) -> None:
        """Tell of elements put in since the last static stage that carry something as they stand."""
        if self._known is None:
            return
        ops = self.ops
        for element in ops.getEleTags():
            if element in self._known:
                continue
            force = max((abs(x) for x in ops.eleForce(element)), default=0.0)
            if force > 1e-6 * max(self.weight, 1.0):
                text = (
                    f"run: element {element} ({ops.eleType(element)}) was put in after gravity() and carries "
                    f"{force:.4g} N at once: its length is that of the unloaded model, or it is prestressed. A Truss "
                    "or zeroLength begins as it stands, a corotTruss or beam does not; call settle() if it is to come "
                    "to rest with the structure"
                )
                warnings.warn(text, GroundspringWarning, stacklevel=4)
                return

    def _pattern(self) -> int:
        return 1 + max([FIRST_TAG, *map(int, self.ops.getPatterns() or [])])
