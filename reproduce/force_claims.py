"""Tooth-profile document: contact law, load sharing, pressure."""

import math

import numpy as np

from fmu_src.arrays import Floats
from pages.charts import Curve, chart
from reproduce import printed_forms as printed
from reproduce.claim import (
    CONDITIONAL,
    CONTRADICTED,
    TOOTH,
    Audited,
    Finding,
    Number,
    states,
)  # fmt: skip
from reproduce.contacts import Contacts
from reproduce.context import BX, MODIFIED, RIGID_BEARINGS, RV, STAND, Context
from rv_plant.contact import contact_force

CASES: dict[str, tuple[tuple[str, ...], Audited]] = {
    "rigid bearings": (RIGID_BEARINGS, 0.995), "soft bearings, no clearance": (("bearing.clearance=0um",), 0.90),
    "soft bearings": ((), 0.70), "clearance 10 µm": (("bearing.clearance=10um",), (0.15, 0.25)),
    "modified profile": (MODIFIED, (0.15, 0.25)),
}  # fmt: skip


def proportionality(contacts: Contacts, exponent: float = 1.0) -> tuple[float, Floats, Floats]:
    """(R2 of F = C sin(alpha)^n over all loaded contacts, sin(alpha), F)."""
    loaded = contacts.force > 0.0
    sine = np.abs(printed.sine_of_pressure_angle(np.radians(contacts.phase[loaded]), contacts.geometry.k1))
    force, x = contacts.force[loaded], sine**exponent
    slope = (x @ force) / (x @ x)
    return 1.0 - float(((force - slope * x) ** 2).sum() / ((force - force.mean()) ** 2).sum()), sine, force


@states("T10", TOOTH, "Force proportional to sin(alpha)",
        "A clear linear relationship was observed: F is proportional to C sin(alpha), a fundamental relationship.")
def sine_law(context: Context) -> Finding:
    numbers, curves, found = [], [], {}
    for label, (texts, audited) in CASES.items():
        contacts = context.contacts(RV, *texts)
        found[label], sine, force = proportionality(contacts)
        numbers.append(Number(f"R² of F = C sin α, {label}", "1", found[label], None, audited, 0.05))
        if label != "soft bearings, no clearance":
            curves.append(Curve(label, sine[::7], force[::7] / force.max(), mode="markers"))
    exact, *_ = proportionality(context.contacts(RV, *RIGID_BEARINGS), 10.0 / 9.0)
    numbers.insert(1, Number("the same against sin(α)^(10/9)", "1", exact, None, 1.0, 0.001))
    figure = chart("sine_law", "Force against sin α, RV20E-121-rigid", "All loaded contacts of a crank turn, over the"
                   " largest force.",
                   curves, "sin α", "F / F max", 12, 320)
    return Finding(
        CONDITIONAL, "With rigid bearings only the disc's turning penetrates the pins and its lever is a Z_c sin α."
        " Real"
        " needle bearings let the disc shift, modification leaves gaps: then the relation is gone. It follows from"
        " compatibility of displacements, not from the moment balance that the document names.", numbers,
        [("holds with rigid bearings", found["rigid bearings"] > 0.99),
         ("fails with 10 µm clearance", found["clearance 10 µm"] < 0.5),
         ("fails with a modified profile", found["modified profile"] < 0.5)],
        "rigid needle bearings without clearance, ideal profile", figures=[figure],
    )  # fmt: skip


@states("T11", TOOTH, "Penetration theta_c r_i - e", "delta_i = theta_c r_i - e_i, contact where it is not negative.")
def linear_penetration(context: Context) -> Finding:
    numbers, ratios = [], {}
    cases: dict[str, tuple[tuple[str, ...], Audited]] = {
        "rigid": (RIGID_BEARINGS, 1.0), "2.5 µm": ((), (0.76, 1.03)), "10 µm": (("bearing.clearance=10um",), 0.54),
    }  # fmt: skip
    for label, (texts, audited) in cases.items():
        contacts = context.contacts(RV, *texts)
        g = contacts.geometry
        phase = np.radians(contacts.phase)
        phase = phase if contacts.force[contacts.phase > 0].sum() > contacts.force[contacts.phase < 0].sum() else -phase
        # About the disc's own centre the levers are z_c/z_p of those about the ring's.
        moment = 0.5 * context.reducer(RV).starts["load_torque"] * (1.0 - 1.0 / 121) * g.lobes / (g.lobes + 1)
        linear = printed.linear_forces(phase, moment, g.eccentricity, g.lobes, g.k1)
        ratio = linear.max(axis=-1) / contacts.force.max(axis=-1)
        ratios[label] = float(linear.max() / contacts.force.max())
        if isinstance(audited, tuple):
            numbers += [Number(f"peak force, linear over true, {label}: smallest over the turn", "1",
                               float(ratio.min()), None, audited[0]),
                        Number("the same, largest over the turn", "1", float(ratio.max()), None, audited[1])]
        else:
            numbers.append(Number(f"peak force, linear over true, {label}", "1", ratios[label], None, audited, 0.04))
    return Finding(
        CONDITIONAL, "The disc also shifts by what its bearings give way: the penetration is that of the true closest"
        f" distance. The linear form understates the peak force, to {ratios['10 µm']:.2f} of it at 10 µm"
        f" clearance.", numbers,
        [("right with rigid bearings", abs(ratios["rigid"] - 1.0) < 0.04),
         ("far off at 10 µm", ratios["10 µm"] < 0.7)],
        "rigid needle bearings without clearance",
    )  # fmt: skip


@states("T12", TOOTH, "Profile error of worn teeth", "e_cp = dR_p - dR_rp.")
def profile_error(context: Context) -> Finding:
    run = context.life(BX, *STAND)
    record = run.pair.wear.record()
    disc, pin = float(run.tooth().max()), float(record["pin_wear"][0].mean(axis=(0, 1)).max())
    error = float(record["mesh_profile_error"][0].max())
    return Finding(
        CONTRADICTED, "Wear of either side opens the gap: e = h_disc + h_pin. With the printed '-' wear of the pin"
        " would press"
        " teeth together, and equally worn sides would show none.",
        [Number("BX-40E-rigid, standing pins, 10,000 h: deepest on the mean tooth", "µm", 1e6 * disc),
         Number("deepest on the mean pin", "µm", 1e6 * pin),
         Number("their gap, if both meet", "µm", 1e6 * (disc + pin), 1e6 * printed.printed_profile_error(disc, pin)),
         Number("largest gap at a contact in the run", "µm", 1e6 * error)],
        [("the printed form makes it negative", printed.printed_profile_error(disc, pin) < 0.0),
         ("the run's gaps exceed the disc's own wear", error > disc)],
    )  # fmt: skip


@states("T13", TOOTH, "Exponent 1.5", "Lankarani-Nikravesh force with n = 1.5, typical of elastic contact.")
def exponent(context: Context) -> Finding:
    line = context.contacts(BX, *RIGID_BEARINGS)
    sphere = context.contacts(BX, "bearing.clearance=0um", "contact.law=lankarani-nikravesh",
                              "roller.stiffness_lankarani=5e8", "numerics.tolerance=1e-6")
    peaks = [float(c.force.max()) for c in (line, sphere)]
    record = context.pair(BX).plant.record()
    k, n = float(record["mesh_constant"][0]), float(record["mesh_exponent"][0])
    half = [contact_force(d, k, n)[0] for d in (0.5e-6, 1e-6)]
    return Finding(
        CONDITIONAL, "The form of the law is right; n = 1.5 is for spheres, a line contact has 1.0 to 1.11, so that"
        " doubling"
        f" the penetration multiplies the force by {half[1] / half[0]:.2f} and not by {2**1.5:.2f}. Its hysteresis"
        f" factor"
        " holds for restitution near 1 and is undefined for a tooth that stays in contact.",
        [Number("force ratio for twice the penetration", "1", half[1] / half[0], 2**1.5, 2 ** (10 / 9), 1e-3),
         Number("peak pin force, rigid bearings", "N", peaks[0], peaks[1])],
        [("n = 1.5 loads the steepest tooth more", peaks[1] > 1.02 * peaks[0])],
        "form of the law, with an exponent of 1.0 to 1.11 for pins",
    )  # fmt: skip


def ring_moment(contacts: Contacts) -> float:
    """Moment of all pin forces about the ring's centre, mean over the turn [N m]; levers a z_p sin(alpha)."""
    g = contacts.geometry
    lever = g.eccentricity * (g.lobes + 1) * np.abs(printed.sine_of_pressure_angle(np.radians(contacts.phase), g.k1))
    sign = np.where(contacts.on_loaded_flank, 1.0, -1.0)
    return float((contacts.force * lever * sign).sum(axis=(1, 2)).mean())


@states("T14", TOOTH, "Moment balance", "The sum of moments from all contact forces balances the input torque on the"
        " cycloid disk.")
def moment_balance(context: Context) -> Finding:
    numbers, grounds = [], []
    for name in (BX, RV):
        torque = context.reducer(name).starts["load_torque"]
        moment = ring_moment(context.contacts(name))
        right = torque * (1.0 - 1.0 / 121)
        numbers.append(Number(f"{name}: moment of the pins on both discs, about the ring's centre", "N m", moment,
                              torque / 121, right, 0.01))
        grounds.append((f"{name}: T (1 - 1/121)", math.isclose(moment, right, rel_tol=0.01)))
    return Finding(
        CONTRADICTED, "The pins hold the housing's share T(1 - 1/121) of the output torque, half of it per disc"
        " (about the disc's own centre Z_c/Z_p of that). The input"
        " torque is 121 times smaller than T. Right if 'input' means what the pins put into the disc.", numbers,
        grounds,
    )  # fmt: skip


@states("T15", TOOTH, "Loaded teeth with wear", "With increasing cycles the number of teeth sharing the load"
        " slightly decreases.")
def teeth_with_wear(context: Context) -> Finding:
    runs = {"BX-40E-rigid, ideal": (context.life(BX), None), "RV20E-121-rigid, ideal": (context.life(RV), (18.4, 19.3)),
            "RV20E-121-rigid, modified": (context.life(RV, *MODIFIED), (7.9, 13.6))}
    numbers, curves, ends = [], [], {}
    for label, (run, audited) in runs.items():
        teeth = run.figure("mean_loaded_teeth")
        ends[label] = teeth[0], teeth[-1]
        numbers += [Number(f"{label}: loaded teeth when new", "1", teeth[0], None, audited and audited[0]),
                    Number(f"{label}: after 10,000 h", "1", teeth[-1], None, audited and audited[1])]
        curves.append(Curve(label, run.hours, teeth, mode="lines+markers"))
    figure = chart("loaded_teeth", "Loaded teeth over the hours", "Mean over a crank turn, per disc.", curves,
                   "operating time [h]", "loaded teeth", 6)
    return Finding(
        CONTRADICTED, "Wear fits modified teeth to the pins, so that more of them touch; on an ideal profile the"
        " number hardly"
        " moves. Right only for the small dip that an ideal profile may show.", numbers,
        [("it grows for the modified profile", ends["RV20E-121-rigid, modified"][1] > 1.3 * ends["RV20E-121-rigid, modified"][0]),
         ("it stays for the ideal one", abs(np.diff(ends["RV20E-121-rigid, ideal"])[0]) < 1.5)], figures=[figure],
    )  # fmt: skip


@states("T16", TOOTH, "Force with wear", "... leading to a gradual increase in the average force on the remaining"
        " contacting teeth.")
def force_with_wear(context: Context) -> Finding:
    numbers, grounds, curves = [], [], []
    for label, name, texts, audited in (("RV20E-121-rigid, ideal", RV, (), (312, 595)),
                                        ("RV20E-121-rigid, modified", RV, MODIFIED, (501, 659)),
                                        ("BX-40E-rigid, ideal", BX, (), None)):
        run = context.life(name, *texts)
        peak = np.array([c.force.max() for c in run.contacts])
        mean = np.array([c.force[c.force > 0].mean() for c in run.contacts])
        numbers += [Number(f"{label}: largest force, new", "N", peak[0], None, audited and audited[0]),
                    Number(f"{label}: largest force, 10,000 h", "N", peak[-1], None, audited and audited[1]),
                    Number(f"{label}: mean force of loaded teeth, change", "%", 100.0 * (mean[-1] / mean[0] - 1.0))]
        grounds.append((f"{label}: the largest force rises", peak[-1] > 1.1 * peak[0]))
        curves.append(Curve(label, run.hours, peak, mode="lines+markers"))
    figure = chart("peak_force", "Largest pin force over the hours", "", curves, "operating time [h]", "force [N]", 6)
    return Finding(
        CONDITIONAL, "The largest force rises, because wear takes load off the middle of the flank and gives it to"
        " its ends"
        " and, per contact, to fewer well-placed teeth. The mean force follows the number of teeth: it falls for"
        " modified ones.",
        numbers, grounds, "the largest force, not the average over the loaded teeth", figures=[figure],
    )  # fmt: skip
