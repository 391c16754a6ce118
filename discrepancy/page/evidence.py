"""The parts of a diagnosis's page: effects, unused conditions, what cannot be separated, rivals, laws."""

from dataclasses import replace
from typing import Any

from discrepancy.inference.noise.series import stream_of
from discrepancy.inference.verdict import NONE, SET, SEVERAL
from discrepancy.page import amounts, bars, laws, maps, whys
from discrepancy.page.amounts import with_minus
from discrepancy.scales import of_axis, of_parameter, parameter_texts
from discrepancy.verdict import Answer
from discrepancy.words.as_told import tables_of, told_name
from discrepancy.words.held_shapes import held_text
from discrepancy.words.sample_errors import COUNTED, OF_PATTERNS, OF_SAMPLES, PATTERNS, SAMPLES
from discrepancy.words.waves import waves_of
from discrepancy.words.wording import (
    NEAREST,
    fitted_together,
    not_judged_text,
    own_form,
    percent,
    stand_in_text,
    together_text,
    told_apart_by,
    turned_down,
    variant_text,
    with_base_text,
)
from fmu_src.effect_words import effect_title as words
from pages import look
from pages.content import Section, Table
from pages.look import Figure
from pages.words import capital, counted, number

MOST_RIVALS = 12
SHARES = "Share of the misfit explained"


def named(effect: dict[str, Any]) -> str:
    variant = variant_text(effect)
    return words(effect["name"]) + (f" ({variant})" if variant else "")


def listed(names: list[str]) -> str:
    return names[0] if len(names) == 1 else ", ".join(names[:-1]) + " and " + names[-1] if names else ""


def effects(answer: Answer) -> Section:
    """Parameters with intervals, and each effect's share."""
    rows, answers = [], []
    for effect, called in [pair for e in answer.effects for pair in ((e, named(e)), *((f, f"or {own_form(f)}") for f in e.get("other_forms", ())))]:
        first = True
        for name, entry in effect["parameters"].items():
            value, interval, unit = amounts.estimate(entry)
            bound = "at a bound of its range" if entry.get("at_bound") else "a bound: it is more than all that was measured" if entry.get("bound") else ""
            beside = amounts.in_words(effect.get("reason") or "") if first else ""
            bound = "; ".join(filter(None, (beside, bound, with_base_text(entry))))
            told = told_name(name, tables_of(answer.model))
            rows.append([called if first else "", effect["part"] if first else "", told, value, interval, unit, entry.get("meaning", ""), bound])
            first = False
            answers.append(whys.of_estimate(answer.diagnosis.fits.space, entry))
        for wave in waves_of(effect["parameters"]):
            value, interval, unit = amounts.estimate({"value": wave.amplitude, "interval": wave.interval, "unit": wave.unit})
            told = f"amplitude, from {told_name(wave.cosine, tables_of(answer.model))} and its sine"
            rows.append(["", "", told, value, interval, unit, "", f"phase {wave.phase:.0f}°"])
            answers.append(whys.of_estimate(answer.diagnosis.fits.space, dict(effect["parameters"][wave.cosine])))
    table = Table("Parameters", ["effect", "part", "parameter", "value", "95 % interval", "unit", "meaning", ""], rows, (3, 4), whys=answers)
    lead = {SET: "Each alone explains the misfit; they are alternatives.", SEVERAL: "All of them together."}.get(
        answer.verdict, "As fitted to the runs that are not held out."
    )
    lead += "".join(f" {words(effect['name'])}: {held}." for effect in answer.effects if (held := held_text(effect["name"], answer.model)))
    return Section("effects", "Effects", lead, [shares(answer)] if answer.verdict != SET and answer.effects[0]["share_explained"] < 0.995 else [], [table])


def shares(answer: Answer) -> Figure:
    """How much of the misfit each effect takes."""
    names, beside = [named(e) for e in answer.effects], [e["share_explained"] for e in answer.effects]
    text = "What an effect takes off the chi-square, of all that is more than noise."
    if not fitted_together(answer):
        texts = [percent(answer, s) for s in beside]
        values = [100.0 * s for s in beside]
        return bars.single("shares", SHARES, text, names, values, "share [%]", [look.NOW] * len(names), texts, 12, range=[0.0, 112.0])
    alone = [e["share_alone"] for e in answer.effects]
    text += f" Effects that do alike take much away alone, and little more when they are added to the others; {together_text(answer).partition(';')[0]}."
    both = [100.0 * s for s in alone], [100.0 * s for s in beside]
    return bars.shares("shares", SHARES, text, names, *both, ([percent(answer, s) for s in alone], [percent(answer, s) for s in beside]))


def base_off(answer: Answer) -> Section:
    """What of the base model itself is off, beside what was assumed of it."""
    rows = []
    for e in answer.diagnosis.base_off:
        value, interval, unit = parameter_texts(e.value, e.interval, e.unit)
        held = of_parameter(abs(e.assumed) or abs(e.value), e.unit)
        told = told_name(e.name, tables_of(answer.model))
        numbers = (value, interval, held.text(e.assumed, 3), held.span(*e.within))
        rows.append([told, *map(with_minus, numbers), unit, e.title])
    table = Table("", ["number", "measured", "95 % interval", "assumed", "held to lie in", "unit", "meaning"], rows, (1, 2))
    lead = (
        "Numbers of the reducer file that are not known for sure, as this campaign has them, and what the base model computes by more off than"
        " was assumed. Such an error is no missing effect."
    )
    return Section("base-off", "The base model is off", lead, [], [table])


def held_out(answer: Answer) -> Section:
    """Error on what was never fitted, before and after."""
    measured = [e for e in answer.effects if e["held_out_error_before"] is not None]
    if not measured:
        return Section(
            "held-out", "On unused conditions", "No run was held out: nothing says how the effect does on conditions that were not fitted."
        )
    rows = answer.diagnosis.held_out
    left_out = any(v.get("kind") for v in rows.values())
    lead = (
        f"{not_judged_text(answer).capitalize()}: each {'other ' if answer.diagnosis.fits.space.held_out else ''}condition was left out in turn."
        if left_out
        else (
            f"Runs that no parameter was fitted to. The {SAMPLES}, is that of the comparison ({OF_SAMPLES}). The {PATTERNS} is taken over those that"
            f" carried it and the effects' own ({OF_PATTERNS}): it stands out of the noise of single samples, and the verdict counts it."
        )
    )
    names = [named(e) for e in measured]
    if fitted_together(answer):
        # Judged together.
        names, measured = [" + ".join(names)], measured[:1]
    before, after = [e["held_out_error_before"] for e in measured], [e["held_out_error_after"] for e in measured]
    hover = [f"{number(v)}, 1 is what noise leaves there" for v in before], [f"{number(v)}, 1 is what noise leaves there" for v in after]
    name = "misfit of a condition that is left out" if left_out else PATTERNS
    caption = f"Before and after; {OF_SAMPLES if left_out else COUNTED}."
    figures = [bars.pairs("held_out", name.capitalize(), caption, names, before, after, hover, axis=f"{name}, over noise")]
    signals: dict[str, dict[str, float]] = next((v["rms"] for v in rows.values() if v.get("rms")), {})
    if signals:
        figures.insert(0, by_signal(answer, signals, names[0]))
    return Section("held-out", "On unused conditions", lead, figures)


def by_signal(answer: Answer, signals: dict[str, Any], effect: str) -> Figure:
    """Plain root mean squares of every sample, signal by signal."""
    units = {stream_of(r): r.unit for r in answer.diagnosis.fits.space.records}
    names = list(signals)
    ratio = {k: [signals[n][k] / signals[n]["floor"] if signals[n]["floor"] > 0.0 else None for n in names] for k in ("before", "after")}
    before, after = (
        [f"{amounts.text(signals[n][k], units.get(n, '1'), n)}, noise {amounts.text(signals[n]['floor'], units.get(n, '1'), n)}" for n in names]
        for k in ("before", "after")
    )
    return bars.pairs(
        "held_out_signals",
        capital(SAMPLES),
        f"Root mean square over the runs of a signal, before and with {effect}; {OF_SAMPLES}.",
        [amounts.signal_title(n) for n in names],
        ratio["before"],
        ratio["after"],
        (before, after),
    )


def confusable(answer: Answer) -> Section:
    """What stands for what, and how alike the responses are."""
    lead = (
        f"This campaign cannot tell apart: {listed(told_apart_by(answer, words))}. rvwear next proposes what would."
        if answer.confusable
        else "Effects that could stand in place of one that is named" + (", beside the others." if fitted_together(answer) else ".")
    )
    tables, figures = [], []
    if answer.diagnosis.alternatives:
        tables.append(
            Table(
                "In place of",
                ["named", "could be, beside the others" if fitted_together(answer) else "could be", "with"],
                [[words(n), words(s.name), with_minus(stand_in_text(answer, s))] for n, others in answer.diagnosis.stand_ins.items() for s in others],
            )
        )
    if answer.diagnosis.correlations:
        figures.append(correlations(answer.diagnosis.correlations))
    return Section("confusable", "What cannot be separated", lead, figures, tables)


def correlations(pairs: dict[str, float]) -> Figure:
    names = list(dict.fromkeys(n for pair in pairs for n in pair.split(" ~ ")))
    value = {(a, b): 1.0 if a == b else pairs.get(f"{a} ~ {b}", pairs.get(f"{b} ~ {a}", float("nan"))) for a in names for b in names}
    z = [[abs(value[a, b]) for b in names] for a in names]
    shown = [words(n) for n in names]
    text = [[f"{value[a, b]:.3f}" if a != b and value[a, b] == value[a, b] else "" for b in names] for a in names]
    hover = [[f"{words(a)} and {words(b)}: {value[a, b]:.4f}" for b in names] for a in names]
    trace = maps.heat(z, shown, shown, text, hover, "correlation", 0.0, 1.0, colours=look.FORCE)
    return Figure(
        "correlations",
        "How alike the responses are",
        "Largest correlation that any parameters of the two can reach on the fitted runs, nuisances taken out; 1 cannot be told apart.",
        [trace],
        maps.layout(shown),
        12 if len(names) > 4 else 8,
        130 + 40 * len(names),
    )


def rivals(answer: Answer) -> Section:
    rejected = turned_down(answer)
    if not rejected:
        return Section("rivals", "Rivals", "No rival came near.")
    rows = [[words(r["name"]), r["reason"]] for r in rejected]
    refitted = [r for r in rejected if r["chi2_difference"] is not None][:MOST_RIVALS]
    count = sum(r["chi2_difference"] is not None for r in rejected)
    fitted = f"{count} {'was' if count == 1 else 'were'} fitted in full, the others fell to the score test." if refitted else ""
    lead = fitted or "None came through the score test."
    if answer.verdict == NONE:
        lead = f"{counted(len(rows), 'effect')}: none improves more than chance would. {fitted}".rstrip()
    figures = []
    if refitted and answer.effects:
        values = [max(r["chi2_difference"], 0.0) for r in refitted]
        figures = [
            bars.single(
                "rivals_by_fit",
                "How much worse the rivals fit",
                "Difference in chi-square to what is named; about 6 tells two effects apart.",
                [words(r["name"]) for r in refitted],
                values,
                "difference in chi-square",
                ["#98a3af"] * len(values),
                [number(v) for v in values],
                12,
            )
        ]
    table = Table("", ["effect", "reason"], rows, whys=[whys.of_rival(r) for r in rejected])
    # The nearest first; a row less is not worth a click.
    shown = max(NEAREST, count)
    tables = [table]
    if len(rows) > shown + 1:
        others = f"The other {len(rows) - shown} effects"
        tables = [replace(table, rows=rows[:shown], whys=table.whys[:shown]), replace(table, rows=rows[shown:], whys=table.whys[shown:], folded=others)]
    title = "What came nearest, none of it significant" if answer.verdict == NONE else "Rivals and why they were turned down"
    return Section("rivals", title, lead, figures, tables)


def recovered(answer: Answer) -> Section:
    """Laws without a name."""
    if not answer.laws:
        lead = "No law was recovered: the campaign has too few points or conditions, or what is left depends on none of them."
        return Section("laws", "The law without a name", lead)
    figures = [f for law in answer.laws for f in laws.figures(law, of_axis("speed", answer.model.campaign))]
    lead = "How what is missing depends on the conditions, as curves with 95 % bands and as closed forms. " + " ".join(
        laws.sentence(law) for law in answer.laws
    )
    return Section("laws", "The law without a name", lead, figures, [laws.table(law) for law in answer.laws if law.forms])
