"""(f) A post-tensioned rocking wall with yielding dissipaters, as New Zealand builds them.

Stages: weight and tendon settle together; the dissipaters come in unstressed; then the ground moves. Uplift, tendon
force, hysteresis of a dissipater, what is left at the end; and what of it still moves with the springs and the steps.

    python rocking_wall.py [FOLDER]
"""

import math
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import openseespy.opensees as ops
from matplotlib import pyplot

import groundspring as gs
from groundspring.opensees import FeetHistory, Stepper, add_feet, springs_for

HALF, THICK, STOREY, STOREYS = 1.5, 0.3, 3.0, 4  # half length of the wall, thickness, storeys, m
FLOOR, TOE = 15e3, 2e3  # kg: at each floor, and at each toe what of the wall lands with it
CONCRETE = 30e9  # N/m2
TENDON_AREA, TENDON_YOUNG, TENDON_STRESSED = 1680e-6, 195e9, 900e3  # m2, N/m2, N before the wall shortens
# dissipaters: off the axis, unbonded length, m; m2; N/m2
BAR_X, BAR_LENGTH, BAR_AREA, BAR_YIELD = 0.6, 0.8, 804e-6, 320e6
LEFT, RIGHT, BASE, ANCHOR, TENDON, BARS = 1, 2, 3, 50, 60, (70, 71)
TOP = 10 + STOREYS


def build() -> None:
    """Wall and tendon, without feet and dissipaters."""
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    for toe, x in ((LEFT, -HALF), (RIGHT, HALF)):
        ops.node(toe, x, 0.0)
        ops.mass(toe, TOE, TOE, 0.0)
    ops.node(BASE, 0.0, 0.0)
    for i in range(1, STOREYS + 1):
        ops.node(10 + i, 0.0, i * STOREY)
        ops.mass(10 + i, FLOOR, FLOOR, FLOOR * (2.0 * HALF) ** 2 / 12.0)
    ops.geomTransf("Corotational", 1)
    area, second = 2.0 * HALF * THICK, THICK * (2.0 * HALF) ** 3 / 12.0
    stiff = (area, 10.0 * CONCRETE, 10.0 * second, 1)  # the wall's own length at its base, which hardly bends
    ends = [BASE, *range(11, TOP + 1)]
    for i, (below, above) in enumerate(zip(ends, ends[1:], strict=False)):
        ops.element("elasticBeamColumn", 10 + i, below, above, area, CONCRETE, second, 1)
    for toe in (LEFT, RIGHT):
        ops.element("elasticBeamColumn", toe, toe, BASE, *stiff)
    for i, x in enumerate((-BAR_X, BAR_X)):
        ops.node(30 + i, x, BAR_LENGTH)  # where the bar holds the wall, and where it holds the ground
        ops.element("elasticBeamColumn", 30 + i, BASE, 30 + i, *stiff)
        ops.node(40 + i, x, 0.0)
        ops.fix(40 + i, 1, 1, 1)
    # before the tendon, which it is not to damp; by the last committed stiffness, which turns with the wall
    ops.rayleigh(0.0, 0.0, 0.0, 2.0 * 0.02 / 25.0)
    ops.node(ANCHOR, 0.0, 0.0)
    ops.fix(ANCHOR, 1, 1, 1)
    ops.uniaxialMaterial("Elastic", 1, TENDON_YOUNG, 0.0, 0.0)  # no compression: it goes slack
    ops.uniaxialMaterial("InitStrainMaterial", 2, 1, TENDON_STRESSED / (TENDON_YOUNG * TENDON_AREA))
    ops.element("corotTruss", TENDON, ANCHOR, TOP, TENDON_AREA, 2)


def dissipaters() -> None:
    """Bars of mild steel, put in as the wall stands: a Truss remembers where its nodes stood, a corotTruss does not."""
    ops.uniaxialMaterial("Steel02", 3, BAR_YIELD, 200e9, 0.02, 18.0, 0.925, 0.15)
    for i, bar in enumerate(BARS):
        ops.element("Truss", bar, 40 + i, 30 + i, BAR_AREA, 3)


def tendon() -> float:
    return float(ops.eleResponse(TENDON, "axialForce")[0])


@dataclass
class Response:
    """At the samples: roof displacement, m; tendon and left dissipater, N; elongation of that bar, m."""

    roof: Any
    tendon: Any
    bar: Any
    stretch: Any
    feet: FeetHistory
    stepper: Stepper


def shake(record: gs.Record, stiffer: float = 1.0) -> Response:
    """All stages, on springs so many times stiffer than what is measured."""
    build()
    feet = add_feet(ops, [LEFT, RIGHT], springs_for(ops, [LEFT, RIGHT], accuracy=0.01).stiffer(stiffer))
    stepper = Stepper(ops, feet, longest=record.dt / 4)
    stepper.gravity()
    dissipaters()
    rows: list[tuple[float, float, float, float]] = []
    stood = ops.nodeDisp(30, 2)

    def sample(i: int, t: float) -> None:
        bar = float(ops.eleResponse(BARS[0], "axialForce")[0])
        rows.append((ops.nodeDisp(TOP, 1), tendon(), bar, ops.nodeDisp(30, 2) - stood))

    history = stepper.run(record, on_sample=sample)
    roof, pull, force, stretch = np.array(rows).T
    return Response(roof, pull, force, stretch, history, stepper)


def with_rest(record: gs.Record, seconds: float = 10.0) -> gs.Record:
    """The record, and then none: what is left when the wall stands still."""
    return gs.Record(record.dt, np.append(record.accel, np.zeros(round(seconds / record.dt))), record.name)


def main(folder: Path) -> None:
    record = gs.el_centro().truncated(15.0).scaled(2.0)
    response = shake(with_rest(record))
    weight, pull = response.stepper.weight, response.stepper.prestress
    theta = response.feet.uplift.max() / (2.0 * HALF)
    print(f"weight {weight / 1e3:.0f} kN, tendon {pull / 1e3:.0f} kN; {response.stepper.report()}")
    roof = np.abs(response.roof).max()
    print(f"uplift {1e3 * response.feet.uplift.max():.1f} mm: theta {1e3 * theta:.2f} mrad; roof {1e3 * roof:.0f} mm")
    # the tendon is longer by theta times its arm about the toe
    by_hand = pull + TENDON_YOUNG * TENDON_AREA / (STOREY * STOREYS) * theta * HALF
    print(f"tendon at most {response.tendon.max() / 1e3:.0f} kN, by hand {by_hand / 1e3:.0f} kN")
    # the left bar is longer by the turn about the right toe times its distance from there
    left = response.feet.uplift[:, 0].max() / (2.0 * HALF) * (HALF + BAR_X)
    print(f"left bar: {np.abs(response.bar).max() / 1e3:.0f} kN (it yields at {BAR_AREA * BAR_YIELD / 1e3:.0f} kN)")
    print(f"left bar stretched by {1e3 * response.stretch.max():.1f} mm, by hand {1e3 * left:.1f} mm")
    print(f"roof at rest: {1e3 * response.roof[-200:].mean():.2f} mm of {1e3 * roof:.0f} mm")
    converged = response.stepper.converged(
        record, build, {"roof": lambda: ops.nodeDisp(TOP, 1)}, forces={"tendon": tendon}, after=dissipaters
    )
    print(converged)
    assert math.isclose(response.tendon.max(), by_hand, rel_tol=0.02)
    assert math.isclose(response.stretch.max(), left, rel_tol=0.05)
    assert converged.largest < 0.02 and converged.force_changes["tendon"] < 0.02

    figure, (above, middle, right) = pyplot.subplots(1, 3, figsize=(11.0, 3.6), layout="constrained")
    above.plot(response.feet.t, 1e3 * response.feet.uplift, label=["left toe", "right toe"])
    above.set_xlabel("time [s]")
    above.set_ylabel("uplift [mm]")
    above.legend()
    middle.plot(1e3 * response.roof, response.tendon / 1e3, color="black", linewidth=0.7)
    middle.set_xlabel("roof displacement [mm]")
    middle.set_ylabel("tendon [kN]")
    right.plot(1e3 * response.stretch, response.bar / 1e3, color="tab:red", linewidth=0.7)
    right.set_xlabel("left bar, elongation [mm]")
    right.set_ylabel("force [kN]")
    figure.savefig(folder / "rocking_wall.png", dpi=150)


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "."))
