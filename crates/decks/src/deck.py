#!/usr/bin/env python3
"""@TITLE@

Runs as it is:  python3 THIS_FILE  (needs openseespy: pip install openseespy; on Debian also
apt install libblas3 liblapack3). It writes u, v, theta of the mass at every sample of the record to
THIS_FILE's name with _history.csv, and compares its peaks with those of @OURS@.
Exit code: 0 within 1 %, 1 not within 1 %, 2 the analysis stopped, 3 openseespy cannot be loaded,
4 within 1 % on springs that are of no use, whose reason is printed.

The model: a rigid body on two feet. Under each foot, vertically and horizontally,

    foot - gap, k1 - absorber m2 - (k2 parallel with dashpot c) - ground

Plane model, SI units (N, m, kg, s). u is positive to the right, v up from the settled position, theta positive
leaning to the right.
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
HEIGHT = @HEIGHT@              # h, of the centre of mass above the feet, m
HALF_WIDTH = @HALF_WIDTH@      # b, half the distance between the feet, m
MASS = @MASS@                  # m1, kg
INERTIA = @INERTIA@            # about the centre of mass, kg m2: @INERTIA_NOTE@
LEG = @LEG@                    # EA/L = 3EI/L^3 of the legs that stand for the body, N/m: @LEG_RATIO@ times the stiffest k1

K1_V = @K1_V@                  # vertical chain: gap spring, N/m
K2_V = @K2_V@                  # ground spring, N/m
C_V = @C_V@                    # dashpot, N s/m
M2_V = @M2_V@                  # absorber mass, kg
K1_H = @K1_H@                  # horizontal chain
K2_H = @K2_H@
C_H = @C_H@
M2_H = @M2_H@

DAMPER_C = @DAMPER_C@          # dashpot between the ground and each corner of the body, N s/m; 0: none
DAMPER_ALOFT = @DAMPER_ALOFT@      # dashpot on the mass in their place while no foot is on the ground, N s/m; 0: they stay
TENDON_K = @TENDON_K@          # from the mass to the ground between the feet, N/m; 0: none
TENDON_SLACK = @TENDON_SLACK@  # its length without tension, m

RECORD_DT = @RECORD_DT@        # s
ACCURACY = @ACCURACY@          # of the history, as a normalised error: @ACCURACY_NOTE@
LANDING = @LANDING@            # 1/Omega_n of the vertical k1, s
RISE = @RISE@               # of a foot, m, from which on its motion counts: a hundredth of where the body topples
STEPS_PER_SAMPLE = @STEPS@     # at least; @STEPS_NOTE@
SAMPLES = @SAMPLES@            # of the record that are followed: @DURATION@ s
COMPARED = @COMPARED@          # of these that EXPECTED is of, to @COMPARED_S@ s; fewer where @BEYOND@
TOLERANCE = @TOLERANCE@        # of Newton's displacements, m

# What @OURS@ found for the same springs and record, m: the check at the end.
EXPECTED = {
    "settled": @SETTLED@,
    "u max": @U_MAX@,
    "u min": @U_MIN@,
    "v max": @V_MAX@,
    "v min": @V_MIN@,
}

# ---------------------------------------------------------------- tags
TOP = 3                                      # the mass
FEET = ((1, -HALF_WIDTH), (2, HALF_WIDTH))   # node of the foot, x
ABSORBER, GROUND = 10, 20                    # added to the foot's tag


def build():
    """Nodes, masses, legs, springs."""
    ops.wipe()
    ops.model("basic", "-ndm", 2, "-ndf", 3)
    ops.node(TOP, 0.0, HEIGHT)
    ops.mass(TOP, MASS, MASS, INERTIA)

    # Legs from the centre of mass to the feet stand for the rigid body. They need not be stiff: what they give, the same in every
    # direction, is taken off the gap's k1, so that both in series are k1; stiffer ones lose digits of its force.
    # Products in this order: a body in a live model, which has them so, is equal to the last bit.
    length = math.sqrt(HALF_WIDTH * HALF_WIDTH + HEIGHT * HEIGHT)
    ea, ei = LEG * length, LEG * (length * (length * length)) / 3.0
    gap_v, gap_h = (k1 / (1.0 - k1 * (1.0 / LEG)) for k1 in (K1_V, K1_H))
    # Corotational: with Linear the weight's moment on the leaning body (P-Delta), which drives rocking, is lost.
    ops.geomTransf("Corotational", 1)

    # k2 parallel with c: Elastic takes the dashpot as its third number, eta.
    ops.uniaxialMaterial("Elastic", 1, K2_H, C_H)
    ops.uniaxialMaterial("Elastic", 2, K2_V, C_V)
    # Gap k1: no tension (ENT), parallel with a trace of tension. The bearing moves a lifted foot's anchor along with the
    # foot only while its axial force is above zero; with exactly zero (ENT alone) the foot would be pulled back to where
    # it stood before, which creates energy.
    ops.uniaxialMaterial("ENT", 31, gap_v)
    ops.uniaxialMaterial("Elastic", 32, 1e-9 * gap_v)
    ops.uniaxialMaterial("Parallel", 3, 31, 32)
    # The bearing asks for a moment spring; this one is too weak to be felt (1e-9 of the weight's own moment).
    ops.uniaxialMaterial("Elastic", 5, 1e-9 * MASS * GRAVITY * length)
    # Friction, unless one is asked for, so high that a pressing foot never slides: the horizontal spring k1 acts whenever the foot presses,
    # and not at all when it is in the air.
    ops.frictionModel("Coulomb", 1, @FRICTION@)

    for foot, x in FEET:
        absorber, ground = foot + ABSORBER, foot + GROUND
        for node in (foot, absorber, ground):
            ops.node(node, x, 0.0)
        ops.fix(ground, 1, 1, 1)
        # The bearing's axes turn with its first node: the absorber must not rotate.
        ops.fix(absorber, 0, 0, 1)
        # One node carries both absorbers: OpenSees takes a mass per direction.
        ops.mass(absorber, M2_H, M2_V, 0.0)
        ops.element("elasticBeamColumn", foot, foot, TOP, ea, 1.0, ei, 1)
        ops.element("zeroLength", 30 + foot, ground, absorber, "-mat", 1, 2, "-dir", 1, 2)
        # Axial direction up (local x = global y); the horizontal k1 is the bearing's shear stiffness.
        ops.element("flatSliderBearing", 50 + foot, absorber, foot, 1, gap_h,
                    "-P", 3, "-Mz", 5, "-orient", 0, 1, 0, -1, 0, 0)
        if DAMPER_C > 0.0:
            # on an arm of its own: what the leg gives is the gap's
            arm = foot + 40
            ops.node(arm, x, 0.0)
            ops.element("elasticBeamColumn", arm, arm, TOP, ea, 1.0, ei, 1)
            ops.uniaxialMaterial("Elastic", 70 + foot, 0.0, DAMPER_C)
            ops.element("zeroLength", 70 + foot, ground, arm, "-mat", 70 + foot, "-dir", 2)

    if DAMPER_ALOFT > 0.0:
        ops.node(5, 0.0, HEIGHT)
        ops.fix(5, 1, 1, 1)
        ops.uniaxialMaterial("Elastic", 79, 0.0, 0.0)
        ops.element("zeroLength", 79, 5, TOP, "-mat", 79, "-dir", 2)

    if TENDON_K > 0.0:
        ops.node(4, 0.0, 0.0)
        # A beam that can hardly bend: a corotTruss does not turn with the body in every build of OpenSees.
        ops.fix(4, 1, 1, 0)
        # no compression: the third stiffness; stressed: a strain from the slack length
        ops.uniaxialMaterial("Elastic", 81, TENDON_K * HEIGHT, 0.0, 0.0)
        ops.uniaxialMaterial("InitStrainMaterial", 82, 81, (HEIGHT - TENDON_SLACK) / HEIGHT)
        ops.uniaxialMaterial("Elastic", 83, 1e-9 * MASS * GRAVITY * HEIGHT**2)
        ops.section("Aggregator", 80, 82, "P", 83, "Mz")
        ops.beamIntegration("Legendre", 80, 80, 2)
        ops.element("dispBeamColumn", 80, 4, TOP, 1, 80)


@SOLVER@


@ROUTINE@


def aloft(flies):
    """Dampers of a body with next to no rotational inertia turn it while a foot is on the ground, and hold but its mass while
    none is: there they would stop its rotation at once, and make a hop of the slightest rebound, in which it moves along."""
    for foot, _ in FEET:
        ops.setParameter("-val", 0.0 if flies else DAMPER_C, "-ele", 70 + foot, "eta")
    ops.setParameter("-val", DAMPER_ALOFT if flies else 0.0, "-ele", 79, "eta")


COLUMNS = ("u", "v", "th")


def checked(_):
    """What is checked: name, column of the history, where it starts, m."""
    return ("u", 1, 0.0), ("v", 2, 0.0)


def run(accuracy):
    """The whole history: rows of t, u, v, theta; the settled position; the steps."""
    build()
    settled = gravity([(TOP, MASS)])
    absorbers = [foot + ABSORBER for foot, _ in FEET]
    shake(2, RECORD, 0, [(TOP, MASS)] + [(absorber, M2_H) for absorber in absorbers])
    if VERTICAL:
        shake(3, VERTICAL, 1, [(TOP, MASS)] + [(absorber, M2_V) for absorber in absorbers])

    def sample():
        u, v, turn = (ops.nodeDisp(TOP, k) for k in (1, 2, 3))
        return u, v - settled, -turn  # OpenSees turns counter-clockwise

    feet = [(foot, foot + ABSORBER) for foot, _ in FEET]
    rows, steps = follow(feet, accuracy, sample, aloft if DAMPER_ALOFT > 0.0 else None)
    return rows, settled, steps


@EPILOGUE@
