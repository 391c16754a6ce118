"""d': the size of a hidden law in units of the noise, after what may be calibrated is projected out."""

import copy
from collections.abc import Callable

import numpy as np
from scipy.linalg import cholesky, solve_triangular

from benchmarks.blind_trial.generator.designs import Design, Series
from benchmarks.blind_trial.generator.noise import Noise
from benchmarks.blind_trial.generator.truth import Bench, Truth
from fmu_src.arrays import Floats

FREE_LEVEL = ("transmission_error", "hysteresis")


# From so many samples on a record's ends do not count, and its noise is whitened frequency by frequency.
LONG = 2000
Whiten = Callable[[Floats], Floats]


def whitener(noise: Noise, y: Floats, of_axis: Floats) -> Whiten:
    """Makes white what a record's noise around ``y`` is, with the variance ``of_axis`` (n,) that its axis adds."""
    n = len(y)
    if n <= LONG:
        covariance = noise.covariance(y) + np.diag(of_axis)
        root = cholesky(covariance + 1e-12 * np.trace(covariance) / n * np.eye(n), lower=True)
        return lambda change: np.asarray(solve_triangular(root, change, lower=True))
    assert noise.relative == noise.gain == 0.0, "the noise of a long record does not go with its values"
    power = np.sqrt(noise.spectrum(n) + noise.quantum**2 / 12.0 + float(of_axis.mean()))

    def coloured(change: Floats) -> Floats:
        return np.asarray(np.fft.ifft(np.fft.fft(change) / power).real)

    # What differs from run to run: offset and drift; (1 + D D')^-1/2 by the singular values of D.
    patterns = [noise.offset * noise.sigma * np.ones(n), noise.drift * noise.sigma * np.linspace(-0.5, 0.5, n)]
    basis, sizes, _ = np.linalg.svd(np.column_stack([coloured(p) for p in patterns]), full_matrices=False)
    shrink = 1.0 - 1.0 / np.sqrt(1.0 + sizes**2)

    def whiten(change: Floats) -> Floats:
        white = coloured(change)
        return white - basis @ (shrink * (basis.T @ white))

    return whiten


def axis_variance(design: Design, s: Series, y: Floats) -> Floats:
    """Variance (n,) of the values by what their axis errs by."""
    for axis, deviation in design.axis_noise.items():
        if axis in s.axes:
            steps, rise = np.diff(s.axes[axis]), np.diff(y)
            slope = np.divide(rise, steps, out=np.zeros(len(steps)), where=steps != 0.0)
            return np.asarray((np.append(slope, slope[-1]) * deviation) ** 2)
    return np.zeros(len(y))


class Ruler:
    """Whitened training series of one campaign and its nuisance columns."""

    def __init__(self, design: Design, nominal: dict[str, float], bench: Bench):
        self.design, self.nominal, self.bench = design, nominal, bench
        self.series = [s for s in design.series if s.condition not in design.held_out]
        self.base = [bench.values(s, []) for s in self.series]
        self.whiteners: list[Whiten] = []
        known: dict[tuple[Noise, int], Whiten] = {}
        for s, y in zip(self.series, self.base):
            noise = s.noise
            plain = noise.relative == noise.gain == 0.0 and not design.axis_noise
            made = known.get((noise, len(y))) if plain else None
            made = made or whitener(noise, y, axis_variance(design, s, y))
            if plain:
                known[(noise, len(y))] = made
            self.whiteners.append(made)
        self.columns = self.nuisance_columns()

    def white(self, changes: list[Floats]) -> Floats:
        return np.concatenate([np.sqrt(s.replicates) * whiten(c) for s, whiten, c in zip(self.series, self.whiteners, changes)])

    def nuisance_columns(self) -> Floats:
        """Columns of declared nuisances, free levels and free zeros, with their priors below."""
        columns, priors = [], []
        zero = [np.zeros(len(y)) for y in self.base]
        for i, s in enumerate(self.series):
            if s.quantity in FREE_LEVEL:
                columns.append(self.white([np.ones(len(y)) if k == i else z for k, (y, z) in enumerate(zip(self.base, zero))]))
                priors.append(0.0)
        for name, entry in self.design.nuisances.items():
            unit = 1e-6 if entry["unit"] == "um" else 1.0
            step = 0.01 * entry["start"] * unit
            moved = Bench({**self.nominal, name: self.nominal[name] + step}, name=self.bench.plain.name)
            # Only what the parameter can touch.
            touched = ("wear_depth", "wear_profile") if name != "mesh_stiffness" else FREE_LEVEL
            changes = [(moved.values(s, []) - y) / step if s.quantity in touched else z for s, y, z in zip(self.series, self.base, zero)]
            columns.append(self.white(changes))
            priors.append(1.0 / (entry["prior"] * unit))
        for mounting in self.design.zeros:
            changes = []
            for s, y, z in zip(self.series, self.base, zero):
                own = s.quantity == "transmission_error" and self.design.mounting.get(s.condition) == mounting
                changes.append(np.gradient(y, s.axes["angle"]) if own else z)
            columns.append(self.white(changes))
            priors.append(0.0)
        if not columns:
            return np.zeros((sum(map(len, self.base)), 0))
        stack = np.column_stack(columns)
        sizes = np.linalg.norm(stack, axis=0)
        keep = sizes > 0.0
        stack = np.vstack([stack, np.diag(priors)])[:, keep] / sizes[keep]
        return np.linalg.qr(stack)[0]

    def beside(self, law: Truth) -> "Ruler":
        """The same ruler where a law's size may be calibrated too."""
        found, column = copy.copy(self), self.column([law])
        found.columns = np.column_stack([self.columns, column / np.linalg.norm(column)])
        return found

    def column(self, truths: list[Truth]) -> Floats:
        """What the laws change together at their present strengths, whitened, what may be calibrated projected out."""
        changes = []
        for s, y in zip(self.series, self.base):
            touched = [t for t in truths if s.quantity in t.quantities]
            changes.append(self.bench.values(s, touched) - y if touched else np.zeros(len(y)))
        return self.projected(changes)

    def projected(self, changes: list[Floats]) -> Floats:
        """Changes of the training series, whitened, what may be calibrated projected out."""
        column = self.white(changes)
        column = np.concatenate([column, np.zeros(self.columns.shape[0] - len(column))])
        return np.asarray(column - self.columns @ (self.columns.T @ column))

    def size(self, truths: list[Truth]) -> float:
        """d' of the laws together at their present strengths."""
        return float(np.linalg.norm(self.column(truths)))

    def set_strength(self, truth: Truth, target: float) -> float:
        """Finds the law's ``a`` within its physical range; returns the noise factor that meets ``target`` then."""
        best = (np.inf, truth.a)
        for _ in range(6):
            size = self.size([truth])
            ratio = target / size if size > 0.0 else 10.0
            best = min(best, (abs(np.log(max(ratio, 1e-9))), truth.a))
            if abs(ratio - 1.0) < 0.04:
                break
            trial = float(np.clip(truth.a * np.clip(ratio, 0.05, 20.0), truth.low, truth.high))
            if trial == truth.a:
                break
            truth.a = trial
        truth.a = best[1]
        return self.size([truth]) / target
