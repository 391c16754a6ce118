"""How far from a hidden law the nearest law of another effect is: what the best possible test could tell, from the truth itself.

A test of the truth against another effect can do no better than one that is told both, at the rival's strength, shape and calibration that come
nearest: by Neyman and Pearson it errs with probability Phi(-d/2) at equal risk, d being their distance in units of the true noise.  The rival's
family is searched from a few draws by Gauss and Newton's method; a better search could only find a smaller distance.

What the reducer file does not know for sure is a rival too: all numbers that have a range there, each as far off as it may be.
"""

import copy
from collections.abc import Callable, Container

import numpy as np
from scipy.optimize import lsq_linear

from benchmarks.blind_trial.generator.laws import CATALOGUE
from benchmarks.blind_trial.generator.strength import Ruler
from benchmarks.blind_trial.generator.truth import Bench, Truth
from fmu_src.arrays import Floats

# Draws of a rival that are tried; draws that say which shapes it has; steps of the search from the best.
DRAWS, RANGES, STEPS = 6, 60, 2
# Share of the truth's size that is left by a rival which is searched no further, and by its first draws if it is drawn no more.
HOPELESS = 0.9
FIRST, FAR = 2, 0.97
# What a sensor of any quantity can do to all of its runs, per unit.
SENSORS: dict[str, Callable[[Floats], Floats]] = {
    "sensor_gain": lambda y: y, "sensor_offset": np.ones_like, "sensor_drift": lambda y: np.linspace(-0.5, 0.5, len(y)),
}  # fmt: skip
# What stands for the numbers of the reducer file; standard deviation of one over its range, and the step of a difference over that.
NUMBERS, SPREAD, PART = "base numbers", 12.0**-0.5, 0.5
# Numbers that laws of the catalogue change: rivals as those.
AS_LAWS = ("bearing_clearance", "load_exponent", "run_in_ratio", "run_in_time")
# Step of a difference, in shares of a shape's range or of the strength.
STEP = 0.03


def distances(ruler: Ruler, truth: Truth, rng: np.random.Generator) -> dict[str, float]:
    """d' between ``truth`` and the nearest law of every other effect that shows in the same quantities."""
    measured = ruler.design.quantities()
    seen = set(truth.quantities) & measured
    target = ruler.column([truth])
    found: dict[str, float] = {}
    for law in CATALOGUE:
        if law.effect == truth.effect or law.effect in truth.acceptable or not seen & set(law.quantities):
            continue
        d = distance(ruler, target, law, rng)
        found[law.effect] = min(d, found.get(law.effect, np.inf))
    others = [(effect, quantity) for effect in SENSORS if effect != truth.effect for quantity in seen]
    for effect, quantity in others:
        found[effect] = min(beyond(ruler, target, SENSORS[effect], quantity), found.get(effect, np.inf))
    found[NUMBERS] = base_distance(ruler, target, truth.numbers)
    return found


def base_distance(ruler: Ruler, target: Floats, own: Container[str]) -> float:
    """d' between a column and what the file's numbers may make together, with what is unlikely of them; ``own`` are what the law itself is."""
    columns = [change for name, change in base_changes(ruler).items() if name not in own]
    if not columns:
        return float(np.linalg.norm(target))
    stack = np.column_stack(columns)
    sizes = np.linalg.lstsq(np.vstack([stack, np.eye(len(columns))]), np.concatenate([target, np.zeros(len(columns))]), rcond=None)[0]
    return float(np.sqrt(np.sum((target - stack @ sizes) ** 2) + np.sum(sizes**2)))


def base_changes(ruler: Ruler) -> dict[str, Floats]:
    """What each number of the file that is not known for sure changes by its standard deviation; without what may be calibrated."""
    plain, found = ruler.bench.plain, {}
    for name, (low, high) in sorted(plain.reducer.ranges.items()):
        records = next((r for r in (plain.plants, plain.wears) if name in (r.dtype.names or ())), None)
        if records is None or records[name].size != 1 or name in AS_LAWS or name in ruler.design.nuisances:
            continue
        value, deviation = float(records[name].flat[0]), SPREAD * (high - low)
        step = PART * deviation * (-1.0 if value + PART * deviation > high else 1.0)
        moved = Bench({**ruler.nominal, name: value + step}, name=plain.name)
        column = ruler.projected([(moved.values(s, []) - y) * deviation / step for s, y in zip(ruler.series, ruler.base)])
        if np.any(column):
            found[name] = column
    return found


def beyond(ruler: Ruler, target: Floats, shape: Callable[[Floats], Floats], quantity: str) -> float:
    """d' between a column and the nearest that a ``shape`` of one quantity can make."""
    column = ruler.projected([shape(y) if s.quantity == quantity else np.zeros(len(y)) for s, y in zip(ruler.series, ruler.base)])
    square = float(column @ column)
    return float(np.linalg.norm(target - column * (column @ target) / square if square > 0.0 else target))


def distance(ruler: Ruler, target: Floats, law: type[Truth], rng: np.random.Generator) -> float:
    """d' between a column and the nearest that the law can make."""
    whole = float(np.linalg.norm(target))
    first: tuple[float, Truth] | None = None
    for k in range(DRAWS):
        if k == FIRST and first is not None and first[0] > FAR * whole:
            return min(first[0], whole)
        trial = law(rng)
        column = seen_by(ruler, trial)
        square = float(column @ column)
        if square > 0.0:
            share = max(float(column @ target), 0.0) / square
            trial.a = float(np.clip(trial.a * share, trial.low, trial.high))
            d = float(np.linalg.norm(target - share * column))
            if first is None or d < first[0]:
                first = d, trial
    if first is None:
        return whole
    best = first[1]
    left = float(np.linalg.norm(target - seen_by(ruler, best)))
    if left > HOPELESS * whole:
        return min(left, whole)
    ranges = shapes_of(law, rng)
    for _ in range(STEPS):
        better, d = stepped(ruler, target, best, ranges)
        if d >= left:
            break
        best, left = better, d
    return left


def seen_by(ruler: Ruler, law: Truth) -> Floats:
    column = ruler.column([law])
    # Lives are kept by the law's identity and strength; this one's shape changes.
    ruler.bench.kept = {key: lives for key, lives in ruler.bench.kept.items() if not key[1]}
    return column


def shapes_of(law: type[Truth], rng: np.random.Generator) -> dict[str, tuple[float, float]]:
    """Range of every number that a law draws beside its strength; a phase has none."""
    drawn = [vars(law(rng)) for _ in range(RANGES)]
    names = [k for k, v in drawn[0].items() if isinstance(v, float) and k not in ("a", "sign")]
    found = {k: (min(d[k] for d in drawn), max(d[k] for d in drawn)) for k in names}
    return {k: (-np.inf, np.inf) if k == "phase" else r for k, r in found.items() if r[0] < r[1]}


def stepped(ruler: Ruler, target: Floats, law: Truth, ranges: dict[str, tuple[float, float]]) -> tuple[Truth, float]:
    """One step of Gauss and Newton's in strength and shapes, within their ranges; the law there and its d'."""
    here = seen_by(ruler, law)
    limits = {"a": (law.low, law.high), **ranges}
    scales = {k: law.a if k == "a" else 1.0 if k == "phase" else high - low for k, (low, high) in limits.items()}
    columns, low, high = [], [], []
    for name, (least, most) in limits.items():
        at = getattr(law, name)
        step = STEP * scales[name] * (-1.0 if at + STEP * scales[name] > most else 1.0)
        columns.append((seen_by(ruler, moved(law, {name: at + step})) - here) / step * scales[name])
        low.append(min((least - at) / scales[name], -1e-9))
        high.append(max((most - at) / scales[name], 1e-9))
    moves = lsq_linear(np.column_stack(columns), target - here, (np.maximum(low, -1.0), np.minimum(high, 1.0))).x
    trial = moved(law, {name: float(np.clip(getattr(law, name) + m * scales[name], *limits[name])) for name, m in zip(limits, moves)})
    return trial, float(np.linalg.norm(target - seen_by(ruler, trial)))


def moved(law: Truth, values: dict[str, float]) -> Truth:
    found = copy.deepcopy(law)
    found.__dict__.update(values)
    return found
