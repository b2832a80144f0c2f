"""(e) What is often done instead: OpenSees' zeroLength gap springs with Rayleigh damping, even steps.
Beside ground springs.

The gap springs do not know Housner's restitution: whatever the damping, the frame does not follow. The damping that
lets it lose the right energy in one landing is wrong in the next, and it holds on in the air.

    python gap_and_rayleigh.py [FOLDER]
"""

import math
import sys
from pathlib import Path
from typing import Any

import numpy as np
import openseespy.opensees as ops
from matplotlib import pyplot

import groundspring as gs
from groundspring.opensees import Stepper, add_feet

GAP = 1e9  # N/m: settles by 3 mm under the weight


def frame(structure: gs.Structure, leg: float) -> None:
    """Legs of this stiffness, N/m, from the mass, node 3, to the feet, nodes 1 and 2."""
    b, h = structure.width / 2.0, structure.height
    length = math.hypot(b, h)
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.node(3, 0.0, h)
    ops.mass(3, structure.mass, structure.mass, structure.inertia)
    ops.geomTransf("Corotational", 1)
    for foot, x in ((1, -b), (2, b)):
        ops.node(foot, x, 0.0)
        ops.element("elasticBeamColumn", foot, foot, 3, leg * length, 1.0, leg * length**3 / 3.0, 1)


def gaps(structure: gs.Structure, record: gs.Record, damping: float, dt: float) -> Any:
    """Vertical gaps and horizontal springs with stiffness-proportional damping: u of the mass at the samples."""
    frame(structure, 1e13)
    ops.uniaxialMaterial("ENT", 1, GAP)
    ops.uniaxialMaterial("Elastic", 2, GAP)
    for foot in (1, 2):
        ops.node(10 + foot, *ops.nodeCoord(foot))
        ops.fix(10 + foot, 1, 1, 1)
        ops.element("zeroLength", 10 + foot, 10 + foot, foot, "-mat", 2, 1, "-dir", 1, 2, "-doRayleigh", 1)
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    ops.load(3, 0.0, -structure.mass * gs.GRAVITY, 0.0)
    solver("Static", "LoadControl", 0.1)
    assert ops.analyze(10) == 0
    ops.loadConst("-time", 0.0)
    ops.wipeAnalysis()
    # at the frequency of the standing body on its gaps
    omega = math.sqrt(2.0 * GAP / structure.mass)
    ops.rayleigh(0.0, 2.0 * damping / omega, 0.0, 0.0)
    ops.timeSeries("Path", 2, "-dt", record.dt, "-values", *record.accel.tolist())
    ops.pattern("UniformExcitation", 2, 1, "-accel", 2)
    solver("Transient", "TRBDF2")
    u = [0.0]
    count = round(record.dt / dt)
    for _ in range(len(record) - 1):
        if ops.analyze(count, dt) != 0:
            print(f"damping {damping:g}: OpenSees gives up at {ops.getTime():.2f} s")
            break
        u.append(ops.nodeDisp(3, 1))
    return np.array(u)


def solver(kind: str, *integrator: Any) -> None:
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system("UmfPack")
    ops.test("NormDispIncr", 1e-10, 30, 0)
    ops.algorithm("Newton")
    ops.integrator(*integrator)
    ops.analysis(kind)


def ground_springs(structure: gs.Structure, record: gs.Record) -> Any:
    """The same frame on tuned springs, on legs that are stiffer still."""
    springs = gs.tune(structure, record).springs
    leg = 4.0 * springs.horizontal.k1
    frame(structure, leg)
    stepper = Stepper(ops, add_feet(ops, [1, 2], springs, compliance=1.0 / leg), tolerance=1e-12)
    stepper.gravity()
    u: list[float] = []
    stepper.run(record, on_sample=lambda i, t: u.append(ops.nodeDisp(3, 1)))
    print(stepper.report())
    return np.array(u)


def main(folder: Path) -> None:
    structure, record = gs.Structure.aframe(61.0, 12.2, 680.1e3), gs.el_centro().truncated(20.0)
    housner = gs.rigid_rocking(structure, record).u
    figure, axes = pyplot.subplots(figsize=(9.0, 4.0), layout="constrained")
    axes.plot(record.t, 1e3 * housner, color="black", label="Housner")

    def show(name: str, u: Any, **style: Any) -> float:
        reference = housner[: len(u)]
        error = float(np.sqrt(np.sum((u - reference) ** 2) / np.sum(reference**2)))
        print(f"{name}: NRMSE against Housner {error:.2g} over {record.dt * (len(u) - 1):g} s")
        axes.plot(record.t[: len(u)], 1e3 * u, label=f"{name}: {error:.2g}", **style)
        return error

    worst = [
        show(f"gaps, {100 * d:g} % Rayleigh", gaps(structure, record, d, 1e-3), linewidth=0.8) for d in (0.0, 0.02, 0.2)
    ]
    tuned = show("ground springs", ground_springs(structure, record), color="tab:red", linestyle="--")
    assert tuned < 0.002 < 0.5 < min(worst)
    axes.set_xlabel("time [s]")
    axes.set_ylabel("displacement u [mm]")
    axes.legend(title="NRMSE against Housner", loc="upper right", fontsize="small")
    figure.savefig(folder / "gap_and_rayleigh.png", dpi=150)


if __name__ == "__main__":
    main(Path(sys.argv[1] if len(sys.argv) > 1 else "."))
