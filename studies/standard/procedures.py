"""The tests' procedures on the virtual bench: one curve a position or a condition."""

import math
from collections.abc import Callable

import numpy as np

from fmu_src.arrays import Floats
from fmu_src.faults import InputFault
from orchestrator.component import InProcess
from orchestrator.settings import Setting, apply
from reducers.reducer import Reducer
from rv_plant.gear_stage import total_ratio
from studies.hysteresis import ANGLES, LOST_MOTION_SHARE, STEPS, one_angle, torque_way
from studies.solve import ARCMIN

SHARES = (0.25, 0.5, 0.75, 1.0)
# Of the rated speed, when the reducer only just turns.
CREEP = 1e-3
PER_CRANK_TURN = 72

Curves = dict[str, dict[str, Floats]]


def ratio_of(reducer: Reducer, settings: list[Setting]) -> float:
    """Turns of the input over turns of the output."""
    first = plant_of(reducer, settings).number("first_stage_ratio")
    return float(total_ratio(first, reducer.topology.pins, reducer.topology.lobes))


def plant_of(reducer: Reducer, settings: list[Setting]) -> InProcess:
    plant = InProcess("plant", reducer.specification("rv_plant"))
    apply(settings, {"plant": plant})
    return plant


def rated_of(reducer: Reducer, settings: list[Setting]) -> tuple[float, float]:
    """(torque [N m], speed of the input [rad/s]) that count as rated: the file's, or what is set."""
    plant = plant_of(reducer, settings)
    torque, speed = abs(plant.number("load_torque")), abs(plant.number("input_speed"))
    if torque == 0.0 or speed == 0.0:
        raise InputFault(
            f"output.load_torque = {torque:g} N.m, input.speed = {speed:g} rad/s: a standard test has a rated torque and speed;"
            " give --torque, --set input.speed=2000rpm"
        )
    return torque, speed


def loops(reducer: Reducer, settings: list[Setting]) -> Curves:
    """Hysteresis curves, input held: to -T, then up to +T and back, at positions evenly over a turn of the cranks."""
    torque, _ = rated_of(reducer, settings)
    way = torque_way(torque, STEPS)
    # 0, +T, 0, -T, 0 and once more: what is looked at begins at -T.
    twice = np.concatenate([way, way[1:]])
    begin = int(np.argmin(way))
    part = slice(begin, begin + len(way))
    curves = {}
    for k in range(ANGLES):
        turning = one_angle(reducer, settings, twice, k / ANGLES) / ARCMIN
        curves[f"position {k + 1}"] = {"output_torque": twice[part], "output_angle": turning[part]}
    return curves


def turned(plant: InProcess, crank_turns: float, ratio_to_cranks: float) -> dict[str, Floats]:
    """Columns of even steps through turns of the cranks."""
    names = {"input_angle": "input_angle", "output_angle": "output_angle", "input_torque": "drive_torque"}
    speed = plant.number("input_speed")
    count = max(1, round(crank_turns * PER_CRANK_TURN))
    step = 2.0 * math.pi * crank_turns / count / abs(speed / ratio_to_cranks)
    plant.set("fidelity", 0)
    plant.enter_initialisation(0.0)
    plant.exit_initialisation()
    rows: dict[str, list[float]] = {name: [] for name in names}
    for n in range(count):
        plant.step(n * step, step)
        for name, own in names.items():
            rows[name].append(plant.number(own))
    return {name: np.array(values) for name, values in rows.items()}


def run(reducer: Reducer, settings: list[Setting], crank_turns: float, torque: float, speed: float) -> dict[str, Floats]:
    plant = plant_of(reducer, settings)
    plant.set("load_torque", torque)
    plant.set("input_speed", speed)
    ratio = ratio_of(reducer, settings)
    # A turn of the output is as many turns of the cranks in the housing as there are lobes.
    columns = turned(plant, crank_turns, abs(ratio) / reducer.topology.lobes)
    count = len(columns["input_torque"])
    columns |= {"input_speed": np.full(count, speed), "output_speed": np.full(count, speed / ratio), "output_torque": np.full(count, torque)}
    return columns


def output_turns(reducer: Reducer, settings: list[Setting]) -> Curves:
    """A turn of the output, unloaded and at the rated torque."""
    torque, speed = rated_of(reducer, settings)
    return {f"{load:g} N.m": run(reducer, settings, reducer.topology.lobes, load, speed) for load in (0.0, torque)}


def both_senses(reducer: Reducer, settings: list[Setting]) -> Curves:
    """A turn of the output there and back under the load's 3 %, which always opposes the motion."""
    torque, speed = rated_of(reducer, settings)
    ratio = ratio_of(reducer, settings)
    there, back = (run(reducer, settings, reducer.topology.lobes, s * LOST_MOTION_SHARE * torque, s * speed) for s in (1.0, -1.0))
    # The same places of the input, a turn of the output apart at the most.
    order = np.argsort(back["input_angle"])
    shifted = there["input_angle"] - 2.0 * math.pi * abs(ratio)
    error = np.interp(shifted, back["input_angle"][order], (back["output_angle"] - back["input_angle"] / ratio)[order])
    inside = (shifted >= back["input_angle"].min()) & (shifted <= back["input_angle"].max())
    columns = {"input_angle": there["input_angle"], "output_angle": there["output_angle"], "back_angle": there["input_angle"] / ratio + error}
    return {"a turn of the output": {name: values[inside] for name, values in columns.items()}}


def loads(reducer: Reducer, settings: list[Setting]) -> Curves:
    torque, speed = rated_of(reducer, settings)
    return {f"{100 * share:g} % of the torque": run(reducer, settings, 1.0, share * torque, speed) for share in SHARES}


def speeds(reducer: Reducer, settings: list[Setting]) -> Curves:
    _, speed = rated_of(reducer, settings)
    return {f"{100 * share:g} % of the speed": run(reducer, settings, 1.0, 0.0, share * speed) for share in SHARES}


def creep(reducer: Reducer, settings: list[Setting]) -> Curves:
    _, speed = rated_of(reducer, settings)
    return {"just turning": run(reducer, settings, 1.0, 0.0, CREEP * speed)}


PROCEDURES: dict[str, Callable[[Reducer, list[Setting]], Curves]] = {
    "lost-motion": loops, "dynamic-lost-motion": both_senses, "stiffness": loops, "transmission-error": output_turns, "efficiency": loads,
    "no-load-torque": speeds, "starting-torque": creep,
}  # fmt: skip
