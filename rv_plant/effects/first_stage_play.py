"""Play of the first stage that depends on the angle: once per turn of planet 1.

    b_1 = b + B_c cos(psi/i1) + B_s sin(psi/i1),  psi the sun's turning against the carrier

b is the play of all planets (``backlash``), at least as large as what comes and goes here.  A planet or its seat
off centre brings the teeth nearer and takes them away: by e it changes the play by 2 e sin(alpha), and half of that
shows on either flank, with opposite signs.  The flank that carries is that of the torque's sign; without torque the
teeth float.  Along the driving flank alone it is what ``planet_runout`` is; under reverse torque it has the other sign.

Source: geometry of spur gears (center distance and backlash, 2 sin(alpha) per change); 5 to 30 um.
"""

import math

from fmu_src.effect import Effect, amplitude
from fmu_src.kernel import kernel
from rv_plant.gear_stage import planet_radius, total_ratio

UM = 1e-6


def _part(name: str, text: str):
    return amplitude(name, "m", f"play of planet 1 along the normal, {text} of the planet's turn", 10 * UM, -500 * UM, 500 * UM, source="ideal part")


EFFECT = Effect(
    0, "first-stage play over the angle",
    "b_1 = b + B_c cos(psi/i1) + B_s sin(psi/i1), half of it on either flank",
    "geometry of spur gears; 5 to 30 um",
    "order 40 at the output at any load, its sign with that of the torque; a planet off centre has the same sign both ways",
    (_part("first_stage_play_cos", "cosine"), _part("first_stage_play_sin", "sine")),
    signals=("transmission_error", "vibration", "hysteresis", "input_torque"),
)  # fmt: skip


@kernel
def before(r):
    if r.first_stage_ratio == 0.0 or (r.first_stage_play_cos == 0.0 and r.first_stage_play_sin == 0.0):
        return
    sun = (total_ratio(r.first_stage_ratio, r.pin_x.shape[0], r.lobe_gap_added.shape[1]) - 1.0) * r.ideal_output
    planet = sun / r.first_stage_ratio
    c, s = math.cos(planet), math.sin(planet)
    play = r.first_stage_play_cos * c + r.first_stage_play_sin * s
    rate = (r.first_stage_play_sin * c - r.first_stage_play_cos * s) / r.first_stage_ratio
    side = 1.0 if r.load_torque >= 0.0 else -1.0
    lever = planet_radius(r.crank_circle_radius, r.first_stage_ratio) * r.pressure_cosine
    r.tooth_play[0] += play
    r.tooth_play_rate[0] += rate
    r.crank_turn_added[0] += side * 0.5 * play / lever
    r.crank_turn_rate[0] += side * 0.5 * rate / lever
