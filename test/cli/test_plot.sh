#!/bin/sh
# SPDX-License-Identifier: MIT
# lrcs plot: drawn from files, a sweep, a profile or a comparison looks as it did from its rows; curves of several files; maps in
# Mollweide's projection, held against its formula; and which files are refused.
. "$(dirname "$0")/check.sh"
cd "$scratch" || exit 1
pair_scene >pair.toml
printf 'name = "The; bus"\n[[part]]\nname = "bus, and; \\"x\\""\nshape = "box"\nsize = [1, 1.5, 2]\n[part.joint]\naxis = [0, 0, 1]\nangle_deg = 0\n' >bus.toml
swept() { # NAME OPTIONS: drawn from its rows, and again from each form of file
    name=$1
    shift
    run sweep "$@" --tolerance 0.01 -o "$name.csv" --plot "$name.svg" --stats-file "$name.json"
    [ "$rc" -eq 1 ] || [ "$rc" -eq 2 ] && not_ok "swept_$name" "$err"
    for form in csv jsonl npy; do
        [ $form = csv ] || run sweep "$@" --tolerance 0.01 -o "$name.$form"
        run plot "$name.$form" -o again.svg --stats-file again.json $options
        [ "$rc" -eq 0 ] || echo "# $err"
        same "${name}_is_drawn_again_from_$form" "$rc $(cmp "$name.svg" again.svg && cmp "$name.json" again.json && echo same)" "0 same"
    done
}
options=
swept curve pair.toml --az 0:90:5 --el 10
swept few pair.toml --el 30:-30:-30 --az 0:40:5 --accept estimate --material 1,0.2,0.3,0.4
swept map pair.toml --az 0:90:10 --el -70:70:10
swept euler pair.toml --euler XYZ:0:90:10,30,0
swept turn pair.toml --direction 1,1,0 --rotate 1,1,2:0:90:10
swept sphere pair.toml --sphere 60
swept joint bus.toml --joint 'bus, and; "x":0:60:5' --vary 'bus, and; "x".size_x:1:2:0.5' --azel 10,20
same an_axis_is_named_by_its_joint "$(grep -c '>joint of bus, and; [^<]* (deg)<' joint.svg)" 1
printf 'time,x,y,z\n0,1,0,0\n1,1,1,0\n3,0,1,0.5\n' >track.csv
run sweep pair.toml --poses track.csv --tolerance 0.01 -o poses.csv --plot poses.svg
run plot poses.csv -o again.svg
same poses_are_drawn_again "$rc $(cmp poses.svg again.svg && echo same)" "0 same"
run sweep pair.toml --poses track.csv --tolerance 0.01 -o poses.npy
failure a_map_of_poses_holds_no_times "a .npy holds no times" plot poses.npy -o x.svg

# Several together.
run plot curve.csv curve.jsonl -o both.svg -o both.png --dbsm
same two_of_one_sweep_have_the_names_of_files "$rc $(grep -c '>curve.csv<\|>curve.jsonl<' both.svg)" "0 2"
same the_charts_are_named "$err" "wrote both.svg
wrote both.png"
run sweep bus.toml --az 0:90:5 --tolerance 0.01 -o bus.csv
run plot curve.csv bus.csv -o two.svg
same two_scenes_have_their_titles "$rc $(grep -c '>pair.toml<\|>The; bus<' two.svg)" "0 2"
same what_differs_is_said "$(printf '%s\n' "$err" | sed -n 's/^notice: bus.csv differs from curve.csv in //p')" "scene, el, title, files"
run plot few.csv curve.csv -o x.svg
same curves_of_few_and_one "$rc $(grep -c '>few.csv, elevation 30 deg<\|>curve.csv<' x.svg)" "0 2"
rm -f x.svg
usage_error maps_are_drawn_one_by_one "map.csv is a map: maps are drawn one by one" plot curve.csv map.csv -o x.svg
usage_error axes_must_be_the_same "runs along 'az_deg' and turn.csv along 'rotate_deg': they do not fit" plot curve.csv turn.csv -o x.svg
usage_error no_more_than_seven "at most 7 curves in one chart, found 9" plot few.csv few.csv few.csv -o x.svg
usage_error statistics_are_of_one_file "--stats needs a single file, found 2" plot curve.csv bus.csv --stats
usage_error nothing_to_do "nothing to do: give -o OUT.svg, --stats or --stats-file" plot curve.csv
usage_error not_over_its_input "would overwrite what is read" plot curve.csv --stats-file ./curve.csv
usage_error a_form_is_needed "-o: expected FILE.svg or FILE.png, found 'x.pdf'" plot curve.csv -o x.pdf
usage_error projections_are_two "--projection: expected flat or mollweide, found 'mercator'" plot map.csv -o x.svg --projection mercator
usage_error a_curve_has_no_projection "--projection mollweide needs azimuths over at most 360 deg" plot curve.csv -o x.svg --projection mollweide
usage_error polar_draws_no_map "--polar draws curves, --projection maps: give one" plot map.csv -o x.svg --projection mollweide --polar
usage_error a_sphere_has_no_angle "--plot: the directions of --sphere are drawn as a map" plot sphere.csv -o x.svg --polar

# What is no whole sweep.
failure no_sweep "expected what lrcs sweep writes" plot pair.toml -o x.svg
failure nothing_there "none.csv: cannot open" plot none.csv -o x.svg
sed 's/^5,25,10,\(.\)/5,25,10,9\1/' curve.csv >damaged.csv
failure a_changed_digit "damaged.csv: is damaged: line 8, sigma_dbsm" plot damaged.csv -o x.svg
sed 's/^5,25,/5,26,/' curve.csv >moved.csv
failure a_changed_angle "moved.csv: is damaged: line 8, az_deg: found '26', expected 25" plot moved.csv -o x.svg
sed '$d' curve.csv >short.csv
failure a_file_without_its_end "short.csv: ends without its checksum" plot short.csv -o x.svg
run sweep pair.toml --az 0:90:5 --el 10 --tolerance 0.01 --shard 2/3 -o part.csv
failure a_shard "part.csv: holds 6 of 19 rows: join the shards with lrcs merge" plot part.csv -o x.svg
cp map.npy bent.npy
cp map.npy.head bent.npy.head
printf 'x' | dd of=bent.npy bs=1 seek=600 conv=notrunc 2>/dev/null
failure a_changed_map "bent.npy: expected a map of lrcs sweep with its FILE.npy.head" plot bent.npy -o x.svg
rm bent.npy.head
failure a_map_without_its_head "expected a map of lrcs sweep with its FILE.npy.head" plot bent.npy -o x.svg
same nothing_was_written "$(ls x.svg 2>/dev/null)" ""

run sweep pair.toml --az 0:360:15 --el -90:90:15 --tolerance 0.01 -o all.csv
run plot all.csv -o all.svg -o all.png --projection mollweide
same a_whole_map_is_drawn "$rc" 0
# shapes: what a drawing consists of.
shapes() { grep -E '<(path|polygon|polyline|rect|line|circle)' "$1"; }
run sweep pair.toml --az 0:345:15 --el -90:90:15 --tolerance 0.01 -o ring.csv
run plot ring.csv -o ring.svg --projection mollweide
same a_turn_without_its_last_step_is_drawn_whole "$rc $(shapes all.svg | grep -c . | awk '{ print ($1 > 50) }') $(shapes ring.svg | cksum)" "0 1 $(shapes all.svg | cksum)"
run sweep pair.toml --az 0:330:15 --el -90:90:15 --tolerance 0.01 -o gap.csv
run plot gap.csv -o gap.svg --projection mollweide
same what_was_not_computed_stays_empty "$rc $(shapes gap.svg | cksum | grep -c "$(shapes all.svg | cksum)")" "0 0"
run plot sphere.csv -o ball.svg --projection mollweide --dbsm
same a_sphere_is_drawn "$rc" 0
# Tables of profile.
run profile bus.toml --azel 20,30 --bin 0.05 --csv flat.csv --plot flat.svg
run profile bus.toml --azel 20,30 --bin 0.05 --pulse-fwhm 0.3 --csv pulse.csv --plot pulse.svg
run profile pair.toml --azel 20,30 --bin 0.5 --csv coarse.csv --plot coarse.svg
for name in flat pulse coarse; do
    run plot $name.csv -o again.svg -o again.png
    same "${name}_is_drawn_again" "$rc $(cmp $name.svg again.svg && echo same) $(head -c 4 again.png | tail -c 3)" "0 same PNG"
done
run sweep pair.toml --az 0:90:10 --tolerance 0.01 --stats-file dist.csv -o turned.csv
usage_error statistics_are_drawn_from_their_sweep "dist.csv holds statistics: draw them from the sweep's own file" plot dist.csv -o y.svg
usage_error profiles_have_no_dbsm "--dbsm is for sweeps: flat.csv is a range profile" plot flat.csv --dbsm -o y.svg
usage_error profiles_are_drawn_one_by_one "flat.csv is a range profile: these are drawn one by one" plot flat.csv coarse.csv -o y.svg
cp flat.csv same.svg
usage_error not_over_a_profile "-o ./same.svg: would overwrite what is read" plot same.svg -o ./same.svg
usage_error a_profile_needs_an_output "nothing to do: give -o OUT.svg" plot flat.csv
usage_error a_profile_needs_a_known_form "-o: expected FILE.svg or FILE.png, found 'y.pdf'" plot flat.csv -o y.pdf
sed '2s/sigma_glint_m2/glint/' flat.csv >odd.csv
failure a_profile_without_a_column "odd.csv: has no column 'sigma_glint_m2'" plot odd.csv -o y.svg
sed '4s/,.*/,x,1,1,1,1,1/' flat.csv >odd.csv
failure a_profile_with_a_word "odd.csv: line 4, column far_m" plot odd.csv -o y.svg
sed '3,$d' flat.csv >odd.csv
failure a_profile_without_rows "odd.csv: has no rows: nothing to draw" plot odd.csv -o y.svg

# Tables of converge, with the truth beside them.
printf 'name = "The; bus=1\\n\\"b\\\\c\\""\n[[part]]\nname = "c"\nshape = "cylinder"\nradius = 0.5\nlength = 1\n[[part]]\nname = "b"\nshape = "box"\nsize = [1, 1, 1]\ntranslate = [2, 0, 0]\n' >round.toml
run converge round.toml --azel 20,30 --seconds 0.3 --csv accuracy.csv --plot accuracy.svg
run plot accuracy.csv -o again.svg -o again.png
same a_comparison_is_drawn_again "$rc $(cmp accuracy.svg again.svg && echo same) $(head -c 4 again.png | tail -c 3)" "0 same PNG"
printf '[[part]]\nname = "k"\nshape = "cone"\nradius = 0.5\nlength = 1\n' >cone.toml
run converge cone.toml --azel 20,30 --seconds 0.3 --csv cone.csv --plot cone.svg
run plot cone.csv -o again.svg
same one_with_a_closed_form_is_drawn_again "$rc $(cmp cone.svg again.svg && echo same)" "0 same"
usage_error a_comparison_has_no_dbsm "--dbsm is for sweeps: cone.csv is a table of lrcs converge" plot cone.csv --dbsm -o y.svg
cp cone.csv alone.csv
failure a_comparison_without_its_truth "alone.csv: expected its FILE.json" plot alone.csv -o y.svg
cp accuracy.csv.json alone.csv.json
failure a_comparison_with_another_truth "alone.csv: is not the table that its FILE.json describes" plot alone.csv -o y.svg
# damaged SED: a comparison with a change, whose FILE.json states its hash.
damaged() {
    sed "$1" cone.csv >alone.csv
    printf '{\n  "hash": "%s",\n  "about": "lrcs x converge; %s; truth_of=shapes; truth=t"\n}\n' "$(fnv1a alone.csv)" "${2-direction=1,0,0; truth_m2=1; truth_bound_m2=0}" >alone.csv.json
}
damaged '' && run plot alone.csv -o again.svg
same a_comparison_described_by_hand "$rc" 0
damaged '2s/,[a-z]*,/,guess,/'
failure a_comparison_by_no_method "alone.csv: line 2, column method" plot alone.csv -o y.svg
damaged '1s/pose_ms/pose/'
failure a_comparison_without_times "alone.csv: has no column 'pose_ms'" plot alone.csv -o y.svg
damaged '2s/1e-1,/1e-9,/'
failure a_comparison_of_no_mesh "alone.csv: line 2, column setting" plot alone.csv -o y.svg
damaged '2s/,\([^,]*,[^,]*,[^,]*,[^,]*,[^,]*,[^,]*\)$/,-\1/'
failure a_comparison_with_a_negative_bound "alone.csv: line 2, column bound_m2" plot alone.csv -o y.svg
damaged '' 'truth_m2=1; truth_bound_m2=0'
failure a_comparison_without_a_direction "states no truth or direction" plot alone.csv -o y.svg
damaged '2,$d'
failure a_comparison_without_rows "alone.csv: has no rows: nothing to draw" plot alone.csv -o y.svg
same nothing_odd_was_drawn "$(ls y.svg 2>/dev/null)" ""
command -v python3 >/dev/null || { skip what_python_reads "no python3"; finish; exit; }
python3 - <<'END' || not_ok the_python_ends_well
import csv, math
import xml.etree.ElementTree as tree
from tap import check
NS = "{http://www.w3.org/2000/svg}"
def areas(path):
    out = []
    for e in tree.parse(path).getroot().iter(NS + "polygon"):
        p = [tuple(map(float, s.split(","))) for s in e.get("points").split()]
        out.append((e.get("fill"), p))
    return out
def spot(az, el):  # from Mollweide's definition, by bisection
    low, high = -math.pi / 2, math.pi / 2
    for _ in range(200):
        t = (low + high) / 2
        if 2 * t + math.sin(2 * t) < math.pi * math.sin(math.radians(el)): low = t
        else: high = t
    az = (az + 180) % 360 - 180
    return 406 + 324 * az / 180 * math.cos(t), 261 - 162 * math.sin(t)
def inside(p, at):
    sign = [(b[0] - a[0]) * (at[1] - a[1]) - (b[1] - a[1]) * (at[0] - a[0]) for a, b in zip(p, p[1:] + p[:1])]
    return all(v >= 0 for v in sign) or all(v <= 0 for v in sign)
def colour_at(list, at):
    found = [c for c, p in list if len(p) == 4 and inside(p, at)]
    return found[-1] if found else None
def light(c):  # of the palette, which grows lighter
    r, g, b = (int(c[i:i + 2], 16) for i in (1, 3, 5))
    return 0.299 * r + 0.587 * g + 0.114 * b
def ordered(svg, rows):  # every two places: more sigma is no darker
    list = areas(svg)
    seen = []
    for az, el, sigma in rows:
        c = colour_at(list, spot(az, el))
        if not c: return False
        seen.append((sigma, light(c)))
    seen.sort()
    return all(b[1] >= a[1] - 2 for a, b in zip(seen, seen[1:]))
table = lambda f: list(csv.DictReader(l for l in open(f) if l[0] != "#"))
rows = [(float(r["az_deg"]) + 1, float(r["el_deg"]), float(r["sigma_m2"])) for r in table("all.csv")
        if abs(float(r["el_deg"])) < 80 and float(r["az_deg"]) not in (180, 360, 0, 60, 120, 240, 300)]
check("each_place_of_a_map_has_its_colour", len(rows) > 150 and ordered("all.svg", rows))
ball = [(math.degrees(math.atan2(float(r["y"]), float(r["x"]))), math.degrees(math.asin(float(r["z"]))), float(r["sigma_m2"])) for r in table("sphere.csv")]
ball = [r for r in ball if abs(r[1]) > 8 and abs(r[1]) < 75 and r[2] > 0]
check("each_direction_of_a_sphere_has_its_colour", len(ball) > 40 and ordered("ball.svg", ball))
inside_ellipse = lambda p: all(((x - 406) / 324) ** 2 + ((y - 261) / 162) ** 2 < 1.001 for x, y in p)
check("no_cell_leaves_the_ellipse", all(inside_ellipse(p) for c, p in areas("all.svg") if len(p) == 4 and p[0][0] < 735 and c != "#ffffff"))
END
finish
