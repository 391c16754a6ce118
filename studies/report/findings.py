"""The result in cards and sentences, computed from the dataset."""

import math
from dataclasses import dataclass

import numpy as np

from pages import look
from pages.words import hour_text, number
from studies.figure_units import OVER_TURN, WINDOW
from studies.report.result import Result

# Relative change below which a figure counts as unchanged.
HARDLY = 0.03
SPARK_WIDTH, SPARK_HEIGHT = 120.0, 26.0


@dataclass(frozen=True)
class Card:
    """One figure at the start and at the end; ``name`` is that of the dataset."""

    name: str
    label: str
    unit: str
    start: float
    end: float
    note: str
    colour: str
    spark: str

    @property
    def start_text(self) -> str:
        return number(self.start)

    @property
    def end_text(self) -> str:
        return number(self.end)


def cards(result: Result) -> list[Card]:
    pin_note = "turning, even all round" if result.pins_turn else "standing, where the disc touches"
    pin_note = pin_note if result["pin_um"][-1] > 0.0 else "no wear"
    texts = {
        "disc_flank_um": ("Disc flank wear", "µm", place_note(result, "disc_peak_deg", "(root 0°, tip 180°)")),
        "inner_raceway_um": ("Inner raceway wear", "µm", place_note(result, "inner_peak_deg", "from the eccentric")),
        "outer_raceway_um": ("Outer raceway wear", "µm", place_note(result, "outer_peak_deg", "from outward radial")),
        "pin_um": ("Pin wear", "µm", pin_note),
        "peak_pin_force_N": ("Peak pin force", "N", ""),
        "peak_contact_pressure_MPa": ("Peak contact pressure", "MPa", ""),
        "mean_loaded_teeth": ("Loaded teeth per disc", "", ""),
        "mean_lag_arcsec": ("Mean lag", "arcsec", ""),
        OVER_TURN: ("Transmission error, peak to peak", "arcsec", ""),
        "torsional_stiffness_Nm_per_arcmin": ("Torsional stiffness, running", "N m/arcmin", ""),
        **({"lost_motion_arcmin": ("Lost motion, input held", "arcmin", "")} if has_lost_motion(result) else {}),
    }
    made = []
    for name, (label, unit, note) in texts.items():
        start, end = float(result[name][0]), float(result[name][-1])
        colour = look.SURFACES[name][1] if name in look.SURFACES else look.NOW
        note = note or (change(start, end) if len(result.hours) > 1 else "")
        made.append(Card(name, label, unit, start, end, note, colour, spark(result, name)))
    return made


def place_note(result: Result, name: str, reference: str) -> str:
    surface = {"disc_peak_deg": "disc_flank_um", "inner_peak_deg": "inner_raceway_um"}.get(name, "outer_raceway_um")
    return f"deepest at {number(result[name][-1])}° {reference}" if result[surface][-1] > 0.0 else "no wear"


def change(start: float, end: float) -> str:
    """Signed change in percent."""
    if not (math.isfinite(start) and math.isfinite(end)) or start == 0.0:
        return ""
    percent = 100.0 * (end / start - 1.0)
    if abs(percent) < 0.05:
        return "unchanged"
    return f"{percent:+.{0 if abs(percent) >= 10.0 else 1}f} %".replace("-", "−")


def spark(result: Result, name: str) -> str:
    """Points of a small line over the hours, for an SVG of SPARK_WIDTH by SPARK_HEIGHT; '' for a single hour."""
    hours, values = result.hours, result[name]
    if len(hours) < 2 or not np.isfinite(values).all():
        return ""
    x = SPARK_WIDTH * (hours - hours[0]) / (hours[-1] - hours[0])
    # At least a tenth of the value high, so that a figure that hardly changes looks flat.
    low, high = float(values.min()), float(values.max())
    span = max(high - low, 0.1 * max(abs(low), abs(high)), 1e-12)
    middle = 0.5 * (low + high)
    y = SPARK_HEIGHT * (0.5 - 0.9 * (values - middle) / span)
    return " ".join(f"{a:.1f},{b:.1f}" for a, b in zip(x, y))


def conditions(result: Result) -> str:
    """Load, speed and length of the life."""
    torque = f"{float(result['load_torque_Nm'][0]):g}"
    rpm = 30.0 / math.pi * abs(result.output_speed)
    t = result.topology
    life = hour_text(result.hours[-1]) if result.hours[-1] > 0.0 else "New,"
    return (
        f"{life} at {torque} N m and {number(rpm)} rpm output"
        f" ({number(30.0 / math.pi * abs(result.crank_speed))} rpm of the cranks);"
        f" {t.discs} discs, {t.cranks} cranks, {t.pins} pins, {t.rollers} rollers per bearing"
    )


def sentences(result: Result) -> list[str]:
    """The main finding, in words."""
    if len(result.hours) < 2:
        return ["Only one hour was recorded: there is no change to show.", *accuracy(result)]
    worn = sorted(((float(result[n][-1]), n) for n in look.SURFACES), reverse=True)
    if worn[0][0] == 0.0:
        return [f"After {hour_text(result.hours[-1])} nothing is worn.", *accuracy(result)]
    return [deepest(result, worn), slowing(result, worn[0][1]), *accuracy(result), loads(result)]


WHERE = {
    "disc_flank_um": "on the flanks of the discs", "inner_raceway_um": "on the inner raceways (eccentrics of the cranks)",
    "outer_raceway_um": "on the outer raceways (holes in the discs)", "pin_um": "on the pins",
}  # fmt: skip


def deepest(result: Result, worn: list[tuple[float, str]]) -> str:
    """Which surface is worn most, where, and the others."""
    depth, name = worn[0]
    place = ""
    if name == "disc_flank_um":
        place = f", {number(result['disc_peak_deg'][-1])}° from the root (0°) towards the tip (180°)"
    others = ", ".join(f"{look.SURFACES[n][0]} {number(d)} µm" for d, n in worn[1:])
    after = f"After {hour_text(result.hours[-1])}"
    return f"{after} the deepest wear, {number(depth)} µm, is {WHERE[name]}{place}; {others}."


def slowing(result: Result, name: str) -> str:
    """How the rate of the deepest wear develops."""
    rate = 1e3 * np.diff(result[name]) / np.diff(result.hours)
    first, last = float(rate[0]), float(rate[-1])
    what = f"{look.SURFACES[name][0].capitalize()} wear"
    if len(rate) < 2 or first == 0.0:
        return f"{what} grows by {number(last, 2)} µm per 1000 h."
    word = verb(first, last, "quickens from", "slows from", "stays near")
    return f"{what} {word} {number(first, 2)} to {number(last, 2)} µm per 1000 h."


def verb(start: float, end: float, up: str, down: str, still: str) -> str:
    """The word for a change."""
    if not (math.isfinite(start) and math.isfinite(end)) or abs(end - start) < HARDLY * abs(start):
        return still
    return up if end > start else down


def moves(what: str, result: Result, name: str, unit: str) -> str:
    """A figure of the dataset and its change as a clause."""
    start, end = float(result[name][0]), float(result[name][-1])
    if number(start) == number(end):
        return f"{what} stays at {number(end)} {unit}"
    word = verb(start, end, "rises", "falls", "hardly changes,")
    return f"{what} {word} from {number(start)} to {number(end)} {unit}"


def accuracy(result: Result) -> list[str]:
    """Lag, transmission error and stiffness."""
    # The lag has the sign of the torque; behind is behind either way.
    lag = [abs(float(result["mean_lag_arcsec"][i])) for i in (0, -1)]
    if len(result.hours) < 2:
        return [
            f"The carrier stands {number(lag[1])} arcsec behind its ideal angle, with a transmission error of"
            f" {number(result[OVER_TURN][-1])} arcsec peak to peak over one turn of the output."
        ]
    before = f"now stands {number(lag[1])} arcsec behind its ideal angle, {number(lag[0])} at first"
    if number(lag[0]) == number(lag[1]):
        before = f"still stands {number(lag[1])} arcsec behind its ideal angle"
    error = moves("the transmission error over one turn of the output", result, OVER_TURN, "arcsec peak to peak")
    stiffness = moves("running torsional stiffness", result, "torsional_stiffness_Nm_per_arcmin", "N m/arcmin")
    found = [error, stiffness, *([moves("lost motion", result, "lost_motion_arcmin", "arcmin")] if has_lost_motion(result) else [])]
    return [f"The carrier {before}; {', '.join(found[:-1])}, and {found[-1]}."]


def has_lost_motion(result: Result) -> bool:
    """Results of former versions have none, nor have lives without torque or in motion."""
    return "lost_motion_arcmin" in result.dataset and bool(np.isfinite(result["lost_motion_arcmin"]).all())


def loads(result: Result) -> str:
    """Pin force and pressure."""
    force = moves("The largest pin force", result, "peak_pin_force_N", "N")
    pressure = moves("peak contact pressure", result, "peak_contact_pressure_MPa", "MPa")
    return f"{force}; {pressure}, both {WINDOW}."
