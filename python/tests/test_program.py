"""Springs for programs with fixed time steps, asked from Python."""

import json
import os
import pickle
import subprocess
from pathlib import Path

import pytest

import groundspring as gs

TUNE = os.environ.get("TUNE")
RECORD = gs.el_centro().truncated(8.0)
BLOCK = gs.Structure.block(2.6, 0.9, 2e3)
FRAME = gs.Structure.aframe(height=45.0, width=9.0, mass=3e5)
CASE = """[structure]
kind = "aframe"
height_m = 45.0
width_m = 9.0
mass_kg = 3e5
"""


@pytest.mark.skipif(TUNE is None, reason="the environment variable TUNE does not name the program")
def test_springs_for_a_program_are_those_of_tune_run(tmp_path: Path) -> None:
    (tmp_path / "case.toml").write_text(CASE)
    asked = ["--for", "opensees-even", "--step", "0.002", "--substeps", "8", "--duration", "8"]
    command = [str(TUNE), "run", "case.toml", *asked, "--no-report", "--no-front", "--quiet", "--out", "out"]
    subprocess.run(command, check=True, capture_output=True, cwd=tmp_path)
    tuned = gs.tune(FRAME, RECORD, program="opensees-even", step=0.002, substeps=8)
    assert tuned.program == json.loads((tmp_path / "out" / "parameters.json").read_text())["program"]
    tuned.save(tmp_path / "package", figures=False)
    decks = [(tmp_path / folder / "decks" / "model_even.py").read_bytes() for folder in ("out", "package")]
    assert decks[0] == decks[1]


def test_a_program_is_asked_by_its_name_or_its_integrator() -> None:
    tuned = gs.tune(FRAME, RECORD, integrator="trbdf2", step=0.004)
    program = tuned.program
    assert program is not None and tuned.parameters["program"] == program
    assert (program.get("for"), program["step_s"], program["integrator"]) == (None, 0.004, "trbdf2")
    assert any(line.startswith("springs for ") and "steps of 4 ms: " in line for line in tuned.lines)
    again = pickle.loads(pickle.dumps(tuned))
    assert again.program == program
    usual = gs.tune(FRAME, RECORD).program
    assert usual is not None and (usual["for"], usual["step_s"]) == ("sap2000", 0.001)


def test_springs_of_no_use_are_a_warning() -> None:
    with pytest.warns(gs.GroundspringWarning, match=r"steps of 4 ms .* are not to be used: .* give step="):
        gs.tune(BLOCK, RECORD, integrator="trbdf2", step=0.004)


@pytest.mark.parametrize(
    ("asked", "words"),
    [
        ({"program": "abaqus"}, r'^program is "abaqus"; give sap2000, etabs or .*: step= and integrator='),
        ({"step": 0.0}, r"^step is 0\.0; give a time step between 1e-6 and 0\.1 s"),
        ({"integrator": "wilson"}, r'^integrator is "wilson"; give newmark:GAMMA:BETA'),
        ({"program": "sap2000", "integrator": "trbdf2"}, r'^integrator is "trbdf2"; SAP2000 takes '),
        ({"substeps": 0}, r"^substeps is 0; give a power of two from 1 to 4096"),
        ({"substeps": 3}, r"^substeps is 3; give a power of two from 1 to 4096"),
    ],
)
def test_what_no_program_can_be_is_told(asked: dict[str, object], words: str) -> None:
    with pytest.raises(ValueError, match=words):
        gs.tune(BLOCK, RECORD, **asked)  # type: ignore[arg-type]
