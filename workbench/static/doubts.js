// What is doubted of a column, with the button that mends it: under In at the file's row, elsewhere before what is drawn or said.

import { h, note } from "./dom.js";
import { post } from "./net.js";

// ``mend(column, role)`` has it mended.
export const doubtNotes = (found, mend) =>
  found.map((d) =>
    h(
      "div",
      { class: "doubt" },
      note([`${d.text}; ${d.remedy}`]),
      d.role ? h("button", { type: "button", onclick: () => mend(d.column, d.role) }, `Take ${d.column} for the ${d.title}`) : null,
    ),
  );

// Before a result: mended, it is asked for anew.
export const doubtsBefore = (result, context, kind) =>
  result.doubts?.length
    ? h(
        "div",
        { class: "doubts" },
        doubtNotes(result.doubts, async (column, role) => {
          const found = await context.act(post("in/mend", { column, role }));
          if (found) context.start(kind, { model: result.model });
        }),
      )
    : null;
