# Housner's equation by SciPy's solve_ivp, restarted at every sample (the record's kinks) and at every impact.
# stdin: JSON {p2, alpha, e, g, dt, accel, methods, rtols, rounds}; stdout: JSON [{tool, rtol, seconds, theta}].
import json
import math
import sys
import time

try:
    from scipy.integrate import solve_ivp
except ImportError as error:
    sys.exit(f"SciPy cannot be loaded ({error}): pip install scipy")

case = json.load(sys.stdin)
p2, alpha, e, g, dt, accel = (case[key] for key in ("p2", "alpha", "e", "g", "dt", "accel"))
limit = g * math.tan(alpha)


def history(method, rtol):
    n = len(accel)
    theta = [0.0] * n
    lifted = next((i for i, a in enumerate(accel) if abs(a) > limit), None)
    if lifted is None:
        return theta
    first = max(lifted - 1, 0)
    a0, a1 = accel[first], accel[lifted]
    side = -math.copysign(1.0, a1)
    t = (first + (0.0 if a0 == a1 else (-side * limit - a0) / (a1 - a0))) * dt
    y = [0.0, 0.0]
    for i in range(first, n - 1):
        start, end = i * dt, (i + 1) * dt
        a, slope = accel[i] / g, (accel[i + 1] - accel[i]) / (g * dt)
        while end - t > 1e-12 * dt:
            def rhs(t, y):
                psi = alpha * side - y[0]
                return [y[1], -p2 * (math.sin(psi) + (a + slope * (t - start)) * math.cos(psi))]  # (1), (3)

            def impact(t, y):
                return y[0]

            impact.terminal = True
            impact.direction = -side
            part = solve_ivp(rhs, (t, end), y, method=method, rtol=rtol, atol=rtol * alpha * 1e-2, events=impact)
            t, y = part.t[-1], [part.y[0][-1], part.y[1][-1]]
            if part.status == 1:
                side = math.copysign(1.0, y[1])
                y = [0.0, e * y[1]]
        t = end
        theta[i + 1] = y[0]
    return theta


out = []
for method in case["methods"]:
    for rtol in case["rtols"]:
        least = math.inf
        for _ in range(case["rounds"]):
            began = time.perf_counter()
            theta = history(method, rtol)
            least = min(least, time.perf_counter() - began)
        out.append({"tool": f"SciPy {method}", "rtol": rtol, "seconds": least, "theta": theta})
json.dump(out, sys.stdout)
