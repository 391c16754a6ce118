"""Where the misfit is: which signals, orders, places and conditions carry it.

For each group G of generic functions S = r'MG (G'MG)^+ G'Mr is tested against the noise of the
replicates, with Satterthwaite's degrees of freedom, and corrected for multiplicity after Holm.
"""

import math
from collections import defaultdict
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import asdict, dataclass, field, replace
from typing import Any

import numpy as np

from discrepancy.inference.base_fit.components import Component, effective_dof, excess
from discrepancy.inference.base_fit.fit import Fit
from discrepancy.inference.base_fit.squares import Chance, chance
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.misfit.features import ORDERS, Feature, features, modulations, samples_of_a_wave
from discrepancy.inference.noise.series import stream_of
from discrepancy.problem import Record
from fmu_src.arrays import Floats

LEVEL = 0.004
"""Significance of a finding over all groups together."""
# Records of more samples are tested by functions made of steps, so many at least in a wave (they see 0.6 % less of the shortest).
MANY, OF_A_WAVE = 50_000, 16.0
# Numbers that are whitened together.
HANDFUL = 4_000_000


@dataclass(frozen=True)
class Group:
    """Result of one group.  ``p`` is corrected for multiplicity; ``statistic`` is in units of what a fit leaves all over its signal, as tests need it.

    ``chi_square`` is in units of the noise alone; ``share``: its part of the whole significant misfit.
    """

    signal: str
    feature: str
    dependence: str
    statistic: float
    width: int
    dof: float
    p_single: float
    p: float
    share: float = 0.0
    chi_square: float = 0.0
    indices: tuple[int, ...] = field(default=(), repr=False)


@dataclass(frozen=True)
class Localisation:
    """All groups, the significant ones best first, and maps for drawing."""

    groups: list[Group]
    conditions: dict[str, dict[str, float]]
    level: float

    @property
    def findings(self) -> list[Group]:
        return sorted((g for g in self.groups if g.p <= self.level), key=lambda g: (g.p_single, -g.statistic))

    @property
    def largest(self) -> list[Group]:
        """The significant ones, largest share of the misfit first: what is told."""
        return sorted(self.findings, key=lambda g: -g.share)

    def to_dict(self) -> dict[str, Any]:
        def plain(g: Group) -> dict[str, Any]:
            entry = asdict(g)
            entry.pop("indices")
            return entry
        rows = [g for g in self.groups if not g.feature.startswith("order ") or g.p <= self.level]
        return {"findings": [plain(g) for g in self.largest], "map": [plain(g) for g in rows],
                "conditions": self.conditions, "level": self.level}


class Localiser:
    """Whitened generic functions of all training records, computed once and tested against any fit."""

    def __init__(self, space: Workspace, orders: Mapping[str, Sequence[float]] = ORDERS):
        self.space = space
        self.streams: dict[str, list[int]] = defaultdict(list)
        for i in space.training:
            self.streams[stream_of(space.records[i])].append(i)
        # By record: its functions in noise units, where each one's columns are, their part along the runs' patterns, their products.
        self.cells: dict[int, tuple[Floats, dict[str, slice], Floats, Floats]] = {}
        self.steps: dict[int, int] = {}
        for i in space.training:
            record, whitener = space.records[i], space.noise.whiteners[i]
            self.steps[i] = step = step_of(record, orders)
            parts, slices, start = [], {}, 0
            for some in handfuls(features(record, orders)):
                parts.append(stepped(whitener(np.hstack([f.columns for f in some])), step))
                for f in some:
                    slices[f.name] = slice(start, start + f.columns.shape[1])
                    start += f.columns.shape[1]
            block = np.hstack(parts)
            directions = stepped(whitener.directions, step)
            self.cells[i] = (block, slices, directions.T @ block, block.T @ block)

    def test(self, fit: Fit, level: float = LEVEL, name: str = "", likely: Chance = chance) -> Localisation:
        """Tests what ``fit`` leaves over; ``name`` restricts to one signal, ``likely`` says how large scores are by chance."""
        space = self.space
        inverse = np.asarray(np.linalg.pinv(fit.normal, hermitian=True), dtype=float) if fit.normal.size else np.zeros((0, 0))
        gradient = fit.gradient
        self.factors = excess(space, fit)
        crosses = {i: block.T @ stepped(fit.jacobian[space.rows[i]], self.steps[i]) for i, (block, *_) in self.cells.items()}
        scores = {i: block.T @ stepped(fit.residual[space.rows[i]], self.steps[i]) for i, (block, *_) in self.cells.items()}
        along_jacobian = {i: space.noise.whiteners[i].directions.T @ fit.jacobian[space.rows[i]] for i in self.cells}
        groups = []
        for stream, indices in self.streams.items():
            if name and stream != name:
                continue
            modulation = modulations([space.records[i] for i in indices])
            names = list(dict.fromkeys(f for i in indices for f in self.cells[i][1]))
            for feature in names:
                comb = feature.startswith("order ")
                have = [k for k, i in enumerate(indices) if feature in self.cells[i][1]]
                for dependence, basis in modulation.items():
                    if comb and dependence != "everywhere":
                        continue
                    group = self._group(stream, feature, dependence, [indices[k] for k in have], basis[have],
                                        inverse, gradient, crosses, scores, along_jacobian, likely)
                    if group is not None:
                        groups.append(group)
        groups = _holm(groups)
        # What is really off: a signal that is off all over has a small statistic and a large misfit.
        whole = sum(max(g.chi_square - g.width, 0.0) for g in groups if g.p <= level)
        groups = [replace(g, share=max(g.chi_square - g.width, 0.0) / whole if whole and g.p <= level else 0.0) for g in groups]
        return Localisation(groups, self._conditions(scores), level)

    def _group(
        self, stream: str, feature: str, dependence: str, indices: Sequence[int], basis: Floats, inverse: Floats, gradient: Floats,
        crosses: Mapping[int, Floats], scores: Mapping[int, Floats], along_jacobian: Mapping[int, Floats], likely: Chance,
    ) -> Group | None:  # fmt: skip
        slices = [self.cells[i][1][feature] for i in indices]
        common = min(s.stop - s.start for s in slices)
        own = [slice(s.start, s.start + common) for s in slices]
        m, p = basis.shape[1], gradient.size
        width = m * common
        cells = np.array([self.cells[i][3][o, o] for i, o in zip(indices, own)])
        gram = np.einsum("ri,rj,rab->iajb", basis, basis, cells, optimize=True).reshape(width, width)
        cross = np.einsum("ri,rap->iap", basis, np.array([crosses[i][o] for i, o in zip(indices, own)])).reshape(width, p)
        score = np.einsum("ri,ra->ia", basis, np.array([scores[i][o] for i, o in zip(indices, own)])).reshape(width)
        original = np.diag(gram).copy()
        gram = gram - cross @ inverse @ cross.T
        score = score - cross @ (inverse @ gradient)
        alive = np.diag(gram) > 1e-6 * np.maximum(original, 1e-300)
        if not alive.any():
            return None
        gram, score, back = gram[np.ix_(alive, alive)], score[alive], (cross @ inverse)[alive]
        size = np.sqrt(np.diag(gram))
        values, vectors = np.linalg.eigh(gram / np.outer(size, size))
        keep = values > 1e-6 * values.max()
        root = np.zeros((int(keep.sum()), width))
        root[:, alive] = (vectors[:, keep] / np.sqrt(values[keep])).T / size
        score = root[:, alive] @ score
        chi_square = float(np.sum(score**2))
        rank = root.shape[0]
        # functions of this group, record by record, in the coordinates of the test
        maps = np.einsum("kia,ri->rka", root.reshape(rank, m, common), basis)
        back_root = root[:, alive] @ back
        grams: dict[Component, Floats] = defaultdict(lambda: np.zeros((rank, rank)))
        for k, (i, o) in enumerate(zip(indices, own)):
            along = self.cells[i][2][:, o] @ maps[k].T - along_jacobian[i] @ back_root.T
            for component, row in zip(self.space.noise.whiteners[i].components, along):
                grams[component] += np.outer(row, row)
        # The runs of a group are of one signal.
        grams[(stream, "main")] = np.eye(rank) - sum(grams.values(), np.zeros((rank, rank)))
        dof = effective_dof(self.space, {c: float(np.trace(g)) for c, g in grams.items()})
        statistic, single = likely(self.space, score, grams, self.factors)
        return Group(stream, feature, dependence, statistic, rank, dof, single, 1.0, chi_square=chi_square, indices=tuple(indices))

    def _conditions(self, scores: Mapping[int, Floats]) -> dict[str, dict[str, float]]:
        """Misfit of each condition and signal in standard deviations of the mean feature, for drawing."""
        result: dict[str, dict[str, float]] = defaultdict(dict)
        for stream, indices in self.streams.items():
            sums: dict[str, list[float]] = defaultdict(lambda: [0.0, 0.0])
            for i in indices:
                _block, slices, _, gram = self.cells[i]
                named = [s for f, s in slices.items() if not f.startswith("order ")]
                pick = np.concatenate([np.arange(s.start, s.stop) for s in named])
                g = gram[np.ix_(pick, pick)]
                s = scores[i][pick]
                scale = np.sqrt(np.maximum(np.diag(g), 1e-300))
                pinv = np.linalg.pinv(g / np.outer(scale, scale), rcond=1e-8, hermitian=True)
                cell = sums[self.space.records[i].condition]
                cell[0] += float((s / scale) @ pinv @ (s / scale))
                cell[1] += pick.size
            for condition, (total, width) in sums.items():
                result[stream][condition] = math.sqrt(total / max(width, 1))
        return dict(result)


def step_of(record: Record, orders: Mapping[str, Sequence[float]]) -> int:
    """Neighbouring samples over which the functions of a record are one step: 1 unless it has very many for its shortest wave."""
    return max(1, min(int(samples_of_a_wave(record, orders) / OF_A_WAVE), np.size(record.values) // MANY))


def stepped(rows: Floats, step: int) -> Floats:
    """Sums (m, ...) of ``step`` neighbouring rows (n, ...) over the root of their number.

    Products of functions that are made of steps with any rows are those of their sums: such functions are as good a test
    as those that they are steps of, and a million samples take the room of a hundred thousand.
    """
    if step == 1:
        return rows
    starts = np.arange(0, len(rows), step)
    sizes = np.diff(starts, append=len(rows))
    found: Floats = np.add.reduceat(rows, starts, axis=0)
    return found / np.sqrt(sizes).reshape(-1, *[1] * (rows.ndim - 1))


def handfuls(made: Iterable[Feature]) -> Iterator[list[Feature]]:
    """As many together as fit into little memory, one at least."""
    some: list[Feature] = []
    for feature in made:
        some.append(feature)
        if sum(f.columns.size for f in some) > HANDFUL:
            yield some
            some = []
    if some:
        yield some


def _holm(groups: Sequence[Group]) -> list[Group]:
    """Holm's correction; the single orders of the comb count as one family with as many members."""
    order = np.argsort([g.p_single for g in groups])
    count = len(groups)
    running = 0.0
    corrected = [1.0] * count
    for rank, k in enumerate(order):
        running = max(running, min(1.0, groups[k].p_single * (count - rank)))
        corrected[k] = running
    return [replace(g, p=float(p)) for g, p in zip(groups, corrected)]
