#!/usr/bin/env python3
"""Ten histories of a sweep with OpenSees: El Centro at two levels of PGA on the five structures of
tuning/sweeps/fragility.toml, each by a deck of `tune export` on the springs that the sweep tuned; peaks beside the
sweep's, and ratios of run time.

    opensees_sweep.py TUNE [LEVEL,LEVEL,...]      (PGA in g; 0.35,0.5 unless said)

Runs the decks with the Python that starts it, which needs numpy and openseespy. Times are of one processor, so that
others on the machine do not count; starting Python and loading OpenSees is taken off. Exit code 1 if a deck stops, or a
history that rocks in both models and on which Housner and the finite elements of the sweep agree differs in its peak by
more than 0.01 alpha.
"""

import csv, json, math, pathlib, resource, subprocess, sys, tempfile

import numpy as np

TUNE = sys.argv[1]
LEVELS = [float(x) for x in (sys.argv[2] if len(sys.argv) > 2 else "0.35,0.5").split(",")]
G = 9.81
#              kind, height of the centre of mass, width [m], mass [kg]
STRUCTURES = [
    ("aframe", 61.0, 12.2, 680.1e3),
    ("aframe", 12.0, 2.4, 350e3),
    ("block", 3.0, 1.2, 10e3),
    ("block", 1.0, 0.5, 400.0),
    ("block", 0.6, 0.4, 100.0),
]
MANY = 400


def seconds(*command, **options):
    """Processor time of a command, and what it printed."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    run = subprocess.run(list(map(str, command)), capture_output=True, text=True, **options)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, run


def swept(folder, model, levels):
    """The histories of a sweep, and seconds each; tuning does not count."""
    tables = "".join(
        f'[[structure]]\nkind = "{k}"\nheight_m = {h}\nwidth_m = {w}\nmass_kg = {m}\n' for k, h, w, m in STRUCTURES
    )
    name = f"{model}{len(levels)}"
    sweep, out = folder / f"{name}.toml", folder / name
    text = ", ".join(map(repr, map(float, levels)))
    sweep.write_text(
        f'[sweep]\nkind = "fragility"\nmodel = "{model}"\n{tables}[records]\nel_centro = true\n[levels]\n'
        f"pga_g = [{text}]\n"
    )
    seconds(TUNE, "sweep", "plan", sweep, "--out", out, "--quiet", check=True)
    took, _ = seconds(TUNE, "sweep", sweep, "--out", out, "--shard", "1/1", "--jobs", "1", "--quiet", check=True)
    seconds(TUNE, "sweep", "gather", sweep, "--out", out, "--no-figures", check=True)
    return took / (len(levels) * len(STRUCTURES)), list(csv.DictReader(open(out / "histories.csv"))), out


def parameters(structure, springs):
    """A parameter file of a structure on the sweep's springs."""
    kind, h, w, m = structure
    r2 = h * h + w * w / 4.0
    inertia = m * r2 / 3.0 if kind == "block" else 1e-5 * m * r2
    p = math.sqrt(m * G * math.sqrt(r2) / (m * r2 + inertia))

    def chain(unit):
        hz, mu = unit["omega_n_hz_over_p"] * p, unit["mu"]
        omega = 2.0 * math.pi * hz
        return {
            "mu": mu,
            "f": unit["f"],
            "xi": unit["xi"],
            "omega_n_hz": hz,
            "k1_n_per_m": m * omega**2,
            "k2_n_per_m": unit["f"] ** 2 * mu * m * omega**2,
            "m2_kg": mu * m,
            "c_ns_per_m": 2.0 * unit["xi"] * mu * m * omega,
        }

    body = {"kind": kind, "height_m": h, "width_m": w, "mass_kg": m, "rotational_inertia_kgm2": inertia}
    return {"structure": body, "vertical": chain(springs["vertical"]), "horizontal": chain(springs["horizontal"])}


def main():
    wrong, theirs = 0, []
    start = min(seconds(sys.executable, "-c", "import openseespy.opensees, math, csv")[0] for _ in range(3))
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        _, rows, out = swept(folder, "both", LEVELS)
        springs = json.loads((out / "springs.json").read_text())["springs"]
        print(
            "| structure | PGA, g | OpenSees, s | peak of theta/alpha: OpenSees | our finite elements | Housner |\n"
            "|---|---|---|---|---|---|"
        )
        for i, row in enumerate(rows):
            structure = STRUCTURES[int(row["structure_index"])]
            b = structure[2] / 2.0
            alpha = math.atan2(b, structure[1])
            # geometries that share their shape share their springs
            of = min(springs, key=lambda s: abs(s["alpha"] - alpha) + abs(s["restitution"] - float(row["restitution"])))
            file, deck = folder / "parameters.json", folder / "deck.py"
            file.write_text(json.dumps(parameters(structure, of)))
            subprocess.run(
                [
                    TUNE,
                    "export",
                    "--parameters",
                    file,
                    "--scale",
                    row["scale"],
                    "--format",
                    "openseespy",
                    "--out",
                    deck,
                ],
                check=True,
                capture_output=True,
            )
            took, run = seconds(sys.executable, deck)
            theirs.append(took - start)
            history = folder / "deck_history.csv"
            if run.returncode or not history.exists():
                print(
                    f"| {row['structure']} | {float(row['level']):g} "
                    f"| stopped: {run.stderr.strip().splitlines()[-1:]} |"
                )
                wrong += 1
                continue
            peak = max(abs(float(r["th"])) for r in csv.DictReader(open(history))) / alpha
            history.unlink()
            fem, housner = float(row["fem_peak"]), float(row["housner_peak"])
            down = row["fem_overturned"] == "true"
            mark = "overturned" if down else f"{fem:.4f}"
            told = "overturned" if peak > 1.5 else f"{peak:.4f}"
            rigid = "overturned" if row["housner_overturned"] == "true" else f"{housner:.4f}"
            bad = down != (peak > 1.5) if abs(fem - housner) < 0.01 else False
            bad |= not down and 0.0 < fem < 1.0 and abs(fem - housner) < 0.01 and abs(peak - fem) > 0.01
            wrong += bad
            print(
                f"| {row['structure']} | {float(row['level']):g} | {took - start:.1f} | {told} | {mark} | {rigid} "
                f"|{' WRONG' if bad else ''}",
                flush=True,
            )
        many = np.geomspace(LEVELS[0], LEVELS[-1], MANY)
        fem, rigid = (
            swept(folder, "fem", many)[0],
            swept(folder, "housner", np.geomspace(LEVELS[0], LEVELS[-1], 10 * MANY))[0],
        )
    opensees = sum(theirs) / len(theirs)
    print(
        f"OpenSees {opensees:.2f} s a history; tune: finite elements in lanes {1e3 * fem:.2f} ms, {opensees / fem:.0f} "
        f"times; Housner {1e6 * rigid:.0f} us, {opensees / rigid:.0f} times"
    )
    sys.exit(wrong > 0)


main()
