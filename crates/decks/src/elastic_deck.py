#!/usr/bin/env python3
"""@TITLE@

Runs as it is:  python3 THIS_FILE  (needs openseespy 3.5 or later: pip install openseespy; on Debian also
apt install libblas3 liblapack3). It writes the displacements of every node at every sample of the record to
THIS_FILE's name with _history.csv, and compares the peaks of the top's with those of @OURS@.
Exit code: 0 within 1 %, 1 not within 1 %, 2 the analysis stopped, 3 openseespy cannot be loaded,
4 within 1 % on springs that are of no use, whose reason is printed.

The model: an elastic structure on rigid footings or feet. Under each corner, vertically and horizontally,

    corner - gap, k1 - absorber m2 - (k2 parallel with dashpot c) - ground

Plane model, SI units (N, m, kg, s). x is positive to the right, z up; rotations are positive clockwise, leaning to the right.
"""
import csv
import math
import os
import sys

try:
    import openseespy.opensees as ops
except (ImportError, RuntimeError, OSError) as error:
    print(f"openseespy cannot be loaded ({error}): pip install openseespy; on Debian also apt install libblas3 liblapack3",
          file=sys.stderr)
    sys.exit(3)

# ---------------------------------------------------------------- numbers
GRAVITY = @GRAVITY@            # m/s2

# Nodes at their centres of mass: x, z (m), mass (kg), rotational inertia (kg m2; 0: a point, beams meet it by hinges).
NODES = (
@NODES@
)
TOP = @TOP@                    # tag of the node whose motion is checked

# Beams: nodes, arms from the nodes to the beam's ends (m), EA (N), EI (N m2), and times by which a stiffness-proportional dashpot
# makes their axial force and their moments run ahead of the deformation (s). A hinge at an end is a node that turns freely there.
# @DAMPING@
BEAMS = (
@BEAMS@
)
@SHEAR@
# Corners: node, arm from it (m); the spring-absorber units under it, vertical and horizontal: k1, k2 (N/m), c (N s/m), m2 (kg).
CORNERS = (
@CORNERS@
)
# Dashpots between a place on a node and the ground: node, arm (m), horizontal and vertical (N s/m).
DAMPERS = (
@DAMPERS@
)

# Tendons to the ground, which only pull: node, arm (m), lower end x, z (m), N/m, tension in the unstressed structure (N).
TENDONS = (
@TENDONS@
)

RECORD_DT = @RECORD_DT@        # s
DAMPED_FROM = @DAMPED_FROM@    # s: from here on dashpots of beams work
ACCURACY = @ACCURACY@          # of the history, as a normalised error: the steps follow from it
LANDING = @LANDING@            # s: sqrt(mass that lands / k1), what a landing takes
RISE = @RISE@                  # of a corner, m, from which on its motion counts: a hundredth of where the structure topples
STEPS_PER_SAMPLE = @STEPS@     # at least
SAMPLES = @SAMPLES@            # of the record that are followed: @DURATION@ s
COMPARED = @COMPARED@          # of these that EXPECTED is of, to @COMPARED_S@ s; fewer where @BEYOND@
TOLERANCE = @TOLERANCE@        # of Newton's displacements, m

# What @OURS@ found for the same springs and record, m: the check at the end.
EXPECTED = {
    "settled": @SETTLED@,
    "x max": @X_MAX@,
    "x min": @X_MIN@,
    "z max": @Z_MAX@,
    "z min": @Z_MIN@,
}

# ---------------------------------------------------------------- tags
# Added to the index of a corner, a dashpot, a tendon, a beam's end.
CORNER, ABSORBER, GROUND, PLACE, TIE, END = 1000, 2000, 3000, 4000, 5000, 8000


def node(i):
    return i + 1


def rigid_arm(tag, i, place, offset, stiffness):
    """The node at an offset (x, z) from node i, on a stiff arm; node i itself without an offset."""
    if offset == (0.0, 0.0):
        return node(i)
    x, z = NODES[i][:2]
    ops.node(place, x + offset[0], z + offset[1])
    length = math.hypot(*offset)
    ops.element("elasticBeamColumn", tag, node(i), place, stiffness * length, 1.0, stiffness * length**3 / 3.0, 1)
    return place


def build():
    """Nodes, masses, beams, springs."""
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    for i, (x, z, mass, inertia) in enumerate(NODES):
        ops.node(node(i), x, z)
        ops.mass(node(i), mass, mass, inertia)

    # Corotational: with Linear the weight's moment on the leaning structure (P-Delta), which drives rocking, is lost.
    ops.geomTransf("Corotational", 1)
    # The arms stand for rigid footings; stiffer ones lose digits of a gap's force.
    rigid = @LEG@ * max(max(v[0], h[0]) for _, _, v, h in CORNERS)
    for i, (a, b, arm_a, arm_b, axial, bending, ahead_axial, ahead_bending) in enumerate(BEAMS):
        tag = 1000 + 10 * i
        # arms of their own: a transformation's joint offsets turn as if rotations were small, which P-Delta feels
        ends = [rigid_arm(tag + 2 + k, owner, END + 2 * i + k, arm, rigid)
                for k, (owner, arm) in enumerate(((a, arm_a), (b, arm_b)))]
        # One beam for the axial force, one for the moments: each has a dashpot of its own. The dashpots act on the deformation,
        # so that a rotation of the whole structure meets none.
        for part, (ea, ei, ahead) in enumerate(((axial, 0.0, ahead_axial), (0.0, bending, ahead_bending))):
            damping = ()
            if ahead > 0.0:
                # not in the first step, which would take a part of the weight's force for a change since the one before
                ops.damping("SecStif", tag + part, ahead, "-activateTime", DAMPED_FROM)
                damping = ("-damp", tag + part)
            ops.element("elasticBeamColumn", tag + part, *ends, ea, 1.0, ei, 1, *damping)
@SHEAR_SPRINGS@
    # Friction so high that a pressing corner never slides: the horizontal spring k1 acts whenever the corner presses, and not at
    # all when it is in the air.
    ops.frictionModel("Coulomb", 1, @FRICTION@)
    for i, (owner, arm, (k1, k2, c, m2), (k1_h, k2_h, c_h, m2_h)) in enumerate(CORNERS):
        absorber, ground = ABSORBER + i, GROUND + i
        foot = rigid_arm(20000 + i, owner, CORNER + i, arm, rigid)
        # What an arm gives is the same in every direction: taken off the gap's, both in series are k1.
        give = 1.0 / rigid if foot == CORNER + i else 0.0
        gap, gap_h = (k / (1.0 - k * give) for k in (k1, k1_h))
        x, z = (NODES[owner][k] + arm[k] for k in (0, 1))
        for tag in (absorber, ground):
            ops.node(tag, x, z)
        ops.fix(ground, 1, 1, 1)
        # The bearing's axes turn with its first node: the absorber must not rotate.
        ops.fix(absorber, 0, 0, 1)
        # One node carries both absorbers: OpenSees takes a mass per direction.
        ops.mass(absorber, m2_h, m2, 0.0)
        # k2 parallel with c: Elastic takes the dashpot as its third number, eta.
        material = 10 * (i + 1)
        ops.uniaxialMaterial("Elastic", material, k2_h, c_h)
        ops.uniaxialMaterial("Elastic", material + 1, k2, c)
        # Gap k1: no tension (ENT), parallel with a trace of tension. The bearing moves a lifted corner's anchor along with it only while
        # its axial force is above zero; with exactly zero (ENT alone) the corner would be pulled back to where it stood before,
        # which creates energy.
        ops.uniaxialMaterial("ENT", material + 2, gap)
        ops.uniaxialMaterial("Elastic", material + 3, 1e-9 * gap)
        ops.uniaxialMaterial("Parallel", material + 4, material + 2, material + 3)
        # The bearing asks for a moment spring; this one is too weak to be felt.
        ops.uniaxialMaterial("Elastic", material + 5, 1e-9 * GRAVITY * sum(n[2] for n in NODES))
        ops.element("zeroLength", 30000 + i, ground, absorber, "-mat", material, material + 1, "-dir", 1, 2)
        # Axial direction up (local x = global y); the horizontal k1 is the bearing's shear stiffness.
        ops.element("flatSliderBearing", 40000 + i, absorber, foot, 1, gap_h,
                    "-P", material + 4, "-Mz", material + 5, "-orient", 0, 1, 0, -1, 0, 0)
    for i, (owner, arm, horizontal, vertical) in enumerate(DAMPERS):
        ground = GROUND + PLACE + i
        place = rigid_arm(50000 + i, owner, PLACE + i, arm, rigid)
        ops.node(ground, *ops.nodeCoord(place))
        ops.fix(ground, 1, 1, 1)
        for k, c in enumerate((horizontal, vertical)):
            ops.uniaxialMaterial("Elastic", 60000 + 2 * i + k, 0.0, c)
        ops.element("zeroLength", 60000 + i, ground, place, "-mat", 60000 + 2 * i, 60001 + 2 * i, "-dir", 1, 2)
    for i, (owner, arm, below, stiffness, tension) in enumerate(TENDONS):
        anchor, material = TIE + 1000 + i, 70000 + 10 * i
        place = rigid_arm(80000 + i, owner, TIE + i, arm, rigid)
        ops.node(anchor, *below)
        length = math.dist(ops.nodeCoord(place), below)
        # A beam that can hardly bend: a corotTruss does not turn with the structure in every build of OpenSees.
        ops.fix(anchor, 1, 1, 0)
        # no compression: the third stiffness; stressed: a strain from the slack length
        ops.uniaxialMaterial("Elastic", material, stiffness * length, 0.0, 0.0)
        ops.uniaxialMaterial("InitStrainMaterial", material + 1, material, tension / (stiffness * length))
        ops.uniaxialMaterial("Elastic", material + 2, 1e-9 * GRAVITY * sum(n[2] for n in NODES) * length**2)
        ops.section("Aggregator", material, material + 1, "P", material + 2, "Mz")
        ops.beamIntegration("Legendre", material, material, 2)
        ops.element("dispBeamColumn", 81000 + i, anchor, place, 1, material)


def corner(i):
    """The node of corner i: its owner where it sits on it, else one on an arm."""
    owner, arm = CORNERS[i][:2]
    return node(owner) if arm == (0.0, 0.0) else CORNER + i


@SOLVER@


@ROUTINE@


COLUMNS = [f"{name}{i}" for i in range(len(NODES)) for name in ("x", "z", "th")]


def checked(settled):
    """What is checked: name, column of the history, where it starts, m."""
    column = COLUMNS.index(f"x{TOP - 1}") + 1
    return ("x", column, 0.0), ("z", column + 1, settled)


def run(accuracy):
    """The whole history: rows of t and displacements; where the top settled; the steps."""
    build()
    masses = [(node(i), mass) for i, (_, _, mass, _) in enumerate(NODES)]
    settled = gravity(masses)
    absorbers = [(ABSORBER + i, horizontal[3], vertical[3]) for i, (_, _, vertical, horizontal) in enumerate(CORNERS)]
    shake(2, RECORD, 0, masses + [(absorber, mass) for absorber, mass, _ in absorbers])
    if VERTICAL:
        shake(3, VERTICAL, 1, masses + [(absorber, mass) for absorber, _, mass in absorbers])

    def sample():
        # OpenSees turns counter-clockwise
        return [sign * ops.nodeDisp(node(i), k) for i in range(len(NODES)) for k, sign in ((1, 1.0), (2, 1.0), (3, -1.0))]

    rows, steps = follow([(corner(i), ABSORBER + i) for i in range(len(CORNERS))], accuracy, sample)
    return rows, settled, steps


@EPILOGUE@
