"""The order in which records are shared between threads."""

from collections.abc import Hashable, Sequence

from discrepancy.problem import Record


def apart(records: Sequence[Record]) -> list[Record]:
    """Records so that those under one load are far from each other: they mostly repeat each other, and the next would only wait for what it repeats."""
    before: dict[Hashable, int] = {}
    rounds = []
    for record in records:
        key = (record.quantity, record.factors.get("load"), record.factors.get("direction"))
        rounds.append(before.get(key, 0))
        before[key] = rounds[-1] + 1
    return [records[k] for k in sorted(range(len(records)), key=rounds.__getitem__)]
