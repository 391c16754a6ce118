"""The range of a computed number over what is not known.

Each assumed number that matters is put at either end of the range that its reducer file states, one at a time; the range goes
from the least to the largest of what is found.  Numbers that are wrong together can go beyond it.
"""

from collections.abc import Callable, Iterable, Mapping
from dataclasses import replace

from reducers.reducer import Reducer
from reproduce.context import RV, Context, LifeRun
from reproduce.prototypes import loop
from studies.family import input_torque

Span = tuple[float, float]
# What moves a loop, what moves losses, and what moves lost motion over a life, by the kernels' names.
OF_LOOPS = (
    "bearing_clearance", "crank_seat_compliance", "mesh_stiffness", "mesh_friction", "mesh_friction_excess", "roller_stiffness", "roller_friction",
    "carrier_seat_compliance", "carrier_twist_compliance", "ring_seat_compliance", "tooth_compliance", "tooth_backlash",
)  # fmt: skip
OF_LOSSES = ("mesh_friction", "roller_friction", "input_seal_torque", "input_churning_torque")
OF_LIVES = {
    "mesh_wear_coefficient": "wear.mesh_coefficient", "run_in_ratio": "wear.run_in_ratio", "run_in_time": "wear.run_in_time", "roughness": "wear.roughness",
    "pressure_viscosity": "grease.pressure_viscosity", "bearing_clearance": "bearing.clearance",
}  # fmt: skip
# As long as the published durability test [h]; coarse, for a range: lost motion within a percent.
TEST_HOURS, COARSE = 1550.0, 0.1


def span_of(values: Iterable[float]) -> Span:
    found = list(values)
    return min(found), max(found)


def ends(reducer: Reducer, names: Iterable[str]) -> list[Reducer]:
    """The reducer as it is, and with each of the numbers at either end of its range; those without a range are passed over."""
    known = [name for name in names if name in reducer.ranges]
    return [reducer, *(replace(reducer, starts=reducer.starts | {name: end}) for name in known for end in reducer.ranges[name])]


def spans(reducer: Reducer, names: Iterable[str], measure: Callable[[Reducer], Mapping[str, float]]) -> dict[str, Span]:
    """(least, largest) of each figure that ``measure`` finds over the ends."""
    found = [measure(one) for one in ends(reducer, names)]
    return {figure: span_of(one[figure] for one in found) for figure in found[0]}


def loop_spans(context: Context, name: str) -> dict[str, Span]:
    """Ranges of ``stiffness`` [N m/arcmin] and ``lost_motion`` [arcmin] of a reducer."""
    def measure(reducer: Reducer) -> dict[str, float]:
        found = loop(reducer)
        return {"stiffness": found.stiffness_Nm_per_arcmin, "lost_motion": found.lost_motion_arcmin}

    return context.once(("loop spans", name), lambda: spans(context.reducer(name), OF_LOOPS, measure), f"{name}, ranges of stiffness and lost motion")


def efficiency_span(context: Context, name: str, load: float, rpm: float, ratio: float) -> Span:
    """Range of the efficiency [%] at an output torque [N m] and speed [rpm]."""
    def measure(reducer: Reducer) -> dict[str, float]:
        return {"efficiency": 100.0 * load / ratio / input_torque(reducer, load, rpm, ratio)}

    return context.once(("efficiency span", name, load, rpm), lambda: spans(context.reducer(name), OF_LOSSES, measure)["efficiency"])


def tested_lives(context: Context) -> list[LifeRun]:
    """The RV20E-121 through the published test, as it is and with each number that rules its wear at the ends of its range."""
    ranges = context.reducer(RV).ranges
    texts = [(), *((f"{path}={end!r}",) for name, path in OF_LIVES.items() for end in ranges[name])]
    return [context.life(RV, *text, hours=TEST_HOURS, tolerance=COARSE) for text in texts]
