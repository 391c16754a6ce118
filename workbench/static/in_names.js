// Names of files that differ by numbers alone belong together; what such a number says is chosen once for all of them.

import { choose, h } from "./dom.js";

const NUMBER = /(\d+(?:[.,]\d+)?)/;
// Field of a pattern of names, with what a number without a unit is taken for.
const FIELDS = { load: "load torque [N m]", speed: "speed [rpm]", temperature: "temperature [°C]", hours: "hours [h]", locked_at: "input locked at [°]" };
// What stands right behind a number that is an angle: of a condition it is the one at which the input was locked.
const DEGREES = /^\s?(°|deg|grad|gradi|grados|graus|degrés?|度)(?!\p{L})/iu;

// Names by what they differ in alone, words kept whole; as they are where that is all of one or nothing of it.
export function apart(names) {
  if (names.length < 2) return names;
  const parted = names.map((name) => name.match(/[^\s_]+[\s_]*/gu) ?? [name]),
    least = Math.min(...parted.map((parts) => parts.length)),
    same = (place) => parted.every((parts) => parts.at(place) === parted[0].at(place));
  let before = 0,
    behind = 0;
  while (before < least && same(before)) before++;
  while (before + behind < least && same(-1 - behind)) behind++;
  const found = parted.map((parts) => parts.slice(before, parts.length - behind).join("").replace(/[\s_]+$/u, ""));
  return found.every(Boolean) ? found : names;
}

export const family = (pattern) => pattern.split(NUMBER).map((part, i) => (i % 2 ? "0" : part)).join("");

// The numbers of one place in patterns of one family, whether they are angles, and the pattern with a field there; null where several places differ, or a
// number has letters of another unit behind it.
export function differing(patterns) {
  const parted = patterns.map((pattern) => pattern.split(NUMBER)),
    places = parted[0].map((_, i) => i).filter((i) => new Set(parted.map((parts) => parts[i])).size > 1);
  if (places.length !== 1) return null;
  const [at] = places,
    behind = parted[0][at + 1],
    angles = DEGREES.test(behind);
  if (!angles && /^[^\W\d_]/u.test(behind)) return null;
  return {
    angles,
    numbers: parted.map((parts) => parts[at]).sort((p, q) => figure(p) - figure(q)),
    number: (pattern) => figure(pattern.split(NUMBER)[at]),
    pattern: (field) => parted[0].map((part, i) => (i === at ? `{${field}}` : part)).join(""),
  };
}

// The pattern of one family of names: where they differ by the angle alone at which the input was locked, its field stands in place of the angle of one file.
export function familyPattern(runs, conditions) {
  const patterns = [...new Set(runs.map((run) => run.names))],
    found = patterns.length > 1 ? differing(patterns) : null;
  const isLocked = (run) => parseFloat(conditions[run.condition]?.locked_at ?? "") === found.number(run.names);
  return found?.angles && runs.every(isLocked) ? found.pattern("locked_at") : patterns[0];
}

const figure = (text) => parseFloat(text.replace(",", "."));

// ``take(pattern)`` is told what was chosen, ``place({condition: angle})`` that it is where the input was locked, which leaves conditions the names that they
// have; ``held``: whether the input may be locked in these runs.
export function numbersSaid(runs, conditions, held, take, place) {
  const patterns = [...new Set(runs.map((run) => run.names))];
  if (patterns.length < 2) return null;
  const found = differing(patterns),
    fits = (field) => (field === "locked_at" ? held : !found?.angles),
    free = Object.entries(FIELDS).filter(([field]) => fits(field) && !patterns[0].includes(`${field}}`) && !patterns[0].includes(`{${field}_`));
  // Where each run states all of these numbers they are read already: "locked at 40°".
  const stated = new Set(runs.flatMap((run) => [...Object.values(run.stated).map((guess) => guess.value), conditions[run.condition]?.locked_at ?? ""].map(parseFloat)));
  if (found?.numbers.every((text) => stated.has(figure(text)))) return null;
  if (!found || !free.length)
    return h("p", { class: "fair small" }, `${patterns.length} names that differ by numbers make conditions of their own. What a number says can be put in under Conditions, or its field, such as {load} or {speed}, in its place under "names say".`);
  return h(
    "p",
    { class: "fair small" },
    h("label", { class: "inline" }, `The ${found.numbers.length} numbers in these names (${found.numbers.join(", ")}) are`, choose([["", "names alone"], ...free], "", (field) => field && (field === "locked_at" ? place(Object.fromEntries(runs.map((run) => [run.condition, `${found.number(run.names)} deg`]))) : take(found.pattern(field))), { "aria-label": "numbers in the names" })),
  );
}
