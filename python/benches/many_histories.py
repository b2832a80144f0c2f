"""Ten thousand histories from Python, table included,
beside a loop in Rust over the same structures, records and scales.

    cargo build --release --package groundspring --example many_histories
    python python/benches/many_histories.py [ROUNDS]

Both take turns, so that what else the machine does falls on both alike; the processor time is that of all threads.
Printed: the least time of each, s, and the ratio of Python's to Rust's.
"""

import os
import subprocess
import sys
import time
from operator import attrgetter
from pathlib import Path
from typing import NamedTuple

import numpy as np

import groundspring as gs

RUST = Path(__file__).parent.parent.parent / "target" / "release" / "examples" / "many_histories"

STRUCTURES = [gs.Structure.block(2.0 + 0.2 * i, 0.8, 1000.0) for i in range(20)]
RECORDS = [gs.el_centro().truncated(seconds) for seconds in (20.0, 25.0, 30.0, 35.0, 40.0)]
SCALES = 0.02 * np.arange(1, 101)


class Run(NamedTuple):
    """Seconds on the clock and of the processor, and what was found."""

    clock: float
    processor: float
    found: str


def python() -> Run:
    """`rocking`, and its table in pandas."""
    start, cpu = time.perf_counter(), time.process_time()
    table = gs.rocking(STRUCTURES, RECORDS, SCALES)
    frame = table.to_pandas()
    seconds, cpu = time.perf_counter() - start, time.process_time() - cpu
    total = float(frame[["peak_ratio", "peak_rate", "peak_u", "peak_time"]].sum().sum())
    times = float((frame["uplift_time"] + frame["last_impact_time"]).sum())
    overturned = int((frame["outcome"] == "overturned").sum())
    return Run(seconds, cpu, f"{len(frame)} {overturned} {frame['impacts'].sum()} {total:.6f} {times:.6f}")


def rust() -> Run:
    """The same of the program, whose first round warms it up as a first call does Python."""
    before = os.times()
    lines = subprocess.run([RUST, "2"], check=True, capture_output=True, text=True).stdout.splitlines()
    after = os.times()
    seconds, found = lines[-1].split(" ", 1)
    spent = after.children_user + after.children_system - before.children_user - before.children_system
    return Run(float(seconds), spent / len(lines), found)


def main(rounds: int) -> None:
    python()  # pandas is imported
    ours, theirs = [], []
    for _ in range(rounds):
        ours.append(python())
        theirs.append(rust())
    one, other = ours[0].found.split(), theirs[0].found.split()
    assert one[:3] == other[:3] and np.allclose(np.array(one, float), np.array(other, float), rtol=1e-9), (one, other)
    for name, pick in (("on the clock", attrgetter("clock")), ("of the processor", attrgetter("processor"))):
        a, b = min(map(pick, ours)), min(map(pick, theirs))
        print(f"{name}: Python {a:.3f} s, Rust {b:.3f} s, ratio {a / b:.3f}")
    print(f"histories, overturned, impacts, sums: {ours[0].found}")


if __name__ == "__main__":
    main(int(sys.argv[1]) if len(sys.argv) > 1 else 5)
