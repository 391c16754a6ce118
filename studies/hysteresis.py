"""The standard stiffness test: input locked, output torque up and down both ways.

The curve of turning against torque gives lost motion (the turning between +3 % and
-3 % of the rated torque, on the middle line of the loop) and torsional stiffness (the secant
between half and full torque on the way up), as catalogues of RV reducers define them.  How wide the loop is stands twice: at no
torque, where the way through the clearances is in it, and in the mean from where lost motion is read up to half of the torque, which
loops of few torques tell alike.  With friction
the torque goes round once before anything is read: it is then where every further round finds it.

What is read depends on where the input is locked, for the cranks stand otherwise to the pins that they push: the test is the
mean over ``angles`` positions, or that at one.
"""

import math
from dataclasses import dataclass

import numpy as np

from fmu_src.arrays import Floats
from fmu_src.faults import InputFault
from orchestrator.component import InProcess
from orchestrator.settings import Setting, apply
from reducers.reducer import Reducer
from rv_plant.gear_stage import total_ratio
from rv_plant.needle_bearing import cage_rate
from studies.solve import ARCMIN

# Torques a quarter beyond the small ones, and places over a turn of the cranks: five times as many torques at twice as many places move lost motion by 0.03 %.
STEPS, ANGLES = 16, 16
# Shares of the rated torque that a loop always has, whatever its steps: to twice that at which lost motion is read, for what friction keeps of the way
# through the clearances depends on the steps out of them.  Four times as many move lost motion by 0.04 %, with a crank's eccentric of 12 um by 0.4 %.
SMALL = np.linspace(0.0, 0.06, 13)
# Power of the sine by which torques lie closer near none and near the largest: at 2 both gain alike, above it small torques more.
CLOSENESS = 2.2
# More torques a quarter and more places of a turn tell nothing more, and take days (assumed).
MOST_STEPS, MOST_ANGLES = 10_000, 1000
# Share of the rated torque at which lost motion is read.
LOST_MOTION_SHARE = 0.03
# Up to this share of the largest torque the loop's mean width is taken, at so many torques of either sign.
HALF, WIDTHS = 0.5, 10
# By these a held output's place depends on the way to it.
MEMORY = ("mesh_friction", "mesh_friction_excess", "friction_coefficient", "friction_excess", "support_slip_compliance")


@dataclass(frozen=True)
class Hysteresis:
    """Torque [N m] and turning of the output [arcmin] along the way, and what is read from them."""

    torque: Floats
    turning: Floats
    lost_motion_arcmin: float
    stiffness_Nm_per_arcmin: float
    stiffness_reverse_Nm_per_arcmin: float
    loop_area_Nm_arcmin: float
    # Between both ways at no torque, and their mean at ``width_torques``.
    width_arcmin: float
    mean_width_arcmin: float


def width_torques(largest: float) -> Floats:
    """Torques [N m] of either sign over which the mean width of a loop up to ``largest`` is taken, of bench and model alike.

    Nearer to none the way through the clearances is met or missed by how closely torques lie.
    """
    shares = np.linspace(LOST_MOTION_SHARE, HALF, WIDTHS)
    return largest * np.concatenate([-shares[::-1], shares])


def torque_way(rated: float, steps: int, small: Floats = SMALL) -> Floats:
    """0, +T, 0, -T, 0: ``steps`` per quarter, with 3 % and half of T among them, and up to the largest of the ``small`` shares of T these in their place.

    They lie closer where bearings come out of their clearance and where friction turns round, near no torque and near T: 16
    read lost motion as well as 160 even ones.
    """
    shares = np.sin(0.5 * np.pi * np.arange(steps + 1) / steps) ** CLOSENESS
    quarter = rated * np.union1d(np.concatenate([small, shares[shares > small.max(initial=-1.0)]]), [LOST_MOTION_SHARE, HALF])
    up, down = quarter, quarter[-2::-1]
    return np.concatenate([up, down, -up[1:], -down])


def hysteresis(reducer: Reducer, settings: list[Setting], steps: int = STEPS, angles: int = ANGLES, locked_at: float | None = None) -> Hysteresis:
    """The test at ``angles`` positions of the input spread over a crank turn, averaged; ``steps`` torques a quarter of the loop.

    ``locked_at``: in their place the one angle of the input [rad], from where the model begins on in the sense that turns the output forward.
    """
    if not (4 <= steps <= MOST_STEPS and 1 <= angles <= MOST_ANGLES):
        raise InputFault(f"steps = {steps}, angles = {angles}: at least 4 and 1 are needed, at most {MOST_STEPS} and {MOST_ANGLES}")
    plant = InProcess("plant", reducer.specification("rv_plant"))
    apply(settings, {"plant": plant})
    rated = abs(plant.number("load_torque"))
    if rated == 0.0:
        raise InputFault("load_torque = 0: the test turns the torque up and down to this value; give --torque")
    remembers = any(plant.number(name) != 0.0 for name in MEMORY)
    torque = torque_way(rated, steps)
    places = [(k / angles, 0.0) for k in range(angles)] if locked_at is None else [turned_there(reducer, plant, locked_at)]
    turning = np.mean([one_angle(reducer, settings, torque, share, 2 if remembers else 1, cage) for share, cage in places], axis=0)
    return read_loop(torque, turning, remembers)


def turned_there(reducer: Reducer, plant: InProcess, locked_at: float) -> tuple[float, float]:
    """Turns of the cranks in the housing, and angle of the roller cages [rad] that roll along, at an angle of the input [rad]."""
    if not math.isfinite(locked_at):
        raise InputFault(f"locked_at = {locked_at:g} rad: a finite angle of the input is needed")
    topology = reducer.topology
    output = float(locked_at / abs(total_ratio(plant.number("first_stage_ratio"), topology.pins, topology.lobes)))
    rate = cage_rate(-topology.lobes, 1.0, plant.number("inner_race_radius"), plant.number("outer_race_radius"))
    return output * topology.lobes / (2.0 * math.pi), float(rate * output)


def read_loop(torque: Floats, turning: Floats, remembers: bool) -> Hysteresis:
    """What is read from a turning [arcmin] along ``torque_way``; without memory both ways are the same."""
    rated = float(torque.max())
    quarter = len(torque) // 4
    up, down, back, home = (slice(k * quarter, (k + 1) * quarter + 1) for k in range(4))

    def at(part: slice, share: float) -> float:
        way = torque[part]
        order = np.argsort(way)
        return float(np.interp(share * rated, way[order], turning[part][order]))

    def middle(there: slice, again: slice, share: float) -> float:
        """On the middle line."""
        return 0.5 * (at(there, share) + at(again, share)) if remembers else at(there, share)

    low = LOST_MOTION_SHARE
    widths = [at(down, s) - at(up, s) if s > 0.0 else at(back, s) - at(home, s) for s in width_torques(1.0)]
    return Hysteresis(
        torque, turning, abs(middle(up, down, low) - middle(back, home, -low)),
        0.5 * rated / abs(at(up, 1.0) - at(up, 0.5)),
        0.5 * rated / abs(at(back, -1.0) - at(back, -0.5)),
        float(abs(np.trapezoid(turning, torque))), abs(at(down, 0.0) - at(home, 0.0)),
        abs(float(np.mean(widths))),
    )


def one_angle(reducer: Reducer, settings: list[Setting], torque: Floats, share: float, rounds: int = 1, cage: float = 0.0) -> Floats:
    """Turning of the output along the torques, the last of ``rounds``, at one input angle, ``share`` turns of the cranks in the housing from
    where the model begins and the roller cages at ``cage`` [rad], in the sense of the torque [arcmin]."""
    plant = InProcess("plant", reducer.specification("rv_plant"))
    apply(settings, {"plant": plant})
    plant.set("fidelity", 0)
    plant.set("input_speed", 0.0)
    plant.set("load_torque", torque[0])
    plant.records["ideal_output"] = 2.0 * math.pi * share / reducer.topology.lobes
    plant.records["cage"] = cage
    plant.exit_initialisation()
    turning = np.zeros(len(torque))
    for _ in range(rounds):
        for i, value in enumerate(torque):
            plant.set("load_torque", float(value))
            plant.step(0.0, 1.0)
            turning[i] = -plant.number("transmission_error") * ARCMIN
    return turning
