#!/bin/sh
# SPDX-License-Identifier: MIT
# lrcs sweep --brightest: which rows it lists, against Python's own search of the sweep's CSV, and who
# makes them, against lrcs run --shares.
. "$(dirname "$0")/check.sh"
cd "$scratch" || exit 1
pair_scene >pair.toml
{
    pair_scene
    printf '[[part]]\nname = "wing"\nshape = "plate"\nsize = [2, 1]\ntranslate = [3, 0, 0]\n[part.joint]\naxis = [1, 0, 0]\nangle_deg = 0\n'
} >wing.toml

cut="sweep pair.toml --tolerance 0.01 --az 0:360:10 --el 10"
usage_error brightest_wants_a_file "--brightest needs -o FILE" $cut --brightest 3
usage_error brightest_is_a_count "--brightest: expected a whole number 1 .. 1000" $cut -o x.csv --brightest 0
usage_error brightest_is_of_whole_sweeps "leave out --shard" $cut -o x.csv --shard 1/2 --brightest 3
same nothing_was_written "$(ls x.csv* 2>/dev/null)" ""

# listed NAME ARGUMENTS...: sweeps into NAME.csv, and keeps the table.
listed() {
    name=$1
    shift
    run "$@" -o "$name.csv" --brightest 40
    same "${name}_is_swept" "$(printf '%s' "$rc" | tr 3 0)" 0
    printf '%s\n' "$out" >"$name.txt"
}
listed cut $cut
listed open sweep pair.toml --tolerance 0.01 --az 0:350:10 --el 10
listed part sweep pair.toml --tolerance 0.01 --az 5:95:10 --el 10
listed map sweep pair.toml --tolerance 0.01 --az 0:360:15 --el -90:90:15
listed turn sweep pair.toml --tolerance 0.01 --azel 90,0 --rotate x:-180:180:10
listed euler sweep pair.toml --tolerance 0.01 --euler XYZ:0:360:30,20,0:90:30
listed joint sweep wing.toml --tolerance 0.01 --joint wing:0:90:15 --azel 50,40
listed vary sweep pair.toml --tolerance 0.01 --vary paint-white.s:0.1:0.5:0.1 --az 0:90:10
listed sphere sweep pair.toml --tolerance 0.01 --sphere 300
printf 'time,x,y,z\n0,1,0,0\n1,1,1,0\n2,0,1,0.5\n4,0,0,1\n5,0,0.1,1\n' >poses.csv
listed track sweep pair.toml --tolerance 0.01 --poses poses.csv

run $cut -o cut.csv --resume --brightest 40
same a_whole_sweep_lists_the_same "$out" "$(cat cut.txt)"
head -c 1200 cut.csv >half.csv.partial
run $cut -o half.csv --resume --brightest 40
same a_resumed_sweep_lists_the_same "$out" "$(cat cut.txt)"
run $cut -o few.csv --brightest 2 --jobs 2
same the_first_two_are_the_two_brightest "$out" "$(head -10 cut.txt)"
run $cut -o map.npy --brightest 40
same a_map_lists_the_same "$out" "$(cat cut.txt)"

run run pair.toml --tolerance 0.01 --azel 90,0 --shares --json
printf '%s\n' "$out" >shares.json
run sweep pair.toml --tolerance 0.01 --az 90 --el 0 -o one.csv --brightest 1
printf '%s\n' "$out" >one.txt

command -v python3 >/dev/null || { skip what_python_reads "no python3"; finish; exit; }
python3 - <<'END' || not_ok the_python_ends_well
import csv, itertools, json, math, sys
from tap import check
def rows(name): return list(csv.DictReader(l for l in open(name + ".csv") if not l.startswith("#")))
def table(name): return [l.split() for l in open(name + ".txt") if l[:4].strip().isdigit()]
def attitude(az, el):
    a, e = math.radians(az), math.radians(el)
    return (math.cos(e) * math.cos(a), math.cos(e) * math.sin(a), math.sin(e))
# Neighbours by what the axes mean, not by how rows are stored: steps, angles modulo a turn, and for
# azimuth and elevation whether the attitudes themselves are one.
def steps(axis, step, turn):
    def near(a, b):
        d = [abs(float(a[k]) - float(b[k])) for k in axis]
        return all(min(x, 360 - x) <= s + 1e-9 if t else x <= s + 1e-9 for x, s, t in zip(d, step, turn))
    return near
def map_near(a, b):
    p, q = [(float(r["az_deg"]), float(r["el_deg"])) for r in (a, b)]
    if abs(p[1] - q[1]) > 15: return False
    if 90 in (abs(p[1]), abs(q[1])): return abs(p[1]) == 90 or abs((p[0] - q[0] + 180) % 360 - 180) <= 15
    return abs((p[0] - q[0] + 180) % 360 - 180) <= 15
def map_same(a, b):
    return math.dist(attitude(float(a["az_deg"]), float(a["el_deg"])), attitude(float(b["az_deg"]), float(b["el_deg"]))) < 1e-9
def angles_same(*axis):
    return lambda a, b: all(abs((float(a[k]) - float(b[k]) + 180) % 360 - 180) < 1e-9 for k in axis)
def peaks(rows, near, same):
    found = []
    for i, r in enumerate(rows):
        sigma = float(r["sigma_m2"])
        if any(same(r, q) for q in rows[:i]): continue
        if sigma > 0 and not any(near(r, q) and (float(q["sigma_m2"]), -j) > (sigma, -i) and not same(r, q)
                                 for j, q in enumerate(rows)): found.append(i)
    return sorted(found, key=lambda i: (-float(rows[i]["sigma_m2"]), i))
never = lambda a, b: False
cases = {
    "cut": (steps(["az_deg"], [10], [1]), angles_same("az_deg")),
    "open": (steps(["az_deg"], [10], [1]), never),
    "part": (steps(["az_deg"], [10], [0]), never),
    "map": (map_near, map_same),
    "turn": (steps(["rotate_deg"], [10], [1]), angles_same("rotate_deg")),
    "euler": (steps(["euler_a_deg", "euler_c_deg"], [30, 30], [1, 0]), angles_same("euler_a_deg", "euler_c_deg")),
    "joint": (steps(["wing.joint_deg"], [15], [0]), never),
    "vary": (steps(["paint-white.s", "az_deg"], [0.1, 10], [0, 0]), never)}
for name, (near, same) in cases.items():
    r = rows(name)
    want = peaks(r, near, same)
    check("peaks_of_" + name, len(want) > 0 and [int(t[1]) for t in table(name)] == want[:40])
r = rows("track")
s = [float(q["sigma_m2"]) for q in r]
want = sorted((i for i in range(5) if s[i] > 0 and all(s[i] > s[j] for j in (i - 1, i + 1) if 0 <= j < 5)), key=lambda i: -s[i])
check("peaks_of_a_track", [int(t[1]) for t in table("track")] == want and len(want) > 0)
r, t = rows("sphere"), table("sphere")
p = [tuple(float(q[k]) for k in "xyz") for q in r]
s = [float(q["sigma_m2"]) for q in r]
spacing = math.sqrt(4 * math.pi / len(r))
listed = [int(q[1]) for q in t]
check("peaks_of_a_sphere_are_no_flanks", len(listed) > 3 and all(s[i] >= s[j] for i in listed for j in range(len(r)) if math.dist(p[i], p[j]) < 1.2 * spacing))
check("no_peak_of_a_sphere_is_missed", all(i in listed for i in range(len(r)) if s[i] > 0 and
    not any(s[j] > s[i] for j in range(len(r)) if math.dist(p[i], p[j]) < 2.1 * spacing)))
check("the_brightest_comes_first", listed[0] == s.index(max(s)))
m = rows("map")
check("numbers_are_those_of_the_rows", all((float(q[2]), float(q[3]), q[4], q[5]) ==
    (float(m[int(q[1])]["az_deg"]), float(m[int(q[1])]["el_deg"]), "%.6g" % float(m[int(q[1])]["sigma_m2"]),
     "%.3f" % float(m[int(q[1])]["sigma_dbsm"])) for q in table("map")))

shares = json.load(open("shares.json"))
lines = open("one.txt").read().split("\n")
glint = shares["sigma_glint_m2"] / shares["sigma_m2"]
check("glint_is_that_of_the_run", lines[2].split()[-2] == "%.1f" % (100 * glint))
def told(list): return ["%s %.1f %%" % (q["name"], 100 * q["share"]) for q in list if q["sigma_m2"] > 0]
check("parts_are_those_of_the_run", lines[3].split(None, 1)[1].split(", ") == told(shares["shares"]["parts"])[:3])
check("materials_are_those_of_the_run", lines[4].split(None, 1)[1].split(", ") == told(shares["shares"]["materials"])[:3])
check("facets_are_those_of_the_run", lines[5].split(None, 1)[1].split(", ") == [
    "%d of %s at %.2f deg %.1f %%" % (f["facet"], f["part"], f["theta_deg"], 100 * f["share"]) for f in shares["shares"]["facets"][:3]])
END
finish
