# @TITLE@
#
# Runs as it is:  OpenSees THIS_FILE   (or, with the PyPI package opensees:  python3 -m opensees THIS_FILE)
# It writes u, v, theta of the mass at every sample of the record to THIS_FILE's name with _history.csv, and compares its
# peaks with those of `tune simulate`. Exit code: 0 within 1 %, 1 not within 1 %, 2 the analysis stopped.
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
set tendonK @TENDON_K@ ;# from the mass to the ground between the feet, N/m; 0: none
set tendonSlack @TENDON_SLACK@ ;# its length without tension, m

set recordDt       @RECORD_DT@ ;# s
set accuracy @ACCURACY@ ;# of the history, as a normalised error: @ACCURACY_NOTE@
set landing  @LANDING@ ;# 1/Omega_n of the vertical k1, s
set rise     @RISE@ ;# of a foot, m, from which on its motion counts: a hundredth of where the body topples
set stepsPerSample @STEPS@ ;# at least; more change nothing
set samples        @SAMPLES@ ;# of the record that are followed: @DURATION@ s

# What `tune simulate` found for the same springs and record, m: the check at the end.
set expected [list settled @SETTLED@ uMax @U_MAX@ uMin @U_MIN@ vMax @V_MAX@ vMin @V_MIN@]

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
proc solver {integrator kind} {
    constraints Plain
    numberer RCM
    system UmfPack
    # By displacement: forces of 1e12 N/m springs never meet a sensible force tolerance.
    test NormDispIncr @TOLERANCE@ 30 0
    algorithm Newton
    eval integrator $integrator
    analysis $kind
}

# ---------------------------------------------------------------- steps
@ROUTINE@

proc stop {reason} {
    puts stderr "stopped: $reason"
    exit 2
}

# ---------------------------------------------------------------- gravity
# Settled, m.
proc gravity {} {
    global mass gravity
    # The weight, as a load on the mass (absorbers carry none).
    timeSeries Linear 1
    pattern Plain 1 1 "load 3 0.0 [expr {-$mass * $gravity}] 0.0"
    solver {LoadControl 0.1} Static
    if {[analyze 10] != 0} { stop "gravity did not converge" }
    loadConst -time 0.0
    wipeAnalysis
    return [nodeDisp 3 2]
}

# ---------------------------------------------------------------- ground motion
# @RECORD_NOTE@
set record {
@RECORD@
}@VERTICAL@

# ---------------------------------------------------------------- history
# The whole history: rows of t, u, v, theta.
proc run {accuracy} {
    global mass m2h record recordDt stepsPerSample landing rise samples settled
    build
    set settled [gravity]
    # Linear between samples: as loads -mass times it.
    timeSeries Path 2 -dt $recordDt -values $record -factor 1.0
    pattern Plain 2 2 "load 3 [expr {-$mass}] 0.0 0.0; load 11 [expr {-$m2h}] 0.0 0.0; load 12 [expr {-$m2h}] 0.0 0.0"@VERTICAL_LOADS@
    # TRBDF2 is L-stable: Newmark (1/2, 1/4) and HHT fail on springs this stiff, Newmark with damping spoils the answer.
    solver TRBDF2 Transient
    steps::start {1 11 2 12} $landing [expr {$recordDt / $stepsPerSample}] $rise $accuracy
    set rows {{0.0 0.0 0.0 0.0}}
    for {set i 1} {$i < $samples} {incr i} {
        if {![steps::advance [expr {$i * $recordDt}]]} {
            stop "no convergence at [getTime] s, in steps of $steps::allowed s: [steps::report]"
        }
        # OpenSees turns counter-clockwise
        lappend rows [list [expr {$i * $recordDt}] [nodeDisp 3 1] [expr {[nodeDisp 3 2] - $settled}] [expr {-[nodeDisp 3 3]}]]
        if {floor($i * $recordDt) > floor(($i - 1) * $recordDt)} {
            puts stderr [format "%.0f s of %g s" [expr {$i * $recordDt}] [expr {($samples - 1) * $recordDt}]]
        }
    }
    return $rows
}

# One run: OpenSees' Tcl interpreter does not forget a model's loads, so that a second one needs a new interpreter. If the report at the
# end warns of touches or lifts within too long a step, make `accuracy` a quarter of what it is and run again.
puts stderr "OpenSees tells of every step that does not converge; such steps are repeated shorter"
set rows [run $accuracy]

set out [open "[file rootname [info script]]_history.csv" w]
puts $out "t,u,v,th"
array set found [list settled $settled uMax 0.0 uMin 0.0 vMax 0.0 vMin 0.0]
foreach row $rows {
    foreach {t u v th} $row {}
    puts $out [format "%.17g,%.17g,%.17g,%.17g" $t $u $v $th]
    set found(uMax) [expr {max($found(uMax), $u)}]
    set found(uMin) [expr {min($found(uMin), $u)}]
    set found(vMax) [expr {max($found(vMax), $v)}]
    set found(vMin) [expr {min($found(vMin), $v)}]
}
close $out

# ---------------------------------------------------------------- check
# 1 % of the largest motion in that direction
array set want $expected
set scale(s) [expr {abs($want(settled))}]
set scale(u) [expr {max(abs($want(uMax)), abs($want(uMin)))}]
set scale(v) [expr {max(abs($want(vMax)), abs($want(vMin)))}]
set good 1
puts [format "OpenSees, %g s: %s" [expr {($samples - 1) * $recordDt}] [steps::report]]
if {$steps::refused > 0} { puts "  OpenSees' messages of failed convergence are those of the pairs repeated" }
foreach {key value} $expected {
    set kind [string index $key 0]
    if {abs($found($key) - $value) > 0.01 * $scale($kind)} { set good 0 }
    puts [format "  %-8s %12.4f mm, expected %12.4f mm" $key [expr {$found($key) * 1e3}] [expr {$value * 1e3}]]
}
puts "within 1 %: [expr {$good ? {yes} : {no}}]"
exit [expr {1 - $good}]
