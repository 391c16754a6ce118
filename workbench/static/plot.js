// A picture of curves in panes over one axis: zoom that stays aligned, cursors A and B, a table behind it.  Draws a million samples.

import { fillTable } from "./behind.js";
import { h } from "./dom.js";
import { listen } from "./hand.js";
import { forgetColours, paint } from "./paint.js";
import { firstFrom, isSorted, nearestIndex, seen, span, spanOf } from "./scale.js";

const all = new Set();
export function recolour() {
  forgetColours();
  for (const plot of all) plot.later();
}

// A line without the samples that stretch no axis.
function inside(line) {
  if (!line.aside?.length) return line;
  if (!line.inside) {
    const y = Float32Array.from(line.y);
    for (const i of line.aside) y[i] = NaN;
    line.inside = { x: line.x, y, sorted: line.sorted };
  }
  return line.inside;
}

const other = (name) => (name === "a" ? "b" : "a");

// Plots of one link show the same stretch of their axis, and cursors at the same place: ``active`` is moved by keys, ``next`` is set by a click.
export class Link {
  constructor() {
    this.range = null;
    this.cursors = { a: null, b: null };
    this.active = this.next = "a";
    this.plots = new Set();
  }
}

export class Plot {
  // panes: [{title, weight, zero, lines: [{name, x, y, colour, width, dots, opacity, dash, hidden, aside: [indices that stretch no axis]}], bands: [{x, low, high}], limits: [values]}]
  constructor({ height = 420, link = new Link(), label = "chart" } = {}) {
    this.link = link;
    link.plots.add(this);
    all.add(this);
    this.height = height;
    this.panes = [];
    this.xTitle = "";
    this.loop = false;
    this.hiddenNames = new Set();
    this.yRange = null;
    this.canvas = h("canvas", { tabindex: 0, role: "img", "aria-label": label, style: { height: `${height}px` } });
    this.legend = h("div", { class: "legend" });
    this.cursorButton = h(
      "button",
      {
        type: "button",
        title: "which cursor the next click sets (keys a, b)",
        onclick: () => this.choose(other(this.link.next)),
      },
      "cursor A",
    );
    this.readout = h("div", { class: "cursors scroll" });
    this.behind = h("details", { class: "behind", ontoggle: () => fillTable(this) }, h("summary", {}, "Table"), h("div", {}));
    const tool = (text, title, act) => h("button", { type: "button", title, "aria-label": title, onclick: act }, text);
    this.element = h(
      "div",
      { class: "plot" },
      h(
        "div",
        { class: "bar-top" },
        this.legend,
        this.cursorButton,
        tool("+", "zoom in", () => this.zoom(0.5)),
        tool("−", "zoom out", () => this.zoom(2)),
        tool("all", "show all (0)", () => this.reset()),
      ),
      this.canvas,
      this.readout,
      this.behind,
    );
    this.watch = new ResizeObserver(() => this.later());
    this.watch.observe(this.canvas);
    listen(this);
  }

  destroy() {
    this.watch.disconnect();
    this.link.plots.delete(this);
    all.delete(this);
  }

  set({ panes, xTitle = "", loop = false, keep = true }) {
    this.panes = panes;
    this.xTitle = xTitle;
    this.lines = panes.flatMap((p) => p.lines);
    for (const line of this.lines) line.sorted ??= isSorted(line.x);
    this.loop = loop || this.lines.some((l) => !l.sorted);
    // On a loop a cursor holds on to a sample, wherever that is drawn now.
    const main = this.lines[0];
    for (const cursor of Object.values(this.link.cursors)) if (main && !main.sorted && cursor?.index < main.x.length) cursor.x = main.x[cursor.index];
    if (!keep) {
      this.link.range = null;
      this.yRange = null;
    }
    const names = [...new Map(this.lines.filter((l) => l.name).map((l) => [l.name, l])).values()];
    this.legend.replaceChildren(
      ...names.map((line) =>
        h(
          "button",
          {
            type: "button",
            "aria-pressed": String(!this.hiddenNames.has(line.name)),
            title: "show or hide",
            onclick: (event) => {
              if (!this.hiddenNames.delete(line.name)) this.hiddenNames.add(line.name);
              event.currentTarget.setAttribute("aria-pressed", String(!this.hiddenNames.has(line.name)));
              this.later();
            },
          },
          h("i", { style: { "border-top-color": `var(${line.colour})` } }),
          line.name,
        ),
      ),
    );
    this.later();
    if (this.behind.open) fillTable(this);
  }

  later() {
    this.waiting ??= requestAnimationFrame(() => {
      this.waiting = undefined;
      paint(this);
    });
  }

  shown(pane) {
    return pane.lines.filter((l) => !this.hiddenNames.has(l.name));
  }

  whole() {
    let low = Infinity,
      high = -Infinity;
    for (const line of this.lines) {
      if (!line.x.length) continue;
      const [a, b] = line.sorted ? [line.x[0], line.x[line.x.length - 1]] : (line.span ??= span(line.x));
      low = Math.min(low, a);
      high = Math.max(high, b);
    }
    if (!(high >= low)) return [0, 1];
    const spare = high > low ? (this.loop || this.lines.some((l) => l.stems) ? 0.03 * (high - low) : 0) : Math.abs(high) || 1;
    return [low - spare, high + spare];
  }

  range() {
    return this.link.range ?? this.whole();
  }

  paneRange(pane, low, high) {
    if (this.loop && this.yRange && pane === this.panes[0]) return this.yRange;
    let bottom = Infinity,
      top = -Infinity;
    const take = ([a, b]) => {
      if (a < bottom) bottom = a;
      if (b > top) top = b;
    };
    for (const drawn of this.shown(pane)) {
      const line = inside(drawn);
      if (line.sorted && !this.loop) take(spanOf(line, ...seen(line.x, low, high)));
      else take((line.ySpan ??= span(line.y)));
    }
    for (const value of pane.limits ?? []) take([value, value]);
    if (pane.zero) take([0, 0]);
    if (!(top >= bottom)) return [0, 1];
    const spare = 0.06 * (top - bottom) || Math.abs(top) * 0.1 || 1;
    return [bottom - (pane.floor && bottom === 0 ? 0 : spare), top + spare];
  }

  changed() {
    for (const plot of this.link.plots) plot.later();
  }

  zoom(factor, at) {
    const [low, high] = this.range(),
      [least, most] = this.whole();
    const middle = at ?? this.link.cursors[this.link.active]?.x ?? (low + high) / 2,
      size = Math.min((high - low) * factor, most - least);
    let from = middle - ((middle - low) / (high - low)) * size;
    from = Math.max(least, Math.min(from, most - size));
    this.link.range = size >= most - least ? null : [from, from + size];
    if (factor > 1 && this.link.range === null) this.yRange = null;
    this.changed();
  }

  reset() {
    this.link.range = null;
    this.yRange = null;
    this.changed();
  }

  pan(share) {
    const [low, high] = this.range(),
      [least, most] = this.whole(),
      by = Math.max(least - low, Math.min(share * (high - low), most - high));
    if (this.link.range) {
      this.link.range = [low + by, high + by];
      this.changed();
    }
  }

  // The cursor that a click sets, and keys move.
  choose(name) {
    this.link.active = this.link.next = name;
    this.changed();
  }

  // A click sets A, then B, then A again; keys move the one that was set.
  click(x, y, name = this.link.next) {
    this.place(name, x, y);
    this.link.active = name;
    this.link.next = other(name);
  }

  remove() {
    this.link.cursors[this.link.active] = null;
    this.choose(this.link.active);
  }

  place(name, x, y) {
    const [low, high] = this.range(),
      main = this.lines[0];
    const cursor = { x };
    if (main && !main.sorted && this.boxes?.[0]) {
      const { bot, up } = this.boxes[0];
      let best = Infinity;
      for (let i = 0; i < main.x.length; i++) {
        const far = ((main.x[i] - x) / (high - low)) ** 2 + (y === undefined ? 0 : ((main.y[i] - y) / (up - bot)) ** 2);
        if (far < best) {
          best = far;
          cursor.index = i;
        }
      }
      cursor.x = main.x[cursor.index] ?? x;
    } else if (main?.x.length) cursor.x = main.x[nearestIndex(main.x, x)];
    this.link.cursors[name] = cursor;
    this.changed();
  }

  step(by) {
    const cursor = this.link.cursors[this.link.active],
      main = this.lines[0];
    if (!main?.x.length) return;
    if (!cursor) {
      const [low, high] = this.range();
      this.place(this.link.active, (low + high) / 2);
      return;
    }
    const [low, high] = this.range();
    const size = main.sorted ? Math.max(1, Math.round((firstFrom(main.x, high) - firstFrom(main.x, low)) / 400)) : 1;
    const i = Math.max(0, Math.min(main.x.length - 1, (main.sorted ? nearestIndex(main.x, cursor.x) : (cursor.index ?? 0)) + by * size));
    this.link.cursors[this.link.active] = main.sorted ? { x: main.x[i] } : { x: main.x[i], index: i };
    this.changed();
  }
}
