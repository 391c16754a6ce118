"""One hole of a disc, or one seat of the carrier, out of place along its circle and outwards.

A constant offset between lobe and hole of the bearings that it carries.

Source: geometry of jig-ground holes, 3 to 6 um.
"""

from fmu_src.effect import Effect, amplitude, choice
from fmu_src.kernel import kernel

UM = 1e-6
EFFECT = Effect(
    13, "hole position errors",
    "hole (or seat) displaced along its circle by t and outwards by s",
    "geometry of jig-ground holes; 3 to 6 um",
    "hole of one disc: order 40 and roller forces unevenly spread; seat in the carrier: no order 40, mean lag"
    " changes, roller forces unevenly spread",
    (
        amplitude("disc_hole_shift", "m", "one hole of a disc along its circle", 3 * UM, -30 * UM, 30 * UM, group="disc"),
        amplitude("disc_hole_radial", "m", "the same hole outwards", 3 * UM, -30 * UM, 30 * UM, group="disc"),
        choice("disc_hole_disc", "disc whose hole it is", 1, 1, 3),
        choice("disc_hole_crank", "hole for which crank", 1, 1, 3),
        amplitude("carrier_seat_shift", "m", "one crank's seat in the carrier along its circle", 3 * UM, -30 * UM, 30 * UM, group="carrier"),
        amplitude("carrier_seat_radial", "m", "the same seat outwards", 3 * UM, -30 * UM, 30 * UM, group="carrier"),
        choice("carrier_seat_crank", "seat of which crank", 1, 1, 3),
    ),
    signals=("transmission_error", "vibration", "wear_profile", "wear_depth", "input_torque", "lost_motion", "hysteresis"),
)


@kernel
def prepare(r):
    discs, cranks = r.hole_tangential_added.shape
    if r.disc_hole_disc <= discs and r.disc_hole_crank <= cranks:
        r.hole_tangential_added[r.disc_hole_disc - 1, r.disc_hole_crank - 1] += r.disc_hole_shift
        r.hole_radial_added[r.disc_hole_disc - 1, r.disc_hole_crank - 1] += r.disc_hole_radial
    if r.carrier_seat_crank <= cranks:
        r.seat_tangential_added[r.carrier_seat_crank - 1] += r.carrier_seat_shift
        r.seat_radial_added[r.carrier_seat_crank - 1] += r.carrier_seat_radial
