#!/usr/bin/python3
# SPDX-License-Identifier: MIT
# Glint and diffuse part of f_r cos^2 at exact doubles A, B, s, m, tan^2, by
# mpmath at 60 digits from the definition A cos^-4 exp(-tan^2/s^2), B cos^(m+2). Writes reflect.inc.
import random
from mpmath import mp, mpf, exp, sqrt, log

mp.dps = 60
random.seed(56)
S = [1e-300, 1e-160, 1e-6, 1e-3, 0.05, 0.2, 0.7, 0.71, 1.0, 3.3, 30.0, 1e3, 1e6, 1e150, 1e300]
M = [0.0, 1e-20, 0.1, 0.5, 1.0, 2.0, 7.3, 100.0, 1e4, 1e9, 1e17, 1e300]
cases = []
for s in S:
    for x in [0.0, 1e-3, 0.3, 1.0, 2.0, 30.0, 300.0, 740.0, 1300.0, 2500.0]:
        cases.append((1.0, 0.0, s, 0.0, float(mpf(s) ** 2 * x * random.uniform(0.9, 1.0))))
    cases.append((1.0, 0.0, s, 0.0, random.uniform(0, 3)))
    cases.append((1e-200, 0.0, s, 0.0, random.uniform(0, 3)))
for m in M:
    for y in [0.0, 1e-3, 0.3, 1.0, 30.0, 300.0, 700.0, 1400.0]:
        u = mpf(10) ** 300 if y > 300 * (m + 2) else exp(mpf(2) * y / (mpf(m) + 2)) - 1
        cases.append((0.0, 1.0, 0.0, m, float(u * random.uniform(0.9, 1.0))))
    cases.append((0.0, 1e250, 0.0, m, random.uniform(0, 3)))
for _ in range(300):
    cases.append((10 ** random.uniform(-3, 3), 10 ** random.uniform(-3, 3),
                  10 ** random.uniform(-6, 3), random.choice([0, 1]) * 10 ** random.uniform(-2, 4),
                  10 ** random.uniform(-14, 6)))


def text(x):
    if x > mpf(2) ** 1023.999999:
        return "HUGE_VAL"
    return float(x).hex()


cases = [c for c in cases if c[4] < float("inf")]
with open("reflect.inc", "w") as out:
    out.write("/* A, B, s, m, tan^2, glint, diffuse: made by reflect.py */\n")
    for A, B, s, m, u in cases:
        w = 1 + mpf(u)
        glint = A * w ** 2 * exp(-mpf(u) / mpf(s) ** 2) if A > 0 else mpf(0)
        diffuse = B * exp(-(mpf(m) / 2 + 1) * log(w)) if B > 0 else mpf(0)
        out.write("{%s, %s},\n" % (", ".join(float(v).hex() for v in (A, B, s, m, u)),
                                   ", ".join(text(v) for v in (glint, diffuse))))
