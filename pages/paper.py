"""Figures of pages as pictures for a paper: SVG, PDF or PNG, at the width of its columns.

Drawn by matplotlib from what plotly.js draws on the page: lines, markers, bars, bands, heat maps and polar curves.
"""

import re
from collections.abc import Sequence
from importlib.util import find_spec
from pathlib import Path
from textwrap import fill
from typing import Any

from fmu_src.checked_file import replacing
from fmu_src.faults import InputFault, MissingPart
from pages.cells import heat, is_worded, least_height
from pages.fonts import printed
from pages.look import Figure, Layout, Trace
from pages.marks import INCH, SIGN_WIDTH, bars, line_of, polar_curve, spelled
from pages.titles import folded, keep_within, title_of

ENDINGS = (".svg", ".pdf", ".png")
# Widths of a paper's columns [mm]: one, one and a half, both (Elsevier's; IEEE's are 88 and 181).
WIDTHS = {"single": 90.0, "middle": 140.0, "double": 190.0}
NARROWEST, WIDEST = 30.0, 1000.0
# What a column of the page is wide on the screen [px], for a figure's height in proportion; curves have a share of the width, rows of cells some mm, at least.
SCREEN_COLUMN, FLATTEST, LOWEST = 92.0, 0.6, 25.0
# Upright bars have a share of the width, too, for the title of their axis stands beside them.
LOWEST_BARS = 0.5
DOTS = 300
# What the line beside a name of the legend takes [mm].
KEY_WIDTH = 9.0
# What a further line of the legend takes [mm]: the plot keeps its height.
LINE_HEIGHT = 3.6
# Sizes in print, in points.
STYLE = {
    "font.size": 7.5, "axes.labelsize": 7.5, "axes.titlesize": 8, "xtick.labelsize": 7, "ytick.labelsize": 7, "legend.fontsize": 7, "axes.linewidth": 0.6,
    "xtick.major.width": 0.6, "ytick.major.width": 0.6, "xtick.major.size": 2.5, "ytick.major.size": 2.5, "xtick.minor.size": 1.5, "ytick.minor.size": 1.5,
    "svg.fonttype": "path", "pdf.fonttype": 42, "svg.hashsalt": "rvwear",
    "axes.spines.top": False, "axes.spines.right": False, "axes.formatter.useoffset": False, "axes.formatter.use_mathtext": True,
    "grid.color": "#e4e9ee", "grid.linewidth": 0.5,
}  # fmt: skip


def width_of(text: str) -> float:
    """A width [mm] from ``single``, ``middle``, ``double``, ``85``, ``85mm``, ``8.5cm`` or ``3.5in``."""
    if text in WIDTHS:
        return WIDTHS[text]
    match = re.fullmatch(r"([\d.]+)\s*(mm|cm|in)?", text.strip())
    try:
        width = float(match[1]) * {"mm": 1.0, "cm": 10.0, "in": INCH}[match[2] or "mm"] if match else 0.0
    except ValueError:
        width = 0.0
    if not NARROWEST <= width <= WIDEST:
        raise InputFault(f"--width {text}: give {', '.join(WIDTHS)} or a width from {NARROWEST:g} to {WIDEST:g} mm, like 85mm, 8.5cm or 3.5in")
    return width


def require_drawable(path: Path) -> None:
    """Before the work: InputFault for an ending that is none, MissingPart without matplotlib."""
    if path.suffix.lower() not in ENDINGS:
        raise InputFault(f"--picture {path}: the ending says what is drawn: {', '.join(ENDINGS)}")
    if find_spec("matplotlib") is None:
        raise MissingPart(f"--picture {path.name}", "matplotlib", "pictures")


def write_pictures(figures: Sequence[Figure], path: Path, width: float = WIDTHS["single"]) -> list[Path]:
    """The first figure as ``path``, further ones beside it as ``NAME_figure.svg``; the files that were written.  ``width`` in mm.

    What ``NAME`` ends with is not said again: ``turn.svg`` has ``turn_force.svg`` beside it.
    """
    require_drawable(path)
    if not figures:
        raise InputFault(f"--picture {path}: there is nothing to draw in this result")
    written = []
    for k, figure in enumerate(figures):
        own = path if k == 0 else path.with_name(f"{name_beside(path.stem, figure.name.strip('_'))}{path.suffix}")
        save(drawn(figure, width), own)
        written.append(own)
    return written


def name_beside(stem: str, figure: str) -> str:
    first, joint, rest = figure.partition("_")
    return f"{stem}_{rest if joint and f'_{stem}'.endswith(f'_{first}') else figure}"


def save(picture: Any, path: Path) -> None:
    """A picture of ``drawn`` as a file; equal pictures give equal bytes."""
    # What would differ from run to run.
    metadata: dict[str, Any] = {".svg": {"Date": None}, ".pdf": {"CreationDate": None}}.get(path.suffix.lower(), {})
    with replacing(path) as partial, printed(STYLE):
        picture.savefig(partial, format=path.suffix.lower().lstrip("."), dpi=DOTS, metadata=metadata)


def drawn(figure: Figure, width: float = WIDTHS["single"]) -> Any:
    """A matplotlib figure, ``width`` mm wide."""
    from matplotlib.figure import Figure as Picture

    lines = any(trace.get("type") in ("scatter", "scatterpolar") for trace in figure.data)
    height = max(FLATTEST if lines else LOWEST / width, figure.height / (SCREEN_COLUMN * max(figure.columns, 6))) * width
    if any(trace.get("type") == "bar" and trace.get("orientation") != "h" for trace in figure.data):
        height = max(height, LOWEST_BARS * width)
    if figure.aspect:
        across, _, along = figure.aspect.partition("/")
        height = width * float(along or 1.0) / float(across)
    height = max([height, *(least_height(trace, width) for trace in figure.data if trace.get("type") == "heatmap" and is_worded(trace))])
    with printed(STYLE):
        picture = Picture(figsize=(width / INCH, height / INCH), dpi=DOTS, layout="constrained")
        traces = [trace for trace in figure.data if trace.get("visible", True) is True]
        if any(trace.get("type") == "scatterpolar" for trace in traces):
            axes = {"y": picture.add_subplot(projection="polar")}
            for trace in traces:
                polar_curve(axes["y"], trace)
        else:
            axes = cartesian(picture, figure.layout, traces)
        add_legend(picture, axes, figure, traces)
        lowest = list(axes.values())[-1]
        keep_within(picture, lowest)
        if lines and not figure.aspect and "y2" not in axes and "theta" not in traces[0]:
            keep_half(picture, axes["y"])
            keep_within(picture, lowest)
    return picture


def keep_half(picture: Any, axes: Any) -> None:
    """Make the picture as high as its curves need to have at least half of it, however long titles, notes and legend are."""
    picture.draw_without_rendering()
    height = picture.get_figheight()
    picture.set_figheight(max(height, 2.0 * height * (1.0 - axes.get_position().height)))


def cartesian(picture: Any, layout: Layout, traces: Sequence[Trace]) -> dict[str, Any]:
    """Axes for each y axis of the layout, one above the other as their domains are, with all that is drawn in them."""
    names = sorted({str(trace.get("yaxis", "y")) for trace in traces} or {"y"}, key=lambda name: -domain(layout, name)[1])
    shares = [domain(layout, name)[1] - domain(layout, name)[0] for name in names]
    made = picture.subplots(len(names), 1, sharex=len(names) > 1, squeeze=False, gridspec_kw={"height_ratios": shares})[:, 0]
    axes = dict(zip(names, made))
    for name, here in axes.items():
        own = [trace for trace in traces if trace.get("yaxis", "y") == name]
        categories = [trace for trace in own if trace.get("type") == "bar"]
        for trace in own:
            match trace.get("type"):
                case "heatmap":
                    heat(picture, here, trace, INCH * picture.get_figwidth())
                case "bar":
                    bars(here, trace, categories)
                case _:
                    line_of(here, trace)
        finish(here, layout, name, is_lowest=name == names[-1], heated=any(t.get("type") == "heatmap" for t in own))
    return axes


def part_of(name: str, letter: str) -> str:
    return f"{letter}axis{name[1:]}"


def domain(layout: Layout, name: str) -> tuple[float, float]:
    low, high = layout.get(part_of(name, "y"), {}).get("domain", (0.0, 1.0))
    return float(low), float(high)


def finish(axes: Any, layout: Layout, name: str, is_lowest: bool, heated: bool) -> None:
    """Titles, ranges, scales, ticks, rules and notes."""
    x, y = layout.get("xaxis", {}), layout.get(part_of(name, "y"), {})
    for letter, given in (("x", x), ("y", y)):
        if given.get("type") == "log":
            getattr(axes, f"set_{letter}scale")("log")
        if (limits := given.get("range")) and not heated and given.get("type") != "category":
            ends = [10.0**v for v in limits] if given.get("type") == "log" else [float(v) for v in limits]
            getattr(axes, f"set_{letter}lim")(*ends)
        if given.get("tickvals"):
            getattr(axes, f"set_{letter}ticks")(given["tickvals"], given.get("ticktext"))
        elif given.get("dtick") and given.get("type") != "log" and isinstance(given["dtick"], (int, float)):
            from matplotlib.ticker import MultipleLocator

            getattr(axes, f"{letter}axis").set_major_locator(MultipleLocator(float(given["dtick"])))
    if not x.get("visible", True):
        axes.set_axis_off()
    if y.get("scaleanchor"):
        axes.set_aspect("equal")
    if is_lowest:
        axes.set_xlabel(title_of(x))
    axes.set_ylabel(folded(title_of(y), axes))
    if not heated:
        if y.get("autorange") == "reversed":
            axes.invert_yaxis()
        axes.grid(visible=True)
        axes.set_axisbelow(True)
    for shape in layout.get("shapes", []):
        rule(axes, shape, name)
    for note in layout.get("annotations", []):
        if note.get("yref", "y") in (name, "paper", f"{name} domain") and note.get("text") and (note.get("yref") == name or is_lowest or "y2" not in layout):
            # plotly takes such places as powers of ten.
            powers = {k: 10.0 ** note[k] for k, axis in (("x", x), ("y", y)) if axis.get("type") == "log" and "paper" not in str(note.get(f"{k}ref"))}
            add_note(axes, note | powers)


def rule(axes: Any, shape: Layout, name: str) -> None:
    """A straight line over the plot, in data or in shares of it."""
    across, along = shape.get("xref", "x") == "paper", shape.get("yref", "y") in ("paper", f"{name} domain")
    if shape.get("type") != "line" or (not along and shape.get("yref", "y") != name):
        return
    look = shape.get("line", {})
    style = {"color": look.get("color", "#5d6975"), "linewidth": 0.6 * look.get("width", 1.0), "linestyle": ":" if look.get("dash") else "-", "zorder": 1.5}
    if across and not along:
        axes.axhline(shape["y0"], **style)
    elif along and not across:
        axes.axvline(shape["x0"], **style)
    elif not across:
        axes.plot([shape["x0"], shape["x1"]], [shape["y0"], shape["y1"]], **style)


def add_note(axes: Any, note: Layout) -> None:
    """A text beside what it says; placed in data or in shares of the plot."""
    from matplotlib.transforms import blended_transform_factory

    kinds = [axes.transAxes if str(note.get(key, letter)).startswith("paper") or "domain" in str(note.get(key)) else axes.transData
             for key, letter in (("xref", "x"), ("yref", "y"))]  # fmt: skip
    placed = {"left": "left", "right": "right", "center": "center", "auto": "center"}[str(note.get("xanchor", "auto"))]
    upright = {"bottom": "bottom", "top": "top", "middle": "center", "auto": "center"}[str(note.get("yanchor", "auto"))]
    axes.text(note["x"], note["y"], spelled(note["text"]), transform=blended_transform_factory(*kinds), ha=placed, va=upright,
              fontsize=6.5, color=note.get("font", {}).get("color", "#5d6975"), clip_on=False)  # fmt: skip


def add_legend(picture: Any, axes: dict[str, Any], figure: Figure, traces: Sequence[Trace]) -> None:
    """Names of what is drawn, each once, below the plot; or the keys that stand beside the figure on its page."""
    from matplotlib.lines import Line2D

    handles: dict[str, Any] = {}
    if figure.keys:
        for text, colour, dash in figure.keys:
            handles[spelled(str(text))] = Line2D([], [], color=colour, linestyle={"dash": "--", "dot": ":", "dashdot": "-."}.get(dash, "-"))
    elif figure.layout.get("showlegend"):
        for here in axes.values():
            for handle, label in zip(*here.get_legend_handles_labels()):
                handles.setdefault(label, handle)
    if len(handles) > 1:
        room = INCH * picture.get_figwidth()
        # As many beside each other as the width takes; one that alone is wider goes on below.
        texts = [fill(label, max(10, int((room - KEY_WIDTH) / SIGN_WIDTH))) for label in handles]
        widest = KEY_WIDTH + SIGN_WIDTH * max(len(line) for text in texts for line in text.split("\n"))
        columns = max(1, min(len(handles), 3, int(room / widest)))
        picture.legend(list(handles.values()), texts, loc="outside lower center", ncols=columns, frameon=False)
        lines = sum(text.count("\n") + 1 for text in texts) / columns
        picture.set_figheight(picture.get_figheight() + max(0.0, lines - 2.0) * LINE_HEIGHT / INCH)
