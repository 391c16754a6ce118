"""A reducer that is delivered worn: what its life at rated speed and torque leaves on its surfaces.

Its units start with those surfaces, at rest and at angle 0, so that whoever connects them does
nothing else than with new ones.
"""

import hashlib
import json
import math
from dataclasses import replace
from typing import Any

import numpy as np

from fmu_src import checked_file
from fmu_src.cache_folder import cache_folder
from fmu_src.faults import InputFault, RunFault
from fmu_src.source_hash import KERNEL_PACKAGES, source_hash
from fmu_src.start_arrays import encode
from fmu_src.units import UnitError, conversion
from orchestrator.component import InProcess
from orchestrator.settings import NUMBER
from reducers.reducer import Reducer
from rv_reducer.exchange import WEAR_TO_PLANT
from studies.coupled_master import CoupledMaster
from studies.life import Life, LifeSettings, live
from studies.meshing_cycle import HOUR
from studies.pair import make_pair
from wear_fmu.contacts import publish_profiles

# Of the wear unit: its surfaces and what it tells of them.
SURFACES = ("disc_wear", "pin_wear", "pin_even_wear", "inner_race_wear", "outer_race_wear")
FIGURES = (
    "flank_depth", "flank_phase", "flank_lobe", "pin_depth", "inner_race_depth", "inner_race_angle", "outer_race_depth",
    "outer_race_angle", "flank_volume", "pin_volume", "inner_race_volume", "outer_race_volume", "operating_time", "crank_travel",
)  # fmt: skip
# What is published at the start: the plant meets the worn surfaces in its first equilibrium.
PUBLISHED = (*(name.replace(".", "_") for name in WEAR_TO_PLANT), "profile_lead", "profile_reach")
# Of the unit of both: the last judgement, by what it was of.
JUDGED = {
    "judged_time": "operating_time", "judged_flank_volume": "flank_volume", "judged_inner_volume": "inner_race_volume",
    "judged_outer_volume": "outer_race_volume",
}  # fmt: skip
# Depths are kept to a part of a picometre, which is below their rounding [m].
GRAIN = 2.0**-41
MARK = b"rvwear worn reducer 1\n"
# A century: nobody means more [h].
MOST_HOURS = 876_600.0


def hours_of(text: str) -> float:
    """Operating hours from ``5000h``, ``200 days`` or a plain number of hours; InputFault if it is no such time."""
    match = NUMBER.fullmatch(text)
    said = f"worn = {text!r}"
    if match is None:
        raise InputFault(f"{said}: a time is needed, with its unit: 5000h")
    try:
        factor, _ = conversion(match[2] or "h", "s")
    except UnitError:
        raise InputFault(f"{said}: {match[2]!r} is no unit of time; operating hours are meant: 5000h") from None
    hours = float(match[1]) * factor / HOUR
    if not 0.0 < hours <= MOST_HOURS:
        raise InputFault(f"{said}: operating hours between 0 and {MOST_HOURS:g} h are needed; a new reducer needs no --worn")
    return hours


def worn_reducer(reducer: Reducer, hours: float) -> Reducer:
    """The same reducer after so many hours at its rated speed and torque; depths to 1 %, as ``rvwear life`` finds them."""
    return replace(reducer, worn={unit: {"hours": hours, "arrays": arrays} for unit, arrays in worn_arrays(reducer, hours).items()})


def worn_arrays(reducer: Reducer, hours: float) -> dict[str, dict[str, str]]:
    """Start values of a worn reducer's wear unit and of its unit of both, packed; kept between runs."""
    code = source_hash((*KERNEL_PACKAGES, "studies"))
    inputs = json.dumps([code, hours, reducer.specification("rv_reducer"), reducer.specification("wear_fmu")], sort_keys=True)
    place = cache_folder("worn") / hashlib.sha256(inputs.encode()).hexdigest()
    kept = checked_file.read(place, MARK)
    if kept is None:
        kept = json.dumps(make_worn(reducer, hours)).encode()
        checked_file.write(place, MARK, kept)
    made: dict[str, dict[str, str]] = json.loads(kept)
    return made


def make_worn(reducer: Reducer, hours: float) -> dict[str, dict[str, str]]:
    new = replace(reducer, worn={})
    pair = make_pair(new, master_kind=CoupledMaster)
    try:
        live(pair, Life(LifeSettings(hours)), lambda life: None, lambda life: None)
    except RunFault as fault:
        raise InputFault(f"worn = {hours:g} h: {reducer.name} does not live as long at its rated speed and torque: {fault}") from None
    found = pair.wear.record()[0]
    wear = InProcess("wear", new.specification("wear_fmu"))
    wear.exit_initialisation()
    r = wear.records[0]
    for name in SURFACES:
        r[name] = np.round(found[name] / GRAIN) * GRAIN
    for name in FIGURES:
        r[name] = found[name]
    # Without the rounding of the jumps' sum.
    r["operating_time"] = hours * HOUR
    sense = math.copysign(1.0, float(found["crank_speed"]))
    publish_profiles(wear.records[0], 0.0, sense, sense * float(r["largest_sweep"]))
    values: dict[str, Any] = {name: r[name] for name in (*SURFACES, *FIGURES, *PUBLISHED)}

    both = InProcess("reducer", new.specification("rv_reducer"))
    both.exit_initialisation()
    names = both.table.views["wear"]
    joint = {names[name]: value for name, value in values.items()}
    joint |= {name: values[of] for name, of in JUDGED.items()}
    joint["new_lost_motion"] = both.number("lost_motion")
    return {
        "wear_fmu": {name: encode(value) for name, value in values.items()},
        "rv_reducer": {name: encode(value) for name, value in joint.items()},
    }
