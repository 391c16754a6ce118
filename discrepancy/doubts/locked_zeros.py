"""Where inputs were locked, counted from a zero of angles that a fit has found: what is said of it beside the base model and beside what is named."""

import math
from collections.abc import Callable

import numpy as np

from discrepancy.campaign.model import ENCODER_PHASE
from discrepancy.counted_from import mounting_of
from discrepancy.held_names import LOCKED_AT
from discrepancy.inference.base_fit.fit import Fit
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.prediction.conditions import angle_zero
from discrepancy.prediction.locked_places import has_place
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import ERROR, ORDERS, Record
from fmu_src.arrays import Floats

# Of the input [deg]: nearer to the model's zero a place shows as where it is stated.
TURNED = 5.0
# Root mean square, over the noise, of what a fit leaves of transmission errors: from more its zero may be another once the misfit is explained.
UNFIT = 1.5
# Standard deviations of a chi-square by which more than noise is left.
SEEN = 3.0
# So near to a bound [deg of the output] a zero stands at it.
AT_BOUND = 1e-4


def zero_texts(model: PhysicalModel, space: Workspace, fit: Fit) -> list[str]:
    """A sentence for each mounting in which curves and stated positions of the input count from one zero that ``fit`` has far from the model's, and for
    each zero at a bound that the campaign states."""
    found = [zero_text(name, at, left_of(space, fit, name) > UNFIT, model.unstated_places.period) for name, at in positions_at_zero(model, fit).items()]
    return [text for text in (*found, *bound_texts(model, fit), *untied_texts(space)) if text]


def untied_texts(space: Workspace) -> list[str]:
    """A sentence for each mounting of which inputs were locked at stated places that nothing ties to the model, if the base model leaves something of their
    loops: what is named may be another place."""
    tied = {angle_zero(r) for r in space.records if r.quantity in (ERROR, ORDERS)}
    stated = sorted({angle_zero(r) for r in space.records if has_place(r)} - tied)
    squares = {name: residual_of(space, space.base, name, has_place) ** 2 for name in stated}
    return [
        f"where the input was locked is counted from the model's own 0 (an eccentric of disc 1 points at crank 1), for no transmission error of mounting"
        f" {mounting_of(name)} tells another: what is named may be another position; unless 0 was there, leave out {LOCKED_AT} (a diagnosis then weighs the"
        " position, too), or add a transmission error over the same angle"
        for name, left in squares.items() if len(left) and left.mean() > 1.0 + SEEN * np.sqrt(2.0 / len(left))
    ]  # fmt: skip


def bound_texts(model: PhysicalModel, fit: Fit) -> list[str]:
    """Zeros that would go on beyond what the campaign states of them."""
    bounds = model.zero_bounds
    ends = [] if bounds.anywhere else [math.degrees(bounds.lower), math.degrees(bounds.upper)]
    return [f"calibrated {name} = {end:.4g} deg stands at the bound that nuisances.{ENCODER_PHASE} of campaign.toml states: the pattern of the transmission"
            " error would have it beyond; state wider bounds, or find what else turns the pattern"
            for name in model.zeros if name in fit.values for end in ends if abs(math.degrees(fit.values[name]) - end) < AT_BOUND]  # fmt: skip


def positions_at_zero(model: PhysicalModel, fit: Fit) -> dict[str, float]:
    """By zero (``angle_zero[1]``) the position of the model's input [rad] at which positions that a campaign states are 0; of mountings that have such."""
    waves = model.locked_waves.taken(model.cages.effects(model.standing() | fit.values))
    # Loops tell in which wave of the pattern; the fit tells where in it.
    return {name: fit.values[name] * model.bench.ratio + waves.get(name, 0) * model.locked_waves.wave for name in model.locked_places.names}


def zeros_told(model: PhysicalModel, fit: Fit) -> dict[str, float]:
    """Zeros of angles [rad of the output] as loops tell them, in which wave of the pattern: one number for what transmission errors leave open."""
    return {name: at / model.bench.ratio for name, at in positions_at_zero(model, fit).items()}


def left_of(space: Workspace, fit: Fit, name: str) -> float:
    """Root mean square, over the noise, of what ``fit`` leaves of the transmission errors that tell the zero ``name``."""
    left = residual_of(space, fit, name, lambda record: record.quantity in (ERROR, ORDERS))
    return float(np.sqrt(np.mean(left**2))) if len(left) else 0.0


def residual_of(space: Workspace, fit: Fit, name: str, of: Callable[[Record], bool]) -> Floats:
    """(n,) What ``fit`` leaves, over the noise, of such records whose angles or positions count from the zero ``name``."""
    return np.concatenate([np.zeros(0), *(fit.residual[rows] for i, rows in space.rows.items()
                                          if of(space.records[i]) and angle_zero(space.records[i]) == name)])  # fmt: skip


def zero_text(name: str, turned: float, unfit: bool, period: float) -> str:
    """Of a zero (``angle_zero[1]``) ``turned`` [rad of the input] from the model's; empty where that is near, to whole turns of the cranks, the ``period``,
    after which positions are much alike (after one of the input they are not).  One that is ``unfit`` has no number: a
    large effect hides the pattern, and where that is found then, near or far, says nothing."""
    counted = f"where the input was locked is counted from the zero of the transmission errors of mounting {mounting_of(name)}"
    if unfit:
        return (f"{counted}; that zero is of a model which does not fit yet (they are off by more than {UNFIT:g} times their noise) and may move when what is"
                " missing is found: change nothing for it before")  # fmt: skip
    if abs(math.degrees(math.remainder(turned, period))) < TURNED:
        return ""
    return (f"{counted}, found {math.degrees(turned):.0f} deg of the input from the model's; if the encoder was set to 0 anew for the loops, leave out"
            f" {LOCKED_AT} (a diagnosis then looks for the position, too)")  # fmt: skip
