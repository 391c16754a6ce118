"""What a standard test reads from its curves, from the virtual bench and from a measured file alike.

Every figure comes with its definition.  Of GB/T 35089-2018 and GB/T 40731-2021 the tables of contents and the definitions of
the hysteresis curve, stiffness, backlash and lost motion were to be had, the full texts were not: what is taken from makers'
data sheets, or from nothing but good sense, says so.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from itertools import pairwise
from typing import Any

import numpy as np

from fmu_src.arrays import Floats
from fmu_src.faults import InputFault
from studies.hysteresis import LOST_MOTION_SHARE
from studies.left_out import CLOSE, between_near
from studies.solve import ARCMIN, ARCSEC

Curve = Mapping[str, Floats]

# Columns and their units, as curves have them.
UNITS = {
    "output_torque": "N.m", "output_angle": "rad", "input_torque": "N.m", "input_angle": "rad", "input_speed": "rad/s", "output_speed": "rad/s",
}  # fmt: skip
# Where stiffness is taken, as shares of the rated torque.
STIFF_FROM = 0.5
# A loop that does not come within this share of the torque that is asked for was not taken far enough.
REACHED = 0.99
# A way is read by a line through so many samples at least, within this share of the torques to either side; and what is a turning point.
ENOUGH, NEAR, TURNS_BACK = 5, 0.01, 0.05
# So many times the noise of neighbours a straight line may leave.
BENT = 2.0
# A measured curve shorter than this says nothing.
FEWEST = 8


@dataclass(frozen=True)
class Figure:
    """A number in a unit, and what it is; ``spread`` are its smallest and largest value over the positions."""

    name: str
    value: float
    unit: str
    definition: str
    spread: tuple[float, float] | None = None

    def as_json(self) -> dict[str, Any]:
        return asdict(self)


@dataclass(frozen=True)
class Test:
    """A standard test: the columns that its curves need, how figures are read, what stands in no text that was to be had.

    ``held``: columns whose levels are conditions of the test.  ``own_figures``: each curve has figures of its own, positions of the others are averaged.
    """

    name: str
    title: str
    columns: tuple[str, ...]
    read: Callable[[Curve, float, float], dict[str, tuple[float, str, str]]]
    text: str
    held: tuple[str, ...] = ()
    own_figures: bool = False

    def evaluate(self, curves: Sequence[Curve], rated: float, ratio: float) -> list[Figure]:
        """The figures of ``evaluated``."""
        return self.evaluated(curves, rated, ratio)[0]

    def evaluated(self, curves: Sequence[Curve], rated: float, ratio: float) -> tuple[list[Figure], dict[str, str]]:
        """Figures over all positions: the mean, and the spread where there are several; by name why those are missing that any position leaves unread.

        ``rated`` torque [N m], ``ratio`` of input turns to output turns.  InputFault for curves that do not hold what the test needs.
        """
        for number, curve in enumerate(curves, 1):
            self.check(curve, number, rated)
        read = [self.read(curve, rated, ratio) for curve in curves]
        why = unread(read)
        if why.keys() == read[0].keys():
            raise InputFault("; ".join(f"{name} is not read: {reason}" for name, reason in why.items()))
        found = []
        for name in (name for name in read[0] if name not in why):
            _, unit, definition = read[0][name]
            values = [one[name][0] for one in read]
            spread = (min(values), max(values)) if len(values) > 1 else None
            found.append(Figure(name, float(np.mean(values)), unit, definition, spread))
        return found, why

    def check(self, curve: Curve, number: int, rated: float) -> None:
        missing = [name for name in self.columns if name not in curve]
        if missing:
            raise InputFault(f"curve {number}: {', '.join(missing)} is missing; {self.name} needs {', '.join(self.columns)}")
        if len(curve[self.columns[0]]) < FEWEST:
            raise InputFault(f"curve {number}: {len(curve[self.columns[0]])} samples are too few; give {FEWEST} at least")
        if not all(np.isfinite(curve[name]).all() for name in self.columns):
            raise InputFault(f"curve {number}: a sample is no finite number")
        for name in self.columns:
            if name.endswith("_angle") and starts_anew(curve[name]):
                raise InputFault(f"curve {number}: {name} starts anew at each turn; give an angle that goes on over the turns")
        if self.read in (read_lost_motion, read_stiffness):
            torque = curve["output_torque"]
            most = REACHED * rated * (LOST_MOTION_SHARE if self.read is read_lost_motion else 1.0)
            if torque.max() < most or torque.min() > -most:
                raise InputFault(
                    f"curve {number}: the output torque goes from {torque.min():g} to {torque.max():g} N.m; {self.name} needs both senses up to"
                    f" {most / REACHED:g} N.m. Give the rated torque with --torque"
                )


def starts_anew(angle: Floats) -> bool:
    """Whether an angle [rad] jumps back by more than half a turn, as an encoder's does: against the way that it goes."""
    steps = np.diff(angle)
    return bool(np.any(np.abs(steps[steps * np.median(steps) < 0.0]) > np.pi))


@dataclass(frozen=True)
class Way:
    """One way of a loop: torques [N m], ascending, and angles [rad]; ``times``: the torques of each time that it was gone, ascending."""

    torque: Floats
    angle: Floats
    times: tuple[Floats, ...] = ()

    def has(self, torque: float, least: float) -> bool:
        """Whether it was measured at a torque, as key figures of a comparison have it; what is nearer than half of ``least`` [N m] counts for measured."""
        end = float(np.clip(torque, self.torque[0], self.torque[-1]))
        if abs(torque - end) > (1.0 - REACHED) * abs(torque):
            return False
        at, close = np.array([end]), CLOSE * np.array([max(abs(torque), least)])
        return any(between_near(levels, at, close)[0] for levels in (np.unique(self.torque), *self.times))

    def around(self, torque: float) -> str:
        """Between which torques nothing was measured, in words."""
        place = int(np.searchsorted(self.torque, torque))
        if not 0 < place < len(self.torque):
            return f"nothing beyond {self.torque[min(place, len(self.torque) - 1)]:.4g} N.m"
        return f"nothing between {self.torque[place - 1]:.4g} and {self.torque[place]:.4g} N.m"

    def at(self, torque: float) -> float:
        """Angle at a torque: by a straight line through what lies about it where that is much and straight, else between its neighbours."""
        near = np.abs(self.torque - torque) <= NEAR * (self.torque[-1] - self.torque[0])
        inside = self.torque[0] <= torque <= self.torque[-1]
        if inside and np.count_nonzero(near) >= ENOUGH and np.ptp(self.torque[near]) > 0.0:
            slope, level = np.polyfit(self.torque[near] - torque, self.angle[near], 1)
            left = self.angle[near] - slope * (self.torque[near] - torque) - level
            # White noise has second differences of six times its variance; what leaves more is no straight line: play.
            if np.std(left) <= BENT * np.std(np.diff(self.angle[near], 2)) / np.sqrt(6.0):
                return float(level)
        return float(np.interp(torque, self.torque, self.angle))


def ways(curve: Curve) -> tuple[Way, Way]:
    """(what was passed with rising torque, what with falling torque); a turning point belongs to both."""
    torque, angle = curve["output_torque"], curve["output_angle"]
    rising, falling = np.zeros((2, len(torque)), bool)
    times: dict[bool, list[Floats]] = {True: [], False: []}
    points = turning_points(torque)
    for first, last in pairwise(points):
        part = slice(first, last + 1)
        upwards = bool(torque[last] > torque[first])
        (rising if upwards else falling)[part] = True
        times[upwards].append(np.unique(torque[part]))
    if not rising.any() or not falling.any():
        raise InputFault("the output torque goes one way alone; a hysteresis curve goes up and down again")
    found = []
    for chosen, once in ((rising, times[True]), (falling, times[False])):
        order = np.argsort(torque[chosen], kind="stable")
        found.append(Way(torque[chosen][order], angle[chosen][order], tuple(once)))
    return found[0], found[1]


def turning_points(torque: Floats) -> list[int]:
    """First and last sample and those where the torque turns back by more than a share of all it covers: noise turns nothing."""
    least = TURNS_BACK * float(np.ptp(torque))
    points, extreme, sense = [0], 0, 0
    for k in range(1, len(torque)):
        moved = torque[k] - torque[extreme]
        if sense * moved >= 0.0 and (sense or abs(moved) > least):
            sense = sense or (1 if moved > 0.0 else -1)
            extreme = k
        elif sense and abs(moved) > least:
            points.append(extreme)
            extreme, sense = k, -sense
    return [*points, extreme] if extreme != points[-1] else points


def read_lost_motion(curve: Curve, rated: float, ratio: float) -> dict[str, tuple[float, str, str]]:
    least = LOST_MOTION_SHARE * rated
    both = up, down = ways(curve)
    gap = abs(up.at(0.0) - down.at(0.0))
    forward, backward = (float(np.mean([way.at(torque) for way in both])) for torque in (least, -least))
    figures = {
        "lost_motion": (abs(forward - backward) * ARCMIN, "arcmin",
                        "angle at +3 % of the rated torque, mean of loading and unloading, less that at -3 %"),
        "backlash": (gap * ARCMIN, "arcmin", "angle at no torque coming from one side, less that coming from the other: width of the loop"),
    }  # fmt: skip
    missing = {"lost_motion": left_out(both, (-least, least), least), "backlash": left_out(both, (0.0,), least)}
    return {name: (float("nan"), unit, missing[name]) if missing[name] else (value, unit, text) for name, (value, unit, text) in figures.items()}


def left_out(both: tuple[Way, Way], torques: Sequence[float], least: float) -> str:
    """Where samples are missing that a figure is read from, in words; empty where none are."""
    senses = zip(("rising", "falling"), both)
    found = [f"with {sense} torque {way.around(torque)}" for sense, way in senses for torque in torques if not way.has(torque, least)]
    return ", ".join(dict.fromkeys(found))


def unread(read: Sequence[Mapping[str, tuple[float, str, str]]]) -> dict[str, str]:
    """Name -> why, of figures that are no number for one of the curves."""
    found: dict[str, str] = {}
    for number, one in enumerate(read, 1):
        for name, (value, _, why) in one.items():
            if np.isnan(value):
                found.setdefault(name, f"curve {number}: {why}" if len(read) > 1 else why)
    return found


def read_stiffness(curve: Curve, rated: float, ratio: float) -> dict[str, tuple[float, str, str]]:
    up, down = ways(curve)

    def secant(way: Way, end: float) -> float:
        turned = way.at(end * rated) - way.at(end * STIFF_FROM * rated)
        return (1.0 - STIFF_FROM) * rated / (abs(turned) * ARCMIN) if turned != 0.0 else float("inf")

    forward, backward = secant(up, 1.0), secant(down, -1.0)
    text = "torque over angle between 50 and 100 % of the rated torque, while it grows, "
    return {
        "torsional_stiffness": (0.5 * (forward + backward), "N.m/arcmin", text + "mean of both senses"),
        "torsional_stiffness_forward": (forward, "N.m/arcmin", text + "positive sense"),
        "torsional_stiffness_reverse": (backward, "N.m/arcmin", text + "negative sense"),
    }


def read_transmission_error(curve: Curve, rated: float, ratio: float) -> dict[str, tuple[float, str, str]]:
    error = curve["output_angle"] - curve["input_angle"] / ratio
    return {
        "transmission_error": (float(np.ptp(error)) * ARCSEC, "arcsec", "largest less smallest of output angle minus input angle over ratio"),
        "transmission_error_rms": (float(np.std(error)) * ARCSEC, "arcsec", "root of the mean square of the same about its mean"),
    }


def read_efficiency(curve: Curve, rated: float, ratio: float) -> dict[str, tuple[float, str, str]]:
    given, taken = (float(np.mean(curve[f"{end}_torque"] * curve[f"{end}_speed"])) for end in ("input", "output"))
    if given == 0.0:
        raise InputFault("no power goes in: input_torque times input_speed is 0 in the mean; an efficiency needs a load")
    return {"efficiency": (100.0 * abs(taken / given), "%", "mean output power over mean input power")}


def read_no_load_torque(curve: Curve, rated: float, ratio: float) -> dict[str, tuple[float, str, str]]:
    torque = np.abs(curve["input_torque"])
    mean = abs(float(np.mean(curve["input_torque"])))
    return {
        "no_load_torque": (mean, "N.m", "mean torque at the input that keeps the unloaded reducer turning"),
        "no_load_torque_largest": (float(torque.max()), "N.m", "largest of the same"),
        "no_load_torque_at_output": (mean * abs(ratio), "N.m", "the mean times the ratio"),
    }


def read_starting_torque(curve: Curve, rated: float, ratio: float) -> dict[str, tuple[float, str, str]]:
    most = float(np.abs(curve["input_torque"]).max())
    return {
        "starting_torque": (most, "N.m", "largest torque at the input while the unloaded reducer begins to turn"),
        "starting_torque_at_output": (most * abs(ratio), "N.m", "the same times the ratio"),
    }


LOOP = "Definitions of hysteresis curve, 3 % and both ways as GB/T prints them for precision reducers for robots. "
TESTS = {
    test.name: test
    for test in (
        Test("lost-motion", "lost motion, static: input held, torque at the output from -T to +T and back", ("output_torque", "output_angle"),
             read_lost_motion, LOOP + "How many positions GB/T 40731-2021 wants (8.4) was not to be had: sixteen, evenly over a turn of the cranks."),
        Test("dynamic-lost-motion", "lost motion, dynamic: transmission error of both senses of turning", ("input_angle", "output_angle", "back_angle"),
             lambda curve, rated, ratio: read_dynamic(curve), "The text of GB/T 40731-2021, 9, was not to be had: the difference of both senses at equal"
             " input angles, its mean and its largest value."),
        Test("stiffness", "torsional stiffness: the same loop up to the rated torque", ("output_torque", "output_angle"), read_stiffness,
             LOOP + "The interval is the evaluator's choice there; 50 to 100 % is that of the makers' data sheets."),
        Test("transmission-error", "transmission error over a turn of the output", ("input_angle", "output_angle"), read_transmission_error,
             "Section 8 of GB/T 35089-2018 was not to be had in full: one turn of the output, peak to peak, without load and at the rated one."
             " On the virtual bench 0 N.m is exactly none: the output floats in its clearances and shows no error of them. The drag of a rig holds it to one"
             " side, as --torque 0.1 does.",
             ("output_torque", "input_speed"), True),
        Test("efficiency", "efficiency at the rated speed, at shares of the rated torque", ("input_torque", "input_speed", "output_torque", "output_speed"),
             read_efficiency, "Section 7 of GB/T 35089-2018 was not to be had in full: 25, 50, 75 and 100 % of the torque, as data sheets draw it.",
             ("output_torque", "input_speed"), True),
        Test("no-load-torque", "running torque without load, over the speed", ("input_torque",), read_no_load_torque,
             "As makers' data sheets have it: torque at the input at 25, 50, 75 and 100 % of the rated speed.",
             ("input_speed",), True),
        Test("starting-torque", "starting torque without load", ("input_torque",), read_starting_torque,
             "As makers' data sheets have it: the torque at the input that begins to turn the output, here the largest at a thousandth of the rated speed."),
    )
}  # fmt: skip


def read_dynamic(curve: Curve) -> dict[str, tuple[float, str, str]]:
    """``back_angle`` is the output's angle at the same input angles with the other sense of turning."""
    difference = np.abs(curve["output_angle"] - curve["back_angle"])
    return {
        "dynamic_lost_motion": (float(np.mean(difference)) * ARCMIN, "arcmin",
                                "output angle turning one way less that turning the other, at equal input angles: mean"),
        "dynamic_lost_motion_largest": (float(difference.max()) * ARCMIN, "arcmin", "the same, its largest value"),
    }  # fmt: skip
