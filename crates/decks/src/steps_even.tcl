# Steps of one size, as a plain script takes them; a step that Newton's iteration gives up is halved.
#
# With touches above 1 a step within which a gap is about to open or close, told from the gap and
# its rate before it, is taken in so many parts, and so is the step after one in which a contact
# changed: OpenSees keeps what has converged, so that a step can be divided before it is taken,
# not after. Always give `analyze` the same number, to the last digit: TRBDF2 and BackwardEuler
# begin anew with every other one.
namespace eval steps {
    proc start {nodes landing longest rise {accuracy 0.002}} {
        foreach name {feet size allowed smallest taken refused closed} { variable $name }
        set feet $nodes
        set size $::step
        set allowed $size
        set smallest $size
        set taken 0
        set refused 0
        set closed {}
    }

    # Whether a contact changes in the step to come, or did in the last one.
    proc touches {} {
        foreach name {feet size closed} { variable $name }
        set now {}
        set near 0
        foreach {foot absorber} $feet {
            set opening [expr {[nodeDisp $foot 2] - [nodeDisp $absorber 2]}]
            set rate [expr {[nodeVel $foot 2] - [nodeVel $absorber 2]}]
            lappend now [expr {$opening <= 0.0}]
            if {($opening <= 0.0) != ($opening + $rate * $size <= 0.0)} { set near 1 }
        }
        if {[llength $closed] > 0 && $closed ne $now} { set near 1 }
        set closed $now
        return $near
    }

    # One step of h, or two halves of it.
    proc one {h least} {
        foreach name {taken refused smallest allowed} { variable $name }
        if {[analyze 1 $h] == 0} {
            incr taken
            set smallest [expr {min($smallest, $h)}]
            return 1
        }
        incr refused
        set allowed $h
        return [expr {$h > 1.5 * $least && [one [expr {0.5 * $h}] $least] && [one [expr {0.5 * $h}] $least]}]
    }

    # One step, wherever the next sample is. 0 if Newton's iteration gives up in the shortest part of it.
    proc advance {end} {
        variable size
        set parts [expr {$::touches > 1 && [touches] ? $::touches : 1}]
        set h [expr {$size / $parts}]
        for {set k 0} {$k < $parts} {incr k} {
            if {![one $h [expr {$h / $::substeps}]]} { return 0 }
        }
        return 1
    }

    proc report {} {
        foreach name {taken smallest refused} { variable $name }
        return [format "%d steps, the shortest %.1e s, %d halved" $taken $smallest $refused]
    }
}
