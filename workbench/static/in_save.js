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
  );
}

// The row may be drawn anew meanwhile: what it says stands in the bag.
async function save(bag, compare) {
  const { data, context, faults } = bag,
    told = (saving) => {
      bag.saving = saving;
      const row = document.getElementById("saving");
      if (row) fill(bag, row);
    };
  told(true);
  const found = await context.act(post("in/save"), faults);
  if (found) await context.act(post("state", { model: context.state.view.model || data.proposal.reducer }), faults);
  told(false);
  if (found) compare();
}
