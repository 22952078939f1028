#!/usr/bin/python3
# SPDX-License-Identifier: MIT
"""Numbers of examples/study from elsewhere: Eq. 2 integrated by mpmath at 40 digits over bodies whose
dimensions follow from their surface, half-power angles as roots of it, means by their closed form.
usage: python3 study.py >study.csv    columns: file, row, column, value, relative tolerance"""
from mpmath import mp, mpf, cos, sin, exp, sqrt, pi, quad, log, erfc, findroot, linspace, asin

mp.dps = 40
A, B, S, M = mpf(1), mpf(1) / 4, mpf("0.2"), mpf("0.5")
TOTAL = mpf(6)


def rad(deg):
    return mpf(deg) * pi / 180


def reflect(c, mat):
    a, b, s, m = mat
    return mpf(0) if c <= 0 else a * c**-4 * exp(-(c**-2 - 1) / s**2) + b * c ** (m + 2)


def around(c_of, mat):
    """Over all azimuths: pieces about the peak, which may be narrow."""
    cuts = [mpf(k) for k in (0, "0.02", "0.05", "0.1", "0.2", "0.4", "0.7", 1, "1.3")] + [pi / 2, pi]
    lit = pi
    if c_of(pi) < 0:  # ends where c = 0
        lit = findroot(c_of, (mpf("0.001"), pi - mpf("0.001")), solver="anderson")
    cuts = [x for x in cuts if x < lit] + [lit]
    return 2 * quad(lambda p: reflect(c_of(p), mat), cuts)


def disc(area, deg, mat):
    return 4 * pi * area * reflect(abs(cos(rad(deg))), mat)


def cylinder_wall(r, l, deg, mat):
    k = sin(rad(deg))
    if deg in (0, 180):
        return mpf(0)
    cuts = [mpf(x) for x in (0, "0.02", "0.05", "0.1", "0.2", "0.4", "0.7", 1, "1.3")] + [pi / 2]
    return 4 * pi * r * l * 2 * quad(lambda p: reflect(k * cos(p), mat), cuts)


def cone_wall(r, half, deg, mat):
    a = sin(rad(half)) * cos(rad(deg))
    b = cos(rad(half)) * sin(rad(deg))
    lateral = pi * r**2 / sin(rad(half))
    if a + b <= 0 or deg >= 180 - half:
        return mpf(0)
    if b == 0 or deg in (0, 180):
        return 4 * pi * lateral * reflect(a, mat)
    return 4 * pi * lateral / (2 * pi) * around(lambda p: a + b * cos(p), mat)


def sphere(r, mat):
    cuts = [mpf(x) for x in (0, "0.3", "0.6", "0.8", "0.9", "0.95", "0.98", "0.995", 1)]
    return 8 * pi**2 * r**2 * quad(lambda c: reflect(c, mat), cuts)


def body(kind, surface, deg, mat):
    c = cos(rad(deg)) if deg != 90 else mpf(0)
    if kind == "disc":
        return mpf(0) if deg == 90 else disc(surface / 2, deg, mat)
    if kind == "cube":
        return 4 * pi * surface / 6 * (reflect(abs(c), mat) + reflect(sin(rad(deg)), mat)) if deg not in (
            0, 180) else 4 * pi * surface / 6 * reflect(mpf(1), mat)
    if kind == "cylinder":
        r = sqrt(surface / (6 * pi))
        return cylinder_wall(r, 2 * r, deg, mat) + 4 * pi * pi * r**2 * reflect(abs(c), mat)
    if kind == "cone":
        r = sqrt(surface / (3 * pi))
        return cone_wall(r, 30, deg, mat) + (4 * pi * pi * r**2 * reflect(-c, mat) if deg > 90 else 0)
    return sphere(sqrt(surface / (4 * pi)), mat)


KINDS = ("disc", "cube", "cylinder", "cone", "sphere")
DIFFUSE, GLINT, MIXED = (mpf(0), B, S, M), (A, mpf(0), S, M), (A, B, S, M)


def say(stem, row, column, value, tolerance="1e-13"):
    print(f"{stem},{row},{column},{mp.nstr(value, 20)},{tolerance}")


def wall(kind, mat, half=30):
    """1 m2 of it at normal incidence."""
    if kind == "disc":
        return 4 * pi * reflect(mpf(1), mat)
    if kind == "cylinder":
        r = sqrt(1 / (4 * pi))
        return cylinder_wall(r, 2 * r, 90, mat)
    if kind == "cone":
        return cone_wall(sqrt(sin(rad(half)) / pi), half, 90 - half, mat)
    return sphere(sqrt(1 / (4 * pi)), mat)


def half_angle(sigma, normal, side, s):
    """Where it has fallen to half, deg from its normal."""
    peak = sigma(mpf(normal))
    guess = s * sqrt(log(2)) * 180 / pi
    return findroot(lambda x: sigma(normal + side * x) / peak - mpf(1) / 2, (guess, guess * mpf("1.05")),
                    tol=mpf(10) ** -25)


def attitudes():
    for stem, mat in (("attitude-diffuse", DIFFUSE), ("attitude-glint", GLINT), ("attitude-mixed", MIXED)):
        for kind in KINDS:
            for deg in (0, 17, 30, 60, 73, 90, 111, 150, 180):
                say(stem, deg, f"{kind}_m2", body(kind, TOTAL, deg, mat))
    for letter, k in (("A", 0), ("B", 1), ("s", 2), ("m", 3)):
        values = {"A": ("0.25", "16"), "B": ("0.0625", "0.5"), "s": ("0.05", "0.4"), "m": ("0", "20")}[letter]
        for value in values:
            mat = list(MIXED)
            mat[k] = mpf(value)
            for deg in (0, "4.5", 45, 88, 90):
                say(f"influence-{letter}", deg, f"{letter}_{value}_m2", body("cylinder", TOTAL, mpf(deg), mat))


def dials():
    for kind in ("cube", "cylinder", "cone"):
        for scale in ("0.125", "1", "8"):
            say("size", scale, f"{kind}_m2", body(kind, TOTAL * mpf(scale) ** 2, 90, MIXED))
    for s in ("0.01", "0.1", "0.5"):
        for kind in ("disc", "cone", "cylinder", "sphere"):
            say("glint-peak", s, f"{kind}_m2", wall(kind, (A, mpf(0), mpf(s), M)))
    for m in ("0", "2.5", "20"):
        for kind in ("disc", "cone", "cylinder", "sphere"):
            say("diffuse-m", m, f"{kind}_m2", wall(kind, (mpf(0), B, S, mpf(m))))


def widths():
    for s in ("0.05", "0.2", "0.5"):
        mat = (A, mpf(0), mpf(s), M)
        flat = half_angle(lambda d: reflect(cos(rad(d)), mat), 0, 1, mpf(s))
        band = half_angle(lambda d: cylinder_wall(1, 1, d, mat), 90, -1, mpf(s))
        base = half_angle(lambda d: cone_wall(1, 30, d, mat), 60, 1, mpf(s))
        nose = half_angle(lambda d: cone_wall(1, 30, d, mat), 60, -1, mpf(s))
        for column, value in (("disc", flat), ("cylinder", band), ("cone_to_base", base), ("cone_to_nose", nose)):
            say("glint-width", s, f"{column}_deg", value, "1e-11")
        if s == "0.2":
            say("glint-share", "disc", "share", (1 - cos(rad(flat))) / 2, "1e-11")
            say("glint-share", "cylinder", "share", sin(rad(band)), "1e-11")
            say("glint-share", "cone", "share", (cos(rad(60 - nose)) - cos(rad(60 + base))) / 2, "1e-11")
    for m in (0, 5, 20):
        angle = 2 * asin(sqrt((1 - mpf(2) ** (-1 / (mpf(m) + 2))) / 2)) * 180 / pi
        say("diffuse-width", m, "disc_deg", angle, "1e-11")


def sheets():
    for kind in KINDS:
        say("equal-surface", kind, "axis_mixed_m2", body(kind, TOTAL, 0, MIXED))
        say("equal-surface", kind, "broadside_mixed_m2", body(kind, TOTAL, 90, MIXED))
    for name, mat in (("diffuse", DIFFUSE), ("glint", GLINT)):
        column = f"broadside_{name}_m2"
        say("equal-projected-area", "cube", column, 4 * pi * reflect(mpf(1), mat))
        say("equal-projected-area", "cylinder", column, cylinder_wall(mpf(1) / 2, 1, 90, mat))
        say("equal-projected-area", "cone", column, cone_wall(sqrt(1 / sqrt(mpf(3))), 30, 90, mat))
        say("equal-projected-area", "sphere", column, sphere(sqrt(1 / pi), mat))
    e = S**2 + sqrt(pi) / 2 * S**3 * exp(1 / S**2) * erfc(1 / S)
    diffuse, glint = TOTAL * 2 * pi * B / (M + 3), TOTAL * pi * A * e
    for kind in KINDS:
        say("attitude-mean", kind, "mean_diffuse_m2", diffuse, "1e-8")
        say("attitude-mean", kind, "mean_glint_m2", glint, "1e-8")
        say("attitude-mean", kind, "mean_mixed_m2", diffuse + glint, "1e-8")
    for kind in ("disc", "cylinder", "cone"):
        say("glint-share", kind, "mean_m2", glint / TOTAL, "1e-8")


attitudes()
dials()
widths()
sheets()
