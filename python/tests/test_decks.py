"""A body in a live model through add_feet and Stepper against the deck that `tune run` writes
and our own finite elements."""

import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import CASES, load, rigid_body

import groundspring as gs
from groundspring.opensees import Stepper, add_feet


@pytest.mark.parametrize("name", CASES)
def test_a_body_on_added_feet_is_that_of_the_deck(name: str, ops: Any, tmp_path: Path) -> None:
    structure, scale, accuracy = CASES[name]
    record = gs.el_centro().truncated(20.0).scaled(scale)
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", gs.GroundspringWarning)
        tuned = gs.tune(structure, record, accuracy)
    compare(tuned, record, ops, tmp_path)


def test_a_body_shaken_vertically_too_is_that_of_the_deck(ops: Any, tmp_path: Path) -> None:
    structure, *_ = CASES["12 m pier"]
    record = gs.el_centro().truncated(20.0)
    # what comes some seconds later, as strong: no phase with the horizontal motion
    up = gs.Record(record.dt, np.roll(record.accel, 311))
    tuned = gs.tune(structure, record, vertical=up)
    without = gs.rigid_rocking(structure, record)
    assert np.abs(tuned.histories.housner.u - without.u).max() > 0.01 * np.abs(without.u).max()
    compare(tuned, record.with_vertical(up), ops, tmp_path)


def compare(tuned: gs.Tuned, record: gs.Record, ops: Any, tmp_path: Path) -> None:
    structure = tuned.structure
    tuned.save(tmp_path, figures=False)
    deck = load(tmp_path / "decks" / "model_openseespy.py")
    rows, settled, _ = deck.run(deck.ACCURACY)

    ops.wipe()
    give = rigid_body(ops, structure, tuned.springs)
    feet = add_feet(ops, [1, 2], tuned.springs, compliance=give)
    longest = record.dt / deck.STEPS_PER_SAMPLE
    tolerance = 2e-14 * np.hypot(structure.height, structure.width / 2.0)
    stepper = Stepper(
        ops, feet, accuracy=deck.ACCURACY, longest=longest, tolerance=tolerance, rise=getattr(deck, "RISE", None)
    )
    stepper.gravity()
    found = []
    sunk = ops.nodeDisp(3, 2)
    stepper.run(record, on_sample=lambda i, t: found.append((ops.nodeDisp(3, 1), ops.nodeDisp(3, 2) - sunk)))
    print(stepper.report())

    u, v = np.array(found).T
    _, deck_u, deck_v, _ = np.array(rows).T
    largest = np.abs(deck_u).max()
    print("u", np.abs(u - deck_u).max() / largest, "v", np.abs(v - deck_v).max() / largest)
    assert sunk == pytest.approx(settled, rel=1e-9)
    assert np.abs(u - deck_u).max() < 1e-9 * largest
    assert np.abs(v - deck_v).max() < 1e-9 * largest
    ours = tuned.histories.u
    nrmse = np.sqrt(np.sum((u - ours) ** 2) / np.sum(ours**2))
    print("nrmse", nrmse, tuned.verdict["well_conditioned"])
    assert nrmse < 1e-3
    assert stepper.steps.late == 0
