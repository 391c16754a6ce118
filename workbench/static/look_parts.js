// Pieces of Look: the key figures, what a chart of a signal holds, single numbers, where the model fails.

import { h, note, number, table, why, words } from "./dom.js";
import { shifted } from "./shifted.js";
import { asked } from "./to_cell.js";

const CLEAR = 3,
  MOST_KINDS = 16;
const tone = (off) => (off > 5 ? "bad" : off > CLEAR ? "fair" : "");

// In the order in which one asks.
const ORDER = ["torsional stiffness", "lost motion", "mean width of the loop", "peak to peak"];
const rank = (f) => {
  const i = ORDER.findIndex((name) => f.name.startsWith(name));
  return i < 0 ? ORDER.length : i + (f.name.length > ORDER[i].length ? 0.5 : 0);
};

export const figureTitle = (f) => `${f.title} ${f.name} ${f.condition}`;

// What an engineer asks first: stiffness, lost motion, width, error by order; as they are measured and as the model has them.
export function keyFigures({ result, all, text, matches, search, showAll }) {
  const found = result.figures.filter((f) => matches(figureTitle(f)));
  const worst = new Map();
  for (const f of [...found].sort((p, q) => Math.abs(q.off) - Math.abs(p.off))) if (!worst.has(f.signal + f.name)) worst.set(f.signal + f.name, f);
  // Those of the catalogue have a row, however near they are (ORDER has their plain names).
  const kinds = [...worst.values()],
    told = kinds.filter((f, i) => i < MOST_KINDS || ORDER.includes(f.name));
  const rows = (all || text ? [...found] : told).sort(
    (p, q) => p.title.localeCompare(q.title) || rank(p) - rank(q) || Math.abs(q.off) - Math.abs(p.off),
  );
  if (!result.figures.length) return null;
  const most = Math.max(5, ...rows.map((f) => Math.abs(f.off)));
  return h(
    "section",
    { id: "figures" },
    h(
      "div",
      { class: "row spread" },
      h("h2", { style: { margin: 0 } }, "Key figures"),
      h(
        "label",
        { class: "inline" },
        h("input", {
          type: "search",
          placeholder: "search signals, figures, conditions  ( / )",
          size: 30,
          value: text,
          oninput: (e) => search(e.target.value),
        }),
      ),
    ),
    h(
      "div",
      { class: "panel" },
      rows.length ? null : h("p", { class: "quiet" }, "No figure has all of these words."),
      table(
        ["signal", "figure", "condition", "measured", "noise", result.calibrated.length ? "model, calibrated" : "model", "off, in noise", ""],
        rows.map((f, i) => [
          rows[i - 1]?.title === f.title ? "" : f.title,
          h("b", {}, f.name),
          f.condition,
          `${f.measured} ${f.unit}`,
          h("span", { class: "quiet" }, `± ${f.noise}`),
          `${f.model} ${f.unit}`,
          h(
            "span",
            { class: tone(Math.abs(f.off)), title: f.repeated ? `from ${f.runs} repetitions` : "from the noise of the samples: nothing is repeated" },
            h("span", { class: "off" }, number(Math.abs(f.off), 3)),
            h("span", { class: "bar", style: { width: `${Math.max(2, (46 * Math.abs(f.off)) / most)}px` } }),
          ),
          why(f.why, `${f.name} at ${f.condition}`),
        ]),
        [3, 4, 5, 6],
        { class: "stack" },
      ),
      rows.length < result.figures.length && !text
        ? h(
            "button",
            {
              type: "button",
              class: "plainly",
              onclick: showAll,
            },
            `all ${result.figures.length} figures (${told.length < kinds.length ? `the ${told.length} kinds furthest off or of the catalogue are shown, ${kinds.length - told.length} nearer ones not` : "every kind is shown"}, each at the condition where it is furthest off)`,
          )
        : null,
      result.of_chance ? h("p", { class: "quiet small" }, `${result.of_chance}.`) : null,
    ),
  );
}

export function spec({ part, shift, asMeasured, several }, signal, members) {
  const upper = [],
    lower = [],
    bands = [];
  // Orders stand apart: a line through them would be none.
  const look = members[0].stems ? { stems: true, sorted: true, width: 2.4 } : {};
  // Both ways of a loop lie close: dashed, the prediction lets what was measured be seen under it.
  const [broad, dash] = signal.loop ? [2, [8, 5]] : [1.1, undefined];
  members.forEach((run, k) => {
    const raw = part(run.x),
      // Orders stand where they do.
      moved = shift && !run.stems ? shifted(raw, part(run.measured), part(run.predicted), run.noises ? part(run.noises) : run.noise, shift) : null,
      x = moved?.x ?? raw,
      opacity = several ? 0.55 : Math.max(0.35, 0.95 - 0.2 * k),
      zero = asMeasured ? (run.zero ?? 0) : 0,
      at = (values) => (zero ? values.map((v) => v + zero) : values),
      predicted = at(part(run.predicted)),
      left = moved?.residual ?? part(run.residual),
      name = several ? ` · ${run.condition}` : "";
    if (k === 0 && !run.stems) {
      const noise = 2 * run.noise;
      bands.push({ x: raw, low: predicted.map((v) => v - noise), high: predicted.map((v) => v + noise) });
    }
    upper.push({
      name: k && !several ? "" : `measured${name}`,
      x,
      y: at(part(run.measured)),
      colour: "--measured",
      width: broad,
      opacity,
      dots: run.dots,
      aside: run.aside,
      ...look,
      shift: -0.3,
    });
    lower.push({
      name: k && !several ? "" : `residual / noise${shift ? ", shifted" : ""}${name}`,
      x,
      y: left,
      colour: "--residual",
      width: 1.1,
      opacity,
      dots: run.dots,
      aside: run.aside,
      ...look,
    });
    if (k === 0 || several)
      upper.push({
        name: `predicted${name}`,
        x: raw,
        y: predicted,
        // Read where the samples stand that it is held against.
        told: moved && { x, y: at(moved.predicted) },
        colour: "--predicted",
        width: 1.8,
        dash,
        opacity: several ? 0.8 : 1,
        ...look,
        shift: 0.3,
      });
  });
  return {
    xTitle: signal.axis.title,
    loop: signal.loop,
    panes: [
      { title: `${signal.title.split(" (")[0]} [${signal.unit}]`, weight: 2, lines: upper, bands, zero: !!look.stems, floor: !!look.stems },
      { title: `residual / noise${shift ? ", shifted" : ""}`, weight: 1, zero: true, limits: [-2, 2], lines: lower },
    ],
  };
}

export function singles(signal) {
  const count = signal.singles.reduce((n, run) => n + run.measured.length, 0);
  return h(
    "details",
    { class: "panel", open: count <= 30 },
    h("summary", {}, h("b", {}, `${signal.title}: ${count} single number${count === 1 ? "" : "s"} [${signal.unit}]`)),
    table(
      ["run", "condition", "measured", "noise", "model", "off, in noise"],
      signal.singles.flatMap((run) =>
        run.measured.map((value, i) => [
          run.run,
          h("span", {}, run.condition, run.held_out ? h("span", { class: "tag held" }, "held out") : ""),
          value,
          h("span", { class: "quiet" }, `± ${run.noise}`),
          run.predicted[i],
          h("span", { class: tone(Math.abs(run.off[i])) }, number(Math.abs(run.off[i]), 3)),
        ]),
      ),
      [2, 3, 4, 5],
    ),
  );
}

const titleOf = (result, signal) => result.signals.find((s) => s.signal === signal)?.title ?? words(signal);

// What is significant is not nothing, however little of all misfit it is.
const percent = (share) => (share < 0.005 ? "< 1 %" : `${Math.round(100 * share)} %`);

export const fails = (result, context) =>
  result.places.length
    ? h(
        "section",
        {},
        h("h2", {}, "Where the model fails"),
        h("p", { class: "quiet small" }, "Significant against the noise of repetitions, over all tests together. The share is of the squares of all that is significantly off, in times of the noise, all samples of all signals together."),
        h(
          "div",
          { class: "panel" },
          table(
            ["signal", "what", "depends on", "share of all misfit", ""],
            result.places
              .slice(0, 20)
              .map((p) => [
                titleOf(result, p.signal),
                p.feature,
                words(p.dependence),
                `${percent(p.share)}, ${p.chance}`,
                why(p.why, `${titleOf(result, p.signal)}, ${p.feature}`),
              ]),
            [3],
            { class: "rows" },
          ),
        ),
        h(
          "button",
          {
            type: "button",
            class: "main",
            onclick: () => {
              context.go("diagnose");
              context.start("diagnose");
            },
          },
          "Which effect is missing?",
        ),
      )
    : h("p", { class: "lead" }, "No place, order or dependence carries a significant misfit.");

export const notes = (result, context) =>
  result.warnings.length + result.calibrated.length > 0 &&
  h(
    "details",
    { open: result.warnings.length > 0 && result.warnings.length < 4 },
    h("summary", {}, `${result.warnings.length || "no"} note${result.warnings.length === 1 ? "" : "s"}${result.calibrated.length ? `, ${result.calibrated.length} calibrated` : ""}`),
    result.warnings.map((t) => note(asked(t, result.cells, context))),
    result.calibrated.length
      ? h(
          "div",
          { class: "panel" },
          table(
            ["calibrated", "value", "meaning"],
            result.calibrated.map((c) => [words(c.name), c.value, c.meaning]),
          ),
          result.unsure ? h("p", { class: "quiet small" }, result.unsure) : null,
        )
      : null,
  );
