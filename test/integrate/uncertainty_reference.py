# SPDX-License-Identifier: MIT
# The references of test_uncertainty.c, by mpmath at 40 digits from the closed forms of these shapes:
# d sigma / dA, dB, ds, dm of shapes. usage: python3 uncertainty_reference.py
from mpmath import mp, mpf, pi, sqrt, exp, erfc, gamma, cos, sin, tan, cot, diff, radians

mp.dps = 40

def plate(deg):
    c = cos(mpf(deg) * pi / 180)
    u = tan(mpf(deg) * pi / 180) ** 2
    return lambda A, B, s, m: 4 * pi * (A * c ** -4 * exp(-u / s ** 2) + B * c ** (m + 2))

def sphere(R):
    E = lambda s: s ** 2 + sqrt(pi) / 2 * s ** 3 * exp(1 / s ** 2) * erfc(1 / s)
    return lambda A, B, s, m: 4 * pi ** 2 * R ** 2 * A * E(s) + 8 * pi ** 2 * R ** 2 * B / (m + 3)

def wall(R, L, deg):
    k = sin(mpf(deg) * pi / 180)
    c2 = cot(mpf(deg) * pi / 180) ** 2
    return lambda A, B, s, m: (4 * pi * R * L * A * sqrt(pi) * s * k ** -3 * (1 + k ** 2 * s ** 2 / 2) * exp(-c2 / s ** 2)
        + 4 * pi * R * L * B * k ** (m + 2) * sqrt(pi) * gamma((m + 3) / 2) / gamma((m + 4) / 2))

def show(name, f, A, B, s, m):
    at = (mpf(A), mpf(B), mpf(s), mpf(m))
    d = [diff(f, at, n) for n in ((1, 0, 0, 0), (0, 1, 0, 0), (0, 0, 1, 0))]
    # m may be 0: the formulas hold beyond
    d.append(diff(f, at, (0, 0, 0, 1)))
    print("{%s, {%s, %s, %s, %s}, {%s}}," % (name, A, B, s, m, ", ".join(mp.nstr(x, 17) for x in d)))

for deg in (0, 20, 60):
    show("plate %g" % deg, plate(deg), "1", "0.25", "0.2", "0.5")
show("plate 20", plate(20), "1", "0.25", "0.05", "0")
show("sphere 0.5", sphere(mpf("0.5")), "1", "0.25", "0.2", "0.5")
show("sphere 0.5", sphere(mpf("0.5")), "2", "0.1", "0.02", "0")
show("wall 0.25 1.5 30", wall(mpf("0.25"), mpf("1.5"), 30), "1", "0.25", "0.2", "0.5")
show("wall 0.25 1.5 80", wall(mpf("0.25"), mpf("1.5"), 80), "1", "0.25", "0.4", "3")
