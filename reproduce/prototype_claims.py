"""Transmission error of prototypes in the literature, and which of their errors matter."""

import numpy as np

from pages.charts import Curve, chart
from reproduce.claim import CONDITIONAL, LITERATURE, NOT_TESTABLE, REPRODUCED, Finding, Number, held, states
from reproduce.context import MODIFIED, REAL_BX, REAL_RV, RV, Context, amplitude
from reproduce.flank_wear_claims import hump
from reproduce.prototypes import loop, part_errors, peak_to_peak, span, transmission_error
from reproduce.rig import SUMMARY
from studies.hysteresis import LOST_MOTION_SHARE

# Peak to peak of the two RV-80E: measured, and computed there.
FAR_OFF, SEEDS = 4.0, (0, 1, 2, 3)
MEASURED_80E, COMPUTED_80E = (60.07, 64.64), (56.15, 65.03)
# An error of each kind, of the size that good parts have.
ERRORS = {
    "throw of one eccentric 3 µm": "errors.crank.eccentricity[1,1]=3um", "phase of one eccentric 2 arcmin": "errors.crank.phase[1,1]=2arcmin",
    "one hole 3 µm": "errors.disc_hole.tangential[1,1]=3um", "one pin 3 µm thick": "errors.pin.radius[5]=3um",
    "equidistant modification 3 µm": "disc.equidistant_modification=3um", "shift modification -3 µm": "disc.shift_modification=-3um",
}  # fmt: skip


@states("L14", LITERATURE, "Transmission error of two RV-80E", "Yang et al. 2021, Mech. Mach. Theory 163, 104384: measured -29.68 to 30.39 and -31.51 to"
        " 33.13 arcsec, computed -28.83 to 27.32 and -32.16 to 32.87; orders 40, 80, 120, 160.")
def rv80e(context: Context) -> Finding:
    reducer = context.rv80e()
    good, coarse, far = (span(reducer, times) for times in (1.0, 3.0, FAR_OFF))
    typical = float(np.median([peak_to_peak(reducer, part_errors(reducer, seed, FAR_OFF)) for seed in SEEDS]))
    spectrum = transmission_error(reducer, part_errors(reducer, 1))
    orders = {order: amplitude(spectrum, order) for order in (40, 78, 80, 120, 160)}
    numbers = [Number(f"peak to peak, {label}, {which} of four", "arcsec", value) for label, both in (("good parts", good), ("three times as far off", coarse))
               for which, value in zip(("least", "largest"), both)]
    numbers += [held(f"peak to peak, four times as far off; theirs {what} of prototype {k}", "arcsec", typical, value, far)
                for what, pair in (("measured", MEASURED_80E), ("computed", COMPUTED_80E)) for k, value in enumerate(pair, 1)]
    leading = sorted(orders, key=lambda order: -orders[order])[:2]
    numbers += [held("leading order", "1", float(leading[0]), 40.0)]
    numbers += [Number(f"order {order} of one of them", "arcsec", value) for order, value in orders.items()]
    return Finding(
        CONDITIONAL, "Geometry of their RV-80E (77.5 mm, 1.5 mm, 4 mm, 10 and 38 teeth; from a public repetition of the paper), completed by design rules."
        " Parts as good as assumed here leave a quarter of what was measured, three times as large errors not quite all; with four times as large ones theirs"
        " lie among four such reducers. Order 40 leads, as there; 80, 120 and 160 are there and small. Their eleven measured errors are not in what is"
        " public.", numbers,
        [("errors of good parts do not reach it", good[1] < 30.0), ("three times as large ones do not", coarse[1] < min(MEASURED_80E)),
         ("four times as large ones do", far[0] < min(MEASURED_80E) and max(MEASURED_80E) < far[1]),
         ("order 40 is the largest", orders[40] == max(orders.values())), ("120 and 160 are there", min(orders[120], orders[160]) > 0.01)],
        "part errors about four times those of good parts",
    )  # fmt: skip


@states("L15", LITERATURE, "Twenty degrees of freedom with wear and eleven errors", "Chen 2026, 10.1007/s40430-026-06366-x: transmission error 23.32 arcsec"
        " computed, 25.5 measured, 6.31 % off at most; bearing force within 8.89 %.")
def twenty_degrees(context: Context) -> Finding:
    reducer = context.reducer(REAL_RV)
    (low, high), wide = span(reducer, 1.0), span(reducer, 2.0)
    typical = float(np.median([peak_to_peak(reducer, part_errors(reducer, seed)) for seed in SEEDS]))
    return Finding(
        NOT_TESTABLE, "Which reducer it is, its errors and its forces are not in what is public: how far off a computation of it is cannot be said. Four"
            " RV-20E with errors of good parts have this size.",
        [held("RV20E-121 of good parts; theirs measured", "arcsec", typical, 25.5, (low, high)), held("theirs computed", "arcsec", typical, 23.32, (low, high)),
         Number("RV20E-121, twice as far off, least of four", "arcsec", wide[0]), Number("largest of these", "arcsec", wide[1]),
         held("bearing force off by at most", "%", None, 8.89), held("transmission error off by at most", "%", None, 6.31)],
        [("their figures lie among reducers of good parts", low < 23.32 < 25.5 < high)],
    )  # fmt: skip


@states("L18", LITERATURE, "Which tolerances matter", "Jin 2025, Appl. Sci. 15(11), 5865, 10.3390/app15115865: five RV-40E prototypes within 5 % of the"
        " computation; eccentricity of the cranks and equidistant modification matter most, their tolerances go from 6 to 4 µm.")
def tolerances(context: Context) -> Finding:
    reducer = context.reducer(REAL_BX)
    error, lost = peak_to_peak(reducer), loop(reducer).lost_motion_arcmin
    numbers, by_error, by_lost = [], {}, {}
    for label, text in ERRORS.items():
        by_error[label] = peak_to_peak(reducer, [text]) - error
        by_lost[label] = loop(reducer, text).lost_motion_arcmin - lost
        numbers += [Number(f"{label}: transmission error", "arcsec", by_error[label]), Number(f"{label}: lost motion", "arcmin", by_lost[label])]
    throw, proud, equidistant = next(iter(ERRORS)), "one pin 3 µm thick", "equidistant modification 3 µm"
    # Either way: a proud pin closes the play that a modification opens.
    error_moved, lost_moved = ({label: abs(value) for label, value in found.items()} for found in (by_error, by_lost))
    shared = {label: moved for label, moved in lost_moved.items() if label != proud}
    tightened = [100.0 * (peak_to_peak(reducer, [f"errors.crank.eccentricity[1,1]={size}um"]) / error - 1.0) for size in (6, 4)]
    numbers += [held("prototypes off by", "%", None, 5.0),
                held("tolerance of the throw, tightened over before: what it adds to the transmission error", "1", tightened[1] / tightened[0], 4.0 / 6.0)]
    return Finding(
        CONDITIONAL, "Of errors of one size an eccentric's throw changes the transmission error most, equidistant modification hardly: it changes the lost"
            " motion, by more than any other error but that of a single proud pin, which closes the play. The prototypes' own errors are not public: the 5 %"
            " cannot be held against anything.", numbers,
        [("throw changes the transmission error most", error_moved[throw] == max(error_moved.values())),
         ("equidistant modification changes it least", error_moved[equidistant] == min(error_moved.values())),
         ("equidistant modification changes lost motion most, a proud pin apart", lost_moved[equidistant] == max(shared.values())),
         ("a proud pin changes it more", lost_moved[proud] > lost_moved[equidistant])],
        "eccentricity for the transmission error, equidistant modification for the lost motion, a proud pin apart",
    )  # fmt: skip


@states("L19", LITERATURE, "Both senses of rotation", "Wang 2024, bidirectional drive and positioning accuracy of a cycloid reducer (journal not in what was"
        f" read), by {SUMMARY}: transmission error in both senses and lost motion computed 6.8, 5.5 and 5.7 % below the measured ones.")
def both_senses(context: Context) -> Finding:
    reducer = context.reducer(REAL_BX)
    errors = part_errors(reducer, 1)
    there = peak_to_peak(reducer, errors)
    back = peak_to_peak(reducer, [*errors, "input.speed=-1815rpm", "output.load_torque=-412"])
    braking = peak_to_peak(reducer, [*errors, "input.speed=-1815rpm"])
    light = LOST_MOTION_SHARE * 412.0
    ways = [transmission_error(reducer, [*errors, f"input.speed={sense * 1815}rpm", f"output.load_torque={sense * light!r}"]) for sense in (1, -1)]
    turned = abs(float(ways[0].mean() - ways[1].mean())) / 60.0
    return Finding(
        NOT_TESTABLE, "A reducer with part errors shows different transmission errors in the two senses, because other flanks and other sides of the"
        " bearings carry. Whether by so much as theirs, and how near to the measured ones, their unknown errors decide.",
        [Number("peak to peak, driving one way", "arcsec", there), Number("driving the other way", "arcsec", back),
         Number("the other way, driven by the load", "arcsec", braking),
         Number("lost motion, mean of a turn one way less that of the other under 3 % of the torque", "arcmin", turned),
         *(held(f"{what}, computed less measured", "%", None, theirs) for what, theirs in
           (("transmission error, one way", -6.8), ("the other way", -5.5), ("lost motion", -5.7)))],
        [("senses differ", abs(there - back) > 0.01 * there), ("there is lost motion in motion", turned > 0.1)],
    )  # fmt: skip


@states("L22", LITERATURE, "A toolkit for RV, planetary and single-crank reducers", "arXiv 2604.02387 (2026): transmission error in both senses, lost motion,"
        " stiffness, vibration.")
def toolkit(context: Context) -> Finding:
    lost = loop(context.reducer(REAL_BX)).lost_motion_arcmin
    return Finding(
        NOT_TESTABLE, "Neither code nor figures are public in what was found. The same quantities come out here: both senses (L19), lost motion and"
        " stiffness (L16), vibration (L25).", [Number("lost motion of an RV-40E", "arcmin", lost)], [("there is lost motion", lost > 0.0)],
    )  # fmt: skip


@states("L23", LITERATURE, "Wear of modified profiles", "Lubricants 2023, 11(8), 323 and 11(10), 445: tooth wear of cycloid drives depends on"
        " the profile's modification; loaded contact with a wear coefficient from regression.")
def modified_wear(context: Context) -> Finding:
    runs = {"ideal profile": context.life(RV), "modified profile": context.life(RV, *MODIFIED)}
    depths = {label: 1e6 * hump(run)[1] for label, run in runs.items()}
    curves = [Curve(label, run.hours, run.figure("disc_flank_um")) for label, run in runs.items()]
    figure = chart("modified_wear", "Deepest flank, RV20E-121-rigid", "", curves, "operating time [h]", "depth [µm]", 6, 280)
    return Finding(
        REPRODUCED, "A modified profile has fewer loaded teeth and wears deeper; their numbers are for another drive and another coefficient.",
        [Number(f"{label}: flank after 10,000 h", "µm", value) for label, value in depths.items()],
        [("the modified one wears deeper", depths["modified profile"] > depths["ideal profile"])], figures=[figure],
    )  # fmt: skip


@states("L31", LITERATURE, "Error of a cycloid stage by modification and errors", "Liu et al., Appl. Sci. 2021, 11(18), 8671: transmission error and backlash"
        " of a cycloid-pin pair follow profile modification, manufacturing and assembly errors.")
def modification(context: Context) -> Finding:
    reducer = context.reducer(REAL_RV)
    plain, gap = loop(reducer), loop(reducer, "disc.equidistant_modification=5um")
    errors = part_errors(reducer, 2)
    ideal, modified = peak_to_peak(reducer, errors), peak_to_peak(reducer, [*errors, "disc.equidistant_modification=5um"])
    numbers = [Number("lost motion, ideal profile", "arcmin", plain.lost_motion_arcmin), Number("equidistant 5 µm", "arcmin", gap.lost_motion_arcmin),
               Number("transmission error with part errors, ideal profile", "arcsec", ideal), Number("the same, equidistant 5 µm", "arcsec", modified)]
    return Finding(REPRODUCED, "Modification opens the pair, and what errors do to the transmission error changes with it.", numbers,
                   [("lost motion grows", gap.lost_motion_arcmin > 1.2 * plain.lost_motion_arcmin), ("transmission error changes", not np.isclose(ideal,
                       modified, rtol=0.02))])


