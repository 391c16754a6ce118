"""Claims judged, one after the other."""

import time
from collections.abc import Callable, Sequence

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
from reproduce.kept import keep, with_sources_numbers
from reproduce.moved import altered
from reproduce.statements import chosen


def run(selected: list[str] | None = None, progress: Callable[[str], None] = lambda _: None, changes: Sequence[str] = ()) -> list[Claim]:
    """Judge the claims of the given ids or id prefixes ("T", "N1"), or all; ``progress`` gets lines of text.

    ``changes``: other numbers of the reducers than the sources', ``name=value``; what the sources' numbers carry need not hold then,
    and no independent check is beside them.
    """
    ids = chosen(selected)
    context = Context(lambda text: progress(f"  run   {text}"), changes)
    # As the sources have it, to see what the changes move; one for all claims that nobody computed before.
    theirs = Context(lambda text: progress(f"  run   {text}, with the sources' numbers, this once"))
    claims = []
    for i, name in enumerate(ids, 1):
        begun = time.perf_counter()
        claim = REGISTRY[name](context)
        if changes:
            claim = altered(claim, context, with_sources_numbers(name, lambda: theirs))
        else:
            keep(claim)
        claims.append(claim)
        progress(f"{i:3d}/{len(ids)}  {name}  {claim.title}: {claim.told} "
                 f" ({time.perf_counter() - begun:.1f} s)")
    return claims
