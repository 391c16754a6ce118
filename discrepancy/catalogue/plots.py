"""The picture of an effect's signature: the quantity that shows it best, without it and with each of its cases."""

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import replace

import numpy as np

from discrepancy.catalogue.examples import BACKGROUND, HOUR, Case, picture
from discrepancy.catalogue.signature import (
    ARCSEC,
    MICRO,
    ORDERS,
    SURFACES,
    amplitudes,
    cage_order,
    changed,
    conditions,
    observed,
    rated,
    turn,
    turned,
    worn,
)
from discrepancy.effects import MODULES
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.units import Condition
from fmu_src.arrays import Floats
from pages import look
from pages.charts import COLOURS, Curve, chart
from pages.look import Figure

WITHOUT = "without"
# Grey is the reducer without the effect.
GREY = look.START
CASE_COLOURS = tuple(c for c in COLOURS if c != GREY)
Values = Mapping[str, float]
# Output torque of the loop over the rated one.
LOOP = np.concatenate([np.linspace(0, 1, 25), np.linspace(1, -1, 49)[1:], np.linspace(-1, 1, 49)[1:]])


def versions(name: str, cases: tuple[Case, ...]) -> list[tuple[str, Values]]:
    """What is drawn: the reducer without the effect, then every case."""
    return [(WITHOUT, BACKGROUND.get(name, {})), *((c.title, c.values) for c in cases)]


def colour_of(version: int) -> str:
    return GREY if version == 0 else CASE_COLOURS[(version - 1) % len(CASE_COLOURS)]


def orders(bench: Bench, name: str, cases: tuple[Case, ...]) -> Figure:
    """Bars of the transmission error's orders."""
    at, spectra = rated(bench), []
    if name in MODULES:
        series = turn(bench, at, {})
        spectra = [(WITHOUT, amplitudes(series) * ARCSEC)]
        spectra += [(c.title, amplitudes(changed(bench, name, c, "transmission_error", at, series)) * ARCSEC) for c in cases]
    else:
        spectra = [(label, amplitudes(turn(bench, at, v) * ARCSEC)) for label, v in versions(name, cases)]
    data = [
        {"type": "bar", "name": label, "x": [str(o) for o in ORDERS], "y": look.short(found[list(ORDERS)], 4),
         "marker": {"color": colour_of(i)},
         "hovertemplate": f"{label}: %{{y}} arcsec at order %{{x}}<extra></extra>"}
        for i, (label, found) in enumerate(spectra)
    ]  # fmt: skip
    legend = {"orientation": "h", "x": 0, "y": -0.24, "yanchor": "top", "font": {"size": 11.5}}
    layout = look.layout(
        xaxis=look.axis("order of the output's turn", type="category"), yaxis=look.axis("transmission error [arcsec]"),
        showlegend=True, legend=legend, barmode="group", margin={"l": 60, "r": 20, "t": 10, "b": 46},
    )  # fmt: skip
    return Figure(name, "Orders of the transmission error", "Rated speed and load, one turn of the output.", data, layout, 12, 320)


def curves_of(name: str, cases: tuple[Case, ...], compute: Callable[[Values], tuple[Floats, Floats]]) -> list[Curve]:
    """One curve per version; grey is the reducer without the effect."""
    found = []
    for i, (label, values) in enumerate(versions(name, cases)):
        found.append(Curve(label, *compute(values), colour_of(i)))
    return found


def loop(bench: Bench, name: str, cases: tuple[Case, ...]) -> Figure:
    hot = name == "thermal_expansion"
    at = conditions(bench)["40 K warmer" if hot else "rated"]
    torque = LOOP * bench.rated_load
    if name in MODULES:
        turning = bench.held(at, {}, torque)
        curves = [Curve(WITHOUT, torque, turning * ARCSEC, GREY)]
        curves += [Curve(c.title, torque, turned(bench, name, c, at, torque, turning) * ARCSEC, colour_of(i + 1)) for i, c in enumerate(cases)]
    else:
        curves = curves_of(name, cases, lambda v: (torque, bench.held(at, v, torque) * ARCSEC))
    where = "Input held, torque up and down both ways" + (", 40 K above the reference." if hot else ".")
    return chart(name, "Turning under torque", where, curves, "torque at the output [N m]", "turning [arcsec]", 12, 320)


def torque(bench: Bench, name: str, cases: tuple[Case, ...]) -> Figure:
    at, shares = rated(bench), np.geomspace(0.01, 2.0, 24)

    def against_speed(values: Values) -> tuple[Floats, Floats]:
        found = [observed(bench, "input_torque", replace(at, speed=s * at.speed), values) for s in shares]
        return shares * at.speed * 30.0 / math.pi, np.array(found)

    return chart(name, "Input torque", "Rated load.", curves_of(name, cases, against_speed), "input speed [rpm]",
                 "input torque [N m]", 12, 320, x_axis={"type": "log"})


def cage(bench: Bench, name: str, cases: tuple[Case, ...]) -> Figure:
    at, shares = rated(bench), np.linspace(0.02, 1.5, 24)

    def against_load(values: Values) -> tuple[Floats, Floats]:
        return shares * at.load, np.array([cage_order(bench, replace(at, load=s * at.load), values) for s in shares])

    return chart(name, "Order of the roller cages", "Turns against the disc per turn of the output.",
                 curves_of(name, cases, against_load), "load [N m]", "order", 12, 320)


def wear_against(
    bench: Bench, name: str, cases: tuple[Case, ...], what: str, title: str, x_title: str, places: Sequence[float],
    condition: Callable[[float], Condition], scale: float,
) -> Figure:  # fmt: skip
    """Deepest wear of the surface that changes most, over a setting of the bench."""
    def all_depths(values: Values) -> dict[str, Floats]:
        return {s: np.array([worn(bench, condition(p), values)[s] for p in places]) for s in SURFACES}

    def change(surface: str) -> float:
        first, last = (np.maximum(depths[surface], 1e-12) for _, depths in (found[0], found[-1]))
        ratios: Floats = last / first
        return float(np.abs(np.log(ratios)).max())

    found = [(label, all_depths(v)) for label, v in versions(name, cases)]
    surface = max(SURFACES, key=change)
    curves = [Curve(label, np.array(places) * scale, d[surface], colour_of(i), mode="lines+markers")
              for i, (label, d) in enumerate(found)]
    return chart(name, title, what, curves, x_title, f"{surface.replace('_', ' ')} [um]", 12, 320, x_axis={"type": "log"},
                 y_axis={"type": "log"})


def load_wear(bench: Bench, name: str, cases: tuple[Case, ...]) -> Figure:
    at = rated(bench)
    return wear_against(bench, name, cases, "After 1,000 h at rated speed.", "Wear against load", "load [N m]",
                        [0.1, 0.25, 0.5, 1.0, 1.5], lambda s: replace(at, load=s * at.load), at.load)


def speed_wear(bench: Bench, name: str, cases: tuple[Case, ...]) -> Figure:
    at = rated(bench)
    return wear_against(bench, name, cases, "After as many turns as 1,000 h have at rated speed.", "Wear against speed",
                        "input speed [rpm]", [0.1, 0.2, 0.5, 1.0, 2.0], lambda s: replace(at, speed=s * at.speed),
                        at.speed * 30.0 / math.pi)


def warm_wear(bench: Bench, name: str, cases: tuple[Case, ...]) -> Figure:
    at = rated(bench)
    return wear_against(bench, name, cases, "After 1,000 h at rated speed and load.", "Wear against temperature", "temperature [degC]",
                        [10.0, 20.0, 35.0, 50.0, 70.0], lambda t: replace(at, temperature=t + 273.15), 1.0)


def hours(bench: Bench, name: str, cases: tuple[Case, ...]) -> Figure:
    at, times = rated(bench), np.array([100.0, 200.0, 400.0, 700.0, 1000.0, 2000.0, 3000.0, 4000.0, 5000.0])

    def over_time(values: Values) -> tuple[Floats, Floats]:
        found = [sum(worn(bench, at, values, float(h))[s] for s in ("inner_race", "outer_race")) for h in times]
        return np.append(0.0, times), np.append(0.0, found)

    return chart(name, "Wear over time", "Inner and outer race together, rated speed and load.",
                 curves_of(name, cases, over_time), "operating time [h]", "depth [um]", 12, 320)


def pin_print(bench: Bench, name: str, cases: tuple[Case, ...]) -> Figure:
    def around(values: Values) -> tuple[Floats, Floats]:
        w = bench.worn(rated(bench), values, 1000.0 * HOUR)[0]
        both = (w["pin_wear"] + w["pin_even_wear"][..., None]).sum(axis=0).mean(axis=0)
        return (np.arange(len(both)) + 0.5) / len(both) * 180.0 - 90.0, both * MICRO

    return chart(name, "Wear of a pin", "After 1,000 h; 0 degrees is the pin's inward radial.", curves_of(name, cases, around),
                 "angle on the pin [degrees]", "depth [um]", 12, 320)


def housing(bench: Bench, name: str, cases: tuple[Case, ...]) -> Figure:
    at, shares = rated(bench), np.linspace(0.1, 2.0, 12)

    def against_speed(values: Values) -> tuple[Floats, Floats]:
        found = [amplitudes(turn(bench, replace(at, speed=s * at.speed), values, "housing_force_x"))[39] for s in shares]
        return shares * at.speed * 30.0 / math.pi, np.array(found)

    return chart(name, "Force on the housing, order 39", "Rated load.", curves_of(name, cases, against_speed),
                 "input speed [rpm]", "amplitude [N]", 12, 320)


def burst(bench: Bench, name: str, cases: tuple[Case, ...]) -> Figure:
    def short(values: Values) -> tuple[Floats, Floats]:
        force = turn(bench, rated(bench), values, "housing_force_x")
        part = len(force) // 13
        return np.arange(part) / len(force) * 360.0, force[:part]

    return chart(name, "Force on the housing", "Three turns of the cranks, rated speed and load.", curves_of(name, cases, short),
                 "angle of the output [degrees]", "force [N]", 12, 320)


def trace(bench: Bench, name: str, cases: tuple[Case, ...]) -> Figure:
    """What a sensor makes of the input torque along a run."""
    at = rated(bench)
    series = np.abs(turn(bench, at, {}, "drive_torque"))
    angle = np.linspace(0.0, 360.0, len(series), endpoint=False)
    curves = [Curve(WITHOUT, angle[::16], series[::16], GREY)]
    curves += [Curve(c.title, angle[::16], changed(bench, name, c, "input_torque", at, series)[::16], colour_of(i + 1)) for i, c in enumerate(cases)]
    return chart(name, "Input torque along a run", "Rated speed and load.", curves, "angle of the output [degrees]",
                 "input torque [N m]", 12, 320)


PICTURE: dict[str, Callable[[Bench, str, tuple[Case, ...]], Figure]] = {
    f.__name__: f for f in (orders, loop, torque, cage, load_wear, speed_wear, warm_wear, hours, pin_print, housing, burst, trace)
}


def figure(bench: Bench, name: str, cases: tuple[Case, ...]) -> Figure:
    """The picture of one effect."""
    return PICTURE[picture(name)](bench, name, cases)
