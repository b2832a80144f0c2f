# Steps of a transient analysis that follow feet touching and leaving the ground.
#
# They are as long as the accuracy asked allows, however stiff or soft the gap springs, and shorten by themselves towards every
# touch and lift. Needs the integrator TRBDF2 and nothing else of this file, so it can be pasted into a script of your own:
#
#     steps::start {foot absorber foot absorber ...} [expr {1.0 / $omegaN}] [expr {$recordDt / 2.0}] [expr {0.01 * $b * $alpha}]
#     for {set i 1} {$i < $samples} {incr i} {
#         if {![steps::advance [expr {$i * $recordDt}]]} { puts stderr [steps::report]; exit 2 }
#     }
#     puts [steps::report]
#
# feet      nodes, two and two, with a vertical gap between them, closed where the foot is not above the absorber
# landing   1/Omega_n of the gap springs, s: what a landing takes; 0: all steps alike
# longest   step, s; steps end where `advance` is told to, which should be every sample of the record
# rise      of a foot, m, from which on its motion counts: errors are relative to the highest rise so far, at least this
# accuracy  wanted of the history (its normalised error); that of the steps stays below a quarter of it
#
# steps::taken     steps so far
# steps::refused   pairs that Newton's iteration gave up: repeated shorter
# steps::late      touches and lifts within a step too long for them: not 0, and the history is not to be trusted
# steps::smallest  step, s
namespace eval steps {
    variable start 1e-6 ;# step, in units of the shortest: OpenSees starts without acceleration, whatever the first load

    variable growth 1.5 ;# from pair to pair, at most
    # What a pair misses of a foot's position, over the highest rise: a landing has up to a thousand pairs, whatever it takes.
    variable pairShare 5e-6
    # The same over a time in which the foot rises or falls.
    variable riseShare 0.1
    # A foot that lifts drops a horizontal force at once; the step across it is wrong by that force for all its length.
    variable drop 0.02
    # What a pair may miss while all feet stand and none has risen yet, over the rise: it dies away.
    variable standShare 1e-4
    # What rounding leaves of a gap, over the farthest coordinate.
    variable roundingShare [expr {pow(2.0, -54)}]

    # To be set where a model changes in the air: a command that is given 1 once no foot is on the ground, 0 after.
    variable aloft ""

    proc start {nodes aLanding aLongest rise {anAccuracy 0.002}} {
        foreach name {feet longest landing accuracy first shortest share allowed strongest highest blur gaps taken refused late
            smallest rounding last flies} {
            variable $name
        }
        set flies 0
        variable start
        variable roundingShare
        set fine [expr {min(1.0, sqrt($anAccuracy / 0.002))}] ;# steps err with their square
        set feet $nodes
        set longest $aLongest
        set landing $aLanding
        set accuracy $anAccuracy
        set first [expr {$landing > 0.0 ? min(0.05 * $fine * $landing, $longest) : $longest}] ;# of a landing
        set shortest $first
        set share [expr {0.2 * $fine}] ;# of the time to the next touch or lift that one step takes
        set allowed [expr {$start * $shortest}]
        set strongest 0.0 ;# acceleration of an open foot on long steps, m/s2
        set highest $rise ;# a foot has come, m
        set blur [expr {1e-10 * $rise}] ;# of a gap, m: what Newton's iteration leaves of it
        # The same, m: three times what was seen on springs of 180 kHz. Over the step it gives the rate, over its square the
        # acceleration: on stiff springs both are nothing but rounding where steps are short, and tell of no lift.
        set farthest 0.0
        foreach node [getNodeTags] {
            foreach x [nodeCoord $node] { set farthest [expr {max($farthest, abs($x))}] }
        }
        set rounding [expr {$roundingShare * $farthest}]
        set last $shortest
        set gaps [measure]
        set taken 0
        set refused 0
        set late 0
        set smallest 1e300
    }

    # Of every gap: opening, its rate and acceleration; the foot's own rate.
    proc measure {} {
        variable feet
        set found {}
        foreach {foot absorber} $feet {
            lappend found [list [expr {[nodeDisp $foot 2] - [nodeDisp $absorber 2]}] \
                [expr {[nodeVel $foot 2] - [nodeVel $absorber 2]}] [expr {[nodeAccel $foot 2] - [nodeAccel $absorber 2]}] \
                [nodeVel $foot 2]]
        }
        return $found
    }

    # Length of the next two steps, s.
    proc size {} {
        foreach name {longest allowed shortest gaps strongest share rounding last} { variable $name }
        set size [expr {min($longest, $allowed)}]
        if {$size <= $shortest} { return $size }
        foreach gap $gaps {
            foreach {opening rate acceleration -} $gap {}
            if {$opening > 0.0} {
                # Soonest touch: at the strongest acceleration met so far.
                set pull [expr {max($strongest, abs($acceleration), 1e-30)}]
                set soonest [expr {2.0 * $opening / (sqrt($rate * $rate + 2.0 * $pull * $opening) - $rate)}]
            } else {
                # Soonest lift: as the spring now relaxes, and at the rate alone, as far as they are more than rounding.
                set rate [expr {$rate - $rounding / $last}]
                set acceleration [expr {$acceleration - 4.0 * $rounding / ($last * $last)}]
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

    # Time in which a foot rises as high as it has come, s.
    proc slow {} {
        foreach name {highest strongest} { variable $name }
        return [expr {$strongest > 0.0 ? sqrt($highest / $strongest) : 1e300}]
    }

    # Length that the next steps may have by the error of these two of h, s.
    proc grown {states h size} {
        foreach name {accuracy highest pairShare riseShare growth first strongest standShare} { variable $name }
        # TRBDF2 misses h^3/3 of the third derivative, in the fast motions of the springs and the slow one of the body alike.
        set missed 1e-300
        foreach a [lindex $states 0] b [lindex $states 1] c [lindex $states 2] {
            set missed [expr {max($missed, $h / 3.0 * abs([lindex $a 3] - 2.0 * [lindex $b 3] + [lindex $c 3]))}]
        }
        set least [expr {$strongest > 0.0 ? $pairShare : $standShare}]
        foreach gap [concat {*}$states] { if {[lindex $gap 0] > 0.0} { set least $pairShare } }
        set may [expr {$accuracy * $highest * max($least, $riseShare * 2.0 * $h / [slow])}]
        set byError [expr {0.9 * $h * pow($may / $missed, 1.0 / 3.0)}]
        # Motions faster than a landing (a rotation of little inertia) are not resolved: steps of a landing end them.
        return [expr {max(min($growth * $size, max($byError, 0.3 * $size)), min(2.0 * $size, $first))}]
    }

    # Acceleration of open feet, from two long steps of h.
    proc learn {before h} {
        foreach name {longest landing gaps strongest first shortest drop accuracy} { variable $name }
        if {$h < 0.2 * $longest} { return }
        foreach a $before b $gaps {
            foreach {was rateWas - -} $a {}
            foreach {opening rate - -} $b {}
            if {$was > 0.0 && $opening > 0.0} {
                set strongest [expr {max($strongest, abs($rate - $rateWas) / (2.0 * $h))}]
            }
        }
        if {$landing > 0.0} { set shortest [expr {min($shortest, max($drop * $accuracy * [slow], 0.1 * $first))}] }
    }

    # Two steps of h, at most `size`: TRBDF2 takes one by BDF2 only if it is as long as the one before, to the last digit.
    proc pair {h size} {
        foreach name {gaps refused allowed shortest taken smallest late highest blur share rounding last aloft flies} { variable $name }
        set states [list $gaps]
        set met 0
        set far 0
        for {set k 0} {$k < 2} {incr k} {
            set before $gaps
            if {[analyze 1 $h] != 0} {
                # A foot lets go and lands again within the step: Newton's iteration cycles, OpenSees takes the step back.
                incr refused
                set allowed [expr {$h > $shortest ? $shortest : 0.25 * $h}]
                set gaps [measure]
                return [expr {$allowed > 1e-6 * $shortest}]
            }
            incr taken
            set gaps [measure]
            lappend states $gaps
            if {$aloft ne ""} {
                set lowest [tcl::mathfunc::min {*}[lmap gap $gaps { lindex $gap 0 }]]
                if {$flies != ($lowest > 0.0)} {
                    set flies [expr {!$flies}]
                    $aloft $flies
                }
            }
            foreach a $before b $gaps {
                set was [lindex $a 0]
                if {($was <= 0.0) != ([lindex $b 0] <= 0.0)} {
                    incr met
                    # A foot that rounding alone holds down lifts unseen.
                    set unseen [expr {8.0 * $rounding / $share}]
                    incr far [expr {abs([lindex $b 0]) > $blur && !(-$unseen < $was && $was <= 0.0)}]
                }
            }
        }
        set last $h
        if {$h >= $shortest || $refused} { set smallest [expr {min($smallest, $h)}] } ;# the very first are tiny
        foreach gap $gaps { set highest [expr {max($highest, [lindex $gap 0])}] }
        if {$met > 0} {
            set allowed $shortest
            if {$h > 1.5 * $shortest} { incr late $far }
        } else {
            set allowed [grown $states $h $size]
            learn [lindex $states 0] $h
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
