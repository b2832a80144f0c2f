# @TITLE@
#
# Runs as it is:  OpenSees THIS_FILE   (or, with the PyPI package opensees:  python3 -m opensees THIS_FILE)
# It writes u, v, theta of the mass at every sample of the record to THIS_FILE's name with _history.csv, and compares its
# peaks with those of @OURS@. Exit code: 0 within 1 %, 1 not within 1 %, 2 the analysis stopped,
# 4 within 1 % on springs that are of no use, whose reason is printed.
#
# The model: a rigid body on two feet. Under each foot, vertically and horizontally,
#
#     foot - gap, k1 - absorber m2 - (k2 parallel with dashpot c) - ground
#
# Plane model, SI units (N, m, kg, s). u is positive to the right, v up from the settled position, theta positive
# leaning to the right.

# ---------------------------------------------------------------- numbers
set gravity   @GRAVITY@    ;# m/s2
set height    @HEIGHT@     ;# h, of the centre of mass above the feet, m
set halfWidth @HALF_WIDTH@ ;# b, half the distance between the feet, m
set mass      @MASS@       ;# m1, kg
set inertia   @INERTIA@    ;# about the centre of mass, kg m2: @INERTIA_NOTE@
set leg       @LEG@        ;# EA/L = 3EI/L^3 of the legs that stand for the body, N/m: @LEG_RATIO@ times the stiffest k1

set k1v @K1_V@ ;# vertical chain: gap spring, N/m
set k2v @K2_V@ ;# ground spring, N/m
set cv  @C_V@ ;# dashpot, N s/m
set m2v @M2_V@ ;# absorber mass, kg
set k1h @K1_H@ ;# horizontal chain
set k2h @K2_H@
set ch  @C_H@
set m2h @M2_H@

set damperC @DAMPER_C@ ;# dashpot between the ground and each corner of the body, N s/m; 0: none
set damperAloft @DAMPER_ALOFT@ ;# dashpot on the mass in their place while no foot is on the ground, N s/m; 0: they stay
set tendonK @TENDON_K@ ;# from the mass to the ground between the feet, N/m; 0: none
set tendonSlack @TENDON_SLACK@ ;# its length without tension, m

set recordDt       @RECORD_DT@ ;# s
set accuracy @ACCURACY@ ;# of the history, as a normalised error: @ACCURACY_NOTE@
set landing  @LANDING@ ;# 1/Omega_n of the vertical k1, s
set rise     @RISE@ ;# of a foot, m, from which on its motion counts: a hundredth of where the body topples
set stepsPerSample @STEPS@ ;# at least; @STEPS_NOTE@
set samples        @SAMPLES@ ;# of the record that are followed: @DURATION@ s
set compared       @COMPARED@ ;# of these that `expected` is of, to @COMPARED_S@ s; fewer where @BEYOND@
set tolerance      @TOLERANCE@ ;# of Newton's displacements, m
set top            3 ;# node of the mass

# What @OURS@ found for the same springs and record, m: the check at the end.
set expected [list settled @SETTLED@ {u max} @U_MAX@ {u min} @U_MIN@ {v max} @V_MAX@ {v min} @V_MIN@]

# ---------------------------------------------------------------- model
proc build {} {
    uplevel #0 {
        wipe
        model basic -ndm 2 -ndf 3
        node 3 0.0 $height
        mass 3 $mass $mass $inertia

        # Legs from the centre of mass to the feet stand for the rigid body. They need not be stiff: what they give, the same in
        # every direction, is taken off the gap's k1, so that both in series are k1; stiffer ones lose digits of its force.
        set length [expr {hypot($halfWidth, $height)}]
        set ea [expr {$leg * $length}]
        set ei [expr {$leg * $length**3 / 3.0}]
        set gapV [expr {$k1v / (1.0 - $k1v / $leg)}]
        set gapH [expr {$k1h / (1.0 - $k1h / $leg)}]
        # Corotational: with Linear the weight's moment on the leaning body (P-Delta), which drives rocking, is lost.
        geomTransf Corotational 1

        # k2 parallel with c: Elastic takes the dashpot as its third number, eta.
        uniaxialMaterial Elastic 1 $k2h $ch
        uniaxialMaterial Elastic 2 $k2v $cv
        # Gap k1: no tension (ENT), parallel with a trace of tension. The bearing moves a lifted foot's anchor along with the foot
        # only while its axial force is above zero; with exactly zero (ENT alone) the foot would be pulled back to where it stood
        # before, which creates energy.
        uniaxialMaterial ENT 31 $gapV
        uniaxialMaterial Elastic 32 [expr {1e-9 * $gapV}]
        uniaxialMaterial Parallel 3 31 32
        # The bearing asks for a moment spring; this one is too weak to be felt (1e-9 of the weight's own moment).
        uniaxialMaterial Elastic 5 [expr {1e-9 * $mass * $gravity * $length}]
        # Friction so high that a pressing foot never slides: the horizontal spring k1 acts whenever the foot presses, and not at
        # all when it is in the air.
        frictionModel Coulomb 1 @FRICTION@

        foreach {foot x} [list 1 [expr {-$halfWidth}] 2 $halfWidth] {
            set absorber [expr {$foot + 10}]
            set ground [expr {$foot + 20}]
            node $foot $x 0.0
            node $absorber $x 0.0
            node $ground $x 0.0
            fix $ground 1 1 1
            # The bearing's axes turn with its first node: the absorber must not rotate.
            fix $absorber 0 0 1
            # One node carries both absorbers: OpenSees takes a mass per direction.
            mass $absorber $m2h $m2v 0.0
            element elasticBeamColumn $foot $foot 3 $ea 1.0 $ei 1
            element zeroLength [expr {$foot + 30}] $ground $absorber -mat 1 2 -dir 1 2
            # Axial direction up (local x = global y); the horizontal k1 is the bearing's shear stiffness.
            element flatSliderBearing [expr {$foot + 50}] $absorber $foot 1 $gapH -P 3 -Mz 5 -orient 0 1 0 -1 0 0
            if {$damperC > 0.0} {
                # on an arm of its own: what the leg gives is the gap's
                set arm [expr {$foot + 40}]
                node $arm $x 0.0
                element elasticBeamColumn $arm $arm 3 $ea 1.0 $ei 1
                uniaxialMaterial Elastic [expr {$foot + 70}] 0.0 $damperC
                element zeroLength [expr {$foot + 70}] $ground $arm -mat [expr {$foot + 70}] -dir 2
            }
        }
        if {$damperAloft > 0.0} {
            node 5 0.0 $height
            fix 5 1 1 1
            uniaxialMaterial Elastic 79 0.0 0.0
            element zeroLength 79 5 3 -mat 79 -dir 2
        }
        if {$tendonK > 0.0} {
            node 4 0.0 0.0
            # A beam that can hardly bend: a corotTruss does not turn with the body in every build of OpenSees.
            fix 4 1 1 0
            # no compression: the third stiffness; stressed: a strain from the slack length
            uniaxialMaterial Elastic 81 [expr {$tendonK * $height}] 0.0 0.0
            uniaxialMaterial InitStrainMaterial 82 81 [expr {($height - $tendonSlack) / $height}]
            uniaxialMaterial Elastic 83 [expr {1e-9 * $mass * $gravity * $height**2}]
            section Aggregator 80 82 P 83 Mz
            element dispBeamColumn 80 4 3 2 80 1
        }
    }
}

# ---------------------------------------------------------------- solver
@SOLVER@

# ---------------------------------------------------------------- steps
@ROUTINE@

# Dampers of a body with next to no rotational inertia turn it while a foot is on the ground, and hold but its mass while none
# is: there they would stop its rotation at once, and make a hop of the slightest rebound, in which it moves along.
proc aloft {flies} {
    global damperC damperAloft
    foreach foot {1 2} { setParameter -val [expr {$flies ? 0.0 : $damperC}] -ele [expr {$foot + 70}] eta }
    setParameter -val [expr {$flies ? $damperAloft : 0.0}] -ele 79 eta
}
if {$damperAloft > 0.0} { set steps::aloft aloft }

set columns {u v th}

# u, v, theta now.
proc sample {} {
    global settled
    # OpenSees turns counter-clockwise
    return [list [nodeDisp 3 1] [expr {[nodeDisp 3 2] - $settled}] [expr {-[nodeDisp 3 3]}]]
}

# What is checked: name, column of the history, where it starts, m.
proc checked {} { return {u 1 0.0 v 2 0.0} }

# The whole history.
proc run {} {
    global settled record vertical mass m2h m2v
    build
    set settled [gravity [list 3 $mass]]
    shake 2 $record 0 [list 3 $mass 11 $m2h 12 $m2h]
    if {[llength $vertical] > 0} { shake 3 $vertical 1 [list 3 $mass 11 $m2v 12 $m2v] }
    return [follow {1 11 2 12}]
}

@EPILOGUE@
