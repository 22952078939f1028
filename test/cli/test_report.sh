#!/bin/sh
# SPDX-License-Identifier: MIT
# lrcs report: a page that needs nothing beside it, says what lrcs run says, and takes names for text.
. "$(dirname "$0")/check.sh"
cd "$scratch" || exit 1

# Names that would be markup, in a scene file, a model and its materials.
{
    printf 'v 0 0 3\nv 1 0 3\nv 0 1 3\nv 0 0 2\nv 0 1 2\nv 1 0 2\nv 1 1 2.5\n'
    printf 'o <script>alert(1)</script>\nusemtl "><img/src="http://evil.invalid/a.png">\nf 1 2 3\n'
    printf 'o b&amp;\nusemtl caf\351\nf 4 5 6\nf 5 7 6\n'
} >hostile.obj
{
    pair_scene
    printf '[[part]]\nname = "<b onclick=\\"x\\">&lt;\357\277\277 \\u0007"\nfile = "hostile.obj"\n'
    printf '[[part]]\nname = "tank"\nshape = "cylinder"\nradius = 0.5\nlength = 1\ntranslate = [0, 0, 3]\n'
} >"hostile<i>'&.toml"
scene="hostile<i>'&.toml"
at="--azel 50,40 --tolerance 0.01"
quick="--seconds 0.2 --cut-step 45 --map-step 45"

usage_error a_page_wants_a_name "give -o FILE.html" report demo
usage_error a_page_is_html "-o: expected FILE.html, found 'x.pdf'" report demo -o x.pdf
usage_error a_step_divides_90 "--cut-step: expected a divisor of 90, found '7'" report demo -o x.html --cut-step 7
usage_error a_step_is_whole "--map-step: expected a whole number" report demo -o x.html --map-step 2.5
usage_error time_is_more_than_none "--seconds: expected a time > 0" report demo -o x.html --seconds 0
ln -s "$scene" scene.html
usage_error not_over_the_scene "would overwrite" report "$scene" -o scene.html
same nothing_was_written "$(ls x.* 2>/dev/null)" ""
box_scene >box.toml
failure a_folder_that_is_not_there "none/x.html" report box.toml -o none/x.html $quick

# shellcheck disable=SC2086
run report "$scene" $at $quick -o page.html
made=$rc
same a_page_is_written "$([ -s page.html ] && echo yes)" yes
same nothing_goes_to_stdout "$out" ""
same no_progress_in_a_pipe "$(printf '%s' "$err" | grep -v '^notice: ')" "wrote page.html"
run run "$scene" $at --shares --json
same a_page_exits_like_the_run "$made" "$rc"
printf '%s\n' "$out" >run.json
run info "$scene" --json
printf '%s\n' "$out" >info.json
run sweep "$scene" --az 0:360:45 --el -90:90:45 --tolerance 0.01 -o map.csv --brightest 6
printf '[[part]]\nname = "p"\nshape = "plate"\nsize = [1, 1]\n' >dark.toml
run report dark.toml --azel 0,0 --material 0,0,0.2,0 $quick -o dark.html
same a_page_of_nothing_is_written "$rc" 0
plates_scene >plates.toml
# shellcheck disable=SC2086
run report box.toml $quick --azel 10,50 --material 1,0.25+-0.05,0.2,0.5 -o error.html
deviation=$("$tool" run box.toml --azel 10,50 --material 1,0.25+-0.05,0.2,0.5 --json 2>/dev/null | sed -n 's/.*"material_uncertainty": {.*"deviation_m2": \([0-9.e-]*\).*/\1/p')
same errors_of_materials_stand_beside_sigma "$rc $(grep -c 'stated errors of materials leave it uncertain by <b>' error.html) $(grep -c "<data id=\"material_deviation_m2\" value=\"$deviation\">" error.html)" "0 1 1"
same without_errors_nothing_is_said_of_them "$(grep -c 'stated errors of materials\|material_deviation' page.html)" 0
run report plates.toml $quick --method zbuffer --resolution 16 -o - --azel 10,50
same no_tolerance_is_spoken_of_where_none_is_in_force "$rc $(printf '%s\n' "$out" | grep -c 'the tolerance of\|tolerance_not_met')" "0 0"
run report plates.toml $quick --method zbuffer --resolution 16 --tolerance 1e-9 -o - --azel 10,50
printf '%s' "$out" >stdout.html
same a_missed_tolerance_exits_3 "$rc" 3

# The run of a page is that of lrcs run at any tolerance: as many facets, and the same scene.
# shellcheck disable=SC2086
run report demo $quick --azel 50,40 -o demo.html
run run demo --azel 50,40 --json
total=$(printf '%s\n' "$out" | sed -n 's/.*"facets": {"total": \([0-9]*\),.*/\1/p')
same facets_and_scene_are_those_of_the_run "$(grep -c "Of $total facets" demo.html) $(grep -c "id=\"scene_hash\">$(value scene_hash | tr -d '"')<" demo.html)" "1 1"
run info demo --json
same facets_of_the_model_are_those_of_info "$(grep -c ">Facets, curved shapes divided for a tolerance of 1e-4<.*>$(value facets); the run has $total<" demo.html)" 1

command -v python3 >/dev/null || { skip what_python_reads "no python3"; finish; exit; }
# The command lines that the page names make the same again.
python3 - <<'END'
import xml.etree.ElementTree as tree
H = "{http://www.w3.org/1999/xhtml}"
lines = tree.parse("page.html").getroot().find(".//%spre/%scode" % (H, H)).text.strip().split("\n")
open("again.sh", "w").write("\n".join("$tool" + line[4:] for line in lines if not line.startswith(("lrcs report", "lrcs converge"))))
END
mv map.csv first.csv
tool=$tool sh again.sh >again.txt 2>again.err
same the_commands_are_taken "$(grep -c '^Try ' again.err)" 0
same they_make_what_stands_on_the_page "$(ls -s facets.csv sigma.png material.png xy.svg xz.csv yz.csv map.svg | grep -vc '^ *0 ')" 7
same they_make_the_same_map "$(cmp map.csv first.csv && echo same)" same
python3 - <<'END' || not_ok the_python_ends_well
import base64, csv, html.parser, json, math, re, sys, xml.etree.ElementTree as tree
from png_file import Png
from tap import check
H, S = "{http://www.w3.org/1999/xhtml}", "{http://www.w3.org/2000/svg}"
VOID = {"meta", "img", "source", "br", "link", "hr", "input"}
class Tags(html.parser.HTMLParser):  # every tag closes what was opened
    def __init__(self):
        super().__init__()
        self.open, self.names, self.links, self.fault = [], [], [], None
    def handle_starttag(self, tag, attrs):
        self.names.append(tag)
        self.links += [(k, v) for k, v in attrs if k in ("src", "srcset", "href", "xlink:href", "data", "action", "poster")]
        self.fault = self.fault or next((k for k, v in attrs if k.startswith("on")), None)
        if tag not in VOID: self.open.append(tag)
    def handle_startendtag(self, tag, attrs):
        self.handle_starttag(tag, attrs)
        if tag not in VOID: self.open.pop()
    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag: self.fault = self.fault or tag
for name in ("page", "dark", "stdout"):
    text = open(name + ".html", encoding="utf-8", newline="").read()
    tags = Tags()
    tags.feed(text)
    root = tree.fromstring(text)
    check(name + "_begins_like_html5", text.startswith("<!DOCTYPE html>\n<html lang=\"en\""))
    check(name + "_is_well_formed", not tags.open and tags.fault is None)
    check(name + "_has_no_scripts", "script" not in tags.names and "iframe" not in tags.names and "link" not in tags.names)
    check(name + "_loads_nothing", all(v.startswith(("#", "data:image/png;base64,")) for k, v in tags.links)
          and not re.search(r"url\(|@import", text))
    ids = [e.get("id") for e in root.iter() if e.get("id")]
    check(name + "_ids_are_unique", len(ids) == len(set(ids)))
    check(name + "_links_lead_somewhere", all(v[1:] in ids for k, v in tags.links if k == "href"))
    check(name + "_has_all_sections", [e.get("id") for e in root.iter(H + "h2")] == ["sigma", "notices", "map", "peaks", "cuts",
          "shares", "model", "materials", "effects", "accuracy", "again"])
    check(name + "_pictures_are_told", all(e.get("alt") for e in root.iter(H + "img")) and
          all(e.get("role") == "img" and e.get("aria-label") for e in root.iter(S + "svg")))
    head = root.find(".//%sheader" % H)
    check(name + "_has_its_verdict_first", "Verdict" in "".join(head.itertext()))
    check(name + "_tables_are_folded_but_two", len([t for d in root.iter(H + "details") for t in d.iter(H + "table")]) >= len(list(root.iter(H + "table"))) - 2 and
          all(d[0].tag == H + "summary" and d.get("open") is None for d in root.iter(H + "details")))
    check(name + "_pictures_are_png", all(base64.b64decode(v.split(",", 1)[1], validate=True)[:4] == b"\x89PNG" for k, v in tags.links if v.startswith("data:")))
    check(name + "_has_pictures_for_light_and_dark", len([v for k, v in tags.links if v.startswith("data:")]) == 4)
    check(name + "_rows_have_their_columns", all(len({sum(1 for c in r) for r in t.iter(H + "tr")}) == 1 for t in root.iter(H + "table")))
    check(name + "_has_a_title", (root.find(".//%stitle" % H).text or "").endswith(": laser radar cross-section"))

# Title and pose stand above the picture on white, the axes in its lower left corner.
root = tree.parse("page.html").getroot()
open("picture.png", "wb").write(base64.b64decode(next(root.iter(H + "img")).get("src").split(",", 1)[1]))
rows = [[tuple(r[k:k + 3]) for k in range(0, len(r), 3)] for r in Png("picture.png").rows]
check("pictures_have_a_title_and_a_pose", all(sum(min(p) < 120 for r in rows[a:b] for p in r) > 100 for a, b in ((8, 24), (28, 44))))
near = lambda p, q: max(abs(x - y) for x, y in zip(p, q)) < 40
corner = [p for r in rows[300:470] for p in r[:150]]
check("pictures_have_axes", all(sum(near(p, q) for p in corner) >= 10 for q in ((0xd5, 0x5e, 0), (0, 0x9e, 0x73), (0, 0x72, 0xb2))))
text = " ".join("".join(root.itertext()).split())
run, info = json.load(open("run.json")), json.load(open("info.json"))
def value(id): return float(root.find(".//%sdata[@id='%s']" % (H, id)).get("value"))
check("numbers_are_those_of_the_run", all(value(k) == run[k] for k in
      ("sigma_m2", "sigma_dbsm", "sigma_glint_m2", "sigma_diffuse_m2", "bound_m2", "projected_area_m2")))
check("the_bound_is_split_as_in_the_run", all(value(k + "_m2") == run["budget_m2"][k] for k in ("visibility", "tessellation", "rounding")))
def shown(e):  # what a reader reads
    t = "".join(e.itertext()).replace("\u2212", "-")
    return float(t.replace("\u00b710", "e"))
check("no_bound_is_shown_smaller_than_it_is", all(shown(root.find(".//%sdata[@id='%s_m2']" % (H, k))) >= value(k + "_m2") for k in
      ("bound", "visibility", "tessellation", "rounding")))
check("method_and_scene_are_those_of_the_run", root.find(".//*[@id='method']").text == run["method"] and root.find(".//*[@id='scene_hash']").text == run["scene_hash"])
check("every_effect_has_its_reason", all(e["name"].replace("_", " ") in text and e["reason"] in text for e in run["effects"]))
clean = lambda t: t.replace("\uffff", "\ufffd").replace("\x07", "\ufffd")
check("notices_are_there", all(" ".join(clean(n).split()) in text for n in run["notices"] + info["notices"]
      if n in run["notices"] or "have no material assigned" not in n))  # info's shapes are finer
def rows(label): return [[(c, "".join(c.itertext())) for c in r] for r in root.find(".//%sdiv[@aria-label='%s']//%stbody" % (H, label, H))]
for key, label in (("parts", "Shares of parts"), ("materials", "Shares of materials")):
    want = [(clean(s["name"]) or ("(default)" if key == "materials" else "(no name)"), s["sigma_m2"]) for s in run["shares"][key] if s["sigma_m2"] > 0]
    got = [(r[0][1], float(r[2][0].find(H + "data").get("value"))) for r in rows(label)]
    check(key + "_share_as_in_the_run", got[:len(want)] == want and len(want) >= 2)
facets = [(int(r[0][1]), float(r[5][0].find(H + "data").get("value"))) for r in rows("The brightest facets")]
check("facets_are_the_brightest_of_the_run", facets == [(f["facet"], f["sigma_m2"]) for f in run["shares"]["facets"]])
check("hostile_names_are_text", "<script>alert(1)</script>" in text and '<img/src="http://evil.invalid/a.png">' in text and "caf\u00e9" in text)
sheet = list(csv.DictReader(l for l in open("map.csv") if not l.startswith("#")))
best = max(float(r["sigma_m2"]) for r in sheet)
peak = rows("Peaks of the map")[0]
check("the_first_peak_is_the_brightest_of_the_sweep", abs(float(peak[2][0].find(H + "data").get("value")) - best) <= 1e-15 * best)
svgs = list(root.iter(S + "svg"))
check("three_cuts_a_map_and_a_chart", len(svgs) == 5)
inside = 0
for svg in svgs:  # of a chart only a box is shown: its words but the title and note, or the ones beside a pole, are in it
    x, y, w, h = map(float, svg.get("viewBox").split())
    words = [(t.text, float(t.get("x")), float(t.get("y")), float(t.get("font-size"))) for t in svg.iter(S + "text")]
    out = [t for t in words if not (x + 8 <= t[1] <= x + w - 8 and y + 8 <= t[2] <= y + h - 3)]
    numbers = [t for t in out if re.fullmatch(r"[-\d.]+", t[0] or "")]
    inside += not numbers and len(out) in ((2, 4) if w == h else (2,))
check("what_is_cut_off_are_titles", inside == 5)
dark = " ".join("".join(tree.parse("dark.html").getroot().itertext()).split())
check("a_scene_without_a_return_says_so", "Nothing returns" in dark and "There are none: nothing returns." in dark and "NaN" not in dark and "nan" not in dark)
END
finish
