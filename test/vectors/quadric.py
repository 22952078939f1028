#!/usr/bin/python3
# SPDX-License-Identifier: MIT
# The greatest distance of a triangle's points from a plane, cylinder, sphere or cone (one nappe),
# and the greatest angle between its normal and the surface's at the nearest points, by mpmath at 50
# digits. The distance is found by search over the triangle, not by the theorem that the engine
# uses: the least signed distance by nested golden sections (it is convex), the greatest at corners
# and at points of a grid; what is written is the distance at the point found, so it is exact for
# that point and never above the truth. Writes quadric.inc.
import random
from mpmath import mp, mpf, sqrt, acos, pi, matrix

mp.dps = 50
random.seed(16)
PLANE, CYLINDER, SPHERE, CONE = range(4)


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def exact(v):
    return [mpf(x) for x in v]


def cross(a, b):
    return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]


def unit_double(v):
    length = sqrt(dot(exact(v), exact(v)))
    return [float(mpf(x) / length) for x in v]


class Surface:
    def __init__(self, kind, point, axis, radius, slope):
        self.kind, self.point, self.axis, self.radius, self.slope = kind, point, axis, radius, slope
        self.c = exact(point)
        a = exact(axis)
        length = sqrt(dot(a, a)) if kind != SPHERE else mpf(1)
        self.a = [x / length for x in a]
        self.cos = 1 / sqrt(1 + mpf(slope) ** 2)
        self.sin = mpf(slope) * self.cos

    def parts(self, p):
        q = [x - y for x, y in zip(p, self.c)]
        if self.kind == SPHERE:
            return sqrt(dot(q, q)), mpf(0), q
        z = dot(q, self.a)
        r = [x - z * y for x, y in zip(q, self.a)]
        return sqrt(dot(r, r)), z, r

    def signed(self, p):
        rho, z, _ = self.parts(p)
        if self.kind == PLANE:
            return z
        if self.kind == CONE:
            return rho * self.cos - z * self.sin
        return rho - mpf(self.radius)

    def distance(self, p):
        rho, z, _ = self.parts(p)
        if self.kind == CONE and z * self.cos + rho * self.sin < 0:
            return sqrt(rho * rho + z * z)
        return abs(self.signed(p))

    def normal(self, p):
        rho, z, r = self.parts(p)
        if self.kind == PLANE:
            return self.a
        if self.kind == CONE:
            return [x / rho * self.cos - y * self.sin for x, y in zip(r, self.a)]
        return [x / rho for x in r]


def at(corner, u, v):
    return [a + u * (b - a) + v * (c - a) for a, b, c in zip(*corner)]


def least(f, low, high, steps=44):
    ratio = (sqrt(mpf(5)) - 1) / 2
    a, b = mpf(low), mpf(high)
    c, d = b - ratio * (b - a), a + ratio * (b - a)
    fc, fd = f(c), f(d)
    for _ in range(steps):
        if fc < fd:
            b, d, fd = d, c, fc
            c = b - ratio * (b - a)
            fc = f(c)
        else:
            a, c, fc = c, d, fd
            d = a + ratio * (b - a)
            fd = f(d)
    return (a + b) / 2


def truth(s, corner):
    def inner(u):
        return least(lambda v: s.signed(at(corner, u, v)), 0, 1 - u)
    u = least(lambda u: s.signed(at(corner, u, inner(u))), 0, 1)
    points = [at(corner, u, inner(u))]
    points += [at(corner, mpf(i) / 8, mpf(j) / 8) for i in range(9) for j in range(9 - i)]
    most = max(s.distance(p) for p in points)
    n = cross([x - y for x, y in zip(corner[1], corner[0])], [x - y for x, y in zip(corner[2], corner[0])])
    length = sqrt(dot(n, n))
    if length == 0:
        return most, mpf(-1)
    n = [x / length for x in n]
    angles = []
    for p in points:
        # the normal of a cone is not defined at its apex: points near it are left out
        if s.kind == PLANE or s.parts(p)[0] > 2 * most:
            angles.append(acos(max(-1, min(1, dot(n, s.normal(p))))))
    if not angles:
        return most, mpf(-1)
    if min(angles) > pi / 2:
        angles = [pi - x for x in angles]
    return most, max(angles)


def frame(axis):
    a = exact(axis)
    other = [mpf(1), mpf(0), mpf(0)] if abs(a[0]) < 0.6 else [mpf(0), mpf(1), mpf(0)]
    u = cross(a, other)
    length = sqrt(dot(u, u))
    u = [x / length for x in u]
    return u, cross(a, u), a


def case(kind):
    axis = unit_double([random.gauss(0, 1) for _ in range(3)])
    if random.random() < 0.2:
        axis = [0.0, 0.0, 1.0]
    radius = 10 ** random.uniform(-3, 3)
    far = random.choice([0.0, 1.0, 1e3, 1e6]) * radius
    point = [random.uniform(-far, far) for _ in range(3)]
    slope = 10 ** random.uniform(-2.5, 1.5)
    s = Surface(kind, point, axis, radius if kind in (CYLINDER, SPHERE) else 0.0,
                slope if kind == CONE else 0.0)
    u, v, a = frame(axis)
    noise = random.choice([0, 0, 1e-12, 1e-6, 1e-3, 0.05]) * radius
    step = random.choice([0.01, 0.1, 0.3, 0.6])
    base = random.uniform(0, 6)
    shape = random.choice(["plain", "plain", "plain", "sliver", "point", "line", "apex"])
    corners = []
    for k in range(3):
        phi = base + (step if k else 0) * (1 + (k == 2) * random.uniform(-0.5, 0.5))
        along = (random.uniform(-3, 3) if k == 1 else 0.3 * k)
        if shape == "sliver" and k == 2:
            phi, along = phi + 1e-9, along + 1e-9
        height = along * radius
        if kind == PLANE:
            local = (radius * random.uniform(-2, 2), radius * random.uniform(-2, 2), 0)
        elif kind == CYLINDER:
            local = (radius * mp.cos(phi), radius * mp.sin(phi), height)
        elif kind == SPHERE:
            theta = 1 + 0.3 * k * step
            local = (radius * mp.sin(theta) * mp.cos(phi), radius * mp.sin(theta) * mp.sin(phi),
                     radius * mp.cos(theta))
        else:
            z = radius * (1 + 0.4 * (k == 1))
            if shape == "apex" and k == 0:
                z = mpf(0)
            local = (z * s.slope * mp.cos(phi), z * s.slope * mp.sin(phi), z)
        x = [c + local[0] * i + local[1] * j + local[2] * l + mpf(random.uniform(-1, 1) * noise)
             for c, i, j, l in zip(s.c, u, v, a)]
        corners.append([float(t) for t in x])
    if shape == "point":
        corners[1] = corners[2] = corners[0]
    if shape == "line":
        corners[2] = corners[1]
    return s, corners


with open("quadric.inc", "w") as out:
    out.write("/* kind, point, axis, radius, slope, corners, distance, angle (-1: none): by quadric.py */\n")
    for i in range(240):
        s, corners = case(i % 4)
        most, angle = truth(s, [exact(c) for c in corners])
        low = [x if x <= 0 else x * (1 - mpf(2) ** -52) for x in (most, angle)]  # below the truth
        numbers = [s.point, s.axis] + corners
        text = ["{%s}" % ", ".join(float(x).hex() for x in v) for v in numbers]
        out.write("{%d, %s, %s, %s, %s, {{%s}, {%s}, {%s}}, %s, %s},\n" % (
            s.kind, text[0], text[1], float(s.radius).hex(), float(s.slope).hex(), text[2], text[3],
            text[4], float(low[0]).hex(), float(low[1]).hex()))
