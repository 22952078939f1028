#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Hostile scenes with their exact visibility, for bounds.c.

Coordinates and directions are arbitrary doubles, taken as exact. Everything is scaled to integers;
points of the view plane are intersections of input lines in homogeneous integers, so that nothing
is ever rounded and nothing grows. The visible part of a facet is what is left after each nearer
facet, cut by the plane where both have one height, is taken away. Eq. 2 is summed at 40 digits.
usage: bounds.py SCENES SEED hostile > FILE   degenerate, aligned, nearly so
       bounds.py SCENES SEED plain > FILE     soups, piercing plates, spacecraft, slivers at large
       bounds.py SCENES SEED lattice > FILE   facets on few points of a lattice, some of them far out
       bounds.py SCENES SEED far > FILE       bodies with up to three vertices far away, 1e2 to 1e24
       bounds.py SCENES SEED contacts > FILE  facets that meet: through corners and sides, in one plane,
                                              at pinched vertices, along sides of many, wound any way
       bounds.py SCENES SEED doubled > FILE   any of these, with facets stored twice, mostly opposite
       bounds.py table [FAMILY:]SEED:NUMBER... > hostile.inc     scenes as rows of C
"""
import math
import random
import sys
from fractions import Fraction as F

from mpmath import mp, mpf

mp.dps = 40


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def sign(x):
    return (x > 0) - (x < 0)


# --- exact polygons: a list of (point, line to the next point), homogeneous ----------------------

def clip(poly, line):
    """The part of a convex polygon where the line is positive or zero, and the part where it is
    negative or zero."""
    sides = [dot(line, p) for p, _ in poly]
    left, right = [], []
    for i, (p, edge) in enumerate(poly):
        a, b = sides[i], sides[(i + 1) % len(poly)]
        cuts = (a > 0 > b) or (a < 0 < b)
        x = cross(edge, line) if cuts else None
        if x and x[2] < 0:
            x = tuple(-c for c in x)
        if a >= 0:
            left.append((p, edge if b >= 0 and (a > 0 or b > 0) or cuts else line))
        if a <= 0:
            right.append((p, edge if b <= 0 and (a < 0 or b < 0) or cuts else line))
        if cuts:
            left.append((x, line if a > 0 else edge))
            right.append((x, line if a < 0 else edge))
    return [q if len(q) > 2 and any(s * dot(line, p) > 0 for p, _ in q) else []
            for q, s in ((left, 1), (right, -1))]


def area(poly):
    """Twice the area."""
    pts = [(F(p[0], p[2]), F(p[1], p[2])) for p, _ in poly]
    return abs(sum(p[0] * q[1] - p[1] * q[0] for p, q in zip(pts, pts[1:] + pts[:1])))


def polygon(corners):
    out = []
    for p, q in zip(corners, corners[1:] + corners[:1]):
        out.append((p, cross(p, q)))
    return out


def shares(verts, facets, d):
    """Facing, normal and visible share of each facet. All integers."""
    axis = max(range(3), key=lambda k: abs(d[k]))
    e, g = (axis + 1) % 3, (axis + 2) % 3
    flat = [(p[e] * d[axis] - p[axis] * d[e], p[g] * d[axis] - p[axis] * d[g], 1) for p in verts]
    info = []
    for f in facets:
        a, b, c = (verts[i] for i in f)
        n = cross(sub(b, a), sub(c, a))
        tri = [flat[i] for i in f]
        turn = dot(cross(tri[0], tri[1]), tri[2])
        if turn < 0:
            tri.reverse()
        info.append((n, a, dot(n, d), polygon(tri), n and dot(n, a) * d[axis]))
    out = []
    for i, (n, a, nd, poly, na) in enumerate(info):
        facing = sign(nd)
        if facing == 0:
            out.append((n, 0, F(0)))
            continue
        whole = area(poly)
        pieces = [poly]
        box = [min(p[k] for p, _ in poly) for k in (0, 1)], [max(p[k] for p, _ in poly) for k in (0, 1)]
        for j, (m, b, md, other, mb) in enumerate(info):
            if j == i or md == 0 or not pieces:
                continue
            if any(all(p[k] <= box[0][k] for p, _ in other) or all(p[k] >= box[1][k] for p, _ in other)
                   for k in (0, 1)):
                continue
            lines = [edge for _, edge in other]
            s = sign(d[axis]) * sign(md) * facing
            above = tuple(s * x for x in (n[e] * md - m[e] * nd, n[g] * md - m[g] * nd, mb * nd - na * md))
            if above == (0, 0, 0):
                if not (sign(md) > facing or (sign(md) == facing and j < i)):
                    continue
            elif above[:2] == (0, 0):
                if above[2] < 0:
                    continue
            else:
                lines.append(above)
            left = []
            for piece in pieces:
                kept, rest = [], piece
                for line in lines:
                    rest, out_part = clip(rest, line)
                    if out_part:
                        kept.append(out_part)
                    if not rest:
                        break
                left += kept if rest else [piece]
            pieces = left
        out.append((n, facing, sum((area(p) for p in pieces), F(0)) / whole))
    return out


# --- scenes ----------------------------------------------------------------------------------------

BOX = [(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4), (2, 6, 7), (2, 7, 3),
       (0, 4, 6), (0, 6, 2), (1, 3, 7), (1, 7, 5)]


class Scene:
    def __init__(self):
        self.v, self.f = [], []
        self.down = False  # seen along z
        self.far = set()   # vertices far away

    def add(self, verts, facets):
        base = len(self.v)
        self.v += [tuple(map(float, p)) for p in verts]
        self.f += [tuple(base + i for i in t) for t in facets]

    def tri(self, a, b, c):
        self.add([a, b, c], [(0, 1, 2)])

    def quad(self, a, b, c, d):
        self.add([a, b, c, d], [(0, 1, 2), (0, 2, 3)])

    def box(self, lo, hi):
        self.add([tuple(hi[k] if i >> k & 1 else lo[k] for k in range(3)) for i in range(8)], BOX)


def some(r, span=4.0, grid=0.3):
    """A number: on a small grid, or anything."""
    return float(r.randint(-4, 4)) if r.random() < grid else r.uniform(-span, span)


def point(r, span=4.0, grid=0.3):
    return (some(r, span, grid), some(r, span, grid), some(r, span, grid))


def mix(a, b, t):
    return tuple(x + t * (y - x) for x, y in zip(a, b))


def soup(r, s):
    for _ in range(r.randint(2, 9)):
        s.tri(point(r), point(r), point(r))


def sheet(r, s):  # shared vertices: folds, fans, edges of many facets
    v = [point(r, 3) for _ in range(r.randint(4, 8))]
    s.add(v, [tuple(r.sample(range(len(v)), 3)) for _ in range(r.randint(4, 9))])


def sliver(r, s):
    for _ in range(r.randint(1, 4)):
        a, b = point(r), point(r)
        w = 10.0 ** -r.uniform(3, 15)
        s.tri(a, b, tuple(x + w * r.uniform(-1, 1) for x in mix(a, b, r.uniform(-0.2, 1.2))))
    for _ in range(r.randint(1, 4)):
        s.tri(point(r), point(r), point(r))


def tiny(r, s):  # small facets over and in a huge one
    big = [point(r, 4) for _ in range(3)]
    s.tri(*big)
    for _ in range(r.randint(1, 6)):
        u, v = sorted((r.random(), r.random()))
        at = tuple(u * a + (v - u) * b + (1 - v) * c for a, b, c in zip(*big))
        w = 10.0 ** -r.uniform(1, 13)
        s.tri(*[tuple(x + w * r.uniform(-1, 1) for x in at) for _ in range(3)])


def nudge(r, x):
    """x one ulp off, towards either side; a zero by 2^-200, since what lies below 2^-300 of a scene's
    largest coordinate counts as zero (run.h)."""
    return math.nextafter(x, r.choice((-9, 9))) if x else math.ldexp(r.choice((-1, 1)), -200)


def skins(r, s):  # a sheet and its copy some ulps away
    v = [point(r, 3) for _ in range(4)]
    f = [(0, 1, 2), (0, 2, 3)][:r.randint(1, 2)]
    s.add(v, f)
    for _ in range(r.randint(1, 2)):
        w = [tuple(nudge(r, x) if r.random() < 0.4 else x for x in p) for p in v]
        s.add(w, [t if r.random() < 0.5 else t[::-1] for t in f])
    s.tri(point(r), point(r), point(r))


def stack(r, s):  # coincident plates
    x, y = r.uniform(1, 3), r.uniform(1, 3)
    for _ in range(r.randint(2, 5)):
        a, b = r.uniform(-2, 1), r.uniform(-2, 1)
        q = [(a, b, 0), (a + x, b, 0), (a + x, b + y, 0), (a, b + y, 0)]
        s.quad(*(q if r.random() < 0.6 else q[::-1]))
    if r.random() < 0.5:
        s.tri(point(r), point(r), point(r))


def tjunction(r, s):
    a, b, c = point(r), point(r), point(r)
    s.tri(a, b, c)
    for _ in range(r.randint(1, 4)):
        p, q = r.choice([(a, b), (b, c), (c, a)])
        t, u = sorted((r.random(), r.random()))
        s.tri(mix(p, q, t), mix(p, q, u), point(r))


def comb(r, s):  # fins that pierce a plate
    s.quad((-3, -3, 0), (3, -3, 0), (3, 3, 0), (-3, 3, 0))
    n = r.randint(2, 6)
    for i in range(n):
        x = -2.5 + 5.0 * i / n + r.choice((0, 0, 1e-12, 0.1))
        lean = r.choice((0, 0, 1e-9, 0.3))
        s.quad((x, -2, -1), (x, 2, -1), (x + lean, 2, 1), (x + lean, -2, 1))


def fan(r, s):  # many facets around one point
    n = r.randint(5, 16)
    top = (0.0, 0.0, r.choice((0.0, 1.0, 1e-9, -0.5)))
    wave = r.choice((0.0, 1e-10, 0.3))
    rim = [(2 * math.cos(2 * math.pi * i / n), 2 * math.sin(2 * math.pi * i / n), wave * r.uniform(-1, 1))
           for i in range(n)]
    s.add([top] + rim, [(0, 1 + i, 1 + (i + 1) % n) for i in range(n)])
    if r.random() < 0.7:
        s.tri(point(r), point(r), point(r))


def boxes(r, s):
    for _ in range(r.randint(1, 3)):
        lo = point(r, 2, 0.5)
        s.box(lo, tuple(x + r.choice((1.0, 0.5, r.uniform(0.01, 3))) for x in lo))


def satellite(r, s):
    s.box((-1, -1, -1), (1, 1, r.choice((1, 1.5))))
    t = r.uniform(-1, 1)
    for side in (-1, 1):
        y0, y1 = 1.3 * side, r.uniform(3, 5) * side
        s.quad((-math.cos(t), y0, -math.sin(t)), (math.cos(t), y0, math.sin(t)),
               (math.cos(t), y1, math.sin(t)), (-math.cos(t), y1, -math.sin(t)))
    n = r.randint(5, 8)
    h = r.uniform(0.2, 1)
    rim = [(0.8 * math.cos(2 * math.pi * i / n), 0.8 * math.sin(2 * math.pi * i / n), 1.5 + h) for i in range(n)]
    s.add([(0, 0, 1.5)] + rim, [(0, 1 + i, 1 + (i + 1) % n) for i in range(n)])
    s.quad((-0.05, 0, 1), (0.05, 0, 1), (0.05, 0, 1.5), (-0.05, 0, 1.5))


def spikes(r, s):  # long sharp points through a small facet's plane
    for _ in range(r.randint(1, 4)):
        w = 10.0 ** -r.uniform(6, 15)
        far = 10.0 ** r.uniform(0, 3)
        tip = (r.uniform(-1, 1), r.uniform(-1, 1), r.uniform(0.1, 1) * far)
        end = (-far * r.uniform(0.3, 1), far * r.uniform(-1, 1), -far * r.uniform(0.1, 1))
        s.tri(tip, end, tuple(x + w * r.uniform(-1, 1) for x in end))
    s.tri((-1, -1, 0), (1, -1, 0), (0, 1, 0))


def roof(r, s):  # a fold that passes a sample by less than double-double tells
    w = r.choice((0.0, 1.0)) * 10.0 ** -r.uniform(28, 60) * r.choice((-1, 1))
    y = r.choice((-1.0, 1.0))
    v = [(-1, w, 0), (1, w, 0), (1, -y, r.uniform(-1, 1)), (-1, -y, 0.3), (1, y, r.uniform(-1, 1)), (-1, -y, -0.5)]
    s.add(v, [r.choice((t, t[::-1])) for t in ((0, 1, 2), (0, 1, 3), (0, 1, 4), (0, 1, 5))][:r.randint(2, 4)])
    s.down = r.random() < 0.7


def turned(r, s):  # a sphere whose pole was pushed through the other: closed, crosses at edges only
    def ring(radius, z):
        return [(radius, radius, z), (-radius, radius, z), (-radius, -radius, z), (radius, -radius, z)]

    o, up, lo, waist = ring(2, 0), ring(1.5, 1), ring(1.5, -1), ring(1, 0)
    mid = [mix(waist[i], waist[(i + 1) % 4], r.choice((0.5, 0.25))) for i in range(4)]
    v = o + up + lo + waist + mid + [(0, 0, -1), (0, 0, 1)]
    f = []
    for i in range(4):
        j = (i + 1) % 4
        f += [(i, j, 4 + j), (i, 4 + j, 4 + i), (4 + i, 4 + j, 12 + j), (4 + i, 12 + j, 12 + i), (12 + i, 12 + j, 20)]
        f += [(j, i, 8 + j), (i, 8 + i, 8 + j), (8 + j, 8 + i, 16 + i), (8 + i, 12 + i, 16 + i),
              (12 + j, 8 + j, 16 + i), (16 + i, 12 + i, 21), (12 + j, 16 + i, 21)]
    s.add(v, f)


# Facets that share corners of a lattice, some of whose coordinates are an ulp off, or far out: needles
# that meet others near their points.

def odd(r):
    x = float(r.randint(-7, 8))
    return x if r.random() < 0.7 else r.choice((x * (1 + 2.0**-52), x * (1 - 2.0**-52), x + 1e-9, x * 1e-12, x / 3,
                                                x * 1e6, x * 1e6, x * 1e9))


def pricked(r, s):  # corners of others stand within next to nothing of a long needle's plane, or side
    def grid():
        return tuple(float(r.randint(-7, 8)) for _ in range(3))

    def along(x, step, t):
        return tuple(a + t * b for a, b in zip(x, step))

    def step():
        return r.choice(((0, 1, 0), (0, -1, 0), (0, 0, -1), (1, 0, 0), grid()))

    far = 10.0 ** r.randint(2, 9)
    side, a = step(), grid()
    b = along(along(a, side, far), grid(), r.choice((0, 1)))
    c = along(grid(), step(), r.choice((0, 1, far)))
    s.tri(*r.sample((a, b, c), 3))
    for _ in range(r.randint(1, 4)):
        p = along(a, side, r.choice((0, 1, 2, r.randint(0, 9), r.random(), far * r.random())))
        p = along(p, grid(), r.choice((0, 0, 0, 1)) * 10.0 ** -r.randint(3, 16))
        s.tri(*r.choice(((p, grid(), grid()), (p, a, grid()), (grid(), p, b))))


def make_lattice(r):
    s = Scene()
    if r.random() < 0.5:
        pricked(r, s)
    else:
        few = [odd(r) for _ in range(r.choice((4, 6, 30)))]
        v = [tuple(r.choice(few) for _ in range(3)) for _ in range(r.randint(4, 11))]
        s.add(v, [tuple(r.sample(range(len(v)), 3)) for _ in range(r.randint(2, 10))])
    valid(s)
    d = r.choice(((0.0, 0.0, 1.0), tuple(odd(r) for _ in range(3))))
    return "lattice", s, d if max(map(abs, d)) > 0 else (0.0, 0.0, 1.0)


# Plain ones: nothing lies on a grid, bodies are turned at random.

def turn(r, s):
    q = [r.gauss(0, 1) for _ in range(4)]
    w, x, y, z = (c / math.sqrt(sum(p * p for p in q)) for c in q)
    rows = ((1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)),
            (2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)),
            (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)))
    s.v = [tuple(dot(row, p) for row in rows) for p in s.v]


def soups(r, s):
    for _ in range(r.randint(3, 16)):
        s.tri(*(point(r, 4, 0) for _ in range(3)))


def plates(r, s):  # through each other
    for _ in range(r.randint(2, 6)):
        at, u, v = point(r, 1.5, 0), point(r, 2, 0), point(r, 2, 0)
        s.quad(*(tuple(a + i * b + j * c for a, b, c in zip(at, u, v))
                 for i, j in ((-1, -1), (1, -1), (1, 1), (-1, 1))))


def spacecraft(r, s):  # bus, booms, panels in one or two wings, dish, feed
    x, y, z = (r.uniform(0.5, 1.5) for _ in range(3))
    s.box((-x, -y, -z), (x, y, z))
    t = r.uniform(-math.pi, math.pi)
    width, gap, length = r.uniform(0.4, 1.5), r.uniform(0.1, 1), r.uniform(1, 5)
    c, e = width * math.cos(t), width * math.sin(t)
    for side in (-1, 1)[:r.randint(1, 2)]:
        near, far, thin = side * (y + gap), side * (y + gap + length), 0.05
        s.box((-thin, min(side * y, near), -thin), (thin, max(side * y, near), thin))
        s.quad((-c, near, -e), (c, near, e), (c, far, e), (-c, far, -e))
    n, radius, deep = r.randint(6, 12), r.uniform(0.4, 1.5), r.uniform(0.1, 0.6)
    low = z + r.uniform(0, 0.3)
    rim = [(radius * math.cos(2 * math.pi * i / n), radius * math.sin(2 * math.pi * i / n), low + deep) for i in range(n)]
    s.add([(0, 0, low)] + rim, [(0, 1 + i, 1 + (i + 1) % n) for i in range(n)])
    s.quad((-0.04, 0, low), (0.04, 0, low), (0.04, 0, low + 2 * deep), (-0.04, 0, low + 2 * deep))
    turn(r, s)


def slivers(r, s):  # from a thousandth to a tenth as wide as long, between larger facets
    for _ in range(r.randint(2, 8)):
        a, b = point(r, 4, 0), point(r, 4, 0)
        w = 10.0 ** -r.uniform(0.5, 2.5)
        s.tri(a, b, tuple(p + w * r.uniform(-1, 1) for p in mix(a, b, r.random())))
    for _ in range(r.randint(1, 4)):
        s.tri(*(point(r, 4, 0) for _ in range(3)))


PLAIN = [soups, plates, spacecraft, slivers]
KINDS = [soup, sheet, sliver, tiny, skins, stack, tjunction, comb, fan, boxes, satellite, spikes, roof, turned]


def direction(r, s):
    pick = r.random()
    if s.down:
        d = (0.0, 0.0, 1.0)
    elif pick < 0.2:
        d = tuple(float(r.randint(-3, 3)) for _ in range(3))
    elif pick < 0.3:
        d = (1.0, r.choice((1e-9, 1e-12, 1e-17)), r.choice((0.0, 1e-17, -1e-17)))
        k = r.randint(0, 2)
        d = d[k:] + d[:k]
    elif pick < 0.55:  # nearly in the plane of a facet, or along an edge
        a, b, c = (s.v[i] for i in r.choice(s.f))
        w = r.choice((0, 1e-16, 1e-12, 1e-9, 1e-6, 1e-3))
        d = mix(sub(b, a), sub(c, a), r.choice((0, 0.5, r.random())))
        d = tuple(x + w * r.uniform(-1, 1) for x in d)
    elif pick < 0.65:  # along a normal
        a, b, c = (s.v[i] for i in r.choice(s.f))
        d = cross(sub(b, a), sub(c, a))
    elif pick < 0.72:
        d = (0.0, 0.0, 1.0)
    else:
        d = tuple(r.gauss(0, 1) for _ in range(3))
    return d if max(map(abs, d)) > 1e-200 else (0.0, 0.0, 1.0)


def valid(s):
    """Drops facets without area."""
    good = []
    for t in s.f:
        a, b, c = (tuple(map(F, s.v[i])) for i in t)
        if cross(sub(b, a), sub(c, a)) != (0, 0, 0):
            good.append(t)
    s.f = good


def make_plain(r):
    kind = r.choice(PLAIN)
    s = Scene()
    kind(r, s)
    valid(s)
    return kind.__name__, s, tuple(r.gauss(0, 1) for _ in range(3))


# Bodies with some vertices far away. Most facets at these do not reflect: then sigma is that of the
# body, and its bound must not depend on how far they reach.

def far_point(r):
    far = 10.0 ** r.choice((r.uniform(2, 6), r.uniform(2, 24)))
    d = r.choice(((1.0, 0.0, 0.0), (0.0, 0.0, 1.0), (0.0, -1.0, 0.0), (1.0, 1.0, 0.5), tuple(r.gauss(0, 1) for _ in range(3))))
    return tuple(far * x for x in d)


def make_far(r):
    kind = r.choice(PLAIN + [spacecraft, spacecraft, satellite, boxes, sheet, comb, tjunction])
    s = Scene()
    kind(r, s)
    at = far_point(r)
    for _ in range(r.randint(1, 3)):
        pick = r.random()
        if pick < 0.4:  # a vertex of the body, moved
            i = r.choice(r.choice(s.f))
            s.v[i] = at
            s.far.add(i)
        elif pick < 0.6:  # a sail between an edge of the body and a point far away
            a, b = r.sample(r.choice(s.f), 2)
            s.far.add(len(s.v))
            s.v.append(at)
            s.f.append((a, b, len(s.v) - 1))
        elif pick < 0.85:  # a facet over or under the body
            s.far.add(len(s.v))
            s.tri(at, point(r), point(r))
        else:  # two of its corners far away
            s.far |= {len(s.v), len(s.v) + 1}
            s.tri(at, far_point(r), point(r))
        if r.random() < 0.5:
            at = far_point(r)
    move = r.choice((0, 0, 0, 1e3, -1e6))
    scale = r.choice((1, 1, 2.0 ** -20, 2.0 ** 30))
    s.v = [tuple((x + move) * scale for x in p) for p in s.v]
    valid(s)
    d = tuple(r.gauss(0, 1) for _ in range(3))
    if s.f and r.random() < 0.4:
        d = direction(r, s)
    return "far_" + kind.__name__, s, d


# Facets that intersect, touch and coincide in every way. Coordinates are multiples of 6, so that middles of sides
# and of facets are integers: what passes through a corner or a side does so exactly.

def six(r):
    return tuple(6.0 * r.randint(-4, 4) for _ in range(3))


def plus(a, b, t=1):
    return tuple(x + t * y for x, y in zip(a, b))


def spot(r, a, b, c):
    """A corner of a facet, the middle of a side, a point inside, or one beyond a corner."""
    a, b, c = r.sample((a, b, c), 3)
    return r.choice((a, mix(a, b, 0.5), tuple((x + y + z) / 3 for x, y, z in zip(a, b, c)), plus(a, a, 0.5)))


def meet(r, s):  # the next facet passes through one spot of another, or two, with a spot of its own
    at = [tuple(six(r) for _ in range(3))]
    for _ in range(r.randint(1, 6)):
        p, q = spot(r, *r.choice(at)), spot(r, *r.choice(at))
        u, v = six(r), six(r)
        at.append(r.choice((
            (p, plus(p, u), plus(p, v)),                                # a corner there
            (plus(p, u), plus(p, u, -1), plus(p, v)),                   # the middle of a side
            (plus(p, u), plus(p, v), plus(plus(p, u, -1), v, -1)),      # its own middle
            (p, q, plus(p, u)),                                         # a side from spot to spot
            (plus(p, plus(q, p, -1), -0.5), plus(q, plus(q, p, -1), 0.5), plus(p, u)),  # and beyond
        )))
    for t in at:
        s.tri(*t)


def plane(r, s):  # overlapping facets in two or three planes that meet, between points of those
    at, side = six(r), [six(r) for _ in range(3)]
    for _ in range(r.randint(2, 7)):
        u, v = r.sample(side, 2)
        s.tri(*(plus(plus(at, u, r.randint(-2, 2) / 2), v, r.randint(-2, 2) / 2) for _ in range(3)))


def pages(r, s):  # facets about one side, some of them on both sides of it, and what passes through it
    a, b = six(r), six(r)
    v = [a, b] + [six(r) for _ in range(r.randint(2, 6))]
    s.add(v, [r.choice(((0, 1, i), (1, 0, i))) for i in range(2, len(v))])
    m = mix(a, b, r.choice((0, 0.5, 0.5, 1)))
    for _ in range(r.randint(0, 2)):
        u, w = six(r), six(r)
        s.tri(plus(m, u), plus(m, u, -1), plus(m, w))


def pinched(r, s):  # cones that share their tip, one of them through a plate, or standing in it
    tip, v, f = six(r), [], []
    for _ in range(r.randint(2, 3)):
        n, first = r.randint(3, 5), len(v) + 1
        v += [plus(tip, six(r)) for _ in range(n)]
        turned = r.random() < 0.5
        f += [(0, first + i, first + (i + 1) % n)[::-1 if turned else 1] for i in range(n - r.randint(0, 1))]
    s.add([tip] + v, f)
    if r.random() < 0.7:
        p = plus(tip, six(r), r.choice((0, 0, 0.5)))
        u, w = six(r), six(r)
        s.quad(plus(p, u), plus(p, w), plus(p, u, -1), plus(p, w, -1))


def moebius(r, s):  # a strip with one side, perhaps so wide that it passes through itself
    n, wide = r.randint(3, 9), r.choice((0.5, 1.0, 3.0))
    v, f = [], []
    for i in range(n):
        a = 2 * math.pi * i / n
        for side in (-wide, wide):
            far = 2 + side * math.cos(a / 2)
            v.append((far * math.cos(a), far * math.sin(a), side * math.sin(a / 2)))
    for i in range(n):
        a, b = 2 * i, 2 * i + 1
        c, d = (2 * i + 2, 2 * i + 3) if i + 1 < n else (1, 0)
        f += [(a, c, d), (a, d, b)]
    s.add(v, f)


def stacked(r, s):  # boxes that share parts of faces, sides or corners, or stand in each other
    lo = six(r)
    size = tuple(6.0 * r.randint(1, 3) for _ in range(3))
    for _ in range(r.randint(2, 3)):
        s.box(lo, plus(lo, size))
        at = tuple(r.choice((0, 0.5, 1, -0.5, -1)) for _ in range(3))
        lo = tuple(x + a * y for x, a, y in zip(lo, at, size))
        size = tuple(y * r.choice((0.5, 1, 1)) for y in size)


def pierced(r, s):  # a folded strip, and what passes through it
    n = r.randint(3, 7)
    s.add([point(r, 3) for _ in range(n)], [(i, i + 1, i + 2) if i % 2 else (i + 1, i, i + 2) for i in range(n - 2)])
    for _ in range(r.randint(1, 3)):
        s.tri(point(r), point(r), point(r))


CONTACTS = [meet, meet, plane, pages, pinched, moebius, stacked, pierced, pierced]


def edge_on(r, s):
    """A direction in the plane of a facet, or nearly so."""
    a, b, c = (s.v[i] for i in r.choice(s.f))
    w = r.choice((0, 1e-18, 1e-17, 1e-16, 1e-15, 1e-14, 1e-12, 1e-9))
    d = mix(sub(b, a), sub(c, a), r.choice((0, 0.5, r.uniform(-1, 2))))
    return tuple(x + w * r.uniform(-1, 1) for x in d)


def make_contacts(r):
    s = Scene()
    for kind in [r.choice(CONTACTS)] + [r.choice(CONTACTS)] * (r.random() < 0.2):
        kind(r, s)
    if r.random() < 0.25:  # nearly
        s.v = [tuple(nudge(r, x) if r.random() < 0.2 else x for x in p) for p in s.v]
    wound = r.choice((0, 0.5, 1))
    s.f = [t[::-1] if r.random() < wound else t for t in s.f]
    if r.random() < 0.5:
        r.shuffle(s.f)
    valid(s)
    d = s.f and (edge_on if kind is pierced else r.choice((direction, edge_on)))(r, s)
    return kind.__name__, s, d if d and max(map(abs, d)) > 0 else (0.0, 0.0, 1.0)


def make(r):
    kind = KINDS[r.randrange(len(KINDS))] if r.random() < 0.9 else KINDS[0]
    s = Scene()
    kind(r, s)
    if kind is not roof and r.random() < 0.3:  # nearly what it was
        s.v = [tuple(math.nextafter(x, r.choice((-99, 99))) if x and r.random() < 0.2 else x for x in p) for p in s.v]
    scale = r.choice((1, 1, 1, 1, 1e-6, 1e6))
    if kind is not roof and r.random() < 0.25:
        move = r.choice((1e6, 1e3, -1e6))
        s.v = [tuple(x + move for x in p) for p in s.v]
    s.v = [tuple(x * scale for x in p) for p in s.v]
    if r.random() < 0.2:
        r.shuffle(s.f)
    valid(s)
    return kind.__name__, s, direction(r, s) if s.f else None


def make_doubled(r):
    """Panels of two faces: facets stored again from any corner, on the same or on equal points, most
    of them wound the other way; all facets, or some; in any order."""
    name, s, d = r.choice((make, make, make_plain, make_lattice))(r)
    part, same = r.choice((1, 1, 0.5)), r.choice((0, 0, 0.2))
    for t in list(s.f):
        if r.random() < part:
            if r.random() < 0.3:
                s.v += [s.v[i] for i in t]
                t = tuple(range(len(s.v) - 3, len(s.v)))
            k = r.randrange(3)
            t = t[k:] + t[:k]
            s.f += [t[::-1]] + [r.choice((t, t[::-1]))] * (r.random() < same)
    if r.random() < 0.5:
        r.shuffle(s.f)
    return name, s, d


FAMILIES = {"hostile": make, "plain": make_plain, "lattice": make_lattice, "doubled": make_doubled,
            "far": make_far, "contacts": make_contacts}


# --- Eq. 2 -------------------------------------------------------------------------------------------

def integers(values):
    """Doubles times the power of two that makes them integers."""
    pairs = [x.as_integer_ratio() for x in values]
    den = max(q for _, q in pairs)
    return [p * (den // q) for p, q in pairs], den


def reflect(brdf, u):
    A, B, s, m = (mpf(x) for x in brdf)
    w = 1 + u
    return (A * w * w * mp.exp(-u / (s * s)) if A else 0) + (B * w ** (-m / 2 - 1) if B else 0)


def sigma(brdfs, which, den, d, seen, sided):
    total = mpf(0)
    for f, (n, facing, share) in enumerate(seen):
        if share == 0 or (facing < 0 and not sided):
            continue
        nd = dot(n, d)
        nn = dot(n, n)
        c = cross(n, d)
        u = mpf(dot(c, c)) / mpf(nd * nd)
        total += mp.sqrt(mpf(nn)) * reflect(brdfs[which[f]], u) * mpf(share.numerator) / mpf(share.denominator)
    return 2 * mp.pi * total / mpf(den) ** 2


def silhouette(den, d, seen):
    total = mpf(0)
    for n, facing, share in seen:
        total += mpf(abs(dot(n, d))) * mpf(share.numerator) / mpf(share.denominator)
    return total / 2 / mp.sqrt(mpf(dot(d, d))) / mpf(den) ** 2


def text(x):
    return mp.nstr(x, 24, min_fixed=0, max_fixed=0)


def show(name, s, d, brdfs, which, seen, sums):
    print("case %s %d %d" % (name, len(s.v), len(s.f)))
    print(*[x.hex() for x in d])
    for b in brdfs:
        print(*[float(x).hex() for x in b])
    for p in s.v:
        print(*[x.hex() for x in p])
    for t, w, (n, facing, share) in zip(s.f, which, seen):
        print(*t, w, text(mpf(share.numerator) / mpf(share.denominator)))
    print(*[text(x) for x in sums])


def row(name, s, d, brdfs, which, seen, sums):
    def braces(values, form=lambda x: float(x).hex()):
        return "{%s}" % ", ".join(map(form, values))

    print('{"%s", %d, %d, %s,' % (name, len(s.v), len(s.f), braces(d)))
    print(" {%s}," % ", ".join(braces(b) for b in brdfs))
    print(" {%s}," % ",\n  ".join("{%s}" % braces(p) for p in s.v))
    print(" {%s}," % ", ".join("{{%d, %d, %d}}" % t for t in s.f))
    print(" %s," % braces(which, str))
    print(" %s," % braces([mpf(x[2].numerator) / mpf(x[2].denominator) for x in seen]))
    print(" %s}," % braces(sums))


def main():
    if sys.argv[1] == "table":
        print("/* Generated by test/hostile/bounds.py %s. Do not edit. */" % " ".join(sys.argv[1:]))
        wanted = [(["hostile"] + x.split(":"))[-3:] for x in sys.argv[2:]]
    else:
        wanted = [(sys.argv[3], sys.argv[2], number) for number in range(int(sys.argv[1]))]
    for family, seed, number in wanted:
        r = random.Random("%s%s %s" % ("" if family == "hostile" else family + " ", seed, number))
        name, s, d = FAMILIES[family](r)
        if not s.f:
            continue
        which = [r.randint(0, 1) for _ in s.f]
        brdfs = [(0, 0.25, 0.2, r.choice((0, 0.5))), (0, 0.5, 0.2, 1.0)] if r.random() < 0.4 else \
            [(r.choice((0, 1)), r.choice((0.25, 0.1)), 10.0 ** r.uniform(-3, -0.155), r.choice((0.5, 0, 3.7, 40))),
                 (r.choice((0, 3, 10)), r.choice((0, 0.3)), 10.0 ** r.uniform(-3, -0.155), 1.0)]
        if s.far and r.random() < 0.7:
            which = [int(any(i in s.far for i in t)) for t in s.f]
            brdfs[1] = (0, 0, 0.2, 1.0)
        flat, den = integers([x for p in s.v for x in p])
        verts = [tuple(flat[3 * i:3 * i + 3]) for i in range(len(s.v))]
        di, _ = integers(d)
        seen = shares(verts, s.f, tuple(di))
        sums = [sigma(brdfs, which, den, di, seen, sided) for sided in (0, 1)] + [silhouette(den, di, seen)]
        (row if sys.argv[1] == "table" else show)("%s %s:%s" % (name, seed, number), s, d, brdfs, which, seen, sums)


main()
