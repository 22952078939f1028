#!/bin/sh
# SPDX-License-Identifier: MIT
# lrcs run --shares: the rows add up to sigma, and each is what Python sums from the per-facet table.
. "$(dirname "$0")/check.sh"
cd "$scratch" || exit 1

# Two objects and two materials in one model, beside two shapes with a material of the same name.
{
    printf 'mtllib m.mtl\nv 0 0 3\nv 1 0 3\nv 0 1 3\nv 2 0 4\nv 3 0 4\nv 2 1 4.5\nv 2.5 2 5\n'
    printf 'o left\nusemtl red\nf 1 2 3\no right\nusemtl blue\nf 4 5 6\nusemtl red\nf 6 5 7\n'
} >m.obj
printf 'newmtl red\nKd 1 0 0\nnewmtl blue\nKd 0 0 1\n' >m.mtl
{
    pair_scene
    printf '[[part]]\nname = "model"\nfile = "m.obj"\n'
} >scene.toml
at="--azel 40,60 --material red=1,0.3,0.4,1 --material blue=0.2,0,0.3,0"

run run scene.toml $at --json
same shares_come_only_when_asked "$(printf '%s\n' "$out" | grep -c '"shares"')" 0
plain=$(printf '%s\n' "$out" | grep -v '"seconds"\|"options"')
run run scene.toml $at --json --shares --facets f.csv
printf '%s\n' "$out" >shares.json
same shares_are_the_last_key "$(keys | sed 's/.*direction //')" "seconds box_min_m box_max_m back_sides coarse_glint title materials options shares "
same the_other_keys_stay "$(printf '%s\n' "$out" | sed '/^  "shares"/,$d' | grep -v '"seconds"\|"options"')" "$(printf '%s\n' "$plain" | sed '$d')"
run run scene.toml $at --shares
printf '%s\n' "$out" >table.txt
run run scene.toml --azel 40,60 --material 0,0,0.1,0 --material red=0,0,0.1,0 --material paint-white=0,0,0.1,0 \
    --material solar-cell=0,0,0.1,0 --json --shares
printf '%s\n' "$out" >dark.json
run run scene.toml $at --json --shares --method zbuffer --resolution 64 --facets z.csv
printf '%s\n' "$out" >z.json
run run scene.toml $at --json --shares --time-budget 200
same a_time_budget_has_shares_too "$(printf '%s\n' "$out" | grep -c '"shares"')" 1
usage_error shares_and_a_table_of_facets_are_too_much "--facets - and --shares both want standard output" \
    run scene.toml --shares --facets -

# Many parts: the table is cut, and says what was.
for i in 01 02 03 04 05 06 07 08 09 10 11 12 13; do
    printf '[[part]]\nname = "p%s"\nshape = "plate"\nsize = [1, %s]\ntranslate = [%s, 0, 0]\n' $i "1.$i" "1$i"
done >many.toml
run run many.toml --shares
printf '%s\n' "$out" >many.txt
run run many.toml --shares --json
printf '%s\n' "$out" >many.json

command -v python3 >/dev/null || { skip what_python_reads "no python3"; finish; exit; }

# Objects of one name, as 3DS files have them.
python3 - <<'END'
import struct
def chunk(id, body): return struct.pack("<HI", id, 6 + len(body)) + body
def triangle(name, side):
    points = chunk(0x4110, struct.pack("<H9f", 3, 0, 0, side, side, 0, side, 0, side, side))
    return chunk(0x4000, name + b"\0" + chunk(0x4100, points + chunk(0x4120, struct.pack("<H4H", 1, 0, 1, 2, 0))))
objects = triangle(b"a", 1) + triangle(b"b", 4) + triangle(b"a", 3)
open("alike.3ds", "wb").write(chunk(0x4D4D, chunk(0x3D3D, objects)))
END
run run alike.3ds --method facet --shares --json
same objects_of_one_name_are_told_apart "$(printf '%s\n' "$out" | sed -n '/"parts"/,/"materials"/s/.*"name": "\([^"]*\)".*/\1/p' | tr '\n' ' ')" "b a #3 a #1 "

python3 - <<'END' || not_ok the_python_ends_well
import csv, json, math, sys
from tap import check
def near(a, b, most=4e-15):
    return abs(a - b) <= most * abs(b)
def names(row): return [r["name"] for r in row]
part = lambda facet: "near" if facet < 12 else "far" if facet < 24 else "model/left" if facet == 24 else "model/right"
for name in ("shares", "z"):
    r = json.load(open(name + ".json"))
    rows = [(int(f["facet"]), f["material"], float(f["sigma_m2"]), float(f["cos_theta"]), float(f["visible_area_m2"]))
            for f in csv.DictReader(open("f.csv" if name == "shares" else "z.csv"))]
    for key, of in (("parts", lambda f: part(f[0])), ("materials", lambda f: f[1])):
        listed = r["shares"][key]
        check(name + "_" + key + "_add_up_to_sigma", near(math.fsum(s["sigma_m2"] for s in listed), r["sigma_m2"]))
        check(name + "_" + key + "_shares_add_up_to_1", near(math.fsum(s["share"] for s in listed), 1))
        check(name + "_" + key + "_are_those_of_the_scene", sorted(names(listed)) == sorted({of(f) for f in rows}))
        check(name + "_" + key + "_are_sums_of_facets", all(
            near(s["sigma_m2"], math.fsum(f[2] for f in rows if of(f) == s["name"])) and
            s["facets"] == sum(of(f) == s["name"] for f in rows) for s in listed))
        check(name + "_" + key + "_glint_adds_up", near(math.fsum(s["sigma_glint_m2"] for s in listed), r["sigma_glint_m2"]))
        check(name + "_" + key + "_diffuse_adds_up", near(math.fsum(s["sigma_diffuse_m2"] for s in listed), r["sigma_diffuse_m2"]))
        check(name + "_" + key + "_begin_with_the_brightest", all(a["sigma_m2"] >= b["sigma_m2"] for a, b in zip(listed, listed[1:])))
    best = sorted((f for f in rows if f[2] > 0), key=lambda f: -f[2])[:10]
    listed = r["shares"]["facets"]
    check(name + "_facets_are_the_ten_brightest", [f["sigma_m2"] for f in listed] == [f[2] for f in best] and len(listed) == 10)
    check(name + "_facets_say_who_they_are", all(
        (f["material"], f["visible_area_m2"], f["sigma_m2"], f["part"]) ==
        next((m, v, s, part(i)) for i, m, s, c, v in rows if i == f["facet"]) and
        near(math.cos(math.radians(f["theta_deg"])), next(abs(c) for i, m, s, c, v in rows if i == f["facet"]), 1e-14)
        for f in listed))

def f_r(A, B, s, m, c):  # the BRDF's two terms at an incidence cosine
    return A / c**6 * math.exp(-(1 / c**2 - 1) / s**2), B * c**m
r = json.load(open("shares.json"))
model = [f for f in csv.DictReader(open("f.csv")) if f["facet"] == "24"][0]
glint, diffuse = f_r(1, 0.3, 0.4, 1, float(model["cos_theta"]))
left = next(s for s in r["shares"]["parts"] if s["name"] == "model/left")
check("glint_of_a_facet_is_that_of_its_brdf", near(left["sigma_glint_m2"], 4 * math.pi * glint * float(model["cos_theta"]) * float(model["visible_area_m2"]), 1e-12))
check("diffuse_of_a_facet_is_that_of_its_brdf", near(left["sigma_diffuse_m2"], 4 * math.pi * diffuse * float(model["cos_theta"]) * float(model["visible_area_m2"]), 1e-12))

dark = json.load(open("dark.json"))
blue = [s for s in dark["shares"]["materials"] if s["name"] == "blue"]
check("of_nothing_there_is_no_share", dark["sigma_m2"] == 0 and all(
    s["share"] is None and s["sigma_m2"] == 0 for key in ("parts", "materials") for s in dark["shares"][key]))
check("of_nothing_no_facet_is_brightest", dark["shares"]["facets"] == [])

text = open("table.txt").read()
check("the_table_names_parts_materials_and_facets", all(w in text for w in ("model/right", "paint-white", "theta deg")))
many, lines = json.load(open("many.json")), open("many.txt").read().split("\n")
others = [l.split() for l in lines if "3 others" in l]
rest = math.fsum(s["sigma_m2"] for s in many["shares"]["parts"][10:])
check("json_lists_all_parts", len(many["shares"]["parts"]) == 13)
check("the_table_says_what_it_left_out", len(others) == 1 and float(others[0][2]) == float("%.6g" % rest))
END
finish
