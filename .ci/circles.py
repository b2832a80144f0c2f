#!/usr/bin/env python3
"""No top-level module of a crate depends on itself by way of others: reads `crate::` paths and `use` trees of every
crate's src/. Between crates Cargo allows no circle. Tests (`#[cfg(test)]` modules, files named tests) may look
anywhere.

    circles.py
"""

import graphlib, pathlib, re, sys

ROOT = pathlib.Path(__file__).resolve().parent.parent


def used(text, at_top, names):
    text = re.sub(r"//.*", "", text.split("#[cfg(test)]\nmod tests {")[0])
    found = set(re.findall(r"crate::(\w+)", text))
    found |= set(re.findall(r"super::(\w+)", text)) if at_top else set()
    for tree in re.findall(r"crate::\{(.*?)\};", text, re.S):
        depth, word = 0, ""
        for c in tree + ",":
            if c == "," and depth == 0:
                found.add(word.strip().split("::")[0].split(" ")[0])
                word = ""
                continue
            depth += (c == "{") - (c == "}")
            word += c
    return found & set(names)


def graph(src):
    root = next(p for p in (src / "lib.rs", src / "main.rs") if p.exists())
    names = re.findall(r"^ *(?:pub(?:\(\w+\))? )?mod (\w+);", root.read_text(), re.M)

    def files(name):
        yield src / f"{name}.rs"
        yield from (p for p in (src / name).rglob("*.rs") if p.stem != "tests" and "tests" not in p.parent.parts)

    here = lambda name: [p for p in files(name) if p.exists() and p.stem != "tests"]
    return {
        name: set().union(*(used(p.read_text(), p.parent == src, names) for p in here(name))) - {name} for name in names
    }


count = 0
for src in [ROOT / "src", *sorted(ROOT.glob("crates/*/src"))]:
    modules = graph(src)
    count += len(modules)
    try:
        graphlib.TopologicalSorter(modules).prepare()
    except graphlib.CycleError as e:
        sys.exit(f"{src.relative_to(ROOT)}: these modules use each other in a circle: {' -> '.join(e.args[1])}")
print(f"{count} modules, no circle")
