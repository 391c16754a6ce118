"""The cheapest next experiment that tells the remaining rivals apart.

Separation of a pair by an experiment: d'(V + J_i S_i J_i' + J_j S_j J_j')^-1 d with d the
difference of predictions, S the covariance of each rival's parameters.  Without the covariance
terms experiments are proposed whose difference the parameters would swallow.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from itertools import combinations
from typing import Any, TypeVar

import numpy as np

from discrepancy.inference.refit.refit import Refit
from fmu_src.arrays import Floats

ENOUGH = 6.0
"""Separation (chi-square) from which two rivals count as told apart."""


@dataclass(frozen=True)
class Experiment:
    """A possible experiment.  ``deviation`` of its noise by sample, or ``covariance``; ``cost`` in any one unit."""

    name: str
    cost: float
    deviation: Floats | float = 1.0
    covariance: Floats | None = None
    settings: Mapping[str, float] = field(default_factory=dict)


@dataclass(frozen=True)
class RivalLaw:
    """A rival with its fitted parameters, their covariance and its weight."""

    name: str
    values: Mapping[str, float]
    names: Sequence[str]
    covariance: Floats
    scales: Floats
    weight: float = 1.0


@dataclass(frozen=True)
class Proposal:
    """An experiment with its worth: ``separation`` of each pair, the least and the weighted mean."""

    experiment: str
    settings: dict[str, float]
    cost: float
    score: float
    least: float
    separation: dict[str, float]

    def to_dict(self) -> dict[str, Any]:
        return dict(self.__dict__)


@dataclass(frozen=True)
class NextExperiment:
    """``separable`` says whether any experiment is enough; ``proposals`` best first (enough ones by cost)."""

    separable: bool
    verdict: str
    proposals: list[Proposal]
    at_stake: dict[str, float]

    def to_dict(self) -> dict[str, Any]:
        return {"separable": self.separable, "verdict": self.verdict, "proposals": [p.to_dict() for p in self.proposals], "at_stake": self.at_stake}


E = TypeVar("E", bound=Experiment)
Predict = Callable[[RivalLaw, Mapping[str, float], E], Floats]
"""Prediction of an experiment by a rival with given parameter values."""


def separation(predict: Predict[E], experiment: E, rivals: Sequence[RivalLaw]) -> dict[tuple[str, str], float]:
    """Chi-square by which the experiment would tell each pair apart."""
    responses, spreads = {}, {}
    for rival in rivals:
        y = np.atleast_1d(predict(rival, rival.values, experiment)).astype(float)
        jacobian = np.empty((y.size, len(rival.names)))
        for k, (name, scale) in enumerate(zip(rival.names, rival.scales)):
            step = 0.01 * scale
            jacobian[:, k] = (np.atleast_1d(predict(rival, {**rival.values, name: rival.values[name] + step}, experiment)) - y) / step
        responses[rival.name] = y
        values, vectors = np.linalg.eigh(0.5 * (rival.covariance + rival.covariance.T))
        spreads[rival.name] = jacobian @ (vectors * np.sqrt(np.maximum(values, 0.0)))
    result = {}
    for a, b in combinations(rivals, 2):
        d = responses[a.name] - responses[b.name]
        spread = np.hstack([spreads[a.name], spreads[b.name]])
        if experiment.covariance is not None:
            root = np.linalg.cholesky(experiment.covariance)
            d, spread = np.linalg.solve(root, d), np.linalg.solve(root, spread)
        else:
            deviation = np.broadcast_to(np.asarray(experiment.deviation, dtype=float), d.shape)
            d, spread = d / deviation, spread / deviation[:, None]
        # Woodbury: the noise is white now, the parameters add a low rank
        inner = np.eye(spread.shape[1]) + spread.T @ spread
        along = spread.T @ d
        result[(a.name, b.name)] = float(max(d @ d - along @ np.linalg.solve(inner, along), 0.0))
    return result


def next_experiment(predict: Predict[E], experiments: Sequence[E], rivals: Sequence[RivalLaw],
                    interests: Sequence[E] = (), enough: float = ENOUGH) -> NextExperiment:
    """The cheapest experiment that separates all pairs, or the best there is.

    ``interests`` are conditions whose outcome matters: the difference of the rivals there is what
    it would cost not to know.
    """
    weight = {r.name: r.weight for r in rivals}
    proposals = []
    for experiment in experiments:
        pairs = separation(predict, experiment, rivals)
        total = sum(weight[a] * weight[b] for a, b in pairs) or 1.0
        score = sum(weight[a] * weight[b] * v for (a, b), v in pairs.items()) / total
        least = min(pairs.values(), default=0.0)
        proposals.append(Proposal(experiment.name, dict(experiment.settings), experiment.cost, score, least,
                                  {f"{a} ~ {b}": v for (a, b), v in pairs.items()}))
    good = sorted((p for p in proposals if p.least >= enough), key=lambda p: (p.cost, -p.score))
    rest = sorted((p for p in proposals if p.least < enough), key=lambda p: -p.score)
    stake = {}
    for condition in interests:
        ys = [np.atleast_1d(predict(r, r.values, condition)) for r in rivals]
        stake[condition.name] = float(max((np.max(np.abs(a - b)) for a, b in combinations(ys, 2)), default=0.0))
    if good:
        verdict = f"{good[0].experiment} separates all rivals (least separation {good[0].least:.1f}) at cost {good[0].cost:g}"
    elif rest and rest[0].score >= enough:
        verdict = f"no experiment separates every pair; {rest[0].experiment} separates most"
    else:
        verdict = "cannot be separated on this rig: no setting within the limits reaches " + f"{enough:g}"
    return NextExperiment(bool(good), verdict, good + rest, stake)


def rival_of(refit: Refit, weight: float | None = None, least: float | None = None) -> RivalLaw:
    """A rival from a refit; the weight follows from its chi-square above the ``least``."""
    parameters = refit.fit.parameters
    if weight is None:
        weight = float(np.exp(-0.5 * max(refit.fit.chi2 - (refit.fit.chi2 if least is None else least), 0.0)))
    return RivalLaw(refit.name, dict(refit.fit.values), [p.name for p in parameters], refit.covariance,
                    np.array([p.scale for p in parameters]), weight)
