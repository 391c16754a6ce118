"""Calibrated numbers that are far from what they can be: the fit took them, which makes them no truth."""

from collections.abc import Container, Sequence

import numpy as np

from discrepancy.as_told import told_name
from discrepancy.campaign.amount import readable
from discrepancy.inference.base_fit.fit import Fit
from discrepancy.inference.refit.refit import covariance_of
from discrepancy.prediction.conditions import LAG_SHARE
from discrepancy.problem import Parameter
from discrepancy.scales import of_parameter
from fmu_src.table import Table

# The lag of the output, of the model's own, is doubted outside of these, and surely known to be off where it is clear of the others (assumed:
# stiffnesses of one type differ by some tens of per cent).
PLAUSIBLE_LAG, CLEAR_LAG = (0.3, 3.0), (0.5, 2.0)
# The line of campaign.toml that says whose the angle was.
OF_INPUT = 'angle_of = "input" in [quantities.transmission_error] of campaign.toml'
# So many standard deviations from what is known beforehand, and from where a number is doubted.
FAR, SURELY = 3.0, 2.0


def calibrated_doubts(fit: Fit, tables: Sequence[Table], effects: Container[str] = ()) -> list[str]:
    """One sentence for each doubtful number that was calibrated: at a bound, far from what is known, or a lag that no such reducer has.

    ``effects`` are the parameters of the fit that are effects', which are judged elsewhere.
    """
    # A misfit makes numbers less certain than the noise alone does.
    scatter = max(1.0, fit.chi2 / max(len(fit.residual), 1))
    found = []
    for parameter, variance in zip(fit.parameters, scatter * np.diag(covariance_of(fit))):
        if parameter.name in effects:
            continue
        value = fit.values[parameter.name]
        scale = of_parameter(max(abs(value), abs(parameter.off)), parameter.unit)
        told = f"calibrated {told_name(parameter.name, tables)} = {scale.text(value, 3)}"
        if parameter.name == LAG_SHARE:
            # At its bound it is 0 but for what a solver leaves.
            told = f"calibrated {LAG_SHARE} = {readable(round(value, 4))}"
            found += [f"{told} {text}" for text in lag_doubts(round(value, 4), float(np.sqrt(variance)))]
        elif parameter.prior and abs(value - parameter.off) > FAR * parameter.prior:
            times = abs(value - parameter.off) / parameter.prior
            found.append(f"{told} lies {times:.1f} standard deviations from {scale.text(parameter.off, 3)}, which was known before: something else is in it")
        elif parameter.name in fit.at_bounds and not is_angle(parameter):
            found.append(f"{told} stands at a bound of its range: it would go on, so it is no measurement of this number")
    return found


def is_angle(parameter: Parameter) -> bool:
    """Whether it says where an angle counts from: such numbers come again after each turn of a wave."""
    return parameter.name.startswith("angle_zero")


def lag_doubts(value: float, deviation: float) -> list[str]:
    """What is said against a share of the lag known to ``deviation``; 1 is the model's own."""
    low, high = PLAUSIBLE_LAG
    if low <= value <= high:
        return []
    if value < CLEAR_LAG[0] - SURELY * deviation:
        return [f"(the model's own is 1): the output hardly lags, as if the angle was the input's over the ratio after all (state {OF_INPUT} if it was), or the"
                " encoder was set to 0 under the load of each run; what is found is the same either way"]
    if value > CLEAR_LAG[1] + SURELY * deviation:
        return [f"(the model's own is 1): either the measured reducer is about {value:.2g} times as soft, which a loop of it would show, or places along the"
                " angle are off for another reason; what is found in orders of high number rests on it"]  # fmt: skip
    return [f"(the model's own is 1) is known to {deviation:.2g} only: the model's lag is fitted as {value:.2g} times what it is, for where loads are alike"
            " the angle's zero makes up for it; runs at another load would tell the two apart (if one is held out, hold out another condition),"
            f" and {OF_INPUT} leaves no lag, if the angle was the input's"]  # fmt: skip
