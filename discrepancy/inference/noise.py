"""Noise of each signal, from runs that repeat each other and not from the misfit of the model.

Signals: V = s^2 AR1(length, nugget) + offset, drift and gain that differ from run to run;
single numbers: V = s^2, constant or proportional to the value.  Without replicates the stated
noise is taken, and without that the fast part of the residual, inflated: both are flagged.
"""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from scipy.stats import chi2

from discrepancy.inference.outliers import CUT, huber_weights, local_deviation, robust_scale, usable
from discrepancy.inference.series import position_of, stream_of
from discrepancy.inference.whiten import Whitener, autoregress, correlations, gains, innovations, whitener
from discrepancy.problem import Record

SHORT = 8
"""Records with fewer samples are single numbers: no correlation is looked for."""
UNREPLICATED_INFLATION = 1.5
UNREPLICATED_DOF = 8.0
KNOWN = 1e6


@dataclass(frozen=True)
class StreamNoise:
    """Noise of one signal.  ``scales`` by condition; ``patterns`` variance relative to scale^2; ``dof`` of each part."""

    scale: float
    scales: dict[str, float]
    proportional: bool
    length: float
    nugget: float
    taps: np.ndarray
    patterns: dict[str, float]
    dof: dict[str, float]
    source: str
    tail: float
    floor: float = 0.0

    def to_dict(self) -> dict:
        return {"scale": self.scale, "proportional": self.proportional, "correlation_length": self.length,
                "white_share": self.nugget, "between_runs": {k: float(np.sqrt(v)) * self.scale for k, v in self.patterns.items()},
                "degrees_of_freedom": dict(self.dof), "source": self.source, "tail": self.tail}


@dataclass(frozen=True)
class Noise:
    """Noise of all signals, with the whitening of every record."""

    streams: dict[str, StreamNoise]
    whiteners: list[Whitener]
    warnings: tuple[str, ...]

    def dof(self, component: tuple[str, str]) -> float:
        stream, part = component
        return self.streams[stream].dof.get(part, KNOWN) if stream in self.streams else KNOWN


@dataclass(frozen=True)
class _Deviation:
    index: int
    position: np.ndarray
    values: np.ndarray
    rows: np.ndarray
    share: float
    condition: str
    pair: bool


def estimate(records: Sequence[Record], residuals: Sequence[np.ndarray], predictions: Sequence[np.ndarray]) -> Noise:
    """Noise from training records; held-out records get whiteners of the same noise."""
    masks = [usable(np.asarray(r.values)) & np.isfinite(e) for r, e in zip(records, residuals)]
    members = defaultdict(list)
    for index, record in enumerate(records):
        members[noise_key(record)].append(index)
    streams, whiteners, warnings = {}, [None] * len(records), []
    for key, indices in members.items():
        training = [i for i in indices if not records[i].held_out] or indices
        short = all(masks[i].sum() < SHORT for i in indices)
        fit = _numbers if short else _signals
        stream, weights, note = fit(records, residuals, predictions, masks, training)
        streams[key] = stream
        if note:
            warnings.append(f"{key}: {note}")
        held = [i for i in indices if i not in training]
        if held and not short:
            weights.update(_weights(stream, _deviations(records, residuals, masks, held), records, residuals, masks, held))
        for i in indices:
            whiteners[i] = _whitener(key, stream, records[i], predictions[i], masks[i], weights.get(i))
        lost = [records[i].name for i in indices if masks[i].sum() < 0.98 * masks[i].size]
        if lost:
            warnings.append(f"{key}: stuck or missing samples left out in {', '.join(lost[:6])}{' ...' if len(lost) > 6 else ''}")
    return Noise(streams, whiteners, tuple(warnings))


def noise_key(record: Record) -> str:
    """Single numbers share the noise of their quantity, signals have their own by tag."""
    return record.quantity if np.size(record.values) < SHORT else stream_of(record)


def _groups(records, indices):
    """Sets of runs that repeat each other, within one mounting where that leaves any."""
    for with_mounting in (True, False):
        groups = defaultdict(list)
        for i in indices:
            r = records[i]
            groups[(stream_of(r), r.condition, r.mounting if with_mounting else "")].append(i)
        repeated = [g for g in groups.values() if len(g) > 1]
        if repeated:
            return repeated
    return []


def _deviations(records, residuals, masks, indices) -> list[_Deviation]:
    """Deviations of repeated runs from each other, scaled to the variance of one run."""
    result = []
    for group in _groups(records, indices):
        positions = [position_of(records[i]) for i in group]
        spacing = np.median(np.abs(np.diff(positions[0]))) if positions[0].size > 1 else 1.0
        matched = all(p.size == positions[0].size and np.allclose(p, positions[0], rtol=0, atol=0.5 * spacing + 1e-12) for p in positions)
        condition = records[group[0]].condition
        if matched:
            rows = np.flatnonzero(np.all([masks[i] for i in group], axis=0))
            if rows.size == 0:
                continue
            stack = np.array([residuals[i][rows] for i in group])
            count = len(group)
            spread = (stack - (stack.mean(0) if count == 2 else np.median(stack, axis=0))) * np.sqrt(count / (count - 1))
            if count > 2:
                spread = (stack - stack.mean(0)) * np.sqrt(count / (count - 1))
            for i, position, values in zip(group, positions, spread):
                result.append(_Deviation(i, position[rows], values, rows, (count - 1) / count, condition, count == 2))
            continue
        for a, b in zip(group[:-1], group[1:]):
            pa, pb = position_of(records[a]), position_of(records[b])
            ra, rb = np.flatnonzero(masks[a]), np.flatnonzero(masks[b])
            if ra.size < 2 or rb.size < 2 or np.any(np.diff(pb[rb]) <= 0):
                continue
            at = np.clip(np.searchsorted(pb[rb], pa[ra]), 1, rb.size - 1)
            at -= np.abs(pb[rb][at - 1] - pa[ra]) < np.abs(pb[rb][at] - pa[ra])
            close = np.abs(pb[rb][at] - pa[ra]) <= 0.75 * spacing
            if close.sum() < max(4, 0.3 * ra.size):
                continue
            rows = ra[close]
            result.append(_Deviation(a, pa[rows], (residuals[a][rows] - residuals[b][rb][at][close]) / np.sqrt(2), rows, 1.0, condition, False))
    return result


def _numbers(records, residuals, predictions, masks, indices):
    """Scale of single numbers, constant or proportional, whichever is likelier."""
    deviations = _deviations(records, residuals, masks, indices)
    dof = sum(d.share * d.values.size for d in deviations)
    stated = [records[i].stated_noise for i in indices if records[i].stated_noise]
    sizes = {i: np.maximum(np.abs(predictions[i]), 1e-300) for i in indices}
    everything = np.concatenate([sizes[i] for i in indices])
    floor = 0.02 * np.median(everything)
    if dof >= 2:
        values = np.concatenate([d.values for d in deviations])
        shares = np.concatenate([np.full(d.values.size, d.share) for d in deviations])
        reference = np.concatenate([np.maximum(sizes[d.index][d.rows], floor) for d in deviations])
        constant = _variance(values, shares)
        relative = _variance(values / reference, shares)
        gain = np.sum(shares * (np.log(constant) - np.log(relative * reference**2)))
        proportional = bool(everything.max() > 3 * floor / 0.02 * 0.7 and gain > 4 and relative > 0)
        variance = relative if proportional else constant
        scale, source, note, known = np.sqrt(variance), "replicates", "", dof
        tiny = 1e-9 * (1.0 if proportional else np.max(everything))
        if dof < 3 and stated and not proportional:
            scale, source, known = max(scale, float(np.median(stated))), "replicates and stated", max(dof, 4.0)
        scale = max(scale, tiny)
    elif stated:
        scale, proportional, source, known = float(np.median(stated)), False, "stated", 30.0
        note = "no replicates, noise as stated"
    else:
        values = np.concatenate([residuals[i][masks[i]] for i in indices])
        known = max(values.size - 2.0, 1.0)
        scale, proportional, source = float(np.sqrt(np.mean(values**2) * values.size / known)), False, "misfit"
        note = "neither replicates nor stated noise: nothing can be concluded from these numbers alone"
    stream = StreamNoise(float(scale), {}, proportional, 0.0, 0.0, np.zeros(0), {}, {"main": float(known)}, source, 0.0, floor)
    return stream, {}, note


def _variance(values, shares):
    """Variance with the largest deviations drawn in, so that one bad number does not set the scale."""
    total = np.sum(shares)
    variance = np.sum(shares * values**2) / total
    return max(variance, 1e-300)


def _signals(records, residuals, predictions, masks, indices):
    """Correlation, scale, tails and run-to-run patterns of a series."""
    deviations = [d for d in _deviations(records, residuals, masks, indices) if d.values.size >= SHORT]
    replicated = bool(deviations)
    note = ""
    if not replicated:
        deviations = []
        for i in indices:
            rows = np.flatnonzero(masks[i])
            if rows.size < SHORT:
                continue
            values = residuals[i][rows]
            fast = np.zeros_like(values)
            fast[1:-1] = (values[1:-1] - 0.5 * (values[:-2] + values[2:])) / np.sqrt(1.5)
            deviations.append(_Deviation(i, position_of(records[i])[rows], fast, rows, 1.0, records[i].condition, False))
    detrended = [_detrend(d.position, d.values) for d in deviations]
    size = np.median([robust_scale(v) for v in detrended])
    size = max(size, 1e-9 * max(np.max(np.abs(predictions[i])) for i in indices), 1e-300)
    if replicated:
        length, nugget = _correlation(deviations, [np.clip(v / (robust_scale(v) + 1e-300), -4, 4) for v in detrended])
    else:
        length, nugget = 0.0, 0.0
    inside = []
    for d, v in zip(deviations, detrended):
        rho = correlations(d.position, length)
        inside.append(innovations(v[:, None], rho, *gains(rho, nugget))[:, 0])
    taps = _autoregression([e / max(robust_scale(e), 1e-300) for e in inside]) if replicated else np.zeros(0)
    inside = [autoregress(e[:, None], taps)[:, 0] for e in inside]
    # scale by condition, drawn towards the common one
    common = np.median([robust_scale(e) for e in inside])
    common = max(common, 1e-9 * size)
    scales = {}
    for condition in {d.condition for d in deviations}:
        own = [(e, d) for e, d in zip(inside, deviations) if d.condition == condition]
        dof = sum(d.share * e.size for e, d in own)
        variance = np.mean([_tail_variance(e) for e, _ in own])
        scales[condition] = np.sqrt((dof * variance + 20 * common**2) / (dof + 20))
    scale = float(np.sqrt(np.mean(np.square(list(scales.values())))))
    source = "replicates"
    known = sum(d.share * d.values.size for d in deviations)
    if not replicated:
        stated = [records[i].stated_noise for i in indices if records[i].stated_noise]
        if stated:
            level = max(float(np.median(stated)), scale)
            note, source = "no replicates, noise as stated", "stated"
        else:
            level = UNREPLICATED_INFLATION * scale
            note, source = "no replicates: noise guessed from the fast part of the residual", "fast residual"
        scales = {c: level for c in scales}
        scale, known = level, UNREPLICATED_DOF
    every = np.concatenate([e / scales[d.condition] for e, d in zip(inside, deviations)])
    tail = float(np.mean(np.abs(every) > CUT))
    base = StreamNoise(scale, scales, False, length, nugget, taps, {}, {"main": float(known)}, source, tail)
    patterns, dof = ({}, {})
    if replicated:
        patterns, dof = _patterns(base, deviations, predictions)
    else:
        patterns, dof = {"offset": 0.25}, {"offset": UNREPLICATED_DOF}
    stream = StreamNoise(scale, scales, False, length, nugget, taps, patterns, {"main": float(known), **dof}, source, tail)
    weights = _weights(stream, deviations if replicated else [], records, residuals, masks, indices)
    return stream, weights, note


def _tail_variance(e):
    """Variance that makes the Huber score have unit variance: E[w^2 e^2]/E[w]."""
    scale = max(robust_scale(e), 1e-300)
    for _ in range(4):
        w = huber_weights(e / scale)
        scale = np.sqrt(np.mean(w**2 * e**2) / np.mean(w**1)) or scale
    return scale**2


def _detrend(position, values):
    x = position - position.mean()
    basis = np.column_stack([np.ones_like(x), x])
    return values - basis @ np.linalg.lstsq(basis, values, rcond=None)[0]


def _correlation(deviations, values):
    """Length and white share that maximise the likelihood, over a grid and then around its best point."""
    # the two deviations of a pair mirror each other: one is enough
    seen, single = set(), []
    for k, d in enumerate(deviations):
        if not (d.pair and d.condition in seen):
            single.append(k)
        seen.add(d.condition)
    chosen = sorted(single, key=lambda k: -values[k].size)[:12]
    spacing = np.median(np.concatenate([np.abs(np.diff(deviations[i].position)) for i in chosen]))
    longest = np.median([np.ptp(deviations[i].position) for i in chosen])
    total = sum(values[i].size for i in chosen)

    trends = []
    for i in chosen:
        x = deviations[i].position - deviations[i].position.mean()
        trends.append(np.column_stack([values[i], np.ones_like(x), x / (np.ptp(x) or 1.0)]))

    def deviance(length, nugget):
        """Restricted likelihood: level and trend of each run are left out, or slow noise would be taken for them."""
        square = logs = 0.0
        for i, columns in zip(chosen, trends):
            rho = correlations(deviations[i].position, length)
            gain, deviation = gains(rho, nugget)
            inside = innovations(columns, rho, gain, deviation)
            gram = inside.T @ inside
            basis, along = gram[1:, 1:], gram[1:, 0]
            square += gram[0, 0] - along @ np.linalg.solve(basis, along)
            logs += 2 * np.sum(np.log(deviation)) + np.log(np.linalg.det(basis))
        free = total - 2 * len(trends)
        return free * np.log(square / free) + logs

    best = (deviance(0.0, 0.0), 0.0, 0.0)
    for _ in range(3):
        if best[1] == 0:
            lengths = [spacing * 2.0**k for k in range(-1, 8) if spacing * 2.0**k < 0.3 * longest]
            nuggets = (0.0, 0.1, 0.3, 0.6, 0.85)
        else:
            lengths = best[1] * np.array([0.6, 0.8, 1.0, 1.25, 1.6])
            nuggets = np.clip(best[2] + np.array([-0.08, 0.0, 0.08]), 0.0, 0.97)
        trials = [(deviance(length, nugget), length, nugget) for length in lengths for nugget in nuggets]
        if not trials or min(trials)[0] >= best[0] - (6 if best[1] == 0 else 0):
            break
        best = min(trials)
    return float(best[1]), float(best[2])


def _autoregression(series, most=6):
    """Remaining correlation of the innovations: taps of the order with the best BIC, last entry the gain."""
    total = sum(e.size for e in series)
    if total < 200:
        return np.zeros(0)
    clipped = [np.clip(e, -4, 4) for e in series]
    c = np.array([sum(np.sum(e[lag:] * e[: e.size - lag]) for e in clipped if e.size > lag) for lag in range(most + 1)])
    c /= c[0]
    best = (0.0, np.zeros(0))
    for order in range(1, most + 1):
        matrix = c[np.abs(np.subtract.outer(np.arange(order), np.arange(order)))]
        taps = np.linalg.solve(matrix, c[1: order + 1])
        variance = 1 - taps @ c[1: order + 1]
        if variance <= 0:
            continue
        score = 0.5 * total * np.log(variance) + order * np.log(total)
        if score < best[0] - 4:
            best = (score, np.append(taps, np.sqrt(variance)))
    return best[1]


def _basis(record_position, prediction, names):
    x = record_position - record_position.mean()
    x = x / (np.sqrt(np.mean(x**2)) or 1.0)
    columns = {"offset": np.ones_like(x), "drift": x}
    if "gain" in names:
        h = prediction - prediction.mean()
        columns["gain"] = h / (np.sqrt(np.mean(prediction**2)) or 1.0)
    return np.column_stack([columns[n] for n in names])


def _patterns(stream, deviations, predictions):
    """Variance of the run-wide patterns in units of scale^2: what their amounts scatter by beyond the noise of the samples.

    The gain is only taken in when it is significant: it may look much like a drift.
    """
    names = ["offset", "drift"] if np.median([d.values.size for d in deviations]) >= 32 else ["offset"]
    dof = sum(d.share for d in deviations)
    squares, expected = _amounts(stream, deviations, predictions, names)
    shape = [predictions[d.index][d.rows] for d in deviations]
    if all(np.std(h) > 1e-6 * (np.sqrt(np.mean(h**2)) + 1e-300) for h in shape):
        with_gain = _amounts(stream, deviations, predictions, [*names, "gain"])
        if chi2.sf(with_gain[0]["gain"] / (with_gain[1]["gain"] / dof + 1e-300), dof) < 0.003:
            (squares, expected), names = with_gain, [*names, "gain"]
    patterns = {n: float(max(squares[n] - expected[n], 0.0) / dof) for n in names}
    return patterns, {n: max(dof, 1.0) for n in patterns}


def _amounts(stream, deviations, predictions, names):
    """Sum of squared amounts of each pattern, and what the noise of the samples alone gives."""
    squares, expected = dict.fromkeys(names, 0.0), dict.fromkeys(names, 0.0)
    for d in deviations:
        rho = correlations(d.position, stream.length)
        g = gains(rho, stream.nugget)
        shape = predictions[d.index][d.rows]
        basis = autoregress(innovations(np.ascontiguousarray(_basis(d.position, shape, names)), rho, *g), stream.taps)
        e = autoregress(innovations((d.values / stream.scales[d.condition])[:, None], rho, *g), stream.taps)[:, 0]
        e = e * huber_weights(e - np.median(e), 2 * CUT)
        amount, *_ = np.linalg.lstsq(basis, e, rcond=None)
        covariance = np.linalg.pinv(basis.T @ basis)
        for k, n in enumerate(names):
            squares[n] += d.share * amount[k] ** 2
            expected[n] += d.share * covariance[k, k]
    return squares, expected


def _weights(stream, deviations, records, residuals, masks, indices):
    """Huber weights of each record: from its replicates, else from its own neighbours."""
    weights = {}
    alone = {}
    for i in indices:
        rows = np.flatnonzero(masks[i])
        if rows.size < SHORT:
            continue
        position = position_of(records[i])[rows]
        rho = correlations(position, stream.length)
        g = gains(rho, stream.nugget)
        level = stream.scales.get(records[i].condition, stream.scale)
        e = innovations((residuals[i][rows] / level)[:, None], rho, *g)
        alone[i] = local_deviation(autoregress(e, stream.taps)[:, 0])
        weights[i] = huber_weights(alone[i], 2 * CUT if deviations else 1.6 * CUT)
    for d in deviations:
        if d.index not in alone:
            continue
        rho = correlations(d.position, stream.length)
        g = gains(rho, stream.nugget)
        e = innovations((d.values / stream.scales.get(d.condition, stream.scale))[:, None], rho, *g)
        e = autoregress(e, stream.taps)[:, 0]
        weight = huber_weights(e - np.median(e))
        rows = np.flatnonzero(masks[d.index])
        at = np.searchsorted(rows, d.rows)
        own = np.ones(rows.size)
        own[at] = weight
        if d.pair:
            # both runs deviate alike: the one that also leaves its own neighbours is to blame
            partner = [j for j in alone if j != d.index and records[j].condition == d.condition and stream_of(records[j]) == stream_of(records[d.index])
                       and alone[j].size == rows.size]
            if partner:
                innocent = np.abs(alone[d.index]) < 0.5 * np.max([np.abs(alone[j]) for j in partner], axis=0)
                own[innocent] = 1.0
        weights[d.index] = own
    return weights


def _whitener(key, stream, record, prediction, kept, weight) -> Whitener:
    rows = int(kept.sum())
    position = position_of(record)[kept]
    level = stream.scales.get(record.condition, stream.scale)
    scale = np.full(rows, level)
    if stream.proportional:
        scale = level * np.maximum(np.abs(prediction[kept]), max(stream.floor, 1e-300))
    names = list(stream.patterns)
    patterns = _basis(position, prediction[kept], names) if names and rows >= SHORT else np.zeros((rows, 0))
    variances = np.array([stream.patterns[n] for n in names]) if patterns.shape[1] else np.zeros(0)
    return whitener(kept, scale, position, stream.length, stream.nugget, stream.taps,
                    np.ones(rows) if weight is None else np.sqrt(weight), patterns, variances,
                    tuple((key, n) for n in names), key)
