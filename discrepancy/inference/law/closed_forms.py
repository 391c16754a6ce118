"""Closed forms for a curve that was recovered from data, ranked by the error on points left out."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from scipy.optimize import OptimizeResult, least_squares
from scipy.special import stdtrit

from discrepancy.words.intervals import Writer, estimate_text
from fmu_src.arrays import Floats

# y of x and the constants; and, for each law, its text, its constants, the function and where fits begin.
Law = Callable[..., Floats]
Laws = dict[str, tuple[str, tuple[str, ...], Law, list[list[float]]]]


@dataclass(frozen=True)
class Form:
    """A law y = f(x): its text, parameters with 95 % intervals, error on left-out groups in noise units, and confidence among the rivals."""

    name: str
    text: str
    parameters: dict[str, float]
    intervals: dict[str, tuple[float, float]]
    error: float
    confidence: float

    def numbers(self, least: int, write: Writer) -> list[str]:
        """``a = 1.234 (1.123 to 1.345)`` of each parameter, with ``least`` digits and more; what the form holds at 0 is left out."""
        told = {k: estimate_text(v, self.intervals[k], least, write) for k, v in self.parameters.items() if self.intervals[k] != (0.0, 0.0)}
        return [f"{k} = {value} ({interval})" for k, (value, interval) in told.items()]

    def to_dict(self) -> dict[str, Any]:
        return {**self.__dict__, "intervals": {k: list(v) for k, v in self.intervals.items()}}


def closed_forms(x: Floats) -> Laws:
    """The forms that can be tried over ``x``."""
    low, high = float(np.min(x)), float(np.max(x))
    span = high - low or 1.0
    middle = 0.5 * (low + high)
    made: Laws = {
        "constant": ("y = a", ("a",), lambda x, a: a + 0 * x, [[0.0]]),
        "linear": ("y = a + b x", ("a", "b"), lambda x, a, b: a + b * x, [[0.0, 1 / span]]),
        "quadratic": ("y = a + b x + c x^2", ("a", "b", "c"), lambda x, a, b, c: a + b * x + c * x**2, [[0.0, 1 / span, 0.1 / span**2]]),
        "exponential": ("y = a + b exp(c x)", ("a", "b", "c"), lambda x, a, b, c: a + b * np.exp(np.clip(c * (x - (low if c < 0 else high)), -60, 60)),
                        [[0.0, 1.0, k / span] for k in (-6.0, -2.0, 2.0, 6.0)]),
        "saturating": ("y = a + b x/(x + c)", ("a", "b", "c"), lambda x, a, b, c: a + b * (x - low) / (np.abs(x - low) + np.abs(c) + 1e-12 * span),
                       [[0.0, 1.0, k * span] for k in (0.1, 0.5)]),
        "threshold": ("y = a + b max(x - c, 0)", ("a", "b", "c"), lambda x, a, b, c: a + b * np.maximum(x - c, 0),
                      [[0.0, 1 / span, low + k * span] for k in (0.25, 0.5, 0.75)]),
        "step": ("y = a + b/(1 + exp(-(x - c)/d))", ("a", "b", "c"), lambda x, a, b, c: a + b / (1 + np.exp(np.clip(-(x - c) / (0.02 * span), -60, 60))),
                 [[0.0, 1.0, low + k * span] for k in (0.3, 0.5, 0.7)]),
        "bump": ("y = a + b exp(-((x - c)/d)^2)", ("a", "b", "c", "d"), lambda x, a, b, c, d: a + b * np.exp(-(((x - c) / (np.abs(d) + 1e-3 * span)) ** 2)),
                 [[0.0, 1.0, low + k * span, 0.12 * span] for k in (0.2, 0.5, 0.8)]),
        "periodic": ("y = a + b cos(k x) + c sin(k x)", ("a", "b", "c", "k"), lambda x, a, b, c, k: a + b * np.cos(k * (x - middle)) + c * np.sin(k * (x - middle)),  # noqa: E501
                     []),
    }
    if low > 0:
        made["power"] = ("y = a + b x^c", ("a", "b", "c"), lambda x, a, b, c: a + b * (x / high) ** np.clip(c, -8, 8),
                         [[0.0, 1.0, k] for k in (-1.0, 0.5, 1.5, 3.0)])
        made["logarithmic"] = ("y = a + b log x", ("a", "b"), lambda x, a, b: a + b * np.log(x), [[0.0, 1.0]])
    return made


def propose(x: Floats, y: Floats, deviation: Floats, groups: Sequence[str] | None = None, folds: int = 6) -> list[Form]:
    """Forms of y(x), best first.  Points of one ``group`` (a condition) are left out together.

    Without enough groups whole stretches of x are left out, so that interpolation is what is judged.
    """
    x, y, deviation = (np.asarray(v, dtype=float) for v in (x, y, deviation))
    deviation = np.maximum(deviation, 1e-12 * (np.ptp(y) + 1e-300))
    scale = max(float(np.std(y)), 1e-300)
    labels = np.asarray(groups) if groups is not None else None
    if labels is None or np.unique(labels).size < 4:
        order = np.argsort(np.argsort(x, kind="stable"))
        labels = order * min(2 * folds, max(x.size // 2, 2)) // x.size
    kinds = np.unique(labels)
    parts = [kinds[k::min(folds, kinds.size)] for k in range(min(folds, kinds.size))]
    levels = np.unique(np.round(x, 9)).size
    results = []
    for name, (text, names, function, starts) in closed_forms(x).items():
        if len(names) >= levels and name != "constant":
            continue
        if name == "periodic":
            starts = _frequencies(x, y / scale, deviation / scale, levels)
        best = min((_fit(function, s, x, y / scale, deviation / scale) for s in starts), key=lambda r: r.cost)
        sizes = np.linalg.norm(best.jac, axis=0)
        if not np.isfinite(best.cost) or not np.isfinite(sizes).all() or sizes.min() == 0.0:
            # Its constants ran to where nothing can be told.
            continue
        losses = np.full(y.size, np.nan)
        for part in parts:
            out = np.isin(labels, part)
            if (~out).sum() <= len(names):
                continue
            solution = _fit(function, best.x, x[~out], y[~out] / scale, deviation[~out] / scale)
            losses[out] = ((y[out] / scale - function(x[out], *solution.x)) * scale / deviation[out]) ** 2
        if np.isnan(losses).all():
            # Too few points to leave some out.
            continue
        loss = float(np.nanmean(np.minimum(losses, 1e6)))
        dof = max(y.size - len(names), 1)
        # Constants of x^2 and of 1 differ by many decades: in their own sizes, or the small ones would seem known exactly.
        covariance = np.linalg.pinv((best.jac / sizes).T @ (best.jac / sizes)) / np.outer(sizes, sizes) * max(2 * best.cost / dof, 1.0)
        half = stdtrit(dof, 0.975) * np.sqrt(np.maximum(np.diag(covariance), 0.0))
        linear = {"a", "b"} | ({"c"} if name in ("quadratic", "periodic") else set())
        parameters = {n: float(v * (scale if n in linear else 1.0)) for n, v in zip(names, best.x)}
        intervals = {n: (float((v - h) * f), float((v + h) * f)) for n, v, h in zip(names, best.x, half)
                     for f in [scale if n in linear else 1.0]}
        results.append((loss, len(names), name, text, parameters, intervals))
    if not results:
        return []
    independent = min(len(parts) * 4, y.size)
    criterion = np.array([0.5 * independent * r[0] / max(min(q[0] for q in results), 1.0) + 0.5 * np.log(y.size) * r[1] for r in results])
    confidence = np.exp(-(criterion - criterion.min()))
    confidence /= confidence.sum()
    forms = [Form(name, text, parameters, intervals, float(np.sqrt(loss)), float(c))
             for (loss, _, name, text, parameters, intervals), c in zip(results, confidence)]
    return sorted(forms, key=lambda f: -f.confidence)


def _frequencies(x: Floats, y: Floats, deviation: Floats, levels: int) -> list[list[float]]:
    """Starting points of the periodic form: the three best frequencies of a scan."""
    span, middle = np.ptp(x) or 1.0, 0.5 * (np.min(x) + np.max(x))
    trials = []
    for turns in np.arange(0.75, max(min(levels / 3, 60.0), 1.0), 0.25):
        k = 2 * np.pi * turns / span
        design = np.column_stack([np.ones_like(x), np.cos(k * (x - middle)), np.sin(k * (x - middle))]) / deviation[:, None]
        solution = np.linalg.lstsq(design, y / deviation, rcond=None)[0]
        trials.append((float(np.sum((y / deviation - design @ solution) ** 2)), [*solution, k]))
    return [start for _, start in sorted(trials, key=lambda t: t[0])[:3]] or [[0.0, 0.5, 0.5, 2 * np.pi / span]]


def _fit(function: Law, start: Sequence[float] | Floats, x: Floats, y: Floats, deviation: Floats) -> OptimizeResult:
    def residual(p: Floats) -> Floats:
        found: Floats = (y - function(x, *p)) / deviation
        return found if np.isfinite(found).all() else np.nan_to_num(found, nan=1e6, posinf=1e6, neginf=-1e6)
    # constants that enter linearly start at their best values
    start = np.array(start, dtype=float)
    if start.size >= 2 and start[0] == 0.0:
        zero = function(x, *np.concatenate([[0.0], start[1:]]))
        a = np.column_stack([np.ones_like(x), zero]) / deviation[:, None]
        solution = np.linalg.lstsq(a, y / deviation, rcond=None)[0]
        start[0], start[1] = solution[0], start[1] * solution[1]
    size = np.maximum(np.abs(start), 1e-3)
    return least_squares(residual, start, x_scale=size, max_nfev=60)
