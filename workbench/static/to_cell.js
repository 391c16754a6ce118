// Which cells a condition has, and the way to one from what is asked.

import { h, words } from "./dom.js";

export const PLACE = '"locked at" is the angle of the input at which loops were measured; "mean" may be typed instead: of positions over a turn of the cranks';

// Whether a key of a condition says something of any of these quantities: a loop has no speed and no load, and of what runs no input is locked.
export const matters = ({ factors, quantities }, key, measured) => !(key in factors) || measured.some((name) => quantities[name]?.matter.includes(key));

export const saysNothing = (key) => h("span", { class: "quiet", title: `${words(key)} says nothing of what was measured here` }, "–");

// ``cell``: condition and key, among the proposal's conditions or those of campaign.toml itself.
export function toCell([name, key]) {
  const go = () => {
    const place = document.getElementById(`c-${name}-${key}`) ?? document.getElementById(`cell-conditions-${name}-${key}`);
    for (let around = place?.parentElement; around; around = around.parentElement) if (around.tagName === "DETAILS") around.open = true;
    place?.scrollIntoView({ block: "center" });
    place?.focus({ preventScroll: true });
  };
  return h("button", { type: "button", class: "to-cell", onclick: go }, `Say it: ${words(key)}`);
}
