#!/usr/bin/python3
# SPDX-License-Identifier: MIT
# References of the hard cases: of test_plain.c, by name, and of test_hard.c. sigma from Eq. 2 at
# inputs that are exact doubles, by mpmath at 50 digits; walls and curved bodies by closed.py, visible
# areas by hand, as said beside each, in exact fractions. Writes hard.inc: a name, a value rounded once.
from fractions import Fraction as Q
from mpmath import mp, mpf, exp, log1p, pi, sqrt
import closed

mp.dps = 50
DEFAULT = (1.0, 0.25, 0.2, 0.5)
rows = []


def put(name, value):
    rows.append((name, value))


def number(x):
    x = Q(x)
    return mpf(x.numerator) / x.denominator


def eq2(area, cos2, mat=DEFAULT):
    """4 pi S f_r cos^2 of a flat area, from cos^2 (a fraction) of its incidence."""
    A, B, s, m = [number(v) for v in mat]
    t2 = number(1 / Q(cos2) - 1)
    glint = A * exp(2 * log1p(t2) - t2 / s ** 2) if A else mpf(0)
    return 4 * pi * area * (glint + B * exp(-(m / 2 + 1) * log1p(t2)))


def shape(kind, deg, mat, parts=0, **dims):
    return sum(closed.sigma(kind, parts, closed.dims(**dims), deg, mat))


def plate(direction, mat=DEFAULT):
    """A unit plate, front on +z."""
    x, y, z = [Q(v) for v in direction]
    return eq2(mpf(1), z * z / (x * x + y * y + z * z), mat)


def facet(corners, direction, mat=DEFAULT):
    """One triangle of exact doubles, wholly seen."""
    a, b, c = [[Q(v) for v in p] for p in corners]
    d = [Q(v) for v in direction]
    p = [v - u for u, v in zip(a, b)]
    q = [v - u for u, v in zip(a, c)]
    n = [p[i - 2] * q[i - 1] - p[i - 1] * q[i - 2] for i in range(3)]
    nn = sum(v * v for v in n)
    dot = sum(u * v for u, v in zip(n, d))
    if dot <= 0:
        return mpf(0)
    return eq2(sqrt(number(nn)) / 2, dot * dot / (nn * sum(v * v for v in d)), mat)


def box(size, direction, mat=DEFAULT):
    d = [Q(v) for v in direction]
    dd = sum(v * v for v in d)
    return sum(eq2(number(Q(size[i - 1]) * Q(size[i - 2])), d[i] * d[i] / dd, mat)
               for i in range(3) if d[i] > 0)


def table():
    """The cases of test_plain.c, in its order."""
    put("sphere, s = 0.02", shape(closed.SPHERE, 0.0, (1.0, 0.25, 0.02, 0.5), R=1.0))
    put("cylinder broadside, m = 10000",
        shape(closed.CYLINDER, 90.0, (1.0, 0.25, 0.2, 1e4), 1, R=0.5, L=2.0))
    put("cylinder broadside, s = 0.0001",
        shape(closed.CYLINDER, 90.0, (1e6, 0.25, 1e-4, 0.5), 1, R=0.5, L=2.0))
    put("cylinder wall seen end-on", mpf(0))
    put("cone of 1e-9 deg, nose-on", shape(closed.CONE, 0.0, DEFAULT, 1, R=0.5, beta=1e-9))
    put("cone of 89.9999 deg, s = 1e-6",
        shape(closed.CONE, 0.0, (1.0, 0.25, 1e-6, 0.5), 1, R=0.5, beta=89.9999))
    put("cone along its side, s = 0.001",
        shape(closed.CONE, 45.0, (1e4, 0.25, 1e-3, 0.5), 1, R=0.5, beta=45.0))
    put("paraboloid, m = 1", shape(closed.PARABOLOID, 0.0, (1.0, 0.25, 0.2, 1.0), 1, R=0.5, L=0.4))
    put("paraboloid 1e-6 deep",
        shape(closed.PARABOLOID, 0.0, (1.0, 0.25, 0.5, 0.5), 1, R=1.0, L=1e-6))
    put("plate 1e-60 rad from edge-on", plate((1.0, 0.0, 1e-60)))
    put("plate exactly edge-on", mpf(0))
    put("glint 1e-6 wide, 2e-6 off normal", plate((2e-6, 0.0, 1.0), (1.0, 0.25, 1e-6, 0.5)))
    put("glint that underflows, 63 deg", plate((2.0, 0.0, 1.0), (1.0, 0.25, 1e-3, 0.5)))
    third = 1 / 3.0
    tip = (0.5 + 2.0 ** -40, 0.5 * third, 2.0 ** -3)
    put("needle of aspect 1e12", facet([(0, 0, 0), (1, third, 0.25), tip], (1, 2, -3)))
    put("sliver of aspect 1e8, Heron", plate((1.0, 2.0, 4.0)) * mpf(2) ** -28)
    put("facet of no area", plate((1.0, 2.0, 4.0)))
    put("box of 2^-500 m", box((1, 1, 1), (1, 2, 3)) * mpf(2) ** -1000)
    put("box of 2^300 m", box((1, 1, 1), (1, 2, 3)) * mpf(2) ** 600)
    # A wall 1 m high on the plate's edge shades tan a = d_x / d_z of it; the wall is black.
    bracket = eq2(mpf(5) / 8, Q(64, 73))
    put("L-bracket, 3/8 in shadow", bracket)
    put("the same, 2^-20 of its size", bracket * mpf(2) ** -40)
    put("the same, moved 2^20 m", bracket)
    # 40 fins 1 high, 1/8 apart, light (1, 0, 2): the gaps' floors are dark, each fin but the last
    # is lit over 1/4.
    put("comb of 40 fins", eq2(mpf(39) / 4 + 1, Q(1, 5)))
    # test_hard.c derives the fractions 1/2 and 5/6.
    put("plates that cross", eq2(sqrt(mpf(8)) / 2, Q(1, 10)) + eq2(sqrt(mpf(8)) * 5 / 6, Q(9, 10)))
    put("facets given twice", plate((0.25, 0.5, 1.0)))
    put("two plates that share a quarter", eq2(mpf(7), Q(1)))
    # From (0, 0, 1) the upper of two unit plates is seen.
    put("skins one ulp apart", eq2(mpf(1), Q(1)))
    put("box inside out", mpf(0))
    put("wholly behind a screen", mpf(0))
    put("box with a T-junction", box((3, 2, 1), (1, 2, 3)))
    put("empty scene", mpf(0))


def plates():
    """Unit plates over slopes, powers and tangents: test_hard.c asks for them by these numbers."""
    for t in ("1e-09", "0.001", "1", "57", "1e+06", "1e+12", "1e+60"):
        for s in ("1e-06", "0.001", "0.2", "1", "1000"):
            for m in ("0", "0.5", "1000", "10000"):
                mat = (1.0, 0.25, float(s), float(m))
                put("plate %s %s %s" % (t, s, m), plate((float(t), 0.0, 1.0), mat))


def cones():
    """Seen from both ends, broadside, and tangent to the wall on either side."""
    for beta in ("1e-09", "0.0001", "45", "89.9999", "89.9999999"):
        b = float(beta)
        for name, light in (("nose", 0.0), ("side", b), ("broad", 90.0), ("tangent", 180 - b),
                            ("base", 180.0)):
            put("cone %s %s" % (beta, name), shape(closed.CONE, light, DEFAULT, R=0.5, beta=b))


def main():
    table()
    plates()
    cones()
    with open("hard.inc", "w") as out:
        out.write("/* What is seen, sigma in m^2: made by hard.py. */\n")
        for name, value in rows:
            out.write('{"%s", %r},\n' % (name, float(value)))


if __name__ == "__main__":
    main()
