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
same the_verdict_names_it "$(printf '%s\n' "$out" | grep -c 'their stated errors leave sigma uncertain by .* % (one standard deviation)$')" 1

# The command line's errors, and a scene file's replaced by them.
run run exact.toml --azel 0,70 --json --material 'foil=1+-0.1,0.25+-0.01,0.2,0.5'
python3 - <<END
from tap import check
import json, math
u = json.loads("""$out""")["material_uncertainty"]
a, b = 0.1 * 0.58741471268846423, 0.01 * 10.756584794533006
check("errors_from_the_command_line", abs(u["deviation_m2"] / math.hypot(a, b) - 1) < 1e-12, u)
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
