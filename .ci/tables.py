#!/usr/bin/env python3
"""The tables of docs/accuracy.md: `tune run` and `tune validate` on fourteen structures, El Centro at three scales, 200
synthetic and 60 earthquake-like motions of a seed that no spring was chosen on.

    tables.py TUNE            runs everything (some minutes) and writes docs/accuracy.md anew
    tables.py --check         whether the page has the tables, rows and columns that this program writes
"""

import json, math, pathlib, re, subprocess, sys, tempfile

PAGE = pathlib.Path(__file__).resolve().parent.parent / "docs" / "accuracy.md"
SEED, SYNTHETIC, EARTHQUAKES, SCALES = 77, 200, 60, (1, 1.5, 2.5)


def frame(h, w, m=1e5):
    return f"A-frame {h:g} x {w:.4g} m", "aframe", h, w, m


def block(h, w, m=1e3):
    return f"block, mass at {h:g} m, {w:.4g} m wide", "block", h, w, m


STRUCTURES = [
    frame(61, 12.2, 680.1e3),
    frame(35, 7.7),
    frame(20, 4),
    frame(12, 2.4, 350e3),
    frame(5, 1.5, 1e4),
    block(1.3, 0.7),
    block(1, 0.5),
    block(0.3, 0.2),
    block(0.15, 0.1),
    frame(20, 40 * math.tan(0.03)),
    frame(20, 40 * math.tan(0.3)),
    frame(10, 20 * math.tan(0.5)),
    block(2, 4 * math.tan(0.05)),
    block(1, 2 * math.tan(0.5)),
]
CAPPED = [
    STRUCTURES[0],
    STRUCTURES[2],
    STRUCTURES[4],
    block(1, 0.5),
    block(0.3, 0.2),
    STRUCTURES[1],
    STRUCTURES[3],
    block(1.3, 0.7),
    block(0.15, 0.1),
]
SLENDER = [block(h, 2 * h * math.tan(0.05)) for h in (2, 1, 0.5, 0.25)]
MANY, OWN_SEED = 2000, 900

EL_CENTRO = ["structure"] + [f"scale {s:g}" for s in SCALES]
SUITE = [
    "structure",
    "Omega_n [kHz]",
    "median",
    "90 %",
    "of",
    "agreement on overturning",
    "Housner with himself",
    "KS",
    "Housner from himself",
    "earthquake-like: geometric mean",
    "of ",
]
CHAOS = ["structure", "Omega_n [kHz]", "agreement on overturning", "Housner with himself", "KS", "Housner from himself"]
CAP = ["structure", "median", "90 %", "agreement on overturning", "KS"]

INTRO = f"""# Accuracy

Written by `.ci/tables.py target/release/tune`; every number is of the program's own output. NRMSE is \
sqrt(sum (u - u_H)^2 / sum u_H^2) of
the horizontal displacement, u_H Housner's. A history is well conditioned if a change of 0.1 and of 1 % in width \
or scale moves Housner's own
by less than ten times as much, and 0.1 % in restitution by less than 0.1.
"""


def run(tune, *args):
    done = subprocess.run([tune, *map(str, args)], capture_output=True, text=True)
    if done.returncode:
        sys.exit(f"{' '.join(map(str, args))}: {done.stderr}")
    return done.stdout


def case(folder, structure):
    _, kind, h, w, m = structure
    path = folder / "case.toml"
    path.write_text(
        f'[structure]\nkind = "{kind}"\nheight_m = {h!r}\nwidth_m = {w!r}\nmass_kg = {m!r}\n[record]\n'
        "duration_s = 20.0\n"
    )
    return path


def parameters(tune, folder, structure, *more):
    out = folder / "out"
    run(tune, "run", case(folder, structure), "--quiet", "--no-figures", "--no-front", "--out", out, *more)
    return json.loads((out / "parameters.json").read_text()), out / "parameters.json"


def suites(tune, folder, file, *more):
    out = folder / "validate"
    run(tune, "validate", "--parameters", file, "--quiet", "--no-figures", "--out", out, *more)
    return json.loads((out / "validate.json").read_text())["suites"]


def short(x):
    return "-" if x is None else f"{x:.4f}" if x >= 1e-4 else f"{x:.5f}"


def on_el_centro(p):
    verdict, match = p["verdict"], p.get("match") or {}
    if match.get("nrmse_horizontal") is None or not match.get("impacts_housner"):
        return "not lifted"
    if not verdict["well_conditioned"]:
        return "ill-conditioned"
    return f"{short(match['nrmse_horizontal'])} / {short(match['nrmse_vertical'])}"


def peaks(s):
    return [
        f"{100 * s['overturning_agreement']:.1f} %",
        f"{100 * s['overturning_agreement_of_housner_changed']:.1f} %",
        f"{s['ks_distance']:.3f}",
        f"{s['ks_distance_of_housner_changed']:.3f}",
    ]


def table(head, rows):
    lines = ["| " + " | ".join(x.strip() for x in head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(row) + " |" for row in rows]) + "\n"


def write(tune):
    el_centro, suite, chaos, cap = [], [], [], []
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        for structure in STRUCTURES:
            cells = []
            for scale in SCALES:
                p, file = parameters(tune, folder, structure, "--scale", scale)
                cells.append(on_el_centro(p))
                if scale == SCALES[0]:
                    found = suites(
                        tune, folder, file, "--synthetic", SYNTHETIC, "--seed", SEED, "--earthquakes", EARTHQUAKES
                    )
                    hz = p["vertical"]["omega_n_hz"]
            el_centro.append([structure[0], *cells])
            s, e = found["synthetic"], found["earthquakes"]["nrmse_geometric_mean"]
            n = s["nrmse_well_conditioned"]
            suite.append(
                [
                    structure[0],
                    f"{hz / 1e3:.1f}",
                    short(n["median"]),
                    short(n["p90"]),
                    str(n["count"]),
                    *peaks(s),
                    short(e["mean"]),
                    str(e["count"]),
                ]
            )
            print(*el_centro[-1], *suite[-1][1:], sep=" | ", file=sys.stderr)
        for structure in SLENDER:
            p, file = parameters(tune, folder, structure)
            s = suites(tune, folder, file, "--synthetic", MANY, "--seed", OWN_SEED)["synthetic"]
            chaos.append([structure[0], f"{p['vertical']['omega_n_hz'] / 1e3:.1f}", *peaks(s)])
            print(*chaos[-1], sep=" | ", file=sys.stderr)
        for structure in CAPPED:
            _, file = parameters(tune, folder, structure, "--max-hz", 160)
            s = suites(tune, folder, file, "--synthetic", SYNTHETIC, "--seed", 1)["synthetic"]
            n = s["nrmse_well_conditioned"]
            cap.append(
                [
                    structure[0],
                    short(n["median"]),
                    short(n["p90"]),
                    f"{100 * s['overturning_agreement']:.1f} %",
                    f"{s['ks_distance']:.3f}",
                ]
            )
            print(*cap[-1], sep=" | ", file=sys.stderr)
    PAGE.write_text(f"""{INTRO}
## El Centro

20 s of El Centro, `tune run CASE --scale S`, all defaults: NRMSE of u / of v where Housner's answer \
is well conditioned.

{table(EL_CENTRO, el_centro)}
## Motions that no spring was chosen on

The springs of scale 1, `tune validate --synthetic {SYNTHETIC} --seed {SEED} --earthquakes {EARTHQUAKES}`: \
NRMSE of u over the well-conditioned ones; agreement
and the Kolmogorov-Smirnov distance (KS) of the peak rotations over all. Beside them those of Housner's answers \
and his own with e changed by
1e-5, than which no model can do better but by chance.

{table(SUITE, suite)}
## Small slender blocks

Of alpha 0.05: the smaller, the more of these motions make them tremble before they rock, and the more are chaotic. \
Many motions show how near
their springs are to what Housner's answers themselves allow: `tune validate --synthetic {MANY} --seed {OWN_SEED}`.

{table(CHAOS, chaos)}
## Springs of at most 160 Hz

For programs with fixed time steps: `tune run CASE --max-hz 160`, then `tune validate --synthetic {SYNTHETIC} --seed 1`.

{table(CAP, cap)}""")


def check():
    text = PAGE.read_text()
    for head, structures in ((EL_CENTRO, STRUCTURES), (SUITE, STRUCTURES), (CHAOS, SLENDER), (CAP, CAPPED)):
        rows = [f"| {structure[0]} | " for structure in structures]
        wanted = re.escape(table(head, [])) + "".join(re.escape(row) + ".*\n" for row in rows)
        if not re.search(wanted, text):
            sys.exit(f"{PAGE}: no table with the columns {head} and its rows; write it anew with tables.py TUNE")
    print(f"{PAGE.name}: all tables are there")


if __name__ == "__main__":
    check() if sys.argv[1:] == ["--check"] else write(sys.argv[1])
