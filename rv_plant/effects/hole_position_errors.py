"""Holes of one disc, or one seat of the carrier, out of place along their circle and outwards.

A constant offset between lobe and hole of the bearings that it carries.
With two cranks an error in the other disc shows as that of the other hole in this disc.

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
        *(
            parameter
            for k in (1, 2, 3)
            for parameter in (
                amplitude(f"disc_hole_shift_{k}", "m", f"hole {k} of a disc along its circle", 3 * UM, -30 * UM, 30 * UM,
                          group=f"hole {k}", needs=("cranks", k)),
                amplitude(f"disc_hole_radial_{k}", "m", f"hole {k} of a disc outwards", 3 * UM, -30 * UM, 30 * UM,
                          group=f"hole {k}", needs=("cranks", k)),
            )
        ),
        choice("disc_hole_disc", "disc whose holes are out of place", 1, 1, 3, part="disc", group="hole"),
        amplitude("carrier_seat_shift", "m", "one crank's seat in the carrier along its circle", 3 * UM, -30 * UM, 30 * UM, group="carrier"),
        amplitude("carrier_seat_radial", "m", "one crank's seat in the carrier outwards", 3 * UM, -30 * UM, 30 * UM, group="carrier"),
        choice("carrier_seat_crank", "crank whose seat is out of place", 1, 1, 3, part="crank", group="carrier"),
    ),
    signals=("transmission_error", "vibration", "wear_profile", "wear_depth", "input_torque", "lost_motion", "hysteresis"),
)


@kernel
def prepare(r):
    discs, cranks = r.hole_tangential_added.shape
    along = (r.disc_hole_shift_1, r.disc_hole_shift_2, r.disc_hole_shift_3)
    outwards = (r.disc_hole_radial_1, r.disc_hole_radial_2, r.disc_hole_radial_3)
    if r.disc_hole_disc <= discs:
        for c in range(min(cranks, 3)):
            r.hole_tangential_added[r.disc_hole_disc - 1, c] += along[c]
            r.hole_radial_added[r.disc_hole_disc - 1, c] += outwards[c]
    if r.carrier_seat_crank <= cranks:
        r.seat_tangential_added[r.carrier_seat_crank - 1] += r.carrier_seat_shift
        r.seat_radial_added[r.carrier_seat_crank - 1] += r.carrier_seat_radial
