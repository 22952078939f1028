#!/bin/sh
# SPDX-License-Identifier: MIT
# lrcs report in a browser, where Chromium is installed: on a phone and on a desk, in light and dark,
# nothing is wider than the page, no words are cut off, all text is readable, and there is no error.
. "$(dirname "$0")/check.sh"
cd "$scratch" || exit 1
browser=$(command -v chromium || command -v chromium-browser || command -v google-chrome)
[ -n "$browser" ] && command -v python3 >/dev/null || { skip the_page_in_a_browser "no chromium or no python3"; finish; exit; }

# A part and a material whose names no line can hold, beside the demo's.
long=$(printf 'x%.0s' $(seq 300))
{
    cat "$root/examples/satellite.toml"
    printf '[[part]]\nname = "%s"\nshape = "plate"\nsize = [9, 9]\ntranslate = [0, 0, 9]\nmaterial = "%s"\n' "$long" "$long"
    printf '[[material]]\nname = "%s"\nlike = "paint-white"\n' "$long"
} >long.toml
run report long.toml --tolerance 0.1 --azel 50,40 --seconds 0.2 --cut-step 45 --map-step 45 -o page.html
same a_page_is_written "$([ -s page.html ] && echo yes)" yes

# The page in frames as wide as a phone and a desk, and what stands where in each.
python3 - <<'END'
import html
page = html.escape(open("page.html", encoding="utf-8").read(), quote=True)
open("frames.html", "w", encoding="utf-8").write("""<!DOCTYPE html><meta charset="utf-8"><body>
<iframe id="phone" width="390" height="900" srcdoc="%s"></iframe>
<iframe id="desk" width="1280" height="900" srcdoc="%s"></iframe>
<script>
function colour(text) { return text.match(/[\\d.]+/g).map(Number) }
function luminance(c) {
  const l = c.slice(0, 3).map(v => (v /= 255) <= 0.04045 ? v / 12.92 : ((v + 0.055) / 1.055) ** 2.4)
  return 0.2126 * l[0] + 0.7152 * l[1] + 0.0722 * l[2]
}
function ground(e, view) {
  for (; e; e = e.parentElement) {
    const c = colour(view.getComputedStyle(e).backgroundColor)
    if (c.length < 4 || c[3] > 0) return c
  }
  return [255, 255, 255]
}
function look(frame) {
  const view = frame.contentWindow, page = frame.contentDocument, wide = view.innerWidth
  for (const fold of page.querySelectorAll("details")) fold.open = true
  const out = {wide, scroll: page.documentElement.scrollWidth, paper: ground(page.body, view), beyond: [], cut: [], faint: [], empty: []}
  for (const e of page.body.querySelectorAll("*")) {
    const box = e.getBoundingClientRect(), style = view.getComputedStyle(e)
    const own = [...e.childNodes].some(n => n.nodeType == 3 && n.data.trim())
    const scrolls = e.parentElement.closest(".wide,.chart,pre")
    if (!scrolls && (box.right > wide + 0.5 || box.left < -0.5)) out.beyond.push(e.tagName)
    if (own && style.overflowX != "visible" && style.overflowX != "auto" && e.scrollWidth > e.clientWidth + 1) out.cut.push(e.tagName)
    if (e.matches(".wide,.chart,pre") && style.overflowX != "auto") out.cut.push(e.className)
    if (own && !e.closest("title,style")) {
      const c = colour(e.closest("svg") ? style.fill : style.color)
      const [a, b] = [luminance(c), luminance(ground(e, view))].sort((x, y) => y - x)
      if ((a + 0.05) / (b + 0.05) < (e.closest("svg") ? 3 : 4.5)) out.faint.push(e.tagName + " " + e.textContent.slice(0, 20) + " " + c)
    }
    if (e.matches("img,svg,td.bar i") && !(box.width > 0 && box.height > 0) && !e.matches("i")) out.empty.push(e.tagName)
    if (e.matches("img") && !(e.complete && e.naturalWidth > 0)) out.empty.push("picture")
  }
  return out
}
window.onload = () => {
  const result = {}
  for (const frame of document.querySelectorAll("iframe")) result[frame.id] = look(frame)
  document.body.textContent = "RESULT" + JSON.stringify(result) + "END"
}
</script></body>""" % (page, page))
END
for scheme in light dark; do
    blink=1
    [ "$scheme" = light ] || blink=0
    timeout 120 "$browser" --headless=new --no-sandbox --disable-gpu --user-data-dir="$scratch/$scheme" \
        --window-size=1800,1000 --blink-settings=preferredColorScheme=$blink --enable-logging=stderr --v=0 \
        --dump-dom "file://$scratch/frames.html" >$scheme.dom 2>$scheme.log
    same "nothing_is_said_on_the_console_in_$scheme" "$(grep -c 'CONSOLE' $scheme.log)" 0
done
python3 - <<'END' || not_ok the_python_ends_well
import html, json, re
from tap import check
paper = {}
for scheme in ("light", "dark"):
    found = re.search("RESULT(.*)END", html.unescape(open(scheme + ".dom", encoding="utf-8").read()), re.S)
    check("the_page_is_looked_at_in_" + scheme, found)
    if not found: continue
    for name, wide in (("phone", 390), ("desk", 1280)):
        r = json.loads(found.group(1))[name]
        where = "_on_a_%s_in_%s" % (name, scheme)
        paper[scheme] = sum(r["paper"][:3])
        check("the_frame_is_as_wide_as_asked" + where, r["wide"] in (wide, wide - 15), r["wide"])
        check("the_page_does_not_scroll_sideways" + where, r["scroll"] <= r["wide"], r["scroll"])
        check("nothing_stands_beyond_the_page" + where, not r["beyond"], r["beyond"][:5])
        check("no_words_are_cut_off" + where, not r["cut"], r["cut"][:5])
        check("all_words_can_be_read" + where, not r["faint"], r["faint"][:5])
        check("all_pictures_are_there" + where, not r["empty"], r["empty"][:5])
check("dark_is_dark_and_light_is_light", paper.get("dark", 999) < 120 and paper.get("light", 0) > 700, paper)
END
finish
