#!/usr/bin/env python3
"""`tune housner` against the float128 program ../shared/reference/housner_quad.cpp: the paper's A-frame, 20 s of El
Centro. The largest difference of theta must be below 1e-12 rad, and the impacts the same in number.

    float128.py TUNE HOUSNER_QUAD RECORD
"""

import csv, io, subprocess, sys, tempfile

tune, quad, record = sys.argv[1:]
# a point mass, as there: `tune` gives one a little inertia unless told
STRUCTURE = "[structure]\nkind='aframe'\nheight_m=61.0\nwidth_m=12.2\nmass_kg=680.1e3\nrotational_inertia_kgm2=0.0\n"
with tempfile.NamedTemporaryFile("w", suffix=".toml") as case:
    case.write(STRUCTURE)
    case.flush()
    command = [tune, "housner", case.name, "--record", record, "--duration", "20"]
    ours = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    count = subprocess.run([*command, "--impacts"], check=True, capture_output=True, text=True)
ours = [float(row["th"]) for row in csv.DictReader(io.StringIO(ours))]
count = len(count.stdout.splitlines()) - 1
with tempfile.NamedTemporaryFile("w", suffix=".txt") as f:
    f.write("\n".join(w for line in open(record).read().splitlines()[4:] for w in line.split()))
    f.flush()
    lines = subprocess.run([quad, "6.1", "61", "1", f.name, "0.01", "20"], check=True, capture_output=True, text=True)
lines = lines.stdout.splitlines()
theirs = [float(line.split()[1]) for line in lines if not line.startswith("#")]
impacts = sum(line.startswith("# impact") for line in lines)
assert len(ours) == len(theirs), (len(ours), len(theirs))
worst = max(abs(a - b) for a, b in zip(ours, theirs))
ok = worst < 1e-12 and count == impacts
print(
    f"Housner against float128: largest difference of theta {worst:.1e} rad, impacts {count} and {impacts}: "
    f"{'ok' if ok else 'FAILED'}"
)
sys.exit(not ok)
