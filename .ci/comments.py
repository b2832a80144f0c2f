#!/usr/bin/env python3
"""No line of a comment is longer than 100 letters, tables and drawings apart (lines that begin with a bar or two spaces, or stand
between fences).

    comments.py
"""
import pathlib, re, subprocess, sys

LONGEST = 100
ROOT = pathlib.Path(__file__).resolve().parent.parent
too_long = []
for name in subprocess.run(["git", "ls-files", "*.rs"], cwd=ROOT, check=True, capture_output=True, text=True).stdout.split():
    fence = False
    for number, line in enumerate((ROOT / name).read_text().splitlines(), 1):
        if not (m := re.match(r"\s*//[/!]? ?(.*)", line)):
            continue
        fence ^= m[1].startswith("```")
        if len(line) > LONGEST and not fence and not re.match(r"\||  |#|```", m[1]):
            too_long.append(f"{name}:{number}: {len(line)} letters")
if too_long:
    sys.exit("\n".join(too_long))
print(f"no comment is wider than {LONGEST} letters")
