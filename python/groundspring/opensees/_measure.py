"""What lands at a foot, and how stiff the structure is above it: measured on the model itself.

OpenSees assembles mass and stiffness of the model as it stands (integrator GimmeMCK, `printA`). With them

    W(Omega) = Omega^2 G (K + Omega^2 M)^-1 G'      of the feet's displacements x, y: rows of G

is what a push that grows as exp(Omega t) does to the feet: the inverse of the mass that moves along in a time of
1/Omega. Parts behind members softer than M Omega^2 stay where they are, parts behind stiffer ones come along, and no
eigenvalue is asked for. For a rigid body W = G M^-1 G' at every Omega. A foot whose mass falls with 1/Omega^2 has none:
it is a spring.
"""

from __future__ import annotations

import itertools
import math
import operator
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from .._native import GRAVITY

if TYPE_CHECKING:
    from ._feet import Array

MOST_EQUATIONS = 3000
"""Equations of a model that is measured: two full matrices of 72 MB."""
COUPLED = 0.1
"""Feet whose motions W couples by more than this share belong to one part, as the two ends of a footing."""


def node_tags(nodes: Sequence[int], call: str) -> list[int]:
    """The nodes as a list of whole numbers."""
    try:
        return [operator.index(node) for node in nodes]
    except TypeError:
        raise ValueError(
            f"{call}: nodes are {nodes!r}; give a list of the tags of the nodes that stand on the ground"
        ) from None


def check_plane(ops: Any, nodes: Sequence[int], call: str) -> None:
    """Refuse nodes of a model that is no plane frame."""
    for node in nodes:
        ndm, ndf = len(ops.nodeCoord(node)), len(ops.nodeDisp(node))
        if ndm == 3:
            raise ValueError(
                f"{call}: node {node} is in a space model (ndm 3); these springs are for plane rocking, and nothing "
                "would hold the feet out of the plane: the body would roll over and twist; "
                "make the model plane (ndm 2, ndf 3)"
            )
        if (ndm, ndf) != (2, 3):
            raise ValueError(
                f"{call}: node {node} has ndm {ndm}, ndf {ndf}; a foot needs a rotation, as in a plane frame (ndm 2, "
                'ndf 3): make its nodes after ops.model("basic", "-ndm", 2, "-ndf", 3), and fix the rotation of those '
                "where only trusses meet; under plane elements, lay a sole of beams on nodes of their own (its page: "
                "docs/rocking-wall.md)"
            )


def check_free(ops: Any, nodes: Sequence[int], call: str) -> None:
    """Refuse nodes that are fixed, or that stand on springs already."""
    fixed = set(ops.getFixedNodes() or [])
    for node in nodes:
        held = sorted({1, 2} & set(ops.getFixedDOFs(node))) if node in fixed else []
        if held:
            raise ValueError(
                f"{call}: node {node} is fixed in direction {held[0]}; a foot must be free: take the fix off"
            )
    wanted = set(nodes)
    for element in ops.getEleTags():
        ends = set(ops.eleNodes(element)) & wanted
        if ends and ops.eleType(element).startswith("FlatSlider"):
            raise OnFeet(
                f"{call}: node {min(ends)} stands on a bearing already (element {element}); a node gets one foot: keep "
                "the feet that the first call returned, or begin the model anew"
            )


class OnFeet(ValueError):
    """A node has a foot already."""


class NotMeasured(ValueError):
    """The model is too large for full matrices, or OpenSees does not assemble them."""


@dataclass
class Held:
    """The structure held at its feet, under 1 m/s2."""

    reactions: Array
    """(H, N) of every foot, N."""
    work: float
    """u' K u, J."""
    omega: float
    """Rayleigh's estimate of the frequency of this deformation, rad/s."""


class Model:
    """Mass and stiffness of the structure on these feet, kg and N/m; parts of the model that do not hang together with
    it are left out.

    ops          openseespy.opensees
    nodes        the feet
    constraints  handler of the model's constraints between nodes
    absorbers    of the nodes that have springs already, by node: these springs are taken off
    there        nodes that hang together with the feet
    nodal        vertical masses of these nodes, kg: what is more in the matrix is that of elements
    """

    def __init__(
        self, ops: Any, nodes: Sequence[int], constraints: str = "Plain", absorbers: Mapping[int, int] | None = None
    ) -> None:
        self.nodes = list(nodes)
        stiffness, dofs = _assembled(ops, (0.0, 0.0, 1.0), constraints)
        mass, _ = _assembled(ops, (1.0, 0.0, 0.0), constraints)
        for node, absorber in (absorbers or {}).items():
            _take_off(stiffness, dofs[node], dofs[absorber])
        feet = [dofs[node][k] for node in nodes for k in (0, 1)]
        if min(feet) < 0:
            raise NotMeasured("a foot is held by a constraint between nodes")
        _check_bound(ops, self.nodes, dofs)
        links = (stiffness != 0.0) | (mass != 0.0)
        for node in nodes:
            own = set(_connected(links, dofs[node][:2]))
            if all(other == node or own.isdisjoint(of) for other, of in dofs.items()):
                raise NotMeasured(
                    f"node {node} carries none of the structure: no element joins it to another node that is free"
                )
        rows = _connected(links, feet)
        index = {old: new for new, old in enumerate(rows)}
        self.there = {node for node, of in dofs.items() if any(dof in index for dof in of)}
        self.stiffness, self.mass = (a[np.ix_(rows, rows)] for a in (stiffness, mass))
        self.stiffness = 0.5 * (self.stiffness + self.stiffness.T)
        self.feet = [index[dof] for dof in feet]
        self.places = np.array([ops.nodeCoord(node) for node in nodes])
        self.nodal = sum(float(ops.nodeMass(node, 2)) for node in self.there)
        # rigid motions: to the right, up, and a turn about the origin
        self.rigid = np.zeros((3, len(rows)))
        for node, of in dofs.items():
            x, y = ops.nodeCoord(node)
            for k, motion in enumerate(((1.0, 0.0, -y), (0.0, 1.0, x), (0.0, 0.0, 1.0))):
                if k < len(of) and of[k] in index:
                    self.rigid[:, index[of[k]]] = motion

    @property
    def total(self) -> float:
        """All mass, kg."""
        return float(self.rigid[1] @ self.mass @ self.rigid[1])

    def inertia(self, omega: float) -> Array:
        """W at Omega, rad/s: rows and columns x, y of every foot, 1/kg."""
        size = len(self.mass)
        # both sides scaled to a diagonal of ones: masses, inertias and stiffnesses differ by powers of ten
        matrix = self.stiffness + omega**2 * self.mass
        scale = 1.0 / np.sqrt(np.maximum(np.abs(np.diag(matrix)), 1e-300))
        pushes = np.zeros((size, len(self.feet)))
        pushes[self.feet, np.arange(len(self.feet))] = 1.0
        try:
            moved = scale[:, None] * np.linalg.solve(scale[:, None] * matrix * scale, scale[:, None] * pushes)
        except np.linalg.LinAlgError as error:
            raise NotMeasured("a node turns or moves freely that nothing holds") from error
        w: Array = omega**2 * moved[self.feet]
        return 0.5 * (w + w.T)

    def effective(self, omega: float) -> Array:
        """Mass that each foot feels vertically while it is held across, kg."""
        w = self.inertia(omega)
        each = [w[2 * i : 2 * i + 2, 2 * i : 2 * i + 2] for i in range(len(self.nodes))]
        return np.array([a[0, 0] / (a[0, 0] * a[1, 1] - a[0, 1] * a[1, 0]) for a in each])

    def springlike(self, omega: float) -> list[int]:
        """Feet without mass: what each feels falls as that of a spring, with 1/Omega^2."""
        one, two = self.effective(omega), self.effective(2.0 * omega)
        return [node for node, a, b in zip(self.nodes, one, two, strict=True) if b < 0.4 * a]

    def held(self) -> tuple[Held, Held]:
        """The structure held at its feet under 1 m/s2 sideways, and upwards."""
        free = np.setdiff1d(np.arange(len(self.mass)), self.feet)
        inner = self.stiffness[np.ix_(free, free)]
        found = []
        for direction in self.rigid[:2]:
            load = -self.mass @ direction
            u = np.zeros(len(self.mass))
            try:
                u[free] = np.linalg.solve(inner, load[free])
            except np.linalg.LinAlgError as error:
                raise NotMeasured("the structure does not stand with its feet held") from error
            work = float(u @ self.stiffness @ u)
            if not (math.isfinite(work) and work > 0.0):
                raise NotMeasured("the structure does not stand with its feet held")
            reactions = (self.stiffness @ u - load)[self.feet].reshape(-1, 2)
            found.append(Held(reactions, work, math.sqrt(work / float(u @ self.mass @ u))))
        return found[0], found[1]

    def parts(self, w: Array) -> list[list[int]]:
        """Feet of one rigid part each, from the left: those whose motions W couples."""
        count = len(self.nodes)
        size = np.sqrt(np.abs(np.diag(w)))
        coupled = np.abs(w) / np.maximum(np.outer(size, size), 1e-300) > COUPLED
        groups = list(range(count))
        for i, j in itertools.combinations(range(count), 2):
            if coupled[2 * i : 2 * i + 2, 2 * j : 2 * j + 2].any():
                groups = [groups[i] if group == groups[j] else group for group in groups]
        parts = [[i for i in range(count) if groups[i] == group] for group in dict.fromkeys(groups)]
        return [sorted(part, key=lambda i: float(self.places[i, 0])) for part in parts]

    def spread(self) -> Array:
        """How far two neighbouring feet move apart under a foot's share of the weight, m: what ties them gives so much.
        A column a pair, from the left."""
        order = [int(i) for i in np.argsort(self.places[:, 0])]
        # slowly: far below any frequency of the structure, whose rigid motions a pair of forces does not move
        slow = 1e-3 * self.held()[0].omega
        w = self.inertia(slow) / slow**2
        share = GRAVITY * self.total / len(self.nodes)
        pairs = zip(order, order[1:], strict=False)
        return np.array([share * (w[2 * i, 2 * i] + w[2 * j, 2 * j] - 2.0 * w[2 * i, 2 * j]) for i, j in pairs])

    def landing_speed(self) -> float:
        """At which a foot lands that fell from half of what overturns, as a rigid body's: 2b p alpha sqrt(3)/2, m/s."""
        mass, turn = self.total, self.rigid[2]
        x, y = float(self.rigid[1] @ self.mass @ turn) / mass, -float(self.rigid[0] @ self.mass @ turn) / mass
        inertia = float(turn @ self.mass @ turn) - mass * (x * x + y * y)
        half = float(np.ptp(self.places[:, 0])) / 2.0
        height = y - float(self.places[:, 1].mean())
        if half <= 0.0 or height <= 0.0:
            raise NotMeasured("the feet are not apart, or the mass is not above them")
        radius = math.hypot(half, height)
        p = math.sqrt(GRAVITY / radius / (1.0 + max(inertia, 0.0) / mass / radius**2))
        return 2.0 * half * p * math.atan2(half, height) * math.sqrt(0.75)


def _assembled(ops: Any, factors: tuple[float, float, float], constraints: str) -> tuple[Array, dict[int, list[int]]]:
    """Mass, damping and stiffness matrix times these, and every node's equations; -1 where it is fixed."""
    ops.wipeAnalysis()
    ops.constraints(constraints)
    ops.numberer("Plain")
    ops.system("FullGeneral")
    ops.algorithm("Linear")
    ops.integrator("GimmeMCK", *factors)
    ops.analysis("Transient")
    try:
        # numbers the equations; no step is taken, nothing is solved
        ops.initialize()
        count = ops.systemSize()
        if not 0 < count <= MOST_EQUATIONS:
            raise NotMeasured(f"the model has {count} equations; up to {MOST_EQUATIONS} are measured")
        values = np.array(ops.printA("-ret"))
        dofs = {node: ops.nodeDOFs(node) for node in ops.getNodeTags()}
    finally:
        ops.wipeAnalysis()
    if values.size != count * count:
        raise NotMeasured("OpenSees does not give its matrices")
    matrix: Array = values.reshape(count, count)
    return matrix, dofs


def _take_off(stiffness: Array, foot: list[int], absorber: list[int]) -> None:
    """Take the springs between a foot and its absorber out of the matrix."""
    for k, a in itertools.product((0, 1), (0, 1)):
        if foot[k] >= 0 and absorber[a] >= 0:
            # what joins two displacements of one place stands off the diagonal with its sign turned
            stiffness[foot[k], foot[a]] += stiffness[foot[k], absorber[a]]
    for dof in absorber:
        if dof >= 0:
            stiffness[dof, :] = stiffness[:, dof] = 0.0


def _check_bound(ops: Any, feet: Sequence[int], dofs: Mapping[int, Sequence[int]]) -> None:
    """Refuse feet that a constraint binds to a node at another place: OpenSees gives them the equations of that node,
    and not how far from it they are."""
    for node in feet:
        for other in ops.getRetainedNodes() or []:
            if node not in ops.getConstrainedNodes(other):
                continue
            apart = ops.nodeCoord(node) != ops.nodeCoord(other)
            if apart or set(dofs[node][:2]).isdisjoint(dofs[other]):
                raise NotMeasured(
                    f"node {node} is bound to node {other} by a constraint (rigidLink, equalDOF), and what lands there "
                    "cannot be measured; join them by a stiff elasticBeamColumn"
                )


def _connected(links: Any, first: list[int]) -> list[int]:
    """Equations that hang together with the first ones."""
    seen = np.zeros(len(links), dtype=bool)
    seen[first] = True
    front = seen.copy()
    while front.any():
        front = links[front].any(axis=0) & ~seen
        seen |= front
    return [int(i) for i in np.flatnonzero(seen)]
