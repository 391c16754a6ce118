"""Which samples of a loop a model can foretell at all."""

from dataclasses import replace

import numpy as np

from discrepancy.campaign.model import Campaign
from discrepancy.closed_loop import joined_after, uncertain, way_of
from discrepancy.problem import SAMPLE, Record
from fmu_src.arrays import Mask

# Share of the rated torque below which a held output has no defined place.
FLOATING = 0.01


def defined(record: Record, campaign: Campaign) -> Record:
    """A loop without the samples near no torque, where the output floats in its clearances, and those that hang on what was before it: what is left
    of one that joined its branch is on it as one that was gone round before.  Samples keep their numbers: what repeats it may be without others."""
    way = joined(record, campaign)
    kept = kept_beyond(way, record, campaign)
    if kept.all():
        return record
    axes = {k: np.asarray(v)[kept] for k, v in record.axes.items()} | {SAMPLE: np.flatnonzero(kept).astype(float)}
    return replace(record, values=record.values[kept], axes=axes, closed=record.closed or way > 0.0)


def defined_at(record: Record, campaign: Campaign) -> Mask:
    """(n,) Samples of a record that the model can foretell: of a loop those at more than ``FLOATING`` of the rated torque, and not the first ones where
    nobody can tell how it was begun: what friction kept of the play then shows until the loop joins the branch that passes there again."""
    return kept_beyond(joined(record, campaign), record, campaign)


def kept_beyond(way: float, record: Record, campaign: Campaign) -> Mask:
    """``defined_at`` of a record that has ``joined`` its branch after this ``way`` of the torque [N m]."""
    if not is_over_torque(record):
        return np.ones(len(record.values), bool)
    torque = np.asarray(record.axes["torque"], float)
    rated = campaign.rated_torque or float(np.abs(torque).max())
    kept: Mask = np.abs(torque) > FLOATING * rated
    kept[: uncertain(torque, record.values)] = False
    if way > 0.0:
        kept[: np.argmax(way_of(torque) > way)] = False
    return kept


def joined(record: Record, campaign: Campaign) -> float:
    """How far the torque [N m] of a loop goes before it, and all that repeat it, have joined the branch that passes there again; 0 of others."""
    if not is_over_torque(record) or record.closed:
        return 0.0
    return max(joined_after(np.asarray(r.axes["torque"], float), r.values) for r in repetitions(record, campaign))


def is_over_torque(record: Record) -> bool:
    """Whether a record is a loop with its torque sample by sample."""
    return record.quantity == "hysteresis" and "torque" in record.axes


def repetitions(record: Record, campaign: Campaign) -> list[Record]:
    """Loops that repeat a record, itself among them: all are left alike, or they would tell no noise."""
    key = (record.quantity, record.condition, record.mounting, record.tags)
    return [record, *(r for r in campaign.records if (r.quantity, r.condition, r.mounting, r.tags) == key and "torque" in r.axes)]
