#!/usr/bin/python3
# SPDX-License-Identifier: MIT
# Sine and cosine of angles in degrees (exact doubles, and exact sums of two) by mpmath at 1200
# bits, as leading double and remainder. Writes degrees.inc.
import random
from fractions import Fraction
from mpmath import mp, mpf, sin, cos, pi

mp.prec = 1200
random.seed(90)
angles = [(1e-300, 0.0), (1e-20, 0.0), (1.0, 0.0), (15.0, 0.0), (29.999999999999996, 0.0),
          (45.0, 0.0), (44.99999999999999, 0.0), (45.00000000000001, 0.0),
          (89.99999999999999, 0.0), (90.00000000000001, 0.0), (179.99999999999997, 0.0),
          (359.99999999999994, 0.0), (-33.3, 0.0), (1e17, 0.0), (1e300, 0.0), (-123456789.125, 0.0),
          (90.0, 1e-20), (180.0, -1e-30), (0.1, 179.9), (-0.1, 90.1), (60.000000000000007, 29.99),
          (1e17, 0.3), (44.99999999999999, 1e-16), (135.0, -1e-14)]
for _ in range(60):
    angles.append((random.uniform(-400, 400), 0.0))
    angles.append((random.uniform(0, 180), random.uniform(-90, 90)))


def parts(x):
    hi = float(x)
    return "%s, %s" % (hi.hex(), float(x - mpf(hi)).hex())


with open("degrees.inc", "w") as out:
    out.write("/* deg, more, sine (leading, rest), cosine (leading, rest): made by degrees.py */\n")
    for a, b in angles:
        x = mpf((Fraction(a) + Fraction(b)) % 360 * 2**1100 // 1) / mpf(2) ** 1100 * pi / 180
        out.write("{%s, %s, %s, %s},\n" % (a.hex(), b.hex(), parts(sin(x)), parts(cos(x))))
