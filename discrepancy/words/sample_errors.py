"""The two measures of how far a model is off, each by one name wherever it stands.

The error over the noise of all samples is what a comparison shows of a signal, and what every view begins with.  A verdict rests on the misfit in the
patterns: thousands of noisy samples drown what few directions (the places that carry the misfit, and the effects' responses) show sharply, so that it is many
times the other; beside that it stands by its own name.
"""

from collections.abc import Callable, Iterable, Mapping

SAMPLES = "error over noise, all samples"
PATTERNS = "misfit in the patterns"
# What 1 is, of each.
OF_SAMPLES, OF_PATTERNS = "1: noise alone", "1: what noise leaves there"
UNUSED, FITTED = "unused runs", "fitted runs"
COUNTED = f"what the verdict counts; {OF_PATTERNS}"


def ratio(error: float, floor: float) -> float:
    return error / floor if floor > 0.0 else float("inf")


def change_text(signal: str, before: float, after: float, floor: float) -> str:
    """``transmission error 15.69 -> 1.01``, of errors in the unit of ``floor``."""
    return f"{signal} {ratio(before, floor):.2f} -> {ratio(after, floor):.2f}"


def samples_text(rows: Mapping[str, Mapping[str, float]], title: Callable[[str], str], runs: str = UNUSED) -> str:
    """All samples of unused or of fitted ``runs``, signal by signal: ``before``, ``after`` and ``floor`` of each."""
    changes = (change_text(title(name), row["before"], row["after"], row["floor"]) for name, row in rows.items())
    return f"{SAMPLES}, on {runs}: {', '.join(changes)}"


def patterns_text(before: float, after: float) -> str:
    return f"{PATTERNS} {before:.2f} -> {after:.2f} ({COUNTED})"


def plain(signal: str) -> str:
    """A signal in the middle of a sentence; its tags stay as they are."""
    name, bracket, tags = signal.partition("[")
    return name.replace("_", " ") + bracket + tags


def furthest_off(rows: Iterable[tuple[str, float, float, float]]) -> tuple[str, float, float] | None:
    """(signal, before, after) over the noise of the signal that was furthest off, of (signal, before, after, floor); None of nothing."""
    found = [(signal, ratio(before, floor), ratio(after, floor)) for signal, before, after, floor in rows]
    return max(found, key=lambda row: row[1], default=None)
