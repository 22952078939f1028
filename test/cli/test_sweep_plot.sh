#!/bin/sh
# SPDX-License-Identifier: MIT
# lrcs sweep --plot: what it refuses, and that points are drawn where the rows put them: Python's XML
# parser reads ticks and curves, the rows are the sweep's own CSV.
. "$(dirname "$0")/check.sh"
cd "$scratch" || exit 1
printf '[[part]]\nname = "bus"\nshape = "box"\nsize = [1, 1.5, 2]\n' >box.toml
printf '[[part]]\nname = "wing"\nshape = "plate"\nsize = [2, 1]\n' >plate.toml

cut="sweep box.toml --tolerance 0.01 --az 0:90:2 --el 10"
usage_error a_plot_is_svg_or_png "--plot: expected FILE.svg or FILE.png, found 'x.pdf'" $cut --plot x.pdf
usage_error dbsm_wants_a_plot "--dbsm needs --plot" $cut --dbsm
usage_error polar_wants_a_plot "--polar needs --plot" $cut --polar
usage_error a_sphere_is_a_map "--plot: the directions of --sphere are drawn as a map" sweep box.toml --sphere 10 --plot x.svg --polar
usage_error a_shard_is_not_whole "--plot needs the whole sweep: leave out --shard" $cut --shard 1/2 --plot x.svg
usage_error three_things_are_too_many "--plot: expected one or two quantities that vary, found 3" \
    sweep box.toml --az 0:4:2 --el 0:4:2 --vary bus.size_x:1:2:1 --plot x.svg
usage_error one_row_is_no_curve "--plot: expected one or two quantities that vary, found 0" sweep box.toml --az 0 --plot x.svg
usage_error a_polar_map_is_too_much "--polar: expected at most 7 curves, found 8" \
    sweep box.toml --az 0:90:10 --el 0:70:10 --polar --plot x.svg
usage_error polar_wants_an_angle "--polar: the values along the curves must be angles, found 'bus.size_x'" \
    sweep box.toml --vary bus.size_x:1:2:0.5 --polar --plot x.svg
{ echo time,x,y,z; for t in 1 2 3 4 5 7 6 8; do echo "$t,1,$t,0"; done; } >turned.csv
usage_error a_map_wants_times_that_ascend "--plot: a map needs poses in the order of their times" \
    sweep box.toml --poses turned.csv --vary bus.size_x:1:9:1 --plot x.svg
usage_error not_one_plot_twice "--plot and --plot name the same file" $cut --plot x.svg --plot ./x.svg
printf 'time,x,y,z\n0,1,0,0\n1,1,1,0\n3,0,1,0.5\n' >track.csv
ln -s track.csv track.svg
usage_error not_over_the_poses "--plot track.svg: would overwrite the poses" sweep box.toml --poses track.csv --plot track.svg
ln -s box.toml box.svg
usage_error not_over_the_scene "--plot box.svg: would overwrite box.toml" $cut --plot box.svg
same nothing_was_written "$(ls x.svg 2>/dev/null)" ""
failure a_folder_that_is_not_there "none/x.svg" $cut -o c.csv --plot none/x.svg
same is_told_before_the_work "$(ls c.csv* 2>/dev/null)" ""

run $cut -o line.csv --plot line.svg --plot line.png
same a_curve_is_drawn "$rc" 0
run $cut -o line.csv --resume --plot again.svg
same a_whole_sweep_is_drawn_from_its_rows "$rc $(cmp line.svg again.svg && echo same)" "0 same"
head -c 1500 line.csv >half.csv.partial
run $cut -o half.csv --resume --plot half.svg
same a_resumed_sweep_is_drawn_whole "$rc $(cmp line.svg half.svg && echo same)" "0 same"
run sweep box.toml --tolerance 0.01 --el 0:60:30 --az 0:180:5 -o few.csv --dbsm --plot few.svg
run sweep box.toml --tolerance 0.01 --az 0:360:5 --el 30 -o polar.csv --polar --plot polar.svg
run sweep box.toml --tolerance 0.01 --az 0:90:5 --el -45:45:5 -o map.csv --plot map.svg --plot map.png
run sweep box.toml --tolerance 0.01 --az 90:0:-5 --el -45:45:5 -o back.csv --plot back.svg
run sweep plate.toml --tolerance 0.01 --azel 90,0 --rotate x:0:180:5 -o dark.csv --dbsm --plot dark.svg
same a_plot_may_have_gaps "$rc" 0
run sweep box.toml --tolerance 0.01 --poses track.csv -o track.out.csv --plot time.svg
same a_track_is_drawn_over_time "$rc $(grep -c '>time (s)<' time.svg)" "0 1"

command -v python3 >/dev/null || { skip what_python_reads "no python3"; finish; exit; }
python3 - <<'END' || not_ok the_python_ends_well
import csv, math, struct, sys
import xml.etree.ElementTree as tree
from tap import check
NS = "{http://www.w3.org/2000/svg}"
def table(path):
    return list(csv.DictReader(l for l in open(path) if not l.startswith("#")))
def spots(e):
    return [tuple(map(float, s.split(","))) for s in e.get("points").split()]
class Svg:
    def __init__(self, path):
        self.root = tree.parse(path).getroot()
        self.texts = [(t.text, t.get("text-anchor"), float(t.get("x")), float(t.get("y")), t.get("transform"))
                      for t in self.root.iter(NS + "text")]
        self.words = [t[0] for t in self.texts]
        self.lines = [(e, spots(e)) for e in self.root.iter(NS + "polyline")]
        self.areas = [(e.get("fill"), spots(e)) for e in self.root.iter(NS + "polygon")]
    def scale(self, anchor, k, most=1e9):  # ticks calibrate an axis; k: 0 for x, 1 for y
        ticks = []
        for text, kind, x, y, turned in self.texts:
            try: value = float(text)
            except ValueError: continue
            if kind == anchor and not turned and x < most: ticks.append((value, x if k == 0 else y - 0.36 * 12))
        ticks.sort()
        (a, p), (b, q) = ticks[0], ticks[-1]
        return lambda value: p + (value - a) * (q - p) / (b - a)
    def curve(self, colour):  # runs share their ends
        out = []
        for e, p in self.lines:
            if e.get("stroke") == colour and float(e.get("stroke-width")) == 1.7 and len(p) > 2: out += p
        return out
def near(a, b, most=0.03):
    return len(a) == len(b) and all(math.hypot(x - u, y - v) < most for (x, y), (u, v) in zip(a, b))

line, rows = Svg("line.svg"), table("line.csv")
x, y = line.scale("middle", 0), line.scale("end", 1)
check("curve_stands_where_its_rows_say", near(line.curve("#0072b2"), [(x(float(r["az_deg"])), y(float(r["sigma_m2"]))) for r in rows]))
check("axes_have_names_and_units", {"azimuth (deg)", "sigma (m2)"} <= set(line.words))
check("one_curve_needs_no_legend", "elevation 10 deg" not in line.words)
check("the_note_says_what_stood_still", any(w.startswith("elevation 10 deg; each sigma is proved to within") for w in line.words))
check("sigma_begins_at_0", "0" in [t[0] for t in line.texts if t[1] == "end"])

few, rows = Svg("few.svg"), table("few.csv")
x, y = few.scale("middle", 0), few.scale("end", 1)
for el, colour in ((0, "#0072b2"), (30, "#d55e00"), (60, "#009e73")):
    want = [(x(float(r["az_deg"])), y(float(r["sigma_dbsm"]))) for r in rows if float(r["el_deg"]) == el]
    check("curve_of_elevation_%d" % el, near(few.curve(colour), want))
check("angles_have_ticks_of_a_turn", {"0", "90", "180"} <= set(few.words))
check("curves_have_a_legend", {"elevation 0 deg", "elevation 30 deg", "elevation 60 deg", "sigma (dBsm)"} <= set(few.words))

polar, rows = Svg("polar.svg"), table("polar.csv")
pole = [p for e, p in polar.lines if e.get("stroke") == "#d9d9d9" and len(p) == 2][0][0]
curve = polar.curve("#0072b2")
at = [(math.hypot(u - pole[0], v - pole[1]), math.degrees(math.atan2(pole[1] - v, u - pole[0])) % 360) for u, v in curve]
unit = at[0][0] / float(rows[0]["sigma_m2"])
check("polar_distance_is_sigma", len(at) == len(rows) and all(abs(d - unit * float(r["sigma_m2"])) < 0.05 for (d, a), r in zip(at, rows)))
check("polar_angle_is_the_azimuth", all(abs((a - float(r["az_deg"]) + 180) % 360 - 180) < 0.2 for (d, a), r in zip(at, rows)))
rings = sorted({round(math.hypot(p[0][0] - pole[0], p[0][1] - pole[1]), 1) for e, p in polar.lines if len(p) == 181})
labels = sorted(float(t) for t, k, u, v, w in polar.texts if k == "middle" and t not in [str(d) for d in range(0, 360, 30)])
check("polar_rings_are_where_their_numbers_say", len(rings) >= 2 and abs(rings[-1] - unit * (labels[-1] if labels else 0)) < 0.2)
check("polar_says_what_the_pole_is", "radius: sigma (m2); centre: 0 m2" in polar.words and "angle: azimuth (deg)" in polar.words)

def viridis(t):
    knots = [(68, 1, 84), (71, 44, 122), (59, 81, 139), (44, 113, 142), (33, 144, 141), (39, 173, 129),
             (92, 200, 99), (170, 220, 50), (253, 231, 37)]
    i = min(int(8 * t), 7)
    return tuple(a + (8 * t - i) * (b - a) for a, b in zip(knots[i], knots[i + 1]))
shown, rows = Svg("map.svg"), table("map.csv")
x, y = shown.scale("middle", 0), shown.scale("end", 1)
bar = sorted(float(t[0]) for t in shown.texts if t[1] == "start" and t[2] > 740 and not t[4])
z = {(float(r["az_deg"]), float(r["el_deg"])): float(r["sigma_m2"]) for r in rows}
def colour_at(u, v):
    found = None
    for fill, p in shown.areas:
        if p[0][0] - 1e-9 <= u <= p[1][0] and min(p[0][1], p[2][1]) <= v <= max(p[0][1], p[2][1]): found = fill
    return tuple(bytes.fromhex(found[1:]))
wrong = sum(any(abs(a - b) > 3 for a, b in zip(colour_at(min(max(x(az), x(0) + 1), x(90) - 1), min(max(y(el), y(45) + 1), y(-45) - 1)),
            viridis((value - bar[0]) / (bar[-1] - bar[0])))) for (az, el), value in z.items())
check("map_has_the_colours_of_its_rows", wrong == 0)
check("map_has_names_and_units", {"azimuth (deg)", "elevation (deg)", "sigma (m2)"} <= set(shown.words))
def along(u, v):  # sigma between points, bilinear
    az, el = min(max((u - x(0)) / (x(90) - x(0)) * 90, 0), 90), min(max((v - y(-45)) / (y(45) - y(-45)) * 90 - 45, -45), 45)
    a, b = min(5 * int(az // 5), 85), min(5 * math.floor(el / 5), 40)
    s, t = (az - a) / 5, (el - b) / 5
    return (1 - t) * ((1 - s) * z[a, b] + s * z[a + 5, b]) + t * ((1 - s) * z[a, b + 5] + s * z[a + 5, b + 5])
ends = [q for e, p in shown.lines if e.get("stroke") in ("#ffffff", "#333333") for q in p]
check("contours_run_along_levels", len(ends) > 100 and all(min(abs(along(*q) - level) for level in bar) < 2e-3 * (bar[-1] - bar[0]) for q in ends))
back = Svg("back.svg")
check("a_range_that_descends_is_the_same_map", sorted(map(str, back.areas)) == sorted(map(str, shown.areas)))

dark = table("dark.csv")
drawn = [p for e, p in Svg("dark.svg").lines if e.get("stroke") == "#0072b2"]
gaps = sum(not r["sigma_dbsm"] for r in dark)
check("the_note_says_what_gaps_are", any(w.endswith("; gaps: sigma is 0") for w in Svg("dark.svg").words))
check("what_returns_nothing_is_a_gap", gaps > 0 and not any(abs(a[0] - b[0]) > 40 for p in drawn for a, b in zip(p, p[1:])))
for name in ("line", "map"):
    data = open(name + ".png", "rb").read(24)
    check(name + "_png_is_twice_the_size", data[:4] == b"\x89PNG" and struct.unpack(">II", data[16:]) == (1720, 1040))
END
finish
