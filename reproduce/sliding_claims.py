"""Tooth-profile document: sliding of flank on pin, and how wear changes it."""


import numpy as np

from pages.charts import PHASE, Curve, chart, degrees_axis
from reproduce import printed_forms as printed
from reproduce.claim import CONTRADICTED, TOOTH, Finding, Number, states
from reproduce.contacts import MIDDLES
from reproduce.context import BX, Context, flank_of
from wear_fmu.kinematics import pitch_distance

MM = 1e3


@states("T22", TOOTH, "Pure rolling at the pitch point", "In the cycloid drive, pure rolling occurs only at the"
        " pitch point.")
def pure_rolling(context: Context) -> Finding:
    g = context.contacts(BX).geometry
    nearest = g.circle * pitch_distance(0.0, g.k1)
    slowest = float(g.sliding([0.0])[0])
    return Finding(
        CONTRADICTED, "The contact would have to lie in the pitch point, R_p sqrt(S) = r_rp; pin centres never come"
        " nearer to it than"
        f" {MM * nearest:.1f} mm. With fixed pins the flank slides everywhere; only a pin that turns can roll.",
        [Number("smallest distance of a pin's centre from the pitch point", "mm", MM * nearest, None, 17.5),
         Number("needed for rolling", "mm", MM * g.radius),
         Number("smallest sliding", "mm per rad of crank", MM * slowest, 0.0, 0.372)],
        [("never in the pitch point", nearest > 3.0 * g.radius), ("sliding never zero", slowest > 0.0)],
    )  # fmt: skip


@states("T23", TOOTH, "Sliding speed", "v_s = a omega [Z_p/(Z_p - 1) - sin(alpha)/sin(alpha + beta)].")
def sliding_speed(context: Context) -> Finding:
    g = context.contacts(BX).geometry
    degrees = np.linspace(0.0, 180.0, 361)
    true = MM * g.sliding(degrees)
    wrong = MM * printed.printed_sliding_speed_signed(np.radians(degrees), g.eccentricity, g.lobes + 1, g.k1)
    speed = abs(context.pair(BX).plant.get("crank_speed"))
    figure = chart("sliding_speed", "Sliding per radian of the crank, BX-40E-rigid", "",
                   [Curve("right: (R_p sqrt(S) - r_rp)/Z_c", degrees, true),
                    Curve("as printed", degrees, wrong, dash="dash")], PHASE, "v_s/ω [mm/rad]", 6, 300,
                   [(g.inflection, "inflection")], degrees_axis())
    return Finding(
        CONTRADICTED, "The disc turns about the pitch point with omega/Z_c, so v_s is that times the distance of the"
        " contact:"
        " monotonic from root to tip. The printed form lacks the pin's radius, has the fraction upside down and"
        " changes its sign.",
        [Number("at the root", "mm/rad", true[0], wrong[0], 0.372),
         Number("at the tip", "mm/rad", true[-1], wrong[-1], 3.04),
         Number("printed, smallest", "mm/rad", None, wrong.min(), -3.83),
         Number("printed, largest", "mm/rad", None, wrong.max(), 0.59),
         Number("slowest at 15 rpm out", "mm/s", true[0] * speed, None, 22.8),
         Number("fastest", "mm/s", true[-1] * speed, None, 186.0)],
        [("monotonic", (np.diff(true) > 0).all()), ("the printed form changes its sign",
                                                    wrong.min() < 0.0 < wrong.max())], figures=[figure],
    )  # fmt: skip


@states("T24", TOOTH, "Sliding distance 'M'", "s_rel along the profile forms an asymmetric M; it is minimal (near"
        " pure rolling) at the inflection.")
def sliding_shape(context: Context) -> Finding:
    contacts = context.contacts(BX)
    g = contacts.geometry
    ratio = g.sliding(MIDDLES) / g.travel(MIDDLES)
    points = 1e6 * contacts.point_sliding_along
    loaded = points > 0.02 * points.max()
    turns = int((np.diff(np.sign(np.diff(smooth(points[loaded])))) != 0).sum())
    whole = np.concatenate((MIDDLES, 360.0 - MIDDLES[::-1]))
    both = np.concatenate((points, points[::-1]))
    figure = chart("sliding_distance", "Sliding length of a point of the flank per pass, BX-40E-rigid",
                   "2 a_H v_s/v_c. Loaded on both flanks (torque both ways) the whole tooth shows two humps with the"
                   " valley at the tip.",
                   [Curve("one flank loaded", MIDDLES, points, width=2.6),
                    Curve("both flanks loaded", whole, both, dash="dot")], PHASE + ", 360 root",
                    "sliding length [µm]",
                   12, 300, [(g.inflection, "inflection"), (360.0 - g.inflection, "inflection")], degrees_axis(360.0))
    probe = g.sliding([2.0, g.inflection, 90.0, 179.0]) / g.travel([2.0, g.inflection, 90.0, 179.0])
    return Finding(
        CONTRADICTED, "Sliding speed is monotonic. v_s/v_c is its ratio to the speed of the contact along the flank, and no speed; it makes the sliding"
        " length of a material point, one hump per flank. At the"
        " inflection the flank slides as far as the contact travels. An 'M' appears only over a whole tooth loaded"
        " both ways, and its valley is the tip.",
        [Number("v_s/v_c at 2°", "1", probe[0], None, 0.04, 0.3),
         Number("v_s/v_c at the inflection", "1", probe[1], 0.0, 0.93),
         Number("v_s/v_c at 90°", "1", probe[2], None, 2.0), Number("v_s/v_c at the tip", "1", probe[3], None, 1.75),
         Number("place of the longest sliding", "°", float(MIDDLES[points.argmax()])),
         Number("turning points of the curve per flank", "1", float(turns), 3.0)],
        [("one hump per flank", turns <= 2), ("far from rolling at the inflection", probe[1] > 0.5),
         ("ratio largest well beyond the inflection", MIDDLES[ratio.argmax()] > g.inflection + 20.0)],
        figures=[figure],
    )  # fmt: skip


def smooth(row: np.ndarray) -> np.ndarray:
    """Mean of three neighbours, twice."""
    for _ in range(2):
        row = np.convolve(np.pad(row, 1, mode="edge"), np.ones(3) / 3.0, mode="valid")
    return row


@states("T25", TOOTH, "Wear sensitivity",
        "zeta = d s_rel/d h is highest in the regions flanking the inflection: small wear there strongly changes"
        " subsequent sliding.")
def sensitivity(context: Context) -> Finding:
    run = context.life(BX)
    later = run.at(300.0)
    before, after = (run.contacts[i].point_sliding_along for i in (0, later))
    phase, depth = flank_of(run.tooth(later))
    h = np.interp(MIDDLES, phase, depth)
    worn = h > 0.1 * h.max()
    zeta = np.where(worn, smooth(after - before) / np.where(worn, h, 1.0), np.nan)
    g = run.contacts[0].geometry
    strongest = float(MIDDLES[np.nanargmax(np.abs(zeta))])
    at_inflection = float(np.interp(g.inflection, MIDDLES[worn], zeta[worn]))
    # The contact stays on the pin: wear of the disc only shortens or stretches the flank's arc, by h times its curvature.
    bend = g.curvature(MIDDLES) - 1.0 / g.radius
    kinematic = 1e2 * float(np.abs(bend[worn] * h[worn]).max())
    by_load = 1e2 * float(np.abs(after / before - 1.0)[worn].max())
    figure = chart("sensitivity", f"Sliding length gained per depth worn, BX-40E-rigid, first {run.hours[later]:.0f} h",
                   "Change of 2 a_H v_s/v_c at a phase over the depth worn there; where at least a tenth of the"
                   " deepest wear is.",
                   [Curve("zeta", MIDDLES[worn], zeta[worn])], PHASE, "zeta [1]", 6, 300,
                   [(g.inflection, "inflection")], degrees_axis())
    return Finding(
        CONTRADICTED, "Defined as the change of a material point's sliding length per pass, 2 a_H v_s/v_c, over the"
        " depth worn there in the"
        f" coupled run. Kinematics hardly feel wear of micrometres; the load moves, and with it a_H. The largest"
        f" |zeta| is at {strongest:.0f}°,"
        " at the edge of the worn zone that takes load over, not beside the inflection.",
        [Number("phase of the largest |zeta|", "°", strongest), Number("inflection", "°", g.inflection),
         Number("zeta there", "1", at_inflection),
         Number("zeta of largest size", "1", float(zeta[np.nanargmax(np.abs(zeta))])),
         Number("largest change of s_rel by kinematics", "%", kinematic), Number("by the moved load", "%", by_load),
         Number("sliding per crank angle gained per depth worn off a pin, 1/Z_c", "1/rad", 1.0 / g.lobes)],
        [("kinematic part is negligible", kinematic < 0.05 * by_load),
         ("largest away from the inflection", abs(strongest - g.inflection) > 20.0)],
        figures=[figure],
    )  # fmt: skip
