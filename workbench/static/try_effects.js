// One effect under Try: what it is, and its sliders.

import { h, number } from "./dom.js";

const plain = (value) => String(Number(value.toPrecision(4)));

export function entry(e, { values, open, drawList, follow }) {
  const on = e.parameters.some((p) => p.name in values);
  // What is drawn open anew stays where it is; what a hand opens is to be seen.
  let byHand = false;
  const item = h(
    "li",
    {},
    h(
      "details",
      {
        open: on || open,
        ontoggle: (event) => {
          if (byHand && event.target.open) item.scrollIntoView({ block: "nearest" });
          byHand = false;
        },
      },
      h(
        "summary",
        {
          title: e.law,
          onclick: () => {
            byHand = true;
          },
        },
        e.title,
        on || e.carried
          ? h("span", { class: "tag good", style: { "margin-left": "6px" } }, e.carried ? (on ? "in the model, changed" : "in the model") : "on")
          : null,
      ),
      e.law ? h("p", { class: "quiet small" }, e.law) : null,
      e.says ? h("p", { class: "quiet small" }, e.says) : null,
      e.carried
        ? h(
            "button",
            {
              type: "button",
              onclick: () => {
                Object.assign(values, e.without);
                drawList();
                follow();
              },
            },
            "Without it",
          )
        : null,
      e.parameters.map((p) => slider(p, values, follow)),
      e.source ? h("p", { class: "quiet small" }, `source: ${e.source}`) : null,
    ),
  );
  return item;
}

// ``sensor_drift[hysteresis]`` as "sensor drift (hysteresis)": in square brackets stand units.
const called = (p) => p.called.replace(/\[([^\]]*)\]$/, " ($1)");

function slider(p, values, follow) {
  const value = p.name in values ? values[p.name] * p.factor + p.offset : p.off,
    step = p.counts ? 1 : (p.high - p.low) / 400,
    unit = p.unit || "1";
  const range = h("input", {
    type: "range",
    min: p.low,
    max: p.high,
    step: p.counts ? 1 : "any",
    value,
    "aria-label": `${called(p)} [${unit}]`,
    "data-parameter": p.name,
    oninput: () => moved(Number(range.value)),
  });
  const field = h("input", {
    type: "number",
    step: "any",
    value: plain(value),
    "aria-label": `${called(p)}, number`,
    onchange: () => {
      const [low, high] = p.bounds,
        asked = Number(field.value),
        taken = Math.min(Math.max(asked, low), high);
      // What is beyond the bounds is computed at them, and so it says.
      say(asked === taken ? "" : `${inUnit(field.value)} must lie in ${inUnit(`[${plain(low)}, ${plain(high)}]`)}; ${inUnit(plain(taken))} is shown`);
      field.value = plain(taken);
      range.value = taken;
      set(taken);
    },
  });
  const refused = h("span", { class: "small bad", role: "status", style: { "grid-column": "1 / -1" } });
  const inUnit = (text) => `${text}${p.unit ? ` ${p.unit}` : ""}`.replaceAll("-", "−");
  const say = (text) => {
    refused.textContent = text;
  };
  range.addEventListener("keydown", (event) => {
    const by = { ArrowRight: 1, ArrowUp: 1, ArrowLeft: -1, ArrowDown: -1 }[event.key];
    if (by) {
      event.preventDefault();
      range.value = Number(range.value) + by * step;
      moved(Number(range.value));
    }
  });
  const set = (v) => {
    if (Math.abs(v - p.off) < 1e-12 * Math.max(1, Math.abs(p.high))) delete values[p.name];
    else values[p.name] = (v - p.offset) / p.factor;
    if (document.activeElement !== field) field.value = plain(v);
    follow();
  };
  // Where the hand goes on from there, what was refused is of before.
  const moved = (v) => {
    say("");
    set(v);
  };
  return h(
    "div",
    { class: "slider" },
    // A number without a unit is a share, or a count, of something: of what stands beside it.
    h("span", { class: "name", title: p.description }, `${called(p)} [${unit}]${p.amplitude ? "" : " · shape"}`, p.of ? h("span", { class: "small of" }, `: ${p.of}`) : null),
    range,
    field,
    // Below the field, above what is always there.
    refused,
    h(
      "span",
      { class: "quiet small", style: { "grid-column": "1 / -1" } },
      `${number(p.low, 3)} to ${number(p.high, 3)}; ` +
        (p.all_round ? "all round (behind a gear a further turn is another place)" : `allowed ${number(p.bounds[0], 3)} to ${number(p.bounds[1], 3)}`),
    ),
  );
}
