"use strict";
(() => {
  const content = JSON.parse(document.getElementById("figures").textContent);
  const config = {
    responsive: true, displaylogo: false, doubleClick: "reset",
    modeBarButtonsToRemove: ["select2d", "lasso2d", "autoScale2d", "zoomIn2d", "zoomOut2d", "pan2d"],
  };
  const hour = document.getElementById("hour");
  const disc = document.getElementById("disc");

  // Traces of a figure at the chosen hour and disc.
  function tracesOf(figure) {
    if (!figure.states.length) return figure.data;
    const rows = figure.states[Math.min(disc ? Number(disc.value) : 0, figure.states.length - 1)];
    const updates = rows[Math.min(hour ? Number(hour.value) : 0, rows.length - 1)];
    return figure.data.map((trace, i) => (updates[i] ? { ...trace, ...updates[i] } : trace));
  }

  for (const figure of content.figures) {
    Plotly.newPlot(figure.name, tracesOf(figure), figure.layout, config);
  }

  function choose() {
    const text = content.hours[hour ? Number(hour.value) : 0];
    for (const place of document.querySelectorAll(".now")) place.textContent = text;
    for (const figure of content.figures) {
      if (figure.states.length) Plotly.react(figure.name, tracesOf(figure), figure.layout, config);
    }
  }
  if (hour) hour.addEventListener("input", choose);
  if (disc) disc.addEventListener("change", choose);

  // A phone that scrolls over a plot must not zoom it.
  if (matchMedia("(pointer: coarse)").matches) {
    for (const figure of content.figures) Plotly.relayout(figure.name, { dragmode: false });
  }
  const fit = () => content.figures.forEach((figure) => Plotly.Plots.resize(figure.name));
  window.addEventListener("beforeprint", fit);
  window.addEventListener("afterprint", fit);
})();
