#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Visible shares of facets in small scenes, in exact rational arithmetic -> visible.inc.

Scenes have small integer coordinates and directions, so that degenerate contacts abound. A facet's
hidden region is the union of convex polygons (each nearer facet, cut by the plane where the two
heights are equal); its area comes from inclusion and exclusion over their intersections, with no
decision ever rounded. Coincident coplanar facets: front beats back, then the lower index.
usage: visible.py > visible.inc
"""
import random
from fractions import Fraction as F


def sub(a, b):
    return tuple(x - y for x, y in zip(a, b))


def cross(a, b):
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def clip(poly, f):
    """The part of a convex polygon where the affine function f is positive or zero."""
    out = []
    for i, p in enumerate(poly):
        q = poly[(i + 1) % len(poly)]
        fp, fq = f(p), f(q)
        if fp >= 0:
            out.append(p)
        if (fp > 0 and fq < 0) or (fp < 0 and fq > 0):
            t = F(fp) / (fp - fq)
            out.append((p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])))
    return out


def area(poly):
    return abs(sum(p[0] * poly[(i + 1) % len(poly)][1] - p[1] * poly[(i + 1) % len(poly)][0]
                   for i, p in enumerate(poly))) / F(2) if len(poly) > 2 else F(0)


def inside(poly, tri):
    """poly cut by a counter-clockwise triangle."""
    for k in range(3):
        a, b = tri[k], tri[(k + 1) % 3]
        poly = clip(poly, lambda p: (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]))
        if area(poly) == 0:
            return []
    return poly


def union(polys, tris, part):
    """Area of the union of convex regions within part: inclusion and exclusion, empty ones pruned.
    Each region is a list of cuts applied to a polygon."""
    total = F(0)
    for i, region in enumerate(polys):
        piece = region(part)
        if area(piece) != 0:
            total += area(piece) - union(polys[i + 1:], tris, piece)
    return total


def shares(verts, facets, d):
    """The visible share of each facet's projected area, or None where it has none."""
    axis = max(range(3), key=lambda k: abs(d[k]))
    e, g = (axis + 1) % 3, (axis + 2) % 3
    flip = 1 if d[axis] > 0 else -1

    def project(p):  # along d onto the plane of the other two axes, seen from d's side
        x = F(p[e]) - F(p[axis] * d[e], d[axis])
        y = F(p[g]) - F(p[axis] * d[g], d[axis])
        return (x, y) if flip > 0 else (y, x)

    info = []
    for f in facets:
        a, b, c = (verts[i] for i in f)
        n = cross(sub(b, a), sub(c, a))
        facing = dot(n, d)
        facing = (facing > 0) - (facing < 0)
        tri = [project(p) for p in (a, b, c)]
        if facing < 0:
            tri.reverse()
        info.append((n, a, facing, tri))

    def height(i):  # along d, over a projected point; affine
        n, a, _, _ = info[i]
        nd = dot(n, d)
        return lambda q: F(dot(n, a) - (n[e] * (q[0] if flip > 0 else q[1]) +
                                        n[g] * (q[1] if flip > 0 else q[0]))) / nd

    out = []
    for i, (n, a, facing, tri) in enumerate(info):
        if facing == 0:
            out.append(None)
            continue
        hi = height(i)
        regions = []
        for j, (m, b, other, tj) in enumerate(info):
            if j == i or other == 0:
                continue
            if cross(n, m) == (0, 0, 0) and dot(n, sub(b, a)) == 0:
                if (other > facing) or (other == facing and j < i):
                    regions.append(lambda poly, t=tj: inside(poly, t))
            else:
                hj = height(j)
                regions.append(lambda poly, t=tj, h=hj: clip(inside(poly, t), lambda q: h(q) - hi(q)))
        out.append(1 - union(regions, None, tri) / area(tri))
    return out


BOX = [(0, 2, 3), (0, 3, 1), (4, 5, 7), (4, 7, 6), (0, 1, 5), (0, 5, 4), (2, 6, 7), (2, 7, 3),
       (0, 4, 6), (0, 6, 2), (1, 3, 7), (1, 7, 5)]


def box(lo, hi):
    v = [tuple(hi[k] if i >> k & 1 else lo[k] for k in range(3)) for i in range(8)]
    return v, list(BOX)


def scene(kind, rnd):
    def point(r=6):
        return tuple(rnd.randint(-r, r) for _ in range(3))

    if kind == "soup":
        n = rnd.randint(3, 7)
        v = [point() for _ in range(3 * n)]
        return v, [(3 * i, 3 * i + 1, 3 * i + 2) for i in range(n)]
    if kind == "sheet":  # shared vertices: fans and folds
        v = [point(3) for _ in range(rnd.randint(5, 7))]
        f = []
        while len(f) < 6:
            t = tuple(rnd.sample(range(len(v)), 3))
            if cross(sub(v[t[1]], v[t[0]]), sub(v[t[2]], v[t[0]])) != (0, 0, 0):
                f.append(t)
        return v, f
    if kind == "plane":  # coplanar overlaps and duplicates, with one plate above or across
        v = [(rnd.randint(-4, 4), rnd.randint(-4, 4), 0) for _ in range(9)] + [point(4) for _ in range(3)]
        f = [(0, 1, 2), (3, 4, 5), (6, 7, 8), (2, 1, 0), (9, 10, 11)]
        rnd.shuffle(f)
        return v, f
    if kind == "boxes":  # two boxes, apart, touching or piercing
        v, f = [], []
        for _ in range(2):
            lo = point(3)
            w, g = box(lo, tuple(x + rnd.randint(1, 4) for x in lo))
            f += [tuple(len(v) + i for i in t) for t in g]
            v += w
        return v, f
    lo = (-1, -1, -1)  # a bus and two wings
    v, f = box(lo, (1, 1, 1))
    for side in (-1, 1):
        y0, y1, z, t = 2 * side, rnd.randint(3, 6) * side, rnd.randint(-1, 1), rnd.randint(-1, 1)
        b = len(v)
        v += [(-1, y0, z - t), (1, y0, z + t), (1, y1, z + t), (-1, y1, z - t)]
        f += [(b, b + 1, b + 2), (b, b + 2, b + 3)]
    return v, f


def main():
    rnd = random.Random(20261121)
    print("/* Generated by visible.py: exact visible shares by rational arithmetic. Do not edit. */")
    kinds = [("soup", 60), ("sheet", 50), ("plane", 40), ("boxes", 30), ("satellite", 30)]
    for kind, count in kinds:
        for _ in range(count):
            v, f = scene(kind, rnd)
            f = [t for t in f if cross(sub(v[t[1]], v[t[0]]), sub(v[t[2]], v[t[0]])) != (0, 0, 0)]
            d = (0, 0, 0)
            while d == (0, 0, 0):
                d = tuple(rnd.randint(-3, 3) for _ in range(3)) if rnd.random() < 0.6 else \
                    tuple(rnd.randint(-40, 40) for _ in range(3))
            s = shares(v, f, d)
            print('{"%s", %d, %d, {%d, %d, %d},' % ((kind, len(v), len(f)) + d))
            print(" {%s}," % ", ".join("{{%d, %d, %d}}" % p for p in v))
            print(" {%s}," % ", ".join("{{%d, %d, %d}}" % t for t in f))
            print(" {%s}}," % ", ".join("-1" if x is None else float(x).hex() for x in s))


if __name__ == "__main__":
    main()
