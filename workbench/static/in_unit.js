// In which unit a column was written, and by which factor its numbers are multiplied; what cannot be is refused where it was typed.

import { choose, h, unitShown } from "./dom.js";

export const SCALE = "what the numbers of the column are multiplied by, such as 0.001, -1 or 1/3437.75";

// ``change("units" or "scales", text, place)`` sends it; a refusal is shown in the place.
export function unitOf(entry, { units, factor }, change) {
  const other = "other…",
    all = units.includes(entry.unit.value) ? units : [entry.unit.value, ...units],
    said = h("div", { class: "small" });
  const send = async (field, part) => {
    const taken = await change(part, field.value.trim(), said);
    if (!taken) field.setAttribute("aria-invalid", "true");
  };
  const list = choose(
    [...all.map((u) => [u, unitShown(u)]), [other, other]],
    entry.unit.value,
    (value) => {
      if (value !== other) {
        send(list, "units");
        return;
      }
      const field = h("input", { type: "text", size: 8, "aria-label": "unit", onchange: () => send(field, "units") });
      list.replaceWith(field);
      field.focus();
    },
    { "aria-label": `unit of ${entry.header}` },
  );
  const scale = h("input", {
    type: "text",
    size: 5,
    value: factor ?? "",
    placeholder: "1",
    inputmode: "decimal",
    "aria-label": `scale of ${entry.header}`,
    onchange: () => send(scale, "scales"),
  });
  return h("div", {}, h("div", { class: "row unit" }, list, h("label", { class: "inline", title: SCALE }, "×", scale)), said);
}
