"""Noise of each signal, from runs that repeat each other and not from the misfit of the model.

Signals: V = s^2 AR1(length, nugget) + offset, drift and gain that differ from run to run;
single numbers: V = s^2, constant or proportional to the value.  Where a loop is steep noise of the torque is noise of the loop:
s^2 grows there by the square of slope times noise.  Without replicates the stated
noise is taken, and without that the fast part of the residual, inflated: both are flagged.
"""

from collections import defaultdict
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from discrepancy.inference.noise.axis_noise import axis_noise_of, evened, factor_of, slopes_of
from discrepancy.inference.noise.correlation import autoregression_of, correlation_of, detrended_values, trend_of
from discrepancy.inference.noise.outliers import CUT, huber_weights, local_deviation, robust_scale, usable
from discrepancy.inference.noise.replicates import Deviation, deviations_of
from discrepancy.inference.noise.run_patterns import pattern_columns, pattern_variances
from discrepancy.inference.noise.series import fast_part, path_of, position_of, spacing_of, stream_of
from discrepancy.inference.noise.stream_noise import StreamNoise
from discrepancy.inference.noise.whiten import SLOW, Whitener, autoregress, correlations, gains, innovations, slow_waves, whitener, with_slow
from discrepancy.problem import ORDERS, Record
from discrepancy.rounding import noise_of, step_of
from fmu_src.arrays import Floats, Mask

SHORT = 8
"""Records with fewer samples are single numbers: no correlation is looked for."""
UNREPLICATED_INFLATION = 1.5
UNREPLICATED_DOF = 8.0
UNSEEN = {"offset": 0.25, "drift": 0.1}
"""By what runs differ where none is repeated (assumed: half and a third of the noise): a drifting zero of one run proves nothing."""
SPECTRUM_DOF = 100.0
"""Of a signal's noise, however long: its spectrum is a fitted form, known at single orders to a seventh."""
FEW = 50.0
"""Degrees of freedom of the slow part of the noise from which on it counts as known."""
KNOWN = 1e6


@dataclass(frozen=True)
class Noise:
    """Noise of all signals, with the whitening of every record."""

    streams: dict[str, StreamNoise]
    whiteners: list[Whitener]
    warnings: tuple[str, ...]

    def dof(self, component: tuple[str, str]) -> float:
        stream, part = component
        return self.streams[stream].dof.get(part, KNOWN) if stream in self.streams else KNOWN


def estimate(records: Sequence[Record], residuals: Sequence[Floats], predictions: Sequence[Floats]) -> Noise:
    """Noise from training records; held-out records get whiteners of the same noise."""
    masks = [usable(np.asarray(r.values)) & np.isfinite(e) & r.counted for r, e in zip(records, residuals)]
    members: dict[str, list[int]] = defaultdict(list)
    for index, record in enumerate(records):
        members[noise_key(record)].append(index)
    streams: dict[str, StreamNoise] = {}
    whiteners: dict[int, Whitener] = {}
    warnings = []
    for key, indices in members.items():
        training = [i for i in indices if not records[i].held_out] or indices
        # A run that is left out says nothing of the noise either.
        plain = [i for i in training if not records[i].left_out] or training
        # What stands beside each other in a table of orders is no neighbour: its noise is that of single numbers.
        short = all(masks[i].sum() < SHORT or records[i].quantity == ORDERS for i in indices)
        fit = _numbers if short else _signals
        stream, weights, note = fit(records, residuals, predictions, masks, plain)
        streams[key] = stream
        if note:
            warnings.append(f"{key}: {note}")
        held = [i for i in indices if i not in plain]
        if held and not short:
            repeated = deviations_of(records, residuals, masks, [i for i in held if not records[i].left_out])
            weights.update(_weights(stream, evened(repeated, records, predictions, stream.axis), records, residuals, predictions, masks, held))
        # Single numbers are too few to show the step in which they were rounded: all runs together do.
        step = step_of(np.concatenate([np.asarray(records[i].values, float) for i in indices])) if short else None
        for i in indices:
            whiteners[i] = _whitener(key, stream, records[i], predictions[i], masks[i], weights.get(i), _rounded(records, indices, i, step))
        lost = [records[i].name for i in indices if masks[i].sum() < 0.98 * masks[i].size]
        if lost:
            warnings.append(f"{key}: stuck or missing samples left out in {', '.join(lost[:6])}{' ...' if len(lost) > 6 else ''}")
    return Noise(streams, [whiteners[i] for i in range(len(records))], tuple(warnings))


def noise_key(record: Record) -> str:
    """Single numbers share the noise of their quantity, signals have their own by tag."""
    return record.quantity if np.size(record.values) < SHORT else stream_of(record)


def _numbers(
    records: Sequence[Record], residuals: Sequence[Floats], predictions: Sequence[Floats], masks: Sequence[Mask], indices: Sequence[int]
) -> tuple[StreamNoise, dict[int, Floats], str]:
    """Scale of single numbers, constant or proportional, whichever is likelier."""
    deviations = deviations_of(records, residuals, masks, indices)
    dof = sum(d.share * d.values.size for d in deviations)
    stated = _stated(records, indices)
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
        varied = everything.max() > 2 * np.median(everything)
        # The two numbers of an order are large and small by their phase, not by their noise.
        waves = any(records[i].quantity == ORDERS for i in indices)
        proportional = bool(varied and relative > 0 and gain > -15 and not waves)
        if proportional and gain < 5:
            # too few replicates to tell: the larger of both holds for each number
            floor = max(floor, float(np.sqrt(constant / relative)))
        variance = relative if proportional else constant
        scale, source, note, known = np.sqrt(variance), "replicates", "", dof
        tiny = 1e-9 * (1.0 if proportional else np.max(everything))
        if dof < 3 and stated and not proportional:
            scale, source, known = max(scale, float(np.median(stated))), "replicates and stated", max(dof, 4.0)
        scale = max(scale, tiny)
    elif stated:
        scale, proportional, source, known = float(np.median(stated)), False, "stated", UNREPLICATED_DOF
        note = "no replicates, noise as stated"
    else:
        values = np.concatenate([residuals[i][masks[i]] for i in indices])
        known = max(values.size - 2.0, 1.0)
        scale, proportional, source = float(np.sqrt(np.mean(values**2) * values.size / known)), False, "misfit"
        note = "neither replicates nor stated noise: nothing can be concluded from these numbers alone"
    stream = StreamNoise(float(scale), {}, proportional, 0.0, 0.0, np.zeros(0), {}, {"main": float(known)}, source, 0.0, floor)
    return stream, {}, note


def _stated(records: Sequence[Record], indices: Sequence[int]) -> list[float]:
    return [noise for i in indices if (noise := records[i].stated_noise)]


def _variance(values: Floats, shares: Floats) -> float:
    """Variance with the largest deviations drawn in, so that one bad number does not set the scale."""
    total = np.sum(shares)
    variance = np.sum(shares * values**2) / total
    return max(float(variance), 1e-300)


def _signals(
    records: Sequence[Record], residuals: Sequence[Floats], predictions: Sequence[Floats], masks: Sequence[Mask], indices: Sequence[int]
) -> tuple[StreamNoise, dict[int, Floats], str]:
    """Correlation, scale, tails and run-to-run patterns of a series."""
    deviations = [d for d in deviations_of(records, residuals, masks, indices) if d.values.size >= SHORT]
    replicated = bool(deviations)
    note = ""
    if not replicated:
        deviations = []
        for i in indices:
            rows = np.flatnonzero(masks[i])
            if rows.size < SHORT:
                continue
            inner, fast = fast_part(path_of(records[i])[rows], residuals[i][rows])
            deviations.append(Deviation(i, position_of(records[i])[rows[inner]], fast, rows[inner], 1.0, records[i].condition, False))
    detrended = [detrended_values(d.position, d.values) for d in deviations]
    axis = 0.0
    if replicated:
        axis = axis_noise_of(detrended, [slopes_of(records[d.index], predictions[d.index])[d.rows] for d in deviations], [d.share for d in deviations])
        deviations = evened(deviations, records, predictions, axis)
        detrended = [v / d.factor for d, v in zip(deviations, detrended)]
    size = np.median([robust_scale(v) for v in detrended])
    size = max(size, 1e-9 * max(np.max(np.abs(predictions[i])) for i in indices), 1e-300)
    if replicated:
        length, nugget = correlation_of(deviations, [np.clip(v / (robust_scale(v) + 1e-300), -4, 4) for v in detrended])
    else:
        length, nugget = 0.0, 0.0
    inside, trends = [], []
    for d, v in zip(deviations, detrended):
        rho = correlations(d.position, length)
        whole = innovations(np.column_stack([v, trend_of(d.position)]), rho, *gains(rho, nugget))
        inside.append(whole[:, 0])
        trends.append(whole[:, 1:])
    shares = [d.share for d in deviations]
    taps = autoregression_of([e / max(robust_scale(e), 1e-300) for e in inside], trends, shares) if replicated else np.zeros(0)
    inside = [autoregress(e[:, None], taps)[:, 0] for e in inside]
    # scale by condition, drawn towards the common one
    common = np.median([robust_scale(e) for e in inside])
    common = max(common, 1e-9 * size)
    scales = {}
    for condition in {d.condition for d in deviations}:
        own = [(e, d) for e, d in zip(inside, deviations) if d.condition == condition]
        dof = sum(d.share * e.size for e, d in own)
        # What stands out of the fast part is a kink that the model lacks, not noise.
        variance = np.mean([_tail_variance(e) if replicated else robust_scale(e) ** 2 for e, _ in own])
        scales[condition] = np.sqrt((dof * variance + 20 * common**2) / (dof + 20))
    scale = float(np.sqrt(np.mean(np.square(list(scales.values())))))
    source = "replicates"
    # Of a spectrum by a form of so many numbers (Berk 1974): the level at a frequency errs in its logarithm by a variance of 2 numbers/n.
    numbers = 1 + max(taps.size - 1, 0) + (nugget > 0.0)
    known = min(sum(d.share * d.values.size for d in deviations) / numbers, SPECTRUM_DOF)
    if not replicated:
        stated = _stated(records, indices)
        if stated:
            level = max(float(np.median(stated)), scale)
            note, source = "no replicates, noise as stated", "stated"
        else:
            level = UNREPLICATED_INFLATION * scale
            note, source = "no replicates: noise guessed from the fast part of the residual", "fast residual"
        scales = dict.fromkeys(scales, level)
        scale, known = level, UNREPLICATED_DOF
    every = np.concatenate([e / scales[d.condition] for e, d in zip(inside, deviations)])
    tail = float(np.mean(np.abs(every) > CUT))
    base = StreamNoise(scale, scales, False, length, nugget, taps, {}, {"main": float(known)}, source, tail, axis=axis)
    if replicated:
        patterns, between = pattern_variances(base, deviations, predictions)
        between |= known_of_slow(deviations, length)
    else:
        patterns, between = dict(UNSEEN), dict.fromkeys(UNSEEN, UNREPLICATED_DOF)
    stream = StreamNoise(scale, scales, False, length, nugget, taps, patterns, {"main": float(known), **between}, source, tail, axis=axis)
    weights = _weights(stream, deviations if replicated else [], records, residuals, predictions, masks, indices)
    return stream, weights, note


def known_of_slow(deviations: Sequence[Deviation], length: float) -> dict[str, float]:
    """Degrees of freedom of waves that are slower than noise of this correlation ``length`` forgets; none where there are many.

    The level at no frequency of a first-order autoregression, 1/(1 - c)^2, errs in its logarithm by a variance of 4 (1 + c)/((1 - c) n), for
    that of c is (1 - c^2)/n; a variance of so many degrees of freedom errs by two over them.
    """
    dof = sum(d.share * d.values.size * np.tanh(0.5 * spacing_of(d.position) / max(length, 1e-300)) for d in deviations) / 2.0
    return {SLOW: max(float(dof), 1.0)} if dof < FEW else {}


def _tail_variance(e: Floats) -> float:
    """Variance that makes the Huber score have unit variance: E[w^2 e^2]/E[w]."""
    scale = max(robust_scale(e), 1e-300)
    for _ in range(4):
        w = huber_weights(e / scale)
        scale = np.sqrt(np.mean(w**2 * e**2) / np.mean(w**1)) or scale
    return float(scale**2)


def _weights(
    stream: StreamNoise, deviations: Sequence[Deviation], records: Sequence[Record], residuals: Sequence[Floats], predictions: Sequence[Floats],
    masks: Sequence[Mask], indices: Sequence[int],
) -> dict[int, Floats]:  # fmt: skip
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
        even = residuals[i][rows] / (level * factor_of(records[i], predictions[i], stream.axis)[rows])
        e = innovations(even[:, None], rho, *g)
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


def _rounded(records: Sequence[Record], indices: Sequence[int], i: int, step: float | None) -> float:
    """Noise of rounding of a run, in steps of ``step`` where that is known; runs that repeat each other and were rounded alike are off alike,
    and say what one says."""
    alike = sum(records[j].condition == records[i].condition and stream_of(records[j]) == stream_of(records[i]) for j in indices)
    noise = noise_of(np.asarray(records[i].values, float)) if step is None else step / float(np.sqrt(12.0))
    return noise * float(np.sqrt(alike))


def _whitener(
    key: str, stream: StreamNoise, record: Record, prediction: Floats, kept: Mask, weight: Floats | None, rounded: float
) -> Whitener:  # fmt: skip
    rows = int(kept.sum())
    position = position_of(record)[kept]
    level = stream.scales.get(record.condition, stream.scale)
    factor = factor_of(record, prediction, stream.axis)[kept]
    scale = max(level, rounded) * factor
    if stream.proportional:
        scale = np.maximum(level * np.maximum(np.abs(prediction[kept]), max(stream.floor, 1e-300)), rounded)
    between = dict(stream.patterns)
    if record.zero_noise and record.quantity == ORDERS:
        mean = np.asarray(record.axes["order"])[kept] == 0.0
        scale[mean] = np.hypot(scale[mean], record.zero_noise)
    elif record.zero_noise:
        between["offset"] = between.get("offset", 0.0) + (record.zero_noise / level) ** 2
    names = list(between)
    patterns = pattern_columns(position, prediction[kept], names) / factor[:, None] if names and rows >= SHORT else np.zeros((rows, 0))
    variances = np.array([between[n] for n in names]) if patterns.shape[1] else np.zeros(0)
    found = whitener(kept, scale, position, stream.length, stream.nugget, stream.taps,
                     np.ones(rows) if weight is None else np.sqrt(weight), patterns, variances,
                     tuple((key, n) for n in names), key)
    if SLOW not in stream.dof or rows < SHORT:
        return found
    return with_slow(found, slow_waves(position, max(stream.length, spacing_of(position))) / factor[:, None])
