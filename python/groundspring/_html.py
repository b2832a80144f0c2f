"""Tables for notebooks."""

from __future__ import annotations

import html
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from ._native import Histories, History, Record, RockingTable, Simulation, Springs, Tuned, Validation


def table(head: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """An HTML table; every cell is text."""

    def line(cells: Sequence[str], tag: str) -> str:
        return "<tr>" + "".join(f"<{tag}>{html.escape(cell)}</{tag}>" for cell in cells) + "</tr>"

    body = "".join(line(row, "td") for row in rows)
    return (
        f"<table><thead>{line(head, 'th')}</thead><tbody>{body}</tbody></table>"
        if any(head)
        else f"<table>{body}</table>"
    )


def paragraph(text: str) -> str:
    return f"<p>{html.escape(text)}</p>"


def record(of: Record) -> str:
    up = "none" if of.vertical is None else f"{of.vertical.pga_g:.4g} g"
    rows = [
        ("samples", f"{len(of)} of {of.dt:g} s"), ("duration", f"{of.duration:g} s"), ("peak", f"{of.pga_g:.4g} g"),
        ("vertical peak", up),
    ]  # fmt: skip
    return table(["record", of.name], rows)


def springs(of: Springs) -> str:
    rows = [
        (name, *(f"{getattr(unit, name):.4g} {units}" for unit in (of.vertical, of.horizontal)))
        for name, units in (("k1", "N/m"), ("k2", "N/m"), ("m2", "kg"), ("c", "N s/m"))
    ]
    head = [f"for {of.mass:.4g} kg, {of.omega_n_hz:.4g} Hz", "vertical", "horizontal"]
    return table(head, rows)


def history(of: History) -> str:
    rows = [
        ("outcome", of.outcome), ("samples", f"{len(of)} of {of.dt:g} s"), ("impacts", str(len(of.impacts))),
        ("largest |theta|/alpha", f"{of.peak_ratio:.4g}"),
    ]  # fmt: skip
    return table(["history", ""], rows)


def histories(of: Histories) -> str:
    rows = [
        ("histories", str(len(of))), ("overturned", str(int(of.overturned.sum()))),
        ("largest |theta|/alpha", f"{of.peak_ratio.max():.4g}" if len(of) else "-"),
    ]  # fmt: skip
    return table(["", ""], rows)


def simulation(of: Simulation) -> str:
    rows = [("outcome", of.outcome), *(_line(line) for line in of.lines)]
    return table(["both models", ""], rows)


def tuned(of: Tuned) -> str:
    lines = table(["tuned", f"Omega_n {of.springs.omega_n_hz:.1f} Hz"], (_line(line) for line in of.lines))
    return lines + springs(of.springs)


def validation(of: Validation) -> str:
    return table(["validation", ""], [("records", str(len(of)))])


def rocking(of: RockingTable, most: int = 10) -> str:
    columns = [list(of[name][:most]) for name in of.columns]
    rows = [[f"{x:.5g}" if isinstance(x, float) else str(x) for x in row] for row in zip(*columns, strict=True)]
    return table(of.columns, rows) + f"<p>{len(of)} rows</p>"


def _line(line: str) -> tuple[str, str]:
    name, colon, rest = line.partition(": ")
    return (name, rest) if colon else ("", line)
