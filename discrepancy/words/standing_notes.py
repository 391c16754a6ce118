"""Notes that hold for a campaign whatever the model: whole where measurements are first held against one, in few words afterwards."""

from collections import defaultdict
from collections.abc import Mapping, Sequence

import numpy as np

from discrepancy.campaign.model import Campaign
from discrepancy.campaign.zeros import unused_means
from discrepancy.prediction.defined_samples import FLOATING, defined_at
from discrepancy.problem import Record

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


def evened_texts(records: Sequence[Record]) -> dict[str, str]:
    """By quantity what of angles that were made even is said, each with its short form."""
    noises: dict[str, list[float]] = defaultdict(list)
    for record in records:
        if record.angle_noise:
            noises[record.quantity].append(record.angle_noise)
    found: dict[str, str] = {}
    for quantity, every in noises.items():
        count = f"{len(every)} run{'s' * (len(every) > 1)}"
        noise = np.degrees(np.median(every))
        text = (f"{quantity}: the angles of {count} err by {noise:.2g} deg from sample to sample (runs that repeat each other agree at even angles and not"
                " at those that are written); taken as those of an even turning")  # fmt: skip
        found[text] = f"{quantity}: angles of {count} made even"
    return found


def standing_notes(campaign: Campaign, records: Sequence[Record]) -> dict[str, str]:
    """The notes, each with its short form; ``records`` are the campaign's as a model compares them."""
    floating = floating_of(campaign)
    notes = {floating_text(floating): f"{counted_samples(floating)} near no torque not compared"} if floating else {}
    notes |= evened_texts(records)
    return notes | {f"{text}; {remedy}": f"{text.partition(':')[0]}: means over a run not used" for text, remedy in unused_means(campaign.records)}


def shortened(warnings: Sequence[str], standing: Mapping[str, str]) -> list[str]:
    """The ``warnings`` with all of the standing notes among them as one, last, in few words."""
    short = [standing[text] for text in warnings if text in standing]
    return [text for text in warnings if text not in standing] + ([f"as before: {'; '.join(short)} ({WHOLE})"] if short else [])
