"""Notes that hold for a campaign whatever the model: whole where measurements are first held against one, in few words afterwards."""

from collections.abc import Mapping, Sequence

import numpy as np

from discrepancy.campaign.model import Campaign
from discrepancy.campaign.zeros import unused_means
from discrepancy.prediction.defined_samples import FLOATING, defined_at
from discrepancy.prediction.even_angles import erring

# Where the whole of a short note stands.
WHOLE = "`rvwear compare` says these whole"


def floating_of(campaign: Campaign) -> dict[str, int]:
    """By run, how many of its samples are not compared, because the output floats there; runs without such samples are left out."""
    counts = {record.name: int((~defined_at(record, campaign)).sum()) for record in campaign.records}
    return {name: count for name, count in counts.items() if count}


def counted_samples(floating: Mapping[str, int]) -> str:
    """``58 samples of 4 runs``; ``floating`` holds at least one run."""
    count = sum(floating.values())
    return f"{count} sample{'s' * (count > 1)} of {f'run {next(iter(floating))}' if len(floating) == 1 else f'{len(floating)} runs'}"


def floating_text(floating: Mapping[str, int]) -> str:
    """What of samples near no torque is said."""
    return (f"{counted_samples(floating)} not compared: within {100 * FLOATING:g} % of the rated torque from no torque the output floats, and where a loop"
            " begins it still hangs on what was before; a lost motion is read only where both ways of the loop have samples left")  # fmt: skip


def evened_texts(campaign: Campaign) -> dict[str, str]:
    """By quantity what of angles that err from sample to sample is said, each with its short form."""
    turnings = erring(campaign.records)
    found: dict[str, str] = {}
    for quantity in dict.fromkeys(r.quantity for r in campaign.records if r.name in turnings):
        runs = [turnings[r.name] for r in campaign.records if r.quantity == quantity and r.name in turnings]
        count = f"{len(runs)} run{'s' * (len(runs) > 1)}"
        noise = np.degrees(np.median([turning.noise for turning in runs]))
        text = (f"{quantity}: the angles of {count} err by {noise:.2g} deg from sample to sample (runs that repeat each other agree at even angles and not"
                " at those that are written); taken as those of an even turning")  # fmt: skip
        found[text] = f"{quantity}: angles of {count} made even"
    return found


def standing_notes(campaign: Campaign) -> dict[str, str]:
    """The notes, each with its short form."""
    floating = floating_of(campaign)
    notes = {floating_text(floating): f"{counted_samples(floating)} near no torque not compared"} if floating else {}
    notes |= evened_texts(campaign)
    return notes | {f"{text}; {remedy}": f"{text.partition(':')[0]}: means over a run not used" for text, remedy in unused_means(campaign.records)}


def shortened(warnings: Sequence[str], standing: Mapping[str, str]) -> list[str]:
    """The ``warnings`` with all of the standing notes among them as one, last, in few words."""
    short = [standing[text] for text in warnings if text in standing]
    return [text for text in warnings if text not in standing] + ([f"as before: {'; '.join(short)} ({WHOLE})"] if short else [])
