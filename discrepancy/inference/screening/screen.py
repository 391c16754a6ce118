"""Score test of every candidate: which of them would reduce the misfit more than noise does.

T_k = max over shapes and amplitudes of r'U(U'U)^-1U'r with U = M dg_k, one-sided where physics
fixes the sign.  Multiplicity by Westfall and Young: noise is drawn with the covariance of all
columns together.  Columns are differences over a small and a typical amplitude, so that effects
that begin with zero slope (thresholds, clearances) are seen too.
"""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from itertools import combinations

import numpy as np

from discrepancy.inference.base_fit.components import component_grams, effective_dof, excess, simulate
from discrepancy.inference.base_fit.fit import Fit
from discrepancy.inference.base_fit.projection import projected, side_by_side, squares
from discrepancy.inference.base_fit.squares import PRIOR
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.screening.tail import needed_for, tail
from discrepancy.problem import Candidate, Parameter
from fmu_src.arrays import Floats

SMALL, TYPICAL = 0.05, 1.0
DRAWS = 2000
LEVEL = 0.001
# An effect that stays below this many noise units even at the bounds of its parameters cannot be seen; what is left
# of it in the predictions is rounding, which scaled up would fit anything.
LEAST_REACH = 2.0
# Cosine of changes that count as the same direction: a score is less by a twenty-fifth, and a refit finds the rest.
STRAIGHT = 0.98


@dataclass(frozen=True)
class Block:
    """Columns of one candidate at one point of its shape grid, per unit of ``Parameter.scale``, made over amplitudes of this ``size`` (in scales)."""

    candidate: int
    shape: dict[str, float]
    columns: slice
    signs: tuple[int, ...]
    size: float = SMALL


@dataclass(frozen=True)
class Columns:
    """Whitened columns of all candidates (N, m), nuisances not yet projected out."""

    values: Floats
    blocks: tuple[Block, ...]


@dataclass(frozen=True)
class Score:
    """Result of one candidate.  ``start`` are parameter values from which to refit, ``left`` the share of their change, squared, that calibrations
    leave to first order; ``needed`` is the statistic from which it would be significant at the level that was asked for."""

    name: str
    statistic: float
    p_single: float
    p_adjusted: float
    start: dict[str, float]
    second_start: dict[str, float] | None
    best_block: int
    left: float = 1.0
    needed: float = math.inf


@dataclass(frozen=True)
class Screen:
    scores: list[Score]
    blocks: tuple[Block, ...] = field(repr=False)

    @property
    def best(self) -> Score | None:
        return min(self.scores, key=lambda s: (s.p_adjusted, s.p_single, -s.statistic), default=None)


def candidate_columns(space: Workspace, candidates: Sequence[Candidate], values: dict[str, float]) -> Columns:
    """Differences of the prediction by every candidate's amplitudes, over its shape grid."""
    made = space.threads.told("screening", lambda candidate: _blocks(space, candidate, values), candidates, lambda candidate: candidate.name)
    stacks, blocks, width = [], [], 0
    for k, own in enumerate(made):
        for shape, block, signs, size in own:
            stacks.append(block)
            blocks.append(Block(k, shape, slice(width, width + block.shape[1]), signs, size))
            width += block.shape[1]
    return Columns(side_by_side(stacks, space.size), tuple(blocks))


def _blocks(space: Workspace, candidate: Candidate, values: dict[str, float]) -> list[tuple[dict[str, float], Floats, tuple[int, ...], float]]:
    """(shape, columns, signs of the amplitudes, their size) of one candidate, without those that show nothing or what another shows."""
    which = [i for i in space.touched(candidate) if i in space.rows]
    found: list[tuple[dict[str, float], Floats, tuple[int, ...], float]] = []
    if not which:
        return found
    linear = False
    for shape in candidate.shape_grid or ({},):
        at = {**values, **{p.name: p.off for p in candidate.shapes}, **shape}
        # What is straight at the first shape at which anything shows is straight at all.
        if not linear:
            glimpses = {size: _glimpse(space, candidate, at, which, size) for size in (TYPICAL, SMALL)}
            linear = _reach(candidate, glimpses[TYPICAL]) > LEAST_REACH / 20.0 and bool(np.all(_alike(*glimpses.values()) > STRAIGHT))
        made = {}
        if not linear:
            made[TYPICAL] = _typical(space, candidate, at, which, glimpses)
        made[SMALL] = _block(space, candidate, at, which, SMALL)
        if not linear and any(p.sign == 0 for p in candidate.amplitudes):
            made[-TYPICAL] = _opposite(space, candidate, at, which, glimpses, made)
        # The small one holds to both sides; what only repeats it is left out.
        for size, block in sorted(made.items(), key=lambda one: abs(one[0])):
            if _reach(candidate, block) < LEAST_REACH or any(_same(block, other) for _, other, *_ in found):
                continue
            # a difference over a large amplitude of a curved effect is only valid on its own side
            signs = tuple((p.sign or (int(np.sign(size)) if not linear and abs(size) == TYPICAL and len(candidate.amplitudes) == 1 else 0))
                          for p in candidate.amplitudes)
            found.append((dict(shape), block, signs, size))
    return found


def _typical(space: Workspace, candidate: Candidate, at: Mapping[str, float], which: Sequence[int], glimpses: Mapping[float, Floats]) -> Floats:
    """Columns over a typical amplitude, those of straight ones over the small one."""
    sizes = np.where(_alike(glimpses[SMALL], glimpses[TYPICAL]) > STRAIGHT, SMALL, TYPICAL)
    return np.column_stack([_column(space, p, at, which, float(size)) for p, size in zip(candidate.amplitudes, sizes)])


def _opposite(space: Workspace, candidate: Candidate, at: Mapping[str, float], which: Sequence[int], glimpses: Mapping[float, Floats],
              made: Mapping[float, Floats]) -> Floats:  # fmt: skip
    """Columns over a typical amplitude to the other side: from what is known where a glimpse shows that they follow from it."""
    other = _glimpse(space, candidate, at, which, -TYPICAL)
    if {other.shape} != {glimpse.shape for glimpse in glimpses.values()}:
        # Nothing was found there at one of the sizes, or there is no way to that side.
        return _block(space, candidate, at, which, -TYPICAL)

    def combined(by_size: Mapping[float, Floats]) -> tuple[Floats, ...]:
        # Straight on this side only; even; curved.
        return by_size[SMALL], -by_size[TYPICAL], 2.0 * by_size[SMALL] - by_size[TYPICAL]

    near = [_alike(other, glimpse) for glimpse in combined(glimpses)]
    columns = []
    for k, p in enumerate(candidate.amplitudes):
        nearest = int(np.argmax([cosines[k] for cosines in near]))
        follows = near[nearest][k] > STRAIGHT
        columns.append(combined(made)[nearest][:, k] if follows else _column(space, p, at, which, -TYPICAL))
    return np.column_stack(columns)


def _reach(candidate: Candidate, block: Floats) -> float:
    """Size, in noise units, of the effect at the bounds of its parameters."""
    return max(reach(p, column) for p, column in zip(candidate.amplitudes, block.T))


def reach(p: Parameter, column: Floats) -> float:
    """Size, in noise units, of what an amplitude does at the further of its bounds."""
    return float(np.linalg.norm(column)) * max(limits(p))


def limits(p: Parameter) -> tuple[float, float]:
    """Largest amplitude below and above ``off``, in scales."""
    return max(p.off - p.lower, 0.0) / p.scale, max(p.upper - p.off, 0.0) / p.scale


def known_before(candidate: Candidate) -> list[float]:
    """What is known beforehand of each amplitude, as chi-square per scale squared."""
    return [0.0 if p.prior is None else (p.scale / p.prior) ** 2 for p in candidate.amplitudes]


def _step(p: Parameter, size: float) -> float:
    return float(np.clip(p.off + (p.sign or 1) * size * p.scale, p.lower, p.upper) - p.off)


def _block(space: Workspace, candidate: Candidate, at: Mapping[str, float], which: Sequence[int], size: float) -> Floats:
    return np.column_stack([_column(space, p, at, which, size) for p in candidate.amplitudes])


def _column(space: Workspace, p: Parameter, at: Mapping[str, float], which: Sequence[int], size: float) -> Floats:
    """Whitened change (N,) over an amplitude of this ``size``, per scale of the parameter."""
    step = _step(p, size)
    if step == 0.0:
        return np.zeros(space.size)
    changes = space.predictions.changes({**at, p.name: p.off + step}, at, which, first_order=abs(size) == SMALL)
    return space.whiten({i: change / step * p.scale for i, change in zip(which, changes)})


def _glimpse(space: Workspace, candidate: Candidate, at: Mapping[str, float], which: Sequence[int], size: float) -> Floats:
    """The same at a few places of the records, roughly in units of their noise: enough to compare directions."""
    columns = []
    for p in candidate.amplitudes:
        step = _step(p, size)
        seen = space.predictions.glimpse({**at, p.name: p.off + step}, at, which, first_order=abs(size) == SMALL)
        columns.append(seen / step * p.scale if step else np.zeros_like(seen))
    return np.column_stack(columns)


def _alike(a: Floats, b: Floats) -> Floats:
    """Cosines of the columns of two blocks, one for two columns of nothing; zero where they were not seen at the same places."""
    if a.shape != b.shape:
        return np.zeros(a.shape[1])
    na, nb = np.sqrt(squares(a)), np.sqrt(squares(b))
    found: Floats = np.where((na == 0) & (nb == 0), 1.0, np.einsum("ij,ij->j", a, b) / np.maximum(na * nb, 1e-300))
    return found


def _same(a: Floats, b: Floats) -> bool:
    """Whether two blocks span the same directions, column by column."""
    return a.shape == b.shape and bool(np.all(_alike(a, b) > 0.9995))


def cone_statistic(scores: Floats, gram: Floats, signs: Sequence[int]) -> tuple[Floats, Floats]:
    """Gain in chi-square and amplitudes for each row of ``scores``, amplitudes keeping their signs."""
    width = gram.shape[0]
    draws = scores.shape[0]
    best = np.zeros(draws)
    amplitude = np.zeros((draws, width))
    signed = [j for j in range(width) if signs[j]] if width <= 5 else []
    free = [j for j in range(width) if j not in signed]
    for count in range(len(signed), -1, -1):
        for chosen in combinations(signed, count):
            subset = free + list(chosen)
            if not subset:
                continue
            inverse = np.linalg.pinv(gram[np.ix_(subset, subset)], rcond=1e-9, hermitian=True)
            a = scores[:, subset] @ inverse
            gain = np.sum(a * scores[:, subset], axis=1)
            allowed = np.ones(draws, dtype=bool)
            for j in chosen:
                allowed &= a[:, subset.index(j)] * signs[j] >= 0
            better = allowed & (gain > best)
            best[better] = gain[better]
            amplitude[better] = 0.0
            amplitude[np.ix_(better, subset)] = a[better]
    return best, amplitude


@dataclass
class _Tested:
    """One candidate over its blocks: largest statistic of data and draws (1 + draws,), (statistic, block, amplitude) of each block."""

    sup: Floats
    starts: list[tuple[float, int, Floats]] = field(default_factory=list)
    width: int = 0
    dof: float = 1e6


def screen(space: Workspace, candidates: Sequence[Candidate], columns: Columns, fit: Fit, seed: int = 0, draws: int = DRAWS,
           exclude: Sequence[str] = (), level: float = LEVEL) -> Screen:
    """Tests every candidate for what ``fit`` has left over; ``level``, over all candidates, is that of which ``Score.needed`` speaks."""
    if not columns.blocks:
        return Screen([], ())
    rng = np.random.default_rng(seed)
    without_fitted = projected(columns.values, fit.jacobian, fit.normal)
    gram = without_fitted.gram()
    dead = np.diag(gram) < 1e-6 * np.maximum(squares(columns.values), 1e-300)
    gram[dead] = 0.0
    gram[:, dead] = 0.0
    score = columns.values.T @ fit.settled
    score[dead] = 0.0
    grams = {c: np.where(dead[:, None] | dead[None, :], 0.0, g) for c, g in component_grams(space, without_fitted).items()}
    prior = gram - sum(grams.values())
    if np.trace(prior) > 1e-6 * np.trace(gram):
        grams[PRIOR] = prior
    draws_of = simulate(space, grams, draws, rng, excess(space, fit))
    everything = np.vstack([score, draws_of])
    results: dict[int, _Tested] = {}
    for index, block in enumerate(columns.blocks):
        own = slice(block.columns.start, block.columns.stop)
        candidate = candidates[block.candidate]
        if candidate.name in exclude:
            continue
        # An amplitude that is known beforehand to be small gains less.
        known = gram[own, own] + np.diag(known_before(candidate))
        statistic, amplitude = cone_statistic(everything[:, own], known, block.signs)
        shares = {c: float(np.trace(np.linalg.pinv(known, rcond=1e-9, hermitian=True) @ g[own, own])) for c, g in grams.items()}
        entry = results.setdefault(block.candidate, _Tested(np.zeros(draws + 1)))
        entry.sup = np.maximum(entry.sup, statistic)
        entry.starts.append((float(statistic[0]), index, amplitude[0]))
        entry.width = max(entry.width, block.columns.stop - block.columns.start)
        entry.dof = min(entry.dof, effective_dof(space, shares))
    sorted_draws = {k: np.sort(e.sup[1:]) for k, e in results.items()}
    singles = {k: tail(float(e.sup[0]), sorted_draws[k], e.width, e.dof) for k, e in results.items()}
    least = np.full(draws, 1.0)
    for e in results.values():
        sims = e.sup[1:]
        ranks = np.empty(draws)
        ranks[np.argsort(-sims, kind="stable")] = (np.arange(draws) + 0.5) / draws
        least = np.minimum(least, ranks)
    ordered = np.sort(least)
    often = ordered[max(int(0.02 * draws) - 1, 0)]
    effective = 0.02 / often
    scores = []
    for k, e in results.items():
        starts = sorted(e.starts, key=lambda s: -s[0])
        p = singles[k]
        adjusted = min(1.0, effective * p) if p < often else float(np.mean(ordered <= p))
        made = [_start(candidates[k], columns.blocks[i], a) for _, i, a in starts]
        second = next((m for (t, i, _), m in zip(starts[1:], made[1:])
                       if columns.blocks[i].shape != columns.blocks[starts[0][1]].shape and t > 0.6 * starts[0][0]), None)
        own, amplitude = columns.blocks[starts[0][1]].columns, starts[0][2]
        whole = float(np.sum((columns.values[:, own] @ amplitude) ** 2))
        left = float(amplitude @ gram[own, own] @ amplitude) / whole if whole > 0.0 else 1.0
        needed = needed_for(level / effective, sorted_draws[k], e.width, e.dof)
        scores.append(Score(candidates[k].name, float(e.sup[0]), p, adjusted, made[0], second, starts[0][1], left, needed))
    scores.sort(key=lambda s: (-s.statistic))
    return Screen(scores, columns.blocks)


def joint_gain(columns: Columns, fit: Fit, *scores: Score) -> float:
    """Gain in chi-square of several effects together, linear and without bounds, at the places where each fits best alone."""
    chosen = np.hstack([columns.values[:, columns.blocks[s.best_block].columns] for s in scores])
    gram = projected(chosen, fit.jacobian, fit.normal).gram()
    score = chosen.T @ fit.settled
    return float(score @ np.linalg.pinv(gram, rcond=1e-9, hermitian=True) @ score)


def bounded_gain(columns: Columns, fit: Fit, score: Score, amplitudes: Sequence[Parameter]) -> tuple[float, Floats]:
    """Gain in chi-square of one effect alone, linear, with its amplitudes drawn into their bounds, and their sizes before."""
    chosen = columns.values[:, columns.blocks[score.best_block].columns]
    gram = projected(chosen, fit.jacobian, fit.normal).gram()
    slope = chosen.T @ fit.settled
    free = np.linalg.pinv(gram, rcond=1e-9, hermitian=True) @ slope
    inside = np.clip(free, [(p.lower - p.off) / p.scale for p in amplitudes], [(p.upper - p.off) / p.scale for p in amplitudes])
    return float(2.0 * inside @ slope - inside @ gram @ inside), free


def _start(candidate: Candidate, block: Block, amplitude: Floats) -> dict[str, float]:
    """Where a refit begins: the linear estimate, kept off zero and inside the bounds."""
    start = {p.name: p.off for p in candidate.shapes}
    start.update(block.shape)
    for j, p in enumerate(candidate.amplitudes):
        value = p.off + amplitude[j] * p.scale
        if p.sign and (value - p.off) * p.sign < 0.02 * p.scale:
            value = p.off + 0.02 * p.scale * p.sign
        if not p.sign and value == p.off:
            value = p.off + 0.01 * p.scale
        start[p.name] = float(np.clip(value, p.lower, p.upper))
    return start
