// A picture of curves in panes over one axis: zoom that stays aligned, cursors A and B, a table behind it.  Draws a million samples.

import { h, number } from "./dom.js";
import { farOut, firstFrom, isSorted, nearestIndex, seen, span, spanOf, ticks, tickText, traceBlocks, tracePath, traceSorted } from "./scale.js";

const LEFT = 56, RIGHT = 12, TOP = 20, GAP = 26, BOTTOM = 40, MOST_ROWS = 400;
const colours = new Map();
const inColour = (name) => {
  if (!name.startsWith("--")) return name;
  if (!colours.has(name)) colours.set(name, getComputedStyle(document.documentElement).getPropertyValue(name).trim());
  return colours.get(name);
};
const all = new Set();
export function recolour() { colours.clear(); for (const plot of all) plot.later(); }

// Plots of one link show the same stretch of their axis, and cursors at the same place.
export class Link { constructor() { this.range = null; this.cursors = { a: null, b: null }; this.plots = new Set(); } }

export class Plot {
  // panes: [{title, weight, zero, lines: [{name, x, y, colour, width, dots, opacity, dash, hidden}], bands: [{x, low, high}], limits: [values]}]
  constructor({ height = 420, link = new Link(), label = "chart" } = {}) {
    this.link = link; link.plots.add(this); all.add(this);
    this.height = height; this.panes = []; this.xTitle = ""; this.loop = false; this.active = "a"; this.hiddenNames = new Set(); this.yRange = null;
    this.canvas = h("canvas", { tabindex: 0, role: "img", "aria-label": label, style: { height: `${height}px` } });
    this.legend = h("div", { class: "legend" });
    this.cursorButton = h("button", { type: "button", title: "which cursor a click sets (keys a, b)", onclick: () => { this.active = this.active === "a" ? "b" : "a"; this.later(); } }, "cursor A");
    this.readout = h("div", { class: "cursors scroll" });
    this.behind = h("details", { class: "behind", ontoggle: () => this.fillTable() }, h("summary", {}, "Table"), h("div", {}));
    const tool = (text, title, act) => h("button", { type: "button", title, "aria-label": title, onclick: act }, text);
    this.element = h("div", { class: "plot" },
      h("div", { class: "bar-top" }, this.legend, this.cursorButton, tool("+", "zoom in", () => this.zoom(0.5)), tool("−", "zoom out", () => this.zoom(2)),
        tool("all", "show all (0)", () => this.reset())),
      this.canvas, this.readout, this.behind);
    this.watch = new ResizeObserver(() => this.later());
    this.watch.observe(this.canvas);
    this.listen();
  }

  destroy() { this.watch.disconnect(); this.link.plots.delete(this); all.delete(this); }

  set({ panes, xTitle = "", loop = false, keep = true }) {
    this.panes = panes; this.xTitle = xTitle;
    this.lines = panes.flatMap((p) => p.lines);
    for (const line of this.lines) line.sorted ??= isSorted(line.x);
    this.loop = loop || this.lines.some((l) => !l.sorted);
    if (!keep) { this.link.range = null; this.yRange = null; }
    const names = [...new Map(this.lines.filter((l) => l.name).map((l) => [l.name, l])).values()];
    this.legend.replaceChildren(...names.map((line) => h("button", { type: "button", "aria-pressed": String(!this.hiddenNames.has(line.name)), title: "show or hide", onclick: (event) => {
      if (!this.hiddenNames.delete(line.name)) this.hiddenNames.add(line.name);
      event.currentTarget.setAttribute("aria-pressed", String(!this.hiddenNames.has(line.name)));
      this.later();
    } }, h("i", { style: { "border-top-color": `var(${line.colour})` } }), line.name)));
    this.later();
    if (this.behind.open) this.fillTable();
  }

  later() { this.waiting ??= requestAnimationFrame(() => { this.waiting = undefined; this.draw(); }); }

  shown(pane) { return pane.lines.filter((l) => !this.hiddenNames.has(l.name)); }

  whole() {
    let low = Infinity, high = -Infinity;
    for (const line of this.lines) {
      if (!line.x.length) continue;
      const [a, b] = line.sorted ? [line.x[0], line.x[line.x.length - 1]] : (line.span ??= span(line.x));
      low = Math.min(low, a); high = Math.max(high, b);
    }
    if (!(high >= low)) return [0, 1];
    const spare = high > low ? (this.loop ? 0.03 * (high - low) : 0) : Math.abs(high) || 1;
    return [low - spare, high + spare];
  }

  range() { return this.link.range ?? this.whole(); }

  paneRange(pane, low, high) {
    if (this.loop && this.yRange && pane === this.panes[0]) return this.yRange;
    let bottom = Infinity, top = -Infinity;
    const take = ([a, b]) => { if (a < bottom) bottom = a; if (b > top) top = b; };
    for (const line of this.shown(pane)) {
      if (line.sorted && !this.loop) take(spanOf(line, ...seen(line.x, low, high)));
      else take(line.ySpan ??= span(line.y));
    }
    for (const value of pane.limits ?? []) take([value, value]);
    if (pane.zero) take([0, 0]);
    if (!(top >= bottom)) return [0, 1];
    const spare = 0.06 * (top - bottom) || Math.abs(top) * 0.1 || 1;
    return [bottom - (pane.floor && bottom === 0 ? 0 : spare), top + spare];
  }

  draw() {
    const ratio = window.devicePixelRatio || 1, width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    if (!width || !this.panes.length) return;
    if (this.canvas.width !== Math.round(width * ratio) || this.canvas.height !== Math.round(height * ratio)) {
      this.canvas.width = Math.round(width * ratio); this.canvas.height = Math.round(height * ratio);
    }
    const c = this.canvas.getContext("2d");
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.clearRect(0, 0, width, height);
    c.font = "11.5px system-ui, sans-serif";
    const [low, high] = this.range();
    const right = width - RIGHT, plotted = right - LEFT;
    const px = (v) => LEFT + ((v - low) / (high - low)) * plotted;
    const room = height - TOP - BOTTOM - GAP * (this.panes.length - 1), weights = this.panes.reduce((s, p) => s + (p.weight ?? 1), 0);
    let top = TOP;
    this.boxes = [];
    const xTicks = ticks(low, high, Math.max(2, plotted / 90)), xStep = xTicks.length > 1 ? xTicks[1] - xTicks[0] : 1;
    for (const pane of this.panes) {
      const tall = (room * (pane.weight ?? 1)) / weights, bottom = top + tall;
      const [bot, up] = this.paneRange(pane, low, high);
      const y0 = bottom, py = (v) => y0 - ((v - bot) / (up - bot)) * tall;
      this.boxes.push({ pane, top, bottom, bot, up, py });
      c.lineWidth = 1; c.strokeStyle = inColour("--grid"); c.fillStyle = inColour("--quiet");
      c.beginPath();
      const yTicks = ticks(bot, up, Math.max(2, tall / 38)), yStep = yTicks.length > 1 ? yTicks[1] - yTicks[0] : 1;
      for (const v of yTicks) { const y = Math.round(py(v)) + 0.5; c.moveTo(LEFT, y); c.lineTo(right, y); }
      for (const v of xTicks) { const x = Math.round(px(v)) + 0.5; c.moveTo(x, top); c.lineTo(x, bottom); }
      c.stroke();
      c.textAlign = "right"; c.textBaseline = "middle";
      for (const v of yTicks) c.fillText(tickText(v, yStep), LEFT - 6, py(v));
      c.textAlign = "left"; c.textBaseline = "bottom"; c.fillText(fitting(c, pane.title ?? "", plotted), LEFT, top - 4);
      c.save(); c.beginPath(); c.rect(LEFT, top - 1, plotted, tall + 2); c.clip();
      for (const band of pane.bands ?? []) this.drawBand(c, band, px, py, low, high);
      for (const value of pane.limits ?? []) {
        c.strokeStyle = inColour("--axis"); c.setLineDash([4, 4]); c.beginPath(); c.moveTo(LEFT, py(value)); c.lineTo(right, py(value)); c.stroke(); c.setLineDash([]);
      }
      if (pane.zero) { c.strokeStyle = inColour("--axis"); c.beginPath(); c.moveTo(LEFT, py(0)); c.lineTo(right, py(0)); c.stroke(); }
      for (const line of this.shown(pane)) this.drawLine(c, line, px, py, low, high);
      c.restore();
      top = bottom + GAP;
    }
    const foot = this.boxes.at(-1).bottom;
    c.fillStyle = inColour("--quiet"); c.textAlign = "center"; c.textBaseline = "top";
    for (const v of xTicks) { const text = tickText(v, xStep), half = c.measureText(text).width / 2; c.fillText(text, Math.min(px(v), width - 2 - half), foot + 5); }
    c.fillText(this.xTitle, LEFT + plotted / 2, foot + 22);
    this.drawCursors(c, px, foot);
    if (this.box) { c.fillStyle = inColour("--band"); c.fillRect(this.box.x, this.box.y, this.box.w, this.box.h); }
    this.tell();
  }

  drawLine(c, line, px, py, low, high) {
    c.strokeStyle = inColour(line.colour); c.lineWidth = line.width ?? 1.4; c.globalAlpha = line.opacity ?? 1; c.setLineDash(line.dash ?? []);
    c.lineJoin = "round"; c.beginPath();
    if (line.stems) { for (let i = 0; i < line.x.length; i++) { c.moveTo(px(line.x[i] + (line.shift ?? 0)), py(0)); c.lineTo(px(line.x[i] + (line.shift ?? 0)), py(line.y[i])); } }
    else if (line.sorted) { const [from, to] = seen(line.x, low, high); if (farOut(line, from, to, px(high) - px(low))) traceBlocks(c, line, from, to, px, py); else traceSorted(c, line.x, line.y, from, to, px, py); }
    else tracePath(c, line.x, line.y, px, py);
    if (!line.only) c.stroke();
    if (line.dots) {
      c.fillStyle = c.strokeStyle; c.beginPath();
      for (let i = 0; i < line.x.length; i++) { const x = px(line.x[i]), y = py(line.y[i]); c.moveTo(x + 2.4, y); c.arc(x, y, 2.4, 0, 7); }
      c.fill();
    }
    c.globalAlpha = 1; c.setLineDash([]);
  }

  // Between two lines; of a loop as thick strokes' worth of small quadrilaterals, so that neither half stays empty.
  drawBand(c, { x, low, high }, px, py, from, to) {
    c.fillStyle = inColour("--band");
    const sorted = isSorted(x), [a, b] = sorted ? seen(x, from, to) : [0, x.length];
    const step = Math.max(1, Math.floor((b - a) / 2000));
    if (sorted) {
      c.beginPath();
      for (let i = a; i < b; i += step) c.lineTo(px(x[i]), py(high[i]));
      for (let i = b - 1; i >= a; i -= step) c.lineTo(px(x[i]), py(low[i]));
      c.fill();
      return;
    }
    c.beginPath();
    for (let i = a; i + step < b; i += step) {
      const j = i + step, right = px(x[j]) >= px(x[i]);
      const [p, q] = right ? [i, j] : [j, i];
      c.moveTo(px(x[p]), py(high[p])); c.lineTo(px(x[q]), py(high[q])); c.lineTo(px(x[q]), py(low[q])); c.lineTo(px(x[p]), py(low[p])); c.closePath();
    }
    c.fill("nonzero");
  }

  drawCursors(c, px, foot) {
    for (const name of ["a", "b"]) {
      const cursor = this.link.cursors[name];
      if (!cursor) continue;
      const x = px(cursor.x);
      if (x < LEFT - 1 || x > this.canvas.clientWidth - RIGHT + 1) continue;
      c.strokeStyle = c.fillStyle = inColour(`--${name}`); c.lineWidth = 1.2;
      c.beginPath(); c.moveTo(x, TOP); c.lineTo(x, foot); c.stroke();
      c.textAlign = "left"; c.textBaseline = "top"; c.fillText(name.toUpperCase(), x + 3, TOP);
    }
    this.cursorButton.textContent = `cursor ${this.active.toUpperCase()}`;
  }

  indexAt(line, cursor) {
    if (line.sorted) return nearestIndex(line.x, cursor.x);
    return cursor.index !== undefined && cursor.index < line.x.length ? cursor.index : null;
  }

  // Values at the cursors and their differences.
  tell() {
    const { a, b } = this.link.cursors;
    const key = JSON.stringify([a, b, this.lines.length, [...this.hiddenNames]]) + this.lines.map((l) => l.y.length).join();
    if (this.told === key && this.toldLines === this.lines) return;
    this.told = key; this.toldLines = this.lines;
    if (!a && !b) { this.readout.replaceChildren(); return; }
    const value = (line, cursor) => { const i = cursor ? this.indexAt(line, cursor) : null; return i === null ? NaN : line.y[i]; };
    const rows = this.panes.flatMap((pane) => this.shown(pane).filter((l) => l.name).map((line) => {
      const va = value(line, a), vb = value(line, b);
      return h("tr", {}, h("td", {}, line.name), h("td", { class: "num" }, number(va)), h("td", { class: "num" }, number(vb)), h("td", { class: "num" }, number(vb - va)));
    }));
    const at = (cursor) => (cursor ? number(cursor.x, 5) : "–");
    this.readout.replaceChildren(h("table", {}, h("thead", {}, h("tr", {}, h("th", {}, this.xTitle), h("th", { class: "num a" }, `A: ${at(a)}`), h("th", { class: "num b" }, `B: ${at(b)}`),
      h("th", { class: "num" }, `B − A: ${a && b ? number(b.x - a.x, 5) : "–"}`))), h("tbody", {}, rows)));
  }

  changed() { for (const plot of this.link.plots) plot.later(); }

  zoom(factor, at) {
    const [low, high] = this.range(), [least, most] = this.whole();
    const middle = at ?? (this.link.cursors[this.active]?.x ?? (low + high) / 2), size = Math.min((high - low) * factor, most - least);
    let from = middle - ((middle - low) / (high - low)) * size;
    from = Math.max(least, Math.min(from, most - size));
    this.link.range = size >= most - least ? null : [from, from + size];
    if (factor > 1 && this.link.range === null) this.yRange = null;
    this.changed();
  }

  reset() { this.link.range = null; this.yRange = null; this.changed(); }

  pan(share) {
    const [low, high] = this.range(), [least, most] = this.whole(), by = Math.max(least - low, Math.min(share * (high - low), most - high));
    if (this.link.range) { this.link.range = [low + by, high + by]; this.changed(); }
  }

  place(name, x, y) {
    const [low, high] = this.range(), main = this.lines[0];
    const cursor = { x };
    if (main && !main.sorted && this.boxes?.[0]) {
      const { bot, up } = this.boxes[0];
      let best = Infinity;
      for (let i = 0; i < main.x.length; i++) {
        const far = ((main.x[i] - x) / (high - low)) ** 2 + (y === undefined ? 0 : ((main.y[i] - y) / (up - bot)) ** 2);
        if (far < best) { best = far; cursor.index = i; }
      }
      cursor.x = main.x[cursor.index] ?? x;
    } else if (main?.x.length) cursor.x = main.x[nearestIndex(main.x, x)];
    this.link.cursors[name] = cursor;
    this.changed();
  }

  step(by) {
    const cursor = this.link.cursors[this.active], main = this.lines[0];
    if (!main?.x.length) return;
    if (!cursor) { const [low, high] = this.range(); this.place(this.active, (low + high) / 2); return; }
    const [low, high] = this.range();
    const size = main.sorted ? Math.max(1, Math.round((firstFrom(main.x, high) - firstFrom(main.x, low)) / 400)) : 1;
    const i = Math.max(0, Math.min(main.x.length - 1, (main.sorted ? nearestIndex(main.x, cursor.x) : cursor.index ?? 0) + by * size));
    this.link.cursors[this.active] = main.sorted ? { x: main.x[i] } : { x: main.x[i], index: i };
    this.changed();
  }

  listen() {
    const canvas = this.canvas;
    const where = (event) => { const r = canvas.getBoundingClientRect(), [low, high] = this.range(); const sx = event.clientX - r.left; return { sx, sy: event.clientY - r.top, x: low + ((sx - LEFT) / (r.width - LEFT - RIGHT)) * (high - low) }; };
    let start = null;
    canvas.addEventListener("pointerdown", (event) => { start = { ...where(event), range: this.range(), touch: event.pointerType === "touch" }; canvas.setPointerCapture(event.pointerId); });
    canvas.addEventListener("pointermove", (event) => {
      if (!start) return;
      const now = where(event);
      if (start.touch || event.shiftKey) { if (this.link.range) this.pan((start.sx - now.sx) / canvas.clientWidth); start.sx = now.sx; return; }
      if (Math.abs(now.sx - start.sx) < 5) return;
      this.box = { x: Math.min(start.sx, now.sx), w: Math.abs(now.sx - start.sx), y: this.loop ? Math.min(start.sy, now.sy) : TOP, h: this.loop ? Math.abs(now.sy - start.sy) : canvas.clientHeight - TOP - BOTTOM };
      this.later();
    });
    canvas.addEventListener("pointerup", (event) => {
      if (!start) return;
      const end = where(event), box = this.box, from = start, first = this.boxes?.[0];
      start = null; this.box = null;
      if (box) {
        const xs = [from.x, end.x].sort((p, q) => p - q);
        if (this.loop && first) { const value = (sy) => first.bot + ((first.bottom - sy) / (first.bottom - first.top)) * (first.up - first.bot); this.yRange = [value(from.sy), value(end.sy)].sort((p, q) => p - q); }
        this.link.range = xs; this.changed();
      } else if (!from.touch || Math.abs(end.sx - from.sx) < 8) {
        const y = first ? first.bot + ((first.bottom - end.sy) / (first.bottom - first.top)) * (first.up - first.bot) : undefined;
        this.place(event.altKey ? "b" : this.active, end.x, y);
      }
    });
    canvas.addEventListener("pointercancel", () => { start = null; this.box = null; this.later(); });
    canvas.addEventListener("dblclick", () => this.reset());
    canvas.addEventListener("wheel", (event) => {
      if (document.activeElement !== canvas && !event.ctrlKey) return;
      event.preventDefault();
      this.zoom(event.deltaY > 0 ? 1.25 : 0.8, where(event).x);
    }, { passive: false });
    canvas.addEventListener("keydown", (event) => {
      const acts = { ArrowLeft: () => this.step(event.shiftKey ? -10 : -1), ArrowRight: () => this.step(event.shiftKey ? 10 : 1), "+": () => this.zoom(0.7), "=": () => this.zoom(0.7), "-": () => this.zoom(1.4),
        0: () => this.reset(), a: () => { this.active = "a"; this.later(); }, b: () => { this.active = "b"; this.later(); }, PageUp: () => this.pan(-0.5), PageDown: () => this.pan(0.5),
        Delete: () => { this.link.cursors[this.active] = null; this.changed(); } };
      if (!acts[event.key] || event.ctrlKey || event.metaKey) return;
      event.preventDefault(); event.stopPropagation(); acts[event.key]();
    });
  }

  // What the curves show as numbers: rows over the stretch that is seen, and all of it as a file.
  fillTable() {
    if (!this.behind.open) return;
    const [low, high] = this.range();
    const parts = [];
    for (const x of new Set(this.lines.map((l) => l.x))) {
      const own = this.lines.filter((l) => l.x === x && l.name);
      if (!own.length) continue;
      const inside = [];
      for (let i = 0; i < x.length; i++) if (x[i] >= low && x[i] <= high) inside.push(i);
      const step = Math.max(1, Math.ceil(inside.length / MOST_ROWS));
      const head = [this.xTitle, ...own.map((l) => l.name)];
      const rows = inside.filter((_, k) => k % step === 0).map((i) => h("tr", {}, h("td", { class: "num" }, number(x[i], 6)), own.map((l) => h("td", { class: "num" }, number(l.y[i], 5)))));
      const save = () => {
        const text = [head.map((t) => `"${t}"`).join(","), ...inside.map((i) => [x[i], ...own.map((l) => l.y[i])].join(","))].join("\n");
        const link = h("a", { href: URL.createObjectURL(new Blob([text], { type: "text/csv" })), download: "curves.csv" });
        link.click();
        URL.revokeObjectURL(link.href);
      };
      parts.push(h("p", { class: "row" }, h("span", { class: "quiet" }, `${inside.length} samples${step > 1 ? `, every ${step}th is listed` : ""}`), h("button", { type: "button", onclick: save }, "save as CSV")),
        h("div", { class: "scroll" }, h("table", {}, h("thead", {}, h("tr", {}, head.map((t) => h("th", { class: "num" }, t)))), h("tbody", {}, rows))));
      if (parts.length > 8) break;
    }
    this.behind.lastElementChild.replaceChildren(...parts);
  }
}

function fitting(c, text, room) {
  if (c.measureText(text).width <= room) return text;
  let short = text;
  while (short.length > 4 && c.measureText(`${short}…`).width > room) short = short.slice(0, -1);
  return `${short}…`;
}
