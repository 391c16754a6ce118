"""Pins out of place: ring off centre, oval, tapered in threes, one proud pin, random places.

    radial shift of pin j   a = A1 cos(eta - d1) + A2 cos 2(eta - d2) + A3 cos 3(eta - d3) + sum_m (c_m cos m eta + s_m sin m eta) + s w_j
    pin radius              r + p for the proud pin; at a number between two both share p, by how near it is to each

with eta = 2 pi j/z_p.  A ring off centre shifts pins by (A1 cos, -A1 sin) along (radial,
tangential).  A number of the proud pin that is none lets a fit find the pin.  The w_j are fixed numbers of mean 0 and variance 1 that look random.
Gap grows by the shift along the contact's normal, exactly, because pins are moved.

Source: physics of the mesh; sizes 2 to 5 um as usual for ground rings.
"""

import math

from fmu_src.effect import Effect, amplitude, shape
from fmu_src.kernel import kernel

UM = 1e-6
# A worn or badly bored ring has them all; the first one moves the ring.
HARMONICS = (2, 3, 4, 5, 6)
EFFECT = Effect(
    7, "pin position errors",
    "a_j = A1 cos(eta_j - d1) + A2 cos 2(eta_j - d2) + A3 cos 3(eta_j - d3) + s w_j; proud pin: r + p",
    "geometry; sizes: ground pin rings, 2 to 5 um",
    "fixed to the ring: orders 78, 156, 234 of the output (39 and its odd multiples cancel between two discs);"
    " beats with 80 to order 2; independent of time, speed and temperature",
    (
        amplitude("pin_ring_runout", "m", "pin ring off centre", 3 * UM, -50 * UM, 50 * UM, sign=1, group="runout"),
        shape("pin_ring_runout_angle", "rad", "direction in which the ring is off centre", 0.0, -20.0, 20.0, "assumed",
              grid=(0.0, 1.5708, 3.1416, 4.7124), group="runout"),
        amplitude("pin_ring_ovality", "m", "pin ring oval, amplitude of the radius: half of peak to valley",
                  3 * UM, -50 * UM, 50 * UM, sign=1, group="ovality"),
        shape("pin_ring_ovality_angle", "rad", "direction of the long axis of the oval ring", 0.0, -20.0, 20.0, "assumed",
              grid=(0.0, 0.7854, 1.5708, 2.3562), group="ovality"),
        amplitude("pin_ring_trilobe", "m", "pin ring with three lobes, amplitude of the radius: half of peak to valley",
                  3 * UM, -50 * UM, 50 * UM, sign=1, group="trilobe"),
        shape("pin_ring_trilobe_angle", "rad", "direction of one of the three lobes", 0.0, -20.0, 20.0, "assumed",
              grid=(0.0, 0.5236, 1.0472, 1.5708), group="trilobe"),
        *(
            amplitude(f"pin_ring_{wave}_{m}", "m", f"radial places of the pins, {name} of harmonic {m}", 2 * UM, -50 * UM, 50 * UM,
                      group="harmonics")
            for m in HARMONICS for wave, name in (("cos", "cosine"), ("sin", "sine"))
        ),
        amplitude("proud_pin", "m", "radius of one pin above nominal", 3 * UM, -50 * UM, 50 * UM, sign=1, group="proud"),
        shape("proud_pin_number", "1", "which pin is proud, counted the way the output turns; between two: both, by how near it is to each", 1.0, 0.0, 400.0,
              "assumed: the first", grid=range(1, 401), group="proud"),
        amplitude("pin_scatter", "m", "scatter of the pins' radial places, standard deviation", 2 * UM, -20 * UM, 20 * UM, group="scatter"),
    ),
    signals=("transmission_error", "vibration", "wear_profile", "wear_depth", "input_torque", "lost_motion",
             "hysteresis", "torsional_stiffness", "no_load_torque", "efficiency"),
)


@kernel
def scatter(j):
    """Fixed numbers of mean 0 and variance about 1 that look random."""
    x = math.sin(12.9898 * (j + 1.0)) * 43758.5453
    return 3.4641 * (x - math.floor(x) - 0.5)


@kernel
def prepare(r):
    pins = r.pin_x.shape[0]
    cosines = (r.pin_ring_cos_2, r.pin_ring_cos_3, r.pin_ring_cos_4, r.pin_ring_cos_5, r.pin_ring_cos_6)
    sines = (r.pin_ring_sin_2, r.pin_ring_sin_3, r.pin_ring_sin_4, r.pin_ring_sin_5, r.pin_ring_sin_6)
    for j in range(pins):
        eta = r.pin_angle[j]
        radial = r.pin_ring_ovality * math.cos(2.0 * (eta - r.pin_ring_ovality_angle))
        radial += r.pin_ring_trilobe * math.cos(3.0 * (eta - r.pin_ring_trilobe_angle))
        radial += r.pin_scatter * scatter(j)
        for k in range(len(cosines)):
            radial += cosines[k] * math.cos(HARMONICS[k] * eta) + sines[k] * math.sin(HARMONICS[k] * eta)
        c, s = math.cos(eta), math.sin(eta)
        r.pin_x[j] += radial * c + r.pin_ring_runout * math.cos(r.pin_ring_runout_angle)
        r.pin_y[j] += radial * s + r.pin_ring_runout * math.sin(r.pin_ring_runout_angle)
    if r.proud_pin_number < pins + 1.0:
        before = int(r.proud_pin_number) - 1
        share = r.proud_pin_number - 1.0 - before
        r.pin_radius_added[(before + pins) % pins] += (1.0 - share) * r.proud_pin
        r.pin_radius_added[(before + 1) % pins] += share * r.proud_pin
