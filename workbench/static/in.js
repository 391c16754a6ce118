// In: drop files, look at what they are taken for and why, correct it by a click, save the campaign.

import { choose, clear, command, h, note, spark, table, words } from "./dom.js";
import { drop, get, post, put } from "./net.js";

const CONDITION = ["output_speed", "input_speed", "load_torque", "temperature", "hours", "direction", "mounting"];
const UNITS = { output_speed: "rpm", input_speed: "rpm", load_torque: "N.m", temperature: "degC", hours: "h" };

export function show(root, context) {
  let data = null, choices = null, closed = false, taking = false;
  const faults = h("div"), body = h("div", {}, h("p", { class: "quiet" }, "Reading the files…"));
  root.append(faults, body);
  const input = h("input", { type: "file", multiple: true, hidden: true, id: "files", onchange: () => upload([...input.files]) });
  root.append(input);

  const over = (event) => { event.preventDefault(); root.querySelector(".drop")?.classList.toggle("over", event.type === "dragover"); };
  const dropped = async (event) => { over(event); upload(await filesOf(event.dataTransfer)); };
  root.addEventListener("dragover", over); root.addEventListener("dragleave", over); root.addEventListener("drop", dropped);

  async function load() {
    // An empty folder needs nothing but its invitation.
    if (!data && context.state && !context.state.files) clear(body, empty());
    const [there, found] = await Promise.all([choices ?? context.act(get("in/choices"), faults), context.act(get("in"), faults)]);
    choices = there;
    if (found && choices && !closed) { data = found; draw(); }
  }

  async function upload(files) {
    clear(faults);
    taking = true;
    const failed = [];
    for (const [i, file] of files.entries()) {
      clear(faults, h("p", { class: "note" }, `Taking in ${file.name} (${i + 1} of ${files.length})`));
      try { await put(`files/${encodeURIComponent(file.name)}`, file); } catch (fault) { failed.push(fault.message); }
    }
    clear(faults, failed.map((text) => note(text, "bad")));
    input.value = "";
    taking = false;
    await load();
  }

  // What was corrected goes to the folder, and the guesses come back anew.
  async function wish(change) {
    const given = structuredClone(data.wishes);
    change(given);
    const found = await context.act(post("in/wishes", given), faults);
    if (found) { clear(faults); data = found; draw(); }
  }
  const put_in = (part, key, value) => wish((w) => { w[part] = { ...w[part] }; if (value === "" || value === null) delete w[part][key]; else w[part][key] = value; });

  function draw() {
    if (!data.files.length) { clear(body, empty()); return; }
    const held = document.activeElement?.id;
    clear(body, head(), data.fault ? note(data.fault, "bad") : null, data.gone.map((text) => note(text)), data.proposal ? [questions(), runs(), conditions(), saved(), textOf()] : files());
    if (held) document.getElementById(held)?.focus();
  }

  const chooseFiles = (text = "Choose files") => h("button", { type: "button", class: "main", onclick: () => input.click() }, text);
  const empty = () => h("div", { class: "empty drop" }, h("h1", {}, "Drop what the bench wrote"),
    h("p", { class: "lead", style: { margin: "4px auto 14px" } }, "CSV as it is found (semicolons, decimal commas, any encoding, lines above the table), Parquet, MAT, MDF or TDMS; files or a folder, several at once. They are copied into this folder and go nowhere else."), chooseFiles());

  function head() {
    const p = data.proposal, sure = p ? p.runs.length : 0;
    const reducers = [...data.models, ...choices.reducers];
    return h("div", { class: "panel drop" },
      h("h1", {}, p ? `${sure} run${sure === 1 ? "" : "s"} in ${data.files.length} file${data.files.length === 1 ? "" : "s"}, ${Object.keys(p.conditions).length} condition${Object.keys(p.conditions).length === 1 ? "" : "s"}` : `${data.files.length} files`),
      h("p", { class: "quiet" }, "More files can be dropped here at any time."),
      h("div", { class: "row" }, h("label", { class: "inline" }, "reducer that was measured", choose([["", "choose…"], ...reducers.map((r) => [r, r])], data.wishes.reducer ?? "", (value) => wish((w) => { w.reducer = value; }), { id: "measured" })),
        h("button", { type: "button", onclick: () => input.click() }, "Add files"), h("button", { type: "button", class: "plainly", onclick: () => context.go("reducer") }, "mine is not in the list")));
  }

  // What is needed first, then what is not sure: each with the place where it is answered.
  function questions() {
    const { needs, doubts } = data.proposal;
    const general = needs.filter((n) => n.place !== "campaign").flatMap((n) => [...n.text.matchAll(/needs (.+)$/g)].map((m) => [n, m[1].split(" or ")]));
    const asked = new Map(general.map(([n, keys]) => [keys.join(), [n, keys]]));
    return [
      needs.length ? h("div", { class: "panel" }, h("h2", { style: { "margin-top": 0 } }, "Needed"), [...asked.values()].map(([n, keys]) => h("div", { class: "row" }, h("span", {}, `${n.place}: `), keys.map((key, i) => [i ? "or " : "", amount(key, data.wishes.conditions?.[key] ?? "", (text) => put_in("conditions", key, text), `need-${key}`)]))),
        needs.filter((n) => n.place === "campaign").map((n) => h("p", {}, `${n.text}: choose it above`))) : null,
      doubts.length ? h("details", { open: doubts.length < 6 }, h("summary", {}, `${doubts.length} not sure`), doubts.map((d) => note([h("b", {}, d.place), `: ${d.text}`]))) : null,
    ];
  }

  // A number with its unit: typing the number alone is enough.
  function amount(key, text, onchange, id) {
    if (key === "direction") return choose([["", "–"], "forward", "reverse"], text, onchange, { id, "aria-label": key });
    const plain = UNITS[key] && text.endsWith(` ${UNITS[key]}`) ? text.slice(0, -UNITS[key].length - 1) : text;
    const field = h("input", { type: "text", value: plain, size: 8, id, "aria-label": words(key), inputmode: UNITS[key] ? "decimal" : undefined, onchange: () => {
      const given = field.value.trim();
      onchange(given && UNITS[key] && /^[-+]?[\d.,]+(e[-+]?\d+)?$/i.test(given) ? `${given.replace(",", ".")} ${UNITS[key]}` : given);
    } });
    return h("label", { class: "inline" }, words(key), field, UNITS[key] ?? "");
  }

  function runs() {
    const groups = new Map();
    for (const run of data.proposal.runs) {
      const key = JSON.stringify([run.quantity.value, Object.entries(run.columns).map(([role, e]) => [role, e.header, e.unit.value]), run.names, run.tags]);
      groups.set(key, [...(groups.get(key) ?? []), run]);
    }
    return h("section", {}, h("h2", {}, "What the files are taken for"), [...groups.values()].map(group));
  }

  function group(members) {
    const first = members[0], quantity = choices.quantities[first.quantity.value];
    const own = [...new Set(members.map((m) => m.file.split("/").at(-1)))];
    const forAll = (part, of, value) => wish((w) => { w[part] = { ...w[part] }; for (const name of own) { const key = of(name); if (value) w[part][key] = value; else delete w[part][key]; } });
    const headers = (data.columns[first.file] ?? []).map((c) => c.name);
    const rows = Object.entries(first.columns).map(([role, entry]) => {
      const column = (data.columns[first.file] ?? []).find((c) => c.name === entry.header), units = quantity.roles[role]?.units ?? [];
      return [h("span", { title: quantity.roles[role]?.description }, words(role)),
        choose(headers.map((name) => [name, name]), entry.header, (value) => wish((w) => { w.columns = { ...w.columns, [role]: value }; }), { "aria-label": `column of ${role}` }),
        column ? spark(column.curve) : "", unitOf(entry, units, (unit) => forAll("units", (name) => `${name}:${entry.header}`, unit)),
        h("span", { class: entry.column.sure && entry.unit.sure ? "" : "fair" }, `${entry.column.reason}; unit: ${entry.unit.reason}`)];
    });
    const tags = Object.entries(first.tags).map(([tag, guess]) => {
      const known = choices.tags[tag]?.choices ?? [], change = (value) => put_in("tags", tag, value);
      return h("label", { class: `inline${guess.sure ? "" : " fair"}`, title: guess.reason }, tag, known.length ? choose(known, guess.value, change) : h("input", { type: "text", value: guess.value, size: 12, onchange: (e) => change(e.target.value) }));
    });
    const pattern = h("input", { type: "text", value: first.names, size: Math.min(44, Math.max(18, first.names.length + 2)), "aria-label": "pattern of the names", title: "{load} {speed} {input_speed} {output_speed} {temperature} {hours} {direction} {mounting} {replicate} {condition} {any}",
      onchange: () => wish((w) => { w.names = [...(w.names ?? []).filter((n) => n !== first.names), ...(pattern.value.trim() ? [pattern.value.trim()] : [])]; }) });
    return h("div", { class: "panel" },
      h("div", { class: "row spread" }, h("div", { class: "row" }, choose(Object.keys(choices.quantities).map((q) => [q, words(q)]), first.quantity.value, (value) => forAll("quantities", (name) => name, value), { "aria-label": "quantity", title: quantity.description }),
        first.quantity.sure ? null : h("span", { class: "tag fair" }, "not sure"), tags), h("label", { class: "inline small" }, "names say", pattern)),
      first.quantity.sure ? null : h("p", { class: "fair small" }, first.quantity.reason),
      table(["role", "column", "curve", "unit", "why"], rows.map((row) => h("tr", {}, row.map((cell, i) => h("td", { class: i === 4 ? "reason" : undefined }, cell))))),
      h("details", {}, h("summary", {}, `${members.length} run${members.length === 1 ? "" : "s"}: ${own.slice(0, 3).join(", ")}${own.length > 3 ? " …" : ""}`),
        table(["run", "file", "condition", "repetition", "said of it", ""], members.map((run) => [run.id, run.file, run.condition, `${run.replicate.value} (${run.replicate.reason})`,
          Object.entries(run.stated).map(([k, g]) => `${words(k)} ${g.value}`).join(", ") || "–", h("button", { type: "button", class: "plainly", title: "put the file aside (.workbench/aside)", onclick: () => context.act(drop(`files/${encodeURIComponent(run.file)}`).then(load), faults) }, "put aside")]))));
  }

  function unitOf(entry, units, change) {
    const other = "other…", all = units.includes(entry.unit.value) ? units : [entry.unit.value, ...units];
    const list = choose([...all.map((u) => [u, u]), [other, other]], entry.unit.value, (value) => {
      if (value !== other) { change(value); return; }
      const field = h("input", { type: "text", size: 8, "aria-label": "unit", onchange: () => change(field.value.trim()) });
      list.replaceWith(field); field.focus();
    }, { "aria-label": `unit of ${entry.header}` });
    return list;
  }

  function conditions() {
    const all = data.proposal.conditions, used = new Set(Object.values(all).flatMap((c) => Object.keys(c)));
    const keys = CONDITION.filter((k) => used.has(k) || (k === "output_speed" && !used.has("input_speed")) || ["load_torque", "temperature"].includes(k));
    const rows = Object.entries(all).map(([name, stated]) => {
      const held = data.proposal.held_out[name], runs = data.proposal.runs.filter((r) => r.condition === name);
      const keep = h("input", { type: "checkbox", checked: !!held, "aria-label": `${name} held out`, onchange: () => wish((w) => {
        const now = new Set(w.held_out ?? Object.keys(data.proposal.held_out));
        if (keep.checked) now.add(name); else now.delete(name);
        w.held_out = [...now];
      }) });
      return [h("b", {}, name), String(runs.length), ...keys.map((key) => {
        const label = amount(key, stated[key] ?? "", (text) => put_in("conditions", `${name}:${key}`, text), `c-${name}-${key}`);
        return label.tagName === "LABEL" ? h("span", { class: "inline" }, label.querySelector("input"), " ", h("span", { class: "quiet" }, UNITS[key] ?? "")) : label;
      }), h("label", { title: held?.reason ?? "" }, keep, held ? h("span", { class: "quiet small reason" }, ` ${held.reason}`) : "")];
    });
    return h("section", {}, h("h2", {}, "Conditions"), h("p", { class: "quiet small" }, "Read from names and heads of the files; what stands here wins. Held-out conditions are never fitted: the error that counts is theirs."),
      h("div", { class: "panel" }, table(["condition", "runs", ...keys.map(words), "held out"], rows)));
  }

  function saved() {
    const ready = data.proposal.reducer && !data.saved, needs = data.proposal.needs.length;
    const save = async () => {
      const found = await context.act(post("in/save"), faults);
      if (!found) return;
      await context.act(post("state", { model: context.state.view.model || data.proposal.reducer }), faults);
      await load();
      if (!found.needs.length) { context.go("look"); context.start("compare", { model: data.proposal.reducer }); }
    };
    return h("div", { class: "row" },
      h("button", { type: "button", class: "main", id: "save", disabled: !data.proposal.reducer, onclick: save }, data.saved ? "Save anew and compare" : needs ? "Save" : "Save and compare"),
      data.saved ? h("span", { class: "quiet" }, data.own ? "campaign.toml is saved" : "campaign.toml was written elsewhere and is not overwritten") : null,
      data.saved ? h("button", { type: "button", onclick: () => { context.go("look"); context.start("compare", { model: context.model() || data.proposal.reducer }); } }, "Compare") : null,
      ready ? null : data.proposal.reducer ? null : h("span", { class: "fair" }, "the reducer has to be chosen first"));
  }

  const textOf = () => h("details", {}, h("summary", {}, "campaign.toml and the command that writes the same"), command(data.command), h("pre", { class: "file" }, data.text));
  const files = () => h("div", { class: "panel" }, table(["file", "size", ""], data.files.map((f) => [f.name, `${Math.max(1, Math.round(f.bytes / 1000))} kB`, h("button", { type: "button", class: "plainly", onclick: () => context.act(drop(`files/${encodeURIComponent(f.name)}`).then(load), faults) }, "put aside")]), [1]));

  load();
  let count = context.state?.files;
  return { update(state) { if (taking) return; if (count !== undefined && state.files !== count && data) load(); count = state.files; }, close() { closed = true; root.removeEventListener("dragover", over); root.removeEventListener("dragleave", over); root.removeEventListener("drop", dropped); } };
}

// Files of what was dropped, folders opened.
async function filesOf(transfer) {
  const entries = [...transfer.items].map((item) => item.webkitGetAsEntry?.()).filter(Boolean);
  if (!entries.length) return [...transfer.files];
  const found = [];
  const walk = async (entry) => {
    if (entry.isFile) found.push(await new Promise((done, failed) => entry.file(done, failed)));
    else {
      const reader = entry.createReader();
      for (;;) {
        const some = await new Promise((done, failed) => reader.readEntries(done, failed));
        if (!some.length) break;
        for (const one of some) await walk(one);
      }
    }
  };
  for (const entry of entries) await walk(entry);
  return found;
}
