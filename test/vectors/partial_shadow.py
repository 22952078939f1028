#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""sigma of true curved shapes that shadow one another in part, by the definition, for
test/host/test_partial_shadow.c.

Every wall is a quadric, every cap and plate a plane, each cut by planes or by a quadric. Rotated so
that w points to the laser, the silhouette of a quadric, a rim and the curve where a plane meets a
quadric are conics in the view plane (u, v). sigma / 4 pi is the integral of F(c) / c over u and v, c
being the cosine of incidence on the surface nearest the laser. On a scanline v = const the surfaces
change only at roots of quadratics; in v the order of these roots changes only where two conics meet (a
quartic, its roots at 50 digits) or one ends. Between these breaks the integrand is analytic, and
tanh-sinh quadrature, which tolerates the roots at a limb, is refined until it converges. Nothing is
tessellated, and no closed form is used. Each reference is computed twice, with scanlines in two
directions, which must agree: in doubles, as the table is made, to 1e-12 of itself; with 22 digits,
which takes minutes a scene, to 1e-15. Where both were run they differ by 1e-12 at most (a body of
revolution seen along its axis is the same in every direction): 1e-11 is claimed of the table.
Curved walls must not pass through one another; planes may pass through walls.

usage: partial_shadow.py > partial_shadow.inc
       partial_shadow.py digits [WORD]      the table, or the scenes that have WORD in their names, with 22
                                            digits, beside what doubles give
       partial_shadow.py check              closed forms against the quadrature
"""
import math
import multiprocessing
import sys

import mpmath
from mpmath import mp, mpf

mp.dps = 22


class Doubles:
    """The functions that the quadrature needs, in doubles."""
    real = float
    sqrt, exp, log, sinh, cosh, pi = math.sqrt, math.exp, math.log, math.sinh, math.cosh, math.pi
    accuracy, reach = 1e-13, 3.2


class Digits:
    """The same at 22 digits."""
    real = mpf
    sqrt, exp, log, sinh, cosh, pi = mp.sqrt, mp.exp, mp.log, mp.sinh, mp.cosh, +mp.pi
    accuracy, reach = mpf(10)**-16, 3.3


# --- shapes ---------------------------------------------------------------------------------------
# A quadric is (M, b, k): x^T M x + 2 b x + k, negative inside. A plane is (n, k): n x + k, and a
# point of a surface counts where all its plane cuts are positive and its quadric cut is negative.

def quadric(xx, yy, zz, z, one):
    return ([[xx, 0, 0], [0, yy, 0], [0, 0, zz]], [0, 0, z / 2], one)


def wall(shape):
    """The wall's quadric and its plane cuts, in the shape's frame."""
    kind, R, L = shape['kind'], shape.get('radius', 0), shape.get('length', 0)
    up, top = ([0, 0, 1], 0), ([0, 0, -1], L)
    if kind in ('sphere', 'dome'):
        return quadric(1, 1, 1, 0, -R * R), [up] if kind == 'dome' else []
    if kind == 'cylinder':
        return quadric(1, 1, 0, 0, -R * R), [up, top]
    if kind == 'paraboloid':  # r^2 = R^2 (1 - z/L)
        return quadric(1, 1, 0, R * R / L, -R * R), [up]
    end = shape.get('radius', 0) if kind == 'frustum' else 0
    base = shape['radius2'] if kind == 'frustum' else R
    t = (end - base) / L  # r = base + t z
    return quadric(1, 1, -t * t, -2 * base * t, -base * base), [up, top]


def surfaces(shape):
    """(surface, plane cuts, quadric cut): the surface a quadric, or a plane with its front up n."""
    kind = shape['kind']
    if kind in ('plate', 'box'):
        half = [x / 2 for x in shape['size']] + [0] * (kind == 'plate')
        sides = []
        for axis in range(3):
            for side in (1, -1):
                n = [side * (k == axis) for k in range(3)]
                sides.append((axis, (n, half[axis])))
        if kind == 'plate':
            return [(([0, 0, 1], 0), [(n, k) for a, (n, k) in sides if a < 2], None)]
        return [((n, -k), [(m, h) for b, (m, h) in sides if b != a], None) for a, (n, k) in sides]
    if kind == 'disc':
        return [(([0, 0, 1], 0), [], quadric(1, 1, 0, 0, -shape['radius']**2))]
    body, cuts = wall(shape)
    out = [(body, cuts, None)]
    if kind == 'sphere' or shape.get('wall_only'):
        return out
    out.append((([0, 0, -1], 0), [], body))
    if kind in ('cylinder', 'frustum'):
        out.append((([0, 0, 1], -shape['length']), [], body))
    return out


def place(shape, turn, origin, X):
    """From coordinates of the view to the shape's: x = T p + t, with rows T."""
    S = [X.real(s) for s in shape.get('scale', (1, 1, 1))]
    at = [X.real(s) - o for s, o in zip(shape['at'], origin)]
    flip = [1, -1, -1] if shape.get('turned') else [1, 1, 1]
    # body = at + flip (S x); body = turn p, the columns of turn being the axes of the view
    T = [[turn[i][j] * flip[i] / S[i] for j in range(3)] for i in range(3)]
    t = [-at[i] * flip[i] / S[i] for i in range(3)]
    return T, t


def tip_of(cone, X):
    up = X.real(cone['length']) * X.real(cone.get('scale', (1, 1, 1))[2])
    at = [X.real(x) for x in cone['at']]
    return [at[0], at[1], at[2] - up if cone.get('turned') else at[2] + up]


def view_of(surface, T, t):
    """A plane or a quadric in the coordinates of the view."""
    dot = lambda a, b: sum(x * y for x, y in zip(a, b))
    if len(surface) == 2:
        n, k = surface
        return [dot(n, [T[i][j] for i in range(3)]) for j in range(3)], dot(n, t) + k
    M, b, k = surface
    MT = [[dot(M[i], [T[l][j] for l in range(3)]) for j in range(3)] for i in range(3)]
    Mt = [dot(M[i], t) + b[i] for i in range(3)]
    return ([[dot([T[l][i] for l in range(3)], [MT[l][j] for l in range(3)]) for j in range(3)]
             for i in range(3)],
            [dot([T[l][i] for l in range(3)], Mt) for i in range(3)],
            dot(t, [dot(M[i], t) for i in range(3)]) + 2 * dot(b, t) + k)


# --- conics of the view plane: a u^2 + 2 h u v + b v^2 + 2 g u + 2 f v + k ----------------------------

def silhouette(q):
    M, b, k = q
    a = M[2][2]
    P, Q, R = M[0][2], M[1][2], b[2]  # beta = P u + Q v + R; beta^2 - a gamma
    if a == 0:
        return (0, 0, 0, P / 2, Q / 2, R)
    return (P * P - a * M[0][0], P * Q - a * M[0][1], Q * Q - a * M[1][1], P * R - a * b[0],
            Q * R - a * b[1], R * R - a * k)


def section(plane, q):
    """Where a plane cuts a quadric, seen along w: n_w^2 times the quadric at w = -(n u + m v + k)/n_w."""
    (n0, n1, n2), d = plane
    M, b, k = q
    if n2 == 0:
        return None
    e = (-n0 / n2, -n1 / n2, -d / n2)
    a = M[2][2]
    return (M[0][0] + 2 * M[0][2] * e[0] + a * e[0] * e[0],
            M[0][1] + M[0][2] * e[1] + M[1][2] * e[0] + a * e[0] * e[1],
            M[1][1] + 2 * M[1][2] * e[1] + a * e[1] * e[1],
            b[0] + M[0][2] * e[2] + b[2] * e[0] + a * e[0] * e[2],
            b[1] + M[1][2] * e[2] + b[2] * e[1] + a * e[1] * e[2],
            k + 2 * b[2] * e[2] + a * e[2] * e[2])


def line(plane, other):
    """Where two planes meet, seen along w."""
    (n0, n1, n2), d = plane
    (m0, m1, m2), e = other
    return (0, 0, 0, (n0 * m2 - m0 * n2) / 2, (n1 * m2 - m1 * n2) / 2, d * m2 - e * n2)


def cleaned(conic, size):
    """Coefficients that are rounding errors are 0; None: nothing is left. Lengths count in `size`."""
    if conic is None:
        return None
    scaled = [conic[0] * size**2, conic[1] * size**2, conic[2] * size**2, conic[3] * size,
              conic[4] * size, conic[5]]
    top = max(abs(x) for x in scaled)
    if top < size**2 * TINY[0]:
        return None
    return tuple(x / top if abs(s) > top * TINY[0] else 0 * x for x, s in zip(conic, scaled))


TINY = [1e-14]


def roots_in_u(conic, v, X):
    a, h, b, g, f, k = conic
    B, C = h * v + g, (b * v + 2 * f) * v + k
    if a == 0:
        return [-C / (2 * B)] if B != 0 else []
    D = B * B - a * C
    if D <= 0:
        return []
    q = -(B + (X.sqrt(D) if B > 0 else -X.sqrt(D)))
    low, high = sorted((q / a, C / q if q != 0 else q / a))
    return [low, high]


def times(p, q):
    out = [mpf(0)] * (len(p) + len(q) - 1)
    for i, x in enumerate(p):
        for j, y in enumerate(q):
            out[i + j] += x * y
    return out


def minus(p, q):
    size = max(len(p), len(q))
    return [(p[i] if i < len(p) else 0) - (q[i] if i < len(q) else 0) for i in range(size)]


def real_roots(poly):
    """Real parts of the roots of a polynomial, lowest coefficient first, that are nearly real."""
    top = max(abs(x) for x in poly)
    if top == 0:
        return []
    while len(poly) > 1 and abs(poly[-1]) < top * mpf(10)**-14 * TINY[1]:
        poly = poly[:-1]
    if len(poly) < 2:
        return []
    try:
        found = mp.polyroots(poly[::-1], maxsteps=400, extraprec=300)
    except mpmath.libmp.NoConvergence:
        found = mp.polyroots(poly[::-1], maxsteps=4000, extraprec=900, error=True)[0]
    return [x.real for x in found if abs(x.imag) < mpf(10)**-5 * (1 + abs(x))]


def ends_in_v(conics):
    """Every v where a conic begins or ends, or two of them meet."""
    out = []
    with mp.workdps(50):
        in_u = []
        for a, h, b, g, f, k in [[mpf(x) for x in c] for c in conics]:
            in_u.append(([a], [2 * g, 2 * h], [k, 2 * f, b]))
        for i, (a, b, c) in enumerate(in_u):
            out += real_roots(minus(times(b, b), [4 * x for x in times(a, c)]))
            for A, B, C in in_u[:i]:
                if a[0] == 0 and A[0] == 0:
                    out += real_roots(minus(times(b, C), times(B, c)))
                    continue
                ac = minus(times(a, C), times(A, c))
                ab = minus(times(a, B), times(A, b))
                bc = minus(times(b, C), times(B, c))
                out += real_roots(minus(times(ac, ac), times(ab, bc)))
    return out


# --- quadrature -----------------------------------------------------------------------------------

def make_rule(X):
    """tanh-sinh: levels of (distance from the nearer end in units of the interval, weight, side)."""
    levels = []
    for level in range(6):
        h = X.real(1) / 2**level
        nodes = []
        j = 0 if level == 0 else 1
        while j * h <= X.reach:
            t = j * h
            q = X.exp(-X.pi * X.sinh(t))
            weight = X.pi * X.cosh(t) * q / (1 + q)**2  # of d(x)/dt for x in 0 .. 1
            nodes.append((q / (1 + q), weight, j == 0))
            j += 1 if level == 0 else 2
        levels.append((h, nodes))
    return levels


def integrate(f, a, b, scale, X, depth=0):
    """Of f from a to b, to X.accuracy times the larger of itself and scale."""
    width = b - a
    total = 0 * width
    sums = []
    for h, nodes in X.rule:
        for d, weight, middle in nodes:
            x = d * width
            total += weight * f(a + x)
            if not middle:
                total += weight * f(b - x)
        sums.append(total * h * width)
        if len(sums) < 4:
            continue
        goal = X.accuracy * max(abs(sums[-1]), scale)
        last, before = abs(sums[-1] - sums[-2]), abs(sums[-2] - sums[-3])
        size = max(abs(sums[-1]), scale)
        if last <= goal or size == 0:
            return sums[-1]
        if last < before and before < size * 1e-2:  # the digits nearly double each level
            x, y = X.log(last / size), X.log(before / size)
            if X.exp(max(x * x / y, x * 7 / 4)) * 100 <= X.accuracy:
                return sums[-1]
    if depth > 24 and last <= 100 * goal:
        return sums[-1]
    if depth > 24:
        raise ArithmeticError('no convergence in %s .. %s' % (a, b))
    c = (a + b) / 2
    return integrate(f, a, c, scale, X, depth + 1) + integrate(f, c, b, scale, X, depth + 1)


# --- the scene in the view ------------------------------------------------------------------------

class View:
    def __init__(self, parts, direction, brdf, two_sided, roll, X):
        self.X, self.two_sided = X, two_sided
        self.A, self.B, self.s, self.m = [X.real(x) for x in brdf]
        axes = frame(direction, roll, X)
        # near its tip a cone keeps its digits if the tip is the origin
        cone = next((p for p in parts if p['kind'] == 'cone'), None)
        origin = tip_of(cone, X) if cone else [X.real(0)] * 3
        self.surface = []
        for shape in parts:
            real = {k: X.real(v) if isinstance(v, (int, float)) and not isinstance(v, bool) else v
                    for k, v in shape.items()}
            if 'size' in shape:
                real['size'] = [X.real(x) for x in shape['size']]
            T, t = place(real, axes, origin, X)
            for body, cuts, inner in surfaces(real):
                body = view_of(body, T, t)
                if shape is cone and len(body) == 3:
                    body = body[0], [X.real(0)] * 3, X.real(0)
                if len(body) == 2:  # exactly edge-on but for rounding
                    n, k = body
                    if abs(n[2]) < 1e-14 * (abs(n[0]) + abs(n[1])):
                        continue
                self.surface.append((body, [view_of(c, T, t) for c in cuts],
                                     view_of(inner, T, t) if inner else None))
        self.prepare(max(sum(abs(float(x)) for x in p.get('at', (0, 0, 0))) +
                         max([float(p.get(k, 0)) for k in ('radius', 'radius2', 'length')] +
                             [float(x) for x in p.get('size', ())]) for p in parts), cone)

    def prepare(self, size, tip):
        """The conics at which the nearest surface may change."""
        self.size = size
        one = self.X.real(1)
        conics = []
        planes = [b for b, _, _ in self.surface if len(b) == 2]
        for i, (body, cuts, inner) in enumerate(self.surface):
            if len(body) == 2:
                conics += [line(body, c) for c in cuts]
                conics += [section(body, inner)] if inner else []
                conics += [line(body, p) for p in planes if p is not body]
            else:
                a = body[0][2][2]
                big = max(abs(x) for row in body[0] for x in row)
                if abs(a) < big * 1e-14:  # the line of sight along a generator or an axis
                    body[0][2][2] = a = 0 * a
                for row, col in ((0, 2), (1, 2)):
                    if abs(body[0][row][col]) < big * 1e-14:
                        body[0][row][col] = body[0][col][row] = 0 * a
                conics.append(silhouette(body))
                conics += [self.cut(c, body) for c in cuts]
                conics += [section(p, body) for p in planes]
        # scanlines near the tip of a cone are also divided beside it: u = 0
        self.conic = [tuple(one / 2 if i == 3 else 0 * one for i in range(6))] if tip else []
        self.tip = 0 if tip else -1
        for c in conics:
            c = cleaned(c, size)
            if c is not None and any(c[:5]) and not any(same(c, d, size) for d in self.conic):
                self.conic.append(c)

    def cut(self, plane, body):
        (n0, n1, n2), k = plane
        if abs(n2) < 1e-14 * (abs(n0) + abs(n1)):
            return (0, 0, 0, n0 / 2, n1 / 2, k)
        return section(plane, body)

    def hit(self, u, v):
        """The surface nearest the laser: its number, and F(c) / c there."""
        best, number = None, -1
        for i, (body, cuts, inner) in enumerate(self.surface):
            for w in self.depths(body, u, v):
                if best is not None and w <= best:
                    continue
                if all(n[0] * u + n[1] * v + n[2] * w + k > 0 for n, k in cuts) and (
                        inner is None or value(inner, u, v, w) < 0):
                    best, number = w, i
        return number, best

    def depths(self, body, u, v):
        if len(body) == 2:
            n, k = body
            return [-(n[0] * u + n[1] * v + k) / n[2]]
        a, beta, gamma = coefficients(body, u, v)
        if a == 0:
            return [-gamma / (2 * beta)] if beta != 0 else []
        D = beta * beta - a * gamma
        if D <= 0:
            return []
        q = -(beta + (self.X.sqrt(D) if beta > 0 else -self.X.sqrt(D)))
        return [q / a, gamma / q] if q != 0 else []

    def upper(self, body, u, v, w):
        """Whether w is the greater of the two depths of a quadric."""
        return w >= max(self.depths(body, u, v))

    def reflect(self, number, u, v, branch):
        """F(c) / c at the greater (branch 1) or smaller depth of a quadric."""
        body = self.surface[number][0]
        X = self.X
        if len(body) == 2:
            gu, gv, gw = body[0]
        else:
            a, beta, gamma = coefficients(body, u, v)
            if a == 0:
                gw, w = beta, -gamma / (2 * beta)
            else:
                D = beta * beta - a * gamma
                root = X.sqrt(D) if D > 0 else 0 * D
                if (a > 0) != (branch == 1):
                    root = -root
                gw = root
                if D > 0:
                    q = -(beta + X.sqrt(D)) if beta > 0 else -(beta - X.sqrt(D))
                    one, two = q / a, (gamma / q if q != 0 else q / a)
                    w = max(one, two) if branch == 1 else min(one, two)
                else:
                    w = -beta / a
            M, b, _ = body
            gu = M[0][0] * u + M[0][1] * v + M[0][2] * w + b[0]
            gv = M[0][1] * u + M[1][1] * v + M[1][2] * w + b[1]
        if gw < 0 and not self.two_sided:
            return 0 * u
        if gw == 0:
            return 0 * u
        t = (gu * gu + gv * gv) / (gw * gw)
        c = 1 / X.sqrt(1 + t)
        out = 0 * u
        if self.B:
            out += self.B * (c**(self.m + 1) if self.m else c)
        power = t / (self.s * self.s)
        if self.A and power < 700:
            out += self.A * X.exp(-power) * (1 + t)**2 / c
        return out

    def scanline(self, v):
        """Pieces of v = const in which one surface is nearest: (surface, branch, from, to)."""
        breaks = []
        for j, c in enumerate(self.conic):
            for i, u in enumerate(roots_in_u(c, v, self.X)):
                breaks.append((u, 2 * j + i))
        breaks.sort()
        out = []
        for (a, i), (b, j) in zip(breaks, breaks[1:]):
            if not a < b:
                continue
            u = (a + b) / 2
            number, w = self.hit(u, v)
            if number < 0:
                continue
            body = self.surface[number][0]
            branch = 1 if len(body) == 2 or self.upper(body, u, v, w) else 0
            if out and out[-1][:2] == (number, branch) and out[-1][3] == a and i // 2 != self.tip:
                out[-1] = out[-1][:3] + (b, out[-1][4], j)
            else:
                out.append((number, branch, a, b, i, j))
        return out

    def inner(self, v, signature):
        """The integral over one scanline between breaks known by their conics."""
        total = 0 * v
        for number, branch, i, j in signature:
            ends = []
            for label in (i, j):
                u = roots_in_u(self.conic[label // 2], v, self.X)
                if not u:
                    a, h, b, g, f, k = self.conic[label // 2]  # of an end of the conic
                    u = [-(h * v + g) / a]
                ends.append(u[min(label % 2, len(u) - 1)])
            low, high = ends
            if not low < high:
                continue
            if len(self.surface[number][0]) == 2:
                total += (high - low) * self.flat[number]
            else:
                total += integrate(lambda u: self.reflect(number, u, v, branch), low, high,
                                   self.goal, self.X)
        return total

    def sigma(self):
        X = self.X
        zero = X.real(0)
        self.flat = [self.reflect(i, zero, zero, 1) if len(s[0]) == 2 else None
                     for i, s in enumerate(self.surface)]
        ends = sorted(set(X.real(v) for v in ends_in_v(self.conic)))
        ends = [v for i, v in enumerate(ends) if i == 0 or v - ends[i - 1] > self.size * TINY[0]]
        pieces = []
        for a, b in zip(ends, ends[1:]):
            sign = tuple((n, r, i, j) for n, r, _, _, i, j in self.scanline((a + b) / 2))
            if pieces and pieces[-1][2] == sign:
                pieces[-1] = (pieces[-1][0], b, sign)
            else:
                pieces.append((a, b, sign))
        pieces = [p for p in pieces if p[2]]
        self.goal = zero
        rough = sum((b - a) * self.rough((a + b) / 2, sign) for a, b, sign in pieces)
        self.goal = rough / self.size / 16
        return 4 * X.pi * sum((integrate(lambda v: self.inner(v, sign), a, b, rough / 16, X)
                               for a, b, sign in pieces), zero)

    def rough(self, v, sign):
        """Diffuse and glint terms at the middles: only the size of sigma matters."""
        total = 0 * v
        for n, r, i, j in sign:
            ends = [roots_in_u(self.conic[x // 2], v, self.X) for x in (i, j)]
            low, high = [e[min(x % 2, len(e) - 1)] for e, x in zip(ends, (i, j))]
            total += (high - low) * self.reflect(n, (low + high) / 2, v, r)
        return total


def same(c, d, size):
    weight = (size**2, size**2, size**2, size, size, 1)
    top = max(range(6), key=lambda i: abs(c[i]) * weight[i])
    if d[top] == 0:
        return False
    r = c[top] / d[top]
    return all(abs(x - r * y) * w <= abs(c[top]) * weight[top] * TINY[0] * 10
               for x, y, w in zip(c, d, weight))


def coefficients(body, u, v):
    M, b, k = body
    beta = M[0][2] * u + M[1][2] * v + b[2]
    gamma = (M[0][0] * u * u + 2 * M[0][1] * u * v + M[1][1] * v * v + 2 * b[0] * u +
             2 * b[1] * v + k)
    return M[2][2], beta, gamma


def value(body, u, v, w):
    a, beta, gamma = coefficients(body, u, v)
    return a * w * w + 2 * beta * w + gamma


def frame(direction, roll, X):
    """Columns: two axes of the view plane, turned by roll (its tangent of the half), and s_hat."""
    d = [X.real(x) for x in direction]
    length = X.sqrt(sum(x * x for x in d))
    d = [x / length for x in d]
    least = min(range(3), key=lambda k: abs(d[k]))
    a = [(k == least) - d[least] * d[k] for k in range(3)]
    length = X.sqrt(sum(x * x for x in a))
    a = [x / length for x in a]
    b = [d[1] * a[2] - d[2] * a[1], d[2] * a[0] - d[0] * a[2], d[0] * a[1] - d[1] * a[0]]
    t = X.real(roll)
    c, s = (1 - t * t) / (1 + t * t), 2 * t / (1 + t * t)
    return [[c * a[k] + s * b[k], c * b[k] - s * a[k], d[k]] for k in range(3)]


for X in (Doubles, Digits):
    X.rule = make_rule(X)


def sigma(scene, X, roll=0.171875):
    TINY[:] = [1e-13, 1] if X is Doubles else [mpf(10)**-17, mpf(10)**-3]
    parts, direction, brdf, two_sided = scene
    return View(parts, direction, brdf, two_sided, roll, X).sigma()


# --- the table ------------------------------------------------------------------------------------

GLOSSY, NARROW, DIFFUSE = (1, 0.25, 0.1875, 0), (1, 0.25, 0.02, 0), (0, 0.25, 1, 1)
REAL = (0.5, 0.25, 0.25, 0.5)  # m is no integer


def part(kind, at=(0, 0, 0), **more):
    return dict(more, kind=kind, at=at)


def ball(radius, *at, **more):
    return part('sphere', at, radius=radius, **more)


def plate(x, y, *at):
    return part('plate', at or (0, 0, 0), size=(x, y))


def box(x, y, z, *at):
    return part('box', at, size=(x, y, z))


def dish(kind='paraboloid', **more):
    """Open above, its rim in z = 0."""
    size = {'paraboloid': dict(radius=1, length=0.5), 'dome': dict(radius=1),
            'cone': dict(radius=1, length=0.5)}[kind]
    return part(kind, turned=True, wall_only=True, **size, **more)


def table():
    """(name, parts, direction, brdf, two-sided). Every number is a double with few bits."""
    post = part('cylinder', (0.75, 0, 0.5), radius=0.25, length=1)
    tube = part('cylinder', radius=0.5, length=1, wall_only=True)
    cone = part('cone', (0.5, 0, 0), radius=0.25, length=1)
    tip = part('cone', (0.5, 0, 1), radius=0.375, length=1, turned=True)
    feed, low = ball(0.125, 0, 0, 0), ball(0.25, 0.25, 0, 0.125)
    return [
        ('shadow of a sphere, half of it beside the plate', [ball(0.5, 0.75, 0.25, 1), plate(2, 2)],
         (-0.25, 0, 1), GLOSSY, 0),
        ('shadow of a sphere, tangent to the edge of the plate', [ball(0.5, 0.5, 0, 1), plate(2, 2)],
         (0, 0, 1), GLOSSY, 0),
        ('sphere resting on a plate, its shadow across the edge', [ball(0.5, 0.5, 0, 0.5), plate(2, 2)],
         (-0.75, 0.25, 1), REAL, 0),
        ('plate whose edge hides half of the glint of a sphere', [ball(0.5, 0, 0, 0), plate(2, 2, 1, 0, 1)],
         (0, 0, 1), NARROW, 0),
        ('plate whose corner hides part of a sphere', [ball(0.5, 0, 0, 0), plate(2, 2, 1.125, 0.875, 1)],
         (0.25, 0.125, 1), REAL, 0),
        ('sphere before a sphere', [ball(0.5, 0, 0, 0), ball(0.5, 0.5, 0.25, 1.5)], (0.125, 0, 1),
         GLOSSY, 0),
        ('sphere before the glint of a sphere', [ball(0.5, 0, 0, 0), ball(0.25, 0.25, 0, 1)],
         (0, 0, 1), NARROW, 0),
        ('spheres whose outlines are tangent from inside', [ball(0.5, 0, 0, 0), ball(0.25, 0.25, 0, 2)],
         (0, 0, 1), DIFFUSE, 0),
        ('spheres that touch', [ball(0.5, 0, 0, 0), ball(0.25, 0, 0, 0.75)], (1, 0.5, 0.5), GLOSSY, 0),
        ('ellipsoid over the edge of a plate', [ball(0.5, 0.75, 0, 1, scale=(1, 2, 0.5)), plate(2, 2)],
         (-0.25, 0.25, 1), GLOSSY, 0),
        ('cylinder over the edge of a plate', [post, plate(2, 2)], (-0.5, 0.25, 1), GLOSSY, 0),
        ('shadow of a standing cylinder as wide as the plate',
         [part('cylinder', radius=0.25, length=1), plate(4, 0.5)], (-1, 0, 1), GLOSSY, 0),
        ('box whose edge hides half of the glint of a cylinder',
         [part('cylinder', radius=0.5, length=1), box(0.5, 1, 0.5, 1.5, 0.5, 0.5)], (1, 0, 0), NARROW, 0),
        ('plate before a cylinder', [post, plate(1, 1, 1, 0, 1.75)], (0.5, 0.125, 1), DIFFUSE, 0),
        ('inside of a tube', [tube], (0.5, 0.25, 1), GLOSSY, 1),
        ('sphere in a tube', [tube, ball(0.25, 0.125, 0, 0.75)], (0.25, 0.125, 1), DIFFUSE, 1),
        ('elliptic cylinder before a plate',
         [dict(post, scale=(1, 2, 0.5)), plate(2, 2)], (-0.5, 0.25, 1), GLOSSY, 0),
        ('cone on its tip, its shadow across the edge', [tip, plate(2, 2)], (-0.75, 0.25, 1), GLOSSY, 0),
        ('standing cone, its shadow across the edge', [cone, plate(2, 2)], (-1, 0.25, 0.5), GLOSSY, 0),
        ('shadow of a standing cone that ends on the edge', [cone, plate(2, 2)], (-0.5, 0, 1), DIFFUSE, 0),
        ('box before the tip of a cone', [cone, box(0.5, 0.25, 0.25, 0.75, 0.125, 1.5)],
         (0.25, 0.125, 1), GLOSSY, 0),
        ('line of sight along a wall of a cone, beside a sphere',
         [part('cone', radius=0.5, length=0.5), ball(0.25, 0, 0.25, 1)], (1, 0, 1), GLOSSY, 0),
        ('frustum over a disc', [part('frustum', (0.25, 0, 0.5), radius=0.5, radius2=0.25, length=0.5),
                                 part('disc', radius=0.5)], (-0.5, 0.25, 1), GLOSSY, 0),
        ('dish and feed on the axis', [dish(), feed], (0, 0, 1), GLOSSY, 1),
        ('dish and feed, a little off the axis', [dish(), feed], (0.015625, 0, 1), GLOSSY, 1),
        ('dish and feed, oblique', [dish(), feed], (0.5, 0.25, 1), GLOSSY, 1),
        ('dish and feed, the glint of the dish in the feed\'s shadow', [dish(), feed],
         (0.03125, 0.015625, 1), NARROW, 1),
        ('dish whose rim hides most of its inside', [dish(), low], (1, 0.25, 0.25), REAL, 1),
        ('dish from behind, part of the feed beyond its rim', [dish(), ball(0.25, 0.875, 0, 0.25)],
         (0.5, 0.25, -1), GLOSSY, 1),
        ('dish and cylindrical feed', [dish(), part('cylinder', (0, 0, -0.125), radius=0.125, length=0.375)],
         (0.5, 0.25, 1), GLOSSY, 1),
        ('dish and cylindrical feed on the axis',
         [dish(), part('cylinder', (0, 0, -0.125), radius=0.125, length=0.375)], (0, 0, 1), DIFFUSE, 1),
        ('dish and box as feed', [dish(), box(0.25, 0.25, 0.25, 0, 0, 0)], (0.375, 0.25, 1), GLOSSY, 1),
        ('round bowl and feed', [dish('dome'), feed], (0.5, 0.25, 1), GLOSSY, 1),
        ('round bowl and feed on the axis', [dish('dome'), feed], (0, 0, 1), GLOSSY, 1),
        ('elliptic dish and feed', [dish(scale=(1, 0.5, 1)), feed], (0.5, 0.25, 1), DIFFUSE, 1),
        ('plate before half of a paraboloid',
         [part('paraboloid', radius=0.5, length=0.5), plate(2, 2, 1, 0, 1)], (0, 0, 1), GLOSSY, 0),
        ('ellipsoid alone', [ball(1, 0, 0, 0, scale=(1, 2, 0.5))], (0.5, 0.25, 0.375), GLOSSY, 0),
        ('long ellipsoid alone, along its axis', [ball(1, 0, 0, 0, scale=(1, 1, 4))], (0, 0, 1), NARROW, 0),
        ('long ellipsoid alone, from its side', [ball(1, 0, 0, 0, scale=(1, 1, 4))], (1, 0.125, 0), REAL, 0),
        ('elliptic cylinder alone', [part('cylinder', radius=0.5, length=1, scale=(2, 0.5, 1))],
         (0.5, 0.75, 0.25), GLOSSY, 0),
        ('elliptic cone alone', [part('cone', radius=0.5, length=1, scale=(1, 3, 1))],
         (0.5, 0.25, 0.125), GLOSSY, 0),
        ('elliptic frustum alone', [part('frustum', radius=0.25, radius2=0.5, length=1, scale=(1, 2, 0.75))],
         (0.25, 0.5, -0.125), REAL, 0),
        ('half of an ellipsoid alone', [part('dome', radius=1, scale=(0.5, 1, 2))], (0.75, 0.25, -0.125),
         GLOSSY, 0),
        ('elliptic paraboloid alone', [part('paraboloid', radius=1, length=1, scale=(1, 0.5, 2))],
         (0.25, 0.5, 0.125), GLOSSY, 0),
    ]


def reference(row, X=Doubles, agree=1e-12):
    """sigma from scanlines in two directions."""
    one, two = sigma(row[1:], X), sigma(row[1:], X, -0.40625)
    assert abs(one - two) <= agree * one, (row[0], one, two)
    return one


def print_digits(word):
    for row in table():
        if word in row[0]:
            many, few = reference(row, Digits, mpf(10)**-15), reference(row)
            print('%s: %s, doubles differ by %.1e of it' % (row[0], mp.nstr(many, 18), few / many - 1),
                  flush=True)


def check():
    """Closed forms: the most by which the quadrature is off, relatively."""
    worst = 0
    one = ball(0.5, 0.125, 0.25, 2)
    standing = part('cylinder', radius=0.25, length=1)
    tilts = [(0, 1), (0.375, 0.5), (1, 0.75)]
    for x, z in tilts:
        c = z / math.hypot(x, z)
        lambert = lambda area: math.pi * c * c * area  # 4 pi B c^2, B = 0.25, m = 0
        sphere = 8 * math.pi**2 * 0.25 * 0.25 / 3
        tube = math.pi * 0.25 * math.sqrt(math.pi) * math.gamma(1.5) / math.gamma(2) * (1 - c * c)
        dark = math.pi * 0.0625 + 0.5 * x / z
        for parts, truth in [
                ([one], sphere),
                ([one, plate(16, 16)], sphere + lambert(256 - math.pi * 0.25 / c)),
                ([standing, plate(16, 16)], tube + lambert(256 + math.pi * 0.0625 - dark))]:
            worst = max(worst, abs(sigma((parts, (x, 0, z), (0, 0.25, 1, 0), 0), Doubles) / truth - 1))
    # half of a sphere's glint behind the edge of a plate; erfcx by mpmath
    k = 1 / mpf(0.02)
    glint = 1 + mp.sqrt(mp.pi) / 2 * mpf(0.02) * mp.exp(k * k) * mp.erfc(k)
    half = 2 * mp.pi**2 * mpf(0.25) * (mpf(0.02)**2 * glint + mpf(0.5) / 3)
    row = next(r for r in table() if 'glint of a sphere' in r[0] and 'edge' in r[0])
    worst = max(worst, abs(sigma(row[1:], Doubles) / float(half + 4 * mp.pi * 4 * mpf(1.25)) - 1))
    print('closed forms: off by %.1e of sigma at most' % worst)
    assert worst <= 1e-12


def c_part(p):
    size = ', '.join(str(x) for x in p.get('size', (0, 0, 0)))
    return '{{LRCS_SHAPE_%s, LRCS_SHAPE_%s, {%s}, %s, %s, %s, 0}, {%s}, {%s}, %d}' % (
        p['kind'].upper(), 'WALL' if p.get('wall_only') else 'ALL', size, p.get('radius', 0),
        p.get('radius2', 0), p.get('length', 0), ', '.join(str(x) for x in p['at']),
        ', '.join(str(x) for x in p.get('scale', (1, 1, 1))), bool(p.get('turned')))


def print_table():
    rows = table()
    with multiprocessing.Pool(2) as pool:
        found = pool.map(reference, rows, 1)
    print('/* Made by partial_shadow.py (needs mpmath): name, parts (shape, where, scale, turned over), their')
    print('   number, direction, A, B, s, m, two-sided, sigma_m2 */')
    for (name, parts, d, brdf, two_sided), value in zip(rows, found):
        print('{"%s",\n {%s},\n %d, {%s}, {%s}, %d, %s},' % (
            name, ',\n  '.join(c_part(p) for p in parts), len(parts), ', '.join(str(x) for x in d),
            ', '.join(str(x) for x in brdf), two_sided, '%.17g' % value))


if __name__ == '__main__':
    if sys.argv[1:2] == ['check']:
        check()
    elif sys.argv[1:2] == ['digits']:
        print_digits(sys.argv[2] if len(sys.argv) > 2 else '')
    else:
        print_table()
