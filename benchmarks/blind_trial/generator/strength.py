"""d': the size of a hidden law in units of the noise, after what may be calibrated is projected out."""

import numpy as np
from scipy.linalg import cholesky, solve_triangular

from benchmarks.blind_trial.generator.designs import Design
from benchmarks.blind_trial.generator.noise import Noise
from benchmarks.blind_trial.generator.truth import Bench, Truth
from fmu_src.arrays import Floats

FREE_LEVEL = ("transmission_error", "hysteresis")


class Ruler:
    """Whitened training series of one campaign and its nuisance columns."""

    def __init__(self, design: Design, nominal: dict[str, float], bench: Bench):
        self.design, self.bench = design, bench
        self.series = [s for s in design.series if s.condition not in design.held_out]
        self.base = [bench.values(s, []) for s in self.series]
        self.roots: list[Floats] = []
        known: dict[tuple[Noise, int], Floats] = {}
        for s, y in zip(self.series, self.base):
            noise = s.noise
            key = (noise, len(y)) if noise.relative == 0.0 and noise.gain == 0.0 else None
            if key is None or key not in known:
                covariance = noise.covariance(y)
                root = cholesky(covariance + 1e-12 * np.trace(covariance) / len(y) * np.eye(len(y)), lower=True)
                if key is not None:
                    known[key] = root
            else:
                root = known[key]
            self.roots.append(root)
        self.columns = self.nuisance_columns(nominal)

    def white(self, changes: list[Floats]) -> Floats:
        return np.concatenate([
            np.sqrt(s.replicates) * solve_triangular(root, c, lower=True)
            for s, root, c in zip(self.series, self.roots, changes)
        ])  # fmt: skip

    def nuisance_columns(self, nominal: dict[str, float]) -> Floats:
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
            moved = Bench({**nominal, name: nominal[name] + step})
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

    def size(self, truths: list[Truth]) -> float:
        """d' of the laws together at their present strengths."""
        changes = []
        for s, y in zip(self.series, self.base):
            touched = [t for t in truths if s.quantity in t.quantities]
            changes.append(self.bench.values(s, touched) - y if touched else np.zeros(len(y)))
        column = self.white(changes)
        column = np.concatenate([column, np.zeros(self.columns.shape[0] - len(column))])
        return float(np.linalg.norm(column - self.columns @ (self.columns.T @ column)))

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
