#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The paper's method as graphics hardware runs it, written a second time -> emulate.inc.

Floats are numpy's float32 and Python's double, each operation by the processor itself; coverage is
decided for every pixel and every facet, in whole numbers. include/lrcs/emulate.h states what is
computed. Coordinates are multiples of 2^-20 below 1, the largest at least 1/2.
usage: emulate.py > emulate.inc (needs numpy)
"""
import math
import random
from fractions import Fraction as F

import numpy as np

SUB = 256


def single(x):
    return np.float32(x)


def double(x):
    return float(x)


def rotation(rng):
    """Rows of a rotation, orthonormal to rounding, from a random quaternion."""
    q = [rng.gauss(0, 1) for _ in range(4)]
    n = math.sqrt(sum(x * x for x in q))
    w, x, y, z = (c / n for c in q)
    return [[1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)]]


def frame(R):
    """The axes that a run makes of R (view/frame.h): dots and crosses rounded once."""
    def dot(a, b):
        return float(sum(F(x) * F(y) for x, y in zip(a, b)))

    def unit(v):
        length = math.sqrt(dot(v, v))
        return [x / length for x in v]

    a, d = R[0], R[2]
    t = dot(a, d) / dot(d, d)
    first = unit([a[k] - t * d[k] for k in range(3)])
    cross = [float(F(d[i]) * F(first[j]) - F(d[j]) * F(first[i])) for i, j in ((1, 2), (2, 0), (0, 1))]
    return [first, unit(cross), unit(d)]


def unit_normal(a, b, c):
    p, q = ([F(u) - F(v) for u, v in zip(e, a)] for e in (b, c))
    n = [float(p[i] * q[j] - p[j] * q[i]) for i, j in ((1, 2), (2, 0), (0, 1))]
    length = math.sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2])
    return [x / length for x in n]


class Window:
    """The host's part, in double: the scene's box, its window, the depth range."""

    def __init__(self, scene, R):
        used = [scene.vertex[i] for f in scene.facet for i in f]
        low = [min(v[k] for v in used) for k in range(3)]
        high = [max(v[k] for v in used) for k in range(3)]
        self.centre = [0.5 * (low[k] + high[k]) for k in range(3)]
        radius = max(max(high[k] - self.centre[k], self.centre[k] - low[k]) for k in range(3))
        self.unit = 2.0 ** -(math.frexp(radius)[1] - 1)
        seen = []
        for v in used:
            p = [v[k] - self.centre[k] for k in range(3)]
            seen.append([R[k][0] * p[0] + R[k][1] * p[1] + R[k][2] * p[2] for k in range(3)])
        low = [min(s[k] for s in seen) for k in range(3)]
        high = [max(s[k] for s in seen) for k in range(3)]
        self.side = max(high[0] - low[0], high[1] - low[1])
        corner = [0.5 * (low[k] + high[k]) - 0.5 * self.side for k in range(2)]
        self.middle = [corner[0] + 0.5 * self.side, corner[1] + 0.5 * self.side,
                       0.5 * (low[2] + high[2])]
        self.half = [0.5 * self.side, 0.5 * self.side,
                     -(0.5 * (high[2] - low[2]) + 0.0078125 * self.side)]


def corners(scene, R, window, size, fit):
    """(x, y in sub-pixels, depth) of every vertex."""
    turn = [[fit(R[k][j] / (window.half[k] * window.unit)) for j in range(3)] for k in range(3)]
    move = [fit(-window.middle[k] / window.half[k]) for k in range(3)]
    out = []
    for v in scene.vertex:
        p = [fit((v[k] - window.centre[k]) * window.unit) for k in range(3)]
        clip = [((turn[k][0] * p[0] + turn[k][1] * p[1]) + turn[k][2] * p[2]) + move[k]
                for k in range(3)]
        scale = fit(0.5 * size)
        xy = [clip[k] * scale + scale for k in range(2)]
        snapped = [math.floor(F(float(x)) * SUB + F(1, 2)) for x in xy]
        out.append((snapped[0], snapped[1], clip[2] * fit(0.5) + fit(0.5)))
    return out


def inside(a, b, p):
    """Twice the signed area, and whether p counts: the top-left rule, y up."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    e = dx * (p[1] - a[1]) - dy * (p[0] - a[0])
    return e, e > 0 or (e == 0 and (dy < 0 or (dy == 0 and dx < 0)))


def kept(depth, bits, fit):
    depth = min(max(depth, fit(0)), fit(1))
    if bits < 32:
        return math.floor(float(depth) * (2.0 ** bits - 1) + 0.5)
    return float(np.float32(depth)) if bits == 32 else float(depth)


def item_buffer(scene, at, size, bits, fit):
    owner = [None] * (size * size)
    clear = 2 ** bits - 1 if bits < 32 else 1.0
    depth = [clear] * (size * size)
    for f, (i, j, k) in enumerate(scene.facet):
        a, b, c = at[i], at[j], at[k]
        twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
        if twice == 0:
            continue
        if twice < 0:
            b, c, twice = c, b, -twice
        inverse = fit(1) / fit(twice)
        for y in range(size):
            for x in range(size):
                p = (SUB * x + SUB // 2, SUB * y + SUB // 2)
                e = [inside(b, c, p), inside(c, a, p), inside(a, b, p)]
                if not all(covered for _, covered in e):
                    continue
                w1, w2 = fit(e[1][0]) * inverse, fit(e[2][0]) * inverse
                z = a[2] + (w1 * (b[2] - a[2]) + w2 * (c[2] - a[2]))
                z = kept(z, bits, fit)
                if z < depth[y * size + x]:
                    depth[y * size + x], owner[y * size + x] = z, f
    return owner


def shades(scene, R, fit):
    """(glint, diffuse) of f_r cos for every facet."""
    out = []
    for f, (i, j, k) in enumerate(scene.facet):
        A, B, s, m = (fit(v) for v in scene.brdf[f][:4])
        n = [fit(v) for v in unit_normal(scene.vertex[i], scene.vertex[j], scene.vertex[k])]
        v = [(fit(R[r][0]) * n[0] + fit(R[r][1]) * n[1]) + fit(R[r][2]) * n[2] for r in range(3)]
        across2 = v[0] * v[0] + v[1] * v[1]
        c = v[2] / fit(math.sqrt(float(across2 + v[2] * v[2])))
        if not (c > 0 or (c < 0 and scene.brdf[f][4])):
            out.append((fit(0), fit(0)))
            continue
        c = abs(c)
        across = fit(math.sqrt(float(across2)))
        x = across / (abs(v[2]) * s) if across > 0 else fit(0)
        e = fit(math.exp(float(-(x * x))))
        c2 = c * c
        c5 = (c2 * c2) * c
        weight = fit(math.pow(float(c), float(m))) * c
        out.append((A * (e / c5) if A > 0 and e > 0 else fit(0), B * weight if B > 0 else fit(0)))
    return out


def pairwise(values, fit):
    """Neighbours, then neighbours of those; what is left over joins from the short end."""
    left = []  # odd ones out, the shortest run first
    while len(values) > 1:
        if len(values) % 2:
            left.append(values[-1])
        values = [values[i] + values[i + 1] for i in range(0, len(values) - 1, 2)]
    total = fit(0)
    for v in left + values:
        total = v + total
    return total


def emulate(scene, R, size, precision, bits):
    fit = single if precision else double
    window = Window(scene, R)
    owner = item_buffer(scene, corners(scene, R, window, size, fit), size, bits, fit)
    shade = shades(scene, R, fit)
    terms = []
    running = 0.0
    pixel = window.side / size
    for t in range(2):
        pixels = [shade[o][t] if o is not None else fit(0) for o in owner]
        terms.append((12.566370614359172954 * float(pairwise(pixels, fit))) * pixel * pixel)
        total = fit(0)
        for x in pixels:
            total = total + x
        running += (12.566370614359172954 * float(total)) * pixel * pixel
    terms.append(running)
    text = "".join("." if o is None else chr(ord("A") + o) for o in owner)
    return text, terms


class Scene:
    """Random triangles, of which some lie a little behind others, and a second skin of one."""

    def __init__(self, rng, count):
        def coordinate():
            return rng.randrange(-(2 ** 20) + 1, 2 ** 20) / 2 ** 20
        self.vertex, self.facet, self.brdf = [[0.75, 0.0, 0.0]], [], []
        while len(self.facet) < count:
            first = len(self.vertex)
            self.vertex += [[coordinate() for _ in range(3)] for _ in range(3)]
            self.facet.append((first, first + 1, first + 2))
        behind = [[x - d for x, d in zip(v, (0, 0, 2.0 ** -17))] for v in self.vertex[1:4]]
        self.vertex += behind
        self.facet.append((len(self.vertex) - 3, len(self.vertex) - 2, len(self.vertex) - 1))
        self.facet.append((1, 3, 2))
        self.facet.append((0, 1, 5))
        for _ in self.facet:
            self.brdf.append((rng.choice([0, 1, 3.7, 0.9]), rng.choice([0, 0.1, 0.25, 0.3]),
                              rng.choice([1e-3, 0.05, 0.2, 2.0]), rng.choice([0, 0.5, 3.3, 40]),
                              int(rng.random() < 0.7)))


def row(numbers):
    return "{" + ", ".join(repr(x) for x in numbers) + "}"


def main():
    rng = random.Random(20)
    print("/* Made by emulate.py with numpy %s; do not edit. */" % np.__version__)
    print("static const emulate_case emulate_cases[] = {")
    for case in range(12):
        scene, R, size = Scene(rng, 2 + case), rotation(rng), (7, 12, 16, 20)[case % 4]
        print("    {%d, %d, %d," % (len(scene.vertex), len(scene.facet), size))
        print("     {%s}," % ",\n      ".join(row(v) for v in scene.vertex))
        print("     {%s}," % ", ".join("{%d, %d, %d}" % f for f in scene.facet))
        print("     {%s}," % ",\n      ".join(row(b) for b in scene.brdf))
        print("     {%s}," % ",\n      ".join(row(r) for r in R))
        print("     {", end="")
        for precision, bits in ((0, 64), (0, 16), (1, 32), (1, 24), (1, 16)):
            text, terms = emulate(scene, frame(R), size, precision, bits)
            print("{%d, %d, %s, %s, %s,\n       \"%s\"},\n      " %
                  (precision, bits, *(x.hex() for x in terms), text), end="")
        print("}},")
    print("};")


main()
