// Life: wear over the hours as it grows; paused, gone on with, its report at the end.

import { clear, command, h, note, number } from "./dom.js";
import { ensemble } from "./ensemble.js";
import { get } from "./net.js";
import { dimmed, pastLife } from "./past.js";
import { Plot } from "./plot.js";

// One for each line of all panes, which share a legend.
const COLOURS = ["--predicted", "--measured", "--tried", "--gold", "--b", "--residual", "--left-a", "--a"];

const USUAL_HOURS = "10000";

// The report in the colours of the page around it: they may be others than the screen's.
const embedded = () => `results/life/report?colours=${document.documentElement.classList.contains("dark") ? "dark" : "light"}`;

const jumps = (n) => `${n} jump${n === 1 ? "" : "s"}`;

// Hours go back to 0 with every pass through the life; after a pause they go on.  Why there is one more is said in the words of the terminal.
function whichPass(now, before) {
  if (now.ended) return `Pass ${now.pass}, in ${jumps(now.jumps)}, is the last: the figures are those of the result, which is being written.`;
  const of = "Figures and solid curves are of this pass",
    dashed = before?.jumps ? `; dashed: pass ${before.pass}, in ${before.jumps}` : "";
  if (!now.why) return `Pass ${now.pass}, in ${jumps(now.jumps)}; then again from 0 h in more of them, until two passes agree. ${of}, as rough as its jumps.`;
  return `Pass ${now.pass}: ${now.why}. ${of} and its ${jumps(now.jumps)}${dashed}.`;
}

const since = (now) => `${Math.round(now.hours.at(-1)).toLocaleString("en")} of ${Math.round(now.until).toLocaleString("en")} operating hours since new, pass ${now.pass}`;

export function show(root, context) {
  let live = null,
    result = null,
    hours = USUAL_HOURS,
    torque = "",
    speed = "",
    // When that began of which the fields are.
    begun = null,
    // How often was asked for what there is.
    asks = 0,
    plot = null,
    report = null,
    // The report is large: its box is empty for seconds.
    drawing = null;
  const top = h("div"),
    words = h("div"),
    chart = h("div", { class: "panel", hidden: true }),
    below = h("div"),
    shown = h("div"),
    many = h("section");
  let why = null;
  root.append(top, shown, many);
  const lives = ensemble(many, context, () => hours);

  // What is shown and what goes on from where it was paused are of these fields, on a page that was loaded anew and in a second tab, too;
  // what was typed since stays.
  function take() {
    const job = [context.state?.jobs.life, context.state?.jobs.ensemble].find((j) => j?.begun);
    if (!job || job.begun === begun) return;
    begun = job.begun;
    hours = String(job.given.hours ?? "").trim() || USUAL_HOURS;
    torque = String(job.given.torque ?? "").trim();
    speed = String(job.given.speed ?? "").trim();
  }

  async function load() {
    const job = context.state?.jobs.life,
      ask = ++asks;
    take();
    const known = job?.state ? await get("results/life/live").catch(() => null) : null,
      found = job?.result && job.state === "done" ? await get("results/life").catch(() => null) : null;
    // An answer that was overtaken by a later one would set the hours back.
    if (ask !== asks) return;
    live = known?.now?.pass ? known : null;
    result = found;
    draw();
  }

  function bar() {
    const job = context.state?.jobs.life,
      busy = context.busy();
    const paused = job?.state === "stopped" || job?.state === "gone";
    const given = () => ({ hours, torque, speed }),
      lacks = busy || (context.model() ? "" : "a model or reducer has to be chosen first");
    clear(
      top,
      h(
        "div",
        { class: "row" },
        context.modelChooser("model or reducer"),
        h(
          "label",
          { class: "inline" },
          "hours",
          h("input", {
            type: "text",
            inputmode: "decimal",
            size: 8,
            id: "hours",
            value: hours,
            onchange: (e) => {
              hours = e.target.value;
            },
          }),
        ),
        h(
          "label",
          { class: "inline" },
          "torque",
          h("input", {
            type: "text",
            inputmode: "decimal",
            size: 7,
            value: torque,
            placeholder: "rated",
            onchange: (e) => {
              torque = e.target.value;
            },
          }),
          "N m",
        ),
        h(
          "label",
          { class: "inline" },
          "input speed",
          h("input", {
            type: "text",
            inputmode: "decimal",
            size: 7,
            id: "speed",
            value: speed,
            placeholder: "the file's",
            title: "of the sun's shaft; without one the speed of the model or reducer, which Reducer says",
            onchange: (e) => {
              speed = e.target.value;
            },
          }),
          "rpm",
        ),
        h(
          "button",
          { type: "button", class: "main", id: "live", disabled: !!lacks, title: lacks || undefined, onclick: () => context.start("life", given()) },
          paused ? "Go on" : "Run",
        ),
        lacks && job?.state !== "running" ? h("span", { class: "fair", id: "lacks" }, lacks) : null,
        result ? h("a", { class: "button", href: "results/life/report?download", download: "" }, "Save the report") : null,
      ),
      job?.fault && job.state !== "running" ? note(job.fault, "bad") : null,
      paused ? note(`Paused${live ? ` at ${since(live.now)}` : ""}: the life goes on from its last jump, as long as hours, torque, speed and model stay.`) : null,
    );
  }

  function draw() {
    bar();
    const now = result ?? live?.now,
      former = now ? pastLife(context.state?.jobs.life, context) : "";
    // A chart that is put elsewhere loses the hand that drags in it: only where it must.
    if (why !== former) {
      why = former;
      clear(shown, dimmed(why, words, chart, below));
    }
    if (!now) {
      clear(words, h("p", { class: "quiet" }, "Thousands of hours in jumps of one meshing cycle each; how many jumps it takes is decided by halving them."));
      chart.hidden = true;
      clear(below);
      return;
    }
    const last = now.panes.flatMap((p) => p.lines.map((l) => `${l.name} ${number(l.values.at(-1), 3)} ${p.unit}`));
    clear(
      words,
      h(
        "h1",
        {},
        result ? result.title : `${now.model}: ${since(now)}`,
      ),
      h("p", { class: "lead" }, `${result ? "" : `pass ${now.pass}, in ${jumps(now.jumps)}: `}${last.join(" · ")}`),
      now.at ? h("p", { class: "quiet", id: "life-at" }, `at ${now.at}`) : null,
      h("p", { class: "quiet small" }, now.how ?? ""),
      result ? null : h("p", { class: "quiet small", id: "which-pass" }, whichPass(now, live.before)),
    );
    chart.hidden = false;
    if (!plot) {
      plot = new Plot({ height: window.innerWidth < 640 ? 560 : 640, label: "wear, lag, transmission error and stiffness over the hours" });
      chart.append(plot.element);
    }
    const x = Float32Array.from(now.hours),
      before = now.panes.map((_, k) => now.panes.slice(0, k).reduce((n, p) => n + p.lines.length, 0)),
      colour = (k, i) => COLOURS[(before[k] + i) % COLOURS.length];
    const panes = now.panes.map((p, k) => ({
      title: `${p.title} [${p.unit}]`,
      weight: k ? 1 : 1.6,
      lines: p.lines.map((l, i) => ({ name: l.name, x, y: Float32Array.from(l.values), colour: colour(k, i), width: 1.8, dots: x.length < 40 })),
    }));
    if (!result && live?.before?.hours) {
      const old = Float32Array.from(live.before.hours);
      live.before.panes.forEach((p, k) =>
        p.lines.forEach((l, i) =>
          panes[k].lines.push({ name: "", x: old, y: Float32Array.from(l.values), colour: colour(k, i), width: 1, dash: [4, 4], opacity: 0.6 }),
        ),
      );
    }
    plot.set({ xTitle: "operating time [h]", panes });
    clear(
      below,
      result
        ? [
            h("h2", {}, "On the parts, over the turn, by order"),
            h(
              "p",
              { class: "row" },
              h("a", { class: "button", href: "results/life/report", target: "_blank", rel: "noopener" }, "Open the report in a tab of its own"),
              h("span", { class: "quiet small" }, "below it scrolls inside its frame"),
            ),
            h(
              "div",
              { class: "report" },
              (drawing = h("p", { class: "quiet", role: "status" }, `The report is being drawn${result.size ? `, a page of ${number(result.size / 1e6, 2)} MB` : ""}…`)),
              (report = h("iframe", {
                class: "report",
                src: embedded(),
                title: "report of the life",
                sandbox: "allow-scripts",
                onload: () => {
                  drawing.hidden = true;
                },
              })),
            ),
            h("p", { class: "quiet small" }, `kept in ${result.file}`),
            command(result.command),
          ]
        : null,
    );
  }

  take();
  draw();
  load();
  let seen = "";
  return {
    update(state) {
      const job = state.jobs.life,
        now = `${job?.state}${job?.begun}${job?.result}${job?.old}${state.view?.model}${job?.tasks?.map((t) => t.done).join()}${Object.values(state.jobs).some((j) => j.state === "running")}`;
      if (now !== seen) {
        seen = now;
        load();
      }
      lives.update(state);
    },
    recolour: () => {
      plot?.later();
      lives.recolour();
      if (report && report.getAttribute("src") !== embedded()) {
        drawing.hidden = false;
        report.src = embedded();
      }
    },
    close: () => {
      plot?.destroy();
      lives.close();
    },
  };
}
