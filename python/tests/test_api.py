"""The package's half without OpenSees: against the program, closed forms, and what a user gets wrong."""

import csv
import io
import json
import math
import os
import signal
import subprocess
import threading
import time
from pathlib import Path

import numpy as np
import pytest

import groundspring as gs

ROOT = Path(__file__).parent.parent.parent
FRAME = gs.Structure.aframe(61.0, 12.2, 680.1e3)
TUNE = os.environ.get("TUNE")
"""The program; .ci/python names it."""
needs_program = pytest.mark.skipif(TUNE is None, reason="the environment variable TUNE does not name the program")


def test_structures_have_the_numbers_of_closed_forms() -> None:
    frame = gs.Structure.aframe(61.0, 12.2, 680.1e3, inertia=0.0)
    assert frame.alpha == pytest.approx(math.atan(0.1), rel=1e-14)
    assert frame.p == pytest.approx(math.sqrt(9.81 / math.hypot(6.1, 61.0)), rel=1e-14)
    assert frame.restitution == pytest.approx(math.cos(2.0 * math.atan(0.1)), rel=1e-14)
    block = gs.Structure.block(2.0, 0.5, 1000.0)
    assert block.height == 1.0
    assert block.inertia == pytest.approx(1000.0 * (2.0**2 + 0.5**2) / 12.0, rel=1e-14)
    assert gs.Structure.block(2.0, 0.5, 1000.0, restitution=0.5).restitution == 0.5
    assert block == gs.Structure.block(2.0, 0.5, 1000.0) != frame


def test_free_rocking_has_housners_period() -> None:
    """After a pulse, half a period follows from the peak within it."""
    body = gs.Structure.aframe(61.0, 12.2, 680.1e3, inertia=0.0)
    accel = np.where(np.arange(3000) < 50, 2.0, 0.0)
    history = gs.rigid_rocking(body, gs.Record(0.01, accel))
    first, second = history.impacts[:2]
    between = np.abs(history.theta[(history.t > first) & (history.t < second)])
    phi = between.max() / body.alpha
    # small angles: half a period 2/p acosh(1/(1 - phi))
    assert second - first == pytest.approx(2.0 / body.p * math.acosh(1.0 / (1.0 - phi)), rel=2e-3)
    assert np.all(np.sign(history.impact_rates[:-1]) == -np.sign(history.impact_rates[1:]))


@needs_program
@pytest.mark.parametrize("scale", [1.0, 1.7])
def test_rocking_is_the_programs_to_its_last_digit(scale: float, tmp_path: Path) -> None:
    case = tmp_path / "case.toml"
    case.write_text('[structure]\nkind = "aframe"\nheight_m = 61.0\nwidth_m = 12.2\nmass_kg = 680.1e3\n')
    run = [str(TUNE), "housner", str(case), "--scale", str(scale)]
    theirs = list(csv.DictReader(io.StringIO(subprocess.run(run, check=True, capture_output=True, text=True).stdout)))
    history = gs.rigid_rocking(FRAME, gs.el_centro(), scale=scale)
    for name, values in (("u", history.u), ("v", history.v), ("th", history.theta)):
        # the program prints twelve digits: the numbers rounded to as many are the same
        written = np.array([float(row[name]) for row in theirs])
        assert np.array_equal(
            np.array([float(f"{x:.11e}") for x in values]), np.array([float(f"{x:.11e}") for x in written])
        )


def test_many_histories_are_those_of_one_to_the_last_bit() -> None:
    record = gs.el_centro()
    blocks = [gs.Structure.block(h, 0.25 * h, 100.0) for h in (0.5, 1.0, 2.0, 4.0)]
    for block, many in zip(blocks, gs.rigid_rocking_many(blocks, record), strict=True):
        one = gs.rigid_rocking(block, record)
        assert np.array_equal(one.theta, many.theta) and np.array_equal(one.impacts, many.impacts)
        assert one.outcome == many.outcome
    scales = np.array([0.5, 1.0, 2.0])
    pairs = gs.rigid_rocking_many(blocks[:3], record, scales)
    assert len(pairs) == 3 and np.array_equal(pairs[-1].theta, pairs[2].theta)
    flat = [0.5 * math.pi / block.alpha for block in blocks[:3]]
    assert (pairs.peak_ratio == flat).tolist() == pairs.overturned.tolist()
    with pytest.raises(IndexError, match="3 histories"):
        pairs[3]
    assert len(gs.rigid_rocking_many(FRAME, record, np.arange(1, 4))) == 3  # whole numbers, too


def test_arrays_are_views_of_the_crates_memory() -> None:
    record = gs.el_centro()
    assert record.accel.ctypes.data == record.accel.ctypes.data
    history = gs.rigid_rocking(FRAME, record)
    theta = history.theta
    assert theta.ctypes.data == history.theta.ctypes.data and theta.base is not None
    assert history.u.ctypes.data == history.u.ctypes.data
    with pytest.raises(ValueError, match="read-only"):
        theta[0] = 1.0
    del history  # the array keeps what it looks at
    assert np.isfinite(theta).all()


@needs_program
def test_a_saved_run_is_that_of_the_program(tmp_path: Path) -> None:
    subprocess.run(
        [str(TUNE), "run", "--quiet", "--no-front", "--out", str(tmp_path / "program")], check=True, capture_output=True
    )
    tuned = gs.tune(FRAME, gs.el_centro(), duration=20.0)
    tuned.save(tmp_path / "package")
    theirs, ours = (
        {path.relative_to(folder): path.read_bytes() for path in folder.rglob("*") if path.is_file()}
        for folder in (tmp_path / "program", tmp_path / "package")
    )
    # the program draws figures as pixels, too
    pixels = [path for path in theirs if path.suffix == ".png"]
    assert pixels and all(path.with_suffix(".svg") in ours for path in pixels)
    checksums = Path(".tune-files.json")
    filed = [json.loads(files.pop(checksums))["run"]["files"] for files in (theirs, ours)]
    for path in pixels:
        del theirs[path], filed[0][str(path)]
    assert sorted(ours) == sorted(theirs) and len(ours) > 10
    assert [str(path) for path in ours if ours[path] != theirs[path]] == []
    assert filed[0] == filed[1]
    structure, springs = gs.read_parameters(tmp_path / "program" / "parameters.json")
    assert (structure, springs) == (FRAME, tuned.springs)


def test_tuned_springs_reach_what_was_asked_for_and_say_so() -> None:
    tuned = gs.tune(FRAME, gs.el_centro().truncated(20.0), accuracy=0.01)
    assert tuned.accuracy["reached"] and tuned.accuracy["accuracy"] == 0.01
    assert tuned.verdict["housner"]["fate"] == tuned.verdict["finite_elements"]["fate"] == "rocked"
    assert any(line.startswith("accuracy: ") and "asked: NRMSE 0.01, reached" in line for line in tuned.lines)
    again = gs.simulate(FRAME, tuned.springs, gs.el_centro().truncated(20.0))
    assert np.array_equal(again.u, tuned.histories.u)
    table = tuned.to_pandas()
    assert len(table) == 2001 and {"u", "u_housner", "base_shear_n"} <= set(table.columns)
    assert tuned.plot().get_xlabel() == "time [s]"
    with pytest.warns(gs.GroundspringWarning, match="the accuracy asked for .* was not reached"):
        gs.tune(FRAME, gs.el_centro().truncated(20.0), max_hz=160.0)


def test_a_record_that_was_cut_and_scaled_is_saved_with_its_length_and_scale(tmp_path: Path) -> None:
    def saved(folder: str, record: gs.Record, **how: float) -> dict[str, object]:
        gs.tune(FRAME, record, accuracy=0.01, **how).save(tmp_path / folder, figures=False)
        parameters: dict[str, object] = json.loads((tmp_path / folder / "parameters.json").read_text())["record"]
        return parameters

    made = saved("made", gs.el_centro().truncated(20.0).scaled(1.1))
    assert made == saved("asked", gs.el_centro(), duration=20.0, scale=1.1)
    assert (made["samples"], made["duration_s"], made["scale"]) == (3995, 20.0, 1.1)


def test_the_design_without_units_is_that_of_every_body_of_its_geometry() -> None:
    small = gs.Structure.block(0.5, 0.125, 10.0)
    design = gs.design(small, stiffness=50_000.0)
    same = gs.design(small.alpha, small.inertia / (small.mass * math.hypot(0.25, 0.0625) ** 2), 50_000.0)
    assert (design.vertical.mu, design.vertical.k) == (same.vertical.mu, same.vertical.k)
    springs = design.springs(small.mass, math.hypot(0.25, 0.0625))
    assert 2.0 * math.pi * springs.omega_n_hz / small.p == pytest.approx(50_000.0, rel=1e-8)
    assert springs.vertical.k2 / springs.vertical.k1 == pytest.approx(design.vertical.k, rel=1e-12)


def test_the_frequency_response_has_its_limits() -> None:
    mu, f, xi = 0.1, 2.3, 9.0
    arr = gs.frequency_response([0.0, 1e3], mu, f, xi)
    assert arr[0] == pytest.approx(1.0 + 1.0 / (mu * f * f), rel=1e-12)
    assert arr[1] == pytest.approx(1e-6, rel=1e-4)
    # theory: mu = 0.1 has a least maximum of 2.91372 at K = 0.52254
    fit = gs.fit_response(0.1)
    assert (fit["k"], fit["peak"]) == (pytest.approx(0.52254, abs=1e-4), pytest.approx(2.91372, abs=1e-4))


def test_validation_counts_its_records() -> None:
    springs = gs.design(FRAME).springs(FRAME.mass, math.hypot(6.1, 61.0))
    own = gs.synthetic_records(FRAME, 3)
    found = gs.validate(FRAME, springs, own, synthetic=4, earthquakes=2, seed=5)
    assert len(found) == 9 and len(found.to_pandas()) == 9
    assert found.summary["count"] == 9 and set(found.summary["suites"]) >= {"synthetic", "earthquakes"}
    with pytest.raises(ValueError, match="there are no records"):
        gs.validate(FRAME, springs)


def test_records_are_read_with_the_words_of_the_program(tmp_path: Path) -> None:
    record = gs.read_record(ROOT / "tuning" / "records" / "IELC180.AT2")
    assert np.array_equal(record.accel, gs.el_centro().accel) and record.dt == 0.01
    assert len(record.truncated(20.0)) == 2001 and record.scaled(2.0).pga == 2.0 * record.pga
    with pytest.raises(ValueError, match="nope.at2: cannot be read .*; check the path"):
        gs.read_record("nope.at2")
    with pytest.raises(ValueError, match="every sample must be a finite number"):
        gs.Record(0.01, [0.0, math.nan])
    with pytest.raises(ValueError, match="above 50 g"):
        record.scaled(1e3)
    weak = tmp_path / "weak.csv"
    weak.write_text("t,a\n" + "".join(f"{0.01 * i:.2f},{1e-7 * (-1) ** i}\n" for i in range(100)))
    with pytest.warns(gs.GroundspringWarning, match="check the unit"):
        gs.read_record(weak, units="g")


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: gs.Structure.aframe(-1.0, 2.0, 3.0), "height_m is -1.0; give a finite number greater than zero"),
        (lambda: gs.Structure.block(1.0, 5.0, 3.0), "slenderness alpha"),
        (lambda: gs.tune(FRAME, accuracy=5.0), "accuracy is 5.0; give an error between 1e-5 and 1"),
        (lambda: gs.tune(FRAME, method="x"), 'give "landing" or "arr"'),  # type: ignore[arg-type]
        (lambda: gs.rigid_rocking(FRAME, gs.el_centro(), restitution=2.0), "a velocity ratio lies between 0 and 1"),
        (lambda: gs.rigid_rocking_many([FRAME] * 2, gs.el_centro(), [1.0, 2.0, 3.0]), "2 structures and 3 scales"),
        (lambda: gs.rigid_rocking_many(FRAME, gs.el_centro(), [1.0, math.inf]), "must be a finite number"),
        (lambda: gs.design(2.0), "give a slenderness between 0.005 and 0.9 rad"),
        (lambda: gs.Chain(1.0, 0.0, 1.0, 1.0), "k2 is 0.0; give a finite number above zero"),
        (lambda: gs.read_parameters("nope.json"), "give the parameters.json that Tuned.save wrote"),
    ],
)
def test_errors_are_value_errors_that_say_what_to_do(call: "object", words: str) -> None:
    with pytest.raises(ValueError) as caught:
        call()  # type: ignore[operator]
    assert words in str(caught.value) and "\n" not in str(caught.value)


def test_an_interrupt_ends_long_work_soon() -> None:
    """^C half a second into work of many seconds."""
    # a shell's background job ignores ^C
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    began = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        gs.validate(FRAME, gs.design(FRAME).springs(FRAME.mass, 61.3), synthetic=100_000)
    signal.signal(signal.SIGINT, before)
    assert time.monotonic() - began < 5.0


def test_other_threads_run_while_the_crate_works() -> None:
    counted = 0
    done = threading.Event()

    def count() -> None:
        nonlocal counted
        while not done.is_set():
            counted += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    gs.validate(FRAME, gs.design(FRAME).springs(FRAME.mass, 61.3), synthetic=40)
    before = counted
    done.set()
    thread.join()
    assert before > 5


def test_a_steady_vertical_acceleration_is_another_gravity() -> None:
    """Under a_v = kappa g the motion is that of time over sqrt(1 + kappa) and a ground acceleration over 1 + kappa."""
    record, kappa = gs.el_centro(), 0.21
    up = gs.Record(record.dt, np.full(len(record), kappa * 9.81))
    shaken = gs.rigid_rocking(FRAME, record, vertical=up)
    similar = gs.rigid_rocking(FRAME, gs.Record(record.dt * np.sqrt(1 + kappa), np.asarray(record.accel) / (1 + kappa)))
    assert shaken.outcome == similar.outcome == "rocked"
    # this history is sensitive beyond 20 s
    assert np.allclose(shaken.theta[:2000], similar.theta[:2000], atol=1e-9 * np.max(np.abs(similar.theta)))


def test_a_vertical_record_of_other_times_is_refused() -> None:
    with pytest.raises(ValueError, match="the vertical component has 10 samples of 0.01 s, the record 3995"):
        gs.rigid_rocking(FRAME, gs.el_centro(), vertical=gs.Record(0.01, np.zeros(10)))


def test_both_models_take_a_vertical_motion() -> None:
    record = gs.el_centro().truncated(10.0)
    up = gs.Record(record.dt, np.roll(record.accel, 311))
    springs = gs.design(FRAME).springs(FRAME.mass, math.hypot(61.0, 6.1))
    shaken = gs.simulate(FRAME, springs, record, vertical=up)
    assert np.array_equal(shaken.housner.theta, gs.rigid_rocking(FRAME, record, vertical=up).theta)
    assert np.array_equal(shaken.u, gs.simulate(FRAME, springs, record.with_vertical(up)).u)
    apart = np.sqrt(np.sum((shaken.u - shaken.housner.u) ** 2) / np.sum(shaken.housner.u**2))
    moved = np.sqrt(np.sum((shaken.u - gs.simulate(FRAME, springs, record).u) ** 2) / np.sum(shaken.u**2))
    assert apart < 0.005 < moved
    still = gs.Record(record.dt, np.zeros(len(record)))
    assert np.array_equal(gs.simulate(FRAME, springs, record, vertical=still).u, gs.simulate(FRAME, springs, record).u)
    with pytest.raises(ValueError, match="vertical component, which is not judged"):
        gs.validate(FRAME, springs, [record.with_vertical(up)])


def test_a_file_with_a_vertical_component_gives_it() -> None:
    file = ROOT / "tests/records/20161113_110259_WTMC_20.V2A"
    record = gs.read_record(file, component=332, vertical="auto")
    assert record.vertical is not None and len(record.vertical) == len(record)
    assert record.vertical.pga_g > 0.5 and gs.read_record(file, component=332).vertical is None
    half = record.scaled(0.5).vertical
    assert half is not None and half.pga_g == pytest.approx(0.5 * record.vertical.pga_g, rel=1e-14)
