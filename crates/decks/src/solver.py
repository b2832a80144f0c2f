def stop(reason):
    print(f"stopped: {reason}", file=sys.stderr)
    sys.exit(2)


def analysis(*integrator, static=False):
    """The solver, as stiff contact needs it."""
    ops.constraints("Plain")
    ops.numberer("RCM")
    ops.system("UmfPack")
    # By displacement: forces of 1e12 N/m springs never meet a sensible force tolerance.
    ops.test("NormDispIncr", TOLERANCE, 30, 0)
@FULL_STEPS@    ops.algorithm("Newton@LINE_SEARCH@")
    ops.integrator(*integrator)
    ops.analysis("Static" if static else "Transient")


def gravity(masses):
    """The weight, as a load on the masses (absorbers carry none): node, kg. Returns where TOP settles, m."""
    ops.timeSeries("Linear", 1)
    ops.pattern("Plain", 1, 1)
    for tag, mass in masses:
        ops.load(tag, 0.0, -mass * GRAVITY, 0.0)
    analysis("LoadControl", 0.1, static=True)
    if ops.analyze(10) != 0:
        stop("gravity did not converge")
    ops.loadConst("-time", 0.0)
    ops.wipeAnalysis()
    return ops.nodeDisp(TOP, 2)


def shake(pattern, record, direction, masses):
    """Ground acceleration, m/s2, positive to the right (direction 0) or upwards (1), linear between samples: as loads -mass times it."""
    ops.timeSeries("Path", pattern, "-dt", RECORD_DT, "-values", *record)
    ops.pattern("Plain", pattern, pattern)
    for tag, mass in masses:
        ops.load(tag, *(-mass if k == direction else 0.0 for k in range(3)))
