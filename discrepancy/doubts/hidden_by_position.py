"""What an unknown position of the input hides: effects that change loops as it does, and how much of each may be in what was named."""

from collections.abc import Sequence

import numpy as np
from scipy.special import ndtri

from discrepancy.campaign.unplaced import REMEDY
from discrepancy.held_names import LOCKED_POSITION
from discrepancy.inference.base_fit.projection import project_out
from discrepancy.inference.diagnose import Diagnostician
from discrepancy.inference.refit.refit import Refit
from discrepancy.inference.screening.screen import Columns
from discrepancy.inference.verdict import Diagnosis
from discrepancy.problem import BASE, CHAIN, Candidate, effect_of
from discrepancy.scales import of_parameter
from discrepancy.words.as_told import told_name
from fmu_src.arrays import Floats
from fmu_src.table import Table

# Of what a loop tells of an effect, what at most is left beside a position of those that it hides; so many of them are said.
HIDDEN, MOST_SAID = 0.1, 3


def hidden_by_position(doctor: Diagnostician, found: Diagnosis, tables: Sequence[Table]) -> list[str]:
    """One sentence where a position is named: how much of what looks like it may be in the loops besides; empty where it is not."""
    holding = next((m for m in found.fits.members if LOCKED_POSITION in (effect_of(c.name) for c in m.candidates)), None)
    columns: Columns | None = getattr(doctor, "columns", None)
    if holding is None or columns is None:
        return []
    named = {effect.name for effect in found.effects}
    shares: dict[str, tuple[float, str]] = {}
    for block in columns.blocks:
        candidate = doctor.chosen[block.candidate]
        if len(candidate.amplitudes) == 1 and not candidate.shapes and candidate.part not in (BASE, CHAIN) and candidate.name not in named:
            amount = told(doctor, holding, candidate, columns.values[:, block.columns.start], tables)
            # Small amounts of a clearance change a loop otherwise than usual ones: what is hidden best counts.
            shares[candidate.name] = min(amount, shares.get(candidate.name, amount))
    hidden = sorted((share, text) for share, text in shares.values() if share < HIDDEN)[:MOST_SAID]
    if not hidden:
        return []
    amounts = ", ".join(text for _, text in hidden)
    return [
        f"a loop at one position looks like one with other play: where the input was locked hides {amounts} (95 %), if they are there;"
        f" {REMEDY}"
    ]


def told(doctor: Diagnostician, holding: Refit, candidate: Candidate, column: Floats, tables: Sequence[Table]) -> tuple[float, str]:
    """(share of its information that is left beside what is named, its interval there in words) of an effect whose whitened ``column`` (N,) is per scale."""
    alone, beside = (float(column @ project_out(column[:, None], fit.jacobian, fit.normal)[:, 0]) for fit in (doctor.space.base, holding.fit))
    if not 0.0 < beside < alone:
        return 1.0, ""
    [p] = candidate.amplitudes
    value, half = float(column @ holding.fit.settled) / beside, float(ndtri(0.975)) * doctor.inflation(holding) / beside**0.5
    low, high = (float(np.clip(p.off + p.scale * end, p.lower, p.upper)) for end in (value - half, value + half))
    scale = of_parameter(max(abs(low), abs(high)), p.unit)
    return beside / alone, f"{told_name(p.name, tables)} of {scale.span(low, high, 2)}"
