"""Needle-bearing document: parameters, stiffness, loads of the bearings."""

import math

import numpy as np

from fmu_src.arrays import Floats
from pages.charts import Curve, chart
from reproduce.claim import (
    CONDITIONAL,
    NEEDLE,
    REPRODUCED,
    Finding,
    Number,
    states,
)  # fmt: skip
from reproduce.contacts import Contacts
from reproduce.context import BX, RV, Context
from reproduce.force_claims import ring_moment
from rv_plant.contact import (
    LINE,
    LITERAL,
    PALMGREN,
    SI,
    STEP,
    damped_force,
    hertz_half_width,
    hertz_peak_pressure,
    law_constants,
)  # fmt: skip
from rv_plant.gear_stage import total_ratio

RPM = 2.0 * math.pi / 60.0


@states("N01", NEEDLE, "Parameters of the RV20E-121", "z_c = 39, z_p = 40, ratio 121, r_p = 52 mm, e = 0.9 mm, 2,000"
        " rpm in, 167 N m.")
def parameters(context: Context) -> Finding:
    s = context.reducer(RV).starts
    ratio = total_ratio(s["first_stage_ratio"], 40, 39)
    out = s["input_speed"] / ratio
    return Finding(
        REPRODUCED, "They belong together: ratio 121 asks for z2/z1 = 3, the torque is the rated one of an RV-20E.",
        [Number("ratio with z2/z1 = 3", "1", ratio, 121.0, 121.0, 1e-9),
         Number("output speed", "rpm", out / RPM, None, 16.53),
         Number("cranks in the housing", "rpm", -39.0 * out / RPM, None, -644.6, 0.001),
         Number("cranks against the carrier", "rpm", 40.0 * out / RPM, None, 661.2, 0.001),
         Number("K1", "1", s["eccentricity"] * 40 / s["pin_circle_radius"], None, 0.6923, 0.001)],
        [("ratio 121", ratio == 121.0)],
    )  # fmt: skip


@states("N02", NEEDLE, "Radii of the needle bearing", "r_i = 10.25, r_r = 1.5, r_o = 13.25 mm.")
def clearance(context: Context) -> Finding:
    s = context.reducer(RV).starts
    play = s["outer_race_radius"] - s["inner_race_radius"] - 2.0 * s["roller_radius"]
    numbers = [Number("radial clearance from the radii", "µm", 1e6 * play)]
    for text, lag, error in (("0um", 26.5, 0.55), ("2.5um", 51.9, 6.8), ("5um", 75.5, 12.7), ("10um", 120.0, 24.0)):
        found = 3600.0 * np.degrees(context.contacts(RV, f"bearing.clearance={text}").turn["lag"])
        numbers += [Number(f"mean lag at {text.replace('um', ' µm')}", "arcsec", float(found.mean()), None, lag,
                           0.005), Number(f"transmission error at {text.replace('um', ' µm')}, peak to peak",
                                          "arcsec", float(np.ptp(found)), None, error, 0.02)]
    return Finding(
        CONDITIONAL, "The radii close to zero clearance, which no real bearing has; lag and transmission error"
        " depend on it most of all. It has to be an extra parameter.",
        numbers, [("closed to a nanometre", abs(play) < 1e-9),
                  ("ten micrometres quadruple the lag", numbers[7].found > 4.0 * numbers[1].found)],
                  "clearance stated separately (here 2.5 µm, assumed)",
    )  # fmt: skip


@states("N03", NEEDLE, "Contact stiffness", "K_pc = 3.2e8 N/m, K_r = 5.1e8 N/m in F = K d^(10/9).")
def stiffness(context: Context) -> Finding:
    s = context.reducer(RV).starts
    constants = {reading: law_constants(LINE, reading, s["roller_stiffness"], 0.0, 1.5,
                                        s["roller_length"])[0] for reading in (SI, LITERAL)}
    palmgren = law_constants(PALMGREN, SI, 0.0, 0.0, 1.5, s["roller_length"])[0]
    mesh = law_constants(LINE, SI, s["mesh_stiffness"], 0.0, 1.5, s["mesh_width"])[0]
    numbers = [Number("K_r, N/m^(10/9)", "", constants[SI], constants[LITERAL], 1.10e9, 0.005),
               Number("K_pc, N/m^(10/9)", "", mesh, 3.2e8, 6.9e8, 0.005),
               Number("Palmgren for 8 mm, N/m^(10/9)", "", palmgren, None, 1.10e9, 0.005),
               Number("SI over literal", "1", constants[SI] / constants[LITERAL], None, 2.1544, 0.001)]
    found = {}
    for name, audited in ((RV, (382.0, 199.0)), (BX, (1113.0, 581.0))):
        torque = context.reducer(name).starts["load_torque"]
        for _i, reading in enumerate(("SI", "literal")):
            full, half = (float(context.contacts(name, f"contact.stiffness_reading={reading}",
                                                 f"output.load_torque={t!r}").turn["lag"].mean()) for t in (torque,
                                                     0.5 * torque))
            found[name, reading] = 0.5 * torque / (60.0 * math.degrees(full - half))
        numbers.append(Number(f"{name}: stiffness of the second stage, SI", "N m/arcmin", found[name, "SI"], None,
                              audited[0], 0.005))
        numbers.append(Number(f"{name}: the same, literal", "N m/arcmin", None, found[name, "literal"], audited[1],
                              0.005))
    return Finding(
        CONDITIONAL, "A 10/9 law has no stiffness in N/m. Palmgren's constant for 8 mm rollers gives the printed"
        " digits per millimetre (5.12e5 N at 1 mm); read as force at 1 m they are 2.15 times too soft.", numbers,
        [("Palmgren confirms the reading per millimetre", abs(palmgren / constants[SI] - 1.0) < 0.01),
         ("literal is half as stiff", found[RV, "literal"] < 0.6 * found[RV, "SI"])],
        "the digits read as force at 1 mm of penetration",
    )  # fmt: skip


@states("N04", NEEDLE, "Contact damping", "F = K d^(10/9) + C c_c v with a damping tuning factor c_c.")
def damping(context: Context) -> Finding:
    record = context.pair(RV).plant.record()
    k, n = float(record["mesh_constant"][0]), float(record["mesh_exponent"][0])
    c, depth, speed = 300.0, 1e-6, 5e-3
    first, _, _, _ = damped_force(1e-12, speed, k, n, STEP, c, depth, speed)
    leaving, _, _, elastic = damped_force(0.2e-6, -0.4, k, n, STEP, c, depth, speed)
    return Finding(
        CONDITIONAL, "c_c has to rise from 0 to 1 over the first depth, and the sum must not pull: else the force"
        " jumps at touch and turns negative on separation. As printed c_c is a constant.",
        [Number("force at first touch, 5 mm/s, C = 300 N s/m", "N", first, c * speed),
         Number("force while separating at 0.4 m/s, 0.2 µm deep", "N", leaving, elastic - c * 0.4)],
        [("begins at zero", first < 1e-3), ("never pulls", leaving >= 0.0),
         ("printed pulls", elastic - c * 0.4 < 0.0)], "c_c a step in the penetration, force never below zero",
    )  # fmt: skip


@states("N05", NEEDLE, "Hertz half widths and pressure", "b_ir, b_or by (1-nu²)/E of both bodies, p = F/(2 b L_r).")
def half_widths(context: Context) -> Finding:
    s = context.reducer(RV).starts
    force, modulus = 650.0, 0.5 * s["elastic_modulus"] / (1.0 - s["poisson_ratio"] ** 2)
    numbers, means = [], []
    for side, sign, audited in (("inner", 1.0, 1.309), ("outer", -1.0, 1.691)):
        radius = 1.0 / (1.0 / s["roller_radius"] + sign / s[f"{side}_race_radius"])
        line = force / s["roller_length"]
        b, peak = hertz_half_width(line, 1.0 / radius, modulus), hertz_peak_pressure(line, 1.0 / radius, modulus)
        means.append(line / (2.0 * b) / peak)
        numbers += [Number(f"effective radius, {side}", "mm", 1e3 * radius, None, audited, 0.001),
                    Number(f"half width, {side}, 650 N", "µm", 1e6 * b),
                    Number(f"pressure, {side}, 650 N", "MPa", peak / 1e6, line / (2.0 * b) / 1e6)]
    return Finding(
        REPRODUCED, "Right with the effective radii below. The printed p is the mean over the width, which is what"
        " the wear law needs; the peak is 4/pi higher.", numbers,
        [("the printed p is the mean", all(math.isclose(m, math.pi / 4, rel_tol=1e-9) for m in means))],
    )  # fmt: skip


def bearing_loads(contacts: Contacts) -> Floats:
    """Resultant of the rollers [N], (position, disc, crank)."""
    force = contacts.turn["roller_force"]
    cage = contacts.turn["cage_angle"].ravel()
    middle = cage - 0.5 * np.diff(cage).mean()
    n = force.shape[-1]
    angle = middle[:, None] + 2.0 * np.pi * np.arange(n) / n
    return np.asarray(np.abs((force * np.exp(1j * angle)[:, None, None, :]).sum(axis=-1)))


@states("N06", NEEDLE, "Instantaneous centre near the bearing", "The instantaneous centre of the meshing"
        " periodically aligns near the bearing, which momentarily carries a disproportionate share.")
def instantaneous_centre(context: Context) -> Finding:
    s = context.reducer(RV).starts
    contacts = context.contacts(RV)
    loads = bearing_loads(contacts) / 1e3
    pitch, circle = s["eccentricity"] * 40, s["crank_circle_radius"]
    share = 50.0 * (1.0 + pitch / circle), 50.0 * (1.0 - pitch / circle)
    turn = -np.degrees(contacts.turn["crank_angle"].ravel() - contacts.turn["output_angle"].ravel())
    turn = turn - turn[0]
    curves = [Curve(f"disc {d + 1}, crank {c + 1}", turn, loads[:, d, c],
                    dash="solid" if d == 0 else "dash") for d in range(2) for c in range(2)]
    figure = chart("bearing_load", "Load of each needle bearing, RV20E-121-rigid", "New parts, rated torque.", curves,
                   "crank against carrier [°]", "load [kN]", 6, 300, x_axis={"dtick": 60},
                   y_axis={"rangemode": "tozero"})
    resultant = s["load_torque"] * (1.0 - 1.0 / 121) / (2.0 * s["eccentricity"] * 40) / 1e3
    return Finding(
        REPRODUCED, f"The pitch point lies at e z_p = {1e3 * pitch:.0f} mm, the cranks at {1e3 * circle:.0f} mm"
        f" (assumed): when a crank is in line with it, it carries more than the whole force of its disc and the"
        f" other pulls back.",
        [Number("share of the crank in line", "%", share[0], None, 114.0, 0.01),
         Number("share of the other", "%", share[1], None, -14.0, 0.03),
         Number("smallest load over the turn", "kN", float(loads.min()), None, 0.25, 0.15),
         Number("largest load over the turn", "kN", float(loads.max()), None, 2.7),
         Number("pins' force along the eccentricity's normal, per disc", "kN", resultant, None, 2.3)],
        [("swings by more than a factor of five", loads.max() > 5.0 * loads.min()),
         ("the largest exceeds a disc's whole force", loads.max() > resultant)], figures=[figure],
    )  # fmt: skip


@states("N07", NEEDLE, "Torque on the pins", "Cranks as driven bodies (15 coordinates, no sun): torque on the pins"
        " T_load (40/39).")
def pin_torque(context: Context) -> Finding:
    sun = context.contacts(RV)
    couples = context.contacts(RV, "first_stage.ratio=0",
                               f"input.speed={-context.reducer(RV).starts['input_speed'] * 39 / 121!r}rad/s")
    peaks = [float(c.force.max()) for c in (sun, couples)]
    rollers = [float(c.turn["largest_roller_force"].max()) for c in (sun, couples)]
    torque, moments = context.reducer(RV).starts["load_torque"], [ring_moment(c) for c in (sun, couples)]
    return Finding(
        CONDITIONAL, "Without the sun the cranks are turned by couples, and the ring takes T(40/39); with it the"
        " teeth also push the cranks' centres and the ring takes T(1 - 1/121). Both balance power; the difference is"
        " 3.4 % of all pin and roller forces.",
        [Number("torque of the ring", "N m", moments[0], moments[1], torque * (1.0 - 1.0 / 121), 0.005),
         Number("largest pin force", "N", peaks[0], peaks[1], 311.2, 0.005),
         Number("largest pin force by couples", "N", None, peaks[1], 319.9, 0.005),
         Number("largest roller force", "N", rollers[0], rollers[1])],
        [("the ring takes T(40/39) then", math.isclose(moments[1], torque * 40.0 / 39.0, rel_tol=1e-3)),
         ("couples load the pins more", 1.01 < peaks[1] / peaks[0] < 1.05)],
         "cranks driven by pure couples instead of by a sun",
    )  # fmt: skip
