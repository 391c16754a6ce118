// What a plot shows, on its canvas: axes, bands, lines, cursors.

import { tell } from "./behind.js";
import { fillBetween, isSorted, seen, ticks, tickText, traceLoop, traceSorted } from "./scale.js";

export const LEFT = 56,
  RIGHT = 12,
  TOP = 20,
  GAP = 26,
  BOTTOM = 40;
const colours = new Map();
const inColour = (name) => {
  if (!name.startsWith("--")) return name;
  if (!colours.has(name)) colours.set(name, getComputedStyle(document.documentElement).getPropertyValue(name).trim());
  return colours.get(name);
};
export const forgetColours = () => colours.clear();

export function paint(plot) {
  const ratio = window.devicePixelRatio || 1,
    width = plot.canvas.clientWidth,
    height = plot.canvas.clientHeight;
  if (!width || !plot.panes.length) return;
  if (plot.canvas.width !== Math.round(width * ratio) || plot.canvas.height !== Math.round(height * ratio)) {
    plot.canvas.width = Math.round(width * ratio);
    plot.canvas.height = Math.round(height * ratio);
  }
  const c = plot.canvas.getContext("2d");
  c.setTransform(ratio, 0, 0, ratio, 0, 0);
  c.clearRect(0, 0, width, height);
  c.font = "11.5px system-ui, sans-serif";
  const [low, high] = plot.range();
  const right = width - RIGHT,
    plotted = right - LEFT;
  const px = (v) => LEFT + ((v - low) / (high - low)) * plotted;
  const room = height - TOP - BOTTOM - GAP * (plot.panes.length - 1),
    weights = plot.panes.reduce((s, p) => s + (p.weight ?? 1), 0);
  let top = TOP;
  plot.boxes = [];
  const xTicks = ticks(low, high, Math.max(2, plotted / 90)),
    xStep = xTicks.length > 1 ? xTicks[1] - xTicks[0] : 1;
  for (const pane of plot.panes) {
    const tall = (room * (pane.weight ?? 1)) / weights,
      bottom = top + tall;
    const [bot, up] = plot.paneRange(pane, low, high);
    const y0 = bottom,
      py = (v) => y0 - ((v - bot) / (up - bot)) * tall;
    plot.boxes.push({ pane, top, bottom, bot, up, py });
    c.lineWidth = 1;
    c.strokeStyle = inColour("--grid");
    c.fillStyle = inColour("--quiet");
    c.beginPath();
    const yTicks = ticks(bot, up, Math.max(2, tall / 38)),
      yStep = yTicks.length > 1 ? yTicks[1] - yTicks[0] : 1;
    for (const v of yTicks) {
      const y = Math.round(py(v)) + 0.5;
      c.moveTo(LEFT, y);
      c.lineTo(right, y);
    }
    for (const v of xTicks) {
      const x = Math.round(px(v)) + 0.5;
      c.moveTo(x, top);
      c.lineTo(x, bottom);
    }
    c.stroke();
    c.textAlign = "right";
    c.textBaseline = "middle";
    for (const v of yTicks) c.fillText(tickText(v, yStep), LEFT - 6, py(v));
    c.textAlign = "left";
    c.textBaseline = "bottom";
    c.fillText(fitting(c, pane.title ?? "", plotted), LEFT, top - 4);
    c.save();
    c.beginPath();
    c.rect(LEFT, top - 1, plotted, tall + 2);
    c.clip();
    for (const band of pane.bands ?? []) drawBand(c, band, px, py, low, high);
    for (const value of pane.limits ?? []) {
      c.strokeStyle = inColour("--axis");
      c.setLineDash([4, 4]);
      c.beginPath();
      c.moveTo(LEFT, py(value));
      c.lineTo(right, py(value));
      c.stroke();
      c.setLineDash([]);
    }
    if (pane.zero) {
      c.strokeStyle = inColour("--axis");
      c.beginPath();
      c.moveTo(LEFT, py(0));
      c.lineTo(right, py(0));
      c.stroke();
    }
    for (const line of plot.shown(pane)) {
      drawLine(c, line, px, py, low, high);
      drawClipped(c, line, px, py, top, bottom);
    }
    c.restore();
    top = bottom + GAP;
  }
  const foot = plot.boxes.at(-1).bottom;
  c.fillStyle = inColour("--quiet");
  c.textAlign = "center";
  c.textBaseline = "top";
  for (const v of xTicks) {
    const text = tickText(v, xStep),
      half = c.measureText(text).width / 2;
    c.fillText(text, Math.min(px(v), width - 2 - half), foot + 5);
  }
  c.fillText(plot.xTitle, LEFT + plotted / 2, foot + 22);
  drawCursors(plot, c, px, foot);
  if (plot.box) {
    c.fillStyle = inColour("--band");
    c.fillRect(plot.box.x, plot.box.y, plot.box.w, plot.box.h);
  }
  tell(plot);
}

function drawLine(c, line, px, py, low, high) {
  c.strokeStyle = c.fillStyle = inColour(line.colour);
  c.lineWidth = line.width ?? 1.4;
  c.globalAlpha = line.opacity ?? 1;
  c.setLineDash(line.dash ?? []);
  c.lineJoin = "bevel";
  if (line.stems) {
    c.beginPath();
    for (let i = 0; i < line.x.length; i++) {
      const x = px(line.x[i] + (line.shift ?? 0));
      c.moveTo(x, py(0));
      c.lineTo(x, py(line.y[i]));
    }
    c.stroke();
  } else if (line.sorted) traceSorted(c, line, ...seen(line.x, low, high), px, py);
  else traceLoop(c, line, low, high, px, py);
  if (line.dots) {
    c.beginPath();
    for (let i = 0; i < line.x.length; i++) {
      const x = px(line.x[i]),
        y = py(line.y[i]);
      c.moveTo(x + 2.4, y);
      c.arc(x, y, 2.4, 0, 7);
    }
    c.fill();
  }
  c.globalAlpha = 1;
  c.setLineDash([]);
}

// Arrowheads at the edge for samples that stand far off, outside of the axis.
function drawClipped(c, line, px, py, top, bottom) {
  c.fillStyle = inColour(line.colour);
  for (const i of line.aside ?? []) {
    const x = px(line.x[i]),
      y = py(line.y[i]);
    if (y >= top && y <= bottom) continue;
    const edge = y < top ? top : bottom,
      back = y < top ? edge + 9 : edge - 9;
    c.beginPath();
    c.moveTo(x, edge);
    c.lineTo(x - 5, back);
    c.lineTo(x + 5, back);
    c.fill();
  }
}

// Between two lines; of a loop column by column of pixels, what both ways reach joined, so that neither half stays empty or is twice as dark.
function drawBand(c, band, px, py, from, to) {
  const { x, low, high } = band;
  c.fillStyle = inColour("--band");
  if ((band.sorted ??= isSorted(x))) {
    band.lines ??= [
      { x, y: low },
      { x, y: high },
    ];
    fillBetween(c, ...band.lines, ...seen(x, from, to), px, py);
    return;
  }
  const step = Math.max(1, Math.floor(x.length / 4000)),
    columns = new Map();
  const add = (column, top, bottom) => {
    const parts = columns.get(column) ?? [];
    const apart = parts.filter((p) => p[1] < top || p[0] > bottom),
      touching = parts.filter((p) => !apart.includes(p));
    apart.push([Math.min(top, ...touching.map((p) => p[0])), Math.max(bottom, ...touching.map((p) => p[1]))]);
    columns.set(column, apart);
  };
  for (let i = 0; i + step < x.length; i += step) {
    const j = i + step;
    if ((x[i] < from && x[j] < from) || (x[i] > to && x[j] > to)) continue;
    const here = px(x[i]),
      there = px(x[j]),
      first = Math.floor(Math.min(here, there)),
      last = Math.floor(Math.max(here, there));
    for (let column = Math.max(first, 0); column <= Math.min(last, c.canvas.width); column++) {
      const share = there === here ? 0 : Math.max(0, Math.min(1, (column + 0.5 - here) / (there - here)));
      add(column, py(high[i] + share * (high[j] - high[i])), py(low[i] + share * (low[j] - low[i])));
    }
  }
  for (const [column, parts] of columns) for (const [top, bottom] of parts) c.fillRect(column, top, 1, bottom - top);
}

function drawCursors(plot, c, px, foot) {
  for (const name of ["a", "b"]) {
    const cursor = plot.link.cursors[name];
    if (!cursor) continue;
    const x = px(cursor.x);
    if (x < LEFT - 1 || x > plot.canvas.clientWidth - RIGHT + 1) continue;
    c.strokeStyle = c.fillStyle = inColour(`--${name}`);
    c.lineWidth = 1.2;
    c.beginPath();
    c.moveTo(x, TOP);
    c.lineTo(x, foot);
    c.stroke();
    c.textAlign = "left";
    c.textBaseline = "top";
    c.fillText(name.toUpperCase(), x + 3, TOP);
  }
  plot.cursorButton.textContent = `cursor ${plot.link.next.toUpperCase()}`;
}

function fitting(c, text, room) {
  if (c.measureText(text).width <= room) return text;
  let short = text;
  while (short.length > 4 && c.measureText(`${short}…`).width > room) short = short.slice(0, -1);
  return `${short}…`;
}

// In lines of this room at most, parted behind blanks and signs; within a word only where it is wider itself.
export function folded(c, text, room) {
  const lines = [""],
    wide = (line) => c.measureText(line.trim()).width > room;
  for (const word of text.match(/[^\s_,;-]+[\s_,;-]*/g) ?? [text])
    for (const piece of wide(word) ? word : [word]) {
      if (lines.at(-1) && wide(lines.at(-1) + piece)) lines.push("");
      lines[lines.length - 1] += piece;
    }
  return lines.map((line) => line.trim());
}
