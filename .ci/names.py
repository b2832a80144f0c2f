#!/usr/bin/env python3
"""A type name has one meaning: no name of a struct, enum, union, trait or type alias is defined twice in the crates,
private or public, at the top of a file or inside a function. Associated types of an `impl` or a trait are not names of
their own. Tests (`#[cfg(test)]` modules, files named tests) may call theirs as they like.

    names.py
"""

import collections, pathlib, re, sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
DEFINITION = re.compile(r"^( *)(?:pub(?:\([^)]*\))? )?(?:unsafe )?(struct|enum|union|trait|type) (\w+)")
IMPLEMENTATION = re.compile(r"^ *(?:pub(?:\([^)]*\))? )?(?:unsafe )?(impl|trait)\b")


def definitions(lines):
    """Names defined in a file, and their line. rustfmt's indentation tells what encloses a line:
    the last one before it with less of it."""
    for number, line in enumerate(lines):
        if m := DEFINITION.match(line):
            above = (
                l for l in reversed(lines[:number]) if l.strip() and l.strip()[0] not in "#/}" and re.match(r" *\w", l)
            )
            encloses = next((l for l in above if len(l) - len(l.lstrip()) < len(m[1])), "")
            if m[2] != "type" or not IMPLEMENTATION.match(encloses):
                yield m[3], number + 1


places = collections.defaultdict(list)
for path in sorted(p for src in [ROOT / "src", *ROOT.glob("crates/*/src")] for p in src.rglob("*.rs")):
    if path.stem != "tests" and "tests" not in path.parent.parts:
        for name, line in definitions(path.read_text().split("#[cfg(test)]\nmod tests {")[0].splitlines()):
            places[name].append(f"{path.relative_to(ROOT)}:{line}")

twice = [f"{name}: {', '.join(where)}" for name, where in sorted(places.items()) if len(where) > 1]
if twice:
    sys.exit("these type names have more than one meaning; name each after what it is:\n" + "\n".join(twice))
print(f"{len(places)} type names, each with one meaning")
