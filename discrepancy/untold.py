"""What a campaign does not tell of effects that are named: which of two things they come from, and what does."""

from collections.abc import Iterable

from discrepancy.campaign.design import Design
from discrepancy.campaign.model import Campaign
from discrepancy.campaign.pairs import PAIRS, judge


def origins_untold(names: Iterable[str], campaign: Campaign) -> list[str]:
    """Of effects that may come from one thing or another: that this campaign does not tell which, and what does."""
    known = set(names)
    verdicts = (judge(pair, Design(campaign)) for pair in PAIRS if pair.within in known)
    return [f"whether it is {', or '.join(v.pair.effects)}, this campaign does not tell: {v.pair.experiment}"
            for v in verdicts if v.status == "not separable"]  # fmt: skip
