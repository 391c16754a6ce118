"""Measured numbers whose scale no reducer has: held against the model's prediction, with the unit or the factor that would fit."""

import math
from collections import defaultdict
from collections.abc import Hashable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from discrepancy.campaign.amount import readable
from discrepancy.campaign.findings import WARNING, Finding
from discrepancy.campaign.model import Campaign, Source
from discrepancy.campaign.quantities import QUANTITIES, VALUE
from discrepancy.doubts.known_factors import KnownFactor, known_factor
from discrepancy.model_file import ModelFile
from discrepancy.prediction.defined_samples import defined_at
from discrepancy.prediction.nuisances import require_known
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import Record
from fmu_src.arrays import Floats
from fmu_src.faults import RunFault
from fmu_src.units import conversion

# Units that are written for each other, by the SI unit of a quantity.
UNITS = {
    "rad": ("rad", "mrad", "urad", "turn", "deg", "arcmin", "arcsec"), "m": ("m", "mm", "um", "nm"), "kg": ("kg", "g", "mg", "ug"),
    "N.m": ("kN.m", "N.m", "N.cm", "mN.m"), "N.m/rad": ("N.m/rad", "N.m/deg", "N.m/arcmin", "N.m/arcsec", "kN.m/rad"),
    "1": ("1", "%", "ppm"), "rad/s": ("rad/s", "deg/s", "rpm", "turn/s"), "m/s^2": ("m/s^2", "mm/s^2"),
}  # fmt: skip
# Off the model by so many times a scale is looked at, and doubted if another unit brings it near.
LOOKED_AT = 20.0
# What is near, in times the model.  Real reducers are several times softer than a base with rigid supports, and turn with several times
# the error of ideal parts; none is stiffer or better than its contacts (assumed limits).
NEAR = {"hysteresis": (0.5, 10.0), "lost_motion": (0.5, 10.0), "transmission_error": (0.5, 10.0), "torsional_stiffness": (0.1, 2.0)}
NEAR_OTHERS = (1.0 / 3.0, 3.0)
# A unit that leaves more than this is not offered: it may be any.
CLOSE = 3.0
# Nearer than this a unit is what was meant, as far as one may say it of a reducer that is not the model's.
MEANT = 1.6
# Off by so many times it is doubted whatever unit it has; wear hangs on coefficients that are hardly known.
DOUBTED, HARDLY_KNOWN = 100.0, 1000.0
LOOSE = ("wear_profile", "wear_depth", "mass_loss", "debris_iron")
# Run-out of an encoder alone may be so many times the error of ideal parts: a factor is no reason to doubt it then.
ANY_SIZE = ("transmission_error",)
# Without friction and errors of parts, which the base model leaves out, there is nothing to compare with.
NOT_COMPARED = ("no_load_torque", "temperature", "vibration", "vibration_order", "transmission_order")
# So many samples show a scale; and so many runs of a signal, from all its files.
SAMPLES, MOST_RUNS = 200, 8


@dataclass(frozen=True)
class Fit:
    """A unit that the numbers may be in, and how many times the model they would be then."""

    unit: str
    times: float


def scale_doubts(campaign: Campaign, lives: bool = True) -> list[Finding]:
    """Runs of each signal, from different files, against the reducer of the campaign; nothing without a reducer.

    Without ``lives`` those of worn units are left out, whose predictions take their time.
    """
    if campaign.reducer is None:
        return []
    require_known(campaign.folder, campaign.nuisances, (campaign.reducer.plant, campaign.reducer.wear))
    chosen: dict[Hashable, dict[str, Record]] = defaultdict(dict)
    # New units first: a worn one costs a life.
    for record in sorted(campaign.records, key=hours_of):
        # A loop that stays near no torque has nothing that the model can foretell.
        if record.quantity not in NOT_COMPARED and (lives or hours_of(record) == 0.0) and defined_at(record, campaign).any():
            chosen[kind_of(record, campaign)].setdefault(file_of(record, campaign), record)
    few = tuple(thinned(record) for runs in chosen.values() for record in list(runs.values())[:: -(-len(runs) // MOST_RUNS)])
    if not few:
        return []
    model = PhysicalModel(ModelFile(campaign.reducer.name, campaign.reducer), replace(campaign, records=few, nuisances=()), zeros={})
    pairs = []
    for k, record in enumerate(model.records):
        try:
            pairs.append((record, model.predict({}, [k])[0]))
        except RunFault:
            # Where the model finds no equilibrium it can doubt nothing.
            continue
    return doubts_of(pairs, campaign)


def doubts_of(pairs: Iterable[tuple[Record, Floats]], campaign: Campaign) -> list[Finding]:
    """What is doubted of records beside their predictions, once for each signal and unit; runs that are off alike are named."""
    found: dict[Hashable, Finding] = {}
    alike: dict[Hashable, list[str]] = defaultdict(list)
    for record, predicted in pairs:
        if (doubted := doubt(record, predicted, campaign.sources, campaign.ratio)) is None:
            continue
        key = (kind_of(record, campaign), doubted.remedy)
        if key in found:
            alike[key].append(record.name)
        else:
            found[key] = doubted
    return [
        replace(f, text=f.text + (f"; alike {', '.join(alike[key][:MOST_RUNS])}{' ...' if len(alike[key]) > MOST_RUNS else ''}" if alike[key] else ""))
        for key, f in found.items()
    ]


def hours_of(record: Record) -> float:
    return float(np.max(record.axes.get("hours", record.factors.get("hours", 0.0)), initial=0.0))


def kind_of(record: Record, campaign: Campaign) -> Hashable:
    """Equal for runs whose numbers are of one signal in one unit."""
    source = campaign.source(record.name, VALUE)
    return (record.quantity, *sorted(record.tags.items()), source and source.unit)


def file_of(record: Record, campaign: Campaign) -> str:
    source = campaign.source(record.name, VALUE)
    return source.file if source else ""


def thinned(record: Record) -> Record:
    """The first samples of a series over angle or time, some of a loop, all numbers."""
    size = len(record.values)
    if size <= SAMPLES:
        return record
    rows = np.arange(SAMPLES) if "torque" not in record.axes else np.linspace(0, size - 1, SAMPLES).astype(int)
    return replace(record, values=record.values[rows], axes={name: np.asarray(axis)[rows] for name, axis in record.axes.items()})


def doubt(record: Record, predicted: Floats, sources: Mapping[str, Mapping[str, Source]], ratio_of_reducer: float | None) -> Finding | None:
    """What is doubted of a run's scale, if anything; ``predicted`` (n,) in the record's unit."""
    measured, model = (size_of(values, record.free_zero) for values in (record.values, predicted))
    if record.quantity in NOT_COMPARED or not (measured > 0.0 and model > 0.0):
        return None
    times = measured / model
    off = max(times, 1.0 / times)
    q = QUANTITIES[record.quantity]
    source = sources.get(record.name, {}).get(VALUE, Source("", "", q.usual_unit, conversion(q.unit, q.usual_unit)[0] ** -1))
    low, high = NEAR.get(record.quantity, NEAR_OTHERS)
    near = [fit for fit in fitting(times, source.unit, q.unit, math.sqrt(low * high)) if low <= fit.times <= high]
    known = None if record.quantity in LOOSE else known_factor(times, source.unit, q.unit, ratio_of_reducer)
    telling = near or (known and record.quantity not in ANY_SIZE)
    if off < LOOKED_AT or not (telling or off >= (HARDLY_KNOWN if record.quantity in LOOSE else DOUBTED)):
        return None
    what = "varies by" if record.free_zero else "is about"
    stated, expected = (readable(size / abs(source.factor), 4) for size in (measured, model))
    place = f" ({source})" if source.column else ""
    text = (
        f"run {record.name}: {record.quantity} {what} {stated} {source.unit}{place}, {ratio(times)} what the model"
        f" predicts, {expected} {source.unit}"
    )
    return Finding(WARNING, "implausible scale", text, remedy_of(near, known, source, q.unit))


def size_of(values: Floats, free_zero: bool) -> float:
    """Root mean square, about the mean where the zero is free."""
    values = np.asarray(values, float)[np.isfinite(values)]
    if not len(values):
        return 0.0
    return float(np.std(values) if free_zero else np.sqrt(np.mean(values**2)))


def fitting(times: float, stated: str, si: str, usual: float = 1.0) -> list[Fit]:
    """Units that the same numbers could be in, nearest to what is ``usual`` (in times the model) first."""
    own = conversion(stated, si)[0] if stated in UNITS.get(si, ()) else None
    if own is None:
        return []
    found = [Fit(unit, times * conversion(unit, si)[0] / own) for unit in UNITS[si] if unit != stated]

    def distance(times: float) -> float:
        return abs(math.log(times / usual))

    return sorted((f for f in found if distance(f.times) < distance(times)), key=lambda f: distance(f.times))


def ratio(times: float) -> str:
    return f"{readable(times)} times" if times >= 1.0 else f"1/{readable(1.0 / times)} of"


def remedy_of(near: Sequence[Fit], known: KnownFactor | None, source: Source, si: str) -> str:
    """By a unit that comes close, else by a well-known factor."""
    fits = [fit for fit in near if 1.0 / CLOSE <= fit.times <= CLOSE][:2]
    if not fits:
        return known.remedy(source, si) if known else "look at unit and scale of the column"
    factors = [conversion(source.unit, si)[0] / conversion(f.unit, si)[0] for f in fits]
    between = ", ".join(f"{max(factor, 1.0 / factor):.6g} is the factor between {source.unit} and {f.unit}" for factor, f in zip(factors, fits))
    named = " or ".join(f'"{f.unit}"' for f in fits)
    # Half or twice is no slip of units: who takes that one for certain has another wrong one.
    left = [fit.unit for fit in fits if not 1.0 / MEANT <= fit.times <= MEANT]
    off = f"; in {' or '.join(left)} it would still be off by more than {MEANT:g} times, so look at the scale, too" if left else ""
    return f"{between}: state unit = {named} if that is what was written{off}"
