"""Sun and planets: profile error at mesh order, run-out of sun and of one planet, play.

Along the line of action the flanks lack

    g_c = E cos(z1 psi) + R_s cos(psi - 2 pi c/n) + R_p cos(psi/i1) for planet 1

with psi the sun's turning against the carrier; a crank falls back by g/(r2 cos alpha), the output by that
over z_c + 1 + 1/i1 (40.33); play b adds b/2 on either flank.  With planets evenly spread, what a sun off centre
takes from one planet it gives to the others: it moves load between the cranks, and the output hardly.  By
virtual work the sun feels the tooth force times -dg/dpsi beside its constant lever.

Source: geometry; 10 to 20 um pitch error, 30 to 80 um play in spur first stages.
"""

import math

from fmu_src.effect import Effect, amplitude, shape
from fmu_src.kernel import kernel
from rv_plant.gear_stage import planet_radius, total_ratio
from rv_plant.poses import crank_position

UM = 1e-6
EFFECT = Effect(
    15, "first-stage gear error and backlash",
    "g_c = E cos(z1 psi) + R_s cos(psi - 2 pi c/n) + R_p cos(psi/i1); play b/2 on either flank",
    "geometry of the spur stage; 10 to 20 um, play 30 to 80 um",
    "orders 1440 (mesh, 12 teeth) and 40 (planet) at the output, reduced by the second stage, whatever the load, and"
    " of the input's torque, in proportion to load;"
    " sun: order 120 in the cranks' shares of the load, which cancels at the output; play: lost motion at reversal",
    (
        amplitude("tooth_error", "m", "profile error of the first stage, amplitude at mesh order", 5 * UM, -100 * UM, 100 * UM,
                  source="ideal part", group="mesh"),
        amplitude("sun_runout", "m", "run-out of the sun, along the line of action", 10 * UM, -200 * UM, 200 * UM, group="sun"),
        amplitude("planet_runout", "m", "run-out of planet 1, along the line of action", 10 * UM, -200 * UM, 200 * UM, group="planet"),
        amplitude("backlash", "m", "play between the flanks beyond the file's, along the normal", 20 * UM, 0.0, 1000 * UM, sign=1,
                  source="none beyond the reducer file", group="backlash"),
        # Beside 0 a quarter of a mesh of 12 teeth, of the sun and of a planet with i1 = 3.
        shape("first_stage_phase", "rad", "the sun's phase at angle 0", 0.0, -20.0, 20.0, "assumed",
              grid=(0.0, 0.1309, 1.5708, 4.7124), group="mesh sun planet"),
    ),
    signals=("transmission_error", "vibration", "lost_motion", "hysteresis", "input_torque"),
)


@kernel
def before(r):
    cranks = r.tooth_gap.shape[0]
    if r.first_stage_ratio == 0.0:
        return
    pins, lobes = r.pin_x.shape[0], r.lobe_gap_added.shape[1]
    sun = (total_ratio(r.first_stage_ratio, pins, lobes) - 1.0) * r.ideal_output + r.first_stage_phase
    lever = planet_radius(r.crank_circle_radius, r.first_stage_ratio) * r.pressure_cosine
    side = 1.0 if r.load_torque >= 0.0 else -1.0
    flank = side * (0.5 * (r.tooth_backlash + r.backlash) + r.tooth_error * math.cos(r.sun_teeth * sun))
    flank_rate = -side * r.tooth_error * r.sun_teeth * math.sin(r.sun_teeth * sun)
    for c in range(cranks):
        at_crank = sun - crank_position(r, c)
        gap, rate = r.sun_runout * math.cos(at_crank), -r.sun_runout * math.sin(at_crank)
        if c == 0:
            planet = sun / r.first_stage_ratio
            gap += r.planet_runout * math.cos(planet)
            rate -= r.planet_runout * math.sin(planet) / r.first_stage_ratio
        r.tooth_gap[c] += gap
        r.tooth_gap_rate[c] += rate
        r.crank_turn_added[c] += (gap + flank) / lever
        r.crank_turn_rate[c] += (rate + flank_rate) / lever
