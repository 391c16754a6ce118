// Try: what would change in each signal, as a table.

import { h, table } from "./dom.js";

export const everySignal = (rows) =>
  h(
    "div",
    { class: "panel" },
    h("h3", {}, "What it would do to each signal"),
    table(
      ["signal", "of", "changes it by", "error before", "after"],
      rows.map((r) => [r.title, r.of, r.touched ? r.change : "nothing", r.before, h("span", { class: r.better ? "good" : "" }, r.after)]),
      [2, 3, 4],
    ),
    rows
      .filter((r) => r.look)
      .map((r) => h("p", { class: "small as-look" }, `${r.title} before, of the same runs and samples, at the one zero and lag that Look has for all runs: ${r.look}; here each run is at its own: ${r.before}.`)),
    h("p", { class: "quiet small" }, "All of them first looks, one run of each condition; where hours have worn the reducer, changes are right within some parts in a hundred of themselves. The number below the chart is exact. Transmission errors stand from the zero and with the lag that suit each curve; where an input was locked, and whatever else is calibrated, stays as the base model has it (beside what a diagnosis names, as that found it), so that adding an effect may do better."),
  );
