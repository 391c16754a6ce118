"""Criteria of the literature for the experiment that tells rivals apart, as packages for model discrimination offer them.

- Hunter and Reiner 1965: squared difference of the predictions, in units of the noise; parameters count as known.
- Buzzi-Ferraris and Forzatti 1984: that difference against noise and uncertain parameters, d'S^-1 d + tr(2 Q S^-1), S = 2 Q + V_i + V_j, without
  the number of responses, which it has where nothing differs.
- Jensen and Renyi (Olofsson, Deisenroth, Misener 2019): quadratic Renyi entropy of the mixture of all predictions less the mean of theirs.

Q is the noise's covariance, V_i what the parameters of rival i make of its prediction.  All are maximised, none knows cost.
The package discopt has them for models in its own language only, which a compiled reducer is not.
"""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
from scipy.special import logsumexp

from fmu_src.arrays import Floats


@dataclass(frozen=True)
class Prediction:
    """What a rival predicts of an experiment: ``mean`` (n,), and ``spread`` (n, k) with covariance spread spread'; noise is white of size 1."""

    mean: Floats
    spread: Floats
    weight: float = 1.0


def reduced(rivals: Sequence[Prediction]) -> list[Prediction]:
    """The same in the space in which rivals differ at all, weights adding up to 1."""
    whole = sum(r.weight for r in rivals)
    first = rivals[0].mean
    stack = np.column_stack([*(r.mean - first for r in rivals), *(r.spread for r in rivals)])
    basis, sizes, _ = np.linalg.svd(stack, full_matrices=False)
    basis = basis[:, sizes > 1e-12 * max(float(sizes.max(initial=0.0)), 1e-300)]
    return [Prediction(basis.T @ (r.mean - first), basis.T @ r.spread, r.weight / whole) for r in rivals]


def pairwise(rivals: Sequence[Prediction], worth: Callable[[Prediction, Prediction], float]) -> float:
    return sum(a.weight * b.weight * worth(a, b) for a, b in combinations(reduced(rivals), 2))


def hunter_reiner(rivals: Sequence[Prediction]) -> float:
    return pairwise(rivals, lambda a, b: float(np.sum((a.mean - b.mean) ** 2)))


def buzzi_ferraris(rivals: Sequence[Prediction]) -> float:
    def worth(a: Prediction, b: Prediction) -> float:
        d = a.mean - b.mean
        inverse = np.linalg.inv(2.0 * np.eye(len(d)) + a.spread @ a.spread.T + b.spread @ b.spread.T)
        return float(d @ inverse @ d + 2.0 * np.trace(inverse) - len(d))

    return pairwise(rivals, worth)


def jensen_renyi(rivals: Sequence[Prediction]) -> float:
    few = reduced(rivals)
    covariances = [np.eye(len(r.mean)) + r.spread @ r.spread.T for r in few]

    def overlap(i: int, j: int) -> float:
        """Logarithm of the integral of the product of two predictions."""
        d, c = few[i].mean - few[j].mean, covariances[i] + covariances[j]
        return float(-0.5 * (d @ np.linalg.solve(c, d) + np.linalg.slogdet(2.0 * np.pi * c)[1]))

    places = range(len(few))
    mixture = -float(logsumexp([[overlap(i, j) + np.log(few[i].weight * few[j].weight) for j in places] for i in places]))
    return mixture + sum(few[i].weight * overlap(i, i) for i in places)


CRITERIA: dict[str, Callable[[Sequence[Prediction]], float]] = {
    "Hunter-Reiner": hunter_reiner, "Buzzi-Ferraris": buzzi_ferraris, "Jensen-Renyi": jensen_renyi,
}  # fmt: skip
