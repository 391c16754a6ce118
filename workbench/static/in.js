// In: drop files, look at what they are taken for and why, correct it by a click, save the campaign.

import { choose, clear, command, h, note, table, words } from "./dom.js";
import { doubtNotes } from "./doubts.js";
import { conditionCells, runCells } from "./in_cells.js";
import { conditions, questions } from "./in_conditions.js";
import { asides, runs } from "./in_runs.js";
import { saveRow } from "./in_save.js";
import { filesOf } from "./dropped_files.js";
import { drop, get, post, put } from "./net.js";
import { arrive, toCell } from "./to_cell.js";

// The place of a role in campaign.toml.
const ROLE = ["runs", "number", "columns", "role"];

export function show(root, context) {
  let data = null,
    choices = null,
    taking = false;
  const faults = h("div"),
    numbers = h("div", { id: "numbers" }),
    body = h("div", {}, h("p", { class: "quiet" }, "Reading the files…"));
  root.append(faults, body);
  const input = h("input", { type: "file", multiple: true, hidden: true, id: "files", onchange: () => upload([...input.files]) });
  root.append(input);

  const over = (event) => {
    event.preventDefault();
    root.querySelector(".drop")?.classList.toggle("over", event.type === "dragover");
  };
  const dropped = async (event) => {
    over(event);
    upload(await filesOf(event.dataTransfer));
  };
  root.addEventListener("dragover", over);
  root.addEventListener("dragleave", over);
  root.addEventListener("drop", dropped);

  // One after the other, what is read anew too: each correction is meant for what the one before it left.
  let corrected = Promise.resolve();
  const inTurn = (next) => {
    corrected = corrected.then(next, next);
    return corrected;
  };
  const load = () => inTurn(read);
  async function read() {
    // An empty folder needs nothing but its invitation.
    if (!data && context.state && !context.state.files) clear(body, empty());
    const [there, found] = await Promise.all([choices ?? context.act(get("in/choices"), faults), context.act(get("in"), faults)]);
    choices = there;
    if (found && choices) {
      data = found;
      draw();
      arrive();
    }
  }

  // What of the numbers cannot be, or hardly, stands open before all else; scales are held against a model, which takes some seconds.
  async function judge() {
    const asked = data;
    if (!data.campaign) {
      clear(numbers);
      return;
    }
    const read = (data.findings ?? []).filter((f) => f.open);
    clear(numbers, doubtNotes(read, mend), data.scales ? null : h("p", { class: "quiet small", role: "status" }, "Holding the scale of the numbers against the model…"));
    data.scales ??= (await get("in/scales").catch(() => ({ findings: [] }))).findings;
    if (data !== asked) return;
    const found = [...data.scales, ...read];
    clear(numbers, found.length && data.own && !data.same ? h("p", { class: "quiet small" }, "Of campaign.toml as it was saved:") : null, doubtNotes(found, mend));
  }

  async function upload(files) {
    clear(faults);
    taking = true;
    const failed = [];
    for (const [i, file] of files.entries()) {
      clear(faults, h("p", { class: "note" }, `Taking in ${file.name} (${i + 1} of ${files.length})`));
      try {
        await put(`files/${encodeURIComponent(file.name)}`, file);
      } catch (fault) {
        failed.push(fault.message);
      }
    }
    clear(
      faults,
      failed.map((text) => note(text, "bad")),
    );
    input.value = "";
    taking = false;
    await load();
  }

  // What was corrected goes to the folder, and the guesses come back anew; what was refused is shown as it was, or with the reason at ``place``.
  async function sent(path, given, place = faults) {
    const found = await context.act(post(path, given), place);
    if (found) {
      clear(faults);
      data = found;
    }
    if (found || place === faults) draw();
    return Boolean(found);
  }
  const wish = (change, place) =>
    inTurn(() => {
      const given = structuredClone(data.wishes);
      change(given);
      return sent("in/wishes", given, place);
    });
  const mend = (column, role) => inTurn(() => sent("in/mend", { column, role }));
  // A cell of campaign.toml itself.
  const correct = (place, value) => inTurn(() => correctNow(place, value));
  // What is refused is shown as it was.
  async function correctNow(place, value) {
    const found = await context.act(post("in/edit", { of: data.cells.of, place, value }), faults);
    if (found) {
      const own = data.own;
      clear(faults);
      data = found;
      // The cells stay: another of them may be in the hand by now.  Of a column with another role each has another place.
      if (!own && place.length !== ROLE.length) {
        judge();
        clear(root.querySelector("#there"), elsewhere());
        clear(root.querySelector("#findings"), findings());
        return;
      }
    }
    draw();
    if (!found) faults.scrollIntoView({ block: "center" });
  }
  const bag = {
    get data() {
      return data;
    },
    get choices() {
      return choices;
    },
    wish,
    mend,
    inTurn,
    putIn: (...given) => putIn(...given),
    context,
    faults,
    load,
    saving: false,
    // Whether each condition may have a mounting of its own.
    mountings: false,
    // Of what no file says, what was asked for as a column of the conditions.
    columns: new Set(),
    // Quantities of which all files are corrected alike.
    together: new Set(),
    redraw: () => draw(),
  };
  const putIn = (part, keys, value) =>
    wish((w) => {
      w[part] = { ...w[part] };
      for (const key of [keys].flat()) {
        if (value === "" || value === null) delete w[part][key];
        else w[part][key] = value;
      }
    });

  function draw() {
    if (!data.files.length && !data.saved) {
      clear(body, empty());
      return;
    }
    if (data.saved && !data.own) {
      const open = [...body.querySelectorAll("details[open]")].map((d) => d.id),
        held = document.activeElement?.id;
      clear(body, numbers, h("div", { id: "there" }, elsewhere()), data.cells ? [conditionCells(data.cells, choices, correct), runCells(data.cells, choices.quantities, correct)] : null, h("div", { id: "findings" }, findings()));
      for (const id of open) if (id) root.querySelector(`#${id}`)?.setAttribute("open", "");
      if (held) document.getElementById(held)?.focus();
      judge();
      return;
    }
    const held = document.activeElement?.id;
    clear(
      body,
      numbers,
      head(),
      data.fault
        ? [
            note(data.fault, "bad"),
            Object.keys(data.wishes).length > 1
              ? h(
                  "button",
                  { type: "button", id: "anew", onclick: () => wish((w) => Object.keys(w).forEach((key) => key !== "reducer" && delete w[key])) },
                  "Begin again with the guesses",
                )
              : null,
          ]
        : null,
      data.gone.map((text) => note(text)),
      data.proposal ? [asides(bag), questions(bag), runs(bag), conditions(bag), saveRow(bag), data.same && data.cells ? runCells(data.cells, choices.quantities, correct) : null, findings(), textOf()] : files(),
    );
    judge();
    if (held) document.getElementById(held)?.focus();
  }

  // A campaign that the page did not write is shown as it is read.
  const elsewhere = () =>
    h(
      "div",
      { class: "panel" },
      data.fault ? note(data.fault, "bad") : null,
      h("h1", {}, data.campaign ? `Campaign ${data.campaign.name}` : "campaign.toml"),
      h("p", { class: "quiet" }, "campaign.toml was written by hand or by the command line: it is used as it stands. What is corrected here changes that alone; comments and all else stay."),
      data.campaign
        ? table(
            ["quantity", "runs", "held out", "conditions", "repetitions"],
            data.campaign.quantities.map((q) => [words(q.quantity), String(q.runs), String(q.held_out), String(q.conditions), String(q.replicates)]),
            [1, 2, 3, 4],
            { class: "rows" },
          )
        : null,
      doubtNotes((data.findings ?? []).filter(ofColumn), mend),
      h(
        "div",
        { class: "row" },
        h(
          "button",
          {
            type: "button",
            class: "main",
            onclick: () => {
              context.go("look");
              context.start("compare");
            },
          },
          "Compare",
        ),
      ),
    );
  // What is found of a column stands where the column does, what is found of numbers above them.
  const ofColumn = (f) => f.column !== undefined;
  const findings = () => {
    const all = (data.findings ?? []).filter((f) => !ofColumn(f) && !f.open),
      found = all.filter((f) => !f.cell),
      told = (f) => note([f.text, f.remedy ? `; ${f.remedy} ` : " ", f.cell ? toCell(f.cell) : ""], f.level === "problem" ? "bad" : "");
    // What one cell answers is no part of a list to be opened.
    return [
      all.filter((f) => f.cell).map(told),
      found.length
        ? h(
            "details",
            { open: found.some((f) => f.level === "problem") || found.length < 4 },
            h("summary", {}, `${found.length} ${found.length < data.findings.length ? "further " : ""}finding${found.length === 1 ? "" : "s"} of the check`),
            found.map(told),
          )
        : null,
    ];
  };

  const chooseFiles = (text = "Choose files") => h("button", { type: "button", class: "main", onclick: () => input.click() }, text);
  const empty = () =>
    h(
      "div",
      { class: "empty drop" },
      h("h1", {}, "Drop what the bench wrote"),
      h(
        "p",
        { class: "lead", style: { margin: "4px auto 14px" } },
        "CSV as it is found (semicolons, decimal commas, any encoding, lines above the table), Excel, Parquet, MAT, MDF or TDMS; files or a folder, several at once. They are copied into this folder and go nowhere else.",
      ),
      chooseFiles(),
    );

  function head() {
    const p = data.proposal,
      sure = p ? p.runs.length : 0;
    const reducers = [...data.models, ...choices.reducers];
    return h(
      "div",
      { class: "panel drop" },
      h(
        "h1",
        {},
        p
          ? `${sure} run${sure === 1 ? "" : "s"} in ${data.files.length} file${data.files.length === 1 ? "" : "s"}, ${Object.keys(p.conditions).length} condition${Object.keys(p.conditions).length === 1 ? "" : "s"}`
          : `${data.files.length} files`,
      ),
      h("p", { class: "quiet" }, "More files can be dropped here at any time."),
      h(
        "div",
        { class: "row" },
        h(
          "label",
          { class: "inline" },
          "reducer that was measured",
          choose(
            [["", "choose…"], ...reducers.map((r) => [r, r])],
            data.wishes.reducer ?? p?.reducer ?? "",
            (value) =>
              wish((w) => {
                w.reducer = value;
              }),
            { id: "measured" },
          ),
        ),
        p?.reducer && data.wishes.reducer === undefined ? h("span", { class: "quiet small", id: "named" }, "as the lines above the tables say") : null,
        h("button", { type: "button", onclick: () => input.click() }, "Add files"),
        h("button", { type: "button", class: "plainly", onclick: () => context.go("reducer") }, "mine is not in the list"),
      ),
    );
  }

  const textOf = () =>
    h("details", {}, h("summary", {}, "campaign.toml and the command that writes the same"), command(data.command), h("pre", { class: "file" }, data.text));
  const files = () =>
    h(
      "div",
      { class: "panel" },
      table(
        ["file", "size", ""],
        data.files.map((f) => [
          f.name,
          `${Math.max(1, Math.round(f.bytes / 1000))} kB`,
          h(
            "button",
            { type: "button", class: "plainly", onclick: () => context.act(drop(`files/${encodeURIComponent(f.name)}`).then(load), faults) },
            "put aside",
          ),
        ]),
        [1],
      ),
    );

  load();
  // Files that the page took in or put aside itself are read by then: drawn anew, a button that is pressed just then would be another one, and do nothing.
  const follow = () => (!taking && data && data.files.length !== context.state.files ? read() : null);
  return { update: () => inTurn(follow) };
}
