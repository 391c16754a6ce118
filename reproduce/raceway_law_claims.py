"""Needle-bearing document: the raceways' wear coefficient and what its depths determine."""

import numpy as np

from pages.charts import Curve, chart
from reproduce.claim import (
    CONDITIONAL,
    CONTRADICTED,
    NEEDLE,
    NOT_TESTABLE,
    REPRODUCED,
    Finding,
    Number,
    states,
)  # fmt: skip
from reproduce.context import RV, Context
from reproduce.raceway_claims import COMPUTED, MEASURED, SIDES, depths
from wear_fmu.wear_laws import janakiraman, janakiraman_printed

# Exponents of roughness and of the pressure-viscosity coefficient in the law.
ROUGHNESS, VISCOSITY = 1.589, 7.377
SCALES = (1.0, 2.0, 4.0, 7.0)


def law_arguments(context: Context, force: float = 650.0) -> tuple[tuple[float, float, float, float, float], float]:
    """(load per length, radius, roughness, alpha, E') of a roller on the inner raceway, and the hardness."""
    s = context.reducer(RV).starts
    radius = 1.0 / (1.0 / s["roller_radius"] + 1.0 / s["inner_race_radius"])
    modulus = s["elastic_modulus"] / (1.0 - s["poisson_ratio"] ** 2)
    return (force / s["roller_length"], radius, s["roughness"], s["pressure_viscosity"], modulus), s["hardness"]


@states("N08", NEEDLE, "Wear coefficient of the raceways", "k = 3.981e-29 C G S^-1.589 E'.")
def coefficient(context: Context) -> Finding:
    arguments, hardness = law_arguments(context)
    right, wrong = janakiraman(*arguments), janakiraman_printed(*arguments, hardness)
    load, radius, _rough, alpha, modulus = arguments
    roughness = np.geomspace(0.1e-6, 1.6e-6, 60)
    rows = [np.array([law(load, radius, r, alpha, modulus, *more) for r in roughness]) for law,
            more in ((janakiraman, ()), (janakiraman_printed, (hardness,)))]
    figure = chart("janakiraman", "Wear coefficient over roughness", "650 N on a roller of the inner raceway, alpha"
                   " 1.8e-8 1/Pa.", [Curve("restored", 1e6 * roughness, np.log10(rows[0])),
                                     Curve("as printed, over H", 1e6 * roughness, np.log10(rows[1]), dash="dash")],
                   "roughness Rq [µm]", "log10 of k [1/Pa]", 6, 280)
    return Finding(
        CONTRADICTED, "The law of Janakiraman et al. (2014) is k = (3.981e29/E') L^1.219 G^-7.377 S^1.589. The print"
        " lost the exponents of load and material and a sign in each of the other two: units of Pa, a thousand times"
        " too small, less wear for rougher surfaces.",
        [Number("k", "1/Pa", right, wrong, 4.6e-19, 0.03),
         Number("K = k H", "1", right * hardness, wrong * hardness, 3e-9, 0.1),
         Number("printed k, not divided by H", "Pa", None, wrong * hardness, 4e-12, 0.1),
         Number("restored over printed", "1", right / wrong),
         Number("change of k when the roughness doubles", "1", 2.0**ROUGHNESS, 2.0**-ROUGHNESS)],
        [("hundreds of times too small", right / wrong > 300.0),
         ("falls with roughness as printed", rows[1][-1] < rows[1][0]),
         ("rises with roughness", rows[0][-1] > rows[0][0])], figures=[figure],
    )  # fmt: skip


@states("N09", NEEDLE, "mu = k/H", "The dimensionless wear coefficient k is turned into mu = k/H.")
def over_hardness(context: Context) -> Finding:
    arguments, hardness = law_arguments(context)
    k, modulus = janakiraman(*arguments), arguments[-1]
    return Finding(
        CONTRADICTED, "The law carries 1/E' and already gives k in 1/Pa; dh = k p s. Dividing the dimensionless k E'"
        " by the hardness overrates wear by E'/H. dV/ds = K F/H and mu = K/H themselves are right.",
        [Number("mu", "1/Pa", k, k * modulus / hardness),
         Number("too large by E'/H", "1", None, modulus / hardness, 33.0)],
         [("more than an order of magnitude", modulus / hardness > 10.0)],
    )  # fmt: skip


def depths_by_scale(context: Context) -> tuple[np.ndarray, np.ndarray]:
    """(scales of k, depths [um] (scale, side)) after 10,000 h; k is scaled through the roughness."""
    base = context.reducer(RV).starts["roughness"]
    rows = [depths(context.life(RV) if scale == 1.0 else context.life(RV,
        f"wear.roughness={1e6 * base * scale ** (1.0 / ROUGHNESS):.6g}um", tolerance=0.05,
        positions=36)) for scale in SCALES]
    return np.array(SCALES), np.array(rows)


def scale_for(context: Context, side: int, depth: float) -> float:
    """Scale of k that gives a depth [um], between and beyond the runs by powers."""
    scales, found = (np.log(v) for v in depths_by_scale(context))
    row = found[:, side]
    i = int(np.clip(np.searchsorted(row, np.log(depth)) - 1, 0, row.size - 2))
    slope = (scales[i + 1] - scales[i]) / (row[i + 1] - row[i])
    return float(np.exp(scales[i] + slope * (np.log(depth) - row[i])))


def viscosities(context: Context, scale: float, roughness: np.ndarray) -> np.ndarray:
    """alpha [1/Pa] that gives the scale of k at each roughness [m]: alpha ~ (Rq^1.589/scale)^(1/7.377)."""
    s = context.reducer(RV).starts
    return s["pressure_viscosity"] * ((roughness / s["roughness"]) ** ROUGHNESS / scale) ** (1.0 / VISCOSITY)


@states("N16", NEEDLE, "3.97 and 3.11 µm", "Largest computed wear after 10,000 h: inner 3.97 µm, outer 3.11 µm (no"
        " roughness, no pressure-viscosity given).")
def computed_depths(context: Context) -> Finding:
    s = context.reducer(RV).starts
    run = context.life(RV)
    targets = [(f"{side} {depth} µm {what}", i, depth) for what,
               row in (("computed", COMPUTED), ("measured", MEASURED)) for i,
               (side, depth) in enumerate(zip(SIDES, row))]
    roughness = np.linspace(0.15e-6, 1.5e-6, 120)
    numbers = [Number(f"{side} raceway with Rq 0.4 µm, alpha 1.8e-8", "µm", depths(run)[i]) for i,
               side in enumerate(SIDES)]
    curves, scales = [], {}
    for (label, side, depth), colour, dash in zip(targets, ("#d55e00", "#e0a000", "#d55e00", "#e0a000"),
                                                  ("solid", "solid", "dash", "dash")):
        scale = scales[label] = scale_for(context, side, depth)
        numbers.append(Number(f"Rq for {label}, alpha 1.8e-8", "µm",
                              1e6 * s["roughness"] * scale ** (1.0 / ROUGHNESS)))
        numbers.append(Number(f"alpha for {label}, Rq 0.4 µm", "1e-8/Pa",
                              1e8 * float(viscosities(context, scale, np.array([s["roughness"]]))[0])))
        curves.append(Curve(label, 1e6 * roughness, 1e8 * viscosities(context, scale, roughness), colour, dash))
    curves.append(Curve("assumed here", np.array([1e6 * s["roughness"]]), np.array([1e8 * s["pressure_viscosity"]]),
                        "#1d2733", mode="markers"))
    figure = chart("degeneracy", "Roughness and pressure-viscosity that give each depth",
                   "Every point of a line gives the same depth after 10,000 h. Mineral oils have 1.8 to 2.4e-8 1/Pa,"
                   " ground raceways 0.25 to 0.8 µm.", curves,
                   "composite roughness Rq [µm]", "alpha [1e-8 1/Pa]", 12, 360)
    inner, outer = (scales[targets[i][0]] for i in (0, 1))
    return Finding(
        CONDITIONAL, f"Either depth comes out with plausible values, for instance Rq"
        f" {1e6 * s['roughness'] * inner ** (1 / ROUGHNESS):.2f} µm for the inner and"
        f" {1e6 * s['roughness'] * outer ** (1 / ROUGHNESS):.2f} µm for the outer"
        " raceway, but no common pair gives both: the two lines do not meet.", numbers,
        [("plausible roughness for the inner depth", 0.25e-6 < s["roughness"] * inner ** (1 / ROUGHNESS) < 0.8e-6),
         ("no common pair", abs(outer / inner - 1.0) > 0.3)],
        "roughness and pressure-viscosity chosen for it, and for each raceway its own", figures=[figure],
    )  # fmt: skip


@states("N17", NEEDLE, "Two depths as validation", "The measured depths lend strong credence to the dynamic wear"
        " model.")
def validation(context: Context) -> Finding:
    scales, rows = depths_by_scale(context)
    ratio = rows[:, 0] / rows[:, 1]
    inner, outer = (scale_for(context, i, MEASURED[i]) for i in (0, 1))
    alpha = viscosities(context, inner, np.array([0.3e-6, 0.8e-6]))
    figure = chart("depth_scale", "Depths after 10,000 h over the scale of k", "",
                   [Curve(f"{side} raceway", scales, rows[:, i], ("#d55e00", "#e0a000")[i],
                          mode="lines+markers") for i, side in enumerate(SIDES)]
                   + [Curve("ratio inner / outer", scales, ratio, "#98a3af", "dot")], "k over its assumed value",
                   "depth [µm], ratio", 6, 300)
    return Finding(
        NOT_TESTABLE, "Roughness and viscosity enter only through the product Rq^1.589 alpha^-7.377, the same for"
        " both raceways: one number, free over orders of magnitude. Two depths are then one fitted scale and one"
        " ratio, and the ratio"
        " hardly depends on it. What the measurement does test is that ratio, 2.14, and the places"
        f" - and these agree: one scale near {0.5 * (inner + outer):.1f} gives both measured depths within"
        f" {100 * abs(inner / outer - 1):.0f} % of k, at an Rq near 1 µm.",
        [Number("ratio inner/outer at the assumed k", "1", float(ratio[0])),
         Number("ratio at 7 times that", "1", float(ratio[-1])),
         Number("ratio measured", "1", MEASURED[0] / MEASURED[1]),
         Number("scale of k for 12.0 µm inner", "1", inner), Number("scale of k for 5.6 µm outer", "1", outer),
         Number("alpha for 12.0 µm at Rq 0.3 µm", "1e-8/Pa", 1e8 * float(alpha[0])),
         Number("alpha for 12.0 µm at Rq 0.8 µm", "1e-8/Pa", 1e8 * float(alpha[1])),
         Number("k changes, alpha 1.5e-8 instead of 2.4e-8", "1", (2.4 / 1.5) ** VISCOSITY)],
        [("the ratio changes by less than a quarter over a factor of 7", np.ptp(ratio) < 0.25 * ratio.mean()),
         ("one scale gives both measured depths within a tenth", abs(inner / outer - 1.0) < 0.1)], figures=[figure],
    )  # fmt: skip


@states("N18", NEEDLE, "Sliding per pass", "The sliding distance ds is derived from the roller's relative motion,"
        " considering a slip-roll ratio of 0.05.")
def passes(context: Context) -> Finding:
    s = context.reducer(RV).starts
    speed = s["input_speed"] / 121 * 40 * 60.0 / (2.0 * np.pi)
    both = s["inner_race_radius"] + s["outer_race_radius"]
    inner, outer = (16 * speed * s[f"{side}_race_radius"] / both for side in ("outer", "inner"))
    halved = depths(context.life(RV, "wear.inner_slip_ratio=0.025", "wear.outer_slip_ratio=0.025", hours=300.0, tolerance=0.1))
    full = depths(context.life(RV, hours=300.0, tolerance=0.1))
    return Finding(
        REPRODUCED, "A point slides 2 b xi per pass of a roller, so that the depth of a pass is k (F/L_r) xi"
        " whatever the width. Depth goes with xi, which is assumed: it is one more factor of the scale of N17.",
        [Number("passes on the inner raceway", "1/min", inner, None, 5965.0, 0.002),
         Number("passes on the outer raceway", "1/min", outer, None, 4614.0, 0.002),
         Number("depth at half the slip over that at 0.05, inner", "1", halved[0] / full[0])],
        [("depth is proportional to the slip", abs(halved[0] / full[0] - 0.5) < 0.03)],
    )  # fmt: skip
