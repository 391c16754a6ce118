"""Over one crank turn: forces on all pins and rollers, lag, torque, loaded teeth.

These figures follow the page's selectors of hour and disc; the first recorded hour
stays beside or behind for comparison.
"""

from collections.abc import Callable

import numpy as np

from fmu_src.arrays import Floats
from pages import look
from pages.look import Figure, short
from pages.words import hour_text, number
from studies.report.result import ARCSEC, Result

MOST_POSITIONS = 120


def figures(result: Result) -> list[Figure]:
    """Maps of the start stand beside those of the chosen hour, if there is more than one."""
    ways = (False,) if alone(result) else (True, False)
    maps = [[make(result, at_start) for at_start in ways] for make in (pin_map, roller_map)]
    return [*maps[0], pin_lines(result), *maps[1], *turn_curves(result)]


def every(result: Result) -> slice:
    """The positions that are drawn."""
    return slice(None, None, max(1, -(-result.dataset.sizes["position"] // MOST_POSITIONS)))


def turned(result: Result, share: float = 1.0) -> np.ndarray:
    """Crank angle since the start of the turn, counted the way it turns [deg].

    ``share`` 0.5: in the middle of each communication step, which mean forces stand for.
    """
    count = result.dataset.sizes["position"]
    return (360.0 * (np.arange(count) + share) / count)[every(result)]


def crank_axis(step: float = 60.0) -> look.Layout:
    return look.angle_axis("crank angle [°]", 0.0, 360.0, step)


def alone(result: Result) -> bool:
    """Whether there is but one hour and nothing to compare."""
    return len(result.shown) == 1


def compared(at_start: bool) -> tuple[str, str]:
    """(end of a figure's name, hour in its title)."""
    return ("_start", "start") if at_start else ("", "now")


def states_of(
    result: Result, at_start: bool, update: Callable[[int, int], list[look.Trace | int | None]]
) -> list[list[list[look.Trace | int | None]]]:
    """``update(disc, entry)`` for every disc and shown hour; the first hour only ``at_start``."""
    shown = result.shown[:1] if at_start else result.shown
    return [[update(d, i) for i in shown] for d in range(result.topology.discs)]


def heat_map(rows: list[int] | list[str], z_max: float, result: Result, hover: str) -> look.Trace:
    """A heat map over the crank angle that waits for its ``z``."""
    return {
        "type": "heatmap", "x": short(turned(result, 0.5)), "y": rows, "zmin": 0, "zmax": round(z_max, 3),
        "colorscale": look.colour_scale(look.FORCE), "hovertemplate": hover + "<extra></extra>",
        "colorbar": {
            "thickness": 9, "len": 1.0, "outlinewidth": 0, "xpad": 4,
            "tickfont": {"size": 11, "color": look.QUIET},
            "title": {"text": "N", "side": "top", "font": {"size": 11, "color": look.QUIET}},
        },
    }  # fmt: skip


def pin_map(result: Result, at_start: bool) -> Figure:
    """Force on every pin over the crank angle."""
    end, when = compared(at_start)
    pins = list(range(1, result.topology.pins + 1))
    trace = heat_map(pins, float(result["mesh_force"][result.shown].max()), result,
                     "pin %{y}, crank %{x:.0f}°: %{z:.0f} N")

    def update(d: int, i: int) -> list[look.Trace | int | None]:
        return [{"z": short(result["mesh_force"][i][every(result), d, :].T, 3)}]

    picture = look.layout(
        xaxis=crank_axis(), yaxis=look.axis("pin", range=[0.5, len(pins) + 0.5], nticks=6),
        margin={"l": 56, "r": 4, "t": 10, "b": 46},
    )
    first, last = (number(result["mesh_force"][i].max()) for i in (result.shown[0], result.shown[-1]))
    caption = "The loaded part of the ring travels round once per crank turn." if at_start or alone(result) else (
        f"The same colours: at most {first} N at {{start}}, {last} N at {hour_text(result.hours[-1])}."
    )
    return Figure(f"pin_map{end}", f"Force on every pin, {{{when}}}", caption, [trace], picture, 6, 340,
                  states=states_of(result, at_start, update))


def pin_lines(result: Result) -> Figure:
    """Force of each pin over the crank angle, and the largest of all then and now."""
    x = short(turned(result, 0.5))
    t = result.topology
    thin = [look.line(x, [], look.NOW, 0.8, opacity=0.45, hover=f"pin {j + 1}: %{{y:.0f}} N") for j in range(t.pins)]
    traces = [*thin, look.line(x, [], look.START, 2.4, hover="largest, start: %{y:.0f} N"),
              look.line(x, [], look.NOW, 2.4, hover="largest: %{y:.0f} N")]

    def update(d: int, i: int) -> list[look.Trace | int | None]:
        largest = result["mesh_force"][i][every(result), d, :].max(axis=1)
        return [*[None] * t.pins, t.pins + 1, {"y": short(largest)}]

    top = float(result["mesh_force"][result.shown].max())
    vertical = look.axis("force on a pin [N]", range=[0.0, round(1.06 * top, 2)], automargin=False)
    picture = look.layout(xaxis=crank_axis(), yaxis=vertical)
    return Figure(
        "pin_lines", "Force on every pin over the crank turn, {now}",
        "One thin line per pin, each loaded once per crank turn; bold: the largest force on any pin of the disc.",
        traces, picture, 12, 300, keys=[("one pin", look.NOW, "thin"), ("largest", look.NOW, "solid")]
        + [("largest, {start}", look.START, "solid")] * (not alone(result)),
        states=states_of(result, False, update), rows_of="pin_map",
    )  # fmt: skip


def roller_map(result: Result, at_start: bool) -> Figure:
    """Force on every roller of a disc's bearings over the crank angle."""
    end, when = compared(at_start)
    t = result.topology
    # One empty row between the bearings.
    row_names: list[str] = []
    for c in range(t.cranks):
        row_names += [f"crank {c + 1}, roller {k + 1}" for k in range(t.rollers)] + [" " * (c + 1)]
    row_names.pop()
    trace = heat_map(row_names, float(result["roller_force"][result.shown].max()), result,
                     "%{y}, crank %{x:.0f}°: %{z:.0f} N")

    def update(d: int, i: int) -> list[look.Trace | int | None]:
        force = result["roller_force"][i][every(result), d]
        rows = []
        for c in range(t.cranks):
            rows += [*short(force[:, c, :].T, 3), [None] * force.shape[0]]
        return [{"z": rows[:-1]}]

    middle = [c * (t.rollers + 1) + (t.rollers - 1) / 2 for c in range(t.cranks)]
    picture = look.layout(
        xaxis=crank_axis(), margin={"l": 56, "r": 4, "t": 10, "b": 46},
        yaxis=look.axis("roller", type="category", tickvals=middle, ticks="", tickangle=-90,
                        ticktext=[f"crank {c + 1}" for c in range(t.cranks)]),
    )  # fmt: skip
    loaded = (result["roller_force"] > 0.0).sum(axis=4)
    first, last = (number(loaded[i].mean()) for i in (result.shown[0], result.shown[-1]))
    caption = "Each row is one roller: it takes load while it passes the loaded side of its bearing." if (
        at_start or alone(result)
    ) else (
        f"The same colours; a bearing has {first} loaded rollers on average at {{start}}, {last} at"
        f" {hour_text(result.hours[-1])}."
    )
    return Figure(f"roller_map{end}", f"Force on every roller, {{{when}}}", caption, [trace], picture, 6, 340,
                  states=states_of(result, at_start, update))


def turn_curves(result: Result) -> list[Figure]:
    """Six small figures: series over the crank turn, first hour grey, selected hour blue."""
    lag = ARCSEC * result["lag"]
    return [
        curve(result, "turn_lag", "Lag", "lag [arcsec]", lag, "Carrier behind its ideal angle, second stage alone."),
        curve(result, "turn_error", "Transmission error, second stage alone", "lag less its mean [arcsec]",
              lag - lag.mean(axis=1, keepdims=True),
              "The part of the lag that comes and goes with each turn of the cranks."),
        curve(result, "turn_pin_force", "Largest pin force", "force [N]", result["largest_pin_force"],
              "The most loaded pin of all discs at each position."),
        curve(result, "turn_pressure", "Largest contact pressure", "Hertz pressure [MPa]",
              1e-6 * result["contact_pressure"], "Between disc and pin, at the worst contact of each position."),
        curve(result, "turn_teeth", "Loaded teeth", "teeth in contact", result["loaded_teeth"],
              "Pins that the selected disc touches.", step=True),
        curve(result, "turn_torque", "Input torque", "torque [N m]", result["drive_torque"],
              "Torque that holds the input against the load."),
    ]  # fmt: skip


def curve(
    result: Result, name: str, title: str, unit: str, series: Floats, caption: str, step: bool = False
) -> Figure:
    """One series over the turn; a third dimension is the disc's."""
    x = short(turned(result))
    unit_text = unit.partition("[")[2].rstrip("]")
    hover = f"%{{x:.0f}}°: %{{y:.4~g}} {unit_text}"
    traces = [look.line(x, [], look.START, 1.8, hover="start, " + hover), look.line(x, [], look.NOW, 1.8, hover=hover)]
    for trace in traces if step else ():
        trace["line"] = trace["line"] | {"shape": "hv"}

    def update(d: int, i: int) -> list[look.Trace | int | None]:
        row = series[i][every(result)]
        return [1, {"y": short(row if row.ndim == 1 else row[:, d], 6)}]

    discs = result.topology.discs if series.ndim == 3 else 1
    states = [[update(d, i) for i in result.shown] for d in range(discs)]
    floor = 1.0 if step else 1e-3 * float(np.abs(series[result.shown]).max())
    spread = [round(v, 6) for v in look.padded(series[result.shown], floor)]
    picture = look.layout(xaxis=crank_axis(90.0), yaxis=look.axis(unit, range=spread, nticks=6))
    return Figure(name, title, caption, traces, picture, 4, 230, states=states)
