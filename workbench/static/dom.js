// Elements, and small pieces that several views have.

export function h(tag, given = {}, ...children) {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(given ?? {})) {
    if (value === undefined || value === null || value === false) continue;
    if (name.startsWith("on")) element.addEventListener(name.slice(2), value);
    else if (name === "class") element.className = value;
    else if (name === "value") element.value = value;
    else if (name === "checked" || name === "selected" || name === "disabled" || name === "open" || name === "hidden") element[name] = value;
    else if (name === "style" && typeof value === "object") for (const [key, part] of Object.entries(value)) element.style.setProperty(key, part);
    else element.setAttribute(name, value === true ? "" : value);
  }
  for (const child of children.flat(Infinity)) if (child !== null && child !== undefined && child !== false) element.append(child);
  return element;
}

export const clear = (element, ...children) => {
  element.replaceChildren(...children.flat(Infinity).filter((c) => c !== null && c !== undefined && c !== false));
  return element;
};

// As ``clear``; what somebody has opened stays open.
export const redraw = (element, ...children) => {
  const name = (part) => `${part.id} ${part.querySelector("summary")?.textContent}`;
  const opened = new Set([...element.querySelectorAll("details[open]")].map(name));
  clear(element, ...children);
  for (const part of element.querySelectorAll("details")) if (opened.has(name(part))) part.open = true;
  return element;
};

export function choose(options, value, onchange, given = {}) {
  const all = options.map((o) => (Array.isArray(o) ? o : [o, o]));
  if (value && !all.some(([v]) => v === value)) all.unshift([value, value]);
  const list = h(
    "select",
    { onchange: (event) => onchange(event.target.value), ...given },
    all.map(([v, text]) => h("option", { value: v }, text)),
  );
  list.value = value ?? "";
  return list;
}

// So many columns stand beside each other on a telephone.
const MOST_BESIDE = 3;

// A table with right-aligned columns of numbers; cells may be elements.  One of many columns becomes rows where the screen is narrow.
export function table(head, rows, right = [], given = {}) {
  const side = (i) => (right.includes(i) ? { class: "num" } : {});
  return h(
    "div",
    { class: "scroll" },
    h(
      "table",
      { class: head.length > MOST_BESIDE ? "rows" : undefined, ...given },
      h(
        "thead",
        {},
        h(
          "tr",
          {},
          head.map((text, i) => h("th", { ...side(i), scope: "col" }, text)),
        ),
      ),
      h(
        "tbody",
        {},
        rows.map((row) =>
          row instanceof HTMLElement
            ? row
            : h(
                "tr",
                {},
                row.map((cell, i) => h("td", { ...side(i), "data-head": head[i] }, cell)),
              ),
        ),
      ),
    ),
  );
}

// Beside a number: by which relation, from which data, with which margin; opened by a click or by Enter.
// In a table the answer has a row of its own: in a cell it would squeeze the columns of all rows.
function below(asked) {
  const row = asked.closest("td")?.parentElement;
  if (!row) return;
  if (asked.open && !asked.answer) {
    asked.answer = h("tr", { class: "because" }, h("td", { colspan: row.cells.length }, asked.querySelector("dl")));
    row.after(asked.answer);
  } else if (!asked.open && asked.answer) {
    asked.append(asked.answer.querySelector("dl"));
    asked.answer.remove();
    asked.answer = null;
  }
}

export const why = (of, about) =>
  of
    ? h(
        "details",
        { class: "why", ontoggle: (event) => below(event.target) },
        h("summary", { "aria-label": `why ${about}?` }, "why?"),
        h(
          "dl",
          {},
          ["relation", "data", "margin"].flatMap((key) => [h("dt", {}, key), h("dd", {}, of[key])]),
        ),
      )
    : null;

// A command line to copy.
export function command(text) {
  if (!text) return null;
  const button = h(
    "button",
    {
      type: "button",
      onclick: async () => {
        await navigator.clipboard.writeText(text).catch(() => {});
        button.textContent = "copied";
        setTimeout(() => {
          button.textContent = "copy";
        }, 1500);
      },
    },
    "copy",
  );
  return h("div", { class: "command" }, h("code", {}, text), button);
}

export const note = (text, tone = "") => h("p", { class: `note ${tone}`, role: tone === "bad" ? "alert" : undefined }, text);

// A curve of few points, as small as a word.
export function spark(values) {
  const known = values.filter((v) => v !== null && Number.isFinite(v));
  if (known.length < 2) return null;
  const low = Math.min(...known),
    span = Math.max(...known) - low || 1;
  let path = "",
    pen = "M";
  values.forEach((v, i) => {
    if (v === null || !Number.isFinite(v)) {
      pen = "M";
      return;
    }
    path += `${pen}${((96 * i) / (values.length - 1)).toFixed(1)} ${(20 - (18 * (v - low)) / span).toFixed(1)}`;
    pen = "L";
  });
  const svg = document.createElementNS("http://www.w3.org/2000/svg", "svg");
  svg.setAttribute("class", "spark");
  svg.setAttribute("viewBox", "0 0 96 22");
  svg.setAttribute("aria-hidden", "true");
  const line = document.createElementNS("http://www.w3.org/2000/svg", "path");
  line.setAttribute("d", path);
  svg.append(line);
  return svg;
}

const SUPER = { "-": "⁻", 0: "⁰", 1: "¹", 2: "²", 3: "³", 4: "⁴", 5: "⁵", 6: "⁶", 7: "⁷", 8: "⁸", 9: "⁹" };

// Rounded to significant digits; no exponent between 1e-4 and 1e6.
export function number(value, digits = 4) {
  if (value === null || value === undefined || !Number.isFinite(value)) return "–";
  if (value === 0) return "0";
  const size = Math.floor(Math.log10(Math.abs(value)));
  if (size < -4 || size > 5) {
    const [mantissa, power] = value.toExponential(digits - 1).split("e");
    return `${Number(mantissa)}·10${[...String(Number(power))].map((c) => SUPER[c]).join("")}`.replace("-", "−");
  }
  return value.toFixed(Math.max(0, Math.min(12, digits - 1 - size))).replace("-", "−");
}

// A torque's unit as the screen has it; what is typed and what files hold keep their point.
export const unitShown = (unit) => unit.replaceAll("N.m", "N m");

export const words = (text) => String(text).replaceAll("_", " ");

// An effect in one of its forms: ``raceway_wear.inner`` as "raceway wear (inner)"; lobes are those of a disc, what a crank has is an eccentric.
export const effectName = (name) =>
  name
    .split(" + ")
    .map((one) => words(one).replace("crank lobe", "crank eccentric").replace(/\.(.+)$/, " ($1)"))
    .join(" + ");

export function duration(seconds) {
  if (seconds < 90) return `${Math.max(1, Math.round(seconds))} s`;
  return seconds < 5400 ? `${Math.round(seconds / 60)} min` : `${(seconds / 3600).toFixed(1)} h`;
}
