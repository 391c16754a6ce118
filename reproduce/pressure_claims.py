"""Tooth-profile document: contact pressure along the tooth."""

import math

import numpy as np

from pages.charts import PHASE, Curve, chart, degrees_axis
from reproduce.claim import CONDITIONAL, CONTRADICTED, TOOTH, Finding, Number, states
from reproduce.contacts import MIDDLES, Contacts
from reproduce.context import BX, RIGID_BEARINGS, RV, Context

MPA = 1e-6


def at(phase: float, values: np.ndarray) -> float:
    """A row over ``MIDDLES`` at a phase [deg]."""
    return float(np.interp(phase, MIDDLES, values))


def share_at(phase: float, contacts: Contacts) -> float:
    """Pressure at a phase over the largest along the flank."""
    return at(phase, contacts.pressure_along) / float(contacts.pressure_along.max())


@states("T17", TOOTH, "Hertz half width and pressure", "p = F/(2 b a_H), a_H = sqrt(4 F rho_eq/(pi b E_eq)).")
def hertz(context: Context) -> Finding:
    contacts = context.contacts(BX)
    g = contacts.geometry
    force, phase = float(contacts.force.max()), 60.0
    width = float(g.half_width([phase], [force])[0])
    p0, mean = float(g.pressure([phase], [force])[0]), force / (2.0 * g.width * width)
    return Finding(
        CONDITIONAL, "The half width is right if E_eq is E* (1/E* the sum of (1 - nu²)/E). F/(2 b a_H) is then the"
        " mean"
        " pressure, pi/4 of the peak; tables of maximum pressure need the peak. E_eq and rho_eq are defined nowhere.",
        [Number("pressure at the largest force, 60° on the tooth", "MPa", MPA * p0, MPA * mean),
         Number("mean over peak pressure", "1", mean / p0, None, math.pi / 4, 1e-3),
         Number("E*", "GPa", g.modulus / 1e9, None, 113.7, 1e-3),
         Number("pressure too low if E_eq is taken as E' = 2E* in the half width", "1", 1.0, math.sqrt(2.0))],
        [("the printed p is the mean", math.isclose(mean / p0, math.pi / 4, rel_tol=1e-6))],
        "E_eq read as E*, p read as the mean pressure",
    )  # fmt: skip


@states("T18", TOOTH, "Where the pressure is largest", "Pressure reaches maximum values near the regions of the"
        " highest pressure angles.")
def largest_pressure(context: Context) -> Finding:
    numbers, grounds, curves = [], [], []
    for name in (BX, RV):
        for label, texts in (("rigid bearings", RIGID_BEARINGS), ("soft bearings", ())):
            contacts = context.contacts(name, *texts)
            g = contacts.geometry
            place = float(MIDDLES[contacts.pressure_along.argmax()])
            numbers.append(Number(f"{name}, {label}: place of the largest pressure", "°", place, g.steepest,
                                  (60.0, 73.0)))
            grounds.append((f"{name}, {label}: well beyond acos K1", place > g.steepest + 8.0))
            curves.append(Curve(f"{name}, {label}", MIDDLES, MPA * contacts.pressure_along,
                                dash="solid" if texts else "dash"))
    g = context.contacts(BX).geometry
    figure = chart("pressure", "Peak pressure along the tooth, new parts", "Hertz peak pressure of the mean force at"
                   " each phase.", curves, PHASE,
                   "p0 [MPa]", 12, 320, [(g.inflection, "inflection, largest α")], degrees_axis())
    return Finding(
        CONTRADICTED, f"The pressure angle is largest at acos K1 = {g.steepest:.1f}°; so is the force. But the flank"
        f" is there nearly"
        " straight: the pressure is largest on the sharper convex flank beyond it. Right for the force with rigid"
        " bearings.",
        numbers, grounds, figures=[figure],
    )  # fmt: skip


@states("T19", TOOTH, "Pressure valley at the inflection", "A distinct pressure valley was observed at the profile"
        " inflection point.")
def valley(context: Context) -> Finding:
    numbers, shares, valleys = [], [], []
    for name in (BX, RV):
        for label, texts in (("rigid bearings", RIGID_BEARINGS), ("soft bearings", ())):
            contacts = context.contacts(name, *texts)
            phase = contacts.geometry.inflection
            share = share_at(phase, contacts)
            before = share_at(phase - 15.0, contacts)
            valleys.append(before > share)
            if texts:
                shares.append(share)
            numbers.append(Number(f"{name}, {label}: pressure at the inflection over the largest", "%",
                                  100.0 * share, None, (72.0, 80.0) if texts else None, 0.01))
            numbers.append(Number(f"{name}, {label}: 15° nearer to the root", "%", 100.0 * before))
    g = context.contacts(BX).geometry
    numbers += [Number("BX-40E-rigid: inflection", "°", g.inflection, None, 40.3, 0.005),
                Number("BX-40E-rigid: largest pressure angle", "°", g.steepest, None, 41.6, 0.005)]
    return Finding(
        CONTRADICTED, "The largest force sits on the inflection (the two phases are a degree apart), and the"
        " pressure rises through it without a"
        " dip. A valley would need the curvature to vanish for the pair, but the pin stays round.", numbers,
        [("no dip: less pressure nearer to the root", not any(valleys)),
         ("still most of the largest pressure", min(shares) > 0.6)],
    )  # fmt: skip


@states("T20", TOOTH, "Flat contact at the inflection", "At the inflection the equivalent radius of curvature"
        " approaches infinity.")
def flat_contact(context: Context) -> Finding:
    g = context.contacts(BX).geometry
    degrees = np.linspace(0.0, 180.0, 181)
    radius = 1e3 / g.curvature(degrees)
    found = 1e3 / float(g.curvature([g.inflection])[0])
    figure = chart("equivalent_radius", "Equivalent radius of flank and pin, BX-40E-rigid", "Dotted: the pin's radius.",
                   [Curve("rho_eq", degrees, radius),
                    Curve("pin radius", degrees[[0, -1]], np.full(2, 1e3 * g.radius), "#98a3af", "dot")], PHASE,
                    "rho_eq [mm]",
                   6, 280, [(g.inflection, "inflection")], degrees_axis(), {"range": [0, 20]})
    return Finding(
        CONTRADICTED, "Only the disc is flat there; flank and pin together have the pin's radius. The widest contact"
        " is at the"
        " root, where the disc is hollow. Right for the radius of the disc alone.",
        [Number("rho_eq at the inflection", "mm", found, None, 1e3 * g.radius, 0.001),
         Number("rho_eq at the root", "mm", float(radius[0]), None, 60.0, 0.05),
         Number("phase of the largest rho_eq", "°", float(degrees[radius.argmax()]))],
        [("rho_eq is the pin's radius", math.isclose(found, 1e3 * g.radius, rel_tol=1e-3)),
         ("largest at the root", radius.argmax() == 0)], figures=[figure],
    )  # fmt: skip


@states("T21", TOOTH, "Table of pressure by zone",
        "Root (high alpha): highest, increase slows; inflection: lowest, minimal change; tip (high alpha): high,"
        " increase accelerates through edge contact.")
def zones(context: Context) -> Finding:
    run = context.life(BX)
    g = run.contacts[0].geometry
    places = {"root (5°)": 5.0, "inflection": g.inflection, "convex flank (65°)": 65.0, "tip (175°)": 175.0}
    over = {label: np.array([MPA * at(phase, c.pressure_along) for c in run.contacts]) for label,
            phase in places.items()}
    numbers = []
    for label, row in over.items():
        numbers += [Number(f"{label}: new", "MPa", row[0]), Number(f"{label}: after 10,000 h", "MPa", row[-1])]
    root, inflection, flank, tip = over.values()
    shown = [0, run.at(500.0), run.at(2000.0), len(run.hours) - 1]
    by_hour = chart("pressure_hours", "Pressure along the tooth over the hours, BX-40E-rigid",
                    "Curvature of the unworn flank.",
                    [Curve(f"{run.hours[i]:,.0f} h", MIDDLES, MPA * run.contacts[i].pressure_along, c) for i,
                     c in zip(shown, ("#a8cbe8", "#4488c2", "#22669f", "#062a4e"))],
                    PHASE, "p0 [MPa]", 6, 320, [(g.inflection, "inflection")], degrees_axis())
    growth = chart("pressure_zones", "The same by zone", "",
                   [Curve(label, run.hours, row, mode="lines+markers") for label, row in over.items()],
                   "operating time [h]", "p0 [MPa]", 6, 320)
    return Finding(
        CONTRADICTED, "Root and tip have the smallest pressure angle (0), hence hardly any force: 'high alpha' there"
        " contradicts F"
        " ~ sin alpha. The highest pressure is on the convex flank and falls as wear unloads it. Edge contact at"
        " root or tip needs"
        " modification errors or impacts that a quasi-static reducer does not have.", numbers,
        [("root below the inflection when new", root[0] < inflection[0]),
         ("tip lowest when new", tip[0] < min(flank[0], inflection[0])),
         ("pressure on the convex flank falls", flank[-1] < flank[0])], figures=[by_hour, growth],
    )  # fmt: skip
