#!/usr/bin/env python3
"""Design forces of six piers and a portal with 4, 8 and 16 elements (twice 8), on the springs of a run, on
softer and on stiffer ones, as a Markdown table.

    python3 .ci/forces.py target/release/tune [--only NAME,...] [--elements 4,8]

No number in the program was chosen with these structures.
"""
import argparse
import json
import pathlib
import subprocess
import sys
import tempfile
import time

ROOT = pathlib.Path(__file__).resolve().parent.parent
TE_MARA = ROOT / "tests/records/20161113_110259_WTMC_20.V2A"
EL_CENTRO = ROOT / "tuning/records/IELC180.AT2"
FORCES = {"column_shear_n": ("column shear", "MN"), "column_base_moment_nm": ("moment at column base", "MN m"),
          "axial_n": ("axial force", "MN")}

PIER = dict(kind="pier")
CASES = {
    "pier 14 m": (dict(PIER, height_m=14.0, width_m=3.2, mass_kg=450e3, footing_mass_kg=90e3, footing_height_m=1.5,
                       ei_nm2=7.65e9, damping_ratio=0.05, column_mass_kg=79e3), TE_MARA, 1.0, 60.0),
    "pier 28 m": (dict(PIER, height_m=28.0, width_m=8.0, mass_kg=2400e3, footing_mass_kg=700e3, footing_height_m=2.5,
                       frequency_hz=0.9, damping_ratio=0.02, column_mass_kg=500e3), EL_CENTRO, 1.0, 12.0),
    "pier 9 m": (dict(PIER, height_m=9.0, width_m=3.5, mass_kg=900e3, footing_mass_kg=250e3, footing_height_m=1.5,
                      frequency_hz=3.2, damping_ratio=0.05, column_mass_kg=80e3), EL_CENTRO, 1.5, 12.0),
    "pier 15 m": (dict(PIER, height_m=15.0, width_m=3.4, mass_kg=120e3, footing_mass_kg=15e3, footing_height_m=1.2,
                       frequency_hz=1.4, damping_ratio=0.02, column_mass_kg=30e3), EL_CENTRO, 1.0, 12.0),
    "pier 40 m": (dict(PIER, height_m=40.0, width_m=11.0, mass_kg=1500e3, footing_mass_kg=1200e3,
                       footing_height_m=3.5, frequency_hz=0.7, damping_ratio=0.03, column_mass_kg=800e3),
                  EL_CENTRO, 1.5, 12.0),
    "pier 6 m": (dict(PIER, height_m=6.0, width_m=2.2, mass_kg=300e3, footing_mass_kg=60e3, footing_height_m=1.0,
                      frequency_hz=2.6, damping_ratio=0.05, column_mass_kg=25e3), EL_CENTRO, 1.5, 12.0),
    "portal 8 m": (dict(kind="frame", height_m=8.0, span_m=10.0, footing_width_m=2.5, footing_height_m=1.0,
                        footing_mass_kg=30e3, beam_mass_kg=200e3, column_ea_n=3e10, column_ei_nm2=4e9,
                        beam_ea_n=4e10, beam_ei_nm2=8e9, damping_ratio=0.02, column_mass_kg=20e3),
                   EL_CENTRO, 1.0, 12.0),
}


def run(tune, structure, record, scale, seconds, folder):
    case = folder / "case.toml"
    lines = [f'{key} = {json.dumps(value)}' for key, value in structure.items()]
    case.write_text("\n".join(["[structure]", *lines, "[record]", f'file = "{record}"', f"scale = {scale}",
                               f"duration_s = {seconds}", ""]))
    begin = time.time()
    done = subprocess.run([tune, "run", "--quiet", "--no-figures", "--out", str(folder / "out"), str(case)],
                          capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"{structure}: {done.stderr}")
    return json.loads((folder / "out/parameters.json").read_text()), time.time() - begin


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("tune")
    parser.add_argument("--only", help="names of structures, with commas between")
    parser.add_argument("--elements", default="4,8")
    args = parser.parse_args()
    print("| structure | elements | Omega_n/2 pi [Hz] | force below | force | given | found | elements doubled "
          "| Omega_n/4 | 4 Omega_n | change |")
    print("|---|--:|--:|--:|---|--:|--:|--:|--:|--:|--:|", flush=True)
    withheld = missing = 0
    for name, (structure, record, scale, seconds) in CASES.items():
        if args.only and name not in args.only.split(","):
            continue
        for elements in map(int, args.elements.split(",")):
            with tempfile.TemporaryDirectory() as folder:
                said, took = run(args.tune, dict(structure, elements=elements), record, scale, seconds,
                                 pathlib.Path(folder))
            print(f"{name}, {elements} elements: {took:.0f} s", file=sys.stderr, flush=True)
            forces = said["design_forces"]
            for key, (words, unit) in FORCES.items():
                force = forces.get(key)
                if force is None:
                    missing += 1
                    continue
                withheld += not force["holds"]
                others = force["others"]
                cell = lambda x: "-" if x is None else f"{x / 1e6:.4g}"
                given = "withheld" if force["value"] is None else f"{cell(force['value'])} {unit}"
                print(f"| {name} | {elements} | {said['omega_n_hz']:.4g} | {forces['below_hz']:.3g} Hz | {words} "
                      f"| {given} | {cell(others['found'])} | {cell(others.get('doubled_elements'))} "
                      f"| {cell(others['softer'])} | {cell(others['stiffer'])} | {1e2 * force['change']:.2g} % |",
                      flush=True)
    raise SystemExit(f"{withheld} withheld, {missing} missing" if withheld or missing else 0)


if __name__ == "__main__":
    main()
