// A campaign.toml as it stands, corrected cell by cell: conditions, and the columns by which each file is read.

import { choose, h, table, words } from "./dom.js";
import { SCALE } from "./in_unit.js";
import { PLACE, matters, saysNothing } from "./to_cell.js";

// ``put(place, value)`` sends a correction; what is refused is shown as it was.
const fieldOf = (put) => (place, value, label, size = 12) =>
  h("input", {
    type: "text",
    value: value ?? "",
    size,
    id: `cell-${place.join("-")}`,
    "aria-label": label,
    style: { width: `${Math.max(size, String(value ?? "").length + 2)}ch` },
    onchange: (event) => put(place, event.target.value),
  });

export function conditionCells(found, choices, put) {
  const field = fieldOf(put),
    tick = (place, value, label) =>
      h("input", { type: "checkbox", id: `cell-${place.join("-")}`, checked: Boolean(value), "aria-label": label, onchange: (event) => put(place, event.target.checked) });
  // What a layout says of its runs is not known here: then all cells stay.
  const known = found.runs.every((r) => typeof r.condition === "string" && r.quantity),
    measured = (name) => found.runs.filter((r) => r.condition === name).map((r) => r.quantity);
  const cell = (name, key) => {
    const value = found.conditions[name][key];
    if (known && measured(name).length && value === undefined && !matters(choices, key, measured(name))) return saysNothing(key);
    return (key === "held_out" ? tick : field)(["conditions", name, key], value, `${words(key)} of ${name}`);
  };
  const condition = (name) => [h("b", {}, name), ...found.keys.map((key) => cell(name, key))];
  return h(
    "details",
    { class: "panel", id: "cells-conditions" },
    h("summary", {}, h("b", {}, "Correct conditions")),
    found.keys.includes("locked_at") ? h("p", { class: "quiet small" }, `${PLACE}.`) : null,
    table(["condition", ...found.keys.map(words)], Object.keys(found.conditions).map(condition), [], { class: "rows" }),
  );
}

// ``quantities`` have the roles that a column may take.
export function runCells(found, quantities, put) {
  const field = fieldOf(put);
  const part = (r, i, role) =>
    quantities[r.quantity]
      ? choose(
          Object.entries(quantities[r.quantity].roles).map(([name, known]) => [name, known.title]),
          role,
          (other) => put(["runs", i, "columns", role], other),
          { "aria-label": `role of ${r.columns[role].column} in ${r.id}`, style: { width: "14em" } },
        )
      : h("span", { class: "quiet" }, words(role));
  const names = Object.keys(found.conditions);
  const run = (r, i) => [
    h("div", {}, h("b", {}, r.id), h("div", { class: "quiet small" }, r.file)),
    words(r.quantity),
    names.includes(r.condition) ? choose(names, r.condition, (value) => put(["runs", i, "condition"], value), { "aria-label": `condition of ${r.id}` }) : String(r.condition),
    h(
      "div",
      {},
      Object.entries(r.columns).map(([role, c]) =>
        h(
          "div",
          { class: "row small", style: { gap: "4px 6px" } },
          part(r, i, role),
          field(["runs", i, "columns", role, "column"], c.column, `column of ${role} in ${r.id}`),
          field(["runs", i, "columns", role, "unit"], c.unit, `unit of ${role} in ${r.id}`, 8),
          h("label", { class: "inline", title: SCALE }, "×", field(["runs", i, "columns", role, "scale"], c.scale, `scale of ${role} in ${r.id}`, 4)),
        ),
      ),
    ),
  ];
  return h(
    "details",
    { class: "panel", id: "cells-runs" },
    h("summary", {}, h("b", {}, "Correct the columns of single files")),
    table(["run and file", "quantity", "condition", "roles, columns, units and factors"], found.runs.map(run), [], { class: "rows" }),
  );
}
