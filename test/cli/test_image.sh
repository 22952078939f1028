#!/bin/sh
# SPDX-License-Identifier: MIT
# lrcs image: what it refuses, and its files, read by other programs: Python's zlib and XML parser, a
# reader of legacy VTK written from its documentation, and VTK itself where it is installed.
. "$(dirname "$0")/check.sh"

cd "$scratch" || exit 1
plates_scene >pair.toml
printf 'newmtl red\nKd 1 0 0\nnewmtl sea\nKd 0 0.2 0.6\n' >m.mtl
cat >m.obj <<'END'
mtllib m.mtl
v 0 0 0
v 1 0 0
v 1 1 0
v 0 1 0
v 2 0 0
v 2 1 0
usemtl red
f 1 2 3
f 1 3 4
usemtl sea
f 2 5 6
f 2 6 3
END
cksum m.obj m.mtl pair.toml >before

usage_error it_asks_for_a_file "give -o FILE.png, --visible FILE.svg or --vtk FILE.vtp" image demo
usage_error a_picture_is_png "-o: expected FILE.png, found 'x.jpg'" image demo -o x.jpg
usage_error a_picture_is_not_stdout "-o: expected FILE.png, found '-'" image demo -o -
usage_error polygons_are_svg "--visible: expected FILE.svg, found 'x.pdf'" image demo --visible x.pdf
usage_error a_surface_is_vtp_or_vtk "--vtk: expected FILE.vtp or FILE.vtk, found 'x.vtu'" image demo --vtk x.vtu
usage_error looks_are_named "--by: expected sigma, theta, range, facet, material or shaded, found 'depth'" \
    image demo -o x.png --by depth
usage_error grounds_are_named "--ground: expected dark or white, found 'red'" image demo -o x.png --ground red
usage_error a_size_wants_a_picture "--size needs -o FILE.png" image demo --visible x.svg --size 64
usage_error a_size_has_limits "--size" image demo -o x.png --size 8
: >there.png
ln -s there.png there.svg
usage_error one_file_is_not_two "-o and --visible name the same file" image demo -o there.png --visible there.svg
: >m.png
ln -f m.obj m.png
usage_error not_over_the_model "-o m.png: would overwrite m.obj" image m.obj -o m.png
ln -f m.mtl m.svg
usage_error not_over_its_materials "--visible m.svg: would overwrite m.mtl" image m.obj --visible m.svg
failure a_folder_that_is_not_there "none/p.vtk" image demo --vtk none/p.vtk
rm m.png m.svg
same the_inputs_are_intact "$(cksum m.obj m.mtl pair.toml)" "$(cat before)"

python3 - 2>/dev/null <<'END'
cells = [(i % 10, i // 10) for i in range(70)]
with open("many.obj", "w") as out:
    for x, y in cells: out.write("".join("v %d %d 0\n" % (x + a, y + b) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))))
    for i in range(70): out.write("usemtl material %02d\nf %d %d %d %d\n" % (i, 4 * i + 1, 4 * i + 2, 4 * i + 3, 4 * i + 4))
END
for colouring in sigma theta range facet material shaded; do
    run image pair.toml --by $colouring --size 192 -o $colouring.png --visible $colouring.svg
    same "by_${colouring}_is_drawn" "$rc" 0
done
run image pair.toml --azel 0,30 --by theta --size 192 -o slant.png
run image m.obj --by material --size 192 --ground white -o coloured.png --visible coloured.svg
run image m.obj --by shaded --size 192 --ground white -o own.png
[ ! -s many.obj ] || run image many.obj --by material --visible many.svg
run image m.obj --size 48 -o small.png
same a_small_picture_has_no_legend "$rc" 0
run run demo --azel 50,40 --tolerance 0.01 --image run.png
run image demo --azel 50,40 --tolerance 0.01 -o image.png --vtk demo.vtp
same the_picture_of_a_run_is_the_same "$(cksum <run.png)" "$(cksum <image.png)"
run image demo --azel 50,40 --tolerance 0.01 --vtk demo.vtk
run run demo --azel 50,40 --tolerance 0.01 --facets demo.csv --json
printf '%s\n' "$out" >demo.json

command -v python3 >/dev/null || { skip what_python_reads "no python3"; finish; exit; }
python3 - <<'END' || not_ok the_python_ends_well
import csv, json, math, re, struct, sys
import xml.etree.ElementTree as tree
from png_file import Png
from tap import check, skip

def pixels(path):
    return [[tuple(row[k:k + 3]) for k in range(0, len(row), 3)] for row in Png(path).rows]
# The drawing is a square about (96, `middle`) whose side is what the legend leaves of 192 pixels.
def at(rows, u, v, side=192 - 2 * 6 - 48):
    return rows[round(6 + side * (1 - v))][round(96 + side * (u - 0.5))]
def viridis(t):
    knots = [(68, 1, 84), (71, 44, 122), (59, 81, 139), (44, 113, 142), (33, 144, 141), (39, 173, 129),
             (92, 200, 99), (170, 220, 50), (253, 231, 37)]
    i = min(int(8 * t), 7)
    return tuple(a + (8 * t - i) * (b - a) for a, b in zip(knots[i], knots[i + 1]))
def like(a, b, most=1.01):
    return all(abs(x - y) <= most for x, y in zip(a, b))

png = {k: pixels(k + ".png") for k in "sigma theta range facet material shaded slant coloured small own".split()}
# Plates at -0.5 and 0.5 m of the box's centre, on a scale from -0.6 to 0.6.
check("range_of_the_low_plate", like(at(png["range"], 0.25, 0.25), viridis(1 / 12)))
check("range_of_the_high_plate", like(at(png["range"], 0.75, 0.75), viridis(11 / 12)))
check("head_on_theta_is_0", like(at(png["theta"], 0.25, 0.25), viridis(0)))
check("slant_theta_is_60", like(at(png["slant"], 0.4, 0.2), viridis(60 / 90)))
check("two_facets_have_two_colours", at(png["facet"], 0.3, 0.1) != at(png["facet"], 0.1, 0.3))
check("shaded_surfaces_have_the_models_own_colours", at(png["own"], 0.3, 0.5) == (255, 0, 0) and at(png["own"], 0.7, 0.5) == (0, 51, 153))
check("a_plain_plate_head_on_is_lit", like(at(png["shaded"], 0.25, 0.25), (200, 200, 200)))
check("materials_have_false_colours", at(png["coloured"], 0.3, 0.5, 192 - 12 - 66) == (0xe6, 0x9f, 0) and
      at(png["coloured"], 0.7, 0.5, 192 - 12 - 66) == (0x56, 0xb4, 0xe9))
check("white_ground_is_white", png["coloured"][0][0] == (255, 255, 255))
check("the_legend_names_colours", sum(row.count((0x56, 0xb4, 0xe9)) for row in png["coloured"][192 - 66:]) >= 100)
check("small_pictures_are_drawing", len(png["small"]) == 48 and png["small"][24][24] != png["small"][0][0])

NS = "{http://www.w3.org/2000/svg}"
def svg(path):
    root = tree.parse(path).getroot()
    group = root.find(NS + "g")
    matrix = [float(x) for x in re.match(r"matrix\((.*)\)", group.get("transform")).group(1).split()]
    areas = {}
    for p in group.iter(NS + "path"):
        for ring in p.get("d").split("Z")[:-1]:
            xy = [tuple(map(float, s.split())) for s in ring[1:].split("L")]
            areas[p.get("id")] = areas.get(p.get("id"), 0) + sum(
                a[0] * b[1] - a[1] * b[0] for a, b in zip(xy, xy[1:] + xy[:1])) / 2
    return root, group, matrix, areas
for colouring in "sigma theta range facet material shaded".split():
    root, group, matrix, areas = svg(colouring + ".svg")
    check(colouring + "_svg_shows_what_is_visible", set(areas) == {"f0", "f1", "f2", "f3"} and
          math.isclose(areas["f0"] + areas["f1"], 3, rel_tol=1e-12) and
          math.isclose(areas["f2"] + areas["f3"], 1, rel_tol=1e-12))
    words = [t.text for t in root.iter(NS + "text")]
    bar = next(w for w in words if re.fullmatch(r"[0-9.]+ m", w))
    ends = [[float(s.split(",")[0]) for s in e.get("points").split()] for e in root.iter(NS + "polyline")]
    check(colouring + "_svg_bar_has_its_length", any(abs(abs(p[0] - p[-1]) - float(bar[:-2]) * matrix[0]) < 0.02 for p in ends))
root, group, matrix, areas = svg("many.svg")
fills = [p.get("fill") for p in group.iter(NS + "path")]
check("sixty_four_materials_have_colours_of_their_own", len(set(fills[:128])) == 64, len(set(fills[:128])))
names = [t.text for t in root.iter(NS + "text")]
listed = [n for n in names if re.match("material ", n or "")]
check("the_legend_says_how_many_more", "and %d more" % (70 - len(listed)) in names and len(listed) >= 20, names)
root, group, matrix, areas = svg("coloured.svg")
check("svg_has_the_colours_of_materials", [p.get("fill") for p in group.iter(NS + "path")] == ["#e69f00"] * 2 + ["#56b4e9"] * 2)
check("svg_names_materials", {"red", "sea"} <= {t.text for t in root.iter(NS + "text")})

table = list(csv.DictReader(open("demo.csv")))
run = json.load(open("demo.json"))
want = {k: [float(r[k]) for r in table] for k in ("cos_theta", "area_m2", "visible_area_m2", "sigma_m2")}
want["material"] = [int(r["material"]) for r in table] if table[0]["material"].isdigit() else None
def legacy(path):
    data, found = open(path, "rb").read(), {}
    pos = data.index(b"\nDATASET POLYDATA\n") + 18
    assert data.startswith(b"# vtk DataFile Version 3.0\n") and b"\nBINARY\n" in data[:400]
    def line():
        nonlocal pos
        end = data.index(b"\n", pos)
        text, pos = data[pos:end].decode(), end + 1
        return text
    def take(count, kind):
        nonlocal pos
        size = {"double": "d", "int": "i"}[kind]
        values = struct.unpack(">%d%s" % (count, size), data[pos:pos + count * struct.calcsize(size)])
        pos += count * struct.calcsize(size)
        assert line() == ""
        return list(values)
    while pos < len(data):
        word = line().split()
        if word[0] == "FIELD":
            for _ in range(int(word[2])):
                name, each, count, kind = line().split()
                found[name] = take(int(each) * int(count), kind)
        elif word[0] == "POINTS": found["points"] = take(3 * int(word[1]), word[2])
        elif word[0] == "POLYGONS":
            flat = take(int(word[2]), "int")
            assert flat[::4] == [3] * int(word[1])
            found["corners"] = [v for k, v in enumerate(flat) if k % 4]
        else: assert word[0] == "CELL_DATA" and int(word[1]) == len(table)
    return found
def xml(path):
    found = {}
    for a in tree.parse(path).getroot().iter("DataArray"):
        kind = float if a.get("type") == "Float64" else int
        found[a.get("Name")] = [kind(x) for x in a.text.split()]
    assert found.pop("offsets") == list(range(3, 3 * len(table) + 1, 3))
    found["corners"] = found.pop("connectivity")
    return found
old, new = legacy("demo.vtk"), xml("demo.vtp")
check("both_vtk_files_say_the_same", old == new)
for k in ("cos_theta", "area_m2", "visible_area_m2", "sigma_m2"):
    check("vtk_has_" + k, old[k] == want[k])
check("vtk_has_the_direction", old["direction"] == run["direction"] or
      all(abs(a - b) < 1e-15 for a, b in zip(old["direction"], run["direction"])))
def area(f):
    p = [old["points"][3 * c:3 * c + 3] for c in old["corners"][3 * f:3 * f + 3]]
    a, b = [[p[k][i] - p[0][i] for i in range(3)] for k in (1, 2)]
    return math.dist([a[1] * b[2], a[2] * b[0], a[0] * b[1]], [a[2] * b[1], a[0] * b[2], a[1] * b[0]]) / 2
check("vtk_facets_have_their_areas", all(abs(area(f) - old["area_m2"][f]) <= 1e-12 * (1 + area(f)) for f in range(len(table))))
check("vtk_fractions_are_of_the_projected_area", all(
      abs(w * a * abs(c) - v) <= 1e-12 * (1 + a) for w, a, c, v in
      zip(old["visible_fraction"], old["area_m2"], old["cos_theta"], old["visible_area_m2"])))
try:
    from vtkmodules.vtkIOLegacy import vtkPolyDataReader
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
    for reader, path in ((vtkPolyDataReader(), "demo.vtk"), (vtkXMLPolyDataReader(), "demo.vtp")):
        reader.SetFileName(path)
        reader.Update()
        read, cells = reader.GetOutput(), reader.GetOutput().GetCellData()
        sigma = cells.GetArray("sigma_m2")
        check("vtk_reads_" + path, read.GetNumberOfPolys() == len(table) and cells.GetNumberOfArrays() == 7 and
              [sigma.GetTuple1(i) for i in range(len(table))] == want["sigma_m2"])
except ImportError:
    skip("vtk_reads_them", "no vtk")
END
finish
