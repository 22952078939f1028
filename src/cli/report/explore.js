// SPDX-License-Identifier: MIT
// The explorer's page at work: the body as the laser sees it, drawn with a depth buffer of its own; the
// map of sigma with the place of the view; what is known there. State is `view`: everything else
// is drawn from it. Angles are in degrees until they are used.
"use strict";
(function () {
  const data = JSON.parse(document.getElementById("data").textContent);
  const find = (id) => document.getElementById(id);
  const body = find("body"), map = find("map"), out = find("readout"), where = find("where");
  const start = {az: data.start[0], el: data.start[1], zoom: 1};
  const view = {...start};
  const rad = Math.PI / 180;

  function bytes(text) {
    const raw = atob(text), list = new Uint8Array(raw.length);
    for (let i = 0; i < raw.length; i++) list[i] = raw.charCodeAt(i);
    return list.buffer;
  }
  const sigma = new Float64Array(bytes(data.sigma)), bound = new Float64Array(bytes(data.bound));
  const band = data.low ? [new Float64Array(bytes(data.low)), new Float64Array(bytes(data.high))] : null;
  const point = new Float32Array(bytes(data.points)), corner = new Uint32Array(bytes(data.facets));
  const material = new Uint32Array(bytes(data.material)), seen = new Float32Array(point.length);

  // ---- the map's numbers: rows go through azimuth, then elevation ----
  const az = data.az, el = data.el, rows = el.count;
  const dbsm = (x) => x > 0 ? 10 * Math.log10(x) : -Infinity;
  let most = -Infinity, least = Infinity, brightest = 0;
  sigma.forEach((x, i) => {
    if (x > sigma[brightest]) brightest = i;
    if (x > 0) { most = Math.max(most, dbsm(x)); least = Math.min(least, dbsm(x)); }
  });
  least = Math.max(least, most - 40);
  const turn = (a) => ((a % 360) + 360) % 360;
  function nearest() {
    const i = Math.round((turn(view.az) - az.least) / az.step);
    const k = Math.round((view.el - el.least) / el.step);
    return {i, k, row: i * rows + k, az: az.least + i * az.step, el: el.least + k * el.step};
  }

  // Viridis (S. van der Walt and N. Smith, 2015, CC0).
  const knots = [[68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141],
    [39, 173, 129], [92, 200, 99], [170, 220, 50], [253, 231, 37]];
  function colour(db) {
    if (!(db > -Infinity)) return [90, 90, 90];
    const t = 8 * Math.min(Math.max((db - least) / (most - least || 1), 0), 1), i = Math.min(Math.floor(t), 7);
    return knots[i].map((c, k) => c + (t - i) * (knots[i + 1][k] - c));
  }

  // ---- the body ----
  // To the laser, right and up: body z stands upright.
  function axes() {
    const a = view.az * rad, e = view.el * rad, ca = Math.cos(a), sa = Math.sin(a);
    const ce = Math.cos(e), se = Math.sin(e);
    return [[-sa, ca, 0], [-se * ca, -se * sa, ce], [ce * ca, ce * sa, se]];
  }
  let depth = new Float32Array(0), picture = null;
  // One triangle into the depth buffer: pixel centres inside it, nearer than what is there.
  // `behind` moves it away, in pixels.
  function fill(n, a, b, c, rgb, pixels, behind) {
    const ax = seen[a], ay = seen[a + 1], bx = seen[b], by = seen[b + 1], cx = seen[c], cy = seen[c + 1];
    const area = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
    if (area === 0) return;
    const x0 = Math.max(0, Math.ceil(Math.min(ax, bx, cx) - 0.5)), x1 = Math.min(n - 1, Math.floor(Math.max(ax, bx, cx) - 0.5));
    const y0 = Math.max(0, Math.ceil(Math.min(ay, by, cy) - 0.5)), y1 = Math.min(n - 1, Math.floor(Math.max(ay, by, cy) - 0.5));
    for (let y = y0; y <= y1; y++) {
      for (let x = x0; x <= x1; x++) {
        const px = x + 0.5, py = y + 0.5;
        const u = ((bx - px) * (cy - py) - (by - py) * (cx - px)) / area;
        const v = ((cx - px) * (ay - py) - (cy - py) * (ax - px)) / area;
        if (u < 0 || v < 0 || u + v > 1) continue;
        const z = u * seen[a + 2] + v * seen[b + 2] + (1 - u - v) * seen[c + 2] - behind, at = y * n + x;
        if (z <= depth[at]) continue;
        depth[at] = z;
        pixels[at] = rgb;
      }
    }
  }
  function drawBody() {
    const n = Math.max(64, Math.min(900, Math.round(body.clientWidth * Math.min(devicePixelRatio, 2))));
    if (body.width !== n) { body.width = body.height = n; picture = null; }
    const context = body.getContext("2d"), [x, y, z] = axes();
    if (!picture) { picture = context.createImageData(n, n); depth = new Float32Array(n * n); }
    const pixels = new Uint32Array(picture.data.buffer), scale = 0.46 * n * view.zoom / data.radius;
    depth.fill(-Infinity);
    pixels.fill(0xff1c110d);
    for (let i = 0; i < point.length; i += 3) {
      const p = [0, 1, 2].map((k) => point[i + k] - data.centre[k]);
      seen[i] = n / 2 + scale * (p[0] * x[0] + p[1] * x[1] + p[2] * x[2]);
      seen[i + 1] = n / 2 - scale * (p[0] * y[0] + p[1] * y[1] + p[2] * y[2]);
      seen[i + 2] = scale * (p[0] * z[0] + p[1] * z[1] + p[2] * z[2]);
    }
    for (let f = 0; f < material.length; f++) {
      const a = 3 * corner[3 * f], b = 3 * corner[3 * f + 1], c = 3 * corner[3 * f + 2];
      const u = [0, 1, 2].map((k) => seen[b + k] - seen[a + k]), v = [0, 1, 2].map((k) => seen[c + k] - seen[a + k]);
      const nx = u[1] * v[2] - u[2] * v[1], ny = u[2] * v[0] - u[0] * v[2], nz = u[0] * v[1] - u[1] * v[0];
      const light = 0.15 + 0.85 * Math.abs(nz) / (Math.hypot(nx, ny, nz) || 1), m = data.materials[material[f]];
      const dead = nz > 0 && !m.two_sided; // y points down: the back shows
      const rgb = dead ? [0x55, 0x55, 0x55] : m.rgb;
      fill(n, a, b, c, (255 << 24 | light * rgb[2] << 16 | light * rgb[1] << 8 | light * rgb[0]) >>> 0, pixels,
        dead ? 0.75 : 0); // the front of a panel modelled as two faces in one plane shows
    }
    context.putImageData(picture, 0, 0);
    drawTriad(context, n, x, y, z);
    drawLength(context, n, scale);
  }
  // The body's axes, the farthest first.
  function drawTriad(context, n, x, y, z) {
    const size = n / 14, at = [1.7 * size, n - 1.7 * size];
    context.lineWidth = n / 250;
    context.font = `${Math.round(n / 30)}px sans-serif`;
    context.textAlign = "center";
    context.textBaseline = "middle";
    [0, 1, 2].sort((i, k) => z[i] - z[k]).forEach((k) => {
      context.strokeStyle = context.fillStyle = ["#ff8a6b", "#7fd48a", "#7fb8ff"][k];
      context.beginPath();
      context.moveTo(at[0], at[1]);
      context.lineTo(at[0] + size * x[k], at[1] - size * y[k]);
      context.stroke();
      context.fillText("xyz"[k], at[0] + 1.3 * size * x[k], at[1] - 1.3 * size * y[k]);
    });
  }

  // A bar of 1, 2 or 5 times a power of ten metres, at most a quarter of the picture.
  function drawLength(context, n, scale) {
    const power = Math.pow(10, Math.floor(Math.log10(0.25 * n / scale)));
    const length = [5, 2, 1].map((k) => k * power).find((l) => l * scale <= 0.25 * n);
    const right = n - n / 24, left = right - length * scale, y = n - n / 12, tick = n / 80;
    context.strokeStyle = context.fillStyle = "#fff";
    context.beginPath();
    [[left, y - tick], [left, y + tick], [left, y], [right, y], [right, y - tick], [right, y + tick]].forEach((p, i) =>
      i === 0 ? context.moveTo(...p) : context.lineTo(...p));
    context.stroke();
    context.fillText(Number(length.toPrecision(1)) + " m", (left + right) / 2, y + n / 28);
  }

  // ---- the map ----
  const box = {left: 60, right: 20, top: 8, bottom: 82};
  let ground = null;
  function drawGround() {
    ground = document.createElement("canvas");
    ground.width = az.count;
    ground.height = el.count;
    const image = ground.getContext("2d").createImageData(az.count, el.count);
    for (let i = 0; i < az.count; i++) {
      for (let k = 0; k < el.count; k++) {
        image.data.set([...colour(dbsm(sigma[i * rows + k])), 255], 4 * ((el.count - 1 - k) * az.count + i));
      }
    }
    ground.getContext("2d").putImageData(image, 0, 0);
  }
  function drawMap() {
    const ratio = Math.min(devicePixelRatio, 2), w = map.clientWidth, h = map.clientHeight;
    map.width = Math.round(w * ratio);
    map.height = Math.round(h * ratio);
    const context = map.getContext("2d"), ink = getComputedStyle(map).color;
    const wide = w - box.left - box.right, high = h - box.top - box.bottom;
    const X = (a) => box.left + wide * a / 360, Y = (e) => box.top + high * (90 - e) / 180;
    context.scale(ratio, ratio);
    context.imageSmoothingEnabled = false; // nothing is interpolated
    // pixels stand for directions at their centres: the outer halves are cut off
    context.drawImage(ground, 0.5, 0.5, az.count - 1, el.count - 1, box.left, box.top, wide, high);
    context.strokeStyle = context.fillStyle = ink;
    context.font = "12px sans-serif";
    context.textAlign = "center";
    context.textBaseline = "top";
    for (let a = 0; a <= 360; a += wide < 400 ? 90 : 45) context.fillText(a + "\u00b0", X(a), h - box.bottom + 5);
    context.textAlign = "right";
    context.textBaseline = "middle";
    for (let e = -90; e <= 90; e += 45) context.fillText(String(e).replace("-", "\u2212") + "\u00b0", box.left - 6, Y(e));
    context.textAlign = "center";
    context.fillText("azimuth", box.left + wide / 2, h - box.bottom + 29);
    context.save();
    context.translate(9, box.top + high / 2);
    context.rotate(-Math.PI / 2);
    context.fillText("elevation", 0, 0);
    context.restore();
    if (most > -Infinity) drawScale(context, wide, h);
    const x = X(turn(view.az)), y = Y(view.el);
    [["#000", 4], ["#fff", 2]].forEach(([style, width]) => {
      context.strokeStyle = style;
      context.lineWidth = width;
      context.beginPath();
      context.arc(x, y, 7, 0, 7);
      context.moveTo(x - 13, y); context.lineTo(x - 4, y); context.moveTo(x + 4, y); context.lineTo(x + 13, y);
      context.moveTo(x, y - 13); context.lineTo(x, y - 4); context.moveTo(x, y + 4); context.lineTo(x, y + 13);
      context.stroke();
    });
  }
  function drawScale(context, wide, h) {
    for (let i = 0; i < 128; i++) {
      context.fillStyle = `rgb(${colour(least + (i + 0.5) / 128 * (most - least)).map(Math.round)})`;
      context.fillRect(box.left + wide * i / 128, h - 32, wide / 128 + 1, 9);
    }
    context.fillStyle = context.strokeStyle;
    context.textBaseline = "top";
    const shown = (value) => value.toFixed(1).replace("-", "\u2212");
    [["left", shown(least), 0], ["center", "\u03c3 (dBsm)", 0.5], ["right", shown(most), 1]].forEach(([align, text, t]) => {
      context.textAlign = align;
      context.fillText(text, box.left + wide * t, h - 19);
    });
  }

  // ---- what is known there ----
  // A bound is never shown smaller than it is.
  function upper(x) {
    if (!(x > 0)) return String(x);
    const unit = Math.pow(10, Math.floor(Math.log10(x)) - 1);
    let text = (Math.ceil(x / unit) * unit).toPrecision(2);
    for (let i = 1; Number(text) < x; i++) text = ((Math.ceil(x / unit) + i) * unit).toPrecision(2);
    return String(Number(text));
  }
  function say() {
    const at = nearest(), s = sigma[at.row], b = bound[at.row];
    const angle = (x) => String(Math.round(100 * x) / 100).replace("-", "\u2212");
    const known = (data.open ? " for its materials, which are illustrative or assumed" : "") +
      (band ? `; by the errors of its materials ${Number(band[0][at.row].toPrecision(3))} to ` +
        `${Number(band[1][at.row].toPrecision(3))} m\u00b2 (68 %)` : "");
    where.textContent = `Laser at azimuth ${angle(turn(view.az))}\u00b0, elevation ${angle(view.el)}\u00b0.`;
    out.textContent = `\u03c3 = ${Number(s.toPrecision(6))} m\u00b2` +
      (s > 0 ? ` (${angle(dbsm(s))} dBsm)` : "") + `, proved to within ${upper(b)} m\u00b2${known}, at azimuth ` +
      `${angle(at.az)}\u00b0, elevation ${angle(at.el)}\u00b0, the nearest direction of the map.`;
    out.dataset.row = at.row;
    out.dataset.sigma = s;
    out.dataset.bound = b;
    body.setAttribute("aria-label", `The body as the laser sees it from azimuth ${angle(turn(view.az))}, elevation ${angle(view.el)} degrees`);
  }
  let asked = 0;
  function show() {
    say();
    if (asked) return;
    asked = requestAnimationFrame(() => { asked = 0; drawBody(); drawMap(); });
  }
  function go(a, e) {
    view.az = turn(a);
    view.el = Math.min(Math.max(e, -90), 90);
    show();
  }
  function zoom(factor) {
    view.zoom = Math.min(Math.max(view.zoom * factor, 0.25), 20);
    show();
  }
  // The next line of the map's grid in a direction; with Shift one degree.
  function step(value, axis, sign, fine) {
    const at = (value - axis.least) / axis.step;
    return fine ? value + sign : axis.least + axis.step * (sign > 0 ? Math.floor(at + 1e-6) + 1 : Math.ceil(at - 1e-6) - 1);
  }
  function key(event) {
    const fine = event.shiftKey, act = {
      ArrowLeft: () => go(step(view.az, az, -1, fine), view.el),
      ArrowRight: () => go(step(view.az, az, 1, fine), view.el),
      ArrowUp: () => go(view.az, step(view.el, el, 1, fine)),
      ArrowDown: () => go(view.az, step(view.el, el, -1, fine)),
      "+": () => zoom(1.25), "=": () => zoom(1.25), "-": () => zoom(0.8),
      Home: () => { view.zoom = 1; go(start.az, start.el); },
    }[event.key];
    if (!act || event.ctrlKey || event.metaKey || event.altKey) return;
    event.preventDefault();
    act();
  }
  // Pointers that are down on a canvas. `move` gets how far one moved, how many are down, and by what
  // factor two went apart. A finger alone takes part once it goes sideways: one that starts up or
  // down scrolls the page (touch-action: pan-y) and is cancelled.
  function drag(canvas, down, move) {
    const held = new Map();
    const spread = () => {
      const [a, b] = [...held.values()];
      return b ? Math.hypot(a.x - b.x, a.y - b.y) : 0;
    };
    canvas.addEventListener("keydown", key);
    canvas.addEventListener("pointerdown", (event) => {
      if (event.button !== 0) return;
      const mouse = event.pointerType !== "touch";
      canvas.setPointerCapture(event.pointerId);
      held.set(event.pointerId, {x: event.clientX, y: event.clientY, taken: mouse});
      if (mouse) down(event);
    });
    canvas.addEventListener("pointermove", (event) => {
      const at = held.get(event.pointerId), before = spread();
      if (!at) return;
      const x = event.clientX - at.x, y = event.clientY - at.y;
      at.taken ||= held.size > 1 || Math.abs(x) > Math.max(8, Math.abs(y));
      if (!at.taken) return;
      [at.x, at.y] = [event.clientX, event.clientY];
      move(event, x, y, held.size, before > 0 ? spread() / before : 1);
    });
    ["pointerup", "pointercancel", "lostpointercapture"].forEach((name) => canvas.addEventListener(name, (event) => held.delete(event.pointerId)));
  }
  drag(body, () => {}, (event, x, y, fingers, apart) => {
    const degree = 180 / body.clientWidth / Math.max(view.zoom, 1) / fingers;
    go(view.az - degree * x, view.el + degree * y);
    if (fingers === 2) zoom(apart);
  });
  function place(event) {
    const wide = map.clientWidth - box.left - box.right, high = map.clientHeight - box.top - box.bottom;
    const a = Math.min(Math.max((event.offsetX - box.left) / wide, 0), 1);
    go(360 * a, 90 - 180 * (event.offsetY - box.top) / high);
  }
  drag(map, place, place);
  map.addEventListener("click", place); // a tap: a finger that goes down may be about to scroll
  body.addEventListener("wheel", (event) => { event.preventDefault(); zoom(Math.exp(-event.deltaY / 500)); }, {passive: false});
  find("brightest").addEventListener("click", () => go(az.least + Math.floor(brightest / rows) * az.step, el.least + brightest % rows * el.step));
  find("back").addEventListener("click", () => { view.zoom = 1; go(start.az, start.el); });
  find("nearer").addEventListener("click", () => zoom(1.25));
  find("farther").addEventListener("click", () => zoom(0.8));
  addEventListener("resize", show);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", show);
  drawGround();
  show();
})();
