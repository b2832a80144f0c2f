#!/usr/bin/env python3
"""The table of piers and frames in docs/elastic.md: `tune run` on El Centro, 20 s, at the default accuracy.

    elastic_tables.py TUNE            runs everything (some minutes) and writes the table anew
    elastic_tables.py --check         whether the page has the rows that this program writes
"""

import csv, json, math, pathlib, subprocess, sys, tempfile

PAGE = pathlib.Path(__file__).resolve().parent.parent / "docs" / "elastic.md"
HEAD = (
    "| structure | Omega_n/2 pi [Hz] | releases: rotation, drift | motions: rotation, drift "
    "| El Centro: rotation, drift | over [s] | over 20 s: rotation, drift | touches a landing |"
)
PIER = dict(kind="pier", height_m=12, width_m=4, footing_height_m=1.5, damping_ratio=0.02)
FRAME = dict(kind="frame", damping_ratio=0.03)
STRUCTURES = {
    f"pier of 12 m, 600 t on {footing // 1000} t, {hz} Hz": PIER
    | dict(mass_kg=600e3, footing_mass_kg=footing, frequency_hz=hz)
    for hz in (1.5, 2.0)
    for footing in (60_000, 200_000)
} | {
    "pier of 18 m, 350 t on 90 t, 1.1 Hz": PIER
    | dict(height_m=18, width_m=5.2, footing_height_m=1.8, mass_kg=350e3, footing_mass_kg=90e3, frequency_hz=1.1),
    "pier of 9 m, 900 t on 250 t, 3.2 Hz": PIER
    | dict(height_m=9, width_m=4.6, footing_height_m=2, mass_kg=900e3, footing_mass_kg=250e3, frequency_hz=3.2),
    "pier of 15 m, 120 t on 40 t, 1.4 Hz, column of 30 t in four elements": PIER
    | dict(height_m=15, width_m=3.4, footing_height_m=1.2, mass_kg=120e3, footing_mass_kg=40e3, frequency_hz=1.4)
    | dict(column_mass_kg=30e3, elements=4),
    "pier of 28 m, 2400 t on 700 t, 0.9 Hz": PIER
    | dict(height_m=28, width_m=8.5, footing_height_m=3, mass_kg=2.4e6, footing_mass_kg=700e3, frequency_hz=0.9),
    "frame of 7.5 x 11 m, 420 t": FRAME
    | dict(height_m=7.5, span_m=11, footing_width_m=2.4, footing_height_m=0.9, footing_mass_kg=30e3, beam_mass_kg=420e3)
    | dict(column_ea_n=1.8e10, column_ei_nm2=1.5e9, beam_ea_n=3e10, beam_ei_nm2=6e9),
    "frame of 14 x 9 m, 260 t": FRAME
    | dict(height_m=14, span_m=9, footing_width_m=3, footing_height_m=1.2, footing_mass_kg=55e3, beam_mass_kg=260e3)
    | dict(column_ea_n=2.2e10, column_ei_nm2=2.6e9, beam_ea_n=2.5e10, beam_ei_nm2=5e9),
}


def pair(errors):
    return "-" if errors is None else ", ".join(f"{x:.1g}" for x in errors)


def over_all(path):
    """NRMSE of rotations and drifts over the whole record."""
    rows = list(csv.DictReader(path.open()))
    out = []
    for what in ("theta", "drift"):
        names = [name for name in rows[0] if name.startswith(f"{what}_reference")]
        both = [
            (float(r[n]), float(r[n.replace("reference", "fem")]))
            for n in names
            for r in rows
            if r[n] and r[n.replace("reference", "fem")]
        ]
        out.append(math.sqrt(sum((a - b) ** 2 for a, b in both) / sum(a * a for a, _ in both)))
    return out


def row(tune, name, structure):
    with tempfile.TemporaryDirectory() as folder:
        case = pathlib.Path(folder) / "case.toml"
        keys = "\n".join(f"{key} = {json.dumps(value)}" for key, value in structure.items())
        case.write_text(f"[structure]\n{keys}\n\n[record]\nduration_s = 20.0\n")
        options = ["--quiet", "--no-figures", "--no-report"]
        subprocess.run([tune, "run", case, "--out", folder, *options], check=True, capture_output=True)
        run = json.loads((pathlib.Path(folder) / "parameters.json").read_text())
        whole = over_all(pathlib.Path(folder) / "history.csv")
    assessment, on = run["assessment"], run["on_record"]
    median = [(assessment["measured"][suite] or {}).get("median") for suite in ("releases", "motions")]
    touches = [m["touches"] for m in (assessment["measured"][s] for s in ("releases", "motions", "record")) if m]
    missed = "" if assessment["reached"] else " (not reached)"
    errors = [pair(e) for e in (*median, (on["nrmse_rotation"], on["nrmse_drift"]))]
    cells = [name + missed, f"{run['omega_n_hz']:.0f}", *errors, f"{on['compared_s']:.1f}", pair(whole)]
    return "| " + " | ".join([*cells, ", ".join(f"{x:.1f}" for x in touches)]) + " |"


def main():
    text = PAGE.read_text()
    if sys.argv[1:] == ["--check"]:
        missing = [name for name in (HEAD, *STRUCTURES) if name not in text]
        sys.exit(
            "\n".join(f"{PAGE.name}: {name} is missing: run .ci/elastic_tables.py TUNE" for name in missing) or None
        )
    rows = []
    for name, structure in STRUCTURES.items():
        rows.append(row(sys.argv[1], name, structure))
        print(rows[-1], flush=True)
    start = text.index(HEAD)
    end = text.index("\n\n", start)
    PAGE.write_text(text[:start] + "\n".join([HEAD, "|" + "---|" * HEAD.count(" | ") + "---|", *rows]) + text[end:])


main()
