proc stop {reason} {
    puts stderr "stopped: $reason"
    exit 2
}

# The solver, as stiff contact needs it.
proc solver {integrator kind} {
    global tolerance
    constraints Plain
    numberer RCM
    system UmfPack
    # By displacement: forces of 1e12 N/m springs never meet a sensible force tolerance.
    test NormDispIncr $tolerance 30 0
@FULL_STEPS@    algorithm Newton@LINE_SEARCH@
    eval integrator $integrator
    analysis $kind
}

# The weight, as a load on the masses (absorbers carry none): node kg node kg ... Returns where the top settles, m.
proc gravity {masses} {
    global gravity top
    set loads {}
    foreach {tag mass} $masses { append loads "load $tag 0.0 [expr {-$mass * $gravity}] 0.0\n" }
    timeSeries Linear 1
    pattern Plain 1 1 $loads
    solver {LoadControl 0.1} Static
    if {[analyze 10] != 0} { stop "gravity did not converge" }
    loadConst -time 0.0
    wipeAnalysis
    return [nodeDisp $top 2]
}

# Ground acceleration, m/s2, positive to the right (direction 0) or upwards (1), linear between samples: as loads -mass times it.
proc shake {pattern record direction masses} {
    global recordDt
    set loads {}
    foreach {tag mass} $masses { append loads "load $tag [lreplace {0.0 0.0 0.0} $direction $direction [expr {-$mass}]]\n" }
    timeSeries Path $pattern -dt $recordDt -values $record -factor 1.0
    pattern Plain $pattern $pattern $loads
}
