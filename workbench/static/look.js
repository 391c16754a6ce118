// Look: key figures first, then measured and predicted over each other with the residual in units of the noise, orders, loops.

import { clear, command, h, note, number } from "./dom.js";
import { doubtsBefore } from "./doubts.js";
import { fails, figureTitle, keyFigures, notes, singles, spec } from "./look_parts.js";
import { exported, exportMenu } from "./export.js";
import { get, numbers } from "./net.js";
import { orders } from "./orders.js";
import { dimmed, past } from "./past.js";
import { Link, Plot } from "./plot.js";
import { matcher } from "./search.js";
import { rms } from "./shifted.js";

const MOST_DRAWN = 4;

// An error in times its noise: root mean square of all samples over that of the noise, as the cards and ``rvwear compare`` have it.
const times = (ratio) => `${number(ratio, 3)}×`;
const ofRuns = (e) => (e.runs ? ` of ${e.runs} run${e.runs === 1 ? "" : "s"}` : "");

export function show(root, context) {
  let result = null,
    columns = null,
    plots = [],
    chosen = null,
    condition = null,
    shift = 0,
    asMeasured = false,
    all = false,
    text = "",
    loading = false;
  const links = new Map();
  const body = h("div");
  root.append(body);

  async function load() {
    if (loading) return;
    if (!context.state?.jobs.compare?.result) {
      draw();
      return;
    }
    loading = true;
    try {
      result = await get("results/compare");
      columns = await numbers("results/compare/columns");
    } catch {
      result = null;
    }
    loading = false;
    draw();
  }

  const part = (place) => columns.subarray(place.from, place.from + place.count);

  function bar() {
    const busy = context.busy();
    return h(
      "div",
      { class: "row" },
      context.modelChooser("model"),
      h(
        "button",
        { type: "button", class: result ? "" : "main", id: "compare", disabled: !!busy, title: busy || undefined, onclick: () => context.start("compare") },
        result ? "Compare again" : "Compare",
      ),
      result ? h("a", { class: "button", href: "results/compare/report?download", download: "" }, "Save as one file") : null,
      result ? exportMenu(context, "compare", () => result.model) : null,
    );
  }

  function draw() {
    for (const plot of plots) plot.destroy();
    plots = [];
    const job = context.state?.jobs.compare;
    if (!context.state?.saved) {
      clear(
        body,
        h(
          "div",
          { class: "empty" },
          h("h1", {}, "Nothing to look at yet"),
          h("p", { class: "lead", style: { margin: "4px auto 14px" } }, "Drop measurements first."),
          h("button", { type: "button", class: "main", onclick: () => context.go("in") }, "In"),
        ),
      );
      return;
    }
    const fault = job?.fault ? note(job.fault, "bad") : null;
    if (!result) {
      clear(
        body,
        bar(),
        fault,
        job?.state === "running" ? h("p", { class: "quiet" }, "Comparing…") : h("p", { class: "quiet" }, "Choose a model and compare."),
      );
      return;
    }
    clear(
      body,
      bar(),
      fault,
      exported("compare"),
      dimmed(
        past(result, job, context),
        h("h1", {}, result.title),
        h("p", { class: "lead" }, result.finding),
        doubtsBefore(result, context, "compare"),
        figures(),
        curves(),
        fails(result, context),
        notes(result, context),
        command(result.command),
      ),
    );
  }

  const figures = () =>
    keyFigures({
      result,
      all,
      text,
      matches: matching(),
      search: (value) => {
        text = value;
        redrawLists();
      },
      showAll: () => {
        all = true;
        redrawLists();
      },
    });
  const searched = (s) => `${s.title} ${[...s.runs, ...s.singles].map((r) => r.condition).join(" ")}`;
  const matching = () => matcher(text, [...result.figures.map(figureTitle), ...result.signals.map(searched)]);

  function redrawLists() {
    const before = document.activeElement?.type === "search";
    root.querySelector("#figures")?.replaceWith(figures());
    const list = root.querySelector("#signals");
    list?.replaceWith(signalChips());
    if (before) {
      const field = body.querySelector("input[type=search]");
      field.focus();
      field.setSelectionRange(text.length, text.length);
    }
  }

  const signalChips = () => {
    const matches = matching();
    return h(
      "div",
      { class: "chips", id: "signals", role: "group", "aria-label": "signals" },
      result.signals
        .filter((s) => !text || matches(searched(s)) || s.signal === chosen)
        .map((s) =>
          h(
            "button",
            {
              type: "button",
              "aria-pressed": String(s.signal === chosen),
              onclick: () => {
                chosen = s.signal;
                condition = null;
                shift = 0;
                draw();
                root.querySelector("#curves")?.scrollIntoView({ block: "nearest" });
              },
            },
            `${s.title} ${(s.errors ?? []).map((e) => (e.held_out ? "held out " : "") + times(e.ratio) + ofRuns(e)).join(", ")}`,
          ),
        ),
    );
  };

  function curves() {
    const worst = (s) => Math.max(0, ...(s.errors ?? []).map((e) => e.ratio ?? 0));
    chosen ??= [...result.signals].sort((p, q) => worst(q) - worst(p))[0]?.signal;
    const signal = result.signals.find((s) => s.signal === chosen) ?? result.signals[0];
    if (!signal) return note("No run can be predicted by this model.");
    return h(
      "section",
      { id: "curves" },
      h("h2", {}, "Measured and predicted"),
      signalChips(),
      signal.runs.length ? series(signal) : null,
      signal.singles.length ? singles(signal) : null,
    );
  }

  function series(signal) {
    const cells = new Map();
    for (const run of signal.runs) {
      const key = run.condition;
      cells.set(key, [...(cells.get(key) ?? []), run]);
    }
    // Root mean square over the repetitions, as the map of errors has it.
    const ratio = (members) => Math.hypot(...members.map((r) => r.ratio ?? 0)) / Math.sqrt(members.length);
    if (!condition || (condition !== "*" && !cells.has(condition))) condition = [...cells].sort((p, q) => ratio(q[1]) - ratio(p[1]))[0][0];
    const chips = h(
      "div",
      { class: "chips", role: "group", "aria-label": "conditions" },
      [...cells].map(([name, members]) =>
        h(
          "button",
          {
            type: "button",
            "aria-pressed": String(name === condition),
            onclick: () => {
              condition = name;
              draw();
            },
          },
          `${name} ${times(ratio(members))}${members[0].held_out ? " · held out" : ""}`,
        ),
      ),
      cells.size > 1
        ? h(
            "button",
            {
              type: "button",
              "aria-pressed": String(condition === "*"),
              onclick: () => {
                condition = "*";
                draw();
              },
            },
            "all",
          )
        : null,
    );
    const members = condition === "*" ? [...cells.values()].map((m) => m[0]) : cells.get(condition).slice(0, MOST_DRAWN);
    if (!links.has(signal.axis.name)) links.set(signal.axis.name, new Link());
    const plot = new Plot({
      height: window.innerWidth < 640 ? 380 : 460,
      link: links.get(signal.axis.name),
      label: `${signal.title}, measured and predicted over ${signal.axis.title}, residual in units of the noise below`,
    });
    plots.push(plot);
    const left = h("span", { class: "quiet", id: "left-shifted" });
    const fill = () => {
      const drawn = spec({ part, shift, asMeasured, several: condition === "*" }, signal, members);
      plot.set(drawn);
      if (!shift || members[0].stems) {
        clear(left);
        return;
      }
      // Counted as the chips count it.
      const errors = drawn.panes[1].lines.map(({ y, aside }, k) => {
        const { ratio, residual } = members[k];
        return { ratio: ((ratio ?? 0) * rms(y, aside)) / rms(part(residual), aside) };
      });
      clear(left, `shifted so, it errs by ${times(ratio(errors))} its noise; for looking only, what is saved stays`);
    };
    fill();
    const shifted = h("input", {
      type: "number",
      step: "any",
      value: shift,
      size: 8,
      style: { width: "8em" },
      onchange: () => {
        shift = Number(shifted.value) || 0;
        fill();
      },
    });
    return h(
      "div",
      { class: "panel" },
      chips,
      signal.axis.name === "angle" ? doubtsBefore(result, context, "compare", (d) => d.column !== undefined) : null,
      plot.element,
      h(
        "div",
        { class: "row small" },
        members.some((run) => run.zero)
          ? h(
              "label",
              { class: "inline", title: "Its zero says nothing: runs are drawn at their fitted zero, or at the heights at which they were written." },
              h("input", {
                type: "checkbox",
                id: "as-measured",
                checked: asMeasured,
                onchange: (e) => {
                  asMeasured = e.target.checked;
                  fill();
                },
              }),
              "the zero is free: draw it as measured",
            )
          : null,
        members[0].stems ? null : h("label", { class: "inline" }, "shift measured along the axis by", shifted, unitIn(signal.axis.title)),
        left,
        h(
          "span",
          { class: "quiet" },
          `${members[0].stems ? `noise of an order ${number(members[0].noise, 3)}` : `the band is two standard deviations of the noise of a single run, ${number(2 * members[0].noise, 3)}`} ${signal.unit}; ${condition === "*" ? "first repetition of each condition" : `${members.length} of ${cells.get(condition).length} repetitions`}; ${members.reduce((n, r) => n + r.samples, 0).toLocaleString("en")} samples`,
        ),
      ),
      signal.spectra?.length || Object.keys(signal.no_orders ?? {}).length
        ? orders(signal, condition === "*" ? (signal.spectra[0] ?? members[0]).condition : condition, result, plots)
        : null,
    );
  }

  draw();
  load();
  let seen = context.state?.jobs.compare?.begun + String(context.state?.jobs.compare?.state),
    busy = context.busy(),
    model = context.model();
  return {
    update(state) {
      // What else is computed stands in the way of comparing.
      if (busy !== context.busy()) {
        busy = context.busy();
        root.querySelector("#compare")?.closest(".row").replaceWith(bar());
      }
      const job = state.jobs.compare,
        now = job?.begun + String(job?.state) + job?.result + (job?.state === "running" ? job.tasks.length > 1 && job.tasks.at(-1)?.what : "");
      if (now !== seen || model !== context.model()) {
        seen = now;
        model = context.model();
        if (job?.result && (job.state !== "running" || !result || result.begun !== job.begun)) load();
        else draw();
      }
    },
    recolour() {
      for (const plot of plots) plot.later();
    },
    close() {
      for (const plot of plots) plot.destroy();
    },
  };
}

const unitIn = (title) => /\[(.+)\]/.exec(title)?.[1] ?? "";
