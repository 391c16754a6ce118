"""First stage: the sun drives one planet on each crank.

With the ratio i1 = z2/z1 and the planets fixed to the cranks, rolling without play gives

    theta_crank = theta_carrier (1 + 1/i1) - theta_sun / i1

and, against the fixed pin ring, theta_sun = (1 + i1 z_p) theta_carrier: the whole
reducer's ratio (121 for i1 = 3, z_p = 40).  The tooth force f_t on a planet, at the
planet's pitch radius r2 = a0 i1/(1 + i1), holds the crank against its rollers' moment
M: f_t = M/r2.  It also pushes the planet's centre, forwards and outwards: that is why
the pins carry T (1 - 1/i) and not T (40/39), as they would if pure couples turned the cranks.

A reducer without this stage has i1 = 0: its cranks are turned directly.
"""

import math

from fmu_src.kernel import kernel
from fmu_src.variables import Sizes, Variable, local, state
from rv_plant.dimension import FILE


def variables(sizes: Sizes) -> list[Variable]:
    crank = sizes.over("crank")
    return [
        Variable("first_stage.ratio", "parameter", "1", "teeth of planet over teeth of sun (0: no first stage)",
                 3.0, minimum=0.0, maximum=100.0, source=FILE),
        Variable("pressure_angle", "parameter", "rad", "pressure angle of the first stage", math.radians(20.0),
                 minimum=0.0, maximum=0.7, source="assumed: standard gearing", path="first_stage.pressure_angle"),
        Variable("sun_teeth", "parameter", "1", "teeth of the sun: order of the first stage's mesh", 12.0, minimum=4.0,
                 maximum=1000.0, source="assumed: usual for a ratio of 3", path="first_stage.sun_teeth"),
        local("tooth_force", "N", "tangential force of the sun on a planet", **crank, nominal=100.0, path="first_stage.tooth_force"),
        state("tooth_gap", "m", "what sun and planet lack along the line of action, on the flank that drives: above 0 the planet lags", **crank),
        state("tooth_gap_rate", "m", "growth of the gap with the sun's turning against the carrier, per radian", **crank),
        state("tooth_play", "m", "play of sun and planet beyond that of all, along the normal: above 0 looser", **crank),
        state("tooth_play_rate", "m", "growth of the play with the sun's turning against the carrier, per radian", **crank),
        state("crank_turn_added", "rad", "a crank's turning by what its teeth lack, counter-clockwise: at rest", **crank),
        state("crank_turn_rate", "1", "growth of that with the sun's turning against the carrier", **crank),
        state("pressure_cosine", "1", "cosine of the first stage's pressure angle"),
    ]


@kernel
def clear_teeth(r):
    """Teeth of sun and planets lack nothing."""
    for c in range(r.tooth_gap.shape[0]):
        r.tooth_gap[c] = r.tooth_gap_rate[c] = r.crank_turn_added[c] = r.crank_turn_rate[c] = 0.0
        r.tooth_play[c] = r.tooth_play_rate[c] = 0.0


@kernel
def total_ratio(first_stage_ratio, pins, lobes):
    """Input turns per output turn: sun, or crank if there is no first stage."""
    if first_stage_ratio == 0.0:
        return -float(lobes)
    return 1.0 + first_stage_ratio * pins


@kernel
def crank_turn_per_carrier_turn(first_stage_ratio):
    """d theta_crank / d theta_carrier with the input held."""
    if first_stage_ratio == 0.0:
        return 0.0
    return 1.0 + 1.0 / first_stage_ratio


@kernel
def planet_radius(crank_circle_radius, first_stage_ratio):
    """Pitch radius of the planet r2 [m]."""
    return crank_circle_radius * first_stage_ratio / (1.0 + first_stage_ratio)


@kernel
def crank_turn_per_shift(direction, crank_circle_radius, first_stage_ratio, pressure_angle, side):
    """d theta_crank / d (x, y) of the crank's centre [1/m], tooth flanks staying in touch.

    ``direction`` is the angle of the crank's centre seen from the sun, ``side`` +1 or
    -1 for the flank in contact.  The same vector times r2 is the tooth force per f_t.
    """
    if first_stage_ratio == 0.0:
        return 0.0, 0.0
    radius = planet_radius(crank_circle_radius, first_stage_ratio)
    c, s = math.cos(direction), math.sin(direction)
    outward = side * math.tan(pressure_angle)
    return (-s + outward * c) / radius, (c + outward * s) / radius


@kernel
def fall_back(r, lag, rate):
    """The output falls back by ``lag`` [rad], growing by ``rate`` per radian of its own turning: all cranks turn, as if their teeth lacked it."""
    lobes, pins = r.lobe_gap_added.shape[1], r.pin_x.shape[0]
    turn = lobes + crank_turn_per_carrier_turn(r.first_stage_ratio)
    against = total_ratio(r.first_stage_ratio, pins, lobes) - 1.0
    lever = planet_radius(r.crank_circle_radius, r.first_stage_ratio) * r.pressure_cosine
    for c in range(r.tooth_gap.shape[0]):
        r.crank_turn_added[c] += turn * lag
        r.crank_turn_rate[c] += turn * rate / against
        r.tooth_gap[c] += turn * lag * lever
        r.tooth_gap_rate[c] += turn * rate / against * lever
