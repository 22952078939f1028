#!/bin/sh
# SPDX-License-Identifier: MIT
# The tool's pictures, read by Python's zlib and json modules, if Python is installed.
. "$(dirname "$0")/../cli/check.sh"
command -v python3 >/dev/null || { skip what_python_reads "no python3"; finish; exit; }
"$tool" run demo --tolerance 0.01 --azel 30,20 --json --image "$scratch/i.png" --image-size 200 \
    --facets "$scratch/f.csv" >"$scratch/o.json" 2>/dev/null
"$tool" info demo --json >"$scratch/info.json" 2>/dev/null
python3 - "$scratch" <<'END' || not_ok the_python_ends_well
import csv, json, math, sys
from png_file import Png
at = sys.argv[1]
from tap import check
png = Png(at + "/i.png")
check("chunk_sums_are_right", png.sums)
check("head_is_200_x_200_rgb", png.head == (200, 200, 8, 2, 0, 0, 0))
check("pixels_inflate_to_their_size", len(png.raw) == 200 * 601)
rows = png.rows
check("corner_is_background", rows[0][:3] == rows[199][597:])
check("something_is_seen", len({r[k:k + 3] for r in rows for k in range(0, 600, 3)}) > 10)
run = json.load(open(at + "/o.json"))
check("run_is_json", run["schema"] == 1 and len(run["effects"]) == 8)
json.load(open(at + "/info.json"))
check("dbsm_matches_sigma", abs(run["sigma_dbsm"] - 10 * math.log10(run["sigma_m2"])) < 1e-9)
check("parts_of_sigma_add_up", math.isclose(run["sigma_glint_m2"] + run["sigma_diffuse_m2"], run["sigma_m2"], rel_tol=1e-12))
check("direction_has_length_1", abs(math.hypot(*run["direction"]) - 1) < 1e-15)
table = list(csv.DictReader(open(at + "/f.csv")))
check("rows_match_the_count", len(table) == run["facets"]["total"])
check("rows_of_sigma_add_up", math.isclose(math.fsum(float(r["sigma_m2"]) for r in table), run["sigma_m2"], rel_tol=1e-12))
check("visible_areas_add_up_to_the_silhouette", math.isclose(math.fsum(float(r["visible_area_m2"]) for r in table), run["projected_area_m2"], rel_tol=1e-9))
check("cosines_are_cosines", all(-1 <= float(r["cos_theta"]) <= 1 for r in table))
END
finish
