"""Key figures beside one another: as measured, of the model before, and with what was added to it."""

from collections.abc import Sequence

from discrepancy.extend import Extension
from discrepancy.key_figures import KeyFigure, furthest
from discrepancy.page import amounts, whys
from discrepancy.page.comparison import FEW_FIGURES
from pages.content import Section, Table
from pages.words import number


def changed_figures(result: Extension) -> list[Section]:
    """Of many figures those that were furthest off before, all of them folded; nothing where none is read."""
    before = [f for f, _ in result.figures]
    if not before:
        return []
    after = {id(f): changed for f, changed in result.figures}
    worst = [(f, after[id(f)]) for f in furthest(before)[:FEW_FIGURES]]
    tables = [table(worst)]
    lead = "Read alike from what was measured and from both models, each calibrated to this campaign as in a comparison."
    if len(before) > len(worst):
        lead += f" Of {len(before)} each is shown where it was furthest off."
        tables.append(table(result.figures, f"All {len(before)} key figures"))
    return [Section("figures", "Key figures", lead, [], tables)]


def table(pairs: Sequence[tuple[KeyFigure, KeyFigure]], folded: str = "") -> Table:
    rows = []
    for before, after in pairs:
        texts = [amounts.text(v, before.unit, before.told_as) for v in (before.measured, before.noise, before.model, after.model)]
        off = f"{number(abs(before.off))} → {number(abs(after.off))}"
        rows.append([amounts.signal_title(before.signal), before.condition, before.name, *texts, off])
    head = ["signal", "condition", "figure", "measured", "noise", "model before", "with the effect", "off, in noise"]
    return Table("", head, rows, (3, 4, 5, 6, 7), whys=[whys.of_key_figure(after) for _, after in pairs], folded=folded)
