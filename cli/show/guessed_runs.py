"""The runs of a proposed campaign in a table: by quantity, repetitions whose names end with their number in one row."""

import re
from collections import defaultdict
from collections.abc import Sequence

from rich.table import Table

from cli.columns import fill
from cli.screen import BETWEEN_LINES, EDGE
from discrepancy.campaign.guess.propose import PlacedRun

# A name that ends with what counts repetitions.
COUNTED = re.compile(r"(.*?)(\d+|[A-Za-z])", re.DOTALL)
# From so many on that follow each other the first and the last are told.
MANY = 4


def table_of(name: str, runs: Sequence[PlacedRun], width: int) -> Table:
    """``width``: signs of a line of the screen."""
    table = Table(title=f"{name}: {len(runs)} run{'s' * (len(runs) != 1)}", title_justify="left")
    by_quantity = defaultdict(list)
    for run in runs:
        by_quantity[run.guessed.quantity.value].append(run)
    rows = []
    for quantity, some in by_quantity.items():
        rows += [(f"{quantity}:", "", ""), *rows_of(some)]
    names, conditions, replicates = zip(*rows)
    fill(table, {"run": names, "condition": conditions, "repetition": replicates}, width - BETWEEN_LINES * 3 - EDGE, ["run", "condition"], ["repetition"])
    return table


def rows_of(runs: Sequence[PlacedRun]) -> list[tuple[str, str, str]]:
    """(name, condition, repetition) of runs of one quantity."""
    by_condition = defaultdict(list)
    for run in runs:
        by_condition[run.condition].append(run)
    rows = []
    for condition, some in by_condition.items():
        some.sort(key=lambda run: run.replicate.value)
        if together := in_one([run.name for run in some]):
            rows.append((together, condition, listed([str(run.replicate.value) for run in some])))
        else:
            rows += [(run.name, condition, str(run.replicate.value)) for run in some]
    return rows


def in_one(names: Sequence[str]) -> str:
    """Names that differ by the count at their end as one, with all counts; empty where they differ otherwise."""
    if len(names) == 1:
        return names[0]
    parted = [match.groups() for name in names if (match := COUNTED.fullmatch(name))]
    if len(parted) < len(names) or len({before for before, _ in parted}) > 1:
        return ""
    return f"{parted[0][0]}{listed([count for _, count in parted])}"


def listed(counts: Sequence[str]) -> str:
    """1, 2, 3 of three, 1 to 8 of eight."""
    numbers = [int(count) for count in counts if count.isdigit()]
    if len(counts) >= MANY and numbers == list(range(numbers[0], numbers[0] + len(counts))):
        return f"{counts[0]} to {counts[-1]}"
    return ", ".join(counts)
