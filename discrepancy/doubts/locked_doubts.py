"""Loops of which nobody says where the input was locked, where that shows: their prediction is a mean over positions."""

from collections import defaultdict
from collections.abc import Hashable, Sequence
from itertools import combinations

import numpy as np

from discrepancy.campaign.amount import readable
from discrepancy.campaign.findings import WARNING, Finding
from discrepancy.campaign.model import Campaign
from discrepancy.campaign.unplaced import QUESTION, REMEDY
from discrepancy.doubts.plausible import thinned
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.defined_samples import defined
from discrepancy.prediction.fineness import fast_noise
from discrepancy.prediction.positions import departures
from discrepancy.problem import Record, is_unplaced
from fmu_src.arrays import Floats
from fmu_src.faults import RunFault
from fmu_src.units import conversion


def locked_doubts(campaign: Campaign) -> list[Finding]:
    """One finding where loops at one position depart from their mean by more than the noise of those measured; nothing without a reducer."""
    loops = [record for record in campaign.records if is_unplaced(record)]
    if campaign.reducer is None or not loops:
        return []
    noise = noise_of(loops)
    # The new reducer's, over the widest of them: a life would take its time, and positions differ much alike after it.
    widest = max(loops, key=lambda record: float(np.ptp(record.axes["torque"])))
    try:
        apart = departures(Bench(campaign.reducer, {}), thinned(defined(widest, campaign)))
    except RunFault:
        # Where the model finds no equilibrium it can say nothing.
        return []
    off = float(np.sqrt(np.mean(apart**2)))
    if not 0.0 < noise < off:
        return []
    arcsec = conversion("rad", "arcsec")[0]
    count = f"{len(loops)} loops" if len(loops) > 1 else f"run {loops[0].name}"
    text = (
        f"{count}: {QUESTION}. The model's loop is the mean over a turn of the cranks; one at one position departs from it"
        f" by {readable(off * arcsec)} arcsec (root mean square, at most {readable(float(np.abs(apart).max()) * arcsec)}), and the noise is"
        f" {readable(noise * arcsec)} arcsec: what is named may be that"
    )
    return [Finding(WARNING, "position of loops", text, REMEDY)]


def noise_of(loops: Sequence[Record]) -> float:
    """The least noise of a value [rad] of any loop: what jumps from sample to sample or is stated, or what repetitions differ by; 0 where nothing tells."""
    alike: dict[Hashable, list[Floats]] = defaultdict(list)
    for record in loops:
        alike[record.condition, len(record.values)].append(np.asarray(record.values, float))
    found = []
    for record in loops:
        runs = alike[record.condition, len(record.values)]
        apart = [float(np.std(a - b)) / np.sqrt(2.0) for a, b in combinations(runs, 2)]
        found.append(max(record.stated_noise or fast_noise(np.asarray(record.values, float)), float(np.median(apart)) if apart else 0.0))
    return min(found)
