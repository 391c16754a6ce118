"""The cheapest next experiment that tells the remaining rivals apart.

Separation of a pair by an experiment: d'(V + J_i S_i J_i' + J_j S_j J_j')^-1 d with d the
difference of predictions, S the covariance of each rival's parameters.  Without the covariance
terms experiments are proposed whose difference the parameters would swallow.
"""

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from itertools import combinations
from typing import Any, TypeVar

import numpy as np

from discrepancy.inference.refit.refit import Refit
from fmu_src.arrays import Floats
from fmu_src.progress import task

ENOUGH = 6.0
"""Separation (chi-square) from which two rivals count as told apart."""
ALIKE = 0.1
"""Experiments whose separations differ by less than this share (or this share of ENOUGH) are one (assumed: no rig repeats better)."""


@dataclass(frozen=True)
class Experiment:
    """A possible experiment.  ``deviation`` of its noise by sample, or ``covariance``; ``cost`` in any one unit.

    ``kind`` says what is measured at the ``settings``; only experiments of one kind can be alike.
    """

    name: str
    cost: float
    deviation: Floats | float = 1.0
    covariance: Floats | None = None
    settings: Mapping[str, float] = field(default_factory=dict)
    kind: str = ""


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
    """An experiment with its worth: ``separation`` of each pair, the least and the weighted mean.

    ``spans``: settings that make no difference, with their lowest and highest value; ``settings`` has one of them.
    """

    experiment: str
    settings: dict[str, float]
    cost: float
    score: float
    least: float
    separation: dict[str, float]
    kind: str = ""
    spans: dict[str, tuple[float, float]] = field(default_factory=dict)

    def to_dict(self) -> dict[str, Any]:
        return dict(self.__dict__)


@dataclass(frozen=True)
class NextExperiment:
    """``separable`` says whether any experiment is enough; ``proposals`` best first (enough ones by cost); ``every`` one that was tried."""

    separable: bool
    verdict: str
    proposals: list[Proposal]
    at_stake: dict[str, float]
    every: list[Proposal] = field(default_factory=list, repr=False)

    def to_dict(self) -> dict[str, Any]:
        return {"separable": self.separable, "verdict": self.verdict, "proposals": [p.to_dict() for p in self.proposals], "at_stake": self.at_stake}


E = TypeVar("E", bound=Experiment)
Predict = Callable[[RivalLaw, Mapping[str, float], E], Floats]
"""Prediction of an experiment by a rival with given parameter values."""
Naming = Callable[[Proposal], str]
"""What a proposal is called, settings that make no difference included."""


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
                    interests: Sequence[E] = (), enough: float = ENOUGH, naming: Naming = lambda p: p.experiment,
                    limits: str = "on this rig: no setting within its limits") -> NextExperiment:  # fmt: skip
    """The cheapest experiment that separates all pairs, or the best there is; those that differ by nothing useful are one.

    ``interests`` are conditions whose outcome matters: the difference of the rivals there is what
    it would cost not to know; ``limits`` says what ``experiments`` are all of.
    """
    weight = {r.name: r.weight for r in rivals}
    proposals = []
    for experiment in told(experiments):
        pairs = separation(predict, experiment, rivals)
        total = sum(weight[a] * weight[b] for a, b in pairs) or 1.0
        score = sum(weight[a] * weight[b] * v for (a, b), v in pairs.items()) / total
        least = min(pairs.values(), default=0.0)
        proposals.append(Proposal(experiment.name, dict(experiment.settings), experiment.cost, score, least,
                                  {f"{a} ~ {b}": v for (a, b), v in pairs.items()}, experiment.kind))
    every = proposals
    proposals = [replace(p, experiment=naming(p)) if p.spans else p for p in alike_together(every, enough)]
    good = sorted((p for p in proposals if p.least >= enough), key=lambda p: (p.cost, -p.score))
    rest = sorted((p for p in proposals if p.least < enough), key=lambda p: -p.score)
    stake = {}
    for condition in interests:
        ys = [np.atleast_1d(predict(r, r.values, condition)) for r in rivals]
        stake[condition.name] = float(max((np.max(np.abs(a - b)) for a, b in combinations(ys, 2)), default=0.0))
    if good:
        verdict = f"{good[0].experiment} separates all rivals (least separation {good[0].least:.1f} of chi-square) at cost {good[0].cost:g}"
    elif rest and rest[0].score >= enough:
        verdict = f"no experiment separates every pair; {rest[0].experiment} separates most"
    else:
        verdict = f"cannot be separated {limits} reaches {enough:g} of chi-square"
    return NextExperiment(bool(good), verdict, good + rest, stake, every)


def told(experiments: Sequence[E]) -> Iterator[E]:
    """The experiments one by one, told to whoever listens."""
    with task("weighing experiments", total=len(experiments)) as weighing:
        for experiment in experiments:
            weighing.what = f"weighing experiments, {experiment.name}"
            yield experiment
            weighing.advance()


def alike_together(proposals: Sequence[Proposal], enough: float = ENOUGH) -> list[Proposal]:
    """Proposals of one kind and cost that do the same at every value of a setting become one; the best of them speaks."""
    current = list(proposals)
    for name in dict.fromkeys(name for p in proposals for name in p.settings):
        groups: dict[Any, list[Proposal]] = {}
        for p in current:
            rest = tuple(sorted((k, v) for k, v in p.settings.items() if k != name and k not in p.spans))
            groups.setdefault((p.kind, p.cost, rest, tuple(sorted(p.spans.items())), name in p.settings), []).append(p)
        current = [p for members in groups.values() for p in _one_or_all(members, name, enough)]
    return current


def _one_or_all(members: list[Proposal], name: str, enough: float) -> list[Proposal]:
    """The best with the span of the setting, if all are alike."""
    if len(members) < 2 or not members[0].kind or name not in members[0].settings:
        return members
    for pair in members[0].separation:
        values = [p.separation[pair] for p in members]
        # One that is enough and one that is not are never alike.
        if max(values) - min(values) > ALIKE * max(*values, enough) or (max(values) >= enough) != (min(values) >= enough):
            return members
    numbers = [p.settings[name] for p in members]
    best = max(members, key=lambda p: (p.least, p.score))
    return [replace(best, spans=best.spans | {name: (min(numbers), max(numbers))})]


def rival_of(refit: Refit, weight: float | None = None, least: float | None = None) -> RivalLaw:
    """A rival from a refit; the weight follows from its chi-square above the ``least``."""
    parameters = refit.fit.parameters
    if weight is None:
        weight = float(np.exp(-0.5 * max(refit.fit.chi2 - (refit.fit.chi2 if least is None else least), 0.0)))
    return RivalLaw(refit.name, dict(refit.fit.values), [p.name for p in parameters], refit.covariance,
                    np.array([p.scale for p in parameters]), weight)
