"""What the commands of the loop show on the screen."""

from collections.abc import Mapping, Sequence
from typing import Any

from rich.console import Console
from rich.table import Table

from cli.columns import fill
from cli.screen import BETWEEN, WIDTH, console, dense, styled
from cli.show.would_show import show_would_show
from discrepancy.compare import Comparison, calibrated_texts
from discrepancy.doubts.calibrated_deviations import unsure_text
from discrepancy.experiment.next_run import NextRun
from discrepancy.extend import HELPED, Extension
from discrepancy.figures.figure_digits import figure_texts, plain_text
from discrepancy.figures.key_figures import KeyFigure
from discrepancy.figures.told_figures import drawn_text, others_text, told_figures
from discrepancy.inference.chance import chance_number
from discrepancy.inference.misfit.localise import Localisation
from discrepancy.inference.next_experiment import ENOUGH, NextExperiment
from discrepancy.inference.verdict import NONE
from discrepancy.ladder_step import step_of
from discrepancy.model_file import ModelFile
from discrepancy.prediction.orders import apart_from_remark
from discrepancy.scales import estimate_texts, parameter_texts, shown
from discrepancy.verdict import Answer
from discrepancy.words.as_told import tables_of, told_name
from discrepancy.words.held_shapes import held_text
from discrepancy.words.left_sizes import left_sizes
from discrepancy.words.pin_shapes import shape_text
from discrepancy.words.sample_errors import COUNTED, FITTED, OF_SAMPLES, PATTERNS, SAMPLES, UNUSED, ratio
from discrepancy.words.standing_notes import shortened
from discrepancy.words.waves import waves_of
from discrepancy.words.wording import (
    NEAREST,
    SHARE,
    base_texts,
    error_text,
    fitted_together,
    left_text,
    other_form_text,
    percent_of_misfit,
    shares_text,
    signals_left,
    stand_ins,
    together_text,
    told_apart_by,
    turned_down,
    variant_text,
    with_base_text,
)

LONGEST = 12
# Figures further off than so many times the noise need no decimals.
WHOLE = 100.0


def show_warnings(out: Console, warnings: list[str]) -> None:
    for text in warnings:
        out.print(styled(("note", "yellow"), f" {text}"))


def ratio_colour(ratio: float, held_out: bool) -> str:
    """Green is kept for what runs show that were not fitted."""
    return "red" if ratio > 2.0 else "yellow" if ratio > 1.3 else "green" if held_out else ""


def show_comparison(comparison: Comparison) -> None:
    out = console(WIDTH)
    table = Table(title=f"{comparison.model.file.heading} against {comparison.model.campaign.name}: {SAMPLES} ({OF_SAMPLES})", title_justify="left")
    for name in ("signal", "runs", "", "error", "noise", "error/noise"):
        table.add_column(name, justify="left" if name in ("signal", "") else "right")
    for row in comparison.signals:
        table.add_row(row["signal"], str(row["runs"]), "held out" if row["held_out"] else "fitted",
                      shown(row["error"], row["unit"], row["signal"]), shown(row["noise_floor"], row["unit"], row["signal"]),
                      styled((f"{row['ratio']:.2f}", ratio_colour(row["ratio"], row["held_out"]))))
    out.print(table)
    if comparison.nuisances:
        out.print("calibrated to this campaign before anything was compared:")
        for text in calibrated_texts(comparison.model, comparison.nuisances, comparison.diagnostician.space.base):
            out.print(f"  {text}")
        if unsure := unsure_text(comparison.diagnostician.space.base):
            out.print(f"  {unsure}")
    show_figures(comparison.figures, out, comparison.model.file, bool(comparison.nuisances), of_chance=comparison.of_chance)
    show_localisation(comparison.diagnostician.localisation, out)
    show_warnings(out, comparison.warnings)


def show_figures(figures: list[KeyFigure], out: Console, file: ModelFile, calibrated: bool, after: Sequence[KeyFigure] = (), added: str = "",
                 of_chance: str = "") -> None:  # fmt: skip
    """Key figures, a row for each kind with the condition where it is furthest off, and one where that is another ``after``; the signal first that has
    the furthest.

    ``after``: the same with what was ``added`` to the model, if anything was; ``of_chance``: what chance makes of them.
    """
    told = told_figures(figures, after)
    if not told:
        return
    table = dense(f"key figures, measured against {file.in_words}" + (" as it was calibrated to this campaign" if calibrated else "")
                  + (f", and with {added} in it" if after else ""))  # fmt: skip
    more = {id(f): changed for f, changed in zip(figures, after)}
    heads = ("figure", "condition", "measured", "noise", "model", *["with it"] * bool(after), "", "off/noise")
    numbers = ("measured", "noise", "model", "with it", "off/noise")
    rows = figure_rows(told, more)
    fill(table, dict(zip(heads, zip(*rows))), out.width - BETWEEN * len(heads), ["figure", "condition"], right=[name for name in heads if name in numbers])
    out.print(table)
    for remark in dict.fromkeys(filter(None, (apart_from_remark(f.name)[1] for f in told))):
        out.print(remark)
    if others := others_text(figures, after):
        out.print(f"{others}: --json lists all")
    if drawn := drawn_text(told, [more[id(f)] for f in told] if after else ()):
        out.print(drawn)
    if of_chance:
        out.print(of_chance)


def figure_rows(figures: Sequence[KeyFigure], after: Mapping[int, KeyFigure]) -> list[tuple[str, ...]]:
    """Cells of key figures in groups, their signal in a line above each: in a column of its own it would take the room that names need.

    ``after``: by their identity what they are with an effect, of all or of none.
    """
    width = 8 if after else 7
    groups: dict[str, list[KeyFigure]] = {}
    for f in figures:
        groups.setdefault(f.signal, []).append(f)
    rows: list[tuple[str, ...]] = []
    for signal, members in groups.items():
        rows += [("",) * width] * bool(rows) + [(f"{signal}:", *[""] * (width - 1)), *(figure_row(f, after.get(id(f))) for f in members)]
    return rows


def figure_row(f: KeyFigure, after: KeyFigure | None) -> tuple[str, ...]:
    both = [f, *([after] if after else [])]
    unit, (measured, noise, *models) = figure_texts(f, *(one.model for one in both), text=plain_text)
    off = " -> ".join(f"{abs(one.off):.{0 if abs(one.off) >= WHOLE else 1}f}" for one in both)
    return apart_from_remark(f.name)[0], f.condition, measured, noise, *models, "" if unit == "1" else unit, off


def show_localisation(localisation: Localisation, out: Console | None = None) -> None:
    """Where the misfit is; all tests together at the stated level."""
    out = out or console(WIDTH)
    findings = localisation.largest
    if not findings:
        out.print("no place, order or dependence carries a significant misfit")
        return
    table = dense("where the model fails (significant over all tests together)")
    for name in ("signal", "what", "depends on", "of all misfit", "p"):
        table.add_column(name, justify="right" if name in ("of all misfit", "p") else "left")
    for g in findings[:LONGEST]:
        table.add_row(g.signal, g.feature, g.dependence, percent_of_misfit(g.share), chance_number(g.p))
    out.print(table)
    if len(findings) > LONGEST:
        out.print(f"and {len(findings) - LONGEST} more: --json lists all")
    if len({g.signal for g in localisation.groups}) > 1:
        out.print(f"of all misfit: {SHARE}")


def show_answer(answer: Answer, standing: Mapping[str, str] = {}) -> None:
    """``standing``: notes that a comparison, which comes first, says whole, each with its short form."""
    out = console(WIDTH)
    out.print(styled("verdict  ", (answer.verdict, "bold"), f": {answer.reason}"))
    for text in base_texts(answer):
        out.print(f"\nbase off: {text}")
    for effect in answer.effects:
        variant = f" ({variant_text(effect)})" if variant_text(effect) else ""
        out.print(styled("\n", (effect["name"], "bold"), f"{variant}  {shares_text(answer, effect)}"))
        if shape := shape_text(effect, answer.model):
            out.print(f"  {shape}")
        if effect["forms"]:
            # Each is added by itself: whose a value is says its heading.
            for form, names in effect["forms"].items():
                out.print(f"  {form.replace('_', ' ')}:")
                show_parameters({name: effect["parameters"][name] for name in names}, answer, out, "    ")
        else:
            show_parameters(effect["parameters"], answer, out, "  ")
        for other in effect.get("other_forms", ()):
            out.print(f"  {other_form_text(other)}:")
            show_parameters(other["parameters"], answer, out, "    ")
        if held := held_text(effect["name"], answer.model):
            out.print(f"  {held}")
        error = "" if fitted_together(answer) else error_text(answer, effect)
        if error:
            out.print(f"  {error}")
    together = together_text(answer)
    if together:
        out.print(f"\n{together}")
    left = left_text(answer)
    if left:
        out.print(f"\nnot explained: {left}")
    if sizes := left_sizes(answer):
        out.print(f"{SAMPLES}, with what is named: {sizes}")
    if answer.confusable:
        out.print(f"\nthis campaign cannot tell apart: {', '.join(told_apart_by(answer))}; `rvwear next` proposes what would")
    for text in stand_ins(answer).values():
        out.print(text)
    for law in answer.laws:
        out.print(f"\nlaw without a name: {law.text}")
    show_warnings(out, shortened(answer.warnings, standing))
    show_figures(answer.figures, out, answer.model.file, bool(answer.diagnosis.nuisances), answer.figures_after, answer.added, answer.of_chance)
    if answer.would_show:
        show_would_show(answer.would_show, out)
    rejected = turned_down(answer)[:NEAREST]
    if rejected:
        # Of nothing there are no rivals.
        out.print("\nwhat came nearest, none of it significant" if answer.verdict == NONE else "\nclosest rivals")
        for rival in rejected:
            out.print(f"  {rival['name']}: {rival['reason']}")


def show_parameters(parameters: Mapping[str, Mapping[str, Any]], answer: Answer, out: Console, indent: str) -> None:
    """Estimates with their intervals, a line each, behind ``indent``."""
    # Waves by their size, largest first: of ten numbers that is what one asks for.
    for wave in sorted(waves_of(parameters), key=lambda w: -w.amplitude):
        value, interval, unit = parameter_texts(wave.amplitude, wave.interval, wave.unit)
        names = " and ".join(told_name(name, tables_of(answer.model)) for name in (wave.cosine, wave.sine))
        out.print(f"{indent}amplitude of {names} = {value}{unit and f' {unit}'}   95 %: {interval}; phase {wave.phase:.0f} deg")
    for name, number in parameters.items():
        value, interval, unit = estimate_texts(number)
        bound = "   a bound: it is more than all that was measured" if number.get("bound") else ""
        out.print(f"{indent}{told_name(name, tables_of(answer.model))} = {value}{unit and f' {unit}'}   95 %: {interval}{bound}")
        if number.get("meaning"):
            out.print(f"{indent}  {number['meaning']}")
        if more := with_base_text(number):
            out.print(f"{indent}  {more}")


def show_extension(extension: Extension) -> None:
    out = console(WIDTH)
    step = extension.step
    colour = "green" if extension.verdict == HELPED else "yellow"
    out.print(styled(f"{' + '.join(step['effects'])}: ", (extension.verdict, f"bold {colour}"), f"; {step['reason']}"))
    for row in step["signals"]:
        where = "held out" if row["held_out"] else "fitted"
        before, after, noise = (shown(row[k], row["unit"], row["signal"]) for k in ("before", "after", "noise_floor"))
        ratios = " -> ".join(f"{ratio(row[k], row['noise_floor']):.2f}" for k in ("before", "after"))
        out.print(f"  {row['signal']} ({where}): {SAMPLES} {ratios} ({before} -> {after}, noise {noise})")
    for name in dict.fromkeys(candidate.partition(".")[0] for candidate in step["effects"]):
        if held := held_text(name, extension.file):
            out.print(f"  {name}: {held}")
    if step["kept"]:
        show_warnings(out, step.get("untold", ()))
    show_left(step, out)


def show_ladder(file: ModelFile) -> None:
    out = console(WIDTH)
    if not file.steps:
        out.print(f"{file.heading} has no steps yet: rvwear extend adds them")
        return
    table = Table(title=f"{file.heading}: step by step", title_justify="left")
    for name in ("step", "campaign", SAMPLES, f"{PATTERNS}, {FITTED}", f"{PATTERNS}, {UNUSED}", "verdict"):
        table.add_column(name, justify="left", overflow="fold")
    for step in file.steps:
        told = step_of(step).samples
        samples = f"{told[1].before:.2f} -> {told[1].after:.2f}" if told else "-"
        fitted, unused = (
            "-" if step.get(f"{runs}_before") is None else f"{step[f'{runs}_before']:.2f} -> {step[f'{runs}_after']:.2f}"
            for runs in ("training", "held_out")
        )
        verdict = step.get("verdict", "") + ("" if step.get("kept", True) else ", not kept")
        table.add_row(" + ".join(step["effects"]), step.get("campaign", ""), samples, fitted, unused, verdict)
    out.print(table)
    out.print(f"{SAMPLES}: of the signal that was furthest off, of {UNUSED} where there are, {OF_SAMPLES}\n{PATTERNS}: {COUNTED}")
    show_left(file.steps[-1], out)


def show_left(step: Mapping[str, Any], out: Console) -> None:
    """An error that fell is not yet all of it."""
    if text := signals_left(step_of(step).left):
        out.print(styled((text, "yellow")))


def show_next(run: NextRun) -> None:
    out = console(WIDTH)
    for line in run.lines:
        out.print(line)
    if run.result is not None:
        show_proposals(run, run.result, out)
    show_asked(run, out)


def show_proposals(run: NextRun, result: NextExperiment, out: Console) -> None:
    """What would tell the rivals apart, and what it costs not to know."""
    table = Table(title=f"to separate {', '.join(run.rivals)}", title_justify="left")
    separations = "least separation [chi-square]", "mean separation [chi-square]"
    for name in ("experiment", f"cost{f' [{run.cost_unit}]' if run.cost_unit else ''}", *separations):
        table.add_column(name, justify="left" if name == "experiment" else "right")
    for p in result.proposals[:LONGEST]:
        table.add_row(p.experiment, f"{p.cost:g}", f"{p.least:.1f}", f"{p.score:.1f}")
    out.print(table)
    out.print(f"separations in chi-square, parameters of the effects free within what is known of them: {ENOUGH:g} is enough")
    for name, text in run.stakes().items():
        out.print(f"what it costs not to know: at {name} the rivals differ by up to {text}")


def show_asked(run: NextRun, out: Console) -> None:
    """What would show a misfit better that nothing explains, each with where, cost and what is expected of it."""
    if run.asked and run.answer.would_show:
        out.print("what these runs cannot show, whatever it is, and what would")
    for a in run.asked:
        # Of a design it is said what it does not show, then what would.
        out.print(f"  {a.why}: {a.experiment}" if run.answer.would_show else f"  {a.text}")
        cost = "" if a.cost is None else f"cost {a.cost:g} {run.cost_unit}".rstrip()
        expected = "" if a.expected is None else f"expected misfit {a.expected:.3g} in chi-square, of two runs that are off as those so far"
        if more := "; ".join(filter(None, (a.like, cost, expected))):
            out.print(f"    {more}")
