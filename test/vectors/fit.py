#!/usr/bin/python3
# SPDX-License-Identifier: MIT
# Readings of known materials with seeded normal noise, and what least squares makes of them, by
# mpmath at 40 digits from the definitions: the minimum of the sum of squares as a root of its
# gradient (Newton, from the truth), standard errors from the matrix of derivatives, and the limits
# of the profile, each as a root of three derivatives and of SS - SSmin - rise. Writes fit.inc.
import random
from mpmath import mp, mpf, exp, cos, tan, log, pi, sqrt, matrix, findroot, betainc, erfinv, diff

mp.dps = 40


def student(nu):
    return findroot(lambda t: betainc(mpf(nu) / 2, mpf(1) / 2, 0, nu / (nu + t * t), regularized=True)
                    - mpf("0.05"), 2 + mpf(4) / nu)


def parts(deg, s, m, cosine):
    c = cos(mpf(deg) * pi / 180)
    u = 1 / c**2 - 1
    f = c if cosine else mpf(1)
    g, d = f * c**-6 * exp(-u / s**2), f * c**m
    return g, d, g * 2 * u / s**3, d * log(c)


def case(name, truth, angles, noise, unit, cosine, kind, seed):
    """kind 0: absolute noise; 2: sigmas given, in proportion to the value (noise), a floor added."""
    random.seed(seed)
    rows = []
    for deg in angles:
        g, d, _, _ = parts(deg, mpf(truth[2]), mpf(truth[3]), cosine)
        f = float((truth[0] * g + truth[1] * d) / unit)
        sigma = noise if kind == 0 else noise * f + 0.002
        rows.append((float(deg), f + sigma * random.gauss(0, 1), sigma))
    weight = [mpf(1) if kind == 0 else 1 / mpf(r[2]) for r in rows]
    y = [mpf(r[1]) * mpf(unit) for r in rows]
    weight = [w if kind == 0 else w / mpf(unit) for w in weight]

    def model(p):
        out = []
        for (deg, _, _), w, v in zip(rows, weight, y):
            g, d, gs, dm = parts(deg, p[2], p[3], cosine)
            out.append((w * (v - p[0] * g - p[1] * d), [w * g, w * d, w * p[0] * gs, w * p[1] * dm]))
        return out

    def square(p):
        return sum(r * r for r, _ in model(p))

    def slope(p):
        rows_ = model(p)
        return [sum(r * j[k] for r, j in rows_) for k in range(4)]

    best = list(findroot(lambda *p: slope(p), [mpf(t) for t in truth]))
    least, n = square(best), len(rows)
    variance = least / (n - 4)
    known = kind == 2 and variance < 1
    t = sqrt(2) * erfinv(mpf("0.95")) if known else student(n - 4)
    rise = t * t * (1 if known else variance)
    jacobian = [j for _, j in model(best)]
    gram = matrix(4, 4)
    for i in range(4):
        for k in range(4):
            gram[i, k] = sum(j[i] * j[k] for j in jacobian)
    inverse = gram**-1
    error = [sqrt((1 if known else variance) * inverse[k, k]) for k in range(4)]
    limits = []
    for k in range(4):
        for side in (-1, 1):
            # along the linear model the others follow by inverse[i, k] / inverse[k, k]
            start = [best[i] + side * t * error[k] * inverse[i, k] / inverse[k, k] for i in range(4)]
            other = [i for i in range(4) if i != k]
            end = findroot(lambda *p: [slope(p)[i] for i in other] + [(square(p) - least) / rise - 1],
                           start, tol=1e-25)
            limits.append(end[k])
    print(name, [float(b) for b in best], float(variance), [float(l) for l in limits])
    return name, unit, cosine, kind, rows, best, error, limits, sqrt(variance)


def span(a, b, n):
    return [a + (b - a) * i / (n - 1) for i in range(n)]


cases = [
    case("plain", (1.0, 0.25, 0.2, 0.5), span(-60, 75, 28), 0.01, 1.0, 0, 0, 1),
    case("panel", (0.6, 0.05, 0.1, 1.2), span(0, 60, 31), 0.004, float(0.98 / pi), 1, 0, 5),
    case("sigma", (2.0, 0.15, 0.15, 0.3), span(0, 70, 36), 0.05, 1.0, 0, 2, 3),
]


def number(x):
    return float(x).hex()


with open("fit.inc", "w") as out:
    out.write("/* Made by fit.py. */\n")
    for name, _, _, _, rows, *_ in cases:
        out.write("static const lrcs_fit_reading fit_readings_%s[] = {\n" % name)
        for row in rows:
            out.write("    {%s},\n" % ", ".join(number(x) for x in row))
        out.write("};\n")
    out.write("/* name, unit, cosine, noise, readings, their number, A B s m, standard errors, limits,\n"
              "   noise of a reading */\n")
    out.write("static const struct {\n    const char *name;\n    double unit;\n    int cosine, noise;\n"
              "    const lrcs_fit_reading *reading;\n    uint32_t count;\n"
              "    double value[4], error[4], limit[8], spread;\n} fit_cases[] = {\n")
    for name, unit, cosine, kind, rows, best, error, limits, spread in cases:
        out.write('    {"%s", %s, %d, %d, fit_readings_%s, %d,\n     {%s},\n     {%s},\n     {%s},\n     %s},\n' % (
            name, number(unit), cosine, kind, name, len(rows), ", ".join(map(number, best)),
            ", ".join(map(number, error)), ", ".join(map(number, limits)), number(spread)))
    out.write("};\n")
