#!/bin/sh
# SPDX-License-Identifier: MIT
# The tool's charts, read by Python's XML parser and zlib, if Python is installed.
. "$(dirname "$0")/../cli/check.sh"
command -v python3 >/dev/null || { skip what_python_reads "no python3"; finish; exit; }
cd "$scratch" || exit 1
cp "$root/examples/plate.toml" 'a<b&"c.toml'
"$tool" converge 'a<b&"c.toml' --azel 0,30 --seconds 0.5 --plot p.svg --plot p.png >/dev/null 2>&1
pair_scene >pair.toml
"$tool" converge pair.toml --azel 20,60 --seconds 0.5 --plot d.svg --csv d.csv >/dev/null 2>&1
python3 - <<'END' || not_ok the_python_ends_well
import csv, math
import xml.etree.ElementTree as tree
from png_file import Png
from tap import check
NS = "{http://www.w3.org/2000/svg}"
def words(svg):
    return ["".join(t.itertext()) for t in svg.iter(NS + "text")]
def spots(svg):
    for e in list(svg.iter(NS + "polyline")) + list(svg.iter(NS + "polygon")):
        for p in e.get("points").split():
            yield tuple(map(float, p.split(",")))
plate, pair = tree.parse("p.svg").getroot(), tree.parse("d.svg").getroot()
width, height = float(plate.get("width")), float(plate.get("height"))
check("title_keeps_what_xml_forbids", 'What accuracy costs in time: a<b&"c.toml' in words(plate))
check("axes_have_units", any("(ms)" in w for w in words(plate)) and any("relative" in w for w in words(plate)))
check("every_curve_has_a_legend", {"zbuffer N: bound", "zbuffer N: error", "exact: bound", "exact: error", "facet: bound",
      "facet: error", "truth's own bound"} <= set(words(plate)))
for name, svg in (("plate", plate), ("pair", pair)):
    check(name + "_stays_on_the_paper", all(0 <= x <= width and 0 <= y <= height for x, y in spots(svg)))
    check(name + "_words_begin_on_the_paper", all(0 <= float(t.get("x")) <= width and 0 <= float(t.get("y")) <= height
          for t in svg.iter(NS + "text")))
# The ticks calibrate the axes: every error and bound in the CSV has a marker where it should be.
def calibrate(anchor, pick):
    ticks = []
    for t in pair.iter(NS + "text"):
        text, span = t.text or "", t.find(NS + "tspan")
        if t.get("text-anchor") != anchor or t.get("transform"): continue
        try: value = float(text) ** (float(span.text) if span is not None else 1)
        except ValueError: continue
        ticks.append((math.log10(value), float(t.get(pick))))
    ticks.sort()
    (a, p), (b, q) = ticks[0], ticks[-1]
    return lambda value: p + (math.log10(value) - a) * (q - p) / (b - a)
at_x, at_y = calibrate("middle", "x"), calibrate("end", "y")
shift = 0.36 * 12  # a tick's text stands that far below its line
centres = []
for e in pair.iter(NS + "polygon"):
    p = [tuple(map(float, s.split(","))) for s in e.get("points").split()]
    if len(p) in (4, 24):
        centres.append((sum(x for x, y in p) / len(p), sum(y for x, y in p) / len(p)))
rows = list(csv.DictReader(open("d.csv")))
# An error below the truth's own bound stands on that line instead: the truth is the last row, exact.
floor = max(1e-9, float(rows[-1]["relative_bound"]))
wanted = [(float(r["pose_ms"]), float(r[k])) for r in rows for k in ("relative_error", "relative_bound")
          if "mesh" not in r["setting"] and (k, r["setting"][:11]) != ("relative_bound", "by estimate") and r[k] and float(r[k]) > floor]
check("pair_has_points_to_find", len(wanted) >= 10)
check("every_point_has_its_marker", all(any(math.hypot(at_x(x) - cx, at_y(y) - shift - cy) < 0.6 for cx, cy in centres)
      for x, y in wanted))
png = Png("p.png")
w, h = int(2 * width), int(2 * height)
rows = png.rows
check("png_sums_are_right", png.sums)
check("png_is_twice_the_size", png.head == (w, h, 8, 2, 0, 0, 0) and len(png.raw) == h * (3 * w + 1))
colours = {r[k:k + 3] for r in rows for k in range(0, 3 * w, 3)}
for name, rgb in (("white", "ffffff"), ("blue", "0072b2"), ("vermilion", "d55e00"), ("purple", "cc79a7")):
    check("png_has_" + name, bytes.fromhex(rgb) in colours)
check("png_margin_is_white", set(rows[0]) == {255} and all(set(r[:9]) == {255} and set(r[-9:]) == {255} for r in rows))
END
finish
