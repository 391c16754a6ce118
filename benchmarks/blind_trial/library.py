"""What the peers are given: the residual of the calibrated base model and what every candidate would do to it."""

from collections import defaultdict
from collections.abc import Hashable, Iterable, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from benchmarks.blind_trial.tool import model_of
from discrepancy.campaign.load import load_campaign
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import BASE, Record
from fmu_src.arrays import Floats

# Of every candidate the numbers of its columns.
Owners = list[tuple[str, list[int]]]


@dataclass(frozen=True)
class Library:
    """Quantities are scaled to one residual size; held-out runs are left out.

    ``residual`` (n,), ``nuisances`` (n, p) what may be calibrated, ``columns`` (n, m) the responses of the candidates, each of length 1,
    ``owners`` of these, ``noise`` (n,) the standard deviation among repetitions, nan where nothing is repeated, ``deviations`` of each
    run those of runs of its quantity and length from the mean of their repetitions, (k, its n) of that standard deviation.
    """

    residual: Floats
    nuisances: Floats
    columns: Floats
    owners: Owners
    noise: Floats
    deviations: list[Floats]


def library_of(folder: Path) -> Library:
    campaign = load_campaign(folder)
    model = PhysicalModel(model_of(campaign), campaign)
    which = [i for i, r in enumerate(model.records) if not r.held_out]
    records = [model.records[i] for i in which]
    values = {p.name: p.off for p in model.nuisances}
    quantities = [r.quantity for r in records]

    def stack(arrays: Iterable[Floats]) -> Floats:
        return np.concatenate([np.asarray(a, np.float64) - (np.nanmean(a) if r.free_zero else 0.0) for a, r in zip(arrays, records)])

    def difference(change: dict[str, float], base: list[Floats]) -> Floats:
        return stack([a - b for a, b in zip(model.predict({**values, **change}, which), base)])

    measured = stack([r.values for r in records])
    nuisances = []
    for _ in range(2):
        base = model.predict(values, which)
        residual = measured - stack(base)
        nuisances = [difference({p.name: values[p.name] + 0.01 * p.scale}, base) / (0.01 * p.scale) for p in model.nuisances]
        if not nuisances:
            break
        scale = np.array([p.scale for p in model.nuisances])
        weights = weights_of(residual, quantities, records)
        shift = np.linalg.lstsq(np.column_stack(nuisances) * scale * weights[:, None], residual * weights, rcond=None)[0] * scale
        values = {p.name: float(np.clip(values[p.name] + s, p.lower, p.upper)) for p, s in zip(model.nuisances, shift)}
    base = model.predict(values, which)
    residual = measured - stack(base)
    weights = weights_of(residual, quantities, records)
    columns: list[Floats] = []
    owners: Owners = []
    for c in (c for c in model.candidates if c.part != BASE):
        own = []
        for shapes in c.shape_grid or ({},):
            for p in c.amplitudes:
                step = 0.1 * p.scale * (-1.0 if p.sign < 0 else 1.0)
                column = difference({**shapes, p.name: p.off + step}, base) * weights
                size = np.linalg.norm(column)
                if size > 1e-9:
                    own.append(len(columns))
                    columns.append(column / size)
        if own:
            owners.append((c.name, own))
    ok = np.isfinite(residual)
    free = np.column_stack(nuisances)[ok] * weights[ok, None] if nuisances else np.zeros((ok.sum(), 0))
    noise, deviations = noise_of(records)
    return Library(
        (residual * weights)[ok], free, np.column_stack(columns)[ok], owners, (noise * weights)[ok],
        [d[:, np.isfinite(r.values)] for d, r in zip(deviations, records)],
    )  # fmt: skip


def weights_of(residual: Floats, quantities: Sequence[str], records: Sequence[Record]) -> Floats:
    """One over the size of the residual of a record's quantity: no quantity outweighs another by its unit."""
    sizes: dict[str, float] = {}
    parts: dict[str, list[Floats]] = {}
    start = 0
    for q, r in zip(quantities, records):
        parts.setdefault(q, []).append(residual[start : start + len(r.values)])
        start += len(r.values)
    for q, found in parts.items():
        sizes[q] = float(np.nanstd(np.concatenate(found))) or 1.0
    return np.concatenate([np.full(len(r.values), 1.0 / sizes[q]) for q, r in zip(quantities, records)])


def noise_of(records: Sequence[Record]) -> tuple[Floats, list[Floats]]:
    """(of every value the standard deviation among repetitions of its quantity, of every run deviations of its kind in units of it)."""
    groups: dict[Hashable, list[Record]] = defaultdict(list)
    for r in records:
        tags = tuple(sorted(r.tags.items()))
        groups[r.quantity, tags, r.condition, r.mounting, r.factors.get("direction", 1.0), len(r.values)].append(r)
    away: dict[str, list[Floats]] = defaultdict(list)
    for members in groups.values():
        if len(members) > 1:
            stack = np.array([r.values - (np.nanmean(r.values) if r.free_zero else 0.0) for r in members], float)
            # The mean has taken its share.
            away[members[0].quantity].append(np.nan_to_num(stack - np.nanmean(stack, axis=0)) * np.sqrt(len(members) / (len(members) - 1)))
    sizes = {q: float(np.sqrt(np.mean(np.concatenate([d.ravel() for d in found]) ** 2))) for q, found in away.items()}
    noise = np.concatenate([np.full(len(r.values), sizes.get(r.quantity, np.nan)) for r in records])
    alike = [[d / sizes[r.quantity] for d in away.get(r.quantity, ()) if d.shape[1] == len(r.values)] for r in records]
    return noise, [np.vstack(d) if d else np.empty((0, len(r.values))) for d, r in zip(alike, records)]
