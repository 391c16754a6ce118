// From where measurements count: whether the zero of a quantity is known, and which files share the zero of their angles.

import { choose, h } from "./dom.js";

const ZERO = "an encoder starts anywhere: the mean of a transmission error or a loop is taken off unless its zero is known (lag under load, wind-up from rest)";

export const zeroOf = ({ data, putIn }, quantity, { zero }) =>
  zero
    ? h(
        "label",
        { class: "inline", title: ZERO },
        "zero",
        choose(
          [
            ["", "not known: its mean is taken off"],
            ["absolute", "known: its mean counts"],
          ],
          data.proposal.zeros[quantity] === "absolute" ? "absolute" : "",
          (value) => putIn("zeros", quantity, value),
          { "aria-label": `zero of ${quantity.replaceAll("_", " ")}` },
        ),
      )
    : null;

// Where angles count from is one unknown for each mounting; without a word for one all files are of the same.
export function mountings(bag, said) {
  const apart = said || bag.mountings;
  return h(
    "label",
    { class: "inline small", title: "unit and encoders stayed in place, or one of them was taken off and put back: each mounting then has a word of its own" },
    "The zero of the encoders' angles is",
    choose(
      [
        ["", "the same for all files"],
        ["apart", "another one at each mounting, said below"],
      ],
      apart ? "apart" : "",
      (value) => {
        bag.mountings = value === "apart";
        if (value || !said) bag.redraw();
        else bag.wish((w) => (w.conditions = Object.fromEntries(Object.entries(w.conditions ?? {}).filter(([key]) => !/(^|:)mounting$/.test(key)))));
      },
      { id: "mountings" },
    ),
  );
}
