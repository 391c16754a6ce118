"""What every test engineer reads first: stiffness by branch, lost motion, width of the loop, run-outs, transmission error by order, drag torque.

Each figure is read in one way from what was measured and from what the model predicts at the same samples; its noise is what
repetitions differ by, or what the noise of the samples makes of it where there are none.
"""

from collections import defaultdict
from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from itertools import pairwise
from typing import Any

import numpy as np
import numpy.typing as npt

from discrepancy.figures.drag_figures import DRAG, DRAG_UNITS, of_drag
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.noise.series import position_of, spacing_of, stream_of
from discrepancy.prediction.support import reversals
from discrepancy.problem import ORDERS as TABLE
from discrepancy.problem import Record
from fmu_src.arrays import Floats
from fmu_src.kernel import kernel
from studies.hysteresis import LOST_MOTION_SHARE, width_torques
from studies.left_out import CLOSE, between_near

STIFFNESS, LOST_MOTION, WIDTH, SPAN = "torsional stiffness", "lost motion", "mean width of the loop", "peak to peak"
# Stiffness is that between half and all of the torque, loading, as catalogues, GB/T 35089 and ``rvwear hysteresis`` have it: friction makes a
# reducer stiffer unloading.  The width is the mean that ``rvwear hysteresis`` calls
# loop_mean_width_arcmin; that at no torque, which it says too, is of the clearances as well, and of how closely a bench's torques lie.
FROM = 0.5
# So many draws of noise where nothing is repeated.
DRAWS = 25
# The base is another kind of reducer where it is so many times stiffer, and then so many noises off count (assumed): what every bench
# calibrates first is fitted before anything else is looked for.
SOFTER, CLEARLY = 1.5, 5.0
SPRINGS, FRICTION, PLAY = ("support_compliance",), ("stribeck_friction", "support_hysteresis", "drive_friction"), ("first_stage_play", "output_play")
# What a base that is too soft may be all the same.
GAIN = ("sensor_gain",)
# What a model's figure is read from.
CURVE = "its curve"
# Repetitions of one condition that differ by so many times what is usual have a noise of their own (assumed; of two, normal noise does it once in 300).
APART = 3.0
# Orders higher than this share of what the samples resolve are not read.
RESOLVED = 0.9

# Reads figures by name from values (n,) of a record.
Reading = Callable[[Floats], dict[str, float]]


@dataclass(frozen=True)
class KeyFigure:
    """One figure of a signal at a condition in ``unit`` (SI): measured and of the model, ``noise`` the standard deviation of the first,
    known from ``dof`` degrees of freedom (0: for sure).  ``model_curve`` is that of the model's curve alone, where noise was drawn on it for ``model``."""

    signal: str
    condition: str
    name: str
    unit: str
    measured: float
    model: float
    noise: float
    runs: int
    repeated: bool
    dof: int = 0
    model_curve: float | None = None

    @property
    def model_from(self) -> str:
        """What the model's number is read from."""
        return CURVE if self.model_curve is None else f"{CURVE} with the noise of the samples drawn on it, mean of {DRAWS} draws"

    @property
    def off(self) -> float:
        """Difference in times its noise."""
        return (self.measured - self.model) / self.noise if self.noise > 0.0 else 0.0

    @property
    def told_as(self) -> str:
        """The signal, or the quantity that is read from it, in whose usual unit the figure is told."""
        return "torsional_stiffness" if self.unit == "N.m/rad" else self.signal

    def as_json(self) -> dict[str, Any]:
        return asdict(self) | {"off": self.off, "model_from": self.model_from}


def key_figures(space: Workspace, predictions: Sequence[Floats], orders: Mapping[str, Sequence[float]], rated: float) -> list[KeyFigure]:
    """All figures of all signals, without runs that are left out; ``predictions`` by record, ``rated`` torque [N m]."""
    groups: dict[tuple[str, str], list[int]] = defaultdict(list)
    for i, record in enumerate(space.records):
        if not record.left_out:
            groups[stream_of(record), record.condition].append(i)
    readings = {key: [reading_of(space.records[i], orders, rated) for i in indices] for key, indices in groups.items()}
    measured = {key: [r(np.asarray(space.records[i].values, float)) for i, r in zip(groups[key], own)] for key, own in readings.items()}
    spread, freedom = between_runs(measured), repetitions_beyond(measured)
    found = []
    for (signal, condition), own in measured.items():
        indices, reading = groups[signal, condition], readings[signal, condition]
        names = [name for name in own[0] if all(name in run for run in own)]
        if not names:
            continue
        # Noise widens a span and lengthens an amplitude, whatever is measured: the model's is read with it.  What is measured errs by what noise makes
        # of it, whatever the model.
        first = np.asarray(space.records[indices[0]].values, float)
        drawn = with_noise(space, indices[0], [first] if PLAIN.keys() & set(names) else [first, predictions[indices[0]]], reading[0])
        for name in names:
            values = [run[name] for run in own]
            by_samples = np.array([[d.get(name, np.nan) for d in read] for read in drawn])
            drawn_noise, between = float(np.nanstd(by_samples[0])), spread.get((signal, name), 0.0)
            noise, dof = (between, freedom[signal, name]) if between > drawn_noise else (drawn_noise, DRAWS - 1)
            # Repetitions that differ by far more than is usual, none of them left out: of their mean nothing more is known.
            if len(values) > 1 and (apart := float(np.sqrt(np.mean(deviations_of(values) ** 2)))) > APART * noise:
                noise, dof = apart, len(values) - 1
            curve = float(np.nanmean([r(predictions[i]).get(name, np.nan) for i, r in zip(indices, reading)]))
            model, alone = (curve, None) if name in PLAIN else (float(np.nanmean(by_samples[1])), curve)
            found.append(KeyFigure(signal, condition, name, PLAIN.get(name, "rad"), float(np.mean(values)), model,
                                   noise / np.sqrt(len(values)), len(values), (signal, name) in spread, dof, alone))  # fmt: skip
    return found


def furthest(figures: Sequence[KeyFigure]) -> list[KeyFigure]:
    """Each figure of each signal at the condition where it is furthest off, the furthest first."""
    worst: dict[tuple[str, str], KeyFigure] = {}
    for f in sorted(figures, key=lambda f: -abs(f.off)):
        worst.setdefault((f.signal, f.name), f)
    return list(worst.values())


def calibrated_first(figures: Sequence[KeyFigure]) -> list[str]:
    """Effects that the key figures call for by name where the base is stiffer by a factor: springs, friction of an open loop, play."""
    clear = [f for f in figures if abs(f.off) > CLEARLY]
    if not any(f.name == STIFFNESS and f.model > SOFTER * f.measured for f in clear):
        return []
    wide = any(f.name == WIDTH and f.off > 0.0 for f in clear)
    lost = any(f.name == LOST_MOTION and f.off > 0.0 for f in clear)
    return [*SPRINGS, *(FRICTION if wide else ()), *(PLAY if lost else ())]


def between_runs(measured: Mapping[tuple[str, str], Sequence[Mapping[str, float]]]) -> dict[tuple[str, str], float]:
    """Standard deviation of one run's figure, by signal and figure, over all conditions with repetitions; robust against one that is off."""
    deviations: dict[tuple[str, str], list[float]] = defaultdict(list)
    for (signal, _), runs in measured.items():
        for name in runs[0] if len(runs) > 1 else ():
            values = [run[name] for run in runs if name in run]
            if len(values) > 1:
                deviations[signal, name] += list(deviations_of(values))
    return {key: robust(np.array(v)) for key, v in deviations.items()}


def deviations_of(values: Sequence[float]) -> Floats:
    """Of repetitions from their median, scaled to the deviation of one run."""
    found: Floats = (np.asarray(values) - np.median(values)) * np.sqrt(len(values) / (len(values) - 1))
    return found


def repetitions_beyond(measured: Mapping[tuple[str, str], Sequence[Mapping[str, float]]]) -> dict[tuple[str, str], int]:
    """Degrees of freedom of ``between_runs``: repetitions beyond the first of each condition."""
    found: dict[tuple[str, str], int] = defaultdict(int)
    for (signal, _), runs in measured.items():
        for name in runs[0]:
            found[signal, name] += max(sum(name in run for run in runs) - 1, 0)
    return found


def robust(deviations: Floats) -> float:
    """Root mean square without those beyond three times the median size."""
    sizes = np.abs(deviations)
    kept = sizes <= 3.0 * max(1.4826 * float(np.median(sizes)), 1e-300)
    return float(np.sqrt(np.mean(deviations[kept] ** 2))) if kept.any() and np.any(deviations[kept]) else float(np.sqrt(np.mean(deviations**2)))


def with_noise(space: Workspace, i: int, curves: Sequence[Floats], reading: Reading) -> list[list[dict[str, float]]]:
    """Figures of each of the ``curves`` (n,) as they would be read with the noise of a run's samples, the same for all, drawn several times."""
    whitener = space.noise.whiteners[i]
    stream = space.noise.streams[whitener.quantity]
    scale = float(np.median(whitener.scale))
    position = position_of(space.records[i])
    rho = float(np.exp(-spacing_of(position) / stream.length)) if stream.length > 0.0 else 0.0
    random = np.random.default_rng(0)
    found: list[list[dict[str, float]]] = [[] for _ in curves]
    for _ in range(DRAWS):
        slow = random.standard_normal(len(curves[0]))
        carry_on(slow, rho, float(np.sqrt(1.0 - rho**2)))
        noise = scale * (np.sqrt(1.0 - stream.nugget) * slow + np.sqrt(stream.nugget) * random.standard_normal(len(slow)))
        for values, read in zip(curves, found):
            read.append(reading(values + noise))
    return found


@kernel
def carry_on(slow: Floats, rho: float, share: float) -> None:
    """Make each of ``slow`` (n,) the one before, weaker by ``rho``, and a ``share`` of itself."""
    before = 0.0
    for i in range(slow.shape[0]):
        before = rho * before + share * slow[i]
        slow[i] = before


def reading_of(record: Record, orders: Mapping[str, Sequence[float]], rated: float) -> Reading:
    """How figures are read from values of a record, from the samples that it has without those that stand far off."""
    good = np.isfinite(record.values) & record.counted
    if record.quantity == "hysteresis" and "torque" in record.axes:
        by_branches = of_loop(np.asarray(record.axes["torque"], float)[good], rated)
        return lambda values: by_branches(values[good])
    if record.quantity in DRAG:
        return of_drag(record)
    if record.quantity == "transmission_error" and "angle" in record.axes:
        by_orders = orders_over(np.asarray(record.axes["angle"], float)[good], orders)
        return lambda values: by_orders(values[good])
    if record.quantity == TABLE:
        every = np.asarray(record.axes["order"], float)
        named = {o: name for name, family in orders.items() for o in family}
        titles = {o: name_of(named[o], (o,)) if o in named else f"order {o:.4g}" for o in np.unique(every[every > 0.0])}
        return lambda values: {title: float(np.linalg.norm(values[every == o])) for o, title in titles.items()}
    return lambda _: {}


# loops ------------------------------------------------------------------------------------
BRANCHES = {(1, True): "forward, loading", (1, False): "forward, unloading", (-1, True): "backward, loading", (-1, False): "backward, unloading"}
LOADING = [name for (_, loading), name in BRANCHES.items() if loading]
LOOP_UNITS = {
    STIFFNESS: "N.m/rad", **{f"{STIFFNESS}, {branch}": "N.m/rad" for branch in BRANCHES.values()}, LOST_MOTION: "rad", WIDTH: "rad",
}  # fmt: skip
# Figures that noise makes neither larger nor smaller in the mean, and their units.
PLAIN = LOOP_UNITS | DRAG_UNITS


def of_loop(torque: Floats, rated: float) -> Reading:
    """How figures are read from turning [rad] along torques [N m] in their order: what the torques decide is found once."""
    if len(torque) < 4:
        return lambda _: {}
    most = float(np.abs(torque).max())
    rising = ways(torque)
    slopes: dict[str, tuple[npt.NDArray[np.intp], Floats]] = {}
    for (sign, loading), name in BRANCHES.items():
        rows = np.flatnonzero((sign * torque >= FROM * most) & (rising == (loading == (sign > 0))))
        if len(rows) >= 2 and np.ptp(torque[rows]) > 0.2 * most:
            level = torque[rows] - torque[rows].mean()
            # Turning times these is the slope of the straight line through it.
            slopes[name] = rows, level / float(level @ level)
    up, down = Branch.of(torque, np.flatnonzero(rising)), Branch.of(torque, np.flatnonzero(~rising))
    small, wide = LOST_MOTION_SHARE * rated * np.array([-1.0, 1.0]), width_torques(most)
    has_small = both(up, down, small).all()
    wide = wide[both(up, down, wide)]

    def read(turning: Floats) -> dict[str, float]:
        slope = {name: float(weights @ turning[rows]) for name, (rows, weights) in slopes.items()}
        positive = {name: value for name, value in slope.items() if value > 0.0}
        found = {f"{STIFFNESS}, {name}": 1.0 / value for name, value in positive.items()}
        if positive:
            loading = [value for name, value in positive.items() if name in LOADING]
            found[STIFFNESS] = 1.0 / float(np.mean(loading or list(positive.values())))
        if up is None or down is None:
            return found
        above, below = up.means(turning), down.means(turning)
        if has_small:
            middle = [0.5 * (np.interp(t, up.torque, above) + np.interp(t, down.torque, below)) for t in small]
            found[LOST_MOTION] = float(middle[1] - middle[0])
        if len(wide) > 1:
            found[WIDTH] = float(np.mean(np.interp(wide, down.torque, below) - np.interp(wide, up.torque, above)))
        return found

    return read


def ways(torque: Floats) -> np.ndarray:
    """Whether the torque rises at each sample (n,), between the places where it turns back for good."""
    rising = np.zeros(len(torque), dtype=bool)
    for begin, end in pairwise(reversals(torque)):
        rising[begin if begin == 0 else begin + 1 : end + 1] = torque[end] > torque[begin]
    return rising


@dataclass(frozen=True)
class Branch:
    """One way of a loop: its ``torque`` (m,), rising, where each of its ``rows`` (n,) lies among them, and the torques of each time that it was gone."""

    torque: Floats
    rows: npt.NDArray[np.intp]
    place: npt.NDArray[np.intp]
    count: npt.NDArray[np.intp]
    times: tuple[Floats, ...]

    @classmethod
    def of(cls, torque: Floats, rows: npt.NDArray[np.intp]) -> "Branch | None":
        if len(rows) < 2:
            return None
        levels, place = np.unique(torque[rows], return_inverse=True)
        times = np.split(torque[rows], np.flatnonzero(np.diff(rows) > 1) + 1)
        return cls(levels, rows, place, np.bincount(place), tuple(np.unique(once) for once in times))

    def has(self, at: Floats) -> npt.NDArray[np.bool_]:
        """Whether torques ``at`` [N m] were measured: all times together, or once, for the torques of several times lie unevenly among each other."""
        found: npt.NDArray[np.bool_] = np.any([between_near(levels, at, CLOSE * np.abs(at)) for levels in (self.torque, *self.times)], axis=0)
        return found

    def means(self, turning: Floats) -> Floats:
        """Turning over the torques, means where one is met again."""
        return np.bincount(self.place, turning[self.rows]) / self.count


def both(up: Branch | None, down: Branch | None, at: Floats) -> npt.NDArray[np.bool_]:
    """Whether both ways were measured at torques ``at`` [N m], and not left out there."""
    if up is None or down is None:
        return np.zeros(len(at), bool)
    return up.has(at) & down.has(at)


# transmission error -----------------------------------------------------------------------
def resolved(angle: Floats, orders: Mapping[str, Sequence[float]]) -> dict[str, tuple[float, ...]]:
    """Families of orders as far as the samples over the angle [rad] show them."""
    turns = float(np.ptp(angle)) / (2.0 * np.pi)
    highest = RESOLVED * np.pi / max(float(np.median(np.abs(np.diff(angle)))), 1e-12)
    inside = {name: tuple(o for o in family if 0.9 / max(turns, 1e-9) <= o <= highest) for name, family in orders.items()}
    return {name: family for name, family in inside.items() if family}


def name_of(name: str, family: Sequence[float]) -> str:
    return f"{name}, order{'s' if len(family) > 1 else ''} {', '.join(f'{o:.4g}' for o in family)}"


def orders_over(angle: Floats, orders: Mapping[str, Sequence[float]]) -> Reading:
    """Span, and amplitude of each family [rad] (root of the sum of squares of its orders), of a transmission error over the angle [rad]."""
    if len(angle) < 2:
        return lambda _: {}
    families = resolved(angle, orders)
    every = list(dict.fromkeys(o for family in families.values() for o in family))
    basis = np.vstack([np.ones(len(angle)), *(f(o * angle) for o in every for f in (np.cos, np.sin))])
    # By the products of the waves: a million samples in a twentieth of the time of their singular values.
    inverse = np.linalg.pinv(basis @ basis.T, hermitian=True) if basis.shape[1] > len(basis) else None

    def read(error: Floats) -> dict[str, float]:
        found = {SPAN: float(np.ptp(error))}
        if inverse is None:
            return found
        parts = inverse @ (basis @ error)
        squares = {o: float(parts[1 + 2 * k] ** 2 + parts[2 + 2 * k] ** 2) for k, o in enumerate(every)}
        return found | {name_of(name, family): float(np.sqrt(sum(squares[o] for o in family))) for name, family in families.items()}

    return read
