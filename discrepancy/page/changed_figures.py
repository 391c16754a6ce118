"""Key figures beside one another: as measured, of the model before, and with what was added to it."""

from collections.abc import Sequence

from discrepancy.extend import Extension
from discrepancy.figures.key_figures import KeyFigure
from discrepancy.figures.told_figures import drawn_text, others_text, told_figures
from discrepancy.page import amounts, whys
from discrepancy.page.comparison import figures_section
from discrepancy.verdict import Answer
from pages.content import Section, Table
from pages.words import capital, number


def changed_figures(result: Extension) -> list[Section]:
    """Those of an extension; nothing where none is read."""
    return section(result.figures, "Read alike from what was measured and from both models, each calibrated to this campaign as in a comparison.")


def figures_of_answer(answer: Answer) -> list[Section]:
    """Those of a diagnosis: of the base model, and with what is named in it where something was fitted."""
    calibrated = bool(answer.diagnosis.nuisances)
    if not answer.figures_after:
        return figures_section(answer.figures, answer.model.file, calibrated, answer.of_chance)
    lead = (
        f"Read alike from what was measured, from {answer.model.file.in_words} and from it with {amounts.effects_title(answer.added)}, as fitted"
        f"{', each calibrated to this campaign' if calibrated else ''}."
    )
    return section(list(zip(answer.figures, answer.figures_after, strict=True)), lead)


def section(pairs: Sequence[tuple[KeyFigure, KeyFigure]], lead: str) -> list[Section]:
    """Of many figures those that were furthest off before or are after, all of them folded; nothing where none is read."""
    before, changed = [f for f, _ in pairs], [f for _, f in pairs]
    if not before:
        return []
    after, told = {id(f): later for f, later in pairs}, told_figures(before, changed)
    tables = [table([(f, after[id(f)]) for f in told])]
    if drawn := drawn_text(told, [after[id(f)] for f in told]):
        lead += f" {capital(drawn)}."
    if others := others_text(before, changed):
        lead += f" Shown are {others}."
        tables.append(table(pairs, f"All {len(before)} key figures"))
    return [Section("figures", "Key figures", lead, [], tables)]


def table(pairs: Sequence[tuple[KeyFigure, KeyFigure]], folded: str = "") -> Table:
    rows = []
    for before, after in pairs:
        texts = amounts.figure_cells(before, before.model, after.model)
        off = f"{number(abs(before.off))} → {number(abs(after.off))}"
        rows.append([amounts.signal_title(before.signal), before.condition, before.name, *texts, off])
    head = ["signal", "condition", "figure", "measured", "noise", "model before", "with the effect", "off, in noise"]
    return Table("", head, rows, (3, 4, 5, 6, 7), whys=[whys.of_key_figure(after) for _, after in pairs], folded=folded)
