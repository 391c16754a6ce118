"""Calibrated numbers that are far from what they can be: the fit took them, which makes them no truth."""

from collections.abc import Callable, Container, Sequence

import numpy as np

from discrepancy.campaign.amount import readable
from discrepancy.figures.key_figures import STIFFNESS, KeyFigure
from discrepancy.inference.base_fit.fit import Fit
from discrepancy.inference.refit.refit import covariance_of
from discrepancy.prediction.conditions import LAG_SHARE
from discrepancy.problem import Parameter, Record
from discrepancy.scales import ZERO_OF_ANGLES, of_calibrated
from discrepancy.words.as_told import told_name
from fmu_src.table import Table

# The lag of the output, of the model's own, is doubted outside of these, and surely known to be off where it is clear of the others (assumed:
# stiffnesses of one type differ by some tens of per cent).
PLAUSIBLE_LAG, CLEAR_LAG = (0.3, 3.0), (0.5, 2.0)
# The line of campaign.toml that says whose the angle was.
OF_INPUT = 'angle_of = "input" in [quantities.transmission_error] of campaign.toml'
# So many standard deviations from what is known beforehand, and from where a number is doubted.
FAR, SURELY = 3.0, 2.0
# Chi-square from which it is known whose an angle was: what a fit has bent to the wrong one counts against the right one.
SURELY_WHOSE = 25.0


def calibrated_doubts(fit: Fit, tables: Sequence[Table], effects: Container[str] = (), records: Sequence[Record] = (),
                      as_input: Callable[[], float] = lambda: 0.0, softer: float | None = None) -> list[str]:  # fmt: skip
    """One sentence for each doubtful number that was calibrated: at a bound, far from what is known, or a lag that no such reducer has.

    ``effects`` are the parameters of the fit that are effects', which are judged elsewhere; ``records`` the campaign's, whose loads a lag rests on;
    ``as_input`` says by how much chi-square their angle is better that of the input; ``softer``: so many times as soft as the model loops show it.
    """
    # A misfit makes numbers less certain than the noise alone does.
    scatter = max(1.0, fit.chi2 / max(len(fit.residual), 1))
    found = []
    for parameter, variance in zip(fit.parameters, scatter * np.diag(covariance_of(fit))):
        if parameter.name in effects:
            continue
        value = fit.values[parameter.name]
        scale = of_calibrated(parameter.name, max(abs(value), abs(parameter.off)), parameter.unit)
        told = f"calibrated {told_name(parameter.name, tables)} = {scale.text(value, 3)}"
        if parameter.name == LAG_SHARE:
            # At its bound it is 0 but for what a solver leaves.
            told = f"calibrated {LAG_SHARE} = {readable(round(value, 4))}"
            found += [f"{told} {text}" for text in lag_doubts(round(value, 4), float(np.sqrt(variance)), loads_of(records), as_input, softer)]
        elif parameter.prior and abs(value - parameter.off) > FAR * parameter.prior:
            times = abs(value - parameter.off) / parameter.prior
            found.append(f"{told} lies {times:.1f} standard deviations from {scale.text(parameter.off, 3)}, which was known before: something else is in it")
        elif parameter.name in fit.at_bounds and not is_angle(parameter):
            found.append(f"{told} stands at a bound of its range: it would go on, so it is no measurement of this number")
    return found


def softer_by_loops(figures: Sequence[KeyFigure]) -> float | None:
    """How many times as soft as the model loops show what was measured; None where there are none."""
    shares = [f.model / f.measured for f in figures if f.name == STIFFNESS and f.measured > 0.0]
    return float(np.median(shares)) if shares else None


def is_angle(parameter: Parameter) -> bool:
    """Whether it says where an angle counts from: such numbers come again after each turn of a wave."""
    return parameter.name.startswith(ZERO_OF_ANGLES)


def loads_of(records: Sequence[Record]) -> list[float | None]:
    """The loads [N.m] that tell a lag: those of a mounting that has more than one, as another mounting has a zero of its own; else no more than one."""
    mountings: dict[str, set[float | None]] = {}
    for record in records:
        if record.of_output and not record.held_out:
            mountings.setdefault(record.mounting, set()).add(record.factors.get("load"))
    most = mountings[max(mountings, key=lambda mounting: len(mountings[mounting]))] if mountings else ()
    return sorted(most, key=lambda load: -1.0 if load is None else load)


def lag_doubts(value: float, deviation: float, loads: Sequence[float | None] = (), as_input: Callable[[], float] = lambda: 0.0,
               softer: float | None = None) -> list[str]:  # fmt: skip
    """What is said against a share of the lag known to ``deviation`` from runs at ``loads`` [N.m]; 1 is the model's own; ``as_input``, ``softer`` as above."""
    low, high = PLAUSIBLE_LAG
    if low <= value <= high:
        return []
    if value < CLEAR_LAG[0] - SURELY * deviation:
        start = '(the model\'s own is 1): the angle is taken for that of the output (angle_of = "output"), which then hardly lags: '
        gained = as_input()
        if gained > SURELY_WHOSE:
            return [f"{start}it was the input's over the ratio, which explains the errors better by {gained:.3g} in chi-square; state {OF_INPUT} and diagnose"
                    " again: places and directions of what is found will move"]  # fmt: skip
        if gained < -SURELY_WHOSE:
            return [f"{start}the encoder was set to 0 under the load of each run (it is no angle of the input, which explains the errors worse by"
                    f" {-gained:.3g} in chi-square)"]  # fmt: skip
        return [f"{start}either it was the input's over the ratio after all (state {OF_INPUT} if it was, and diagnose again: places and directions of what is"
                " found may move), or the encoder was set to 0 under the load of each run"]  # fmt: skip
    if value > CLEAR_LAG[1] + SURELY * deviation and softer is not None and softer < value / CLEAR_LAG[1]:
        return [f"(the model's own is 1) is no softness: loops of this campaign show {softer:.3g} times the model's own; an effect that is not in the model yet"
                " moves places along the angle, and with it in the model it should come near to that"]  # fmt: skip
    if value > CLEAR_LAG[1] + SURELY * deviation:
        return [f"(the model's own is 1): either the measured reducer is about {value:.2g} times as soft, which a loop of it would show, or places along the"
                " angle are off for another reason; what is found in orders of high number rests on it"]  # fmt: skip
    hardly = f"(the model's own is 1) is no result: it is known to {deviation:.2g} only"
    if len(loads) > 1:
        known = [f"{load:.4g}" for load in loads if load is not None]
        return [f"{hardly}, from runs at {len(loads)} loads ({', '.join(known)} N.m). Diagnose before anything is changed: an effect that is missing moves it."
                f" If the angle was the input's, state {OF_INPUT}"]  # fmt: skip
    return [f"{hardly}, for all fitted runs of a mounting are at one load, where its zero makes up for it. Runs at another load would tell the two apart"
            f" (if one is held out, hold out another condition). If the angle was the input's, state {OF_INPUT}: then there is no lag"]  # fmt: skip
