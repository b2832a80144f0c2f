#!/usr/bin/env python3
"""Random piers, A-frames and portals as engineers build them: `tune run` of each ends, and what \
share reaches its accuracy.

    random_elastic.py TUNE [COUNT] [--seed SEED] [--timeout SECONDS] [--keep FOLDER] [-- OPTIONS of tune run]

Drawn are height, slenderness, mass, and stiffness by what practice allows: axial stress under the weight (concrete 1 to
8 MPa, steel 20 to 90 MPa), frequency fixed to the ground (0.8 to 5 Hz), drift under the acceleration that lifts the
structure (at most 1 % of the height). A draw that is not within all of them is drawn again. The record is El Centro,
scaled to 1.2 to 3 times the acceleration that lifts. A case that is refused says why; one that does not end within the
timeout (generous: four times what a job is sized for) fails the check.
"""

import argparse, json, math, pathlib, random, subprocess, sys, tempfile, time

G = 9.81
EL_CENTRO_G = 0.3129
MOST_DRIFT = 0.01
FREQUENCY_HZ = (0.8, 5.0)
CONCRETE = (30e9, (1e6, 8e6))  # modulus [N/m2], axial stress under the weight [N/m2]
STEEL = (210e9, (20e6, 90e6))


def between(rng, low, high):
    return math.exp(rng.uniform(math.log(low), math.log(high)))


def section(rng, load, length):
    """EA and EI of a member that bears a load: by its stress,
    and a slenderness length/radius of gyration of 20 to 90."""
    modulus, stress = rng.choice([CONCRETE, STEEL])
    area = load / between(rng, *stress)
    gyration = length / between(rng, 20, 90)
    return modulus * area, modulus * area * gyration**2


def within(frequency_hz, lift_g, height):
    """Whether frequency and drift are those of practice: a static drift of lift g/(2 pi f)^2."""
    drift = lift_g * G / (2 * math.pi * frequency_hz) ** 2
    return FREQUENCY_HZ[0] <= frequency_hz <= FREQUENCY_HZ[1] and drift <= MOST_DRIFT * height


def pier(rng):
    height = between(rng, 5, 40)
    width = height * rng.uniform(0.2, 0.5)
    mass = between(rng, 50e3, 3000e3)
    footing = mass * rng.uniform(0.05, 0.4)
    thick = min(0.2 * height, rng.uniform(0.8, 3.0))
    length = height - thick
    ea, ei = section(rng, mass * G, length)
    frequency = math.sqrt(3 * ei / length**3 / mass) / (2 * math.pi)
    centre = (mass * height + footing * thick / 2) / (mass + footing)
    lift = width / 2 / centre
    keys = dict(
        kind="pier",
        height_m=height,
        width_m=width,
        mass_kg=mass,
        footing_mass_kg=footing,
        footing_height_m=thick,
        ei_nm2=ei,
        ea_n=ea,
    )
    if rng.random() < 0.3:
        keys["column_mass_kg"] = mass * rng.uniform(0.02, 0.2)
    return keys, lift, within(frequency, lift, height)


def aframe(rng):
    height = between(rng, 6, 70)
    width = height * rng.uniform(0.15, 0.5)
    mass = between(rng, 20e3, 2000e3)
    leg = math.hypot(height, width / 2)
    ea, ei = section(rng, mass * G, leg)
    # a foot that slides: both legs bend and lengthen; fixed to the ground the axial stiffness of the legs carries
    sine = width / 2 / leg
    frequency = math.sqrt((2 * ea / leg * sine**2 + 6 * ei / leg**3) / mass) / (2 * math.pi)
    lift = width / 2 / height
    keys = dict(
        kind="aframe",
        height_m=height,
        width_m=width,
        mass_kg=mass,
        ea_n=ea,
        ei_nm2=ei,
        foot_mass_kg=mass * rng.uniform(0.005, 0.08),
    )
    return keys, lift, within(frequency, lift, height)


def portal(rng):
    height = between(rng, 4, 20)
    span = height * rng.uniform(0.6, 2.0)
    beam = between(rng, 30e3, 1000e3)
    foot = height * rng.uniform(0.15, 0.4)
    thick = rng.uniform(0.08, 0.2) * height
    footing = beam * rng.uniform(0.05, 0.3)
    length = height - thick
    ea, ei = section(rng, beam * G / 2, length)
    frequency = math.sqrt(2 * 12 * ei / length**3 / beam) / (2 * math.pi)
    # columns rock side by side: the whole leans by half a footing over its height
    lift = foot / height
    keys = dict(
        kind="frame",
        height_m=height,
        span_m=span,
        footing_width_m=foot,
        footing_height_m=thick,
        footing_mass_kg=footing,
        beam_mass_kg=beam,
        column_ea_n=ea,
        column_ei_nm2=ei,
        beam_ea_n=ea * rng.uniform(0.8, 3),
        beam_ei_nm2=ei * rng.uniform(0.8, 4),
    )
    if rng.random() < 0.2:
        keys["column_mass_kg"] = beam * rng.uniform(0.01, 0.1)
    return keys, lift, foot < 0.8 * span and within(frequency, lift, height)


def drawn(rng, draw):
    while True:
        keys, lift, good = draw(rng)
        if good:
            keys["damping_ratio"] = rng.uniform(0.01, 0.05)
            return keys, rng.uniform(1.2, 3.0) * lift / EL_CENTRO_G


def toml(keys):
    lines = [f'{key} = "{value}"' if isinstance(value, str) else f"{key} = {value:.6g}" for key, value in keys.items()]
    return "\n".join(["[structure]", *lines, "", "[record]", "duration_s = 20.0", ""])


def quantile(values, q):
    values = sorted(values)
    return values[min(len(values) - 1, int(q * len(values)))] if values else float("nan")


parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
parser.add_argument("tune")
parser.add_argument("count", type=int, nargs="?", default=200)
parser.add_argument("--seed", type=int, default=1)
parser.add_argument("--timeout", type=float, default=480.0)
parser.add_argument("--keep", type=pathlib.Path)
own, options = (
    (sys.argv[1:] + ["--"])[: (sys.argv[1:] + ["--"]).index("--")],
    sys.argv[1:][(sys.argv[1:] + ["--"]).index("--") + 1 :],
)
arguments = parser.parse_args(own)
tune = pathlib.Path(arguments.tune).resolve()
kinds = {"pier": pier, "aframe": aframe, "frame": portal}
results = []
with tempfile.TemporaryDirectory() as temporary:
    folder = arguments.keep or pathlib.Path(temporary)
    folder.mkdir(parents=True, exist_ok=True)
    for i in range(arguments.count):
        rng = random.Random(f"{arguments.seed}/{i}")
        kind = list(kinds)[i % len(kinds)]
        keys, scale = drawn(rng, kinds[kind])
        case, out = folder / f"{i}.toml", folder / f"{i}"
        case.write_text(toml(keys))
        command = [
            tune,
            "run",
            case,
            "--scale",
            f"{scale:.4f}",
            "--quiet",
            "--no-figures",
            "--no-report",
            "--out",
            out,
            *options,
        ]
        begun = time.monotonic()
        try:
            ran = subprocess.run(command, capture_output=True, text=True, timeout=arguments.timeout)
            seconds, code = time.monotonic() - begun, ran.returncode
        except subprocess.TimeoutExpired:
            seconds, code = arguments.timeout, None
        row = dict(
            i=i,
            kind=kind,
            seconds=seconds,
            end="not ended" if code is None else "refused" if code else "ended",
            said="",
        )
        if code == 0:
            filed = json.loads((out / "parameters.json").read_text())
            row["reached"] = filed["assessment"]["reached"]
            row["found"] = [f["finding"] for f in filed.get("findings", [])]
        elif code is not None:
            row["said"] = ran.stderr.strip().splitlines()[-1] if ran.stderr.strip() else f"exit code {code}"
        results.append(row)
        print(
            f"{i:4} {kind:7} {seconds:7.1f} s  {row['end']}  {row.get('reached', '')}  {row['said']}", file=sys.stderr
        )
print(
    f"{'kind':8}{'runs':>6}{'ended':>7}{'refused':>9}{'reached':>9}{'cut':>6}{'median s':>10}{'90 % s':>9}{'most s':>9}"
)
for kind in [*kinds, "all"]:
    rows = [row for row in results if kind in ("all", row["kind"])]
    ended = [row for row in rows if row["end"] == "ended"]
    refused = sum(row["end"] == "refused" for row in rows)
    reached = sum(row["reached"] for row in ended)
    cut = sum("search_cut" in row["found"] or "histories_unfinished" in row["found"] for row in ended)
    seconds = [row["seconds"] for row in ended]
    share = f"{100 * reached / len(ended):.0f} %" if ended else "-"
    times = "".join(f"{quantile(seconds, q):{width}.1f}" for q, width in ((0.5, 10), (0.9, 9), (1.0, 9)))
    print(f"{kind:8}{len(rows):6}{len(ended):7}{refused:9}{share:>9}{cut:6}{times}")
missing = [row["i"] for row in results if row["end"] == "not ended"]
if missing:
    sys.exit(f"not ended within {arguments.timeout:g} s: {missing}")
