"""Transmission error of prototypes in the literature, and which of their errors matter."""

import numpy as np

from pages.charts import Curve, chart
from reproduce.claim import CONDITIONAL, LITERATURE, NOT_TESTABLE, REPRODUCED, Finding, Number, states
from reproduce.context import MODIFIED, REAL_BX, REAL_RV, RV, Context, amplitude
from reproduce.flank_wear_claims import hump
from reproduce.prototypes import loop, part_errors, peak_to_peak, span, transmission_error
from rv_plant.gear_stage import total_ratio

# Peak to peak of the two RV-80E: measured, and computed there.
MEASURED_80E, COMPUTED_80E = (60.07, 64.64), (56.15, 65.03)
# An error of each kind, of the size that good parts have.
ERRORS = {
    "throw of one lobe 3 µm": "errors.crank.eccentricity[1,1]=3um", "phase of one lobe 2 arcmin": "errors.crank.phase[1,1]=2arcmin",
    "one hole 3 µm": "errors.disc_hole.tangential[1,1]=3um", "one pin 3 µm thick": "errors.pin.radius[5]=3um",
    "equidistant modification 3 µm": "disc.equidistant_modification=3um", "shift modification -3 µm": "disc.shift_modification=-3um",
}  # fmt: skip


@states("L14", LITERATURE, "Transmission error of two RV-80E", "Yang et al. 2021, Mech. Mach. Theory 163, 104384: measured -29.68 to 30.39 and -31.51 to"
        " 33.13 arcsec, computed -28.83 to 27.32 and -32.16 to 32.87; orders 40, 80, 120, 160.")
def rv80e(context: Context) -> Finding:
    reducer = context.rv80e()
    good, coarse = span(reducer, 1.0), span(reducer, 3.0)
    spectrum = transmission_error(reducer, part_errors(reducer, 1))
    orders = {order: amplitude(spectrum, order) for order in (40, 78, 80, 120)}
    numbers = [Number(f"peak to peak, {label}, {which} of four", "arcsec", value) for label, both in (("good parts", good), ("three times as far off", coarse))
               for which, value in zip(("least", "largest"), both)]
    numbers += [Number(f"measured there, {k}", "arcsec", None, value) for k, value in enumerate(MEASURED_80E, 1)]
    numbers += [Number(f"computed there, {k}", "arcsec", None, value) for k, value in enumerate(COMPUTED_80E, 1)]
    numbers += [Number(f"order {order} of one of them", "arcsec", value) for order, value in orders.items()]
    return Finding(
        CONDITIONAL, "Geometry of their RV-80E (77.5 mm, 1.5 mm, 4 mm, 10 and 38 teeth; from a public repetition of the paper), completed by design rules."
        " Parts as good as assumed here leave a quarter of what was measured; three times as large errors reach it. Order 40 leads, as there. Their eleven"
        " measured errors are not in what is public.", numbers,
        [("errors of good parts do not reach it", good[1] < 30.0), ("three times as large ones come near", coarse[1] > 45.0),
         ("order 40 is the largest", orders[40] == max(orders.values()))],
        "part errors about three times those of good parts",
    )  # fmt: skip


@states("L15", LITERATURE, "Twenty degrees of freedom with wear and eleven errors", "Chen 2026, 10.1007/s40430-026-06366-x: transmission error 23.32 arcsec"
        " computed, 25.5 measured; bearing force within 8.89 %.")
def twenty_degrees(context: Context) -> Finding:
    reducer = context.reducer(REAL_RV)
    low, high = span(reducer, 1.0)
    wide = span(reducer, 2.0)
    return Finding(
        NOT_TESTABLE, "Which reducer it is, its errors and its forces are not in what is public. An RV-20E with errors of good parts, or with twice as"
        " large ones, has this size.",
        [Number("theirs, measured", "arcsec", None, 25.5), Number("theirs, computed", "arcsec", None, 23.32),
         Number("RV-20E, good parts, least of four", "arcsec", low), Number("largest", "arcsec", high),
         Number("RV-20E, twice as far off, least of four", "arcsec", wide[0]), Number("largest of these", "arcsec", wide[1])],
        [("their figure lies between", low < 25.5 < wide[1])],
    )  # fmt: skip


@states("L18", LITERATURE, "Which tolerances matter", "Jin 2025: five RV-40E prototypes within 5 % of the computation; eccentricity of the cranks and"
        " equidistant modification matter most.")
def tolerances(context: Context) -> Finding:
    reducer = context.reducer(REAL_BX)
    error, lost = peak_to_peak(reducer), loop(reducer).lost_motion_arcmin
    numbers, by_error, by_lost = [], {}, {}
    for label, text in ERRORS.items():
        by_error[label] = peak_to_peak(reducer, [text]) - error
        by_lost[label] = loop(reducer, text).lost_motion_arcmin - lost
        numbers += [Number(f"{label}: transmission error", "arcsec", by_error[label]), Number(f"{label}: lost motion", "arcmin", by_lost[label])]
    throw, equidistant = next(iter(ERRORS)), "equidistant modification 3 µm"
    return Finding(
        REPRODUCED, "Of errors of one size, a lobe's throw changes the transmission error most, equidistant modification the lost motion. The prototypes'"
        " own errors are not public: the 5 % cannot be held against anything.", numbers,
        [("throw changes the transmission error most", by_error[throw] == max(by_error.values())),
         ("equidistant modification changes lost motion most", by_lost[equidistant] == max(by_lost.values()))],
    )  # fmt: skip


@states("L19", LITERATURE, "Both senses of rotation", "Wang 2024: transmission error and lost motion computed in both senses, 5.5 to 6.8 % below the"
        " measured ones.")
def both_senses(context: Context) -> Finding:
    reducer = context.reducer(REAL_BX)
    errors = part_errors(reducer, 1)
    there = peak_to_peak(reducer, errors)
    back = peak_to_peak(reducer, [*errors, "input.speed=-1815rpm", "output.load_torque=-412"])
    braking = peak_to_peak(reducer, [*errors, "input.speed=-1815rpm"])
    return Finding(
        NOT_TESTABLE, "A reducer with part errors shows different transmission errors in the two senses, because other flanks and other sides of the"
        " bearings carry. Whether by so much as theirs, and how near to the measured ones, their unknown errors decide.",
        [Number("peak to peak, driving one way", "arcsec", there), Number("driving the other way", "arcsec", back),
         Number("the other way, driven by the load", "arcsec", braking)],
        [("senses differ", abs(there - back) > 0.01 * there)],
    )  # fmt: skip


@states("L20", LITERATURE, "Fourier series over conditions", "Bauer et al., ICIT 2025, 10.1109/ICIT63637.2025.10965256: RH380-N cycloid drive, 224"
        " conditions fitted, 19 held out, rmse 5.0 and 5.8 arcsec by a quadratic Fourier model; no condition with speed and torque of one sign.")
def fourier(context: Context) -> Finding:
    reducer = context.reducer(REAL_RV)
    full, light = (peak_to_peak(reducer, [*part_errors(reducer, 1), f"output.load_torque={torque}"]) for torque in (167, 42))
    return Finding(
        NOT_TESTABLE, "A statistical model of another drive; its data are not public. What physics says of the missing conditions: with the load driving,"
        " other flanks carry (L19).",
        [Number("an RV-20E of good parts, rated torque", "arcsec", full), Number("a quarter of it", "arcsec", light)],
        [("the error depends on the torque", abs(full - light) > 0.1)],
    )  # fmt: skip


@states("L21", LITERATURE, "A rig of ratio 81", "Robotics Comput.-Integr. Manuf. 2025, 102838, 10.1016/j.rcim.2024.102838: transmission error of an RV"
        " reducer of ratio 81 over torque, speed, temperature and both senses, by orders.")
def rig(context: Context) -> Finding:
    return Finding(
        NOT_TESTABLE, "Its data have no licence and do not come with this software: examples/rv_reducer_te reads a user's own clone and holds the model"
        " against it, order by order.",
        [Number("ratio of an RV reducer with 40 pins and planets twice the sun", "1", total_ratio(2.0, 40, 39))],
        [("81 is such a ratio", total_ratio(2.0, 40, 39) == 81.0)],
    )  # fmt: skip


@states("L22", LITERATURE, "A toolkit for RV, planetary and single-crank reducers", "arXiv 2604.02387 (2026): transmission error in both senses, lost"
        " motion, stiffness, vibration.")
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
    figure = chart("modified_wear", "Deepest flank, RV20E-121", "", curves, "operating time [h]", "depth [µm]", 6, 280)
    return Finding(
        REPRODUCED, "A modified profile has fewer loaded teeth and wears deeper; their numbers are for another drive and another coefficient.",
        [Number(f"{label}: flank after 10,000 h", "µm", value) for label, value in depths.items()],
        [("the modified one wears deeper", depths["modified profile"] > depths["ideal profile"])], figures=[figure],
    )  # fmt: skip


@states("L31", LITERATURE, "Error of a cycloid stage by modification and errors", "Liu et al., Appl. Sci. 2021, 11(18), 8671: transmission error and"
        " backlash of a cycloid-pin pair follow profile modification, manufacturing and assembly errors.")
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


