"""Example (b), and what it must tend to."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import load

import groundspring as gs
from groundspring.opensees import Stepper, add_feet

EXAMPLES = Path(__file__).parent.parent / "examples"


@pytest.fixture(scope="module")
def frame() -> Any:
    return load(EXAMPLES / "two_storey_frame.py")


def test_a_frame_made_stiff_tends_to_housner(frame: Any, ops: Any) -> None:
    """One cycle of a sine, 0.8 g, 0.8 s: five impacts, well-conditioned."""
    t = np.arange(0.0, 6.0, 0.01)
    record = gs.Record(0.01, np.where(t < 0.8, 0.8 * gs.GRAVITY * np.sin(2.0 * np.pi * t / 0.8), 0.0), "sine")
    body = frame.rigid(100.0)
    springs = gs.design(body, stiffness=2.0 * math.pi * 500.0 / body.p).springs(
        body.mass, math.hypot(body.height, frame.BAY / 2)
    )
    housner = gs.rigid_rocking(body, record).u
    ours = gs.simulate(body, springs, record)
    assert ours.verdict["well_conditioned"] and ours.match["nrmse_horizontal"] < 0.005
    errors = []
    for stiffer in (1.0, 1e4, 1e6):
        frame.build(stiffer, 100.0)
        # the springs are for the whole body, which the stiffest of the three is
        stepper = Stepper(ops, add_feet(ops, [1, 2], springs, measure=False))
        stepper.gravity()
        rows: list[tuple[float, float]] = []
        stepper.run(record, on_sample=lambda i, t: rows.append((ops.nodeDisp(3, 1), ops.nodeDisp(5, 1))))  # noqa: B023
        below, above = np.array(rows).T
        u = below + (above - below) * (body.height / frame.STOREY - 1.0)
        errors.append(np.sqrt(np.sum((u - housner) ** 2) / np.sum(housner**2)))
    print(errors)
    assert errors[0] > errors[1] > errors[2]
    # where the legs are stiffer than the springs the rotation has digits to lose: their own error is 0.003
    assert errors[2] < 0.02
