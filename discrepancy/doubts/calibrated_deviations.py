"""How sure calibrated numbers are: as noise leaves them where the model fits, and not said where it misses the data, for what it lacks moves them by more."""

import math

import numpy as np

from discrepancy.doubts.locked_zeros import UNFIT
from discrepancy.inference.base_fit.fit import Fit
from discrepancy.inference.refit.refit import covariance_of
from discrepancy.scales import ZERO_OF_ANGLES

AT_BOUND = "at a bound of its range, so no measurement"


def misfit_of(base: Fit) -> float:
    """Root mean square of what the fit leaves, over the noise."""
    return math.sqrt(base.chi2 / max(len(base.residual), 1))


def deviations_of(base: Fit) -> dict[str, float]:
    """By calibrated number its standard deviation (SI), wider by a misfit as in the doubts of these numbers; nothing where the model misses the data."""
    misfit = misfit_of(base)
    if misfit > UNFIT:
        return {}
    return dict(zip(base.names, map(float, max(1.0, misfit) * np.sqrt(np.diag(covariance_of(base))))))


def unsure_text(base: Fit) -> str:
    """Why no deviations are told; empty where they are."""
    if (misfit := misfit_of(base)) <= UNFIT:
        return ""
    return f"without +-: the model misses the data by {misfit:.2g} times the noise, and what it lacks may move these numbers by far more than noise does"


def stands_at_bound(base: Fit, name: str) -> bool:
    """Whether a calibrated number would go on beyond its range; zeros of angles come again after each turn of a wave."""
    return name in base.at_bounds and not name.startswith(ZERO_OF_ANGLES)


def doubt_of(base: Fit, name: str) -> str:
    """What is said against a calibrated number in few words, for who reads it in a table alone; empty where nothing is."""
    misses = f"the model misses the data by {misfit_of(base):.2g} times the noise, what it lacks may move this" if misfit_of(base) > UNFIT else ""
    return "; ".join(filter(None, [AT_BOUND if stands_at_bound(base, name) else "", misses]))
