// Many lives: what scatters and how far, and the bands that come of it.

import { choose, clear, command, h, note, number, table, words } from "./dom.js";
import { get, post } from "./net.js";
import { dimmed, pastLife } from "./past.js";
import { Plot } from "./plot.js";

const KINDS = { normal: ["mean", "standard deviation"], uniform: ["from", "to"], lognormal: ["median", "factor"] };
// What a first ensemble scatters: the numbers that wear knows least.
const FIRST = ["bearing.clearance", "wear.mesh_coefficient"];

export function ensemble(root, context, hours) {
  let rows = null,
    numbers = [],
    found = null,
    samples = "8",
    limits = { lost_motion_arcmin: "", disc_flank_um: "" },
    plot = null,
    model = "",
    // When that began of which the fields are.
    begun = null,
    open = false;
  const form = h("div"),
    faults = h("div"),
    result = h("div"),
    chart = h("div", { class: "panel", hidden: true }),
    shown = h("div");
  let why = null;
  const all = h(
    "details",
    {
      class: "panel",
      id: "ensemble",
      ontoggle: () => {
        open = all.open;
        if (open) load();
      },
    },
    h("summary", {}, h("b", {}, "Many lives: parts, load and coefficients that scatter")),
    form,
    faults,
    shown,
  );
  root.append(all);

  async function load() {
    const job = context.state?.jobs.ensemble;
    const given = job?.given?.model === context.model() ? job.given : null;
    if (!rows || model !== context.model() || (given && job.begun !== begun)) {
      model = context.model();
      const told = model ? await context.act(post("reducer", { model }), faults) : null;
      numbers = told?.reducer?.numbers.filter((n) => /\d/.test(n.value)) ?? [];
      rows = given?.scatters?.map((row) => ({ ...row })) ?? FIRST.filter((name) => numbers.some((n) => n.name === name)).map(usual);
      if (given) {
        begun = job.begun;
        samples = given.samples ?? samples;
        limits = { ...limits, ...given.limits };
      }
    }
    found = job?.state ? await get(job.state === "running" || !job.result ? "results/ensemble/live" : "results/ensemble").catch(() => null) : null;
    if (!found?.panes) found = null;
    draw();
  }

  const plain = (text) => Number(text.replaceAll(",", "").replace("−", "-"));
  // Small coefficients by a factor, all else by a tenth, or by half of the half range of the file.
  function usual(name) {
    const n = numbers.find((m) => m.name === name),
      value = plain(n.value),
      [low, high] = n.range ? n.range.split(" to ").map(plain) : [0.8 * value, 1.2 * value];
    return name.includes("coefficient")
      ? { name, unit: n.unit, distribution: "lognormal", first: value, second: 1.3 }
      : { name, unit: n.unit, distribution: "normal", first: value, second: Number(((high - low) / 4 || 1).toPrecision(2)) };
  }

  function draw() {
    const job = context.state?.jobs.ensemble,
      busy = context.busy();
    const field = (row, key) =>
      h("input", {
        type: "text",
        inputmode: "decimal",
        size: 9,
        value: row[key],
        "aria-label": `${row.name}, ${KINDS[row.distribution][key === "first" ? 0 : 1]}`,
        onchange: (e) => {
          row[key] = e.target.value;
        },
      });
    const lives = (rows?.length ?? 0) + 2,
      lacks = busy || (rows?.length ? "" : model ? "a number that scatters has to be added first" : "a model has to be chosen first");
    clear(
      form,
      model ? null : h("p", { class: "quiet" }, "Choose a model first."),
      rows?.length
        ? table(
            ["what scatters", "how", "", "", "unit", ""],
            rows.map((row, i) => [
              h("code", {}, row.name),
              choose(Object.keys(KINDS), row.distribution, (v) => {
                row.distribution = v;
                draw();
              }),
              h("label", { class: "inline" }, KINDS[row.distribution][0], field(row, "first")),
              h("label", { class: "inline" }, KINDS[row.distribution][1], field(row, "second")),
              row.distribution === "lognormal" ? row.unit : row.unit,
              h(
                "button",
                {
                  type: "button",
                  class: "plainly",
                  onclick: () => {
                    rows.splice(i, 1);
                    draw();
                  },
                },
                "leave out",
              ),
            ]),
          )
        : null,
      h(
        "div",
        { class: "row" },
        choose(
          [["", "add a number…"], ...numbers.filter((n) => !rows?.some((r) => r.name === n.name)).map((n) => [n.name, `${n.name} = ${n.value} ${n.unit}`])],
          "",
          (name) => {
            if (name) {
              rows.push(usual(name));
              draw();
            }
          },
          { "aria-label": "add a number that scatters" },
        ),
        h(
          "label",
          { class: "inline" },
          "base samples",
          choose(["2", "4", "8", "16", "32", "64"], samples, (v) => {
            samples = v;
            draw();
          }),
        ),
        h("span", { class: "quiet small" }, `${lives * Number(samples)} lives of ${hours()} h`),
        Object.entries(limits).map(([name, value]) =>
          h(
            "label",
            { class: "inline" },
            `limit of ${words(name.replace(/_(arcmin|um)$/, ""))}`,
            h("input", {
              type: "text",
              inputmode: "decimal",
              size: 6,
              value,
              onchange: (e) => {
                limits[name] = e.target.value;
              },
            }),
            name.endsWith("um") ? "µm" : "arcmin",
          ),
        ),
        h(
          "button",
          {
            type: "button",
            class: "main",
            id: "ensemble-run",
            disabled: !!lacks,
            title: lacks || undefined,
            onclick: () => context.start("ensemble", { hours: hours(), samples, limits, scatters: rows }),
          },
          job?.state === "stopped" ? "Go on" : "Run",
        ),
      ),
    );
    clear(faults, job?.fault && job.state !== "running" ? note(job.fault, "bad") : null);
    chart.hidden = !found?.panes?.length;
    const former = chart.hidden ? "" : pastLife(job, context);
    if (why !== former) {
      why = former;
      clear(shown, dimmed(why, chart, result));
    }
    if (chart.hidden) {
      clear(result);
      return;
    }
    if (!plot) {
      plot = new Plot({ height: 120 * found.panes.length + 60, label: "bands of many lives over the hours" });
      chart.append(plot.element);
    }
    const x = Float32Array.from(found.hours);
    plot.set({
      xTitle: "operating time [h]",
      panes: found.panes.map((p) => {
        const [low, lower, middle, upper, high] = p.quantiles.map((q) => Float32Array.from(q));
        return {
          title: `${p.title} [${p.unit}]`,
          limits: p.limit ? [p.limit] : [],
          bands: [
            { x, low, high },
            { x, low: lower, high: upper },
          ],
          lines: [
            { name: "median", x, y: middle, colour: "--predicted", width: 1.8 },
            { name: "5 and 95 %", x, y: low, colour: "--measured", width: 1 },
            { name: "5 and 95 %", x, y: high, colour: "--measured", width: 1 },
          ],
        };
      }),
    });
    const s = found.summary,
      at = (d, q) => number(d?.[q]?.value, 3);
    clear(
      result,
      h(
        "p",
        { class: "quiet small" },
        `${found.lives} of ${found.planned} lives; bands of the ${found.counted} that stand for the distributions: half of them, and nine of ten`,
      ),
      s?.distributions
        ? table(
            ["at the end", "5 %", "median", "95 %"],
            Object.entries(s.distributions).map(([name, d]) => [words(name), at(d, "q05"), at(d, "q50"), at(d, "q95")]),
            [1, 2, 3],
          )
        : null,
      s?.life_hours
        ? h(
            "p",
            {},
            `Hours to the first limit: median ${s.life_hours.q50.value === null ? `beyond ${number(found.hours.at(-1))}` : number(s.life_hours.q50.value, 3)} h; ${Math.round(100 * s.beyond_any_limit.value)} % pass one within the hours.`,
          )
        : null,
      s?.sensitivity
        ? [
            h("h3", {}, "What matters"),
            table(
              ["figure", "most", "share of the variance"],
              Object.entries(s.sensitivity)
                .filter(([, r]) => Object.keys(r).length)
                .map(([name, r]) => [
                  words(name),
                  words(Object.keys(r)[0]),
                  `${Math.round(100 * Object.values(r)[0].total)} ± ${Math.round(100 * Object.values(r)[0].total_plus_minus)} %`,
                ]),
              [2],
            ),
          ]
        : null,
      command(found.command),
    );
  }

  let seen = "";
  return {
    update(state) {
      const job = state.jobs.ensemble,
        now = `${job?.state}${job?.begun}${job?.old}${job?.tasks?.map((t) => t.done).join()}${state.view?.model}${Object.values(state.jobs).some((j) => j.state === "running")}`;
      if (now === seen) return;
      seen = now;
      if (job?.state === "running" && !open) {
        all.open = true;
        return;
      }
      if (open) load();
    },
    recolour: () => plot?.later(),
    close: () => plot?.destroy(),
  };
}
