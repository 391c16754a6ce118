"""Try: runs with as many samples as a screen shows, and what of a campaign that is."""

import math
from collections.abc import Sequence
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from discrepancy.inference.noise.series import stream_of
from discrepancy.problem import Record
from pages.words import counted, ordinal

# Samples of the curve that follows the hand: more than a screen is wide make no picture better.
FEW = 1200


def thinned(record: Record) -> Record:
    """A run with the samples that are ``kept_of`` it."""
    kept, every = kept_of(record), len(record.values)
    if len(kept) == every:
        return record
    axes = {k: np.asarray(v)[kept] if np.size(v) == every else v for k, v in record.axes.items()}
    return replace(record, values=np.asarray(record.values)[kept], axes=axes)


def kept_of(record: Record) -> npt.NDArray[np.intp]:
    """Of an angle the first turn alone, for a line through few samples of many waves shows none of them."""
    kept = np.arange(len(record.values))
    if "angle" in record.axes and len(kept) > FEW:
        angle = np.abs(np.asarray(record.axes["angle"]) - record.axes["angle"][0])
        kept = np.flatnonzero(angle < 2.0 * math.pi) if angle.max() > 2.0 * math.pi else kept
    return kept[:: max(1, math.ceil(len(kept) / FEW))]


def looked_at(runs: Sequence[Record], campaign: Sequence[Record]) -> str:
    """Of which runs and samples an error of a signal is, of those that its ``campaign`` has of it."""
    [signal] = {stream_of(run) for run in runs}
    whole = {run.name: run for run in campaign if stream_of(run) == signal}
    held = sum(run.held_out for run in runs)
    kinds = "" if held in (0, len(runs)) else f" ({len(runs) - held} fitted, {held} held out, together)"
    few, every = (sum(len(one) for one in samples) for samples in ([kept_of(whole[run.name]) for run in runs], [whole[run.name].values for run in runs]))
    samples = f", {few:,} of their {every:,} samples" if few < every else ""
    return f"{len(runs)} of {counted(len(whole), 'run')}{kinds}{samples}"


def of_one(run: Record, whole: Record) -> str:
    """The same of one run that is drawn."""
    few, every = len(kept_of(whole)), len(whole.values)
    return f"this run alone{' (held out)' if run.held_out else ''}{f', {few:,} of its {every:,} samples' if few < every else ''}"


def taken_words(record: Record, records: Sequence[Record]) -> str:
    """What of a run, and how many of all runs, are looked at: one of each condition; empty where that is all there is."""
    shown = len({(stream_of(one), one.condition) for one in records})
    said = [f"{shown} of {len(records)} runs, one of each condition"] if shown < len(records) else []
    kept, every = kept_of(record), len(record.values)
    if len(kept) < every:
        step = int(kept[1] - kept[0])
        # Of the last step as many are left as there are.
        first_turn = kept[-1] + step < every
        parts = [*(["the first turn"] if first_turn else []), *([f"every {ordinal(step)} sample"] if step > 1 else [])]
        said.append(f"of this one {', '.join(parts)} ({len(kept):,} of {every:,} samples)")
    return "; ".join(said)
