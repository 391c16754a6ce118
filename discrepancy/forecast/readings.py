"""A campaign's inspections of one quantity over the hours, and the limit at which its life ends."""

import math
from collections import defaultdict
from dataclasses import dataclass

import numpy as np

from discrepancy.campaign.amount import amount, to_si
from discrepancy.campaign.model import Campaign
from discrepancy.campaign.quantities import QUANTITIES
from discrepancy.forecast.forecast import Reading
from discrepancy.problem import Record
from discrepancy.repetitions import Outlying, outlying, with_left_out
from discrepancy.scales import of_axis, unit_of_axis
from fmu_src.faults import InputFault, nearest

# What only grows, one number an inspection.
GROWING = ("lost_motion", "wear_depth", "mass_loss")
HOUR = 3600.0


@dataclass(frozen=True)
class Limit:
    """Of a quantity, in the unit that people read it in."""

    quantity: str
    value: float
    unit: str


@dataclass(frozen=True)
class Inspections:
    """Readings that a forecast rests on, and those that were held out, in the limit's unit; ``outlying`` runs are in neither where they are left out."""

    readings: list[Reading]
    held_out: list[Reading]
    condition: str
    outlying: tuple[Outlying, ...] = ()


def limit_of(text: str) -> Limit:
    """``lost_motion=1arcmin``."""
    quantity, equals, value = text.partition("=")
    quantity = quantity.strip()
    if not equals or quantity not in GROWING:
        hint = nearest(quantity, GROWING, 1)
        raise InputFault(f"--limit {text}: write QUANTITY=NUMBER UNIT with one of {', '.join(GROWING)}{hint}, for instance lost_motion=1arcmin")
    known = QUANTITIES[quantity]
    number = amount(value.strip(), known.unit, f"--limit {quantity}")
    return Limit(quantity, number / to_si(known.usual_unit, known.unit, "")[0], known.usual_unit)


def inspections(campaign: Campaign, limit: Limit, condition: str | None = None, noise: str | None = None) -> Inspections:
    """Inspections of one condition; ``noise`` in place of what the campaign states or its repetitions show."""
    records = [r for r in campaign.records if r.quantity == limit.quantity]
    if not records:
        shown = sorted({r.quantity for r in campaign.records})
        raise InputFault(f"{campaign.folder}: no run of {limit.quantity}; there {'is' if len(shown) == 1 else 'are'} {', '.join(shown)}")
    named = sorted({without_hours(r, campaign) for r in records})
    chosen = condition or (named[0] if len(named) == 1 else "")
    if chosen not in named:
        raise InputFault(f"{campaign.folder}: {limit.quantity} was read at {', '.join(named)}; say which with --condition")
    records = [r for r in records if without_hours(r, campaign) == chosen]
    apart = tuple(outlying(records))
    records = [r for r in with_left_out(records, apart) if not r.left_out]
    factor = to_si(limit.unit, QUANTITIES[limit.quantity].unit, "")[0]
    stated = amount(noise, QUANTITIES[limit.quantity].unit, "--noise") if noise else None
    if stated is not None and not stated > 0.0:
        raise InputFault(f"--noise {noise}: a standard deviation lies above 0, for instance 0.3{limit.unit}")
    repeated = scatter([r for r in records if not r.held_out])
    found: dict[bool, list[Reading]] = {False: [], True: []}
    for r in records:
        own = stated or r.stated_noise or repeated
        if not own:
            text = f"{campaign.folder}: run {r.name}: nothing says how exact {limit.quantity} is"
            raise InputFault(f"{text}; state noise in the run, repeat one, or give --noise")
        hours = np.broadcast_to(np.asarray(r.axes.get("hours", r.factors.get("hours", 0.0)), np.float64), len(r.values)) / HOUR
        found[r.held_out] += [Reading(float(t), float(v) / factor, own / factor) for t, v in zip(hours, r.values) if math.isfinite(v)]
    used, held_out = (sorted(found[held], key=lambda r: r.hours) for held in (False, True))
    return Inspections(used, held_out, chosen, apart)


def without_hours(record: Record, campaign: Campaign) -> str:
    """What was inspected, whenever: where a campaign has a condition for each number of hours its factors tell them apart."""
    factors = {name: value for name, value in record.factors.items() if name != "hours"}
    tags = ", ".join(f"{name} {value}" for name, value in sorted(record.tags.items()))
    return ", ".join(factor_text(name, value, campaign) for name, value in sorted(factors.items())) + (f", {tags}" if tags else "")


def factor_text(name: str, value: float, campaign: Campaign) -> str:
    """A factor in the unit that the campaign states it in."""
    if name == "direction":
        return "forward" if value > 0.0 else "backward"
    return f"{name} {of_axis(name, campaign).number(value):.4g} {unit_of_axis(name, campaign)}".rstrip()


def scatter(records: list[Record]) -> float:
    """Standard deviation between readings of equal hours; 0 where none is repeated."""
    alike: dict[float, list[float]] = defaultdict(list)
    for r in records:
        for t, v in zip(np.broadcast_to(np.asarray(r.axes.get("hours", r.factors.get("hours", 0.0))), len(r.values)), r.values):
            alike[float(t)].append(float(v))
    squares = [(float(np.sum((np.array(v) - np.mean(v)) ** 2)), len(v) - 1) for v in alike.values() if len(v) > 1]
    freedom = sum(n for _, n in squares)
    return math.sqrt(sum(s for s, _ in squares) / freedom) if freedom else 0.0
