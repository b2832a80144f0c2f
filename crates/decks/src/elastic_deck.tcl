# @TITLE@
#
# Runs as it is:  OpenSees THIS_FILE   (or, with the PyPI package opensees:  python3 -m opensees THIS_FILE)
# It writes the displacements of every node at every sample of the record to THIS_FILE's name with _history.csv, and compares the peaks of
# the top's with those of @OURS@. Exit code: 0 within 1 %, 1 not within 1 %, 2 the analysis stopped,
# 4 within 1 % on springs that are of no use, whose reason is printed.
#
# The model: an elastic structure on rigid footings or feet. Under each corner, vertically and horizontally,
#
#     corner - gap, k1 - absorber m2 - (k2 parallel with dashpot c) - ground
#
# Plane model, SI units (N, m, kg, s). x is positive to the right, z up; rotations are positive clockwise, leaning to the right.

# ---------------------------------------------------------------- numbers
set gravity @GRAVITY@ ;# m/s2

# Nodes at their centres of mass: x, z (m), mass (kg), rotational inertia (kg m2; 0: a point, beams meet it by hinges).
set nodes {
@NODES@
}
set top @TOP@ ;# tag of the node whose motion is checked

# Beams: nodes, arms from the nodes to the beam's ends (m), EA (N), EI (N m2), and times by which a stiffness-proportional dashpot
# makes their axial force and their moments run ahead of the deformation (s). A hinge at an end is a node that turns freely there.
# @DAMPING@
set beams {
@BEAMS@
}
@SHEAR@
# Corners: node, arm from it (m); the spring-absorber units under it, vertical and horizontal: k1, k2 (N/m), c (N s/m), m2 (kg).
set corners {
@CORNERS@
}
# Dashpots between a place on a node and the ground: node, arm (m), horizontal and vertical (N s/m).
set dampers {
@DAMPERS@
}

# Tendons to the ground, which only pull: node, arm (m), lower end x, z (m), N/m, tension in the unstressed structure (N).
set tendons {
@TENDONS@
}

set recordDt  @RECORD_DT@ ;# s
set dampedFrom @DAMPED_FROM@ ;# s: from here on dashpots of beams work
set accuracy  @ACCURACY@ ;# of the history, as a normalised error: the steps follow from it
set landing   @LANDING@ ;# s: sqrt(mass that lands / k1), what a landing takes
set rise      @RISE@ ;# of a corner, m, from which on its motion counts: a hundredth of where the structure topples
set stepsPerSample @STEPS@ ;# at least
set samples   @SAMPLES@ ;# of the record that are followed: @DURATION@ s
set compared  @COMPARED@ ;# of these that `expected` is of, to @COMPARED_S@ s; fewer where @BEYOND@
set tolerance @TOLERANCE@ ;# of Newton's displacements, m

# What @OURS@ found for the same springs and record, m: the check at the end.
set expected [list settled @SETTLED@ {x max} @X_MAX@ {x min} @X_MIN@ {z max} @Z_MAX@ {z min} @Z_MIN@]

# ---------------------------------------------------------------- model
# Tags: a node's index and 1; added to the index of a corner, a dashpot, a tendon, a beam's end, as below.

# The node at an offset (x, z) from node i, on a stiff arm; node i itself without an offset.
proc rigidArm {tag i place offset stiffness} {
    global nodes
    lassign $offset dx dz
    if {$dx == 0.0 && $dz == 0.0} { return [expr {$i + 1}] }
    lassign [lindex $nodes $i] x z
    node $place [expr {$x + $dx}] [expr {$z + $dz}]
    set length [expr {hypot($dx, $dz)}]
    element elasticBeamColumn $tag [expr {$i + 1}] $place [expr {$stiffness * $length}] 1.0 [expr {$stiffness * $length**3 / 3.0}] 1
    return $place
}

# One beam for the axial force, one for the moments: each has a dashpot of its own. The dashpots act on the deformation, so that a
# rotation of the whole structure meets none.
proc beam {tag from to ea ei ahead} {
    if {$ahead > 0.0} {
        # not in the first step, which would take a part of the weight's force for a change since the one before
        damping SecStif $tag $ahead -activateTime $::dampedFrom
        element elasticBeamColumn $tag $from $to $ea 1.0 $ei 1 -damp $tag
    } else {
        element elasticBeamColumn $tag $from $to $ea 1.0 $ei 1
    }
}

# Gap and absorber under corner i; the corner's node.
proc stand {i corner rigid trace} {
    global nodes
    lassign $corner owner arm vertical horizontal
    lassign $vertical k1 k2 c m2
    lassign $horizontal k1h k2h ch m2h
    set absorber [expr {2000 + $i}]
    set ground [expr {3000 + $i}]
    set foot [rigidArm [expr {20000 + $i}] $owner [expr {1000 + $i}] $arm $rigid]
    # What an arm gives is the same in every direction: taken off the gap's, both in series are k1.
    set give [expr {$foot == 1000 + $i ? 1.0 / $rigid : 0.0}]
    set gap [expr {$k1 / (1.0 - $k1 * $give)}]
    set gapH [expr {$k1h / (1.0 - $k1h * $give)}]
    set x [expr {[lindex $nodes $owner 0] + [lindex $arm 0]}]
    set z [expr {[lindex $nodes $owner 1] + [lindex $arm 1]}]
    node $absorber $x $z
    node $ground $x $z
    fix $ground 1 1 1
    # The bearing's axes turn with its first node: the absorber must not rotate.
    fix $absorber 0 0 1
    # One node carries both absorbers: OpenSees takes a mass per direction.
    mass $absorber $m2h $m2 0.0
    # k2 parallel with c: Elastic takes the dashpot as its third number, eta.
    set material [expr {10 * ($i + 1)}]
    foreach name {side up none pull both turn} step {0 1 2 3 4 5} { set $name [expr {$material + $step}] }
    uniaxialMaterial Elastic $side $k2h $ch
    uniaxialMaterial Elastic $up $k2 $c
    # Gap k1: no tension (ENT), parallel with a trace of tension. The bearing moves a lifted corner's anchor along with it only while
    # its axial force is above zero; with exactly zero (ENT alone) the corner would be pulled back to where it stood before, which
    # creates energy.
    uniaxialMaterial ENT $none $gap
    uniaxialMaterial Elastic $pull [expr {1e-9 * $gap}]
    uniaxialMaterial Parallel $both $none $pull
    # The bearing asks for a moment spring; this one is too weak to be felt.
    uniaxialMaterial Elastic $turn $trace
    element zeroLength [expr {30000 + $i}] $ground $absorber -mat $side $up -dir 1 2
    # Axial direction up (local x = global y); the horizontal k1 is the bearing's shear stiffness.
    element flatSliderBearing [expr {40000 + $i}] $absorber $foot 1 $gapH -P $both -Mz $turn -orient 0 1 0 -1 0 0
    return $foot
}

# Nodes, masses, beams, springs. Returns the corners' nodes.
proc build {} {
    global nodes beams corners dampers tendons gravity
    foreach each $beams {
        if {[lindex $each 6] + [lindex $each 7] > 0.0 && [info commands damping] eq ""} {
            stop "this OpenSees has no damping objects, which version 3.5 has; run the deck for openseespy"
        }
    }
    wipe
    model basic -ndm 2 -ndf 3
    set total 0.0
    set tag 0
    foreach each $nodes {
        lassign $each x z mass inertia
        incr tag
        node $tag $x $z
        mass $tag $mass $mass $inertia
        set total [expr {$total + $mass}]
    }
    # Corotational: with Linear the weight's moment on the leaning structure (P-Delta), which drives rocking, is lost.
    geomTransf Corotational 1
    # The arms stand for rigid footings; stiffer ones lose digits of a gap's force.
    set rigid 0.0
    foreach corner $corners { set rigid [expr {max($rigid, [lindex $corner 2 0], [lindex $corner 3 0])}] }
    set rigid [expr {@LEG@ * $rigid}]
    set i 0
    foreach each $beams {
        lassign $each a b armA armB axial bending aheadAxial aheadBending
        set tag [expr {1000 + 10 * $i}]
        # arms of their own: a transformation's joint offsets turn as if rotations were small, which P-Delta feels
        set from [rigidArm [expr {$tag + 2}] $a [expr {8000 + 2 * $i}] $armA $rigid]
        set to [rigidArm [expr {$tag + 3}] $b [expr {8001 + 2 * $i}] $armB $rigid]
        beam $tag $from $to $axial 0.0 $aheadAxial
        beam [expr {$tag + 1}] $from $to 0.0 $bending $aheadBending
        incr i
    }
@SHEAR_SPRINGS@    # Friction so high that a pressing corner never slides: the horizontal spring k1 acts whenever the corner presses, and not at
    # all when it is in the air.
    frictionModel Coulomb 1 @FRICTION@
    set feet {}
    set i 0
    foreach corner $corners {
        lappend feet [stand $i $corner $rigid [expr {1e-9 * $gravity * $total}]]
        incr i
    }
    set i 0
    foreach each $dampers {
        lassign $each owner arm horizontal vertical
        set place [rigidArm [expr {50000 + $i}] $owner [expr {4000 + $i}] $arm $rigid]
        set ground [expr {7000 + $i}]
        node $ground [nodeCoord $place 1] [nodeCoord $place 2]
        fix $ground 1 1 1
        set side [expr {60000 + 2 * $i}]
        uniaxialMaterial Elastic $side 0.0 $horizontal
        uniaxialMaterial Elastic [expr {$side + 1}] 0.0 $vertical
        element zeroLength [expr {60000 + $i}] $ground $place -mat $side [expr {$side + 1}] -dir 1 2
        incr i
    }
    set i 0
    foreach each $tendons {
        lassign $each owner arm below stiffness tension
        lassign $below x z
        set anchor [expr {6000 + $i}]
        set place [rigidArm [expr {80000 + $i}] $owner [expr {5000 + $i}] $arm $rigid]
        node $anchor $x $z
        set length [expr {hypot([nodeCoord $place 1] - $x, [nodeCoord $place 2] - $z)}]
        # A beam that can hardly bend: a corotTruss does not turn with the structure in every build of OpenSees.
        fix $anchor 1 1 0
        # no compression: the third stiffness; stressed: a strain from the slack length
        set material [expr {70000 + 10 * $i}]
        uniaxialMaterial Elastic $material [expr {$stiffness * $length}] 0.0 0.0
        uniaxialMaterial InitStrainMaterial [expr {$material + 1}] $material [expr {$tension / ($stiffness * $length)}]
        uniaxialMaterial Elastic [expr {$material + 2}] [expr {1e-9 * $gravity * $total * $length**2}]
        section Aggregator $material [expr {$material + 1}] P [expr {$material + 2}] Mz
        element dispBeamColumn [expr {81000 + $i}] $anchor $place 2 $material 1
        incr i
    }
    return $feet
}

# ---------------------------------------------------------------- solver
@SOLVER@

# ---------------------------------------------------------------- steps
@ROUTINE@

set columns {}
for {set i 0} {$i < [llength $nodes]} {incr i} { lappend columns x$i z$i th$i }

# x, z, clockwise rotation of every node: OpenSees turns counter-clockwise.
proc sample {} {
    global nodes
    set now {}
    for {set tag 1} {$tag <= [llength $nodes]} {incr tag} {
        lappend now [nodeDisp $tag 1] [nodeDisp $tag 2] [expr {-[nodeDisp $tag 3]}]
    }
    return $now
}

# What is checked: name, column of the history, where it starts, m.
proc checked {} {
    global top settled
    return [list x [expr {3 * $top - 2}] 0.0 z [expr {3 * $top - 1}] $settled]
}

# The whole history.
proc run {} {
    global settled record vertical nodes corners
    set feet [build]
    set masses {}
    set tag 0
    foreach each $nodes { lappend masses [incr tag] [lindex $each 2] }
    set settled [gravity $masses]
    set across $masses
    set up $masses
    set gaps {}
    set absorber 2000
    foreach corner $corners foot $feet {
        lappend across $absorber [lindex $corner 3 3]
        lappend up $absorber [lindex $corner 2 3]
        lappend gaps $foot $absorber
        incr absorber
    }
    shake 2 $record 0 $across
    if {[llength $vertical] > 0} { shake 3 $vertical 1 $up }
    return [follow $gaps]
}

@EPILOGUE@
