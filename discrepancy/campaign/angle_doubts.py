"""Angles of the output that run on at another rate than the stated speed, mostly those of the input, or the other way round."""

import math
from collections.abc import Iterator

import numpy as np

from discrepancy.campaign.amount import readable
from discrepancy.campaign.design import Design, turns
from discrepancy.campaign.findings import WARNING, Finding
from discrepancy.campaign.mending import OfColumn
from discrepancy.campaign.model import Campaign
from discrepancy.campaign.row_order import is_shuffled
from discrepancy.problem import Record

# Times the stated speed from which on a rate is doubted (either way), and how near to the ratio it speaks for the input.
OTHER_RATE, NEAR_RATIO = 2.0, 0.1
# Without a time: a quarter of a turn of the input, taken for the output, with fewer samples than show the pins' order.
SHARE_OF_RATIO, SAMPLES_PER_WAVE = 0.25, 2.0
# The first and the last part of so many tell which way an angle runs.
FEW = 8


def angle_doubts(campaign: Campaign) -> list[Finding]:
    """Both kinds, of a campaign that was only just written."""
    design = Design(campaign)
    return [*rates_of_angles(design), *senses_of_angles(design)]


def rates_of_angles(design: Design) -> Iterator[Finding]:
    """Once for each column that runs alike."""
    campaign, seen = design.campaign, set[tuple[str, str]]()
    for record in campaign.records:
        source, speed = campaign.source(record.name, "angle"), output_speed(record, campaign)
        if source is None or speed <= 0.0 or "angle" not in record.axes or is_shuffled(record, "angle"):
            continue
        times, text = with_time(record, speed) if "time" in record.axes else without_time(record, speed, campaign)
        column = source.column.removeprefix("column ")
        if not text or (column, text) in seen:
            continue
        seen.add((column, text))
        of = OfColumn(column, "input_angle" if abs(times / (campaign.ratio or math.inf) - 1.0) < NEAR_RATIO else "")
        remedy = of.remedy() if of.role else "correct the angle's unit or scale, or the condition's speed"
        yield Finding(WARNING, "rate of the angle", f"run {record.name}: the output's angle{campaign.place(record.name, 'angle')} {text}", remedy, of)


def senses_of_angles(design: Design) -> Iterator[Finding]:
    """Angles that fall while the reducer turned forward: every place on it would be taken for its mirror image."""
    campaign, seen = design.campaign, set[str]()
    for record in campaign.records:
        source, angle = campaign.source(record.name, "angle"), record.axes.get("angle", np.zeros(0))
        if record.quantity != "transmission_error" or source is None or len(angle) < FEW or record.factors.get("direction", 1.0) < 0.0:
            continue
        ends = float(np.mean(angle[-(len(angle) // FEW) :]) - np.mean(angle[: len(angle) // FEW]))
        # Of shuffled rows the ends are any: what is wrong with them is said of their order.
        if ends >= 0.0 or source.column in seen or is_shuffled(record, "angle"):
            continue
        seen.add(source.column)
        stated = "is forward" if campaign.conditions[record.condition].direction_stated else "states no direction and so is forward"
        text = f"run {record.name}: the angle{campaign.place(record.name, 'angle')} falls, while its condition {stated}"
        remedy = 'state direction = "reverse" if it turned that way; else scale = -1 in its column, for the encoder counts the other way'
        yield Finding(WARNING, "sense of the angle", text, remedy, OfColumn(source.column.removeprefix("column ")))


def output_speed(record: Record, campaign: Campaign) -> float:
    """Stated, rad/s at the output; 0 where nothing is."""
    stated = record.axes.get("speed", record.factors.get("speed", 0.0))
    return float(np.mean(stated)) / (campaign.ratio or math.inf)


def with_time(record: Record, speed: float) -> tuple[float, str]:
    """Times the stated speed, and what is odd about it; no words where all is well."""
    seconds = float(np.ptp(record.axes["time"]))
    times = 2.0 * math.pi * turns(record) / (speed * seconds) if seconds > 0.0 else 1.0
    if times == 0.0 or 1.0 / OTHER_RATE < times < OTHER_RATE:
        return times, ""
    return times, f"makes {turns_text(turns(record))} in {readable(seconds)} s: {readable(times)} times the stated {rpm(speed)}"


def without_time(record: Record, speed: float, campaign: Campaign) -> tuple[float, str]:
    """The ratio where only the input can have turned so far in so few samples, and the words; else 1 and none."""
    whole = turns(record)
    if campaign.reducer is None or campaign.ratio is None or whole < SHARE_OF_RATIO * campaign.ratio:
        return 1.0, ""
    if len(record.values) > SAMPLES_PER_WAVE * campaign.reducer.topology.pins * whole:
        return 1.0, ""
    return campaign.ratio, (
        f"makes {turns_text(whole)}, {readable(2.0 * math.pi * whole / speed)} s at the stated {rpm(speed)}, in {len(record.values)} samples, too few for"
        f" the {campaign.reducer.topology.pins} pins; over the ratio it is {turns_text(whole / campaign.ratio)}"
    )


def turns_text(count: float) -> str:
    said = readable(count)
    return f"{said} turn{'s' * (said != '1')}"


def rpm(speed: float) -> str:
    return f"{readable(speed * 30.0 / math.pi)} rpm"
