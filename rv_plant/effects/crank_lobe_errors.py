"""One lobe of one crank with another throw or turned against its twin.

    lobe centre = (e + de) (cos, sin)(theta + offset + dphi)

Source: geometry of ground cranks, +-3 um and +-3 arcmin.
"""

from fmu_src.effect import Effect, amplitude, choice
from fmu_src.kernel import kernel

UM = 1e-6
EFFECT = Effect(
    12, "crank lobe errors",
    "lobe = (e + de) at the angle theta + offset + dphi, one lobe",
    "geometry of ground cranks; 3 um, 3 arcmin",
    "an error of one lobe alone gives order 40 (3 um: 5 arcsec), load split between the cranks and pin force;"
    " errors common to a disc or a crank give no 40 but change the mean",
    (
        amplitude("lobe_throw_error", "m", "throw of one lobe above nominal", 2 * UM, -30 * UM, 30 * UM),
        amplitude("lobe_phase_error", "rad", "turning of one lobe", 5e-4, -1e-2, 1e-2),
        choice("lobe_error_disc", "disc whose lobe it is", 1, 1, 3),
        choice("lobe_error_crank", "crank whose lobe it is", 1, 1, 3),
    ),
    signals=("transmission_error", "vibration", "wear_profile", "wear_depth", "input_torque", "lost_motion", "hysteresis"),
)


@kernel
def prepare(r):
    discs, cranks = r.throw_added.shape
    if r.lobe_error_disc <= discs and r.lobe_error_crank <= cranks:
        r.throw_added[r.lobe_error_disc - 1, r.lobe_error_crank - 1] += r.lobe_throw_error
        r.lobe_turn_added[r.lobe_error_disc - 1, r.lobe_error_crank - 1] += r.lobe_phase_error
