#!/bin/sh
# SPDX-License-Identifier: MIT
# The benchmarks work, and what they print, write and draw agrees with itself. No time is judged.
case $1 in /*) bench=$(dirname "$1")/test/bench ;; *) bench=$PWD/$(dirname "$1")/test/bench ;; esac
command -v python3 >/dev/null || { echo "ok no_python3_here_skipped"; exit 0; }
scratch=$(mktemp -d) || exit 1
trap 'rm -rf "$scratch"' EXIT
tests=$(cd "$(dirname "$0")/.." && pwd)
cd "$scratch" || exit 1
"$bench/bench" --tiny --csv b.csv --plot b.svg --scratch b.stl >bench.txt; echo $? >bench.rc
"$bench/bench" --sizes 3 >/dev/null 2>usage.txt; echo $? >usage.rc
"$bench/scaling" --tiny >scaling.txt; echo $? >scaling.rc
PYTHONPATH=$tests python3 -B - <<'END'
import csv, math, os, sys
import xml.etree.ElementTree as tree
from told import check, finish
def text(path):
    return open(path).read()
def cells(line):
    return [c.strip() for c in line.strip().strip("|").split("|")]
check("bench_and_scaling_run", text("bench.rc") == text("scaling.rc") == "0\n")
check("unknown_options_are_usage_errors", text("usage.rc") == "2\n" and "usage" in text("usage.txt"))
check("the_scratch_model_is_gone", not os.path.exists("b.stl"))

lines = text("b.csv").splitlines()
check("the_machine_is_named", {"processor", "compiler", "date"} == {l[2:].split(":")[0] for l in lines if l[0] == "#"})
rows = list(csv.DictReader(l for l in lines if l[0] != "#"))
number = lambda row, key: float(row[key] or 0)
near = lambda a, b: math.isclose(a, b, rel_tol=1e-4)
stages = {"read mesh", "write frame 512", "write frame 1024", "load", "prepare", "cull", "contest", "raster 512", "raster 1024",
          "areas of 512", "areas of 1024", "exact", "sum", "pose facet", "pose zbuffer 1024", "pose exact"}
made = [r for r in rows if r["scene"] == "satellite 2580"]
check("every_stage_has_a_row", sorted(stages) == sorted(r["stage"] for r in made))
check("facets_and_vertices_obey_euler", all(int(r["facets"]) == 2580 and int(r["vertices"]) == 2580 // 2 + 2 * 5 for r in made))
check("medians_lie_between_quartiles", all(0 < number(r, "ms_low_quartile") <= number(r, "ms") <= number(r, "ms_high_quartile") for r in rows))
check("a_facets_share_is_the_time_over_facets", all(near(number(r, "ns_per_facet") * int(r["facets"]), 1e6 * number(r, "ms")) for r in rows))
check("a_pixels_share_is_the_time_over_pixels", all(near(number(r, "ns_per_pixel") * int(r["stage"].split()[-1]) ** 2, 1e6 * number(r, "ms"))
      for r in rows if r["ns_per_pixel"]) and sum(r["ns_per_pixel"] != "" for r in made) == 7)
read = {r["scene"]: number(r, "ms") for r in rows if r["stage"] == "read mesh"}
check("limits_are_of_the_same_run", all(near(number(r, "limit_ms"), read[r["scene"]]) for r in rows if r["stage"] in ("cull", "pose exact", "pose facet")))
check("ratios_are_of_the_limits_and_targets", all(near(number(r, "times_" + k) * number(r, k + "_ms"), number(r, "ms"))
      for r in rows for k in ("limit", "target") if r[k + "_ms"]))
targets = {r["stage"]: number(r, "target_ms") for r in made if r["target_ms"]}
check("targets_are_those_of_the_design", targets == {"pose zbuffer 1024": 0.4, "pose exact": 1})
printed = [cells(l) for l in text("bench.txt").splitlines() if l.startswith("|")]
check("tables_have_every_row_of_the_csv", all(any(p[0] == r["stage"] and math.isclose(float(p[1]), number(r, "ms"), rel_tol=6e-4)
      for p in printed) for r in rows))

svg = tree.parse("b.svg").getroot()
words = {"".join(t.itertext()) for t in svg.iter("{http://www.w3.org/2000/svg}text")}
check("the_plot_names_axes_units_and_curves", {"facets", "time (ms)", "zbuffer 1024", "exact", "limit: read the mesh"} <= words)

fits = [cells(l) for l in text("scaling.txt").splitlines() if l.startswith("| satellite  ")]
sizes = [[float(x) for x in f[3].split("..")] for f in fits]
times = [[float(x) for x in f[4].split("..")] for f in fits]
check("four_methods_are_fitted", [f[2] for f in fits] == ["prepare", "facet", "zbuffer", "exact"])
check("two_points_are_on_their_line", all(abs(math.log(t[1] / t[0]) / math.log(s[1] / s[0]) - float(f[5])) < 0.006 and f[5] == f[7]
      and f[6] == "1.00" for f, s, t in zip(fits, sizes, times)))
check("the_worst_cases_are_answered", sum(l.rstrip().endswith("| none |") for l in text("scaling.txt").splitlines()) == 6)
finish()
END
