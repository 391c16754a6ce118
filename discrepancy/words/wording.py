"""What may be said of a diagnosis, in words that its numbers bear; for screen and page."""

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any

from discrepancy.alike.other_places import place_of, shortened
from discrepancy.campaign.amount import readable
from discrepancy.compare import by_signal, runs_of
from discrepancy.extend import BETTER
from discrepancy.inference.held_out.held_out import WITHIN_NOISE
from discrepancy.inference.verdict import BASE_OFF, INCOMPLETE, NONE, ONE, SET, SEVERAL, STOPPED, UNKNOWN, BaseError, StandIn
from discrepancy.scales import estimate_texts, of_estimate, of_parameter, parameter_texts, shown
from discrepancy.verdict import Answer
from discrepancy.words.as_told import tables_of, told_name
from discrepancy.words.held_signals import held_signals_text
from discrepancy.words.intervals import interval_text
from discrepancy.words.sample_errors import FITTED, OF_SAMPLES, patterns_text, plain, samples_text

# A share from here on would be rounded to all of it, and from there on in hundredths of a percent, too.
NEARLY_ALL, ALL_BUT_ALL = 0.995, 0.9999
# What is named leaves something.
LEAVES = (INCOMPLETE, STOPPED, UNKNOWN)
MOST_NAMED = 3
# Of what was turned down as many stand there at once.
NEAREST = 6
TONES = {BASE_OFF: "fair", SET: "fair", INCOMPLETE: "fair", UNKNOWN: "bad"}


def variant_text(effect: Mapping[str, Any]) -> str:
    """Which form of an effect it is, or may as well be, and at which part; empty where there is but one."""
    return or_others(own_form(effect), effect)


def own_form(effect: Mapping[str, Any]) -> str:
    """The form whose values are told."""
    forms = str(effect.get("variant", "")).replace("_", " ")
    return str(effect.get("place") or "") if " + " not in forms and effect.get("place") else forms


def or_others(own: str, effect: Mapping[str, Any]) -> str:
    """``first stage, carrier or housing``: with the forms that fit as well, unless they are parts that look alike, which ``own`` names already."""
    forms = [f for f in effect.get("other_forms", ()) if f["candidates"][0] not in effect.get("look_alike", ())]
    return either([own, *map(own_form, forms)])


def either(names: Sequence[str]) -> str:
    return " or ".join(filter(None, (", ".join(names[:-1]), names[-1])))


def other_form_text(form: Mapping[str, Any]) -> str:
    """``or carrier (fits worse by 0.2 in chi-square than support_compliance.first_stage)``"""
    return f"or {own_form(form)}" + (f" ({form['reason']})" if form.get("reason") else "")


def shortly(effect: dict[str, Any]) -> str:
    """The same for a headline, which names no other parts that look alike: ``variant_text`` stands below it."""
    own = own_form(effect)
    return or_others(shortened(own, len(effect.get("other_places", ()))) if own == effect.get("place") else own, effect)


def signals_left(left: Mapping[str, float], title: Callable[[str], str] = str) -> str:
    """What a step leaves of the signals, ``left`` by signal in times its noise; empty where nothing stands out."""
    return f"left: {', '.join(f'{title(signal)} {ratio:.3g} times its noise' for signal, ratio in left.items())}" if left else ""


def share_text(answer: Answer, share: float) -> str:
    """How much of the misfit an effect takes."""
    return f"explains {percent(answer, share)} of the misfit"


def fitted_together(answer: Answer) -> bool:
    """Whether what is named was fitted as one: effects beside each other, or beside numbers of the base model."""
    members = answer.diagnosis.fits.members
    return bool(members) and len(members[0].candidates) > 1


def percent(answer: Answer, share: float) -> str:
    """What leaves something is never said to take all."""
    if answer.verdict in LEAVES and share >= NEARLY_ALL:
        return f"{math.floor(1e4 * share) / 100.0:.2f} %" if share < ALL_BUT_ALL else "over 99.99 %"
    return percent_of_misfit(share)


# A share goes with squares: a signal of 90 times its noise has 99 % beside one of 2.5 times its noise with ten times its samples.
SHARE = "of the squares of all that is significantly off, in times of the noise, all samples of all signals together"


def percent_of_misfit(share: float) -> str:
    """What is significant is not nothing, however little of all misfit it is."""
    return "< 1 %" if share < 0.005 else f"{100.0 * share:.0f} %"


def shares_text(answer: Answer, effect: dict[str, Any]) -> str:
    """The share of an effect; of one of several that which it has alone, and what it adds to the others."""
    if effect.get("share_alone") is None:
        return share_text(answer, effect["share_explained"])
    others = "the others" if len(answer.effects) > 1 else "what of the base model is off"
    alone, more = percent(answer, effect["share_alone"]), percent(answer, effect["share_explained"])
    return f"alone it takes away {alone} of the misfit; added to {others}, {more} more of it"


def together_text(answer: Answer) -> str:
    """What all that is named does as one, and its error on what was not fitted; empty where each effect is judged by itself."""
    if not fitted_together(answer) or not answer.effects:
        return ""
    error = error_text(answer, answer.effects[0])
    base = ", with what of the base model is off," if answer.diagnosis.base_off else ""
    return f"together{base} this {share_text(answer, answer.diagnosis.captured)}" + (f"; {error}" if error else "")


def stand_ins(answer: Answer, title: Callable[[str], str] = str) -> dict[str, str]:
    """What could stand in place of each effect, with its values, as a sentence."""
    beside = ", beside the others," if fitted_together(answer) else ""
    return {
        name: f"in place of {title(name)}{beside} could stand: {'; '.join(f'{title(s.name)} ({stand_in_text(answer, s)})' for s in others)}"
        for name, others in answer.diagnosis.stand_ins.items()
    }


def stand_in_text(answer: Answer, other: StandIn) -> str:
    """``effects.support_compliance.housing_compliance = 0.0175 arcmin/(N m), 95 %: 0.0174 to 0.0176; fits worse by 0.2 in chi-square``"""
    texts = []
    for name, entry in other.parameters.items():
        value, interval, unit = estimate_texts(entry)
        texts.append(f"{told_name(name, tables_of(answer.model))} = {value}{unit and f' {unit}'}, 95 %: {interval}")
    return "; ".join([*texts, other.reason])


def told_apart_by(answer: Answer, title: Callable[[str], str] = str) -> list[str]:
    """What the campaign cannot tell apart, each with its forms and how much worse it fits than the first."""
    by_name = {effect["name"]: effect for effect in answer.effects}
    return [title(name) + (f" ({'; '.join(told)})" if (told := apart_words(by_name.get(name, {}))) else "") for name in answer.confusable]


def apart_words(effect: Mapping[str, Any]) -> list[str]:
    return [text for text in (variant_text(effect) if effect.get("other_forms") else "", effect.get("reason", "")) if text]


def turned_down(answer: Answer) -> list[dict[str, Any]]:
    """The rivals that are no stand-ins, with the part at which they were tried."""
    return [r | ({"reason": f"{place}, {r['reason']}"} if (place := place_of(r["name"], answer.model)) else {}) for r in answer.diagnosis.rejected]


def base_texts(answer: Answer) -> list[str]:
    """What of the base model is off and by how much, one text each, in the units of campaign and field."""
    texts = []
    for e in answer.diagnosis.base_off:
        value, interval, unit = parameter_texts(e.value, e.interval, e.unit)
        held = of_parameter(abs(e.assumed) or abs(e.value), e.unit)
        share = f", {100.0 * (e.value / e.assumed - 1.0):+.1f} %" if e.assumed else ""
        range_text = held.span(*e.within) + beyond_text(e) if e.explains is not None else f"standard deviation {held.text(e.within[1] - e.assumed, 3)}"
        name = told_name(e.name, tables_of(answer.model))
        texts.append(f"{name} = {value}{unit and f' {unit}'} (95 %: {interval}){share}; assumed {held.text(e.assumed)} ({range_text}); {e.title}")
    return texts


def beyond_text(e: BaseError) -> str:
    """Where a number of the file is found to be where its file says that it is not."""
    return "" if e.within[0] <= e.value <= e.within[1] else ", beyond which it is"


def left_text(answer: Answer) -> str:
    """What is left beside that which is named; empty where nothing is said of it."""
    found = answer.diagnosis.leftover.get("findings", [])
    if answer.verdict == UNKNOWN and not found:
        # Nothing was fitted: all of it is left.
        found = answer.diagnosis.localisation["findings"]
    named = [f"{f['signal']}, {f['feature']}" + ("" if f["dependence"] == "everywhere" else f", changing with {f['dependence']}") for f in found]
    if not named and "held_out" in answer.diagnosis.leftover:
        named = ["runs that were not fitted are further off than noise allows"]
    more = f", and {len(named) - MOST_NAMED} more" if len(named) > MOST_NAMED else ""
    return "; ".join(named[:MOST_NAMED]) + more


def judged(answer: Answer, effect: dict[str, Any]) -> dict[str, Any]:
    """The held-out entry of the fit that an effect belongs to."""
    entries = answer.diagnosis.held_out.items()
    return next((entry for name, entry in entries if any(c in name for c in effect.get("candidates", [effect["name"]]))), {})


def by_unused_runs(answer: Answer, effect: dict[str, Any]) -> bool:
    """Whether its errors are those of runs that were held out, and not of conditions left out in turn."""
    entry = judged(answer, effect)
    return bool(answer.diagnosis.fits.space.held_out) and bool(entry) and not entry.get("kind")


def fitted_samples(answer: Answer) -> dict[str, dict[str, float]]:
    """Of each signal the error of all samples of its fitted runs before and with what is named, and the noise, in its unit; empty where nothing was fitted."""
    fits = answer.diagnosis.fits
    if not fits.members:
        return {}
    every = list(range(len(fits.space.records)))
    before, after = (by_signal(runs_of(fits.space, fits.space.predictions(fit.values, every))) for fit in (fits.space.base, fits.members[0].fit))
    return {
        a["signal"]: {"before": b["error"], "after": a["error"], "floor": a["noise_floor"]} for b, a in zip(before, after, strict=True) if not a["held_out"]
    }


def below_noise(answer: Answer, effect: dict[str, Any]) -> bool:
    """Whether the unused runs were off by less than the noise of their samples before anything was added."""
    signals = judged(answer, effect).get("rms") or {}
    return bool(signals) and all(row["before"] <= row["floor"] for row in signals.values())


def with_base_text(entry: Mapping[str, Any]) -> str:
    """What the interval that is told leaves open, and which it would be otherwise; empty where both are one."""
    if "interval_with_base" not in entry:
        return ""
    scale = of_estimate(entry)
    low, high = (scale.number(v) for v in entry["interval"])
    return f"with each of the base model's numbers free within its range; {interval_text(low, high, 3, readable)} with them as its file has them"


def is_shown(answer: Answer, effect: dict[str, Any]) -> bool:
    """Whether unused runs show that the effect helps."""
    before, after = effect["held_out_error_before"], effect["held_out_error_after"]
    return before is not None and by_unused_runs(answer, effect) and not below_noise(answer, effect) and before > WITHIN_NOISE and after < BETTER * before


def not_judged_text(answer: Answer) -> str:
    """Why an error is that of conditions left out in turn, and not of runs that were held out."""
    if not answer.diagnosis.fits.space.held_out:
        return "no run is held out"
    return f"the runs that are held out are not judged{' yet' if answer.verdict == STOPPED else ''}"


def error_text(answer: Answer, effect: dict[str, Any]) -> str:
    """The error on what was not fitted, before and after, and what it is measured in; empty without one."""
    before, after = effect["held_out_error_before"], effect["held_out_error_after"]
    if before is None:
        return ""
    change = f"{before:.2f} -> {after:.2f}"
    if not by_unused_runs(answer, effect):
        fitted = fitted_samples(answer)
        before_that = f"{samples_text(fitted, plain, FITTED)}; " if fitted else ""
        return f"{before_that}{not_judged_text(answer)}; leaving out one condition at a time: misfit of a condition {change} ({OF_SAMPLES})"
    records = answer.diagnosis.fits.space.records
    of_signals = held_signals_text(records)
    if not below_noise(answer, effect):
        unused = judged(answer, effect).get("rms") or {}
        return "; ".join([*([samples_text(unused, plain)] if unused else []), patterns_text(before, after)]) + of_signals
    units = {r.quantity: r.unit for r in records}
    rows = [
        f"{name}: {shown(row['before'], units[name.partition('[')[0]], name)}, noise {shown(row['floor'], units[name.partition('[')[0]], name)}"
        for name, row in judged(answer, effect)["rms"].items()
    ]
    return (
        f"on unused conditions the samples are off by less than their noise ({'; '.join(rows)}), so that these runs prove little;"
        f" {patterns_text(before, after)}{of_signals}"
    )


def tone(answer: Answer) -> str:
    """Of the verdict: good only where unused runs show it."""
    if answer.verdict in TONES:
        return TONES[answer.verdict]
    if answer.verdict in (ONE, SEVERAL):
        return "good" if answer.effects and is_shown(answer, answer.effects[0]) else "fair"
    # Where nothing would have been seen, that nothing was seen is no good news.
    little = answer.would_show is not None and answer.would_show.says_little
    return "good" if answer.verdict == NONE and unused_within_noise(answer) and not little else "plain"


def unused_within_noise(answer: Answer) -> bool:
    """Whether there are held-out runs, and the base model errs there by the noise."""
    space = answer.diagnosis.fits.space
    predictions = space.predictions(space.base.values, space.held_out)
    ratios = []
    for i, predicted in zip(space.held_out, predictions):
        whitener = space.noise.whiteners[i]
        between = 1.0 + sum(space.noise.streams[whitener.quantity].patterns.values())
        error = ((space.records[i].values - predicted)[whitener.kept] / whitener.scale) ** 2 / between
        if error.size:
            ratios.append(float(error.mean()) ** 0.5)
    return bool(ratios) and max(ratios) <= WITHIN_NOISE
