#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
# Rotation matrices to 50 digits (mpmath), printed as the nearest doubles: pose.inc.
# Euler products and Rodrigues' formula are written out from their definitions; quaternions as
# v -> q v q*. Run: python3 pose.py > pose.inc
from mpmath import mp, mpf, matrix, cos, sin, pi, sqrt, eye

mp.dps = 50


def elementary(axis, deg):
    c, s = cos(mpf(deg) * pi / 180), sin(mpf(deg) * pi / 180)
    j, k = (axis + 1) % 3, (axis + 2) % 3
    r = eye(3)
    r[j, j], r[j, k], r[k, j], r[k, k] = c, -s, s, c
    return r


def euler(sequence, angles):
    r = eye(3)
    for letter, angle in zip(sequence, angles):
        e = elementary("xyz".index(letter.lower()), angle)
        r = r * e if letter.isupper() else e * r
    return r


def rodrigues(axis, deg):
    k = matrix([mpf(a) for a in axis])
    k = k / sqrt(sum(a * a for a in k))
    cross = matrix([[0, -k[2], k[1]], [k[2], 0, -k[0]], [-k[1], k[0], 0]])
    t = mpf(deg) * pi / 180
    return eye(3) + sin(t) * cross + (1 - cos(t)) * cross * cross


def hamilton(a, b):
    return [a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
            a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
            a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
            a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]]


def quaternion(q):
    q = [mpf(a) for a in q]
    n = sqrt(sum(a * a for a in q))
    q = [a / n for a in q]
    conjugate = [q[0], -q[1], -q[2], -q[3]]
    r = eye(3)
    for j in range(3):
        v = [mpf(0)] * 4
        v[1 + j] = mpf(1)
        turned = hamilton(hamilton(q, v), conjugate)
        for i in range(3):
            r[i, j] = turned[1 + i]
    return r


# The arc from d to z turns about d x z by the angle between them.
def shortest(d):
    d = matrix([mpf(a) for a in d])
    d = d / sqrt(sum(a * a for a in d))
    k = matrix([d[1], -d[0], 0])
    n = sqrt(k[0] * k[0] + k[1] * k[1])
    k = k / n
    cross = matrix([[0, -k[2], k[1]], [k[2], 0, -k[0]], [-k[1], k[0], 0]])
    return eye(3) + n * cross + (1 - d[2]) * cross * cross


def number(x):
    x = float(x)
    return repr(x if x != 0 else 0.0)


def row(r):
    return ", ".join(number(r[i, j]) for i in range(3) for j in range(3))


def table(name, kind, rows):
    print("static const %s %s[] = {" % (kind, name))
    for given, r in rows:
        print("    {%s,\n     {%s}}," % (given, row(r)))
    print("};\n")


print("/* Made by pose.py with mpmath at 50 digits; do not edit. */")
triples = [(10, 20, 30), (-75.5, 140, 3.25), (1e-7, 89.99999999, -180), (725, -333, 1e5),
           (0.1, 0.2, 0.3)]
sequences = ["XYZ", "XZY", "YXZ", "YZX", "ZXY", "ZYX", "XYX", "XZX", "YXY", "YZY", "ZXZ", "ZYZ"]
sequences += [s.lower() for s in sequences]
table("euler_rows", "euler_row",
      [('"%s", {%s}' % (s, ", ".join(repr(float(a)) for a in t)), euler(s, t))
       for i, s in enumerate(sequences) for t in (triples[i % 5], triples[(i + 2) % 5])])
axes = [((1, 2, 3), 40), ((-1, 1e-9, 0.5), 179.999), ((1e200, -3e200, 2e200), -61.7),
        ((3e-310, 4e-310, -5e-310), 123), ((0, 0, -2), 30), ((1, 1, 1), 120), ((5, -7, 11), 1e-6)]
table("axis_rows", "axis_row",
      [("{%s}, %r" % (", ".join(repr(float(a)) for a in k), float(t)), rodrigues(k, t))
       for k, t in axes])
quaternions = [(1, 2, 3, 4), (0.1, -0.7, 0.2, 0.6), (1e200, -2e200, 5e199, 1e200),
               (4e-320, 3e-320, -1e-320, 2e-320), (1e-9, 1, 1e-9, 0), (1, 1e-8, -1e-8, 1e-12)]
table("quaternion_rows", "quaternion_row",
      [("{%s}" % ", ".join(repr(float(a)) for a in q), quaternion(q)) for q in quaternions])
directions = [(1, 2, 3), (1, 2, -3), (0.3, -0.4, -1), (1e-3, 2e-3, -1), (1e-9, -3e-9, -1),
              (1e-170, 1e-170, -1), (1e308, -1e308, -1e308), (1e-320, 3e-320, -2e-320),
              (1, 0, 0), (0, -1, 1e-30), (0, -1, -1e-30), (-1e-5, 7e-6, 1)]
table("direction_rows", "direction_row",
      [("{%s}" % ", ".join(repr(float(a)) for a in d), shortest(d)) for d in directions])
azels = [(0, 0), (30, 45), (-123.456, 12.5), (1e6, -89), (17, 89.9999999), (359.999, -60), (45, 30)]
table("azel_rows", "azel_row",
      [("%r, %r" % (float(a), float(e)), shortest(
          (cos(mpf(e) * pi / 180) * cos(mpf(a) * pi / 180),
           cos(mpf(e) * pi / 180) * sin(mpf(a) * pi / 180), sin(mpf(e) * pi / 180))))
       for a, e in azels])
