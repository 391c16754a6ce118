"""Which key figures a table has: one row of each kind, where it is furthest off; of very many kinds the nearest are left out, and named."""

from collections.abc import Sequence

from discrepancy.figures.key_figures import LOST_MOTION, SPAN, STIFFNESS, WIDTH, KeyFigure, furthest

# So many kinds have a row each; those that a reducer's catalogue has do, however near they are.
MOST, CATALOGUE = 16, (STIFFNESS, LOST_MOTION, WIDTH, SPAN)
# So many kinds that are left out are named.
MOST_NAMED = 4


def told_figures(figures: Sequence[KeyFigure]) -> list[KeyFigure]:
    """Each kind of figure where it is furthest off, the furthest first."""
    return [f for i, f in enumerate(furthest(figures)) if i < MOST or f.name in CATALOGUE]


def others_text(figures: Sequence[KeyFigure]) -> str:
    """What of ``figures`` a table of those that are told does not show; empty where it shows all."""
    told = told_figures(figures)
    if len(told) == len(figures):
        return ""
    shown = {id(f) for f in told}
    left = [f.name for f in furthest(figures) if id(f) not in shown]
    named = f"{'; '.join(left[:MOST_NAMED])}{f'; and {len(left) - MOST_NAMED} more' if len(left) > MOST_NAMED else ''}"
    kinds = f"{len(told)} kinds of figure (furthest off, or of a catalogue; left out are nearer ones: {named})" if left else f"all {len(told)} kinds of figure"
    return f"{kinds}, each where it is furthest off; {len(figures)} figures in all"
