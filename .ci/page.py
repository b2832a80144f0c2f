"""Puts docs/groundspring.html together, or tells whether it is of the sources that are there.

    page.py pack GLUE.js PROGRAM.wasm PACKED
    page.py build PAGE GLUE.js PACKED.gz
    page.py check PAGE

What is packed: the worker's script (the glue of wasm-bindgen, and worker.js), then the program.
"""

import hashlib
import re
import sys
from pathlib import Path

CRATES = (
    "elementary files parallel strong-motion rocking dynamics frames frequency-response landing "
    "fixed-steps validation results cases springs parameters decks report run-folder web".split()
)
SCRIPTS = ["core.js", "plot.js", "drawing.js", "working.js", "inputs.js", "app.js", "begin.js"]
FOLDER = Path("crates/web/page")
LIMIT = 1_500_000
# 91 letters, without the one that begins a tag
ALPHABET = "0123456789ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz!\"#$%&'()*+,-./:;=>?@[]^_{|}~"


def sources():
    """All that the page is made of."""
    files = [Path("Cargo.toml"), Path("Cargo.lock"), Path("tuning/paper.toml"), Path("tuning/records/IELC180.AT2")]
    files += [Path(".ci/page"), Path(".ci/page.py"), *FOLDER.iterdir()]
    for crate in CRATES:
        files.append(Path("crates") / crate / "Cargo.toml")
        found = (Path("crates") / crate / "src").rglob("*")
        # tests are no part of it
        files += [f for f in found if f.is_file() and f.name != "tests.rs" and "tests" not in f.parts]
    return sorted(files)


def fingerprint():
    digest = hashlib.sha256()
    for file in sources():
        data = file.read_bytes()
        digest.update(f"{file.as_posix()} {len(data)}\n".encode())
        digest.update(data)
    return digest.hexdigest()[:16]


def base91(data):
    """Two letters to 13 or 14 bits (basE91), lines of 1000 letters."""
    letters, bits, count = [], 0, 0
    for byte in data:
        bits |= byte << count
        count += 8
        if count > 13:
            # 14 bits where two letters hold them
            wide = (bits & 8191) <= 88
            taken = 14 if wide else 13
            high, low = divmod(bits & ((1 << taken) - 1), 91)
            letters += [ALPHABET[low], ALPHABET[high]]
            bits >>= taken
            count -= taken
    if count:
        high, low = divmod(bits, 91)
        letters += [ALPHABET[low], ALPHABET[high]]
    text = "".join(letters)
    lines = [text[i : i + 1000] for i in range(0, len(text), 1000)]
    return "\n".join(lines)


def dense(text):
    """Scripts and styles without indentation, blank lines and lines of comment: the sources are for reading."""
    lines = (line.strip() for line in text.splitlines())
    return "\n".join(line for line in lines if line and not line.startswith("//"))


def worker(glue):
    """The worker's script."""
    return dense(Path(glue).read_text() + "\n" + (FOLDER / "worker.js").read_text()).encode()


def pack(glue, wasm, packed):
    Path(packed).write_bytes(worker(glue) + Path(wasm).read_bytes())


def build(page, glue, packed):
    data = Path(packed).read_bytes()
    script = dense("\n".join((FOLDER / name).read_text() for name in SCRIPTS))
    parts = {
        "/*STYLE*/": dense((FOLDER / "style.css").read_text()),
        "/*HASH*/": fingerprint(),
        # bytes that are packed, bytes of the script, letters
        "/*PROGRAM*/": f"{len(data)}\n{len(worker(glue))}\n{base91(data)}",
        "/*SCRIPT*/": f'"use strict";\n{script}',
    }
    text = (FOLDER / "index.html").read_text()
    for mark, part in parts.items():
        if "</script" in part:
            sys.exit(f"{mark} ends a script; take that out")
        before, after = text.split(mark)
        text = before + part + after
    Path(page).write_text(text)
    size = Path(page).stat().st_size
    print(f"{page}: {size} bytes, sources {parts['/*HASH*/']}")
    if size > LIMIT:
        sys.exit(f"{page} is larger than {LIMIT} bytes")


def check(page):
    found = re.search(r"sources <code>(\w+)</code>", Path(page).read_text())
    now = fingerprint()
    if not found or found[1] != now:
        sys.exit(f"{page} is of other sources ({found and found[1]}, not {now}); build it anew with .ci/page")
    print(f"{page} is of these sources, {now}")


if __name__ == "__main__":
    {"pack": pack, "build": build, "check": check}[sys.argv[1]](*sys.argv[2:])
