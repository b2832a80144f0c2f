    foreach each $shear {
        lassign $each i stiffness damping
        lassign [lindex $beams $i] a b armA armB
        set ends {}
        foreach owner [list $a $b] arm [list $armA $armB] k {0 1} {
            lappend ends [expr {[lindex $arm 0] == 0.0 && [lindex $arm 1] == 0.0 ? $owner + 1 : 8000 + 2 * $i + $k}]
        }
        uniaxialMaterial Elastic [expr {90000 + $i}] $stiffness $damping
        element twoNodeLink [expr {90000 + $i}] {*}$ends -mat [expr {90000 + $i}] -dir 3
    }
