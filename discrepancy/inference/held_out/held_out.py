"""Error on runs that were never used for fitting.

The unit is the noise: 1 is what replicates differ by.  It is taken over few directions, so that
the error of the model is not drowned in thousands of noisy samples: the generic functions that
carried the misfit in training, and the responses of the effects under discussion.
"""

from collections import defaultdict
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from discrepancy.inference.base_fit.components import component_grams
from discrepancy.inference.base_fit.squares import chance
from discrepancy.inference.base_fit.workspace import Workspace, rows_of
from discrepancy.inference.misfit.features import ORDERS, features
from discrepancy.inference.misfit.localise import Group, Localisation
from discrepancy.inference.noise.series import stream_of
from discrepancy.inference.refit.refit import Refit
from fmu_src.arrays import Floats

# Error over noise that noise alone makes now and then.
WITHIN_NOISE = 1.3
# In noise units over all unused runs: what changes them by less cannot be judged by them.
SEEN = 2.0


@dataclass(frozen=True)
class HeldOut:
    """Errors of one fit: ``error`` in noise units, ``rms`` by signal in its unit with the ``floor`` of noise, ``p`` of the misfit left.

    ``gain`` is what they gain in chi-square.  Not ``seen``: what is judged does nothing in these runs, so that they speak neither for nor against it.
    ``surprise``: minus twice the logarithm of how likely they are by the fit, as well as it knows them; beside that of a rival over the same directions.
    """

    before: float
    after: float
    p_after: float
    rms: dict[str, dict[str, float]]
    kind: str
    seen: bool = True
    gain: float = 0.0
    surprise: float = 0.0


class HeldOutJudge:
    """Judges fits on the held-out records (or on ``indices``) over one common set of directions."""

    def __init__(self, space: Workspace, localisation: Localisation, rivals: Sequence[Refit],
                 orders: Mapping[str, Sequence[float]] = ORDERS, most: int = 3, indices: Sequence[int] | None = None):  # fmt: skip
        self.space = space
        self.indices = space.held_out if indices is None else list(indices)
        if not self.indices:
            return
        self.rows, self.size = rows_of(space.noise, self.indices)
        self.base = self._raw(space.base.values)
        columns = []
        for finding in localisation.findings[:most]:
            columns.extend(self._finding(finding, orders))
        for rival in rivals:
            columns.append(self.response(rival))
        directions = np.column_stack(columns) if columns else np.zeros((self.size, 0))
        blind = np.column_stack([self._stack({i: c for i, c in space.raw_nuisance[k].items() if i in self.rows}) for k in space.blind]) \
            if space.blind else np.zeros((self.size, 0))
        self.blind = _orthonormal(blind)
        directions = directions - self.blind @ (self.blind.T @ directions)
        self.directions = _orthonormal(directions)
        self.grams = component_grams(space, self.directions, self.rows)

    def _stack(self, arrays: Mapping[int, Floats]) -> Floats:
        result = np.zeros(self.size)
        for i, a in arrays.items():
            result[self.rows[i]] = self.space.noise.whiteners[i](a)
        return result

    def _raw(self, values: Mapping[str, float]) -> Floats:
        ys = self.space.predictions(values, self.indices)
        return self._stack({i: self.space.records[i].values - y for i, y in zip(self.indices, ys)})

    def response(self, rival: Refit) -> Floats:
        """Whitened contribution of the effects on the held-out records."""
        own = {p.name for p in rival.own}
        rest = {k: v for k, v in rival.fit.values.items() if k not in own}
        high = self.space.predictions(rival.fit.values, self.indices)
        low = self.space.predictions(rest, self.indices)
        return self._stack({i: a - b for i, a, b in zip(self.indices, high, low)})

    def _finding(self, finding: Group, orders: Mapping[str, Sequence[float]]) -> list[Floats]:
        """The finding's function in the held-out records, with the mean over them and, if it depends on a factor, its trend."""
        blocks = {}
        for i in self.indices:
            if stream_of(self.space.records[i]) != finding.signal:
                continue
            match = next((f for f in features(self.space.records[i], orders) if f.name == finding.feature), None)
            if match is not None:
                blocks[i] = match.columns[:, :4]
        if not blocks:
            return []
        width = min(b.shape[1] for b in blocks.values())
        weights = dict.fromkeys(blocks, 1.0)
        if finding.dependence != "everywhere":
            reference = [self.space.records[i].factors[finding.dependence] for i in finding.indices]
            middle, spread = float(np.mean(reference)), float(np.std(reference)) or 1.0
            weights = {i: (self.space.records[i].factors.get(finding.dependence, middle) - middle) / spread for i in blocks}
        return [self._stack({i: weights[i] * b[:, k] for i, b in blocks.items()}) for k in range(width)]

    def error(self, values: Mapping[str, float]) -> tuple[float, int]:
        """Chi-square in the common directions and their number."""
        if not self.indices or not self.directions.shape[1]:
            return 0.0, 0
        e = self._raw(values)
        return float(np.sum((self.directions.T @ e) ** 2)), self.directions.shape[1]

    def judge(self, rival: Refit) -> HeldOut | None:
        if not self.indices or not self.directions.shape[1]:
            return None
        before, width = self.error(self.space.base.values)
        after, _ = self.error(rival.fit.values)
        known = self.directions.T @ self._raw(rival.fit.values)
        # What the fit does not know it foretells no better: noise, and the uncertainty of its parameters.
        spread = self.directions.T @ self._sensitivities(rival)
        expected = np.eye(width) + spread @ rival.covariance @ spread.T
        root = np.linalg.cholesky(expected)
        score = np.linalg.solve(root, known)
        grams = {c: np.linalg.solve(root, np.linalg.solve(root, g).T) for c, g in self.grams.items()}
        unexplained, p = chance(self.space, score, grams, {})
        surprise = unexplained + float(np.linalg.slogdet(expected)[1])
        return HeldOut(float(np.sqrt(before / width)), float(np.sqrt(after / width)), p,
                       self.rms(rival.fit.values), "held-out runs", self._visible(self.response(rival)), before - after, surprise)

    def tells(self, one: Refit, other: Refit) -> bool:
        """Whether these runs differ by more than noise between two fits."""
        return bool(self.indices) and self._visible(self._raw(one.fit.values) - self._raw(other.fit.values))

    def _visible(self, change: Floats) -> bool:
        """Whether a whitened change stands out where what cannot be known is left aside."""
        return float(np.linalg.norm(change - self.blind @ (self.blind.T @ change))) > SEEN

    def _sensitivities(self, rival: Refit) -> Floats:
        """Derivatives of the held-out runs by the fit's parameters: those of nuisances at the base fit."""
        space, own = self.space, {p.name for p in rival.own}
        nuisances = {p.name: columns for p, columns in zip(space.model.nuisances, space.raw_nuisance)}
        raw = [space.column(rival.fit.values, p, self.indices) if p.name in own else nuisances.get(p.name, {}) for p in rival.fit.parameters]
        return np.column_stack([self._stack({i: c for i, c in columns.items() if i in self.rows}) for columns in raw])

    def rms(self, values: Mapping[str, float]) -> dict[str, dict[str, float]]:
        """Root mean square by signal in its own unit, before and after, with the noise floor."""
        sums: dict[str, dict[str, list[float]]] = defaultdict(lambda: {"before": [], "after": [], "floor": []})
        base = self.space.predictions(self.space.base.values, self.indices)
        now = self.space.predictions(values, self.indices)
        for i, b, n in zip(self.indices, base, now):
            record, whitener = self.space.records[i], self.space.noise.whiteners[i]
            cell = sums[stream_of(record)]
            kept = whitener.kept
            cell["before"].append(float(np.mean((record.values - b)[kept] ** 2)))
            cell["after"].append(float(np.mean((record.values - n)[kept] ** 2)))
            cell["floor"].append(whitener.floor**2)
        return {s: {k: float(np.sqrt(np.mean(v))) for k, v in cell.items()} for s, cell in sums.items()}


def _orthonormal(columns: Floats) -> Floats:
    norms = np.linalg.norm(columns, axis=0)
    columns = columns[:, norms > 1e-9] / norms[norms > 1e-9] if columns.shape[1] else columns
    if not columns.shape[1]:
        return np.zeros((columns.shape[0], 0))
    u, s, _ = np.linalg.svd(columns, full_matrices=False)
    return u[:, s > 1e-4 * s[0]]
