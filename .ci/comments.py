#!/usr/bin/env python3
"""No line of Rust is longer than 100 letters: rustfmt wraps code, but neither comments nor literals.
Left as they are: addresses, raw literals, and in comments tables and drawings (lines that begin with
a bar or two spaces, or stand between fences).

    comments.py
"""
import pathlib, re, subprocess, sys

LONGEST = 100
ROOT = pathlib.Path(__file__).resolve().parent.parent
# literals still to be wrapped: the start of a path, and why
LATER = {
    "crates/parameters/src/error.rs": "rustfmt joins the fields of a variant to 101 letters",
}

too_long = []
listed = subprocess.run(["git", "ls-files", "*.rs"], cwd=ROOT, check=True, capture_output=True, text=True)
for name in listed.stdout.split():
    fence = False
    for number, line in enumerate((ROOT / name).read_text().splitlines(), 1):
        comment = re.match(r"\s*//[/!]? ?(.*)", line)
        fence = fence ^ comment[1].startswith("```") if comment else False
        if len(line) <= LONGEST or "://" in line or 'r#"' in line:
            continue
        if comment and (fence or re.match(r"\||  |#|```", comment[1])):
            continue
        if not comment and name.startswith(tuple(LATER)):
            continue
        too_long.append(f"{name}:{number}: {len(line)} letters")
if too_long:
    sys.exit("\n".join(too_long))
print(f"no line of Rust is wider than {LONGEST} letters")
