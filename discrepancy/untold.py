"""What a campaign does not tell of effects that are named: which of two things they come from, and what does."""

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

from discrepancy.campaign.design import Design
from discrepancy.campaign.model import Campaign
from discrepancy.campaign.pairs import PAIRS, judge
from discrepancy.model_file import ModelFile
from fmu_src.effect_words import effect_words

# Of an effect at one of several parts with which the reducer as a whole does the same.
SAME_WITH_EACH = (
    "no other run of these signals tells, for they are the same with each; measure these parts, or exchange one of them for that of another unit and"
    " repeat a run: if the effect changes with it, it was in that part"
)


def parts_untold(effects: Sequence[Mapping[str, Any]]) -> list[str]:
    """Of named effects that would show the same at other parts: that no run tells at which they are, and what does."""
    several = (effect for effect in effects if effect.get("other_places"))
    return [f"at which part it is ({effect_words(effect['name'])} at {effect['place']}) stays open; {SAME_WITH_EACH}" for effect in several]


def parts_untold_before(file: ModelFile) -> list[str]:
    """The same of effects that stand in a model file, as it was when they were added."""
    return [text for step in file.steps if step.get("kept", True) for text in step.get("untold", ())]


def origins_untold(effects: Sequence[Mapping[str, Any]], file: ModelFile, campaign: Campaign) -> list[str]:
    """Of ``effects`` that are named, or that the model has, and may come from one thing or another: that this campaign does not tell which, and what does."""
    return origins_untold_of([*(name for effect in effects for name in effect["parameters"]), *file.values()], campaign)


def origins_untold_of(known: Iterable[str], campaign: Campaign) -> list[str]:
    """The same of parameters by their names."""
    names = list(known)
    verdicts = (judge(pair, Design(campaign)) for pair in PAIRS if pair.within and any(name.startswith(pair.within) for name in names))
    return [f"whether it is {', or '.join(v.pair.effects)}, this campaign does not tell: {v.pair.experiment}"
            for v in verdicts if v.status == "not separable"]  # fmt: skip
