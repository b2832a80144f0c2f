#!/usr/bin/env python3
"""Rocking of a rigid body with a tendon and dampers, by SciPy: values of the test
`crates/rocking/tests/housner/restrained.rs`.

    python3 .ci/restrained.py

Equation of motion from Cartesian positions of the mass and of the corners about the pivot, numeric
virtual work: d/dt(I0 w') = sum of F . dr/dw. Impacts by equation 2. Ground: linear between samples.
"""

import numpy as np
from scipy.integrate import solve_ivp

G = 9.81


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


def history(body, accel, dt, theta0=0.0, until=None):
    """theta at the samples, and impacts."""
    count = len(accel)
    times = np.arange(count) * dt
    theta, impacts = [theta0], []
    rocking, side, state = theta0 != 0, np.sign(theta0) or 1.0, [abs(theta0), 0.0]
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
                # off the ground by a Taylor step: w''' alone is not zero there
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


def noise(dt, seconds):
    t = np.arange(round(seconds / dt) + 1) * dt
    g = 0.25 * np.sin(5.1 * t) + 0.2 * np.sin(11.3 * t + 1) + 0.15 * np.sin(23.7 * t + 2)
    return t, g


def main():
    dt = 0.01
    t, g = noise(dt, 8.0)
    accel = np.round(3.0 * g * np.minimum(t / 2, 1) * G / 3, 6)
    for name, k, n, c in [("tendon", 4e7, 2e5, 0.0), ("dampers", 0.0, 0.0, 8e4),
                          ("both", 4e7, 2e5, 8e4)]:
        body = Body(1.05, 8.9, 120e3, 3.0e5, k, n, c)
        theta, impacts = history(body, accel, dt)
        peak = np.abs(theta).argmax()
        print(name, "peak", peak, repr(theta[peak]), "end", repr(theta[-1]), len(impacts))
        print("  ", impacts[:3])


if __name__ == "__main__":
    main()
