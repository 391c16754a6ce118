"""The page of a diagnosis: the verdict, what it rests on, and what was turned down."""

from typing import Any

from discrepancy.inference.chance import chance
from discrepancy.inference.verdict import BASE_OFF, INCOMPLETE, NONE, ONE, SET, SEVERAL, STOPPED, UNKNOWN
from discrepancy.page import comparison, profiles, response, whys, would_show
from discrepancy.page.amounts import in_words, signal_title
from discrepancy.page.changed_figures import figures_of_answer
from discrepancy.page.evidence import base_off, confusable, effects, held_out, listed, recovered, rivals
from discrepancy.page.runs import runs_of
from discrepancy.scales import of_axis
from discrepancy.verdict import Answer
from discrepancy.words import wording
from discrepancy.words.as_told import tables_of, told_name
from discrepancy.words.left_sizes import left_sizes
from discrepancy.words.pin_shapes import shape_text
from discrepancy.words.sample_errors import FITTED, OF_PATTERNS, OF_SAMPLES, PATTERNS, SAMPLES, UNUSED, furthest_off
from fmu_src.effect_words import effect_title
from pages.content import Card, Page
from pages.words import capital, number


def page(answer: Answer) -> Page:
    diagnosis = answer.diagnosis
    space = diagnosis.fits.space
    runs = runs_of(space, space.predictions(space.base.values, list(range(len(space.records)))), of_axis("speed", answer.model.campaign))
    place = diagnosis.localisation
    localised = comparison.localisation_section(place.get("map", []), place.get("conditions", {}), place.get("level", 0.0))
    laws_found = [recovered(answer)] if answer.verdict in (UNKNOWN, INCOMPLETE) or answer.laws else []
    if answer.effects:
        sections = [
            effects(answer),
            *([response.section(answer), profiles.section(answer)] if diagnosis.fits.members else []),
            held_out(answer),
            *([confusable(answer)] if answer.confusable or diagnosis.alternatives or diagnosis.correlations else []),
            *laws_found,
            localised,
            rivals(answer),
        ]
    else:
        shown = [would_show.section(answer.would_show)] if answer.would_show else []
        sections = [*shown, localised, *laws_found, rivals(answer)]
    sections += figures_of_answer(answer)
    if diagnosis.base_off:
        sections.insert(0, base_off(answer))
    where = comparison.conditions(answer, runs) if runs else ""
    return Page(
        "Diagnosis: which effect does the model lack?",
        comparison.title(answer),
        where,
        sentence(answer),
        cards(answer),
        sections,
        answer.warnings,
    )


def sentence(answer: Answer) -> str:
    """The verdict as one would say it, with what it rests on."""
    said = headline(answer)
    if answer.verdict == ONE:
        best, together = answer.effects[0], wording.together_text(answer)
        error = wording.error_text(answer, best)
        share = f"It {wording.share_text(answer, best['share_explained'])}{f'; {error}' if error else ''}"
        said += f" {capital(together) if together else share}.".replace("->", "→")
    if answer.verdict in (UNKNOWN, SEVERAL):
        said += f" ({capital(reason_text(answer))}.)"
    if answer.verdict == NONE and (figure := answer.reason.partition("; ")[2]):
        said += f" {capital(figure)}."
    if answer.would_show:
        said += f" {capital(in_words(answer.would_show.sentence))}."
    left = wording.left_text(answer) if answer.verdict == INCOMPLETE else ""
    sizes = left_sizes(answer, signal_title)
    return said + (f" Left are: {left}." if left else "") + (f" {capital(SAMPLES)}: {sizes}." if sizes else "")


def headline(answer: Answer) -> str:
    """The verdict alone; parts that look alike are named below it."""
    names = [said_of(e, answer) for e in answer.effects]
    off = [told_name(e.name, tables_of(answer.model)) for e in answer.diagnosis.base_off]
    texts = {
        NONE: "The model is adequate: no effect and no other pattern is significant against the noise of this campaign.",
        ONE: f"The model lacks {listed(names)}.",
        SET: f"The model lacks one of {len(names)} effects that this campaign cannot tell apart: {listed(names)}. Each of them would do.",
        SEVERAL: f"The model lacks several effects together: {listed(names)}.",
        INCOMPLETE: f"{part_named(answer, names)} part of what the model lacks, but something else is left {answer.left_over}.",
        BASE_OFF: f"No effect is missing; the base model itself is off: {listed(off)}.",
        STOPPED: f"The diagnosis was interrupted: {reason_text(answer)}. What stands here is what was known by then, not an answer to the question.",
        UNKNOWN: "The misfit is real, but no effect of the catalogue explains it.",
    }
    return texts.get(answer.verdict, answer.verdict)


def said_of(effect: dict[str, Any], answer: Answer) -> str:
    """An effect as a headline has it; where its name would answer what the campaign leaves open, the shape that was found."""
    variant = wording.shortly(effect)
    return shape_text(effect, answer.model) or effect_title(effect["name"]) + (f" ({variant})" if variant else "")


def reason_text(answer: Answer) -> str:
    """What the verdict rests on, or how far an interrupted diagnosis came."""
    return in_words(answer.reason)


def part_named(answer: Answer, names: list[str]) -> str:
    """What is named but does not do alone, with its verb."""
    if answer.confusable:
        return f"One of {len(names)} effects that this campaign cannot tell apart, {listed(names)}, is"
    return f"{listed(names).capitalize()} {'is' if len(names) == 1 else 'are'}"


def samples(answer: Answer, best: dict[str, Any]) -> list[Card]:
    """The number that a comparison begins with, of the signal that was furthest off, of unused runs where they are judged; nothing where none was fitted."""
    unused_rows = wording.judged(answer, best).get("rms") or {}
    rows, runs = (unused_rows, UNUSED) if unused_rows else (wording.fitted_samples(answer), FITTED)
    found = furthest_off((name, row["before"], row["after"], row["floor"]) for name, row in rows.items())
    if found is None:
        return []
    signal, before, after = found
    more = f", the furthest off of {len(rows)} signals" if len(rows) > 1 else ""
    why = whys.of_samples(answer, signal, rows[signal], bool(unused_rows))
    note = f"{signal_title(signal)}, {runs}{more}"
    return [Card(capital(SAMPLES), number(after), note, number(before), OF_SAMPLES, tone_of(answer, best) if unused_rows else "plain", why)]


def tone_of(answer: Answer, best: dict[str, Any]) -> str:
    """Green only if runs that were held out show that it fell."""
    worse = best["held_out_error_after"] >= best["held_out_error_before"]
    return "bad" if worse else "good" if wording.is_shown(answer, best) else "plain"


def unused(answer: Answer, best: dict[str, Any]) -> Card:
    """What the verdict counts of that which was not fitted."""
    judged = answer.effects if wording.fitted_together(answer) else [best]
    by_runs, drowned = wording.by_unused_runs(answer, best), wording.below_noise(answer, best)
    names = " + ".join(effect_title(e["name"]) for e in judged)
    return Card(
        f"{capital(PATTERNS)}, unused runs" if by_runs else "Misfit of a condition that is left out",
        number(best["held_out_error_after"]),
        f"with {names}; {'what the verdict counts' if by_runs else 'each left out in turn'}"
        + ("; the samples are off by less than their noise" if drowned else ""),
        number(best["held_out_error_before"]),
        OF_PATTERNS if by_runs else OF_SAMPLES,
        tone_of(answer, best),
        whys.of_unused(answer, best["held_out_error_before"], best["held_out_error_after"]),
    )


def cards(answer: Answer) -> list[Card]:
    """In which an effect goes by its name alone: which form of it, and at which part, the headline says."""
    diagnosis = answer.diagnosis
    made = [Card("Verdict", answer.verdict, reason_text(answer), tone=wording.tone(answer), why=whys.of_verdict(answer))]
    if answer.effects:
        best, together = answer.effects[0], wording.fitted_together(answer)
        share = wording.percent(answer, diagnosis.captured)
        alone = ", ".join(f"{effect_title(e['name'])} {wording.percent(answer, e['share_alone'])}" for e in answer.effects) if together else ""
        title = "Share of the misfit explained" + (" together" if together else "")
        made.append(Card(title, share, f"alone: {alone}" if together else f"best: {effect_title(best['name'])}", why=whys.of_share(answer)))
        if best["held_out_error_before"] is not None:
            made += [*samples(answer, best), unused(answer, best)]
    made.append(
        Card(
            "Findings of the localisation",
            str(len(diagnosis.localisation.get("findings", []))),
            f"smallest {chance(diagnosis.p_localise)}",
            why=whys.of_localising(answer),
        )
    )
    made.append(Card("Screening of the effects", chance(diagnosis.p_screen), "smallest p over all effects together", why=whys.of_screening(answer)))
    return made
