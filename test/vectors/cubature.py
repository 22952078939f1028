#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""References for test/integrate/test_cubature.c: integrals of f_r cos(theta) over a triangle of area
1 whose normals are linear between its corners. Not the method of the library: Gauss-Legendre rules of
20 points (their nodes from mpmath) on panels fitted to the peaks, over polar coordinates of the plane
of slopes (n_x, n_y) / n_z, where the glint depends on the radius alone; over one coordinate where two
corners share a normal; over the lit part of the triangle itself where some normals face away. Sums are
exact (fsum). Each is done twice, with every panel halved: both agree to 1e-12 or the script stops.
usage: cubature.py >cubature.inc"""
from math import atan2, cos, exp, fsum, pi, sin, sqrt
from mpmath import mp, mpf

mp.dps = 22
HALVE = [1]  # panels are cut into so many


def gauss(count):
    """Nodes and weights on [-1, 1], by Newton's method on Legendre's polynomial."""
    rule = []
    for i in range(count):
        x = mp.cos(mp.pi * (i + mpf(3) / 4) / (count + mpf(1) / 2))
        for _ in range(6):
            p0, p1 = mpf(1), x
            for k in range(2, count + 1):
                p0, p1 = p1, ((2 * k - 1) * x * p1 - (k - 1) * p0) / k
            slope = count * (x * p1 - p0) / (x * x - 1)
            x -= p1 / slope
        rule.append((float(x), float(2 / ((1 - x * x) * slope * slope))))
    return rule


RULE = gauss(20)


def quad(f, breaks):
    """The integrals of both parts of f over panels between breaks."""
    terms = [[], []]
    for a, b in zip(breaks, breaks[1:]):
        for h in range(HALVE[0]):
            half = (b - a) / 2 / HALVE[0]
            middle = a + (2 * h + 1) * half
            for x, weight in RULE:
                value = f(middle + half * x)
                terms[0].append(half * weight * value[0])
                terms[1].append(half * weight * value[1])
    return [fsum(terms[0]), fsum(terms[1])]


def parts(u, s, m):
    """Glint and diffuse f_r cos from tan^2, amplitudes 1."""
    w = 1 + u
    return w ** 2.5 * exp(-u / s**2), w ** (-(m + 1) / 2)


def steps(low, high, widths):
    """Breaks of an interval at multiples of the widths of what stands in it, from `low`."""
    at = {low, high}
    for width in widths:
        at |= {low + k * width for k in (0.25, 0.5, 1, 2, 3, 4, 6, 8, 12) if low + k * width < high}
    return sorted(at)


def graded(ends):
    """Breaks that close in on every end: there the diffuse term is a broken power of n_z."""
    at = set(ends)
    for low, high in zip(ends, ends[1:]):
        for k in range(1, 15):
            at |= {low + (high - low) / 2**k, high - (high - low) / 2**k}
    return sorted(at)


def over_slopes(normals, s, m):
    """By polar coordinates about the laser. A point of slopes (p, q) has shares
    lambda = M^-1 (p, q, 1) / w, w the sum of M^-1 (p, q, 1); the area element of the triangle is
    |det M^-1| / w^3 dp dq, times 2 for an area of 1."""
    a, b, c = normals
    rows = [[y[1] * z[2] - y[2] * z[1], y[2] * z[0] - y[0] * z[2], y[0] * z[1] - y[1] * z[0]]
            for y, z in ((b, c), (c, a), (a, b))]  # of M^-1, times det M
    det = fsum(a[k] * rows[0][k] for k in range(3))
    column = [fsum(row[k] for row in rows) / det for k in range(3)]  # w = column . (p, q, 1)
    jacobian = 2 / abs(det)
    corner = [(n[0] / n[2], n[1] / n[2]) for n in normals]
    sides = [(corner[i], corner[(i + 1) % 3]) for i in range(3)]

    def reach(a, b, c, t):
        """Where the ray along (c, t) meets the line through a and b."""
        return (a[0] * b[1] - a[1] * b[0]) / (c * (b[1] - a[1]) - t * (b[0] - a[0]))

    def ray(angle, near, far):
        c, t = cos(angle), sin(angle)
        lean = column[0] * c + column[1] * t

        def along_ray(radius):
            share = radius / abs(column[2] + lean * radius) ** 3
            return [share * part for part in parts(radius * radius, s, m)]

        start = reach(*near, c, t) if near else 0.0
        # on a flank the glint falls by e over s^2 / 2 r
        widths = [s, 1 / sqrt(m + 1)] + ([s * s / 2 / start] if start > 0 else [])
        return quad(along_ray, steps(start, reach(*far, c, t), widths))

    def sector(low, high, near, far):
        # breaks about where the near side comes nearest: there a flank peaks
        ends = {low, high} | {low + (high - low) * k / 8 for k in range(8)}
        for k in range(1, 14):
            ends |= {low + (high - low) / 2**k, high - (high - low) / 2**k}
        value = quad(lambda angle: ray(angle, near, far), sorted(ends))
        return [jacobian * value[k] for k in range(2)]

    turn = [atan2(q[1], q[0]) for q in corner]
    inside = all(a[0] * b[1] - a[1] * b[0] > 0 for a, b in sides)
    if inside:
        pieces = [sector(turn[i], turn[(i + 1) % 3] + (2 * pi if turn[(i + 1) % 3] < turn[i] else 0),
                         None, sides[i]) for i in range(3)]
    else:  # seen from the laser the triangle lies within a half-turn, here about +x
        order = sorted(range(3), key=lambda i: turn[i])
        first, middle, last = (corner[i] for i in order)
        chord = (first, last)
        low, mid, high = (turn[i] for i in order)
        beyond = reach(*chord, cos(mid), sin(mid)) < sqrt(middle[0] ** 2 + middle[1] ** 2)
        pieces = []
        for a, b, side in ((low, mid, (first, middle)), (mid, high, (middle, last))):
            pieces.append(sector(a, b, chord, side) if beyond else sector(a, b, side, chord))
    return [fsum(piece[k] for piece in pieces) for k in range(2)]


def over_strip(a, b, s, m):
    """Corner normals (a, a, b): they turn along one coordinate."""
    def at(t):
        n = [(1 - t) * a[k] + t * b[k] for k in range(3)]
        return (n[0] ** 2 + n[1] ** 2) / n[2] ** 2

    # where the laser comes nearest, and how wide the peak is there
    best = min((at(i / 4096), i / 4096) for i in range(4097))[1]
    turn = sqrt(sum((a[k] - b[k]) ** 2 for k in range(3)))
    ends = set()
    for width in (s / turn, 1 / sqrt(m + 1) / turn, 1 / 4096):
        for k in range(-16, 17):
            ends.add(best + k * width / 2)
    ends = sorted(e for e in ends | {0.0, 1.0} if 0 <= e <= 1)
    return quad(lambda t: [2 * (1 - t) * part for part in parts(at(t), s, m)], ends)


def over_lit(normals, s, m):
    """By shares (x, y) of corners 1 and 2, over what has n_z > 0; smooth enough to go straight."""
    z = [n[2] for n in normals]

    def at(x, y):
        n = [normals[0][k] * (1 - x - y) + normals[1][k] * x + normals[2][k] * y for k in range(3)]
        return (n[0] ** 2 + n[1] ** 2) / n[2] ** 2

    def column(x):
        # z is linear in y: cut [0, 1 - x] where it changes sign
        z0, slope = z[0] * (1 - x) + z[1] * x, z[2] - z[0]
        low, high = 0.0, 1 - x
        if slope > 0:
            low = max(low, -z0 / slope)
        elif slope < 0:
            high = min(high, -z0 / slope)
        elif z0 <= 0:
            return [0.0, 0.0]
        if low >= high:
            return [0.0, 0.0]
        return quad(lambda y: parts(at(x, y), s, m), graded([low, high]))

    breaks = {0.0, 1.0}
    for a, b in ((0, 1), (1, 2)):  # where a side along x crosses z = 0
        if z[a] * z[b] < 0:
            breaks.add(z[a] / (z[a] - z[b]) if (a, b) == (0, 1) else z[2] / (z[2] - z[1]))
    return [2 * value for value in quad(column, graded(sorted(breaks)))]


PEAK = [(-0.25, -0.125, 1), (0.375, -0.125, 1), (0.0625, 0.3125, 1)]  # 30 deg, the laser inside
FLANK = [(0.125, 0.0625, 1), (0.5, 0.0625, 0.875), (0.25, 0.375, 0.9375)]  # the laser outside
SLIGHT = [(0.0078125, 0, 1), (0, 0.0078125, 1), (-0.00390625, -0.0078125, 1)]
A, B = (-0.125, 0, 1), (0.25, 0, 0.96875)
DARK1 = [(0.5, 0.25, 0.75), (0.75, -0.5, 0.25), (1, 0.125, -0.375)]
DARK2 = [(0.25, 0.25, 0.875), (0.875, -0.25, -0.125), (1, 0.25, -0.5)]
CASES = [("slopes", PEAK, s, m) for s, m in ((0.2, 0.5), (0.05, 0), (1e-3, 30), (1e-6, 1e4), (1e3, 3))]
CASES += [("slopes", FLANK, s, m) for s, m in ((0.2, 0.5), (0.05, 2), (0.01, 300))]
CASES += [("slopes", SLIGHT, s, m) for s, m in ((0.2, 0.5), (0.005, 100))]
CASES += [("strip", (A, A, B), s, m) for s, m in ((0.2, 0.5), (0.05, 2), (1e-4, 1e4))]
CASES += [("lit", n, s, m) for n in (DARK1, DARK2) for s, m in ((0.3, 0.5), (0.5, 3))]


def main():
    print("/* Made by cubature.py (Gauss-Legendre, 1e-12): normals at three corners, s, m, the integrals over")
    print("   an area of 1 of the glint and of the diffuse term of f_r cos for A = B = 1. */")
    for kind, given, s, m in CASES:
        normals = given
        found = []
        for HALVE[0] in (1, 2):
            if kind == "strip":
                found.append(over_strip(normals[0], normals[2], s, m))
            else:
                found.append((over_slopes if kind == "slopes" else over_lit)(normals, s, m))
        value = found[1]
        assert all(abs(found[0][k] - value[k]) <= 1e-12 * value[k] for k in range(2)), found
        rows = ", ".join("{%s}" % ", ".join(repr(x) for x in n) for n in given)
        print("{{%s}, %r, %r,\n %s, %s}," % (rows, s, m, *(repr(v) for v in value)), flush=True)


if __name__ == "__main__":
    main()
