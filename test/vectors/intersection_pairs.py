#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Writes intersection_pairs.inc: pairs of integer triangles and how each meets the open inside of the other.

Found by clipping in rational arithmetic, which constructs the intersections that the library avoids:
not in one plane, the cut of the one with the plane of the other, as a segment in barycentric
coordinates of the other, clipped to where all three are positive; in one plane, the polygon that
Sutherland and Hodgman's clipping leaves, and its area. usage: intersection_pairs.py > intersection_pairs.inc
"""
import random
from fractions import Fraction as F

random.seed(7)
NONE, CROSS, COPLANAR = -1, 0, 1


def sub(a, b):
    return [x - y for x, y in zip(a, b)]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def normal(t):
    return cross(sub(t[1], t[0]), sub(t[2], t[0]))


def mix(p, q, t):
    return [F(a) + t * (F(b) - F(a)) for a, b in zip(p, q)]


def barycentric(f, x):
    """Of a point in the plane of f."""
    n = normal(f)
    return [F(dot(cross(sub(f[(k + 2) % 3], f[(k + 1) % 3]), sub(x, f[(k + 1) % 3])), n)) / dot(n, n)
            for k in range(3)]


def cut(f, t):
    """The ends of the part of t that lies in the plane of f."""
    n = normal(f)
    h = [dot(n, sub(p, f[0])) for p in t]
    ends = [p for p, x in zip(t, h) if x == 0]
    for i in range(3):
        j = (i + 1) % 3
        if h[i] * h[j] < 0:
            ends.append(mix(t[i], t[j], F(h[i], h[i] - h[j])))
    return ends


def segment_meets_inside(f, ends):
    """Is there s in [0, 1] with all three coordinates of (1-s) p + s q positive?"""
    p, q = barycentric(f, ends[0]), barycentric(f, ends[-1])
    low, high, low_open, high_open = F(0), F(1), False, False
    for a, b in zip(p, q):
        d = b - a
        if d == 0:
            if a <= 0:
                return False
        elif d > 0:
            s = -a / d
            if s >= low:
                low, low_open = s, True
        else:
            s = -a / d
            if s <= high:
                high, high_open = s, True
    return low < high or (low == high and not low_open and not high_open)


def clip(poly, f, k):
    out = []
    value = [barycentric(f, x)[k] for x in poly]
    for i in range(len(poly)):
        j = (i + 1) % len(poly)
        if value[i] >= 0:
            out.append(poly[i])
        if value[i] * value[j] < 0:
            out.append(mix(poly[i], poly[j], value[i] / (value[i] - value[j])))
    return out


def overlap(f, t):
    poly = [[F(x) for x in p] for p in t]
    for k in range(3):
        poly = clip(poly, f, k)
        if not poly:
            return False
    total = [F(0)] * 3
    for i in range(1, len(poly) - 1):
        c = cross(sub(poly[i], poly[0]), sub(poly[i + 1], poly[0]))
        total = [a + b for a, b in zip(total, c)]
    return any(total)


def meets(f, t):
    n = normal(f)
    if all(dot(n, sub(p, f[0])) == 0 for p in t):
        return COPLANAR if overlap(f, t) else NONE
    ends = cut(f, t)
    return CROSS if ends and segment_meets_inside(f, ends) else NONE


def rim(f, t):
    """Does t meet a side of f, ends excluded, that is not a side of t too?"""
    flat = all(dot(normal(f), sub(p, f[0])) == 0 for p in t)
    poly = [[F(x) for x in p] for p in (t if flat else cut(f, t))]
    for k in range(3):
        poly = clip(poly, f, k) if poly else []
    for k in range(3):
        along = [barycentric(f, x)[(k + 1) % 3] for x in poly if barycentric(f, x)[k] == 0]
        inside = any(0 < u < 1 for u in along) or (0 in along and 1 in along)
        if inside and not (f[(k + 1) % 3] in t and f[(k + 2) % 3] in t):
            return 1
    return 0


def point(span):
    return [random.randrange(span + 1) for _ in range(3)]


def triangle(span, seeds):
    while True:
        t = [random.choice(seeds) if seeds and random.random() < 0.5 else point(span)
             for _ in range(3)]
        if any(normal(t)):
            return t


def flatten(t, axis):
    return [[0 if k == axis else p[k] for k in range(3)] for p in t]


def pair(i):
    span = (2, 3, 4, 7)[i % 4]
    a = triangle(span, [])
    b = triangle(span, a if i % 3 == 0 else [])
    if i % 5 == 0:
        axis = random.randrange(3)
        a, b = flatten(a, axis), flatten(b, axis)
    return a, b


def main():
    print('/* Made by intersection_pairs.py: how b meets the inside of a, how a meets that of b; whether b meets the')
    print('   rim of a other than in corners of a or along a common side, and a that of b; then a, b. */')
    seen, i = {}, 0
    while sum(seen.values()) < 4000:
        i += 1
        a, b = pair(i)
        if not any(normal(a)) or not any(normal(b)):
            continue
        kinds = (meets(a, b), meets(b, a))
        if seen.get(kinds, 0) >= 1000:
            continue
        seen[kinds] = seen.get(kinds, 0) + 1
        print('PAIR(%d,%d,%d,%d,%s),' % (*kinds, rim(a, b), rim(b, a), ','.join(str(x) for p in a + b for x in p)))


main()
