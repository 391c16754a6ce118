"""Stiffness, lost motion and vibration of real reducers in catalogue and literature, against the library's reducers and the series."""

import numpy as np

from pages.charts import Curve, chart
from reproduce.claim import CATALOGUE, CONDITIONAL, LITERATURE, NOT_TESTABLE, REPRODUCED, Finding, Number, held, states
from reproduce.context import REAL_BX, REAL_RV, RV, Context
from reproduce.prototypes import loop, part_errors, settings_of
from reproduce.rig import SUMMARY
from reproduce.unknowns import loop_spans
from studies.family import SCATTER, SIZES, reducer_of_size, stiffness_of
from studies.hysteresis import one_angle, torque_way
from studies.modes import Mode, modes

# Three grades of precision of one reducer: stiffness [N m/arcmin], lost motion [arcmin].
GRADES = ((131.98, 0.364), (125.55, 0.389), (117.41, 0.412))
# Part errors that stand for them here, over those of good parts (assumed).
PRECISION = (0.0, 1.0, 2.0)


@states("C05", CATALOGUE, "Torsional stiffness of the library's reducers", "RV-20E 49, RV-40E 108 N m/arcmin.")
def real_stiffness(context: Context) -> Finding:
    numbers, ratios, curves = [], [], []
    for name, target in ((REAL_RV, 49.0), (REAL_BX, 108.0)):
        reducer = context.reducer(name)
        found = loop(reducer)
        ratios.append(found.stiffness_Nm_per_arcmin / target)
        springs = loop(reducer, "mesh.friction=0", "mesh.friction_excess=0")
        numbers += [
            held(name, "N m/arcmin", found.stiffness_Nm_per_arcmin, target, loop_spans(context, name)["stiffness"]),
            Number(f"{name}, springs without friction", "N m/arcmin", springs.stiffness_Nm_per_arcmin),
        ]
        curves.append(Curve(name, found.torque / found.torque.max(), found.turning))
    figure = chart("real_loops", "Turning against torque, input locked", "Friction included.", curves, "torque over rated", "turning [arcmin]", 12, 320)
    return Finding(
        CONDITIONAL, "One number of the supports was fitted to the series (C08): that both come within an eighth is a test of the rules by which it is"
        " carried from size to size, not of the number.", numbers, [("both within a fifth", all(abs(ratio - 1.0) < 0.2 for ratio in ratios))],
        "how soft a crank's bearing is in place is fitted, 6 times its rollers alone", figures=[figure],
    )  # fmt: skip


@states("C06", CATALOGUE, "Lost motion of the library's reducers", "Below 1 arcmin at 3 % of the rated torque, on the middle line of the loop.")
def real_lost_motion(context: Context) -> Finding:
    numbers, found = [], []
    for name in (REAL_RV, REAL_BX):
        reducer = context.reducer(name)
        found.append(loop(reducer).lost_motion_arcmin)
        numbers.append(held(name, "arcmin", found[-1], (0.0, 1.0), loop_spans(context, name)["lost_motion"]))
    return Finding(
        CONDITIONAL, "Mostly the clearance of the needle bearings; its range alone goes beyond the limit, so that makers must keep it in the lower half.",
            numbers,
        [("below the limit", max(found) < 1.0)], "needle clearance of about 2 µm, ideal profile",
    )  # fmt: skip


@states("C08", CATALOGUE, "Eight sizes with five dials", "RV-6E to RV-450E: 20, 49, 108, 196, 294, 392, 980, 1176 N m/arcmin, from rated torque, outer"
        " diameter and ratio.")
def series(context: Context) -> Finding:
    found = {size.name: (stiffness_of(reducer_of_size(size)), size.stiffness) for size in SIZES}
    ratios = [model / catalogue for model, catalogue in found.values()]
    within = sum(abs(ratio - 1.0) <= SCATTER for ratio in ratios)
    return Finding(
        CONDITIONAL, f"{within} of {len(ratios)} sizes within a quarter, their mean by the fit. RV-6E is a third too stiff, as if its crank bearings were"
            " smaller than the rules make them; `rvwear family` names what is missing and draws it.",
        [held(name, "N m/arcmin", model, catalogue) for name, (model, catalogue) in found.items()],
        [("seven of eight within a quarter", within >= 7), ("mean within a tenth", abs(np.exp(np.mean(np.log(ratios))) - 1.0) < 0.1)],
        "one dial fitted to all sizes, none to one",
    )  # fmt: skip


@states("L16", LITERATURE, "Stiffness and lost motion of three grades of precision", "Xu 2025, hysteresis, torsional rigidity and lost motion of an RV"
        f" reducer (journal not in what was read), by {SUMMARY}: 131.98, 125.55, 117.41 N m/arcmin and 0.364, 0.389, 0.412 arcmin; the stiffness of support"
        " bearings rules rigidity, the clearance of the turning-arm bearings lost motion.")
def grades(context: Context) -> Finding:
    reducer = context.reducer(REAL_BX)
    found = loop(reducer)
    low, high = reducer.ranges["crank_seat_compliance"]
    changed = {
        "crank supports a tenth softer": loop(reducer, f"crank.support_compliance={1.1 * reducer.starts['crank_seat_compliance']!r}"),
        "needle clearance 1 µm larger": loop(reducer, "bearing.clearance=3.5um"), "needle clearance 0.3 µm": loop(reducer, "bearing.clearance=0.3um"),
        "supports at the stiff end": loop(reducer, f"crank.support_compliance={low!r}"), "supports at the soft end": loop(reducer,
        f"crank.support_compliance={high!r}"),
    }  # fmt: skip
    spans = loop_spans(context, REAL_BX)
    graded = [loop(reducer, *part_errors(reducer, 1, times), "bearing.clearance=0.3um") for times in PRECISION]
    numbers = [held("BX-40E: stiffness", "N m/arcmin", found.stiffness_Nm_per_arcmin, (GRADES[-1][0], GRADES[0][0]), spans["stiffness"]),
               held("BX-40E: lost motion", "arcmin", found.lost_motion_arcmin, (GRADES[0][1], GRADES[-1][1]), spans["lost_motion"])]
    for name, one, (stiffness, lost) in zip(("high", "moderate", "low"), graded, GRADES):
        numbers += [held(f"{name} precision, clearance 0.3 µm: stiffness", "N m/arcmin", one.stiffness_Nm_per_arcmin, stiffness),
                    held(f"{name} precision, clearance 0.3 µm: lost motion", "arcmin", one.lost_motion_arcmin, lost)]
    for label, one in changed.items():
        numbers += [Number(f"{label}: stiffness", "N m/arcmin", one.stiffness_Nm_per_arcmin), Number(f"{label}: lost motion", "arcmin", one.lost_motion_arcmin)]
    softer, wider, tight = list(changed.values())[:3]
    return Finding(
        CONDITIONAL, "Both rules hold: supports change the stiffness and hardly the lost motion, clearance the other way about. Stiffness lies among"
        " theirs. Their lost motion is half of ours: needle bearings nearly without clearance, as the last but two lines have it, where 2.5 µm is assumed"
        " here. Part errors of twice good parts take a tenth of the stiffness, as there; they close what play is left, where theirs open it.", numbers,
        [("stiffness among theirs", GRADES[-1][0] < found.stiffness_Nm_per_arcmin < GRADES[0][0]),
         ("supports rule stiffness", softer.stiffness_Nm_per_arcmin < 0.95 * found.stiffness_Nm_per_arcmin < 0.96 * wider.stiffness_Nm_per_arcmin),
         ("clearance rules lost motion", wider.lost_motion_arcmin > 1.15 * found.lost_motion_arcmin > 1.1 * softer.lost_motion_arcmin),
         ("errors take stiffness as theirs"
             " do", abs(graded[-1].stiffness_Nm_per_arcmin / graded[0].stiffness_Nm_per_arcmin - GRADES[-1][0] / GRADES[0][0]) < 0.04),
         ("without clearance lost motion is as theirs", 0.9 * GRADES[0][1] < tight.lost_motion_arcmin < 1.15 * GRADES[-1][1])],
        "needle clearance near zero; what part errors do to lost motion apart",
    )  # fmt: skip


@states("L24", LITERATURE, "Stiffness in operation is not that of the loop", "Appl. Sci. 2023, 13(16), 9277: torsional stiffness is dynamic; the hysteresis"
        " curve cannot represent that of a running reducer.")
def dynamic_stiffness(context: Context) -> Finding:
    reducer = context.reducer(REAL_RV)
    held = loop(reducer).stiffness_Nm_per_arcmin
    running = loop(reducer, "mesh.friction=0", "mesh.friction_excess=0").stiffness_Nm_per_arcmin
    torque = torque_way(167.0, 8)
    by_angle = []
    for share in np.linspace(0.0, 1.0, 12, endpoint=False):
        turning = one_angle(context.reducer(RV), settings_of(context.reducer(RV), ()), torque, float(share))
        full, half = int(np.argmax(torque)), int(np.argmin(abs(torque[: len(torque) // 4 + 1] - 83.5)))
        by_angle.append(83.5 / abs(turning[full] - turning[half]))
    return Finding(
        REPRODUCED, "Held, friction helps the springs on the way up; running, it shows in the input's torque and not in the angle: an eighth less"
        " stiffness. Over the cranks' angle the contacts' stiffness changes by little.",
        [Number("RV20E-121, loop with the input held", "N m/arcmin", held), Number("RV20E-121, running", "N m/arcmin", running),
         Number("contacts alone, least over a turn of the cranks", "N m/arcmin", min(by_angle)), Number("largest", "N m/arcmin", max(by_angle))],
        [("running is softer", running < 0.95 * held), ("the angle matters less than friction", max(by_angle) / min(by_angle) < held / running)],
    )  # fmt: skip


def kinds(found: list[Mode]) -> list[tuple[float, float, float]]:
    """For each mode the kinetic energy in turning of carrier, ring, sun and load, in shift of the carrier, and in all else, over the whole."""
    rows = []
    for mode in found:
        whole = sum(mode.energy_share.values())
        turning = mode.parts["carrier turns"] + sum(mode.parts.get(name, 0.0) for name in ("ring turns", "sun turns", "load turns"))
        rows.append((turning / whole, mode.parts["carrier shifts"] / whole, 1.0 - (turning + mode.parts["carrier shifts"]) / whole))
    return rows


@states("L25", LITERATURE, "Three kinds of modes", "Yang, Chen, Wang 2018, Chin. J. Mech. Eng., 10.1186/s10033-018-0249-y: vibrations of an RV reducer are"
        " of three kinds, rotational, translational, and of the planetary components.")
def three_kinds(context: Context) -> Finding:
    found = modes(context.reducer(REAL_RV), [], held=False)
    rows = kinds(found)
    mixed = max(min(turning, shift) for turning, shift, _ in rows)
    numbers = [Number(f"{mode.frequency_Hz:.0f} Hz: {mode.moves}; turning of central bodies", "1", row[0]) for mode, row in zip(found[1:9], rows[1:9])]
    planetary = [row for row in rows if row[2] > 0.9]
    return Finding(
        REPRODUCED, "Turned by half a turn the reducer is itself with its discs exchanged: what turns carrier, ring, sun and load shifts none of them. Some"
        " modes move cranks and discs alone.", [*numbers, Number("largest share of the lesser of turning and shift in a mode", "1", mixed)],
        [("no mode turns and shifts central bodies", mixed < 1e-6), ("some are of cranks and discs alone", len(planetary) >= 3)],
    )  # fmt: skip


@states("L26", LITERATURE, "Modes by finite elements", "Adv. Mech. Eng. 2023, 10.1177/16878132231181328: modes of an RV reducer, of its input shaft and of"
        " its cycloid gear by finite elements, held against vibration measured under three conditions.")
def finite_elements(context: Context) -> Finding:
    found = [mode.frequency_Hz for mode in modes(context.reducer(REAL_RV), [])]
    return Finding(
        NOT_TESTABLE, "Elastic bodies: their modes are not in a model of rigid bodies on springs, and which reducer and which frequencies is not in what"
        " was read. What this model has below is the load on the whole reducer; its own bodies begin kilohertz above the order of the cranks.",
        [Number("load of 5 kg m² on the reducer", "Hz", found[0]), Number("lowest of its own bodies", "Hz", found[1])],
        [("nothing between", found[1] > 50.0 * found[0])],
    )  # fmt: skip
