// Pointer and keys on a plot: frame to zoom, click for a cursor, wheel, arrows.

import { BOTTOM, LEFT, RIGHT, TOP } from "./paint.js";

const state = (link) => ({ cursors: { ...link.cursors }, active: link.active, next: link.next });

export function listen(plot) {
  const canvas = plot.canvas;
  const where = (event) => {
    const r = canvas.getBoundingClientRect(),
      [low, high] = plot.range();
    const sx = event.clientX - r.left;
    return { sx, sy: event.clientY - r.top, x: low + ((sx - LEFT) / (r.width - LEFT - RIGHT)) * (high - low) };
  };
  let start = null,
    // Cursors before the last two clicks.
    before = [];
  canvas.addEventListener("pointerdown", (event) => {
    start = { ...where(event), range: plot.range(), touch: event.pointerType === "touch" };
    canvas.setPointerCapture(event.pointerId);
  });
  canvas.addEventListener("pointermove", (event) => {
    if (!start) return;
    const now = where(event);
    if (start.touch || event.shiftKey) {
      if (plot.link.range) plot.pan((start.sx - now.sx) / canvas.clientWidth);
      start.sx = now.sx;
      return;
    }
    if (Math.abs(now.sx - start.sx) < 5) return;
    plot.box = {
      x: Math.min(start.sx, now.sx),
      w: Math.abs(now.sx - start.sx),
      y: plot.loop ? Math.min(start.sy, now.sy) : TOP,
      h: plot.loop ? Math.abs(now.sy - start.sy) : canvas.clientHeight - TOP - BOTTOM,
    };
    plot.later();
  });
  canvas.addEventListener("pointerup", (event) => {
    if (!start) return;
    const end = where(event),
      box = plot.box,
      from = start,
      first = plot.boxes?.[0];
    start = null;
    plot.box = null;
    if (box) {
      const xs = [from.x, end.x].sort((p, q) => p - q);
      if (plot.loop && first) {
        const value = (sy) => first.bot + ((first.bottom - sy) / (first.bottom - first.top)) * (first.up - first.bot);
        plot.yRange = [value(from.sy), value(end.sy)].sort((p, q) => p - q);
      }
      plot.link.range = xs;
      plot.changed();
    } else if (!from.touch || Math.abs(end.sx - from.sx) < 8) {
      const y = first ? first.bot + ((first.bottom - end.sy) / (first.bottom - first.top)) * (first.up - first.bot) : undefined;
      before = [before.at(-1), state(plot.link)];
      plot.click(end.x, y, event.altKey ? "b" : undefined);
    }
  });
  canvas.addEventListener("pointercancel", () => {
    start = null;
    plot.box = null;
    plot.later();
  });
  canvas.addEventListener("dblclick", () => {
    // Its two clicks were no cursors.
    Object.assign(plot.link, before[0]);
    plot.reset();
  });
  canvas.addEventListener(
    "wheel",
    (event) => {
      if (document.activeElement !== canvas && !event.ctrlKey) return;
      event.preventDefault();
      plot.zoom(event.deltaY > 0 ? 1.25 : 0.8, where(event).x);
    },
    { passive: false },
  );
  canvas.addEventListener("keydown", (event) => {
    const acts = {
      ArrowLeft: () => plot.step(event.shiftKey ? -10 : -1),
      ArrowRight: () => plot.step(event.shiftKey ? 10 : 1),
      "+": () => plot.zoom(0.7),
      "=": () => plot.zoom(0.7),
      "-": () => plot.zoom(1.4),
      0: () => plot.reset(),
      a: () => plot.choose("a"),
      b: () => plot.choose("b"),
      PageUp: () => plot.pan(-0.5),
      PageDown: () => plot.pan(0.5),
      Delete: () => plot.remove(),
    };
    if (!acts[event.key] || event.ctrlKey || event.metaKey) return;
    event.preventDefault();
    event.stopPropagation();
    acts[event.key]();
  });
}
