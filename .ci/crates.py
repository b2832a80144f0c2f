#!/usr/bin/env python3
"""The crates of the workspace as Cargo.toml files have them: a dependency that no source of the crate names
fails; so does a drawing in docs/architecture.md that is not the one printed here.

    crates.py [--check docs/architecture.md]
"""

import pathlib, re, sys, tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent
ours = {}
for manifest in sorted(
    [*(ROOT / path / "Cargo.toml" for path in ("", "python", "benches")), *ROOT.glob("crates/*/Cargo.toml")]
):
    ours[tomllib.loads(manifest.read_text())["package"]["name"]] = manifest


def text_of(folder, parts):
    files = (p for part in parts for p in (folder / part).rglob("*.rs"))
    return "\n".join(re.sub(r"//.*", "", p.read_text()) for p in files)


uses, idle = {}, []
for name, manifest in ours.items():
    toml = tomllib.loads(manifest.read_text())
    uses[name] = [d for d in toml["dependencies"] if d in ours]
    for table, parts in [
        ("dependencies", ["."] if name == "benches" else ["src"]),
        ("dev-dependencies", ["src", "tests", "examples", "../fuzz"]),
    ]:
        text = text_of(manifest.parent, parts)
        for crate in toml.get(table, {}):
            word = crate.replace("-", "_")
            # plotters-svg's backend and argmin-math work by traits and features
            if not re.search(rf"\b{word}\b", text) and crate not in ("argmin-math",):
                idle.append(f"{manifest.relative_to(ROOT)}: nothing uses {crate}")
if idle:
    sys.exit("\n".join(idle))


def depth(name):
    return 1 + max((depth(other) for other in uses[name]), default=0)


order = sorted(ours, key=lambda name: (depth(name), name))
lines = ["| crate | what it is for | uses |", "|---|---|---|"]
for name in order:
    what = tomllib.loads(ours[name].read_text())["package"]["description"]
    below = ", ".join(f"`{other}`" for other in sorted(uses[name], key=order.index)) or "-"
    lines.append(f"| `{name}` | {what} | {below} |")
drawing = "\n".join(lines)
if sys.argv[1:2] == ["--check"]:
    if drawing not in pathlib.Path(sys.argv[2]).read_text():
        sys.exit(f"{sys.argv[2]} does not have the crates as Cargo has them:\n{drawing}")
    print(f"{len(ours)} crates, as {sys.argv[2]} draws them; every dependency is used")
else:
    print(drawing)
