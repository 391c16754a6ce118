// What is doubted of a column, with the button that mends it: under In at the file's row, elsewhere before what is drawn or said.

import { h, note } from "./dom.js";
import { post } from "./net.js";

const MOST_OPEN = 6;

// ``mend(column, role)`` has it mended.
export const doubtNotes = (found, mend) => {
  const lines = found.map((d) =>
    h(
      "div",
      { class: "doubt" },
      note([[d.text, d.remedy].filter(Boolean).join("; ")]),
      d.role ? h("button", { type: "button", onclick: () => mend(d.column, d.role) }, `Take ${d.column} for the ${d.title}`) : null,
    ),
  );
  const more = lines.splice(MOST_OPEN);
  return more.length ? [...lines, h("details", {}, h("summary", {}, `${more.length} more like these`), more)] : lines;
};

// Before a result, those that concern what follows: mended, it is asked for anew.
export const doubtsBefore = (result, context, kind, concerns = () => true) => {
  const found = (result.doubts ?? []).filter(concerns);
  return found.length
    ? h(
        "div",
        { class: "doubts" },
        doubtNotes(found, async (column, role) => {
          const mended = await context.act(post("in/mend", { column, role }));
          if (mended) context.start(kind, { model: result.model });
        }),
      )
    : null;
};
