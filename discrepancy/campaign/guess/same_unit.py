"""Columns of one name in several files of one quantity have one unit."""

from collections import Counter, defaultdict
from collections.abc import Sequence
from dataclasses import replace

from discrepancy.campaign.guess.run import GuessedRun
from discrepancy.campaign.guess.said import Guess


def with_one_unit(runs: Sequence[GuessedRun]) -> list[GuessedRun]:
    """Units that were guessed by size become those of most files: the first hours of a wear test look like another unit."""
    counts: dict[tuple[str, str, str], Counter[str]] = defaultdict(Counter)
    for run in runs:
        for role, entry in run.columns.items():
            if not entry.unit.sure:
                counts[run.quantity.value, role, entry.header][entry.unit.value] += 1
    found = []
    for run in runs:
        columns, doubts = dict(run.columns), run.doubts
        for role, entry in run.columns.items():
            unit = entry.unit.value if entry.unit.sure else counts[run.quantity.value, role, entry.header].most_common(1)[0][0]
            if unit != entry.unit.value:
                columns[role] = replace(entry, unit=Guess(unit, "nothing states it; the same column of most files is likely in it", False))
                was, now = (f"unit of column {entry.header!r} taken for {word}:" for word in (entry.unit.value, unit))
                doubts = tuple(replace(doubt, text=f"{now} {columns[role].unit.reason}") if doubt.text.startswith(was) else doubt for doubt in doubts)
        found.append(replace(run, columns=columns, doubts=doubts))
    return found
