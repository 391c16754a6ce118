// Axes and lines of plots as plain computation: ticks, ranges, and what of a long line a screen can show.

import { number } from "./dom.js";

export function ticks(low, high, wanted) {
  const span = high - low;
  if (!(span > 0) || !Number.isFinite(span)) return [];
  const raw = span / Math.max(1, wanted),
    power = 10 ** Math.floor(Math.log10(raw));
  const step = [1, 2, 2.5, 5, 10].map((k) => k * power).find((s) => s >= raw * 0.75);
  const found = [];
  for (let v = Math.ceil(low / step - 1e-9) * step; v <= high + 1e-9 * span; v += step) found.push(Math.abs(v) < 1e-9 * step ? 0 : v);
  return found;
}

// As many decimals as tell the ticks apart.
export function tickText(value, step) {
  const size = Math.max(Math.abs(value), step);
  if (size >= 1e6 || (size < 1e-4 && size > 0)) return number(value, 3);
  const plain = step > 0 ? Math.max(0, Math.min(8, -Math.floor(Math.log10(step) + 1e-9))) : 0;
  const decimals = step > 0 && Math.abs(step * 10 ** plain - Math.round(step * 10 ** plain)) > 1e-6 ? plain + 1 : plain;
  return value.toFixed(decimals).replace("-", "−");
}

export function isSorted(x) {
  for (let i = 1; i < x.length; i++) if (x[i] < x[i - 1]) return false;
  return true;
}

// First index whose x is not below the value.
export function firstFrom(x, value) {
  let low = 0,
    high = x.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (x[middle] < value) low = middle + 1;
    else high = middle;
  }
  return low;
}

export function nearestIndex(x, value) {
  const i = firstFrom(x, value);
  if (i <= 0) return 0;
  if (i >= x.length) return x.length - 1;
  return value - x[i - 1] < x[i] - value ? i - 1 : i;
}

export function span(values, from = 0, to = values.length) {
  let low = Infinity,
    high = -Infinity;
  for (let i = from; i < to; i++) {
    const v = values[i];
    if (v < low) low = v;
    if (v > high) high = v;
  }
  return [low, high];
}

// Indices [from, to) of a rising axis that lie in [low, high], one more at either side.
export function seen(x, low, high) {
  return [Math.max(0, firstFrom(x, low) - 1), Math.min(x.length, firstFrom(x, high) + 1)];
}

// Lowest and highest of each BLOCK samples of a long line: what is far out is drawn and measured by these.
const BLOCK = 64,
  LONG = 40_000;
export function blocks(line) {
  if (line.y.length < LONG) return null;
  if (!line.blocks) {
    const { y } = line,
      count = Math.ceil(y.length / BLOCK),
      low = new Float32Array(count),
      high = new Float32Array(count);
    for (let b = 0; b < count; b++) [low[b], high[b]] = span(y, b * BLOCK, Math.min(y.length, (b + 1) * BLOCK));
    line.blocks = { low, high };
  }
  return line.blocks;
}

// Range of a line's values between two indices.
export function spanOf(line, from, to) {
  const coarse = blocks(line);
  if (!coarse || to - from < 4 * BLOCK) return span(line.y, from, to);
  const first = Math.ceil(from / BLOCK),
    last = Math.floor(to / BLOCK);
  const parts = [span(line.y, from, first * BLOCK), span(line.y, last * BLOCK, to), [span(coarse.low, first, last)[0], span(coarse.high, first, last)[1]]];
  return [Math.min(...parts.map((p) => p[0])), Math.max(...parts.map((p) => p[1]))];
}

// Lowest and highest of a rising line in each column of pixels, told as (column, lowest, highest) in the line's unit.
function columns(line, from, to, px, tell) {
  const { x, y } = line,
    coarse = farOut(line, from, to, Math.abs(px(x[to - 1]) - px(x[from])) || 1) ? blocks(line) : null;
  const step = coarse ? BLOCK : 1;
  let column = NaN,
    low = Infinity,
    high = -Infinity;
  const flush = () => {
    if (high >= low) tell(column, low, high);
  };
  for (let i = coarse ? Math.floor(from / BLOCK) : from; i < (coarse ? Math.ceil(to / BLOCK) : to); i++) {
    const at = Math.floor(px(x[Math.min(x.length - 1, i * step)])),
      below = coarse ? coarse.low[i] : y[i],
      above = coarse ? coarse.high[i] : y[i];
    if (at !== column) {
      flush();
      column = at;
      low = Infinity;
      high = -Infinity;
    }
    if (below < low) low = below;
    if (above > high) high = above;
  }
  flush();
}
const farOut = (line, from, to, pixels) => line.y.length >= LONG && to - from > 2 * BLOCK * pixels;

// A rising line on a canvas: sample by sample, or, where many share a column of pixels, a bar for each column that touches its neighbour.
export function traceSorted(context, line, from, to, px, py) {
  const { x, y } = line,
    wide = Math.abs(px(x[Math.max(from, to - 1)]) - px(x[from]));
  if (to - from > 3 * wide) {
    const thick = Math.max(1, context.lineWidth);
    let lastTop = NaN,
      lastBottom = NaN;
    columns(line, from, to, px, (column, low, high) => {
      let top = py(high),
        bottom = py(low);
      if (lastBottom < top) top = lastBottom;
      if (lastTop > bottom) bottom = lastTop;
      lastTop = py(high);
      lastBottom = py(low);
      context.fillRect(column, top - thick / 2, 1, bottom - top + thick);
    });
    return;
  }
  let pen = false;
  context.beginPath();
  for (let i = from; i < to; i++) {
    if (y[i] !== y[i]) {
      pen = false;
      continue;
    }
    if (pen) context.lineTo(px(x[i]), py(y[i]));
    else context.moveTo(px(x[i]), py(y[i]));
    pen = true;
  }
  context.stroke();
}

// The area between two rising lines: corner by corner, or, where many samples share a column of pixels, a bar for each column from the lowest of one
// to the highest of the other (a polygon of so many corners takes ten times as long to fill).
export function fillBetween(context, lower, upper, from, to, px, py) {
  const { x } = upper,
    wide = Math.abs(px(x[Math.max(from, to - 1)]) - px(x[from]));
  if (to - from > 3 * wide) {
    const bottoms = new Map();
    columns(lower, from, to, px, (column, low) => bottoms.set(column, py(low)));
    columns(upper, from, to, px, (column, _, high) => context.fillRect(column, py(high), 1, bottoms.get(column) - py(high)));
    return;
  }
  context.beginPath();
  for (let i = from; i < to; i++) context.lineTo(px(x[i]), py(upper.y[i]));
  for (let i = to - 1; i >= from; i--) context.lineTo(px(x[i]), py(lower.y[i]));
  context.fill();
}

// Extremes of each BLOCK samples of a long line that turns back, and of eight such blocks, and so on: [{size, left, right, low, high}, ...], finest first.
function pyramid(line) {
  if (line.pyramid) return line.pyramid;
  const level = (size, count, of) => {
    const made = { size, left: new Float32Array(count), right: new Float32Array(count), low: new Float32Array(count), high: new Float32Array(count) };
    for (let b = 0; b < count; b++) [[made.left[b], made.right[b]], [made.low[b], made.high[b]]] = of(b);
    return made;
  };
  const { x, y } = line,
    first = level(BLOCK, Math.ceil(x.length / BLOCK), (b) => {
      const to = Math.min(x.length, (b + 1) * BLOCK);
      return [span(x, b * BLOCK, to), span(y, b * BLOCK, to)];
    });
  line.pyramid = [first];
  for (let fine = first; fine.low.length > 8000; fine = line.pyramid.at(-1)) {
    const part = (values, b) => span(values, 8 * b, Math.min(fine.low.length, 8 * b + 8));
    line.pyramid.push(
      level(8 * fine.size, Math.ceil(fine.low.length / 8), (b) => [
        [part(fine.left, b)[0], part(fine.right, b)[1]],
        [part(fine.low, b)[0], part(fine.high, b)[1]],
      ]),
    );
  }
  return line.pyramid;
}

// A line that turns back, as a loop does: sample by sample, or, of a long one, a box around as many neighbours as a pixel or two hold.
export function traceLoop(context, line, from, to, px, py) {
  const { x, y } = line;
  if (x.length < LONG) {
    context.beginPath();
    tracePath(context, x, y, px, py);
    context.stroke();
    return;
  }
  const levels = pyramid(line),
    finest = levels[0],
    inside = (level, b) => level.right[b] >= from && level.left[b] <= to;
  let count = 0;
  for (let b = 0; b < finest.low.length; b++) if (inside(finest, b)) count++;
  if (count * BLOCK < LONG) {
    context.beginPath();
    for (let b = 0; b < finest.low.length; b++) {
      // One sample more at either side: the next run of blocks goes on from there.
      if (inside(finest, b)) tracePath(context, x, y, px, py, Math.max(0, b * BLOCK - 1), Math.min(x.length, (b + 1) * BLOCK + 1));
    }
    context.stroke();
    return;
  }
  const level = levels.findLast((l) => (count * BLOCK) / l.size > 2000) ?? finest,
    thick = Math.max(1, context.lineWidth);
  for (let b = 0; b < level.low.length; b++) {
    if (!inside(level, b) || !(level.high[b] >= level.low[b])) continue;
    const left = px(level.left[b]) - thick / 2,
      top = py(level.high[b]) - thick / 2;
    context.fillRect(left, top, px(level.right[b]) + thick / 2 - left, py(level.low[b]) + thick / 2 - top);
  }
}

// Sample by sample: those that fall on the last pixel are left out.
export function tracePath(context, x, y, px, py, from = 0, to = x.length) {
  let lastX = NaN,
    lastY = NaN,
    pen = false;
  for (let i = from; i < to; i++) {
    if (y[i] !== y[i]) {
      pen = false;
      continue;
    }
    const sx = px(x[i]),
      sy = py(y[i]);
    if (pen && Math.abs(sx - lastX) < 0.5 && Math.abs(sy - lastY) < 0.5) continue;
    if (pen) context.lineTo(sx, sy);
    else context.moveTo(sx, sy);
    pen = true;
    lastX = sx;
    lastY = sy;
  }
}
