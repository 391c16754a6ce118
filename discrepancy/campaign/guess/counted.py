"""Repetitions whose names count them by a word that nobody knows."""

import re
from collections import defaultdict
from collections.abc import Sequence
from dataclasses import replace

from discrepancy.campaign.guess.run import GuessedRun
from discrepancy.campaign.guess.said import Doubt
from discrepancy.campaign.guess.wishes import Wishes

COUNTER = re.compile(r"(.*[^\W\d_])(\d{1,2})$")


def with_repetitions(runs: Sequence[GuessedRun], wishes: Wishes) -> list[GuessedRun]:
    """Files that are alike in every number of their condition and whose names differ by a number from 1 on alone repeat each other, which is said.

    Patterns that are given, and conditions that are named in what is given, decide themselves.
    """
    named = {key.rpartition(":")[0] for key in wishes.conditions} | set(wishes.held_out or ())
    groups: dict[tuple[object, ...], list[int]] = defaultdict(list)
    for k, run in enumerate(runs):
        label = COUNTER.match(run.name.label)
        if label and not run.name.given and run.name.replicate is None and run.repeated is None and run.name.label not in named:
            numbers = tuple(sorted((key, guess.value) for key, guess in run.factors.items()))
            groups[run.quantity.value, numbers, tuple(sorted((tag, guess.value) for tag, guess in run.tags.items())), label[1]].append(k)
    found = list(runs)
    for members in groups.values():
        counts = sorted({count_of(runs[k]) for k in members})
        if len(counts) < 2 or counts[0] > 1 or counts[-1] - counts[0] >= len(counts):
            continue
        for k in members:
            found[k] = counted(runs[k], f"{runs[members[0]].name.label} to {runs[members[-1]].name.label}")
    return found


def with_odd_counts_doubted(runs: Sequence[GuessedRun]) -> list[GuessedRun]:
    """Numbers at the ends of names that were taken for repetitions and do not count from 1 may be a speed or a load, which is said: N10, N20."""
    groups: dict[tuple[str, str], list[int]] = defaultdict(list)
    for k, run in enumerate(runs):
        if run.name.replicate is not None and not run.name.given and run.repeated is None:
            groups[run.quantity.value, run.name.pattern].append(k)
    found = list(runs)
    for (_, pattern), members in groups.items():
        counts = sorted({runs[k].name.replicate or 0 for k in members})
        if len(counts) < 2 or counts[0] <= 1:
            continue
        text = f"{', '.join(map(str, counts))} in {pattern} are taken for repetitions, which are mostly counted from 1"
        remedy = f"--names '{pattern.replace('{replicate}', '{speed}')}' (or {{load}}, {{temperature}} ...) if they are numbers of the condition"
        first = members[0]
        found[first] = replace(runs[first], doubts=(*runs[first].doubts, Doubt(runs[first].path.name, text, remedy)))
    return found


def count_of(run: GuessedRun) -> int:
    match = COUNTER.match(run.name.label)
    assert match is not None
    return int(match[2])


def counted(run: GuessedRun, names: str) -> GuessedRun:
    """The run as a repetition, with the pattern of names that says so."""
    label = run.name.label
    count = count_of(run)
    word = label.rpartition("_")[2]
    stem = re.sub(r"\d+$", "", word)
    before, _, after = run.name.pattern.rpartition(word)
    text = f"{names} are taken for repetitions of one condition: these names differ by their number only, and no other number of their conditions does"
    doubt = Doubt(run.path.name, text, f"--names '{before}{{condition}}{after}' if they are conditions")
    name = replace(run.name, pattern=f"{before}{stem}{{replicate}}{after}", label=re.sub(r"\d+$", "", label), replicate=count)
    return replace(run, name=name, doubts=(*run.doubts, doubt))
