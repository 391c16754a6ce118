"""Runs that are planned and not measured yet, as records with nothing in them: what they would vary is known already."""

import math
from dataclasses import replace

import numpy as np

from discrepancy.campaign.file_format import FILE, read_campaign_file
from discrepancy.campaign.load import as_stated, record_of, zero_known
from discrepancy.campaign.model import Campaign
from discrepancy.campaign.order_analysis import as_numbers
from discrepancy.campaign.quantities import QUANTITIES, VALUE
from discrepancy.campaign.scales import make_scales
from discrepancy.problem import ORDERS, Record
from fmu_src.arrays import Floats

# Samples of one turn of the output, of each way of a loop, and of a surface (assumed: as benches have them once averaged).
ANGLES, WAY, PLACES = 450, 10, 40
HIGHEST_ORDER = 420


def with_planned(campaign: Campaign) -> tuple[Campaign, tuple[str, ...]]:
    """The campaign with a record of zeros for every run that has no rows yet, and the names of those runs."""
    if not campaign.unfilled:
        return campaign, ()
    path = campaign.folder / FILE
    content, _ = read_campaign_file(path)
    scales = make_scales(content.campaign, campaign.folder, path)
    found: list[Record] = []
    for i, run in enumerate(content.runs):
        series = axes_of(run.quantity, campaign) if run.id in campaign.unfilled else None
        if series is None:
            continue
        size = len(next(iter(series.values()))) if series else 1
        place = f"{path}: runs[{i + 1}] ({run.id})"
        record = record_of(run, campaign.conditions[run.condition], {VALUE: np.zeros(size), **series}, scales, place)
        found.append(as_stated(record, run, content, path, place, zero_known(run, content, place)))
    return replace(campaign, records=(*campaign.records, *found)), tuple(record.name for record in found)


def axes_of(quantity: str, campaign: Campaign) -> dict[str, Floats] | None:
    """Axes as a bench would have them; None where nobody can guess them."""
    rated = campaign.rated_torque
    known = {
        "angle": np.linspace(0.0, 2.0 * math.pi, ANGLES, endpoint=False), "order": np.arange(1.0, HIGHEST_ORDER),
        "depth_angle": np.radians(np.linspace(-78.0, 78.0, PLACES)),
    }  # fmt: skip
    if rated:
        up = (np.arange(WAY) + 1.0) / WAY * rated
        known["torque"] = np.concatenate([up, up[-2::-1], -up, -up[-2::-1], up])
    if quantity == ORDERS:
        numbers = as_numbers(known["order"], np.zeros(len(known["order"]), np.complex128))
        return {name: numbers[name] for name in ("order", "part")}
    axes = QUANTITIES[quantity].axes
    return {name: known[name] for name in axes} if all(name in known for name in axes) else None
