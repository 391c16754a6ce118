// Saving the campaign, and comparing at once: reading all files again takes seconds, in which the row says so.

import { clear, h } from "./dom.js";
import { post } from "./net.js";

export function saveRow(bag) {
  const row = h("div", { class: "row", id: "saving" });
  fill(bag, row);
  return row;
}

function fill(bag, row) {
  const { data, context, saving } = bag,
    { reducer, needs } = data.proposal,
    lacks = reducer ? (needs.length ? "what is needed above has to be answered first" : "") : "the reducer has to be chosen first",
    compare = (model) => {
      context.go("look");
      context.start("compare", { model });
    };
  const button = (text, given) => h("button", { type: "button", ...given, disabled: !!(saving || given.disabled) }, text);
  clear(
    row,
    button(saving ? "Saving …" : data.saved ? "Save anew and compare" : "Save and compare", {
      class: "main",
      id: "save",
      disabled: lacks,
      title: lacks || undefined,
      onclick: () => save(bag, () => compare(reducer)),
    }),
    saving ? h("span", { class: "inline", role: "status" }, h("progress", { "aria-label": "saving" }), " reading all files once more, then comparing") : null,
    data.saved
      ? h("span", { class: "quiet" }, data.own ? (data.same ? "campaign.toml is saved" : "changed since it was saved") : "campaign.toml was written elsewhere and is not overwritten")
      : null,
    data.saved ? button("Compare", { onclick: () => compare(context.model() || reducer) }) : null,
    lacks ? h("span", { class: "fair" }, lacks) : null,
    lacks ? null : open(data),
  );
}

// Nothing is assumed without a word: what stands open as it is saved, and what is taken for it.
function open({ proposal: { doubts }, saved, same }) {
  const placeless = doubts.filter((d) => d.cell),
    others = doubts.filter((d) => !d.cell);
  if (!doubts.length) return null;
  const told = [
    ...placeless.map((d) => `where the input was locked in ${d.place}: loops are predicted as the mean over a turn of the cranks until somebody says it`),
    ...others.filter((d) => d.guess).map((d) => `guessed: ${d.guess}`),
    others.some((d) => !d.guess) ? "what else is not sure above is taken as it stands" : "",
  ].filter(Boolean);
  return h("div", { class: "fair small open", id: "open" }, saved && same ? "Saved with this open: " : "Open, and saved so: ", told.join("; "), ".");
}

// The row may be drawn anew meanwhile: what it says stands in the bag.
async function save(bag, compare) {
  const { data, context, faults, inTurn } = bag,
    told = (saving) => {
      bag.saving = saving;
      const row = document.getElementById("saving");
      if (row) fill(bag, row);
    };
  told(true);
  // After what was corrected before: else that would be saved as it was, and its answer would clear away what is said here.
  const found = await inTurn(() => context.act(post("in/save"), faults));
  if (found) await context.act(post("state", { model: context.state.view.model || data.proposal.reducer }), faults);
  told(false);
  if (found) compare();
}
