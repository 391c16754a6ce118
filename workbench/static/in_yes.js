// A guess that is right is stated by one click, as it is.

import { h } from "./dom.js";

// ``about``: of what, for who cannot see beside what the button stands.
export const soItIs = (about, onclick) =>
  h("button", { type: "button", class: "small yes", "aria-label": `so it is: ${about}`, title: "state it as it was guessed", onclick }, "so it is");

// The answer that a question offers: a click states it.
export const yes = ({ yes: text, stated }, wish) => (text ? h("button", { type: "button", class: "yes", onclick: () => wish((w) => state(w, stated)) }, text) : "");

function state(wishes, stated) {
  for (const [part, said] of Object.entries(stated)) wishes[part] = typeof said === "object" ? { ...wishes[part], ...said } : said;
}

// By condition the angle that its name holds and nobody stated.
export const anglesNamed = (proposal) =>
  Object.fromEntries(
    proposal.doubts
      .filter((d) => d.cell)
      .flatMap((d) => Object.entries(d.stated?.conditions ?? {}))
      .map(([key, angle]) => [key.slice(0, key.lastIndexOf(":")), angle]),
  );
