"""Transmission error while the speed changes: bodies in motion, with the load's inertia."""

import math

import numpy as np
from scipy.optimize import brentq

from fmu_src.arrays import Floats
from orchestrator.component import InProcess
from orchestrator.settings import apply
from pages.charts import Curve, chart
from reproduce.claim import CONDITIONAL, LITERATURE, NOT_TESTABLE, Finding, Number, held, states
from reproduce.context import REAL_BX, Context
from reproduce.prototypes import settings_of
from reproduce.rig import SUMMARY
from reproduce.unknowns import span_of
from rv_plant.faults import DYNAMIC
from studies.solve import ARCMIN

STEP, SECONDS, BEGINS = 5e-4, 1.2, 0.35
# Speeds of the input [rpm], the second beyond what it gets to in that time, and how fast it gets there [rad/s2]: orders stay below the load's swing.
SLOW, FAST, ACCELERATION = 300.0, 9000.0, 200.0
# No inertia to speak of, and bounds between which theirs is looked for [kg m2].
NONE, MOST = 0.01, 60.0
XU = "Xu 2025, dynamic transmission accuracy of an RV reducer under variable speed (journal not in what was read), by " + SUMMARY
# Two laws of driving: with 28.2 % more inertia, with 81.8 % more acceleration [arcmin]; increase over constant speed without and with inertia [%].
INERTIA, MORE_INERTIA = ((8.208, 10.732), (9.666, 11.613)), 1.282
QUICKER, MORE_ACCELERATION = ((3.221, 4.347), (3.833, 5.241)), 1.818
WITHOUT, WITH = (6.3, 5.1), (494.3, 599.9)
# Their error at constant speed, which they do not state: 8.208 arcmin is 494.3 % more.
CONSTANT = INERTIA[0][0] / (1.0 + WITH[0] / 100.0)


def error_in_motion(context: Context, inertia: float, acceleration: float, last: float = FAST) -> Floats:
    """Transmission error [arcmin] of an RV-40E of perfect parts under rated torque over ``SECONDS``; the input goes from SLOW towards ``last`` [rpm]."""
    def make() -> Floats:
        reducer = context.reducer(REAL_BX)
        plant = InProcess("plant", reducer.specification("rv_plant"))
        apply(settings_of(reducer, [f"load.inertia={inertia!r}"]), {"plant": plant})
        plant.set("fidelity", DYNAMIC)
        plant.set("input_speed", SLOW * math.pi / 30.0)
        plant.set("input_acceleration", acceleration)
        plant.exit_initialisation()
        count = round(SECONDS / STEP)
        error = np.zeros(count)
        for k in range(count):
            if k == round(BEGINS * count):
                plant.set("input_speed", last * math.pi / 30.0)
            plant.step(k * STEP, STEP)
            error[k] = plant.number("transmission_error") * ARCMIN
        return error

    return context.once(("in motion", inertia, acceleration, last), make)


def swing(context: Context, inertia: float, acceleration: float = ACCELERATION) -> float:
    """Peak to peak [arcmin]."""
    return float(np.ptp(error_in_motion(context, inertia, acceleration)))


def constant(context: Context) -> float:
    """Peak to peak over as long at constant speed [arcmin]."""
    return float(np.ptp(error_in_motion(context, NONE, ACCELERATION, SLOW)))


def inertia_for(context: Context, times: float) -> float:
    """Inertia of the load [kg m2] that makes the error so many times that at constant speed."""
    goal = times * constant(context)
    return float(brentq(lambda inertia: swing(context, inertia) - goal, NONE, MOST, xtol=1e-3))


@states("L17", LITERATURE, "Variable speed and inertia", f"{XU}: 28.2 % more inertia, transmission error 8.208 -> 10.732 and 9.666 -> 11.613 arcmin; 81.8 %"
        " more acceleration, 3.221 -> 4.347 and 3.833 -> 5.241 arcmin (two laws of driving).")
def inertia(context: Context) -> Finding:
    still = constant(context)
    heavy, light = (inertia_for(context, pair[0] / CONSTANT) for pair in (INERTIA[0], QUICKER[0]))
    more = swing(context, MORE_INERTIA * heavy) / swing(context, heavy)
    quicker = swing(context, light, MORE_ACCELERATION * ACCELERATION) / swing(context, light)
    theirs = [span_of(after / before for before, after in pairs) for pairs in (INERTIA, QUICKER)]
    time = 1e3 * STEP * np.arange(round(SECONDS / STEP))
    figure = chart("error_in_motion", "Transmission error of BX-40E while the input gets faster", "Perfect parts, rated torque, bodies in motion.",
                   [Curve(label, time, error_in_motion(context, value, ACCELERATION)) for label, value in
                    (("no load inertia", NONE), (f"{heavy:.3g} kg m²", heavy), (f"{MORE_INERTIA * heavy:.3g} kg m²", MORE_INERTIA * heavy))],
                   "time [ms]", "[arcmin]", 6, 280)  # fmt: skip
    return Finding(
        NOT_TESTABLE, "Their reducer, speeds, laws of driving and inertia are not public. Bodies in motion here (fidelity dynamic), inertia chosen so that"
        " the error grows as much as theirs over constant speed: more of it and more acceleration do more than there. It is windup under the torque that"
        " accelerates the load, and the load's swing on the reducer's spring, which a constant acceleration from one moment on strikes and a smooth law"
        " does not. Errors are smaller here throughout: parts are perfect.",
        [held("growth of the error by 28.2 % more inertia", "1", more, theirs[0]),
         held("growth of the error by 81.8 % more acceleration", "1", quicker, theirs[1]),
         held("error with inertia", "arcmin", swing(context, heavy), INERTIA[0][0]),
         held("error with 28.2 % more", "arcmin", swing(context, MORE_INERTIA * heavy), INERTIA[0][1]),
         held("error in the slower test", "arcmin", swing(context, light), QUICKER[0][0]),
         held("error with 81.8 % more acceleration", "arcmin", swing(context, light, MORE_ACCELERATION * ACCELERATION), QUICKER[0][1]),
         held("error at constant speed (theirs by 8.208 arcmin and 494.3 %)", "arcmin", still, CONSTANT),
         Number("inertia that does it at 200 rad/s² of the input", "kg m²", heavy)],
        [("more inertia, larger error", more > 1.05), ("more acceleration, larger error", quicker > 1.1)], figures=[figure],
    )  # fmt: skip


@states("L37", LITERATURE, "Variable speed without load inertia", f"{XU}: without load inertia variable speed raises the transmission error by 6.3 and 5.1 %,"
        " with it by 494.3 and 599.9 %.")
def without_inertia(context: Context) -> Finding:
    still = constant(context)
    bare = 100.0 * (swing(context, NONE) / still - 1.0)
    arms = {f"{value:g} kg m²": 100.0 * (swing(context, value) / still - 1.0) for value in (5.0, 10.0, 20.0)}
    return Finding(
        CONDITIONAL, "What accelerates the reducer's own parts winds it up by next to nothing, here by a tenth of theirs; a load does, in proportion to its"
        " inertia. Which inertia they had is not public: an arm of the size that an RV-40E moves has 5 to 20 kg m² (assumed).",
        [held("increase without load inertia", "%", bare, (WITHOUT[1], WITHOUT[0])),
         held("increase with a load of 10 kg m²", "%", arms["10 kg m²"], WITH, (arms["5 kg m²"], arms["20 kg m²"]))],
        [("without inertia less than a tenth", 0.0 <= bare < 10.0), ("theirs lies between loads of 5 and 20 kg m²",
            arms["5 kg m²"] < WITH[0] < WITH[1] < arms["20 kg m²"])],
        "a load between 5 and 20 kg m²; without one by a tenth of theirs",
    )  # fmt: skip
