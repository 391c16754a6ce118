"""Angles that grow without end, kept as sharp after ten million steps as at the start.

Each step's turning is added with what rounding left out of the last sum (Neumaier 1974), so that angles do not drift from speed times
time.  Bodies in motion leave whole turns of the output out of their places: everything repeats with them, and the rounding of a large
angle would move parts against each other (contact forces by 1e-4 after 35,000 turns, measured).
"""

import math

from fmu_src.kernel import kernel
from fmu_src.variables import Sizes, Variable, state
from rv_plant.gear_stage import total_ratio
from rv_plant.mesh import ring_coordinate
from rv_plant.needle_bearing import cage_rate

TURN = 2.0 * math.pi


def variables(sizes: Sizes) -> list[Variable]:
    return [
        state("ideal_output", "rad", "output angle of ideal kinematics"),
        state("ideal_output_rest", "rad", "what rounding left out of ideal_output"),
        state("cage_rest", "rad", "what rounding left out of the angle of the cages"),
        state("turns_left_out", "1", "whole turns of the output that the places of the bodies in motion leave out"),
    ]


@kernel
def add_turning(angle, rest, turning):
    """Sum of an angle with its rest and a turning [rad], and the sum's own rest."""
    more = rest + turning
    total = angle + more
    taken = total - angle
    return total, (angle - (total - taken)) + (more - taken)


@kernel
def speeds(r):
    """Ideal speeds of output and cages [rad/s]."""
    pins, lobes = r.pin_x.shape[0], r.lobe_pitch_error.shape[1]
    output = r.input_speed / total_ratio(r.first_stage_ratio, pins, lobes)
    return output, r.cage_share * cage_rate(-lobes * output, output, r.inner_race_radius, r.outer_race_radius)


@kernel
def turn_input(r, duration):
    """Turn the input by input_speed times duration [s]; returns the output's ideal speed [rad/s]."""
    output_speed, cage_speed = speeds(r)
    r.ideal_output, r.ideal_output_rest = add_turning(r.ideal_output, r.ideal_output_rest, output_speed * duration)
    r.cage, r.cage_rest = add_turning(r.cage, r.cage_rest, cage_speed * duration)
    return output_speed


@kernel
def whole_turns(angle):
    """Turns to the nearest one, of an angle [rad]."""
    return math.floor(angle / TURN + 0.5)


@kernel
def angles_within_turn(r):
    """Ideal output and cages within one turn: everything repeats, and rounding of a large angle would move parts against each other."""
    output = r.ideal_output - TURN * whole_turns(r.ideal_output)
    cage = r.cage - TURN * math.floor(r.cage / TURN)
    return output + r.ideal_output_rest, cage + r.cage_rest


@kernel
def leave_out_turns(r):
    """Take whole turns of the output out of the places of the bodies in motion."""
    discs, cranks = r.roller_force.shape[:2]
    pins, lobes = r.pin_x.shape[0], r.lobe_pitch_error.shape[1]
    carrier, ring = 3 * discs, ring_coordinate(r)
    turns = whole_turns(r.q[carrier])
    if turns == 0:
        return
    for d in range(discs):
        r.q[3 * d + 2] -= TURN * turns
    r.q[carrier] -= TURN * turns
    for c in range(cranks):
        r.q[carrier + 5 + 3 * c] += TURN * (lobes * turns)
    r.q[ring + 1] -= total_ratio(r.first_stage_ratio, pins, lobes) * (TURN * turns)
    r.q[ring + 2] -= TURN * turns
    r.turns_left_out += turns


@kernel
def left_out(r):
    """Turning of the output that the places of the bodies in motion leave out [rad]."""
    return TURN * r.turns_left_out
