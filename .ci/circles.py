#!/usr/bin/env python3
"""A module of the library may use those alone that stand above it in src/lib.rs, so that none depends on itself by way of others: reads
`crate::` paths and `use` trees of src/, top-level modules only. Tests (`#[cfg(test)]` modules, files named tests) may look anywhere.

    circles.py
"""
import pathlib, re, sys

SRC = pathlib.Path(__file__).resolve().parent.parent / "src"
names = re.findall(r"^ *(?:pub )?mod (\w+);", (SRC / "lib.rs").read_text(), re.M)


def files(name):
    yield SRC / f"{name}.rs"
    yield from (p for p in (SRC / name).rglob("*.rs") if p.stem != "tests" and "tests" not in p.parent.parts)


def used(text, at_top):
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


graph = {name: set().union(*(used(p.read_text(), p.parent == SRC) for p in files(name) if p.exists())) - {name} for name in names}


wrong = [
    f"{name} uses {other}, which stands below it"
    for place, name in enumerate(names)
    for other in sorted(graph[name])
    if names.index(other) > place
]
if wrong:
    sys.exit("src/lib.rs says that each module uses those above it alone: " + "; ".join(wrong))
print(f"{len(names)} modules, {sum(map(len, graph.values()))} dependencies, each on a module further up in src/lib.rs")
