"""Where the roller cages stood in each run, from the ripple that rollers leave in the transmission error, and from the form of loops at one place.

Nobody knows where the cages stand when a run begins, and they stand elsewhere at the next; the error repeats with the pitch of the
rollers.  Found with the base model and kept as a correction.  An effect that changes the ripple (a clearance of the bearings) has its
own: found anew when the effect is fitted for good.
"""

from collections.abc import Callable, Collection, Mapping, Sequence
from dataclasses import replace

import numpy as np

from discrepancy.held_names import HELD, LOCKED_AT
from discrepancy.outlying_samples import bridged
from discrepancy.prediction.apart import apart
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.cage_ripples import errors_of_cages
from discrepancy.prediction.conditions import turns_of
from discrepancy.prediction.fewer import fewer
from discrepancy.prediction.observe import OBSERVED, ripples_of_cages
from discrepancy.prediction.over_angle import CAGES, QUARTERS, is_rolled_over, passed_at
from discrepancy.prediction.parabola import vertex
from discrepancy.prediction.whitening import whitening
from discrepancy.problem import Record, is_unplaced
from fmu_src.arrays import Floats
from fmu_src.threads import Threads

# Samples that a ripple can be found in, and the form of a loop.
LONG, LONG_LOOP = 40, 16
# Places of the cages within a pitch that are weighed.
PLACES = 64
# A place that is known so well is looked for once more, so far to either side, at so many places.
KNOWN, BESIDE, LOOKS = 0.9, 0.08, 17
# Steps in which the place of a ripple that has kinks is looked for once more.
STEPS = (0.04, 0.01)
# Places at which the ripple is computed, at most; by so much a series through twice as many misses less.
MOST_PLACES, DOUBLED = 16, 3.0
# What it may miss, of what a prediction may err.
HALF = 0.5
# Share of itself by which a ripple errs at few nodes.
RIPPLE_ERRS = 0.06

# A record as it is seen with the effects of values, and the values that a reducer knows of it.
AsSeen = Callable[[Record, Mapping[str, float]], tuple[Record, dict[str, float]]]


class Cages:
    """Corrections by run, for the base model and for sets of effects; ``amplitudes`` says by name where an effect is off."""

    def __init__(self, bench: Bench, records: Sequence[Record], as_seen: AsSeen, threads: Threads):
        self.bench, self.as_seen, self.threads = bench, as_seen, threads
        self.pitch = bench.reducer.topology.roller_pitch
        self.records = apart([bridged(r) for r in records if tells(r) or is_unplaced(r)])
        self.amplitudes: dict[str, float] = {}
        self.ripples: dict[frozenset[str], dict[str, Floats]] = {}
        # How far the cages stand ahead [rad] of the angle that rollers pass, by run, if an effect acts as each of them does: it is seen with them there.
        self.ahead: dict[frozenset[str], dict[str, float]] = {}

    def effects(self, values: Mapping[str, float]) -> frozenset[str]:
        """The effects' amplitudes that are on."""
        return frozenset(n for n, v in values.items() if n in self.amplitudes and v != self.amplitudes[n])

    def placed(self, record: Record, effects: frozenset[str], values: Mapping[str, float]) -> Record:
        """The record with its cages where they stand, if that is known beside ``effects`` that act as each roller passes: with the angle that is passed
        they go on, so that a roller is over it at the same time."""
        ahead = self.ahead.get(effects, {}).get(record.name)
        return record if ahead is None else replace(record, factors={**record.factors, CAGES: ahead + passed_at(values)})

    def ripple(self, record: Record, values: Mapping[str, float]) -> Floats | None:
        """What the record's cages add [rad] to a prediction with the cages where rolling from 0 brings them."""
        effects = self.effects(values)
        if record.name in self.ahead.get(effects, {}):
            return None
        placed = self.ripples.get(effects) or self.ripples.get(frozenset(), {})
        return placed.get(record.name)

    def place(self, values: Mapping[str, float], names: Collection[str] | None = None) -> bool:
        """Find the cages with ``values``, of runs of these ``names`` alone where some are given; False if there is nothing to find them by."""

        def one(record: Record) -> Floats | float | None:
            seen, own = self.as_seen(record, values)
            # A mean over positions of the cranks is one over those of the cages.
            return self.found(seen, own) if tells(seen) else None

        self.ahead.pop(self.effects(values), None)
        chosen = [record for record in self.records if names is None or record.name in names]
        made = self.threads.told("placing the roller cages", one, chosen, lambda record: record.name)
        found = {record.name: place for record, place in zip(chosen, made) if place is not None}
        self.ripples[self.effects(values)] = {name: place for name, place in found.items() if not isinstance(place, float)}
        if ahead := {name: place for name, place in found.items() if isinstance(place, float)}:
            self.ahead[self.effects(values)] = ahead
        return bool(found)

    def found(self, record: Record, own: dict[str, float]) -> Floats | float:
        """What the record's cages add [rad]; where an effect acts as each roller passes and it is known where they stand, how far ahead of it [rad]."""
        few = record if record.quantity in HELD else fewer(record, turns_of(self.bench, record))
        if few is record:
            there, ripples = OBSERVED[record.quantity](self.bench, record, own), np.array(ripples_of_cages(self.bench, record, own, QUARTERS))
        else:
            there, ripples = self.roughly(few, own)
        middle, cosine, sine = ripples.mean(axis=0), 0.5 * (ripples[0] - ripples[2]), 0.5 * (ripples[1] - ripples[3])
        misfit = few.values - there
        share, sure = resultant(np.column_stack([cosine, sine]), misfit - middle)
        if sure > KNOWN and record.quantity not in HELD and is_rolled_over(self.bench, own):
            return self.pitch * (share if few is not record else self.closest(record, own, misfit, share)) - passed_at(own)
        if few is not record:
            [ripple] = ripples_of_cages(self.bench, record, own, [share])
            exactly = (1.0 - sure) * RIPPLE_ERRS * float(np.std(ripple)) > self.bench.allowed(record)
            ahead = np.array(ripples_of_cages(self.bench, record, own, QUARTERS, True)) if exactly else self.roughly(record, own)[1]
            middle = ahead.mean(axis=0)
        elif sure > KNOWN:
            # Shared by all runs of a condition, wherever their cages stand.
            ripples = self.closer(record, own, ripples)
            share = likeliest(ripples, misfit, share)
            ripple, middle = (weights(np.array([share]), len(ripples)) @ ripples)[0], ripples.mean(axis=0)
        else:
            [ripple] = ripples_of_cages(self.bench, record, own, [share])
        # The ripple's form at the likeliest place as far as that is known, else its mean over all places.
        placed: Floats = sure * ripple + (1.0 - sure) * middle
        return placed

    def closer(self, record: Record, own: dict[str, float], ripples: Floats) -> Floats:
        """The ``ripples`` (k, n) at equal places of the pitch, at so many that nobody sees what the series through them misses."""
        missed = np.inf
        while len(ripples) < MOST_PLACES and missed > HALF * DOUBLED * self.bench.allowed(record):
            between = (np.arange(len(ripples)) + 0.5) / len(ripples)
            new = np.array(ripples_of_cages(self.bench, record, own, between))
            missed = float(np.sqrt(np.mean((weights(between, len(ripples)) @ ripples - new) ** 2)))
            ripples = np.stack([ripples, new], axis=1).reshape(-1, ripples.shape[1])
        return ripples

    def closest(self, record: Record, own: dict[str, float], misfit: Floats, share: float) -> float:
        """The place next to ``share`` of the pitch at which the ripple leaves least of the ``misfit``, each computed where it is: it has kinks."""
        for step in STEPS:
            left = [misfit - ripple for ripple in ripples_of_cages(self.bench, record, own, (share - step, share, share + step))]
            white = whitening(left[1])
            before, at, after = (float(np.sum(white(series) ** 2)) for series in left)
            share += step * vertex(before, at, after, 1.0)
        return share

    def roughly(self, record: Record, own: dict[str, float]) -> tuple[Floats, Floats]:
        """Transmission error [rad] as it is predicted wherever cages stand, and its ripple at ``QUARTERS``, which errs by ``RIPPLE_ERRS`` of itself."""
        errors = np.array(errors_of_cages(self.bench, record, own, [share * self.pitch for share in QUARTERS]))
        there: Floats = errors.mean(axis=0) if is_rolled_over(self.bench, own) else errors[0]
        return there, errors - there


def tells(record: Record) -> bool:
    """Whether a record may tell where its cages stood: a loop does at one place; elsewhere a mean over many is predicted."""
    if record.quantity == "hysteresis":
        return LOCKED_AT in record.factors and record.tags.get("locked") != "output" and "torque" in record.axes and len(record.values) >= LONG_LOOP
    return record.quantity == "transmission_error" and "angle" in record.axes and len(record.values) >= LONG


def resultant(basis: Floats, misfit: Floats) -> tuple[float, float]:
    """Mean of the cages' place over what is likely: its direction as a share of the rollers' pitch, and its length (1: known, 0: anything).

    ``basis`` (n, 2) is the ripple's fundamental with the cages at 0 and a quarter of the pitch ahead, ``misfit`` (n,) what it shall explain.
    Noise of an instrument is loud where nothing fast is: it is weighed by what one sample does not say of the next.
    """
    basis, misfit = basis - basis.mean(axis=0), misfit - misfit.mean()
    parts, *_ = np.linalg.lstsq(basis, misfit, rcond=None)
    white = whitening(misfit - basis @ parts)
    basis, misfit = white(basis), white(misfit)
    phases = np.linspace(0.0, 2.0 * np.pi, PLACES, endpoint=False)
    waves = np.array([np.cos(phases), np.sin(phases)])
    # Squares of what each place leaves, by their products: over all samples once.
    chi2 = np.sum((basis.T @ basis @ waves) * waves, axis=0) - 2.0 * (basis.T @ misfit) @ waves
    weights = np.exp(-0.5 * (chi2 - chi2.min()))
    mean = complex(np.sum(weights * np.exp(1j * phases)) / np.sum(weights))
    return float(np.angle(mean)) / (2.0 * np.pi), abs(mean)


def weights(shares: Floats, count: int) -> Floats:
    """(m, count): what each of ``count`` equal places of the pitch, the first at 0, adds at ``shares`` (m,) to the trigonometric series through them."""
    turns = 2.0 * np.pi * (shares[:, None] - np.arange(count) / count)
    harmonics = sum((2.0 * np.cos(h * turns) for h in range(1, count // 2)), np.cos(count // 2 * turns))
    found: Floats = (1.0 + harmonics) / count
    return found


def likeliest(ripples: Floats, misfit: Floats, share: float) -> float:
    """The place about ``share`` at which the ripple, of which ``ripples`` (k, n) are known at equal places, leaves least of the ``misfit`` (n,)."""
    white = whitening(misfit - (weights(np.array([share]), len(ripples)) @ ripples)[0])
    columns = white(np.column_stack([misfit, *ripples]))
    shares = share + np.linspace(-BESIDE, BESIDE, LOOKS)
    shown = np.column_stack([np.ones(LOOKS), -weights(shares, len(ripples))])
    # Squares of what each place leaves, by products over all samples once.
    left = np.einsum("ij,jk,ik->i", shown, columns.T @ columns, shown)
    best = int(np.clip(np.argmin(left), 1, LOOKS - 2))
    before, at, after = left[best - 1 : best + 2]
    step = vertex(before, at, after, 1.0)
    return float(shares[best]) + step * float(shares[1] - shares[0])
