"""The tables of docs/gap-links.md: an ordinary gap link under the feet, in OpenSees, beside Housner's equation.

    gap_links.py TUNE    prints them; TUNE is the program; needs openseespy

Under each foot stand a gap link (no tension) of a multiple of the leg's EA/L, and a horizontal spring as stiff that is
always on, as a gap link with a linear shear spring has it. Steps of 1 ms, halved up to four times where Newton's
iteration does not end. El Centro.
"""

import csv
import json
import math
import subprocess
import sys
import tempfile
from pathlib import Path

STEP = 1e-3
G = 9.81
CONCRETE = 30e9
CASES = {
    "frame": {
        "text": "kind = 'aframe'\nheight_m = 61.0\nwidth_m = 12.2\nmass_kg = 680.1e3\n",
        "elastic": "kind = 'aframe'\nheight_m = 61.0\nwidth_m = 12.2\nmass_kg = 680.1e3\nfoot_mass_kg = 1e3\n"
        "ea_n = 3e11\nei_nm2 = 3e12\ndamping_ratio = 0.02\n",
        "height": 61.0,
        "width": 12.2,
        "mass": 680.1e3,
        "ea": 3e11,
        "ei": 3e12,
        "scale": 1.0,
        "seconds": 20.0,
    },
    "block": {
        "text": "kind = 'block'\ntotal_height_m = 2.0\nwidth_m = 0.5\nmass_kg = 1200.0\n",
        "height": 1.0,
        "width": 0.5,
        "mass": 1200.0,
        "ea": CONCRETE * 0.25 * 0.5,
        "ei": CONCRETE * 0.25 * 0.01,
        "scale": 1.2,
        "seconds": 20.0,
    },
}
DAMPED = 0.05
HHT = {words: ("HHT", 1.0 + alpha) for words, alpha in (("HHT 0", 0.0), ("HHT -1/24", -1 / 24), ("HHT -1/3", -1 / 3))}
INTEGRATORS = {"Newmark 1/2, 1/4": ("Newmark", 0.5, 0.25)} | HHT
# gap over leg, integrator, damping, geometry
ROWS = [
    *((gap, name, None, "Corotational") for name in INTEGRATORS for gap in (10.0, 100.0)),
    *(
        (10.0, name, damping, "Corotational")
        for name in ("Newmark 1/2, 1/4", "HHT -1/3")
        for damping in ("contact", "mass", "rayleigh")
    ),
    *((10.0, name, None, "Linear") for name in ("Newmark 1/2, 1/4", "HHT -1/3")),
]
DAMPING = {
    None: "none",
    "contact": "5 % while it presses",
    "mass": "5 % by mass",
    "rayleigh": "5 % by mass and stiffness",
}


def reference(tune, text, case):
    """Housner's u, or that of an elastic structure's peaks on rigid ground: rows of history.csv, and the peaks."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "case.toml")
        path.write_text(f"[structure]\n{text}[record]\nduration_s = {case['seconds']}\nscale = {case['scale']}\n")
        command = [tune, "run", path, "--quiet", "--no-figures", "--no-report", "--out", Path(folder, "out")]
        subprocess.run(command, check=True, capture_output=True)
        rows = list(csv.DictReader(Path(folder, "out/history.csv").open()))
        peaks = json.loads(Path(folder, "out/parameters.json").read_text())["peaks"]["reference"]
    return rows, peaks


def advance(ops, step, halvings=4):
    """A step, or two of half its size where Newton's iteration does not end."""
    if ops.analyze(1, step) == 0:
        return True
    return halvings > 0 and all(advance(ops, step / 2.0, halvings - 1) for _ in range(2))


def model(ops, case, gap, integrator, damping, geometry, motion, dt):
    """u of the mass at every sample of the record, up to where it falls or gives up; and why it ended."""
    b, h, m = case["width"] / 2.0, case["height"], case["mass"]
    leg = math.hypot(b, h)
    stiffness = gap * case["ea"] / leg
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    for tag, x in ((1, -b), (2, b)):
        ops.node(tag, x, 0.0)
        ops.node(10 + tag, x, 0.0)
        ops.fix(10 + tag, 1, 1, 1)
        ops.mass(tag, 1e-3 * m, 1e-3 * m, 1e-6 * m)
    ops.node(3, 0.0, h)
    inertia = m * (4.0 * h * h + 4.0 * b * b) / 12.0 if case["height"] < 2.0 else 1e-5 * m * leg * leg
    ops.mass(3, m, m, inertia)
    ops.geomTransf(geometry, 1)
    for tag in (1, 2):
        ops.element("elasticBeamColumn", tag, tag, 3, 1.0, case["ea"], case["ei"], 1)
    ops.uniaxialMaterial("ENT", 1, stiffness)
    ops.uniaxialMaterial("Elastic", 2, stiffness)
    for tag in (1, 2):
        ops.element("zeroLength", 10 + tag, 10 + tag, tag, "-mat", 2, 1, "-dir", 1, 2, "-doRayleigh", 1)
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    ops.load(3, 0.0, -m * G, 0.0)
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system("UmfPack")
    ops.test("NormDispIncr", 1e-9 * h, 40)
    ops.algorithm("Newton")
    ops.integrator("LoadControl", 0.1)
    ops.analysis("Static")
    assert ops.analyze(10) == 0
    ops.loadConst("-time", 0.0)
    omega = math.sqrt(ops.eigen("-fullGenLapack", 1)[0])
    if damping == "contact":
        # critical of half of the mass on one gap: the tangent is none in the air
        beta = 2.0 * DAMPED * math.sqrt(0.5 * m / stiffness)
        ops.region(1, "-ele", 11, 12, "-rayleigh", 0.0, beta, 0.0, 0.0)
    elif damping == "mass":
        ops.rayleigh(2.0 * DAMPED * omega, 0.0, 0.0, 0.0)
    elif damping == "rayleigh":
        # at its first frequency and ten times that
        ops.rayleigh(2.0 * DAMPED * omega * 10.0 / 11.0, 0.0, 2.0 * DAMPED / (11.0 * omega), 0.0)
    ops.timeSeries("Path", 2, "-dt", dt, "-values", *motion, "-factor", case["scale"])
    ops.pattern("UniformExcitation", 2, 1, "-accel", 2)
    ops.wipeAnalysis()
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system("UmfPack")
    ops.test("NormDispIncr", 1e-9 * h, 40)
    ops.algorithm("Newton")
    ops.integrator(*integrator)
    ops.analysis("Transient")
    at_rest = ops.nodeDisp(3, 1)
    found = [0.0]
    per = round(dt / STEP)
    for _ in range(round(case["seconds"] / dt)):
        if not all(advance(ops, STEP) for _ in range(per)):
            return found, "gives up", omega
        u = ops.nodeDisp(3, 1) - at_rest
        if not abs(u) < 2.0 * h:
            return found, "blows up", omega
        found.append(u)
        if abs(u) > 0.9 * h:
            return found, "overturns", omega
    return found, "", omega


def record():
    """El Centro, m/s2, every 0.01 s."""
    lines = Path(__file__).resolve().parent.parent.joinpath("tuning/records/IELC180.AT2").read_text().split("\n")
    return [G * float(x) for line in lines[4:] for x in line.split()]


def main():
    import openseespy.opensees as ops

    tune, motion, dt = sys.argv[1], record(), 0.01
    for name, case in CASES.items():
        rows, _ = reference(tune, case["text"], case)
        u = [float(row["u_housner"]) for row in rows]
        print(f"\n{name}, El Centro x {case['scale']}: Housner's largest {1e3 * max(map(abs, u)):.1f} mm")
        if "elastic" in case:
            _, peaks = reference(tune, case["elastic"], case)
            print(f"on elastic legs, plastic landings (tune run): {1e3 * peaks['top_displacement_m']:.1f} mm")
        print("| gap / leg | integrator | damping | geometry | largest / Housner's | NRMSE | ends |")
        print("|---|---|---|---|---|---|---|")
        for gap, integrator, damping, geometry in ROWS:
            found, end, omega = model(ops, case, gap, INTEGRATORS[integrator], damping, geometry, motion, dt)
            n = min(len(found), len(u))
            ratio = max(map(abs, found)) / max(map(abs, u[:n]))
            error = math.sqrt(sum((a - b) ** 2 for a, b in zip(found, u[:n], strict=False)) / sum(x * x for x in u[:n]))
            at = f"{end} at {dt * (len(found) - 1):.1f} s" if end else ""
            cells = [f"{gap:.0f}", integrator, DAMPING[damping], geometry.lower(), f"{ratio:.2f}", f"{error:.2f}", at]
            print(f"| {' | '.join(cells)} |", flush=True)
        print(f"first frequency, both feet down: {omega / 2 / math.pi:.2f} Hz")


main()
