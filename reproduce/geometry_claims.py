"""Tooth-profile document: parameters, profile, curvature."""

import math

import numpy as np

from fmu_src.arrays import Floats, Points
from pages.charts import PHASE, Curve, chart, degrees_axis, picture
from pages.look import Figure
from reproduce import printed_forms as printed
from reproduce.claim import CONDITIONAL, CONTRADICTED, REPRODUCED, TOOTH, Finding, Number, states
from reproduce.context import BX, RV, Context
from rv_plant.geometry import flank_curvature, lobe_point, shortening

MM, UM = 1e3, 1e6


def profile(starts: dict[str, float], phase: Floats, lobes: int = 39) -> Points:
    """The true flank from the kernel [m, complex]."""
    circle, radius, throw = starts["pin_circle_radius"], starts["pin_radius"], starts["eccentricity"]
    k1 = shortening(throw, lobes, circle)
    points = np.array([lobe_point(p, lobes, circle, radius, throw, k1) for p in phase])
    return points[:, 0] + 1j * points[:, 1]


@states("T01", TOOTH, "Short coefficient", "K1 = a Z_p/(R_p + dR_p), in the table 0.7482.")
def short_coefficient(context: Context) -> Finding:
    starts = context.reducer(BX).starts
    k1 = shortening(starts["eccentricity"], 39, starts["pin_circle_radius"])
    return Finding(
        REPRODUCED, "The table's lengths give the table's coefficient, so its a, R_p and Z_p belong together.",
        [Number("K1", "1", k1, 0.7482, 0.7482, 1e-4)], [("K1 rounds to 0.7482", round(k1, 4) == 0.7482)],
    )  # fmt: skip


@states("T02", TOOTH, "Generating circle",
        "The profile is derived from the rolling of a circle of radius r_rp (generating circle radius).")
def generating_circle(context: Context) -> Finding:
    s = context.reducer(BX).starts
    circle, radius, throw = s["pin_circle_radius"], s["pin_radius"], s["eccentricity"]
    rolling, base = circle / 40, circle * 39 / 40
    # A point at the throw from the centre of the rolling circle: the curve of the pin centres.
    psi = np.linspace(0.0, 2.0 * math.pi, 721)
    traced = (base + rolling) * np.exp(1j * psi / 39) - throw * np.exp(1j * psi * (1.0 + base / rolling) / 39)
    true = np.array([lobe_point(p, 39, circle, 0.0, throw, throw * 40 / circle)[:2] for p in psi]) @ [1.0, 1j]
    miss = float(np.abs(traced - true).max())
    return Finding(
        CONTRADICTED, "r_rp is the pin's radius. The rolling circle has R_p/Z_p and rolls on R_p Z_c/Z_p; a circle of"
        " 3 mm would roll off a non-integer number of lobes. Right only if r_rp is read as the pin radius, as the"
        " table does.",
        [Number("rolling circle", "mm", MM * rolling, MM * radius),
         Number("base circle", "mm", MM * base, MM * circle),
         Number("lobes rolled off: base over rolling circle", "1", base / rolling, circle / radius),
         Number("largest distance of the rolled curve from the kernel's", "nm", 1e9 * miss)],
        [("the right circles give the kernel's curve", miss < 1e-12),
         ("the printed circles do not close", abs(circle / radius % 1.0 - 0.5) < 0.45)],
    )  # fmt: skip


@states("T03", TOOTH, "412 N m as input torque", "Table: input torque T_in = 412 N m.")
def input_torque(context: Context) -> Finding:
    reducer = context.reducer(BX)
    contacts = context.contacts(BX)
    torque, speed = reducer.starts["load_torque"], reducer.starts["input_speed"]
    needed = float(contacts.turn["drive_torque"].mean())
    return Finding(
        CONTRADICTED, "412 N m is the rated output torque of an RV-40E. As a torque on the sun it would mean 78 kW"
        " at the"
        " rated speed; what the plant needs at the sun is 121 times less. Read as output torque it is right.",
        [Number("torque at the sun", "N m", needed, torque, torque / 121, 0.01),
         Number("power", "kW", needed * speed / 1e3, torque * speed / 1e3)],
        [("the sun needs T/121", math.isclose(needed, torque / 121, rel_tol=0.01))],
    )  # fmt: skip


@states("T04", TOOTH, "300 rpm as output speed", "Table: output speed n_out = 300 rpm.")
def output_speed(context: Context) -> Finding:
    torque = context.reducer(BX).starts["load_torque"]
    rpm = 2.0 * math.pi / 60.0
    rated = context.reducer(BX).starts["input_speed"] / 121
    return Finding(
        CONTRADICTED, "300 rpm under 412 N m is 12.9 kW from a reducer rated 0.65 kW and permitted 70 rpm out. Right"
        " only"
        " as a speed of the cranks (7.7 rpm out).",
        [Number("output speed", "rpm", rated / rpm, 300.0), Number("output power", "kW", torque * rated / 1e3,
         torque * 300.0 * rpm / 1e3, 0.65, 0.02), Number("output speed if 300 rpm are the cranks'", "rpm",
             300.0 / 39, None, 7.7)],
        [("20 times the rated power", torque * 300.0 * rpm > 15.0 * torque * rated)],
    )  # fmt: skip


@states("T05", TOOTH, "Profile equation, y", "y_i ends with - (r_rp + dR_rp) S^(-1/2) [K1 sin phi_H - sin(phi -"
        " phi_H)].")
def profile_sign(context: Context) -> Finding:
    phase = np.linspace(0.0, 39 * 2.0 * math.pi, 14041)
    numbers, misses = [], {}
    for name, audited in ((BX, 23.8), (RV, 13.0)):
        s = context.reducer(name).starts
        arguments = phase, s["pin_circle_radius"], s["pin_radius"], s["eccentricity"], 40
        true = np.conj(profile(s, phase))
        misses[name] = [float(np.abs(printed.printed_profile(*arguments, sign) - true).max()) for sign in (1.0, -1.0)]
        right, wrong = misses[name]
        numbers += [Number(f"{name}: distance from the envelope with '+' and, printed, with '-'", "mm", MM * right,
                           MM * wrong),
                    Number(f"{name}: the printed form's largest miss", "mm", None, MM * wrong, audited, 0.005)]
    s = context.reducer(BX).starts
    arguments = phase, s["pin_circle_radius"], s["pin_radius"], s["eccentricity"], 40
    curves = [Curve(label, MM * z.real, MM * z.imag, dash=dash, width=1.3) for label, z, dash in (
        ("true envelope", profile(s, phase), "solid"), ("as printed", np.conj(printed.printed_profile(*arguments)),
            "solid"))]
    figure = picture("profile", "BX-40E-rigid disc", "The printed equation against the envelope of the pins.",
                     [Curve(c.label, c.x[::3], c.y[::3], c.colour, c.dash, c.mode, c.width) for c in curves], 12, 430)
    return Finding(
        CONTRADICTED, "With '+' in the last bracket the equation is exact; with the printed '-' the curve leaves the"
        " envelope by up to 2 r_rp/(1 - K1). x_i is right with phi_H = (Z_p/Z_c) phi.", numbers,
        [("'+' is exact", max(m[0] for m in misses.values()) < 1e-12),
         ("'-' misses by millimetres", min(m[1] for m in misses.values()) > 5e-3)], figures=[figure],
    )  # fmt: skip


@states("T06", TOOTH, "phi_H per tooth", "phi_iH = 2 pi (i - 1)/Z_c, phi is the input crank angle.")
def profile_parameter(context: Context) -> Finding:
    s = context.reducer(BX).starts
    throw, circle = s["eccentricity"], s["pin_circle_radius"]
    phase = np.linspace(0.0, 2.0 * math.pi, 721)
    # With a constant phi_H (tooth 1: 0) only phi runs: nearly a circle about (-a, 0).
    root = printed.root_s(phase, 40 * throw / circle)
    stuck = circle * np.exp(1j * phase) - throw
    stuck = stuck + s["pin_radius"] / root * (40 * throw / circle - np.cos(phase) + 1j * np.sin(phase))
    ripple = float(np.ptp(np.abs(stuck + throw)))
    lobe = float(np.ptp(np.abs(profile(s, phase))))
    turns = np.sum(np.diff(np.sign(np.diff(np.abs(stuck)))) != 0)
    return Finding(
        CONTRADICTED, "With a constant phi_H the equation draws one bulge per turn instead of 39 lobes. The profile"
        " needs"
        " phi_H = (Z_p/Z_c) phi; 2 pi (i - 1)/Z_c is right only as an added tooth shift, and a pin stands at 2 pi (i"
        " - 1)/Z_p.",
        [Number("extrema of the radius over a turn", "1", 78.0, float(turns + 1)),
         Number("height of the curve", "mm", MM * lobe, MM * ripple)],
        [("no 39 lobes come out", turns < 10), ("the true lobe is 2 a high",
                                                math.isclose(lobe, 2 * throw, rel_tol=0.02))],
    )  # fmt: skip


@states("T07", TOOTH, "Wear as a change of R_p and r_rp",
        "Wear of disc (dR_p) and pin (dR_rp) modifies the profile through R_p + dR_p cos alpha and r_rp + dR_rp.")
def wear_in_profile(context: Context) -> Finding:
    s = context.reducer(BX).starts
    circle, radius, throw = s["pin_circle_radius"], s["pin_radius"], s["eccentricity"]
    degrees = np.linspace(0.0, 180.0, 181)
    phase, depth = np.radians(degrees), 10e-6
    rows = np.array([lobe_point(p, 39, circle, radius, throw, throw * 40 / circle) for p in phase])
    normal = np.conj(rows[:, 2] + 1j * rows[:, 3])
    new = printed.printed_profile(phase, circle, radius, throw, 40, 1.0)

    def outward(disc_change: float, pin_change: float) -> Floats:
        moved = printed.printed_profile(phase, circle, radius, throw, 40, 1.0, disc_change, pin_change) - new
        return np.asarray((moved * np.conj(normal)).real)

    by_disc, by_pin = outward(depth, 0.0), outward(0.0, depth)
    figure = chart("wear_in_profile", "What 10 µm put into the printed profile does",
                   "Along the flank's normal; sign of y mended.",
                   [Curve("dR_p = 10 µm (disc)", degrees, UM * by_disc),
                    Curve("dR_rp = 10 µm (pin)", degrees, UM * by_pin),
                    Curve("wear of 10 µm", degrees, np.full(degrees.shape, -10.0), "#98a3af", "dot")],
                   PHASE, "outward displacement [µm]", 12, 260, x_axis=degrees_axis())
    return Finding(
        CONTRADICTED, "These are the formulas of shift and equidistant modification. A worn depth h moves the flank"
        " by -h along"
        " its normal; dR_p moves it outwards or inwards by an amount that depends on the phase, and wear of the pin"
        " does not change the disc at all. Right if dR_p, dR_rp are read as modifications.",
        [Number("displacement for 10 µm on the disc, largest", "µm", -10.0, UM * float(by_disc.max())),
         Number("the same, smallest", "µm", -10.0, UM * float(by_disc.min())),
         Number("displacement of the disc for 10 µm on the pin", "µm", 0.0, UM * float(by_pin.mean()))],
        [("printed disc wear is not a uniform depth", np.ptp(by_disc) > 0.3 * depth),
         ("printed pin wear takes its depth off the disc", np.allclose(by_pin, -depth, rtol=1e-6))], figures=[figure],
    )  # fmt: skip


@states("T08", TOOTH, "Radius of curvature", "rho_i = R_p S^(3/2)/|K1 (Z_p+1) cos phi - (1 + Z_p K1^2)| + r_rp.")
def curvature(context: Context) -> Finding:
    numbers, grounds, figures = [], [], list[Figure]()
    for name, low, radii in ((BX, 20.0, (2.7, 8.7)), (RV, 14.0, None)):
        contacts = context.contacts(name)
        g = contacts.geometry
        degrees = np.linspace(0.5, 179.5, 359)
        phase = np.radians(degrees)
        true = np.array([1.0 / flank_curvature(p, g.lobes, g.circle, g.radius, g.k1) for p in phase])
        wrong = printed.printed_radius_of_curvature(phase, g.circle, g.radius, g.lobes + 1, g.k1)
        convex = true > 0.0
        # The document has no sign for it: the convex flank enters the pair as convex.
        pair_true, pair_printed = 1.0 / g.radius + 1.0 / true, 1.0 / g.radius + np.where(convex, 1.0, -1.0) / wrong
        low_by = 100.0 * (1.0 - math.sqrt((pair_printed / pair_true)[convex].min()))
        sharp, printed_sharp = MM * true[convex].min(), MM * wrong[convex].min()
        numbers += [
            Number(f"{name}: smallest convex radius", "mm", sharp, None, radii and radii[0]),
            Number(f"{name}: the same, printed", "mm", None, printed_sharp, radii and radii[1]),
            Number(f"{name}: peak pressure too low, at worst", "%", None, low_by, low, 0.06),
        ]
        grounds.append((f"{name}: printed convex radius is 2 r_rp too large",
                        math.isclose(printed_sharp - sharp, 2e3 * g.radius, rel_tol=1e-6)))
        if not figures:
            figures.append(chart("curvature", f"Radius of curvature, {name}", "Convex part: the printed radius is 2 r_rp"
                                 " too large; the concave part is right.",
                                 [Curve("true, |rho|", degrees, MM * np.abs(true)),
                                  Curve("printed", degrees, MM * wrong, dash="dash")],
                                 PHASE, "radius [mm]", 6, 300, [(g.inflection, "inflection")], degrees_axis(),
                                 {"range": [0, 60]}))
    return Finding(
        CONTRADICTED, "The radius needs its sign: a parallel curve adds r_rp to a concave and takes it off a convex"
        " radius."
        " With |...| the concave root is right, the convex flank is 2 r_rp too blunt, and its pressure comes out too"
        " low.",
        numbers, grounds, figures=figures,
    )  # fmt: skip


@states("T09", TOOTH, "Half of the teeth in mesh", "The force is shared by approximately half of the teeth in"
        " contact simultaneously.")
def half_the_teeth(context: Context) -> Finding:
    from reproduce.context import MODIFIED

    ideal = float(context.contacts(BX).turn["loaded_teeth"].mean())
    rv = float(context.contacts(RV).turn["loaded_teeth"].mean())
    modified = float(context.contacts(RV, *MODIFIED).turn["loaded_teeth"].mean())
    return Finding(
        CONDITIONAL, "An ideal profile loads all teeth of one side. With the modification that real discs have, far"
        " fewer touch until wear has fitted them.",
        [Number("BX-40E-rigid, ideal profile: loaded teeth of 40", "1", ideal),
         Number("RV20E-121-rigid, ideal profile", "1", rv, None, 18.4),
         Number("RV20E-121-rigid, 20 µm shift and 13 µm equidistant", "1", modified, None, 7.9)],
        [("about half for the ideal profile", 17.0 < ideal < 21.0),
         ("far fewer for the modified one", modified < 12.0)],
        "ideal profile, without modification or pin errors",
    )  # fmt: skip
