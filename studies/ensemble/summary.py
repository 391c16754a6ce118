"""Distributions, lives against limits, and which parameter matters most, from the finished lives."""

import math
import warnings
from collections.abc import Callable
from typing import Any

import numpy as np
from SALib.analyze import sobol
from scipy import stats

from fmu_src.arrays import Floats
from studies.ensemble.ensemble_file import Ensemble
from studies.ensemble.figures import FIGURES, Outcome
from studies.ensemble.sampling import independent_rows, problem

# "value" with "low" and "high" of its interval.
Estimate = dict[str, float]

QUANTILES = (0.05, 0.5, 0.95)
CONFIDENCE = 0.95
RESAMPLES = 999


def summarise(ensemble: Ensemble, lives: dict[int, Outcome], planned: int) -> dict[str, Any]:
    """All figures of an ensemble; ``lives`` by number, finished ones alone."""
    good = {number: life for number, life in lives.items() if "fault" not in life}
    rows = [number for number in independent_rows(ensemble).tolist() if number in good]
    ends = {name: {number: life["figures"][name][-1] for number, life in good.items()} for name in FIGURES}
    found: dict[str, Any] = {
        "reducer": ensemble.reducer.name, "hours": ensemble.hours, "lives_planned": planned, "lives_done": len(lives),
        "lives_failed": len(lives) - len(good), "faults": sorted({life["fault"] for life in lives.values() if "fault" in life})[:5],
        "lives_in_distributions": len(rows),
    }  # fmt: skip
    if len(rows) < 2:
        return found
    found["distributions"] = {name: distribution([ends[name][n] for n in rows], ensemble.seed) for name in FIGURES}
    if ensemble.limits:
        spans = {n: life_hours(good[n], ensemble.limits) for n in rows}
        found["limits"] = ensemble.limits
        found["life_hours"] = censored(list(spans.values()), ensemble.hours, ensemble.seed)
        found["beyond_limits"] = {name: share_beyond([ends[name][n] > limit for n in rows]) for name, limit in ensemble.limits.items()}
        found["beyond_any_limit"] = share_beyond([math.isfinite(hours) for hours in spans.values()])
    if len(good) == planned and len(ensemble.scatters) > 1:
        found["sensitivity"] = {name: sensitivity(ensemble, [ends[name][n] for n in range(planned)]) for name in FIGURES}
    return found


def distribution(values: list[float], seed: int) -> dict[str, Estimate]:
    """Mean and quantiles with bootstrap intervals."""
    data = np.array(values)
    found = {"mean": interval(data, np.mean, seed)}
    for q in QUANTILES:
        found[f"q{round(100 * q):02d}"] = interval(data, lambda x, axis=-1, q=q: np.quantile(x, q, axis=axis), seed)
    return found


def interval(data: Floats, statistic: Callable[..., Any], seed: int) -> Estimate:
    """Value and percentile bootstrap interval."""
    value = float(statistic(data))
    if np.ptp(data) == 0.0:
        return {"value": value, "low": value, "high": value}
    made = stats.bootstrap((data,), statistic, n_resamples=RESAMPLES, confidence_level=CONFIDENCE, method="percentile",
                           rng=np.random.default_rng(seed)).confidence_interval  # fmt: skip
    return {"value": value, "low": float(made.low), "high": float(made.high)}


def life_hours(life: Outcome, limits: dict[str, float]) -> float:
    """Hours at which the first limit is passed, along a straight line between recorded hours; inf if none is."""
    first = math.inf
    for name, limit in limits.items():
        values, hours = life["figures"][name], life["hours"]
        if values[0] > limit:
            return 0.0
        for i in range(1, len(values)):
            if values[i] > limit:
                share = (limit - values[i - 1]) / (values[i] - values[i - 1])
                first = min(first, hours[i - 1] + share * (hours[i] - hours[i - 1]))
                break
    return first


def censored(spans: list[float], hours: float, seed: int) -> dict[str, dict[str, float | None]]:
    """Quantiles of the life; None where it is longer than what was run."""
    data = np.minimum(spans, 10.0 * hours)
    found = {}
    for q in QUANTILES:
        made = interval(data, lambda x, axis=-1, q=q: np.quantile(x, q, axis=axis, method="inverted_cdf"), seed)
        found[f"q{round(100 * q):02d}"] = {key: value if value <= hours else None for key, value in made.items()}
    return found


def share_beyond(beyond: list[bool]) -> Estimate:
    """Share with its Wilson interval, which also says something where none or all are beyond."""
    made = stats.binomtest(int(sum(beyond)), len(beyond)).proportion_ci(CONFIDENCE, "wilson")
    return {"value": sum(beyond) / len(beyond), "low": float(made.low), "high": float(made.high)}


def sensitivity(ensemble: Ensemble, values: list[float]) -> dict[str, dict[str, float]]:
    """Sobol' indices by parameter, most important first: share of the variance alone, and with all its interactions."""
    data = np.array(values)
    spread = float(np.std(data))
    if spread <= 1e-9 * abs(float(np.mean(data))):
        return {}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        made = sobol.analyze(problem(ensemble), (data - data.mean()) / spread, calc_second_order=False, num_resamples=RESAMPLES,
                             conf_level=CONFIDENCE, seed=ensemble.seed)  # fmt: skip
    names = [scatter.name for scatter in ensemble.scatters]
    rows = {
        name: {"alone": float(made["S1"][i]), "alone_plus_minus": float(made["S1_conf"][i]),
               "total": float(made["ST"][i]), "total_plus_minus": float(made["ST_conf"][i])}
        for i, name in enumerate(names)
    }  # fmt: skip
    return dict(sorted(rows.items(), key=lambda row: -row[1]["total"]))
