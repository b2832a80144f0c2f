"""add_feet and Stepper on models of a user's own: tags, checks, recorders, several structures, failures."""

import math
import re
import warnings
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import rigid_body

import groundspring as gs
from groundspring.opensees import StepError, Stepper, UntiedFeetWarning, add_feet, springs_for

FRAME = gs.Structure.aframe(12.0, 2.4, 350e3)
SPRINGS = gs.design(FRAME, stiffness=2e4).springs(FRAME.mass, np.hypot(12.0, 1.2))
RECORD = gs.el_centro().truncated(4.0)


def soft_frame(ops: Any, feet: int = 2, footing: float = 1e3, tied: bool = False) -> list[int]:
    """One storey of steel columns on footings, beams above, and between the footings if they are tied: the feet."""
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.geomTransf("Corotational", 1)
    for i in range(feet):
        for node, y, mass in ((1 + i, 0.0, footing), (101 + i, 3.5, 20e3)):
            ops.node(node, 3.0 * i, y)
            ops.mass(node, mass, mass, 0.0)
        ops.element("elasticBeamColumn", 1 + i, 1 + i, 101 + i, 149e-4, 210e9, 2.517e-4, 1)
        for level in (0, 100) if tied else (100,):
            if i > 0:
                ops.element("elasticBeamColumn", 100 + level + i, level + i, level + i + 1, 62.6e-4, 210e9, 1.177e-4, 1)
    ops.rayleigh(0.0, 0.0, 0.0, 0.003)
    return list(range(1, feet + 1))


def standing(ops: Any, **options: Any) -> Stepper:
    """The pier, settled."""
    give = rigid_body(ops, FRAME, SPRINGS)
    stepper = Stepper(ops, add_feet(ops, [1, 2], SPRINGS, compliance=give), tolerance=2e-13, **options)
    stepper.gravity()
    return stepper


def test_the_feet_know_what_they_carry(ops: Any) -> None:
    stepper = standing(ops)
    feet = stepper.groups[0]
    assert feet.forces()[:, 1] == pytest.approx(FRAME.mass * gs.GRAVITY / 2, rel=1e-6)
    assert feet.pressing().all() and ops.getTime() == 0.0
    # each foot carries half the weight on k1 and k2 in series; the legs give some of k1
    assert -ops.nodeDisp(3, 2) == pytest.approx(SPRINGS.settlement, rel=1e-3)
    history = stepper.run(RECORD)
    assert history.uplift.shape == (len(RECORD), 2) and history.uplift.max() > 1e-3
    assert len(history.to_pandas()) == len(RECORD)
    # what the ground gives the body is its mass times its absolute acceleration: the mean over the run is its momentum
    assert np.abs(history.largest_vertical).max() > FRAME.mass * gs.GRAVITY
    # a foot in the air carries nothing but the trace of tension
    airborne = history.gap > 1e-4
    assert airborne.any() and np.abs(history.horizontal[airborne]).max() < 1e-3 * FRAME.mass
    # what the feet keep and lose is what the structure has done on them
    missing = np.abs(history.released).sum(axis=1).max()
    assert missing < 0.1 * history.work.sum(axis=1).max()


def test_tags_do_not_collide_and_nothing_is_wiped(ops: Any, tmp_path: Path) -> None:
    give = rigid_body(ops, FRAME, SPRINGS)
    ops.uniaxialMaterial("Elastic", 1, 1.0)
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    ops.recorder("Node", "-file", str(tmp_path / "u.txt"), "-time", "-node", 3, "-dof", 1, "disp")
    nodes, elements = set(ops.getNodeTags()), set(ops.getEleTags())
    feet = add_feet(ops, [1, 2], SPRINGS, compliance=give)
    added = (*feet.absorbers, *feet.grounds)
    assert len(set(added)) == 4 and nodes.isdisjoint(added)
    assert set(ops.getNodeTags()) == nodes | set(added)
    assert set(ops.getEleTags()) == elements | {*feet.units, *feet.bearings}
    stepper = Stepper(ops, feet, tolerance=2e-13)
    stepper.gravity()
    stepper.run(RECORD.truncated(1.0))
    last = ops.nodeDisp(3, 1)
    ops.wipe()  # recorders write when they are closed
    rows = np.loadtxt(tmp_path / "u.txt")
    assert rows[-1, 0] == pytest.approx(1.0) and rows[-1, 1] == pytest.approx(last, rel=1e-3, abs=1e-12)
    assert len(rows) >= stepper.steps.taken


def test_two_structures_stand_in_one_model(ops: Any) -> None:
    """Each moves as it does alone."""
    alone: list[float] = []
    standing(ops).run(RECORD, on_sample=lambda i, t: alone.append(ops.nodeDisp(3, 1)))
    ops.wipe()
    give = rigid_body(ops, FRAME, SPRINGS)
    leg = 4.0 * SPRINGS.horizontal.k1
    length = np.hypot(12.0, 1.2)
    ops.node(103, 50.0, 12.0)
    ops.mass(103, FRAME.mass, FRAME.mass, FRAME.inertia)
    for node, x in ((101, 48.8), (102, 51.2)):
        ops.node(node, x, 0.0)
        ops.element("elasticBeamColumn", node, node, 103, leg * length, 1.0, leg * length**3 / 3.0, 1)
    groups = [add_feet(ops, nodes, SPRINGS, compliance=give) for nodes in ([1, 2], [101, 102])]
    tags = [
        tag for feet in groups for tag in (*feet.absorbers, *feet.grounds, *feet.units, *feet.bearings, *feet.materials)
    ]
    assert len(set(tags)) == len(tags)
    stepper = Stepper(ops, groups, tolerance=2e-13)
    stepper.gravity()
    both: list[tuple[float, float]] = []
    history = stepper.run(RECORD, on_sample=lambda i, t: both.append((ops.nodeDisp(3, 1), ops.nodeDisp(103, 1))))
    assert history.nodes == (1, 2, 101, 102)
    first, second = np.array(both).T
    largest = np.abs(alone).max()
    assert np.abs(first - second).max() < 1e-4 * largest
    assert np.abs(first - alone).max() < 2e-3 * largest


def test_what_cannot_have_feet_is_refused_with_a_reason(ops: Any) -> None:
    rigid_body(ops, FRAME, SPRINGS)
    with pytest.raises(ValueError, match="node 7 is not in the model"):
        add_feet(ops, [1, 7], SPRINGS)
    with pytest.raises(ValueError, match="each once"):
        add_feet(ops, [1, 1], SPRINGS)
    with pytest.raises(ValueError, match="compliance is 1.0 m/N"):
        add_feet(ops, [1, 2], SPRINGS, compliance=1.0)
    heavy = gs.Springs(1e9, SPRINGS.vertical, SPRINGS.horizontal)
    with pytest.warns(gs.GroundspringWarning, match="check units"):
        add_feet(ops, [1, 2], heavy, measure=False)
    ops.wipe()
    rigid_body(ops, FRAME, SPRINGS)
    ops.fix(1, 1, 0, 0)
    with pytest.raises(ValueError, match="node 1 is fixed in direction 1"):
        add_feet(ops, [1, 2], SPRINGS)
    for ndm, ndf, place, words in ((3, 6, (0.0, 0.0, 0.0), "space model"), (2, 2, (0.0, 0.0), "ndf 2")):
        ops.wipe()
        ops.model("basic", "-ndm", ndm, "-ndf", ndf)
        ops.node(1, *place)
        with pytest.raises(ValueError, match=words):
            add_feet(ops, [1], SPRINGS)


def test_gravity_comes_first(ops: Any) -> None:
    rigid_body(ops, FRAME, SPRINGS)
    feet = add_feet(ops, [1, 2], SPRINGS)
    stepper = Stepper(ops, feet)
    with pytest.raises(ValueError, match="a normalised error from 1e-6 to 0.1"):
        Stepper(ops, feet, accuracy=1.0)
    with pytest.raises(ValueError, match="greater than zero"):
        Stepper(ops, feet, longest=-1.0)
    with pytest.raises(ValueError, match="gravity"):
        stepper.run(RECORD)


def test_a_step_that_fails_is_accounted_for(ops: Any) -> None:
    """Newton's iteration cannot meet a tolerance below the rounding of its numbers."""
    stepper = standing(ops)
    stepper.tolerance = 1e-40
    with pytest.raises(StepError, match=r"stopped at t = \d.*; node 1 (presses|is in the air).*tolerance"):
        stepper.run(RECORD)
    assert len(stepper.history.t) >= 1


def test_a_weight_that_is_there_twice_or_not_at_all_is_warned_of(ops: Any) -> None:
    def stands(load: float) -> Stepper:
        ops.wipe()
        give = rigid_body(ops, FRAME, SPRINGS)
        ops.timeSeries("Linear", 1)
        ops.pattern("Plain", 1, 1)
        ops.load(3, 0.0, -load, 0.0)
        return Stepper(ops, add_feet(ops, [1, 2], SPRINGS, compliance=give))

    weight = FRAME.mass * gs.GRAVITY
    with pytest.warns(gs.GroundspringWarning, match=r'it is on twice: begin anew and call gravity\("own"\)'):
        stands(weight).gravity()
    stands(weight).gravity("own")
    with pytest.warns(gs.GroundspringWarning, match=r"3.09e.06 N of weight are missing; call gravity\(\)"):
        stands(0.1 * weight).gravity("own")


def test_gravity_is_put_on_once(ops: Any) -> None:
    stepper = standing(ops)
    before = stepper.groups[0].forces().copy()
    for again in (stepper, Stepper(ops, stepper.groups)):
        with pytest.raises(
            ValueError, match="the feet carry 3.434e.06 N already, and a second call would put the weight on twice"
        ):
            again.gravity()
    assert np.array_equal(stepper.groups[0].forces(), before)
    stepper.settle()
    assert stepper.groups[0].forces() == pytest.approx(before, rel=1e-9, abs=1.0)
    stepper.run(RECORD.truncated(0.1))
    with pytest.raises(ValueError, match="settle: the model's time is 0.1"):
        stepper.settle()


def test_feet_under_feet_are_refused(ops: Any) -> None:
    give = rigid_body(ops, FRAME, SPRINGS)
    add_feet(ops, [1, 2], SPRINGS, compliance=give)
    elements = ops.getEleTags()
    with pytest.raises(ValueError, match="node 1 stands on a bearing already"):
        add_feet(ops, [1, 2], SPRINGS, compliance=give)
    assert ops.getEleTags() == elements


def test_a_structure_that_overturns_is_warned_of(ops: Any) -> None:
    give = rigid_body(ops, FRAME, SPRINGS)
    stepper = Stepper(ops, add_feet(ops, [1, 2], SPRINGS, compliance=give))
    stepper.gravity()
    push = gs.Record(0.01, np.full(330, 3.0))
    with pytest.warns(gs.GroundspringWarning, match="the structure has overturned by"):
        history = stepper.run(push)
    # a foot rises by the width times sin(theta)
    theta, width = gs.rigid_rocking(FRAME, push).theta, FRAME.width
    leant = history.t[: len(theta)][np.sin(np.abs(theta)) > 0.7]
    # Housner's body keeps its foot on the ground, from which a fall of this speed takes it off
    assert history.overturned is not None and abs(history.overturned - leant[0]) < 0.1
    assert history.overturned == history.t[np.argmax(history.uplift.max(axis=1) > 0.7 * width)]
    assert f"330 samples to 3.29 s; OVERTURNED at {history.overturned:.2f} s" in repr(history)


def test_a_structure_that_stands_has_not_overturned(ops: Any) -> None:
    give = rigid_body(ops, FRAME, SPRINGS)
    stepper = Stepper(ops, add_feet(ops, [1, 2], SPRINGS, compliance=give))
    stepper.gravity()
    history = stepper.run(gs.Record(0.01, np.full(30, 3.0)))
    assert history.overturned is None and "largest uplift" in repr(history)


def test_a_foot_without_mass_under_a_soft_column_is_refused_in_one_line(ops: Any) -> None:
    feet = soft_frame(ops, footing=0.0)
    words = r"node 1 has no mass, and what stands on it gives more .*ops.mass\(1, m, m, 0.0\)"
    with pytest.raises(ValueError, match=words) as caught:
        add_feet(ops, feet, gs.design(FRAME, stiffness=2e4).springs(1e3, 12.0))
    assert "\n" not in str(caught.value)
    with pytest.raises(ValueError, match="springs_for: node 1 has no mass that lands"):
        springs_for(ops, feet)


def test_springs_for_more_than_lands_are_told_with_their_cause(ops: Any) -> None:
    feet = soft_frame(ops)
    springs = gs.design(FRAME, stiffness=1e5).springs(42e3, 3.8)
    words = "the springs are for 4.2e.04 kg, but 10.. kg land at node 1: .*take springs_for"
    with pytest.warns(gs.GroundspringWarning, match=words):
        add_feet(ops, feet, springs)


def told(caught: list[warnings.WarningMessage]) -> int:
    return sum(issubclass(one.category, UntiedFeetWarning) for one in caught)


def test_three_feet_that_nothing_ties_are_told_before_the_run(ops: Any) -> None:
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        feet = add_feet(ops, nodes := soft_frame(ops, 3), springs_for(ops, nodes))
        Stepper(ops, feet)
    assert told(caught) == 1 and caught[0].filename == __file__
    words = "3 feet, and what ties nodes [12] and [23] gives [0-9.]+ mm under .* tie the feet \\(a grade beam\\)"
    assert re.match(words, str(caught[0].message))
    assert (
        ops.getTime() == 0.0
        and np.abs([ops.nodeDisp(node, k) for node in ops.getNodeTags() for k in (1, 2)]).max() == 0.0
    )


@pytest.mark.parametrize(("count", "tied"), [(3, True), (2, False)])
def test_tied_feet_and_two_feet_are_not_told(ops: Any, count: int, tied: bool) -> None:
    nodes = soft_frame(ops, count, tied=tied)
    springs = springs_for(ops, nodes)
    groups = [add_feet(ops, [node], springs[i], measure=False) for i, node in enumerate(nodes)]
    # warnings are errors here
    assert len(Stepper(ops, groups).groups) == count
    ops.wipe()
    assert add_feet(ops, soft_frame(ops, count, tied=tied), springs[0]).measured


def test_untied_feet_are_told_whoever_sees_them_all_first(ops: Any) -> None:
    """springs for all in `add_feet`; one call of it a foot, and then the stepper."""
    nodes = soft_frame(ops, 3, tied=True)
    unit = springs_for(ops, nodes)[0]
    ops.wipe()
    with warnings.catch_warnings(record=True) as caught:
        warnings.simplefilter("always")
        feet = add_feet(ops, soft_frame(ops, 3), unit)
        assert told(caught) == 1 and caught[0].filename == __file__
        Stepper(ops, feet)
        assert told(caught) == 1
        ops.wipe()
        soft_frame(ops, 3)
        groups = [add_feet(ops, [node], unit, measure=False) for node in nodes]
        assert told(caught) == 1
        stepper = Stepper(ops, groups)
    assert told(caught) == 2 and caught[-1].filename == __file__
    # the springs were taken off: what ties the feet gives what it did
    first, last = (str(one.message) for one in (caught[0], caught[-1]))
    assert first == last
    stepper.gravity()
    assert stepper.weight == pytest.approx(3 * 21e3 * gs.GRAVITY, rel=1e-6)


def test_structures_apart_are_not_tied_to_each_other(ops: Any) -> None:
    """Two frames of two feet each in one model are two structures."""
    nodes = soft_frame(ops)
    for node in (1, 2, 101, 102):
        x, y = ops.nodeCoord(node)
        ops.node(10 + node, x + 20.0, y)
        ops.mass(10 + node, *[ops.nodeMass(node, 1)] * 2, 0.0)
    for i, (a, b) in enumerate(((11, 111), (12, 112), (111, 112))):
        ops.element("elasticBeamColumn", 301 + i, a, b, 149e-4, 210e9, 2.517e-4, 1)
    groups = [add_feet(ops, pair, springs_for(ops, pair)) for pair in (nodes, [11, 12])]
    assert len(Stepper(ops, groups).groups) == 2


def test_masses_of_elements_that_nothing_gives_weight_to_are_told(ops: Any) -> None:
    nodes = soft_frame(ops)
    ops.element("elasticBeamColumn", 301, 101, 102, 62.6e-4, 210e9, 1.177e-4, 1, "-mass", 500.0)
    stepper = Stepper(ops, add_feet(ops, nodes, springs_for(ops, nodes)))
    words = 'elements have 1500 kg of mass .* beside the 4.2e.04 kg of the nodes; .* gravity\\("own"\\)'
    twice = r"OpenSees shakes the mass of elasticBeamColumn elements \(-mass\) twice, and element 1 is one: put"
    with pytest.warns(gs.GroundspringWarning) as caught:
        stepper.gravity()
    assert [one.filename for one in caught] == [__file__] * 2
    for text in (words, twice):
        assert any(re.search(text, str(one.message)) for one in caught), text


@pytest.mark.parametrize(("kind", "times"), [("elasticBeamColumn", 2.0), ("dispBeamColumn", 1.0)])
def test_opensees_shakes_the_mass_of_elastic_beams_twice(ops: Any, kind: str, times: float) -> None:
    """What the warning says: a damped cantilever under a constant acceleration a comes to rest at m a/k, by hand."""
    height, mass, stiffness = 3.0, 2000.0, 3.0 * 30e9 * 1e-3 / 27.0
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    for node, y in ((1, 0.0), (2, height)):
        ops.node(node, 0.0, y)
    ops.fix(1, 1, 1, 1)
    ops.geomTransf("Linear", 1)
    if kind == "elasticBeamColumn":
        ops.element(kind, 1, 1, 2, 0.1, 30e9, 1e-3, 1, "-mass", 2.0 * mass / height)
    else:
        ops.section("Elastic", 1, 30e9, 0.1, 1e-3)
        ops.beamIntegration("Lobatto", 1, 1, 5)
        ops.element(kind, 1, 1, 2, 1, 1, "-mass", 2.0 * mass / height)
    ops.timeSeries("Constant", 1)
    ops.pattern("UniformExcitation", 1, 1, "-accel", 1)
    ops.rayleigh(0.0, 1.4 / math.sqrt(stiffness / mass), 0.0, 0.0)
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system("UmfPack")
    ops.test("NormDispIncr", 1e-12, 30)
    ops.algorithm("Newton")
    ops.integrator("TRBDF2")
    ops.analysis("Transient")
    assert ops.analyze(1000, 0.004) == 0
    assert ops.nodeDisp(2, 1) * stiffness / -mass == pytest.approx(times, rel=1e-4)


def test_the_account_tells_of_patterns_that_it_does_not_know(ops: Any) -> None:
    nodes = soft_frame(ops)
    stepper = Stepper(ops, add_feet(ops, nodes, springs_for(ops, nodes)))
    with pytest.raises(ValueError, match=r'gravity\("own"\): .* put 0 N on the structure, and no foot presses'):
        stepper.gravity("own")
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    for node in (1, 2, 101, 102):
        ops.load(node, 0.0, -ops.nodeMass(node, 2) * gs.GRAVITY, 0.0)
    stepper.gravity("own")
    with pytest.warns(gs.GroundspringWarning, match="not that of the model's own patterns"):
        stepper.run(RECORD.truncated(0.1), account=True)


def test_what_a_newcomer_gets_wrong_is_said_in_his_own_words(ops: Any) -> None:
    nodes = soft_frame(ops)
    with pytest.raises(ValueError, match="springs_for: nodes are 1; give a list of the tags"):
        springs_for(ops, 1)  # type: ignore[arg-type]
    ops.fix(2, 0, 1, 0)
    with pytest.raises(ValueError, match="springs_for: node 2 is fixed in direction 2; a foot must be free"):
        springs_for(ops, nodes)

    def with_feet() -> None:
        ops.wipe()
        add_feet(ops, soft_frame(ops), springs)

    ops.wipe()
    springs = springs_for(ops, soft_frame(ops))
    stepper = Stepper(ops, add_feet(ops, nodes, springs))
    with pytest.raises(ValueError, match="springs_for: node 1 stands on a bearing already"):
        springs_for(ops, nodes)
    stepper.gravity()
    with pytest.raises(ValueError, match="converged: build leaves feet in the model; it makes the model anew"):
        stepper.converged(RECORD, with_feet)


def test_uplift_is_drawn_with_a_line_a_foot(ops: Any) -> None:
    nodes = soft_frame(ops)
    stepper = Stepper(ops, add_feet(ops, nodes, springs_for(ops, nodes)))
    stepper.gravity()
    axes = stepper.run(RECORD.truncated(0.05)).plot()
    assert [line.get_label() for line in axes.lines] == ["node 1", "node 2"] and axes.get_ylabel() == "uplift [mm]"
