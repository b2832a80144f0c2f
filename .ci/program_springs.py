#!/usr/bin/env python3
"""What `tune run --step` promises of springs for programs with fixed time steps, beside what OpenSees finds.

    program_springs.py target/release/tune [--motions 48] [--opensees 8] [--only NAME,...]

Exit code 1 if a promise is missed. For ten structures that no number in the program was chosen with, three
steps and three integrators: springs and promise of `tune run --no-record`, then the error of the model beside
Housner's history on well-conditioned synthetic motions of another seed, emulated and in OpenSees at a constant
step. Errors are medians of the normalised root mean square of u, in units of p dt. Needs openseespy, and
`cargo build --release --example fixed_steps`.
"""

import argparse, json, math, os, pathlib, subprocess, sys, tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from fixed_steps import GRAVITY, ROOT, Emulator, in_opensees, nrmse

SEED = 1953
# what a promise may be off by, medians over p dt, histories through
OFF, MOST, THROUGH = 1.5, 22.0, {"trbdf2": 0.99, "backward-euler": 0.99, "hht:-0.3333333333333333": 0.95}
# p dt beyond which rows do not count
LONGEST = 0.03
STRUCTURES = {
    "frame 3 m": dict(kind="aframe", height_m=3.0, width_m=0.9, mass_kg=2e3),
    "frame 8 m": dict(kind="aframe", height_m=8.0, width_m=1.0, mass_kg=3e4),
    "frame 20 m": dict(kind="aframe", height_m=20.0, width_m=8.0, mass_kg=2e5),
    "frame 45 m": dict(kind="aframe", height_m=45.0, width_m=6.0, mass_kg=5e5),
    "frame 80 m": dict(kind="aframe", height_m=80.0, width_m=24.0, mass_kg=1e6),
    "block 0.2 m": dict(kind="block", total_height_m=0.4, width_m=0.1, mass_kg=20.0),
    "block 0.7 m": dict(kind="block", total_height_m=1.4, width_m=0.5, mass_kg=300.0),
    "block 2 m": dict(kind="block", total_height_m=4.0, width_m=0.6, mass_kg=5e3),
    "block 3 m": dict(kind="block", total_height_m=6.0, width_m=2.6, mass_kg=3e4),
    "block 4 m": dict(kind="block", total_height_m=8.0, width_m=1.6, mass_kg=6e4),
}
STEPS = (1e-2, 1e-3, 2.5e-4)
INTEGRATORS = tuple(THROUGH)


def tuned(tune, structure, step, integrator):
    """parameters.json of a run without a record."""
    with tempfile.TemporaryDirectory() as folder:
        case = pathlib.Path(folder) / "case.toml"
        case.write_text("[structure]\n" + "".join(f"{key} = {json.dumps(value)}\n" for key, value in structure.items()))
        out = pathlib.Path(folder) / "out"
        asked = ["--step", str(step), "--integrator", integrator]
        command = [tune, "run", case, "--no-record", "--no-report", "--quiet", *asked, "--out", out]
        subprocess.run(command, check=True, capture_output=True)
        return json.loads((out / "parameters.json").read_text())


def median(errors, of):
    ordered = sorted(errors) + [math.inf] * (of - len(errors))
    return (ordered[(of - 1) // 2] + ordered[of // 2]) / 2


def main():
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("tune")
    options.add_argument("--motions", type=int, default=48)
    options.add_argument("--opensees", type=int, default=8)
    options.add_argument("--steps", type=float, nargs="*", default=STEPS)
    options.add_argument("--only", default="")
    options.add_argument("--program", default=str(ROOT / "target/release/examples/fixed_steps"))
    asked = options.parse_args()
    emulator, missed = Emulator(asked.program), []
    os.dup2(os.open(os.devnull, os.O_WRONLY), 2)  # OpenSees tells of every step that fails
    only = [name for name in asked.only.split(",") if name]
    print(
        "| structure | dt (s) | p dt | integrator | promised | emulated, median | 90 % | lost | in OpenSees | lost |  |"
    )
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    for name, structure in STRUCTURES.items():
        if only and name not in only:
            continue
        for step in asked.steps:
            for integrator in INTEGRATORS:
                found = tuned(asked.tune, structure, step, integrator)
                kept, row = found["structure"], found["program"]
                half_width, height, mass = kept["width_m"] / 2, kept["height_m"], kept["mass_kg"]
                body = [height, half_width, mass, row["rotational_inertia_kgm2"]]
                r = math.hypot(height, half_width)
                p = math.sqrt(mass * GRAVITY * r / (body[3] + mass * r * r))
                if p * step > LONGEST:
                    continue
                unit = lambda c: [c["k1_n_per_m"], c["k2_n_per_m"], c["m2_kg"], c["c_ns_per_m"]]
                springs = {way: unit(row[way]) for way in ("vertical", "horizontal")}
                motions = emulator.ask({"references": asked.motions, "seed": SEED, "body": body})
                errors, lost = ([], []), [0, 0]
                for i, motion in enumerate(motions):
                    case = dict(
                        body=body,
                        integrator=integrator,
                        step=step,
                        dt=motion["dt"],
                        accel=motion["accel"],
                        substeps=row["substeps"],
                        tolerance=row["converged"]["increment_m"],
                        **springs,
                    )
                    for k, follow in enumerate((emulator.ask, in_opensees)[: 2 if i < asked.opensees else 1]):
                        history = follow(case)
                        if history["stopped"] is None and len(history["u"]) == len(motion["u"]):
                            errors[k].append(nrmse(history["u"], motion["u"]) / (p * step))
                        else:
                            lost[k] += 1
                counts = [len(e) + l for e, l in zip(errors, lost)]
                here, there = (median(e, n) if n else math.nan for e, n in zip(errors, counts))
                ninety = (sorted(errors[0]) + [math.inf] * lost[0])[min(math.ceil(0.9 * counts[0]) - 1, counts[0] - 1)]
                measured = row["expected"].get("synthetic") or {}
                promised = ((measured.get("history") or [None])[0] or math.inf) / (p * step)
                wrong = []
                if not math.isnan(there) and not there / OFF <= promised <= there * OFF:
                    wrong.append("promise")
                if here > MOST:
                    wrong.append("median")
                if lost[0] > (1 - THROUGH[integrator]) * counts[0]:
                    wrong.append("lost")
                missed += wrong
                print(
                    f"| {name} | {step:g} | {p * step:.5f} | {integrator[:10]} | {promised:.1f} | {here:.1f} "
                    f"| {ninety:.0f} | {lost[0]} of {counts[0]} | {there:.1f} | {lost[1]} of {counts[1]} "
                    f"| {', '.join(wrong)} |",
                    flush=True,
                )
    print(f"missed: {len(missed)} ({', '.join(f'{w} {missed.count(w)}' for w in sorted(set(missed)))})")
    return 1 if missed else 0


if __name__ == "__main__":
    sys.exit(main())
