"""Single samples that stand far off, in words: run, place, size in the usual unit and in times the noise, and the file's row."""

import numpy as np

from discrepancy.campaign.amount import readable
from discrepancy.campaign.model import Campaign
from discrepancy.campaign.quantities import QUANTITIES, VALUE
from discrepancy.outlying_samples import OutlyingSamples
from fmu_src.units import conversion

REMEDY = "left out of fit, errors, key figures and axes of charts; look for the cause at the instrument"
# Axes that say where a sample is, the plainest first, and the unit in which benches read them.
PLACES = {"angle": "deg", "torque": "N.m", "time": "s", "depth_angle": "deg", "hours": "h"}
# Samples of a run whose places are named.
MOST_NAMED = 3


def words_of(found: OutlyingSamples, campaign: Campaign) -> str:
    """``run te_2: 1 of 2,808 samples stands 440 times the noise off, by 181 arcsec at 153.8 deg (sample 1,201; te_2.csv, column e [arcsec])``."""
    usual = QUANTITIES[found.quantity].usual_unit
    factor, count, times = conversion(found.unit, usual)[0], len(found.rows), [readable(t) for t in (found.times[-1], found.times[0])]
    unit = "" if usual == "1" else f" {usual}"
    sizes = times[1] if times[0] == times[1] else f"{times[0]} to {times[1]}"
    named = [f"by {readable(factor * off)}{unit}{place_of(found, row, campaign)} (sample {row + 1:,})" for row, off in zip(found.rows, found.off)]
    some = ", ".join(named[:MOST_NAMED]) + (" ..." if count > MOST_NAMED else "")
    return (
        f"run {found.run}{campaign.place(found.run, VALUE)}: {count} of {found.samples:,} samples {'stand' if count > 1 else 'stands'} {sizes} times"
        f" the noise off {'their' if count > 1 else 'its'} neighbours, {some}"
    )


def place_of(found: OutlyingSamples, row: int, campaign: Campaign) -> str:
    """`` at 153.8 deg``; empty where the run has no axis that says it."""
    axes = next((r.axes for r in campaign.records if r.name == found.run), {})
    name = next((n for n in PLACES if n in axes and np.ptp(axes[n]) > 0.0), "")
    if not name:
        return ""
    source = campaign.source(found.run, name)
    si = "rad" if PLACES[name] == "deg" else "s" if PLACES[name] in ("s", "h") else PLACES[name]
    # As the file counts it, where one was read: its row is looked for there.
    factor, unit = (1.0 / source.factor, source.unit) if source and source.column else (conversion(si, PLACES[name])[0], PLACES[name])
    return f" at {factor * float(axes[name][row]):.6g} {unit}"
