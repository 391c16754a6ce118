"""The signature of an effect: what the virtual bench shows with it, beside what it shows without.

Orders are those of one turn of the output.  Amplitudes of the transmission error are
given in arcsec, lost motion and the mean by which the output stays behind in arcsec, depths in um.
"""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from discrepancy.catalogue.examples import BACKGROUND, HOUR, Case, part_of
from discrepancy.effects import MODULES, STARTS
from discrepancy.model_file import every_effect
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.chain import ASKED
from discrepancy.prediction.observe import OBSERVED
from discrepancy.prediction.units import Condition
from discrepancy.problem import Record
from fmu_src.arrays import Floats
from reducers.reducer import load_reducer
from studies.coupled import COLUMNS
from studies.hysteresis import LOST_MOTION_SHARE
from studies.wear_figures import peak_of_circle

# Rigid supports and no losses: an effect shows by itself.
IDEAL = "RV20E-121-rigid"
ORDERS = (1, 2, 39, 40, 78, 80, 120, 121, 156, 234, 279, 361, 1440, 1560)
# Samples of one turn of the output; the mesh's order 1560 needs more than 3120.
SAMPLES = 4096
ARCSEC = math.degrees(1.0) * 3600.0
MICRO = 1e6
WARMER = 40.0
# Hours at rated speed to which wear is run, and for growth in time.
WEAR_HOURS, LATE_HOURS = 1000.0, 5000.0
SURFACES = ("flank", "pin", "inner_race", "outer_race")


# In place of a stiffness: what somebody's law makes of the turning falls with the torque.
TURNS_BACK = "none: the curve turns back"


@dataclass(frozen=True)
class Row:
    """One figure at one condition, without and with the effect."""

    figure: str
    unit: str
    condition: str
    without: float
    present: float

    @property
    def change(self) -> float:
        return self.present - self.without

    @property
    def texts(self) -> tuple[str, str]:
        """Without and with the effect; a secant that does not rise is no stiffness."""
        rises = self.figure.startswith("stiffness")
        without, present = (TURNS_BACK if rises and not value > 0.0 else number(value) for value in (self.without, self.present))
        return without, present

    def is_visible(self) -> bool:
        """More than half a percent, and more than rounding."""
        floor = {"arcsec": 0.1, "N": 0.1, "N m": 1e-4, "um": 1e-4, "K": 0.01}.get(self.unit, 1e-6)
        return abs(self.change) > max(0.005 * abs(self.without), floor)


@dataclass(frozen=True)
class Signature:
    """All figures of one case of an effect."""

    effect: str
    case: Case
    rows: tuple[Row, ...]

    @property
    def shows(self) -> bool:
        """Whether anything changes that could be seen."""
        return any(r.is_visible() for r in self.rows)

    def row(self, figure: str, condition: str = "rated") -> Row:
        return next(r for r in self.rows if r.figure == figure and r.condition == condition)


def new_bench(reducer: str = IDEAL) -> Bench:
    return Bench(load_reducer(reducer), {})


def rated(bench: Bench) -> Condition:
    return Condition(bench.rated_speed, bench.rated_load)


def conditions(bench: Bench) -> dict[str, Condition]:
    """The bench's settings by name."""
    at = rated(bench)
    return {
        "rated": at, "load 10 %": replace(at, load=0.1 * at.load), "load 25 %": replace(at, load=0.25 * at.load),
        "load 150 %": replace(at, load=1.5 * at.load), "no load": replace(at, load=0.0),
        "speed 10 %": replace(at, speed=0.1 * at.speed), "speed 20 %": replace(at, speed=0.2 * at.speed),
        "speed 200 %": replace(at, speed=2.0 * at.speed), "40 K warmer": replace(at, temperature=at.temperature + WARMER),
    }  # fmt: skip


def turn(bench: Bench, condition: Condition, values: Mapping[str, float], column: str = "transmission_error") -> Floats:
    """One turn of the output, SAMPLES long."""
    angles = np.linspace(0.0, 2.0 * math.pi, SAMPLES, endpoint=False)
    return bench.running(condition, values, angles)[:, COLUMNS.index(column)]


def amplitudes(series: Floats) -> Floats:
    """Amplitude of every order of a series over one whole turn."""
    return 2.0 * np.abs(np.fft.rfft(series)) / len(series)


def record_of(quantity: str, condition: Condition, axes: Mapping[str, Floats] | None = None, **tags: str) -> Record:
    """A record to be predicted at a condition."""
    axes = axes or {}
    count = max((len(a) for a in axes.values()), default=1)
    factors = {"speed": condition.speed, "load": condition.load, "temperature": condition.temperature,
               "hours": condition.hours, "direction": condition.direction}  # fmt: skip
    return Record(quantity, quantity, "", "", 1, np.zeros(count), axes, factors, tags=tags)


def observed(bench: Bench, quantity: str, condition: Condition, values: Mapping[str, float]) -> float:
    return float(OBSERVED[quantity](bench, record_of(quantity, condition), values)[0])


def low_torque_stiffness(bench: Bench, condition: Condition, values: Mapping[str, float]) -> float:
    """Secant between 5 and 20 % of the rated torque [N m/rad]."""
    torque = np.array([0.0, 0.05, 0.2]) * bench.rated_load
    turning = bench.held(condition, values, torque)
    return float((torque[2] - torque[1]) / (turning[2] - turning[1]))


def loop_width(bench: Bench, condition: Condition, values: Mapping[str, float]) -> float:
    """Distance of the closed loop's branches at half the rated torque [rad]."""
    up = np.linspace(0.0, 1.0, 9)
    way = np.concatenate([up, up[-2::-1], -up[1:], -up[-2::-1], up[1:]])
    turning = bench.held(condition, values, way * bench.rated_load)
    half = len(up) // 2
    return float(turning[2 * len(up) - 2 - half] - turning[len(way) - 1 - half])


def cage_order(bench: Bench, condition: Condition, values: Mapping[str, float]) -> float:
    """Turns of a cage against its disc per turn of the output."""
    return observed(bench, "cage_speed", condition, values) * abs(bench.ratio) / condition.speed


def depths(wear: Floats) -> dict[str, float]:
    """Deepest wear [m] of each kind of surface: the worst disc's mean lobe, the mean pin, the worst race."""
    w = wear[0]
    discs = w["disc_wear"].shape[0]
    lobes = w["disc_wear"].reshape(discs, -1, w["slide"].shape[0]).mean(axis=1)
    pins = (w["pin_wear"] + w["pin_even_wear"][..., None]).sum(axis=0).mean(axis=0)
    found = {"flank": float(peak_of_circle(lobes)[0]), "pin": float(pins.max())}
    for surface in ("inner_race", "outer_race"):
        races = w[f"{surface}_wear"].reshape(-1, w[f"{surface}_wear"].shape[-1])
        found[surface] = float(peak_of_circle(races)[0])
    return found


def worn(bench: Bench, condition: Condition, values: Mapping[str, float], hours: float = WEAR_HOURS) -> dict[str, float]:
    """Depths [um] after as many turns as ``hours`` have at rated speed."""
    time = hours * HOUR * bench.rated_speed / condition.speed
    return {k: v * MICRO for k, v in depths(bench.worn(condition, values, time)).items()}


# figure: (unit, conditions, factor to the unit, function).
FIGURES: dict[str, tuple[str, tuple[str, ...], float, Callable[[Bench, Condition, Mapping[str, float]], float]]] = {
    "lost motion": ("arcsec", ("rated", "40 K warmer"), ARCSEC, lambda b, c, v: observed(b, "lost_motion", c, v)),
    "loop width at half torque": ("arcsec", ("rated",), ARCSEC, loop_width),
    "stiffness": ("N m/arcmin", ("rated", "40 K warmer"), 60.0 / ARCSEC, lambda b, c, v: observed(b, "torsional_stiffness", c, v)),
    "stiffness at low torque": ("N m/arcmin", ("rated", "40 K warmer"), 60.0 / ARCSEC, low_torque_stiffness),
    "input torque": ("N m", ("rated", "no load", "load 10 %", "speed 10 %", "speed 200 %", "40 K warmer"), 1.0,
                     lambda b, c, v: observed(b, "input_torque", c, v)),
    "cage order": ("1", ("rated", "load 10 %"), 1.0, cage_order),
    "temperature": ("K", ("rated", "speed 200 %"), 1.0, lambda b, c, v: b.average("reducer_temperature", c, v)),
}  # fmt: skip
SPECTRUM_AT = ("rated", "load 25 %")
# Further conditions of effects of the measuring chain that only other speeds show.
SHOWN_BY_SPEED = {"torsional_resonance": ("speed 20 %", "speed 200 %")}
WEAR_AT = ("load 10 %", "load 150 %", "speed 20 %", "speed 200 %", "40 K warmer")


def signature(bench: Bench, name: str, case: Case) -> Signature:
    """Everything that an effect changes, at one strength."""
    base = BACKGROUND.get(name, {})
    if name in MODULES:
        return Signature(name, case, tuple(chain_rows(bench, name, case)))
    rows = spectrum_rows(bench, base, case.values)
    at = conditions(bench)
    for figure, (unit, where, factor, compute) in FIGURES.items():
        for c in where:
            pair = (factor * compute(bench, at[c], v) for v in (base, case.values))
            rows.append(Row(figure, unit, c, *pair))
    rows += wear_rows(bench, base, case.values, "wear" in part_of(name))
    if "grease_age" in {p.variable.name for p in every_effect()[name].parameters}:
        aged = replace(at["rated"], hours=LATE_HOURS * HOUR)
        rows.append(Row("input torque", "N m", f"{LATE_HOURS:g} h",
                        *(observed(bench, "input_torque", aged, v) for v in (base, case.values))))
    return Signature(name, case, tuple(rows))


def spectrum_rows(bench: Bench, base: Mapping[str, float], values: Mapping[str, float]) -> list[Row]:
    """Orders and mean of the transmission error, and order 39 of the force on the housing."""
    rows, at = [], conditions(bench)
    for c in SPECTRUM_AT:
        series = [turn(bench, at[c], v) * ARCSEC for v in (base, values)]
        without, present = map(amplitudes, series)
        rows += [Row(f"TE order {o}", "arcsec", c, without[o], present[o]) for o in ORDERS]
        rows.append(Row("mean TE (behind)", "arcsec", c, -series[0].mean(), -series[1].mean()))
        rows.append(Row("TE peak to peak", "arcsec", c, np.ptp(series[0]), np.ptp(series[1])))
    for c in ("rated", "load 25 %", "speed 200 %"):
        force = [amplitudes(turn(bench, at[c], v, "housing_force_x"))[39] for v in (base, values)]
        rows.append(Row("housing force order 39", "N", c, *force))
    return rows


def wear_rows(bench: Bench, base: Mapping[str, float], values: Mapping[str, float], everywhere: bool) -> list[Row]:
    """Depths after as many turns; for effects of the wear unit at all conditions and with time."""
    at, rows = conditions(bench), []
    for c in ("rated", *(WEAR_AT if everywhere else ())):
        pair = [worn(bench, at[c], v) for v in (base, values)]
        rows += [Row(f"{s} depth", "um", c, pair[0][s], pair[1][s]) for s in SURFACES]
    if everywhere:
        growth = [{s: d[1][s] - d[0][s] for s in SURFACES} for d in (
            [worn(bench, at["rated"], v, h) for h in (LATE_HOURS - WEAR_HOURS, LATE_HOURS)] for v in (base, values))]
        rows += [Row(f"{s} depth", "um", f"{LATE_HOURS - WEAR_HOURS:g} to {LATE_HOURS:g} h", growth[0][s], growth[1][s]) for s in SURFACES]
    return rows


def chain_rows(bench: Bench, name: str, case: Case) -> list[Row]:
    """What a sensor makes of the transmission error and of the input torque."""
    if MODULES[name].EFFECT.signals == ("hysteresis",):
        return held_rows(bench, name, case)
    rows, at = [], conditions(bench)
    for c in (*SPECTRUM_AT, *SHOWN_BY_SPEED.get(name, ())):
        series = turn(bench, at[c], {})
        shown = changed(bench, name, case, "transmission_error", at[c], series)
        without, present = (ARCSEC * amplitudes(s) for s in (series, shown))
        rows += [Row(f"TE order {o}", "arcsec", c, without[o], present[o]) for o in ORDERS]
    for c in SPECTRUM_AT:
        torque = np.abs(turn(bench, at[c], {}, "drive_torque"))
        shown = changed(bench, name, case, "input_torque", at[c], torque)
        rows.append(Row("input torque", "N m", c, torque.mean(), shown.mean()))
        rows.append(Row("rise of torque in a run", "N m", c, *(tilt(s) for s in (torque, shown))))
    return rows


def held_rows(bench: Bench, name: str, case: Case) -> list[Row]:
    """What a rig makes of a held output's turning."""
    torque = bench.rated_load * np.array([LOST_MOTION_SHARE, -LOST_MOTION_SHARE, 0.05, 0.2, 0.5, 1.0])
    turning = bench.held(rated(bench), {}, torque)
    seen = [(y[0] - y[1], (torque[3] - torque[2]) / (y[3] - y[2]), (torque[5] - torque[4]) / (y[5] - y[4]))
            for y in (turning, turned(bench, name, case, rated(bench), torque, turning))]  # fmt: skip
    figures = (("lost motion", "arcsec", ARCSEC), ("stiffness at low torque", "N m/arcmin", 60.0 / ARCSEC), ("stiffness", "N m/arcmin", 60.0 / ARCSEC))
    return [Row(figure, unit, "rated", factor * without, factor * present) for (figure, unit, factor), without, present in zip(figures, *seen)]


def changed(bench: Bench, name: str, case: Case, quantity: str, condition: Condition, series: Floats) -> Floats:
    """A series over one turn as the sensor shows it."""
    record = record_of(quantity, condition, {"angle": np.linspace(0.0, 2.0 * math.pi, len(series), endpoint=False)})
    return as_shown(bench, name, case, record, series)


def turned(bench: Bench, name: str, case: Case, condition: Condition, torque: Floats, turning: Floats) -> Floats:
    """A held output's ``turning`` [rad] under torques [N m] as the rig shows it."""
    return as_shown(bench, name, case, record_of("hysteresis", condition, {"torque": torque}), turning)


def as_shown(bench: Bench, name: str, case: Case, record: Record, values: Floats) -> Floats:
    known = {**STARTS, **case.values}

    def at(parameter: str) -> Any:
        return ASKED[parameter](bench, record) if parameter in ASKED else known[parameter]

    return MODULES[name].change(values, record, at, max(abs(values.mean()), values.std()))


def tilt(series: Floats) -> float:
    """Rise of the straight line through a series, end over start."""
    return float(np.polyfit(np.linspace(0.0, 1.0, len(series)), series, 1)[0])


def largest(found: Signature, most: int = 12, but: str = "") -> list[Row]:
    """The visible rows that say most, in the order of the figures; without figures that end in ``but``."""
    def weight(row: Row) -> float:
        # A small amplitude must not count only because there was none.
        plain = {"arcsec": 2.0, "N": 20.0}.get(row.unit, 0.0)
        return abs(row.change) / max(abs(row.without), plain, 1e-9)

    visible = [r for r in found.rows if r.is_visible() and not (but and r.figure.endswith(but))]
    kept = {id(r) for r in sorted(visible, key=lambda r: -weight(r))[:most]}
    return [r for r in visible if id(r) in kept]


def words(found: Signature, most: int = 12) -> list[str]:
    """The largest changes in words."""
    return [f"{r.figure} ({r.condition}) {change_text(r)}" for r in largest(found, most)]


def change_text(row: Row) -> str:
    """The unit stands behind the last number."""
    (without, present), unit = row.texts, "" if row.unit == "1" else f" {row.unit}"
    return f"{without}{unit} -> {present}" if present == TURNS_BACK else f"{without} -> {present}{unit}"


def number(value: float) -> str:
    """Three figures; rounding noise is nothing."""
    return "0" if abs(value) < 1e-6 else f"{value:.3g}"
