"""(b) A two-storey elastic steel frame that steps on its two feet, beside the same frame on pins.

The frame is the user's own; feet are added under nodes 1 and 2. The foot that lands is stopped by its springs, the rest
of the frame by its columns: springs are for the mass of the footing. Drift, column forces, uplift, and the account of
energy.

    python two_storey_frame.py [FOLDER]
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
from groundspring.opensees import FeetHistory, Stepper, add_feet

BAY, STOREY = 3.0, 3.5  # m
FLOOR, FOOTING = 10e3, 1e3  # kg at each node
YOUNG = 210e9  # N/m2
COLUMN, BEAM = (149e-4, 2.517e-4), (62.6e-4, 1.177e-4)  # HEB 300, IPE 330: area m2, second moment m4
NODES = {1: (-BAY / 2, 0.0), 2: (BAY / 2, 0.0)} | {
    2 * i + k: ((k - 1.5) * BAY, i * STOREY) for i in (1, 2) for k in (1, 2)
}
COLUMNS = {1: (1, 3), 2: (2, 4), 3: (3, 5), 4: (4, 6)}
BEAMS = {5: (3, 4), 6: (5, 6)}
DAMPING, FREQUENCY = 0.02, 12.0  # of the first mode, rad/s


def build(stiffer: float = 1.0, footing: float = FOOTING) -> None:
    """The frame, its sections so many times stiffer."""
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    for node, (x, y) in NODES.items():
        ops.node(node, x, y)
        mass = footing if y == 0.0 else FLOOR
        ops.mass(node, mass, mass, 0.0)
    ops.geomTransf("Corotational", 1)
    for members, (area, inertia) in ((COLUMNS, COLUMN), (BEAMS, BEAM)):
        for member, (i, j) in members.items():
            ops.element("elasticBeamColumn", member, i, j, area, stiffer * YOUNG, inertia, 1)
    # by the last committed stiffness, which turns with the frame; the initial one would damp its rocking
    ops.rayleigh(0.0, 0.0, 0.0, 2.0 * DAMPING / FREQUENCY / stiffer)


def rigid(footing: float = FOOTING) -> gs.Structure:
    """The rigid body of the frame's masses."""
    masses = [(footing if y == 0.0 else FLOOR, x, y) for x, y in NODES.values()]
    mass = math.fsum(m for m, _, _ in masses)
    height = math.fsum(m * y for m, _, y in masses) / mass
    inertia = math.fsum(m * (x**2 + (y - height) ** 2) for m, x, y in masses)
    return gs.Structure.aframe(height, BAY, mass, inertia=inertia)


def landing_springs(mass: float = FOOTING, hz: float = 4000.0) -> gs.Springs:
    """Springs for what lands first: the footing."""
    body = rigid()
    radius = math.hypot(body.height, BAY / 2)
    p = math.sqrt(gs.GRAVITY / radius / (1.0 + body.inertia / body.mass / radius**2))
    return gs.design(body, stiffness=2.0 * math.pi * hz / p).springs(mass, radius)


@dataclass
class Response:
    """Displacements, m, and forces, N, at the samples; forces also at their largest between samples."""

    t: Any
    roof: Any
    axial: float
    shear: float
    report: str
    feet: FeetHistory | None = None


def stepping(record: gs.Record, springs: gs.Springs, accuracy: float, longest: float) -> Response:
    """The frame on feet."""
    build()
    stepper = Stepper(ops, add_feet(ops, [1, 2], springs), accuracy=accuracy, longest=longest)
    stepper.gravity()
    roof: list[float] = []
    largest = np.zeros(2)

    def forces(h: float) -> None:
        for column in (1, 2):
            shear, axial = ops.eleForce(column)[:2]
            largest[:] = np.maximum(largest, np.abs((axial, shear)))

    stepper.on_step = forces
    feet = stepper.run(record, on_sample=lambda i, t: roof.append(ops.nodeDisp(5, 1)), account=True)
    return Response(feet.t, np.array(roof), largest[0], largest[1], stepper.report(), feet)


def pinned(record: gs.Record) -> Response:
    """The frame held at its feet."""
    build()
    for node in (1, 2):
        ops.fix(node, 1, 1, 0)
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    for node, (_, y) in NODES.items():
        ops.load(node, 0.0, -gs.GRAVITY * (FOOTING if y == 0.0 else FLOOR), 0.0)
    ops.system("UmfPack")
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.test("NormDispIncr", 1e-12, 30, 0)
    ops.algorithm("Newton")
    ops.integrator("LoadControl", 0.1)
    ops.analysis("Static")
    assert ops.analyze(10) == 0
    ops.loadConst("-time", 0.0)
    ops.wipeAnalysis()
    ops.timeSeries("Path", 2, "-dt", record.dt, "-values", *record.accel.tolist())
    ops.pattern("UniformExcitation", 2, 1, "-accel", 2)
    ops.system("UmfPack")
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.test("NormDispIncr", 1e-12, 30, 0)
    ops.algorithm("Newton")
    ops.integrator("TRBDF2")
    ops.analysis("Transient")
    roof, forces = [0.0], [0.0, 0.0]
    for _ in range(len(record) - 1):
        assert ops.analyze(4, record.dt / 4) == 0
        roof.append(ops.nodeDisp(5, 1))
        for column in (1, 2):
            shear, axial = ops.eleForce(column)[:2]
            forces = [max(forces[0], abs(axial)), max(forces[1], abs(shear))]
    return Response(record.t, np.array(roof), forces[0], forces[1], "")


def main(folder: Path) -> None:
    record = gs.el_centro().truncated(10.0).scaled(1.5)
    springs = landing_springs()
    free = stepping(record, springs, 0.001, record.dt / 4)
    finer = stepping(record, springs, 0.0005, record.dt / 8)
    held = pinned(record)
    for name, response in (("stepping", free), ("the same, half the error", finer), ("on pins", held)):
        print(
            f"{name}: roof {1e3 * np.abs(response.roof).max():.1f} mm, column {response.axial / 1e3:.0f} kN axial, "
            f"{response.shear / 1e3:.1f} kN shear {response.report}"
        )
    assert free.feet is not None and free.feet.account is not None
    account = free.feet.account
    missing = np.abs(account.residual).max() / account.input.max()
    walked = ", ".join(f"{1e3 * x:+.1f} mm" for x in free.feet.anchor[-1])
    print(f"the feet stand off their first places by {walked}: a lifted column straightens, and lands where it hangs")
    print(f"uplift {1e3 * free.feet.uplift.max():.1f} mm; energy not accounted for: {100 * missing:.2f} % of the input")
    converged = [
        np.abs(free.roof).max() / np.abs(finer.roof).max() - 1.0,
        free.axial / finer.axial - 1.0, free.shear / finer.shear - 1.0,
    ]  # fmt: skip
    print("halving the error changes roof, axial force, shear by", ", ".join(f"{100 * c:+.2f} %" for c in converged))
    print("forces on springs of other stiffness: not checked, as Stepper.converged would")
    assert missing < 0.01
    assert max(map(abs, converged)) < 0.01

    figure, (above, below) = pyplot.subplots(2, 1, figsize=(9.0, 6.0), sharex=True, layout="constrained")
    above.plot(held.t, 1e3 * held.roof, color="tab:gray", label="on pins")
    above.plot(free.t, 1e3 * free.roof, color="tab:red", label="stepping")
    above.set_ylabel("roof displacement [mm]")
    above.legend(loc="upper right")
    for column, node in enumerate((1, 2)):
        below.plot(free.t, 1e3 * free.feet.uplift[:, column], label=f"foot {node}")
    below.set_xlabel("time [s]")
    below.set_ylabel("uplift [mm]")
    below.legend(loc="upper right")
    figure.savefig(folder / "two_storey_frame.png", dpi=150)


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "."))
