#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""sigma of curved bodies by the definition, for test/optics/test_deviation.c.

sigma = 4 pi * integral over the surface where c = n . s_hat > 0 of
        A c^-4 exp(-(c^-2 - 1)/s^2) + B c^(m+2)
by Gauss-Legendre quadrature with mpmath over azimuth and meridian, split at the horizon and
about the glint; no closed form is used but for flat caps. Held to 1e-9 of itself by
comparing two orders. Inputs have few decimal digits: the text is the double.

usage: shapes.py > shapes.inc
"""
import random
from mpmath import mp, mpf, sin, cos, tan, atan, acos, asin, sqrt, exp, pi, quad, atan2

mp.dps = 20


def F(c, mat):
    A, B, s, m = mat
    if c <= 0:
        return mpf(0)
    g = A * c**-4 * exp(-(c**-2 - 1) / s**2) if A else 0
    return g + (B * c**(m + 2) if B else 0)


def pieces(points, low, high):
    inside = sorted(p for p in points if low < p < high)
    return [low] + inside + [high]


def azimuth(psi, alpha, mat, degree):
    """integral over azimuth of F for normals of elevation psi"""
    a, b = sin(psi) * cos(alpha), cos(psi) * sin(alpha)
    if a + b <= 0:
        return mpf(0)
    end = acos(-a / b) if a < b and -a < b else pi
    w = mat[2] if mat[0] else mpf(1)
    cut = pieces([w * k / max(sin(alpha), mpf('0.02')) for k in (1, 2, 4, 8, 16)], mpf(0), end)
    return 2 * quad(lambda f: F(a + b * cos(f), mat), cut, method='gauss-legendre', maxdegree=degree)


def meridian(low, high, alpha, mat, degree, weight):
    """integral over polar angle theta of the normal of weight(theta) * azimuth"""
    w = mat[2] if mat[0] else mpf(1)
    points = [abs(pi / 2 - alpha)] + [alpha + k * w for k in (-8, -4, -2, -1, 0, 1, 2, 4, 8)]
    cut = pieces(points, low, high)
    return quad(lambda t: weight(t) * azimuth(pi / 2 - t, alpha, mat, degree), cut,
                method='gauss-legendre', maxdegree=degree)


def wall(kind, R, R2, L, alpha, mat, degree):
    if kind == 'cylinder':
        return R * L * azimuth(mpf(0), alpha, mat, degree)
    if kind == 'cone':
        return R * sqrt(R * R + L * L) / 2 * azimuth(atan2(R, L), alpha, mat, degree)
    if kind == 'frustum':
        return (R + R2) / 2 * sqrt((R2 - R)**2 + L * L) * azimuth(atan2(R2 - R, L), alpha, mat, degree)
    if kind == 'sphere':
        return meridian(mpf(0), pi, alpha, mat, degree, lambda t: R * R * sin(t))
    if kind == 'dome':
        return meridian(mpf(0), pi / 2, alpha, mat, degree, lambda t: R * R * sin(t))
    T = 2 * L / R  # paraboloid: rho = R tan(t)/T, dA = rho drho/cos(t)
    return meridian(mpf(0), atan(T), alpha, mat, degree,
                    lambda t: (R / T)**2 * tan(t) / cos(t)**3)


def sigma(kind, part, R, R2, L, alpha, mat, degree):
    total = wall(kind, R, R2, L, alpha, mat, degree)
    if part == 'ALL' and kind != 'sphere':
        base = R2 if kind == 'frustum' else R
        total += pi * base**2 * F(-cos(alpha), mat)
        if kind in ('cylinder', 'frustum'):
            total += pi * R**2 * F(cos(alpha), mat)
    return 4 * pi * total


def main():
    random.seed(20260101)
    pick = lambda low, high: '%.4g' % (low * (high / low)**random.random())
    print('/* Made by shapes.py (mpmath). kind, parts, radius, radius2, length, A, B, s, m,')
    print('   aspect_deg, sigma_m2 */')
    work = [('cylinder', 90), ('cone', 90), ('frustum', 90), ('sphere', 8), ('dome', 16),
            ('paraboloid', 16)]
    for kind, count in work:
        done = 0
        while done < count:
            part = random.choice(['ALL', 'WALL'])
            R, L = pick(0.1, 10), pick(0.1, 10)
            R2 = pick(0.1, 10) if kind == 'frustum' else '0'
            L = '0' if kind in ('sphere', 'dome') else L
            A = random.choice(['0', '1', '1', pick(0.01, 10)])
            B = random.choice(['0', '0.25', pick(0.01, 10)])
            s = pick(0.02, 2) if count > 20 else pick(0.1, 1)
            m = random.choice(['0', '0.5', '1', pick(0.1, 50)])
            if A == '0' and B == '0':
                continue
            glint = atan2(mpf(R), mpf(L)) if kind == 'cone' else (
                atan2(mpf(R2) - mpf(R), mpf(L)) if kind == 'frustum' else mpf(0))
            near = 90 - float(glint * 180 / pi) + random.gauss(0, 1) * float(s) * 57
            deg = random.choice([random.uniform(0, 180), near])
            deg = '%.5g' % min(180, max(0.01, deg))
            mat = tuple(mpf(x) for x in (A, B, s, m))
            args = (kind, part, mpf(R), mpf(R2), mpf(L), mpf(deg) * pi / 180, mat)
            one, two = sigma(*args, 5), sigma(*args, 4)
            if one < mpf(10)**-290 or abs(one - two) > mpf(10)**-9 * one:
                continue
            done += 1
            print('{LRCS_SHAPE_%s, LRCS_SHAPE_%s, %s, %s, %s, {%s, %s, %s, %s}, %s, %s},' %
                  (kind.upper(), part, R, R2, L, A, B, s, m, deg, mp.nstr(one, 15)), flush=True)


main()
