"""Which signals the runs are of that were held out: those of one say nothing of another."""

from collections.abc import Iterable

from discrepancy.problem import ERROR, ORDERS, Record


def held_signals_text(records: Iterable[Record]) -> str:
    """The end of a sentence on held-out runs; empty where each signal has some, or none has."""
    held, all_of = set[str](), dict[str, None]()
    for record in records:
        name = (ERROR if record.quantity == ORDERS else record.quantity).replace("_", " ")
        all_of[name] = None
        if record.unused:
            held.add(name)
    others = [name for name in all_of if name not in held]
    if not held or not others:
        return ""
    return f"; these runs are of {' and '.join(name for name in all_of if name in held)} alone and say nothing of {', '.join(others)}"
