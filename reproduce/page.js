"use strict";
(() => {
  const figures = JSON.parse(document.getElementById("content").textContent);
  const config = {
    responsive: true, displayModeBar: false, doubleClick: "reset",
  };
  for (const figure of figures) Plotly.newPlot("plot-" + figure.name, figure.data, figure.layout, config);
  const rows = [...document.querySelectorAll("[data-verdict]")];
  const boxes = [...document.querySelectorAll(".filter input")];
  function choose() {
    const shown = new Set(boxes.filter((box) => box.checked).map((box) => box.value));
    for (const row of rows) row.hidden = !shown.has(row.dataset.verdict);
    for (const figure of figures) {
      const place = document.getElementById("plot-" + figure.name);
      if (place.offsetParent) Plotly.Plots.resize(place);
    }
  }
  for (const box of boxes) box.addEventListener("change", choose);
})();
