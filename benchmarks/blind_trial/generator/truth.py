"""What a hidden truth may change, and how a series is computed with it."""

import math
from functools import lru_cache

import numpy as np

from benchmarks.blind_trial.generator import reducer as bench
from benchmarks.blind_trial.generator.designs import Series
from benchmarks.blind_trial.generator.reducer import COLUMNS, HOUR, QUICK, Plain, Setting

TE, DRIVE, FX, FY, CAGE, ROLLERS = range(len(COLUMNS))
SPECTRUM = 4096
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

    def __init__(self, rng: np.random.Generator):
        self.a = self.typical
        self.draw(rng)

    def draw(self, rng) -> None:
        """Whatever else is random about it."""

    parts = None
    surfaces = None
    rate = None
    standing = None

    def post(self, series: Series, y: np.ndarray, rows: list[Setting]) -> np.ndarray:
        """Changes the ideal values."""
        return y

    def chain(self, series: Series, y: np.ndarray, rows: list[Setting], run: int) -> np.ndarray:
        """The measuring chain, last."""
        return y

    def parameters(self) -> dict[str, float]:
        return {}

    def facts(self) -> dict:
        """All numbers that make the truth."""
        plain = {}
        for key, value in self.__dict__.items():
            if isinstance(value, np.ndarray):
                value = value.tolist()
            plain[key] = value
        return {"law": self.name, "effect": self.effect, "text": (self.__doc__ or "").strip(), "parameters": self.parameters(),
                "numbers": {k: v for k, v in plain.items() if isinstance(v, (int, float, str, list, tuple))}}


def both(first, second):
    """Two hooks on the same record, one after the other."""
    if first is None or second is None:
        return first or second

    def run(*arguments):
        first(*arguments)
        second(*arguments)

    return run


class Bench:
    """Computes series of one true reducer with hidden laws."""

    def __init__(self, parameters: dict[str, float], cycle: tuple[int, int] = QUICK):
        self.plain = Plain(parameters, cycle)

    def rows_of(self, series: Series) -> list[Setting]:
        return series.rows or [series.setting] * series.size

    def values(self, series: Series, truths: list[Truth], cage: float = 0.3, run: int = 0, axes: dict | None = None) -> np.ndarray:
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

    def ideal(self, series: Series, truths: list[Truth], cage: float, axes: dict) -> np.ndarray:
        parts = surfaces = None
        for t in truths:
            parts = both(parts, t.parts and bound(t.parts, series.setting))
            surfaces = both(surfaces, t.surfaces and bound(t.surfaces, series.setting))
        return getattr(self, series.quantity)(series, truths, cage, axes, parts, surfaces)

    def transmission_error(self, series, truths, cage, axes, parts, surfaces):
        y = self.plain.sweep(series.setting, axes["angle"], cage, parts, surfaces)[:, TE]
        return y - y.mean()

    def hysteresis(self, series, truths, cage, axes, parts, surfaces):
        y = self.plain.held(series.setting, axes["torque"], parts, surfaces)
        return y - y.mean()

    def input_torque(self, series, truths, cage, axes, parts, surfaces):
        # Ideal and free of losses: the load over the ratio.
        return np.array([abs(s.load) / self.plain.ratio for s in series.rows])

    def cage_speed(self, series, truths, cage, axes, parts, surfaces):
        p = self.plain.plants
        inner, outer = float(p["inner_race_radius"][0]), float(p["outer_race_radius"][0])
        out = np.array([s.speed for s in series.rows]) / self.plain.ratio
        return out * (self.plain.lobes + 1.0) * inner / (inner + outer)

    def vibration_order(self, series, truths, cage, axes, parts, surfaces):
        orders = axes["order"]
        if parts is None and surfaces is None:
            return np.zeros(len(orders))
        angles = np.linspace(0.0, 2.0 * math.pi, SPECTRUM, endpoint=False)
        force = self.plain.sweep(series.setting, angles, cage, parts, surfaces)[:, FX]
        amplitude = 2.0 * np.abs(np.fft.rfft(force - force.mean())) / SPECTRUM
        return np.interp(orders, np.arange(len(amplitude)), amplitude) / HOUSING_MASS

    def lives(self, rows: list[Setting], truths: list[Truth], parts) -> list[np.ndarray]:
        rates = [t for t in truths if t.rate is not None]
        first = rows[0]

        def rate(surface, life):
            return math.prod(t.rate(surface, life, first) for t in rates)

        key = (tuple(rows), tuple((id(t), t.a) for t in truths), parts is None)
        if key not in self.kept:
            hours = [s.hours for s in rows]
            fresh = Setting(first.speed, first.load, first.temperature, 0.0, first.direction)
            self.kept[key] = self.plain.live(fresh, hours, rate if rates else None, parts)
        return self.kept[key]

    @property
    def kept(self) -> dict:
        return self.__dict__.setdefault("_kept", {})

    def wear_depth(self, series, truths, cage, axes, parts, surfaces):
        return np.array([bench.deepest(w, series.tags["surface"]) for w in self.lives(series.rows, truths, parts)])

    def wear_profile(self, series, truths, cage, axes, parts, surfaces):
        """Print on the pins: even, or where discs touch standing ones."""
        w = self.lives([series.setting], truths, parts)[-1]
        angle, depth = bench.print_of(w, "pin")
        y = np.interp(axes["depth_angle"], angle, depth)
        share = sum(t.standing(series.setting) for t in truths if t.standing is not None)
        if share:
            stuck = standing_print(series.setting.load, series.setting.speed, series.setting.hours)
            y = (1.0 - share) * y + share * np.interp(axes["depth_angle"], *stuck)
        return y


def bound(hook, setting):
    return lambda record: hook(record, setting)


@lru_cache(maxsize=50)
def standing_print(load: float, speed: float, hours: float) -> tuple[np.ndarray, np.ndarray]:
    """Print on pins that never turn, by the plain wear unit."""
    plain = Plain({"pins": 1})
    angle, depth = bench.print_of(plain.live(Setting(speed, load), [hours])[0], "pin")
    window = np.hanning(7) / np.hanning(7).sum()
    return angle, np.convolve(np.pad(depth, 3, "edge"), window, "valid")


@lru_cache(maxsize=4)
def worn_places() -> tuple[float, float]:
    """Where inner and outer races wear most [rad]."""
    w = Plain().live(Setting(209.4, 167.0), [200.0 * HOUR])[0]
    found = []
    for surface in ("inner_race", "outer_race"):
        angle, depth = bench.print_of(w, surface)
        found.append(float(angle[bench.rounded(depth, 0.1).argmax()]))
    return tuple(found)
