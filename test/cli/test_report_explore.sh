#!/bin/sh
# SPDX-License-Identifier: MIT
# lrcs report --explore: a page that needs nothing beside it, holds the map as lrcs sweep computes it,
# and, in Chromium where that is installed, works with mouse and keys without an error.
. "$(dirname "$0")/check.sh"
cd "$scratch" || exit 1

usage_error cuts_belong_to_the_other_page "--cut-step: there are no cuts with --explore" \
    report demo --explore --cut-step 5 -o x.html
usage_error a_page_wants_a_name "give -o FILE.html" report demo --explore
{
    pair_scene
    printf '[[part]]\nname = "<script>alert(1)</script>"\nshape = "plate"\nsize = [1, 1]\ntranslate = [0, 0, 5]\n'
} >'scene<b>.toml'
run report 'scene<b>.toml' --explore --map-step 15 --azel 50,40 -o page.html
same a_page_is_written "$rc $([ -s page.html ] && echo yes)" "0 yes"
same nothing_goes_to_stdout "$out" ""
run report demo --explore --map-step 30 -o - 
same a_page_goes_to_stdout "$rc $(printf '%s\n' "$out" | grep -c '^<!DOCTYPE html>')" "0 1"
run sweep 'scene<b>.toml' --az 0:360:15 --el -90:90:15 --tolerance 0.01 -o map.csv
box_scene >box.toml
run report box.toml --material 1+-0.2,0.25+-0.05,0.2,0.5 --explore --map-step 30 -o errors.html
run sweep box.toml --material 1+-0.2,0.25+-0.05,0.2,0.5 --az 0:360:30 --el -90:90:30 -o errors.csv
run report 'scene<b>.toml' --explore --seconds 0.05 -o soon.html
same time_alone_decides_the_step "$rc" 0
if [ -d "$models" ]; then
    run report "$models/skylab.3ds" --explore --map-step 90 --method facet -o large.html
    same a_large_model_is_reduced_and_told "$rc $(grep -c 'of its 35910 facets, vertices' large.html)" "0 1"
else
    skip a_large_model_is_reduced_and_told "$models is not there"
fi

command -v python3 >/dev/null || { skip what_python_reads "no python3"; finish; exit; }
python3 - <<'END' || not_ok the_python_ends_well
import base64, csv, html, html.parser, json, re, struct
from tap import check
text = open("page.html", encoding="utf-8").read()
check("no_address_is_on_the_page", not re.search(r"https?://|//[a-z]|url\(|@import|\bfetch\b|XMLHttp|WebSocket|\bimport\b", re.sub(r"(^|\s)// .*", "", text, flags=re.M)))
check("nothing_is_loaded", not re.search(r"<(link|img|iframe|source|object|embed)\b|\s(src|href|srcset)\s*=", text))
check("its_policy_forbids_it", "default-src 'none'" in text)
check("names_are_text", "scene&lt;b&gt;" in text and "<b>.toml" not in text)
check("it_fits_a_phone", 'name="viewport"' in text)
data = json.loads(re.search(r'id="data">(.*?)</script>', text, re.S).group(1))
def numbers(key, kind): raw = base64.b64decode(data[key]); return struct.unpack("<%d%s" % (len(raw) // struct.calcsize(kind), kind), raw)
sigma, bound = numbers("sigma", "d"), numbers("bound", "d")
rows = [r for r in csv.DictReader(l for l in open("map.csv") if not l.startswith("#"))]
check("the_map_is_that_of_the_sweep", list(sigma) == [float(r["sigma_m2"]) for r in rows] and list(bound) == [float(r["bound_m2"]) for r in rows] and len(sigma) == 25 * 13)
given = data
data = json.loads(re.search(r'id="data">(.*?)</script>', open("errors.html", encoding="utf-8").read(), re.S).group(1))
low, high = numbers("low", "d"), numbers("high", "d")
errors = [r for r in csv.DictReader(l for l in open("errors.csv") if not l.startswith("#"))]
close = lambda a, b: abs(a - b) <= 1e-12 * abs(b)  # of rows of one direction the first is run
check("bands_of_materials_are_those_of_the_sweep", len(low) == 13 * 7 and all(close(a, float(r["material_low_m2"])) and close(b, float(r["material_high_m2"])) for a, b, r in zip(low, high, errors) if abs(float(r["el_deg"])) < 90 and float(r["az_deg"]) < 360))
data = given
check("without_errors_there_are_none", "low" not in data and data["open"] == 1)
points, facets, material = numbers("points", "f"), numbers("facets", "I"), numbers("material", "I")
check("every_facet_is_drawn", len(material) == 26 and len(facets) == 78 and max(facets) * 3 + 2 < len(points) and max(material) < len(data["materials"]))
try:
    large = open("large.html", encoding="utf-8").read()
    d = json.loads(re.search(r'id="data">(.*?)</script>', large, re.S).group(1))
    n = len(base64.b64decode(d["material"])) // 4
    p = base64.b64decode(d["points"]); p = struct.unpack("<%df" % (len(p) // 4), p)
    check("a_reduced_body_is_within_the_limit_and_keeps_its_box", 5000 < n <= 20000 and
          abs(max(p[1::3]) - min(p[1::3]) - 37.2662) < 0.2)
except FileNotFoundError: pass
# a hidden page draws no frames: run their functions at once
page = html.escape(text.replace("<head>", "<head><script>window.requestAnimationFrame = draw => setTimeout(draw, 0)</script>", 1), quote=True)
open("frame.html", "w", encoding="utf-8").write("""<!DOCTYPE html><meta charset="utf-8"><body>
<iframe id="phone" width="390" height="900" srcdoc="%s"></iframe>
<iframe id="desk" width="1200" height="900" srcdoc="%s"></iframe>
<script>
const faults = []
function state(page) {
  const o = page.getElementById("readout")
  return {row: +o.dataset.row, sigma: +o.dataset.sigma, bound: +o.dataset.bound, words: o.textContent,
          where: page.getElementById("where").textContent, label: page.getElementById("body").getAttribute("aria-label")}
}
function pictures(view, page) {
  const out = {}
  for (const id of ["body", "map"]) {
    const c = page.getElementById(id), d = c.getContext("2d").getImageData(0, 0, c.width, c.height).data, seen = new Set()
    let sum = 0
    for (let i = 0; i < d.length; i += 4) { seen.add(d[i] << 16 | d[i + 1] << 8 | d[i + 2]); sum = (31 * sum + d[i] + 3 * d[i + 1] + 7 * d[i + 2]) %% 1000000007 }
    out[id] = {colours: seen.size, sum, wide: c.getBoundingClientRect().width}
  }
  return out
}
const frames = () => new Promise(done => setTimeout(done, 60))
async function use(frame) {
  const view = frame.contentWindow, page = frame.contentDocument, log = []
  view.addEventListener("error", e => faults.push(e.message))
  const key = async (id, name, shift) => {
    page.getElementById(id).focus()
    page.activeElement.dispatchEvent(new view.KeyboardEvent("keydown", {key: name, shiftKey: !!shift, bubbles: true, cancelable: true}))
    await frames()
    log.push({id, name, focus: page.activeElement.id, ...state(page), ...pictures(view, page)})
  }
  await frames()
  log.push({name: "start", ...state(page), ...pictures(view, page)})
  await key("body", "ArrowRight"); await key("body", "ArrowUp"); await key("body", "ArrowRight", true)
  await key("map", "ArrowLeft"); await key("map", "ArrowDown"); await key("body", "+"); await key("body", "-"); await key("body", "Home")
  for (let i = 0; i < 20; i++) await key("body", "ArrowUp")
  page.getElementById("brightest").click(); await frames()
  log.push({name: "brightest", ...state(page), ...pictures(view, page)})
  const map = page.getElementById("map"), box = map.getBoundingClientRect()
  const at = {clientX: box.left + 60 + (box.width - 80) * 0.25, clientY: box.top + 8 + (box.height - 90) * 0.5}
  map.setPointerCapture = () => {}
  map.dispatchEvent(new view.PointerEvent("pointerdown", {...at, buttons: 1, pointerId: 1, bubbles: true})); await frames()
  log.push({name: "click", ...state(page), ...pictures(view, page)})
  const body = page.getElementById("body")
  body.setPointerCapture = () => {}
  const point = (kind, id, x, y, type) => body.dispatchEvent(new view.PointerEvent(kind, {clientX: x, clientY: y, pointerId: id, pointerType: type, buttons: 1, bubbles: true}))
  point("pointerdown", 1, 100, 100, "mouse"); point("pointermove", 1, 60, 100, "mouse"); point("pointerup", 1, 60, 100, "mouse"); await frames()
  log.push({name: "drag", ...state(page), ...pictures(view, page)})
  point("pointermove", 1, 0, 100, "mouse"); await frames()
  log.push({name: "released", ...state(page), ...pictures(view, page)})
  point("pointerdown", 2, 100, 100, "touch"); point("pointerdown", 3, 140, 100, "touch"); point("pointermove", 3, 180, 100, "touch"); await frames()
  log.push({name: "pinch", ...state(page), ...pictures(view, page)})
  point("pointercancel", 2, 0, 0, "touch"); point("pointercancel", 3, 0, 0, "touch"); point("pointermove", 3, 0, 0, "touch"); await frames()
  log.push({name: "cancelled", ...state(page), ...pictures(view, page)})
  const style = view.getComputedStyle(page.getElementById("keys"))
  return {log, wide: view.innerWidth, scroll: page.documentElement.scrollWidth, loaded: view.performance.getEntriesByType("resource").length,
          tab: [...page.querySelectorAll("canvas,button")].every(e => e.tabIndex >= 0 && (e.getAttribute("aria-label") || e.textContent)),
          live: page.getElementById("readout").getAttribute("aria-live")}
}
window.onload = async () => {
  const result = {}
  for (const frame of document.querySelectorAll("iframe")) result[frame.id] = await use(frame)
  result.faults = faults
  document.body.textContent = "RESULT" + JSON.stringify(result) + "END"
}
</script></body>""" % (page, page))
END
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome)
[ -n "$browser" ] || { skip the_page_in_a_browser "no chromium"; finish; exit; }
browse() { # browse FILE: its document as scripts leave it; messages in log
    timeout 120 "$browser" --headless=new --no-sandbox --disable-gpu --user-data-dir="$scratch/profile" --window-size=1700,1000 \
        --virtual-time-budget=20000 --log-net-log="$scratch/net.json" --enable-logging=stderr --v=0 --dump-dom "file://$scratch/$1" 2>log
}
browse frame.html >dom
same nothing_is_said_on_the_console_in_use "$(grep CONSOLE log | grep -vc willReadFrequently)" 0 # which the test does
browse page.html >alone
same nothing_is_said_on_the_console "$(grep -c CONSOLE log) $(grep -c 'id="readout"' alone)" "0 1"
same under_illustrative_materials_the_bound_says_so "$(grep -c 'for its materials, which are illustrative or assumed, at azimuth' alone)" 1
browse errors.html >banded
same the_errors_of_materials_are_read_off "$(grep -c 'm² (68 %), at azimuth' banded) $(grep -c 'id="readout".*illustrative' banded)" "1 0"
python3 - <<'END' || not_ok the_python_ends_well
import csv, html, json, re
from tap import check
found = re.search("RESULT(.*)END", html.unescape(open("dom", encoding="utf-8").read()), re.S)
check("the_page_is_used", found)
result = json.loads(found.group(1)) if found else {}
check("no_faults", result and not result["faults"], result.get("faults"))
rows = [r for r in csv.DictReader(l for l in open("map.csv") if not l.startswith("#"))]
most = max(float(r["sigma_m2"]) for r in rows)
for name in ("phone", "desk") if result else ():
    r = result[name]
    log, on = r["log"], "_on_a_" + name
    where = [(int(x["row"]) // 13 * 15, int(x["row"]) % 13 * 15 - 90) for x in log]
    check("the_map_is_read_off_everywhere" + on, all(x["sigma"] == float(rows[x["row"]]["sigma_m2"]) and x["bound"] == float(rows[x["row"]]["bound_m2"]) for x in log))
    check("it_starts_at_the_pose" + on, "azimuth 50°, elevation 40°" in log[0]["where"] and where[0] == (45, 45), log[0]["where"])
    check("arrows_go_along_the_grid" + on, where[1:6] == [(60, 45), (60, 45), (60, 45), (60, 45), (60, 30)], where[1:6])
    check("to_its_next_line" + on, [x["where"] for x in log[1:4]] == ["Laser at azimuth 60°, elevation 40°.", "Laser at azimuth 60°, elevation 45°.", "Laser at azimuth 61°, elevation 45°."], [x["where"] for x in log[1:4]])
    check("home_goes_back" + on, log[8]["where"] == log[0]["where"] and log[8]["body"]["sum"] == log[0]["body"]["sum"])
    check("the_pole_is_the_end" + on, where[28][1] == 90 and "elevation 90°" in log[28]["where"], where[28])
    check("the_brightest_is_found" + on, log[29]["sigma"] == most)
    check("the_map_takes_a_click" + on, where[30] == (90, 0), log[30]["where"])
    check("the_body_turns_under_the_mouse" + on, log[31]["where"] != log[30]["where"] and log[31]["body"]["sum"] != log[30]["body"]["sum"], log[31]["where"])
    check("once_released_it_stays" + on, log[32]["where"] == log[31]["where"])
    check("two_fingers_zoom" + on, log[33]["body"]["sum"] != log[32]["body"]["sum"] and log[33]["where"] != log[32]["where"] and log[34]["body"]["sum"] == log[33]["body"]["sum"])
    check("keys_turn_the_body_and_move_the_mark" + on, log[1]["body"]["sum"] != log[0]["body"]["sum"] and log[1]["map"]["sum"] != log[0]["map"]["sum"])
    check("keys_zoom" + on, log[6]["body"]["sum"] != log[5]["body"]["sum"] and log[6]["map"]["sum"] == log[5]["map"]["sum"] and log[7]["body"]["sum"] == log[5]["body"]["sum"])
    check("what_has_keys_has_the_focus" + on, all(x["focus"] == x["id"] for x in log if "id" in x))
    check("both_are_drawn" + on, log[0]["body"]["colours"] > 5 and log[0]["map"]["colours"] > 50, log[0])
    check("a_shown_bound_is_no_smaller" + on, all(float(re.search("within ([-.e+0-9]+) m", x["words"]).group(1)) >= x["bound"] for x in log))
    check("the_label_says_the_view" + on, "azimuth 60" in log[1]["label"] and r["live"] == "polite" and r["tab"])
    check("the_page_does_not_scroll_sideways" + on, r["scroll"] <= r["wide"], r["scroll"])
    check("nothing_was_loaded" + on, r["loaded"] == 0, r["loaded"])
net = json.load(open("net.json")) if found else {"events": []}
urls = {e["params"]["url"] for e in net["events"] if isinstance(e.get("params"), dict) and "url" in e["params"] and e["params"].get("initiator", "").startswith(("file", "null"))}
check("no_request_of_the_page_goes_out", not [u for u in urls if not u.startswith(("file:", "data:", "about:"))], sorted(urls))
END

# A phone under real fingers, by the browser's own protocol over pipes.
cat >touch.py <<'END'
import json, os, subprocess, sys, threading
from tap import check
threading.Timer(60, lambda: os._exit(3)).start()
from_us, to_browser = os.pipe()
from_browser, to_us = os.pipe()


def pipes():
    os.dup2(from_us, 3)
    os.dup2(to_us, 4)


# 3 and 4 are the browser's ends
low = [os.dup(fd) for fd in (from_us, to_us)]
while min(low) < 10:
    low = [os.dup(fd) for fd in low]
from_us, to_us = low
browser = subprocess.Popen([sys.argv[1], "--headless=new", "--no-sandbox", "--disable-gpu", "--remote-debugging-pipe", "--user-data-dir=" + os.getcwd() + "/touched", "about:blank"],
                           preexec_fn=pipes, pass_fds=(3, 4, from_us, to_us), stderr=subprocess.DEVNULL)
number, rest = 0, b""


def ask(method, session=None, **params):
    global number, rest
    number += 1
    message = {"id": number, "method": method, "params": params}
    if session:
        message["sessionId"] = session
    os.write(to_browser, json.dumps(message).encode() + b"\0")
    while True:
        while b"\0" not in rest:
            rest += os.read(from_browser, 1 << 16)
        line, rest = rest.split(b"\0", 1)
        reply = json.loads(line)
        if reply.get("id") == number:
            return reply.get("result", reply)


page = ask("Target.createTarget", url="about:blank")["targetId"]
session = ask("Target.attachToTarget", targetId=page, flatten=True)["sessionId"]
ask("Emulation.setDeviceMetricsOverride", session, width=390, height=700, deviceScaleFactor=2, mobile=True)
ask("Emulation.setTouchEmulationEnabled", session, enabled=True, maxTouchPoints=5)
ask("Page.enable", session)
ask("Page.navigate", session, url="file://" + os.getcwd() + "/page.html")
value = lambda text: ask("Runtime.evaluate", session, expression=text, awaitPromise=True, returnByValue=True)["result"].get("value")
value("new Promise(done => { const wait = () => document.getElementById('readout') && document.getElementById('readout').dataset.row ? done(1) : setTimeout(wait, 50); wait() })")


def middle(name):
    value("document.getElementById('%s').scrollIntoView({block: 'center'})" % name)
    return value("(b => ({x: b.x + b.width / 2, y: b.y + b.height / 2}))(document.getElementById('%s').getBoundingClientRect())" % name)


def touch(name, across, down):
    """A finger from the middle of a canvas, or a tap. Returns where the laser stood, and how far the page moved."""
    at = middle(name)
    place = "[document.getElementById('where').textContent, document.getElementById('%s').getBoundingClientRect().y]" % name
    before = value(place)
    steps = 12 if across or down else 0
    ask("Input.dispatchTouchEvent", session, type="touchStart", touchPoints=[at])
    for k in range(1, steps + 1):
        ask("Input.dispatchTouchEvent", session, type="touchMove", touchPoints=[{"x": at["x"] + across * k / steps, "y": at["y"] + down * k / steps}])
    ask("Input.dispatchTouchEvent", session, type="touchEnd", touchPoints=[])
    # at least 0.4 s; on a busy machine up to 6 s until something changes
    after = value("new Promise(done => { let n = 0; const wait = () => JSON.stringify(%s) !== %s || ++n > 14 ? done(%s) : setTimeout(wait, 400); setTimeout(wait, 400) })"
                  % (place, json.dumps(json.dumps(before, separators=(",", ":"), ensure_ascii=False)), place))
    return before[0], after[0], before[1] - after[1]


for name in ("body", "map"):
    before, after, moved = touch(name, 0, -120)
    check(f"a_finger_scrolls_the_page_over_the_{name}", moved > 60 and after == before, (before, after, moved))
    before, after, moved = touch(name, -90, 10)
    check(f"a_finger_sideways_turns_by_the_{name}", abs(moved) < 2 and after != before, (before, after, moved))
before, after, moved = touch("map", 0, 0)
check("a_tap_on_the_map_chooses", after != before and abs(moved) < 2, (before, after, moved))
check("the_page_is_no_wider_than_the_phone", value("document.documentElement.scrollWidth") <= 390)
browser.kill()
os._exit(0)
END
python3 touch.py "$browser" || not_ok the_touches_end_well
finish
