"""Discs that are not alike: profile, its place to the holes, clearance of the bearings, or what they see of the ring.

    disc d of D:  w_d = d/(D - 1) - 1/2  (first disc -1/2, last disc 1/2)
    teeth    material missing  + g w_d,  displaced along the pitch by p w_d
    bearings radial clearance  + q w_d
    ring     off centre by     (x, y) w_d as disc d sees it

The last is a ring whose axis stands askew to the carrier's, or one that is bored off centre under one disc.  What is
fixed to the ring comes once per turn of the cranks, order z_c: on equal discs it cancels between the two, here it does not.  Unequal teeth and
clearances alone make no order z_c in the transmission error, because a ring without errors looks the same from all
sides; with a ring that is off centre (``pin_ring_runout``) they let a part of it through.  By themselves they shift load from
disc to disc, and what one disc carries more pushes the housing about at order z_c, in proportion to the torque.

Source: geometry; discs ground in different clampings, 1 to 5 um.
"""

from fmu_src.effect import Effect, amplitude
from fmu_src.kernel import kernel

UM = 1e-6


def _difference(name: str, text: str, group: str):
    return amplitude(name, "m", f"{text}, last disc less first", 2 * UM, -50 * UM, 50 * UM, source="ideal part", group=group)


EFFECT = Effect(
    0, "unequal discs",
    "disc d: w_d = d/(D - 1) - 1/2; teeth lack g w_d, stand off by p w_d, clearance + q w_d; ring off centre by (x, y) w_d",
    "geometry; discs ground in different clampings, 1 to 5 um",
    "misaligned with the ring: order 39 (z_c), which equal discs never show, at any load; unequal teeth and clearances: load goes"
    " from one disc to the other, the force on the housing has order 39, orders of the ring that cancelled come through in part",
    (
        _difference("disc_offset_x", "ring off centre along x", "alignment"),
        _difference("disc_offset_y", "ring off centre along y", "alignment"),
        _difference("disc_gap_difference", "material missing on the teeth", "teeth"),
        _difference("disc_pitch_difference", "teeth along the pitch", "teeth"),
        _difference("disc_clearance_difference", "radial clearance of the bearings", "clearance"),
    ),
    signals=("transmission_error", "vibration", "lost_motion", "hysteresis", "input_torque", "no_load_torque", "efficiency"),
)  # fmt: skip


@kernel
def weight(d, discs):
    """w_d; nothing differs where there is one disc."""
    return d / (discs - 1.0) - 0.5 if discs > 1 else 0.0


@kernel
def prepare(r):
    discs, cranks, rollers = r.roller_gap_added.shape
    for d in range(discs):
        w = weight(d, discs)
        for lobe in range(r.lobe_gap_added.shape[1]):
            r.lobe_gap_added[d, lobe] += w * r.disc_gap_difference
            r.lobe_pitch_added[d, lobe] += w * r.disc_pitch_difference
        for c in range(cranks):
            for k in range(rollers):
                r.roller_gap_added[d, c, k] += w * r.disc_clearance_difference


@kernel
def before(r):
    if r.disc_offset_x == 0.0 and r.disc_offset_y == 0.0:
        return
    discs = r.ring_offset_x.shape[0]
    for d in range(discs):
        r.ring_offset_x[d] += weight(d, discs) * r.disc_offset_x
        r.ring_offset_y[d] += weight(d, discs) * r.disc_offset_y
