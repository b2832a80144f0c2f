#!/usr/bin/env python3
"""The histories in crates/frames/tests/elastic/data are those of an independent program,
../shared/reference/flexible_pier.py: run it again with the same arguments and compare, or write the files. Without it
there is nothing to do. El Centro is tuning/records/IELC180.AT2.

    elastic.py [--write] [NAME...]
"""
import pathlib, subprocess, sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PROGRAM = ROOT.parent / "shared/reference/flexible_pier.py"
DATA = ROOT / "crates/frames/tests/elastic/data"
EVERY = 5  # samples between rows
FREE = "--th0 0.0975 --end 5"
QUAKE = f"--record {ROOT}/tuning/records/IELC180.AT2 --end 8"
CASES = {
    "free_axial": f"{FREE} --ka 4e9",
    "free_chord": f"{FREE} --ka 4e9 --chord 12",
    "free_bilateral": f"{FREE} --bilateral",
    "el_centro": QUAKE,
    "el_centro_axial": f"{QUAKE} --ka 4e9",
    "el_centro_chord": f"{QUAKE} --ka 4e9 --chord 12",
    "el_centro_bilateral": f"{QUAKE} --bilateral",
    "el_centro_soft": f"{QUAKE} --f 1.5 --mb 6e4",
}


def rows(text):
    return [line.split(",")[:3] for line in text.split()[1:]]


def computed(name):
    run = subprocess.run([sys.executable, PROGRAM, *CASES[name].split()], capture_output=True, text=True, check=True)
    return rows(run.stdout)[::EVERY]


def worst(found, kept):
    """Largest difference of theta and u over the peaks."""
    if len(found) != len(kept):
        return float("inf")
    both = [[[float(row[k]) for row in rows] for rows in (found, kept)] for k in (1, 2)]
    return max(max(abs(a - b) for a, b in zip(x, y)) / max(map(abs, y)) for x, y in both)


write = "--write" in sys.argv
names = [name for name in sys.argv[1:] if name != "--write"] or CASES
if not PROGRAM.exists():
    print(f"{PROGRAM.name} is not there: the histories stay as they are")
    sys.exit()
for name in names:
    path, found = DATA / f"{name}.csv", computed(name)
    if write:
        DATA.mkdir(exist_ok=True)
        path.write_text("\n".join(map(",".join, [("t", "theta", "u"), *found])) + "\n")
    else:
        error = worst(found, rows(path.read_text()))
        print(f"{name}: {error:.1e} of the peak")
        if error > 1e-7:
            sys.exit(f"{path} is not what {PROGRAM.name} {CASES[name]} prints")
