// After the diagnosis: what to measure next, the effect added, how the error fell, the units built.

import { choose, command, effectName, h, note, number, table, words } from "./dom.js";
import { cards, sections } from "./page.js";
import { alike, offered, refusal } from "./refused.js";
import { asked } from "./to_cell.js";

// Where it is told what is being done, once it is.
const progressOf = (kind) => h("ul", { class: "quiet small", id: `doing-${kind}`, "aria-live": "off" });

const NOTHING = "Nothing is to be added: the model is adequate";

// What is asked for; of what a design cannot show nobody knows a price or what would be off.
function questions(next, price, context) {
  const priced = next.asked.some((a) => a.like || a.cost !== null || a.expected !== null);
  const head = ["☐", "measure", "because", ...(priced ? ["condition", price, "expected misfit"] : [])];
  const rows = next.asked.map((a) => [
    "☐",
    a.experiment,
    h("span", {}, asked(a.why, next.cells, context)),
    ...(priced ? [a.like, a.cost === null ? "–" : String(Number(a.cost.toPrecision(4))), number(a.expected, 3)] : []),
  ]);
  return table(head, rows, priced ? [4, 5] : [], { class: "rows" });
}

export function nextPart(bag) {
  const { answer, next, context } = bag;
  const busy = context.busy();
  const price = next?.cost_unit ? `price [${next.cost_unit}]` : "price";
  const sheet = next
    ? [
        // A clause a line; what an earlier version kept is one.
        Array.isArray(next.verdict) && next.verdict.length > 1
          ? h(
              "ul",
              { class: "lead" },
              next.verdict.map((line) => h("li", {}, line)),
            )
          : h("p", { class: "lead" }, next.verdict),
        next.proposals.length
          ? h(
              "div",
              { id: "sheet" },
              table(
                ["☐", "experiment", price, "least separation [chi-square]", "mean separation [chi-square]"],
                next.proposals.map((p) => ["☐", p.experiment, String(Number(p.cost.toPrecision(4))), number(p.least, 3), number(p.mean, 3)]),
                [2, 3, 4],
                { class: "rows" },
              ),
            )
          : null,
        next.asked.length
          ? h(
              "div",
              { id: "asked" },
              questions(next, price, context),
            )
          : null,
        Object.keys(next.stakes).length
          ? h(
              "p",
              { class: "quiet small" },
              `What it costs not to know: ${Object.entries(next.stakes)
                .map(([k, v]) => `at ${words(k)} up to ${v}`)
                .join("; ")}`,
            )
          : null,
        // Where nothing is proposed there is nothing to take to the rig.
        next.asked.length + next.proposals.length
          ? h(
              "div",
              { class: "row" },
              h("a", { class: "button", href: "results/next/report?download", download: "" }, "Sheet for the rig"),
              h("button", { type: "button", onclick: () => print() }, "Print"),
            )
          : null,
        command(next.command),
      ]
    : null;
  const ask = [
    sheet,
    h("button", { type: "button", id: "next", disabled: !!busy, title: busy || undefined, onclick: () => context.start("next", { model: answer.model }) }, next ? "Ask again" : answer.would_show ? "Make the sheet" : "Propose the next experiment"),
  ];
  // Of an adequate model nothing need be asked; what was asked all the same is seen.
  if (answer.verdict === "none")
    return h(
      "section",
      {},
      h("h2", {}, answer.untold?.length ? `What can still be asked: ${answer.untold.length > 1 ? `${answer.untold.length} questions` : "one question"}` : "Nothing is left to explain: no further experiment is asked for"),
      ...(answer.untold ?? []).map((text) => h("p", {}, text)),
      h("p", { class: "quiet" }, "How large an effect must have been to be seen, what these runs cannot show, and what would, stands in the evidence above."),
      h("div", { class: "panel" }, h("details", { id: "next-anyway", open: !!next }, h("summary", {}, answer.would_show ? "What these runs cannot show, as a sheet for the rig" : "Propose an experiment anyway"), ask), progressOf("next")),
    );
  return h("section", {}, h("h2", {}, "What to measure next"), h("div", { class: "panel" }, ask, progressOf("next")));
}

export function addPart(bag) {
  const { answer, extension, context, old } = bag;
  let anyway = false;
  // What a former model lacks may be in this one already.
  const busy = context.busy() || (old && `${old} Diagnose that first.`);
  const options = offered(answer),
    others = alike(answer),
    adequate = answer.verdict === "none";
  if (!options.length) return adequate ? h("section", {}, h("h2", {}, NOTHING)) : null;
  const add = (name) => context.start("extend", { model: answer.model, effects: name.split(" + "), anyway });
  let choice = options[0];
  const keep = h("input", {
    type: "checkbox",
    onchange: () => {
      anyway = keep.checked;
    },
  });
  const offer = [
    h(
      "p",
      { class: "quiet small" },
      "It is fitted to the runs that are not held out and judged on those that are; it stays only if their error falls. The model is model.toml in the folder.",
    ),
    // It is added at one of these places, and is no surer there than at the others.
    (answer.open ?? []).map((text) => note(text)),
    h(
      "div",
      { class: "row" },
      options.length > 1
        ? choose(
            options.map((o) => [o, effectName(o) + (others.includes(o) ? ", which looks alike" : "")]),
            choice,
            (v) => {
              choice = v;
            },
          )
        : h("b", {}, effectName(choice)),
      h(
        "button",
        {
          type: "button",
          class: adequate || (extension && !extension.kept) ? "" : "main",
          id: "extend",
          disabled: !!busy,
          title: busy || undefined,
          onclick: () => add(choice),
        },
        "Add it",
      ),
      h("label", { class: "inline small" }, keep, "keep it even if it does not help"),
    ),
  ];
  return h(
    "section",
    {},
    h("h2", {}, adequate ? NOTHING : "Add it to the model"),
    h(
      "div",
      { class: "panel" },
      adequate ? h("details", { id: "anyway" }, h("summary", {}, "Add an effect anyway"), offer) : offer,
      progressOf("extend"),
      extension
        ? [
            extension.kept
              ? h(
                  "p",
                  { class: `lead ${extension.verdict === "helped" ? "good" : "fair"}`, id: "added" },
                  `${extension.effects.map(effectName).join(" + ")}: ${extension.verdict}; ${extension.reason}`,
                )
              : refusal(answer, extension, busy, add),
            extension.left ? h("p", { class: "fair", id: "left" }, extension.left) : null,
            cards(extension.page.cards),
            // Stiffness, lost motion and the like are what one asks first.
            sections(extension.page.sections, extension.page.sections[0]?.id === "figures" ? 1 : 0),
            command(extension.command),
          ]
        : null,
    ),
  );
}

export function ladder(bag) {
  const { extension, built, context } = bag;
  if (!extension) return null;
  const busy = context.busy(),
    steps = extension.steps,
    // What stands above already, beside the step that was taken last.
    told = new Set(extension.page.sections.map((s) => JSON.stringify(s))),
    chosen = (kind) => async () => {
      await context.choose("model.toml");
      if (kind === "compare") context.go("look");
      context.start(kind, { model: "model.toml" });
    };
  const most = Math.max(...steps.flatMap((s) => [s.held_out_before ?? 0, s.held_out_after ?? 0, s.training_before ?? 0, s.training_after ?? 0]), 1),
    inModel = steps.some((s) => s.kept !== false),
    last = steps.at(-1),
    fell = (last?.held_out_after ?? last?.training_after ?? 0) < (last?.held_out_before ?? last?.training_before ?? 0);
  // An error that rose is no success, whatever became of the step.
  const tone = (before, after) => (after > before ? "bad" : after < before ? "good" : "");
  const bar = (value, tone) =>
    value === null || value === undefined
      ? "–"
      : h(
          "span",
          { class: tone },
          h("span", { class: "off" }, number(value, 3)),
          h("span", { class: "bar", style: { width: `${Math.max(2, (90 * value) / most)}px` } }),
        );
  return h(
    "section",
    { id: "ladder" },
    h("h2", {}, extension.kept && fell ? "How the error fell" : "What became of the error"),
    h(
      "div",
      { class: "panel" },
      table(
        ["step", "fitted runs, before", "after", "unused runs, before", "after", "verdict"],
        steps.map((s) => [
          s.effects.map(effectName).join(" + "),
          bar(s.training_before, "quiet"),
          bar(s.training_after, "quiet"),
          // Runs that an effect hardly changes judge nothing: no number there looks like a success.
          ...(s.unseen ? ["–", "–"] : [bar(s.held_out_before, "quiet"), bar(s.held_out_after, tone(s.held_out_before, s.held_out_after))]),
          `${s.verdict}${s.kept === false ? ", not kept" : ""}`,
        ]),
      ),
      extension.left ? h("p", { class: "fair" }, extension.left) : null,
      h("p", { class: "quiet small" }, "In units of the noise, in the patterns that carry the misfit; 1 is what repetitions differ by on average, single patterns differ by more. Of fitted runs any effect lowers it."),
      steps.some((s) => s.unseen) ? h("p", { class: "quiet small" }, "–: unused runs are hardly changed by it, and judge nothing; with one condition left out at a time it is judged, as said above.") : null,
      // Where nothing was ever added there is no better model.
      inModel
        ? h(
            "div",
            { class: "row" },
            h(
              "button",
              { type: "button", id: "better", disabled: !!busy, title: busy || undefined, onclick: chosen("compare") },
              extension.kept ? (fell ? "Look at the better model" : "Look at the new model") : "Look at the model as it stands",
            ),
            h("button", { type: "button", id: "else", disabled: !!busy, title: busy || undefined, onclick: chosen("diagnose") }, "Is anything else missing?"),
            h("button", { type: "button", id: "build", disabled: !!busy, title: busy || undefined, onclick: () => context.start("build", { model: "model.toml" }) }, "Build its FMUs"),
          )
        : null,
      progressOf("build"),
      built
        ? [
            h("h3", {}, "FMUs"),
            table(
              ["file", "size"],
              built.files.map((f) => [f.name, `${Math.round(f.bytes / 1000).toLocaleString("en")} kB`]),
              [1],
            ),
            (built.take ?? []).map((text) => h("p", { class: "quiet small" }, text)),
            command(built.command),
          ]
        : null,
      sections(extension.ladder.sections.filter((s) => !told.has(JSON.stringify(s)))),
    ),
  );
}
