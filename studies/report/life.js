"use strict";
(() => {
  const content = JSON.parse(document.getElementById("content").textContent);
  const touch = matchMedia("(hover: none)").matches;
  const config = {
    responsive: true, displaylogo: false, doubleClick: "reset", displayModeBar: touch ? false : "hover",
    modeBarButtonsToRemove: ["select2d", "lasso2d", "autoScale2d", "zoomIn2d", "zoomOut2d", "pan2d"],
  };
  const byName = Object.fromEntries(content.figures.map((figure) => [figure.name, figure]));
  const idOf = (figure) => "plot-" + figure.name;
  const hour = document.getElementById("chosen-hour");
  const disc = document.getElementById("chosen-disc");

  // Traces of a figure at the chosen hour and disc.
  function tracesOf(figure) {
    if (!figure.states.length) return figure.data;
    const rows = figure.states[Math.min(disc ? Number(disc.value) : 0, figure.states.length - 1)];
    const updates = rows[Math.min(hour ? Number(hour.value) : 0, rows.length - 1)];
    const map = figure.rows ? tracesOf(byName[figure.rows])[0].z : [];
    return figure.data.map((trace, i) => {
      const update = typeof updates[i] === "number" ? rows[0][updates[i]] : updates[i];
      return { ...trace, ...update, ...(i < map.length ? { y: map[i] } : {}) };
    });
  }

  for (const figure of content.figures) {
    Plotly.newPlot(idOf(figure), tracesOf(figure), figure.layout, config);
  }

  function choose() {
    const text = content.hours[hour ? Number(hour.value) : 0];
    for (const place of document.querySelectorAll(".now")) place.textContent = text;
    for (const figure of content.figures) {
      if (figure.states.length) Plotly.react(idOf(figure), tracesOf(figure), figure.layout, config);
    }
  }
  if (hour) hour.addEventListener("input", choose);
  if (disc) disc.addEventListener("change", choose);

  // A phone that scrolls over a plot must not zoom it.
  if (touch) {
    for (const figure of content.figures) Plotly.relayout(idOf(figure), { dragmode: false });
  }
  // Plots measure themselves on the screen, so the page takes a sheet's width before it is printed.
  function fit(printing) {
    document.body.classList.toggle("printing", printing);
    for (const figure of content.figures) {
      const place = document.getElementById(idOf(figure));
      // Plots.resize would wait a moment, and the sheet would be printed by then.
      Plotly.relayout(place, printing
        ? { width: place.clientWidth, height: place.clientHeight }
        : { width: null, height: null, autosize: true });
    }
  }
  window.addEventListener("beforeprint", () => fit(true));
  window.addEventListener("afterprint", () => fit(false));
})();
