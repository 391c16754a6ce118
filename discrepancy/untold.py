"""What a campaign does not tell of effects that are named: which of two things they come from, and what does."""

from collections.abc import Mapping, Sequence
from typing import Any

from discrepancy.campaign.design import Design
from discrepancy.campaign.model import Campaign
from discrepancy.campaign.pairs import PAIRS, judge
from discrepancy.model_file import ModelFile


def origins_untold(effects: Sequence[Mapping[str, Any]], file: ModelFile, campaign: Campaign) -> list[str]:
    """Of ``effects`` that are named, or that the model has, and may come from one thing or another: that this campaign does not tell which, and what does."""
    known = [*(name for effect in effects for name in effect["parameters"]), *file.values()]
    verdicts = (judge(pair, Design(campaign)) for pair in PAIRS if pair.within and any(name.startswith(pair.within) for name in known))
    return [f"whether it is {', or '.join(v.pair.effects)}, this campaign does not tell: {v.pair.experiment}"
            for v in verdicts if v.status == "not separable"]  # fmt: skip
