"""The pages of an extension and of a model with its ladder."""


from discrepancy.extend import DID_NOT_HELP, HELPED, Extension
from discrepancy.ladder_step import Step, step_of, steps_of
from discrepancy.model_file import ModelFile
from discrepancy.page import amounts, bars, ladder, whys
from discrepancy.page.changed_figures import changed_figures
from discrepancy.words.as_told import effect_name, is_direction
from discrepancy.words.intervals import pins_in
from discrepancy.words.sample_errors import FITTED, OF_PATTERNS, OF_SAMPLES, PATTERNS, SAMPLES, UNUSED
from discrepancy.words.wording import signals_left
from fmu_src.effect_words import effect_words
from pages.content import Card, Page, Section, Table
from pages.look import Figure
from pages.words import capital, number

TONES = {HELPED: "good", DID_NOT_HELP: "bad"}


def extension_page(result: Extension) -> Page:
    step = step_of(result.step)
    kept = "" if step.kept else " The model stays as it was."
    finding = (
        f"{step.label.capitalize()}: {result.verdict}. "
        f"{reason_text(step)}.{kept if 'stays' not in step.reason else ''}"
    )
    finding += left_sentence(step)
    warnings = untold(result.file) + ([] if step.held_out else ["No run was held out: a lower error on fitted runs proves nothing."])
    return Page(
        "An effect added to a model",
        result.file.heading,
        f"judged on campaign {step.campaign}",
        finding,
        cards(step),
        [*changed_figures(result), signals_section(step), ladder_section(result.file), parameters(result.file)],
        warnings,
    )


def untold(file: ModelFile) -> list[str]:
    """What stays open of all that is in the model."""
    return [text for step in steps_of(file.steps) if step.kept for text in step.untold]


def model_page(file: ModelFile) -> Page:
    steps = steps_of(file.steps)
    if not steps:
        return Page("Ladder of a model", file.heading, conditions(file), "No step yet: rvwear extend adds them.", [], [parameters(file)], [])
    kept = [s for s in steps if s.kept]
    judged = [s.held_out for s in kept if s.held_out]
    finding = f"{len(kept)} of {len(steps)} steps are part of the model."
    if judged:
        first, last = kept[0].samples, kept[-1].samples
        if first and last and (first[0], first[2]) == (last[0], last[2]):
            off = f"{number(first[1].before)} → {number(last[1].after)}"
            finding += f" {SAMPLES.capitalize()}: {off} ({amounts.signal_title(last[0])}, {UNUSED if last[2] else FITTED})."
        went = "fell" if judged[-1].after < judged[0].before else "went"
        finding += f" The {PATTERNS} of unused runs {went} from {number(judged[0].before)} to {number(judged[-1].after)} ({OF_PATTERNS})."
    else:
        finding += " None of them was judged on unused runs."
    finding += left_sentence(steps[-1])
    failed = [s.label for s in steps if s.verdict == DID_NOT_HELP]
    if failed:
        finding += f" Did not help: {', '.join(failed)}."
    sections = [
        ladder_section(file),
        Section(
            "signals",
            "Signal by signal",
            f"Every step: {SAMPLES}.",
            [signal_figure(s, k) for k, s in enumerate(steps, start=1) if s.signals],
        ),
        parameters(file),
    ]
    return Page("Ladder of a model", file.heading, conditions(file), finding, cards(kept[-1]) if kept else [], sections, untold(file))


def reason_text(step: Step) -> str:
    """Why a step has its verdict, in the words and signs of a page; steps of before may begin otherwise."""
    text = amounts.in_words(step.reason).replace("->", "→")
    return capital(text)


def left_sentence(step: Step) -> str:
    """What is left after a step, for the end of a finding."""
    text = signals_left(step.left, amounts.signal_title)
    return f" {capital(text)}." if text else ""


def conditions(file: ModelFile) -> str:
    effects = ", ".join(map(effect_words, file.effects)) or "no further effects"
    return f"Reducer {file.reducer.name} with {effects}"


def cards(step: Step) -> list[Card]:
    made = [
        Card(step.label, step.verdict, "kept" if step.kept else "not kept", tone=TONES.get(step.verdict, "fair"))
    ]
    if step.samples:
        signal, off, unused = step.samples
        tone = "good" if unused and step.verdict == HELPED else "plain"
        note = f"{amounts.signal_title(signal)}, {UNUSED if unused else FITTED}"
        made.append(Card(capital(SAMPLES), number(off.after), note, number(off.before), OF_SAMPLES, tone))
    name = capital(PATTERNS)
    for key, text, note in (
        ("held_out", f"{name}, {UNUSED}", "changed too little to decide" if step.unseen else "what the verdict rests on"),
        ("training", f"{name}, {FITTED}", "any effect can lower it"),
    ):
        change = step.change(key)
        if change:
            before, after = change.before, change.after
            decides = key != "training" and not step.unseen
            tone = "bad" if decides and after >= before else "good" if decides and step.verdict == HELPED else "plain"
            made.append(Card(text, number(after), note, number(before), OF_PATTERNS, tone, whys.of_step(key, before, after, len(step.signals))))
    return made


def signal_figure(step: Step, place: int = 0) -> Figure:
    rows = step.signals
    ratio = {k: [getattr(r, k) / r.noise_floor if r.noise_floor > 0.0 else None for r in rows] for k in ("before", "after")}
    before, after = (
        [f"{amounts.text(getattr(r, k), r.unit, r.signal)}, noise {amounts.text(r.noise_floor, r.unit, r.signal)}" for r in rows]
        for k in ("before", "after")
    )
    title = f"Step {place}: {step.label}" if place else capital(SAMPLES)
    caption = (
        f"{capital(step.verdict)}: {reason_text(step)}."
        if place
        else f"Root mean square over the runs of each signal, the noise that of replicates; {OF_SAMPLES}."
    )
    return bars.pairs(
        f"signals_{place}", title, caption, bars.signal_rows(rows), ratio["before"], ratio["after"], (before, after), 6 if place else 12
    )


def signals_section(step: Step) -> Section:
    rows = [
        [
            amounts.signal_title(r.signal),
            "held out" if r.held_out else "fitted",
            *(amounts.text(value, r.unit, r.signal) for value in (r.before, r.after, r.noise_floor)),
        ]
        for r in step.signals
    ]
    table = Table("", ["signal", "runs", "error before", "error after", "noise"], rows, (2, 3, 4))
    return Section(
        "signals",
        "Signal by signal",
        "The new model with its parameters as estimated.",
        [signal_figure(step)] if rows else [],
        [table] if rows else [],
    )


def ladder_section(file: ModelFile) -> Section:
    steps = steps_of(file.steps)
    if not steps:
        return Section("ladder", "Ladder", "No step yet.")
    rows = [
        [
            str(k),
            s.label,
            s.campaign,
            change(s, "training"),
            change(s, "held_out"),
            s.verdict + ("" if s.kept else ", not kept"),
            s.reason,
        ]
        for k, s in enumerate(steps, start=1)
    ]
    head = ["step", "effect", "campaign", "fitted runs", "unused runs", "verdict", "why"]
    return Section(
        "ladder",
        "Ladder",
        f"Every attempt, those that did not help too. What counts are the unused runs, and the {PATTERNS} there ({OF_PATTERNS}).",
        [ladder.figure(steps)],
        [Table("", head, rows, (3, 4))],
    )


def change(step: Step, key: str) -> str:
    found = step.change(key)
    return f"{number(found.before)} → {number(found.after)}" if found else "–"


def parameters(file: ModelFile) -> Section:
    rows = []
    for effect, entries in file.effects.items():
        for k, (name, entry) in enumerate(entries.items()):
            both = {
                "value": entry["value"],
                "direction": is_direction(effect, name),
                "unit": entry.get("unit", "1"),
                "interval": [entry.get("low", entry["value"]), entry.get("high", entry["value"])],
            } | ({"alike": entry["alike"]} if "alike" in entry else {}) | pins_in(name, entry["value"], file.reducer)
            value, interval, unit = amounts.estimate(both)
            rows.append([effect_words(effect) if k == 0 else "", effect_name(effect, name), value, interval if "low" in entry else "", unit])
    lead = "As the model file has them." if rows else "The model carries no effect beyond its reducer."
    return Section(
        "effects",
        "Effects of the model",
        lead,
        [],
        [Table("", ["effect", "parameter", "value", "95 % interval", "unit"], rows, (2, 3))] if rows else [],
    )
