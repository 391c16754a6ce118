"""The RV-E series from its catalogue: eight sizes completed by the same rules and the same few dials, none for one size alone.

A size gives rated torque, outer diameter and a ratio of its list; ``reducers.completion`` makes a reducer of them.  Dials (``DIALS``) are the same for
all sizes, each within its published or assumed range; three more (``FIXED``) stand at one end of theirs.  One of the dials, how soft a crank's
bearing is in place, is fitted to the stiffness of all sizes together.  What is then left of each size is named: the compliance at the cranks'
supports that is missing, or too much.  Which size fails in which figure: ``family_marks``.

Source of the catalogue's figures: Nabtesco, Precision Reduction Gear RV, E series, rating table, as it is quoted elsewhere; not checked
against the printed catalogue.
Efficiency there is a chart per size, which was not to be had: typical start-up efficiency is a column of the table, 80 to 90 % at rated load and 50 to
60 % at a tenth of it are what is generally read off the charts.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass

from scipy.optimize import brentq

from fmu_src.faults import InputFault
from fmu_src.progress import task
from orchestrator.settings import parse_setting
from reducers.completion.complete import Completion, complete
from reducers.completion.dials import IN_SERIES, Dial
from reducers.completion.file import reducer_at
from reducers.completion.given import Given
from reducers.reducer import Reducer
from studies.hysteresis import ANGLES, STEPS, hysteresis
from studies.pair import make_pair
from studies.solve import record_turn

CATALOGUE = "Nabtesco, Precision Reduction Gear RV, E series, rating table, as quoted elsewhere; not checked against print"
# Loads over rated torque, output speeds [rpm], and the speed that stands for starting.
SHARES, SPEEDS, STARTING = (1.0, 0.5, 0.25, 0.1), (5.0, 15.0, 30.0), 0.05
POSITIONS = 12
# Of the catalogue's stiffness, either way: assumed.  The one size that somebody measured, RV-40E, had 109 to 122 % of its catalogue's.
SCATTER, MEASURED = 0.25, 0.22


@dataclass(frozen=True)
class Size:
    """One size in the catalogue: rated torque [N m] at 15 rpm, outer diameter [mm], a ratio of its list, stiffness [N m/arcmin], largest lost motion
    [arcmin], typical start-up efficiency [%]."""

    name: str
    rated: float
    diameter: float
    ratio: float
    stiffness: float
    lost_motion: float
    start_up: float


SIZES = (
    Size("RV-6E", 58.0, 122.0, 103.0, 20.0, 1.5, 70.0), Size("RV-20E", 167.0, 145.0, 121.0, 49.0, 1.0, 75.0),
    Size("RV-40E", 412.0, 190.0, 121.0, 108.0, 1.0, 85.0), Size("RV-80E", 784.0, 222.0, 121.0, 196.0, 1.0, 85.0),
    Size("RV-110E", 1078.0, 244.0, 161.0, 294.0, 1.0, 85.0), Size("RV-160E", 1568.0, 280.0, 129.0, 392.0, 1.0, 85.0),
    Size("RV-320E", 3136.0, 325.0, 129.0, 980.0, 1.0, 80.0), Size("RV-450E", 4410.0, 370.0, 129.0, 1176.0, 1.0, 85.0),
)  # fmt: skip
PINS = 40
# The dials of the family, by name as in reducers.completion; one of them is fitted.
DIALS: Mapping[str, float] = {
    "support_share": 6.0, "bearing.clearance": 2.0, "mesh.friction": 0.06, "seal_share": 0.035, "churning_share": 0.035,
}  # fmt: skip
FITTED = "support_share"
# Beside the dials, at the end of its range for all sizes: rollers lie on two races (Palmgren), profiles are ideal (assumed).
FIXED: Mapping[str, float] = {"roller_contact": IN_SERIES, "gap": 0.0, "shift": 0.0}
# Compliances of a reducer file, as they are drawn.
PARTS = {
    "crank supports": "crank.support_compliance=0m/N", "carrier": "carrier.compliance=0rad/(N.m)", "housing": "housing.compliance=0rad/(N.m)",
    "main bearings": "carrier.bearing_compliance=0m/N", "first stage": "first_stage.compliance=0m/N",
}  # fmt: skip
SPRINGS_ALONE = ("mesh.friction=0", "mesh.friction_excess=0")


@dataclass(frozen=True)
class Member:
    """What the model says of one size.

    Stiffness [N m/arcmin] and lost motion [arcmin] of the loop, compliances [arcmin/(N m)] of the springs by part, without friction, efficiency [%]
    by (load over rated, output rpm), no-load torque at the input [N m] at 15 rpm.
    """

    size: Size
    cranks: int
    stiffness: float
    lost_motion: float
    parts: dict[str, float]
    efficiency: dict[tuple[float, float], float]
    start_up: float
    no_load: float

    @property
    def over_catalogue(self) -> float:
        return self.stiffness / self.size.stiffness

    @property
    def missing(self) -> float:
        """Compliance [arcmin/(N m)] that would have to be added in series (below 0: taken away) to meet the catalogue's stiffness, friction as it is."""
        return sum(self.parts.values()) * (self.over_catalogue - 1.0)

    @property
    def missing_at_cranks(self) -> float:
        """The same over what the crank supports have: by so much they would have to be softer (below 0: stiffer)."""
        return self.missing / self.parts["crank supports"]


def dial_of(name: str) -> Dial:
    """With its range and source."""
    return next(dial for dial in completed(SIZES[1]).dials if dial.name == name)


def completed(size: Size) -> Completion:
    return complete(Given(size.ratio, PINS, size.rated, size.diameter, lost_motion=size.lost_motion))


def reducer_of_size(size: Size, dials: Mapping[str, float] = DIALS) -> Reducer:
    """The reducer that the rules make of one size; InputFault if a dial is not one of the family's or beyond its range."""
    whole = completed(size)
    known = {dial.name: dial for dial in whole.dials}
    for name, value in dials.items():
        if name not in DIALS:
            raise InputFault(f"dial {name!r}: the family has {', '.join(DIALS)}; give one of these")
        if not known[name].low <= value <= known[name].high:
            raise InputFault(f"dial {name} = {value:g}: beyond its range of {known[name].low:g} to {known[name].high:g} ({known[name].source})")
    return reducer_at(whole, {**DIALS, **dials, **FIXED}, size.name)


def stiffness_of(reducer: Reducer, *texts: str) -> float:
    settings = [parse_setting(text, [reducer.plant, reducer.wear]) for text in texts]
    return hysteresis(reducer, settings, STEPS, ANGLES).stiffness_Nm_per_arcmin


def input_torque(reducer: Reducer, torque: float, output_rpm: float, ratio: float, *more: str) -> float:
    """Mean over a turn of the cranks [N m], with ``more`` settings."""
    texts = (f"output.load_torque={torque!r}N.m", f"input.speed={output_rpm * ratio!r}rpm", *more)
    pair = make_pair(reducer, [parse_setting(text, [reducer.plant, reducer.wear]) for text in texts], positions=POSITIONS)
    pair.wear.set("acceleration", 0.0)
    return float(record_turn(pair, POSITIONS)["drive_torque"].mean())


def member(size: Size, dials: Mapping[str, float] = DIALS) -> Member:
    """All figures of one size."""
    reducer = reducer_of_size(size, dials)
    loop = hysteresis(reducer, [], STEPS, ANGLES)
    springs = stiffness_of(reducer, *SPRINGS_ALONE)
    without = {part: stiffness_of(reducer, *SPRINGS_ALONE, text) for part, text in PARTS.items()}
    parts = {part: max(0.0, 1.0 / springs - 1.0 / one) for part, one in without.items()}
    parts["contacts"] = max(0.0, 1.0 / springs - sum(parts.values()))

    def efficiency(share: float, rpm: float) -> float:
        return 100.0 * share * size.rated / size.ratio / input_torque(reducer, share * size.rated, rpm, size.ratio)

    return Member(
        size, reducer.topology.cranks, loop.stiffness_Nm_per_arcmin, loop.lost_motion_arcmin, parts,
        {(share, rpm): efficiency(share, rpm) for share in SHARES for rpm in SPEEDS}, efficiency(1.0, STARTING),
        input_torque(reducer, 0.0, SPEEDS[1], size.ratio),
    )  # fmt: skip


def family(dials: Mapping[str, float] = DIALS) -> list[Member]:
    """All sizes, smallest first."""
    found = []
    with task("eight sizes", len(SIZES)) as running:
        for size in SIZES:
            found.append(member(size, dials))
            running.advance()
    return found


def fitted_share(dials: Mapping[str, float] = DIALS) -> float:
    """``support_share`` at which the stiffness of all sizes is right in the (geometric) mean."""
    def off(share: float) -> float:
        return sum(math.log(stiffness_of(reducer_of_size(size, {**dials, FITTED: share})) / size.stiffness) for size in SIZES)

    dial = dial_of(FITTED)
    return float(brentq(off, dial.low, dial.high, xtol=1e-2))
