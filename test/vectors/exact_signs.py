#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Writes exact_signs.inc: near-degenerate determinants, their signs and values.

Both come from rational arithmetic (fractions.Fraction of the very doubles printed). Each case is
four points; the turn case uses the fourth as a direction. usage: exact_signs.py > exact_signs.inc
"""
import math
import random
from fractions import Fraction as F

random.seed(20260721)


def sign(x):
    return (x > 0) - (x < 0)


def det(u, v, w):
    return (w[0] * (u[1] * v[2] - u[2] * v[1]) + w[1] * (u[2] * v[0] - u[0] * v[2])
            + w[2] * (u[0] * v[1] - u[1] * v[0]))


def sub(a, b):
    return [F(x) - F(y) for x, y in zip(a, b)]


def answer(kind, a, b, c, d):
    last = sub(d, a) if kind == 's' else [F(x) for x in d]
    return det(sub(b, a), sub(c, a), last)


def number(bits):
    """A double of so many bits, its exponent anywhere in eight octaves."""
    m = random.getrandbits(bits - 1) | (1 << (bits - 1))
    return random.choice((-1, 1)) * math.ldexp(m, random.randrange(-4, 4) - bits)


def point(bits):
    return [number(bits) for _ in range(3)]


def nudge(x):
    for _ in range(random.randrange(3)):
        x = math.nextafter(x, random.choice((-math.inf, math.inf)))
    return x


def combine(kind, a, b, c, s, t):
    """A point on the plane of a, b, c, or (turn) a c that makes a, b, c turn nowhere seen from d."""
    if kind == 's':
        return [float(F(a[k]) + s * (F(b[k]) - F(a[k])) + t * (F(c[k]) - F(a[k]))) for k in range(3)]
    return [float(F(a[k]) + s * (F(b[k]) - F(a[k])) + t * F(c[k])) for k in range(3)]


def case(bits, exact):
    kind = random.choice('st')
    a, b, c = point(bits), point(bits), point(bits)
    if exact:
        s, t = F(random.randrange(-4, 5)), F(random.randrange(-4, 5), 4)
    else:
        s, t = F(random.uniform(-1, 2)), F(random.uniform(-1, 2))
    p = combine(kind, a, b, c, s, t)
    if not exact:
        p = [nudge(x) for x in p]
    if kind == 't':
        c, p = p, c
    return kind, a, b, c, p


def text(x):
    h = float(x).hex()
    head, exponent = h.split('p')
    if '.' in head:
        head = head.rstrip('0').rstrip('.')
    return head + 'p' + str(int(exponent))


def main():
    print('/* Made by exact_signs.py: kind (s: side, t: turn), sign, a, b, c, and p or d; the value, the rest of it. */')
    for bits, exact, count in ((53, False, 400), (12, False, 1150), (12, True, 500)):
        for _ in range(count):
            kind, a, b, c, p = case(bits, exact)
            value = answer(kind, a, b, c, p)
            rest = float(value - F(float(value)))
            row = [str(sign(value))] + [text(x) for q in (a, b, c, p, (float(value), rest)) for x in q]
            print("CASE('%s',%s)," % (kind, ','.join(row)))


main()
