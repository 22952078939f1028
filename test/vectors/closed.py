#!/usr/bin/python3
# SPDX-License-Identifier: MIT
# sigma of every shape from the definition, 4 pi times the integral of f_r cos^2 over the lit surface
# (Eq. 2), at inputs that are exact doubles, by mpmath at 50 digits. Writes closed.inc.
#
# Plane faces: area times f_r cos^2. Walls of revolution: the integral over azimuth of the cosine
# a + b cos(phi) between the terminators. Sphere, dome: over the angle theta from the light, times
# the azimuths whose normal lies in the hemisphere. Paraboloid: the same, the azimuths weighted with
# 1 / Gaussian curvature = K n_z^-4, whose antiderivative in the eccentric anomaly is elementary.
# Each integral is a 24-point Gauss rule on panels that halve towards both ends, 56 times: the cosine
# spans 17 decades to the terminator, and the panels' truncation is below 1e-25 of the integral.
# About 8 minutes on one core.
# check() repeats a sample of them by mpmath's adaptive tanh-sinh rule and, for the dome and the
# paraboloid, by a double integral over the surface itself.
import random
from fractions import Fraction
from mpmath import (mp, mpf, acos, atan, atan2, cos, cosh, exp, log, pi, quad, sin, sinh, sqrt,
                    tan, atanh, hypot, legendre)

mp.dps = 50
random.seed(1956)
PLATE, DISC, BOX, SPHERE, DOME, CYLINDER, CONE, FRUSTUM, PARABOLOID = range(9)
LEVELS = 56


def gauss(n):
    rule = []
    for i in range(n):
        x = cos(pi * (i + mpf(3) / 4) / (n + mpf(1) / 2))
        for _ in range(7):  # Newton; the guess is good to 1e-4
            d = n * (x * legendre(n, x) - legendre(n - 1, x)) / (x * x - 1)
            x -= legendre(n, x) / d
        rule.append((x, 2 / ((1 - x * x) * d * d)))
    assert abs(sum(w for _, w in rule) - 2) < mpf(10) ** -45
    return rule


RULE = gauss(24)


def integrate(f, low, high):
    """Graded towards both ends. Panels on which f is nothing at three points are passed over: every
    f here is a smooth bump or falls monotonically on them."""
    if not high > low:
        return mpf(0)
    length = high - low
    cuts = [low] + [low + length / mpf(2) ** k for k in range(LEVELS, 1, -1)]
    cuts += [low + length / 2] + [high - length / mpf(2) ** k for k in range(2, LEVELS + 1)] + [high]
    total = mpf(0)
    probe = [max(abs(f((a + b) / 2)), abs(f(a + (b - a) / 16)), abs(f(b - (b - a) / 16))) * (b - a)
             for a, b in zip(cuts, cuts[1:])]
    most = max(probe)
    for (a, b), size in zip(zip(cuts, cuts[1:]), probe):
        if size > most * mpf(10) ** -28:
            half = (b - a) / 2
            mid = (a + b) / 2
            total += half * sum(w * f(mid + half * x) for x, w in RULE)
    return total


def sincos(deg):
    """Of an exact number of degrees, exact zeros."""
    deg = Fraction(deg) % 360
    if deg % 90 == 0:
        k = int(deg / 90)
        return mpf([0, 1, 0, -1][k]), mpf([1, 0, -1, 0][k])
    x = mpf(deg.numerator) / deg.denominator * pi / 180
    return sin(x), cos(x)


def laws(mat):
    """Glint and diffuse f_r cos^2 as functions of the cosine."""
    A, B, s, m = [mpf(v) for v in mat]

    def glint(c):
        if not c > 0 or A == 0:
            return mpf(0)
        e = (1 - c * c) / (c * c * s * s)
        return A * exp(-e) / c ** 4 if e < 3000 else mpf(0)

    def diffuse(c):
        if not c > 0 or B == 0:
            return mpf(0)
        e = -(m + 2) * log(c)
        return B * exp(-e) if e < 3000 else mpf(0)

    return glint, diffuse


def face(mat, sine, cosine, area):
    """By sine and cosine, so that near-normal light keeps its digits."""
    A, B, s, m = [mpf(v) for v in mat]
    if not cosine > 0:
        return [mpf(0), mpf(0)]
    t2 = (sine / cosine) ** 2
    glint = A * (1 + t2) ** 2 * exp(-t2 / s ** 2) if A else mpf(0)
    return [4 * pi * area * glint, 4 * pi * area * B * (1 + t2) ** (-m / 2 - 1)]


def wall(mat, sa, ca, sb, cb, area):
    a = sb * ca
    b = cb * sa
    if not a + b > mpf(10) ** -45:  # sin(alpha + beta); 0 but for rounding at alpha + beta = 180
        return [mpf(0), mpf(0)]
    end = acos(-a / b) if b > abs(a) else pi
    return [4 * area * integrate(lambda p: f(a + b * cos(p)), mpf(0), end) for f in laws(mat)]


def cap_weight(kind, tau, sa, ca, theta):
    """Azimuths about the light whose normal is within tau of +z; paraboloid: weighted n_z^-4."""
    P = ca * cos(theta)
    Q = sa * sin(theta)
    N = cos(tau)
    if P + Q <= N:
        return mpf(0)
    whole = P - Q >= N
    phi = pi if whole else acos((N - P) / Q)
    if kind == DOME:
        return 2 * phi
    old = mp.dps
    mp.dps = 90
    D = P * P - Q * Q
    if D > 0:
        E = pi if whole else 2 * atan(sqrt((P - Q) / (P + Q)) * tan(phi / 2))
        value = (P ** 3 * E - 3 * P * P * Q * sin(E) + 3 * P * Q * Q * (E / 2 + sin(2 * E) / 4)
                 - Q ** 3 * (sin(E) - sin(E) ** 3 / 3)) / D ** 3 / sqrt(D)
    else:
        H = 2 * atanh(sqrt((Q - P) / (P + Q)) * tan(phi / 2))
        value = (Q ** 3 * (sinh(H) + sinh(H) ** 3 / 3) - 3 * Q * Q * P * (H / 2 + sinh(2 * H) / 4)
                 + 3 * Q * P * P * sinh(H) - P ** 3 * H) / D ** 3 / sqrt(-D) * -1
    mp.dps = old
    return 2 * value


def cap(mat, kind, tau, deg_or_sc, K):
    sa, ca = deg_or_sc
    alpha = atan2(sa, ca)
    kink = abs(tau - alpha)
    last = min(pi / 2, tau + alpha)
    out = []
    for f in laws(mat):
        def g(t):
            return f(cos(t)) * sin(t) * cap_weight(kind, tau, sa, ca, t)
        total = mpf(0)
        if alpha < tau:
            total += integrate(g, mpf(0), kink)
        total += integrate(g, kink, last) if sa > 0 else 0
        out.append(4 * pi * K * total)
    return out


def sphere(mat, R):
    return [8 * pi * pi * R * R * integrate(lambda t: f(cos(t)) * sin(t), mpf(0), pi / 2)
            for f in laws(mat)]


def sigma(kind, parts, dims, light, mat):
    """dims: size0 size1 size2 radius radius2 length half_angle; light: degrees or a direction."""
    x, y, z, R, R2, L = [mpf(v) for v in dims[:6]]
    if isinstance(light, tuple):
        d = [mpf(v) for v in light]
        n = sqrt(sum(v * v for v in d))
        hat = [v / n for v in d]
        sa, ca = sqrt(hat[0] ** 2 + hat[1] ** 2), hat[2]
    else:
        sa, ca = sincos(light)
        hat = [sa, mpf(0), ca]
    total = [mpf(0), mpf(0)]

    def add(part):
        total[0] += part[0]
        total[1] += part[1]

    if kind == PLATE:
        add(face(mat, sa, ca, x * y))
    if kind == DISC:
        add(face(mat, sa, ca, pi * R * R))
    if kind == BOX:
        for i, area in enumerate((y * z, z * x, x * y)):
            add(face(mat, sqrt(hat[i - 1] ** 2 + hat[i - 2] ** 2), abs(hat[i]), area))
    if kind == SPHERE:
        add(sphere(mat, R))
    if kind == DOME:
        add(cap(mat, DOME, pi / 2, (sa, ca), R * R))
    if kind == PARABOLOID:
        add(cap(mat, PARABOLOID, atan(2 * L / R), (sa, ca), (R * R / (2 * L)) ** 2))
    if kind == CYLINDER:
        add(wall(mat, sa, ca, mpf(0), mpf(1), 2 * pi * R * L))
    if kind == CONE and dims[6] > 0:
        if isinstance(light, tuple) or Fraction(light) + Fraction(dims[6]) < 180:
            sb, cb = sincos(dims[6])
            add(wall(mat, sa, ca, sb, cb, pi * R * R / sb))
    if kind == FRUSTUM or kind == CONE and dims[6] == 0:
        top, base = (R, R2) if kind == FRUSTUM else (mpf(0), R)
        slant = hypot(base - top, L)
        add(wall(mat, sa, ca, (base - top) / slant, L / slant, pi * (top + base) * slant))
    if parts == 0 and kind in (CYLINDER, FRUSTUM):
        add(face(mat, sa, ca, pi * R * R))
        add(face(mat, sa, -ca, pi * (R2 if kind == FRUSTUM else R) ** 2))
    if parts == 0 and kind in (DOME, CONE, PARABOLOID):
        add(face(mat, sa, -ca, pi * R * R))
    return total


PAIRS = [(0.2, 0.5), (0.05, 0.0), (1e-3, 100.0), (1e-6, 1e4), (0.7, 1.0), (1.0, 3.3), (10.0, 10.0),
         (1e3, 1e3), (30.0, 0.01)]


def material():
    s, m = random.choice(PAIRS)
    return (1.0, 0.25, s, m)


def dims(size=(0.0, 0.0, 0.0), R=0.0, R2=0.0, L=0.0, beta=0.0):
    return tuple(size) + (R, R2, L, beta)


def direction():
    v = [random.gauss(0, 1) * 10 ** random.choice([0, 0, 0, -3, -9]) for _ in range(3)]
    return tuple(u * 10.0 ** random.choice([0, -200, 200]) for u in v)


ASPECTS = [0.0, 1e-9, 0.01, 10.0, 30.0, 45.0, 60.0, 75.0, 85.0, 89.999, 89.99999999999999, 90.0,
           90.00000000000001, 90.001, 100.0, 120.0, 135.0, 150.0, 165.0, 179.0, 179.9999999, 180.0]
cases = []


def put(kind, d, lights, repeat=1, parts=None):
    for light in lights:
        for _ in range(repeat):
            p = random.choice([0, 1]) if parts is None else parts
            cases.append((kind, p, d, light, material()))


def build():
    put(PLATE, dims((1.0, 1.0, 0.0)), ASPECTS[:14] + [1e-7, 1e-5], 3, 0)
    put(PLATE, dims((1e-100, 1e100, 0.0)), [direction() for _ in range(15)], 1, 0)
    put(DISC, dims(R=0.3), ASPECTS[:13], 2, 0)
    put(BOX, dims((1.0, 2.0, 3.0)), ASPECTS, 3, 0)
    put(BOX, dims((0.1, 0.7, 1e5)), [direction() for _ in range(40)], 1, 0)
    for s, m in PAIRS:
        cases.append((SPHERE, 0, dims(R=1.5), 0.0, (1.0, 0.25, s, m)))
        cases.append((SPHERE, 0, dims(R=1.5), 33.0, (0.5, 0.1, s * random.uniform(0.5, 2), m * 1.7)))
        cases.append((CONE, 1, dims(R=1.0, beta=20.0), 70.0, (1.0, 0.25, s, m)))
        cases.append((PARABOLOID, 1, dims(R=1.0, L=1.0), 40.0, (1.0, 0.25, s, m)))
        cases.append((DOME, 1, dims(R=1.0), 100.0, (1.0, 0.25, s, m)))
        cases.append((CYLINDER, 1, dims(R=1.0, L=1.0), 80.0, (1.0, 0.25, s, m)))
    for d in (dims(R=0.5, L=2.0), dims(R=1e-3, L=1e3), dims(R=1e100, L=1e-100)):
        put(CYLINDER, d, ASPECTS + [1e-3, 5.0], 2)
    put(DOME, dims(R=2.0), ASPECTS + [1e-4, 89.0, 91.0], 4)
    for beta in (15.0, 1.0, 89.0, 1e-3, 89.999, 45.0, 30.0, 60.5, 1e-9):
        special = [beta, 180.0 - beta, 90.0 - beta, beta * (1 + 2 ** -50), beta * (1 - 2 ** -50),
                   (180.0 - beta) * (1 - 2 ** -50), min(180.0, (180.0 - beta) * (1 + 2 ** -40)),
                   180.0 - beta * 1.01, beta * 1.01, beta * 0.99]
        put(CONE, dims(R=0.5, beta=beta), special, 2)
        put(CONE, dims(R=0.5, beta=beta), random.sample(ASPECTS, 9) + [0.0, 90.0], 2)
        put(CONE, dims(R=0.5, beta=beta), [direction() for _ in range(4)], 1)
    for R, L in ((1.0, 2.0), (1.0, 1e5), (1e5, 1.0), (1e-100, 1e100)):
        put(CONE, dims(R=R, L=L), random.sample(ASPECTS, 10) + [26.565051177077990, 90.0], 2)
    for R, R2, L in ((0.5, 1.0, 2.0), (1.0, 0.5, 2.0), (1.0, 1.0, 2.0), (1.0, 1.0 + 2 ** -40, 3.0),
                     (3.0, 0.1, 1e-3), (0.0, 1.0, 1.0), (1.0, 0.0, 0.5), (1.0, 2.0, 0.0)):
        put(FRUSTUM, dims(R=R, R2=R2, L=L), random.sample(ASPECTS, 10) + [0.0, 90.0, 180.0], 2)
    for R, H in ((1.0, 1.0), (1.0, 0.01), (1.0, 5.0), (1.0, 500.0), (1.0, 1e-5), (1e-3, 1e3)):
        tau = float(atan(2 * mpf(H) / mpf(R)) * 180 / pi)
        put(PARABOLOID, dims(R=R, L=H), [0.0, 1e-9, tau, tau * (1 - 2 ** -45), tau * (1 + 2 ** -45),
                                         90.0 - tau, 90.0, 90.0 + tau * 0.99, 90.0 + tau, 180.0])
        put(PARABOLOID, dims(R=R, L=H), random.sample(ASPECTS, 8) + [random.uniform(0, 150)], 2)
    put(CONE, dims(R=2.0, beta=12.5), [random.uniform(0, 180) for _ in range(20)], 3)
    put(FRUSTUM, dims(R=0.3, R2=0.9, L=1.7), [direction() for _ in range(15)], 2)
    put(DOME, dims(R=1e-100), [direction() for _ in range(15)], 1)
    put(PARABOLOID, dims(R=1.0, L=0.7), [direction() for _ in range(15)], 1)
    put(CYLINDER, dims(R=1e100, L=1.0), [direction() for _ in range(15)], 1)


def check():
    """The panels against an adaptive rule, and caps against the surface itself."""
    mat = (1.0, 0.25, 0.3, 0.7)
    sb, cb = sincos(20)
    for deg in (10, 40, 100):
        sa, ca = sincos(deg)
        got = wall(mat, sa, ca, sb, cb, mpf(1))
        a, b = sb * ca, cb * sa
        end = acos(-a / b) if b > a else pi
        for f, value in zip(laws(mat), got):
            want = 4 * quad(lambda p: f(a + b * cos(p)), [0, end / 8, end / 2, end])
            assert abs(value - want) <= mpf(10) ** -22 * want, (deg, value, want)
    mp.dps = 15
    sa, ca = sincos(40)
    for f, dome, bowl in zip(laws(mat), cap(mat, DOME, pi / 2, (sa, ca), mpf(1)),
                             cap(mat, PARABOLOID, atan(mpf(2)), (sa, ca), mpf(1) / 4)):
        # surface (theta, phi) of the unit half sphere; (r, phi) of z = 1 - r^2
        want = 8 * pi * quad(lambda t, p: sin(t) * f(ca * cos(t) + sa * sin(t) * cos(p)),
                             [0, 0.35, 0.7, 1.05, pi / 2], [0, 0.5, 1, 2, pi])
        assert abs(dome - want) < 1e-6 * want, (dome, want)
        want = 8 * pi * quad(lambda r, p: r * sqrt(1 + 4 * r * r)
                             * f((ca + sa * 2 * r * cos(p)) / sqrt(1 + 4 * r * r)),
                             [0, 0.2, 0.42, 0.6, 1], [0, 0.5, 1, 2, pi])
        assert abs(bowl - want) < 1e-6 * want, (bowl, want)
    mp.dps = 50


def text(x):
    return repr(float(x)).replace("e+", "e") if x != 0 else "0"


def main():
    check()
    build()
    with open("closed.inc", "w") as out:
        out.write("/* kind, parts, size[3], radius, radius2, length, half_angle_deg, by_direction, deg "
                  "or direction[3],\n   A, B, s, m, sigma_glint, sigma_diffuse: made by closed.py */\n")
        for kind, parts, d, light, mat in cases:
            value = sigma(kind, parts, d, light, mat)
            by = isinstance(light, tuple)
            where = light if by else (light, 0.0, 0.0)
            d = [text(v) for v in d]
            row = [str(kind), str(parts), "{%s}" % ", ".join(d[:3])] + d[3:] + [str(int(by))]
            row += ["{%s}" % ", ".join(text(v) for v in where)]
            row += [text(v) for v in mat] + [text(v) for v in value]
            out.write("{%s},\n" % ", ".join(row))


if __name__ == "__main__":
    main()
