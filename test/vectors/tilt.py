#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Incidence of triangles in exact rational arithmetic, printed as the nearest doubles: tilt.inc.
# tan^2 = |N x d|^2 / (N . d)^2 and cos = N . d / (|N| |d|), N = (b - a) x (c - a), of doubles taken
# as exact; slivers among them. Run: python3 tilt.py > tilt.inc
import random
from fractions import Fraction
from math import isqrt, sqrt

random.seed(20)


def cross(p, q):
    return [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]


def dot(p, q):
    return sum(x * y for x, y in zip(p, q))


# The nearest double to the root, to 200 bits first.
def root(x):
    shift = 400 + 2 * max(0, x.denominator.bit_length() - x.numerator.bit_length())
    return float(Fraction(isqrt((x.numerator << shift) // x.denominator), 1 << shift // 2))


def unit(v):
    size = sqrt(sum(float(x) ** 2 for x in v))
    return [float(x) / size for x in v]


def triangle(thin):
    a, b, c = ([random.uniform(-1, 1) for _ in range(3)] for _ in range(3))
    return a, b, [x + thin * (y - z) for x, y, z in zip(b, c, a)] if thin < 1 else c


def normal(corner):
    a, b, c = ([Fraction(x) for x in p] for p in corner)
    return cross([x - y for x, y in zip(b, a)], [x - y for x, y in zip(c, a)])


# A direction at about that angle from the normal, on its front or its back.
def direction(n, tangent, side):
    n = unit(n)
    w = unit(cross(n, [random.uniform(-1, 1) for _ in range(3)]))
    near, off = (1, tangent) if tangent < 1 else (1 / tangent, 1)
    return [side * near * x + off * y for x, y in zip(n, w)]


print("/* Made by tilt.py in exact rational arithmetic; do not edit. */")
print("static const tilt_row tilt_rows[] = {")
for tangent in [1e-12, 1e-8, 1e-5, 1e-3, 0.03, 0.3, 1, 3, 30, 1e3, 1e6, 1e9]:
    for thin in [1, 1, 1e-3, 1e-7]:
        corner = triangle(thin)
        n = normal(corner)
        d = direction(n, tangent, random.choice([-1, 1]))
        e = [Fraction(x) for x in d]
        turn = cross(n, e)
        tan2 = float(Fraction(dot(turn, turn), dot(n, e) ** 2))
        cosine = root(Fraction(dot(n, e) ** 2, dot(n, n) * dot(e, e)))
        cosine = cosine if dot(n, e) > 0 else -cosine
        projected = root(Fraction(dot(n, e) ** 2, 4 * dot(e, e)))
        rows = ["{%s}" % ", ".join("%.17g" % x for x in p) for p in corner]
        print("    {{%s},\n     {%s}, %.17g, %.17g, %.17g}," %
              (", ".join(rows), ", ".join("%.17g" % x for x in d), tan2, cosine, projected))
print("};")
