#!/usr/bin/env python3
"""Histories of `crates/fixed-steps` beside those of OpenSees with the same model, springs, integrator and constant step.

The model is our deck's (crates/decks/src/deck.py, solver.py: their text is run here), stepped by `analyze(1, step)`. Needs openseespy.

    fixed_steps.py [--short] [--json FILE]       exit code 1 if they do not agree
"""
import argparse, json, math, os, pathlib, subprocess, sys, time

import openseespy.opensees as ops

ROOT = pathlib.Path(__file__).resolve().parent.parent
GRAVITY = 9.81
# OpenSees' own arguments
INTEGRATORS = {
    "newmark:0.5:0.25": ("Newmark", 0.5, 0.25),
    "hht:0": ("HHT", 1.0),
    "hht:-0.1": ("HHT", 0.9),
    f"hht:{-1 / 3}": ("HHT", 2 / 3),
    "trbdf2": ("TRBDF2",),
    "backward-euler": ("BackwardEuler",),
}
STEPS = (1e-2, 1e-3, 2.5e-4)


def deck(body, vertical, horizontal, tolerance):
    """The deck's functions with these numbers in place of its own."""
    height, half_width, mass, inertia = body
    text = (ROOT / "crates/decks/src/deck.py").read_text()
    text = text[text.index("# ---------------------------------------------------------------- tags"):text.index("@SOLVER@")]
    text += (ROOT / "crates/decks/src/solver.py").read_text()
    scope = dict(ops=ops, math=math, sys=sys, GRAVITY=GRAVITY, HEIGHT=height, HALF_WIDTH=half_width, MASS=mass, INERTIA=inertia,
                 LEG=LEG * max(vertical[0], horizontal[0]), DAMPER_C=0.0, TENDON_K=0.0, TENDON_SLACK=0.0, TOLERANCE=tolerance)
    for name, (k1, k2, m2, c) in (("V", vertical), ("H", horizontal)):
        scope |= {f"K1_{name}": k1, f"K2_{name}": k2, f"M2_{name}": m2, f"C_{name}": c}
    exec(text.replace("@FRICTION@", "1e7"), scope)
    return scope


LEG = 4.0   # stiffness of the deck's legs over that of the stiffest gap


def in_opensees(case):
    """u, v, theta at the record's samples; when it stopped, if it did; seconds."""
    model = deck(case["body"], case["vertical"], case["horizontal"], case["tolerance"])
    model["build"]()
    settled = model["gravity"]([(3, case["body"][2])])
    dt, accel, step = case["dt"], case["accel"], case["step"]
    ops.timeSeries("Path", 2, "-dt", dt, "-values", *accel)
    ops.pattern("Plain", 2, 2)
    for node, mass in ((3, case["body"][2]), (11, case["horizontal"][2]), (12, case["horizontal"][2])):
        ops.load(node, -mass, 0.0, 0.0)
    model["analysis"](*INTEGRATORS[case["integrator"]])
    rows, stopped, begin = [[0.0, 0.0, 0.0]], None, time.time()
    before, shown = rows[0], 1
    for n in range(math.ceil((len(accel) - 1) * dt / step - 1e-6)):
        if ops.analyze(1, step) != 0:
            stopped = n * step
            break
        now = [ops.nodeDisp(3, 1), ops.nodeDisp(3, 2) - settled, -ops.nodeDisp(3, 3)]
        if abs(now[2]) > math.pi / 2:
            break
        while shown < len(accel) and shown * dt <= (n + 1) * step + 1e-6 * step:
            part = (shown * dt - n * step) / step
            rows.append(now if part > 1 - 1e-6 else [a + part * (b - a) for a, b in zip(before, now)])
            shown += 1
        before = now
    return dict(u=[r[0] for r in rows], v=[r[1] for r in rows], theta=[r[2] for r in rows], stopped=stopped, seconds=time.time() - begin)


class Emulator:
    def __init__(self):
        self.process = subprocess.Popen([PROGRAM], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def ask(self, question):
        print(json.dumps(question), file=self.process.stdin, flush=True)
        return json.loads(self.process.stdout.readline())


def nrmse(x, y):
    n = min(len(x), len(y))
    below = sum(b * b for b in y[:n])
    return math.sqrt(sum((a - b)**2 for a, b in zip(x[:n], y[:n])) / below) if below else 0.0


def chain(mass, k, c, mu, hz):
    k1 = mass * (2 * math.pi * hz)**2
    return [k1, k * k1, mu * mass, c * mass * 2 * math.pi * hz]


def p_alpha(body):
    height, half_width, mass, inertia = body
    r = math.hypot(height, half_width)
    return math.sqrt(mass * GRAVITY * r / (inertia + mass * r * r)), math.atan2(half_width, height)


def springs(kind, body, step):
    """The recipe's, or a plain chain of 160 Hz."""
    mass = body[2]
    if kind == "plain":
        return chain(mass, 0.1, 0.75, 0.3, 160.0), chain(mass, 0.57, 1.86, 0.3, 160.0)
    p, alpha = p_alpha(body)
    hz = 7.75 * math.sqrt(p / step) / alpha / (2 * math.pi)
    return chain(mass, 0.25, 0.6, 0.2, hz), chain(mass, 0.25, 0.6, 0.2, 4 * hz)


def bodies():
    def frame(height, width, mass):
        r2 = height**2 + (width / 2)**2
        return [height, width / 2, mass, 1e-3 * mass * r2]
    block = [1.3, 0.35, 1000.0, 1000.0 * (1.3**2 + 0.35**2) / 3]
    return {"frame 61 m": frame(61.0, 12.2, 680.1e3), "frame 12 m": frame(12.0, 2.2, 1e4), "block 1.3 m": block}


def main():
    global PROGRAM, LEG
    options = argparse.ArgumentParser()
    options.add_argument("--short", action="store_true")
    options.add_argument("--program", default=str(ROOT / "target/release/examples/fixed_steps"))
    options.add_argument("--motions", type=int, default=2)
    options.add_argument("--leg", type=float, default=LEG)
    options.add_argument("--steps", type=float, nargs="*", default=STEPS)
    options.add_argument("--seed", type=int, default=2005)
    options.add_argument("--seconds", type=float, default=10.0)
    options.add_argument("--kinds", nargs="*", default=("recipe", "plain"))
    options.add_argument("--integrators", nargs="*", default=list(INTEGRATORS))
    asked = options.parse_args()
    PROGRAM, LEG = asked.program, asked.leg
    emulator = Emulator()
    null = os.open(os.devnull, os.O_WRONLY)
    err = os.dup(2)
    os.dup2(null, 2)   # OpenSees tells of every step that fails
    print("| body | springs | step | integrator | motion | 2 s | all | width + 1e-9 | peak | stopped here / OpenSees | time here / OpenSees |")
    for name, body in bodies().items():
        motions = emulator.ask({"body": body, "motions": asked.motions, "seed": asked.seed})
        for kind in asked.kinds:
            for step in asked.steps:
                for integrator in asked.integrators:
                    for motion in motions:
                        vertical, horizontal = springs(kind, body, step)
                        count = min(len(motion["accel"]), int(asked.seconds / motion["dt"]) + 1)
                        tolerance = 2e-14 * math.hypot(body[0], body[1])
                        case = dict(body=body, vertical=vertical, horizontal=horizontal, integrator=integrator, step=step,
                                    tolerance=tolerance, dt=motion["dt"], accel=motion["accel"][:count])
                        ours, theirs = emulator.ask(case), in_opensees(case)
                        wider = emulator.ask(case | {"body": [body[0], body[1] * (1 + 1e-9), *body[2:]]})
                        two = int(2.0 / motion["dt"]) + 1
                        early, all_ = nrmse(ours["u"][:two], theirs["u"][:two]), nrmse(ours["u"], theirs["u"])
                        peak = max(abs(x) for x in theirs["u"])
                        print(f"| {name} | {kind} | {step:g} | {integrator[:10]} | {motion['name']} | {early:.1e} | {all_:.1e} "
                              f"| {nrmse(wider['u'], ours['u']):.1e} | {peak:.3g} | {ours['stopped']} / {theirs['stopped']} "
                              f"| {ours['seconds'] * 1e3:.1f} / {theirs['seconds'] * 1e3:.0f} ms |", flush=True)
    os.dup2(err, 2)


if __name__ == "__main__":
    main()
