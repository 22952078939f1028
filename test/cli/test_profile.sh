#!/bin/sh
# SPDX-License-Identifier: MIT
# lrcs profile: tables, JSON, chart, options; and its bins against Python's, which cuts the visible
# polygons of lrcs run in fractions, and against closed forms and quadrature with mpmath.
. "$(dirname "$0")/check.sh"
cd "$scratch" || exit 1
plates_scene >pair.toml
pair_scene >boxes.toml

run profile pair.toml --bin 0.5
same a_table_comes "$rc $(printf '%s\n' "$out" | grep -c '^verdict')" "0 1"
same two_plates_have_two_ranges "$(printf '%s\n' "$out" | awk '/^  +-?[0-9.]+ +-?[0-9.]+ / && $3 > 0 { printf "%s ", $1 }')" "-1 0 "
run profile pair.toml --bin 0.5 --csv - --azel 20,30
same rows_have_a_header "$(printf '%s\n' "$out" | sed -n 2p)" "near_m,far_m,sigma_m2,bound_m2,sigma_glint_m2,sigma_diffuse_m2,density_m"
run profile pair.toml --bin 0.5 --csv rows.csv --azel 20,30 --plot chart.svg --pulse-fwhm 0.3
same the_first_line_says_what_of "$(sed -n 1p rows.csv | grep -cE '^# lrcs [0-9.]+ profile; scene_hash=[0-9a-f]{16}; title=pair.toml; options=--[^;]*; file=pair.toml fnv1a:[0-9a-f]{16} unit=m; direction=[-0-9.e]+,[-0-9.e]+,[-0-9.e]+; sigma_m2=[0-9.e]+; pulse_fwhm_m=[0-9.e-]+; bound_of_the_sum_m2=[-0-9.e]+; materials=illustrative or assumed$')" 1
same csv_and_chart_are_written "$rc $(sed -n 2p rows.csv | tr ',' '\n' | tail -2 | tr '\n' ' ')$(grep -c '</svg>' chart.svg)" "0 pulse_m pulse_bound_m 1"
run profile pair.toml --bin 0.5 --plot chart.png
same a_png_is_one "$rc $(head -c 4 chart.png | tail -c 3)" "0 PNG"
run profile pair.toml --bin 0.5 --json --pulse-fwhm 0.3
same json_has_its_keys "$(keys)" "schema version scene_hash files unit direction bin_m pulse_fwhm_m sigma_m2 sigma_glint_m2 sigma_diffuse_m2 bound_m2 normals curvature_estimate_m2 bound_refers_to tolerance notices title materials options bins "
run profile pair.toml --azel 0,-90 --bin 0.5
same what_shows_only_backs_has_no_bins "$rc $(printf '%s\n' "$out" | grep -c '; 0 bins of')" "0 1"

usage_error bins_need_a_width "give the width of the bins: --bin W, m" profile demo
usage_error no_width_of_0 "--bin: expected a length in m without unit, > 0, found '0'" profile demo --bin 0
usage_error no_negative_width "--bin: expected a length in m without unit, > 0, found '-1'" profile demo --bin -1
usage_error no_width_that_is_no_number "--bin" profile demo --bin nan
usage_error no_pulse_of_0 "--pulse-fwhm: expected a length in m without unit, > 0, found '0'" profile demo --bin 1 --pulse-fwhm 0
usage_error no_chart_of_another_kind "--plot: expected FILE.svg or FILE.png, found 'a.pdf'" profile demo --bin 1 --plot a.pdf
usage_error not_twice_to_stdout "--csv - and --json both want standard output" profile demo --bin 1 --csv - --json
usage_error not_over_the_scene "--csv pair.toml: would overwrite pair.toml" profile pair.toml --bin 1 --csv pair.toml
usage_error not_two_files_of_one_name "name the same file" profile demo --bin 1 --csv a.svg --plot a.svg
failure not_too_many_bins "bins of 1e-07 m: there would be more than 1048576" profile demo --bin 1e-7
failure not_too_fine_bins "bins of 1e-13 m: too fine for" profile demo --bin 1e-13
usage_error a_width_with_its_unit "--bin: expected a length in m without unit, > 0, found '5cm'" profile demo --bin 5cm
failure not_a_pulse_over_too_many "pulse of 1e+06 m reaches over more bins" profile demo --bin 1 --pulse-fwhm 1e6
run profile pair.toml --azel 50,40 --bin 0.1 --tolerance 1e-30 --json
same a_tolerance_given_and_missed_is_exit_3 "$rc $(printf '%s\n' "$out" | grep -c '"met": false')" "3 1"
same and_the_reason_is_said "$(printf '%s\n' "$err" | grep -c '^lrcs: the tolerance .* is missed$')" 1
run profile demo --azel 50,40 --bin 0.1 --json
same no_tolerance_no_judgement "$rc $(printf '%s\n' "$out" | grep -c '"asked": null')" "0 1"

if ! python3 -c 'import mpmath' 2>/dev/null; then
    skip the_bins_are_those_of_fractions 'no python3 with mpmath'
    finish
    exit
fi
for scene in boxes.toml pair.toml; do
    for pose in 0,90 50,40 -120,15; do
        name=$(basename $scene .toml)_$pose
        "$tool" run $scene --azel=$pose --method exact --polygons "$name.rings" --facets "$name.facets" --json >"$name.run" 2>/dev/null
        "$tool" profile $scene --azel=$pose --bin 0.05 --json >"$name.fine" 2>/dev/null
        "$tool" profile $scene --azel=$pose --bin 0.1 --pulse-fwhm 0.3 --json >"$name.json" 2>/dev/null
    done
done
cat >check.py <<'END'
import csv, glob, json, math
from fractions import Fraction as F
from mpmath import mp, mpf, sqrt
from tap import check
mp.dps = 40


def ranges_of(points, direction):
    """Exact up to 1e-40: the direction's length as a fraction."""
    d = [F(x) for x in direction]
    length = F(str(mp.nstr(sqrt(mpf(1) * sum(mpf(x.numerator) / x.denominator * mpf(x.numerator) / x.denominator for x in d)), 45)))
    return [-(d[0] * p[0] + d[1] * p[1] + d[2] * p[2]) / length for p in points]


def cut(polygon, z, sign):
    """What of a polygon, corners (u, v, range), has sign * (range - z) >= 0."""
    out = []
    for a, b in zip(polygon, polygon[1:] + polygon[:1]):
        s, t = sign * (a[2] - z), sign * (b[2] - z)
        if s >= 0:
            out.append(a)
        if (s > 0 and t < 0) or (s < 0 and t > 0):
            share = s / (s - t)
            out.append(tuple(x + share * (y - x) for x, y in zip(a, b)))
    return out


def area(polygon):
    return sum((a[0] * b[1] - a[1] * b[0] for a, b in zip(polygon, polygon[1:] + polygon[:1])), F(0)) / 2


for name in sorted(glob.glob("*.run")):
    base = name[:-4]
    run, fine, bins = (json.load(open(base + end)) for end in (".run", ".fine", ".json"))
    rate = {}
    for row in csv.DictReader(open(base + ".facets")):
        seen = float(row["visible_area_m2"])
        if float(row["sigma_m2"]) > 0 and seen > 0:
            rate[int(row["facet"])] = F(float(row["sigma_m2"])) / F(seen)
    rings = {}
    for row in csv.DictReader(open(base + ".rings")):
        if int(row["facet"]) in rate:
            ring = rings.setdefault((int(row["facet"]), int(row["ring"])), ([], []))
            ring[0].append([F(float(row[k])) for k in ("x_m", "y_m", "z_m")])
            ring[1].append([F(float(row[k])) for k in ("u_m", "v_m")])
    pieces = []
    for (facet, _), (body, view) in rings.items():
        # the facet's own plane is flat to rounding only: a fan of triangles
        z = ranges_of(body, run["direction"])
        corners = [(u, v, r) for (u, v), r in zip(view, z)]
        for i in range(2, len(corners)):
            pieces.append((rate[facet], [corners[0], corners[i - 1], corners[i]]))
    # what rounding of the rings' points and of facets.csv may add
    slack = 1e-12 * (run["sigma_m2"] + 1)

    def in_bin(pieces, near, far):
        total = 0
        for factor, triangle in pieces:
            low, high = min(c[2] for c in triangle), max(c[2] for c in triangle)
            if high < near or low >= far:
                continue
            part = cut(cut(triangle, near, 1), far, -1)
            if low == high:  # normal to the beam: wholly here
                part = triangle
            total += factor * area(part) if len(part) > 2 else 0
        return float(total)

    worst = ""
    sums = {}
    for b in fine["bins"]:
        want = in_bin(pieces, F(b["near_m"]), F(b["far_m"]))
        if abs(want - b["sigma_m2"]) > b["bound_m2"] + slack:
            worst = f"{base} {b['near_m']}: {b['sigma_m2']} +- {b['bound_m2']}, want {want}"
        k = round(b["near_m"] / 0.05) // 2
        sums.setdefault(k, []).append(b)
    check(f"the_bins_are_those_of_fractions_{base}", not worst and len(fine["bins"]) > 0, worst)
    total = sum(b["sigma_m2"] for b in fine["bins"])
    check(f"they_add_up_to_sigma_{base}",
          abs(total - run["sigma_m2"]) <= run["bound_m2"] + sum(b["bound_m2"] for b in fine["bins"])
          and abs(fine["sigma_m2"] - run["sigma_m2"]) <= run["bound_m2"] + fine["bound_m2"],
          f"{total} {fine['sigma_m2']} {run['sigma_m2']}")
    worst = ""
    for b in bins["bins"]:
        halves = sums.get(round(b["near_m"] / 0.1), [])
        got = sum(h["sigma_m2"] for h in halves)
        if abs(got - b["sigma_m2"]) > b["bound_m2"] + sum(h["bound_m2"] for h in halves) + 1e-15:
            worst = f"{b} against {halves}"
    check(f"a_bin_is_the_sum_of_its_halves_{base}", not worst, worst)

    # The pulse: bins of 1/16 of its deviation, each as a uniform density; what that is off by falls
    # with the square of their width, and is allowed for beside the bound. Plain doubles are enough.
    d = 0.3 / (2 * math.sqrt(2 * math.log(2)))
    plain = [(float(factor), [tuple(map(float, c)) for c in t]) for factor, t in pieces]
    low = math.floor(min(c[2] for _, t in plain for c in t) * 128)
    high = math.floor(max(c[2] for _, t in plain for c in t) * 128)
    cells = [(k / 128, in_bin(plain, k / 128, (k + 1) / 128)) for k in range(low, high + 1)]
    worst = ""
    peak = max(b["pulse_m"] for b in bins["bins"])
    for b in bins["bins"][::5]:
        z = (b["near_m"] + b["far_m"]) / 2
        want = sum(s * 64 * (math.erf((z - x) / d / math.sqrt(2)) - math.erf((z - x - 1 / 128) / d / math.sqrt(2)))
                   for x, s in cells if abs(z - x) < 2)
        allowed = b["pulse_bound_m"] + (0.03 if base.endswith("0,90") else 1e-3) * peak
        if abs(want - b["pulse_m"]) > allowed:
            worst = f"{base} at {z}: {b['pulse_m']} +- {b['pulse_bound_m']}, want {want}"
        if b["pulse_bound_m"] > 1e-4 * peak:
            worst = f"bound {b['pulse_bound_m']} of {peak}"
    check(f"the_pulse_is_that_of_fine_bins_{base}", not worst, worst)
END
python3 check.py || not_ok python_ran

# Curved shapes against closed forms and quadrature: the bounds hold of the true shapes.
shape() { # NAME KEYS: a scene of one shape that stands off the origin
    printf '[[part]]\nname = "%s"\nshape = "%s"\n%s\ntranslate = [0.3, -0.2, 0.17]\n' "$1" "$1" "$2" >"$1.toml"
}
shape sphere 'radius = 1'
shape cone 'radius = 0.5
half_angle_deg = 20'
shape cylinder 'radius = 0.5
length = 2'
{
    cat sphere.toml
    printf '[[part]]\nname = "roof"\nshape = "plate"\nsize = [4, 4]\ntranslate = [2.3, -0.2, 3]\n'
} >half.toml
for tolerance in 1e-2 1e-3; do
    for bin in 0.2 0.03; do
        "$tool" profile sphere.toml --bin $bin --azel 20,35 --tolerance $tolerance --json --pulse-fwhm 0.3 >"sphere.$bin.$tolerance.curved" 2>/dev/null
        "$tool" profile half.toml --bin $bin --tolerance $tolerance --json >"half.$bin.$tolerance.curved" 2>/dev/null
        "$tool" profile cone.toml --bin $bin --tolerance $tolerance --json >"cone.$bin.$tolerance.curved" 2>/dev/null
        "$tool" profile cylinder.toml --bin $bin --azel 30,0 --tolerance $tolerance --json >"cylinder.$bin.$tolerance.curved" 2>/dev/null
    done
done
cat >curved.py <<'END'
import functools, glob, json
from mpmath import mp, mpf, quad, exp, cos, sin, acos, sqrt, log, pi, tan, radians
from tap import check
mp.dps = 20
A, B, S, M = mpf(1), mpf("0.25"), mpf("0.2"), mpf("0.5")


def f(c):
    return A / c**6 * exp(-(1 / c**2 - 1) / S**2) + B * c**M if c > 0 else mpf(0)


def clip(x, low, high):
    return min(max(x, low), high)


@functools.cache
def sphere(a, b):  # ranges from its centre
    low, high = clip(-b, 0, 1), clip(-a, 0, 1)
    return 8 * pi**2 * quad(lambda c: f(c) * c * c, [low, (low + high) / 2, high]) if high > low else mpf(0)


@functools.cache
def cone(a, b):  # from the apex
    al = radians(mpf(20))
    end = mpf("0.5") / tan(al)
    r = [clip(z, 0, end) * tan(al) for z in (a, b)]
    return 4 * pi * f(sin(al)) * sin(al) * pi * (r[1]**2 - r[0]**2)


@functools.cache
def cylinder(a, b):  # from its axis, seen from the side
    low, high = acos(clip(-a * 2, 0, 1)), acos(clip(-b * 2, 0, 1))
    return 2 * 4 * pi * mpf("0.5") * 2 * quad(lambda p: f(cos(p)) * cos(p)**2, [low, (low + high) / 2, high]) if high > low else mpf(0)


shift = [mpf("0.3"), mpf("-0.2"), mpf("0.17")]
for name in sorted(glob.glob("*.curved")):
    got = json.load(open(name))
    kind = name.split(".")[0]
    d = [mpf(x) for x in got["direction"]]
    at = -sum(x * y for x, y in zip(shift, d))
    worst, total, apart = "", mpf(0), mpf(0)
    for b in got["bins"]:
        k = round(b["near_m"] / got["bin_m"])
        near, far = mpf(k * got["bin_m"]), mpf((k + 1) * got["bin_m"])
        if kind == "half" and far < -2.5:  # the roof
            continue
        if kind == "sphere":
            want = sphere(near - at, far - at)
        elif kind == "half":
            want = sphere(near - at, far - at) / 2
        elif kind == "cone":
            apex = at - mpf("0.5") / tan(radians(mpf(20)))
            want = cone(near - apex, far - apex)
        else:
            want = cylinder(near - at, far - at)
        total += want
        apart = max(apart, b["bound_m2"])
        if not abs(want - b["sigma_m2"]) <= b["bound_m2"] + 1e-13:
            worst = f"{name} at {b['near_m']}: {b['sigma_m2']} +- {b['bound_m2']}, want {want}"
    fine = name.endswith("1e-3.curved")
    check("bins_of_a_true_" + name, not worst and total > 0, worst or "empty")
    check("their_bounds_tell_something_" + name, apart < (0.02 if fine else 0.3) * got["sigma_m2"], f"{apart} of {got['sigma_m2']}")
    check("the_bound_is_of_the_true_shape_" + name, got["bound_refers_to"].endswith("true curved shapes"), got["bound_refers_to"])
    if kind != "half":
        check("their_sum_is_sigma_" + name, abs(total - got["sigma_m2"]) <= got["bound_m2"] + 1e-13, f"{total} {got['sigma_m2']} {got['bound_m2']}")

got = json.load(open("sphere.0.2.1e-3.curved"))
at = -sum(x * mpf(y) for x, y in zip(shift, got["direction"]))
d = mpf("0.3") / (2 * sqrt(2 * log(2)))
worst = ""
for b in got["bins"]:
    z = (mpf(b["near_m"]) + mpf(b["far_m"])) / 2 - at
    want = 8 * pi**2 * quad(lambda c: f(c) * c * c * exp(-((z + c) / d)**2 / 2), [0, 0.25, 0.5, 0.75, 0.9, 1]) / d / sqrt(2 * pi)
    if not abs(want - b["pulse_m"]) <= b["pulse_bound_m"] + 1e-12:
        worst = f"{z}: {b['pulse_m']} +- {b['pulse_bound_m']}, want {want}"
check("a_pulse_on_a_true_sphere", not worst, worst)
END
python3 curved.py || not_ok python_ran

# Curved normals: against quadrature over the visible polygons, cut by Python; and on meshes of a
# sphere and a cone, whose bins approach the closed forms with the square of the facets' size.
cat >meshes.py <<'END'
from math import cos, sin, pi, tan, radians


def sphere(n):
    lines, number, before = [], 1, None
    for i in range(n + 1):
        t = pi * i / n
        ring = [(sin(t) * cos(pi * k / n), sin(t) * sin(pi * k / n), cos(t)) for k in range(2 * n)]
        ring = ring if 0 < i < n else [(0.0, 0.0, cos(t))]
        lines += ["v %r %r %r\nvn %r %r %r" % (*x, *x) for x in ring]
        here = list(range(number, number + len(ring)))
        number += len(ring)
        for k in range(2 * n if before else 0):
            a, b = before[k % len(before)], before[(k + 1) % len(before)]
            c, d = here[k % len(here)], here[(k + 1) % len(here)]
            corners = [a, c, d] if len(before) == 1 else [a, c, b] if len(here) == 1 else [a, c, d, b]
            lines.append("f " + " ".join("%d//%d" % (v, v) for v in corners))
        before = here
    return lines


def cone(n):
    # the apex once for each facet: its normal there is that of the facet's middle
    al = radians(20)
    end = 0.5 / tan(al)
    lines = []
    for k in range(n):
        a, b, c = (2 * pi * (k + s) / n for s in (0, 1, 0.5))
        for x, p in (((0.0, 0.0, end), c), ((0.5 * cos(a), 0.5 * sin(a), 0.0), a), ((0.5 * cos(b), 0.5 * sin(b), 0.0), b)):
            lines.append("v %r %r %r\nvn %r %r %r" % (*x, cos(al) * cos(p), cos(al) * sin(p), sin(al)))
        lines.append("f -3//-3 -2//-2 -1//-1")
    return lines


def wall(n):
    # of a cylinder about z, and a plate that hides some of it
    lines = []
    for k in range(2 * n):
        x, y = cos(2 * pi * (k % n) / n), sin(2 * pi * (k % n) / n)
        lines.append("v %r %r %r\nvn %r %r 0" % (0.5 * x, 0.5 * y, -1 if k < n else 1, x, y))
    for k in range(1, n + 1):
        m = k % n + 1
        lines.append("f " + " ".join("%d//%d" % (v, v) for v in (k, m, n + m, n + k)))
    return lines + ["v 2 -0.1 -0.7\nv 2.3 1.3 -0.7\nv 2.3 1.3 0.4\nv 2 -0.1 0.4\nf -4 -3 -2 -1"]


for n in (24, 48):
    for name, lines in (("ball%d" % n, sphere(n)), ("cone%d" % n, cone(2 * n)), ("wall", wall(12))):
        open(name + ".obj", "w").write("\n".join(lines) + "\n")
END
python3 meshes.py || not_ok python_ran
for n in 24 48; do
    "$tool" profile ball$n.obj --normals smooth --bin 0.25 --azel 20,35 --json >ball$n.mesh 2>/dev/null
    "$tool" profile cone$n.obj --normals smooth --bin 0.25 --json >cone$n.mesh 2>/dev/null
done
"$tool" run wall.obj --material 1,0.25,0.2,1 --normals smooth --method exact --azel 12,20 --polygons wall.rings --facets wall.facets --json >wall.whole 2>/dev/null
"$tool" profile wall.obj --material 1,0.25,0.2,1 --normals smooth --azel 12,20 --bin 0.07 --json >wall.bins 2>/dev/null
"$tool" profile wall.obj --normals smooth --azel 12,20 --bin 0.07 --pulse-fwhm 0.3 --csv wall.csv >wall.text 2>/dev/null
same text_says_what_is_estimated "$(grep -c 'Estimated, not proved: the integral over curved normals' wall.text)" 1
same rows_carry_the_estimate "$(sed -n 2p wall.csv)" "near_m,far_m,sigma_m2,bound_m2,sigma_glint_m2,sigma_diffuse_m2,density_m,pulse_m,pulse_bound_m,curvature_estimate_m2,pulse_estimate_m"
run profile wall.obj --normals auto --bin 0.5 --json
same auto_curves_what_its_glint_needs "$rc $(printf '%s\n' "$out" | grep -c '"normals": "auto"')$(printf '%s\n' "$out" | grep -c '^  "curvature_estimate_m2": [0-9]')" "0 11"
usage_error no_normals_of_another_kind "--normals: expected flat, auto or smooth, found 'round'" profile demo --bin 1 --normals round
cat >smooth.py <<'END'
import csv, json
from math import cos as fcos, sin as fsin, exp as fexp, hypot, pi as fpi
exec(open("curved.py").read().split("shift =")[0])
for kind, truth, start in (("ball", sphere, mpf(0)), ("cone", cone, -mpf("0.5") / tan(radians(mpf(20))))):
    error = []
    for n in ("24", "48"):
        got = json.load(open(kind + n + ".mesh"))
        off = [abs(float(truth(b["near_m"] - start, b["far_m"] - start)) - b["sigma_m2"]) for b in got["bins"]]
        error.append(max(off) / got["sigma_m2"])
    check(f"bins_of_a_smooth_{kind}_approach_its_closed_form", 0 < error[1] < 0.35 * error[0] < 0.01, error)

# Gauss on [0, 1], 8 points
AT = [0.019855071751231884, 0.101666761293186630, 0.237233795041835507, 0.408282678752175098]
AT += [1 - x for x in reversed(AT)]
W = [0.050614268145188130, 0.111190517226687235, 0.156853322938943644, 0.181341891689180991]
W += W[::-1]


def reflected(n):
    if n[2] <= 0:
        return 0.0
    tan2 = (n[0] * n[0] + n[1] * n[1]) / (n[2] * n[2])
    c = (1 + tan2) ** -0.5
    return fexp(-tan2 / 0.04) / c**5 + 0.25 * c * c


def over(a, b, c, depth=2):
    """4 pi times the integral over a triangle of (u, v, range, normal), in 4^depth parts."""
    if depth > 0:
        m = [tuple((x + y) / 2 for x, y in zip(p, q)) for p, q in ((a, b), (b, c), (c, a))]
        return sum(over(*t, depth - 1) for t in ((a, m[0], m[2]), (m[0], b, m[1]), (m[2], m[1], c), tuple(m)))
    twice = abs((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
    total = 0.0
    for i, s in enumerate(AT):
        for k, q in enumerate(AT):
            t = (1 - s) * q
            total += W[i] * W[k] * (1 - s) * reflected([a[j] * (1 - s - t) + b[j] * s + c[j] * t for j in (3, 4, 5)])
    return 4 * fpi * twice * total


def cut(polygon, z, sign, key=2):
    out = []
    for a, b in zip(polygon, polygon[1:] + polygon[:1]):
        s, t = sign * (a[key] - z), sign * (b[key] - z)
        if s >= 0:
            out.append(a)
        if (s > 0 and t < 0) or (s < 0 and t > 0):
            out.append(tuple(x + s / (s - t) * (y - x) for x, y in zip(a, b)))
    return out


run, got = json.load(open("wall.whole")), json.load(open("wall.bins"))
d = run["direction"]
d = [x / (d[0]**2 + d[1]**2 + d[2]**2)**0.5 for x in d]
right = [-d[1] / hypot(d[0], d[1]), d[0] / hypot(d[0], d[1]), 0.0]
up = [d[1] * right[2] - d[2] * right[1], d[2] * right[0] - d[0] * right[2], d[0] * right[1] - d[1] * right[0]]
rate = {}
for row in csv.DictReader(open("wall.facets")):
    if float(row["visible_area_m2"]) > 0 and float(row["sigma_m2"]) > 0:  # what is seen of fronts
        rate[int(row["facet"])] = float(row["sigma_m2"]) / float(row["visible_area_m2"])
rings = {}
for row in csv.DictReader(open("wall.rings")):
    if int(row["facet"]) in rate:
        rings.setdefault((int(row["facet"]), int(row["ring"])), []).append([float(row[k]) for k in ("x_m", "y_m", "z_m")])
pieces = []
for (facet, _), ring in rings.items():
    curved = facet < 24
    # on the wall, normals are linear along the chord of the facet
    a, b = ((fcos(fpi * k / 6), fsin(fpi * k / 6)) for k in (facet // 2, facet // 2 + 1))
    e = (b[0] - a[0], b[1] - a[1])
    corners = []
    for x in ring:
        s = ((x[0] - 0.5 * a[0]) * e[0] + (x[1] - 0.5 * a[1]) * e[1]) / (0.5 * (e[0]**2 + e[1]**2))
        n = (a[0] + s * e[0], a[1] + s * e[1], 0.0)
        place, normal = ([sum(p * q for p, q in zip(axis, v)) for axis in (right, up, d)] for v in (x, n))
        corners.append((place[0], place[1], -place[2], *normal))
    pieces += [(curved, rate[facet], [corners[0], corners[i - 1], corners[i]]) for i in range(2, len(corners))]
worst, seen = "", 0
for row in got["bins"]:
    want = 0.0
    for curved, factor, triangle in pieces:
        part = cut(cut(triangle, row["near_m"], 1), row["far_m"], -1)
        part = cut(part, 0.0, 1, 5) if curved else part  # normals that face the laser
        for p, q in zip(part[1:], part[2:]):
            r = part[0]
            area = abs((p[0] - r[0]) * (q[1] - r[1]) - (p[1] - r[1]) * (q[0] - r[0])) / 2
            want += over(r, p, q) if curved else factor * area
    seen += want > 0
    if abs(want - row["sigma_m2"]) > row["bound_m2"] + row["curvature_estimate_m2"] + 1e-12:
        worst = f"{row} want {want}"
check("bins_with_curved_normals_are_those_of_cut_polygons", not worst and seen > 5, worst or seen)
check("their_sum_is_that_of_run", abs(got["sigma_m2"] - run["sigma_m2"]) <= got["bound_m2"] + run["bound_m2"] + got["curvature_estimate_m2"] + run["curvature_estimate_m2"], (got["sigma_m2"], run["sigma_m2"]))
check("the_estimate_is_small", 0 < got["curvature_estimate_m2"] < 1e-6 * got["sigma_m2"], got["curvature_estimate_m2"])
END
python3 smooth.py || not_ok python_ran
finish
