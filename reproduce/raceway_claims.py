"""Needle-bearing document: wear of the raceways over 10,000 h."""

import numpy as np

from fmu_src.arrays import Floats
from orchestrator.component import InProcess
from orchestrator.master import Master
from pages.charts import Curve, chart, polar
from reproduce.claim import (
    CONTRADICTED,
    NEEDLE,
    REPRODUCED,
    Finding,
    Number,
    states,
)  # fmt: skip
from reproduce.context import RV, Context, LifeRun
from studies.meshing_cycle import HOUR
from studies.pair import CONNECTIONS
from studies.wear_figures import SURFACES, wear_figures
from wear_fmu.wear_laws import run_in_factor

COMPUTED, MEASURED = (3.97, 3.11), (12.0, 5.6)
SIDES = ("inner", "outer")
BACK = [link for link in CONNECTIONS if link[0].startswith("wear.")]
FORTH = [link for link in CONNECTIONS if not link[0].startswith("wear.")]


def depths(run: LifeRun) -> tuple[float, float]:
    """Deepest wear of inner and outer raceway at the end [um]."""
    inner, outer = (float(run.figure(f"{side}_raceway_um")[-1]) for side in SIDES)
    return inner, outer


def segmented(context: Context, hours: float = 10_000.0, segments: int = 5) -> list[dict[str, float]]:
    """As the document does it: loads of a segment follow from the wear at its start, which stays as it is.

    Two wear units listen to the plant: one shows the profile of the segment's start, the other wears on.
    """
    def make() -> list[dict[str, float]]:
        pair = context.pair(RV)
        reducer = pair.reducer
        shown, worn = (InProcess(name, reducer.specification("wear_fmu")) for name in ("shown", "wear"))
        units = {"plant": pair.plant, "shown": shown, "wear": worn}
        links = FORTH + [(s, t.replace("wear.", "shown.")) for s,
                         t in FORTH] + [(s.replace("wear.", "shown."), t) for s, t in BACK]
        master = Master(units, links, pair.master.step_size)
        master.initialise()
        shown.set("acceleration", 0.0)
        steps = reducer.topology.lobes * pair.positions
        found = []
        for _ in range(segments):
            worn.set("acceleration", hours / segments * HOUR / (steps * master.step_size))
            master.run(steps)
            for name in (*SURFACES, "crank_travel"):
                shown.records[name] = worn.records[name]
            found.append(wear_figures(worn.record()))
        return found

    return context.once(("segmented", hours, segments), make, f"{RV}, {hours:.0f} h in {segments} segments of fixed"
                        f" profile")


@states("N10", NEEDLE, "2,000 h segments", "Wear over 10,000 operating hours, segmented into 2,000-hour intervals,"
        " the profile updated after each.")
def segments(context: Context) -> Finding:
    run, steps = context.life(RV), segmented(context)
    ends = {side: (depths(run)[i], steps[-1][f"{side}_raceway_um"]) for i, side in enumerate(SIDES)}
    audited = {"inner": 3.01, "outer": 1.34}
    numbers = [Number(f"{side} raceway, 10,000 h (printed: 2,000 h segments)", "µm", *ends[side], audited[side],
                      0.03) for side in SIDES]
    flank = float(run.figure("disc_flank_um")[-1]), steps[-1]["disc_flank_um"]
    numbers.append(Number("disc flank (printed: 2,000 h segments)", "µm", *flank))
    curves = []
    for i, side in enumerate(SIDES):
        name = f"{side}_raceway_um"
        curves.append(Curve(f"{side}, error-controlled", run.hours, run.figure(name), ("#d55e00", "#e0a000")[i]))
        curves.append(Curve(f"{side}, 2,000 h segments", np.linspace(0, 10_000, 6),
                            np.array([0.0] + [s[name] for s in steps]), ("#d55e00", "#e0a000")[i], "dot",
                            "lines+markers"))
    figure = chart("segments", "Raceway wear over the hours, RV20E-121-rigid", "Deepest place.", curves,
                   "operating time [h]", "depth [µm]", 6, 300)
    off = {side: 100.0 * (b / a - 1.0) for side, (a, b) in ends.items()}
    return Finding(
        REPRODUCED, f"Segments with a fixed profile change the raceways by {off['inner']:+.1f} % (inner) and"
        f" {off['outer']:+.1f} % (outer): the feedback on"
        f" them is weak. The flank, which unloads itself, changes by {100 * (flank[1] / flank[0] - 1):+.1f} %."
        f" Segments of 2,000 h are good enough for this claim.", numbers,
        [("raceways within five percent", max(abs(v) for v in off.values()) < 5.0)], figures=[figure],
    )  # fmt: skip


@states("N11", NEEDLE, "Where the inner raceway wears", "Deepest in the direction perpendicular to the eccentricity,"
        " on one side only; the opposite side wears minimally.")
def inner_side(context: Context) -> Finding:
    run = context.life(RV)
    new = run.figure("inner_peak_deg")
    wide = context.life(RV, "bearing.clearance=10um", tolerance=0.05)
    row = run.life.surfaces[-1]["inner_race_wear"][0, 0] * 1e6
    angle, opposite = degrees_of(run, row), 100.0 * across(run, row) / row.max()
    figure = polar("inner_race", "Inner raceway, RV20E-121-rigid, 10,000 h", "Depth [µm] over the angle from the eccentric"
                   " direction, the way the cranks turn.", [Curve("inner raceway", *angle, "#d55e00")])
    return Finding(
        REPRODUCED, "The pins' resultant T/(2 e z_c) goes through the pitch point, at right angles to the"
        " eccentricity, and turns with the crank: always the same side.",
        [Number("place of the deepest wear, first jump", "°", float(new[1])),
         Number("after 10,000 h", "°", float(new[-1]), None, (88.0, 94.0), 0.01),
         Number("with 10 µm clearance", "°", float(wide.figure("inner_peak_deg")[-1]), None, (72.0, 108.0)),
         Number("depth opposite over the deepest", "%", opposite)],
        [("within 8° of perpendicular", abs(new[-1] - 90.0) < 8.0), ("opposite side hardly worn", opposite < 5.0)],
        figures=[figure],
    )  # fmt: skip


def degrees_of(run: LifeRun, row: Floats) -> tuple[Floats, Floats]:
    """(angle the way the cranks turn [deg], depth) of a raceway, closed."""
    sense = -1.0 if run.pair.plant.number("crank_speed") < 0.0 else 1.0
    angle = sense * 360.0 * (np.arange(row.size) + 0.5) / row.size
    return np.append(angle, angle[0] + 360.0 * sense)[::2], np.append(row, row[0])[::2]


def across(run: LifeRun, row: Floats) -> float:
    """Depth opposite to the deepest place."""
    return float(np.roll(row, row.size // 2)[row.argmax()])


@states("N12", NEEDLE, "Where the outer raceway wears", "On the side of the hole that is circumferential (clockwise"
        " relative to the wheel's rotation), not along the line to the wheel's centre.")
def outer_side(context: Context) -> Finding:
    run = context.life(RV)
    place = run.figure("outer_peak_deg")
    row = run.life.surfaces[-1]["outer_race_wear"][0, 0] * 1e6
    opposite = 100.0 * across(run, row) / row.max()
    turned = context.life(RV, "output.load_torque=-167", hours=300.0, tolerance=0.1)
    other = float(turned.figure("outer_peak_deg")[-1])
    figure = polar("outer_race", "Outer raceway, RV20E-121-rigid, 10,000 h", "Depth [µm] over the angle from the outward"
                   " radial, the way the cranks turn.", [Curve("outer raceway", *degrees_of(run, row), "#e0a000")])
    return Finding(
        REPRODUCED, "The disc's moment loads its holes with the couple T/(4 a0), fixed in the disc: along the circle"
        " of the holes. With the torque reversed it is the other side.",
        [Number("place of the deepest wear, first jump", "°", float(place[1]), None, (89.5, 90.5), 0.005),
         Number("after 10,000 h", "°", float(place[-1]), None, (89.5, 90.5), 0.005),
         Number("with the torque reversed", "°", other), Number("depth opposite over the deepest", "%", opposite)],
        [("within 4° of the circumference", abs(place[-1] - 90.0) < 4.0),
         ("the other side for the other torque", other < 0.0), ("opposite side hardly worn", opposite < 5.0)],
         figures=[figure],
    )  # fmt: skip


@states("N13", NEEDLE, "Inner wears more than outer", "The inner raceway is the more critically worn component (3.97"
        " against 3.11 µm computed, 12.0 against 5.6 µm measured).")
def inner_over_outer(context: Context) -> Finding:
    run = context.life(RV)
    s = context.reducer(RV).starts
    first = float(run.figure("inner_raceway_um")[1] / run.figure("outer_raceway_um")[1])
    passes = s["outer_race_radius"] / s["inner_race_radius"]
    radii = [1.0 / (1.0 / s["roller_radius"] + sign / s[f"{side}_race_radius"]) for side,
             sign in zip(SIDES, (1.0, -1.0))]
    ratios = {}
    for label, text, audited in (("0 µm", "bearing.clearance=0um", 2.22), ("10 µm", "bearing.clearance=10um", 1.71),
                                 ("a0 26 mm", "crank.circle_radius=26mm", 1.96),
                                 ("a0 30 mm", "crank.circle_radius=30mm", 2.23)):
        a, b = depths(context.life(RV, text, tolerance=0.05) if label == "10 µm" else context.life(RV, text,
            hours=300.0, tolerance=0.1))
        ratios[label] = a / b, audited
    law = (radii[1] / radii[0]) ** (1.219 + 1.589)
    needed = (first / (COMPUTED[0] / COMPUTED[1])) ** (1.0 / 1.589)
    numbers = [Number("inner over outer, new", "1", first, None, 2.09),
               Number("after 10,000 h", "1", depths(run)[0] / depths(run)[1]),
               Number("of it: more passes of rollers", "1", passes, None, 1.293, 0.002),
               Number("of it: radius in the wear law", "1", law, None, (1.691 / 1.309) ** 2.808, 0.005)]
    numbers += [Number(f"with {label}", "1", value, None, audited) for label, (value, audited) in ratios.items()]
    numbers += [Number("source, computed", "1", COMPUTED[0] / COMPUTED[1]),
                Number("source, measured", "1", MEASURED[0] / MEASURED[1]),
                Number("roughness outer over inner that gives 1.28", "1", needed, None, 1.37)]
    return Finding(
        REPRODUCED, "More roller passes on the inner race and its smaller effective radius outweigh its wider spread"
        " of load. The computed ratio is near the measured 2.14; the document's own 1.28 needs a"
        " rougher outer race or a law without the radius.", numbers,
        [("inner deeper in every case", min(v for v, _ in ratios.values()) > 1.0 and first > 1.0),
         ("nearer to the measured ratio than the document's computation", abs(first - 2.143) < abs(1.277 - 2.143))],
    )  # fmt: skip


@states("N14", NEEDLE, "Measured 12.0 and 5.6 µm", "Measured 12.0 µm matches remarkably well; the outer difference"
        " is due to material and run-in wear not captured.")
def measured(context: Context) -> Finding:
    inner, outer = (m / c for m, c in zip(MEASURED, COMPUTED))
    # What a run-in ten times faster with s0 = 500 h adds to 10,000 h, the upper ends of what is known.
    hours = np.linspace(0.0, 10_000.0, 2001)
    factor = np.array([run_in_factor(10.0, h, 500.0) for h in hours])
    gained = float(np.trapezoid(factor, hours) / hours[-1])
    return Finding(
        CONTRADICTED, "Place and shape agree, depths do not: three times (inner) and nearly twice (outer) the"
        " computed ones. Even the strongest plausible running-in explains only half as much.",
        [Number("measured over computed, inner", "1", inner, None, 3.0, 0.02),
         Number("measured over computed, outer", "1", outer, None, 1.8, 0.02),
         Number("run-in 10 x with 500 h over 10,000 h", "1", gained)],
        [("inner off by more than a factor of two", inner > 2.0), ("run-in does not close it", gained < inner)],
    )  # fmt: skip


@states("N15", NEEDLE, "Wear opens the bearing", "Accumulated wear increases the bearing clearance locally, which"
        " alters the contact forces: two-way coupling.")
def coupling(context: Context) -> Finding:
    run = context.life(RV)
    lag, roller = run.figure("mean_lag_arcsec"), run.figure("peak_roller_force_N")
    lost = run.lost_motion_arcsec
    return Finding(
        REPRODUCED, "The carrier falls behind, and the load spreads to rollers beside the worn arc: the largest"
        " roller force falls while the wear deepens.",
        [Number("mean lag, new", "arcsec", lag[0], None, 51.9), Number("after 10,000 h", "arcsec", lag[-1]),
         Number("largest roller force, new", "N", roller[0], None, 852.0),
         Number("after 10,000 h", "N", roller[-1]), Number("lost motion, new", "arcsec", lost[0]),
         Number("after 10,000 h", "arcsec", lost[-1])],
        [("lag grows", lag[-1] > 1.5 * lag[0]), ("roller forces change", abs(roller[-1] / roller[0] - 1.0) > 0.03)],
    )  # fmt: skip
