"use strict";
(async () => {
  // plotly.js comes packed.
  const packed = Uint8Array.from(atob(document.getElementById("plotly").textContent), (c) => c.charCodeAt(0));
  const library = document.createElement("script");
  library.textContent = await new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"))).text();
  document.head.append(library);

  const content = JSON.parse(document.getElementById("content").textContent);
  const darkness = matchMedia("(prefers-color-scheme: dark)");
  const onPaper = structuredClone(content.figures);
  const touch = matchMedia("(hover: none)").matches;
  const config = {
    responsive: true, displaylogo: false, doubleClick: "reset", displayModeBar: touch ? false : "hover",
    // A picture for a paper; the command line writes PDF and the width of its column (--picture).
    modeBarButtonsToAdd: [{
      name: "Download as SVG", icon: Plotly.Icons.disk,
      click: async (plot) => {
        if (darkness.matches) repaint(false);
        await Plotly.downloadImage(plot, { format: "svg", filename: plot.id.replace("plot-", "") });
        if (darkness.matches) repaint(true);
      },
    }],
    modeBarButtonsToRemove: ["select2d", "lasso2d", "autoScale2d", "zoomIn2d", "zoomOut2d", "pan2d"],
  };
  const byName = Object.fromEntries(content.figures.map((figure) => [figure.name, figure]));
  const placeOf = (figure) => document.getElementById("plot-" + figure.name);
  const selectOf = (figure) => document.querySelector(`select[data-figure="${figure.name}"]`);
  const hour = document.getElementById("chosen-hour");
  const disc = document.getElementById("chosen-disc");

  // Figures in the colours of the screen, or of paper.
  function paint(dark) {
    paintKeys(dark);
    painted(onPaper, dark).forEach((figure, i) => Object.assign(content.figures[i], figure));
    // A phone that scrolls over a plot must not zoom it.
    if (touch) for (const figure of content.figures) figure.layout.dragmode = false;
  }
  paint(darkness.matches);

  // The chosen entry of a figure with a selector of its own.
  const choiceOf = (figure) => figure.choices[Number(selectOf(figure).value)];

  // Traces of a figure at the chosen hour and disc, or at its own selector's entry.
  function tracesOf(figure) {
    if (figure.choices.length) {
      const choice = choiceOf(figure);
      return figure.data.map((trace, i) => ({ ...trace, ...choice.traces[i] }));
    }
    if (!figure.states.length) return figure.data;
    const rows = figure.states[Math.min(disc ? Number(disc.value) : 0, figure.states.length - 1)];
    const updates = rows[Math.min(hour ? Number(hour.value) : 0, rows.length - 1)];
    const map = figure.rows ? tracesOf(byName[figure.rows])[0].z : [];
    return figure.data.map((trace, i) => {
      const update = typeof updates[i] === "number" ? rows[0][updates[i]] : updates[i];
      return { ...trace, ...update, ...(i < map.length ? { y: map[i] } : {}) };
    });
  }

  // Plotly keeps the user's zoom in the layout: it is shared, but for what a selector changes.
  function layoutOf(figure) {
    return figure.choices.length ? structuredClone({ ...figure.layout, ...choiceOf(figure).layout }) : figure.layout;
  }

  // A card that is too narrow for its names grows.
  function draw(figure) {
    const place = placeOf(figure);
    const fitting = narrowed(figure, tracesOf(figure), layoutOf(figure), place.clientWidth);
    if (!place.style.aspectRatio) place.style.height = fitting.height + "px";
    return Plotly.react(place, fitting.data, fitting.layout, config);
  }

  for (const figure of content.figures) {
    draw(figure);
    if (figure.choices.length) selectOf(figure).addEventListener("change", () => draw(figure));
  }

  let wide = innerWidth;
  addEventListener("resize", () => {
    if (innerWidth === wide) return;
    wide = innerWidth;
    content.figures.forEach(draw);
  });
  const repaint = (dark) => {
    paint(dark);
    content.figures.forEach(draw);
  };
  darkness.addEventListener("change", () => repaint(darkness.matches));

  function choose() {
    const text = content.hours[hour ? Number(hour.value) : 0];
    for (const place of document.querySelectorAll(".now")) place.textContent = text;
    for (const figure of content.figures) if (figure.states.length) draw(figure);
  }
  if (hour) hour.addEventListener("input", choose);
  if (disc) disc.addEventListener("change", choose);

  // Boxes that show and hide what carries their word.
  const boxes = [...document.querySelectorAll(".filter input")];
  function filter() {
    const shown = new Set(boxes.filter((box) => box.checked).map((box) => box.value));
    for (const row of document.querySelectorAll("[data-verdict]")) row.hidden = !shown.has(row.dataset.verdict);
    for (const figure of content.figures) if (placeOf(figure).offsetParent) Plotly.Plots.resize(placeOf(figure));
  }
  for (const box of boxes) box.addEventListener("change", filter);

  // Plots measure themselves on the screen, so the page takes a sheet's width before it is printed.
  function fit(printing) {
    document.body.classList.toggle("printing", printing);
    // Paper is white.
    if (darkness.matches) paint(!printing);
    content.figures.forEach(draw);
    for (const figure of content.figures) {
      const place = placeOf(figure);
      // Plots.resize would wait a moment, and the sheet would be printed by then.
      Plotly.relayout(place, printing
        ? { width: place.clientWidth, height: place.clientHeight }
        : { width: null, height: null, autosize: true });
    }
  }
  window.addEventListener("beforeprint", () => fit(true));
  window.addEventListener("afterprint", () => fit(false));
})();
