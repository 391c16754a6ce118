// Diagnose: which effect is missing, why, what else it might be, what to measure next; add it, see the error fall, build the units.

import { addPart, ladder, nextPart } from "./better.js";
import { clear, command, duration, effectName, h, note, redraw, why } from "./dom.js";
import { doubtsBefore } from "./doubts.js";
import { exported, exportMenu } from "./export.js";
import { get } from "./net.js";
import { cards, recolour, sections, warnings } from "./page.js";
import { dimmed, past } from "./past.js";
import { asked } from "./to_cell.js";

// What a diagnosis is called that begins at the beginning, or goes on; its steps stand within.
const WHOLE = ["the whole diagnosis", "the rest of the diagnosis"];

// What is done where the diagnosis was kept from before (steps.py): nothing is diagnosed then.
const PAGE_OF_FOUND = "drawing the page of the diagnosis that was found again";

// What the answer took; one of the same model and measurements that is kept is found again, and nothing is computed then.
function took(answer) {
  const spent = `${duration(answer.seconds)} of computing`;
  if (!answer.found) return spent;
  return `found again: made ${new Date(1000 * answer.found).toLocaleString("en-GB", { dateStyle: "medium", timeStyle: "short" })}${answer.found_in ? `, from the folder ${answer.found_in} with the same files,` : ""} in ${spent}`;
}

export function show(root, context) {
  let answer = null,
    next = null,
    extension = null,
    built = null;
  const top = h("div"),
    live = h("div"),
    body = h("div"),
    after = h("div");
  root.append(top, live, body, after);

  const fetched = (kind) => get(`results/${kind}`).catch(() => null);
  async function load() {
    const jobs = context.state?.jobs ?? {};
    [answer, next, extension, built] = await Promise.all(["diagnose", "next", "extend", "build"].map((kind) => (jobs[kind]?.result ? fetched(kind) : null)));
    // What was proposed after an answer of before says nothing of this one.
    if (answer?.begun && jobs.next?.begun < answer.begun) next = null;
    draw();
  }

  function bar() {
    const job = context.state?.jobs.diagnose,
      busy = context.busy();
    clear(
      top,
      h(
        "div",
        { class: "row" },
        context.modelChooser("model"),
        h(
          "button",
          { type: "button", id: "diagnose", class: answer ? "" : "main", disabled: !!busy, title: busy || undefined, onclick: () => context.start("diagnose") },
          answer ? (answer.verdict === "stopped" ? "Go on" : "Diagnose again") : "Diagnose",
        ),
        answer ? h("a", { class: "button", href: "results/diagnose/report?download", download: "" }, "Save as one file") : null,
        answer ? exportMenu(context, "diagnose", () => answer.model) : null,
      ),
      ["diagnose", "next", "extend", "build"].map((kind) =>
        context.state?.jobs[kind]?.fault && context.state.jobs[kind].state !== "running" ? note(context.state.jobs[kind].fault, "bad") : null,
      ),
    );
  }

  // What is known by now: steps that were taken, and what each found.
  function progress() {
    const job = context.state?.jobs.diagnose;
    doing();
    if (job?.state !== "running") {
      clear(live);
      return;
    }
    const found = job.tasks.some((t) => t.what === PAGE_OF_FOUND);
    clear(
      live,
      h(
        "div",
        { class: "panel" },
        h("h1", {}, found ? "Found again" : "Diagnosing"),
        h("p", { class: "quiet", id: "step" }, steps(job).map((t, i) => [i ? " › " : "", t.sentence])),
        whole(job),
        job.said.length
          ? [
              found ? null : h("h3", {}, "Known so far"),
              h(
                "ul",
                { id: "sofar" },
                job.said.map((text) => h("li", {}, text)),
              ),
            ]
          : h("p", { class: "quiet" }, "The base model is fitted first, then each effect is held against what it leaves."),
        found ? null : h("p", { class: "quiet small" }, "Stop gives the answer as far as it is known; diagnosing again goes on from there."),
      ),
    );
  }

  // Steps within steps, each once: one that two threads take at a time stands there twice.
  function steps(job) {
    const inner = job.tasks.slice(job.tasks.findIndex((t) => WHOLE.includes(t.what)) + 1);
    return inner.filter((t, i) => !i || t.sentence !== inner[i - 1].sentence);
  }

  // How long it takes in all, of one that began at the beginning: as its first steps foretell it, else as the last one took.
  function whole(job) {
    const task = job.tasks.find((t) => t.what === WHOLE[0]);
    if (task?.span) return h("p", { class: "quiet", id: "whole" }, `${task.span} left in all, as its first steps tell; longer where several effects are missing.`);
    if (!task?.before) return null;
    const last = `the last one took ${duration(task.before)}`;
    return h("p", { class: "quiet", id: "whole" }, task.left === null ? `Longer than the last one by now: ${last}.` : `About ${duration(task.left)} left in all: ${last}.`);
  }

  // What adding an effect, or the next experiment, is at: steps within steps, below what was clicked.
  function doing() {
    for (const kind of ["next", "extend", "build"]) {
      const place = root.querySelector(`#doing-${kind}`),
        job = context.state?.jobs[kind];
      if (place) clear(place, job?.state === "running" ? job.tasks.map((t) => h("li", {}, t.sentence)) : null);
    }
  }

  function draw() {
    bar();
    progress();
    if (!context.state?.saved) {
      clear(body, h("p", { class: "quiet" }, "Drop measurements first, and save them under In."));
      return;
    }
    if (!answer) {
      clear(body, h("p", { class: "quiet" }, "Which physical effect does the model lack? Minutes with many runs; it can be stopped at any time."));
      clear(after);
      return;
    }
    const old = past(answer, context.state.jobs.diagnose, context);
    redraw(
      body,
      exported("diagnose"),
      dimmed(
        old,
        doubtsBefore(answer, context, "diagnose"),
        h(
          "div",
          { class: `panel verdict ${answer.tone}`, id: "verdict" },
          h("p", { class: "quiet small" }, `verdict on ${answer.model}: ${answer.verdict} · ${took(answer)}`),
          h("h1", {}, answer.headline),
          answer.headline.includes(answer.reason.slice(1)) || (answer.verdict === "none" && !answer.reason.includes(";")) ? null : h("p", { class: "quiet" }, answer.reason),
          answer.would_show ? h("p", { id: "would-show" }, answer.would_show) : null,
          answer.effects.map(effectOf),
          answer.together ? h("p", { class: "quiet", style: { "margin-top": "8px" } }, answer.together) : null,
          answer.base_off.map((b) => h("p", {}, `base off: ${b.text}`)),
          answer.left ? h("p", { class: "small" }, h("b", {}, "Not explained: "), answer.left) : null,
          answer.sizes ? h("p", { class: "small" }, h("b", {}, "Every sample is off by: "), answer.sizes) : null,
          answer.laws.map((law) => h("div", { class: "small" }, h("b", {}, "Law without a name"), h("div", {}, h("code", {}, law)))),
        ),
        cards(answer.page.cards),
        alike(),
        h("h2", {}, "Evidence"),
        // What an answer is worth that names nothing stands first, and open.
        sections(answer.page.sections, answer.would_show ? 1 : 0),
        warnings(answer.page.warnings, (text) => asked(text, answer.cells, context)),
        command(answer.command),
      ),
    );
    const bag = { answer, next, extension, built, context, old };
    redraw(after, nextPart(bag), addPart(bag), ladder(bag));
    doing();
  }

  const parameterOf = (p) =>
    h(
      "div",
      {},
      `${p.name} = `,
      h("b", {}, `${p.value} ${p.unit}`),
      h("span", { class: "quiet" }, ` 95 %: ${p.interval}${p.bound ? "; at a bound" : ""}${p.with_base ? `, ${p.with_base}` : ""} `),
      why(p.why, p.name),
      p.meaning ? h("div", { class: "quiet small" }, p.meaning) : null,
    );

  // Which form it is, and at which part, is said once above.
  const effectOf = (e) =>
    h(
      "div",
      { style: { "margin-top": "8px" } },
      h("h3", {}, effectName(e.name) + (e.place && !answer.headline.includes(`(${e.place})`) ? ` (${e.place})` : "")),
      e.parameters.map(parameterOf),
      (e.others ?? []).map((other) => h("div", { style: { "margin-top": "4px" } }, h("div", { class: "quiet" }, `${other.said}:`), other.parameters.map(parameterOf))),
      h("p", { class: "quiet small" }, [e.share, e.error, e.held].filter(Boolean).join("; ")),
    );

  // What was turned down, and why, stands in the evidence.
  const alike = () =>
    answer.confusable.length || answer.stand_ins.length
      ? h(
          "div",
          { class: "panel" },
          answer.confusable.length ? h("p", {}, `This campaign cannot tell apart: ${(answer.alike ?? answer.confusable).join(", ")}.`) : null,
          answer.stand_ins.map((text) => h("p", {}, text)),
        )
      : null;

  draw();
  load();
  const mark = (state) =>
    JSON.stringify(
      ["diagnose", "next", "extend", "build"].map((k) => [state.jobs[k]?.state, state.jobs[k]?.begun, state.jobs[k]?.result, state.jobs[k]?.old]),
    ) +
    context.model() +
    state.models +
    state.saved +
    Object.values(state.jobs).some((j) => j.state === "running");
  let seen = context.state ? mark(context.state) : "";
  return {
    update(state) {
      const now = mark(state);
      if (now !== seen) {
        seen = now;
        load();
      } else progress();
    },
    recolour: () => recolour(root),
  };
}
