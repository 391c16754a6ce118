"""Tooth-profile document: wear of the pins."""

import numpy as np

from pages.charts import Curve, chart
from reproduce.claim import CONDITIONAL, CONTRADICTED, TOOTH, Finding, Number, states
from reproduce.context import BX, RV, STAND, Context, LifeRun

UM = 1e6


@states("T30", TOOTH, "Wear of disc and pin",
        "After 5,000 cycles the disc is worn about an order of magnitude deeper than the harder, stationary pins.")
def disc_and_pin(context: Context) -> Finding:
    numbers, ratios = [], {}
    for name in (BX, RV):
        for label, texts, audited in (("turning pins", (), (0.03, 0.11)), ("standing pins", STAND, (4.0, 6.0))):
            run = context.life(name, *texts) if name == BX or not texts else context.life(name, *texts,
                hours=2000.0, tolerance=0.05)
            for when, hour in (("first jump", 1), ("end", -1)):
                found = ratio_of(run, hour)
                ratios[name, label, when] = found
                numbers.append(Number(f"{name}, {label}, {when}: pin over disc", "1", found, 0.1,
                                      audited if when == "first jump" else None))
    return Finding(
        CONDITIONAL, "Both sides lose the same area. A standing pin takes it on the short arc where its contact"
        " dwells, and wears several times"
        " deeper than the disc. Only pins that turn in their grooves spread it and reach a tenth; the document calls"
        " them stationary.", numbers,
        [("turning pins: about a tenth or less", ratios[BX, "turning pins", "first jump"] < 0.15),
         ("standing pins: deeper than the disc", ratios[BX, "standing pins", "first jump"] > 2.0)],
        f"pins that turn (or standing ones {10 * ratios[BX, 'standing pins', 'first jump']:.0f} times more resistant"
        f" than the disc)",
    )  # fmt: skip


def ratio_of(run: LifeRun, hour: int) -> float:
    """Deepest pin wear over deepest flank wear at a recorded hour."""
    return float(run.figure("pin_um")[hour] / run.figure("disc_flank_um")[hour])


@states("T31", TOOTH, "Wear pattern of the pin", "The wear depth on the pin follows a similar but mirrored pattern.")
def pin_pattern(context: Context) -> Finding:
    run = context.life(BX, *STAND)
    pin = run.life.surfaces[-1]["pin_wear"].mean(axis=(0, 1))
    angle = 180.0 * (np.arange(pin.size) + 0.5) / pin.size - 90.0
    turning = np.degrees(np.arcsin(run.contacts[0].geometry.k1))
    place = abs(float(angle[pin.argmax()]))
    figure = chart("pin_pattern", "Depth on a standing pin, BX-40E-rigid, 10,000 h", "Mean of all pins; 0 faces the ring's"
                   " centre.", [Curve("standing pin", angle, UM * pin)],
                   "angle on the pin [°]", "depth [µm]", 6, 280, [(-turning, "contact turns back"), (turning, "")],
                   {"range": [-90, 90], "dtick": 30})
    return Finding(
        CONTRADICTED, "The contact runs to asin K1 from the pin's inward radial, turns back and dwells there: a"
        " sharp peak at the edge of the contact"
        " area, unlike the flank's broad hump. A turning pin wears evenly. (The edge peak agrees with Lubricants"
        " 2025, 13(8), 362.)",
        [Number("place of the deepest wear on a standing pin", "°", place, None, 48.4, 0.05),
         Number("where the contact turns back", "°", turning, None, 48.4, 0.005)],
        [("deepest where the contact turns back", abs(place - turning) < 3.0)], figures=[figure],
    )  # fmt: skip
