// A result that is not of what is chosen now: it stays to be looked at, dimmed, and says of which model it is.

import { h } from "./dom.js";

// Why it is past; empty for one that is of the chosen model and of the files as they are.
export function past(result, job, context) {
  if (!result) return "";
  const chosen = context.model(),
    running = job?.state === "running",
    former = job && result.begun !== job.begun,
    anew = running && former ? " It is being computed anew." : "";
  if (chosen && result.model !== chosen) return `What stands below is of ${result.model}; the model that is chosen now is ${chosen}.${anew}`;
  if (anew) return `What stands below is of before.${anew}`;
  if (former && result.begun && !running) return "What stands below is of before: what was computed since came to no result.";
  return job?.old && !running ? `What stands below is of ${result.model} and the files as they were; they have changed since.` : "";
}

// Of a life or of many: of their model alone, for they know no measurements, and one that begins drops what another showed.
export function pastLife(job, context) {
  const model = job?.given?.model;
  return model ? past({ model, begun: job.begun }, { ...job, old: job.old && model.endsWith(".toml") }, context) : "";
}

// The words stand over what they are about.
export const dimmed = (why, ...parts) =>
  why ? [h("div", { class: "row past-note", role: "status" }, h("b", { class: "fair" }, why)), h("div", { class: "past" }, ...parts)] : parts;
