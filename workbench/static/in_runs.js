// What dropped files are taken for, group by group: quantity, columns with curve and unit, why; each corrected by a click.

import { choose, h, spark, table, unitShown, words } from "./dom.js";
import { doubtNotes } from "./doubts.js";
import { apart, family, familyPattern, numbersSaid } from "./in_names.js";
import { unitOf } from "./in_unit.js";
import { soItIs } from "./in_yes.js";
import { zeroOf } from "./in_zero.js";
import { drop } from "./net.js";

// So many files of a group are named before it is opened.
const MOST_NAMED = 12;
const COLUMNS = ["role", "column", "curve", "unit, scale", "why"];

// Files that nothing could be made of, and those that say nothing new: each with the reason, and a way out.
const ASIDE = [
  { key: "unread", one: "A file that cannot be read", many: "files that cannot be read", lead: "It has no part in the campaign; all others stay.", level: "bad" },
  { key: "copied", one: "A copy among the files", many: "copies among the files", lead: "Name the files of the repetitions, or measure again; a copy may stay, for it is not counted.", level: "fair" },
];
export const asides = (bag) => ASIDE.map((kind) => aside(bag, kind));

function aside({ data, context, faults, load }, { key, one, many, lead, level }) {
  const found = Object.entries(data[key]);
  if (!found.length) return null;
  return h(
    "div",
    { class: "panel", id: key },
    h("h2", { style: { "margin-top": 0 } }, found.length === 1 ? one : `${found.length} ${many}`),
    h("p", { class: "quiet" }, lead),
    table(
      ["file", "why", ""],
      found.map(([name, why]) => [
        h("b", {}, name),
        h("span", { class: level }, why),
        h(
          "button",
          { type: "button", title: "put the file aside (.workbench/aside)", onclick: () => context.act(drop(`files/${encodeURIComponent(name)}`).then(load), faults) },
          "Remove",
        ),
      ]),
      [],
      { class: "rows" },
    ),
  );
}

export function runs(bag) {
  const { data } = bag;
  const groups = new Map();
  for (const run of data.proposal.runs) {
    const key = JSON.stringify([run.quantity.value, Object.entries(run.columns).map(([role, e]) => [role, e.header, e.unit.value, e.scale]), family(run.names), run.tags]);
    groups.set(key, [...(groups.get(key) ?? []), run]);
  }
  return h(
    "section",
    {},
    h("h2", {}, "What the files are taken for"),
    [...groups.values()].map((members) => group(bag, members)),
  );
}

// Families of one quantity are told apart by their names or units; what is corrected of one may be so of all.
function alike(quantity, { together, redraw }) {
  const box = h("input", {
    type: "checkbox",
    checked: together.has(quantity),
    onchange: () => {
      if (box.checked) together.add(quantity);
      else together.delete(quantity);
      redraw();
    },
  });
  return h("label", { class: "inline small", title: `a unit, a scale or a quantity that is corrected here is so for all files of ${words(quantity)}` }, box, "the same for all of this quantity");
}

function group(bag, members) {
  const { data, choices, wish, mend, putIn, context, faults, load, together } = bag;
  const first = members[0],
    quantity = choices.quantities[first.quantity.value];
  const named = (runs) => [...new Set(runs.map((run) => run.file.split("/").at(-1)))],
    own = named(members),
    kin = named(data.proposal.runs.filter((run) => run.quantity.value === first.quantity.value));
  // A correction is meant for the files of this family, or for all of its quantity.
  const forAll = (part, of, value, place) =>
    wish((w) => {
      w[part] = { ...w[part] };
      for (const name of together.has(first.quantity.value) ? kin : own) {
        const key = of(name);
        if (value) w[part][key] = value;
        else delete w[part][key];
      }
    }, place);
  const short = apart(own.map((name) => name.replace(/\.\w+$/, "")));
  const headers = (data.columns[first.file] ?? []).map((c) => c.name);
  const roles = Object.entries(quantity.roles).map(([role, r]) => [role, r.title]);
  // A column that takes a role of another gives that one its own, if it has one.
  const cast = (header, role, before) =>
    wish((w) => {
      w.columns = { ...w.columns };
      if (before) delete w.columns[before];
      if (before && first.columns[role]) w.columns[before] = first.columns[role].header;
      w.columns[role] = header;
    });
  const putEach = (part, said) =>
    wish((w) => {
      w[part] = { ...w[part], ...Object.fromEntries(said) };
    });
  // Of a column role and unit are one answer.
  const confirm = (role, { header, column, unit }) =>
    wish((w) => {
      const files = together.has(first.quantity.value) ? kin : own;
      if (!column.sure) w.columns = { ...w.columns, ...Object.fromEntries(files.map((name) => [`${name}:${role}`, header])) };
      if (!unit.sure) w.units = { ...w.units, ...Object.fromEntries(files.map((name) => [`${name}:${header}`, unit.value])) };
    });
  const doubted = data.doubts.filter((d) => Object.values(first.columns).some((e) => e.column.value === d.column));
  const used = new Set(Object.values(first.columns).map((e) => e.header));
  const idle = (data.columns[first.file] ?? []).filter((c) => !used.has(c.name));
  const rows = Object.entries(first.columns).map(([role, entry]) => {
    const column = (data.columns[first.file] ?? []).find((c) => c.name === entry.header),
      units = quantity.roles[role]?.units ?? [];
    return [
      choose(roles, role, (other) => cast(entry.header, other, role), { "aria-label": `role of ${entry.header}`, title: quantity.roles[role]?.description }),
      choose(
        headers.map((name) => [name, name]),
        entry.header,
        (value) =>
          wish((w) => {
            w.columns = { ...w.columns, [role]: value };
          }),
        { "aria-label": `column of ${role}` },
      ),
      column ? spark(column.curve) : "",
      unitOf(entry, { units, factor: data.wishes.scales?.[`${own[0]}:${entry.header}`] }, (part, value, place) => forAll(part, (name) => `${name}:${entry.header}`, value, place)),
      [
        h("span", { class: entry.column.sure && entry.unit.sure ? "" : "fair" }, `${entry.why.join("; ")} `),
        entry.column.sure && entry.unit.sure ? null : soItIs(`${entry.header} is ${words(role)} in ${unitShown(entry.unit.value)}`, () => confirm(role, entry)),
      ],
    ];
  });
  const tags = Object.entries(first.tags).map(([tag, guess]) => {
    const known = choices.tags[tag]?.choices ?? [],
      change = (value) => putIn("tags", tag, value);
    const label = h(
      "label",
      { class: `inline${guess.sure ? "" : " fair"}`, title: guess.reason },
      tag,
      known.length ? choose(known, guess.value, change) : h("input", { type: "text", value: guess.value, size: 12, onchange: (e) => change(e.target.value) }),
    );
    return guess.sure ? label : [label, soItIs(`${tag} ${guess.value}`, () => change(guess.value))];
  });
  const whose = data.proposal.angle_of;
  // A transmission error over an angle that turns as the output does: one answer for all of them.
  if (whose && first.quantity.value === "transmission_error" && first.columns.angle)
    tags.push(
      h(
        "label",
        { class: `inline${whose.sure ? "" : " fair"}`, title: whose.reason },
        "angle of",
        choose(
          [
            ["output", "an encoder on the output"],
            ["input", "the input, over the ratio"],
          ],
          whose.value,
          (value) =>
            wish((w) => {
              w.angle_of = value;
            }),
          { "aria-label": "whose angle" },
        ),
      ),
      whose.sure
        ? null
        : soItIs(`angle of the ${whose.value}`, () =>
            wish((w) => {
              w.angle_of = whose.value;
            }),
          ),
    );
  const patterns = [...new Set(members.map((run) => run.names))];
  const say = (names) =>
    wish((w) => {
      // What was given for the other groups stays; files that no pattern fits are guessed as ever, words in their names included.
      const others = (w.names ?? []).filter((n) => !patterns.includes(n));
      w.names = names ? [...new Set([names, ...others])] : others;
    });
  const shown = familyPattern(members, data.proposal.conditions);
  const pattern = h("input", {
    type: "text",
    value: shown,
    size: Math.min(64, Math.max(18, shown.length + 2)),
    "aria-label": "pattern of the names",
    title: `${shown}\n\n` + "{load} {speed} {input_speed} {output_speed} {temperature} {hours} {locked_at} {direction} {mounting} {replicate} {condition} {any}; a unit behind a number is read, {load:in-lbf} says it where the name does not",
    onchange: () => say(pattern.value.trim()),
  });
  return h(
    "div",
    { class: "panel" },
    h(
      "div",
      { class: "row spread" },
      h(
        "div",
        { class: "row" },
        choose(
          Object.keys(choices.quantities).map((q) => [q, words(q)]),
          first.quantity.value,
          (value) => forAll("quantities", (name) => name, value),
          { "aria-label": "quantity", title: quantity.description },
        ),
        first.quantity.sure ? null : [h("span", { class: "tag fair" }, "not sure"), soItIs(words(first.quantity.value), () => forAll("quantities", (name) => name, first.quantity.value))],
        tags,
        zeroOf(bag, first.quantity.value, quantity),
        kin.length > own.length ? alike(first.quantity.value, bag) : null,
      ),
      h("label", { class: "inline small" }, patterns.length > 1 && shown === patterns[0] ? `names say (one of ${patterns.length} alike)` : "names say", pattern),
    ),
    numbersSaid(members, data.proposal.conditions, Boolean(quantity.roles.locked_at), say, (angles) =>
      putEach("conditions", Object.entries(angles).map(([name, angle]) => [`${name}:locked_at`, angle])),
    ),
    first.quantity.sure ? null : h("p", { class: "fair small" }, first.quantity.reason),
    table(
      COLUMNS,
      rows.map((row) =>
        h(
          "tr",
          {},
          row.map((cell, i) => h("td", { class: i === 4 ? "reason" : undefined, "data-head": COLUMNS[i] }, cell)),
        ),
      ),
      [],
      { class: "rows" },
    ),
    doubtNotes(doubted, mend),
    idle.length
      ? h(
          "details",
          {},
          h("summary", {}, `${idle.length} column${idle.length === 1 ? "" : "s"} without a part: ${idle.slice(0, 3).map((c) => c.name).join(", ")}${idle.length > 3 ? " …" : ""}`),
          table(
            ["column", "curve", "role"],
            idle.map((c) => [c.name, spark(c.curve), choose([["", "none"], ...roles], "", (role) => role && cast(c.name, role), { "aria-label": `role of ${c.name}` })]),
            [],
            { class: "rows" },
          ),
        )
      : null,
    h(
      "details",
      {},
      // What tells the files apart is seen; in full they are in the title, and in the table below.
      h("summary", { title: own.join("\n") }, `${members.length} run${members.length === 1 ? "" : "s"}: ${short.slice(0, MOST_NAMED).join(", ")}${own.length > MOST_NAMED ? " …" : ""}`),
      table(
        ["run", "file", "condition", "repetition", "said of it", ""],
        members.map((run) => [
          run.id,
          run.file,
          run.condition,
          `${run.replicate.value} (${run.replicate.reason})`,
          Object.entries(run.stated)
            .map(([k, g]) => `${words(k)} ${g.value}`)
            .join(", ") || "–",
          h(
            "button",
            {
              type: "button",
              class: "plainly",
              title: "put the file aside (.workbench/aside)",
              onclick: () => context.act(drop(`files/${encodeURIComponent(run.file)}`).then(load), faults),
            },
            "put aside",
          ),
        ]),
        [],
        { class: "rows" },
      ),
    ),
  );
}
