"""Repetitions that stand out, in words and in the usual unit of their quantity, and those that are none."""

from collections.abc import Mapping

from discrepancy.campaign.amount import readable
from discrepancy.campaign.model import Campaign
from discrepancy.campaign.quantities import QUANTITIES, VALUE
from discrepancy.interchanged import Interchanged
from discrepancy.repetitions import Outlying
from fmu_src.units import conversion

WORDS = {"span": "spans {}", "mean": "has a mean of {}", "departure": "departs by {} from the middle of all", "value": "is {}"}
# Sets of equal runs that are named.
MOST_ALIKE = 4
LOOK = "look for the cause: clamping, a slip, a wrong file or unit; measure it again"
COPY = "a copy is no repetition, it counts once and says nothing of the noise"


def words(found: Outlying) -> str:
    """``run r3 (repetition 3 of 5 of hysteresis at locked) spans 111 arcmin, the others 14 to 23``."""
    q = QUANTITIES[found.quantity]
    factor, offset = conversion(found.unit, q.usual_unit)
    offset = offset if found.what in ("mean", "value") else 0.0
    size, low, high = (readable(factor * v + offset) for v in (found.size, found.low, found.high))
    others = low if low == high else f"{low} to {high}"
    rest = f"the other, {found.other}, {others}" if found.other else f"the others {others}"
    verb = WORDS.get(found.what, found.what + " is {}")
    unit = "" if q.usual_unit == "1" else f" {q.usual_unit}"
    return (
        f"run {found.run} (replicate {found.replicate}, of {found.count} repetitions of {found.signal} at {found.condition}) "
        f"{verb.format(size + unit)}, {rest}"
    )


def interchanged_words(found: Interchanged, campaign: Campaign) -> tuple[str, str]:
    """What two runs show that were interchanged, and what to do."""
    placed = [f"{run}{campaign.place(run, VALUE)} of {condition}" for run, condition in zip(found.runs, found.conditions)]
    either = f" (or else the other two, {' and '.join(found.or_else)})" if found.or_else else ""
    usual = QUANTITIES[found.quantity].usual_unit
    before, after = (f"{readable(conversion(found.unit, usual)[0] * v)}{'' if usual == '1' else f' {usual}'}" for v in (found.before, found.after))
    return (
        f"runs {' and '.join(placed)}{either} look interchanged: each repeats the other condition's run; they differ by {before} from their own"
        f" repetitions, exchanged by {after}",
        "see what was measured under which condition, and exchange the two in file = \"...\" of their runs",
    )


def what_is_done(found: Outlying) -> str:
    """Whether the run takes part, and what to do."""
    if found.left_out:
        return f"left out of fit, errors and key figures (pages draw it in grey), for its repetitions agree without it; {LOOK}"
    if found.by_chance:
        return f"of so few that differ so chance makes one like it now and then, so that all count; {LOOK}"
    many = "the two" if found.count == 2 else "them, of which as many stand out as do not,"
    return f"which of {many} is wrong cannot be told, so that all count, as noise that hides what is smaller; {LOOK}"


def copied_words(copies: Mapping[str, str]) -> tuple[str, str]:
    """What is wrong with runs that hold the numbers of others, copy -> the other, and the remedy."""
    alike = [" and ".join([original, *(copy for copy, of in copies.items() if of == original)]) for original in dict.fromkeys(copies.values())]
    some = "; ".join(alike[:MOST_ALIKE]) + (f"; and {len(alike) - MOST_ALIKE} more like them" if len(alike) > MOST_ALIKE else "")
    return (
        f"runs {some} hold the same numbers: {COPY}",
        'name the files of the repetitions, or measure again; if the instrument shows no finer, state noise = "..." in the runs',
    )
