"""What one gets wrong with a model of one's own, and is told: arguments of another kind, feet that cannot lift,
springs of another model, gravity that is missing."""

import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from test_feet import soft_frame

import groundspring as gs
from groundspring.opensees import Feet, FeetSprings, Stepper, add_feet, springs_for

RECORD = gs.el_centro().truncated(0.2)


def on_feet(ops: Any) -> tuple[Feet, FeetSprings]:
    nodes = soft_frame(ops)
    springs = springs_for(ops, nodes)
    return add_feet(ops, nodes, springs), springs


def test_a_slice_of_springs_is_for_the_feet_in_it(ops: Any) -> None:
    nodes = soft_frame(ops)
    springs = springs_for(ops, nodes)
    one = springs[1:]
    assert (
        isinstance(one, FeetSprings) and one.nodes == (2,) and one.lands == springs.lands[1:] and one.parts == ((2,),)
    )
    assert list(springs) == [springs[0], springs[1]] and one[0] == springs[1]
    groups = [add_feet(ops, [1], springs[:1]), add_feet(ops, [2], one)]
    stepper = Stepper(ops, groups)
    stepper.gravity()
    assert stepper.weight == pytest.approx(42e3 * gs.GRAVITY, rel=1e-6)
    with pytest.raises(ValueError, match=r"takes none of the 2 feet; feet are counted from 0"):
        springs[2:]


def test_the_line_of_the_springs_says_what_its_numbers_are(ops: Any) -> None:
    springs = springs_for(ops, soft_frame(ops))
    words = f"; for accuracy 0.01: their energy under the weight is {100 * springs.give:.2g} % of the structure's)"
    assert repr(springs).endswith(words) and "\n" not in repr(springs)
    assert springs.stiffer(4.0).measured == springs.measured


def test_springs_of_another_kind_or_for_other_nodes_are_refused(ops: Any) -> None:
    nodes = soft_frame(ops)
    springs = springs_for(ops, nodes)
    with pytest.raises(TypeError, match=r"springs is a list of Springs, which has lost what was measured; give what"):
        add_feet(ops, nodes, list(springs))  # type: ignore[arg-type]
    with pytest.raises(TypeError, match="springs is a NoneType; give what springs_for returned"):
        add_feet(ops, nodes, None)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"springs are for nodes \[1\], nodes are \[1, 2\]; give as many"):
        add_feet(ops, nodes, springs[0:1])
    with pytest.raises(ValueError, match=r"springs are for nodes \[1, 2\], in this order, nodes are \[2, 1\]"):
        add_feet(ops, [2, 1], springs)
    for wrong in ("12", ["a"], [1.5, 2]):
        with pytest.raises(ValueError, match="give a list of the tags"):
            springs_for(ops, wrong)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match="accuracy is '0.01'; give a share"):
        springs_for(ops, nodes, "0.01")  # type: ignore[arg-type]


def test_springs_of_another_model_are_refused_with_both_masses(ops: Any) -> None:
    nodes = soft_frame(ops)
    springs = springs_for(ops, nodes)
    ops.mass(101, 40e3, 40e3, 0.0)
    words = r"the structure on nodes 1, 2 weighs 6.2e\+04 kg, and 4.2e\+04 kg where springs_for measured it"
    with pytest.raises(ValueError, match=words):
        add_feet(ops, nodes, springs)
    # the same mass, but more of it at a foot
    ops.mass(101, 19e3, 19e3, 0.0)
    ops.mass(1, 2e3, 2e3, 0.0)
    with pytest.raises(ValueError, match="what lands at node 1 is 2001 kg, and 1001 kg where springs_for measured it"):
        add_feet(ops, nodes, springs)
    ops.mass(1, 1.01e3, 1.01e3, 0.0)
    assert add_feet(ops, nodes, springs.stiffer(8.0)).measured


def test_a_stepper_says_what_it_takes(ops: Any) -> None:
    feet, springs = on_feet(ops)
    for wrong, words in (([1, 2], "feet has 1, a tag of a node; give what add_feet returned"), (springs, "a Springs;")):
        with pytest.raises(TypeError, match=words):
            Stepper(ops, wrong)  # type: ignore[arg-type]
    with pytest.raises(ValueError, match=r"feet on nodes \[1, 2\] are given twice"):
        Stepper(ops, [feet, feet])
    with pytest.raises(ValueError, match="accuracy is 'x'; give a normalised error"):
        Stepper(ops, feet, accuracy="x")  # type: ignore[arg-type]
    stepper = Stepper(ops, feet)
    stepper.gravity()
    with pytest.raises(TypeError, match="run: record is a list; give a groundspring.Record"):
        stepper.run([0.1] * 9)  # type: ignore[arg-type]


def test_nodes_without_rotation_are_refused_at_the_feet_and_weigh_elsewhere(ops: Any) -> None:
    ops.model("basic", "-ndm", 2, "-ndf", 2)
    ops.node(1, 0.0, 0.0)
    with pytest.raises(ValueError, match="node 1 has ndm 2, ndf 2; a foot needs a rotation"):
        springs_for(ops, [1])
    ops.wipe()
    nodes = soft_frame(ops)
    # a mass of ndf 2 that hangs on the frame
    ops.model("basic", "-ndm", 2, "-ndf", 2)
    ops.uniaxialMaterial("Elastic", 7, 210e9)
    ops.node(900, 20.0, 0.0)
    ops.fix(900, 1, 1)
    ops.node(901, 20.0, 3.0)
    ops.fix(901, 1, 0)
    ops.mass(901, 500.0, 500.0)
    ops.element("Truss", 900, 900, 901, 0.01, 7)
    springs = springs_for(ops, nodes)
    words = 'makes nodes of ndf 2 as it was last set; .* call ops.model\\("basic", "-ndm", 2, "-ndf", 3\\)'
    with pytest.raises(ValueError, match=words):
        add_feet(ops, nodes, springs)
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    stepper = Stepper(ops, add_feet(ops, nodes, springs))
    stepper.gravity()
    assert stepper.weight == pytest.approx(42.5e3 * gs.GRAVITY, rel=1e-6)


def fixed_foot(ops: Any, feet: Feet) -> None:
    ops.fix(1, 1, 1, 0)


def fixed_by_height(ops: Any, feet: Feet) -> None:
    ops.fixX(0.0, 1, 0, 0)


def fixed_by_pattern(ops: Any, feet: Feet) -> None:
    ops.timeSeries("Constant", 9)
    ops.pattern("Plain", 9, 9)
    ops.sp(1, 2, 0.0)


def freed_ground(ops: Any, feet: Feet) -> None:
    ops.remove("sp", feet.grounds[1], 2)


def fixed_absorber(ops: Any, feet: Feet) -> None:
    ops.fix(feet.absorbers[0], 0, 1, 0)


def bound(ops: Any, feet: Feet) -> None:
    ops.equalDOF(feet.grounds[0], 1, 1, 2)


HELD: list[tuple[Callable[[Any, Feet], None], str]] = [
    (fixed_foot, r'node 1 has been fixed in direction 1 since add_feet: .* ops.remove\("sp", 1, 1\)'),
    (fixed_by_height, "node 1 has been fixed in direction 1 since add_feet: the foot never lifts"),
    (fixed_by_pattern, "node 1 has been fixed in direction 2 since add_feet: the foot never lifts"),
    (freed_ground, "the ground under node 2, is no longer fixed in direction 2: nothing bears the foot; put it back"),
    (fixed_absorber, "has been fixed in direction 2 since add_feet: the springs under node 1 do not give"),
    (bound, "node 1 is bound to node .*, which is fixed in direction 1: the foot never lifts"),
]


@pytest.mark.parametrize(("change", "words"), HELD, ids=[change.__name__ for change, _ in HELD])
def test_a_foot_that_cannot_lift_is_told_before_the_run(
    change: Callable[[Any, Feet], None], words: str, ops: Any
) -> None:
    feet, _ = on_feet(ops)
    stepper = Stepper(ops, feet)
    change(ops, feet)
    with pytest.raises(ValueError, match=f"gravity: .*{words}"):
        stepper.gravity()
    ops.wipe()
    feet, _ = on_feet(ops)
    stepper = Stepper(ops, feet)
    stepper.gravity()
    change(ops, feet)
    for call in (stepper.settle, lambda: stepper.run(RECORD)):
        with pytest.raises(ValueError, match=words):
            call()


def test_a_fix_that_was_taken_off_again_leaves_the_weight_on_once(ops: Any) -> None:
    feet, _ = on_feet(ops)
    stepper = Stepper(ops, feet)
    ops.fix(1, 0, 1, 0)
    with pytest.raises(ValueError, match="since add_feet"):
        stepper.gravity()
    ops.remove("sp", 1, 2)
    stepper.gravity()
    assert stepper.weight == pytest.approx(42e3 * gs.GRAVITY, rel=1e-6)


def test_a_foot_that_cannot_turn_is_told(ops: Any) -> None:
    feet, _ = on_feet(ops)
    ops.fix(1, 0, 0, 1)
    words = r"gravity: node 1 is fixed in direction 3: element 1 \(.*\) cannot turn where it stands on the foot"
    with pytest.warns(gs.GroundspringWarning, match=words) as caught:
        Stepper(ops, feet).gravity()
    assert [one.filename for one in caught] == [__file__]


def test_a_duration_beyond_the_record_is_told_with_both_numbers(ops: Any) -> None:
    feet, _ = on_feet(ops)
    stepper = Stepper(ops, feet)
    stepper.gravity()
    with pytest.warns(gs.GroundspringWarning, match="duration is 1 s, the record ends at 0.2 s, and the run with it"):
        history = stepper.run(RECORD, duration=1.0)
    assert history.t[-1] == pytest.approx(0.2)
    for wrong in (-1.0, np.nan, "1"):
        with pytest.raises(ValueError, match="run: duration is .*; give a finite number of seconds"):
            stepper.run(RECORD, duration=wrong)  # type: ignore[arg-type]
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        assert len(stepper.run(RECORD, duration=RECORD.duration).t) == len(RECORD)


def test_feet_that_a_constraint_binds_are_not_measured_wrongly(ops: Any) -> None:
    """OpenSees gives both the equations of the node that they are linked to."""
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.geomTransf("Corotational", 1)
    for node, y, mass in ((10, 0.0, 2e3), (11, 5.0, 5e4)):
        ops.node(node, 0.0, y)
        ops.mass(node, mass, mass, 0.3 * mass)
    ops.element("elasticBeamColumn", 1, 10, 11, 0.5, 28e9, 0.12, 1)
    for node, x in ((1, -1.0), (2, 1.0)):
        ops.node(node, x, 0.0)
        ops.rigidLink("beam", 10, node)
    for constraints in ("Plain", "Transformation"):
        with pytest.raises(
            ValueError, match="node 1 is bound to node 10 by a constraint .* by a stiff elasticBeamColumn"
        ):
            springs_for(ops, [1, 2], constraints=constraints)


def test_constraints_that_plain_leaves_out_are_told(ops: Any) -> None:
    nodes = soft_frame(ops)
    ops.node(201, 0.0, 4.5)
    ops.mass(201, 5e3, 5e3, 0.0)
    ops.rigidLink("beam", 101, 201)
    feet = add_feet(ops, nodes, springs_for(ops, nodes, constraints="Transformation"))
    with pytest.raises(ValueError, match='constraints is "Plain", .* give constraints="Transformation"'):
        Stepper(ops, feet)
    stepper = Stepper(ops, feet, constraints="Transformation")
    stepper.gravity()
    assert stepper.weight == pytest.approx(47e3 * gs.GRAVITY, rel=1e-6)
    assert stepper.run(RECORD).uplift.shape == (len(RECORD), 2)


def test_a_structure_that_stands_on_something_else_is_told(ops: Any) -> None:
    feet, _ = on_feet(ops)
    for node in (101, 102):
        ops.fix(node, 0, 1, 0)
    words = (
        r"feet on nodes \[1, 2\] carry .* N, node 10[12] bears .* N of the same structure: it is fixed in direction 2"
    )
    with pytest.warns(gs.GroundspringWarning, match=words) as caught:
        Stepper(ops, feet).gravity()
    assert [one.filename for one in caught] == [__file__]


def test_feet_of_a_model_that_was_wiped_are_told(ops: Any) -> None:
    feet, _ = on_feet(ops)
    stepper = Stepper(ops, feet)
    stepper.gravity()
    ops.wipe()
    soft_frame(ops)
    with pytest.raises(ValueError, match=r"run: the feet on nodes \[1, 2\] are no longer in the model"):
        stepper.run(RECORD)


def test_a_model_in_millimetres_is_doubted(ops: Any) -> None:
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.geomTransf("Corotational", 1)
    for node, x, y, mass in (
        (1, 0.0, 0.0, 1.0),
        (2, 3000.0, 0.0, 1.0),
        (3, 0.0, 3500.0, 20.0),
        (4, 3000.0, 3500.0, 20.0),
    ):
        ops.node(node, x, y)
        ops.mass(node, mass, mass, 0.0)
    for i, (a, b) in enumerate(((1, 3), (2, 4), (3, 4)), 1):
        ops.element("elasticBeamColumn", i, a, b, 149e2, 210e3, 2.517e8, 1)
    springs = springs_for(ops, [1, 2])
    with pytest.warns(
        gs.GroundspringWarning, match="model reaches 4610 m from a foot; units are SI .*: check units"
    ) as caught:
        add_feet(ops, [1, 2], springs)
    assert [one.filename for one in caught] == [__file__]


def test_a_second_run_is_not_shaken_by_the_rest_of_the_first_record(ops: Any) -> None:
    """And an analysis that was made between the two is not taken for the stepper's."""
    shaken, still = gs.el_centro().scaled(0.3), gs.Record(0.01, np.zeros(51))
    roofs = []
    for record, duration in ((shaken.truncated(1.0), None), (shaken, 1.0)):
        ops.wipe()
        feet, _ = on_feet(ops)
        stepper = Stepper(ops, feet)
        stepper.gravity()
        stepper.run(record, duration=duration)
        if duration is not None:
            ops.wipeAnalysis()
        roofs.append([])
        stepper.run(still, on_sample=lambda i, t: roofs[-1].append(ops.nodeDisp(101, 1)))
    assert roofs[1] == pytest.approx(roofs[0], rel=1e-9, abs=1e-12) and np.ptp(roofs[0]) > 1e-6
