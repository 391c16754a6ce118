// The numbers behind a plot: values at the cursors, and all that is seen as a table or a file.

import { h, number } from "./dom.js";
import { nearestIndex } from "./scale.js";

const MOST_ROWS = 400;

function indexAt(x, sorted, cursor) {
  if (sorted) return nearestIndex(x, cursor.x);
  return cursor.index !== undefined && cursor.index < x.length ? cursor.index : null;
}

// What is read of a line: mostly what is drawn.
const read = (line) => line.told ?? line;

// Values at the cursors and their differences.
export function tell(plot) {
  const { a, b } = plot.link.cursors;
  const key = JSON.stringify([a, b, plot.lines.length, [...plot.hiddenNames]]) + plot.lines.map((l) => l.y.length).join();
  if (plot.told === key && plot.toldLines === plot.lines) return;
  plot.told = key;
  plot.toldLines = plot.lines;
  if (!a && !b) {
    plot.readout.replaceChildren();
    return;
  }
  const value = (line, cursor) => {
    const { x, y } = read(line),
      i = cursor ? indexAt(x, line.sorted, cursor) : null;
    return i === null ? NaN : y[i];
  };
  const rows = plot.panes.flatMap((pane) =>
    plot
      .shown(pane)
      .filter((l) => l.name)
      .map((line) => {
        const va = value(line, a),
          vb = value(line, b);
        return h(
          "tr",
          {},
          h("td", {}, line.name),
          h("td", { class: "num" }, number(va)),
          h("td", { class: "num" }, number(vb)),
          h("td", { class: "num" }, number(vb - va)),
        );
      }),
  );
  const at = (cursor) => (cursor ? number(cursor.x, 5) : "–");
  plot.readout.replaceChildren(
    h(
      "table",
      {},
      h(
        "thead",
        {},
        h(
          "tr",
          {},
          h("th", {}, plot.xTitle),
          h("th", { class: "num a" }, `A: ${at(a)}`),
          h("th", { class: "num b" }, `B: ${at(b)}`),
          h("th", { class: "num" }, `B − A: ${a && b ? number(b.x - a.x, 5) : "–"}`),
        ),
      ),
      h("tbody", {}, rows),
    ),
  );
}

// With a byte order mark where a sign is outside ASCII: without it Excel takes UTF-8 for the machine's own code page.
export function marked(text) {
  return /[^ -~\t\r\n]/.test(text) ? `\ufeff${text}` : text;
}

// What the curves show as numbers: rows over the stretch that is seen, and all of it as a file.
export function fillTable(plot) {
  if (!plot.behind.open) return;
  const [low, high] = plot.range();
  const parts = [];
  for (const x of new Set(plot.lines.map((l) => read(l).x))) {
    const own = plot.lines.filter((l) => read(l).x === x && l.name);
    if (!own.length) continue;
    const inside = [];
    for (let i = 0; i < x.length; i++) if (x[i] >= low && x[i] <= high) inside.push(i);
    const step = Math.max(1, Math.ceil(inside.length / MOST_ROWS));
    const head = [plot.xTitle, ...own.map((l) => l.name)];
    const rows = inside
      .filter((_, k) => k % step === 0)
      .map((i) =>
        h(
          "tr",
          {},
          h("td", { class: "num" }, number(x[i], 6)),
          own.map((l) => h("td", { class: "num" }, number(read(l).y[i], 5))),
        ),
      );
    const save = () => {
      const text = marked([head.map((t) => `"${t}"`).join(","), ...inside.map((i) => [x[i], ...own.map((l) => read(l).y[i])].join(","))].join("\n"));
      const link = h("a", { href: URL.createObjectURL(new Blob([text], { type: "text/csv" })), download: "curves.csv" });
      link.click();
      URL.revokeObjectURL(link.href);
    };
    parts.push(
      h(
        "p",
        { class: "row" },
        h("span", { class: "quiet" }, `${inside.length} samples${step > 1 ? `, every ${step}th is listed` : ""}`),
        h("button", { type: "button", onclick: save }, "save as CSV"),
      ),
      h(
        "div",
        { class: "scroll" },
        h(
          "table",
          {},
          h(
            "thead",
            {},
            h(
              "tr",
              {},
              head.map((t) => h("th", { class: "num" }, t)),
            ),
          ),
          h("tbody", {}, rows),
        ),
      ),
    );
    if (parts.length > 8) break;
  }
  plot.behind.lastElementChild.replaceChildren(...parts);
}
