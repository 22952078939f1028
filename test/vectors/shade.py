#!/usr/bin/python3
# SPDX-License-Identifier: MIT
# sigma of single triangles 0, b, c without shadows, by mpmath at 80 digits, b, c and the direction d
# being exact doubles: 4 pi S f_r cos^2 of Eq. 2 with tan^2 = |N x d|^2 / (N . d)^2, N = b x c. Each
# part as a sum of two doubles. Incidences at random, and where the block's arithmetic is at its
# worst: exactly normal, within a few roundings of it, about every threshold of optics/shade.c, far
# flanks, grazing. Writes shade.inc.
import random
from mpmath import mp, mpf, exp, sqrt, log, pi, cos, sin, atan

mp.dps = 80
random.seed(1412)
S = [1e-6, 1e-4, 1e-3, 0.02, 0.0499, 0.05, 0.1, 0.2, 0.3, 0.7, 1.0, 3.0, 30.0, 1e3]
M = [0.0, 0.3, 0.5, 1.0, 2.0, 7.3, 100.0, 799.0, 801.0, 1e4]


def cross(p, q):
    return [p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0]]


def dot(p, q):
    return sum(x * y for x, y in zip(p, q))


def unit(v):
    size = sqrt(dot(v, v))
    return [x / size for x in v]


def at(theta, b, c):
    n = unit(cross([mpf(x) for x in b], [mpf(x) for x in c]))
    w = unit(cross(n, [mpf(random.uniform(-1, 1)) for _ in range(3)]))
    return [float(x * cos(theta) + y * sin(theta)) for x, y in zip(n, w)]


def triangle():
    b, c = ([random.uniform(-1, 1) for _ in range(3)] for _ in range(2))
    if random.random() < 0.2:
        c = [x + 1e-6 * y for x, y in zip(b, c)]
    return b, c


def row(s, m, A, B, theta):
    b, c = triangle()
    rows.append((A, B, s, m, b, c, at(theta, b, c)))


rows = []
for s in S:
    for x in [0.01, 0.5, 1.0, 5.9, 6.1, 11.9, 12.1, 30.0, 200.0, 689.0, 691.0, 760.0]:
        for B in [0.0, 0.25]:
            row(s, random.choice(M), 1.0, B, atan(mpf(s) * sqrt(mpf(x))))
for m in M:
    for y in [0.01, 1.0, 11.9, 12.1, 200.0, 688.0, 692.0, 760.0]:
        c2 = exp(-2 * mpf(y) / (mpf(m) + 2))
        row(0.2, m, random.choice([0.0, 1.0]), 1.0, atan(sqrt(1 / c2 - 1)))
for cosine in [2.0 ** -6 * (1 + e) for e in (-1e-3, -1e-14, 0, 1e-14, 1e-3)] + [1e-3, 1e-9, 0.02, 0.05, 0.2]:
    for s in [0.2, 1.0, 3.0, 30.0, 1e3]:
        row(s, random.choice(M), 1.0, 0.25, mp.acos(mpf(cosine)))
for theta in [1e-300, 1e-17, 1e-16, 3e-16, 1e-15, 1e-12, 1e-9, 1e-7]:
    for s in [0.05, 0.06, 0.2, 1.0]:
        row(s, random.choice(M), 1.0, 0.25, mpf(theta))
for _ in range(40):  # exactly normal: N of small integers is the direction
    b, c = ([float(random.randint(-9, 9)) for _ in range(3)] for _ in range(2))
    n = cross(b, c)
    if any(n):
        rows.append((1.0, 0.25, random.choice(S[5:]), random.choice(M), b, c, n))
for _ in range(400):
    row(10 ** random.uniform(-1.3, 0.3), random.choice(M + [10 ** random.uniform(-2, 3)]), 1.0,
        random.choice([0.0, 0.01, 0.25, 1.0]), mp.acos(mpf(random.uniform(0, 1))))


def two(x):
    high = float(x)
    return "{%s, %s}" % (high.hex(), float(x - mpf(high)).hex())


def triple(v):
    return "{%s}" % ", ".join(float(x).hex() for x in v)


with open("shade.inc", "w") as out:
    out.write("/* A, B, s, m, b, c, d, glint, diffuse as sums: made by shade.py */\n")
    for A, B, s, m, b, c, d in rows:
        N = cross([mpf(x) for x in b], [mpf(x) for x in c])
        D = [mpf(x) for x in d]
        t = cross(N, D)
        along = dot(N, D)
        if along <= 0:
            continue
        u = dot(t, t) / along ** 2
        S4 = 2 * pi * sqrt(dot(N, N))
        glint = S4 * A * (1 + u) ** 2 * exp(-u / mpf(s) ** 2)
        diffuse = S4 * B * exp(-(mpf(m) / 2 + 1) * log(1 + u))
        out.write("{%s, %s, %s, %s, %s, %s, %s, %s, %s},\n" % (
            float(A).hex(), float(B).hex(), float(s).hex(), float(m).hex(), triple(b), triple(c),
            triple(d), two(glint), two(diffuse)))
