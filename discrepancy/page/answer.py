"""The page of a diagnosis: the verdict, what it rests on, and what was turned down."""

from typing import Any

from discrepancy import wording
from discrepancy.as_told import tables_of, told_name
from discrepancy.inference.chance import chance
from discrepancy.inference.verdict import BASE_OFF, INCOMPLETE, NONE, ONE, SET, SEVERAL, STOPPED, UNKNOWN
from discrepancy.left_sizes import left_sizes
from discrepancy.page import comparison, profiles, response, whys
from discrepancy.page.amounts import effect_title, in_words, signal_title
from discrepancy.page.evidence import base_off, confusable, effects, held_out, listed, recovered, rivals
from discrepancy.page.runs import runs_of
from discrepancy.scales import of_axis
from discrepancy.verdict import Answer
from pages.content import Card, Page
from pages.words import number


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
        sections = [localised, *laws_found, rivals(answer)]
    sections += comparison.figures_section(answer.figures, answer.model.file, bool(diagnosis.nuisances))
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
        said += f" {f'{together[:1].upper()}{together[1:]}' if together else share}.".replace("->", "→")
    if answer.verdict in (UNKNOWN, SEVERAL):
        said += f" ({reason_text(answer)[:1].upper()}{reason_text(answer)[1:]}.)"
    if answer.verdict == NONE and (figure := answer.reason.partition("; ")[2]):
        said += f" {figure[:1].upper()}{figure[1:]}."
    left = wording.left_text(answer) if answer.verdict == INCOMPLETE else ""
    sizes = left_sizes(answer, signal_title)
    return said + (f" Left are: {left}." if left else "") + (f" Every sample is off by: {sizes}." if sizes else "")


def headline(answer: Answer) -> str:
    """The verdict alone; parts that look alike are named below it."""
    names = [effect_title(e["name"]) + (f" ({variant})" if (variant := wording.shortly(e)) else "") for e in answer.effects]
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


def reason_text(answer: Answer) -> str:
    """What the verdict rests on, or how far an interrupted diagnosis came."""
    return in_words(answer.reason)


def part_named(answer: Answer, names: list[str]) -> str:
    """What is named but does not do alone, with its verb."""
    if answer.confusable:
        return f"One of {len(names)} effects that this campaign cannot tell apart, {listed(names)}, is"
    return f"{listed(names).capitalize()} {'is' if len(names) == 1 else 'are'}"


def unused(answer: Answer, best: dict[str, Any]) -> Card:
    """Error on what was not fitted; green only if runs that were held out show that it fell."""
    worse = best["held_out_error_after"] >= best["held_out_error_before"]
    judged = answer.effects if wording.fitted_together(answer) else [best]
    by_runs, drowned = wording.by_unused_runs(answer, best), wording.below_noise(answer, best)
    return Card(
        "Error on unused conditions" if by_runs else "Error on conditions left out in turn",
        number(best["held_out_error_after"]),
        f"with {' + '.join(effect_title(e['name']) for e in judged)}" + ("; the samples are off by less than their noise" if drowned else ""),
        number(best["held_out_error_before"]),
        "in the patterns that matter" if drowned else "times noise",
        "bad" if worse else "good" if wording.is_shown(answer, best) else "plain",
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
            made.append(unused(answer, best))
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
