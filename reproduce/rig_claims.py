"""Rigs whose data are public or described: learned and closed forms of the transmission error, and what named physics makes of them."""

import numpy as np

from reproduce import rig
from reproduce.claim import LITERATURE, NOT_TESTABLE, REPRODUCED, Finding, Number, held, states
from reproduce.context import REAL_RV, RV, Context, amplitude
from reproduce.prototypes import part_errors, peak_to_peak
from reproduce.rig import SUMMARY
from reproduce.stiffness_claims import ERRORS
from rv_plant.gear_stage import total_ratio

SENSES = ("forward", "backward")


def around(value: float, deviation: float) -> tuple[float, float]:
    return value - deviation, value + deviation


@states("L20", LITERATURE, "Fourier series over conditions", "Bauer et al., ICIT 2025, 10.1109/ICIT63637.2025.10965256: RH380-N cycloid drive, 224"
        " conditions fitted, 19 held out, rmse 5.0 and 5.8 arcsec by a quadratic Fourier model; no condition with speed and torque of one sign.")
def fourier(context: Context) -> Finding:
    reducer = context.reducer(REAL_RV)
    full, light = (peak_to_peak(reducer, [*part_errors(reducer, 1), f"output.load_torque={torque}"]) for torque in (167, 42))
    # Radians as the source has them.
    theirs = [float(3600.0 * np.degrees(rad)) for rad in (2.40e-5, 2.82e-5)]
    fitted = [held(f"quadratic Fourier model on conditions left out, {sense}", "arcsec", ours, them, around(ours, spread))
              for sense, ours, them, spread in zip(SENSES, rig.QUADRATIC, theirs, rig.QUADRATIC_SPREAD)]
    return Finding(
        NOT_TESTABLE, "A statistical model of another drive; its data are not public. Ours is the same form on the rig of ratio 81 (64 conditions, 13 of them"
            f" left out; mean absolute, not root mean square; kept from {rig.COMMAND}): zeros that jump from session to session are most of it. What physics"
            " says of the missing conditions: with the load driving, other flanks carry (L19).",
        [*fitted, held("conditions fitted", "1", 51.0, 224.0), held("conditions left out", "1", 13.0, 19.0),
         Number("an RV-20E of good parts, rated torque", "arcsec", full), Number("a quarter of it", "arcsec", light)],
        [("the error depends on the torque", abs(full - light) > 0.1)],
    )  # fmt: skip


@states("L21", LITERATURE, "A rig of ratio 81", "Robotics Comput.-Integr. Manuf. 2025, 102838, 10.1016/j.rcim.2024.102838: transmission error of an RV"
        " reducer of ratio 81 over torque, speed, temperature and both senses, by orders. Best learned models err by 3.9 and 8.6 arcsec on unused conditions,"
        " the best closed form by 6.5 and 7.1; ten orders leave 1.1; order 1 is 61.9 arcsec; the mean's slope 430 to 480 N m/arcmin.")
def rig_of_81(context: Context) -> Finding:
    errors = [held(f"error on unused conditions, {sense}; theirs the best {form}", "arcsec", ours, marks[k], around(ours, spread))
              for form, marks in (("closed form", rig.CLOSED_FORM), ("learned model", rig.LEARNED))
              for k, (sense, ours, spread) in enumerate(zip(SENSES, rig.PHYSICS, rig.PHYSICS_SPREAD))]
    ratio = total_ratio(2.0, 40, 39)
    return Finding(
        NOT_TESTABLE, "Its data have no licence and do not come with this software: examples/rv_reducer_te reads a user's own clone. Figures here are kept"
        f" from {rig.COMMAND} (docs/real_data.md). Order 1 is the encoder off centre. The marks of the closed form are missed by 3.8 and 2.2 arcsec with a"
        " nineteenth of its numbers: zeros of the encoders jump from session to session, and no condition left out has a neighbour of its own session. Ours"
        " of the stiffness is the springs beside the contacts, theirs the whole. What ten orders leave was not read: only orders are in the table.",
        [held("ratio of an RV reducer with 40 pins and planets twice the sun", "1", ratio, 81.0), *errors,
         held("order 1: run-out of the encoder", "arcsec", rig.RUN_OUT, rig.ORDER_1, around(rig.RUN_OUT, rig.RUN_OUT_DEVIATION)),
         held("stiffness beside the contacts; theirs the slope of the mean", "N m/arcmin", rig.SPRINGS, rig.SLOPE, rig.SPRINGS_RANGE),
         held("what ten orders leave of the raw curve", "arcsec", None, 1.1)],
        [("81 is such a ratio", ratio == 81.0), ("order 1 is theirs", abs(rig.RUN_OUT - rig.ORDER_1) <= 0.01 * rig.ORDER_1),
         ("springs in series are stiffer than the whole", rig.SPRINGS_RANGE[0] > rig.SLOPE[1]),
         ("the marks are not reached", all(ours > mark for ours, mark in zip(rig.PHYSICS, rig.CLOSED_FORM)))],
    )  # fmt: skip


@states("L40", LITERATURE, "Compensation of the transmission error", "Robotics Comput.-Integr. Manuf. 2025, 102838, 10.1016/j.rcim.2024.102838, by"
        f" {SUMMARY}: feeding back orders 0, 1 and 39 lowers the rms error in motion by 83.3 % (a robot's profile) and 94.0 % (a cycloid's).")
def compensation(context: Context) -> Finding:
    lowered = [100.0 * (1.0 - after / before) for before, after in zip(rig.NOTHING_FITTED, rig.FITTED)]
    return Finding(
        NOT_TESTABLE, "Nothing was compensated here. What a model could take away is what it foretells: of the mean absolute error on unused conditions named"
        f" physics with 20 numbers takes about as much as their learned orders do in motion. Kept from {rig.COMMAND}.",
        [held(f"error taken away, {sense}; theirs {profile}", "%", ours, theirs)
         for sense, profile, ours, theirs in zip(SENSES, ("a robot's profile", "a cycloid's"), lowered, (83.3, 94.0))],
        [("within eight points", all(abs(ours - theirs) < 8.0 for ours, theirs in zip(lowered, (83.3, 94.0))))],
    )  # fmt: skip


@states("L42", LITERATURE, "Orders of pins and discs", f"Bauer et al., ICIT 2025, 10.1109/ICIT63637.2025.10965256, by {SUMMARY}: of a cycloid drive of 46"
        " pins and 45 lobes orders 46 k from k = 1 on count, orders 45 k from k = 2 on.")
def disc_orders(context: Context) -> Finding:
    throw, ring = (context.output_turn(RV, *ERRORS[what]) for what in ("throw of one eccentric +3 µm", "pin ring 5 µm eccentric"))
    t = context.reducer(RV).topology

    def lowest(turn: np.ndarray, teeth: int, least: float) -> float:
        """First multiple of a number of teeth whose amplitude [arcsec] is worth naming."""
        return float(next(k for k in range(1, 5) if amplitude(turn, k * teeth) > least))

    pins, lobes = lowest(throw, t.pins, 0.5), lowest(ring, t.lobes, 0.5)
    return Finding(
        REPRODUCED, "Two discs half a turn apart cancel what comes once a lobe and add what comes twice; an eccentric of one crank belongs to one disc and does"
            " not cancel.",
        [held("first multiple of the number of pins (error of a crank)", "1", pins, 1.0),
         held("first multiple of the number of lobes (ring off centre)", "1", lobes, 2.0),
         Number("order 39 of a ring off centre", "arcsec", amplitude(ring, t.lobes)), Number("order 78 of it", "arcsec", amplitude(ring, 2 * t.lobes))],
        [("pins from once on", pins == 1.0), ("lobes from twice on", lobes == 2.0)],
    )  # fmt: skip
