"""How much is left of each signal where what is named is not enough: significant may be little."""

from collections.abc import Callable

from discrepancy.compare import by_signal, runs_of
from discrepancy.inference.verdict import INCOMPLETE
from discrepancy.verdict import Answer
from discrepancy.words.sample_errors import PATTERNS

NOT_COUNTED = f"; the verdict counts the {PATTERNS}, not this"


def left_sizes(answer: Answer, title: Callable[[str], str] = str) -> str:
    """What every sample is off by beside its noise, signal by signal, and that no verdict counts it: ``hysteresis: 1.1 times its noise (unused runs: 1.3)``;
    empty of other verdicts."""
    fits = answer.diagnosis.fits
    if answer.verdict != INCOMPLETE or not fits.members:
        return ""
    space = fits.space
    found: dict[str, dict[bool, float]] = {}
    for row in by_signal(runs_of(space, space.predictions(fits.members[0].fit.values, list(range(len(space.records)))))):
        found.setdefault(row["signal"], {})[row["held_out"]] = row["ratio"]
    # It stands beside errors in the patterns that carry the misfit, which may be much larger or smaller.
    return "; ".join(f"{title(signal)}: {size_text(ratios)}" for signal, ratios in found.items()) + NOT_COUNTED


def size_text(ratios: dict[bool, float]) -> str:
    """Of one signal, by whether its runs were held out."""
    unused = f"{ratios[True]:.3g}" if True in ratios else ""
    if False not in ratios:
        return f"{unused} times its noise in unused runs"
    return f"{ratios[False]:.3g} times its noise" + (f" (unused runs: {unused})" if unused else "")
