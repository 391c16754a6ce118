"""A spall on one raceway: a pit that every roller drops into as it passes.

    depth(x) = D cos^2(pi x/w) for |x| < w/2, x from the pit's middle

Source: fatigue pitting after the rating life L10; 5 to 100 um, some millimetres.
"""

import math

from fmu_src.effect import Effect, amplitude, choice, shape
from fmu_src.kernel import kernel
from rv_plant.poses import disc_offset

UM = 1e-6
EFFECT = Effect(
    23, "race spall",
    "roller gap + D cos^2(pi x/w) where a roller passes the pit",
    "fatigue pitting after L10",
    "bursts at the roller-passing orders 361 (inner race) or 279 (outer race), like a threshold; not in the mean",
    (
        amplitude("spall_depth", "m", "depth of a pit in the inner race, on the crank", 5 * UM, 0.0, 500 * UM, sign=1, group="inner race"),
        amplitude("spall_depth_outer", "m", "depth of a pit in the outer race, in the disc", 5 * UM, 0.0, 500 * UM, sign=1, group="outer race"),
        shape("spall_width", "rad", "width of the pit", 0.1, 0.005, 2.0, "assumed: a roller's footprint and more", grid=(0.1, 0.25)),
        shape("spall_angle", "rad", "place of the pit, from the eccentric's direction or the hole's outward radial",
              4.7124, -20.0, 20.0, "assumed: in the zone that positive load loads", grid=(1.5708, 4.7124)),
        choice("spall_disc", "disc whose bearing has the pit", 1, 1, 3, part="disc"),
        choice("spall_crank", "crank whose bearing has the pit", 1, 1, 3, part="crank"),
    ),
    signals=("vibration", "hysteresis", "transmission_error"),
    rolled_over="spall_angle",
)


@kernel
def before(r):
    if r.spall_depth == 0.0 and r.spall_depth_outer == 0.0:
        return
    discs, cranks, rollers = r.roller_gap_now.shape
    d, c = r.spall_disc - 1, r.spall_crank - 1
    if d >= discs or c >= cranks:
        return
    turn = 2.0 * math.pi
    lobes = r.lobe_gap_added.shape[1]
    # Direction of roller 1 from the hole's radial, and from the eccentric's direction.
    from_hole = r.cage
    from_eccentric = from_hole + (1.0 + lobes) * r.ideal_output + turn * c / cranks - disc_offset(r, d)
    for k in range(rollers):
        ahead = turn * k / rollers - r.spall_angle
        r.roller_gap_now[d, c, k] += r.spall_depth * share_of_pit(from_eccentric + ahead, r.spall_width)
        r.roller_gap_now[d, c, k] += r.spall_depth_outer * share_of_pit(from_hole + ahead, r.spall_width)


@kernel
def share_of_pit(x, width):
    """Depth of a pit at an angle x [rad] from its middle, of its largest."""
    turn = 2.0 * math.pi
    x = abs(x - turn * math.floor(x / turn + 0.5))
    if x >= 0.5 * width:
        return 0.0
    cosine = math.cos(math.pi * x / width)
    return cosine * cosine
