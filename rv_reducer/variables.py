"""The variables of plant and wear in one table, with what the two give together.

Each unit's kernels see the record through a view with their own names.  What the units
exchange is one cell in both views, so nothing is copied.  Parameters of the same name
are one parameter.
"""

import math
from collections.abc import Sequence
from dataclasses import replace

from fmu_src.table import Table
from fmu_src.variables import SEEN, SETTABLE, Variable, local
from rv_plant.terminals import MECHANICAL as TERMINALS
from rv_plant.topology import Topology
from rv_plant.variables import plant_table
from rv_reducer import estimate
from rv_reducer.exchange import PLANT_TO_WEAR, WEAR_TO_PLANT
from wear_fmu.variables import Resolution, wear_table

# Between plant and wear alone, or of the cages: shown, nothing to connect.
NEW = ("worst_flank_depth", "worst_pin_depth", "worst_race_depth")
INNER = ("crank_path", "cage_angle", "cage_speed")
LIMITS = ("none", "flank depth", "race depth", "lost motion")
ARCMIN = math.pi / 10800.0


def reducer_table(topology: Topology, resolution: Resolution = Resolution()) -> Table:
    """The unit's variables; ``topology`` has discs, cranks, pins, lobes, rollers."""
    plant, wear = plant_table(topology), wear_table(topology, resolution)
    plant_view = {v.name: name_beside(wear, v, "plant") for v in plant.variables}
    wear_view = {v.name: name_beside(plant, v, "wear") for v in wear.variables}
    given, returned = (
        {target.by_path[name].name: source.by_path[name].name for name in names}
        for source, target, names in ((plant, wear, PLANT_TO_WEAR), (wear, plant, WEAR_TO_PLANT))
    )
    wear_view |= {target: plant_view[source] for target, source in given.items()}
    plant_view |= {target: wear_view[source] for target, source in returned.items()}

    moving = [in_one_unit(v, plant_view[v.name], v.name in returned) for v in plant.variables]
    # Peaks of depth feel single forces: at the plant's own tolerance those differ by up to 0.3 % from the finest.
    moving = [replace(v, start=1e-3, source="measured: depths within 0.2 %") if v.name == "dynamic_tolerance" else v for v in moving]
    taken = {v.name for v in moving}
    worn = [in_one_unit(v, wear_view[v.name], False) for v in wear.variables if wear_view[v.name] not in taken]
    judged = judgement(plant.by_name["z"])
    # Cells before the first state of the wear: interface and the plant's states.
    before = [v for v in moving if v.role != "scratch"] + [v for v in worn + judged if v.role in SEEN]
    after = [v for v in worn + judged if v.role not in (*SEEN, "scratch")]
    kept, worn_kept = (
        Variable(name, "scratch", "1", "", 0, (sum(v.size for v in group),), ("",), integer=True)
        for name, group in (("kept", before), ("worn_kept", after))
    )
    return Table("RvReducer", "RV reducer that wears: motion, contacts and wear in one unit",
                 [*moving, *worn, *judged, kept, worn_kept], known_at_start(plant, moving, worn),
                 {"plant": plant_view, "wear": wear_view}, TERMINALS)


def known_at_start(plant: Table, moving: list[Variable], worn: list[Variable]) -> dict[str, Sequence[str]]:
    """Wear starts from nothing, and what moves knows nothing of wear."""
    given = [v.name for v in moving if v.role in SETTABLE]
    of_motion = {v.name: plant.known_at_start.get(v.name, given) for v in moving if v.role == "output"}
    return of_motion | dict.fromkeys((*(v.name for v in worn if v.role == "output"), *NEW), ())


def name_beside(other: Table, v: Variable, unit: str) -> str:
    """The variable's name in the common table: a hidden one makes way for what the other unit calls the same."""
    namesake = other.by_name.get(v.name)
    if unit == "wear" and v.role == "input" and namesake is not None and namesake.role == "output":
        # What is not exchanged is no input of the whole either.
        return f"wear_{v.name}"
    if namesake is None or v.role in SEEN or (unit == "wear" and namesake.role not in SEEN):
        return v.name
    return f"{unit}_{v.name}"


def in_one_unit(v: Variable, name: str, received: bool) -> Variable:
    """The variable in the common table: what goes from unit to unit, and each single contact, is hidden; other arrays are shown."""
    exchanged = received or (v.role == "input" and name == f"wear_{v.name}")
    of_contacts = v.role in ("output", "local") and {"pin", "roller"} & set(v.axes)
    role = v.role
    if exchanged or of_contacts:
        role = "state"
    elif role == "output" and (v.shape or v.name in INNER):
        role = "local"
    return replace(v, name=name, role=role)


def judgement(z: Variable) -> list[Variable]:
    """Worst depths, lost motion and remaining life; ``z`` is the plant's vector of coordinates."""

    def limit(name: str, unit: str, text: str, start: float, nominal: float, source: str, display: str = "") -> Variable:
        return Variable(name, "parameter", unit, f"{text} at which the reducer's life ends (0: no limit)", start,
                        minimum=0.0, nominal=nominal, tunable=True, source=source, path=f"life.{name}", display=display)

    def depth(name: str, text: str) -> Variable:
        return Variable(name, "output", "m", f"deepest wear of {text}", nominal=1e-6, path=f"life.{name}")

    def state(name: str, unit: str, text: str, like: Variable | None = None) -> Variable:
        shape, axes = (like.shape, like.axes) if like else ((), ())
        return Variable(name, "state", unit, text, 0.0, shape, axes)

    return [
        state("sweep_left", "rad", "turning of the cranks until the surfaces next wear"),
        state("sweep_path", "rad", "turning of the cranks since they last did"),
        state("sweep_time", "s", "time since they last did"),
        state("sweep_sense", "1", "sense of turning since they last did"),
        state("sweep_acceleration", "1", "acceleration that holds for it"),
        state("swept_until", "s", "operating time until they last did"),
        limit("flank_depth_limit", "m", "wear of a flank", 20e-6, 1e-6, "assumed: two to three times that of 10,000 h"),
        limit("race_depth_limit", "m", "wear of a raceway", 10e-6, 1e-6, "assumed: two to three times that of 10,000 h"),
        limit("lost_motion_limit", "rad", "lost motion", 2.0 * ARCMIN, 1e-4, "assumed: twice the 1 arcmin of a new one",
              display="arcmin"),
        Variable("rated_torque", "parameter", "N.m", "lost motion is the turning of the output between 3 % of this torque in"
                 " one sense and in the other, input held", 100.0, minimum=1e-3, nominal=100.0,
                 source="the reducer file's output.load_torque unless it says", path="life.rated_torque"),
        Variable("judgement_interval", "parameter", "rad", "turning of the cranks between two looks at lost motion and"
                 " remaining life", 2.0 * math.pi, minimum=0.0, tunable=True,
                 source="one turn: each lobe has met a pin at every phase", path="life.judgement_interval"),
        depth("worst_flank_depth", "all flanks"),
        depth("worst_pin_depth", "all pins"),
        depth("worst_race_depth", "all raceways"),
        Variable("lost_motion", "output", "rad", "turning of the output between +3 % and -3 % of life.rated_torque, input at"
                 " angle 0, without friction: the middle line of a loop with the input held, which has it, reads somewhat more",
                 nominal=1e-4, path="life.lost_motion", display="arcmin"),
        Variable("remaining_life", "output", "s", "operating time until the first limit if wear goes on as in the last"
                 " life.judgement_interval", nominal=1e6, path="life.remaining"),
        Variable("limited_by", "output", "1", "the limit that life.remaining refers to", choices=LIMITS, path="life.limited_by"),
        local("overloads", "1", "looks at lost motion at which output.load_torque was beyond 5 times life.rated_torque, where figures are of no real reducer",
              integer=True, path="life.overloads"),
        Variable("pausing", "state", "1", "where a step may end before its time: nowhere, where the judgement changes, wherever surfaces wore",
                 integer=True),
        state("paused_after", "s", "how much of the last step was done; 0: all of it"),
        *estimate.variables(),
        state("own_rate", "rad/s", "growth of lost motion by the unit's own wear"),
        state("turned", "rad", "turning of the cranks since the last judgement"),
        state("judged_time", "s", "operating time at the last judgement"),
        state("judged_flank_volume", "m^3", "flank.volume at the last judgement"),
        state("judged_inner_volume", "m^3", "inner_race.volume at the last judgement"),
        state("judged_outer_volume", "m^3", "outer_race.volume at the last judgement"),
        state("new_lost_motion", "rad", "lost motion when new"),
        state("z_forward", "1", "the plant's z under +3 % of rated_torque, to start from", z),
        state("z_backward", "1", "the plant's z under -3 % of rated_torque, to start from", z),
    ]
