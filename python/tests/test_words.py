"""What is said names arguments, not options of the program, and leaves names of files as they are."""

import copy
import pickle
from pathlib import Path
from typing import Any

import numpy as np
import pytest

import groundspring as gs

BLOCK = gs.Structure.block(2.0, 0.5, 1e3)
RECORD = gs.el_centro().truncated(2.0)
SINE = 0.5 * np.sin(np.arange(100) / 5.0)


@pytest.mark.parametrize(
    "name",
    [
        "site--out.txt",
        "tuning.v2/eq--baseline.at2",
        "AKBMR--n.1000hyfh",
        "my --dt file.txt",
        "--units.txt",
        "tune run.csv",
        "a --max-hz 10 b.txt",
    ],
)
def test_a_name_stays_as_it_is(name: str, tmp_path: Path) -> None:
    with pytest.raises(ValueError, match="cannot be read") as missing:
        gs.read_record(name)
    assert str(missing.value).startswith(f"{name}: cannot be read")
    with pytest.raises(ValueError) as parameters:
        gs.read_parameters(name)
    assert name in str(parameters.value)
    # that ending has a header of its own
    file = tmp_path / name.replace(".at2", ".csv")
    file.parent.mkdir(exist_ok=True)
    file.write_text("0.1\n-0.2\n0.1\n")
    with pytest.raises(ValueError) as no_step:
        gs.read_record(file, units="g")
    assert str(no_step.value) == f"{file}: the time step is not in the file; pass dt=seconds"
    with pytest.raises(ValueError) as no_unit:
        gs.read_record(file, dt=0.01)
    units = 'units="g", "m/s2", "cm/s2", "mm/s2", "mg", "%g", "ft/s2", "in/s2" or "mGal"'
    assert str(no_unit.value) == f"{file}: the unit of acceleration is not in the file; pass {units}"
    with pytest.raises(ValueError) as bad_sample:
        gs.Record(0.01, [0.1, np.nan], name)
    assert name in str(bad_sample.value)
    with pytest.warns(gs.GroundspringWarning) as strong:
        gs.Record(0.01, SINE * 20, name, units="g")
    assert all(name in str(warning.message) for warning in strong)


def test_files_of_a_folder_keep_their_names(tmp_path: Path) -> None:
    (tmp_path / "eq --baseline 1.csv").write_text("time (s),acc (g)\n0.00,0.1\n0.01,-0.1\n0.09,0.1\n")
    springs = gs.tune(BLOCK, RECORD, accuracy=0.01).springs
    with pytest.raises(ValueError) as uneven:
        gs.validate(BLOCK, springs, tmp_path)
    said = str(uneven.value)
    assert "/eq --baseline 1.csv, line " in said and said.endswith("printed coarsely pass dt=")


def test_an_argument_of_another_kind_is_told_by_its_name() -> None:
    calls: list[tuple[Any, str]] = [
        (lambda: gs.Record("0.01", SINE), "dt is '0.01', a str; give a number, the time step in s"),  # type: ignore[arg-type]
        (lambda: gs.Record(SINE, 0.01), "dt is an ndarray; give a number, the time step in s"),  # type: ignore[arg-type]
        (lambda: gs.Structure.block("1.7", 0.5, 310.0), "height is '1.7', a str; give a number, m"),  # type: ignore[arg-type]
        (lambda: gs.Structure.aframe(1.7, 0.5, None), "mass is None, a NoneType; give a number, kg"),  # type: ignore[arg-type]
        (lambda: gs.rocking([BLOCK, "x"], RECORD), "item 1 is 'x', a str; give a Structure, or a list of them"),  # type: ignore[list-item]
        (lambda: gs.rocking(BLOCK, "x"), "the argument is 'x', a str; give a Record, or a list of them"),  # type: ignore[arg-type]
        (
            lambda: gs.validate(BLOCK, gs.design(BLOCK.alpha, 0.75, 100.0).springs(1e3, 1.0), ["a.txt"]),  # type: ignore[list-item]
            "records[0] is 'a.txt', a str; give Records (read_record makes one of a file), or the path of a folder",
        ),
    ]
    for call, words in calls:
        with pytest.raises(TypeError) as caught:
            call()
        assert str(caught.value) == words


def test_impossible_lengths_are_refused_as_they_were_given() -> None:
    for duration in (-1.0, 0.0, float("nan")):
        with pytest.raises(ValueError, match="truncated: duration is .*; give seconds greater than zero"):
            RECORD.truncated(duration)
    assert RECORD.truncated(1e9) == RECORD and len(RECORD.truncated(1e-9)) == 1
    with pytest.raises(ValueError, match=r"Structure.block: height is -1.7; give a finite number greater than zero"):
        gs.Structure.block(-1.7, 0.5, 310.0)


def test_doubtful_structures_and_springs_are_warned_of() -> None:
    with pytest.warns(gs.GroundspringWarning) as told:
        millimetres = gs.Structure.block(1700.0, 500.0, 310.0)
    said = [str(warning.message) for warning in told]
    assert len(said) == 2 and all(text.startswith("Structure.block: ") for text in said)
    assert "no structure 1700 m high was ever built" in said[0] and "a mean density of" in said[1]
    # told once
    assert pickle.loads(pickle.dumps(millimetres)) == copy.copy(millimetres) == millimetres
    light, heavy = gs.Structure.block(1.7, 0.5, 310.0), gs.Structure.block(1.7, 0.5, 3100.0)
    springs = gs.tune(light, RECORD, accuracy=0.01).springs
    words = r"the springs are for a structure of 310 kg, this one has 3100 kg; give those of gs.tune\(structure\)"
    with pytest.warns(gs.GroundspringWarning, match="simulate: " + words):
        gs.simulate(heavy, springs, RECORD)
    with pytest.warns(gs.GroundspringWarning, match="validate: " + words):
        gs.validate(heavy, springs, [RECORD])
    gs.simulate(light, springs, RECORD)


def test_columns_vertical_rows_and_outcomes(tmp_path: Path) -> None:
    table = tmp_path / "three.csv"
    table.write_text("time (s),H1 (g),H2 (g)\n0.00,0.1,0.2\n0.01,-0.1,-0.2\n0.02,0.0,0.0\n0.03,0.0,0.0\n")
    by_number, by_name = gs.read_record(table, column=3), gs.read_record(table, column="H2")
    assert by_number.pga_g == by_name.pga_g == pytest.approx(0.2, rel=1e-15)
    with pytest.raises(ValueError, match=r"choose the acceleration with column=, a number or a name \(column 2"):
        gs.read_record(table)
    with pytest.raises(ValueError, match="give component or column, not both"):
        gs.read_record(table, column=3, component="H1")
    up = 0.1 * np.ones(len(RECORD))
    shaken = RECORD.with_vertical(up)
    assert shaken == RECORD.with_vertical(gs.Record(RECORD.dt, up, "up"))
    assert shaken.vertical is not None and np.array_equal(shaken.vertical.accel, up)
    with pytest.raises(ValueError, match="up: an array of 2 dimensions"):
        RECORD.with_vertical(np.ones((2, 3)))
    many = gs.rigid_rocking_many(BLOCK, gs.el_centro(), [0.001, 1.0, 9.0])
    assert many.outcome == [many[i].outcome for i in range(3)] and set(many.outcome) >= {"never_lifted", "overturned"}
