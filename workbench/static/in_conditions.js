// Conditions of the dropped files: what is needed, what is not sure, and the table of their numbers.

import { choose, h, note, table, unitShown, words } from "./dom.js";
import { anglesNamed, soItIs, yes } from "./in_yes.js";
import { mountings } from "./in_zero.js";
import { PLACE, matters, saysNothing, toCell } from "./to_cell.js";

const CONDITION = ["output_speed", "input_speed", "load_torque", "temperature", "hours", "locked_at", "direction", "mounting"];
const UNITS = { output_speed: "rpm", input_speed: "rpm", load_torque: "N.m", temperature: "degC", hours: "h", locked_at: "deg" };

// A condition with those that joined it by what was put in: what is said of it is said of them, too.
const withJoined = ({ joined }, name) => [name, ...Object.keys(joined).filter((other) => joined[other] === name)];

// What is needed first, then what is not sure: each with the place where it is answered.
export function questions(bag) {
  const { data, wish } = bag;
  const { needs, doubts } = data.proposal,
    names = Object.keys(data.proposal.conditions);
  // What was saved was taken as it stands: it asks no more.
  const unsettled = !(data.saved && data.same);
  // Keys of a condition that are asked for, with the conditions that need them.
  const asked = new Map();
  for (const need of needs.filter((n) => n.place !== "campaign"))
    for (const [, keys] of need.text.matchAll(/needs (.+)$/g)) {
      const needing = need.place.split(", ");
      asked.set(keys, [...new Set([...(asked.get(keys) ?? []), ...names.filter((name) => name === need.place || needing.includes(name))])]);
    }
  // What some conditions need is said of them alone: the others may say something else, or need none.
  const answer = (needing, key, text) =>
    wish((w) => {
      const own = needing.length < names.length ? needing.flatMap((name) => withJoined(data.proposal, name)).map((name) => `${name}:${key}`) : [key];
      w.conditions = { ...w.conditions, ...Object.fromEntries(own.map((name) => [name, text])) };
    });
  return [
    needs.length
      ? h(
          "div",
          { class: "panel" },
          h("h2", { style: { "margin-top": 0 } }, "Needed"),
          [...asked].map(([keys, needing]) =>
            h(
              "div",
              { class: "row" },
              h("span", {}, `${needing.join(", ")}: `),
              needs.some((n) => n.text.endsWith(`needs ${keys}`) && n.remedy.startsWith("--names")) ? "what the numbers in the names are can be chosen below; or, for all alike, " : "",
              keys.split(" or ").map((key, i) => [i ? "or " : "", amount(key, "", (text) => text && answer(needing, key, text), `need-${key}`)]),
            ),
          ),
          needs.filter((n) => n.place === "campaign").map((n) => h("p", {}, `${n.text}: choose it above`)),
        )
      : null,
    doubts.length
      ? h(
          "details",
          { open: unsettled && doubts.length < 6 },
          h("summary", {}, unsettled ? `${doubts.length} not sure` : `saved with ${doubts.length} guess${doubts.length === 1 ? "" : "es"} that ${doubts.length === 1 ? "was" : "were"} not sure`),
          doubts.map((d) => note([h("b", {}, d.place), `: ${d.text} `, yes(d, wish), " ", d.cell ? toCell(d.cell) : ""])),
        )
      : null,
  ];
}

// A number with its unit: typing the number alone is enough, one in another unit has that with it.
const NUMBER = /^[-+]?[\d.,]+(e[-+]?\d+)?$/i;
const TYPED = "a number alone is in the unit beside it; another unit may be typed with it, such as 1478 in-lbf or 77 F";

// ``named``: an angle that a name holds and that nobody stated.
function amount(key, text, onchange, id, named = "") {
  if (key === "direction") return choose([["", "–"], "forward", "reverse"], text, onchange, { id, "aria-label": key });
  const plain = UNITS[key] && text.endsWith(` ${UNITS[key]}`) ? text.slice(0, -UNITS[key].length - 1) : text,
    unit = h("span", { class: "quiet" });
  // Beside a number with a unit of its own no other stands.
  const beside = () => {
    const given = field.value.trim();
    unit.textContent = !given || NUMBER.test(given) ? unitShown(UNITS[key] ?? "") : "";
  };
  const field = h("input", {
    type: "text",
    value: plain,
    size: Math.max(8, plain.length),
    id,
    "aria-label": words(key),
    title: key === "locked_at" ? PLACE : UNITS[key] ? TYPED : undefined,
    placeholder: named ? `${named}?` : key === "locked_at" ? "or mean" : undefined,
    oninput: () => beside(),
    onchange: () => {
      const given = field.value.trim();
      onchange(given && UNITS[key] && NUMBER.test(given) ? `${given.replace(",", ".")} ${UNITS[key]}` : given);
    },
  });
  beside();
  return h("label", { class: "inline" }, words(key), field, unit);
}

// What no name or head says can be said of each condition, too.
const column = (bag, more) =>
  h(
    "label",
    { class: "inline small" },
    "a column for",
    choose([["", "–"], ...more.map((key) => [key, words(key)])], "", (key) => key && bag.columns.add(key) && bag.redraw(), { id: "more-columns" }),
  );

export function conditions(bag) {
  const { data, choices, wish, putIn } = bag;
  const all = data.proposal.conditions,
    named = anglesNamed(data.proposal),
    used = new Set(Object.values(all).flatMap((c) => Object.keys(c))),
    asked = (key, runs) => matters(choices, key, runs.map((r) => r.quantity.value)),
    offered = ["load_torque", "temperature", "locked_at", ...(used.has("input_speed") ? [] : ["output_speed"])];
  const keys = CONDITION.filter((k) => used.has(k) || bag.columns.has(k) || (k === "mounting" && bag.mountings) || (offered.includes(k) && asked(k, data.proposal.runs)));
  // A speed is one of the two; mountings have a switch of their own.
  const more = CONDITION.filter((k) => !keys.includes(k) && k !== "mounting" && !k.endsWith("_speed") && asked(k, data.proposal.runs));
  const rows = Object.entries(all).map(([name, stated]) => {
    const held = data.proposal.held_out[name],
      names = withJoined(data.proposal, name),
      runs = data.proposal.runs.filter((r) => r.condition === name);
    const keep = h("input", {
      type: "checkbox",
      checked: !!held,
      "aria-label": `${name} held out`,
      onchange: () =>
        wish((w) => {
          const now = new Set(w.held_out ?? Object.keys(data.proposal.held_out));
          if (keep.checked) now.add(name);
          else names.forEach((each) => now.delete(each));
          w.held_out = [...now];
        }),
    });
    return [
      h("b", {}, name),
      String(runs.length),
      ...keys.map((key) => {
        // What is stated all the same stays to be seen.
        if (!(key in stated) && !asked(key, runs)) return saysNothing(key);
        const say = (text) => putIn("conditions", names.map((each) => `${each}:${key}`), text),
          angle = key === "locked_at" ? named[name] : undefined,
          label = amount(key, stated[key] ?? "", say, `c-${name}-${key}`, angle);
        if (label.tagName !== "LABEL") return label;
        return h("span", { class: "inline" }, label.querySelector("input"), " ", label.querySelector("span"), angle ? soItIs(`${name} locked at ${angle}`, () => say(angle)) : "");
      }),
      h("label", { class: "held", title: held?.reason ?? "" }, keep, held ? h("span", { class: "quiet small reason" }, held.reason) : ""),
    ];
  });
  return h(
    "section",
    {},
    h("h2", {}, "Conditions"),
    h(
      "p",
      { class: "quiet small" },
      `Read from names and heads of the files; what stands here wins; ${TYPED}. ${keys.includes("locked_at") ? `${PLACE}. ` : ""}Held-out conditions are never fitted: the error that counts is theirs.`,
    ),
    h("div", { class: "panel" }, h("div", { class: "row" }, mountings(bag, used.has("mounting")), more.length ? column(bag, more) : null), table(["condition", "runs", ...keys.map(words), "held out"], rows, [], { class: "rows level" })),
  );
}
