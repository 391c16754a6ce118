"""Which effects a design can tell apart: the best test's d' between two rivals, everything else projected out.

An effect that is hidden with d' = s (its size in noise units, calibration projected out) changes the whitened data by s u.  A rival imitates
it as well as its amplitudes, its shapes and all nuisances allow; what is left has length

    d = s min over the rival of |M (u - U_B c)| / |M u|,     M = I - J N^-1 J'

with the rival's parameters within their bounds, and s no larger than the hidden effect's own bounds allow.

By Neyman and Pearson no test separates the hidden effect from its nearest imitation better than one that sees them at d: at equal risk it errs
with probability Phi(-d/2) (7 % at d = 3), whatever it computes.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import Any

import numpy as np
from scipy.special import ndtr

from discrepancy.inference.base_fit.projection import projected, squares
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.screening.screen import Block, Columns, cone_statistic, limits
from discrepancy.problem import Candidate, effect_of
from fmu_src.arrays import Floats

STRENGTH = 10.0
"""d' of the hidden effect at which pairs are judged."""
APART = 3.0
"""d' between two rivals below which they count as one: the best test errs in 7 of 100 cases."""
# Share of a column that nuisances leave, below which an effect shows nothing.
SEEN = 1e-3


@dataclass(frozen=True)
class Pair:
    """What ``rival`` leaves of ``hidden``, in noise units: for the parameters of ``hidden`` that are the worst, and for the middle ones."""

    hidden: str
    rival: str
    least: float
    typical: float

    @property
    def error(self) -> float:
        """With which probability the best test takes one for the other, at the middle."""
        return best_error(self.typical)

    def to_dict(self) -> dict[str, Any]:
        return {**self.__dict__, "error": self.error}


def best_error(separation: float) -> float:
    """Error of the best test of two hypotheses at this d', with equal risks."""
    return float(ndtr(-0.5 * separation))


def separations(space: Workspace, candidates: Sequence[Candidate], columns: Columns, strength: float = STRENGTH) -> list[Pair]:
    """Every ordered pair of effects that show at all, the hardest first; to first order in the amplitudes, shapes on their grids and between."""
    gram = projected(columns.values, space.base.jacobian, space.base.normal).gram()
    sizes = np.sqrt(np.maximum(np.diag(gram), 1e-300))
    # How large, in noise units, each column's parameter can become within its bounds, below and above.
    ranges = np.array([limits(p) for b in columns.blocks for p in candidates[b.candidate].amplitudes]).reshape(-1, 2) * sizes[:, None]
    seen = sizes > SEEN * np.sqrt(np.maximum(squares(columns.values), 1e-300))
    unit = gram / np.outer(sizes, sizes)
    own: dict[str, list[Block]] = {}
    for block in columns.blocks:
        own.setdefault(effect_of(candidates[block.candidate].name), []).append(block)
    # What may be hidden: column and sign; an effect of either sign is as near as its nearer side.
    hidden = {name: [(k, s, min(strength, ranges[k, (s > 0) * 1])) for b in blocks
                     for k, sign in zip(range(b.columns.start, b.columns.stop), b.signs) if seen[k]
                     for s in ((sign,) if sign else (1, -1)) if ranges[k, (s > 0) * 1] >= APART]
              for name, blocks in own.items()}  # fmt: skip
    truths = [truth for name in own for truth in hidden[name]]
    targets = np.array([sign * size * unit[k] for k, sign, size in truths]).reshape(len(truths), len(unit))
    found, start = [], 0
    left = {rival: remaining(targets, np.array([size for *_, size in truths]), unit, ranges, seen, blocks) for rival, blocks in own.items()}
    for name, members in hidden.items():
        rows = slice(start, start + len(members))
        start += len(members)
        for rival, theirs in own.items():
            if rival != name and members and any(seen[b.columns].any() for b in theirs):
                # Both signs of one column are one thing to hide.
                near: dict[int, float] = {}
                for (k, *_), d in zip(members, left[rival][rows]):
                    near[k] = min(near.get(k, np.inf), float(d))
                found.append(Pair(name, rival, min(near.values()), float(np.median(list(near.values())))))
    return sorted(found, key=lambda p: (p.typical, p.least))


def remaining(targets: Floats, sizes: Floats, unit: Floats, ranges: Floats, seen: np.ndarray, blocks: Sequence[Block]) -> Floats:
    """What an effect with these blocks leaves of each target (t,), of which ``targets`` (t, m) are the products with all unit columns."""
    shares = np.zeros(len(targets))
    groups = [[b] for b in blocks] + [[a, b] for a, b in combinations(blocks, 2) if neighbours(a, b)]
    for group in groups:
        index = [k for b in group for k in range(b.columns.start, b.columns.stop) if seen[k]]
        if not index:
            continue
        signs = [s for b in group for k, s in zip(range(b.columns.start, b.columns.stop), b.signs) if seen[k]]
        gain, amplitudes = cone_statistic(targets[:, index], unit[np.ix_(index, index)], signs)
        allowed = np.where(amplitudes < 0.0, ranges[index, 0], ranges[index, 1])
        # Shortened to its bounds, which takes (2 t - t^2) of the gain.
        t = np.min(np.divide(allowed, np.abs(amplitudes), out=np.ones_like(amplitudes), where=np.abs(amplitudes) > allowed), axis=1)
        np.maximum(shares, gain * (2.0 * t - t * t), out=shares)
    return np.sqrt(np.clip(sizes**2 - shares, 0.0, None))


def neighbours(a: Block, b: Block) -> bool:
    """Whether a mixture of both stands for a shape or an amplitude between them."""
    return a.candidate == b.candidate and sum(a.shape[k] != b.shape[k] for k in a.shape) <= 1
