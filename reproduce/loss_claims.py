"""Efficiency, drag and what wears, in catalogue and literature, against the library's reducers."""

import numpy as np

from pages.charts import Curve, chart
from reproduce.claim import CATALOGUE, CONDITIONAL, CONTRADICTED, LITERATURE, NOT_TESTABLE, REPRODUCED, Finding, Number, held, states
from reproduce.context import REAL_BX, REAL_RV, RV, Context
from reproduce.prototypes import loop
from reproduce.unknowns import efficiency_span, loop_spans
from studies.family import STARTING, input_torque
from studies.hysteresis import LOST_MOTION_SHARE

RATED = {REAL_RV: 167.0, REAL_BX: 412.0}
START_UP = {REAL_RV: 75.0, REAL_BX: 85.0}
RATIO, RPM = 121.0, 15.0
SHARES = (0.1, 0.25, 0.5, 0.75, 1.0)


def efficiency(context: Context, name: str, share: float = 1.0, rpm: float = RPM, *texts: str) -> float:
    """[%] at a load over the rated one and an output speed."""
    key = ("efficiency", name, share, rpm, texts)
    load = share * RATED[name]
    return context.once(key, lambda: 100.0 * load / RATIO / input_torque(context.reducer(name), load, rpm, RATIO, *texts))


def losses(context: Context, name: str, share: float = 1.0) -> tuple[float, float]:
    """Range of the efficiency [%] over the ranges of friction and drag."""
    return efficiency_span(context, name, share * RATED[name], RPM, RATIO)


@states("C07", CATALOGUE, "Efficiency of the library's reducers", "80 to 90 % at rated load, 50 to 60 % at a tenth; typical start-up efficiency 75 %"
        " (RV-20E) and 85 % (RV-40E).")
def catalogue_efficiency(context: Context) -> Finding:
    numbers, curves, start = [], [], {}
    for name, typical in START_UP.items():
        over_load = [efficiency(context, name, share) for share in SHARES]
        start[name] = efficiency(context, name, 1.0, STARTING)
        numbers += [held(f"{name}, rated load", "%", over_load[-1], (80.0, 90.0), losses(context, name)),
                    held(f"{name}, a tenth of it", "%", over_load[0], (50.0, 60.0), losses(context, name, 0.1)),
                    held(f"{name}, starting under rated load", "%", start[name], typical)]
        curves.append(Curve(name, 100.0 * np.array(SHARES), np.array(over_load), mode="lines+markers"))
    figure = chart("efficiency", "Efficiency over load at 15 rpm", "", curves, "load [% of rated]", "efficiency [%]", 12, 300)
    return Finding(
        CONDITIONAL, "Friction of mesh and bearings takes a share of the load, seals and grease one that counts at small load. Starting, friction is that"
        " at rest. The two sizes do not differ here as they do in the catalogue.", numbers,
        [("rated load", all(80.0 <= efficiency(context, name) <= 90.0 for name in RATED)),
         ("a tenth of it", all(50.0 <= efficiency(context, name, 0.1) <= 60.0 for name in RATED)),
         ("start-up within 7 points", all(abs(start[name] - typical) < 7.0 for name, typical in START_UP.items()))],
        "friction of the mesh 0.06 (0.10 at rest), bearings 0.003, drag 7 % of the rated input torque", figures=[figure],
    )  # fmt: skip


@states("C09", CATALOGUE, "No-load and starting torque", "No-load torque of RV reducers is 0.1 to 0.6 N m at the input.")
def no_load(context: Context) -> Finding:
    numbers, cold, warm = [], {}, {}
    for name in RATED:
        reducer = context.reducer(name)
        cold[name] = input_torque(reducer, 0.0, RPM, RATIO)
        warm[name] = input_torque(reducer, 0.0, RPM, RATIO, "heat.ambient_temperature=40degC")
        numbers += [held(f"{name}, running at 15 rpm, 20 °C", "N m", cold[name], (0.1, 0.6)), Number(f"{name}, at 40 °C", "N m", warm[name]),
                    Number(f"{name}, starting", "N m", input_torque(reducer, 0.0, STARTING, RATIO))]
    return Finding(
        CONDITIONAL, "BX-40E within what is published, RV20E-121 a little below its lower end, because efficiency at a tenth of the load leaves no more. Of"
        " preload nothing is known.", numbers,
        [("BX-40E within", 0.1 <= cold[REAL_BX] <= 0.6), ("RV20E-121 less than a tenth below the lower end", 0.09 <= cold[REAL_RV] <= 0.6),
         ("less when warm", all(warm[name] < cold[name] for name in RATED))],
        "seals and grease each 3.5 % of the rated input torque",
    )  # fmt: skip


@states("L27", LITERATURE, "A cycloid drive through 300 hours", "Farrell, Holley, Bluethmann, O'Malley 2018 (NASA, Rice University): cycloidal drive for a"
        " rover, peak efficiency 81 %, rising with the torque; substantial burn-in over 129,000 output cycles (7.6 million input cycles) in more than 300 h.")
def rover(context: Context) -> Finding:
    found = [efficiency(context, REAL_RV, share) for share in SHARES]
    travelled = 7.6e6 / (585.0 * 60.0)
    return Finding(
        CONDITIONAL, "Another drive; an RV-20E comes to the same peak and rises in the same way. That efficiency itself runs in is not modelled: friction"
        " here is constant, wear alone runs in.",
        [held("RV20E-121, largest over load", "%", max(found), 81.0, losses(context, REAL_RV)),
         *(Number(f"RV20E-121 at {100 * share:.0f} % of the rated torque", "%", value) for share, value in zip(SHARES, found)),
         held("7.6 million turns of the cranks at rated speed of an RV-40E", "h", travelled, 300.0)],
        [("peak within four points", abs(max(found) - 81.0) < 4.0), ("rises with torque", bool(np.all(np.diff(found) > 0.0)))],
        "after their burn-in",
    )  # fmt: skip


@states("L28", LITERATURE, "A maker's figures for his series", "Nantong Zhenkang ZKRV-20E to ZKRV-450E, table as quoted 2026: efficiency 85 to 95 %,"
        " backlash at most 1 arcmin.")
def another_maker(context: Context) -> Finding:
    found = {name: efficiency(context, name) for name in RATED}
    lost = {name: loop(context.reducer(name)).lost_motion_arcmin for name in RATED}
    best = efficiency(context, REAL_BX, 1.0, RPM, "mesh.friction=0.04", "roller.friction=0.002")
    return Finding(
        CONTRADICTED, "Backlash is as here. Efficiency of 85 % and more wants friction at the lower end of its range; 95 % is out of reach of sliding on"
        " pins, bearings and seals together.",
        [*(held(f"{name}, efficiency at rated"
            " load", "%", value, (85.0, 95.0), losses(context, name)) for name, value in found.items()), Number("BX-40E, friction of mesh and bearings at"
            " their lower ends", "%", best),
         *(held(f"{name}, lost motion", "arcmin", value, (0.0, 1.0), loop_spans(context, name)["lost_motion"]) for name, value in lost.items())],
        [("backlash is met", max(lost.values()) < 1.0), ("95 % is not", best < 92.0), ("85 % is, with little friction", best > 85.0)],
    )  # fmt: skip


@states("L29", LITERATURE, "Where a cycloid drive loses", "Antoniak and Bednarczyk, Machines 2024, 12(5), 345: losses occur at two places, the gearing and"
        " the output mechanism.")
def where_lost(context: Context) -> Finding:
    reducer = context.reducer(REAL_RV)
    off = {"gearing": ("mesh.friction=0", "mesh.friction_excess=0"), "needle bearings of the cranks": ("roller.friction=0",),
           "seals and grease": ("input.seal_torque=0", "input.churning_torque=0")}  # fmt: skip
    whole = input_torque(reducer, 167.0, RPM, RATIO)
    parts = {label: 100.0 * (whole - input_torque(reducer, 167.0, RPM, RATIO, *texts)) / whole for label, texts in off.items()}
    return Finding(
        CONDITIONAL, "At rated load gearing and crank bearings, which are the output mechanism of an RV reducer, take two thirds; seals and grease the"
        " rest, and most of it at small load, which their drive's model leaves out.",
        [Number(label, "% of the input", value) for label, value in parts.items()],
        [("gearing most", parts["gearing"] == max(parts.values())),
         ("both take more than the drag", parts["gearing"] + parts["needle bearings of the cranks"] > parts["seals and grease"])],
        "at rated load",
    )  # fmt: skip


@states("L30", LITERATURE, "Clearance and efficiency", "Appl. Sci. 2022, 12(23), 11917: clearance from the chain of dimensions has a certain influence on"
        " the efficiency of a cycloid pair.")
def clearance(context: Context) -> Finding:
    found = {f"needle clearance {c} µm": efficiency(context, REAL_RV, 1.0, RPM, f"bearing.clearance={c}um") for c in (1, 2, 5)}
    found |= {f"equidistant modification {m} µm": efficiency(context, REAL_RV, 1.0, RPM, f"disc.equidistant_modification={m}um") for m in (5, 13)}
    change = max(found.values()) - min(found.values())
    return Finding(
        REPRODUCED, "A certain influence, and a small one: fewer teeth carry the same torque, where they slide a little less or more.",
        [*(Number(label, "%", value) for label, value in found.items()), Number("largest difference", "points", change)],
        [("there is one", change > 1e-3), ("it is small", change < 2.0)],
    )  # fmt: skip


@states("L32", LITERATURE, "Iron in the grease and growth of backlash", "Kočiško, Baron, Paulišin, Machines 2023, 11(6), 595: iron in the lubricant of"
        " TwinSpin reducers goes with the growth of kinematic backlash, after run-in and after about 1,000 h.")
def iron(context: Context) -> Finding:
    run = context.life(RV)
    lost = np.array(run.lost_motion_arcsec)
    worn = run.figure("disc_flank_um") + run.figure("inner_raceway_um")
    likeness = float(np.corrcoef(worn, lost)[0, 1])
    grown = float(np.interp(1000.0, run.hours, lost) - lost[0])
    return Finding(
        REPRODUCED, "What is worn off and what the output can turn without the input grow together through the whole life.",
        [Number("correlation of wear and lost motion over 10,000 h", "1", likeness), Number("lost motion grown in 1,000 h", "arcsec", grown)],
        [("they go together", likeness > 0.97), ("lost motion grows", grown > 0.0)],
    )  # fmt: skip


@states("L33", LITERATURE, "Temperature of a cycloid reducer", "Lubricants 2025, 13(2), 70: a cycloid reducer's lubricant settles at a temperature that its"
        " losses and its surface decide.")
def temperature(context: Context) -> Finding:
    lost = {name: RATED[name] * RPM * 2.0 * np.pi / 60.0 * (100.0 / efficiency(context, name) - 1.0) for name in RATED}
    area = 2.0 * np.pi * 0.0725 * (0.0725 + 0.065)
    rise = lost[REAL_RV] / (15.0 * area)
    return Finding(
        NOT_TESTABLE, "Their temperatures are of another reducer. The losses are known here; how warm they make it hangs on heat transfer: with 15 W/(m² K)"
        " on the outer surface of an RV-20E (145 mm by 65 mm, assumed) by the last figure, in a robot's arm by less.",
        [*(Number(f"{name}, lost at rated load", "W", float(value)) for name, value in lost.items()), Number("rise of an RV-20E that stands alone", "K",
            float(rise))],
        [("of the size of published rises", 20.0 < rise < 120.0)],
    )  # fmt: skip


@states("L34", LITERATURE, "What lost motion is", "Spinea, catalogue and 'When the motion is lost': angle of the output at ±3 % of the nominal torque on"
        " the centre line of the hysteresis curve, input and case fixed.")
def definition(context: Context) -> Finding:
    found = loop(context.reducer(REAL_RV))
    return Finding(
        REPRODUCED, "The same definition: ±3 % of the rated torque, middle line. Read on the way up alone, friction would go with it.",
        [held("share of the rated torque here", "%", 100.0 * LOST_MOTION_SHARE, 3.0), Number("RV20E-121, middle line", "arcmin", found.lost_motion_arcmin),
         Number("width of its loop at no torque", "arcmin", found.width_arcmin)],
        [("three per cent", LOST_MOTION_SHARE == 0.03), ("the loop is open", found.width_arcmin > 0.1)],
    )  # fmt: skip


@states("L35", LITERATURE, "Wear as the grease degrades", "Padgurskas et al., Lubricants 2025, 13(6), 268: wear at the contacts of cycloidal reducers in"
        " boundary lubrication follows the acid number of the lubricant.")
def acid(context: Context) -> Finding:
    reducer = context.reducer(RV)
    names = [v.path for v in reducer.wear.variables if v.path.startswith("effects.grease_ageing")]
    return Finding(
        NOT_TESTABLE, "Wear that grows as grease ages is an effect of the catalogue (effects.grease_ageing), off where nothing is known of the grease; an"
        " acid number is not among its parameters.", [Number("parameters of that effect in the wear unit", "1", float(len(names)))],
        [("there is one", len(names) > 0)],
    )  # fmt: skip


@states("L36", LITERATURE, "Loads of crank and support bearings", "Lubricants 2026, 14(4), 141, 10.3390/lubricants14040141: static forces of an RV reducer,"
        " discs taken as rigid, bearings of the cranks elastic; wear of turning-arm and support bearings.")
def bearing_loads(context: Context) -> Finding:
    turn = context.contacts(REAL_RV).turn
    force = np.asarray(turn["roller_force"])
    return Finding(
        NOT_TESTABLE, "Its equations are those used here, discs rigid and bearings elastic; its figures are not in what was read. Supports that wear are"
        " missing here (L07).",
        [Number("RV20E-121, largest force on a needle roller", "N", float(force.max())), Number("mean over those that carry", "N",
            float(force[force > 0.0].mean()))],
        [("some rollers carry nothing", bool((force == 0.0).any()))],
    )  # fmt: skip
