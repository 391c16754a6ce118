// Curves and figures for other programs, pictures for a paper: written into the folder's results.

import { choose, clear, command, h, note, table } from "./dom.js";
import { get } from "./net.js";

const ENDINGS = [
  ["", "Export as…"],
  ["csv", "CSV"],
  ["xlsx", "Excel"],
  ["parquet", "Parquet"],
  ["mat", "MAT"],
  ["svg", "SVG, a paper's column"],
  ["pdf", "PDF, a paper's column"],
  ["png", "PNG, a paper's column"],
];

export const endingName = (ending) => ENDINGS.find(([known]) => known === ending)?.[1].split(",")[0] ?? ending;

// Several may be chosen one after the other: each waits for its turn.
export function exportMenu(context, what, model) {
  const menu = choose(
    ENDINGS,
    "",
    (ending) => {
      menu.value = "";
      if (ending) context.start("export", { what, ending, model: model() });
    },
    { "aria-label": "export as" },
  );
  return menu;
}

// What was exported while this page is open, and where that is told now.
const done = [],
  places = new Map();

// The state of the folder, whichever view is seen: each export that ended is told.
export function hear(state) {
  const job = state.jobs.export;
  if (!job?.begun || !(job.state === "done" || (job.fault && job.state !== "running")) || done.some((one) => one.begun === job.begun)) return;
  const { what, ending } = job.given,
    one = { begun: job.begun, what, ending, fault: job.fault, files: [], command: "" };
  const before = done.findIndex((other) => other.what === what && other.ending === ending);
  if (before >= 0) done.splice(before, 1);
  done.push(one);
  fill(what);
  if (!one.fault)
    get("results/export").then(
      // By now it may be that of the next one.
      (found) => {
        if (found.begun === one.begun) Object.assign(one, { files: found.files, command: found.command });
        fill(what);
      },
      () => {},
    );
}

// What exports of this kind wrote, or why they did not.
export function exported(what) {
  places.set(what, h("div", { class: "exported" }));
  fill(what);
  return places.get(what);
}

function fill(what) {
  if (places.has(what)) clear(places.get(what), done.filter((one) => one.what === what).map(message));
}

function message({ ending, fault, files, command: line }) {
  const name = endingName(ending);
  if (fault) return note(`${name}: ${fault}`, "bad");
  return h(
    "details",
    {},
    h("summary", {}, `${name}: ${files.length ? `${files.length} file${files.length === 1 ? "" : "s"} ` : ""}exported to results/`),
    files.length
      ? table(
          ["file", "size"],
          files.map((f) => [f.name, `${Math.max(1, Math.round(f.bytes / 1000)).toLocaleString("en")} kB`]),
          [1],
        )
      : null,
    command(line),
  );
}
