"use strict";
// Figures on a narrow card: names beside rows and bars fold, heads stand upright where they would lie over each other, titles and
// names of a legend fold where they would be cut.

const NARROW = 520, LETTER = 6.2, LINE = 13;
// Names have so much of a card's width; a map's row takes so much beside its lines.
const SHARE = 0.32, MARGIN = 10;
// What the line beside a name of the legend takes, with the edges.
const KEY = 60;
// Ticks and the gap below them, above a title; a row of a legend; and the lowest that curves become.
const UNDER = 42, ROW = 19, LEAST = 80;

// Words of a name in lines of so many letters at most; what is one long word is cut where it has a sign.
function folded(name, letters) {
  const lines = [""];
  for (const part of String(name).replace(/<br>/g, " ").match(/[^\s_.,]+[\s_.,]*/g) ?? []) {
    if (lines.at(-1) && (lines.at(-1) + part).trimEnd().length > letters) lines.push("");
    lines[lines.length - 1] += part;
  }
  return lines.map((line) => line.trim());
}

const longest = (texts) => Math.max(...texts.map((text) => Math.max(...String(text).split("<br>").map((line) => line.length))));
const named = (values) => values?.length && values.every((v) => typeof v === "string");

// Ticks of an axis of names, folded to a width [px]; and how many lines the longest has.
function ticks(names, width) {
  const texts = names.map((name) => folded(name, Math.max(6, Math.floor(width / LETTER))));
  return { axis: { tickmode: "array", tickvals: names, ticktext: texts.map((t) => t.join("<br>")) }, lines: Math.max(...texts.map((t) => t.length)), texts };
}

// The axis of upright bars with names that would run together: the tallest keep theirs, as far as these stand apart.
function thinned(data, layout, width) {
  const bars = data.filter((trace) => trace.type === "bar" && named(trace.x));
  if (!bars.length || layout.xaxis?.tickangle !== 0) return {};
  const names = bars[0].x, cell = (width - (layout.margin?.l ?? 80) - (layout.margin?.r ?? 80)) / names.length;
  const tall = (i) => Math.max(...bars.map((trace) => Math.abs(trace.y[i] ?? 0)));
  const kept = [];
  for (const i of names.map((_, k) => k).sort((p, q) => tall(q) - tall(p)))
    if (kept.every((k) => Math.abs(k - i) * cell > ((names[k].length + names[i].length) / 2 + 1) * LETTER)) kept.push(i);
  return kept.length < names.length ? { xaxis: { ...layout.xaxis, tickmode: "array", tickvals: kept.sort((p, q) => p - q).map((i) => names[i]) } } : {};
}

// The axis of bars that lie, long enough for what is written behind the longest.
function roomy(data, layout, wide) {
  const [low, high] = layout.xaxis?.range ?? [];
  if (low !== 0 || layout.xaxis.type === "log") return {};
  const ends = data.filter((trace) => trace.type === "bar" && Array.isArray(trace.text)).flatMap((trace) => trace.x.map((x, i) => (x * wide) / Math.max(wide / 2, wide - (String(trace.text[i]).length + 1) * LETTER)));
  return { xaxis: { ...layout.xaxis, range: [0, Math.max(high, ...ends)] } };
}

// Titles of axes in lines that their axis has room for.
function titled(layout, width, height) {
  const { l = 80, r = 80, t = 100, b = 80 } = layout.margin ?? {}, shown = { ...layout };
  for (const key of Object.keys(layout).filter((name) => /^[xy]axis\d*$/.test(name) && layout[name]?.title?.text)) {
    const axis = layout[key], [from, to] = axis.domain ?? [0, 1], upright = key[0] === "y";
    const lines = folded(axis.title.text, Math.max(8, Math.floor(((upright ? height - t - b : width - l - r) * (to - from)) / LETTER)));
    if (lines.length < 2) continue;
    shown[key] = { ...axis, title: { ...axis.title, text: lines.join("<br>") } };
    // An axis that takes no room by itself is given it.
    if (axis.automargin === false) shown.margin = { ...shown.margin, ...(upright ? { l: l + LINE * (lines.length - 1) } : { b: b + LINE * (lines.length - 1) }) };
  }
  return shown;
}

// Names of a legend that lies below, each in lines of the card's width: what is wider is cut.
function keyed(data, layout, width) {
  if (layout.legend?.orientation !== "h" || layout.showlegend === false) return data;
  const letters = Math.floor((width - KEY) / LETTER);
  return data.map((trace) => (trace.name?.length > letters ? { ...trace, name: folded(trace.name, letters).join("<br>") } : trace));
}

// A legend below, moved down where the title of the axis above it would lie in it; what it takes itself makes the curves lower.
function cleared(data, layout, width, height) {
  const legend = layout.legend ?? {}, title = layout.xaxis?.title?.text;
  if (legend.orientation !== "h" || layout.showlegend === false || !(legend.y < 0) || !title || layout.xaxis.showticklabels === false) return layout;
  const { l = 80, r = 80, t = 100, b = 80 } = layout.margin ?? {};
  const names = data.filter((trace) => trace.name && trace.showlegend !== false).map((trace) => trace.name.split("<br>"));
  const beside = Math.max(1, Math.floor((width - l - r) / (KEY + LETTER * Math.max(1, ...names.flat().map((line) => line.length)))));
  const rows = Math.ceil(names.length / beside) * Math.max(1, ...names.map((lines) => lines.length));
  const needed = UNDER + LINE * String(title).split("<br>").length, high = Math.max(LEAST, height - t - Math.max(b, needed + ROW * rows));
  return -legend.y * high < needed ? { ...layout, legend: { ...legend, y: -needed / high } } : layout;
}

// What the card of this width shows: {data, layout, height}; what needs nothing stays as it is.
function narrowed(figure, data, layout, width) {
  const shown = byNames(figure, data, layout, width);
  if (width >= NARROW) return shown;
  const keys = keyed(shown.data, shown.layout, width);
  return { ...shown, data: keys, layout: cleared(keys, titled(shown.layout, width, shown.height), width, shown.height) };
}

// The same, where names stand beside rows or below bars.
function byNames(figure, data, layout, width) {
  const bar = data.find((trace) => trace.type === "bar" && trace.orientation === "h");
  const map = data.find((trace) => trace.type === "heatmap" && named(trace.y));
  const names = [...new Set((bar ?? map)?.y ?? [])];
  if (!named(names)) return { data, layout: { ...layout, ...thinned(data, layout, width) }, height: figure.height };
  const narrow = width < NARROW;
  if (!narrow && longest(names) * LETTER < SHARE * width) return { data, layout, height: figure.height };
  const rows = ticks(names, SHARE * width);
  const bars = bar ? data.filter((trace) => trace.type === "bar").length : 1;
  let height = Math.max(figure.height, figure.height + names.length * (rows.lines * LINE + MARGIN - (bar ? 28 + 18 * (bars - 1) : 27)));
  const shown = { ...layout, yaxis: { ...layout.yaxis, ...rows.axis } };
  if (bar) return { data, layout: { ...shown, ...roomy(data, layout, (1 - SHARE) * width - (layout.margin?.r ?? 80)), margin: { ...layout.margin, l: 8 } }, height };
  // A map: its scale goes, for the colours are told below and the cells have their numbers.
  const cell = (width - Math.max(...rows.texts.flat().map((line) => line.length)) * LETTER - 30) / map.x.length;
  const heads = ticks(map.x, cell);
  const fit = longest(heads.axis.ticktext) * LETTER < cell;
  const upright = { tickangle: -90, tickmode: "array", tickvals: map.x, ticktext: map.x.map((head) => String(head).replace(/<br>/g, " ")) };
  shown.xaxis = { ...layout.xaxis, ...(fit ? { ...heads.axis, tickangle: 0 } : upright) };
  height += fit ? (heads.lines - 1) * LINE : Math.min(longest(upright.ticktext), 30) * LETTER - LINE;
  shown.margin = { ...layout.margin, l: 8, r: 4 };
  // Numbers of a few signs stand in narrow cells, too.
  const tight = map.text && longest(map.text.flat()) * LETTER > cell;
  return { data: data.map((t) => (t === map ? { ...t, showscale: false, ...(tight ? { textfont: { ...t.textfont, size: 8 } } : {}) } : t)), layout: shown, height };
}
