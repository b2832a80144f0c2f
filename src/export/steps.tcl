# Steps of a transient analysis that follow feet touching and leaving the ground.
#
# They are as long as the accuracy asked allows, however stiff the gap springs, and shorten by themselves towards every touch
# and lift. Needs the integrator TRBDF2 and nothing else of this file, so it can be pasted into a script of your own:
#
#     steps::start {foot absorber foot absorber ...} [expr {1.0 / $omegaN}] [expr {$recordDt / 2.0}]
#     for {set i 1} {$i < $samples} {incr i} {
#         if {![steps::advance [expr {$i * $recordDt}]]} { puts stderr [steps::report]; exit 2 }
#     }
#     puts [steps::report]
#
# feet      nodes, two and two, with a vertical gap between them, closed where the foot is not above the absorber
# landing   1/Omega_n of the gap springs, s: what a landing takes; 0: all steps alike
# longest   step, s; steps end where `advance` is told to, which should be every sample of the record
# accuracy  wanted of the history (its normalised error); that of the steps stays below a quarter of it
#
# steps::taken     steps so far
# steps::refused   pairs that Newton's iteration gave up: repeated shorter
# steps::late      touches and lifts within a step too long for them: not 0, and the history is not to be trusted
# steps::smallest  step, s
namespace eval steps {
    variable first 1e-6 ;# step, in units of the shortest: OpenSees starts without acceleration, whatever the first load

    proc start {nodes aLanding aLongest {accuracy 0.002}} {
        foreach name {feet longest landing shortest growth share error allowed strongest highest gaps taken refused late smallest} {
            variable $name
        }
        variable first
        set fine [expr {min(1.0, sqrt($accuracy / 0.002))}] ;# steps err with their square
        set feet $nodes
        set longest $aLongest
        set landing $aLanding
        set shortest [expr {$landing > 0.0 ? min(0.1 * $fine * $landing, $longest) : $longest}]
        set growth [expr {1.0 + 0.2 * $fine}] ;# from pair to pair, while a landing's vibrations last; 1.5 after them
        set share [expr {0.2 * $fine}] ;# of the time to the next touch or lift that one step takes
        set error [expr {$accuracy / 40.0}] ;# of a step in position, relative to how far the foot travels
        set allowed [expr {$first * $shortest}]
        set strongest 0.0 ;# acceleration of an open foot on long steps, m/s2
        set highest 0.0 ;# a foot has come, m
        set gaps [measure]
        set taken 0
        set refused 0
        set late 0
        set smallest 1e300
    }

    # Of every gap: opening, its rate and acceleration.
    proc measure {} {
        variable feet
        set found {}
        foreach {foot absorber} $feet {
            lappend found [list [expr {[nodeDisp $foot 2] - [nodeDisp $absorber 2]}] \
                [expr {[nodeVel $foot 2] - [nodeVel $absorber 2]}] [expr {[nodeAccel $foot 2] - [nodeAccel $absorber 2]}]]
        }
        return $found
    }

    # Length of the next two steps, s.
    proc size {} {
        foreach name {longest allowed shortest gaps strongest highest error share} { variable $name }
        set size [expr {min($longest, $allowed)}]
        if {$size <= $shortest} { return $size }
        foreach gap $gaps {
            foreach {opening rate acceleration} $gap {}
            if {$opening > 0.0} {
                # Soonest touch: at the strongest acceleration met so far.
                set pull [expr {max($strongest, abs($acceleration), 1e-30)}]
                set soonest [expr {2.0 * $opening / (sqrt($rate * $rate + 2.0 * $pull * $opening) - $rate)}]
                # A step errs by h^2/12 of the acceleration's change; little must it be beside the height the foot can rise to.
                set height [expr {max($opening + 0.5 * $rate * $rate / $pull, 0.01 * $highest)}]
                set size [expr {min($size, sqrt(12.0 * $error * $height / $pull))}]
            } else {
                # Soonest lift: as the spring now relaxes, and at the rate alone.
                set soonest [expr {$rate > 0.0 ? -$opening / $rate : 1e300}]
                set root [expr {$rate * $rate - 2.0 * $acceleration * $opening}]
                if {$root >= 0.0 && sqrt($root) + $rate > 0.0} {
                    set soonest [expr {min($soonest, -2.0 * $opening / (sqrt($root) + $rate))}]
                }
            }
            set size [expr {min($size, $share * $soonest)}]
        }
        return [expr {max($size, $shortest)}]
    }

    # Acceleration and height of open feet, from two long steps of h.
    proc learn {before h} {
        foreach name {longest gaps strongest highest} { variable $name }
        if {$h < 0.2 * $longest} { return }
        foreach a $before b $gaps {
            foreach {was rateWas -} $a {}
            foreach {opening rate -} $b {}
            if {$was > 0.0 && $opening > 0.0} {
                set strongest [expr {max($strongest, abs($rate - $rateWas) / (2.0 * $h))}]
                if {$strongest > 0.0} {
                    set highest [expr {max($highest, $opening + 0.5 * $rate * $rate / $strongest)}]
                }
            }
        }
    }

    # Two steps of h, at most `size`: TRBDF2 takes one by BDF2 only if it is as long as the one before, to the last digit.
    proc pair {h size} {
        foreach name {gaps refused allowed shortest taken smallest late growth landing} { variable $name }
        set before $gaps
        set met 0
        for {set k 0} {$k < 2} {incr k} {
            set last $gaps
            if {[analyze 1 $h] != 0} {
                # A foot lets go and lands again within the step: Newton's iteration cycles, OpenSees takes the step back.
                incr refused
                set allowed [expr {$h > $shortest ? $shortest : 0.25 * $h}]
                set gaps [measure]
                return [expr {$allowed > 1e-6 * $shortest}]
            }
            incr taken
            set gaps [measure]
            foreach a $last b $gaps { incr met [expr {([lindex $a 0] <= 0.0) != ([lindex $b 0] <= 0.0)}] }
        }
        if {$h >= $shortest || $refused} { set smallest [expr {min($smallest, $h)}] } ;# the very first are tiny
        if {$met > 0} {
            set allowed $shortest
            if {$h > 1.5 * $shortest} { incr late $met }
        } else {
            set allowed [expr {($size < $landing ? $growth : 1.5) * $size}]
            learn $before $h
        }
        return 1
    }

    # To time `end`, s. 0 if Newton's iteration gives up however short the step.
    proc advance {end} {
        variable longest
        while {$end - [getTime] > 1e-9 * $longest} {
            set left [expr {$end - [getTime]}]
            set size [size]
            set pairs [expr {max(1.0, ceil($left / (2.0 * $size) - 1e-6))}]
            if {![pair [expr {$left / (2.0 * $pairs)}] $size]} { return 0 }
        }
        return 1
    }

    proc report {} {
        foreach name {taken smallest refused late} { variable $name }
        set text [format "%d steps, the shortest %.1e s, %d pairs repeated shorter" $taken $smallest $refused]
        if {$late > 0} { append text "; WARNING: $late touches or lifts within too long a step, ask for more accuracy" }
        return $text
    }
}
