"""Tilting moment on the output flange, as far as a planar reducer can carry it.

    M = M_0 + m T,  tilt = c M
    ring as disc d of D sees it   off centre by -tilt (d - (D - 1)/2) l
    loss                          f |M| omega_output

The main bearings yield by c, and the carrier tilts in the housing: its cranks and discs, l apart along the axis, are
displaced against the ring, the first one way, the last the other way.  M is a vector that stands still in the housing, given by
the way in which it moves the last disc, the one next to the flange.  m is the moment over the torque: lever of the
arm's weight along the axis over that across it.  A loaded pair of bearings brakes with f = 2 mu r/L, r their
radius, L their distance.  A diagnosis looks for m alone: M_0 shows as discs that are misaligned with the ring
(``unequal_discs``), and only the drag would tell.

What a planar model cannot carry: a tilted disc touches pins and rollers along their length unevenly (how that wears, but
not how it is carried, is ``edge_loading``); forces along the axis; teeth of the first stage that are carried askew;
wear of the main bearings; a moment that turns with the flange.

Source: moment rigidity in catalogues of such reducers, 370 N m/arcmin for this size [assumed].
"""

import math

from fmu_src.effect import Effect, amplitude, shape
from fmu_src.kernel import kernel


def _moment(name: str, unit: str, text: str, scale: float, high: float, group: str):
    return amplitude(name, unit, text, scale, -high, high, source="no moment, as in both sources", group=group)


EFFECT = Effect(
    0, "tilting moment",
    "M = M_0 + m T, tilt = c M, ring off centre by -c M (d - (D - 1)/2) l at disc d, loss f |M| omega",
    "moment rigidity of catalogues, 370 N m/arcmin assumed",
    "order 39 (z_c) in proportion to the moment, and drag that does not go away without torque; a constant moment looks as"
    " discs misaligned with the ring (unequal discs) but for the drag, one in proportion to the torque does not",
    (
        _moment("tilting_share_x", "1", "moment over load torque that moves the last disc along x", 1.0, 20.0, "with the load"),
        _moment("tilting_share_y", "1", "moment over load torque that moves the last disc along y", 1.0, 20.0, "with the load"),
        _moment("tilting_moment_x", "N.m", "constant moment that moves the last disc along x", 100.0, 5000.0, "constant moment"),
        _moment("tilting_moment_y", "N.m", "constant moment that moves the last disc along y", 100.0, 5000.0, "constant moment"),
        shape("tilting_compliance", "rad/(N.m)", "tilt of the carrier per moment", 7.8e-7, 0.0, 1e-3, "assumed: 370 N m/arcmin", held=True),
        shape("disc_spacing", "m", "distance of neighbouring discs along the axis", 10e-3, 0.0, 0.2, "assumed: width of a disc and a gap", held=True),
        shape("tilting_friction", "1", "f: friction torque at the output over the moment", 4e-3, 0.0, 0.2,
              "assumed: 2 mu r/L with mu 0.002 and bearings as far apart as they are wide", grid=(4e-3,)),
    ),
    signals=("transmission_error", "vibration", "hysteresis", "input_torque"),
)  # fmt: skip


@kernel
def moment(r):
    """(x, y) of M [N m]."""
    return r.tilting_moment_x + r.tilting_share_x * r.load_torque, r.tilting_moment_y + r.tilting_share_y * r.load_torque


@kernel
def before(r):
    x, y = moment(r)
    if x == 0.0 and y == 0.0:
        return
    discs = r.ring_offset_x.shape[0]
    for d in range(discs):
        lever = r.tilting_compliance * r.disc_spacing * (d - 0.5 * (discs - 1.0))
        r.ring_offset_x[d] -= lever * x
        r.ring_offset_y[d] -= lever * y


@kernel
def after(r):
    x, y = moment(r)
    if x == 0.0 and y == 0.0:
        return
    r.friction_power += r.tilting_friction * math.sqrt(x * x + y * y) * abs(r.crank_speed) / r.lobe_gap_added.shape[1]
