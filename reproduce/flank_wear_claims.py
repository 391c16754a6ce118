"""Tooth-profile document: where and how fast flanks and pins wear."""

from typing import Any

import numpy as np

from pages.charts import PHASE, Curve, chart, degrees_axis
from reproduce.claim import CONDITIONAL, CONTRADICTED, REPRODUCED, TOOTH, Finding, Number, states
from reproduce.context import BX, MODIFIED, RV, STAND, Context, LifeRun, flank_of
from reproduce.sliding_claims import smooth

UM = 1e6
PROUD = ("errors.pin.radius[5]=5um",)


def tooth_curve(label: str, run: LifeRun, scale: float = UM, **more: Any) -> Curve:
    """Depth of the mean tooth from root to root."""
    tooth = run.tooth()
    return Curve(label, 360.0 * (np.arange(tooth.size) + 0.5) / tooth.size, scale * tooth, **more)


def humps(run: LifeRun) -> int:
    """Maxima along the whole mean tooth, higher than a twentieth of the deepest."""
    row = smooth(smooth(run.tooth()))
    inner = row[1:-1]
    return int(((inner > row[:-2]) & (inner >= row[2:]) & (inner > 0.05 * row.max())).sum())


def hump(run: LifeRun, hour: int = -1) -> tuple[float, float]:
    """(place [deg], depth [m]) of the deepest wear on the mean tooth."""
    phase, depth = flank_of(run.tooth(hour))
    depth = smooth(smooth(depth))
    return float(phase[depth.argmax()]), float(depth.max())


@states("T26", TOOTH, "Wear profile, inverted W", "The wear depth profile is an irregular, asymmetric inverted W"
        " with two primary peaks on the flanks of the lobe.")
def inverted_w(context: Context) -> Finding:
    way, other = context.life(BX), context.life(BX, "output.load_torque=-412", hours=1000.0, tolerance=0.05)
    backwards = context.life(BX, "input.speed=-1815rpm", hours=1000.0, tolerance=0.05)
    both = context.reversing(BX)
    modified = context.life(RV, *MODIFIED)
    coarse = context.life(BX, positions=24)
    counts = {"torque one way": humps(way), "the other way": humps(other), "input turning backwards, same"
              " torque": humps(backwards), "reversing torque": humps(both),
              "one way, computed with only 24 positions a turn": humps(coarse)}
    first = [run.tooth()[:90].sum() > run.tooth()[90:].sum() for run in (way, other, backwards)]
    curves = [tooth_curve("torque one way, 10,000 h", way), tooth_curve("reversing torque, 10,000 h", both)]
    curves += [tooth_curve("torque the other way, 1,000 h", other, dash="dash"),
               tooth_curve("RV20E-121-rigid, modified, one way, 10,000 h", modified, dash="dot")]
    curves.append(tooth_curve("one way, only 24 positions a turn", coarse, colour="#98a3af",
                              width=1.2))
    g = way.contacts[0].geometry
    figure = chart("wear_profile", "Depth along a whole tooth, BX-40E-rigid where no other reducer is named", "Mean of all teeth; turning pins.", curves,
                   PHASE + ", 360 next root", "depth [µm]", 12, 340,
                   [(g.inflection, "inflection"), (360.0 - g.inflection, "inflection"), (180.0, "tip")],
                   degrees_axis(360.0))
    return Finding(
        CONDITIONAL, "A torque in one direction wears one flank, with one hump. Two humps appear when the torque"
        " reverses, one per flank; the"
        " valley between them is the tip, not an inflection. The sense of the torque decides, not that of the"
        " rotation. A computation with a third of the positions shows one hump as well.",
        [Number(f"humps per tooth, {label}", "1", float(count), 2.0) for label, count in counts.items()],
        [("one hump for one way", counts["torque one way"] == counts["the other way"] == 1),
         ("one also where it is computed coarsely", humps(coarse) == 1),
         ("two for reversing torque", counts["reversing torque"] == 2),
         ("the other torque wears the other flank, backward rotation the same one",
          first[0] != first[1] and first[0] == first[2])],
        "torque that reverses; the two peaks are then the two flanks of a tooth", figures=[figure],
    )  # fmt: skip


@states("T27", TOOTH, "Least wear at the inflection", "The wear depth is minimal at the inflection point: low"
        " contact pressure and near-zero sliding.")
def least_at_inflection(context: Context) -> Finding:
    numbers, shares = [], []
    for name in (BX, RV):
        run = context.life(name)
        g = run.contacts[0].geometry
        for label, hour in (("new", 1), ("10,000 h", -1)):
            phase, depth = flank_of(run.tooth(hour))
            share = float(np.interp(g.inflection, phase, depth) / depth.max())
            shares.append(share)
            numbers.append(Number(f"{name}, {label}: depth at the inflection over the deepest", "%", 100.0 * share,
                                  None, (96.0, 98.0) if label != "new" else None))
    return Finding(
        CONTRADICTED, "The inflection lies inside the hump: force is largest there, and the flank slides as far as"
        " the contact travels."
        " The least wear is at root and tip.", numbers,
        [("more than half of the deepest wear there", min(shares) > 0.5)],
    )  # fmt: skip


@states("T28", TOOTH, "Place of the peaks", "Primary wear peaks in the high-sensitivity zones before and after the"
        " inflection.")
def peak_places(context: Context) -> Finding:
    numbers, figures, places = [], [], {}
    for label, name, texts, start, end in (("BX-40E-rigid, ideal", BX, (), None, None),
                                           ("RV20E-121-rigid, ideal", RV, (), 66.0, 56.0),
                                           ("RV20E-121-rigid, modified", RV, MODIFIED, 55.0, (47.0, 50.0))):
        run = context.life(name, *texts)
        places[label] = hump(run, 1)[0], hump(run)[0]
        numbers += [Number(f"{label}: deepest place in the first {run.hours[1]:.0f} h", "°", places[label][0], None,
                           start, 0.05),
                    Number(f"{label}: after 10,000 h", "°", places[label][1], None, end, 0.05)]
        if texts or name == BX:
            shown = [1, run.at(1000.0), run.at(4000.0), len(run.hours) - 1]
            colours = ("#a8cbe8", "#4488c2", "#22669f", "#062a4e")
            figures.append(chart("hump_" + ("modified" if texts else "ideal"),
                                 f"Growth of the wear profile, {label}", "", [
                Curve(f"{run.hours[i]:,.0f} h", *scaled(flank_of(run.tooth(i))), colour=c) for i,
                c in zip(shown, colours)], PHASE, "depth [µm]", 6, 300,
                [(run.contacts[0].geometry.inflection, "inflection")], degrees_axis()))
    return Finding(
        CONTRADICTED, "One peak, and it lies beyond the inflection, on the convex flank: pressure and sliding both"
        " grow there. With wear it"
        " moves towards the inflection, because load leaves what is worn. Modification confines the contact and"
        " moves it nearer to the inflection.",
        numbers, [("beyond the inflection at first", places["BX-40E-rigid, ideal"][0] > 50.0),
                  ("moves towards the root", all(b < a + 1.0 for a, b in places.values()))], figures=figures,
    )  # fmt: skip


def scaled(row: tuple[np.ndarray, np.ndarray]) -> tuple[np.ndarray, np.ndarray]:
    return row[0], UM * row[1]


@states("T29", TOOTH, "Micro-peaks at root and tip", "Small, sharp wear peaks are observed very close to the root"
        " and tip (edge loading, impacts).")
def micro_peaks(context: Context) -> Finding:
    cases = {"ideal": context.life(RV), "modified": context.life(RV, *MODIFIED),
             "standing pins": context.life(RV, *STAND, hours=2000.0, tolerance=0.05),
             "one pin 5 µm proud": context.life(RV, *PROUD, hours=2000.0, tolerance=0.05)}
    numbers, shares, rising = [], [], []
    curves = []
    for label, run in cases.items():
        phase, depth = flank_of(run.tooth())
        near = max(depth[phase < 6.0].max(), depth[phase > 174.0].max()) / depth.max()
        shares.append(near)
        row = smooth(smooth(depth)) / depth.max()
        ends = (phase < 12.0), (phase > 168.0)
        rising.append(any(peaks_inside(row[end]) for end in ends))
        numbers.append(Number(f"{label}: deepest within 6° of root or tip over the deepest", "%", 100.0 * near))
        curves.append(Curve(label, phase, depth / depth.max()))
    figure = chart("micro_peaks", "Depth over the deepest, RV20E-121-rigid", "Mean tooth, loaded flank.", curves, PHASE,
                   "depth / deepest", 12, 280, (), degrees_axis())
    return Finding(
        CONTRADICTED, "No quasi-static case shows them: the force vanishes at root and tip, as its lever does, and"
        " one proud pin loads the whole"
        " flank alike. They need what is not in the document's equations: edges, chamfers or impacts.", numbers,
        [("root and tip wear little", max(shares) < 0.25), ("no local peak near root or tip", not any(rising))],
        figures=[figure],
    )  # fmt: skip


def peaks_inside(row: np.ndarray) -> bool:
    """Whether a row has a local maximum that is not at its ends."""
    return bool(((row[1:-1] > 1.01 * row[:-2]) & (row[1:-1] > 1.01 * row[2:])).any())


@states("T32", TOOTH, "Falling wear rate", "The wear rate is highest initially and gradually decreases, approaching"
        " a steady state.")
def falling_rate(context: Context) -> Finding:
    variable, constant = context.life(BX), context.life(BX, "wear.mesh_law=constant")
    numbers, curves, falls = [], [], []
    for label, run in (("variable coefficient", variable), ("constant coefficient", constant)):
        rate = np.diff(run.figure("disc_flank_um")) / np.diff(run.hours) * 1e3
        falls.append(rate[-1] / rate[0])
        numbers += [Number(f"{label}: first rate", "nm/h", rate[0]), Number(f"{label}: last rate", "nm/h", rate[-1])]
        curves.append(Curve(label, 0.5 * (run.hours[1:] + run.hours[:-1]), rate, mode="lines+markers"))
    figure = chart("wear_rate", "Rate of the deepest flank wear, BX-40E-rigid", "", curves, "operating time [h]",
                   "rate [nm/h]", 6, 300, y_axis={"rangemode": "tozero"})
    return Finding(
        REPRODUCED, "Twice over: the coefficient runs in, and even with a constant one the load leaves the deepest"
        " place as it wears."
        " The second effect is weaker and slower. Work hardening is not needed for it.", numbers,
        [("falls with running-in", falls[0] < 0.5), ("falls with a constant coefficient too", falls[1] < 0.98)],
        figures=[figure],
    )  # fmt: skip


@states("T33", TOOTH, "Constant against variable coefficient",
        "The constant-kappa model underestimated wear in the peak regions and failed to predict root/tip"
        " micro-peaks.")
def constant_coefficient(context: Context) -> Finding:
    variable, constant = context.life(BX), context.life(BX, "wear.mesh_law=constant")
    deep = [hump(run)[1] for run in (variable, constant)]
    curves = [tooth_curve(label, run, 1.0 / run.tooth().mean()) for label,
              run in (("variable", variable), ("constant, same mean wear", constant))]
    peaks = [run.tooth().max() / run.tooth().mean() for run in (variable, constant)]
    half = [Curve(c.label, c.x[: c.x.size // 2], c.y[: c.x.size // 2], dash=d) for c,
            d in zip(curves, ("solid", "dash"))]
    figure = chart("constant", "Shape of the wear profile, BX-40E-rigid, 10,000 h", "Depth over its mean.", half, PHASE,
                   "depth / mean depth", 6, 280, (), degrees_axis())
    return Finding(
        CONDITIONAL, "Which model wears deeper is a matter of the constant chosen: with the run-in value at the"
        " reference load the constant one does. At equal"
        f" mean wear it is {100 * (1 - peaks[1] / peaks[0]):.1f} % lower in the peak, from the load exponent."
        f" Neither has micro-peaks.",
        [Number("variable: deepest on the mean tooth", "µm", UM * deep[0]),
         Number("constant: deepest", "µm", UM * deep[1]),
         Number("variable: peak over mean depth", "1", peaks[0]),
         Number("constant: peak over mean depth", "1", peaks[1])],
        [("at equal mean wear the constant model's peak is lower", peaks[1] < peaks[0]),
         ("by less than a tenth", abs(peaks[0] / peaks[1] - 1.0) < 0.1)],
        "equal mean wear, and only a few percent; micro-peaks appear in neither model", figures=[figure],
    )  # fmt: skip
