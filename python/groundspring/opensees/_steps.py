"""The decks' stepping routine, on a model of one's own."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable
from typing import Any

from .._native import STEPS


class Watched:
    """openseespy as the routine sees it: it is told of every step that succeeds."""

    def __init__(self, ops: Any, after: Callable[[float], None]) -> None:
        self._ops, self._after = ops, after

    def __getattr__(self, name: str) -> Any:
        return getattr(self._ops, name)

    def analyze(self, count: int, h: float) -> int:
        code: int = self._ops.analyze(count, h)
        if code == 0:
            self._after(h)
        return code


def routine(ops: Any, elastic: bool) -> Any:
    """`class Steps` of the decks, from their own source, with what an elastic structure asks besides."""
    names: dict[str, Any] = {"math": math, "sys": sys, "ops": ops, "__name__": __name__}
    exec(compile(STEPS, "<steps of the decks>", "exec"), names)

    steps: Any = names["Steps"]

    class OwnSteps(steps):  # type: ignore[misc]
        """The decks' steps learn how fast a foot moves from long steps alone. Vibrations of an elastic structure may
        allow none for a whole run, and every step would be as short as a landing asks: there it is learnt over as long
        a time in several steps, too. Touches and lifts are counted.
        """

        def __init__(self, *arguments: Any, **named: Any) -> None:
            self.open_since: dict[int, tuple[float, float]] = {}
            self.closed: list[bool] = []
            self.changes = 0
            self.strongest = 0.0
            super().__init__(*arguments, **named)

        def measure(self) -> Any:
            gaps = super().measure()
            closed = [gap[0] <= 0.0 for gap in gaps]
            self.changes += sum(a != b for a, b in zip(self.closed, closed, strict=False))
            self.closed = closed
            return gaps

        def learn(self, before: Any, h: float) -> None:
            super().learn(before, h)
            if not elastic:
                return  # to the last digit as the decks
            now = ops.getTime()
            for i, ((was, *_), (opening, rate, _, _)) in enumerate(zip(before, self.gaps, strict=True)):
                if was <= 0.0 or opening <= 0.0:
                    self.open_since.pop(i, None)
                    continue
                since, rate_then = self.open_since.setdefault(i, (now, rate))
                if now - since >= self.longest:
                    if self.strongest == 0.0:
                        self.strongest = abs(rate - rate_then) / (now - since)
                    self.open_since[i] = now, rate

    return OwnSteps
