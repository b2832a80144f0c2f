#!/usr/bin/env python3
"""No Rust file above 400 lines, no function above 80 (from its signature to its closing brace, as rustfmt lays it out).

    sizes.py
"""

import pathlib, re, subprocess, sys

FILE, FUNCTION = 400, 80
ROOT = pathlib.Path(__file__).resolve().parent.parent
SIGNATURE = re.compile(r"^( *)(?:pub(?:\([^)]*\))? )?(?:const )?(?:async )?fn (\w+)")

files, functions = [], []
for name in subprocess.run(
    ["git", "ls-files", "*.rs"], cwd=ROOT, check=True, capture_output=True, text=True
).stdout.split():
    lines = (ROOT / name).read_text().splitlines()
    files.append((len(lines), name))
    for i, line in enumerate(lines):
        if m := SIGNATURE.match(line):
            # the end is the first line that closes at the signature's own indentation;
            # a trait's function may have no body
            ends = (
                j
                for j in range(i, len(lines))
                if lines[j].startswith(m[1] + "}") or (j == i and lines[j].endswith((";", "}")))
            )
            functions.append((next(ends, i) - i + 1, f"{name}: {m[2]}"))

too_long = [f"{n} lines: {what}" for n, what in files if n > FILE] + [
    f"{n} lines: {what}" for n, what in functions if n > FUNCTION
]
if too_long:
    sys.exit("\n".join(too_long))
print("largest file: {} lines, {}; longest function: {} lines, {}".format(*max(files), *max(functions)))
