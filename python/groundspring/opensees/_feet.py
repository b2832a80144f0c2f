"""Spring-absorber units under nodes of a plane frame model.

    node - gap, k1 - absorber m2 - (k2 parallel with dashpot c) - ground,   vertically and horizontally

Why each element is what it is stands in the decks that `tune run` writes; this is the same model.
"""

from __future__ import annotations

import itertools
import math
import warnings
from collections.abc import Callable, Iterable, Sequence
from typing import Any

import numpy as np
import numpy.typing as npt

from .._native import GRAVITY, GroundspringWarning, Springs
from ._checks import check_springs
from ._measure import Model, NotMeasured, check_free, check_plane, node_tags
from ._springs_for import FeetSprings, tell_untied

Array = npt.NDArray[np.float64]

HOLDS = 1e7
"""A coefficient of friction at which no pressing foot ever slips, as in the decks."""

LARGEST = 1000.0
"""Distance of a node from a foot, m, beyond which the units are doubted: no structure that rocks is as high."""

HEAVY = 3.0
"""Mass that springs are for over what lands, from which on it is told: absorbers then weigh more than the foot."""

ANOTHER = 0.03
"""Share by which mass may differ from what `springs_for` measured: masses of a few fittings, put on in between."""

FIRST_TAG = 1_000_000
"""Tags begin here, or beyond the model's largest: materials and friction models cannot be asked for theirs."""


class Feet:
    """Nodes on ground springs. Made by `add_feet`.

    nodes       their tags
    absorbers   tags of the absorbers' nodes
    grounds     tags of the fixed nodes
    units       tags of the zeroLength elements between ground and absorber
    bearings    tags of the elements with the gap, between absorber and node
    materials   tags of the uniaxial materials
    springs     the units, as given
    landing     1/Omega_n of the vertical k1, s: what a landing takes
    """

    def __init__(self, ops: Any, nodes: Sequence[int], springs: Springs | FeetSprings, compliance: float) -> None:
        self.ops, self.nodes, self.springs = ops, tuple(nodes), springs
        each = [springs] * len(self.nodes) if isinstance(springs, Springs) else list(springs)
        self.absorbers: tuple[int, ...] = ()
        self.grounds: tuple[int, ...] = ()
        self.units: tuple[int, ...] = ()
        self.bearings: tuple[int, ...] = ()
        self.materials: tuple[int, ...] = ()
        self.options: dict[str, Any] = {}
        self.measured = isinstance(springs, FeetSprings)  # whether it was looked at what ties these feet
        self.element_mass = 0.0  # of the structure, where it was measured, kg
        # what the structure gives above the foot is taken off the gap's: both in series are k1
        self.gap_vertical, self.gap_horizontal = (
            np.array([unit.k1 / (1.0 - unit.k1 * compliance) for unit in units])
            for units in ([of.vertical for of in each], [of.horizontal for of in each])
        )
        self._k2, self._c, self._m2 = (
            np.array([[getattr(unit, name) for unit in (of.horizontal, of.vertical)] for of in each]).T
            for name in ("k2", "c", "m2")
        )
        lands = (
            [math.sqrt(of.mass / of.vertical.k1) for of in each] if isinstance(springs, Springs) else springs.landings
        )
        self.landing = min(lands)

    @property
    def pairs(self) -> tuple[tuple[int, int], ...]:
        """Node and absorber of every foot: a gap is closed where the node is not above the absorber."""
        return tuple(zip(self.nodes, self.absorbers, strict=True))

    def gaps(self) -> Array:
        """Opening of every gap, m; negative: compressed."""
        return self._relative(2)

    def uplifts(self) -> Array:
        """Height of every node above the unloaded ground, m; negative: it has sunk in."""
        return np.array([self.ops.nodeDisp(node, 2) for node in self.nodes])

    def forces(self) -> Array:
        """The ground's force on every node, N: horizontal (to the right), vertical (up). A row a foot."""
        return np.array([[-x for x in self.ops.eleForce(bearing)[3:5]] for bearing in self.bearings])

    def anchors(self) -> Array:
        """Where every foot holds on to the ground: its horizontal displacement
        at which the bearing carries no shear, m.

        It moves along with a foot in the air.
        """
        anchors: Array = self._relative(1) + self.forces()[:, 0] / self.gap_horizontal
        return anchors

    def pressing(self) -> npt.NDArray[np.bool_]:
        """Whether every foot presses on the ground."""
        return self.gaps() <= 0.0

    def stored(self) -> Array:
        """Energy in the springs and the absorbers' motion of every foot, J."""
        compressed = np.minimum(self.gaps(), 0.0)
        energy: Array = 0.5 * self.gap_vertical * compressed**2 + 0.5 * self.forces()[:, 0] ** 2 / self.gap_horizontal
        for k in (0, 1):
            displacement, velocity = self._absorber(k + 1)
            energy += 0.5 * self._k2[k] * displacement**2 + 0.5 * self._m2[k] * velocity**2
        return energy

    def damping(self) -> Array:
        """Power that the dashpots of every foot take, W."""
        (_, across), (_, down) = self._absorber(1), self._absorber(2)
        power: Array = self._c[0] * across**2 + self._c[1] * down**2
        return power

    def _relative(self, dof: int) -> Array:
        disp = self.ops.nodeDisp
        return np.array([disp(node, dof) - disp(absorber, dof) for node, absorber in self.pairs])

    def _absorber(self, dof: int) -> tuple[Array, Array]:
        of = self.absorbers
        return np.array([self.ops.nodeDisp(a, dof) for a in of]), np.array([self.ops.nodeVel(a, dof) for a in of])

    def __repr__(self) -> str:
        return f"Feet(nodes={self.nodes}, absorbers={self.absorbers}, grounds={self.grounds}, bearings={self.bearings})"


def add_feet(
    ops: Any,
    nodes: Sequence[int],
    springs: Springs | FeetSprings,
    *,
    compliance: float = 0.0,
    friction: float = HOLDS,
    first_tag: int | None = None,
    measure: bool = True,
) -> Feet:
    """Put spring-absorber units under nodes of a plane frame model.

    ops         openseespy.opensees, with a model of ndm 2 and ndf 3
    nodes       the nodes that stand on the ground, two or more under a structure that rocks
    springs     of `springs_for`, one a node; or one for all, as tuned for a rigid body: each node gets all of it
    compliance  m/N: what the structure gives above a node, where that stands for a rigid body; taken off k1's
    friction    coefficient, without unit; unless given a pressing foot never slips
    first_tag   the first of the tags used; beyond the model's own unless given
    measure     look whether the springs are for what lands; OpenSees' analysis objects are wiped for it. Not done with
                a compliance, nor in models of more than 3,000 equations

    Call it after `ops.rayleigh`, which would damp the absorbers.

    ValueError: a model that is not plane, nodes that are not there or fixed, that have feet already, or that have no
    mass under columns softer than the springs; springs that `springs_for` measured on another model; numbers that mean
    nothing. GroundspringWarning: springs for three times the mass that lands, or more; a model in other units than m.
    UntiedFeetWarning: three or more feet that nothing holds together, if `springs_for` has not told it.
    """
    nodes = node_tags(nodes, "add_feet")
    check_springs(springs, nodes)
    _check(ops, nodes, springs, compliance, friction)
    model = _check_lands(ops, nodes, springs) if measure and compliance == 0.0 else None
    feet = Feet(ops, nodes, springs, compliance)
    if model is not None:
        feet.measured, feet.element_mass = True, model.total - model.nodal
    feet.options = {"compliance": compliance, "friction": friction, "first_tag": first_tag}
    there = [*ops.getNodeTags(), *ops.getEleTags()]
    free = itertools.count(max([FIRST_TAG, *(tag + 1 for tag in there)]) if first_tag is None else first_tag)
    units = [springs] * len(nodes) if isinstance(springs, Springs) else list(springs)
    # the bearing asks for a moment spring; this one is too weak to be felt (1e-9 of the weight's own moment)
    heaviest = max(unit.mass for unit in units)
    moment = 1e-9 * heaviest * GRAVITY * _radius(ops, nodes)

    def material(*arguments: Any) -> int:
        return take(free, lambda tag: ops.uniaxialMaterial(arguments[0], tag, *arguments[1:]))

    made: list[tuple[Springs, tuple[int, ...]]] = []
    of_node: list[tuple[int, ...]] = []
    for unit, gap_vertical in zip(units, feet.gap_vertical, strict=True):
        known = [tags for other, tags in made if other == unit]
        if not known:
            v, h = unit.vertical, unit.horizontal
            across, down = material("Elastic", h.k2, h.c), material("Elastic", v.k2, v.c)
            # without a trace of tension a foot in the air would be pulled back to where it stood before,
            # which creates energy
            closed, trace = material("ENT", gap_vertical), material("Elastic", 1e-9 * gap_vertical)
            known = [(across, down, closed, trace, material("Parallel", closed, trace), material("Elastic", moment))]
            made.append((unit, known[0]))
        of_node.append(known[0])
    feet.materials = tuple(tag for _, tags in made for tag in tags)
    coulomb = take(free, lambda tag: ops.frictionModel("Coulomb", tag, friction))

    # in the order of the decks: OpenSees numbers and adds up by tags, and its rounding follows
    feet.absorbers, feet.grounds, feet.units, feet.bearings = (tuple(next(free) for _ in nodes) for _ in range(4))
    for i, node in enumerate(nodes):
        absorber, ground, tags = feet.absorbers[i], feet.grounds[i], of_node[i]
        x, y = ops.nodeCoord(node)
        ops.node(absorber, x, y)
        ops.node(ground, x, y)
        ops.fix(ground, 1, 1, 1)
        # the bearing's axes turn with its first node: the absorber must not rotate
        ops.fix(absorber, 0, 0, 1)
        ops.mass(absorber, units[i].horizontal.m2, units[i].vertical.m2, 0.0)
        ops.element("zeroLength", feet.units[i], ground, absorber, "-mat", tags[0], tags[1], "-dir", 1, 2)
        # axial direction up (local x = global y); the horizontal k1 is the bearing's shear stiffness
        ops.element(
            "flatSliderBearing", feet.bearings[i], absorber, node, coulomb, float(feet.gap_horizontal[i]),
            "-P", tags[4], "-Mz", tags[5], "-orient", 0, 1, 0, -1, 0, 0,
        )  # fmt: skip
    return feet


def take(free: Iterable[int], make: Callable[[int], Any]) -> int:
    """Make something that cannot be asked for its tags, under the first of `free` that is not taken."""
    for tag, _ in zip(free, range(1000), strict=False):
        try:
            make(tag)
        except Exception as error:  # openseespy's own class of errors differs from build to build
            last = error
        else:
            return tag
    raise ValueError(f"add_feet: OpenSees takes none of a thousand tags up to {tag}; give another first_tag") from last


def _check(ops: Any, nodes: list[int], springs: Springs | FeetSprings, compliance: float, friction: float) -> None:
    there = set(ops.getNodeTags())
    if not nodes or len(set(nodes)) < len(nodes):
        raise ValueError(f"add_feet: nodes are {nodes}; give the tags of the nodes that stand on the ground, each once")
    for node in nodes:
        if node not in there:
            raise ValueError(f"add_feet: node {node} is not in the model; make it before its foot")
    check_plane(ops, nodes, "add_feet")
    if (ndf := int(np.ravel(ops.getNDF())[0])) != 3:
        raise ValueError(
            f"add_feet: the model makes nodes of ndf {ndf} as it was last set; the springs' nodes need 3: call "
            'ops.model("basic", "-ndm", 2, "-ndf", 3), which wipes nothing, before add_feet'
        )
    check_free(ops, nodes, "add_feet")
    for name, value in (("compliance", compliance), ("friction", friction)):
        if not (math.isfinite(value) and value >= 0.0):
            raise ValueError(f"add_feet: {name} is {value!r}; give a finite number, zero or greater")
    units = [springs] if isinstance(springs, Springs) else list(springs)
    stiffest = max(max(unit.vertical.k1, unit.horizontal.k1) for unit in units)
    if compliance * stiffest >= 1.0:
        raise ValueError(
            f"add_feet: compliance is {compliance!r} m/N, that of the stiffest k1 {1.0 / stiffest:.3e} m/N; "
            "what the structure gives must be less"
        )
    _check_mass(ops, max(unit.mass for unit in units))
    _check_size(ops, nodes)


def _check_lands(ops: Any, nodes: list[int], springs: Springs | FeetSprings) -> Model | None:
    """Refuse feet without mass under soft columns; warn of springs for more than what lands.
    None: could not be measured."""
    units = [springs] * len(nodes) if isinstance(springs, Springs) else list(springs)
    omega = min(math.sqrt(unit.vertical.k1 / unit.mass) for unit in units)
    try:
        if isinstance(springs, Springs):
            model = Model(ops, nodes)
            tell_untied(model, 3)  # springs_for tells it of its own
        else:
            model = Model(ops, nodes, springs.measured.constraints)
        lands, massless = model.effective(omega), model.springlike(omega)
    except NotMeasured:
        return None
    if isinstance(springs, FeetSprings):
        _check_same(model, springs)
    for node, mass, unit in zip(nodes, lands, units, strict=True):
        stiffness = mass * omega**2
        if node in massless and stiffness < 0.5 * unit.vertical.k1:
            raise ValueError(
                f"add_feet: node {node} has no mass, and what stands on it gives more ({stiffness:.3g} N/m) than its "
                f"spring ({unit.vertical.k1:.3g} N/m): it would let go and land without end; give it the mass of its "
                f"base plate or footing, ops.mass({node}, m, m, 0.0), and springs by springs_for"
            )
    heavy = [(unit.mass / mass, node, mass, unit) for node, mass, unit in zip(nodes, lands, units, strict=True)]
    times, node, mass, unit = max(heavy, key=lambda entry: entry[0])
    if times > HEAVY and isinstance(springs, Springs):
        text = (
            f"add_feet: the springs are for {unit.mass:.4g} kg, but {mass:.4g} kg land at node {node}: what stands on "
            "it is softer than the springs, and does not land with it. The foot will touch and lift again and again, "
            "in very many steps; take springs_for(ops, nodes)"
        )
        warnings.warn(text, GroundspringWarning, stacklevel=3)
    return model


def _check_same(model: Model, springs: FeetSprings) -> None:
    """Refuse springs that were measured on another model: by the structure's mass, and by what lands at each foot."""
    was = springs.measured
    masses = [("the structure on nodes " + ", ".join(map(str, model.nodes)), "weighs", was.total, model.total)]
    masses += [
        (f"what lands at node {node}", "is", before, now)
        for node, before, now in zip(model.nodes, springs.lands, model.effective(was.omega).tolist(), strict=True)
    ]
    for what, verb, before, now in masses:
        if abs(now / before - 1.0) > ANOTHER:
            raise ValueError(
                f"add_feet: {what} {verb} {now:.4g} kg, and {before:.4g} kg where springs_for measured it: the springs "
                "are another model's; call springs_for on this one, as it stands now"
            )


def _check_size(ops: Any, nodes: Sequence[int]) -> None:
    size = _radius(ops, nodes)
    if size > LARGEST:
        text = f"add_feet: the model reaches {size:.4g} m from a foot; units are SI (m, kg, N, s), not mm: check units"
        warnings.warn(text, GroundspringWarning, stacklevel=4)


def _check_mass(ops: Any, mass: float) -> None:
    masses = [ops.nodeMass(node, 2) for node in ops.getNodeTags()]
    if any(nodal < 0.0 for nodal in masses):
        raise ValueError("add_feet: a nodal mass is negative; masses are positive or zero")
    total = math.fsum(masses)
    # element masses are not seen: too little is no mistake
    if total > 0.0 and mass > 2.0 * total:
        text = (
            f"add_feet: WARNING: the springs are for {mass:.4g} kg, the model's nodes carry {total:.4g} kg; check units"
        )
        warnings.warn(text, GroundspringWarning, stacklevel=4)


def _radius(ops: Any, nodes: Sequence[int]) -> float:
    """Largest distance from a foot to a node of the model, m."""
    places = [ops.nodeCoord(node) for node in ops.getNodeTags()]
    feet = [ops.nodeCoord(node) for node in nodes]
    far = max(math.hypot(x - x0, y - y0) for x0, y0 in feet for x, y in places)
    if far == 0.0:
        raise ValueError("add_feet: the model has no node but this one; build the structure before its feet")
    return far
