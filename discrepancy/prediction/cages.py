"""Where the roller cages stood in each run, from the ripple that rollers leave in the transmission error.

Nobody knows where the cages stand when a run begins, and they stand elsewhere at the next; the error repeats with the pitch of the
rollers.  Found with the base model and kept as a correction.  An effect that changes the ripple (a clearance of the bearings) has its
own: found anew when the effect is fitted for good.
"""

from collections.abc import Callable, Mapping, Sequence

import numpy as np
from scipy.linalg import solve_toeplitz

from discrepancy.prediction.bench import Bench
from discrepancy.prediction.conditions import turns_of
from discrepancy.prediction.curves import OF_RIPPLE, errors_of_cages
from discrepancy.prediction.fewer import fewer
from discrepancy.prediction.observe import ripple_of_cages, transmission_error
from discrepancy.problem import Record
from fmu_src.arrays import Floats
from fmu_src.progress import task

# Samples that a ripple can be found in.
LONG = 40
# Places of the cages within a pitch that are weighed.
PLACES = 64
# Parts of the pitch beside 0 at which the ripple is looked at.
QUARTERS = (0.25, 0.5, 0.75)
# A place that is known so well is looked for so far to either side once more, and closer again.
KNOWN, BESIDE, CLOSE_BESIDE = 0.9, 0.08, 0.05
# What a ripple to first order misses may add to chi-square, root.
SHOWS = 1.0
# Samples that one of the noise remembers.
LAGS = 10
# Share of itself by which a ripple errs at few nodes.
RIPPLE_ERRS = 0.06

ForRecord = Callable[[Record, Mapping[str, float]], dict[str, float]]


class Cages:
    """Corrections by run, for the base model and for sets of effects; ``amplitudes`` says by name where an effect is off."""

    def __init__(self, bench: Bench, records: Sequence[Record], for_record: ForRecord):
        self.bench, self.for_record = bench, for_record
        self.records = [r for r in records if r.quantity == "transmission_error" and "angle" in r.axes and len(r.values) >= LONG]
        self.amplitudes: dict[str, float] = {}
        self.ripples: dict[frozenset[str], dict[str, Floats]] = {}

    def effects(self, values: Mapping[str, float]) -> frozenset[str]:
        """The effects' amplitudes that are on."""
        return frozenset(n for n, v in values.items() if n in self.amplitudes and v != self.amplitudes[n])

    def ripple(self, record: Record, values: Mapping[str, float]) -> Floats | None:
        """What the record's cages add [rad] to a prediction with the cages where rolling from 0 brings them."""
        placed = self.ripples.get(self.effects(values)) or self.ripples.get(frozenset(), {})
        return placed.get(record.name)

    def place(self, values: Mapping[str, float]) -> bool:
        """Find the cages with ``values``; False if there is nothing to find them by."""
        found: dict[str, Floats] = {}
        with task("placing the roller cages", total=len(self.records)) as placing:
            for record in self.records:
                found[record.name] = self.found(record, self.for_record(record, values))
                placing.advance()
        self.ripples[self.effects(values)] = found
        return bool(self.records)

    def found(self, record: Record, own: dict[str, float]) -> Floats:
        few = fewer(record, turns_of(self.bench, record))
        if few is record:
            there = transmission_error(self.bench, record, own)
            quarter, half, last = (ripple_of_cages(self.bench, record, own, share) for share in QUARTERS)
        else:
            there, (quarter, half, last) = self.roughly(few, own, QUARTERS)
        middle, cosine, sine = (quarter + half + last) / 4.0, -half / 2.0, (quarter - last) / 2.0
        basis = np.column_stack([cosine, sine])
        misfit = few.values - there
        share, sure = resultant(basis, misfit - middle)
        exactly = False
        if sure > KNOWN and few is record:
            # To first order, and if what that misses would show, by the ripple itself.
            share, missed = self.nearer(record, own, misfit, share, BESIDE, False)
            exactly = missed > SHOWS
            if exactly:
                share, _ = self.nearer(record, own, misfit, share, CLOSE_BESIDE, True)
        ripple = ripple_of_cages(self.bench, record, own, share, exactly)
        if few is not record:
            exactly = (1.0 - sure) * RIPPLE_ERRS * float(np.std(ripple)) > self.bench.allowed(record)
            ripples = [ripple_of_cages(self.bench, record, own, s) for s in QUARTERS] if exactly else self.roughly(record, own, QUARTERS)[1]
            middle = sum(ripples, np.zeros(len(record.values))) / 4.0
        # The ripple's form at the likeliest place as far as that is known, else its mean over all places.
        return sure * ripple + (1.0 - sure) * middle

    def nearer(self, record: Record, own: dict[str, float], misfit: Floats, share: float, beside: float, exactly: bool) -> tuple[float, float]:
        """The likeliest place about ``share``, and what a ripple to first order would miss there, in units of the noise."""
        around = [share - beside, share, share + beside]
        ripples = [ripple_of_cages(self.bench, record, own, s, exactly) for s in around]
        white = whitening(misfit - ripples[1])
        return likeliest(around, ripples, misfit, white), float(np.linalg.norm(white(OF_RIPPLE * ripples[1])))

    def roughly(self, record: Record, own: dict[str, float], shares: Sequence[float]) -> tuple[Floats, list[Floats]]:
        """Transmission error [rad] where rolling from 0 brings the cages, and its ripple at ``shares`` ahead, which errs by ``RIPPLE_ERRS`` of itself."""
        pitch = 2.0 * np.pi / self.bench.reducer.topology.rollers
        there, *ahead = errors_of_cages(self.bench, record, own, [share * pitch for share in (0.0, *shares)])
        return there, [error - there for error in ahead]


def whitening(rest: Floats) -> Callable[[Floats], Floats]:
    """Prediction error of the autoregression that the noise ``rest`` (n,) follows, of unit variance; of columns (n, k) too."""
    rest = rest - rest.mean()
    order = min(LAGS, len(rest) // 8)
    products = np.array([rest[: len(rest) - lag] @ rest[lag:] for lag in range(order + 1)])
    # A little more on the diagonal: without noise the equations would have no solution.
    products[0] = products[0] * (1.0 + 1e-9) + 1e-300
    taps = np.concatenate([[1.0], -solve_toeplitz(products[:-1], products[1:])])
    error = np.convolve(rest, taps, "valid")
    scale = max(float(np.sqrt(error @ error / len(error))), 1e-150)

    def white(columns: Floats) -> Floats:
        found: Floats = np.apply_along_axis(np.convolve, 0, columns - columns.mean(axis=0), taps / scale, "valid")
        return found

    return white


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


def likeliest(shares: Sequence[float], ripples: Sequence[Floats], misfit: Floats, white: Callable[[Floats], Floats]) -> float:
    """The place between the three ``shares`` whose ripple, which is no sine, leaves least of the ``misfit``; by a parabola."""
    left = [float(np.sum(white(misfit - ripple) ** 2)) for ripple in ripples]
    step, bend = 0.5 * (left[2] - left[0]), left[0] - 2.0 * left[1] + left[2]
    if bend <= 0.0:
        return shares[int(np.argmin(left))]
    return shares[1] + (shares[2] - shares[1]) * float(np.clip(-step / bend, -1.0, 1.0))
