// Orders of a signal over the output's turn: of one condition as stems, of all as a waterfall; hovering names what makes an order.

import { h, number, table } from "./dom.js";
import { LEFT, RIGHT, folded } from "./paint.js";
import { Plot } from "./plot.js";

const FONT = "11.5px system-ui, sans-serif";
const SHOWN = 12;
const STRONGEST = ["order", "measured", "predicted", "of the residual", "makes it"];
// A row of the waterfall, a line of its name, and what stands below the rows [px].
const ROW = 26,
  LINE = 13,
  BELOW = 34,
  MOST_TALL = 420;

export function orders(signal, condition, result, plots) {
  const chosen = signal.spectra.find((s) => s.condition === condition),
    none = signal.no_orders?.[condition];
  const parts = [h("h3", { style: { "margin-top": "16px" } }, "Orders of the output's turn")];
  if (none) parts.push(h("p", { class: "quiet", id: "no-orders" }, `None at ${condition}: ${none}`));
  const said = h("p", { class: "quiet small", "aria-live": "polite" }, "Point at an order to see what makes it.");
  if (chosen) {
    const plot = new Plot({ height: 240, label: `orders of ${signal.title} at ${condition}` });
    const x = Float32Array.from(chosen.measured, (_, i) => i);
    const stem = (name, values, colour, shift) => ({ name, x, y: Float32Array.from(values), colour, width: 2.2, stems: true, shift, sorted: true });
    plot.set({
      xTitle: "order",
      panes: [
        {
          title: `amplitude [${signal.unit}]`,
          floor: true,
          zero: true,
          lines: [stem("measured", chosen.measured, "--measured", -0.22), stem("predicted", chosen.predicted, "--predicted", 0.22)],
        },
      ],
    });
    plots.push(plot);
    const hover = (order) => {
      said.replaceChildren(...about(order, result, chosen, signal.unit));
    };
    plot.canvas.addEventListener("pointermove", (event) => {
      const box = plot.canvas.getBoundingClientRect(),
        [low, high] = plot.range();
      const at = low + ((event.clientX - box.left - LEFT) / (box.width - LEFT - RIGHT)) * (high - low);
      const near = [Math.round(at) - 1, Math.round(at), Math.round(at) + 1]
        .filter((o) => o > 0 && o < chosen.measured.length)
        .sort((p, q) => chosen.measured[q] - chosen.measured[p])[0];
      if (near) hover(near);
    });
    const strongest = chosen.measured
      .map((v, order) => [order, Math.max(v, chosen.predicted[order])])
      .sort((p, q) => q[1] - p[1])
      .slice(0, SHOWN)
      .map(([order]) => order)
      .filter((o) => o > 0)
      .sort((p, q) => p - q);
    parts.push(
      plot.element,
      chosen.bridged ? h("p", { class: "quiet small" }, chosen.bridged) : null,
      said,
      h(
        "details",
        {},
        h("summary", {}, `The ${strongest.length} strongest orders, and what makes them`),
        table(
          STRONGEST,
          strongest.map((o) =>
            h(
              "tr",
              { tabindex: 0, onfocus: () => hover(o), onpointerenter: () => hover(o) },
              [h("b", {}, String(o)), number(chosen.measured[o], 3), number(chosen.predicted[o], 3), number(chosen.residual[o], 3), makersOf(o, result)].map(
                (cell, i) => h("td", { class: i && i < 4 ? "num" : undefined, "data-head": STRONGEST[i] }, cell),
              ),
            ),
          ),
          [1, 2, 3],
        ),
      ),
    );
  }
  if (signal.spectra.length > 1) parts.push(waterfall(signal, said, result));
  return h("div", { id: "orders" }, parts);
}

const makersOf = (order, result) =>
  [result.orders[String(order)] ? `${result.orders[String(order)]}` : "", (result.makers?.[String(order)] ?? []).map((m) => m.title).join(", ")]
    .filter(Boolean)
    .join(": ") || "–";

function about(order, result, spectrum, unit) {
  const name = result.orders[String(order)],
    makers = result.makers?.[String(order)] ?? [];
  return [
    h("b", {}, `order ${order}`),
    `${name ? ` (${name})` : ""}: measured ${number(spectrum.measured[order], 3)} ${unit}, predicted ${number(spectrum.predicted[order], 3)} ${unit}. `,
    makers.length
      ? `Effects that make it: ${makers.map((m) => `${m.title} (${Math.round(100 * m.share)} % of its strongest order)`).join("; ")}.`
      : result.makers && Object.keys(result.makers).length
        ? "No effect of the catalogue makes it alone."
        : "",
  ];
}

// Conditions above each other, orders along: the darker the stronger, of what was measured or of what is left.
function waterfall(signal, said, result) {
  const canvas = h("canvas", {
    style: { width: "100%", height: `${Math.min(MOST_TALL, ROW * signal.spectra.length + BELOW)}px` },
    role: "img",
    "aria-label": `orders of ${signal.title} for each condition`,
  });
  let which = "measured";
  const names = signal.spectra.map((s) => s.condition);
  const draw = () => {
    const ratio = window.devicePixelRatio || 1,
      width = canvas.clientWidth;
    if (!width) return;
    const left = Math.min(150, width * 0.3),
      c = canvas.getContext("2d");
    // A name that is wider than its place takes more lines, and all rows as much height.
    c.font = FONT;
    const lines = names.map((name) => folded(c, name, left - 8)),
      height = Math.max(canvas.clientHeight, (Math.max(...lines.map((l) => l.length)) * LINE + 5) * names.length + BELOW);
    canvas.style.height = `${height}px`;
    canvas.width = width * ratio;
    canvas.height = height * ratio;
    const style = getComputedStyle(document.documentElement);
    c.setTransform(ratio, 0, 0, ratio, 0, 0);
    c.font = FONT;
    const tall = (height - BELOW) / signal.spectra.length,
      count = Math.min(...signal.spectra.map((s) => s[which].length));
    const most = Math.max(...signal.spectra.flatMap((s) => s[which].slice(0, count)));
    signal.spectra.forEach((s, row) => {
      c.fillStyle = style.getPropertyValue("--quiet");
      c.textAlign = "right";
      c.textBaseline = "middle";
      lines[row].forEach((line, i) => c.fillText(line, left - 6, (row + 0.5) * tall + (i - (lines[row].length - 1) / 2) * LINE));
      c.fillStyle = style.getPropertyValue("--predicted");
      for (let order = 1; order < count; order++) {
        c.globalAlpha = Math.min(1, Math.sqrt(s[which][order] / (most || 1)));
        const x = left + ((order - 1) / (count - 1)) * (width - left - 8);
        c.fillRect(x, row * tall + 1, Math.max(1.4, (width - left - 8) / (count - 1)), tall - 2);
      }
      c.globalAlpha = 1;
    });
    c.fillStyle = style.getPropertyValue("--quiet");
    c.textAlign = "center";
    c.textBaseline = "top";
    const wide = width - left - 8,
      // As many as stand apart.
      step = [20, 40, 50, 100, 200].find((s) => (s / count) * wide > c.measureText("000 ").width) ?? count;
    for (let order = step; order < count; order += step) {
      const text = String(order),
        half = c.measureText(text).width / 2;
      c.fillText(text, Math.min(left + ((order - 0.5) / (count - 1)) * wide, width - 2 - half), height - 30);
    }
    c.fillText("order", left + (width - left) / 2, height - 15);
  };
  new ResizeObserver(draw).observe(canvas);
  canvas.addEventListener("pointermove", (event) => {
    const box = canvas.getBoundingClientRect(),
      left = Math.min(150, box.width * 0.3),
      count = signal.spectra[0][which].length;
    const order = 1 + Math.floor(((event.clientX - box.left - left) / (box.width - left - 8)) * (count - 1)),
      row = Math.floor((event.clientY - box.top) / ((box.height - BELOW) / signal.spectra.length));
    const s = signal.spectra[row];
    if (s && order > 0 && order < count) said.replaceChildren(h("b", {}, `${s.condition}, `), ...about(order, result, s, signal.unit));
  });
  const button = (name) =>
    h(
      "button",
      {
        type: "button",
        "aria-pressed": String(which === name),
        onclick: (event) => {
          which = name;
          for (const b of event.currentTarget.parentElement.children) b.setAttribute("aria-pressed", String(b === event.currentTarget));
          draw();
        },
      },
      name,
    );
  return h(
    "div",
    {},
    h("div", { class: "row" }, h("h3", {}, "Waterfall over the conditions"), h("div", { class: "chips" }, ["measured", "predicted", "residual"].map(button))),
    canvas,
    h(
      "details",
      { class: "behind" },
      h("summary", {}, "Table"),
      table(
        ["condition", ...strong(signal).map((o) => `order ${o}`)],
        signal.spectra.map((s) => [s.condition, ...strong(signal).map((o) => number(s.measured[o], 3))]),
        strong(signal).map((_, i) => i + 1),
      ),
    ),
  );
}

const strong = (signal) =>
  signal.spectra[0].measured
    .map((_, o) => [o, Math.max(...signal.spectra.map((s) => s.measured[o]))])
    .sort((p, q) => q[1] - p[1])
    .slice(0, SHOWN)
    .map(([o]) => o)
    .filter((o) => o > 0)
    .sort((p, q) => p - q);
