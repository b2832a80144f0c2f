#!/usr/bin/env python3
"""The same histories with SciPy: El Centro at levels of PGA on the five structures of tuning/sweeps/fragility.toml, as
ratios of run time to `tune sweep`. Needs numpy and scipy.

    scipy_fragility.py TUNE [HISTORIES]      (60 histories unless said)

SciPy's solve_ivp (RK45, rtol 1e-8) starts anew at every sample, with the impact as an event: the record's kinks are not
smoothed over, which is what it takes to be right (docs/accuracy.md). Times are of one processor, so that others on the
machine do not count.
"""

import csv, math, pathlib, resource, subprocess, sys, tempfile, time

import numpy as np
from scipy.integrate import solve_ivp

ROOT = pathlib.Path(__file__).resolve().parent.parent
TUNE, COUNT = sys.argv[1], int(sys.argv[2]) if len(sys.argv) > 2 else 60
G = 9.81
STRUCTURES = [
    ("aframe", 61.0, 12.2),
    ("aframe", 12.0, 2.4),
    ("block", 3.0, 1.2),
    ("block", 1.0, 0.5),
    ("block", 0.6, 0.4),
]


def record():
    lines = (ROOT / "tuning/records/IELC180.AT2").read_text().splitlines()
    return 0.01, np.array([float(x) for line in lines[4:] for x in line.split()]) * G


def rock(kind, h, width, dt, accel):
    """Largest |theta|/alpha and whether it overturned."""
    b = width / 2
    alpha, radius = math.atan2(b, h), math.hypot(b, h)
    share = 0.75 if kind == "block" else 1.0 / (1.0 + 1e-5)
    p2, e = share * G / radius, 1.0 - 2.0 * share * math.sin(alpha) ** 2
    theta = rate = peak = 0.0
    for i in range(len(accel) - 1):
        a0, a1 = accel[i] / G, accel[i + 1] / G
        t, end = 0.0, dt
        if theta == 0.0 and rate == 0.0:
            if max(abs(a0), abs(a1)) <= math.tan(alpha):
                continue
            if abs(a0) < math.tan(alpha):
                t = dt * (math.copysign(math.tan(alpha), a1) - a0) / (a1 - a0)
            side = -math.copysign(1.0, a1 if abs(a0) < math.tan(alpha) else a0)
            theta = 1e-14 * side
        while t < end:
            side = math.copysign(1.0, theta if theta != 0.0 else rate)
            f = lambda s, y: (
                y[1],
                -p2 * (math.sin(alpha * side - y[0]) + (a0 + (a1 - a0) * s / dt) * math.cos(alpha * side - y[0])),
            )
            down = lambda s, y: y[0]
            down.terminal, down.direction = True, -side
            found = solve_ivp(f, (t, end), (theta, rate), rtol=1e-8, atol=1e-12, events=down)
            (theta, rate), t = found.y[:, -1], found.t[-1]
            peak = max(peak, abs(theta))
            if found.status == 1:
                theta, rate = 1e-14 * math.copysign(1.0, rate), e * rate
                if abs(rate) < 1e-6:
                    theta = rate = 0.0
                    break
        if abs(theta) > math.pi / 2:
            return math.pi / 2 / alpha, True
    over = abs(theta) > alpha and (theta * rate >= 0 or rate * rate < 4 * p2 * math.sin((abs(theta) - alpha) / 2) ** 2)
    return (math.pi / 2 if over else peak) / alpha, over


levels = np.geomspace(0.15, 1.2, max(2, COUNT // len(STRUCTURES)))
tables = "".join(
    f'[[structure]]\nkind = "{kind}"\nheight_m = {h}\nwidth_m = {w}\nmass_kg = 1000.0\n' for kind, h, w in STRUCTURES
)
with tempfile.TemporaryDirectory() as folder:
    sweep = pathlib.Path(folder) / "sweep.toml"

    def run(levels):
        text = ", ".join(map(repr, map(float, levels)))
        sweep.write_text(
            f'[sweep]\nkind = "fragility"\n{tables}[records]\nel_centro = true\n[levels]\npga_g = [{text}]\n'
        )
        out = pathlib.Path(folder) / f"out{len(levels)}"
        began = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
        subprocess.run(
            [TUNE, "sweep", sweep, "--out", out, "--shard", "1/1", "--jobs", "1", "--quiet"],
            check=True,
            stdout=subprocess.DEVNULL,
        )
        seconds = resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - began
        subprocess.run([TUNE, "sweep", "gather", sweep, "--out", out, "--no-figures"], check=True, capture_output=True)
        return seconds, out

    # many histories, so that starting the program does not count
    many = np.geomspace(0.15, 1.2, 4000)
    ours = run(many)[0] / (len(many) * len(STRUCTURES))
    rows = list(csv.DictReader(open(run(levels)[1] / "histories.csv")))

dt, accel = record()
pga = np.abs(accel).max()
began = time.process_time()
theirs = [rock(*structure, dt, accel * level * G / pga) for structure in STRUCTURES for level in levels]
scipy_s = (time.process_time() - began) / len(theirs)
differ = [abs(float(row["housner_peak"]) - peak) for row, (peak, over) in zip(rows, theirs) if peak > 0 and not over]
same = sum((row["housner_overturned"] == "true") == over for row, (_, over) in zip(rows, theirs))
near = sum(d < 1e-3 for d in differ)
print(
    f"{len(theirs)} histories of El Centro, 40 s: overturning agrees in {same}; of {len(differ)} that rock, peaks of "
    f"theta/alpha agree to 0.001 in {near}, median difference {np.median(differ):.1e}"
)
print(f"SciPy {1e3 * scipy_s:.1f} ms a history, tune {1e6 * ours:.1f} us: {scipy_s / ours:.0f} times")
