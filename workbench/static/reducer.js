// Reducer: of the library, a file of the folder, or completed from a few numbers; drawn to scale, numbers with unit, source and range.

import { choose, clear, command, h, note, table } from "./dom.js";
import { post } from "./net.js";
import { cards, figure, recolour, warnings } from "./page.js";

export function show(root, context) {
  let data = null,
    form = {},
    known = {},
    made = null,
    // The file that was saved here last.
    saved = "",
    search = "",
    model = context.model(),
    timer = 0;
  const faults = h("div"),
    top = h("div"),
    body = h("div");
  root.append(faults, top, body);

  async function load(name = model) {
    if (!data || name !== model) clear(body, h("p", { class: "quiet", role: "status" }, "Reading the reducer…"));
    model = name;
    const found = await context.act(post("reducer", { model }), faults);
    if (!found) {
      clear(body);
      return;
    }
    clear(faults);
    data = found;
    draw();
  }

  function draw() {
    bar();
    drawBody();
  }

  // Whose numbers stand below, and which model the other views go on with: what is looked at here changes that by a click alone.
  function bar() {
    const all = [...data.files, ...data.library],
      used = context.model();
    clear(
      top,
      h(
        "div",
        { class: "row" },
        h(
          "label",
          { class: "inline" },
          "reducer",
          choose([["", made ? "a new reducer, not saved yet" : "choose…"], ...all.map((r) => [r, r])], made ? "" : model, (v) => {
            made = null;
            load(v);
          }),
        ),
        h(
          "button",
          {
            type: "button",
            id: "new",
            onclick: () => {
              made ??= {};
              draw();
            },
          },
          "Complete one from a few numbers",
        ),
        data.reducer && used !== model && !made
          ? h("button", { type: "button", id: "use", onclick: () => context.choose(model) }, "Use it as the model")
          : null,
        h("span", { class: "quiet", id: "used" }, used ? `Look, Diagnose, Try and Life use ${used}${used === model && !made ? ", this one" : ""}` : "no model is chosen yet for Look, Diagnose, Try and Life"),
      ),
      saved && saved === model && !made
        ? h("p", { class: "note", role: "status", id: "kept" }, `${saved} is in the folder.`, used === saved ? "" : ` The other views stay with ${used || "no model"}, until "Use it as the model" is clicked.`)
        : null,
    );
  }

  function drawBody() {
    if (made) {
      clear(body, newOne());
      return;
    }
    if (!data.reducer) {
      clear(body, h("p", { class: "quiet" }, "Choose a reducer, or complete one from ratio and rated torque."));
      return;
    }
    const r = data.reducer;
    clear(
      body,
      h("h1", {}, r.title),
      h("p", { class: "lead" }, r.lead),
      h(
        "p",
        { class: "quiet" },
        Object.entries(r.counts)
          .filter(([, v]) => v)
          .map(([k, v]) => `${v} ${k}`)
          .join(", "),
        r.speed ? `; ${r.speed}` : "",
      ),
      r.findings.map((t) => note(t, "bad")),
      r.doubts.length ? h("div", { id: "doubts" }, r.doubts.map((t) => note(`doubtful: ${t}`))) : null,
      r.open.length ? h("div", { id: "open-places" }, r.open.map((t) => note(t))) : null,
      h("div", { class: "grid" }, r.figures.map(figure)),
      numbers([...r.added, ...r.numbers]),
    );
  }

  function numbers(rows) {
    const list = h("div");
    const fill = () =>
      clear(
        list,
        table(
          ["number", "value", "unit", "range", "meaning", "source"],
          rows
            .filter((n) => !search || `${n.name} ${n.meaning} ${n.source}`.toLowerCase().includes(search))
            .map((n) => [
              h("code", {}, n.name),
              h("span", { class: n.outside ? "bad" : "" }, n.value),
              n.unit,
              n.range,
              h("span", { class: "small" }, n.meaning),
              h(
                "span",
                { class: "small" },
                n.assumed ? [h("span", { class: "fair" }, n.source.split(":")[0]), n.source.slice(n.source.split(":")[0].length)] : n.source,
              ),
            ]),
          [1],
          { class: "stack2" },
        ),
      );
    fill();
    return h(
      "section",
      {},
      h(
        "div",
        { class: "row spread" },
        h("h2", { style: { margin: 0 } }, `${rows.length} numbers`),
        h("input", {
          type: "search",
          placeholder: "search numbers  ( / )",
          oninput: (e) => {
            search = e.target.value.toLowerCase();
            fill();
          },
        }),
      ),
      h("div", { class: "panel" }, list),
    );
  }

  // Answers at once: each number that is typed draws the reducer anew, or says where it cannot be made.
  function newOne() {
    const result = h("div"),
      said = h("div");
    const ask = async (save = false) => {
      if (!form.ratio || !form.rated) {
        clear(
          result,
          h("p", { class: "quiet" }, "Ratio and rated torque are needed; everything else follows by design rules (40 pins are assumed where nobody counted them), and narrows with what you know."),
        );
        return;
      }
      if (!result.childElementCount || result.firstChild.className === "quiet") clear(result, h("p", { class: "quiet" }, "Completing and checking…"));
      const found = await context.act(post("reducer/new", { ...form, known, save }), said);
      // What is asked for is typed in the table below: it stays, as it was last made.
      const stands = result.childElementCount > 1;
      result.classList.toggle("before", !found && stands);
      if (!found) {
        if (stands) said.append(h("p", { class: "past-note", role: "status" }, "What stands below is the reducer as it could last be made; what is typed there is taken."));
        else clear(result);
        return;
      }
      if (found.saved) {
        made = null;
        saved = found.saved;
        load(saved);
        return;
      }
      clear(
        said,
        found.findings.map((t) => note(t, "bad")),
      );
      const held = document.activeElement?.id;
      clear(
        result,
        h("h1", {}, found.page.title),
        h("p", { class: "quiet" }, `${found.page.conditions}; ${found.page.finding}`),
        cards(found.page.cards),
        warnings(found.page.warnings),
        h("div", { class: "grid" }, found.page.sections.flatMap((s) => s.figures).map(figure)),
        h(
          "div",
          { class: "row" },
          h(
            "label",
            { class: "inline" },
            "name",
            h("input", {
              type: "text",
              value: form.name ?? found.name,
              onchange: (e) => {
                form.name = e.target.value;
              },
            }),
          ),
          h("button", { type: "button", class: "main", id: "save-reducer", onclick: () => ask(true) }, "Save it in the folder"),
        ),
        h("h2", {}, "Every number of its file"),
        h("p", { class: "quiet small" }, "A number that you have measured is typed over; what hangs on it follows."),
        h(
          "div",
          { class: "panel" },
          table(
            ["number", "value", "unit", "range", "by"],
            found.numbers.map((n) => [
              h("code", {}, n.name),
              n.asked
                ? h("input", {
                    type: "text",
                    size: 9,
                    id: `n-${n.name}`,
                    class: n.given ? "changed" : "",
                    value: n.value,
                    "aria-label": n.name,
                    onchange: (e) => {
                      const text = e.target.value.trim().replace(",", ".");
                      if (text) known[n.name] = /[a-zµ%]/i.test(text.replace(/e[-+]?\d+$/i, "")) ? text : `${text}${n.unit}`;
                      else delete known[n.name];
                      ask();
                    },
                  })
                : n.value,
              n.unit,
              n.range,
              h("span", { class: "small" }, n.source),
            ]),
            [],
            { class: "stack2" },
          ),
        ),
        command(found.command),
      );
      if (held) document.getElementById(held)?.focus();
    };
    const fields = data.asked.map(([name, label, unit, needed]) =>
      h(
        "label",
        { class: "inline" },
        `${label}${needed ? " *" : ""}`,
        h("input", {
          type: "text",
          inputmode: "decimal",
          size: 7,
          id: `ask-${name}`,
          value: form[name] ?? "",
          placeholder: { speed: "15", rollers: "16", lost_motion: "1", cranks: "2 or 3" }[name],
          oninput: (e) => {
            form[name] = e.target.value;
            clearTimeout(timer);
            timer = setTimeout(() => ask(), 350);
          },
        }),
        unit,
      ),
    );
    // A gap that is typed below counts for measured; one that the test finds keeps its range.
    const meets = h(
      "label",
      { class: "inline" },
      h("input", {
        type: "checkbox",
        id: "meets-lost-motion",
        checked: form.meets_lost_motion || null,
        onchange: (e) => {
          form.meets_lost_motion = e.target.checked;
          ask();
        },
      }),
      "refuse where no gap, clearance and play within their ranges make the lost motion the catalogue's",
    );
    ask();
    return [h("div", { class: "panel" }, h("h1", {}, "A reducer of which little is known"), h("div", { class: "row" }, fields, meets), said), result];
  }

  load();
  let used = context.model();
  return {
    update(state) {
      if (!data) return;
      if (JSON.stringify(state.models) !== JSON.stringify(data.files) && !made) load();
      else if (used !== context.model()) bar();
      used = context.model();
    },
    recolour: () => recolour(root),
    close: () => clearTimeout(timer),
  };
}
