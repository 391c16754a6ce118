// What may be added of an answer; and where unused runs contradict it: that it was refused, and what can be done then.

import { effectName, h } from "./dom.js";

const MOST_TURNED_DOWN = 4;

// Names as they are asked for: what was named together first, then each of it alone, then all with one of it in a form or place that looks alike.
export function offered(answer) {
  const named = answer.effects.flatMap((e) => e.candidates),
    off = answer.base_off.map((b) => `base.${b.name.split(" ")[0]}`);
  if (answer.confusable.length) return [...new Set([...answer.effects.map((e) => e.candidates[0]), ...alike(answer)])];
  const together = named.length ? named : off;
  if (together.length) return [...new Set([together.join(" + "), ...together, ...alike(answer)])];
  return answer.rejected.slice(0, 5).map((r) => r.name);
}

// What this campaign cannot tell from what is offered first; effects that are alternatives themselves stand alone.
export function alike(answer) {
  return answer.effects.flatMap((e) =>
    (e.instead ?? []).map((other) => (answer.confusable.length ? other : answer.effects.flatMap((one) => (one === e ? [other] : one.candidates)).join(" + "))),
  );
}

// ``add(name)`` tries another one.
export function refusal(answer, extension, busy, add) {
  const tried = new Set(extension.steps.filter((s) => s.kept === false).map((s) => s.effects.join(" + "))).add(extension.effects.join(" + ")),
    // What was turned down first stands nearest.
    others = [...new Set([...offered(answer), ...answer.rejected.slice(0, MOST_TURNED_DOWN).map((r) => r.name)])].filter((name) => !tried.has(name));
  // Where nothing was named nothing is asked for, and a refusal is what was to be expected.
  const named = answer.verdict !== "none",
    after = named ? " and measure what it asks for next" : ", which names nothing that is missing";
  return h(
    "div",
    { id: "refused" },
    h("h3", { class: "bad" }, `Refused: ${extension.effects.map(effectName).join(" + ")} is not in the model`),
    h("p", { class: "lead" }, `${extension.verdict}; ${extension.reason}`),
    h("p", { class: "quiet" }, "model.toml is written without it: the model as it was, and what was tried as a step not kept."),
    h(
      "p",
      { class: "quiet" },
      others.length
        ? `What can be done: try another effect that the diagnosis looked at, or go back to its answer${after}.`
        : `All that the diagnosis ${named ? "named" : "looked at first"} was tried. Go back to its answer${after}.`,
    ),
    h(
      "div",
      { class: "row" },
      others.map((name) => h("button", { type: "button", disabled: !!busy, title: busy || undefined, onclick: () => add(name) }, `Try ${effectName(name)}${name.includes(" + ") ? "" : " alone"}`)),
      h("button", { type: "button", onclick: () => document.getElementById("verdict")?.scrollIntoView({ block: "start" }) }, "Back to the answer"),
    ),
  );
}
