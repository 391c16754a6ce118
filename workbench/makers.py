"""Which effects make which order: what each effect of the catalogue, one typical size of it, changes in the transmission error."""

from dataclasses import replace
from typing import Any

import numpy as np

from discrepancy.compare import Comparison
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import BASE, ERROR, ORDERS, Candidate
from fmu_src.arrays import Floats
from fmu_src.effect_words import effect_title
from fmu_src.faults import RunFault

# An effect makes an order in which it is at least so strong, of its strongest (assumed), and so many are named, strongest first.
SHARE, MOST = 0.1, 6
# Samples of one turn at which its change is looked at: orders up to a third of them.
SAMPLES = 600


def makers(result: Comparison) -> dict[str, list[dict[str, Any]]]:
    """By order of the output's turn; {} where no transmission error was measured, over the angle or by order."""
    model = result.model
    record = next((r for r in model.records if (r.quantity == ERROR and "angle" in r.axes) or r.quantity == ORDERS), None)
    if record is None:
        return {}
    turn = np.linspace(0.0, 2.0 * np.pi, SAMPLES, endpoint=False)
    even = replace(record, name="one turn", quantity=ERROR, values=np.zeros(SAMPLES), axes={"angle": turn}, far_off=())
    base = model.one(even, model.standing(), rough=True)
    found: dict[str, list[dict[str, Any]]] = {}
    for candidate in model.candidates:
        if candidate.part == BASE:
            continue
        change = changed(model, even, candidate, base)
        strengths = 2.0 * np.abs(np.fft.rfft(change))[: SAMPLES // 3] / SAMPLES
        strengths[0] = 0.0
        strongest = float(strengths.max())
        if strongest < 1e-9 or not np.isfinite(strongest):
            continue
        for order in np.flatnonzero(strengths >= SHARE * strongest):
            found.setdefault(str(order), []).append({
                "name": candidate.name, "title": effect_title(candidate.name), "share": round(float(strengths[order]) / strongest, 3),
            })  # fmt: skip
    return {order: sorted(entries, key=lambda e: -e["share"])[:MOST] for order, entries in found.items()}


def changed(model: PhysicalModel, record: Any, candidate: Candidate, base: Floats) -> Floats:
    """What one typical size of the effect changes in the record; nothing where the reducer finds no equilibrium with it."""
    values = {p.name: p.off + p.scale * (p.sign or 1) for p in candidate.amplitudes}
    shapes = {p.name: p.off for p in candidate.parameters if p.name not in values}
    try:
        return model.one(record, {**model.standing(), **shapes, **values}, rough=True) - base
    except RunFault:
        return np.zeros(len(base))
