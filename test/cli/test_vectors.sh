#!/bin/sh
# SPDX-License-Identifier: MIT
# lrcs vectors: the same bytes every time, its options, and what it writes, read by Python programs that
# share nothing with the tool: the three forms of each scene agree, tiers 1 and 2 and the images are what the
# formulas of the kit's README say.
. "$(dirname "$0")/check.sh"

cd "$scratch" || exit 1
run vectors kit --resolution 32
same a_kit_is_written "$rc" 0
run vectors again --resolution 32
same the_same_bytes_every_time "$(diff -r kit again 2>&1 | head -3)" ""
run vectors again --resolution 32
same an_old_kit_is_overwritten "$rc $(diff -r kit again)" "0 "
same nothing_names_this_machine "$(grep -rl "$scratch" kit)" ""
run vectors small --tier 2 --resolution 0
same tiers_may_be_left_out "$(cut -d, -f3 small/cases.csv | sort -u | tr '\n' ' ')" "1 2 tier "
same no_images_where_none_are_asked "$(find small -name '*.png' -o -name '*.u32' -o -name '*.f64')" ""

mkdir other
echo precious >other/file
failure other_peoples_folders_are_left_alone "contains other files but no kit" vectors other
same nothing_was_added_to_them "$(ls other)" file
echo flat >flat
failure a_file_is_no_folder "flat" vectors flat
usage_error a_folder_is_asked_for "DIR is missing" vectors
usage_error not_more_tiers_than_there_are "--tier" vectors kit --tier 6
usage_error not_a_picture_of_that_size "--resolution" vectors kit --resolution 1e9

# The truth of a case is what the tool says of the same files.
run run kit/scenes/plate-turned.obj --direction "$(awk -F, '$1 == "plate-turned" && $2 == "a" { print $8 "," $9 "," $10 }' kit/cases.csv)" --material reference=1,0.25,0.2,0.5 --json
same a_case_can_be_run_again "$(value sigma_m2)" "$(awk -F, '$1 == "plate-turned" && $2 == "a" { print $13 }' kit/cases.csv)"

# So says the kit's README; it also shows any case.
run image kit/scenes/comb.obj --quaternion "$(awk -F, '$1 == "comb" && $2 == "f" { print $4 "," $5 "," $6 "," $7 }' kit/cases.csv)" --by facet -o comb.png
same a_case_can_be_looked_at "$rc $(head -c 4 comb.png | tail -c 3)" "0 PNG"

command -v python3 >/dev/null || { skip what_python_reads "no python3"; finish; exit; }
python3 - <<'END' || not_ok the_python_ends_well
import csv, glob, json, math, os, struct, sys
from png_file import Png

from tap import check

def obj(path):
    v, f, m, now = [], [], [], None
    for line in open(path):
        w = line.split()
        if w[:1] == ["v"]: v.append(tuple(map(float, w[1:])))
        if w[:1] == ["usemtl"]: now = w[1]
        if w[:1] == ["f"]:
            f.append(tuple(int(i) - 1 for i in w[1:]))
            m.append(now)
    return v, f, m

def stl(path):
    p = [tuple(map(float, line.split()[1:])) for line in open(path) if line.startswith("vertex")]
    return [tuple(p[i:i + 3]) for i in range(0, len(p), 3)]

materials = {r["material"]: r for r in csv.DictReader(open("kit/materials.csv"))}
cases = list(csv.DictReader(open("kit/cases.csv")))
scenes, forms, single, used = {}, [], [], []
for name in dict.fromkeys(c["scene"] for c in cases):
    v, f, m = scenes[name] = obj(f"kit/scenes/{name}.obj")
    j = json.load(open(f"kit/scenes/{name}.json"))
    corners = [tuple(v[i] for i in t) for t in f]
    if (stl(f"kit/scenes/{name}.stl") != corners
            or [tuple(tuple(j["vertices_m"][i]) for i in t) for t in j["facets"]] != corners
            or [j["materials"][i]["name"] for i in j["facet_material"]] != m): forms.append(name)
    if any(x != struct.unpack("f", struct.pack("f", x))[0] for p in v for x in p): single.append(name)
    if not set(m) <= set(materials) or not set(m) <= set(open(f"kit/scenes/{name}.mtl").read().split()): used.append(name)
check("obj_stl_and_json_are_one_scene", not forms, forms)
check("coordinates_are_of_single_precision", not single, single)
check("every_material_is_in_the_tables", not used, used)

kit = json.load(open("kit/kit.json"))
check("kit_json_holds_the_cases", [(c["scene"], c["attitude"], c["sigma_m2"], c["bound_m2"]) for c in kit["cases"]]
      == [(c["scene"], c["attitude"], float(c["sigma_m2"]), float(c["bound_m2"])) for c in cases])
check("every_tier_has_scenes", {s["tier"] for s in kit["scenes"]} == {t["tier"] for t in kit["tiers"]} == {1, 2, 3, 4, 5})

def dot(a, b): return sum(x * y for x, y in zip(a, b))
def rotation(q):
    w, x, y, z = q
    return ((1-2*(y*y+z*z), 2*(x*y-w*z), 2*(x*z+w*y)), (2*(x*y+w*z), 1-2*(x*x+z*z), 2*(y*z-w*x)), (2*(x*z-w*y), 2*(y*z+w*x), 1-2*(x*x+y*y)))
def normal(a, b, c):
    u, w = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
    return (u[1]*w[2]-u[2]*w[1], u[2]*w[0]-u[0]*w[2], u[0]*w[1]-u[1]*w[0])

frames, sums, angles = [], [], []
for c in cases:
    s = [float(c[k]) for k in ("sx", "sy", "sz")]
    R = rotation([float(c[k]) for k in ("qw", "qx", "qy", "qz")])
    az, el = (math.radians(float(c[k])) for k in ("az_deg", "el_deg"))
    t = (math.cos(el)*math.cos(az), math.cos(el)*math.sin(az), math.sin(el))
    if max(abs(a - b) for a, b in zip(R[2] + t, s + s)) > 1e-15: frames.append(c["scene"] + " " + c["attitude"])
    if int(c["tier"]) > 2: continue
    v, f, m = scenes[c["scene"]]
    sigma = glint = 0
    for t, name in zip(f, m):
        n = normal(*(v[i] for i in t))
        k = math.hypot(*n)
        cos = dot(n, s) / k
        A, B, slope, power = (float(materials[name][x]) for x in "ABsm")
        if cos > 0:
            # tan^2 from the cross product: near the normal the cosine has lost it
            cross = normal((0, 0, 0), n, s)
            g = A * cos**-6 * math.exp(-dot(cross, cross) / dot(n, s)**2 / slope**2) * cos**2 * k / 2 * 4 * math.pi
            glint += g
            sigma += g + 4 * math.pi * B * cos**power * cos**2 * k / 2
    if abs(sigma - float(c["sigma_m2"])) > 2e-13 * sigma + 1e-290: sums.append((c["scene"], c["attitude"], sigma, c["sigma_m2"]))
    if abs(glint - float(c["glint_m2"])) > 2e-13 * glint + 1e-290: sums.append((c["scene"], c["attitude"], glint, c["glint_m2"]))
check("quaternion_direction_azimuth_and_elevation_are_one_attitude", not frames, frames[:3])
check("tiers_1_and_2_are_what_eq_2_says", not sums, sums[:3])
check("bounds_are_small", all(float(c["bound_m2"]) <= 1e-10 * float(c["sigma_m2"]) + 1e-290 for c in cases))

records = {}
for path in glob.glob("kit/truth/*.facets.csv"):
    for r in csv.DictReader(open(path)): records.setdefault((r["scene"], r["attitude"]), []).append(r)
off = [k for c in cases if (k := (c["scene"], c["attitude"])) and (
    abs(math.fsum(float(r["sigma_m2"]) for r in records[k]) - float(c["sigma_m2"])) > 1e-13 * float(c["sigma_m2"])
    or abs(math.fsum(float(r["visible_area_m2"]) for r in records[k]) - float(c["silhouette_m2"])) > 1e-12 * float(c["silhouette_m2"])
    or [int(r["facet"]) for r in records[k]] != list(range(len(scenes[k[0]][1]))))]
check("facets_add_up_to_the_case", not off, off[:3])

# Images: the first facet along the line of sight of a pixel, by a search over all facets.
wrong, deep, pictures, shown = [], [], [], 0
for c in cases:
    N = int(c["image"])
    if N == 0: continue
    shown += 1
    stem = f"kit/truth/{c['scene']}.{c['attitude']}."
    item = struct.unpack(f"<{N*N}I", open(stem + "item.u32", "rb").read())
    depth = struct.unpack(f"<{N*N}d", open(stem + "depth.f64", "rb").read())
    png = Png(stem + "item.png")
    ids = [int.from_bytes(row[3*x:3*x+3], "big") for row in png.rows for x in range(N)]
    if not png.sums or [(i + 1) & 0xffffffff for i in item] != ids: pictures.append(stem)
    if c["scene"] not in ("box", "wings", "tray", "gate", "comb"): continue
    R = rotation([float(c[k]) for k in ("qw", "qx", "qy", "qz")])
    v, f, m = scenes[c["scene"]]
    p = [tuple(dot(r, x) for r in R) for x in v]
    left, top, side = (float(c[k]) for k in ("left_m", "top_m", "side_m"))
    for i in range(0, N * N, 7):
        x, y = left + (i % N + .5) * side / N, top - (i // N + .5) * side / N
        best, near = 0xffffffff, -math.inf
        for k, t in enumerate(f):
            a, b, d = (p[j] for j in t)
            turn = lambda g, h: (h[0]-g[0])*(y-g[1]) - (h[1]-g[1])*(x-g[0])
            e = (turn(a, b), turn(b, d), turn(d, a))
            if min(e) >= 0 or max(e) <= 0:
                n = normal(a, b, d)
                z = a[2] - (n[0]*(x-a[0]) + n[1]*(y-a[1])) / n[2]
                if z > near: best, near = k, z
        if best != item[i]: wrong.append((stem, i, best, item[i]))
        elif best != 0xffffffff and abs(near - depth[i]) > 1e-12 * side: deep.append((stem, i))
        elif best == 0xffffffff and not math.isnan(depth[i]): deep.append((stem, i))
check("most_scenes_have_images", shown > 30)
check("item_images_show_the_nearest_facet", not wrong, wrong[:3])
check("depths_are_those_of_the_planes", not deep, deep[:3])
check("pngs_hold_the_same_items", not pictures, pictures[:3])
END
finish
