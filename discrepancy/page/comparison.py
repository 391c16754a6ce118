"""The page of a comparison: measured against predicted, and where they differ."""

from collections.abc import Sequence
from dataclasses import asdict, replace
from typing import Any

from discrepancy.compare import CONSPICUOUS, Comparison, calibrated_numbers, digits_beside
from discrepancy.doubts.calibrated_deviations import AT_BOUND, deviations_of, stands_at_bound, unsure_text
from discrepancy.figures.key_figures import KeyFigure
from discrepancy.figures.told_figures import drawn_text, others_text, told_figures
from discrepancy.inference.chance import chance
from discrepancy.inference.noise.series import stream_of
from discrepancy.model_file import ModelFile
from discrepancy.page import amounts, maps, numbers, panels, series, spectra, whys
from discrepancy.page.runs import Run, by_signal, runs_of
from discrepancy.scales import of_axis
from discrepancy.verdict import Answer
from discrepancy.words.sample_errors import SAMPLES
from discrepancy.words.wording import percent_of_misfit
from fmu_src.effect_words import effect_words
from pages.content import Card, Page, Section, Table
from pages.look import Figure
from pages.words import capital, counted, number

FITTED, HELD = "fitted", "held out"
MOST_CARDS = 6


def page(result: Comparison) -> Page:
    space = result.diagnostician.space
    speed = of_axis("speed", result.model.campaign)
    runs, apart = (runs_of(space, result.predictions, speed, left_out=gone) for gone in (False, True))
    orders, no_orders = order_figures(runs)
    gone = ", ".join(left_out(result))
    but = f" ({gone}: left out)" if gone else ""
    # What one asks first: numbers, then curves, then maps.
    sections = [
        *figures_section(result.figures, result.model.file, bool(result.nuisances), result.of_chance),
        Section(
            "runs",
            "Measured against predicted",
            " ".join([f"Every run of the campaign{but} beside the model's prediction of it.", *no_orders]),
            run_figures("run", runs, gone=apart) + orders,
        ),
        errors(result),
        localisation_section(
            [asdict(g) for g in result.diagnostician.localisation.groups],
            result.diagnostician.localisation.conditions,
            result.diagnostician.localisation.level,
        ),
        nuisances(result),
    ]
    return Page(
        "Model against measurement",
        title(result),
        conditions(result, runs),
        finding(result),
        cards(result),
        sections,
        list(dict.fromkeys(result.warnings)),
        sections[0].id if result.figures else "",
    )


def title(result: Comparison | Answer) -> str:
    name, campaign = result.model.file.heading, result.model.campaign.name
    return f"{name} against {campaign}" if campaign else name


def conditions(result: Comparison | Answer, runs: list[Run]) -> str:
    """How much was measured, and what the model carries."""
    held = [run.record for run in runs if run.record.held_out]
    of_them = f"{counted(len(held), 'run')} at {counted(len({record.condition for record in held}), 'condition')}" if held else "none"
    count = len({run.record.condition for run in runs})
    effects = ", ".join(map(effect_words, result.model.file.effects))
    gone = ", ".join(left_out(result))
    left = f"left out: {gone}; " if gone else ""
    return f"{counted(len(runs), 'run')} at {counted(count, 'condition')}; held out: {of_them}; {left}" + (
        f"model with {effects}" if effects else "model without further effects"
    )


def left_out(result: Comparison | Answer) -> list[str]:
    """Repetitions that stand out: no run of the page."""
    return [record.name for record in result.model.records if record.left_out]


def finding(result: Comparison) -> str:
    """Worst signal, and what of it is off most, as far as the localisation finds anything."""
    found = result.diagnostician.localisation.largest
    worst = max(result.signals, key=lambda s: s["ratio"], default=None)
    if worst is None:
        return "Nothing that was measured can be predicted by this model."
    counting = [r for r in result.runs if not r["left_out"]]
    off = [r for r in counting if r["ratio"] > CONSPICUOUS]
    start = (
        f"{len(off)} of {len(counting)} runs err by more than {CONSPICUOUS:g} times their noise; the worst "
        f"signal is {place(worst)} with {number(worst['ratio'])} times its noise."
    )
    if not found:
        return start + " No place, order or dependence carries a significant misfit."
    best = next((g for g in found if g.signal == worst["signal"]), found[0])
    where = "at all conditions alike" if best.dependence == "everywhere" else f"changing with {best.dependence.replace('_', ' ')}"
    return (
        start
        + f" What is off most in {amounts.signal_title(best.signal)}: {best.feature}, {where}"
        f" ({percent_of_misfit(best.share)} of all misfit, {chance(best.p)})."
    )


def place(row: dict[str, Any]) -> str:
    return f"{amounts.signal_title(row['signal'])} ({HELD if row['held_out'] else FITTED})"


def tone(ratio: float, held_out: bool) -> str:
    """Good is kept for runs that were not fitted."""
    return "bad" if ratio > 2.0 else "fair" if ratio > 1.3 else "good" if held_out else "plain"


def cards(result: Comparison) -> list[Card]:
    """All signals; of many only what was held out, if anything was."""
    rows = result.signals
    if len(rows) > MOST_CARDS:
        rows = [r for r in rows if r["held_out"]] or rows
    return [
        Card(
            capital(place(row)),
            number(row["ratio"]),
            f"{amounts.text(row['error'], row['unit'], row['signal'])} over {counted(row['runs'], 'run')}, noise"
            f" {amounts.text(row['noise_floor'], row['unit'], row['signal'])}",
            unit="times noise, all samples",
            tone=tone(row["ratio"], row["held_out"]),
            why=whys.of_error(result.diagnostician.space, row),
        )
        for row in rows
    ]


def errors(result: Comparison) -> Section:
    """Table per signal, heat map per signal and condition."""
    cells: dict[tuple[str, str], list[float]] = {}
    for run in result.runs:
        if not run["left_out"]:
            cells.setdefault((run["signal"], run["condition"]), []).append(run["ratio"])
    held = {run["condition"] for run in result.runs if run["held_out"]}
    heat = maps.grid(
        "Error over noise by signal and condition",
        "Root mean square over all samples of the replicates; pale is as good as the noise allows, white was not measured.",
        "error_map",
        {k: series.rms(v) for k, v in cells.items()},
        held,
    )
    rows = [
        [
            amounts.signal_title(s["signal"]),
            HELD if s["held_out"] else FITTED,
            str(s["runs"]),
            amounts.text(s["error"], s["unit"], s["signal"]),
            amounts.text(s["noise_floor"], s["unit"], s["signal"]),
            number(s["ratio"]),
        ]
        for s in result.signals
    ]
    table = Table("Error and noise per signal", ["signal", "runs", "number", "error", "noise", SAMPLES], rows, (2, 3, 4, 5),
                  whys=[whys.of_error(result.diagnostician.space, s) for s in result.signals])
    lead = "Root mean squares over all samples. Noise is what replicates of one condition differ by."
    # A map of one condition says what the table says.
    return Section("errors", "Error against noise", lead, [heat] if len({condition for _, condition in cells}) > 1 else [], [table])


def localisation_section(places: list[dict[str, Any]], by_condition: dict[str, dict[str, float]], level: float) -> Section:
    """Where the misfit is; also of a diagnosis."""
    findings = [p for p in places if p["p"] <= level]
    lead = (
        (
            "Generic functions of the misfit, signal by signal, tested against the noise of replicates and corrected "
            f"for their number. {len(findings)} of {len(places)} are significant."
        )
        if findings
        else "No place, order or dependence carries a significant misfit."
    )
    figures, tables = maps.localisation("place", places, level)
    cells = {(signal, c): float(v) for signal, row in by_condition.items() for c, v in row.items()}
    if len({condition for _, condition in cells}) > 1:
        figures.insert(
            0,
            maps.grid(
                "Misfit by signal and condition",
                "Of the generic functions alone, root of the variance ratio: much sharper than the error over all samples.",
                "misfit_map",
                cells,
                bar="misfit / noise",
            ),
        )
    return Section("localisation", "Where the model fails", lead, figures, tables)


def run_figures(prefix: str, runs: list[Run], words: tuple[str, str, str] = panels.WORDS, gone: Sequence[Run] = ()) -> list[Figure]:
    """A figure per signal: series over their axis, numbers over their factors, with repetitions that are left out (``gone``); series first."""
    drawn = []
    for signal, members in by_signal(runs).items():
        apart = [r for r in gone if stream_of(r.record) == signal and r.measured.size]
        lines = [r for r in members if r.series]
        single = [r for r in members if not r.series]
        if lines:
            drawn.append(series.figure(prefix, signal, lines, words, gone=[r for r in apart if r.series]))
        if single:
            drawn.append(numbers.figure(f"{prefix}_number", signal, single, words, gone=[r for r in apart if not r.series]))
    return sorted(drawn, key=lambda f: -f.columns)


def order_figures(runs: list[Run]) -> tuple[list[Figure], list[str]]:
    """Orders of measured and predicted over each other, of signals that were measured over whole turns; of others over the angle why there are none."""
    figures, reasons = [], []
    for signal, members in by_signal(runs).items():
        drawn, why = spectra.figure("orders", signal, [r for r in members if r.series], ("measured", "predicted"))
        figures += [drawn] if drawn else []
        reasons += [f"{capital(amounts.signal_title(signal))}: {why}"] if why else []
    return figures, reasons


def figures_section(figures: list[KeyFigure], file: ModelFile, calibrated: bool, of_chance: str = "") -> list[Section]:
    """Key figures, measured against the model as it stands in ``file``; also of a diagnosis.  Of many those that are furthest off, all of them folded."""
    if not figures:
        return []
    lead = (
        f"Read alike from what was measured and from what {file.in_words} predicts there. Noise is what repetitions differ by, over the root of their"
        " number; where nothing is repeated, what the noise of the samples makes of it."
    )
    if calibrated:
        lead += " The model's are those after its calibration to this campaign; rvwear hysteresis and bench give them without it."
    if drawn := drawn_text(told_figures(figures)):
        lead += f" {capital(drawn)}."
    if of_chance:
        lead += f" {capital(amounts.in_words(of_chance))}."
    if not (others := others_text(figures)):
        return [Section("figures", "Key figures", lead, [], [figures_table(figures, calibrated)])]
    tables = [figures_table(told_figures(figures), calibrated), replace(figures_table(figures, calibrated), folded=f"All {len(figures)} key figures")]
    return [Section("figures", "Key figures", f"{lead} Shown are {others}.", [], tables)]


def figures_table(figures: list[KeyFigure], calibrated: bool) -> Table:
    rows = []
    for f in figures:
        measured, noise, model = amounts.figure_cells(f, f.model)
        rows.append([amounts.signal_title(f.signal), f.condition, f.name, measured, noise, model, number(abs(f.off))])
    head = ["signal", "condition", "figure", "measured", "noise", "model, calibrated" if calibrated else "model", "off, in noise"]
    return Table("", head, rows, (3, 4, 5, 6), whys=[whys.of_key_figure(f) for f in figures])


def nuisances(result: Comparison) -> Section:
    base = result.diagnostician.space.base
    known, deviations = {p.name: p for p in result.model.nuisances}, deviations_of(base)
    rows = []
    for name, (told, value, scale) in zip(result.nuisances, calibrated_numbers(result.model, result.nuisances)):
        parameter = known.get(name)
        prior = f"{number(scale.number(parameter.off))} ± {number(scale.factor * parameter.prior)}" if parameter and parameter.prior else ""
        size = abs(scale.factor) * deviations.get(name, 0.0)
        sure = f"{number(scale.number(value), digits_beside(scale.number(value), size))}{f' ± {number(size, 2)}' if size > 0.0 else ''}"
        doubt = AT_BOUND if stands_at_bound(base, name) else ""
        rows.append([told, sure, amounts.pretty(scale.unit), prior, "; ".join(filter(None, [parameter.description if parameter else "", doubt]))])
    lead = (
        f"Fitted to the campaign before anything was compared; {unsure_text(base).replace('+-', '±') or '± is the standard deviation that noise leaves'}."
        if rows
        else "Nothing was declared for calibration: the model stands as it is."
    )
    table = Table("", ["parameter", "value", "unit", "known before", "meaning"], rows, (1,))
    return Section("nuisances", "Calibrated", lead, [], [table] if rows else [])
