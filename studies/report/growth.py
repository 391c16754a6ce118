"""Over the hours: depth, rate, places, forces, stiffness, accuracy, and how the run was stepped."""

import math

import numpy as np

from fmu_src.arrays import Floats
from pages import look
from pages.look import Figure, short
from pages.words import capital
from studies.figure_units import OVER_TURN, RUNNING, WINDOW
from studies.report.result import Result

SURFACE_KEYS = [(text, colour, dash) for text, colour, dash in look.SURFACES.values()]
LOAD, SECOND = look.NOW, "#d55e00"


def figures(result: Result) -> list[Figure]:
    """None if there is but one hour; rate and place only of what wears."""
    if len(result.hours) < 2:
        return []
    worn = any(result[name][-1] > 0.0 for name in look.SURFACES)
    return [depths(result), *([rates(result), places(result)] if worn else []),
        small(result, "growth_lag", "Mean lag", "lag [arcsec]", [("mean_lag_arcsec", "second stage", LOAD, "solid"),
              ("mean_lag_at_input_arcsec", "at the input", SECOND, "dash")],
              f"Carrier behind its ideal angle at the set torque, {WINDOW}: wear adds to it like lost motion."),
        small(result, "growth_error", "Transmission error", "peak to peak [arcsec]",
              [(OVER_TURN, "whole, over one turn of the output", LOAD, "solid"),
               ("transmission_error_pp_arcsec", "second stage alone, over one crank turn", SECOND, "dash")],
              "Whole: output less input over the ratio, over one turn of the output, between the first hour and the last as the jumps show it."
              f" Second stage alone: against the cranks, {WINDOW}, so it misses what errors fixed to the ring do elsewhere."),
        small(result, "growth_stiffness", "Torsional stiffness", "stiffness [N m/arcmin]",
              [("torsional_stiffness_Nm_per_arcmin", "second stage", LOAD, "solid")],
              f"Contacts of the second stage alone, {WINDOW}. {capital(RUNNING)}."),
        small(result, "growth_force", "Peak forces", "force [N]", [("peak_pin_force_N", "pin", LOAD, "solid"),
              ("peak_roller_force_N", "roller", SECOND, "dash")], f"Largest force on any pin and on any roller, {WINDOW}."),
        small(result, "growth_pressure", "Peak contact pressure", "Hertz pressure [MPa]",
              [("peak_contact_pressure_MPa", "disc on pin", LOAD, "solid")],
              f"Disc on pin, on the curvature of the flank as made, {WINDOW}."),
        small(result, "growth_teeth", "Loaded teeth", "teeth per disc",
              [("mean_loaded_teeth", "mean over a crank turn", LOAD, "solid")],
              f"Pins that one disc touches, mean {WINDOW}."),
        jumps(result), errors(result),
    ]  # fmt: skip


def marked(x: Floats, y: Floats, colour: str, dash: str, hover: str) -> look.Trace:
    """A line with a marker at every recorded hour."""
    return look.line(short(x, 5), short(y), colour, 1.8, dash, hover) | {
        "mode": "lines+markers", "marker": {"size": 5, "color": colour},
    }


def small(result: Result, name: str, title: str, unit: str, curves: list[tuple[str, str, str, str]], caption: str) -> Figure:
    """Figures of the dataset over the hours."""
    symbol = unit.partition("[")[2].rstrip("]")
    traces = [
        marked(result.hours, result[variable], colour, dash, f"{text}, %{{x:,.0f}} h: %{{y:.4~g}} {symbol}")
        for variable, text, colour, dash in curves
    ]
    values = np.concatenate([result[variable] for variable, *_ in curves])
    finite = values[np.isfinite(values)]
    floor = 0.1 * float(np.abs(finite).max(initial=1e-9))
    spread = [round(v, 6) for v in look.padded(finite, floor, 0.1)]
    picture = look.layout(xaxis=look.hour_axis(result.hours), yaxis=look.axis(unit, range=spread, nticks=6))
    keys = [(text, colour, dash) for _, text, colour, dash in curves] if len(curves) > 1 else []
    return Figure(name, title, caption, traces, picture, 4, 230, keys=keys)


def depths(result: Result) -> Figure:
    """Deepest wear of each kind of surface."""
    traces = [
        marked(result.hours, result[name], colour, dash, f"{text}, %{{x:,.0f}} h: %{{y:.3~g}} µm")
        for name, (text, colour, dash) in look.SURFACES.items()
    ]
    top = round(max(float(result[name][-1]) for name in look.SURFACES), 4) or 1.0
    vertical = look.axis("deepest wear [µm]", range=[-0.03 * top, 1.06 * top])
    picture = look.layout(xaxis=look.hour_axis(result.hours), yaxis=vertical)
    return Figure("growth_depth", "Deepest wear", "Deepest place of each kind of surface.", traces, picture, 6, 300,
                  keys=SURFACE_KEYS)


def rates(result: Result) -> Figure:
    """Growth of the deepest wear between recorded hours."""
    spans = np.diff(result.hours)
    middles = result.hours[:-1] + 0.5 * spans
    traces, top = [], []
    for name, (text, colour, dash) in look.SURFACES.items():
        rate = 1e3 * np.diff(result[name]) / spans
        top.append(rate)
        hover = f"{text}, about %{{x:,.0f}} h: %{{y:.3~g}} µm/1000 h"
        traces.append(marked(middles, np.where(rate > 0.0, rate, np.nan), colour, dash, hover))
    rates_found = np.concatenate(top) if top else np.zeros(0)
    rates_found = rates_found[rates_found > 0.0]
    vertical = look.axis("wear rate [µm per 1000 h]", type="log", tickvals=ticks_of(rates_found))
    if rates_found.size:
        vertical["range"] = [round(v, 3) for v in look.padded(np.log10(rates_found), 0.3)]
    picture = look.layout(xaxis=look.hour_axis(result.hours), yaxis=vertical)
    return Figure("growth_rate", "Wear rate", "Between one recorded hour and the next, logarithmic.", traces, picture,
                  6, 300, keys=SURFACE_KEYS)


def ticks_of(values: np.ndarray) -> list[float]:
    """Ticks of a logarithmic axis: 1, 2, 5 within three decades, else 1 alone."""
    if not values.size:
        return [1.0]
    low, high = math.floor(math.log10(values.min())), math.ceil(math.log10(values.max()))
    steps = (1.0, 2.0, 5.0) if high - low < 4 else (1.0,)
    return [float(f"{step * 10.0**power:.3g}") for power in range(low, high + 1) for step in steps]


def places(result: Result) -> Figure:
    """Where the deepest wear lies."""
    traces, found = [], []
    for name, surface in (("disc_peak_deg", "disc_flank_um"), ("inner_peak_deg", "inner_raceway_um"),
                          ("outer_peak_deg", "outer_raceway_um")):  # fmt: skip
        text, colour, dash = look.SURFACES[surface]
        worn = result[surface] > 0.0
        found.append(result[name][worn])
        hover = f"{text}, %{{x:,.0f}} h: %{{y:.1f}}°"
        traces.append(marked(result.hours[worn], result[name][worn], colour, dash, hover))
    values = np.concatenate(found)
    picture = look.layout(
        xaxis=look.hour_axis(result.hours),
        yaxis=look.axis("angle [°]", range=[round(v, 3) for v in look.padded(values, 10.0, 0.1)], nticks=6),
    )
    caption = (
        "Flank: phase from root (0°) to tip (180°); raceways: from the eccentric direction (inner) and the outward"
        " radial (outer), counted the way the cranks turn."
    )
    return Figure("growth_place", "Place of the deepest wear", caption, traces, picture, 4, 230, keys=SURFACE_KEYS[:3])


def jumps(result: Result) -> Figure:
    """Hours of each jump."""
    spans = np.diff(result.hours)
    trace = {
        "type": "bar", "x": short(result.hours[:-1] + 0.5 * spans, 6), "y": short(spans, 5),
        "width": short(0.86 * spans, 5), "marker": {"color": "#9db9d6"},
        "hovertemplate": "%{y:,.0f} h about %{x:,.0f} h<extra></extra>",
    }  # fmt: skip
    vertical = look.axis("jump [h]", rangemode="tozero", nticks=6)
    picture = look.layout(xaxis=look.hour_axis(result.hours), yaxis=vertical)
    cycles = result.dataset.attrs.get("cycles_simulated")
    caption = "Hours that full meshing cycles stand for"
    caption += f"; {int(cycles)} cycles were simulated for the life." if cycles else "."
    return Figure("growth_jumps", "Jumps of the run", caption, [trace], picture, 4, 230)


def errors(result: Result) -> Figure:
    """Error estimate at each recorded hour against the tolerance of the run."""
    percent = 100.0 * result["error_estimate"][1:]
    traces = [marked(result.hours[1:], percent, LOAD, "solid", "%{x:,.0f} h: %{y:.2~g} %")]
    life = result.inputs.get("life", {})
    tolerance = life.get("tolerance") if isinstance(life, dict) else None
    limit = []
    if tolerance:
        limit = [{"type": "line", "xref": "paper", "x0": 0, "x1": 1, "y0": 100.0 * tolerance, "y1": 100.0 * tolerance,
                  "line": {"color": SECOND, "width": 1.4, "dash": "dash"}}]  # fmt: skip
    top = max([*percent, 100.0 * (tolerance or 0.0), 1e-3])
    vertical = look.axis("share of the depth at the end [%]", range=[0.0, round(1.12 * top, 5)], nticks=6)
    picture = look.layout(xaxis=look.hour_axis(result.hours), yaxis=vertical, shapes=limit)
    keys = [("estimate", LOAD, "solid"), ("tolerance", SECOND, "dash")] if tolerance else []
    return Figure("growth_errors", "Error estimate", "From the same life in fewer jumps.", traces,
                  picture, 4, 230, keys=keys)
