// Which cells a condition has, and the way to one from what is asked.

import { h, words } from "./dom.js";

export const PLACE = '"locked at" is the angle of the input at which loops were measured; "mean" may be typed instead: of positions over a turn of the cranks';

// Whether a key of a condition says something of any of these quantities: a loop has no speed and no load, and of what runs no input is locked.
export const matters = ({ factors, quantities }, key, measured) => !(key in factors) || measured.some((name) => quantities[name]?.matter.includes(key));

export const saysNothing = (key) => h("span", { class: "quiet", title: `${words(key)} says nothing of what was measured here` }, "–");

// What another view asks for, until In is drawn.
let wanted = null;

// ``cell``: condition and key, among the proposal's conditions or those of campaign.toml itself; or a role alone: the first column that has it.
const placeOf = ([name, key]) =>
  key
    ? (document.getElementById(`c-${name}-${key}`) ?? document.getElementById(`cell-conditions-${name}-${key}`))
    : [...document.querySelectorAll('select[aria-label^="role of "]')].find((role) => role.value === name);

function lead(cell) {
  const place = placeOf(cell);
  for (let around = place?.parentElement; around; around = around.parentElement) if (around.tagName === "DETAILS") around.open = true;
  place?.scrollIntoView({ block: "center" });
  place?.focus({ preventScroll: true });
}

const button = ([name, key], onclick) => h("button", { type: "button", class: "to-cell", onclick }, `Say it: ${key ? words(key) : `whose the ${words(name)} is`}`);

export const toCell = (cell) => button(cell, () => lead(cell));

// From a result: the cell is another view's.
export const toCellOfIn = (cell, context) =>
  button(cell, () => {
    wanted = cell;
    context.go("in");
  });

// In, drawn: whoever was sent here stands at the cell.
export function arrive() {
  if (wanted) lead(wanted);
  wanted = null;
}

// What is no cell: the doubt may be gone once it is known which effect is missing.
const FIRST = "diagnose";
const toDiagnose = (context) => h("button", { type: "button", class: "to-cell", onclick: () => context.go(FIRST) }, "Diagnose first");

// A note of a result, with the way to what answers it.
export function asked(text, cells, context) {
  const cell = cells?.[text];
  return cell ? [text, " ", cell[0] === FIRST ? toDiagnose(context) : toCellOfIn(cell, context)] : [text];
}
