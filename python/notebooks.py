"""The examples as notebooks in docs/notebooks, made from their sources.

    python python/notebooks.py           write them, run, with what they print and draw (needs nbclient and ipykernel)
    python python/notebooks.py --check   exit 1 if one is not that of its example, or has no outputs
    python python/notebooks.py --run     run those that are there, in another folder: exit 1 if one fails
"""

import ast
import json
import sys
import tempfile
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

HERE = Path(__file__).parent
NOTEBOOKS = HERE.parent / "docs" / "notebooks"


def cell(kind: str, text: str, number: int) -> dict[str, Any]:
    lines = text.strip("\n").splitlines(keepends=True)
    common = {"cell_type": kind, "id": f"cell-{number}", "metadata": {}, "source": lines}
    return common if kind == "markdown" else common | {"execution_count": None, "outputs": []}


def notebook(source: str) -> dict[str, Any]:
    """The docstring as text; a cell of code for what comes before the first function,
    one for each function, and the call."""
    tree, lines = ast.parse(source), source.splitlines(keepends=True)
    title, _, rest = (ast.get_docstring(tree) or "").partition("\n")
    rest = "\n".join(line for line in rest.splitlines() if not line.startswith("    "))
    texts, begin = [], tree.body[0].end_lineno or 0
    for node in tree.body[1:]:
        if isinstance(node, ast.If):  # if __name__ == "__main__"
            break
        first = min([node.lineno, *(d.lineno for d in getattr(node, "decorator_list", []))])
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            texts.append("".join(lines[begin : first - 1]))
            texts.append("".join(lines[first - 1 : node.end_lineno]))
            begin = node.end_lineno or begin
    texts.append('main(Path("."))')
    cells = [cell("markdown", f"# {title}\n{rest}", 0)]
    cells += [cell("code", text, i) for i, text in enumerate(filter(str.strip, texts), 1)]
    kernel = {"display_name": "Python 3", "language": "python", "name": "python3"}
    return {"cells": cells, "metadata": {"kernelspec": kernel}, "nbformat": 4, "nbformat_minor": 5}


def run(of: dict[str, Any]) -> dict[str, Any]:
    """With outputs, without what changes from run to run and what OpenSees and this machine say on stderr."""
    import nbformat
    from nbclient import NotebookClient

    node = nbformat.reads(json.dumps(of), as_version=4)
    with tempfile.TemporaryDirectory() as folder:
        NotebookClient(node, timeout=900, resources={"metadata": {"path": folder}}).execute()
    for entry in node.cells:
        entry.metadata = nbformat.from_dict({})
        if entry.cell_type == "code":
            entry.outputs = [output for output in entry.outputs if output.get("name") != "stderr"]
    found: dict[str, Any] = json.loads(nbformat.writes(node))
    return found | {"metadata": of["metadata"]}


def sources(of: dict[str, Any]) -> list[str]:
    return ["".join(entry["source"]) for entry in of["cells"]]


def main() -> int:
    wrong: list[str] = []
    to_run: dict[Path, dict[str, Any]] = {}
    for example in sorted((HERE / "examples").glob("*.py")):
        path = NOTEBOOKS / f"{example.stem}.ipynb"
        made = notebook(example.read_text())
        if "--check" in sys.argv[1:]:
            found = json.loads(path.read_text()) if path.exists() else {"cells": []}
            if sources(found) != sources(made) or not any(entry.get("outputs") for entry in found["cells"]):
                wrong.append(path.name)
        elif "--run" in sys.argv[1:]:
            to_run[path] = json.loads(path.read_text())
        else:
            to_run[path] = made
    with ProcessPoolExecutor() as pool:
        for path, ran in zip(to_run, pool.map(run, to_run.values()), strict=True):
            if "--run" in sys.argv[1:]:
                print(f"{path.name} runs")
            else:
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(json.dumps(ran, indent=1) + "\n")
    if wrong:
        print(
            f"not those of the examples, or without outputs: {', '.join(wrong)}; run python python/notebooks.py",
            file=sys.stderr,
        )
    return len(wrong) > 0


if __name__ == "__main__":
    sys.exit(main())
