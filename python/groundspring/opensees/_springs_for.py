"""Springs for the feet of a model of one's own, by what lands at each and by what the structure gives."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import Any

from .._native import Springs, _units_for
from ._measure import Model

GIVE = 0.1
"""Give of the stance over the accuracy: where the search for springs of an elastic structure begins, too."""


class FeetSprings(Sequence[Springs]):
    """Units under every foot, in the order of the nodes. Made by `springs_for`, taken by `add_feet`.

    nodes           tags of the feet
    lands           mass of what lands at each foot, kg: what it feels vertically within 1/Omega_n
    parts           feet that belong to one rigid part: tuples of tags
    give            energy of the springs over that of the structure, under its weight's worth sideways and upwards
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
    ) -> None:
        self.nodes, self._units, self.lands = tuple(nodes), tuple(units), tuple(lands)
        self.parts, self.give, self.k, self.landing_speed = tuple(parts), give, k, landing_speed

    def __len__(self) -> int:
        return len(self._units)

    def __getitem__(self, index: Any) -> Any:
        return self._units[index]

    def __iter__(self) -> Iterator[Springs]:
        return iter(self._units)

    def stiffer(self, factor: float) -> FeetSprings:
        """The same, `factor` times as stiff, landing alike: `Springs.stiffer` of each."""
        units = [unit.stiffer(factor) for unit in self._units]
        return FeetSprings(self.nodes, units, self.lands, self.parts, self.give / factor, self.k, self.landing_speed)

    @property
    def landings(self) -> tuple[float, ...]:
        """1/Omega_n of what lands at each foot, s."""
        return tuple(math.sqrt(mass / unit.vertical.k1) for mass, unit in zip(self.lands, self._units, strict=True))

    def __repr__(self) -> str:
        each = ", ".join(
            f"node {node}: {mass:.4g} kg on {unit.vertical.k1:.3g} N/m"
            for node, mass, unit in zip(self.nodes, self.lands, self._units, strict=True)
        )
        return f"FeetSprings({each}; give {self.give:.2g})"


def springs_for(
    ops: Any, nodes: Sequence[int], accuracy: float = 0.01, *, constraints: str = "Plain", give=None
) -> FeetSprings:
    model = Model(ops, nodes, constraints)
    give = GIVE * accuracy if give is None else give
    held = model.held()
    # k1 by the give of the vertical k1 alone, as `Standing` has it
    k1 = sum(float((h.reactions[:, 1] ** 2).sum()) / h.work for h in held) / give
    omega = math.sqrt(k1 / model.total)
    for _ in range(50):
        lands = model.effective(omega)
        before, omega = omega, math.sqrt(k1 / min(lands))
        if abs(omega / before - 1.0) < 1e-6:
            break
    speed = model.landing_speed()
    w = model.inertia(omega)
    parts = []
    for part in model.parts(w):
        rows = [2 * i + k for i in part for k in (0, 1)]
        width = float(abs(model.places[part[-1], 0] - model.places[part[0], 0]))
        parts.append((part, w[rows][:, rows].ravel().tolist(), width))
    responses = tuple((h.reactions.tolist(), h.work, h.omega) for h in held)
    k, total, units = _units_for(model.total, responses, parts, give, speed)
    tags = [tuple(nodes[i] for i in part) for part, _, _ in parts]
    return FeetSprings(nodes, units, lands.tolist(), tags, total, k, speed)
