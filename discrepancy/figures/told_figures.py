"""Which key figures a table has: one row of each kind, where it is furthest off; of very many kinds the nearest are left out, and named."""

from collections.abc import Sequence

from discrepancy.figures.figure_digits import figure_texts, plain_text
from discrepancy.figures.key_figures import LOST_MOTION, SPAN, STIFFNESS, WIDTH, KeyFigure, furthest

# So many kinds have a row each; those that a reducer's catalogue has do, however near they are.
MOST, CATALOGUE = 16, (STIFFNESS, LOST_MOTION, WIDTH, SPAN)
# So many kinds that are left out are named.
MOST_NAMED = 4
# What is further off than so many times its noise with what was added has a row, too, where its kind is shown at another condition.
STILL_OFF = 2.0


def told_figures(figures: Sequence[KeyFigure], after: Sequence[KeyFigure] = ()) -> list[KeyFigure]:
    """Each kind of figure where it is furthest off, the furthest first.

    ``after``: the same with what was added to the model; below a kind stands where that leaves it furthest off.
    """
    told = [f for i, f in enumerate(furthest(figures)) if i < MOST or f.name in CATALOGUE]
    own = {id(changed): f for f, changed in zip(figures, after)}
    left = {(f.signal, f.name): own[id(f)] for f in furthest(after) if abs(f.off) > STILL_OFF}
    rows = []
    for f in told:
        more = left.get((f.signal, f.name), f)
        rows += [f] if more is f else [f, more]
    return rows


def others_text(figures: Sequence[KeyFigure], after: Sequence[KeyFigure] = ()) -> str:
    """What of ``figures`` a table of those that are told does not show; empty where it shows all."""
    told = told_figures(figures, after)
    if len(told) == len(figures):
        return ""
    kinds = {(f.signal, f.name) for f in told}
    left = [f.name for f in furthest(figures) if (f.signal, f.name) not in kinds]
    named = f"{'; '.join(left[:MOST_NAMED])}{f'; and {len(left) - MOST_NAMED} more' if len(left) > MOST_NAMED else ''}"
    what = f"{len(kinds)} kinds of figure (furthest off, or of a catalogue; left out are nearer ones: {named})" if left else f"all {len(kinds)} kinds of figure"
    where = "each where it is furthest off"
    if after:
        where += f" before anything was added, and where it is furthest off with it if that is another condition and more than {STILL_OFF:g} times its noise"
    return f"{what}, {where}; {len(figures)} figures in all"


def drawn_text(told: Sequence[KeyFigure], after: Sequence[KeyFigure] = ()) -> str:
    """How the model's numbers are made where noise is drawn on its curve, and what peak to peak that has by itself; empty where none is.

    ``after``: what those that are ``told`` are with what was added, of all or of none.
    """
    drawn = [f for f in told if f.model_curve is not None]
    if not drawn:
        return ""
    names = " and ".join(name for name, there in ((SPAN, any(f.name == SPAN for f in drawn)), ("sizes by order", any(f.name != SPAN for f in drawn))) if there)
    later = {id(f): changed for f, changed in zip(told, after)}
    spans = []
    for f in drawn:
        if f.name == SPAN:
            both = [f, later[id(f)]] if later else [f]
            unit, (_, _, alone, *then) = figure_texts(f, *(one.model_curve for one in both if one.model_curve is not None), text=plain_text)
            spans.append(f"{alone} {unit} at {f.condition}{''.join(f', with it {value} {unit}' for value in then)}")
    peaks = f"; {SPAN} of the curve alone: {'; '.join(spans)}" if spans else ""
    return f"{names}, model: of {drawn[0].model_from}, for noise makes what is measured larger, too{peaks}"
