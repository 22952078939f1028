#!/bin/sh
# SPDX-License-Identifier: MIT
# lrcs sweep --stats: mean by solid angle, percentiles, least and most, against the rows themselves.
. "$(dirname "$0")/check.sh"
cd "$scratch" || exit 1
box_scene >box.toml
stat() { printf '%s\n' "$1" | sed -n "s/^  $2  *\([0-9.e+-]*\) m2.*/\1/p"; }

# The mean over all directions of a convex body of one material: 22 m2, B = 0.25, m = 0, A = 0:
# 22 2 pi 0.25 / 3 = 11.5191730632.
run sweep box.toml --az 0:360:3 --el -90:90:3 --material 0,0.25,0.2,0 -o grid.csv --stats
same a_grid_is_weighed_by_solid_angle "$(awk -v a="$(stat "$out" mean)" 'BEGIN { d = a / 11.5191730632 - 1; print (a != "" && d * d < 1e-6) }')" 1
plain=$(grep '^[0-9]' grid.csv | awk -F, '{ s += $4 } END { d = s / NR / 11.5191730632 - 1; print (d * d < 1e-6) }')
same a_plain_mean_would_not_do "$plain" 0
same least_and_most_have_their_attitudes "$(printf '%s\n' "$out" | grep -c '^  \(least\|most\) .* at az_deg = [0-9.-]*, el_deg = [0-9.-]*$')" 2
run sweep box.toml --sphere 500 -o ball.csv --stats
near the_mean_of_a_sphere_is_that_of_its_rows "$(awk -v a="$(stat "$out" mean)" -v b="$(sed -n 's/^# mean_sigma_m2=\([^;]*\);.*/\1/p' ball.csv)" 'BEGIN { d = a / b - 1; print (d * d < 1e-16) }')" 1
sorted() { grep '^[0-9]' ball.csv | cut -d, -f5 | sort -g | sed -n "$1p"; }
for part in least:1 '5 %:25' '50 %:250' '99 %:495' most:500; do
    same "${part%:*}_is_row_${part#*:}_of_500" "$(awk -v a="$(stat "$out" "${part%:*}")" -v b="$(sorted "${part#*:}")" 'BEGIN { d = a / b - 1; print (d * d < 1e-16) }')" 1
done
run sweep box.toml --az 0:90:10 --stats
same without_a_file_stdout_is_for_rows "$(printf '%s\n' "$out" | grep -c statistics) $(printf '%s\n' "$err" | grep -c '^statistics   10 rows')" "0 1"
run sweep box.toml --az 0 --el -90:270:30 --stats
same a_cut_is_weighed_alike "$(printf '%s\n' "$err" | grep -c 'rows, all alike: a cut stands for no solid angle')" 1
usage_error a_statistics_file_has_a_form "--stats-file: expected FILE.json, .csv, .svg or .png, found 'x.pdf'" sweep box.toml --sphere 9 --stats-file x.pdf
usage_error rows_and_statistics_are_two_files "name the same file" sweep box.toml --sphere 9 -o x.csv --stats-file ./x.csv
usage_error of_a_shard_nothing_is_known "--stats needs the whole sweep: leave out --shard" sweep box.toml --az 0:90:10 --shard 1/2 --stats

# A ball returns the same everywhere; a plate returns 4 pi B cos^2 on one half of all directions, of
# which cos is spread evenly: a share (1 + sqrt(sigma / 4 pi B)) / 2 is at most sigma.
printf '[[part]]\nname = "ball"\nshape = "sphere"\nradius = 1\n' >sphere.toml
printf '[[part]]\nname = "plate"\nshape = "plate"\nsize = [1, 1]\n' >plate.toml
run sweep sphere.toml --material 1,0.25,0.2,0.5 --sphere 50 -o s.csv --stats-file s.json --stats-file s.svg
run sweep plate.toml --material 0,0.25,0.2,0 --sphere 4000 -o p.csv --stats-file p.json --stats-file p.csv.csv
run sweep plate.toml --azel 0,-90 --rotate z:0:90:30 --stats-file dark.svg
same nothing_is_drawn_of_nothing "$rc $(ls dark.svg 2>/dev/null) $(printf '%s\n' "$err" | grep -c 'sigma of every row is 0')" "1  1"
pair_scene >pair.toml
run sweep pair.toml --az -180:180:30 --el -90:90:15 --method zbuffer --resolution 32 -o z.csv --stats-file z.json --stats-file z.csv.csv --stats-file z.png
run sweep pair.toml --az -180:180:30 --el -90:90:15 --tolerance 1e-6 -o exact.csv
# One uncertain amplitude moves all rows by the same factor; two amplitudes move them together at
# most: the band of the mean is no narrower than its deviation.
run sweep box.toml --az 0:360:10 --el -90:90:10 --material 0,0.25+-0.05,0.2,0 -o one.csv --stats --stats-file one.json --stats-file one.csv.csv --stats-file one.svg
same text_has_the_band_of_materials "$(printf '%s\n' "$out" | grep -c ';  materials [0-9.e+-]* .. [0-9.e+-]* m2$') $(printf '%s\n' "$out" | grep -c 'materials: 68 % by their errors')" "12 1"
same a_chart_has_a_band "$(grep -c 'shaded: 68 % by the errors of materials' one.svg) $(grep -c '<polygon fill="#bfdcec"' one.svg | awk '{ print ($1 > 5) }')" "1 1"
run plot one.csv --stats-file again.json --stats-file again.svg
same statistics_of_the_file_have_the_same_band "$rc $(cmp one.json again.json && cmp one.svg again.svg && echo same)" "0 same"
run sweep box.toml --az 0:360:10 --el -90:90:10 --material 1+-0.1,0.25+-0.03,0.2,0.5 -o two.csv --stats-file two.json
run sweep box.toml --az 0:360:10 --el -90:90:10 --material 1,0.25+-0.03,0.2,0.5 -o twob.csv --stats-file twob.json
run sweep box.toml --az 0:360:10 --el -90:90:10 --material 1+-0.1,0.25,0.2,0.5 -o twoa.csv --stats-file twoa.json
run sweep box.toml --az 0:90:10 --stats --stats-file none.json -o none.csv
same without_errors_there_is_no_band "$(printf '%s\n' "$out" | grep -c materials) $(grep -c material_low none.json)" "0 0"
command -v python3 >/dev/null || { skip what_python_reads "no python3"; finish; exit; }
python3 - <<'END' || not_ok the_python_ends_well
import csv, json, math
from tap import check
def rows(path):
    return [{k: float(v) for k, v in r.items() if k != "flags" and v} for r in csv.DictReader(l for l in open(path) if l[0] != "#")]
s, p, z = (json.load(open(f + ".json")) for f in "spz")
ball = 7.24989628827
one = json.load(open("one.json"))
near = lambda a, b: abs(a - b) <= 1e-9 * abs(b) + 1e-30
band = lambda v: near(v["material_low"], 0.8 * v["value"]) and near(v["material_high"], 1.2 * v["value"])
check("an_amplitude_scales_all_statistics", band(one["mean_m2"]) and all(band(q["sigma_m2"]) for q in one["percentiles"])
      and near(one["most"]["material_high"], 1.2 * one["most"]["sigma_m2"]), one["mean_m2"])
moved = lambda factor, edge: sum(r["weight"] for r in weighed if factor * r["sigma_m2"] <= edge * (1 + 1e-12)) / sum(r["weight"] for r in weighed)
weighed = rows("one.csv")
for r in weighed:
    el = math.radians(r["el_deg"])
    r["weight"] = (math.sin(min(el + math.radians(5), math.pi / 2)) - math.sin(max(el - math.radians(5), -math.pi / 2))) * (0.5 if r["az_deg"] in (0, 360) else 1)
check("so_are_the_shares", all(abs(c["share"]["material_high"] - moved(0.8, c["sigma_m2"])) < 1e-9
      and abs(c["share"]["material_low"] - moved(1.2, c["sigma_m2"])) < 1e-9 for c in one["cdf"]))
columns = [{k: float(v) for k, v in r.items()} for r in csv.DictReader(l for l in open("one.csv.csv") if l[0] != "#")]
check("and_the_table", [(r["cdf_material_low"], r["cdf_material_high"]) for r in columns] ==
      [(c["share"]["material_low"], c["share"]["material_high"]) for c in one["cdf"]])
half = lambda f: (lambda m: (m["material_high"] - m["material_low"]) / 2)(json.load(open(f))["mean_m2"])
both, a, b = half("two.json"), half("twoa.json"), half("twob.json")
check("the_band_of_a_mean_is_no_narrower_than_its_deviation", 0 < a and 0 < b and math.hypot(a, b) <= both * 1.001 <= (a + b) * 1.01, (both, a, b))
check("a_ball_is_the_same_everywhere", all(abs(v / ball - 1) < 1e-11 for v in
      [s["mean_m2"]["value"], s["least"]["sigma_m2"], s["most"]["sigma_m2"]] + [q["sigma_m2"]["value"] for q in s["percentiles"]]))
check("its_distribution_is_one_step", [c["share"]["value"] for c in s["cdf"]] == [0.0, 1.0])
check("a_ball_lies_between_its_ends", all(q["sigma_m2"]["least"] <= ball * (1 + 1e-11) and ball * (1 - 1e-11) <= q["sigma_m2"]["most"] for q in s["percentiles"]))
most = math.pi  # 4 pi B
check("a_plate_has_its_mean", abs(p["mean_m2"]["value"] / (most / 6) - 1) < 1e-3)
check("a_plate_has_its_percentiles", all(abs(q["sigma_m2"]["value"] - most * max(0, 2 * q["percent"] / 100 - 1) ** 2) < 4 * most / 4000 for q in p["percentiles"]))
check("a_plate_has_its_distribution", len(p["cdf"]) > 5 and all(abs(c["share"]["value"] - min(1, 0.5 + 0.5 * math.sqrt(c["sigma_m2"] / most))) < 1.5 / 4000 for c in p["cdf"]))
table = [{k: float(v) for k, v in r.items()} for r in csv.DictReader(l for l in open("p.csv.csv") if l[0] != "#")]
check("the_table_is_the_same", [(r["to_m2"], r["cdf"], r["cdf_least"], r["cdf_most"]) for r in table] ==
      [(c["sigma_m2"], c["share"]["value"], c["share"]["least"], c["share"]["most"]) for c in p["cdf"]])
check("shares_add_up", abs(sum(r["share"] for r in table) - 1) < 1e-12)
check("provenance_is_that_of_the_rows", s["schema"] == 1 and s["lrcs"] == "statistics" and "sphere.toml" in s["sweep"]["files"] and s["sweep"]["sphere"] == "50")
# a map by solid angle, computed again from its rows
def weight(r):
    half = math.radians(7.5)
    el = math.radians(r["el_deg"])
    band = math.sin(min(el + half, math.pi / 2)) - math.sin(max(el - half, -math.pi / 2))
    return band * (0.5 if abs(r["az_deg"]) == 180 else 1)
data = rows("z.csv")
whole = sum(map(weight, data))
mean = sum(weight(r) * r["sigma_m2"] for r in data) / whole
within = sum(weight(r) * r["bound_m2"] for r in data) / whole
check("a_map_has_its_mean_and_bound", abs(z["mean_m2"]["value"] / mean - 1) < 1e-12 and
      abs((z["mean_m2"]["most"] - mean) / within - 1) < 1e-9 and within > 0)
def percentile(value, part, slack):
    below = 0.0
    for v, w in sorted((value(r), weight(r)) for r in data):
        below += w
        if below >= part * whole * (1 + slack): return v
near = lambda a, b: abs(a - b) <= 1e-12 * abs(b)
# where a sum of weights meets a percentage exactly, rounding decides between two neighbours
check("a_map_has_its_percentiles", all(any(near(q["sigma_m2"]["value"], percentile(lambda r: r["sigma_m2"], q["percent"] / 100, e)) for e in (-1e-12, 1e-12)) for q in z["percentiles"]))
check("and_their_ends", all(q["sigma_m2"]["least"] <= percentile(lambda r: max(r["sigma_m2"] - r["bound_m2"], 0), q["percent"] / 100, 1e-12) * (1 + 1e-12) and
      q["sigma_m2"]["most"] >= percentile(lambda r: r["sigma_m2"] + r["bound_m2"], q["percent"] / 100, -1e-12) * (1 - 1e-12) for q in z["percentiles"]))
# the truth of the same rows lies between the ends
truth = {(r["az_deg"], r["el_deg"]): r for r in rows("exact.csv")}
data = [dict(truth[r["az_deg"], r["el_deg"]]) for r in data]
check("the_truth_lies_between_the_ends", all(q["sigma_m2"]["least"] <= percentile(lambda r: r["sigma_m2"], q["percent"] / 100, 1e-12) * (1 + 2e-6) and
      percentile(lambda r: r["sigma_m2"], q["percent"] / 100, -1e-12) * (1 - 2e-6) <= q["sigma_m2"]["most"] for q in z["percentiles"]))
mean = sum(weight(r) * r["sigma_m2"] for r in data) / whole
check("the_true_mean_too", z["mean_m2"]["least"] <= mean * (1 + 1e-6) and mean * (1 - 1e-6) <= z["mean_m2"]["most"] and z["mean_m2"]["most"] > z["mean_m2"]["least"])
share = lambda x, e: sum(weight(r) for r in data if r["sigma_m2"] <= x * (1 + e)) / whole
check("true_shares_too", all(c["share"]["least"] - 1e-12 <= share(c["sigma_m2"], 2e-6) and share(c["sigma_m2"], -2e-6) <= c["share"]["most"] + 1e-12 for c in z["cdf"]))
END
finish
