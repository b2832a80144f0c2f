#!/usr/bin/env python3
"""Rocking of a rigid body with a tendon and dampers, by SciPy: values of the test
`crates/rocking/tests/housner/restrained.rs`.

    python3 .ci/restrained.py [target/release/tune]

With a program, its `tune housner` is to have the same to 1e-9 rad. Equation of motion from Cartesian positions of the mass and of the corners about the pivot, numeric
virtual work: d/dt(I0 w') = sum of F . dr/dw. Impacts by equation 2. Ground: linear between samples.
"""

import csv
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
from scipy.integrate import solve_ivp

G = 9.81
HALF_WIDTH, HEIGHT, MASS, INERTIA = 1.05, 8.9, 120e3, 3.0e5


class Body:
    def __init__(self, b, h, mass, inertia, k, n, c):
        self.b, self.h, self.mass = b, h, mass
        self.i0 = inertia + mass * (b * b + h * h)
        self.k, self.n, self.c = k, n, c
        self.e = 1 - mass * 2 * b * b / self.i0
        self.l0 = h - n / k if k else h

    def place(self, w, x, z):
        """A point that stands at x (from the pivot, towards the other foot), z, after a turn."""
        return np.array([x * np.cos(w) - z * np.sin(w), x * np.sin(w) + z * np.cos(w)])

    def turn(self, w, x, z):
        return np.array([-x * np.sin(w) - z * np.cos(w), x * np.cos(w) - z * np.sin(w)])

    def second(self, w, rate, side, a):
        mass, by = self.place(w, self.b, self.h), self.turn(w, self.b, self.h)
        # a lean to the right turns about the right foot: the pivot's other side is to the left
        force = self.mass * np.array([side * a, -G])
        anchor = np.array([self.b, 0.0])
        along = mass - anchor
        length = np.hypot(*along)
        force = force - self.k * max(0.0, length - self.l0) * along / length
        torque = force @ by
        corner = self.turn(w, 2 * self.b, 0.0)
        torque -= self.c * (corner[1] * rate) * corner[1]
        return torque / self.i0


def history(body, accel, dt):
    """theta at the samples, and impacts."""
    count = len(accel)
    times = np.arange(count) * dt
    theta, impacts = [0.0], []
    rocking, side, state = False, 1.0, [0.0, 0.0]
    limit = body.b / body.h * (G + body.n / body.mass)
    for i in range(count - 1):
        t, end = times[i], times[i + 1]
        slope = (accel[i + 1] - accel[i]) / dt
        ground = lambda s, t0=times[i], a0=accel[i]: a0 + slope * (s - t0)
        while t < end:
            if not rocking:
                inside = [s for s in ((g * limit - accel[i]) / slope + times[i] for g in (1, -1))
                          if t < s < end] if slope else []
                if abs(ground(t)) > limit * (1 + 1e-12):
                    inside = [t]
                if not inside:
                    break
                t = min(inside)
                side = -np.sign(ground(t))
                rocking, state = True, [0.0, 0.0]
                # w''' alone is not zero there
                if end - t < 1e-12:
                    break
            right = lambda s, y: [y[1], body.second(y[0], y[1], side, ground(s))]
            land = lambda s, y: y[0]
            land.terminal, land.direction = True, -1
            out = solve_ivp(right, (t, end), state, method="DOP853", rtol=1e-12, atol=1e-15,
                            events=land, max_step=dt / 4)
            if out.t_events[0].size and out.t_events[0][0] > t + 1e-9:
                t = out.t_events[0][0]
                rate = out.y_events[0][0][1]
                impacts.append((t, rate * side))
                side, state = -side, [0.0, -rate * body.e]
                if abs(rate) < 1e-7:
                    rocking, state = False, [0.0, 0.0]
                continue
            t, state = end, list(out.y[:, -1])
        theta.append(side * state[0] if rocking else 0.0)
    return np.array(theta), impacts


def ground(dt, seconds):
    """Three sines (m/s2), as the test has them."""
    t = np.arange(round(seconds / dt) + 1) * dt
    sines = 0.25 * np.sin(5.1 * t) + 0.2 * np.sin(11.3 * t + 1) + 0.15 * np.sin(23.7 * t + 2)
    return np.round(sines * np.minimum(t / 2, 1) * G, 6)


CASE = """[structure]
kind = "block"
height_m = {h}
width_m = {width}
mass_kg = {mass}
rotational_inertia_kgm2 = {inertia}
{members}"""
TENDON = "[tendon]\nstiffness_n_per_m = {k}\npretension_n = {n}\n"
DAMPER = "[damper]\nc_ns_per_m = {c}\n"


def of_tune(tune, accel, dt, k, n, c):
    """theta by `tune housner`."""
    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        (folder / "ground.txt").write_text("".join(f"{a:.6f}\n" for a in accel))
        members = TENDON.format(k=k, n=n) if k else ""
        members += DAMPER.format(c=c) if c else ""
        case = CASE.format(
            h=HEIGHT, width=2 * HALF_WIDTH, mass=MASS, inertia=INERTIA, members=members
        )
        (folder / "case.toml").write_text(case)
        record = ["--record", folder / "ground.txt", "--dt", str(dt), "--units", "m/s2"]
        out = subprocess.run(
            [tune, "housner", folder / "case.toml", *record],
            check=True,
            capture_output=True,
            text=True,
        ).stdout
    return np.array([float(row["th"]) for row in csv.DictReader(out.splitlines())])


def main():
    dt = 0.01
    accel = ground(dt, 8.0)
    for name, k, n, c in [
        ("tendon", 4e7, 2e5, 0.0),
        ("dampers", 0.0, 0.0, 8e4),
        ("tendon and dampers", 4e7, 2e5, 8e4),
    ]:
        body = Body(HALF_WIDTH, HEIGHT, MASS, INERTIA, k, n, c)
        theta, impacts = history(body, accel, dt)
        peak = np.abs(theta).argmax()
        print(f"{name}: sample {peak} {float(theta[peak])!r}, last {float(theta[-1])!r}, {len(impacts)} impacts,")
        print(f"    the first at {float(impacts[0][0])!r} s")
        if len(sys.argv) > 1:
            apart = np.abs(of_tune(sys.argv[1], accel, dt, k, n, c) - theta).max()
            print(f"    tune housner differs by {apart:.1e} rad")
            if apart > 1e-9:
                sys.exit("more than 1e-9 rad")


if __name__ == "__main__":
    main()
