"""Hysteresis and lost motion by the way in which the torque is put on, of a reducer with friction."""

from collections.abc import Sequence

import numpy as np

from fmu_src.arrays import Floats
from pages.charts import Curve, chart
from reproduce.claim import CONDITIONAL, LITERATURE, Finding, Number, states
from reproduce.context import REAL_RV, Context
from reproduce.prototypes import loop
from studies.hysteresis import LOST_MOTION_SHARE, one_angle

RATED, ANGLES = 167.0, 8
# Of the rated torque: steps of a bench whose servo resolves little, and of one that resolves enough.
COARSE, FINE = (0.0, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0), tuple(np.linspace(0.0, 1.0, 81))


def loaded(context: Context, shares: Sequence[float], rounds: int = 2) -> tuple[Floats, Floats]:
    """(torque [N m], turning [arcmin]) along 0, +T, 0, -T, 0 in such shares of the rated torque; the last of ``rounds``, over a turn of the cranks."""
    quarter = RATED * np.array(shares)
    way = np.concatenate([quarter, quarter[-2::-1], -quarter[1:], -quarter[-2::-1]])
    turning = np.mean([one_angle(context.reducer(REAL_RV), [], way, k / ANGLES, rounds) for k in range(ANGLES)], axis=0)
    return way, np.asarray(turning)


def lost_motion(way: Floats, turning: Floats) -> float:
    """On the middle line at 3 % of the rated torque, between the samples there are [arcmin]."""
    count = len(way) // 4
    up, down, back, home = (slice(k * count, (k + 1) * count + 1) for k in range(4))

    def at(part: slice, torque: float) -> float:
        order = np.argsort(way[part])
        return float(np.interp(torque, way[part][order], turning[part][order]))

    least = LOST_MOTION_SHARE * RATED
    return abs(0.5 * (at(up, least) + at(down, least)) - 0.5 * (at(back, -least) + at(home, -least)))


@states("L12", LITERATURE, "Hysteresis depends on the way of loading", "Meas. Control 2024, 10.1177/00202940231217338: lost motion by the hysteresis curve"
        " depends on way and rate of loading; large steps of equal torque change the curve's shape.")
def loading_way(context: Context) -> Finding:
    whole = loop(context.reducer(REAL_RV))
    ways = {"81 even torques a quarter": loaded(context, FINE), "steps of a tenth": loaded(context, COARSE),
            "81, first round from rest": loaded(context, FINE, 1), "81, to half the torque only": loaded(context, [0.5 * share for share in FINE])}
    found = {label: lost_motion(*way) for label, way in ways.items()}
    fine, coarse, first, half = found.values()
    figure = chart("ways_of_loading", "Turning against torque by steps, RV20E-121", "Friction included, input held.",
                   [Curve(label, *ways[label], mode="lines+markers" if label == "steps of a tenth" else "lines") for label in list(ways)[:2]],
                   "torque [N m]", "turning [arcmin]", 6, 300)
    return Finding(
        CONDITIONAL, "With friction the loop is open. Steps of a tenth of the rated torque miss the knee at the clearance: read between them, lost motion is"
            " half of what it is. A first round from rest, or a loop to half of the torque, reads the same. Friction here does not depend on the rate, so"
            " that neither does the loop.",
        [*(Number(f"lost motion, {label}", "arcmin", value) for label, value in found.items()), Number("as the command reads"
            " it", "arcmin", whole.lost_motion_arcmin),
         Number("area of the loop", "N m arcmin", whole.loop_area_Nm_arcmin), Number("width of the loop at no torque", "arcmin", whole.width_arcmin)],
        [("the loop is open", whole.width_arcmin > 0.1), ("large steps change it", abs(coarse / fine - 1.0) > 0.02),
         ("first round and smaller loop do not", max(abs(first / fine - 1.0), abs(half / fine - 1.0)) < 0.005)],
        "the steps of the loading; not its rate", figures=[figure],
    )  # fmt: skip
