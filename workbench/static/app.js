// The frame: views, what is being computed, keys, colours.  What all tabs share comes from the server as it changes.

import { choose, clear, duration, h, note } from "./dom.js";
import { endingName, hear } from "./export.js";
import { post } from "./net.js";
import { recolour } from "./plot.js";
import { waiting } from "./waiting.js";

const VIEWS = { in: "In", look: "Look", diagnose: "Diagnose", try: "Try", reducer: "Reducer", life: "Life" };
const NAMES = Object.keys(VIEWS);
const WORK = {
  compare: "Comparing",
  diagnose: "Diagnosing",
  next: "Looking for the next experiment",
  extend: "Adding the effect",
  build: "Building FMUs",
  export: "Exporting",
  life: "Living",
  ensemble: "Living many times",
};
const KEYS = [
  ["1 … 6", "the views, in their order"],
  ["/", "search"],
  ["?", "this list"],
  ["click", "in a chart: set cursor A, then B, then A again"],
  ["a, b", "in a chart: which cursor the next click sets, and the arrows move"],
  ["← →", "in a chart: move the cursor that was set last; with Shift ten times as far"],
  ["+ − 0", "in a chart: zoom in, out, show all"],
  ["Page ↑ ↓", "in a chart: move along"],
  ["Del", "in a chart: take the cursor away"],
  ["wheel", "in a chart that was clicked: zoom"],
  ["drag", "in a chart: zoom to what is framed; with Shift move along"],
  ["Alt + click", "in a chart: set cursor B"],
];

export const context = { state: null, go, act, start, busy, modelChooser, choose: (model) => chooseModel(model), model: () => context.state?.view?.model || "" };
const main = document.getElementById("view"),
  work = document.getElementById("work"),
  gone = document.getElementById("gone");
// The view that was drawn last, with the place that it alone draws into; it is left as soon as another one is asked for.
let last = null,
  opening = 0;
const current = () => (last?.place.isConnected ? last.view : null);
const loaded = new Set();

// colours ---------------------------------------------------------------------------------
const dark = matchMedia("(prefers-color-scheme: dark)");
let chosen = null;
try {
  chosen = localStorage.getItem("rvwear colours");
} catch {
  /* private window */
}
function paint() {
  document.documentElement.classList.toggle("dark", chosen ? chosen === "dark" : dark.matches);
  recolour();
  current()?.recolour?.();
}
dark.addEventListener("change", paint);
document.getElementById("colours").addEventListener("click", () => {
  chosen = document.documentElement.classList.contains("dark") ? "light" : "dark";
  try {
    localStorage.setItem("rvwear colours", chosen);
  } catch {
    /* private window */
  }
  paint();
});
paint();

// views -----------------------------------------------------------------------------------
const tabs = document.getElementById("tabs");
tabs.append(
  ...NAMES.map((name, i) =>
    h("button", { type: "button", role: "tab", id: `tab-${name}`, "aria-selected": "false", title: `key ${i + 1}`, onclick: () => go(name) }, VIEWS[name]),
  ),
);

export function go(name) {
  if (location.hash === `#${name}`) open(name);
  else location.hash = name;
}

function select(name) {
  for (const other of NAMES) document.getElementById(`tab-${other}`).setAttribute("aria-selected", String(other === name));
  document.getElementById(`tab-${name}`).scrollIntoView({ block: "nearest", inline: "nearest" });
  document.title = `${VIEWS[name]} · ${context.state?.name ?? ""} · rvwear`;
}

async function open(name) {
  const mine = ++opening;
  // A view that was never opened cannot be had from a server that is gone: the one that is seen stays.
  if (!gone.hidden && !loaded.has(name)) {
    if (last) history.replaceState(null, "", `#${last.name}`);
    return;
  }
  select(name);
  // Whatever the view that is left still waits for comes into a place that is no part of the page any more.
  const place = h("div", {}, h("p", { class: "quiet", role: "status" }, "Loading…"));
  clear(main, place);
  const module = await import(`./${name}.js`).catch(() => null);
  if (mine !== opening) return;
  if (!module) {
    lost();
    if (!last) return;
    select(last.name);
    clear(main, last.place);
    return;
  }
  loaded.add(name);
  last?.view.close?.();
  clear(place);
  last = { name, place, view: module.show(place, context) };
  if (context.state) last.view.update?.(context.state);
}
const wanted = () => (NAMES.includes(location.hash.slice(1)) ? location.hash.slice(1) : context.state?.saved ? "look" : "in");
addEventListener("hashchange", () => open(wanted()));

// what goes wrong, said where it is seen -----------------------------------------------------
export async function act(promise, place = null) {
  try {
    return await promise;
  } catch (fault) {
    if (fault.name !== "Fault" && !("message" in fault)) throw fault;
    const text = note(fault.message, "bad");
    if (place) clear(place, text);
    else {
      main.prepend(text);
      setTimeout(() => text.remove(), 12000);
      text.scrollIntoView({ block: "nearest" });
    }
    if (fault.constructor.name !== "Fault") console.error(fault);
    return undefined;
  }
}

// Why nothing else can be started now; empty while nothing is computed.
function busy() {
  const running = Object.entries(context.state?.jobs ?? {}).find(([, job]) => job.state === "running");
  return running ? `${doing(running[0], running[1].given)}: one thing is computed at a time; wait for its end, or stop it above` : "";
}

// Which file is exported says so: several may wait.
const doing = (kind, given) => (kind === "export" && given?.ending ? `${WORK.export} ${endingName(given.ending)}` : WORK[kind]);

// What is clicked while something is computed waits for its end.
const queue = waiting({
  busy,
  act,
  begin: ({ kind, given }) => post(`jobs/${kind}`, given).then(heard),
  changed: () => showWork(context.state.jobs),
  apart: ({ kind }) => kind === "export",
});
export function start(kind, given = {}) {
  return queue.start({ kind, given: { model: context.model(), ...given } });
}

// The model that all views are about, in every tab.
const chooseModel = (model) => act(post("state", { model }).then(heard));

export function modelChooser(label = "model") {
  const state = context.state,
    reducers = state?.library ?? [];
  const known = [...(state?.models ?? []), ...reducers];
  return h(
    "label",
    { class: "inline" },
    label,
    choose([["", "choose…"], ...known.map((m) => [m, m])], context.model(), chooseModel, { id: "model" }),
  );
}

// what is being computed ----------------------------------------------------------------------
function showWork(jobs) {
  const running = Object.entries(jobs).find(([, job]) => job.state === "running");
  work.hidden = !running;
  if (!running) {
    work.replaceChildren();
    return;
  }
  const [kind, job] = running,
    task = [...job.tasks].reverse().find((t) => t.total) ?? job.tasks.at(-1),
    inner = job.tasks.at(-1);
  const bar = h("progress", task?.total ? { max: task.total, value: task.done, "aria-label": task.what } : { "aria-label": "at work" });
  const said = job.said.at(-1),
    // Of a step alone "about 1 s left" would be read as the end.
    step = inner ? `${inner.sentence}${job.whole ? `; in all ${job.whole} left` : ""}` : "starting";
  clear(
    work,
    h("b", {}, doing(kind, job.given)),
    bar,
    h(
      "span",
      { class: "doing", title: [step, said && `so far: ${said}`].filter(Boolean).join("\n") },
      step,
      said ? h("span", { class: "quiet" }, ` · so far: ${said}`) : null,
    ),
    h("span", { class: "quiet" }, job.seconds ? duration(job.seconds) : ""),
    h("button", { type: "button", id: "stop", onclick: () => act(post(`jobs/${kind}/stop`)) }, kind === "life" ? "Pause" : "Stop"),
    queue.waits.length
      ? h(
          "span",
          { id: "waits" },
          "then: ",
          queue.waits.map((one, i) => [
            i ? ", " : "",
            `${doing(one.kind, one.given)} `,
            h("button", { type: "button", class: "plainly", onclick: () => queue.leave(one) }, "leave it"),
          ]),
        )
      : null,
  );
}

function heard(state) {
  const first = !context.state;
  context.state = state;
  document.getElementById("folder").textContent = state.name;
  document.getElementById("folder").title = state.folder;
  showWork(state.jobs);
  hear(state);
  queue.heard();
  if (first) open(wanted());
  else current()?.update?.(state);
  return state;
}

const events = new EventSource("events");
events.onmessage = (event) => {
  gone.hidden = true;
  heard(JSON.parse(event.data));
};
events.onerror = lost;

function lost() {
  gone.hidden = false;
  clear(
    gone,
    "The server is gone. What was found is in the folder. Start it again with ",
    h("code", {}, `rvwear workbench ${JSON.stringify(context.state?.folder ?? "FOLDER")}`),
    " and open the address that it prints: every start has a new one.",
  );
  // Nobody tells any more how far it is.
  work.hidden = true;
}

// Whatever is clicked then, the word is seen that says why nothing happens.
addEventListener(
  "click",
  () => {
    if (gone.hidden) return;
    gone.classList.remove("again");
    requestAnimationFrame(() => gone.classList.add("again"));
  },
  true,
);

// keys ----------------------------------------------------------------------------------------
const help = document.getElementById("help");
const showKeys = () => {
  clear(
    help,
    h("h2", {}, "Keys"),
    h(
      "table",
      {},
      h(
        "tbody",
        {},
        KEYS.map(([key, what]) => h("tr", {}, h("td", {}, h("kbd", {}, key)), h("td", {}, what))),
      ),
    ),
    h("p", { class: "row" }, h("button", { type: "button", onclick: () => help.close() }, "Close")),
  );
  help.showModal();
};
document.getElementById("keys").addEventListener("click", showKeys);
addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || help.open) return;
  const typing = event.target.closest?.("input, select, textarea");
  if (typing) {
    if (event.key === "Escape") typing.blur();
    return;
  }
  const place = Number(event.key) - 1;
  if (NAMES[place]) {
    go(NAMES[place]);
    event.preventDefault();
  } else if (event.key === "?") showKeys();
  else if (event.key === "/") {
    const search = main.querySelector("input[type=search]");
    if (search) {
      search.focus();
      event.preventDefault();
    }
  }
});
