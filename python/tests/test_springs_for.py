"""What lands at a foot, measured on the model itself, against closed forms;
whether histories on its springs converge."""

import math
from typing import Any

import numpy as np
import pytest
from test_feet import soft_frame

from groundspring.opensees import springs_for
from groundspring.opensees._measure import Model


def block(ops: Any, half: float, height: float, mass: float, stiffness: float = 1e14) -> None:
    """A footing: its mass at its centre, stiff arms to both ends."""
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.geomTransf("Corotational", 1)
    ops.node(3, 0.0, height)
    ops.mass(3, mass, mass, mass * (half**2 + height**2) / 3.0)
    for node, x in ((1, -half), (2, half)):
        ops.node(node, x, 0.0)
        ops.element("elasticBeamColumn", node, node, 3, stiffness, 1.0, stiffness, 1)


def test_what_lands_of_a_block_is_that_of_the_closed_form(ops: Any) -> None:
    """W = G M^-1 G' of a plane body with its corners at (x, -h)."""
    b, h, m = 2.0, 0.5, 6e4
    block(ops, b, h, m)
    found = Model(ops, [1, 2]).inertia(100.0)  # slow enough for the arms to be rigid
    g = np.array([[1.0, 0.0, h], [0.0, 1.0, -b], [1.0, 0.0, h], [0.0, 1.0, b]])
    expected = g @ np.diag([1.0 / m, 1.0 / m, 3.0 / m / (b * b + h * h)]) @ g.T
    assert found == pytest.approx(expected, rel=1e-4, abs=1e-4 * np.abs(expected).max())
    assert Model(ops, [1, 2]).total == pytest.approx(m, rel=1e-12)


def test_what_is_behind_a_soft_column_stays_where_it_is(ops: Any) -> None:
    """m_eff = m + 1/(1/M W^2 + 1/k) of a footing m under a mass M on an axial spring k, at W."""
    m, top, k = 1e3, 2e4, 149e-4 * 210e9 / 3.5
    feet = soft_frame(ops, footing=m)
    model = Model(ops, feet)
    for omega in (2e3, 2e4, 2e5):
        moved = 1.0 / (1.0 / (top * omega**2) + 1.0 / k) / omega**2
        assert model.effective(omega)[0] == pytest.approx(m + moved, rel=2e-3)
    assert model.springlike(2e4) == []


def test_the_held_structure_has_the_reactions_of_statics(ops: Any) -> None:
    """A cantilever with its mass on top, on two ends of a stiff base: N = m a h/2b, and its own frequency."""
    b, h, m, ei = 2.0, 9.0, 3e5, 6e9
    block(ops, b, 0.5, 5e4, 1e16)
    ops.node(10, 0.0, 0.5 + h)
    ops.mass(10, m, m, 0.0)
    ops.element("elasticBeamColumn", 10, 3, 10, 1.0, 1e13, ei / 1e13, 1)
    sideways, upwards = Model(ops, [1, 2]).held()
    assert sideways.omega == pytest.approx(math.sqrt(3.0 * ei / h**3 / m), rel=1e-2)
    assert sideways.reactions[:, 0].sum() == pytest.approx(m + 5e4, rel=1e-9)
    assert sideways.reactions[0, 1] == pytest.approx((m * (h + 0.5) + 5e4 * 0.5) / (2.0 * b), rel=1e-6)
    assert upwards.reactions[:, 1] == pytest.approx([(m + 5e4) / 2.0] * 2, rel=1e-9)


def test_springs_follow_the_accuracy_and_what_lands(ops: Any) -> None:
    feet = soft_frame(ops)
    coarse, fine = springs_for(ops, feet, 0.01), springs_for(ops, feet, 0.001)
    assert fine[0].vertical.k1 == pytest.approx(10.0 * coarse[0].vertical.k1, rel=1e-9)
    assert fine.k < coarse.k and fine.give < coarse.give
    assert coarse.lands == pytest.approx([1e3, 1e3], rel=0.02) and coarse.parts == ((1,), (2,))
    stiff = coarse.stiffer(4.0)
    assert stiff[0].vertical.k1 == pytest.approx(4.0 * coarse[0].vertical.k1)
    assert (
        stiff[0].vertical.c == pytest.approx(2.0 * coarse[0].vertical.c)
        and stiff[0].vertical.m2 == coarse[0].vertical.m2
    )
    assert stiff.landings[0] == pytest.approx(0.5 * coarse.landings[0])
    ops.wipe()
    block(ops, 2.0, 0.5, 6e4, 1e16)
    ops.node(10, 0.0, 9.0)
    ops.mass(10, 3e5, 3e5, 0.0)
    ops.element("elasticBeamColumn", 10, 3, 10, 1.0, 1e13, 6e-4, 1)
    assert springs_for(ops, [1, 2]).parts == ((1, 2),)
    with pytest.raises(ValueError, match="give a share of the largest displacement from 1e-4 to 0.1"):
        springs_for(ops, [1, 2], 0.5)
    with pytest.raises(ValueError, match="give the tags of nodes that are in the model"):
        springs_for(ops, [1, 77])


def test_a_space_model_and_a_foot_that_carries_nothing_are_refused(ops: Any) -> None:
    feet = soft_frame(ops)
    ops.node(9, 20.0, 0.0)
    ops.mass(9, 1e3, 1e3, 0.0)
    for nodes in ([1, 9], [*feet, 9]):
        with pytest.raises(ValueError, match="springs_for: node 9 carries none of the structure: no element joins it"):
            springs_for(ops, nodes)
    ops.wipe()
    ops.model("basic", "-ndm", 3, "-ndf", 6)
    ops.node(1, 0.0, 0.0, 0.0)
    with pytest.raises(ValueError, match=r"springs_for: node 1 is in a space model \(ndm 3\)"):
        springs_for(ops, [1])
