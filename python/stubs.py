"""The docstrings of the native module are written in Rust; its stubs repeat them, for editors that run nothing.

    python python/stubs.py    exit 1 if a docstring of groundspring._native is not that of the stub
"""

import ast
import inspect
import sys
from collections.abc import Iterator
from pathlib import Path

from groundspring import _native

STUBS = Path(__file__).parent / "groundspring" / "_native.pyi"


def documented(body: list[ast.stmt], prefix: str = "") -> Iterator[tuple[str, str | None]]:
    """Names and docstrings of classes, functions and properties."""
    for node in body:
        if isinstance(node, ast.ClassDef):
            yield prefix + node.name, ast.get_docstring(node)
            yield from documented(node.body, f"{node.name}.")
        elif isinstance(node, ast.FunctionDef) and not overloaded_first(node):
            yield prefix + node.name, ast.get_docstring(node)


def overloaded_first(node: ast.FunctionDef) -> bool:
    """Whether another form follows, which has the docstring."""
    overload = any(isinstance(d, ast.Name) and d.id == "overload" for d in node.decorator_list)
    return overload and ast.get_docstring(node) is None


def words(text: str | None) -> str:
    """Lines are broken where they are too long for either file: they do not count."""
    return " ".join((text or "").split())


def main() -> int:
    wrong = 0
    for name, stub in documented(ast.parse(STUBS.read_text()).body):
        last = name.rpartition(".")[2]
        if last.startswith("_") and last != "__arrow_c_stream__":
            continue
        found: object = _native
        for part in name.split("."):
            found = inspect.getattr_static(found, part) if isinstance(found, type) else getattr(found, part)
        if isinstance(found, staticmethod):
            found = found.__func__
        told = getattr(found, "__doc__", None)
        if stub is None and last.startswith("__"):
            continue
        if not told or words(told) != words(stub):
            wrong += 1
            print(f"{name}\n  at run time: {words(told)}\n  in the stub: {words(stub)}", file=sys.stderr)
    return int(wrong > 0)


if __name__ == "__main__":
    sys.exit(main())
