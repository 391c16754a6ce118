"""What a hidden truth may change, and how a series is computed with it."""

import math
from collections.abc import Callable, Hashable, Mapping
from functools import lru_cache
from typing import Any

import numpy as np

from benchmarks.blind_trial.generator import reducer as bench
from benchmarks.blind_trial.generator.designs import Series
from benchmarks.blind_trial.generator.reducer import HOUR, QUICK, RESOLUTION, RIGID, Change, Gaps, Plain, Setting, both
from benchmarks.blind_trial.generator.stepping import COLUMNS
from fmu_src.arrays import Floats
from wear_fmu.variables import Resolution

TE, DRIVE, FX, FY, CAGE, ROLLERS = range(len(COLUMNS))
SPECTRUM = 4096
# Quantities that a life leads to.
LIVED = ("wear_depth", "wear_profile")
HOUSING_MASS = 10.0


class Truth:
    """One hidden law of strength ``a``; every hook does nothing unless a law says so.

    ``quantities`` are what it can touch; ``effect`` is the catalogue's name that fits, '' if there is none;
    ``parameters()`` gives values of the catalogue's parameters where they mean the same.
    """

    name = ""
    effect = ""
    blocks: tuple[str, ...] = ()
    quantities: tuple[str, ...] = ()
    low, high = 0.0, math.inf
    typical = 1.0
    acceptable: tuple[str, ...] = ()
    # Numbers of a reducer file that are the law's own: where they have a range, "the base is off, here" says the same.
    numbers: tuple[str, ...] = ()
    # Reckoned with rigid supports, or about what a soft reducer shows without it: not hidden in one.
    rigid_only = False

    def __init__(self, rng: np.random.Generator):
        self.a = self.typical
        self.draw(rng)

    def draw(self, rng: np.random.Generator) -> None:
        """Whatever else is random about it."""

    # On the plant's and on the wear unit's records; further gaps of the pins at output angles under forces (transmission
    # error and vibration); factor of wear on "flank" or "race"; share of time in which pins stand.
    parts: Callable[[np.ndarray, Setting], None] | None = None
    surfaces: Callable[[np.ndarray, Setting], None] | None = None
    gaps: Callable[[Setting, Floats, Floats], Floats] | None = None
    rate: Callable[[str, Mapping[str, float], Setting], float] | None = None
    standing: Callable[[Setting], float] | None = None
    # Share of wear that is missing below a force of disc on pin, and below one on a roller [N].
    mild: Callable[[], Floats] | None = None

    def post(self, series: Series, y: Floats, rows: list[Setting]) -> Floats:
        """Changes the ideal values."""
        return y

    def chain(self, series: Series, y: Floats, rows: list[Setting], run: int) -> Floats:
        """The measuring chain, last."""
        return y

    def parameters(self) -> dict[str, float]:
        return {}

    def facts(self) -> dict[str, Any]:
        """All numbers that make the truth."""
        plain = {}
        for key, value in self.__dict__.items():
            if isinstance(value, np.ndarray):
                value = value.tolist()
            plain[key] = value
        return {"law": self.name, "effect": self.effect, "text": (self.__doc__ or "").strip(), "parameters": self.parameters(),
                "numbers": {k: v for k, v in plain.items() if isinstance(v, (int, float, str, list, tuple))}}


class Bench:
    """Computes series of one true reducer with hidden laws."""

    def __init__(self, parameters: dict[str, float], cycle: tuple[int, int] = QUICK, resolution: Resolution = RESOLUTION, name: str = RIGID):
        self.plain = Plain(parameters, cycle, resolution, name)
        self.itself: dict[tuple[Hashable, ...], Floats] = {}
        # By rows, laws with their strengths, and whether parts are ideal.
        self.kept: dict[tuple[Hashable, tuple[tuple[int, float], ...], bool], list[np.ndarray]] = {}

    def rows_of(self, series: Series) -> list[Setting]:
        return series.rows or [series.setting] * series.size

    def values(self, series: Series, truths: list[Truth], cage: float = 0.3, run: int = 0, axes: dict[str, Floats] | None = None) -> Floats:
        """What an ideal instrument behind the measuring chain shows."""
        acting = [t for t in truths if series.quantity in t.quantities]
        y = self.ideal(series, acting, cage, axes or series.axes)
        rows = self.rows_of(series)
        here = series if axes is None else Series(**{**series.__dict__, "axes": axes})
        for t in acting:
            y = t.post(here, y, rows)
        for t in acting:
            y = t.chain(here, y, rows, run)
        return y

    def ideal(self, series: Series, truths: list[Truth], cage: float, axes: dict[str, Floats]) -> Floats:
        parts: Change | None = None
        surfaces: Change | None = None
        for t in truths:
            parts = both(parts, bound(t.parts, series.setting))
            surfaces = both(surfaces, bound(t.surfaces, series.setting))
        compute = getattr(self, series.quantity)
        if series.quantity in LIVED or parts is not None or surfaces is not None or gaps_of(truths, series.setting) is not None:
            found: Floats = compute(series, truths, cage, axes, parts, surfaces)
            return found
        # The reducer itself, for every law that adds to what it shows.
        key = (series.quantity, series.setting, tuple(series.rows), cage, tuple((name, at.tobytes()) for name, at in axes.items()))
        if key not in self.itself:
            self.itself[key] = compute(series, truths, cage, axes, parts, surfaces)
        return self.itself[key].copy()

    def transmission_error(
        self, series: Series, truths: list[Truth], cage: float, axes: dict[str, Floats], parts: Change | None, surfaces: Change | None
    ) -> Floats:
        y = self.plain.sweep(series.setting, axes["angle"], cage, parts, surfaces, gaps_of(truths, series.setting))[:, TE]
        return y - float(y.mean())

    def hysteresis(
        self, series: Series, truths: list[Truth], cage: float, axes: dict[str, Floats], parts: Change | None, surfaces: Change | None
    ) -> Floats:
        y = self.plain.held(series.setting, axes["torque"], parts, surfaces)
        return y - float(y.mean())

    def input_torque(
        self, series: Series, truths: list[Truth], cage: float, axes: dict[str, Floats], parts: Change | None, surfaces: Change | None
    ) -> Floats:
        if self.plain.rubs:
            return np.array([abs(self.plain.means(s)["drive_torque"]) for s in series.rows])
        # Ideal and free of losses: the load over the ratio.
        return np.array([abs(s.load) / self.plain.ratio for s in series.rows])

    def cage_speed(
        self, series: Series, truths: list[Truth], cage: float, axes: dict[str, Floats], parts: Change | None, surfaces: Change | None
    ) -> Floats:
        p = self.plain.plants
        inner, outer = float(p["inner_race_radius"][0]), float(p["outer_race_radius"][0])
        out = np.array([s.speed for s in series.rows]) / self.plain.ratio
        return out * (self.plain.lobes + 1.0) * inner / (inner + outer)

    def vibration_order(
        self, series: Series, truths: list[Truth], cage: float, axes: dict[str, Floats], parts: Change | None, surfaces: Change | None
    ) -> Floats:
        orders = axes["order"]
        gaps = gaps_of(truths, series.setting)
        if parts is None and surfaces is None and gaps is None:
            return np.zeros(len(orders))
        angles = np.linspace(0.0, 2.0 * math.pi, SPECTRUM, endpoint=False)
        force = self.plain.sweep(series.setting, angles, cage, parts, surfaces, gaps)[:, FX]
        amplitude = 2.0 * np.abs(np.fft.rfft(force - force.mean())) / SPECTRUM
        return np.interp(orders, np.arange(len(amplitude)), amplitude) / HOUSING_MASS

    def lives(self, rows: list[Setting], truths: list[Truth], parts: Change | None) -> list[np.ndarray]:
        rates = [t.rate for t in truths if t.rate is not None]
        first = rows[0]

        def rate(surface: str, life: Mapping[str, float]) -> float:
            return math.prod(factor(surface, life, first) for factor in rates)

        key = (tuple(rows), tuple((id(t), t.a) for t in truths), parts is None)
        if key not in self.kept:
            hours = [s.hours for s in rows]
            fresh = Setting(first.speed, first.load, first.temperature, 0.0, first.direction)
            milds = [t.mild() for t in truths if t.mild is not None]
            self.kept[key] = self.plain.live(fresh, hours, rate if rates else None, parts, *milds[:1])
        return self.kept[key]

    def wear_depth(
        self, series: Series, truths: list[Truth], cage: float, axes: dict[str, Floats], parts: Change | None, surfaces: Change | None
    ) -> Floats:
        return np.array([bench.deepest(w, series.tags["surface"]) for w in self.lives(series.rows, truths, parts)])

    def wear_profile(
        self, series: Series, truths: list[Truth], cage: float, axes: dict[str, Floats], parts: Change | None, surfaces: Change | None
    ) -> Floats:
        """Print on the pins: even, or where discs touch standing ones."""
        w = self.lives([series.setting], truths, parts)[-1]
        angle, depth = bench.print_of(w, "pin")
        y = np.interp(axes["depth_angle"], angle, depth)
        share = sum(t.standing(series.setting) for t in truths if t.standing is not None)
        if share:
            stuck = standing_print(series.setting.load, series.setting.speed, series.setting.hours)
            y = (1.0 - share) * y + share * np.interp(axes["depth_angle"], *stuck)
        return y


def bound(hook: Callable[[np.ndarray, Setting], None] | None, setting: Setting) -> Change | None:
    return None if hook is None else lambda records: hook(records, setting)


def gaps_of(truths: list[Truth], setting: Setting) -> Gaps | None:
    """The sum of what laws let the pins miss; worn races and such gaps are never in one law."""
    laws = [t.gaps for t in truths if t.gaps is not None]
    if not laws:
        return None
    return lambda angles, forces: np.sum([gaps(setting, angles, forces) for gaps in laws], axis=0)


@lru_cache(maxsize=50)
def standing_print(load: float, speed: float, hours: float) -> tuple[Floats, Floats]:
    """Print on pins that never turn, by the plain wear unit."""
    plain = Plain({"pins": 1})
    angle, depth = bench.print_of(plain.live(Setting(speed, load), [hours])[0], "pin")
    window = np.hanning(7) / np.hanning(7).sum()
    return angle, np.convolve(np.pad(depth, 3, "edge"), window, "valid")


@lru_cache(maxsize=4)
def worn_places() -> tuple[float, float]:
    """Where inner and outer races wear most [rad]."""
    w = Plain().live(Setting(209.4, 167.0), [200.0 * HOUR])[0]
    (inner, inner_depth), (outer, outer_depth) = (bench.print_of(w, surface) for surface in ("inner_race", "outer_race"))
    return float(inner[bench.rounded(inner_depth, 0.1).argmax()]), float(outer[bench.rounded(outer_depth, 0.1).argmax()])
