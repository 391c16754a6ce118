"""Eccentrics of the cranks, at one disc, with another throw or turned against their twins.

    centre of the eccentric = (e + de) (cos, sin)(theta + offset + dphi)

With two cranks an error at the other disc shows as that of the other crank's eccentric at this disc.

Source: geometry of ground cranks, +-3 um and +-3 arcmin.
"""

from fmu_src.effect import Effect, amplitude, choice
from fmu_src.kernel import kernel

UM = 1e-6
EFFECT = Effect(
    12, "crank eccentric errors",
    "eccentric = (e + de) at the angle theta + offset + dphi, one of a crank",
    "geometry of ground cranks; 3 um, 3 arcmin",
    "an error of one eccentric alone gives order 40 (3 um: 5 arcsec), load split between the cranks and pin force;"
    " errors common to a disc or a crank give no 40 but change the mean",
    (
        *(
            parameter
            for k in (1, 2, 3)
            for parameter in (
                amplitude(f"lobe_throw_error_{k}", "m", f"throw of crank {k}'s eccentric above nominal", 2 * UM, -30 * UM, 30 * UM,
                          group=f"crank {k}", needs=("cranks", k)),
                amplitude(f"lobe_phase_error_{k}", "rad", f"turning of crank {k}'s eccentric", 5e-4, -1e-2, 1e-2,
                          group=f"crank {k}", needs=("cranks", k)),
            )
        ),
        choice("lobe_error_disc", "disc at which the cranks' eccentrics have errors", 1, 1, 3, part="disc", group="crank"),
    ),
    signals=("transmission_error", "vibration", "wear_profile", "wear_depth", "input_torque", "lost_motion", "hysteresis"),
)


@kernel
def prepare(r):
    discs, cranks = r.throw_added.shape
    if r.lobe_error_disc > discs:
        return
    throw = (r.lobe_throw_error_1, r.lobe_throw_error_2, r.lobe_throw_error_3)
    turned = (r.lobe_phase_error_1, r.lobe_phase_error_2, r.lobe_phase_error_3)
    for c in range(min(cranks, 3)):
        r.throw_added[r.lobe_error_disc - 1, c] += throw[c]
        r.lobe_turn_added[r.lobe_error_disc - 1, c] += turned[c]
