#!/bin/sh
# SPDX-License-Identifier: MIT
# The benchmarks work, and what they print, write and draw agrees with itself. No time is judged.
. "$(dirname "$0")/../cli/check.sh"
bench=$(dirname "$tool")/test/bench
command -v python3 >/dev/null || { skip what_python_reads "no python3"; finish; exit; }
cd "$scratch" || exit 1
mkdir cases peers
printf 'import sys\nprint("v 0 0 0\\nv 1 0 0\\nv 0 1 0\\nf 1 2 3")\nassert sys.argv[1] == "10"\n' >cases/hatch.py
printf 'raise SystemExit(1)\n' >cases/stack.py
# a peer that takes 2 ms for each pose and 3 ms to build; the other peer is missing
printf '#!/bin/sh\nfor i in 1 2 3; do echo "10 20 1.5 2e-3"; done\necho "median 2e-3 s a pose, build 3e-3 s" >&2\n' >peers/embree_lrcs
chmod +x peers/embree_lrcs
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >one.obj
"$bench/bench" --tiny --limit 600 --csv b.csv --plot b.svg --scratch . --cases cases --peers peers one.obj >bench.txt 2>told.txt; echo $? >bench.rc
"$bench/bench" --tiny --limit 0 --only doubled --csv late.csv --scratch . >late.txt 2>/dev/null; echo $? >late.rc
"$bench/bench" --sizes 3 >/dev/null 2>usage.txt; echo $? >usage.rc
"$bench/scaling" --tiny >scaling.txt; echo $? >scaling.rc
python3 - <<'END' || not_ok the_python_ends_well
import csv, glob, math
import xml.etree.ElementTree as tree
from tap import check
def text(path):
    return open(path).read()
def cells(line):
    return [c.strip() for c in line.strip().strip("|").split("|")]
def table(path):
    return list(csv.DictReader(l for l in text(path).splitlines() if l[0] != "#"))
check("bench_and_scaling_run", text("bench.rc") == text("late.rc") == text("scaling.rc") == "0\n")
check("unknown_options_are_usage_errors", text("usage.rc") == "2\n" and "usage" in text("usage.txt"))
check("scratch_models_are_gone", not glob.glob("lrcs_bench*"))

check("the_machine_is_named", {"processor", "compiler", "date"} == {l[2:].split(":")[0] for l in text("b.csv").splitlines() if l[0] == "#"})
rows = table("b.csv")
number = lambda row, key: float(row[key] or 0)
near = lambda a, b: math.isclose(a, b, rel_tol=1e-4)
of = lambda scene: {r["what"]: r for r in rows if r["scene"] == scene}
own = ["load", "prepare", "facet", "zbuffer 512", "zbuffer 1024", "exact", "auto 1e-1", "auto 1e-2", "auto 1e-3", "auto 1e-4", "estimate 1e-2", "estimate 1e-3"]
peers = ["llvmpipe 1024", "Embree 1024", "Embree tree"]
scenes = ["one.obj", "satellite 2.6 k", "convex body", "station", "station with doubled faces", "one vertex 1e22 m away", "hatch 10"]
check("scenes_stand_in_the_order_measured", list(dict.fromkeys(r["scene"] for r in rows)) == scenes)
check("every_cell_has_a_row", all(list(of(s)) == own + (peers if s != "hatch 10" else []) for s in scenes))
check("a_generator_that_fails_is_left_out", not of("stack 10"))
facets = {s: int(of(s)["load"]["facets"]) for s in scenes}
check("facets_are_those_of_the_formulas", facets == dict(zip(scenes, (1, 108 * 25 - 24 * 5, 16 * 16 + 16 * 4 - 8, 228 - 24, 2 * (228 - 24), 108 * 4 - 24 * 2, 1))))
made = [r for r in rows if r["what"] in own]
check("every_own_cell_is_done", all(r["end"] == "done" and int(r["samples"]) >= 1 for r in made))
check("medians_lie_between_quartiles", all(0 < number(r, "ms_low_quartile") <= number(r, "ms") <= number(r, "ms_high_quartile") for r in made))
check("poses_have_a_first_one_and_a_work_area", all((number(r, "first_ms") > 0) == (number(r, "work_bytes") > 0) == (r["what"] not in ("load", "prepare")) for r in made))
check("a_peer_is_read_as_it_prints", all(near(number(of(s)["Embree 1024"], "ms"), 2) and near(number(of(s)["Embree tree"], "ms"), 3)
      and of(s)["Embree 1024"]["samples"] == "3" for s in scenes[:-1]))
check("a_peer_that_is_missing_failed", all(of(s)["llvmpipe 1024"]["end"] == "failed" and of(s)["llvmpipe 1024"]["ms"] == "" for s in scenes[:-1]))
check("ratios_are_of_wall_times", all((r["peer"], near(number(r, "times_peer") * t, number(r, "wall_ms"))) == (p, True)
      for s in scenes[:-1] for r, p, t in ((of(s)["exact"], "Embree 1024", 2), (of(s)["prepare"], "Embree tree", 3))))
check("no_peer_no_ratio", all(r["times_peer"] == "" for r in rows if r["what"] not in ("exact", "prepare") or r["scene"] == "hatch 10"))
check("bounds_are_reported", all((number(of("station")[w], "bound_over_sigma") > 0) for w in own[2:])
      and 0 < number(of("station")["zbuffer 1024"], "estimate_over_sigma") < number(of("station")["zbuffer 512"], "estimate_over_sigma"))

printed = {cells(l)[0]: cells(l) for l in text("bench.txt").split("Peers'")[0].splitlines() if l.startswith("|")}
def shown(cell, value):
    return math.isclose(float(cell), value, rel_tol=6e-3) if value else cell == "-"
check("the_table_has_every_median", all(shown(c, number(of(s)[w], "ms")) for s in scenes for c, w in zip(printed[s][2:7] + printed[s][8:], own)))
check("progress_goes_to_stderr", all(s in text("told.txt") for s in scenes))

late = table("late.csv")
check("only_takes_what_is_named", {r["scene"] for r in late} == {"station with doubled faces"})
check("what_does_not_finish_is_told_so", all(r["end"] == "too long" and r["ms"] == "" for r in late) and "> 0 s" in text("late.txt"))

svg = tree.parse("b.svg").getroot()
words = {"".join(t.itertext()) for t in svg.iter("{http://www.w3.org/2000/svg}text")}
check("the_plot_names_axes_units_and_what_was_measured", {"facets", "time (ms)", "zbuffer 1024", "exact", "estimate 1e-2", "Embree tree"} <= words
      and "llvmpipe 1024" not in words)

fits = [cells(l) for l in text("scaling.txt").splitlines() if l.startswith("| satellite  ")]
sizes = [[float(x) for x in f[3].split("..")] for f in fits]
times = [[float(x) for x in f[4].split("..")] for f in fits]
check("four_methods_are_fitted", [f[2] for f in fits] == ["prepare", "facet", "zbuffer", "exact"])
check("two_points_are_on_their_line", all(abs(math.log(t[1] / t[0]) / math.log(s[1] / s[0]) - float(f[5])) < 0.006 and f[5] == f[7]
      and f[6] == "1.00" for f, s, t in zip(fits, sizes, times)))
check("the_worst_cases_are_answered", sum(l.rstrip().endswith("| none |") for l in text("scaling.txt").splitlines()) == 6)
END
finish
