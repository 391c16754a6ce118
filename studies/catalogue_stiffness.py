"""A reducer completed so that it is as stiff as its catalogue says: the one number that no rule computes is found by the stiffness test."""

import math
from dataclasses import replace

from fmu_src.faults import InputFault
from orchestrator.settings import parse_setting
from reducers.completion.complete import AS_STIFF, Completion, complete
from reducers.completion.doubts import FREE, stiffness_doubt
from reducers.completion.file import reducer_at
from reducers.completion.given import Given
from reducers.reducer import Reducer
from studies.hysteresis import hysteresis
from studies.secants import size_for

# As catalogues round.
NEAR = 1e-3
# Three come as near.
MOST_STEPS = 12
# Softer ones are none (assumed: a tenth of the softest in catalogues) [N m/arcmin].
LEAST = 0.1


def as_stiff_as(given: Given, stiffness: float) -> Completion:
    """Completed with crank supports that make the torsional stiffness the catalogue's [N m/arcmin]; InputFault where none do."""
    if not LEAST <= stiffness < math.inf:
        raise InputFault(f"--stiffness {stiffness:g} N.m/arcmin: must be {LEAST:g} or more; look at its unit")
    if FREE in given.known:
        raise InputFault(f"--stiffness {stiffness:g} N.m/arcmin and --known {FREE}: each says how soft the crank supports are; keep one")
    by_rules = complete(given)
    number = by_rules.numbers[FREE]
    found = compliance_of(reducer_at(by_rules, {}, "new"), number.value, stiffness)
    completion = complete(replace(given, known={**given.known, FREE: found}))
    source = f"{AS_STIFF}, {stiffness:g} N.m/arcmin"
    doubts = stiffness_doubt(f"{stiffness:g} N.m/arcmin", found, number.low, number.high, number.unit, given.diameter)
    numbers = completion.numbers | {FREE: replace(completion.numbers[FREE], source=source)}
    return replace(completion, numbers=numbers, doubts=[*completion.doubts, *doubts])


def compliance_of(reducer: Reducer, usual: float, stiffness: float) -> float:
    """Of the crank supports [m/N], by secants from rigid ones and the ``usual`` ones on: the turning is nearly straight over it."""
    turned = turning(reducer, 0.0)
    if turned >= 1.0 / stiffness:
        raise InputFault(
            f"--stiffness {stiffness:g} N.m/arcmin: with rigid crank supports the other numbers make it {1.0 / turned:.4g} N.m/arcmin, which is softer; look at"
            " the unit, or give what makes them stiffer: --diameter, --known mesh.width=..., carrier.compliance=..., first_stage.compliance=..."
        )
    met = size_for(1.0 / stiffness, lambda size: turning(reducer, size), (0.0, turned), (usual, turning(reducer, usual)), NEAR, MOST_STEPS)
    if not met.near:
        raise InputFault(f"--stiffness {stiffness:g} N.m/arcmin: no {FREE} makes it, {1.0 / met.figure:.4g} N.m/arcmin is the nearest; look at its unit")
    return met.size


def turning(reducer: Reducer, compliance: float) -> float:
    """Per torque [arcmin/(N m)]."""
    setting = parse_setting(f"{FREE}={compliance!r}", [reducer.plant, reducer.wear])
    return 1.0 / hysteresis(reducer, [setting]).stiffness_Nm_per_arcmin
