// Look: key figures first, then measured and predicted over each other with the residual in units of the noise, orders, loops.

import { clear, command, h, note, number, table, words } from "./dom.js";
import { get, numbers } from "./net.js";
import { orders } from "./orders.js";
import { Link, Plot } from "./plot.js";

const CLEAR = 3, MOST_DRAWN = 4, FEW_FIGURES = 12;
const tone = (off) => (off > 5 ? "bad" : off > CLEAR ? "fair" : "");

export function show(root, context) {
  let result = null, columns = null, made = null, plots = [], chosen = null, condition = null, shift = 0, all = false, text = "", loading = false;
  const links = new Map();
  const body = h("div");
  root.append(body);

  async function load() {
    if (loading) return;
    if (!context.state?.jobs.compare?.result) { draw(); return; }
    loading = true;
    try {
      result = await get("results/compare");
      columns = await numbers("results/compare/columns");
    } catch { result = null; }
    loading = false;
    draw();
  }

  const part = (place) => columns.subarray(place.from, place.from + place.count);

  function bar() {
    const job = context.state?.jobs.compare;
    return h("div", { class: "row" }, context.modelChooser("model"),
      h("button", { type: "button", class: result ? "" : "main", id: "compare", disabled: job?.state === "running", onclick: () => context.start("compare") }, result ? "Compare again" : "Compare"),
      result ? h("a", { class: "button", href: "results/compare/report?download", download: "" }, "Save as one file") : null,
      job?.old && job.state === "done" ? h("span", { class: "fair" }, "files have changed since: compare again") : null,
      result && context.model() && result.model !== context.model() ? h("span", { class: "fair" }, `what is shown is of ${result.model}`) : null);
  }

  function draw() {
    for (const plot of plots) plot.destroy();
    plots = [];
    const job = context.state?.jobs.compare;
    if (!context.state?.saved) { clear(body, h("div", { class: "empty" }, h("h1", {}, "Nothing to look at yet"), h("p", { class: "lead", style: { margin: "4px auto 14px" } }, "Drop measurements first."), h("button", { type: "button", class: "main", onclick: () => context.go("in") }, "In"))); return; }
    const fault = job?.fault ? note(job.fault, "bad") : null;
    if (!result) { clear(body, bar(), fault, job?.state === "running" ? h("p", { class: "quiet" }, "Comparing…") : h("p", { class: "quiet" }, "Choose a model and compare.")); return; }
    clear(body, bar(), fault, h("h1", {}, result.title), h("p", { class: "lead" }, result.finding), figures(), curves(), fails(), words_(), command(result.command));
  }

  // What an engineer asks first: stiffness, lost motion, width, error by order; as they are measured and as the model has them.
  function figures() {
    const found = result.figures.filter((f) => matches(`${f.title} ${f.name} ${f.condition}`));
    const worst = new Map();
    for (const f of [...found].sort((p, q) => Math.abs(q.off) - Math.abs(p.off))) if (!worst.has(f.signal + f.name)) worst.set(f.signal + f.name, f);
    const rows = (all || text ? [...found] : [...worst.values()].slice(0, FEW_FIGURES)).sort((p, q) => p.title.localeCompare(q.title) || rank(p) - rank(q) || Math.abs(q.off) - Math.abs(p.off));
    if (!result.figures.length) return null;
    const most = Math.max(5, ...rows.map((f) => Math.abs(f.off)));
    return h("section", { id: "figures" }, h("div", { class: "row spread" }, h("h2", { style: { margin: 0 } }, "Key figures"),
      h("label", { class: "inline" }, h("input", { type: "search", placeholder: "search signals, figures, conditions  ( / )", size: 30, value: text, oninput: (e) => { text = e.target.value; redrawLists(); } }))),
      h("div", { class: "panel" }, table(["signal", "figure", "condition", "measured", "noise", "model", "off, in noise"], rows.map((f, i) => [rows[i - 1]?.title === f.title ? "" : f.title, h("b", {}, f.name), f.condition, `${f.measured} ${f.unit}`, h("span", { class: "quiet" }, `± ${f.noise}`), `${f.model} ${f.unit}`,
        h("span", { class: tone(Math.abs(f.off)), title: f.repeated ? `from ${f.runs} repetitions` : "from the noise of the samples: nothing is repeated" }, h("span", { class: "off" }, number(f.off, 3)), h("span", { class: "bar", style: { width: `${Math.max(2, (46 * Math.abs(f.off)) / most)}px` } }))]), [3, 4, 5, 6], { class: "stack" }),
        rows.length < result.figures.length && !text ? h("button", { type: "button", class: "plainly", onclick: () => { all = true; redrawLists(); } }, `all ${result.figures.length} figures (each is shown where it is furthest off)`) : null));
  }
  const matches = (title) => text.toLowerCase().split(/\s+/).every((word) => title.toLowerCase().includes(word));

  function redrawLists() {
    const before = document.activeElement?.type === "search";
    document.getElementById("figures")?.replaceWith(figures());
    const list = document.getElementById("signals");
    list?.replaceWith(signalChips());
    if (before) { const field = body.querySelector("input[type=search]"); field.focus(); field.setSelectionRange(text.length, text.length); }
  }

  const signalChips = () => h("div", { class: "chips", id: "signals", role: "group", "aria-label": "signals" }, result.signals.filter((s) => !text || matches(`${s.title} ${[...s.runs, ...s.singles].map((r) => r.condition).join(" ")}`) || s.signal === chosen).map((s) => {
    const worst = Math.max(0, ...[...s.runs, ...s.singles].map((r) => r.ratio ?? 0));
    return h("button", { type: "button", "aria-pressed": String(s.signal === chosen), onclick: () => { chosen = s.signal; condition = null; shift = 0; draw(); document.getElementById("curves")?.scrollIntoView({ block: "nearest" }); } }, `${s.title} ${number(worst, 2)}×`);
  }));

  function curves() {
    const worst = (s) => Math.max(0, ...[...s.runs, ...s.singles].map((r) => r.ratio ?? 0));
    chosen ??= [...result.signals].sort((p, q) => worst(q) - worst(p))[0]?.signal;
    const signal = result.signals.find((s) => s.signal === chosen) ?? result.signals[0];
    if (!signal) return note("No run can be predicted by this model.");
    return h("section", { id: "curves" }, h("h2", {}, "Measured and predicted"), signalChips(), signal.runs.length ? series(signal) : null, signal.singles.length ? singles(signal) : null);
  }

  function series(signal) {
    const cells = new Map();
    for (const run of signal.runs) { const key = run.condition; cells.set(key, [...(cells.get(key) ?? []), run]); }
    const ratio = (members) => Math.max(...members.map((r) => r.ratio ?? 0));
    if (!condition || (condition !== "*" && !cells.has(condition))) condition = [...cells].sort((p, q) => ratio(q[1]) - ratio(p[1]))[0][0];
    const chips = h("div", { class: "chips", role: "group", "aria-label": "conditions" }, [...cells].map(([name, members]) => h("button", { type: "button", "aria-pressed": String(name === condition), onclick: () => { condition = name; draw(); } }, `${name} ${number(ratio(members), 2)}×${members[0].held_out ? " · held out" : ""}`)),
      cells.size > 1 ? h("button", { type: "button", "aria-pressed": String(condition === "*"), onclick: () => { condition = "*"; draw(); } }, "all") : null);
    const members = condition === "*" ? [...cells.values()].map((m) => m[0]) : cells.get(condition).slice(0, MOST_DRAWN);
    if (!links.has(signal.axis.name)) links.set(signal.axis.name, new Link());
    const plot = new Plot({ height: window.innerWidth < 640 ? 380 : 460, link: links.get(signal.axis.name), label: `${signal.title}, measured and predicted over ${signal.axis.title}, residual in units of the noise below` });
    plots.push(plot);
    const fill = () => plot.set(spec(signal, members));
    fill();
    const shifted = h("input", { type: "number", step: "any", value: shift, size: 8, style: { width: "8em" }, onchange: () => { shift = Number(shifted.value) || 0; fill(); } });
    made = members;
    return h("div", { class: "panel" }, chips, plot.element, h("div", { class: "row small" }, h("label", { class: "inline" }, "shift measured along the axis by", shifted, unitIn(signal.axis.title)), h("span", { class: "quiet" }, `the band is two standard deviations of the noise, ${number(2 * members[0].noise, 3)} ${signal.unit}; ${condition === "*" ? "first repetition of each condition" : `${members.length} of ${cells.get(condition).length} repetitions`}; ${members.reduce((n, r) => n + r.samples, 0).toLocaleString("en")} samples`)),
      signal.spectra?.length ? orders(signal, condition === "*" ? signal.spectra[0].condition : condition, result, plots) : null);
  }

  function spec(signal, members) {
    const upper = [], lower = [], bands = [], several = condition === "*";
    members.forEach((run, k) => {
      const raw = part(run.x), x = shift ? raw.map((v) => v + shift) : raw, p = raw, opacity = several ? 0.55 : Math.max(0.35, 0.95 - 0.2 * k), predicted = part(run.predicted), name = several ? ` · ${run.condition}` : "";
      if (k === 0) {
        const noise = 2 * run.noise;
        bands.push({ x: p, low: predicted.map((v) => v - noise), high: predicted.map((v) => v + noise) });
      }
      upper.push({ name: k && !several ? "" : `measured${name}`, x, y: part(run.measured), colour: "--measured", width: 1.1, opacity, dots: run.dots });
      lower.push({ name: k && !several ? "" : `residual / noise${name}`, x: p, y: part(run.residual), colour: "--residual", width: 1.1, opacity, dots: run.dots });
      if (k === 0 || several) upper.push({ name: `predicted${name}`, x: p, y: predicted, colour: "--predicted", width: 1.8, opacity: several ? 0.8 : 1 });
    });
    return { xTitle: signal.axis.title, loop: signal.loop, panes: [{ title: `${signal.title.split(" (")[0]} [${signal.unit}]`, weight: 2, lines: upper, bands }, { title: "residual / noise", weight: 1, zero: true, limits: [-2, 2], lines: lower }] };
  }

  function singles(signal) {
    const count = signal.singles.reduce((n, run) => n + run.measured.length, 0);
    return h("details", { class: "panel", open: count <= 30 }, h("summary", {}, h("b", {}, `${signal.title}: ${count} single number${count === 1 ? "" : "s"} [${signal.unit}]`)), table(["run", "condition", "measured", "noise", "model", "off, in noise"], signal.singles.flatMap((run) => run.measured.map((value, i) => [run.run, h("span", {}, run.condition, run.held_out ? h("span", { class: "tag held" }, "held out") : ""), value, h("span", { class: "quiet" }, `± ${run.noise}`), run.predicted[i], h("span", { class: tone(Math.abs(run.off[i])) }, number(run.off[i], 3))])), [2, 3, 4, 5]));
  }

  const fails = () => (result.places.length ? h("section", {}, h("h2", {}, "Where the model fails"), h("p", { class: "quiet small" }, "Significant against the noise of repetitions, over all tests together."), h("div", { class: "panel" }, table(["signal", "what", "depends on", "share of the misfit", "p"],
    result.places.slice(0, 20).map((p) => [result.signals.find((s) => s.signal === p.signal)?.title ?? words(p.signal), p.feature, words(p.dependence), `${Math.round(100 * p.share)} %`, p.p.toExponential(0)]), [3, 4])), h("button", { type: "button", class: "main", onclick: () => { context.go("diagnose"); context.start("diagnose"); } }, "Which effect is missing?"))
    : h("p", { class: "lead" }, "No place, order or dependence carries a significant misfit."));
  const words_ = () => result.warnings.length + result.calibrated.length > 0 && h("details", { open: result.warnings.length > 0 && result.warnings.length < 4 }, h("summary", {}, `${result.warnings.length} notes${result.calibrated.length ? `, ${result.calibrated.length} calibrated` : ""}`), result.warnings.map((t) => note(t)), result.calibrated.length ? table(["calibrated", "value", "meaning"], result.calibrated.map((c) => [words(c.name), c.value, c.meaning])) : null);

  draw();
  load();
  let seen = context.state?.jobs.compare?.begun + String(context.state?.jobs.compare?.state), makers = false, model = context.model();
  return { update(state) {
    const job = state.jobs.compare, now = job?.begun + String(job?.state) + job?.result + (job?.state === "running" ? job.tasks.length > 1 && job.tasks.at(-1)?.what : "");
    if (now !== seen || model !== context.model()) { seen = now; model = context.model(); if (job?.result && (job.state !== "running" || !result || result.begun !== job.begun)) load(); else draw(); }
  }, recolour() { for (const plot of plots) plot.later(); }, close() { for (const plot of plots) plot.destroy(); } };
}

// In the order in which one asks.
const ORDER = ["torsional stiffness", "lost motion", "width of the loop", "peak to peak"];
const rank = (f) => { const i = ORDER.findIndex((name) => f.name.startsWith(name)); return i < 0 ? ORDER.length : i + (f.name.length > ORDER[i].length ? 0.5 : 0); };

const unitIn = (title) => /\[(.+)\]/.exec(title)?.[1] ?? "";
