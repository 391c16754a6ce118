"""The rungs as steps of a model file, so that `rvwear ladder model.toml` shows what each effect earned."""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from named_physics import ARCSEC

from discrepancy.extend import BETTER, DID_NOT_HELP, HELPED, NOT_PROVEN

SIGNAL = "transmission_order"
# What ten orders leave of the raw curve [arcsec] (README of the public repository): no model of orders does better.
LEFT_BY_ORDERS = 1.1
KINDS = {"training": False, "held_out": True}


def steps_of(before: Mapping[str, Any], rungs: Sequence[Mapping[str, Any]]) -> tuple[dict[str, Any], ...]:
    """A step a rung, from rows of the answer (errors in arcsec by kind, part of the curve and sense); ``before``: without any rung."""
    steps = []
    for rung in rungs:
        changes = {part: (mean(before["held_out"][part]), mean(rung["held_out"][part])) for part in ("whole", "waves")}
        better = {part: after < BETTER * was for part, (was, after) in changes.items()}
        # What the ladder shows is the whole curve: that has to get better.  Waves alone prove nothing of it, though means jump from session to session.
        verdict = HELPED if better["whole"] else NOT_PROVEN if better["waves"] else DID_NOT_HELP
        whole = {kind: (mean(before[kind]["whole"]), mean(rung[kind]["whole"])) for kind in KINDS}
        steps.append({
            "campaign": "rig of ratio 81", "effects": [rung["effect"]], "verdict": verdict,
            "reason": f"{rung['says']}; on unused conditions " + ", ".join(f"{part} {a:.2f} -> {b:.2f} arcsec" for part, (a, b) in changes.items()),
            **{f"{kind}_{when}": error / LEFT_BY_ORDERS for kind, both in whole.items() for when, error in zip(("before", "after"), both)},
            "signals": [
                {"signal": SIGNAL, "held_out": unused, "unit": "rad", "before": whole[kind][0] * ARCSEC, "after": whole[kind][1] * ARCSEC,
                 "noise_floor": LEFT_BY_ORDERS * ARCSEC}
                for kind, unused in KINDS.items()
            ],
        })  # fmt: skip
        before = rung
    return tuple(steps)


def mean(by_sense: Mapping[str, float]) -> float:
    return float(np.mean(list(by_sense.values())))
