// Try: every effect with a slider; the predicted curve follows the hand.

import { choose, clear, h, number, words } from "./dom.js";
import { post, wordsAndRows } from "./net.js";
import { Plot } from "./plot.js";
import { entry } from "./try_effects.js";
import { everySignal } from "./try_signals.js";

export function show(root, context) {
  let data = null,
    run = null,
    values = {},
    kept = null,
    keptName = "",
    moves = 0,
    busy = false,
    // The model that is being made ready; the server tells of other things meanwhile.
    readying = "",
    again = false,
    search = "",
    settle = 0,
    last = null,
    beside = "",
    model = "";
  const faults = h("div"),
    top = h("div"),
    list = h("ul", { class: "list", "aria-label": "effects" }),
    right = h("div"),
    told = h("p", { class: "quiet small", id: "followed", "aria-live": "off" }),
    everywhere = h("div");
  const plot = new Plot({ height: window.innerWidth < 640 ? 340 : 440, label: "measured, predicted and tried" });
  root.append(
    faults,
    top,
    h(
      "div",
      { class: "sides" },
      h(
        "div",
        { class: "panel" },
        h("input", {
          type: "search",
          placeholder: "search effects  ( / )",
          style: { width: "100%" },
          oninput: (e) => {
            search = e.target.value.toLowerCase();
            drawList();
          },
        }),
        list,
      ),
      right,
    ),
  );
  clear(right, h("div", { class: "panel" }, plot.element, told), everywhere);

  async function load() {
    model = context.model();
    clear(top, h("div", { class: "row" }, context.modelChooser("model")));
    if (!context.state?.saved || !model) {
      clear(faults, h("p", { class: "quiet" }, context.state?.saved ? "Choose a model." : "Drop measurements first, and save them under In."));
      return;
    }
    clear(faults, h("p", { class: "quiet" }, "Making the model ready…"));
    const asked = model;
    readying = asked;
    const found = await context.act(post("try", { model }), faults);
    if (readying === asked) readying = "";
    // Who went on wants no curve of it, nor who has chosen another model meanwhile.
    if (!found || !root.isConnected || model !== asked) return;
    clear(faults);
    data = found;
    if (!Object.keys(values).length) values = remembered();
    run =
      data.runs.find((r) => r.run === run)?.run ??
      (data.runs.find((r) => r.signal.startsWith("transmission_error")) ?? data.runs.find((r) => r.axis) ?? data.runs[0])?.run;
    drawTop();
    drawList();
    follow();
  }

  // What was tried is there again when the view is, or the page.
  const memory = () => `tried ${context.state.folder} ${model}`;
  function remembered() {
    const known = new Set(parameters().map((p) => p.name));
    try {
      return Object.fromEntries(Object.entries(JSON.parse(localStorage.getItem(memory())) ?? {}).filter(([name]) => known.has(name)));
    } catch {
      return {};
    }
  }
  function remember() {
    try {
      localStorage.setItem(memory(), JSON.stringify(values));
    } catch {
      // A browser that keeps nothing: so be it.
    }
  }

  function drawTop() {
    const names = new Map();
    for (const r of data.runs) if (!names.has(`${r.signal}|${r.condition}`) || r.run === run) names.set(`${r.signal}|${r.condition}`, r);
    clear(
      top,
      h(
        "div",
        { class: "row" },
        context.modelChooser("model"),
        h(
          "label",
          { class: "inline" },
          "run",
          choose(
            [...names.values()].map((r) => [r.run, `${r.title}, ${r.condition}${r.held_out ? " (held out)" : ""}`]),
            run,
            (v) => {
              run = v;
              kept = null;
              follow();
            },
            { id: "run" },
          ),
        ),
        h(
          "button",
          {
            type: "button",
            onclick: () => {
              values = {};
              drawList();
              follow();
            },
            title: carried().length ? "takes back what is tried; the model file's own effects stay" : undefined,
          },
          carried().length ? "Back to the model as it is" : "All off",
        ),
        h(
          "button",
          {
            type: "button",
            title: "hold this curve and compare further ones with it",
            onclick: () => {
              kept = last;
              keptName = `${summary()}${last?.roughly && Object.keys(values).length ? " (as at first look)" : ""}`;
              follow();
            },
          },
          "Keep as A",
        ),
        kept
          ? h(
              "button",
              {
                type: "button",
                onclick: () => {
                  kept = null;
                  follow();
                },
              },
              "Let A go",
            )
          : null,
        h(
          "label",
          { class: "inline" },
          "beside",
          choose(
            [["", "no other model"], ...[...context.state.models, ...context.state.library].filter((m) => m !== model).map((m) => [m, m])],
            beside,
            (v) => {
              beside = v;
              follow();
            },
            { id: "beside" },
          ),
        ),
      ),
    );
  }

  const summary = () =>
    Object.entries(values)
      .map(([k, v]) => shown(k, v))
      .join(", ") || (carried().length ? `the model as it is, its own effects on (${carried().join(", ")})` : "base model");
  // Effects that the model file has already: they stay when all is off.
  const carried = () => data.effects.filter((e) => e.carried).map((e) => e.title);
  const parameters = () => [...data.effects, ...data.numbers].flatMap((e) => e.parameters);
  const shown = (name, value) => {
    const p = parameters().find((q) => q.name === name);
    return p ? `${p.called} ${number(value * p.factor + p.offset, 3)} ${p.unit}` : `${words(name)} ${number(value, 3)}`;
  };

  // What is called so stands open and first; what a search only finds in the words about it (which all forms of an effect share) is listed.
  const named = (e) => !!search && `${e.title} ${e.parameters.map((p) => `${p.name} ${p.called}`).join(" ")}`.toLowerCase().includes(search);
  const shownEntry = (e) => entry(e, { values, open: search.length > 2 && named(e), drawList, follow });
  function drawList() {
    if (!data) return;
    const on = (e) => e.parameters.some((p) => p.name in values);
    const fits = (e) => !search || named(e) || (e.says ?? "").toLowerCase().includes(search);
    const effects = data.effects.filter((e) => fits(e) || on(e)).sort((p, q) => on(q) - on(p) || named(q) - named(p));
    const numbers = data.numbers.filter((e) => fits(e) || on(e));
    clear(
      list,
      effects.length + numbers.length ? null : h("li", { class: "quiet" }, "No effect has these words."),
      effects.map(shownEntry),
      numbers.length
        ? h(
            "li",
            {},
            h(
              "details",
              { open: numbers.some(on) || !!search },
              h("summary", {}, `${numbers.length} numbers of the reducer that are not known for sure`),
              numbers.map(shownEntry),
            ),
          )
        : null,
    );
  }

  // The hand goes first: one request at a time, and while it is on its way only the last position counts.
  async function follow() {
    if (!run) return;
    remember();
    moves++;
    clearTimeout(settle);
    if (busy) {
      again = true;
      return;
    }
    busy = true;
    const begun = performance.now();
    try {
      const [words_, rows] = await wordsAndRows("try/curve", { model, run, values, roughly: true, beside }, 5);
      last = { told: words_, rows, roughly: true };
      drawCurve(performance.now() - begun);
    } catch (fault) {
      failed(faults, fault);
    }
    busy = false;
    if (again) {
      again = false;
      await follow();
      return;
    }
    rest(exactly);
  }

  const failed = (place, fault) => clear(place, h("p", { class: "note bad" }, fault.message));

  // When the hand rests, or another tab's does.
  function rest(act) {
    clearTimeout(settle);
    settle = setTimeout(() => root.isConnected && act(), 300);
  }

  // Exactly, and then for all signals; both give way to a move, in any tab.
  async function exactly() {
    const mine = moves;
    try {
      const [words_, rows] = await wordsAndRows("try/curve", { model, run, values, roughly: false, beside }, 5);
      if (mine !== moves) return;
      if (words_.late) {
        rest(exactly);
        return;
      }
      last = { told: words_, rows, roughly: false };
      drawCurve(null);
    } catch (fault) {
      if (mine === moves) failed(faults, fault);
    }
    if (mine === moves) await spread();
  }

  function drawCurve(took) {
    const {
        told: t,
        rows: [x, measured, base, tried, other],
      } = last,
      own = Object.keys(values).length > 0,
      // Nothing that is tried: nothing is rough.
      provisional = last.roughly && own;
    const lines = [
      { name: "measured", x, y: measured, colour: "--measured", width: 1.1, aside: t.aside },
      { name: "model", x, y: base, colour: "--predicted", width: 1.6 },
    ];
    if (kept && kept.rows[0].length === x.length) lines.push({ name: "A", x, y: kept.rows[3], colour: "--a", width: 1.6 });
    if (own) lines.push({ name: "with what is tried", x, y: tried, colour: "--tried", width: 2 });
    if (beside) lines.push({ name: beside, x, y: other, colour: "--b", width: 1.6 });
    const difference = (y) => measured.map((v, i) => v - y[i]);
    const lower = [{ name: "measured − model", x, y: difference(base), colour: "--residual", width: 1.1 }];
    if (kept && kept.rows[0].length === x.length) lower.push({ name: "measured − A", x, y: difference(kept.rows[3]), colour: "--left-a", width: 1.1 });
    if (beside) lower.push({ name: `measured − ${beside}`, x, y: difference(other), colour: "--left-b", width: 1.1 });
    if (own) lower.push({ name: "measured − tried", x, y: difference(tried), colour: "--gold", width: 1.3 });
    for (const line of lower) line.aside = t.aside;
    if (t.stems)
      [...lines, ...lower].forEach((line, i) => Object.assign(line, { stems: true, sorted: true, width: 2.4, shift: 0.35 * ((i % lines.length) - 1) }));
    plot.set({
      xTitle: t.axis.title,
      loop: t.loop,
      panes: [
        { title: `${t.title.split(" (")[0]} [${t.unit}]`, weight: 2, lines },
        { title: `difference [${t.unit}]`, weight: 1, zero: true, lines: lower },
      ],
    });
    if (took !== null) told.dataset.ms = String(Math.round(took));
    clear(
      told,
      `rms of the difference ${number(t.rms[0], 3)} ${t.unit} → `,
      h("b", {}, `${provisional ? "≈ " : ""}${number(t.rms[1], 3)} ${t.unit}`), ` of ${t.of}`,
      provisional ? h("span", { class: "fair" }, " first look, the exact number follows") : "",
      ` · ${summary()}`,
      kept ? ` · A: ${keptName}` : "",
      t.free ? " · the zero is free: drawn at the fitted one" : "",
      Object.entries({ placed: t.placed, "as-look": t.look && `model: ${t.look}` }).map(([id, text]) => (text ? h("span", { id }, ` · ${text}`) : "")),
      t.taken ? h("span", { id: "taken", style: { display: "block" } }, `shown: ${t.taken}`) : "",
    );
  }

  // What it would do to each signal.
  async function spread() {
    if (!data) return;
    const mine = moves,
      own = { ...values };
    if (!Object.keys(own).length) {
      clear(everywhere);
      return;
    }
    try {
      const rows = await post("try/everywhere", { model, values: own });
      if (mine !== moves) return;
      if (!rows) {
        rest(spread);
        return;
      }
      clear(everywhere, everySignal(rows));
    } catch (fault) {
      if (mine === moves) failed(everywhere, fault);
    }
  }

  load();
  return {
    update(state) {
      if (context.model() !== model || (!data && state.saved && !readying && model)) load();
    },
    recolour: () => plot.later(),
    close: () => {
      clearTimeout(settle);
      plot.destroy();
    },
  };
}
