"""Which catalogued effects a campaign could not tell apart, whatever it measures: from the model alone, before or after the measurement."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from discrepancy.campaign.model import Campaign
from discrepancy.campaign.planned import with_planned
from discrepancy.experiment.usual_noise import UNMEASURED
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.screening.screen import candidate_columns
from discrepancy.inference.separable import APART, STRENGTH, Pair, separations
from discrepancy.model_file import ModelFile
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import BASE, Record, effect_of
from fmu_src.faults import InputFault
from fmu_src.threads import sharing_no_matrices

# Samples that show all that a loop has, and all orders of a turn; more only take longer.
ENOUGH = {"hysteresis": 500, "transmission_error": 4500}
# Of the size of a signal that was never measured and whose noise nobody stated (assumed).
SHARE_OF_SIZE = 0.05


@dataclass(frozen=True)
class Separability:
    """``pairs``, the hardest first; ``invisible`` effects show nothing here; ``planned`` runs have no rows yet: their noise is assumed or stated."""

    pairs: list[Pair]
    invisible: list[str]
    planned: tuple[str, ...]
    strength: float = STRENGTH
    apart: float = APART

    @property
    def alike(self) -> list[Pair]:
        """What the best test could not tell apart: with most of what may be hidden."""
        return [p for p in self.pairs if p.typical < self.apart]

    @property
    def sometimes(self) -> list[Pair]:
        """Told apart as a rule, not with the worst of what may be hidden."""
        return [p for p in self.pairs if p.least < self.apart <= p.typical]

    def groups(self) -> list[tuple[str, list[str]]]:
        """Each hidden effect with the rivals that it could be taken for."""
        hidden = dict.fromkeys(p.hidden for p in self.alike)
        return [(name, [p.rival for p in self.alike if p.hidden == name]) for name in hidden]

    def as_json(self) -> dict[str, Any]:
        return {
            "strength": self.strength, "apart": self.apart, "planned": list(self.planned), "invisible": self.invisible,
            "pairs": [p.to_dict() for p in self.pairs],
        }  # fmt: skip


@sharing_no_matrices
def separability(campaign: Campaign, strength: float = STRENGTH, jobs: int = 1) -> Separability:
    """Every pair of catalogued effects that the campaign shows, hidden with d' = ``strength``.

    Runs that have no rows yet are taken as the model predicts them, with their stated noise or that of a usual bench.
    InputFault without a reducer, or if no run is one that the model predicts.
    """
    reducer = campaign.reducer
    if reducer is None:
        raise InputFault(f"{campaign.folder}: to say what could be told apart takes a model; state [campaign] reducer")
    campaign, planned = with_planned(campaign)
    if not campaign.training:
        raise InputFault(f"{campaign.folder}: every run is held out or of unknown axes: nothing can be told; mark some conditions as training")
    file = ModelFile(reducer.name, reducer)
    campaign = replace(campaign, records=tuple(map(thinned, campaign.records)))
    if planned:
        campaign = replace(campaign, records=foretold(campaign, file, planned))
    model = PhysicalModel(file, campaign, jobs=jobs)
    space = Workspace(model)
    space.fit_base()
    # Effects against each other; what a number of the base could do is said where it was measured.
    candidates = [c for c in model.candidates if c.part != BASE]
    with space.predictions.roughly():
        columns = candidate_columns(space, candidates, space.base.values)
    pairs = separations(space, candidates, columns, strength)
    seen = {p.hidden for p in pairs}
    return Separability(pairs, [e for e in dict.fromkeys(effect_of(c.name) for c in candidates) if e not in seen], planned, strength)


def thinned(record: Record) -> Record:
    """Every nth sample of a run that has more than enough."""
    step = -(-len(record.values) // ENOUGH.get(record.quantity, len(record.values)))
    return record if step == 1 else replace(record, values=record.values[::step], axes={k: np.asarray(v)[::step] for k, v in record.axes.items()})


def foretold(campaign: Campaign, file: ModelFile, planned: Sequence[str]) -> tuple[Record, ...]:
    """The records, planned ones with the model's values and noise of their size."""
    model = PhysicalModel(file, campaign, zeros={})
    values = {record.name: y for record, y in zip(model.records, model.predict({}))}
    rng = np.random.default_rng(0)
    found = []
    for record in campaign.records:
        if record.name in planned and record.name in values:
            y = values[record.name]
            noise = record.stated_noise or UNMEASURED.get(record.quantity, SHARE_OF_SIZE * float(np.sqrt(np.mean(y**2))) or SHARE_OF_SIZE)
            axes = next(r for r in model.records if r.name == record.name).axes
            record = replace(record, values=y + noise * rng.standard_normal(len(y)), axes=axes, stated_noise=noise)
        found.append(record)
    return tuple(found)
