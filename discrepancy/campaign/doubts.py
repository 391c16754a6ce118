"""Numbers of a campaign that cannot be, or that no diagnosis needs; what only a model can doubt is in ``discrepancy.doubts.plausible``."""

import math
from collections import defaultdict
from collections.abc import Iterator

import numpy as np

from discrepancy.campaign.amount import readable
from discrepancy.campaign.angle_doubts import rates_of_angles, senses_of_angles
from discrepancy.campaign.design import Design, turns
from discrepancy.campaign.findings import WARNING, Finding
from discrepancy.campaign.loop_doubts import ways_round
from discrepancy.campaign.model import Campaign, Source
from discrepancy.campaign.quantities import VALUE
from discrepancy.campaign.row_order import jumps_of
from discrepancy.problem import Record
from fmu_src.arrays import Floats
from fmu_src.units import conversion
from reducers.rated import MOST_RATED

# Share of the rated torque that a loop reaches at least if its unit is right, and the most that benches apply.
USUAL_REACH = (0.1, 2.5)
TORQUE_UNITS = ("N.m", "N.mm", "N.cm", "kgf.cm", "lbf.in", "kN.m")
# Samples of the shortest wave that show it, with a margin above the two that are needed at least.
SAMPLES_PER_WAVE = 2.5
# Of the largest torque: steps that show play (from -3 % to +3 %), curvature and the loop's width.
TORQUE_STEP = 0.01
# Samples are more than enough from so many times on.
NEEDLESS = 2.0
NOWHERE = Source("", "", "", 1.0)


def source_of(campaign: Campaign, record: Record, axis: str) -> Source:
    """Where the numbers stand; nowhere of a record that no file was read for."""
    return campaign.source(record.name, axis) or NOWHERE


def torques(design: Design) -> Iterator[Finding]:
    for record in design.campaign.records:
        if found := impossible_torque(record, design.campaign):
            yield found


def impossible_torque(record: Record, campaign: Campaign) -> Finding | None:
    """A torque or load of a run that no reducer takes, with the unit that it may be in; None where all is possible."""
    rated = campaign.rated_torque
    for name in ("torque", "load"):
        stated = [record.factors[name]] if name in record.factors else []
        largest = float(np.abs(np.asarray(record.axes.get(name, stated), float)).max(initial=0.0))
        if not rated or largest <= MOST_RATED * rated:
            continue
        source = source_of(campaign, record, name)
        fits = fitting_unit(largest, rated, source) if name in record.axes else ""
        wrong = "correct unit or scale of the column" if name in record.axes else f"correct load_torque in [conditions.{record.condition}]"
        return Finding(
            WARNING, "impossible torque",
            f"run {record.name}: the {name} reaches {largest:.6g} N.m{campaign.place(record.name, name)},"
            f" {readable(largest / rated)} times the rated {rated:.4g} N.m; a reducer takes {MOST_RATED:g} times",
            f'state unit = "{fits}" in its column if that is what it holds' if fits else wrong,
        )  # fmt: skip
    return None


def fitting_unit(largest: float, rated: float, source: Source) -> str:
    """A unit in which the same numbers would be a loop of this reducer; empty if none."""
    for unit in TORQUE_UNITS:
        reach = largest * conversion(unit, "N.m")[0] / (source.factor * rated)
        if unit != source.unit and USUAL_REACH[0] <= abs(reach) <= USUAL_REACH[1]:
            return unit
    return ""


def order_of_rows(design: Design) -> Iterator[Finding]:
    for record in design.campaign.records:
        for name, at in jumps_of(record).items():
            source = source_of(design.campaign, record, name)
            first = int(at[0])
            before, after = (float(v) / source.factor for v in record.axes[name][first : first + 2])
            unit = f" {source.unit}" if source.column else ""
            yield Finding(
                WARNING, "rows out of order",
                f"run {record.name}: {name}{design.campaign.place(record.name, name)} jumps back and forth {len(at)} times,"
                f" first from {before:.6g} to {after:.6g}{unit} at sample {first + 2}",
                "export the rows in the order in which they were measured (sort by time); split repetitions by where = { ... }",
            )  # fmt: skip


def needless_samples(design: Design) -> Iterator[Finding]:
    campaign = design.campaign
    found: dict[tuple[str, str], list[tuple[Record, int]]] = defaultdict(list)
    for record in campaign.records:
        enough, why = suffices(record, campaign)
        if enough and len(record.values) >= NEEDLESS * enough:
            found[record.quantity, why].append((record, enough))
    for (quantity, why), runs in found.items():
        record, enough = max(runs, key=lambda r: len(r[0].values) / r[1])
        points = min(len(r.values) // e for r, e in runs)
        yield Finding(
            WARNING, "needless samples",
            f"{quantity}: {len(record.values)} samples in run {record.name}{campaign.place(record.name, VALUE)}"
            + (f" and more than enough in {len(runs) - 1} others" if len(runs) > 1 else "") + f", {enough} suffice: {why}",
            f"average = {{ points = {points} }} gives the same answer sooner: means keep what the samples say of these",
        )  # fmt: skip


def suffices(record: Record, campaign: Campaign) -> tuple[int, str]:
    """How many samples show all that a diagnosis looks at, and why; 0 where nothing is known of it."""
    if record.quantity == "hysteresis" and "torque" in record.axes:
        torque = np.asarray(record.axes["torque"], float)
        # The way of a noiseless torque: jitter of the sensor is no way.
        way = path(torque)
        largest = float(np.abs(torque).max(initial=0.0))
        count = math.ceil(way / (TORQUE_STEP * largest)) if largest > 0.0 else 0
        return count, f"steps of {100 * TORQUE_STEP:g} % of the largest torque show play, curvature and width of the loop"
    if "angle" in record.axes and campaign.reducer is not None:
        order, what = highest_order_of_parts(campaign)
        count = math.ceil(SAMPLES_PER_WAVE * order * turns(record))
        return count, f"no part makes a higher order than {order:g} per output turn ({what}), which {SAMPLES_PER_WAVE:g} samples a wave show"
    return 0, ""


def path(torque: Floats) -> float:
    """Way from end to end through all reversals that are larger than a twentieth of the range."""
    least, turned, last = 0.05 * float(np.ptp(torque)), [float(torque[0])], float(torque[0])
    for value in map(float, torque):
        if len(turned) > 1 and (value - last) * (last - turned[-2]) >= 0.0:
            last = turned[-1] = value
        elif abs(value - last) > least:
            turned.append(value)
            last = value
    return float(np.abs(np.diff(turned)).sum())


def highest_order_of_parts(campaign: Campaign) -> tuple[float, str]:
    """Of the pins, of the first stage, and of what the campaign names."""
    assert campaign.reducer is not None
    topology = campaign.reducer.topology
    orders = [(float(topology.pins * topology.lobes), "lobes over pins")]
    starts = campaign.reducer.plant.by_name
    if float(starts["first_stage_ratio"].start) > 0.0 and campaign.ratio:
        orders.append(((campaign.ratio - 1.0) * float(starts["sun_teeth"].start), "teeth of the first stage"))
    orders += [(max(family), name) for name, family in campaign.orders.items() if family]
    return max(orders)


DOUBTS = (torques, order_of_rows, rates_of_angles, senses_of_angles, ways_round, needless_samples)
