// Diagnose: which effect is missing, why, what else it might be, what to measure next; add it, see the error fall, build the units.

import { choose, clear, command, duration, h, note, number, table, words } from "./dom.js";
import { get } from "./net.js";
import { cards, recolour, sections, warnings } from "./page.js";

export function show(root, context) {
  let answer = null, next = null, extension = null, built = null, anyway = null;
  const top = h("div"), live = h("div"), body = h("div"), after = h("div");
  root.append(top, live, body, after);

  const fetched = (kind) => get(`results/${kind}`).catch(() => null);
  async function load() {
    const jobs = context.state?.jobs ?? {};
    [answer, next, extension, built] = await Promise.all(["diagnose", "next", "extend", "build"].map((kind) => (jobs[kind]?.result ? fetched(kind) : null)));
    draw();
  }

  function bar() {
    const job = context.state?.jobs.diagnose, busy = Object.values(context.state?.jobs ?? {}).some((j) => j.state === "running");
    clear(top, h("div", { class: "row" }, context.modelChooser("model"), h("button", { type: "button", id: "diagnose", class: answer ? "" : "main", disabled: busy, onclick: () => context.start("diagnose") }, answer ? (answer.verdict === "stopped" ? "Go on" : "Diagnose again") : "Diagnose"),
      answer ? h("a", { class: "button", href: "results/diagnose/report?download", download: "" }, "Save as one file") : null,
      job?.old && job.state === "done" ? h("span", { class: "fair" }, "files have changed since") : null,
      answer && context.model() && answer.model !== context.model() ? h("span", { class: "fair" }, `the answer is of ${answer.model}`) : null),
    ["diagnose", "next", "extend", "build"].map((kind) => (context.state?.jobs[kind]?.fault && context.state.jobs[kind].state !== "running" ? note(context.state.jobs[kind].fault, "bad") : null)));
  }

  // What is known by now: steps that were taken, and what each found.
  function progress() {
    const job = context.state?.jobs.diagnose;
    if (job?.state !== "running") { clear(live); return; }
    clear(live, h("div", { class: "panel" }, h("h1", {}, "Diagnosing"), h("p", { class: "quiet" }, job.tasks.at(-1)?.sentence ?? ""),
      job.said.length ? [h("h3", {}, "Known so far"), h("ul", { id: "sofar" }, job.said.map((text) => h("li", {}, text)))] : h("p", { class: "quiet" }, "The base model is fitted first, then each effect is held against what it leaves."),
      h("p", { class: "quiet small" }, "Stop gives the answer as far as it is known; diagnosing again goes on from there.")));
  }

  function draw() {
    bar();
    progress();
    if (!context.state?.saved) { clear(body, h("p", { class: "quiet" }, "Drop measurements first, and save them under In.")); return; }
    if (!answer) { clear(body, h("p", { class: "quiet" }, "Which physical effect does the model lack? Minutes with many runs; it can be stopped at any time.")); clear(after); return; }
    clear(body, h("div", { class: `panel verdict ${answer.tone}`, id: "verdict" }, h("p", { class: "quiet small" }, `verdict: ${answer.verdict} · ${duration(answer.seconds)} of computing`), h("h1", {}, answer.page.finding), answer.page.finding.includes(answer.reason.slice(1)) ? null : h("p", { class: "quiet" }, answer.reason),
      answer.effects.map(effectOf), answer.base_off.map((b) => h("p", {}, `base off: ${b.text}`)), answer.left ? h("p", {}, `not explained: ${answer.left}`) : null, answer.laws.map((law) => h("p", {}, `law without a name: ${law}`))),
    cards(answer.page.cards), why(), rivals(), h("h2", {}, "Evidence"), sections(answer.page.sections), warnings(answer.page.warnings), command(answer.command));
    clear(after, nextPart(), addPart(), ladder());
  }

  const effectOf = (e) => h("div", { style: { "margin-top": "8px" } }, h("h3", {}, words(e.name)), e.parameters.map((p) => h("p", {}, `${words(p.name)} = `, h("b", {}, `${p.value} ${p.unit}`), h("span", { class: "quiet" }, ` 95 %: ${p.interval}${p.bound ? "; at a bound" : ""}`))), answer.effects.length > 1 ? h("p", { class: "quiet small" }, [e.share, e.error].filter(Boolean).join("; ")) : null);

  // Every number of the verdict with the relation, the data and the margin that it comes from.
  function why() {
    const rows = [];
    const held = answer.page.cards.find((c) => c.label.startsWith("Error on"));
    rows.push(["an effect is needed", "score tests of all effects against the base fit", `smallest p over all ${answer.p_screen === null ? "" : answer.p_screen.toExponential(1)}`, "0.02 where the misfit has a place, else 0.002"]);
    if (answer.effects[0]) rows.push(["its name", "fits of the nearest effects, each in earnest", answer.rejected[0] ? `nearest rival: ${words(answer.rejected[0].name)}, ${answer.rejected[0].reason}` : "no rival", "6 of chi-square: 20 to 1 in likelihood"]);
    if (held) rows.push(["it helps", "error on conditions that were not fitted", `${held.start} → ${held.value} ${held.unit}`, "1 is what repetitions differ by"]);
    for (const e of answer.effects) for (const p of e.parameters) rows.push([`${words(p.name)} = ${p.value} ${p.unit}`, "fit to all runs that are not held out, nuisances following", `95 %: ${p.interval}`, "Student's law, widened by what the fit leaves"]);
    return h("details", { class: "panel" }, h("summary", {}, h("b", {}, "Why?")), table(["what is said", "by which relation", "from which data", "with which margin"], rows));
  }

  const rivals = () => (answer.rejected.length || answer.confusable.length ? h("details", { class: "panel", open: answer.confusable.length > 0 }, h("summary", {}, h("b", {}, "Rivals, and why not")), answer.confusable.length ? h("p", {}, `This campaign cannot tell apart: ${answer.confusable.map(words).join(", ")}.`) : null,
    Object.entries(answer.alternatives).map(([name, others]) => h("p", {}, `in place of ${words(name)} could stand: ${others.map(words).join(", ")}`)), table(["effect", "why not"], answer.rejected.slice(0, 12).map((r) => [words(r.name), r.reason]))) : null);

  function nextPart() {
    const busy = Object.values(context.state.jobs).some((j) => j.state === "running");
    const sheet = next ? [h("p", { class: "lead" }, next.verdict), next.open.map((text) => h("p", {}, `• ${text}`)),
      next.proposals.length ? h("div", { id: "sheet" }, table(["☐", "experiment", "price", "least separation", "mean separation"], next.proposals.map((p) => ["☐", p.experiment, number(p.cost, 4), number(p.least, 3), number(p.mean, 3)]), [2, 3, 4])) : null,
      Object.keys(next.stakes).length ? h("p", { class: "quiet small" }, `What it costs not to know: ${Object.entries(next.stakes).map(([k, v]) => `at ${words(k)} up to ${v}`).join("; ")}`) : null,
      h("div", { class: "row" }, h("a", { class: "button", href: "results/next/report?download", download: "" }, "Sheet for the rig"), h("button", { type: "button", onclick: () => print() }, "Print")), command(next.command)] : null;
    return h("section", {}, h("h2", {}, "What to measure next"), h("div", { class: "panel" }, sheet, h("button", { type: "button", id: "next", disabled: busy, onclick: () => context.start("next") }, next ? "Ask again" : "Propose the next experiment")));
  }

  function addPart() {
    const busy = Object.values(context.state.jobs).some((j) => j.state === "running");
    const named = answer.effects.flatMap((e) => e.candidates), numbersOff = answer.base_off.map((b) => `base.${b.name.split(" ")[0]}`);
    const one = answer.confusable.length ? answer.effects.map((e) => e.candidates[0]) : null;
    const options = one ?? (named.length ? [named.join(" + ")] : numbersOff.length ? [numbersOff.join(" + ")] : answer.rejected.slice(0, 5).map((r) => r.name));
    if (!options.length) return null;
    let choice = options[0];
    const keep = h("input", { type: "checkbox", onchange: () => { anyway = keep.checked; } });
    return h("section", {}, h("h2", {}, "Add it to the model"), h("div", { class: "panel" }, h("p", { class: "quiet small" }, "It is fitted to the runs that are not held out and judged on those that are; it stays only if their error falls. The model is model.toml in the folder."),
      h("div", { class: "row" }, options.length > 1 ? choose(options.map((o) => [o, words(o)]), choice, (v) => { choice = v; }) : h("b", {}, words(choice)), h("button", { type: "button", class: "main", id: "extend", disabled: busy, onclick: () => context.start("extend", { model: answer.model, effects: choice.split(" + "), anyway: !!anyway }) }, "Add it"), h("label", { class: "inline small" }, keep, "keep it even if it does not help")),
      extension ? [h("p", { class: `lead ${extension.verdict === "helped" ? "good" : "fair"}`, id: "added" }, `${extension.effects.map(words).join(" + ")}: ${extension.verdict}; ${extension.reason}`), cards(extension.page.cards), sections(extension.page.sections), command(extension.command)] : null));
  }

  function ladder() {
    if (!extension) return null;
    const busy = Object.values(context.state.jobs).some((j) => j.state === "running"), steps = extension.steps;
    const most = Math.max(...steps.flatMap((s) => [s.held_out_before ?? 0, s.training_before ?? 0]), 1);
    const bar = (value, tone) => (value === null || value === undefined ? "–" : h("span", { class: tone }, h("span", { class: "off" }, number(value, 3)), h("span", { class: "bar", style: { width: `${Math.max(2, (90 * value) / most)}px` } })));
    return h("section", { id: "ladder" }, h("h2", {}, "How the error fell"), h("div", { class: "panel" }, table(["step", "fitted runs, before", "after", "unused runs, before", "after", "verdict"], steps.map((s) => [s.effects.map(words).join(" + "), bar(s.training_before, "quiet"), bar(s.training_after, "quiet"), bar(s.held_out_before, "bad"), bar(s.held_out_after, "good"), `${s.verdict}${s.kept === false ? ", not kept" : ""}`])),
      h("p", { class: "quiet small" }, "In units of the noise, in the patterns that carry the misfit; 1 is what repetitions differ by."),
      h("div", { class: "row" }, h("button", { type: "button", onclick: () => { context.go("look"); context.start("compare", { model: "model.toml" }); } }, "Look at the better model"), h("button", { type: "button", onclick: () => context.start("diagnose", { model: "model.toml" }) }, "Is anything else missing?"),
        h("button", { type: "button", id: "build", disabled: busy, onclick: () => context.start("build", { model: "model.toml" }) }, "Build its FMUs")),
      built ? [h("h3", {}, "FMUs"), table(["file", "size"], built.files.map((f) => [f.name, `${Math.round(f.bytes / 1000).toLocaleString("en")} kB`]), [1]), command(built.command)] : null, sections(extension.ladder.sections)));
  }

  draw();
  load();
  const mark = (state) => JSON.stringify(["diagnose", "next", "extend", "build"].map((k) => [state.jobs[k]?.state, state.jobs[k]?.begun, state.jobs[k]?.result, state.jobs[k]?.old])) + context.model() + state.models + state.saved + Object.values(state.jobs).some((j) => j.state === "running");
  let seen = context.state ? mark(context.state) : "";
  return { update(state) { const now = mark(state); if (now !== seen) { seen = now; load(); } else progress(); }, recolour: () => recolour(root) };
}
