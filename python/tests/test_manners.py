"""What one expects of a Python package: pickles, equality, tables, wrong arrays, words, ^C."""

import copy
import os
import pickle
import signal
import threading
import time
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import groundspring as gs

FRAME = gs.Structure.aframe(61.0, 12.2, 680.1e3)
BLOCK = gs.Structure.block(2.0, 0.46, 1000.0, restitution=0.9)
RECORD = gs.el_centro().truncated(20.0)
SPRINGS = gs.design(FRAME).springs(FRAME.mass, 61.3)
OBJECTS = {
    "record": RECORD,
    "record with a vertical one": RECORD.with_vertical(gs.Record(RECORD.dt, np.roll(RECORD.accel, 311))),
    "a-frame": FRAME,
    "block": BLOCK,
    "springs": SPRINGS,
    "unit": SPRINGS.vertical,
    "design": gs.design(BLOCK),
    "unit of a design": gs.design(BLOCK).horizontal,
    "history": gs.rigid_rocking(BLOCK, RECORD, scale=2.0),
    "histories": gs.rigid_rocking_many(BLOCK, RECORD, [0.2, 1.0, 3.0]),
}


@pytest.mark.parametrize("name", OBJECTS)
def test_what_is_pickled_or_copied_is_equal(name: str) -> None:
    one = OBJECTS[name]
    for again in (pickle.loads(pickle.dumps(one)), copy.copy(one), copy.deepcopy(one)):
        assert again == one and hash(again) == hash(one) and type(again) is type(one)
    assert one != "something else" and not (one == 1.0)
    assert "\n" not in repr(one)


def test_equal_numbers_make_equal_objects() -> None:
    same = gs.Record(RECORD.dt, np.array(RECORD.accel), RECORD.name)
    assert same == RECORD and hash(same) == hash(RECORD) and len({same, RECORD}) == 1
    assert same != RECORD.scaled(1.001) != RECORD and RECORD != OBJECTS["record with a vertical one"]
    assert gs.rigid_rocking(BLOCK, RECORD) == gs.rigid_rocking_many(BLOCK, RECORD)[0] != gs.rigid_rocking(FRAME, RECORD)


def test_what_is_computed_pickles_as_what_it_came_from() -> None:
    tuned = gs.tune(FRAME, RECORD, accuracy=0.01)
    again: gs.Tuned = pickle.loads(pickle.dumps(tuned))
    assert again.springs == tuned.springs and again.lines == tuned.lines
    for simulation in (tuned.histories, gs.simulate(FRAME, SPRINGS, RECORD.truncated(5.0), scale=1.5)):
        assert np.array_equal(pickle.loads(pickle.dumps(simulation)).u, simulation.u)
    found = gs.validate(FRAME, SPRINGS, synthetic=3, seed=7)
    assert pickle.loads(pickle.dumps(found)).summary == found.summary


def test_a_line_and_a_table_for_notebooks() -> None:
    tuned = gs.tune(FRAME, RECORD, accuracy=0.01)
    assert (
        repr(tuned).startswith("Tuned(Omega_n ") and "accuracy 0.01 reached" in repr(tuned) and "\n" not in repr(tuned)
    )
    assert str(tuned).splitlines()[1:] == tuned.lines
    shown = [
        tuned,
        tuned.histories,
        gs.rocking(BLOCK, RECORD),
        gs.validate(FRAME, SPRINGS, synthetic=2),
        *OBJECTS.values(),
    ]
    for one in shown:
        html = getattr(one, "_repr_html_", None)
        assert html is None or html().startswith("<table>")
    assert sum(hasattr(one, "_repr_html_") for one in shown) >= 9
    for plot in (
        RECORD.plot,
        OBJECTS["record with a vertical one"].plot,  # type: ignore[attr-defined]
        OBJECTS["history"].plot,  # type: ignore[attr-defined]
        SPRINGS.plot,
        tuned.plot,
    ):
        assert plot().get_ylabel()


def test_the_version_is_that_of_the_distribution() -> None:
    from importlib.metadata import version

    assert gs.__version__ == version("groundspring")


WRONG: dict[str, tuple[Any, str]] = {
    "two rows": (np.zeros((3, 2)), "an array of 2 dimensions, shape (3, 2); give one row of numbers"),
    "a number": (np.float64(1.0), "an array of 0 dimensions"),
    "masked": (np.ma.masked_array([1.0, 2.0], [False, True]), "a masked array; fill what is masked"),
    "complex": (np.array([1j]), "complex numbers; give real ones"),
    "text": (["a"], "give numbers"),
    "ragged": ([[1.0], [1.0, 2.0]], "not a row of numbers"),
    "objects": ([None], "an array of object"),
}


@pytest.mark.parametrize("name", WRONG)
def test_what_is_no_row_of_numbers_is_refused_with_what_to_pass(name: str) -> None:
    wrong, words = WRONG[name]
    calls = [lambda: gs.Record(0.01, wrong)]
    if name != "a number":
        calls += [
            lambda: gs.rigid_rocking_many(BLOCK, RECORD, wrong),
            lambda: gs.frequency_response(wrong, 0.1, 2.0, 1.0),
        ]
    for call in calls:
        with pytest.raises(ValueError) as caught:
            call()
        assert words in str(caught.value) and "\n" not in str(caught.value) and "PyArray" not in str(caught.value)


def test_numbers_with_units_are_refused_and_units_are_named() -> None:
    class Quantity(np.ndarray):
        units = "m/s**2"

    with pytest.raises(ValueError, match="accel: numbers with units of their own; give plain numbers"):
        gs.Record(0.01, np.array([1.0, 2.0]).view(Quantity))
    assert gs.Record(0.01, [0.1, -0.2], units="g").pga == pytest.approx(0.2 * gs.GRAVITY, rel=1e-15)
    assert gs.Record(0.01, [10, 20], units="cm/s2") == gs.Record(0.01, [0.1, 0.2])
    with pytest.raises(ValueError, match="unit 'furlong' is not known; use g, m/s2"):
        gs.Record(0.01, [0.1], units="furlong")
    assert len(gs.Record(0.01, np.ma.masked_array([1.0, 2.0], [False, False]))) == 2


def test_a_scale_that_is_none_is_blamed_itself() -> None:
    for call in (gs.rigid_rocking_many, gs.rocking):
        with pytest.raises(ValueError, match=r"^scales\[1\] is nan; every scale must be a finite number$"):
            call(BLOCK, RECORD, [1.0, np.nan])


def test_a_scale_of_zero_is_refused_as_the_program_does() -> None:
    for call in (lambda: gs.rigid_rocking(BLOCK, RECORD, scale=0.0), lambda: gs.simulate(FRAME, SPRINGS, RECORD, 0.0)):
        with pytest.raises(ValueError, match=r"^scale is 0; nothing would move"):
            call()


def test_numbers_that_no_record_has_are_doubted() -> None:
    """60 m/s2 is 6.116 g. A slow push is none of these: 3 m/s2 for 2 s makes 6 m/s."""
    to_and_fro = np.tile([1.0, -1.0], 20)
    with pytest.warns(gs.GroundspringWarning, match="a peak of 6.116 g, above 5 g; check the unit") as told:
        gs.Record(0.01, 60.0 * to_and_fro)
    assert [one.filename for one in told] == [__file__]
    with pytest.warns(gs.GroundspringWarning, match="a time step of 0.1 s"):
        gs.Record(0.1, 0.1 * to_and_fro)
    gs.Record(0.01, np.repeat([3.0, -3.0], 200))
    gs.Record(0.01, to_and_fro)


def test_messages_speak_python(tmp_path: Path) -> None:
    """No option and no command of the program, but the argument and the function that are the same."""
    said = []
    columns = tmp_path / "a.txt"
    columns.write_text("0.1\n0.2\n0.1\n")
    several = gs.Structure.aframe
    calls: list[Any] = [
        lambda: gs.read_record(columns),
        lambda: gs.read_record(columns, dt=0.01),
        lambda: gs.Record(0.01, [1e4]),
        lambda: gs.tune(FRAME, gs.Record(0.01, [0.0, 0.1]), method="arr"),
        lambda: gs.read_record(
            Path(__file__).parents[2] / "tests/records/20161113_110259_WTMC_20.V2A", component="N99"
        ),
        lambda: gs.tune(FRAME, RECORD, max_hz=1.0, max_settlement=1e-9),
        lambda: several(61.0, -1.0, 1.0),
    ]
    for call in calls:
        with pytest.raises(ValueError) as caught:
            call()
        said.append(str(caught.value))
    with pytest.warns(gs.GroundspringWarning) as told:
        gs.read_record(Path(__file__).parents[2] / "tests/records/20161113_110259_WTMC_20.V2A")
        gs.tune(FRAME, RECORD, max_hz=160.0)
        gs.tune(gs.Structure.block(2.0, 0.4, 1e3), RECORD, accuracy=0.01)
    said += [str(warning.message) for warning in told]
    assert [
        text for text in said if "--" in text or "tune " in text.replace("groundspring.tune ", "") or "tuning." in text
    ] == []
    assert any("component=" in text for text in said) and any("dt=" in text for text in said)


@pytest.mark.parametrize("make", [gs.earthquake_records, gs.synthetic_records])
def test_an_interrupt_ends_the_making_of_records(make: Any) -> None:
    interrupted(lambda: make(FRAME, 10_000_000))


def test_an_interrupt_ends_many_histories() -> None:
    interrupted(lambda: gs.rocking(BLOCK, gs.el_centro(), np.linspace(0.5, 1.5, 1_000_000)))


def interrupted(work: Any) -> None:
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    began = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        work()
    signal.signal(signal.SIGINT, before)
    assert time.monotonic() - began < 3.0


def test_a_table_of_many_is_that_of_each_history() -> None:
    records = [RECORD, gs.Record(0.005, np.roll(RECORD.accel, 100), "rolled")]
    done: list[int] = []
    table = gs.rocking([BLOCK, FRAME], records, [0.5, 1.0, 3.0], progress=done.append)
    assert len(table) == 12 == sum(done)
    for row in range(12):
        structure, record = (BLOCK, FRAME)[table["structure"][row]], records[table["record_index"][row]]
        one = gs.rigid_rocking_many(structure, record, table["scale"][row])[0]
        assert (table["record"][row], table["outcome"][row]) == (record.name, one.outcome)
        assert table["impacts"][row] == len(one.impacts) and table["peak_ratio"][row] == one.peak_ratio
        assert table["peak_theta"][row] == np.abs(one.theta).max()
        assert table["peak_u"][row] == pytest.approx(np.abs(one.u).max(), rel=1e-12, abs=1e-15)
        assert table["peak_rate"][row] == np.abs(one.rate).max()
        overturned = np.nan if one.overturned is None else one.overturned
        assert np.array_equal(table["overturned_time"][row], overturned, equal_nan=True)
    assert (
        list(table["scale"][:3]) == [0.5, 1.0, 3.0]
        and list(table["structure"]) == [0] * 3 + [1] * 3 + [0] * 3 + [1] * 3
    )
    with pytest.raises(KeyError, match='there is no column "nothing"; there are structure, record'):
        table["nothing"]
    with pytest.raises(ValueError, match="2 records and 3 vertical ones"):
        gs.rocking(BLOCK, records, vertical=[RECORD] * 3)
    up = gs.Record(RECORD.dt, np.roll(RECORD.accel, 311))
    shaken = gs.rocking(BLOCK, RECORD, vertical=up)
    assert shaken["peak_ratio"][0] == gs.rigid_rocking(BLOCK, RECORD, vertical=up).peak_ratio


def test_tables_are_those_of_pandas_polars_and_arrow() -> None:
    import polars
    import pyarrow

    table = gs.rocking([BLOCK, FRAME], RECORD, np.linspace(0.5, 3.0, 50))
    frame = table.to_pandas()
    assert list(frame) == table.columns and len(frame) == 100
    for other in (pyarrow.table(table).to_pandas(), polars.DataFrame(table).to_pandas(), table.to_polars().to_pandas()):
        assert other.astype(frame.dtypes.to_dict()).equals(frame)
    kept = polars.DataFrame(table)
    del table  # what was taken out of it stays
    assert kept["peak_theta"].to_list() == frame["peak_theta"].tolist()
    assert (
        pickle.loads(pickle.dumps(gs.rocking(BLOCK, RECORD))).to_pandas().equals(gs.rocking(BLOCK, RECORD).to_pandas())
    )
    many = gs.rigid_rocking_many(BLOCK, RECORD, [0.2, 1.0, 3.0])
    assert many.to_pandas()["peak_ratio"].tolist() == many.peak_ratio.tolist()
