"""Claims judged, one after the other."""

import time
from collections.abc import Callable, Sequence
from dataclasses import replace

from reproduce import (  # noqa: F401  each registers its claims
    bearing_claims,
    coefficient_claims,
    completion_claims,
    flank_wear_claims,
    force_claims,
    geometry_claims,
    individuality_claims,
    literature_claims,
    loading_claims,
    loss_claims,
    motion_claims,
    pin_wear_claims,
    pressure_claims,
    prototype_claims,
    raceway_claims,
    raceway_law_claims,
    recent_claims,
    rig_claims,
    rigidity_claims,
    sliding_claims,
    stiffness_claims,
)  # fmt: skip
from reproduce.claim import REGISTRY, Claim
from reproduce.context import Context
from reproduce.statements import chosen


def run(selected: list[str] | None = None, progress: Callable[[str], None] = lambda _: None, changes: Sequence[str] = ()) -> list[Claim]:
    """Judge the claims of the given ids or id prefixes ("T", "N1"), or all; ``progress`` gets lines of text.

    ``changes``: other numbers of the reducers than the sources', ``name=value``; what the sources' numbers carry need not hold then,
    and no independent check is beside them.
    """
    ids = chosen(selected)
    context = Context(lambda text: progress(f"  run   {text}"), changes)
    claims = []
    for i, name in enumerate(ids, 1):
        begun = time.perf_counter()
        claim = REGISTRY[name](context)
        # The independent solver had the sources' numbers.
        if changes:
            claim = replace(claim, numbers=[replace(number, audited=None) for number in claim.numbers], altered=context.altered,
                            drawn_with=tuple(map(context.altered_in, claim.figures)))  # fmt: skip
        claims.append(claim)
        progress(f"{i:3d}/{len(ids)}  {name}  {claim.title}: {claim.outcome} "
                 f" ({time.perf_counter() - begun:.1f} s)")
    return claims
