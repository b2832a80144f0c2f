def follow(feet, accuracy, sample, aloft=None):
    """The motion through the record, or as far as steps converge: rows of t and what `sample` tells, and the steps."""
@INTEGRATOR@
    steps = Steps(feet, LANDING, RECORD_DT / STEPS_PER_SAMPLE, RISE, accuracy)
    steps.aloft = aloft
    before = now = [0.0, *sample()]
    rows = [now]
    for i in range(1, SAMPLES):
        end = i * RECORD_DT
        while now[0] < end - 1e-6 * RECORD_DT:
            if not steps.advance(end):
                print(f"no convergence at {ops.getTime():.5f} s, in steps of {steps.allowed:.1e} s: the history ends", file=sys.stderr)
                return rows, steps
            before, now = now, [ops.getTime(), *sample()]
        # a step that does not divide the record's ends beyond the sample, which lies on the line to there
        part = (end - before[0]) / (now[0] - before[0])
        values = [a + part * (b - a) for a, b in zip(before[1:], now[1:])] if part < 1.0 - 1e-6 else now[1:]
        rows.append([end, *values])
        if math.floor(end) > math.floor((i - 1) * RECORD_DT):
            print(f"{end:.0f} s of {(SAMPLES - 1) * RECORD_DT:g} s", file=sys.stderr, flush=True)
    return rows, steps


def main():
@REFUSAL@    print("OpenSees tells of every step that does not converge; such steps are repeated shorter", file=sys.stderr)
    for accuracy in (ACCURACY, ACCURACY / 4.0, ACCURACY / 16.0):
        rows, settled, steps = run(accuracy)
        if steps.late == 0:
            break
        print(f"accuracy {accuracy:g}: {steps.report()}", file=sys.stderr)

    out = os.path.splitext(os.path.abspath(__file__))[0] + "_history.csv"
    with open(out, "w", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(("t", *COLUMNS))
        writer.writerows([f"{x:.17g}" for x in row] for row in rows)

    if len(rows) < COMPARED:
        stop(f"no convergence after {rows[-1][0]:g} s: {steps.report()}; wrote {out}")
    found, scale = {"settled": settled}, {"settled": abs(EXPECTED["settled"])}
    for name, column, start in checked(settled):
        values = [row[column] - start for row in rows[:COMPARED]]
        found[name + " max"], found[name + " min"] = max(values), min(values)
        # 1 % of the largest motion in that direction, or of what is none to speak of
        largest = max(abs(EXPECTED[name + " max"]), abs(EXPECTED[name + " min"]), 1e-3 * RISE)
        scale[name + " max"] = scale[name + " min"] = largest
    good = all(abs(found[key] - value) <= 0.01 * scale[key] for key, value in EXPECTED.items())
    print(f"OpenSees {ops.version()}, {rows[-1][0]:g} s: {steps.report()}; wrote {out}")
    if steps.refused:
        print("  OpenSees' messages of failed convergence are of steps that were repeated shorter")
    if COMPARED < SAMPLES:
        print(f"  compared to {(COMPARED - 1) * RECORD_DT:g} s: beyond, @BEYOND@")
    for key, value in EXPECTED.items():
        print(f"  {key:8s} {found[key] * 1e3:12.4f} mm, expected {value * 1e3:12.4f} mm")
    print(f"within 1 %@OF@: {'yes' if good else 'no'}")
    if len(rows) < SAMPLES:
        stop(f"no convergence after {rows[-1][0]:g} s of {(SAMPLES - 1) * RECORD_DT:g} s; up to {(COMPARED - 1) * RECORD_DT:g} s it is judged above")
@END@


# ---------------------------------------------------------------- ground motion
# @RECORD_NOTE@
RECORD = (
@RECORD@
)
# The vertical part, positive upwards; none if empty.
VERTICAL = (
@VERTICAL@
)

if __name__ == "__main__":
    sys.exit(main())
