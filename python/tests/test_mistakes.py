"""What one gets wrong with a model of one's own, and is told: arguments of another kind, springs of another model."""

from typing import Any

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
