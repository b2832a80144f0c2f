#!/usr/bin/env python3
"""No module of the library may depend on itself by way of others: reads `crate::` paths and `use` trees of src/, top-level modules only.
Tests (`#[cfg(test)]` modules, files named tests) may look anywhere.

    circles.py
"""
import pathlib, re, sys

SRC = pathlib.Path(__file__).resolve().parent.parent / "src"
names = re.findall(r"^ *(?:pub )?mod (\w+);", (SRC / "lib.rs").read_text(), re.M)


def files(name):
    yield SRC / f"{name}.rs"
    yield from (p for p in (SRC / name).rglob("*.rs") if p.stem != "tests" and "tests" not in p.parent.parts)


def used(text):
    text = re.sub(r"//.*", "", text.split("#[cfg(test)]\nmod tests {")[0])
    found = set(re.findall(r"crate::(\w+)", text))
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


graph = {name: set().union(*(used(p.read_text()) for p in files(name) if p.exists())) - {name} for name in names}


def circle():
    done, path = set(), []

    def visit(name):
        if name in path:
            return path[path.index(name):] + [name]
        if name in done:
            return None
        path.append(name)
        for other in sorted(graph[name]):
            if found := visit(other):
                return found
        path.pop()
        done.add(name)

    for name in names:
        if found := visit(name):
            return found


if found := circle():
    sys.exit("a circle of modules: " + " -> ".join(found))
print(f"{len(names)} modules, {sum(map(len, graph.values()))} dependencies, no circle")
