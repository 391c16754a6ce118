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

export const exportMenu = (context, what, model) =>
  choose(ENDINGS, "", (ending) => ending && context.start("export", { what, ending, model: model() }), { "aria-label": "export as" });

// What the last export of this kind wrote.
export function exported(context, what) {
  const place = h("div"),
    job = context.state?.jobs.export;
  if (job?.given?.what !== what) return place;
  if (job.fault && job.state !== "running") clear(place, note(job.fault, "bad"));
  else if (job.state === "done")
    get("results/export").then(
      (found) =>
        clear(
          place,
          h(
            "details",
            {},
            h("summary", {}, `${found.files.length} file${found.files.length === 1 ? "" : "s"} exported to results/`),
            table(
              ["file", "size"],
              found.files.map((f) => [f.name, `${Math.max(1, Math.round(f.bytes / 1000)).toLocaleString("en")} kB`]),
              [1],
            ),
            command(found.command),
          ),
        ),
      () => {},
    );
  return place;
}
