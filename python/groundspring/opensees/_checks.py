"""What can be seen to be wrong before a run: arguments of another kind, a foot that cannot lift."""

from __future__ import annotations

import math
import warnings
from collections.abc import Iterable, Sequence
from numbers import Real
from typing import TYPE_CHECKING, Any

from .._native import GroundspringWarning, Record, Springs
from ._springs_for import FeetSprings

if TYPE_CHECKING:
    from ._feet import Feet

HINGED = ("Truss", "ZeroLength", "TwoNodeLink", "FlatSlider")
"""Parts of the names of elements that do not turn with their nodes, or need not."""

LEAST_MASS = 1e-3
"""Share of the nodal masses from which on the mass of elements is told."""

HARDLY_STANDS = 0.1
"""Share of what another support bears below which the feet do not carry their structure."""


def is_number(value: object) -> bool:
    """Whether it is a finite real number."""
    return isinstance(value, Real) and math.isfinite(value)


def check_springs(springs: object, nodes: Sequence[int]) -> None:
    """Refuse what is no springs, and springs of `springs_for` in another order than the nodes."""
    if not isinstance(springs, (Springs, FeetSprings)):
        kind = type(springs).__name__
        if isinstance(springs, (list, tuple)) and springs and isinstance(springs[0], Springs):
            kind += " of Springs, which has lost what was measured"
        raise TypeError(
            f"add_feet: springs is a {kind}; give what springs_for returned as it is (springs[0:1] for the first foot "
            "alone), or the Springs of gs.tune for all feet"
        )
    theirs = list(springs.nodes) if isinstance(springs, FeetSprings) else list(nodes)
    if len(theirs) != len(nodes):
        raise ValueError(
            f"add_feet: springs are for nodes {theirs}, nodes are {list(nodes)}; give as many, or springs[0:1] and its "
            "like, a slice of them"
        )
    if theirs != list(nodes) and sorted(theirs) == sorted(nodes):
        raise ValueError(
            f"add_feet: springs are for nodes {theirs}, in this order, nodes are {list(nodes)}; give nodes as "
            "springs_for had them"
        )


def check_feet(feet: object, kind: type[Feet]) -> list[Feet]:
    """Several of what `add_feet` returned, as a list; refuses what is none."""
    given = list(feet) if isinstance(feet, Iterable) else [feet]
    groups: list[Feet] = []
    if not given:
        raise ValueError("Stepper: there are no feet; give what add_feet returns")
    for one in given:
        if not isinstance(one, kind):
            what = f"{one!r}, a tag of a node" if isinstance(one, int) else f"a {type(one).__name__}"
            raise TypeError(
                f"Stepper: feet has {what}; give what add_feet returned: feet = add_feet(ops, nodes, springs), then "
                "Stepper(ops, feet)"
            )
        if any(one is other for other in groups):
            raise ValueError(f"Stepper: feet on nodes {list(one.nodes)} are given twice; give each group once")
        groups.append(one)
    return groups


def check_constraints(groups: Sequence[Feet], constraints: str) -> None:
    """Refuse "Plain", which leaves constraints out, for springs that were measured with another handler."""
    for group in groups:
        if not isinstance(group.springs, FeetSprings) or constraints != "Plain":
            continue
        if (theirs := group.springs.measured.constraints) != "Plain":
            raise ValueError(
                f'Stepper: constraints is "Plain", which leaves out constraints between nodes; springs_for measured '
                f'with "{theirs}": give constraints="{theirs}"'
            )


def check_record(record: object, call: str, name: str = "record") -> None:
    """Refuse what is no record."""
    if not isinstance(record, Record):
        raise TypeError(
            f"{call}: {name} is a {type(record).__name__}; give a groundspring.Record, of gs.read_record(path) or "
            "gs.Record(dt, accel)"
        )


def ends_at(record: Record, duration: float | None, call: str, level: int) -> float | None:
    """The duration of a run, s; warns of one that is longer than the record, with which the run ends."""
    if duration is None:
        return None
    if not is_number(duration) or duration <= 0.0:
        raise ValueError(f"{call}: duration is {duration!r}; give a finite number of seconds greater than zero")
    # a last sample that is missed by rounding is not told
    if duration > record.duration + record.dt:
        text = (
            f"{call}: duration is {duration:g} s, the record ends at {record.duration:g} s, and the run with it; for "
            "what comes after it append zeros to its accelerations: gs.Record(dt, np.append(accel, np.zeros(n)))"
        )
        warnings.warn(text, GroundspringWarning, stacklevel=level + 1)
    return min(duration, record.duration)


def check_supports(ops: Any, groups: Sequence[Feet], call: str) -> None:
    """Refuse a foot that was fixed after `add_feet`, and ground that was freed: the foot would never lift."""
    nodes, there = set(ops.getFixedNodes() or []), {*ops.getNodeTags(), *ops.getEleTags()}
    for group in groups:
        if not there.issuperset((*group.nodes, *group.grounds, *group.bearings)):
            raise ValueError(
                f"{call}: the feet on nodes {list(group.nodes)} are no longer in the model, which was wiped or built "
                "anew since add_feet: call add_feet again, and make a new Stepper"
            )

    def fixed(node: int) -> set[int]:
        return set(ops.getFixedDOFs(node)) if node in nodes else set()

    retained = [(node, set(ops.getConstrainedNodes(node))) for node in ops.getRetainedNodes() or []]
    for group in groups:
        for node, absorber, ground in zip(group.nodes, group.absorbers, group.grounds, strict=True):
            for at, what in ((node, "the foot never lifts"), (absorber, f"the springs under node {node} do not give")):
                if held := sorted(fixed(at) & {1, 2}):
                    raise ValueError(
                        f"{call}: node {at} has been fixed in direction {held[0]} since add_feet: {what}; take it off, "
                        f'ops.remove("sp", {at}, {held[0]}), or begin anew and fix other nodes before add_feet'
                    )
            if free := sorted({1, 2, 3} - fixed(ground)):
                raise ValueError(
                    f"{call}: node {ground}, the ground under node {node}, is no longer fixed in direction {free[0]}: "
                    f"nothing bears the foot; put it back, ops.fix({ground}, 1, 1, 1)"
                )
            for other, bound in retained:
                if node in bound and (held := sorted({1, 2} & set(ops.getConstrainedDOFs(node, other)) & fixed(other))):
                    raise ValueError(
                        f"{call}: node {node} is bound to node {other}, which is fixed in direction {held[0]}: the "
                        "foot never lifts; a foot must be free"
                    )


def tell_turn(ops: Any, groups: Sequence[Feet], call: str) -> None:
    """Warn of a foot that may not turn, if what stands on it turns with it."""
    fixed = {node for node in ops.getFixedNodes() or [] if 3 in ops.getFixedDOFs(node)}
    held = fixed & {node for group in groups for node in group.nodes}
    for element in ops.getEleTags() if held else []:
        ends = held & set(ops.eleNodes(element))
        if ends and not any(name in ops.eleType(element) for name in HINGED):
            node = min(ends)
            text = (
                f"{call}: node {node} is fixed in direction 3: element {element} ({ops.eleType(element)}) cannot turn "
                "where it stands on the foot, and a structure that cannot turn does not rock; free it unless a guide "
                "is meant"
            )
            warnings.warn(text, GroundspringWarning, stacklevel=3)
            return


def tell_shaken_twice(ops: Any, groups: Sequence[Feet], call: str) -> None:
    """Warn of masses given to elasticBeamColumn elements: OpenSees 3.7.1 shakes these twice under UniformExcitation. A
    cantilever under a constant acceleration a ends at 2 m a/k; with dispBeamColumn, or its mass on nodes, at m a/k."""
    mass = max(group.element_mass for group in groups)
    nodal = math.fsum(ops.nodeMass(node, 1) for node in ops.getNodeTags())
    beams = [element for element in ops.getEleTags() if ops.eleType(element) == "ElasticBeam2d"]
    if beams and mass > LEAST_MASS * nodal:
        text = (
            f"{call}: elements have {mass:.4g} kg of mass; OpenSees shakes the mass of elasticBeamColumn elements "
            f"(-mass) twice, and element {beams[0]} is one: put their mass on the nodes, ops.mass(...)"
        )
        warnings.warn(text, GroundspringWarning, stacklevel=4)


def tell_resting(ops: Any, groups: Sequence[Feet], call: str) -> None:
    """Warn of a structure that hardly stands on its feet: fixed nodes that hang together with these bear it. Reactions
    must have been asked for."""
    fixed = {node for node in ops.getFixedNodes() or [] if 2 in ops.getFixedDOFs(node)}
    fixed -= {ground for group in groups for ground in group.grounds}
    bears = {node: load for node in fixed if (load := float(ops.nodeReaction(node, 2))) > 0.0}
    if not bears:
        return
    ends = [set(ops.eleNodes(element)) for element in ops.getEleTags()]
    for group in groups:
        reached, front = set(group.nodes), set(group.nodes)
        while front:
            # not beyond what is fixed
            front = set().union(*(of for of in ends if not of.isdisjoint(front - fixed))) - reached
            reached |= front
        most = max(reached & set(bears), key=lambda node: bears[node], default=None)
        carried = float(group.forces()[:, 1].sum())
        if most is not None and carried < HARDLY_STANDS * bears[most]:
            text = (
                f"{call}: the feet on nodes {list(group.nodes)} carry {carried:.4g} N, node {most} bears "
                f"{bears[most]:.4g} N of the same structure: it is fixed in direction 2, and what is fixed does not "
                "rock; free it unless that is meant"
            )
            warnings.warn(text, GroundspringWarning, stacklevel=4)
