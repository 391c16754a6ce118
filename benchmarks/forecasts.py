"""Forecasts of remaining life on lives with hidden laws, beside a straight line and a power law through the same points.

    python -m benchmarks.forecasts [--lives 240] [--seed 0] [--output results/forecasts.json]

The lost motion of an RV20E-121 with rigid supports over its own wear comes from the reducer's model with drawn coefficients, clearance and load; how fast it
wears over the hours comes from the laws of the blind trial, which are written otherwise than the catalogue's effects and of which the forecast knows
nothing.  Seeds below 1000 are for looking at intervals while the forecast is made, others for judging it.
"""

import argparse
import json
import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import numpy as np

from benchmarks.blind_trial.generator.laws.wearing import Ageing, Debris, DryRun, OldGrease, RunIn, SoftCore, Wearing
from benchmarks.blind_trial.generator.reducer import Setting
from discrepancy.forecast.forecast import COVERAGE, Range, Reading, forecast, range_of
from discrepancy.model_file import load_model
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.observe import lost_motion_at
from discrepancy.prediction.units import Condition
from fmu_src.arrays import Floats
from rv_reducer import estimate

HOUR, ARCSEC = 3600.0, math.pi / 648000.0
# Hours of constant wear at which the reducer is looked at [h]; beyond the last it goes on along a straight line.
OWN = np.array([0.0, 200.0, 600.0, 1500.0, 3000.0, 6000.0, 10000.0, 16000.0])
# Deepest flank after 10,000 h of constant wear and iron of grease then, roughly: what the hidden laws ask for.
FLANK, IRON = 5e-6, 1e-4
LONGEST = 200_000.0
LATER = (Debris, SoftCore, OldGrease, DryRun, Ageing, None)


@dataclass(frozen=True)
class Life:
    """Inspections of one life, and what nobody tells: hours [h] at which the limit is reached, and the laws."""

    readings: list[Reading]
    limit: float
    end: float
    laws: list[str]


def bench_of() -> Bench:
    # Friction's memory would make each look a loop; how lost motion grows with wear is that of the contacts.
    model = load_model("RV20E-121-rigid")
    return Bench(model.reducer, {"mesh_wear_law": 0.0, "raceway_wear_law": 0.0})


def own_growth(bench: Bench, rng: np.random.Generator) -> Floats:
    """Lost motion [arcsec] at the hours ``OWN`` of a wear coefficient that stays as it is."""
    values = {
        "mesh_wear_coefficient": 5e-9 * math.exp(rng.normal(0.0, 0.7)), "raceway_wear_coefficient": 3e-9 * math.exp(rng.normal(0.0, 0.7)),
        "bearing_clearance": rng.uniform(1.5e-6, 5e-6),
    }  # fmt: skip
    new = Condition(bench.rated_speed, bench.rated_load * rng.uniform(0.6, 1.2))
    bench.planned = {new: {h * HOUR for h in OWN}}
    return np.array([lost_motion_at(bench, replace(new, hours=h * HOUR), values) for h in OWN]) / ARCSEC


def strength(law: Wearing, rng: np.random.Generator) -> Wearing:
    law.a = float(np.clip(law.typical * math.exp(rng.uniform(math.log(0.3), math.log(4.0))), law.low, law.high))
    return law


def lived(bench: Bench, seed: int) -> Life | None:
    """A life and its inspections; None where nothing wears."""
    rng = np.random.default_rng(seed)
    own = own_growth(bench, rng)
    laws = [strength(RunIn(rng), rng)] if rng.random() < 0.75 else []
    kind = LATER[rng.integers(len(LATER))]
    if kind is not None:
        laws.append(strength(kind(rng), rng))
    # The whole unit lives longer or shorter than the laws' hours have it.
    pace = math.exp(rng.normal(0.0, 0.4))
    hours = np.concatenate([[0.0], np.geomspace(2.0, LONGEST, 900)])
    used = np.zeros(len(hours))
    for k in range(1, len(hours)):
        t = pace * hours[k - 1]
        own_share = used[k - 1] / 10_000.0
        life = {"travel": 67.5 * HOUR * t, "hours": t, "flank": FLANK * own_share, "race": FLANK * own_share, "iron": IRON * own_share}
        factor = math.prod(law.rate("flank", life, Setting(209.4, 167.0)) for law in laws if law.rate is not None)
        used[k] = used[k - 1] + min(factor, 1e3) * (hours[k] - hours[k - 1])
    slope = (own[-1] - own[-2]) / (OWN[-1] - OWN[-2])
    motion = np.interp(used, OWN, own) + slope * np.maximum(used - OWN[-1], 0.0)
    limit = float(own[0] + rng.uniform(12.0, 45.0))
    if motion[-1] < limit:
        return None
    end = float(np.interp(limit, motion, hours))
    noise = rng.uniform(0.2, 1.0)
    # New, and then at hours that crowd at the beginning, as inspections do.
    last = end * rng.uniform(0.15, 0.6)
    at = np.concatenate([[0.0], np.sort(last * rng.uniform(0.05, 0.95, rng.integers(1, 6)) ** 1.5), [last]])
    seen = np.interp(at, hours, motion) + noise * rng.standard_normal(len(at))
    return Life([Reading(float(t), float(v), noise) for t, v in zip(at, seen)], limit, end, [law.name for law in laws])


def through_points(readings: Sequence[Reading], limit: float, powers: Floats) -> Range:
    """Hours left by a + b t^p with what the noise leaves possible of a, b and (on a grid) p; no prior, growth only."""
    hours, values, noise = (np.array([getattr(r, n) for r in readings]) for n in ("hours", "value", "noise"))
    fits = []
    for p in powers:
        design = np.column_stack([np.ones(len(hours)), (hours / hours[-1]) ** p]) / noise[:, None]
        normal = np.linalg.inv(design.T @ design)
        best = normal @ design.T @ (values / noise)
        fits.append((float(np.sum((design @ best - values / noise) ** 2)), p, best, normal))
    # As for any fit: noise that is larger than stated is taken from what is left.
    least = min(f[0] for f in fits)
    freedom = max(len(hours) - 2 - (len(powers) > 1), 1)
    scale = max(1.0, least / freedom)
    weights = np.array([math.exp(-0.5 * (f[0] - least) / scale) * math.sqrt(np.linalg.det(f[3])) for f in fits])
    rng = np.random.default_rng(0)
    left = []
    for (_, p, best, normal), count in zip(fits, rng.multinomial(4000, weights / weights.sum())):
        a, b = rng.multivariate_normal(best, scale * normal, count).T
        with np.errstate(divide="ignore", invalid="ignore", over="ignore"):
            end = np.where(b > 0.0, hours[-1] * np.maximum((limit - a) / b, 0.0) ** (1.0 / p), np.inf)
        left.append(np.maximum(end - hours[-1], 0.0))
    return range_of(np.concatenate(left))


def by_filter(life: Life) -> Range:
    """RvReducer's filter, told by the forecast after the second inspection and given the others one by one."""
    told = forecast(life.readings[:2], life.limit)
    cells = [v.name for v in estimate.variables()] + ["lost_motion", "lost_motion_limit", "operating_time", "own_rate"]
    r = np.zeros(1, [(name, float) for name in cells]).view(np.recarray)
    first, second = life.readings[:2]
    r["lost_motion"] = r["measured_lost_motion"] = second.value * ARCSEC
    r["lost_motion_limit"], r["operating_time"], r["reading_noise"] = life.limit * ARCSEC, second.hours * HOUR, first.noise * ARCSEC
    r["expected_rate"], r["rate_deviation"], r["rate_drift"] = told.rate.middle * ARCSEC / HOUR, told.rate_deviation, told.drift / HOUR
    estimate.start_estimate(r[0])
    for reading in life.readings[2:]:
        r["operating_time"], r["measured_lost_motion"] = reading.hours * HOUR, reading.value * ARCSEC
        estimate.estimate(r[0])
    rate, left = float(r["estimated_rate"][0]), float(r["estimated_remaining"][0]) / HOUR
    to_go = max((life.limit * ARCSEC - float(r["estimated_lost_motion"][0])), 1e-9)
    spread = math.exp(1.645 * math.hypot(math.sqrt(float(r["rate_variance"][0])) / rate, math.sqrt(float(r["level_variance"][0])) / to_go))
    return Range(left, left / spread, left * spread)


MODELS: dict[str, Callable[[Life], Range]] = {
    "forecast": lambda life: forecast(life.readings, life.limit).remaining,
    "forecast from first and last reading alone": lambda life: forecast([life.readings[0], life.readings[-1]], life.limit).remaining,
    "filter in the unit": by_filter,
    "straight line": lambda life: through_points(life.readings, life.limit, np.array([1.0])),
    "power law": lambda life: through_points(life.readings, life.limit, np.linspace(0.2, 3.0, 57)),
}


def summary(lives: Sequence[Life], ranges: Sequence[Range]) -> dict[str, float]:
    """Coverage, shares that ended after (``above``) and before (``below``) the interval, error of the middle and width as factors."""
    left = np.array([life.end - life.readings[-1].hours for life in lives])
    middle, low, high = (np.array([getattr(r, n) for r in ranges]) for n in ("middle", "low", "high"))
    tiny = 1e-3 * left
    return {
        "holds": float(np.mean([r.holds(x) for r, x in zip(ranges, left)])), "above": float(np.mean(left > high)), "below": float(np.mean(left < low)),
        "error_factor": float(np.exp(np.median(np.abs(np.log(np.maximum(np.minimum(middle, 1e12), tiny) / left))))),
        "width_factor": float(np.exp(np.median(np.log(np.minimum(high, 1e12) / np.maximum(low, tiny))))),
    }  # fmt: skip


def by_law(lives: Sequence[Life], ranges: Sequence[Range]) -> dict[str, dict[str, float]]:
    """What ended before and after the interval, by what happened to the wear rate after running-in."""
    found = {}
    named = [next((law for law in life.laws if law != RunIn.name), "nothing after running-in") for life in lives]
    for law in sorted(set(named)):
        some = [k for k, name in enumerate(named) if name == law]
        of = summary([lives[k] for k in some], [ranges[k] for k in some])
        found[f"forecast, {law}"] = {"lives": float(len(some)), **{key: of[key] for key in ("holds", "above", "below")}}
    return found


def measure(count: int, seed: int) -> dict[str, dict[str, float]]:
    bench = bench_of()
    lives: list[Life] = []
    while len(lives) < count:
        life = lived(bench, seed)
        seed += 1
        if life:
            lives.append(life)
    ranges = {name: [model(life) for life in lives] for name, model in MODELS.items()}
    found = {name: summary(lives, some) for name, some in ranges.items()} | by_law(lives, ranges["forecast"])
    return found | {"lives": {"lives": float(count), "coverage asked": COVERAGE, "readings": float(np.mean([len(life.readings) for life in lives]))}}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--lives", type=int, default=240, help="lives (default 240)")
    parser.add_argument("--seed", type=int, default=1000, help="first of the seeds (default 1000; below: while the forecast was made)")
    parser.add_argument("--output", type=Path, default=Path("results/forecasts.json"))
    options = parser.parse_args()
    found = measure(options.lives, options.seed)
    options.output.parent.mkdir(parents=True, exist_ok=True)
    options.output.write_text(json.dumps(found, indent=1))
    for name, figures in found.items():
        print(f"{name:42}" + ", ".join(f"{key} {value:.3g}" for key, value in figures.items()))


if __name__ == "__main__":
    main()
