"""What positions of the input count from: those of a model from where it begins, those of a bench from the zero of its encoder, which a campaign finds."""

import math
from collections.abc import Iterable, Mapping
from typing import Any

from fmu_src.reading import quoted
from reducers.reducer import Reducer
from rv_plant.gear_stage import total_ratio

BEGINS = "positions of the input count from where the model begins: an eccentric of disc 1 points at crank 1"
ZERO = "angle_zero["


def zeros_of(steps: Iterable[Mapping[str, Any]]) -> dict[tuple[str, str], float]:
    """(campaign, mounting) -> the output angle of the model [rad] at which that campaign's angle is 0, by the last step that was kept."""
    return {
        (str(step.get("campaign", "")), mounting_of(name)): float(zero)
        for step in steps if step.get("kept", True)
        for name, zero in {**step.get("nuisances", {}), **step.get("positions", {})}.items() if name.startswith(ZERO)
    }  # fmt: skip


def mounting_of(zero: str) -> str:
    """Of a zero by its name: ``1`` of ``angle_zero[1]``."""
    return zero.removeprefix(ZERO).rstrip("]")


def zero_texts(reducer: Reducer, steps: Iterable[Mapping[str, Any]], locked_at: float | None = None) -> list[str]:
    """A line for each mounting of which it is known: where its angle 0 is, and how its positions become those of the model; ``locked_at`` [deg] is told in
    both ways."""
    t = reducer.topology
    ratio = abs(total_ratio(reducer.starts["first_stage_ratio"], t.pins, t.lobes))
    found = []
    for (campaign, mounting), zero in zeros_of(steps).items():
        on = math.degrees(zero) * ratio
        both = ""
        if locked_at is not None:
            # No minus before a place that is none.
            both = f"; its {locked_at:g} deg is --locked-at {locked_at + on:.1f}, and --locked-at {locked_at:g} its {round(locked_at - on, 1) + 0.0:.1f} deg"
        found.append(
            f"angle 0 of campaign {quoted(campaign)}, mounting {quoted(mounting)}, is at output angle {math.degrees(zero):.4g} deg of this model:"
            f" --locked-at is the campaign's position of the input {'-' if zero < 0.0 else '+'} {abs(on):.1f} deg{both}"
        )
    return found
