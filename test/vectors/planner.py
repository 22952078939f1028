#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Scenes made to deceive a planner, with their exact visibility -> planner.inc.

Nearly convex, nearly closed and touching bodies, hidden materials, backs: coordinates are doubles
taken as exact, some of them one ulp from a special place. The visible share of every facet is
visible.py's, in rational arithmetic; areas and cosines are printed with 25 digits.
usage: planner.py > planner.inc
"""
from fractions import Fraction as F

from mpmath import mp, mpf

from visible import BOX, box, cross, dot, shares, sub

mp.dps = 40
SHADOWS, BACKS = 1, 2  # bits of effects that must be off
ULP = 2.0 ** -52
OPEN = [t for t in BOX if t not in ((4, 5, 7), (4, 7, 6))]  # the unit box without its top
TOP = [(4, 5, 7), (4, 7, 6)]


class Scene:
    def __init__(self, name, off=0):
        self.name, self.off, self.verts, self.facets, self.body = name, off, [], [], []

    def add(self, verts, facets, body=0):
        base = len(self.verts)
        self.verts += [tuple(float(x) for x in v) for v in verts]
        self.facets += [tuple(base + i for i in t) for t in facets]
        self.body += [body] * len(facets)
        return self

    def box(self, lo, hi, body=0, inverted=False):
        v, f = box(lo, hi)
        return self.add(v, [t[::-1] for t in f] if inverted else f, body)

    def plate(self, corner, u, v, body=0):
        p = [corner, tuple(c + x for c, x in zip(corner, u)),
             tuple(c + x + y for c, x, y in zip(corner, u, v)),
             tuple(c + y for c, y in zip(corner, v))]
        return self.add(p, [(0, 1, 2), (0, 2, 3)], body)


def unit():
    return box((0, 0, 0), (1, 1, 1))[0]


def fan(point):
    """The unit box, its top a fan around a point."""
    return unit() + [point], OPEN + [(4, 5, 8), (5, 7, 8), (7, 6, 8), (6, 4, 8)]


def crease(depth):
    v = unit() + [(0.5, 0, 1 - depth), (0.5, 1, 1 - depth)]
    f = [t for t in OPEN if t not in ((0, 1, 5), (0, 5, 4), (2, 6, 7), (2, 7, 3))]
    return v, f + [(0, 1, 5), (0, 5, 8), (0, 8, 4), (2, 6, 9), (2, 9, 7), (2, 7, 3),
                   (4, 8, 9), (4, 9, 6), (8, 5, 7), (8, 7, 9)]


def scenes():
    yield Scene("box", SHADOWS | BACKS).box((0, 0, 0), (1, 1, 1)), []
    # nearly convex
    for depth in (ULP / 2, 1e-15, 1e-9, 1e-3):
        grazing = [(1, 0.25, depth / 2), (1, 0.25, depth), (-1, 0.125, 3 * depth)]
        yield Scene("top pushed in by %g" % depth, BACKS).add(*fan((0.5, 0.5, 1 - depth))), grazing
        yield Scene("top creased by %g" % depth, BACKS).add(*crease(depth)), grazing
    yield (Scene("top pulled out by an ulp", SHADOWS | BACKS).add(*fan((0.5, 0.5, 1 + ULP))),
           [(1, 0.25, ULP / 2)])
    yield Scene("top fanned", SHADOWS | BACKS).add(*fan((0.5, 0.5, 1))), [(1, 0.25, ULP)]
    # nearly closed
    for thin in (1e-3, 1e-9, ULP):
        v, f = fan((0.5, thin, 1))
        f.remove((4, 5, 8))
        yield Scene("a sliver of %g missing" % thin).add(v, f), []
        yield (Scene("a crack of %g at a T-junction" % thin).add(
            unit() + [(0.5, thin, 1)], OPEN + [(4, 8, 6), (8, 5, 7), (8, 7, 6)]), [])
        yield (Scene("an overlap of %g at a T-junction" % thin).add(
            unit() + [(0.5, -thin, 1)], OPEN + [(4, 8, 6), (8, 5, 7), (8, 7, 6)]), [])
    yield (Scene("a T-junction that fits").add(
        unit() + [(0.5, 0, 1)], OPEN + [(4, 8, 6), (8, 5, 7), (8, 7, 6)]), [])
    yield Scene("one facet missing").add(unit(), OPEN + TOP[:1]), []
    yield Scene("one facet flipped").add(unit(), OPEN + [TOP[0], TOP[1][::-1]]), []
    yield Scene("an inverted box").box((0, 0, 0), (1, 1, 1), inverted=True), []
    # touching bodies
    for name, lo in (("a face", (1, 0, 0)), ("half a face", (1, 0.5, 0.25)), ("an edge", (1, 1, 0)),
                     ("a vertex", (1, 1, 1)), ("a resting face", (0.25, 0.25, 1)),
                     ("nothing by an ulp", (0.25, 0.25, 1 + ULP)),
                     ("an ulp of volume", (0.25, 0.25, 1 - ULP / 2))):
        yield (Scene("boxes that share " + name).box((0, 0, 0), (1, 1, 1))
               .box(lo, tuple(x + 0.5 for x in lo), 1), [])
    # bodies in bodies
    yield (Scene("a box inside another").box((0, 0, 0), (1, 1, 1))
           .box((0.25, 0.25, 0.25), (0.75, 0.75, 0.75), 1), [])
    yield (Scene("a hollow box").box((0, 0, 0), (1, 1, 1))
           .box((0.25, 0.25, 0.25), (0.75, 0.75, 0.75), 1, inverted=True), [])
    yield (Scene("a box in an inverted one").box((0, 0, 0), (1, 1, 1), inverted=True)
           .box((0.25, 0.25, 0.25), (0.75, 0.75, 0.75), 1), [])
    # hidden materials
    for gap in (1.0, ULP, 0.0):
        yield (Scene("a plate %g behind another" % gap).plate((0, 0, 1 + gap), (1, 0, 0), (0, 1, 0))
               .plate((0, 0, 1), (1, 0, 0), (0, 1, 0), 1), [])
    yield (Scene("a plate that another covers but for an ulp")
           .plate((0, 0, 2), (1 - ULP / 2, 0, 0), (0, 1, 0))
           .plate((0, 0, 1), (1, 0, 0), (0, 1, 0), 1), [])
    # backs
    yield Scene("a plate").plate((0, 0, 0), (1, 0, 0), (0, 1, 0)), []
    yield (Scene("opposite skins").plate((0, 0, 0), (1, 0, 0), (0, 1, 0))
           .plate((0, 0, 0), (0, 1, 0), (1, 0, 0), 1), [])
    yield (Scene("fins of no thickness on a box").box((0, 0, 0), (1, 1, 1))
           .plate((1, 0.25, 0.5), (1, 0, 0), (0, 0.5, 0), 1)
           .plate((0.25, 0.5, 1), (0.5, 0, 0), (0, 0, 0.5), 1), [])
    yield (Scene("a fin through a box").box((0, 0, 0), (1, 1, 1))
           .plate((-0.5, 0.5, -0.5), (2, 0, 0), (0, 0, 2), 1), [])


DIRECTIONS = [(0, 0, 1), (0, 0, -1), (0.5, 0.75, 1), (-0.3, 0.7, -0.2), (1, -0.25, 0.01)]


def number(x):
    return mp.nstr(x, 25, min_fixed=0, max_fixed=0, strip_zeros=False) + "L"


def row(scene, d):
    verts = [tuple(F(x) for x in v) for v in scene.verts]
    d = tuple(F(float(x)) for x in d)
    seen, cos2 = [], []
    for t, share in zip(scene.facets, shares(verts, scene.facets, d)):
        n = cross(sub(verts[t[1]], verts[t[0]]), sub(verts[t[2]], verts[t[0]]))
        nd = dot(n, d)
        c = F(nd * nd) / (dot(n, n) * dot(d, d))
        size = mp.sqrt(mpf(dot(d, d).numerator) / dot(d, d).denominator)
        part = abs(nd) * (share or 0) / 2
        seen.append(mpf(part.numerator) / part.denominator / size)
        cos2.append(mpf(c.numerator) / c.denominator * (1 if nd > 0 else -1))
    print('{"%s", %d, %d, %d, {%s},' % (scene.name, scene.off, len(verts), len(seen),
                                        ", ".join(float(x).hex() for x in d)))
    print(" {%s}," % ", ".join("{{%s, %s, %s}}" % tuple(x.hex() for x in v) for v in scene.verts))
    print(" {%s}," % ", ".join("{{%d, %d, %d}}" % t for t in scene.facets))
    print(" {%s}," % ", ".join(str(b) for b in scene.body))
    print(" {%s}," % ", ".join(number(x) for x in seen))
    print(" {%s}}," % ", ".join(number(x) for x in cos2))


def main():
    print("/* Generated by planner.py: exact visible areas by rational arithmetic. Do not edit. */")
    for scene, more in scenes():
        for d in DIRECTIONS + more:
            row(scene, d)


main()
