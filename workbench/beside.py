"""Try: where angles count from, how far outputs lag and where roller cages stood beside an effect, as a diagnosis of the same measurements has found them.

A large effect hides the pattern that tells the zero of angles: drawn at the base model's it looks wrong, however right it is.  Without a diagnosis the zero
is looked for beside what is tried, from one run.
"""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field

import numpy as np

from discrepancy import remembered
from discrepancy.campaign.model import Campaign
from discrepancy.inference.verdict import Settings
from discrepancy.prediction.by_effects import Effects, Found
from discrepancy.prediction.conditions import places_of_zero
from discrepancy.prediction.defined_samples import defined_at
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import ERROR, Record
from discrepancy.verdict import Answer
from fmu_src.arrays import Floats
from fmu_src.effect_words import effect_title
from workbench.thinned import kept_of, thinned

# Of what is left at the zero that stands, what another has to take away: places are looked for in steps.
CLEARLY = 0.05


@dataclass(frozen=True)
class Known:
    """A fit of what a diagnosis names: the parameters of its effects, how they are called, and all values (SI)."""

    own: frozenset[str]
    title: str
    values: dict[str, float]


@dataclass
class Beside:
    """What is known beside effects by the diagnosis of a ``campaign``, for a ``model`` of its runs as they are ``thinned``; read anew when the diagnosis
    is another one."""

    model: PhysicalModel
    campaign: Campaign
    known: list[Known] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.place = remembered.place_of(self.model.file, self.campaign, Settings())
        self.seen = 0
        self.standing: Mapping[str, float] = {}
        # By what is tried, for as long as the hand moves.
        self.zeros: dict[frozenset[str], dict[str, float]] = {}

    def stand(self, standing: Mapping[str, float]) -> None:
        """Takes what is calibrated first, by ``standing``: loops are locked where its zero has them, which the pattern alone told roughly."""
        if standing != self.standing:
            self.standing = dict(standing)
            self.zeros.clear()
            if self.model.stands_elsewhere(standing):
                self.model.settle(standing)

    def stands(self, standing: Mapping[str, float]) -> bool:
        """Whether neither the diagnosis nor what is calibrated first has changed."""
        return standing == self.standing and self.changed() == self.seen

    def refresh(self) -> None:
        """Takes what a diagnosis has found since, if there was one."""
        if self.changed() == self.seen:
            return
        answer = remembered.remembered(self.model.file, self.campaign)
        self.known = [] if answer is None else known_of(answer)
        if answer is not None:
            take_over(self.model, answer, self.campaign)
        self.seen = self.changed()

    def changed(self) -> int:
        """When the diagnosis was written; 0 without one."""
        return self.place.stat().st_mtime_ns if self.place.is_file() else 0

    def fit(self, tried: Iterable[str]) -> Known | None:
        """The fit that names most of the parameters that are tried, if one names any."""
        names = set(tried)
        best = max(self.known, key=lambda fit: len(names & fit.own), default=None)
        return best if best and names & best.own else None

    def calibrated(self, tried: Mapping[str, float], roughly: bool = False) -> dict[str, float]:
        """What is calibrated beside what is tried, where that is known; else zeros of angles that suit it, ``roughly`` those of the last time."""
        if fit := self.fit(tried):
            return {p.name: fit.values[p.name] for p in self.model.nuisances if p.name in fit.values}
        if tried and not roughly:
            self.zeros[frozenset(tried)] = self.suiting(tried)
        return self.zeros.get(frozenset(tried), {})

    def suiting(self, tried: Mapping[str, float]) -> dict[str, float]:
        """Zeros of angles beside what is tried, where others leave clearly less of the runs that tell them than those that stand."""
        errors = [record for record in reversed(self.model.records) if record.quantity == ERROR and "angle" in record.axes and not record.left_out]
        telling = {name: record for record in errors for name in places_of_zero(record) if name in self.model.zeros}
        if not telling:
            return {}
        values = {**self.standing, **tried}
        zeros = self.model.zeros_in_turn(values)

        def left(at: Mapping[str, float]) -> float:
            off = ((r.values - self.model.one(r, {**values, **at}))[r.counted] for r in telling.values())
            return float(sum(np.nanvar(each) for each in off))

        return zeros if left(zeros) < (1.0 - CLEARLY) * left({}) else {}

    def words(self, record: Record, tried: Sequence[str]) -> str:
        """One line below the curve; empty where nothing is tried, or nothing of a record hangs on an angle's zero or a cage."""
        if not tried or not (self.counts(record) or self.model.cages.ripple(record, {}) is not None):
            return ""
        fit = self.fit(tried)
        if fit is None:
            others = "are those of the model without what is tried: a large effect may fit better at others, which a diagnosis finds"
            moved = [name for name in self.zeros.get(frozenset(tried), {}) if name in places_of_zero(record)]
            return f"angles count from where what is tried fits best; phases of cages {others}" if moved else f"zero and phases {others}"
        return f"zero and phases are those that the diagnosis found beside {fit.title}"

    def counts(self, record: Record) -> bool:
        """Whether a curve, or the place of a loop, counts from a zero that is found."""
        free = {p.name for p in self.model.nuisances} & set(places_of_zero(record))
        return bool(free) and ("angle" in record.axes or self.model.locked_waves.counts(record))


def known_of(answer: Answer) -> list[Known]:
    """The fits of what is named."""
    return [Known(frozenset(p.name for p in fit.own), " + ".join(effect_title(c.name) for c in fit.candidates), fit.fit.values)
            for fit in answer.diagnosis.fits.members]  # fmt: skip


def take_over(model: PhysicalModel, answer: Answer, campaign: Campaign) -> None:
    """What ``answer`` has placed beside effects, for a model of the same runs as they are thinned; without effects that has placed all itself."""
    there = answer.model
    *places, (ripples_of_mine, _) = zip(model.found_beside(), there.found_beside())
    for mine, found in places:
        take(mine, found)
    whole = {record.name: record for record in campaign.records}
    ripples = {effects: {name: fewer(ripple, whole[name], campaign) for name, ripple in placed.items()} for effects, placed in there.cages.ripples.items()}
    take(ripples_of_mine, ripples)


def take(mine: dict[Effects, Found], found: Mapping[Effects, Found]) -> None:
    """What was found with effects."""
    mine.update({effects: placed for effects, placed in found.items() if effects})


def fewer(ripple: Floats, record: Record, campaign: Campaign) -> Floats:
    """What cages add at the samples of a run that can be foretold, at those of the run as it is thinned."""
    every = np.zeros(len(record.values))
    every[defined_at(record, campaign)] = ripple
    few: Floats = every[kept_of(record)][defined_at(thinned(record), campaign)]
    return few
