#!/usr/bin/env python3
"""Histories of `crates/fixed-steps` beside those of OpenSees with the same model, springs,
integrator and constant step.

The models are our decks' (crates/decks/src/deck.py, elastic_deck.py, solver.py: their text is run here), stepped by
`analyze(1, step)`. Needs openseespy, and `cargo build --release --example fixed_steps`.

    fixed_steps.py [--short]       exit code 1 if they do not agree
    fixed_steps.py --medians N     the error of the recipe against Housner on N well-conditioned motions,
                                   here and in OpenSees

Errors are normalised root mean squares of u: over the 2 s that follow the first rise of the body (u above a thousandth
of its peak), and over the whole; beside them what a change of the width by 1e-9 does to our own history, a thousand
times: a history that moves by more than the limit is not predictable, and does not count. So does one that stops in
both programs at the same step.
"""

import argparse, json, math, os, pathlib, subprocess, sys, time

import openseespy.opensees as ops

ROOT = pathlib.Path(__file__).resolve().parent.parent
GRAVITY = 9.81
# Stiffness of the decks' legs and arms over that of the stiffest gap. Under HHT a foot, which has no mass, keeps a part
# alpha/(1 + alpha) of what its leg gave in the step before, and lifts a little elsewhere than a rigid body's: the
# errors early on are inversely as the legs' stiffness.
LEG = 4.0
EARLY, WHOLE = 1e-5, 2e-3
# Share of histories that may differ: a program stops where its iteration goes to and fro between contacts,
# and rounding may end that.
DIFFERENT = 0.04
# name here, OpenSees' own arguments
INTEGRATORS = {
    "newmark:0.5:0.25": ("Newmark", 0.5, 0.25),
    "hht:0": ("HHT", 1.0),
    "hht:-0.1": ("HHT", 0.9),
    f"hht:{-1 / 3}": ("HHT", 2 / 3),
    "trbdf2": ("TRBDF2",),
    "backward-euler": ("BackwardEuler",),
}
STEPS = (1e-2, 1e-3, 2.5e-4)


def deck(name, numbers):
    """The functions of a deck with these numbers in place of its own."""
    text = (ROOT / f"crates/decks/src/{name}.py").read_text()
    text = text[
        text.index("# ---------------------------------------------------------------- tags") : text.index("@SOLVER@")
    ]
    text += (ROOT / "crates/decks/src/solver.py").read_text()
    own = {"FRICTION": "1e7", "LEG": str(LEG), "SHEAR_SPRINGS": "", "FULL_STEPS": "", "LINE_SEARCH": ""}
    for key, value in own.items():
        text = text.replace(f"@{key}@", value)
    scope = dict(ops=ops, math=math, sys=sys, GRAVITY=GRAVITY) | numbers
    exec(text, scope)
    return scope


def rigid(case):
    """Build the body; its masses; the nodes of its absorbers; how a row is read."""
    height, half_width, mass, inertia = case["body"]
    vertical, horizontal = case["vertical"], case["horizontal"]
    numbers = dict(
        HEIGHT=height,
        HALF_WIDTH=half_width,
        MASS=mass,
        INERTIA=inertia,
        LEG=LEG * max(vertical[0], horizontal[0]),
        DAMPER_C=0.0,
        DAMPER_ALOFT=0.0,
        TENDON_K=0.0,
        TENDON_SLACK=0.0,
        TOLERANCE=case["tolerance"],
    )
    for name, (k1, k2, m2, c) in (("V", vertical), ("H", horizontal)):
        numbers |= {f"K1_{name}": k1, f"K2_{name}": k2, f"M2_{name}": m2, f"C_{name}": c}
    return (
        deck("deck", numbers),
        [(3, mass)],
        (11, 12),
        lambda: (ops.nodeDisp(3, 1), ops.nodeDisp(3, 2), -ops.nodeDisp(3, 3)),
    )


def elastic(case):
    """The same of a pier: nodes 1 (footing) and 2 (mass)."""
    pier = case["pier"]
    mass, centre, top = pier["footing"]
    inertia = mass * (pier["width"] ** 2 + 4 * centre**2) / 12
    ea, ei, eta_a, eta_i = pier["column"]
    units = [tuple(case[name][k] for k in (0, 1, 3, 2)) for name in ("vertical", "horizontal")]
    numbers = dict(
        NODES=((0.0, centre, mass, inertia), (0.0, pier["height"], pier["mass"], 0.0)),
        TOP=2,
        DAMPERS=(),
        TENDONS=(),
        BEAMS=((0, 1, (0.0, top - centre), (0.0, 0.0), ea, ei, eta_a / ea, eta_i / ei),),
        CORNERS=tuple((0, (side * pier["width"] / 2, -centre), *units) for side in (-1, 1)),
        RECORD_DT=case["dt"],
        DAMPED_FROM=1.2 * case["step"],
        TOLERANCE=case["tolerance"],
    )
    masses = [(1, mass), (2, pier["mass"])]
    return (
        deck("elastic_deck", numbers),
        masses,
        (2000, 2001),
        lambda: (ops.nodeDisp(2, 1), ops.nodeDisp(2, 2), -ops.nodeDisp(1, 3)),
    )


def as_opensees_damps(case):
    """The case as our own program has to be asked. OpenSees' damping objects under HHT take the change of a force from
    one point (1 + alpha) dt within a step to the next, which is a step apart, and divide by (1 + alpha) dt: they act
    1/(1 + alpha) times too strongly, however short the step. They keep the force that the element was last asked for;
    HHT asks for none at the step's end."""
    if "pier" not in case or not case["integrator"].startswith("hht"):
        return case
    stronger = 1.0 / INTEGRATORS[case["integrator"]][1]
    *stiffness, axial, bending = case["pier"]["column"]
    return case | {"pier": case["pier"] | {"column": [*stiffness, stronger * axial, stronger * bending]}}


class Touches:
    """Substeps where a gap is about to open or close, and in the step after one that did."""

    def __init__(self, case):
        self.body, self.step, self.substeps = case["body"], case["step"], case["at_touches"]
        self.closed = None

    def gaps(self):
        """Compression of the gaps, and its rate."""
        height, half_width = self.body[:2]
        z, theta, rate_z, rate = ops.nodeDisp(3, 2), -ops.nodeDisp(3, 3), ops.nodeVel(3, 2), -ops.nodeVel(3, 3)
        for node, side in ((11, -half_width), (12, half_width)):
            foot = z - side * math.sin(theta) + height * (1 - math.cos(theta))
            foot_rate = rate_z + (height * math.sin(theta) - side * math.cos(theta)) * rate
            yield ops.nodeDisp(node, 2) - foot, ops.nodeVel(node, 2) - foot_rate

    def parts(self):
        gaps = list(self.gaps())
        closed = [d >= 0 for d, _ in gaps]
        near = self.closed not in (None, closed) or any((d > 0) != (d + rate * self.step > 0) for d, rate in gaps)
        self.closed = closed
        return self.substeps if near else 1


def step(size, least):
    """One step, or two halves of it down to this size; whether it holds."""
    return ops.analyze(1, size) == 0 or size > 1.5 * least and step(size / 2, least) and step(size / 2, least)


def in_opensees(case):
    """u, v, theta at the record's samples; when it stopped, if it did; seconds."""
    model, masses, absorbers, read = (rigid if "body" in case else elastic)(case)
    model["build"]()
    settled = model["gravity"](masses)
    dt, accel, size = case["dt"], case["accel"], case["step"]
    ops.timeSeries("Path", 2, "-dt", dt, "-values", *accel)
    ops.pattern("Plain", 2, 2)
    for node, mass in masses + [(node, case["horizontal"][2]) for node in absorbers]:
        ops.load(node, -mass, 0.0, 0.0)
    model["analysis"](*INTEGRATORS[case["integrator"]])
    if "unbalance" in case:
        ops.test("NormUnbalance", case["unbalance"], 30, 0)

    def row():
        u, v, theta = read()
        return u, v - settled, theta

    rows, stopped, begin = [row()], None, time.time()
    before, shown = rows[0], 1
    refinement = Touches(case) if case.get("at_touches", 1) > 1 else None
    for n in range(math.ceil((len(accel) - 1) * dt / size - 1e-6)):
        # the same number each time: a multi-step integrator begins anew at every other one
        parts = refinement.parts() if refinement else 1
        if not all(step(size / parts, size / parts / case.get("substeps", 1)) for _ in range(parts)):
            stopped = n * size
            break
        now = row()
        while shown < len(accel) and shown * dt <= (n + 1) * size + 1e-6 * size:
            part = (shown * dt - n * size) / size
            rows.append(now if part > 1 - 1e-6 else [a + part * (b - a) for a, b in zip(before, now)])
            shown += 1
        before = now
        if abs(now[2]) > math.pi / 2:
            break
    return dict(
        u=[r[0] for r in rows],
        v=[r[1] for r in rows],
        theta=[r[2] for r in rows],
        stopped=stopped,
        seconds=time.time() - begin,
    )


class Emulator:
    """Our own program: a question a line."""

    def __init__(self, program):
        self.process = subprocess.Popen([program], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def ask(self, question):
        print(json.dumps(question), file=self.process.stdin, flush=True)
        return json.loads(self.process.stdout.readline())


def nrmse(x, y, span=slice(None)):
    n = min(len(x), len(y))
    x, y = x[:n][span], y[:n][span]
    below = sum(b * b for b in y)
    return math.sqrt(sum((a - b) ** 2 for a, b in zip(x, y)) / below) if below else 0.0


def chain(mass, k, c, mu, hz):
    k1 = mass * (2 * math.pi * hz) ** 2
    return [k1, k * k1, mu * mass, c * mass * 2 * math.pi * hz]


def plain(mass):
    """A plain chain of 160 Hz."""
    return dict(vertical=chain(mass, 0.1, 0.75, 0.3, 160.0), horizontal=chain(mass, 0.57, 1.86, 0.3, 160.0))


def structures():
    """Name, the structure's part of a case, its size (m), the body that motions are made for."""

    def frame(height, width, mass):
        return [height, width / 2, mass, 1e-3 * mass * (height**2 + (width / 2) ** 2)]

    for name, body in (
        ("frame 61 m", frame(61.0, 12.2, 680.1e3)),
        ("frame 12 m", frame(12.0, 2.2, 1e4)),
        ("block 1.3 m", [1.3, 0.35, 1000.0, 1000.0 * (1.3**2 + 0.35**2) / 3]),
    ):
        yield name, {"body": body}, math.hypot(*body[:2]), body
    mass, height, hz = 6e5, 12.0, 2.0
    bending = mass * (2 * math.pi * hz) ** 2 * (height - 0.75) ** 3 / 3
    # the column begins at the footing's centre: an arm to its top would give, as those to the corners do,
    # and only theirs is made up for
    for name, damping in (("pier 2 Hz", 0.0), ("damped pier", 0.02)):
        ahead = 2 * damping / (2 * math.pi * hz)
        column = [100.0 * bending / height**2 * 3, bending, ahead * 300.0 * bending / height**2, ahead * bending]
        pier = dict(mass=mass, height=height, width=4.0, footing=[1.2e5, 0.75, 0.75], column=column)
        yield name, {"pier": pier}, math.hypot(height, 4.0), [height, 2.0, mass, 0.0]


def units(emulator, kind, case, body, integrator, step):
    """The recipe's or a plain chain, and the tolerance of its iteration."""
    if kind == "plain":
        mass = body[2] if "body" in case else case["pier"]["footing"][0]
        return plain(mass)
    recipe = emulator.ask({"recipe": integrator, "step": step, "body": body})
    found = {key: recipe[key] for key in ("vertical", "horizontal")}
    if kind == "recipe, unbalance":
        # as crates/fixed-steps/src/program.rs
        height, half_width, mass = body[:3]
        found["unbalance"] = math.sqrt(2) * half_width / height * mass * GRAVITY
    return found


def widened(case):
    """The same, 1e-9 wider."""
    if "body" in case:
        height, half_width, *rest = case["body"]
        return case | {"body": [height, half_width * (1 + 1e-9), *rest]}
    return case | {"pier": case["pier"] | {"width": case["pier"]["width"] * (1 + 1e-9)}}


def compare(emulator, case):
    """Errors of u early and over all, predictability, when both stopped, seconds of both."""
    same = as_opensees_damps(case)
    ours, theirs, wider = emulator.ask(same), in_opensees(case), emulator.ask(widened(same))
    peak = max(map(abs, theirs["u"]))
    rise = next(i for i, u in enumerate(theirs["u"]) if abs(u) >= 1e-3 * peak)
    early = slice(0, rise + int(2.0 / case["dt"]) + 1)
    return dict(
        early=nrmse(ours["u"], theirs["u"], early),
        whole=nrmse(ours["u"], theirs["u"]),
        peak=peak,
        moved=1e3 * nrmse(wider["u"], ours["u"]),
        moved_early=1e3 * nrmse(wider["u"], ours["u"], early),
        stopped=(ours["stopped"], theirs["stopped"]),
        seconds=(ours["seconds"], theirs["seconds"]),
    )


def verdict(found):
    """What is wrong, if anything."""
    ours, theirs = found["stopped"]
    same = ours == theirs or (ours is not None and theirs is not None and abs(ours - theirs) < 1e-9)
    if found["early"] > max(EARLY, found["moved_early"]):
        return "early"
    if found["moved"] > WHOLE:
        return "not predictable"
    if found["whole"] > WHOLE:
        return "whole"
    return "" if same else "stop"


def medians(emulator, count, steps):
    """The median error of the recipe over p dt, here and in OpenSees, on the same motions."""

    def median(errors, of):
        ordered = sorted(errors) + [math.inf] * (of - len(errors))
        return (ordered[(of - 1) // 2] + ordered[of // 2]) / 2

    print(
        "| body | step (s) | integrator | here/(p dt) | OpenSees/(p dt) | stopped here / in OpenSees | of "
        "| expected/(p dt) |"
    )
    print("|---|---|---|---|---|---|---|---|")
    for name, part, _, body in structures():
        if "pier" in part:
            continue
        for step, integrator in ((s, i) for s in steps for i in ("trbdf2", "backward-euler", f"hht:{-1 / 3}")):
            recipe = emulator.ask({"recipe": integrator, "step": step, "body": body})
            heavy = [*body[:3], recipe["inertia"]]
            errors, stopped = ([], []), [0, 0]
            motions = emulator.ask({"references": count, "seed": 77, "body": heavy})
            for motion in motions:
                case = case_of(heavy, integrator, step, motion, recipe)
                for k, found in enumerate((emulator.ask(case), in_opensees(case))):
                    if found["stopped"] is None and len(found["u"]) == len(motion["u"]):
                        errors[k].append(nrmse(found["u"], motion["u"]))
                    else:
                        stopped[k] += 1
            height, half_width, mass, inertia = heavy
            r = math.hypot(height, half_width)
            unit = math.sqrt(mass * GRAVITY * r / (inertia + mass * r * r)) * step
            here, there = (median(e, len(motions)) / unit for e in errors)
            print(
                f"| {name} | {step:g} | {integrator[:10]} | {here:.1f} | {there:.1f} | {stopped[0]} / {stopped[1]} "
                f"| {len(motions)} | {recipe['median'] / unit:.1f} |",
                flush=True,
            )


def case_of(body, integrator, step, motion, recipe):
    """What both programs are asked: a body on the springs of the recipe under a motion."""
    springs = {key: recipe[key] for key in ("vertical", "horizontal", "tolerance")}
    return dict(body=body, integrator=integrator, step=step, dt=motion["dt"], accel=motion["accel"], **springs)


def touches(emulator, count, substeps, step=1e-3):
    """Touch refinement in OpenSees: its errors against Housner, ours on the same motions,
    both histories beside each other."""
    print("| body | integrator | error here | in OpenSees | of each other | stopped here / in OpenSees |")
    print("|---|---|---|---|---|---|")
    for name, part, _, body in structures():
        for integrator in ("trbdf2", "backward-euler") if "body" in part else ():
            recipe = emulator.ask({"recipe": integrator, "step": step, "body": body, "at_touches": substeps})
            heavy = [*body[:3], recipe["inertia"]]
            for motion in emulator.ask({"references": count, "seed": 77, "body": heavy}):
                case = case_of(heavy, integrator, step, motion, recipe) | {"at_touches": substeps}
                ours, theirs = emulator.ask(case), in_opensees(case)
                print(
                    f"| {name} | {integrator} | {nrmse(ours['u'], motion['u']):.5f} "
                    f"| {nrmse(theirs['u'], motion['u']):.5f} | {nrmse(ours['u'], theirs['u']):.1e} "
                    f"| {ours['stopped']} / {theirs['stopped']} |",
                    flush=True,
                )


def main():
    options = argparse.ArgumentParser()
    options.add_argument("--short", action="store_true", help="one motion, two steps, 6 s")
    options.add_argument("--medians", type=int, default=0)
    options.add_argument("--touches", type=int, default=0, help="N motions with twenty substeps in steps at touches")
    options.add_argument("--program", default=str(ROOT / "target/release/examples/fixed_steps"))
    options.add_argument("--motions", type=int, default=3)
    options.add_argument("--seed", type=int, default=2005)
    options.add_argument("--seconds", type=float, default=10.0)
    options.add_argument("--steps", type=float, nargs="*", default=STEPS)
    options.add_argument("--structures", nargs="*", help="names, all if none is given")
    options.add_argument("--all", action="store_true", help="a row a history")
    asked = options.parse_args()
    if asked.short:
        asked.motions, asked.seconds, asked.steps = 1, 6.0, (1e-2, 1e-3)
    emulator = Emulator(asked.program)
    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)  # OpenSees tells of every step that fails
    if asked.touches:
        return touches(emulator, asked.touches, 20)
    if asked.medians:
        return medians(emulator, asked.medians, asked.steps)
    print(
        "| structure | springs | step (s) | integrator | early | whole | histories | not predictable | both stop "
        "| time here / OpenSees (ms) |"
    )
    print("|---|---|---|---|---|---|---|---|---|---|")
    wrong, total = [], 0
    for name, part, size, body in structures():
        if asked.structures and name not in asked.structures:
            continue
        motions = emulator.ask({"body": body, "motions": asked.motions, "seed": asked.seed})
        for kind, step, integrator in (
            (k, s, i) for k in ("recipe", "plain", "recipe, unbalance") for s in asked.steps for i in INTEGRATORS
        ):
            # elsewhere steps end while a foot's force is missing, and what they end with is the iteration's path
            if kind == "recipe, unbalance" and (
                name != "frame 61 m" or step > 1e-3 or not integrator.startswith("hht:-0.3")
            ):
                continue
            all_found = []
            for motion in motions:
                count = min(len(motion["accel"]), int(asked.seconds / motion["dt"]) + 1)
                case = (
                    part
                    | units(emulator, kind, part, body, integrator, step)
                    | dict(
                        integrator=integrator,
                        step=step,
                        tolerance=2e-14 * size,
                        dt=motion["dt"],
                        accel=motion["accel"][:count],
                    )
                )
                found = compare(emulator, case)
                fault = verdict(found)
                if asked.all or fault not in ("", "not predictable"):
                    print(f"  {motion['name']} {found} {fault}")
                if fault not in ("", "not predictable"):
                    wrong.append(f"{name}, {kind}, {step:g} s, {integrator}, {motion['name']}: {fault}")
                all_found.append((found, fault))
                total += 1
            good = [f for f, fault in all_found if fault != "not predictable"]
            early = max(f["early"] for f, _ in all_found)
            whole = f"{max(f['whole'] for f in good):.1e}" if good else "-"
            stops = sum(f["stopped"][0] is not None and f["stopped"][1] is not None for f, _ in all_found)
            ours, theirs = (1e3 * sum(f["seconds"][k] for f, _ in all_found) / len(all_found) for k in (0, 1))
            print(
                f"| {name} | {kind} | {step:g} | {integrator[:10]} | {early:.1e} | {whole} | {len(all_found)} "
                f"| {len(all_found) - len(good)} | {stops} | {ours:.1f} / {theirs:.0f} |",
                flush=True,
            )
    print("\n".join([f"{total - len(wrong)} of {total} histories agree; these do not:", *wrong]))
    return 0 if len(wrong) <= DIFFERENT * total else 1


if __name__ == "__main__":
    sys.exit(main())
