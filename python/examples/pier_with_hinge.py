"""(c) A reinforced concrete bridge pier with a fibre section at its base, stepping on its footing.

Rocking limits what the column's base has to carry: the same pier on a fixed footing yields. Moment against curvature at
the base, drift, uplift.

    python pier_with_hinge.py [FOLDER]
"""

import math
import sys
from pathlib import Path
from typing import Any

import numpy as np
import openseespy.opensees as ops
from matplotlib import pyplot

import groundspring as gs
from groundspring.opensees import FeetHistory, Stepper, add_feet

HEIGHT, WIDTH, DEPTH = 10.0, 4.0, 1.5  # of the deck above the footing, of the footing, of the column's section, m
DECK, FOOTING = 400e3, 60e3  # kg, the footing's at each of its feet
LEFT, RIGHT, BASE = 1, 2, 3
ELEMENTS = 8
TOP = BASE + ELEMENTS


def build() -> None:
    """Column of fibre elements on a stiff footing."""
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    for node, x in ((LEFT, -WIDTH / 2), (RIGHT, WIDTH / 2)):
        ops.node(node, x, 0.0)
        ops.mass(node, FOOTING, FOOTING, 0.0)
    for i in range(ELEMENTS + 1):
        ops.node(BASE + i, 0.0, HEIGHT * (i / ELEMENTS) ** 1.5)  # shorter elements where it yields
    ops.mass(TOP, DECK, DECK, 0.0)
    ops.geomTransf("Corotational", 1)
    for foot in (LEFT, RIGHT):
        ops.element("elasticBeamColumn", foot, foot, BASE, 4.0, 30e9, 5.0, 1)

    # concrete C30 confined and its cover, 1.2 % of steel B500 around the edge
    ops.uniaxialMaterial("Concrete01", 1, -38e6, -0.004, -30e6, -0.02)
    ops.uniaxialMaterial("Concrete01", 2, -30e6, -0.002, -6e6, -0.006)
    ops.uniaxialMaterial("Steel02", 3, 500e6, 200e9, 0.01, 18.0, 0.925, 0.15)
    ops.section("Fiber", 1)
    core, edge, steel = DEPTH / 2 - 0.06, DEPTH / 2, 0.012 * DEPTH**2 / 4.0
    ops.patch("rect", 1, 24, 1, -core, -core, core, core)
    for side in (-1, 1):
        a, b = sorted((side * core, side * edge))
        ops.patch("rect", 2, 2, 1, a, -edge, b, edge)
    for y in (-core, core):
        ops.layer("straight", 3, 10, steel / 10, y, -core, y, core)
    ops.layer("straight", 3, 20, 2 * steel / 20, -core, 0.0, core, 0.0)
    ops.beamIntegration("Legendre", 1, 1, 2)
    for i in range(ELEMENTS):
        ops.element("dispBeamColumn", 10 + i, BASE + i, BASE + i + 1, 1, 1)
    ops.rayleigh(0.0, 0.0, 0.0, 0.003)  # by the last committed stiffness: the initial one would damp rocking


def springs() -> gs.Springs:
    """For what lands: the footing's share at a foot."""
    body = gs.Structure.aframe(HEIGHT, WIDTH, DECK + 2 * FOOTING)
    return gs.design(body, stiffness=2.0 * math.pi * 1000.0 / body.p).springs(FOOTING, math.hypot(HEIGHT, WIDTH / 2))


def shake(record: gs.Record, rocks: bool) -> tuple[Any, FeetHistory]:
    """Rows of top displacement, base curvature, base moment; on feet that rock, or pressed so hard that they do not."""
    build()
    feet = add_feet(ops, [LEFT, RIGHT], springs())
    stepper = Stepper(ops, feet, tolerance=1e-9, longest=record.dt / 4)
    stepper.gravity()
    if not rocks:
        for absorber, foot in feet.pairs:
            # a tie that pulls: the foot never lifts
            ops.uniaxialMaterial("Elastic", 50 + absorber, 1e12)
            ops.element("zeroLength", 50 + absorber, absorber, foot, "-mat", 50 + absorber, "-dir", 2)
    rows: list[tuple[float, float, float]] = []

    def sample(i: int, t: float) -> None:
        moment = ops.eleResponse(10, "section", 1, "force")[1]
        curvature = ops.eleResponse(10, "section", 1, "deformation")[1]
        rows.append((ops.nodeDisp(TOP, 1), curvature, moment))

    history = stepper.run(record, on_sample=sample)
    print(f"{'rocking' if rocks else 'held down'}: {stepper.report()}")
    return np.array(rows), history


def main(folder: Path) -> None:
    record = gs.el_centro().truncated(10.0).scaled(1.8)
    (rocking, history), (held, _) = shake(record, rocks=True), shake(record, rocks=False)
    for name, rows in (("rocking", rocking), ("held down", held)):
        top, curvature, moment = np.abs(rows).max(axis=0)
        print(
            f"{name}: top {1e3 * top:.0f} mm, curvature {1e3 * curvature:.2f} 1/km, base moment {moment / 1e6:.2f} MN m"
        )
    print(f"uplift {1e3 * history.uplift.max():.0f} mm; curvature and moment: not checked with steps and springs")
    assert np.abs(rocking[:, 1]).max() < np.abs(held[:, 1]).max()

    figure, (left, right) = pyplot.subplots(1, 2, figsize=(10.0, 4.0), layout="constrained")
    for rows, color, name in ((held, "tab:gray", "held down"), (rocking, "tab:red", "rocking")):
        left.plot(record.t, 1e3 * rows[:, 0], color=color, label=name)
        right.plot(1e3 * rows[:, 1], rows[:, 2] / 1e6, color=color, label=name)
    left.set_xlabel("time [s]")
    left.set_ylabel("displacement of the deck [mm]")
    left.legend()
    right.set_xlabel("curvature at the base [1/km]")
    right.set_ylabel("moment [MN m]")
    figure.savefig(folder / "pier_with_hinge.png", dpi=150)


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "."))
