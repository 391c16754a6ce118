"""The missing law without a name: how the misfit depends on conditions and axes, as curves and as closed forms."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

from discrepancy.inference.base_fit.fit import Fit
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.law.closed_forms import Form, propose
from discrepancy.inference.law.splines import Curve, additive
from discrepancy.inference.law.waves import GROWING, Growth, wave_of
from discrepancy.inference.noise.series import order_axis, spacing_of, stream_of
from discrepancy.words.intervals import general
from fmu_src.arrays import Floats

BINS = 24
# Of the variance of a misfit: a curve with less is no dependence to speak of (assumed).
TELLING_SHARE = 0.5

# How an axis, a factor or the misfit of a signal is told: (factor, offset, unit) of SI values, by its name.
Told = Callable[[str], tuple[float, float, str]]


def in_si(_: str) -> tuple[float, float, str]:
    return 1.0, 0.0, ""


@dataclass(frozen=True)
class Recovered:
    """The law of one signal.  ``relative``: the misfit as a share of the prediction.  ``forms`` of the leading curve, best first.

    Curves and points are in SI units; forms are laws of ``x_told`` (factor, offset, unit) of the leading axis and ``y_told``
    (factor, unit) of the misfit, as the text is.
    """

    signal: str
    relative: bool
    curves: list[Curve]
    leading: str
    factor: str | None
    points: dict[str, list[float]]
    forms: list[Form]
    held_out_error_before: float | None
    held_out_error_after: float | None
    text: str
    x_told: tuple[float, float, str] = (1.0, 0.0, "")
    y_told: tuple[float, str] = (1.0, "")
    # Of a wave, what its size goes with.
    growth: Growth | None = None

    def to_dict(self) -> dict[str, Any]:
        plain = dict(self.__dict__)
        plain["curves"] = [c.to_dict() for c in self.curves]
        plain["forms"] = [f.to_dict() for f in self.forms]
        plain["growth"] = self.growth and asdict(self.growth)
        return plain


def recover(space: Workspace, fit: Fit, signals: list[str] | None = None, told: Told = in_si) -> list[Recovered]:
    """Laws of the misfit that ``fit`` leaves, for ``signals`` (all by default), in the units of ``told``; a constant is no law."""
    streams: dict[str, list[int]] = {}
    for i, record in enumerate(space.records):
        if not record.left_out:
            streams.setdefault(stream_of(record), []).append(i)
    found = []
    for signal, indices in streams.items():
        if signals is None or signal in signals:
            law = _signal(space, fit, signal, indices, told)
            if law is None or not law.forms or law.forms[0].name == "constant":
                # A wave that means of neighbouring samples do not show.
                law = _wave(space, fit, signal, indices, told) or law
            found += [law] if law is not None else []
    return found


@dataclass(frozen=True)
class _Bin:
    """Mean misfit and mean prediction of neighbouring samples of a run; ``places`` are factors ("factor:load") and the axis ("axis:angle")."""

    y: float
    prediction: float
    variance: float
    condition: str
    held: bool
    places: dict[str, float]


@dataclass(frozen=True)
class _Smooth:
    """The training bins written one way (misfit over ``way``), with the curves through them."""

    name: str
    way: Callable[[_Bin], float]
    y: Floats
    weights: Floats
    axes: dict[str, Floats]
    curves: list[Curve]
    fitted: Floats


def _table(space: Workspace, fit: Fit, indices: Sequence[int]) -> list[_Bin]:
    """Binned residuals with their conditions: columns of one table, a row per bin and run."""
    ys = space.predictions(fit.values, indices)
    rows = []
    for i, y in zip(indices, ys):
        record, whitener = space.records[i], space.noise.whiteners[i]
        stream = space.noise.streams[whitener.quantity]
        e = np.asarray(record.values, dtype=float) - y
        kept = np.flatnonzero(whitener.kept)
        axes = {k: np.asarray(v, dtype=float) for k, v in record.axes.items() if np.ptp(v) > 0}
        angle = order_axis(record)
        names = [n for n in axes if not (n == "time" and angle is not None)]
        # A few samples are conditions of their own: a table of torques over speeds, depths over hours.
        alone = bool(names) and kept.size <= BINS
        main = axes[names[0]] if names and not alone else None
        if alone:
            cuts = np.array_split(kept, kept.size)
        else:
            cuts = [kept] if main is None else np.array_split(kept[np.argsort(main[kept], kind="stable")], min(BINS, max(kept.size // 4, 1)))
        scales = np.zeros(e.size)
        scales[kept] = whitener.scale
        weight = np.zeros(e.size)
        weight[kept] = whitener.weight**2
        for cut in cuts:
            if cut.size == 0:
                continue
            w = weight[cut] + 1e-9
            scale = float(np.mean(scales[cut]))
            # correlated samples average worse than independent ones
            spacing = spacing_of(main) if main is not None else 1.0
            together = 1 + 2 * (1 - stream.nugget) * stream.length / max(spacing, 1e-300) if stream.length else 1.0
            variance = scale**2 * (min(together, cut.size) / cut.size)
            places = {f"factor:{k}": float(v) for k, v in record.factors.items()}
            if alone:
                places |= {f"factor:{n}": float(axes[n][cut[0]]) for n in names}
            elif main is not None:
                places["axis:" + names[0]] = float(np.mean(main[cut]))
            rows.append(_Bin(float(np.sum(w * e[cut]) / np.sum(w)), float(np.mean(y[cut])), variance, record.condition, record.held_out, places))
    return rows


def _signal(space: Workspace, fit: Fit, signal: str, indices: Sequence[int], told: Told) -> Recovered | None:
    rows = _table(space, fit, indices)
    training = [r for r in rows if not r.held]
    if len(training) < 5:
        return None
    keys = sorted({k for r in rows for k in r.places})
    keys = [k for k in keys if all(k in r.places for r in rows) and np.unique([r.places[k] for r in training]).size >= 2]
    if not keys:
        return None
    alike = together(keys, training)
    keys = list(alike)
    best: tuple[float, _Smooth] | None = None
    predictions = np.array([abs(r.prediction) for r in training])
    # which way of writing the misfit is smooth in the conditions: as it is, by direction, by load, or as a share
    ways: dict[str, Callable[[_Bin], float]] = {"none": lambda r: 1.0}
    if any(r.places.get("factor:direction", 1.0) < 0 for r in training):
        ways["direction"] = lambda r: r.places["factor:direction"]
    if predictions.min() > 0.002 * predictions.max():
        ways["prediction"] = lambda r: r.prediction
    if all(r.places.get("factor:load", 0.0) > 0 for r in rows):
        ways["load"] = lambda r: r.places["factor:load"]
        if "direction" in ways:
            ways["load and direction"] = lambda r: r.places["factor:load"] * r.places["factor:direction"]
    for name, way in ways.items():
        axes = {k: np.array([r.places[k] for r in training]) for k in keys if not (k == "factor:direction" and "direction" in name)}
        if not axes:
            continue
        y = np.array([r.y / way(r) for r in training])
        w = np.array([way(r) ** 2 / r.variance for r in training])
        used = {k: _monotone(k, x) for k, x in axes.items()}
        curves, fitted = additive(y, w, used)
        loss = float(np.sum(w * (y - fitted) ** 2)) + 2 * sum(c.effective_dof for c in curves) + 2 * (name != "none")
        if best is None or loss < best[0]:
            best = (loss, _Smooth(name, way, y, w, axes, curves, fitted))
    return None if best is None else _law(signal, best[1], rows, training, told, alike)


def together(keys: Sequence[str], rows: Sequence[_Bin]) -> dict[str, list[str]]:
    """Factors and axes, each with those that change with it and never apart: between them nothing can be told."""
    levels = {k: np.unique([r.places[k] for r in rows], return_inverse=True)[1] for k in keys}
    found: dict[str, list[str]] = {}
    for key in keys:
        pairs = {first: len(set(zip(levels[first], levels[key]))) for first in found}
        same = [first for first, count in pairs.items() if count == levels[first].max() + 1 == levels[key].max() + 1]
        if same:
            found[same[0]].append(key)
        else:
            found[key] = []
    return found


def _law(
    signal: str, found: _Smooth, rows: Sequence[_Bin], training: Sequence[_Bin], told: Told, alike: Mapping[str, Sequence[str]]
) -> Recovered | None:
    name, way, y, w, axes, curves = found.name, found.way, found.y, found.weights, found.axes, found.curves
    lead = curves[0].name
    # partial residual of the leading axis
    x = axes[lead]
    rest = np.zeros(y.size)
    for c in curves[1:]:
        rest = rest + np.interp(_monotone(c.name, axes[c.name]), c.x, c.y)
    partial = y - rest
    x_told, y_told = told(lead.split(":")[1]), _told(signal, name, told)
    forms = propose(x_told[0] * x + x_told[1], y_told[0] * partial, y_told[0] / np.sqrt(w),
                    [r.condition for r in training] if np.unique(x).size < 8 else None)
    if tells_nothing(forms, name):
        if name != "none" or np.unique(x).size > 2 or curves[0].share < TELLING_SHARE:
            return None
        # Two levels differ, and no form can be told from two.
        forms = []
    shown = [Curve(c.name.split(":")[1], _back(c.name, c.x, axes[c.name]), c.y, c.deviation, c.share, c.effective_dof) for c in curves]
    held = [r for r in rows if r.held]
    before = after = None
    if held:
        hy = np.array([r.y for r in held])
        variance = np.array([r.variance for r in held])
        level = float(np.average(y, weights=w)) if not np.any(found.fitted) else float(np.average(found.fitted, weights=w))
        shape = np.zeros(hy.size)
        for c in curves:
            shape = shape + np.interp(_monotone(c.name, np.array([r.places[c.name] for r in held]), axes[c.name]), c.x, c.y)
        predicted = np.array([way(r) for r in held]) * (level + shape)
        before, after = float(np.sqrt(np.mean(hy**2 / variance))), float(np.sqrt(np.mean((hy - predicted) ** 2 / variance)))
    lead_name = lead.split(":")[1]
    text = _text(signal, name, lead_name, forms, x_told[2], y_told[1])
    if alike[lead]:
        text += f" ({' and '.join(k.partition(':')[2] for k in alike[lead])} changed with it)"
    points = {"x": x.tolist(), "y": partial.tolist(), "deviation": (1 / np.sqrt(w)).tolist()}
    return Recovered(signal, name == "prediction", shown, lead_name, None if name == "none" else name, points, forms, before, after, text,
                     x_told, y_told)


def tells_nothing(forms: Sequence[Form], way: str) -> bool:
    """Whether the best form is a constant, or a share of what the misfit is written over that may as well be none."""
    if not forms or forms[0].name != "constant":
        return False
    low, high = forms[0].intervals["a"]
    return way == "none" or low <= 0.0 <= high


def _wave(space: Workspace, fit: Fit, signal: str, indices: Sequence[int], told: Told) -> Recovered | None:
    """The law of one wave over the angle, as the periodic form that it is."""
    zeros = {name: -offset / factor for name in GROWING for factor, offset, _ in (told(name),)}
    wave = wave_of(space, fit, indices, zeros)
    if wave is None:
        return None
    rows = [r for r in _table(space, fit, indices) if "axis:angle" in r.places and not r.held]
    weights = [wave.weight({k.partition(":")[2]: v for k, v in r.places.items()}) for r in rows]
    x, y = np.array([r.places["axis:angle"] for r in rows]), np.array([r.y / w for r, w in zip(rows, weights)])
    deviation = np.array([np.sqrt(r.variance) / abs(w) for r, w in zip(rows, weights)])
    (factor, _, unit), y_told = told("angle"), _told(signal, wave.way, told)
    b, c, covariance = wave.about(0.5 * (float(x.min()) + float(x.max())))
    half = 1.96 * np.sqrt(np.diag(covariance))
    values = {"b": (y_told[0] * b, y_told[0] * half[0]), "c": (y_told[0] * c, y_told[0] * half[1]), "k": (wave.order / factor, half[2] / factor)}
    intervals = {name: (float(value - h), float(value + h)) for name, (value, h) in values.items()}
    form = Form("periodic", "y = b cos(k x) + c sin(k x)", {"a": 0.0} | {k: float(v) for k, (v, _) in values.items()},
                {"a": (0.0, 0.0)} | intervals, wave.error, 1.0)
    grid = np.linspace(float(x.min()), float(x.max()), int(8 * wave.order * np.ptp(x) / np.pi) + 61)
    phase = wave.order * (grid - 0.5 * (x.min() + x.max()))
    spread = np.full(grid.size, float(np.hypot(half[0], half[1])) / 1.96)
    curve = Curve("angle", grid, b * np.cos(phase) + c * np.sin(phase), spread, wave.gain / float(fit.residual @ fit.residual), 3.0)
    text = f"{_text(signal, wave.way, 'angle', [form], unit, y_told[1])}: order {wave.order:.4g}"
    if wave.growth:
        keys = [k for k in rows[0].places if k.startswith("factor:") and all(k in r.places for r in rows) and len({r.places[k] for r in rows}) > 1]
        text += f", {growth_text(wave.growth, told)}{beside(together(keys, rows), wave.growth.factor)}"
    points = {"x": x.tolist(), "y": y.tolist(), "deviation": deviation.tolist()}
    return Recovered(signal, False, [curve], "angle", None if wave.way == "none" else wave.way, points, [form], None, None,
                     text, (factor, 0.0, unit), y_told, wave.growth)


def growth_text(growth: Growth, told: Told) -> str:
    """What the size of a wave goes with, in the unit of the campaign."""
    factor, _, unit = told(growth.factor)
    low, high = (growth.exponent + 1.96 * side * growth.deviation for side in (-1.0, 1.0))
    top = general(factor * growth.top, 4)
    return f"its size with ({growth.factor}/{top}{unit and ' ' + unit})^{growth.exponent:.3g} ({low:.3g} to {high:.3g}), which is 1 at the largest measured"


def beside(alike: Mapping[str, list[str]], factor: str) -> str:
    """What changed with a factor and never apart."""
    others = [k.partition(":")[2] for first, rest in alike.items() if f"factor:{factor}" in (first, *rest) for k in (first, *rest)]
    return f" ({' and '.join(k for k in others if k != factor)} changed with it)" if len(others) > 1 else ""


def _told(signal: str, way: str, told: Told) -> tuple[float, str]:
    """(factor, unit) of the misfit as it is written."""
    factor, _, unit = told(signal)
    if way == "prediction":
        return 1.0, ""
    if "load" not in way:
        return factor, unit
    load, _, load_unit = told("load")
    return factor / load, f"{unit or '1'}/({load_unit})" if load_unit else unit


def _text(signal: str, way: str, lead: str, forms: Sequence[Form], x_unit: str, y_unit: str) -> str:
    """The best form with its numbers."""
    def of(what: str, unit: str) -> str:
        return f"{what} [{unit}]" if unit else what

    misfit = f"{'misfit' if way == 'none' else 'misfit / ' + way} of {signal}"
    if not forms:
        return f"{of(misfit, y_unit)} over {of(lead, x_unit)}: too few levels for a form"
    best = forms[0]
    numbers = ", ".join(best.numbers(3, general))
    if best.name == "constant":
        return f"misfit of {signal} in proportion to {way}: {of('share', y_unit)} {numbers}"
    return f"{of(misfit, y_unit)} over {of(lead, x_unit)}: {best.text}, {numbers}"


def _logarithmic(name: str, reference: Floats) -> bool:
    low, high = float(np.min(reference)), float(np.max(reference))
    return name.split(":")[1] not in ("angle", "depth_angle", "temperature", "direction") and low > 0 and high > 5 * low


def _monotone(name: str, x: Floats, reference: Floats | None = None) -> Floats:
    """Logarithm of quantities that span decades."""
    reference = x if reference is None else reference
    return np.log(np.maximum(x, 0.2 * np.min(reference))) if _logarithmic(name, reference) else x


def _back(name: str, grid: Floats, reference: Floats) -> Floats:
    return np.exp(grid) if _logarithmic(name, reference) else grid
