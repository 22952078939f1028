#!/usr/bin/python3
# SPDX-License-Identifier: MIT
# e^x, log(x) and log(1 + x) of exact doubles by mpmath at 60 digits, each as a sum of two doubles:
# arguments all over the range, and where reductions change over: about odd multiples of ln(2)/2 and
# powers of two of sqrt(1/2), about 1, and where sums with 1 round. Writes elementary.inc.
import random
from mpmath import mp, mpf, exp, log, sqrt

mp.dps = 60
random.seed(14)


def near(x, n, spread):
    return [float(mpf(x) * (1 + mpf(random.uniform(-spread, spread)))) for _ in range(n)] + [float(x)]


exps = [0.0, 5e-324, -5e-324, 1e-300, 2.0 ** -53, -2.0 ** -53, 2.0 ** -54, 690.0, -690.0]
for k in list(range(-8, 9)) + [-995, -700, -331, 331, 700, 995]:
    exps += near((k + mpf(1) / 2) * log(2), 4, 1e-15) + near((k + mpf(1) / 2) * log(2), 2, 1e-3)
exps += [random.uniform(-690, 690) for _ in range(300)] + [random.uniform(-1, 1) for _ in range(200)]
exps += [random.choice([-1, 1]) * 2.0 ** random.uniform(-60, 0) for _ in range(60)]
logs = [1.0, 5e-324, 2.0 ** -1022, 1.7e308, 2.0, 0.5]
for k in [-900, -333, -3, -2, -1, 0, 1, 2, 333, 900]:
    logs += near(sqrt(mpf(1) / 2) * mpf(2) ** k, 6, 1e-15) + near(mpf(2) ** k, 6, 1e-15)
logs += [1 + random.choice([-1, 1]) * 2.0 ** random.uniform(-52, -1) for _ in range(150)]
logs += [random.uniform(0.5, 2) for _ in range(300)] + [2.0 ** random.uniform(-1070, 1023) for _ in range(150)]
logs1p = [0.0, 5e-324, 1e-300, 1e308]
for k in range(-56, -48):
    logs1p += near(mpf(2) ** k, 5, 1e-15) + near(mpf(3) * mpf(2) ** k, 5, 0.4)
logs1p += [2.0 ** random.uniform(-80, 1020) for _ in range(100)] + [2.0 ** random.uniform(-60, 3) for _ in range(200)]

with open("elementary.inc", "w") as out:
    out.write("/* function, x, value as a sum: made by elementary.py */\n")
    for name, f, arguments in (("EXP", lambda x: exp(x), exps), ("LOG", lambda x: log(x), logs),
                               ("LOG1P", lambda x: log(1 + x) if x > mpf(2) ** -500 else x - x * x / 2, logs1p)):
        for x in arguments:
            value = f(mpf(x))
            high = float(value)
            out.write("{%s, %s, %s, %s},\n" % (name, float(x).hex(), high.hex(), float(value - mpf(high)).hex()))
