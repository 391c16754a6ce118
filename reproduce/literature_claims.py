"""Published findings beyond the two documents, held against the model of the RV20E-121.

Known from abstracts, conclusions and excerpts only; the reducers are others.
"""

from typing import TypedDict

import numpy as np

from fmu_src.arrays import Floats
from pages.charts import PHASE, Curve, chart, degrees_axis
from reproduce.claim import (
    CONDITIONAL,
    CONTRADICTED,
    LITERATURE,
    NOT_TESTABLE,
    REPRODUCED,
    Finding,
    Number,
    held,
    states,
)  # fmt: skip
from reproduce.context import MODIFIED, RV, STAND, Context, LifeRun, flank_of
from reproduce.flank_wear_claims import hump, humps
from reproduce.sliding_claims import smooth
from reproduce.unknowns import COARSE, TEST_HOURS, span_of, tested_lives

DURABILITY = "Lubricants 2025, 13(8), 362, 10.3390/lubricants13080362"
# The source tells the growth until then and afterwards [h].
EARLY_HOURS = 600.0


class Span(TypedDict):
    hours: float
    tolerance: float


SHORT: Span = {"hours": 300.0, "tolerance": 0.1}


@states("L01", LITERATURE, "Lost motion grows, transmission error does not", f"{DURABILITY}: over 1,550 h the lost motion grew by 12.92 arcsec (30.23 %), the"
        " transmission error stayed about constant.")
def lost_motion(context: Context) -> Finding:
    run = context.life(RV)
    lost, error = np.array(run.lost_motion_arcsec), run.figure("transmission_error_pp_arcsec")

    def at(row: Floats, hours: float) -> float:
        return float(np.interp(hours, run.hours, row))

    grown = at(lost, 1550.0) - lost[0]
    lives = [growth_of(life) for life in tested_lives(context)]
    ends = [span_of(values) for values in zip(*((new, later, 100.0 * later / new) for new, later, _, _ in lives))]
    figure = chart("lost_motion", "Lost motion and transmission error, RV20E-121-rigid", "Torque one way during life; lost motion between +3 and -3 % of it.",
                   [Curve("lost motion", run.hours, lost, mode="lines+markers"),
                    Curve("transmission error of the second stage, peak to peak", run.hours, error, mode="lines+markers")],
                    "operating time [h]", "[arcsec]", 6, 300, [(1550.0, "1,550 h")], y_axis={"rangemode": "tozero"})
    return Finding(
        REPRODUCED, "Raceways open a clearance at right angles to the eccentricity and flanks recede alike on all"
        " teeth: both add to the lag and hardly to its ripple. The amount depends on assumed coefficients.",
        [held("lost motion, new", "arcsec", lost[0], 42.7, ends[0]),
         held("growth in 1,550 h", "arcsec", grown, 12.92, ends[1]),
         held("growth", "%", 100.0 * grown / lost[0], 30.23, ends[2]),
         Number("transmission error of the second stage, new", "arcsec", error[0], None, 6.8),
         Number("at 1,550 h", "arcsec", at(error, 1550.0)), Number("lost motion after 10,000 h", "arcsec", lost[-1])],
        [("lost motion grows by a tenth or more", grown > 0.1 * lost[0]),
         ("transmission error does not grow", at(error, 1550.0) < 1.1 * error[0])], figures=[figure],
    )  # fmt: skip


def growth_of(run: LifeRun) -> tuple[float, float, float, float]:
    """Lost motion of new parts and its growth in the test [arcsec], the share of the first 600 h [%], the rate afterwards [arcsec/h]."""
    new, early, late = np.interp([0.0, EARLY_HOURS, TEST_HOURS], run.hours, run.lost_motion_arcsec)
    return float(new), float(late - new), float(100.0 * (early - new) / (late - new)), float((late - early) / (TEST_HOURS - EARLY_HOURS))


@states("L02", LITERATURE, "Most of it in the first 600 h", f"{DURABILITY}: 10.6 of 12.92 arcsec in the first 600 h, then 0.0024 arcsec/h.")
def early_growth(context: Context) -> Finding:
    lives = [growth_of(life) for life in tested_lives(context)]
    shares, rates = (span_of(one[k] for one in lives) for k in (2, 3))
    usual = growth_of(context.life(RV, *all_run_in(10.0, 200.0), hours=TEST_HOURS, tolerance=COARSE))
    strong = growth_of(context.life(RV, *all_run_in(42.0, 93.0), "wear.mesh_coefficient=2.4e-9", "grease.pressure_viscosity=2.2e-8", hours=TEST_HOURS,
        tolerance=COARSE))
    needed, rate = 100.0 * 10.6 / 12.92, 0.0024
    return Finding(
        CONDITIONAL, "As the library has it early growth comes from the flanks' running-in (300 h, five times faster, assumed) and the raceways grow evenly:"
        " neither share nor rate is reached within the ranges. If all surfaces run in, ten times as fast over 200 h, the most that is usual, they are not"
        " either. Their curve comes out with 42 times over 93 h and slower wear afterwards, which no pin-on-disc test has shown.",
        [held("share of the growth in the first 600 h", "%", lives[0][2], needed, shares),
         held("rate afterwards", "arcsec/h", lives[0][3], rate, rates),
         Number("share, all surfaces run in ten times as fast over 200 h", "%", usual[2]), Number("rate afterwards, so", "arcsec/h", usual[3]),
         held("share, all surfaces 42 times over 93 h", "%", strong[2], needed),
         held("rate afterwards, so", "arcsec/h", strong[3], rate),
         held("growth in 1,550 h, so", "arcsec", strong[1], 12.92)],
        [("more than an even share", lives[0][2] > 100.0 * EARLY_HOURS / TEST_HOURS), ("less than measured over the ranges", shares[1] < needed),
         ("less with running-in as it is usual", usual[2] < needed - 5.0), ("theirs under the condition: share", abs(strong[2] - needed) < 3.0),
         ("rate", abs(strong[3] / rate - 1.0) < 0.15), ("growth", abs(strong[1] / 12.92 - 1.0) < 0.15)],
        "raceways and flanks run in, 42 times as fast as later and over 93 h",
    )  # fmt: skip


def all_run_in(times: float, hours: float) -> tuple[str, ...]:
    """Settings by which every surface wears ``times`` as fast when new, and has run in after some ``hours``."""
    return "wear.run_in_ratio=1", f"effects.running_in.excess={times - 1.0!r}", f"effects.running_in.time={hours * 3600.0!r}"


@states("L03", LITERATURE, "Flank wear on the convex part", f"{DURABILITY}: cycloid wear lies mainly on the convex part of the flank.")
def convex(context: Context) -> Finding:
    numbers, shares = [], []
    for label, texts in (("ideal", ()), ("modified", MODIFIED)):
        run = context.life(RV, *texts)
        g = run.contacts[0].geometry
        phase, depth = flank_of(run.tooth())
        arc = g.travel(phase)
        beyond = phase > g.inflection
        shares.append(100.0 * float((depth * arc)[beyond].sum() / (depth * arc).sum()))
        numbers.append(Number(f"{label}: worn area beyond the inflection, 10,000 h", "%", shares[-1]))
    return Finding(REPRODUCED, "Pressure and sliding are both larger on the convex flank; the hump's peak lies there"
                   " too.", numbers, [("more than half", min(shares) > 50.0)])


@states("L04", LITERATURE, "Pin wear at the edge of its contact", f"{DURABILITY}: pin wear rises sharply at the edge of its contact area.")
def pin_edge(context: Context) -> Finding:
    run = context.life(RV, *STAND, hours=2000.0, tolerance=0.05)
    pin = run.life.surfaces[-1]["pin_wear"].mean(axis=(0, 1))
    angle = 180.0 * (np.arange(pin.size) + 0.5) / pin.size - 90.0
    edge = float(np.degrees(np.arcsin(run.contacts[0].geometry.k1)))
    loaded = np.abs(angle) < edge
    side = np.sign(angle[pin.argmax()])
    middle = float(np.interp(0.5 * side * edge, angle, pin))
    return Finding(
        CONDITIONAL, "The contact turns back at asin K1 on the pin and dwells there. It needs pins that stand;"
        " turning pins wear evenly.",
        [Number("place of the deepest wear", "°", abs(float(angle[pin.argmax()]))),
         Number("edge of the contact area", "°", edge),
         Number("deepest over the depth half-way to the edge", "1", float(pin[loaded].max()) / middle)],
        [("deepest at the edge", abs(abs(float(angle[pin.argmax()])) - edge) < 3.0),
         ("rises sharply", pin.max() > 3.0 * middle)], "pins that stand in their grooves",
    )  # fmt: skip


@states("L05", LITERATURE, "Raceway wear at the ends of the loaded zone", f"{DURABILITY}: raceway wear concentrates where rollers enter and leave the loaded"
        " zone.")
def loaded_zone(context: Context) -> Finding:
    run = context.life(RV)
    numbers, middle = [], []
    for label, hour in (("new", 1), ("10,000 h", -1)):
        row = run.life.surfaces[hour]["outer_race_wear"][0, 0]
        row = smooth(np.roll(row, row.size // 2 - int(row.argmax())))
        zone = np.flatnonzero(row > 0.05 * row.max())
        middle.append(float(row.argmax() - zone[0]) / (zone[-1] - zone[0]))
        numbers.append(Number(f"outer raceway, {label}: width of the worn zone", "°",
                              float(zone[-1] - zone[0]) * 360.0 / row.size))
        numbers.append(Number(f"outer raceway, {label}: place of the deepest in it, 0 entry, 1 exit", "1",
                              middle[-1]))
    return Finding(
        CONTRADICTED, "With a constant slip ratio wear follows the load, which is largest in the middle of the zone."
        " Wear at its ends needs slip that grows where the load is small or the roller is brought up to speed: an"
        " effect not switched on here.",
        numbers, [("deepest inside, not at the ends", all(0.2 < m < 0.8 for m in middle))],
    )  # fmt: skip


def growth_exponent(low: LifeRun, high: LifeRun, name: str, ratio: float) -> float:
    """Exponent of the load in a depth, from two runs."""
    return float(np.log(high.figure(name)[-1] / low.figure(name)[-1]) / np.log(ratio))


@states("L06", LITERATURE, "Clearance grows linearly with load", f"{DURABILITY}: clearance grows about linearly with radial load.")
def with_load(context: Context) -> Finding:
    law = context.life(RV, "output.load_torque=83.5", **SHORT), context.life(RV, **SHORT)
    constant = (context.life(RV, "wear.race_law=constant", "output.load_torque=83.5", **SHORT),
                context.life(RV, "wear.race_law=constant", "output.load_torque=167", **SHORT))
    found = [growth_exponent(*runs, name, 2.0) for runs in (law, constant) for name in ("inner_raceway_um",
        "outer_raceway_um")]
    return Finding(
        CONDITIONAL, "With the law of Janakiraman k itself grows with load^1.219. Only a constant coefficient gives"
        " nearly linear growth: the two publications do not describe the same wear.",
        [Number("exponent of the torque, inner, Janakiraman", "1", found[0]),
         Number("outer, Janakiraman", "1", found[1], None, 1.95),
         Number("inner, constant coefficient", "1", found[2]), Number("outer, constant coefficient", "1", found[3])],
        [("far from linear with Janakiraman", min(found[:2]) > 1.5),
         ("about linear with a constant coefficient", all(0.6 < f < 1.3 for f in found[2:]))],
         "a wear coefficient that does not depend on load",
    )  # fmt: skip


@states("L07", LITERATURE, "Crank supports wear more", f"{DURABILITY}: crank support bearings change their clearance more than turning-arm bearings at equal"
        " load.")
def supports(context: Context) -> Finding:
    compliant = "crank_support_compliance" in context.reducer(RV).plant.by_name
    return Finding(NOT_TESTABLE, "The model has supports that give way, but none that wear.", [],
                   [("supports are compliant at most", compliant)])


@states("L08", LITERATURE, "One hump that grows with load and speed",
        "Proc. IMechE E 2024, 10.1177/09544089241288026: wear first rises, then falls along the flank; depth and"
        " region grow with load and speed, the region more with load.")
def one_hump(context: Context) -> Finding:
    runs = {"rated": context.life(RV, **SHORT), "half torque": context.life(RV, "output.load_torque=83.5", **SHORT),
            "half speed": context.life(RV, "input.speed=1000rpm", **SHORT)}
    numbers, curves, deep, wide = [], [], {}, {}
    for label, run in runs.items():
        phase, depth = flank_of(run.tooth())
        deep[label], wide[label] = 1e6 * hump(run)[1], 2.0 * float((depth > 0.2e-6).sum())
        numbers += [Number(f"{label}: depth in 300 h", "µm", deep[label]),
                    Number(f"{label}: region deeper than 0.2 µm", "°", wide[label])]
        curves.append(Curve(label, phase, 1e6 * depth))
    figure = chart("load_and_speed", "Flank wear in 300 h, RV20E-121-rigid", "", curves, PHASE, "depth [µm]", 6, 280, (),
                   degrees_axis())
    one = all(humps(run) == 1 for run in runs.values())
    return Finding(
        REPRODUCED, "One hump in every case. Torque and speed both deepen it; the region above a given depth follows.", numbers,
        [("one hump", one), ("deeper with load", deep["rated"] > deep["half torque"]),
         ("deeper with speed", deep["rated"] > deep["half speed"]),
         ("wider with both", wide["rated"] > max(wide["half torque"], wide["half speed"])),
         ("wider rather with load", wide["half torque"] < wide["half speed"])], figures=[figure],
    )  # fmt: skip
