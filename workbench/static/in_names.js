// Names of files that differ by numbers alone belong together; what such a number says is chosen once for all of them.

import { choose, h } from "./dom.js";

const NUMBER = /(\d+(?:[.,]\d+)?)/;
// Field of a pattern of names, with what a number without a unit is taken for.
const FIELDS = { load: "load torque [N·m]", speed: "speed [rpm]", temperature: "temperature [°C]", hours: "hours [h]" };

export const family = (pattern) => pattern.split(NUMBER).map((part, i) => (i % 2 ? "0" : part)).join("");

// The numbers of one place in patterns of one family, and the pattern with a field there; null where several places differ, or a number has letters behind it.
export function differing(patterns) {
  const parted = patterns.map((pattern) => pattern.split(NUMBER)),
    places = parted[0].map((_, i) => i).filter((i) => new Set(parted.map((parts) => parts[i])).size > 1);
  if (places.length !== 1 || /^[^\W\d_]/u.test(parted[0][places[0] + 1])) return null;
  const [at] = places;
  return {
    numbers: parted.map((parts) => parts[at]).sort((p, q) => parseFloat(p) - parseFloat(q)),
    pattern: (field) => parted[0].map((part, i) => (i === at ? `{${field}}` : part)).join(""),
  };
}

// ``take(pattern)`` is told what was chosen.
export function numbersSaid(patterns, take) {
  if (patterns.length < 2) return null;
  const found = differing(patterns),
    free = Object.entries(FIELDS).filter(([field]) => !patterns[0].includes(`${field}}`) && !patterns[0].includes(`{${field}_`));
  if (!found || !free.length)
    return h("p", { class: "fair small" }, `${patterns.length} names that differ by numbers make conditions of their own. What a number says can be put in under Conditions, or its field, such as {load} or {speed}, in its place under "names say".`);
  return h(
    "p",
    { class: "fair small" },
    h("label", { class: "inline" }, `The ${found.numbers.length} numbers in these names (${found.numbers.join(", ")}) are`, choose([["", "names alone"], ...free], "", (field) => field && take(found.pattern(field)), { "aria-label": "numbers in the names" })),
  );
}
