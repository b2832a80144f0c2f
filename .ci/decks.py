#!/usr/bin/env python3
"""Exported decks in OpenSees: steps, seconds, errors. Nine structures, 20 s of El Centro at three scales.

    decks.py TUNE [--hz HZ | --max-hz HZ] [--steps N,N...] [--accuracy A] [--tcl] [--only NAME,...] [--scales S,...]

TUNE is the program. Springs: those of `tune run` (--max-hz: capped), or with --hz the family of theory (one vertical
chain scaled by the effective mass, stiff horizontals) at that Omega_n. --steps: other numbers of steps a sample at
least (default: the deck's own). A row is one run: analyze steps, seconds of the whole process, NRMSE of u of OpenSees
against `tune simulate` and Housner, of `tune simulate` against Housner, all up to the first overturning, how Housner's
history moves with its width (* where it is ill-conditioned: then no error is judged), and when u first differs from
ours by 1 % of its peak. Runs with the Python that starts it, which needs openseespy (and opensees, for --tcl). Exit
code 1 if a deck stops, or a well-conditioned history is off: with the deck's own steps by more than 0.001 from ours or
(springs of `tune run`) 0.003 from Housner's, with other steps by more than 0.01 from ours.
"""

import argparse, csv, json, math, os, pathlib, re, statistics, subprocess, sys, tempfile, time
from concurrent import futures

#         kind, height of the centre of mass, width [m], mass [kg]
BODIES = {
    "A-frame 61 m": ("aframe", 61.0, 12.2, 680.1e3),
    "A-frame 35 m": ("aframe", 35.0, 7.7, 400e3),
    "A-frame 20 m": ("aframe", 20.0, 4.0, 350e3),
    "A-frame 12 m": ("aframe", 12.0, 2.4, 350e3),
    "A-frame 5 m": ("aframe", 5.0, 1.5, 1e3),
    "block 1.3 m": ("block", 1.3, 0.7, 2e3),
    "block 1 m": ("block", 1.0, 0.5, 1e3),
    "block 0.3 m": ("block", 0.3, 0.2, 100.0),
    "block 0.15 m": ("block", 0.15, 0.1, 10.0),
}


def family(body, hz):
    """Springs of theory at Omega_n: vertically K by stance, C and mu scaled by the effective mass;
    horizontally 8 times stiffer."""
    kind, h, width, m = body
    b = width / 2.0
    r2, alpha = h * h + b * b, math.atan2(b, h)
    inertia = m * r2 / 3.0 if kind == "block" else 1e-5 * m * r2
    i0 = m * r2 + inertia
    p = math.sqrt(m * 9.81 * math.sqrt(r2) / i0)
    effective = 1.0 - m * r2 / i0 * math.sin(alpha) ** 2

    def chain(hz, k, c, mu):
        omega = 2.0 * math.pi * hz
        k1 = m * omega**2
        return {
            "mu": mu,
            "f": math.sqrt(k / mu),
            "xi": c / (2.0 * mu),
            "omega_n_hz": hz,
            "k1_n_per_m": k1,
            "k2_n_per_m": k * k1,
            "m2_kg": mu * m,
            "c_ns_per_m": c * m * omega,
        }

    k = min(0.3, 0.5 * (2.0 * math.pi * hz / p) ** -0.55 * alpha**-1.5)
    return {
        "structure": {"kind": kind, "height_m": h, "width_m": width, "mass_kg": m, "rotational_inertia_kgm2": inertia},
        "vertical": chain(hz, k, 0.6 * math.sqrt(effective), 0.66 * effective),
        "horizontal": chain(8.0 * hz, 1.0, 2.0, 0.3),
    }


def tuned(tune, body, folder, options):
    kind, h, width, m = body
    case = folder / "case.toml"
    case.write_text(f'[structure]\nkind = "{kind}"\nheight_m = {h}\nwidth_m = {width}\nmass_kg = {m}\n')
    subprocess.run(
        [tune, "run", case, "--no-figures", "--no-front", "--quiet", *options, "--out", folder / "run"],
        check=True,
        capture_output=True,
    )
    return json.loads((folder / "run/parameters.json").read_text())


def nrmse(x, reference):
    below = sum(b * b for b in reference)
    return math.sqrt(sum((a - b) ** 2 for a, b in zip(x, reference)) / below) if below > 0.0 else math.nan


def columns(path, *names):
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    return [[float(row[name]) for row in rows] for name in names]


def one(tune, parameters, scale, steps, options, folder):
    """Steps, seconds, errors, conditioning; the deck's complaint in their place."""
    ours, deck = folder / "ours.csv", folder / ("deck.tcl" if options.tcl else "deck.py")
    common = ["--parameters", parameters, "--scale", str(scale), "--duration", "20"]
    simulated = subprocess.run([tune, "simulate", *common, "--out", ours], check=True, capture_output=True, text=True)
    told = simulated.stderr
    export = ["--accuracy", str(options.accuracy)] if options.accuracy else []
    subprocess.run(
        [tune, "export", *common, *export, "--format", "opensees-tcl" if options.tcl else "openseespy", "--out", deck],
        check=True,
        capture_output=True,
    )
    if steps:
        text = deck.read_text()
        text = re.sub(r"^(STEPS_PER_SAMPLE = |set stepsPerSample )\d+", rf"\g<1>{steps}", text, flags=re.M)
        deck.write_text(text)
    began = time.perf_counter()
    run = subprocess.run(
        [sys.executable, *(["-m", "opensees"] if options.tcl else []), deck], capture_output=True, text=True
    )
    seconds = time.perf_counter() - began
    ill = "ILL-CONDITIONED" in told
    moved = re.search(r"width changes Housner's history by (\S+) %", told)
    moved = float(moved[1]) if moved else 0.0
    taken = re.search(r"(\d+) steps, the shortest \S+ s, (\d+) pairs", run.stdout)
    if not taken:
        return None, run.stderr.strip().splitlines()[-2:], moved, ill
    fem, housner = columns(ours, "u_fem", "u_housner")
    (u,) = columns(folder / "deck_history.csv", "u")
    # up to the first overturning: how a body falls is not rocking
    samples = round(json.loads(simulated.stdout)["duration_s"] / 0.01) + 1
    fem, housner, u = fem[:samples], housner[:samples], u[:samples]
    late = re.search(r"WARNING: (\d+) touches", run.stdout)
    far = 0.01 * max(map(abs, fem))
    parted = next((f"{0.01 * i:.2f} s" for i, (a, b) in enumerate(zip(u, fem)) if abs(a - b) > far), "never")
    return (
        (
            int(taken[1]),
            int(taken[2]),
            int(late[1]) if late else 0,
            seconds,
            nrmse(u, fem[: len(u)]),
            nrmse(u, housner[: len(u)]),
            nrmse(fem, housner[: len(fem)]),
            parted,
        ),
        max(map(abs, housner)),
        moved,
        ill,
    )


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("tune")
    parser.add_argument("--hz", type=float)
    parser.add_argument("--max-hz")
    parser.add_argument("--steps", default="0")
    parser.add_argument("--accuracy", type=float)
    parser.add_argument("--tcl", action="store_true")
    parser.add_argument("--only", default=",".join(BODIES))
    parser.add_argument("--scales", default="1,1.5,2.5")
    options = parser.parse_args()
    print(
        "| structure | scale | width, 1 % | steps a sample | steps | repeated | late | s | ours | Housner "
        "| ours, Housner | parts from ours |"
    )
    print("|---|---|---|---|---|---|---|---|---|---|---|---|")
    wrong, taken, times, every = 0, [], [], []
    with tempfile.TemporaryDirectory() as folder, futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        rows = []
        for name in options.only.split(","):
            # no blank in a path: the Tcl interpreter that pip installs takes one for two words
            parameters = pathlib.Path(folder) / str(len(rows)) / "parameters.json"
            parameters.parent.mkdir()
            cap = ["--max-hz", options.max_hz] if options.max_hz else []
            springs = (
                family(BODIES[name], options.hz)
                if options.hz
                else tuned(options.tune, BODIES[name], parameters.parent, cap)
            )
            parameters.write_text(json.dumps(springs))
            for scale in map(float, options.scales.split(",")):
                for steps in map(int, options.steps.split(",")):
                    own = parameters.parent / f"{scale}-{steps}"
                    own.mkdir()
                    rows.append(
                        (name, scale, steps, pool.submit(one, options.tune, parameters, scale, steps, options, own))
                    )
        for name, scale, steps, row in rows:
            found, peak, moved, ill = row.result()
            start = f"| {name} | {scale:g} | {moved:.3g} %{' *' if ill else ''} | {steps or 'own'} |"
            if found is None:
                print(start, "stopped:", *peak, "|", flush=True)
                wrong += 1
                continue
            n, repeated, late, seconds, ours, housner, between, parted = found
            rocks = peak > 0.0
            bad = (
                rocks
                and not ill
                and (
                    ours > (0.01 if steps else 0.001)
                    or not (steps or options.hz or options.max_hz)
                    and housner > 0.003
                )
            )
            wrong += bad
            if not steps:
                every.append(n)
            if rocks and not steps:
                taken.append(n)
                times.append(seconds)
            print(
                start,
                f"{n} | {repeated} | {late} | {seconds:.1f} | {ours:.1e} | {housner:.1e} "
                f"| {between:.1e} | {parted} |" + (" WRONG" if bad else ""),
                flush=True,
            )
    if taken:
        print(
            f"\nown steps, median of all: {statistics.median(every):g}; where it rocks: {statistics.median(taken):g} "
            f"in {statistics.median(times):.1f} s"
        )
    print(f"wrong: {wrong}")
    sys.exit(wrong > 0)


main()
