"""The standard stiffness test: input locked, output torque up and down both ways.

The curve of turning against torque gives lost motion (the turning between +3 % and
-3 % of the rated torque) and torsional stiffness (the secant between half and full
torque), as catalogues of RV reducers define them.
"""

import math
from dataclasses import dataclass

import numpy as np

from fmu_src.arrays import Floats
from fmu_src.faults import InputFault
from orchestrator.component import InProcess
from orchestrator.settings import Setting, apply
from reducers.reducer import Reducer
from studies.solve import ARCMIN

# Share of the rated torque at which lost motion is read.
LOST_MOTION_SHARE = 0.03


@dataclass(frozen=True)
class Hysteresis:
    """Torque [N m] and turning of the output [arcmin] along the way, and what is read from them."""

    torque: Floats
    turning: Floats
    lost_motion_arcmin: float
    stiffness_Nm_per_arcmin: float
    stiffness_reverse_Nm_per_arcmin: float
    loop_area_Nm_arcmin: float


def torque_way(rated: float, steps: int) -> Floats:
    """0, +T, 0, -T, 0: ``steps`` per quarter, with +-3 % among them."""
    quarter = np.union1d(np.linspace(0.0, rated, steps + 1), [LOST_MOTION_SHARE * rated])
    up, down = quarter, quarter[-2::-1]
    return np.concatenate([up, down, -up[1:], -down])


def hysteresis(reducer: Reducer, settings: list[Setting], steps: int = 40, angles: int = 8) -> Hysteresis:
    """The test at ``angles`` positions of the input spread over a crank turn, averaged."""
    rated = abs(InProcess("plant", reducer.specification("rv_plant")).number("load_torque"))
    for setting in settings:
        if setting.name == "load_torque":
            rated = abs(setting.value)
    if rated == 0.0:
        raise InputFault("load_torque = 0: the test turns the torque up and down to this value; give --torque")
    torque = torque_way(rated, steps)
    turning = np.mean([one_angle(reducer, settings, torque, k / angles) for k in range(angles)], axis=0)
    quarter = len(torque) // 4 + 1
    forward, backward = slice(0, quarter), slice(2 * quarter - 2, 3 * quarter - 2)

    def at(part: slice, share: float) -> float:
        way = torque[part]
        order = np.argsort(way)
        return float(np.interp(share * rated, way[order], turning[part][order]))

    low = LOST_MOTION_SHARE
    return Hysteresis(
        torque, turning, abs(at(forward, low) - at(backward, -low)),
        0.5 * rated / abs(at(forward, 1.0) - at(forward, 0.5)),
        0.5 * rated / abs(at(backward, -1.0) - at(backward, -0.5)),
        float(abs(np.trapezoid(turning, torque))),
    )


def one_angle(reducer: Reducer, settings: list[Setting], torque: Floats, share: float) -> Floats:
    """Turning of the output along the torques at one input angle, in the sense of the torque [arcmin]."""
    plant = InProcess("plant", reducer.specification("rv_plant"))
    apply(settings, {"plant": plant})
    plant.set("fidelity", 0)
    plant.set("input_speed", 0.0)
    plant.set("load_torque", torque[0])
    plant.records["ideal_output"] = 2.0 * math.pi * share / reducer.topology.lobes
    plant.exit_initialisation()
    turning = np.zeros(len(torque))
    for i, value in enumerate(torque):
        plant.set("load_torque", float(value))
        plant.step(0.0, 1.0)
        turning[i] = -plant.number("transmission_error") * ARCMIN
    return turning
