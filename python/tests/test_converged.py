"""`Stepper.converged`: when a force is the structure's, what it asks for, and what it repeats."""

import warnings
from typing import Any

import numpy as np
import pytest
from test_feet import soft_frame

import groundspring as gs
from groundspring.opensees import Convergence, FeetHistory, Stepper, add_feet, springs_for
from groundspring.opensees._converged import TWIN_NAME, Refined

RECORD = gs.el_centro().truncated(0.2)
NAMES = ("as asked", "accuracy halved", "longest step halved", "springs twice", "springs four times", TWIN_NAME)


def table(
    uplifts: tuple[float, ...], roofs: tuple[float, ...], limit: float = 0.01, lifts: float = 1e-3
) -> tuple[Convergence, FeetHistory]:
    """Of these, and a moment that changes by 1 %."""
    moments = (10.0, 10.0, 10.0, 10.0, 10.1, 10.0)
    rows = [
        Refined(name, 1, values) for name, values in zip(NAMES, zip(uplifts, roofs, moments, strict=True), strict=True)
    ]
    history = FeetHistory((1,), np.zeros(1), *np.zeros((10, 1, 1)))
    return Convergence(["uplift", "roof"], rows, ["moment"], history, limit, lifts), history


STEADY = (1.0,) * 6


def test_no_force_is_the_structures_where_a_displacement_does_not_converge() -> None:
    found, history = table(STEADY, (1.0, 1.0, 1.0, 1.005, 1.02, 1.0))
    assert not found.converged and found.own_forces == () == history.own_forces
    assert found.force_changes == history.force_changes == pytest.approx({"moment": 0.01})
    displacements, forces = str(found).splitlines()[-2:]
    why = "roof changes by 2 % with springs four times"
    assert (
        displacements == f"displacements: they do NOT converge: {why}, limit 1 %; give springs_for a smaller accuracy"
    )
    words = f"forces: none is the structure's, as displacements do not converge ({why}): moment (1.0 %)"
    assert forces == words and repr(history).endswith(f"{words})") and why in found._repr_html_()
    assert "NOT converged, largest change 2.00%, limit 1.00%" in repr(found) and repr(found).endswith(
        "structure: none)"
    )
    # what may change by more is asked for less
    found, history = table(STEADY, (1.0, 1.0, 1.0, 1.005, 1.02, 1.0), limit=0.03)
    assert found.converged and found.own_forces == ("moment",) == history.own_forces
    assert "displacements: they converge: at most 2 % (roof), limit 3 %" in str(found)
    assert repr(found).endswith("forces of the structure: moment)")


@pytest.mark.parametrize(
    ("roofs", "words"),
    [
        ((1.0, 1.02, 1.0, 1.0, 1.0, 1.0), "with accuracy halved, limit 1 %; give Stepper a smaller accuracy"),
        ((1.0, 1.0, 0.98, 1.0, 1.0, 1.0), "with longest step halved, limit 1 %; give Stepper a smaller longest"),
        ((1.0, 1.0, 1.0, 1.0, 1.2, 1.0001), "changes them by 100 millionths: the motion is sensitive"),
        ((1.0, 1.0, 1.0, 1.0, 1.0, 1.02), "roof changes by 2 % under a ground a millionth more, limit 1 %"),
    ],
)
def test_what_to_refine_is_said(roofs: tuple[float, ...], words: str) -> None:
    found, _ = table(STEADY, roofs)
    assert words in str(found) and found.own_forces == ()


def test_the_uplift_of_feet_that_hardly_lift_is_that_of_springs() -> None:
    """They sink into the springs: half as deep into springs twice as stiff."""
    sunk = (-2e-6, -2e-6, -2e-6, -1e-6, -5e-7, -2e-6)
    found, _ = table(sunk, STEADY)
    assert found.converged and found.changes()["springs twice"]["uplift"] == pytest.approx(1e-3)
    assert "; no foot lifts by 0.001 m, and changes of the uplift are shares of that" in str(found)
    found, _ = table(tuple(-1e3 * x for x in sunk), STEADY)
    assert not found.converged and found.changes()["springs twice"]["uplift"] == pytest.approx(-0.5)


def standing(ops: Any, gravity: bool = True) -> Stepper:
    """A frame whose feet are tied."""
    ops.wipe()
    nodes = soft_frame(ops, tied=True)
    stepper = Stepper(ops, add_feet(ops, nodes, springs_for(ops, nodes)))
    if gravity:
        stepper.gravity()
    return stepper


def test_the_limit_is_the_accuracy_asked_and_the_roof_is_looked_at_unasked(ops: Any) -> None:
    def build() -> None:
        ops.wipe()
        soft_frame(ops, tied=True)

    stepper = standing(ops)
    with pytest.warns(gs.GroundspringWarning, match="converged: duration is 1 s, the record ends at 0.2 s") as caught:
        found = stepper.converged(RECORD, build, forces={"moment": lambda: ops.eleForce(1)[5]}, duration=1.0)
    assert len(caught) == 1 and caught[0].filename == __file__
    assert found.limit == 0.01 and found.names == ("uplift", "node 101 sideways")
    assert found.rows[0].values[1] > 1e-4 and "moment" in found.own_forces
    assert found.lifts == pytest.approx(stepper.rise / 10.0)


def test_what_a_run_cannot_begin_from_is_refused(ops: Any) -> None:
    def build(feet: int = 2) -> None:
        ops.wipe()
        soft_frame(ops, feet, tied=True)

    def lighter() -> None:
        build()
        ops.mass(101, 10e3, 10e3, 0.0)

    with pytest.raises(
        ValueError, match="gravity.. of this stepper has not been called, .*: call stepper.gravity.. first"
    ):
        standing(ops, gravity=False).converged(RECORD, build)
    assert ops.getTime() == 0.0
    wrong: list[tuple[Any, type[Exception], str]] = [
        (None, TypeError, "build is a NoneType; give a function without arguments"),
        (
            ops.wipe,
            ValueError,
            "build makes no node 1, on which a foot of the stepper stands; .* returns is not looked at",
        ),
        (lambda: standing(ops), ValueError, "build leaves feet in the model; .* what build returns is not looked at"),
        (lambda: None, ValueError, "build leaves feet in the model"),
        (lighter, ValueError, r"nodes have 3.2e\+04 kg, those of the stepper's model have 4.2e\+04 kg"),
    ]
    for function, kind, words in wrong:
        with pytest.raises(kind, match=f"converged: .*{words}"):
            standing(ops).converged(RECORD, function)
    stepper = standing(ops)
    for options, error, words in (
        ({"quantities": [build]}, TypeError, "quantities is a list; give functions by name"),
        ({"forces": build}, TypeError, "forces is a function; give functions by name"),
        ({"after": 3}, TypeError, "after is a int; give a function, or leave it out"),
        ({"scale": "2"}, ValueError, "scale is '2'; give a finite number"),
        ({"quantities": {"x": lambda: ops.nodeDisp(999, 1)}}, ValueError, "'x' is no number .* knows no such node"),
    ):
        with pytest.raises(error, match=f"converged: {words}"):
            stepper.converged(RECORD, build, **options)  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="converged: record is a list"):
        stepper.converged([1.0], build)  # type: ignore[arg-type]


def test_what_has_settled_after_gravity_is_repeated_by_after(ops: Any) -> None:
    def build() -> None:
        ops.wipe()
        soft_frame(ops, tied=True)

    def load(stepper: Stepper) -> None:
        ops.timeSeries("Linear", 5)
        ops.pattern("Plain", 5, 5)
        ops.load(101, 0.0, -1e5, 0.0)
        stepper.settle()

    stepper = standing(ops)
    load(stepper)
    with pytest.raises(ValueError, match="settle.. of this stepper has been called since gravity"):
        stepper.converged(RECORD, build)
    history = stepper.run(RECORD)
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # its first run is the history
        found = stepper.converged(RECORD, build, after=load)
    assert np.array_equal(found.history.vertical[0], history.vertical[0])
    assert history.vertical[0].sum() == pytest.approx(42e3 * gs.GRAVITY + 1e5, rel=1e-6)
