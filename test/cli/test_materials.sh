#!/bin/sh
# SPDX-License-Identifier: MIT
# Errors of materials, from scene file or command line, and what they leave uncertain of sigma;
# derivatives.
. "$(dirname "$0")/check.sh"
cd "$scratch" || exit 1

# scene NAME ERRORS: a plate of 1 m2 in a material with such lines of errors.
scene() {
    printf '[[part]]\nname = "plate"\nshape = "plate"\nsize = [1, 1]\nmaterial = "foil"\n' >"$1"
    printf '[[material]]\nname = "foil"\nA = 1\nB = 0.25\ns = 0.2\nm = 0.5\n%b' "$2" >>"$1"
}
scene exact.toml ''
scene linear.toml 'A_error = 0.1\nB_error = 0.01\ncorrelation = [-0.6, 0, 0, 0, 0, 0]\n'
scene bent.toml 's_error = 0.08\n'
scene negative.toml 'A_error = -1\n'
scene impossible.toml 'A_error = 1\ncorrelation = [0.9, 0.9, 0, -0.9, 0, 0]\n'
scene few.toml 'correlation = [0.9, 0.9, 0]\n'

run run exact.toml --azel 0,70 --json
same without_errors_there_is_none "$(value material_uncertainty)" null
bound=$(value bound_m2)

# 4 pi cos^2 f_r at 20 degrees: dA = 0.58741471..., dB = 10.756584...
run run linear.toml --azel 0,70 --json
python3 - "$scratch" "$bound" <<END
from tap import check
import json, math
r = json.loads("""$out""")
u = r["material_uncertainty"]
a, b = 0.1 * 0.58741471268846423, 0.01 * 10.756584794533006
want = math.sqrt(a * a + b * b - 1.2 * a * b)
check("first_order_is_the_square_root_of_g_c_g", abs(u["deviation_m2"] / want - 1) < 1e-12, u)
check("it_says_by_what", u["by"] == "first_order" and u["draws"] == 4096 and u["seed"] == 1, u)
check("the_interval_is_about_sigma", abs(u["high_m2"] - r["sigma_m2"] - want) < 1e-12, u)
check("the_sample_agrees", abs(u["sample_m2"] / want - 1) < 0.05, u)
check("the_bound_does_not_include_it", r["bound_m2"] == float("$bound"), r["bound_m2"])
m = r["materials"][0]
check("the_errors_stand_with_the_material", m["A_error"] == 0.1 and m["correlation"][0] == -0.6, m)
END
first=$out
run run linear.toml --azel 0,70 --json
same the_same_sample_again "$(printf '%s\n' "$out" | grep material_unc)" "$(printf '%s\n' "$first" | grep material_unc)"
run run linear.toml --azel 0,70 --json --seed 2
same another_seed_another_sample "$([ "$(printf '%s\n' "$out" | grep material_unc)" != "$(printf '%s\n' "$first" | grep material_unc)" ] && echo yes)" yes
run run linear.toml --azel 0,70 --json --draws 0
same without_draws_no_sample "$(printf '%s\n' "$out" | grep -c '"sample_m2": null.*"draws": 0')" 1

run run bent.toml --azel 0,70 --json
same a_bent_sigma_is_sampled "$(printf '%s\n' "$out" | grep -c '"by": "sample"')" 1
run run bent.toml --azel 0,70
same and_the_table_says_so "$(printf '%s\n' "$out" | grep -c '^materials    +- .* one standard deviation, from a sample; not in the bound$')" 1
same the_verdict_names_it "$(printf '%s\n' "$out" | grep -c '^  materials  their stated errors leave sigma uncertain by .* % (one standard deviation)$')" 1

# The command line's errors, and a scene file's replaced by them.
run run exact.toml --azel 0,70 --json --material 'foil=1+-0.1,0.25+-0.01,0.2,0.5'
python3 - <<END
from tap import check
import json, math
u = json.loads("""$out""")["material_uncertainty"]
a, b = 0.1 * 0.58741471268846423, 0.01 * 10.756584794533006
check("errors_from_the_command_line", abs(u["deviation_m2"] / math.hypot(a, b) - 1) < 1e-12, u)
END
# Errors of names that one pattern binds are correlated; those of names bound one by one are not.
printf 'v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 3 0 0\nv 3 1 0\nv 2 1 0\n' >two.obj
printf 'usemtl foil1\nf 1 2 3 4\nusemtl foil2\nf 5 6 7 8\n' >>two.obj
run run two.obj --json --material 'foil*=0,0.25+-0.02,0,0'
together=$out
run run two.obj --json --material 'foil1=0,0.25+-0.02,0,0' --material 'foil2=0,0.25+-0.02,0,0'
python3 - <<END
from tap import check
import json, math
a = json.loads("""$together""")["material_uncertainty"]["deviation_m2"]
b = json.loads("""$out""")["material_uncertainty"]["deviation_m2"]
one = 4 * math.pi * 0.02
check("a_pattern_binds_one_material", abs(a / (2 * one) - 1) < 1e-12, a)
check("two_bindings_bind_two", abs(b / (math.sqrt(2) * one) - 1) < 1e-12, b)
END
run run linear.toml --azel 0,70 --json --material 'foil=1,0.25,0.2,0.5'
same a_binding_replaces_errors_too "$(value material_uncertainty)" null

run run exact.toml --azel 0,70 --json --sensitivity
python3 - <<END
from tap import check
import json, math
s = json.loads("""$out""")["sensitivity"]
m = s["materials"][0]
want = [0.58741471268846423, 10.756584794533006, 19.454342834150948, -0.16727149906049578]
got = [m[k] for k in ("dA_m2_sr", "dB_m2_sr", "ds_m2", "dm_m2")]
check("derivatives_by_material", all(abs(g / w - 1) < 1e-12 for g, w in zip(got, want)), got)
y = s["attitude"]["about_y"]
def sigma(deg):
    t = math.radians(deg); c = math.cos(t)
    return 4 * math.pi * (c ** -4 * math.exp(-math.tan(t) ** 2 / 0.04) + 0.25 * c ** 2.5)
want = (sigma(19.999) - sigma(20.001)) / 0.002
check("derivatives_in_attitude", abs(y["m2_per_deg"] / want - 1) < 1e-5, y)
check("with_their_errors", 0 < y["bound_m2_per_deg"] < 1e-10 and 0 < y["estimate_m2_per_deg"] < 1e-5, y)
END

# What a fit knows goes through a scene file into the uncertainty of sigma, correlations included.
python3 - >noisy.csv <<END
import math, random
random.seed(3)
print("angle_deg,value")
for a in range(0, 80, 2):
    c = math.cos(math.radians(a))
    f = c ** -6 * math.exp(-math.tan(math.radians(a)) ** 2 / 0.04) + 0.25 * c ** 0.5
    print(f"{a},{f + random.gauss(0, 0.01):.5f}")
END
run fit noisy.csv
{ printf '[[part]]\nname = "p"\nshape = "plate"\nsize = [1, 1]\nmaterial = "noisy"\n'; printf '%s\n' "$out" | sed -n '/^\[\[material/,$p'; } >fitted.toml
option=$(printf '%s\n' "$out" | sed -n "s/^--material '\(.*\)'$/\1/p")
run fit noisy.csv --json
fit=$out
run run fitted.toml --azel 0,75 --json --sensitivity
same a_fitted_scene_runs "$rc" 0
python3 - <<END
from tap import check
import json, math
fit = json.loads("""$fit""")["fits"][0]
r = json.loads("""$out""")
d = [r["sensitivity"]["materials"][0][k] for k in ("dA_m2_sr", "dB_m2_sr", "ds_m2", "dm_m2")]
v = [d[i] * fit["parameters"][k]["std_error"] for i, k in enumerate("ABsm")]
c = fit["correlation"]
want = math.sqrt(sum(v[i] * c[i][j] * v[j] for i in range(4) for j in range(4)))
u = r["material_uncertainty"]
check("with_the_fits_covariance", abs(u["first_order_m2"] / want - 1) < 0.01, (u, want))
END
run run exact.toml --azel 0,75 --json --material "foil=${option#*=}"
same the_option_of_a_fit_has_its_errors "$(printf '%s\n' "$out" | grep -c '"material_uncertainty": {')" 1

# ---- sweeps ----
"$tool" sweep bent.toml --az 0 --el 60:80:2 -o whole.csv 2>/dev/null
same a_sweep_has_the_columns "$(sed -n 2p whole.csv)" "index,az_deg,el_deg,sigma_m2,sigma_dbsm,bound_m2,sigma_glint_m2,sigma_diffuse_m2,material_deviation_m2,material_low_m2,material_high_m2,material_sampled,flags"
same the_head_says_how "$(sed -n 1p whole.csv | grep -c '; uncertainty=4096 draws seed 1;')" 1
run run bent.toml --azel 0,70 --json
want=$(value material_uncertainty | sed 's/.*"deviation_m2": \([^,]*\),.*/\1/')
same a_row_is_what_run_says "$(awk -F, '$3 == 70 { print $9 }' whole.csv)" "$want"
"$tool" sweep exact.toml --az 0 --el 60:80:2 -o exact.csv 2>/dev/null
same without_errors_no_columns "$(sed -n 2p exact.csv | grep -c material)" 0
for k in 1 2 3; do "$tool" sweep bent.toml --az 0 --el 60:80:2 --shard $k/3 -o part$k.csv 2>/dev/null; done
"$tool" merge part1.csv part2.csv part3.csv -o merged.csv 2>/dev/null
same shards_merge "$(cmp whole.csv merged.csv && echo same)" same
"$tool" sweep bent.toml --az 0 --el 60:80:2 --jobs 2 -o jobs.csv 2>/dev/null
same and_threads_change_nothing "$(cmp whole.csv jobs.csv && echo same)" same
head -6 whole.csv >again.csv.partial
"$tool" sweep bent.toml --az 0 --el 60:80:2 -o again.csv --resume 2>/dev/null
same a_sweep_goes_on "$(cmp whole.csv again.csv && echo same)" same
"$tool" sweep bent.toml --az 0 --el 60:80:2 -o whole.jsonl 2>/dev/null
head -6 whole.jsonl >again.jsonl.partial
"$tool" sweep bent.toml --az 0 --el 60:80:2 -o again.jsonl --resume 2>/dev/null
same so_does_one_of_json_lines "$(cmp whole.jsonl again.jsonl && echo same)" same
"$tool" sweep bent.toml --az 0 --el 60:80:2 -o whole.npy 2>/dev/null
same a_map_is_made_of_them "$(head -c 6 whole.npy | tail -c 5)" NUMPY

# damaged FIELD VALUE TEXT: such a field in the first row is refused, and says what.
damaged() {
    awk -F, -v OFS=, -v f="$1" -v v="$2" 'NR == 3 { $f = v } { print }' whole.csv | head -6 >bad.csv.partial
    run sweep bent.toml --az 0 --el 60:80:2 -o bad.csv --resume
    same "damaged_field_$1_as_$2" "$rc $(printf '%s\n' "$err" | grep -c "$3")" "1 1"
    rm -f bad.csv.partial bad.csv.lock
}
damaged 9 -1 'material_deviation_m2: found'
damaged 9 nan 'material_deviation_m2: found'
damaged 10 1e9 'material_low_m2: found'
damaged 12 2 'material_sampled: found'
damaged 11 '' 'material_high_m2: found'
"$tool" sweep linear.toml --az 0 --el 60:80:2 -o whole.csv 2>/dev/null
awk -F, -v OFS=, 'NR == 3 { $11 *= 1.001 } { print }' whole.csv | head -6 >bad.csv.partial
run sweep linear.toml --az 0 --el 60:80:2 -o bad.csv --resume
same by_first_order_the_interval_is_about_sigma "$rc $(printf '%s\n' "$err" | grep -c 'material_high_m2: found')" "1 1"
run sweep linear.toml --vary foil.s:0.1:0.3:0.1 --azel 0,70
same errors_stay_where_a_parameter_varies "$(printf '%s\n' "$out" | awk -F, '/^[0-9]/ && $8 > 0' | wc -l | tr -d ' ')" 3

# ---- plots ----
"$tool" sweep linear.toml --az 0 --el 60:80:2 -o plotted.csv --plot plotted.svg --plot plotted.png 2>/dev/null
"$tool" sweep exact.toml --az 0 --el 60:80:2 -o bare.csv --plot bare.svg 2>/dev/null
same a_band_has_an_area_between_points "$(($(grep -c '<polygon' plotted.svg) - $(grep -c '<polygon' bare.svg)))" 10
same and_the_note_says_what_it_is "$(grep -c 'shaded: 68 % by the errors of materials' plotted.svg bare.svg | tr '\n' ' ')" "plotted.svg:1 bare.svg:0 "
"$tool" plot plotted.csv -o drawn.svg 2>/dev/null
same drawn_again_it_is_the_same "$(cmp plotted.svg drawn.svg && echo same)" same

# ---- what pictures were made from ----
hash=$("$tool" run linear.toml --json | sed -n 's/.*"hash": "\(fnv1a:[0-9a-f]*\)".*/\1/p')
# Polar diagrams have bands, and maps state numbers.
"$tool" sweep linear.toml --az 0 --el 60:80:2 --plot polar.svg --polar >/dev/null 2>&1
"$tool" sweep exact.toml --az 0 --el 60:80:2 --plot bare.svg --polar >/dev/null 2>&1
same a_polar_band_has_an_area_between_points "$(($(grep -c '<polygon fill="#bfdcec"' polar.svg) - $(grep -c '<polygon fill="#bfdcec"' bare.svg)))" 10
same and_its_note_says_so "$(grep -c 'shaded: 68 % by the errors of materials' polar.svg bare.svg | tr '\n' ' ')" "polar.svg:1 bare.svg:0 "
box_scene >box.toml
for form in "--az 0:80:10 --el 0:80:10" "--sphere 40" "--az 0:80:10 --el 0:80:10 --projection mollweide"; do
    # shellcheck disable=SC2086 # options are words
    "$tool" sweep box.toml --material 1+-0.2,0.25+-0.05,0.2,0.5 $form -o rows.csv --plot map.svg >/dev/null 2>&1
    python3 - "$form" <<'END'
from tap import check
import csv, re, sys
rows = [r for r in csv.DictReader(l for l in open("rows.csv") if l[0] != "#")]
half = sorted(0.5 * (float(r["material_high_m2"]) - float(r["material_low_m2"])) / float(r["sigma_m2"]) for r in rows if float(r["sigma_m2"]) > 0)
n = len(half)
want = (50 * (half[(n - 1) // 2] + half[n // 2]), 100 * half[-1])
found = re.search(r"errors of materials \(68 %\): \+-([0-9.e+-]+) % of sigma \(median\), \+-([0-9.e+-]+) % \(most\)", open("map.svg").read())
check("the_note_of_a_map_has_its_uncertainty " + sys.argv[1], n > 30 and found and all(abs(float(a) / b - 1) < 0.06 for a, b in zip(found.groups(), want)), (found and found.groups(), want))
END
done
"$tool" sweep exact.toml --az 0:80:10 --el 0:80:10 --plot map.svg >/dev/null 2>&1
same without_errors_a_map_says_nothing "$(grep -c 'errors of materials' map.svg)" 0
run report linear.toml --azel 0,70 --seconds 0.2 -o page.html
same a_report_says_them_of_two_cuts_and_its_map "$rc $(grep -c 'Errors of its materials' page.html)" "0 3"
same its_cuts_are_shaded "$(grep -o '<polygon fill="#bfdcec"' page.html | wc -l | awk '{ print ($1 > 20) }')" 1
same an_svg_names_its_files "$(grep -c "<metadata>lrcs .*files=linear.toml $hash" plotted.svg)" 1
python3 - "$hash" <<END
from tap import check
import struct, sys, zlib
def comment(path):
    data = open(path, "rb").read()
    at = 8
    while at < len(data):
        size, kind = struct.unpack(">I4s", data[at:at + 8])
        body = data[at + 8:at + 8 + size]
        assert zlib.crc32(kind + body) == struct.unpack(">I", data[at + 8 + size:at + 12 + size])[0]
        if kind == b"tEXt":
            return body
        at += 12 + size
    return b""
body = comment("plotted.png")
check("so_does_a_png", body.startswith(b"Comment\0lrcs ") and sys.argv[1].encode() in body, body)
END
"$tool" image linear.toml --material 'foil=1,0.1,0.2,0.3' -o shown.png >/dev/null 2>&1
same a_picture_names_its_materials "$(LC_ALL=C tr -d '\0' <shown.png | LC_ALL=C grep -a -c 'Commentlrcs .*; scene_hash=.*; title=[^;]*; options=--material=foil=1,0.1,0.2,0.3; file=linear.toml fnv1a:[0-9a-f]* unit=m; material=foil 1,0.1,0.2,0.3 given')" 1

run run negative.toml
same a_negative_error_is_refused "$rc $(printf '%s\n' "$err" | grep -c 'A_error.*0 or more')" "1 1"
run run impossible.toml
same so_are_impossible_correlations "$rc $(printf '%s\n' "$err" | grep -c 'without negative eigenvalues')" "1 1"
run run few.toml
same and_too_few "$rc $(printf '%s\n' "$err" | grep -c 'six numbers')" "1 1"
usage_error errors_need_a_slope "given for A or s, where s is 0" run exact.toml --material 'foil=0+-1,0.1,0,0'
usage_error one_draw_has_no_deviation "one draw" run exact.toml --draws 1
usage_error shape_has_no_errors "no errors (+-) here" shape plate --size 1,1 --material 1+-0.1,0.25,0.2,0.5
finish
