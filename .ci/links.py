#!/usr/bin/env python3
"""Links between the pages of the documentation: every file named is there, every heading named is one,
every page is in the book.

    links.py
"""

import pathlib, re, sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
PAGES = [*sorted(ROOT.glob("*.md")), *sorted((ROOT / "docs").glob("*.md"))]
# what .ci/book puts beside the pages
MADE = ("rustdoc/",)


def text_of(page):
    return re.sub(r"```.*?```|`[^`\n]*`", "", page.read_text(), flags=re.S)


def anchors(page):
    for head in re.findall(r"^#+ (.*)$", page.read_text(), re.M):
        yield re.sub(r"[^\w -]", "", head.lower().replace("`", "")).replace(" ", "-")


wrong, count = [], 0
for page in PAGES:
    for link in re.findall(r"\]\(([^)\s]+)\)", text_of(page)):
        if re.match(r"\w+:", link) or link.startswith(MADE):
            continue
        count += 1
        path, _, anchor = link.partition("#")
        there = page.parent / path if path else page
        if not there.exists():
            wrong.append(f"{page.relative_to(ROOT)}: {link}: no such file")
        elif anchor and anchor not in anchors(there):
            wrong.append(f"{page.relative_to(ROOT)}: {link}: no such heading")
book = re.findall(r"\]\(([^)]+)\)", (ROOT / "docs" / "SUMMARY.md").read_text())
wrong += [
    f"docs/{p.name}: not in SUMMARY.md" for p in (ROOT / "docs").glob("*.md") if p.name not in [*book, "SUMMARY.md"]
]
if wrong:
    sys.exit("\n".join(wrong))
print(f"{len(PAGES)} pages, {count} links, all there")
