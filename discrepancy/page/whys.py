"""What answers "why?" beside a number: by which relation it comes about, from which data, and with which margin it says what it says."""

import math
from collections.abc import Mapping, Sequence
from typing import Any

from discrepancy.compare import CONSPICUOUS
from discrepancy.extend import BETTER
from discrepancy.figures.key_figures import CLEARLY, DRAWS, KeyFigure
from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.chance import chance, chance_number
from discrepancy.inference.law.closed_forms import Form
from discrepancy.inference.next_experiment import ENOUGH, Proposal
from discrepancy.inference.noise.series import stream_of
from discrepancy.inference.verdict import Settings
from discrepancy.page import amounts
from discrepancy.verdict import Answer
from discrepancy.words.wording import turned_down, with_base_text
from fmu_src.effect_words import effect_title
from pages.content import Why
from pages.words import counted, number

NOISE_IS_ONE = "1 is what repetitions of one condition differ by"
USED = Settings()


def of_error(space: Workspace, row: dict[str, Any]) -> Why:
    """Error of a signal in times the noise."""
    error, noise = (amounts.text(row[key], row["unit"], row["signal"]) for key in ("error", "noise_floor"))
    kind = "held-out" if row["held_out"] else "fitted"
    return Why(
        "root mean square of measured − predicted over all samples, over that of the noise",
        f"{counted(row['runs'], f'{kind} run')}: {error} over {noise}; {noise_from(space, row['signal'])}",
        f"{NOISE_IS_ONE}; a run counts as off from {CONSPICUOUS:g}, a signal as bad from 2",
    )


def noise_from(space: Workspace, signal: str) -> str:
    """Where the noise of a signal was learnt."""
    quantity = next((w.quantity for r, w in zip(space.records, space.noise.whiteners) if stream_of(r) == signal), "")
    stream = space.noise.streams.get(quantity)
    if stream is None:
        return "noise as stated"
    freedom = stream.dof.get("main", 0.0)
    return f"noise from {stream.source.replace('_', ' ')}" + (f", {freedom:.0f} degrees of freedom" if freedom >= 1.0 else "")


def of_key_figure(f: KeyFigure) -> Why:
    noise = f"what its {f.runs} repetitions differ by, over the root of their number" if f.repeated else f"{DRAWS} draws of the noise of its samples"
    alone = "" if f.model_curve is None else (
        f"; the model's is of {f.model_from}, for noise makes what is measured larger, too: of the curve alone it is"
        f" {amounts.text(f.model_curve, f.unit, f.told_as)}"
    )
    return Why(
        f"read in one way from the measured curve and from the model at the same samples; their difference over its noise{alone}",
        f"{counted(f.runs, 'run')} at {f.condition}; the noise is {noise}",
        f"{amounts.text(abs(f.measured - f.model), f.unit, f.told_as)} apart, {number(abs(f.off))} times {amounts.text(f.noise, f.unit, f.told_as)};"
        f" {CLEARLY:g} times and more is clear",
    )


def amount(p: Mapping[str, Any]) -> str:
    """How much of chi-square is along a function, and as how much it is tested in a signal that is off all over, where that is less."""
    tested = f", tested as {number(p['statistic'])} as its signal is off all over" if p["statistic"] < 0.99 * p["chi_square"] else ""
    return f"{number(p['chi_square'])} of chi-square{tested}"


def of_place(p: dict[str, Any], level: float) -> Why:
    """A finding of where the model fails."""
    return Why(
        "part of the misfit along this function, r'G (G'G)⁺ G'r, nuisances taken out, against an F law of the noise",
        f"{amount(p)}, in {p['width']} dimensions, where noise leaves {p['width']}; noise known to {p['dof']:.0f} degrees of freedom",
        f"{chance(p['p'])} over all tests together (Holm); significant below {chance_number(level)}",
    )


def of_estimate(space: Workspace, entry: dict[str, Any]) -> Why:
    """A fitted parameter of an effect and its interval."""
    runs = [space.records[i] for i in space.training]
    signals = ", ".join(dict.fromkeys(amounts.signal_title(stream_of(r)) for r in runs))
    held = f", {counted(len(space.held_out), 'held-out run')} not used" if space.held_out else ""
    freedom = f" with {entry['degrees_of_freedom']:.0f} degrees of freedom" if 1.0 <= entry.get("degrees_of_freedom", 0.0) < 1e6 else ""
    bounded = " It is a bound: it changes more than was measured." if entry.get("bound") else ""
    bound = " It ended at a bound of its range." if entry.get("at_bound") else bounded
    taken = with_base_text(entry) or "with the base model's numbers as its file has them"
    return Why(
        "least squares of measured − predicted in units of the noise, nuisances fitted along",
        f"{counted(len(runs), 'fitted run')} of {signals}{held}",
        f"95 % by Student's law{freedom} from the curvature of chi-square, widened where the fit leaves more than noise; {taken}.{bound}",
    )


def of_samples(answer: Answer, signal: str, row: Mapping[str, float], unused: bool) -> Why:
    """Error of all samples of a signal's unused or fitted runs: ``before``, ``after``, ``floor``."""
    space = answer.diagnosis.fits.space
    unit = next((r.unit for r in space.records if stream_of(r) == signal), "1")
    kind = "held-out run" if unused else "fitted run"
    runs = sum(stream_of(r) == signal and (r.unused if unused else r.fitted) for r in space.records)
    before, after, floor = (amounts.text(row[key], unit, signal) for key in ("before", "after", "floor"))
    return Why(
        "root mean square of measured − predicted over all samples, over that of the noise: the number that a comparison shows",
        f"{counted(runs, kind)}: {before} before, {after} with what is named, noise {floor}; {noise_from(space, signal)}",
        NOISE_IS_ONE,
    )


def of_unused(answer: Answer, before: float, after: float) -> Why:
    """Error on what no parameter was fitted to."""
    space = answer.diagnosis.fits.space
    held = [space.records[i] for i in space.held_out]
    data = (
        f"{counted(len(held), 'held-out run')} at {counted(len({r.condition for r in held}), 'condition')}"
        if held
        else f"{counted(len({space.records[i].condition for i in space.training}), 'condition')}, each left out in turn"
    )
    return Why(
        "root of chi-square over its dimensions, in the patterns that carry the misfit and the effects' own",
        f"{data}; {number(before)} before, {number(after)} with the effect",
        f"{NOISE_IS_ONE}; it helped if it fell below {100.0 * BETTER:.0f} %: it went to {100.0 * after / before:.0f} %" if before > 0.0 else NOISE_IS_ONE,
    )


def of_step(kind: str, before: float, after: float, runs: int) -> Why:
    """Error of a step of the ladder."""
    return Why(
        "root of chi-square over its dimensions, in the patterns that carry the misfit",
        ("runs that no parameter was fitted to" if kind == "held_out" else "the runs that were fitted") + (f", {counted(runs, 'signal')}" if runs else ""),
        f"{NOISE_IS_ONE}; from {number(before)} to {number(after)}, {100.0 * after / before:.0f} %" if before > 0.0 else NOISE_IS_ONE,
    )


def of_verdict(answer: Answer) -> Why:
    """What the verdict rests on."""
    fitted = [r for r in turned_down(answer) if r["chi2_difference"] is not None]
    nearest = min(fitted, key=lambda r: r["chi2_difference"], default=None)
    rival = f"nearest rival: {effect_title(nearest['name'])}, {nearest['reason']}" if nearest else "no rival was near enough to be fitted"
    runs = [r for r in answer.diagnosis.fits.space.records if not r.left_out]
    return Why(
        "score tests of every effect against what the base model leaves, fits in earnest of the nearest, judged on unused runs",
        f"{counted(len(runs), 'run')} at {counted(len({r.condition for r in runs}), 'condition')}; {rival}",
        f"rivals are told apart from {USED.margin:g} of chi-square (20 to 1 in likelihood)",
    )


def of_share(answer: Answer) -> Why:
    members = answer.diagnosis.fits.members
    gain = members[0].gain if members else 0.0
    return Why(
        "what the fit takes off chi-square, of all that is more than noise",
        f"{number(gain)} of chi-square" if gain else "the fitted runs",
        f"an effect is named alone from {100.0 * USED.captured:.0f} %",
    )


def of_screening(answer: Answer) -> Why:
    return Why(
        "score test: how well an effect's response, nuisances taken out, matches what the base model leaves",
        f"{counted(len(answer.diagnosis.rejected) + len(answer.effects), 'effect')}, simulated noise for their number",
        f"{chance(answer.diagnosis.p_screen)}; something is missing below {chance_number(USED.naming_level)} where the misfit has a place,"
        f" else below {chance_number(USED.screen_level)}",
    )


def of_localising(answer: Answer) -> Why:
    places = answer.diagnosis.localisation.get("map", [])
    level = answer.diagnosis.localisation.get("level", 0.0)
    return Why(
        "generic functions of the misfit (mean, orders, branches, slopes) against the noise",
        f"{len(places)} tests of {counted(len({p['signal'] for p in places}), 'signal')}",
        f"significant below {chance_number(level)} over all tests together (Holm); the smallest is {chance(answer.diagnosis.p_localise)}",
    )


def of_rival(rejected: dict[str, Any]) -> Why:
    """Why an effect was turned down."""
    difference = rejected["chi2_difference"]
    if difference is None:
        return Why("score test of the effect alone against the base fit", rejected["reason"], f"fitted in earnest only among the {USED.shortlist} nearest")
    return Why(
        "fitted in earnest with all its parameters and the nuisances, chi-square beside that of what is named",
        "the same fitted runs",
        f"{number(difference)} of chi-square, a likelihood ratio of {ratio_text(difference)}; from {USED.margin:g} it is turned down",
    )


def ratio_text(difference: float) -> str:
    """``20 to 1``, from a difference in chi-square."""
    return "more than a million to 1" if difference > 27.6 else f"{number(math.exp(0.5 * difference), 2)} to 1" if difference > 0.0 else "1 to 1"


def of_form(form: Form) -> Why:
    """A closed form of a law without a name."""
    return Why(
        "least squares through what is left of the misfit, each point in units of its noise; groups of points left out in turn",
        "the points behind the curve above, of all conditions that show it",
        f"left-out points are off by {number(form.error)} times the noise; {100.0 * form.confidence:.0f} % of the weight of all forms that were tried,"
        " more parameters counting against one (as in BIC)",
    )


def of_proposal(p: Proposal, rivals: Sequence[str]) -> Why:
    """Separation of rivals by an experiment; its root is d'."""
    return Why(
        "squared difference of the rivals' predictions over the noise there, their parameters free within what is known of them",
        f"{counted(len(p.separation), 'pair')} of {counted(len(rivals), 'rival')}, noise as this campaign has it",
        f"d' = {number(p.least**0.5)} between the two that are nearest; {ENOUGH:g} of chi-square (d' = {number(ENOUGH**0.5)}) is enough",
    )
