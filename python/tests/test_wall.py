"""The post-tensioned wall of example (f), and a frame on soft columns, on the springs that springs_for gives."""

import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import load
from test_feet import soft_frame

import groundspring as gs
from groundspring.opensees import Convergence, FeetHistory, Stepper, add_feet, springs_for
from groundspring.opensees._converged import TWIN_NAME, Refined

ROOT = Path(__file__).parent.parent.parent
wall: Any = load(ROOT / "python" / "examples" / "rocking_wall.py")


def kaikoura() -> gs.Record:
    """15 s about the strongest shaking at Te Mara Farm, 2016."""
    record = gs.read_record(ROOT / "tests" / "records" / "20161113_110259_WTMC_20.V2A", component=332)
    peak = int(np.argmax(np.abs(record.accel)))
    begin, end = peak - round(8.0 / record.dt), peak + round(7.0 / record.dt)
    return gs.Record(record.dt, record.accel[begin:end], "Kaikoura")


RECORDS = {"El Centro x 2": gs.el_centro().truncated(15.0).scaled(2.0), "Kaikoura": kaikoura()}


@pytest.mark.parametrize("name", RECORDS)
def test_the_walls_uplift_does_not_move_on_eight_times_stiffer_springs(name: str, ops: Any) -> None:
    measured, stiffer = (wall.shake(RECORDS[name], factor) for factor in (1.0, 8.0))
    uplift, roof = measured.feet.uplift.max(), np.abs(measured.roof).max()
    print(uplift, roof, measured.stepper.report())
    assert stiffer.feet.uplift.max() == pytest.approx(uplift, rel=0.02) and uplift > 5e-3
    assert np.abs(stiffer.roof).max() == pytest.approx(roof, rel=0.02)
    assert measured.stepper.steps.taken <= 60_000 and measured.stepper.steps.late == 0


def two_storeys(ops: Any) -> list[int]:
    """Example (b), whose feet are not tied."""
    load(ROOT / "python" / "examples" / "two_storey_frame.py").build()
    return [1, 2]


FRAMES = {"two storeys": two_storeys, "three tied feet": lambda ops: soft_frame(ops, 3, tied=True)}


@pytest.mark.parametrize("name", RECORDS)
@pytest.mark.parametrize("frame", FRAMES)
def test_the_same_of_frames_on_soft_columns(name: str, frame: str, ops: Any) -> None:
    uplifts = []
    for factor in (1.0, 8.0):
        ops.wipe()
        nodes = FRAMES[frame](ops)
        stepper = Stepper(
            ops, add_feet(ops, nodes, springs_for(ops, nodes).stiffer(factor)), longest=RECORDS[name].dt / 4
        )
        stepper.gravity()
        uplifts.append(stepper.run(RECORDS[name]).uplift.max())
        assert stepper.steps.taken <= 60_000
    print(uplifts)
    assert uplifts[1] == pytest.approx(uplifts[0], rel=0.02) and uplifts[0] > 5e-3


def wall_of_quads(ops: Any, footing: float = 2e3) -> list[int]:
    """A wall of plane elements on a sole of beams, 6 m by 2 m by 0.3 m: its toes."""
    height, width, thick, across, up = 6.0, 2.0, 0.3, 4, 8
    dx, dy = width / across, height / up
    ops.model("basic", "-ndm", 2, "-ndf", 2)
    for j in range(up + 1):
        for i in range(across + 1):
            ops.node(1 + i + j * (across + 1), i * dx, j * dy)
            cells = (0.5 if i in (0, across) else 1.0) * (0.5 if j in (0, up) else 1.0)
            mass = 2400.0 * thick * dx * dy * cells
            ops.mass(1 + i + j * (across + 1), mass, mass)
    ops.nDMaterial("ElasticIsotropic", 1, 30e9, 0.2)
    for j in range(up):
        for i in range(across):
            a, b = 1 + i + j * (across + 1), 1 + i + (j + 1) * (across + 1)
            ops.element("quad", 1 + i + j * across, a, a + 1, b + 1, b, thick, "PlaneStress", 1)
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.geomTransf("Linear", 1)
    for i in range(across + 1):
        ops.node(1001 + i, i * dx, 0.0)
        ops.mass(1001 + i, footing / (across + 1), footing / (across + 1), 0.0)
        ops.equalDOF(1001 + i, 1 + i, 1, 2)
        if i > 0:
            section = thick * 0.5, 30e9, thick * 0.5**3 / 12.0
            ops.element("elasticBeamColumn", 1000 + i, 1000 + i, 1001 + i, *section, 1)
    ops.rayleigh(0.0, 0.0, 1e-4, 0.0)
    return [1001, 1001 + across]


def test_a_wall_of_plane_elements_stands_on_a_sole_of_beams(ops: Any) -> None:
    uplifts = []
    for factor in (1.0, 8.0):
        ops.wipe()
        nodes = wall_of_quads(ops)
        feet = add_feet(ops, nodes, springs_for(ops, nodes).stiffer(factor))
        stepper = Stepper(ops, feet, constraints="Transformation")
        stepper.gravity()
        assert stepper.weight == pytest.approx(9.81 * (2400.0 * 6.0 * 2.0 * 0.3 + 2e3), rel=1e-6)
        uplifts.append(stepper.run(RECORDS["El Centro x 2"].truncated(2.5)).uplift.max())
        print(uplifts, stepper.report())
        assert stepper.steps.taken <= 20_000 and stepper.steps.late == 0
    assert uplifts[1] == pytest.approx(uplifts[0], rel=0.02) and uplifts[0] > 5e-3


def test_the_wall_begins_to_lift_at_the_acceleration_of_statics(ops: Any) -> None:
    """Under a ramp: sum m_i h_i a = (W + T) b about a toe, the bars without a force yet."""
    rate = 0.4  # m/s3
    t = np.arange(0.0, 20.0, 0.01)
    response = wall.shake(gs.Record(0.01, -rate * t, "ramp"))
    weight, pull = response.stepper.weight, response.stepper.prestress
    assert weight == pytest.approx(9.81 * (4 * wall.FLOOR + 2 * wall.TOE), rel=1e-6)
    moment = wall.FLOOR * sum(wall.STOREY * i for i in range(1, 5))
    by_hand = (weight + pull) * wall.HALF / moment
    lifted = int(np.argmax(response.feet.gap.max(axis=1) > 1e-6))
    assert rate * t[lifted] == pytest.approx(by_hand, rel=0.02)
    assert (
        abs(response.bar[0]) < 1e-3
        and np.abs(response.bar[: lifted - 50]).max() < 0.02 * wall.BAR_AREA * wall.BAR_YIELD
    )


def test_the_wall_comes_back_and_its_bars_have_dissipated(ops: Any) -> None:
    response = wall.shake(wall.with_rest(RECORDS["El Centro x 2"], 5.0))
    loop = float(np.sum(0.5 * (response.bar[1:] + response.bar[:-1]) * np.diff(response.stretch)))
    yielded = wall.BAR_AREA * wall.BAR_YIELD
    assert np.abs(response.bar).max() > yielded and loop > yielded * response.stretch.max()
    assert np.abs(response.roof[-100:]).max() < 0.02 * np.abs(response.roof).max()


def test_what_is_put_in_with_the_length_of_the_unloaded_wall_is_told(ops: Any) -> None:
    wall.build()
    stepper = Stepper(ops, add_feet(ops, [wall.LEFT, wall.RIGHT], springs_for(ops, [wall.LEFT, wall.RIGHT])))
    stepper.gravity()
    ops.uniaxialMaterial("Steel02", 3, wall.BAR_YIELD, 200e9, 0.02, 18.0, 0.925, 0.15)
    ops.element("corotTruss", 70, 40, 30, wall.BAR_AREA, 3)
    with pytest.warns(
        gs.GroundspringWarning, match=r"element 70 \(CorotTruss\) was put in after gravity\(\) and carries 449"
    ):
        stepper.run(gs.Record(0.01, np.zeros(3)))


def test_halved_steps_and_springs_come_as_a_table(ops: Any) -> None:
    record = RECORDS["El Centro x 2"].truncated(4.0)
    wall.build()
    nodes = [wall.LEFT, wall.RIGHT]
    stepper = Stepper(ops, add_feet(ops, nodes, springs_for(ops, nodes)), longest=record.dt / 4)
    stepper.gravity()
    wall.dissipaters()
    history = stepper.run(record)
    assert "forces: not checked" in repr(history) and history.force_changes is None
    quantities, forces = {"roof": lambda: ops.nodeDisp(wall.TOP, 1)}, {"tendon": wall.tendon}
    found = stepper.converged(record, wall.build, quantities, forces=forces, after=wall.dissipaters)
    print(found)
    assert found.names == ("uplift", "roof") and len(found.rows) == 6
    assert found.largest < 0.02 and found.sensitivity < 1e-4
    # the tendon's force is the structure's; those of the ground in a landing grow with the springs
    assert (
        found.forces == ("tendon", "vertical at a foot", "horizontal at a foot")
        and found.force_changes["tendon"] < 0.02
    )
    assert (
        "forces: the structure's: tendon (" in str(found).splitlines()[-1]
        and "vertical at a foot" in found._repr_html_()
    )
    assert history.force_changes == found.force_changes == found.history.force_changes
    assert "; forces: the structure's: tendon (" in repr(history)
    assert found.to_pandas().shape == (6, 11) and "\n" not in repr(found) and found._repr_html_().startswith("<table>")
    assert math.isclose(found.rows[0].values[0], found.to_pandas()["uplift"].iloc[0])
    with pytest.raises(ValueError, match="a quantity is not a function"):
        stepper.converged(record, wall.build, {"roof": 1.0})  # type: ignore[dict-item]
    with pytest.raises(ValueError, match="the name 'roof' is there already"):
        stepper.converged(record, wall.build, quantities, forces=quantities)


@pytest.mark.parametrize(
    ("quantity", "words"),
    [
        (lambda: math.nan, "converged: 'M' is nan at t = .* s; a quantity is a finite number"),
        (lambda: None, "converged: 'M' is no number at t = .* s: "),
        (lambda: 0.0, "converged: 'M' is zero throughout, there is nothing to compare"),
    ],
)
def test_what_is_no_number_or_zero_is_not_certified(quantity: Any, words: str, ops: Any) -> None:
    record = RECORDS["El Centro x 2"].truncated(0.2)
    wall.build()
    nodes = [wall.LEFT, wall.RIGHT]
    stepper = Stepper(ops, add_feet(ops, nodes, springs_for(ops, nodes)))
    stepper.gravity()
    with pytest.raises(ValueError, match=words):
        stepper.converged(record, wall.build, forces={"M": quantity})


def test_another_structure_is_told_from_that_of_the_history(ops: Any) -> None:
    record = RECORDS["El Centro x 2"].truncated(2.5)
    wall.build()
    nodes = [wall.LEFT, wall.RIGHT]
    stepper = Stepper(ops, add_feet(ops, nodes, springs_for(ops, nodes)))
    stepper.gravity()
    wall.dissipaters()
    history = stepper.run(record)
    with pytest.warns(gs.GroundspringWarning, match="its first run is not the history that run gave: largest uplift"):
        stepper.converged(record, wall.build, forces={"tendon": wall.tendon})  # `after` is forgotten
    assert history.force_changes is None
    with pytest.raises(ValueError, match="run: scale is nan; give a finite number"):
        stepper.run(record, scale=math.nan)


def test_a_force_that_moves_with_the_springs_is_not_the_structures() -> None:
    names = ("as asked", "accuracy halved", "longest step halved", "springs twice", "springs four times", TWIN_NAME)
    moments, shears = (10.0, 10.1, 10.2, 9.9, 10.49, 10.6), (5.0, 5.0, 5.0, 5.1, 5.25, 5.0)
    rows = [
        Refined(name, 1, values)
        for name, values in zip(names, zip((1.0,) * 6, moments, shears, strict=True), strict=True)
    ]
    history = FeetHistory((1,), np.zeros(1), *np.zeros((10, 1, 1)))
    assert "forces: not checked" in repr(history)
    found = Convergence(["uplift"], rows, ["moment", "shear"], history)
    # the ground that shakes by a millionth more is no refinement
    assert found.force_changes == pytest.approx({"moment": 0.049, "shear": 0.05})
    words = "forces: the structure's: moment (4.9 %); not the structure's, but of springs and steps: shear (5.0 %)"
    assert str(found).splitlines()[-1] == words and repr(history).endswith(f"{words})")
    assert found.largest == 0.0
