// The page of a result drawn in the workbench: the same cards, tables and figures as its file has.

import { h, note, table, why } from "./dom.js";
import { script } from "./net.js";

const config = { responsive: true, displaylogo: false, doubleClick: "reset", displayModeBar: false };

export const cards = (list) =>
  list.length
    ? h(
        "div",
        { class: "cards" },
        list.map((c) =>
          h(
            "div",
            { class: `card ${c.tone}` },
            h("p", { class: "label" }, c.label, c.unit ? ` · ${c.unit}` : ""),
            h("p", { class: "value" }, c.start ? `${c.start} → ${c.value}` : c.value),
            h("p", { class: "more" }, c.note),
            why(c.why, c.label),
          ),
        ),
      )
    : null;

// Sections open one by one, and their figures are drawn only then.
export function sections(list, first = 0) {
  return list.map((s, i) => {
    const inside = h("div");
    let filled = false;
    const fill = () => {
      if (filled) return;
      filled = true;
      inside.append(...[s.figures.length ? h("div", { class: "grid" }, s.figures.map(figure)) : null, ...s.tables.map(tableOf)].filter(Boolean));
    };
    const part = h(
      "details",
      { class: "panel", open: i < first, ontoggle: () => part.open && fill() },
      h("summary", {}, h("b", {}, s.title)),
      s.lead ? h("p", { class: "quiet small" }, s.lead) : null,
      inside,
    );
    if (i < first) fill();
    return part;
  });
}

// ``told`` makes of a warning what its note holds.
export const warnings = (list, told = (text) => text) =>
  list.length
    ? h(
        "details",
        { open: list.length < 3 },
        h("summary", {}, `${list.length} note${list.length === 1 ? "" : "s"}`),
        list.map((t) => note(told(t))),
      )
    : null;

const tableOf = (t) =>
  h(
    t.folded ? "details" : "div",
    { style: { "margin-top": "10px" } },
    t.folded ? h("summary", {}, t.folded) : null,
    t.title ? h("h3", {}, t.title) : null,
    table(t.whys?.length ? [...t.head, ""] : t.head, t.whys?.length ? t.rows.map((row, i) => [...row, why(t.whys[i], row.find(Boolean))]) : t.rows, t.right, t.head.length > 2 ? { class: "rows" } : {}),
    t.note ? h("p", { class: "quiet small" }, t.note) : null,
  );

export function figure(f) {
  const place = h("div", { style: f.aspect ? { "aspect-ratio": f.aspect } : { height: `${f.height}px` } });
  const select = f.labels.length
    ? h(
        "select",
        { "aria-label": f.asks, onchange: () => draw() },
        f.labels.map((text, i) => h("option", { value: i }, text)),
      )
    : null;
  const tools = () => Promise.all([script("plotly.js"), script("narrow.js")]);
  // Before it is seen, so that it can be printed without a wait; what fails is said where it is drawn.
  tools().catch(() => {});
  const draw = async () => {
    await tools();
    const choice = select ? f.choices[Number(select.value)] : null;
    const data = choice ? f.data.map((trace, i) => ({ ...trace, ...choice.traces[i] })) : f.data;
    const fitting = window.narrowed(f, data, { ...f.layout, ...(choice?.layout ?? {}) }, place.clientWidth);
    if (!f.aspect) place.style.height = `${fitting.height}px`;
    window.Plotly.react(place, themed(fitting.data), coloured(themed(fitting.layout)), config);
  };
  const watch = new IntersectionObserver((entries) => {
    if (entries.some((e) => e.isIntersecting)) {
      watch.disconnect();
      draw();
    }
  });
  watch.observe(place);
  place.dataset.figure = f.name;
  place.redraw = draw;
  return h(
    "figure",
    { style: { "--span": f.columns } },
    h("div", { class: "row spread" }, h("h3", {}, f.title), select ? h("label", { class: "inline" }, f.asks, select) : null),
    f.keys.length
      ? h(
          "div",
          { class: "keysrow" },
          f.keys.map(([text, colour]) =>
            h(
              "span",
              {},
              h("i", {
                style: { display: "inline-block", width: "18px", "border-top": `3px solid ${colour}`, "margin-right": "5px", "vertical-align": "middle" },
              }),
              text,
            ),
          ),
        )
      : null,
    place,
    h("figcaption", {}, f.caption),
    behind(f),
  );
}

// Numbers behind a figure, as far as they are rows.
function behind(f) {
  const rows = f.data.filter((t) => Array.isArray(t.x) && Array.isArray(t.y) && t.x.length && !Array.isArray(t.z) && t.hoverinfo !== "skip").slice(0, 6);
  const maps = f.data.filter((t) => Array.isArray(t.z));
  if (!rows.length && !maps.length) return null;
  const fill = (event) => {
    const place = event.target.lastElementChild;
    if (!event.target.open || place.childElementCount) return;
    place.append(
      ...rows.map((t) =>
        table(
          ["", t.name ?? "value"],
          t.x.slice(0, 200).map((x, i) => [String(x), String(t.y[i] ?? "")]),
          [1],
        ),
      ),
      ...maps.map((t) =>
        table(
          ["", ...t.x.map(String)],
          t.z.map((row, i) => [String(t.y[i]), ...row.map((v, k) => String(t.text?.[i]?.[k] ?? v ?? ""))]),
          t.x.map((_, i) => i + 1),
        ),
      ),
    );
  };
  return h("details", { class: "behind", ontoggle: fill }, h("summary", {}, "Table"), h("div"));
}

// Colours of the printed page by their meaning, so that they stand out on a dark ground, too.
const MEANINGS = {
  "#1d2733": "--ink",
  "#5d6975": "--quiet",
  "#e4e9ee": "--grid",
  "#eceff2": "--soft",
  "#ffffff": "--paper",
  "#0b4f94": "--predicted",
  "#98a3af": "--measured",
  "#7d8894": "--measured",
  "#d55e00": "--tried",
  "#a3195b": "--a",
  "#eef1f4": "--soft",
  "#e3e9f0": "--soft",
};
function themed(content) {
  const text = JSON.stringify(content);
  if (!document.documentElement.classList.contains("dark")) return JSON.parse(text);
  const style = getComputedStyle(document.documentElement);
  return JSON.parse(text.replace(/"(#[0-9a-f]{6})"/g, (whole, colour) => (MEANINGS[colour] ? `"${style.getPropertyValue(MEANINGS[colour]).trim()}"` : whole)));
}

// The layout in the page's colours.
function coloured(layout) {
  const style = getComputedStyle(document.documentElement),
    ink = style.getPropertyValue("--ink").trim(),
    quiet = style.getPropertyValue("--quiet").trim(),
    grid = style.getPropertyValue("--grid").trim();
  layout.font = { ...layout.font, color: ink };
  layout.hoverlabel = { ...layout.hoverlabel, bgcolor: style.getPropertyValue("--paper").trim(), font: { color: ink } };
  for (const key of Object.keys(layout))
    if (/^[xy]axis\d*$/.test(key)) {
      const a = layout[key];
      layout[key] = {
        ...a,
        gridcolor: grid,
        linecolor: grid,
        tickcolor: grid,
        tickfont: { ...a.tickfont, color: quiet },
        title: a.title ? { ...a.title, font: { ...a.title.font, color: quiet } } : undefined,
        fixedrange: matchMedia("(hover: none)").matches,
      };
    }
  for (const a of layout.annotations ?? []) if (a.font?.color || !a.font) a.font = { ...a.font, color: quiet };
  return layout;
}

// Figures are drawn as they are scrolled to; paper has no scrolling, and waits for nothing that is not at hand.
addEventListener("beforeprint", () => {
  for (const place of document.querySelectorAll("[data-figure]")) if (!place.childElementCount && place.clientWidth) place.redraw();
});

export function recolour(root) {
  for (const place of root.querySelectorAll("[data-figure]")) if (place.childElementCount) place.redraw();
}
