"""The measured records, their noise, and the model fitted to them as it stands."""

import copy
from collections.abc import Mapping, Sequence

import numpy as np

from discrepancy.inference.base_fit.fit import Box, Fit, fit_of
from discrepancy.inference.base_fit.predictions import Predictions
from discrepancy.inference.noise.noise import Noise, estimate
from discrepancy.problem import Candidate, Model, OnThreads, Parameter
from fmu_src.arrays import Floats
from fmu_src.threads import Threads

STEP = 0.01
"""Step of a finite difference in units of ``Parameter.scale``."""
STALE = 0.3
"""Move of a nuisance, in units of its scale, after which sensitivities are taken anew."""


def rows_of(noise: Noise, indices: Sequence[int]) -> tuple[dict[int, slice], int]:
    """Rows of each record in a stack of whitened records, and the height of the stack."""
    rows: dict[int, slice] = {}
    start = 0
    for i in indices:
        size = noise.whiteners[i].size
        rows[i] = slice(start, start + size)
        start += size
    return rows, start


class Workspace:
    """Records, noise and whitening; columns of parameters are stacked over the training records."""

    # What ``fit_base`` finds.
    noise: Noise
    base: Fit

    def __init__(self, model: Model):
        self.model, self.threads = model, model.threads if isinstance(model, OnThreads) else Threads()
        self.records = list(model.records)
        self.predictions = Predictions(model)
        self.training = [i for i, r in enumerate(self.records) if r.fitted]
        self.held_out = [i for i, r in enumerate(self.records) if r.unused]
        if not self.training:
            raise ValueError("every record is held out: nothing is left to fit; mark some conditions as training")

    @property
    def conditions(self) -> list[str]:
        """Those of the training records, in their order."""
        return list(dict.fromkeys(self.records[i].condition for i in self.training))

    # rows ---------------------------------------------------------------------------------
    def lay_out(self) -> None:
        """Which rows of the stack belong to which training record."""
        self.rows, self.size = rows_of(self.noise, self.training)

    def only(self, kept: Sequence[int]) -> "Workspace":
        """The same with these training records alone."""
        other = copy.copy(self)
        other.training = list(kept)
        other.lay_out()
        return other

    def whiten(self, arrays: Mapping[int, Floats]) -> Floats:
        """Whitened stack over the training records; records not given are zero."""
        width = next((a.shape[1] for a in arrays.values() if a.ndim == 2), None)
        result = np.zeros(self.size if width is None else (self.size, width))
        for i, a in arrays.items():
            result[self.rows[i]] = self.noise.whiteners[i](a)
        return result

    def touched(self, candidate: Candidate | None) -> list[int]:
        if candidate is None or not candidate.signals:
            return list(range(len(self.records)))
        return [i for i, r in enumerate(self.records) if r.quantity in candidate.signals]

    def furthest_off(self, candidate: Candidate) -> int:
        """Of the training records that a candidate can touch the one with the largest misfit of the base fit."""
        return max((i for i in self.touched(candidate) if i in self.rows), key=lambda i: float(np.sum(self.base.residual[self.rows[i]] ** 2)))

    def residual(self, values: Mapping[str, float]) -> Floats:
        ys = self.predictions(values, self.training)
        return self.whiten({i: self.records[i].values - y for i, y in zip(self.training, ys)})

    def raw_residuals(self, values: Mapping[str, float]) -> tuple[list[Floats], list[Floats]]:
        every = list(range(len(self.records)))
        ys = self.predictions(values, every)
        return [np.asarray(r.values, dtype=float) - y for r, y in zip(self.records, ys)], ys

    # sensitivities ------------------------------------------------------------------------
    def column(self, values: Mapping[str, float], parameter: Parameter, which: Sequence[int]) -> dict[int, Floats]:
        """Finite difference by one parameter, by record, per unit of the parameter."""
        at = values.get(parameter.name, parameter.off)
        step = STEP * parameter.scale
        if not parameter.lower <= at + step <= parameter.upper:
            step = -step
        here = {**values, parameter.name: at}
        high = self.predictions.beside({**values, parameter.name: at + step}, here, which)
        low = self.predictions.beside(here, here, which)
        return {i: (a - b) / step for i, a, b in zip(which, high, low)}

    def columns(self, parameters: Sequence[Parameter], values: Mapping[str, float]) -> Floats:
        """Sensitivities (N, p) of the training records at ``values``, whitened."""
        return self._stack(self.threads.map(lambda p: self.column(values, p, self.training), parameters))

    def _everywhere(self, nuisances: Sequence[Parameter], values: Mapping[str, float]) -> list[dict[int, Floats]]:
        """Sensitivities of all records, those held out too, as far as they are not zero."""
        every = list(range(len(self.records)))

        def shown(p: Parameter) -> dict[int, Floats]:
            return {i: c for i, c in self.column(values, p, every).items() if np.any(c)}

        return self.threads.told("base fit, sensitivity", shown, nuisances, lambda p: f"to {p.name}")

    def _stack(self, raw: Sequence[Mapping[int, Floats]]) -> Floats:
        stacked = np.zeros((self.size, len(raw)))
        for k, columns in enumerate(raw):
            for i, c in columns.items():
                if i in self.rows:
                    stacked[self.rows[i], k] = self.noise.whiteners[i](c)
        return stacked

    # the model as it stands ---------------------------------------------------------------
    def fit_base(self, passes: int = 2) -> Fit:
        """Nuisances fitted and noise estimated in turn: the differences of replicates need the phases of their mountings."""
        nuisances = self.model.nuisances
        values = {p.name: p.off for p in nuisances}
        sensitivities = None
        for k in range(passes):
            if k == 1:
                # What the model corrects for itself it found where the nuisances start.
                self.predictions.settle(values)
            self.noise = estimate(self.records, *self.raw_residuals(values))
            self.lay_out()
            if not nuisances:
                break
            if sensitivities is None:
                sensitivities = self._everywhere(nuisances, values)
            values = self._nuisances_from(values, sensitivities)
        self.raw_nuisance = self._everywhere(nuisances, values)
        jacobian = self._stack(self.raw_nuisance)
        self.base = fit_of(nuisances, values, self.residual(values), jacobian)
        # nuisances that no training record can see (mounting phases of held-out runs), and of which nothing is known otherwise
        self.blind = [k for k, p in enumerate(nuisances) if p.prior is None and not np.any(jacobian[:, k])]
        return self.base

    def _nuisances_from(self, values: Mapping[str, float], raw: Sequence[Mapping[int, Floats]]) -> dict[str, float]:
        """Fitted nuisances; sensitivities ``raw`` at ``values`` serve until one has moved far."""
        box = Box(self.model.nuisances)
        at: Floats | None = None
        known = self._stack(raw)

        def columns(x: Floats) -> Floats:
            nonlocal at, known
            if at is None:
                at = x.copy()
            elif np.max(np.abs(x - at) / box.scale) > STALE:
                at, known = x.copy(), self._stack(self._everywhere(self.model.nuisances, box.named(x)))
            return known

        # residuals spoilt by samples left out are zero there: whitening drops them
        solution = box.minimise(lambda x: self.residual(box.named(x)), columns, box.array(values), inside=0.3, xtol=1e-6, ftol=1e-7, evaluations=12)
        return box.named(solution.x)
