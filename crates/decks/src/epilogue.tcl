# ---------------------------------------------------------------- ground motion
# @RECORD_NOTE@
set record {
@RECORD@
}
# The vertical part, positive upwards; none if empty.
set vertical {
@VERTICAL@
}

# ---------------------------------------------------------------- history
# The motion through the record, or as far as steps converge: rows of t and what `sample` tells.
proc follow {feet} {
    global recordDt samples landing stepsPerSample rise accuracy
@INTEGRATOR@
    steps::start $feet $landing [expr {$recordDt / $stepsPerSample}] $rise $accuracy
    set now [concat 0.0 [sample]]
    set before $now
    set rows [list $now]
    for {set i 1} {$i < $samples} {incr i} {
        set end [expr {$i * $recordDt}]
        while {[lindex $now 0] < $end - 1e-6 * $recordDt} {
            if {![steps::advance $end]} {
                puts stderr "no convergence at [getTime] s, in steps of $steps::allowed s: the history ends"
                return $rows
            }
            set before $now
            set now [concat [getTime] [sample]]
        }
        # a step that does not divide the record's ends beyond the sample, which lies on the line to there
        set part [expr {($end - [lindex $before 0]) / ([lindex $now 0] - [lindex $before 0])}]
        set row $end
        foreach a [lrange $before 1 end] b [lrange $now 1 end] {
            lappend row [expr {$part < 1.0 - 1e-6 ? $a + $part * ($b - $a) : $b}]
        }
        lappend rows $row
        if {floor($end) > floor(($i - 1) * $recordDt)} {
            puts stderr [format "%.0f s of %g s" $end [expr {($samples - 1) * $recordDt}]]
        }
    }
    return $rows
}

# One run: OpenSees' Tcl interpreter does not forget a model's loads, so that a second one needs a new interpreter. If the report at the
# end warns of touches or lifts within too long a step, make `accuracy` a quarter of what it is and run again.
@REFUSAL@puts stderr "OpenSees tells of every step that does not converge; such steps are repeated shorter"
set rows [run]

set out [open "[file rootname [info script]]_history.csv" w]
puts $out [join [concat t $columns] ,]
foreach row $rows {
    set texts {}
    foreach x $row { lappend texts [format %.17g $x] }
    puts $out [join $texts ,]
}
close $out
if {[llength $rows] < $compared} {
    stop "no convergence after [lindex $rows end 0] s: [steps::report]"
}

# ---------------------------------------------------------------- check
# 1 % of the largest motion in that direction, or of what is none to speak of
array set want $expected
array set found [list settled $settled]
array set scale [list settled [expr {abs($want(settled))}]]
foreach {name column start} [checked] {
    set most -1e300
    set least 1e300
    foreach row [lrange $rows 0 $compared-1] {
        set value [expr {[lindex $row $column] - $start}]
        set most [expr {max($most, $value)}]
        set least [expr {min($least, $value)}]
    }
    array set found [list "$name max" $most "$name min" $least]
    set largest [expr {max(abs($want($name max)), abs($want($name min)), 1e-3 * $rise)}]
    array set scale [list "$name max" $largest "$name min" $largest]
}
set good 1
puts [format "OpenSees, %g s: %s" [lindex $rows end 0] [steps::report]]
if {$steps::refused > 0} { puts "  OpenSees' messages of failed convergence are of steps that were repeated shorter" }
if {$compared < $samples} {
    puts [format "  compared to %g s: beyond, @BEYOND@" [expr {($compared - 1) * $recordDt}]]
}
foreach {key value} $expected {
    if {abs($found($key) - $value) > 0.01 * $scale($key)} { set good 0 }
    puts [format "  %-8s %12.4f mm, expected %12.4f mm" $key [expr {$found($key) * 1e3}] [expr {$value * 1e3}]]
}
puts "within 1 %@OF@: [expr {$good ? {yes} : {no}}]"
if {[llength $rows] < $samples} {
    set judged [expr {($compared - 1) * $recordDt}]
    stop "no convergence after [lindex $rows end 0] s of [expr {($samples - 1) * $recordDt}] s; up to $judged s it is judged above"
}
@END@
