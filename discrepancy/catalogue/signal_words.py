"""The words that ``signals=`` of an effect may have: by them a diagnosis knows in which measured quantities to look for it."""

from collections.abc import Sequence

from discrepancy.campaign.quantities import QUANTITIES
from discrepancy.prediction.candidates import SHOWN_BY
from fmu_src.faults import nearest

# Of the words that are no quantity themselves.
SHORT = {"debris": "iron in the grease", "pin_on_disc": "what a pin-on-disc test wears off"}


def words() -> dict[str, tuple[str, tuple[str, ...]]]:
    """Word -> what is measured, and the quantities of a campaign that it stands for."""
    plain = {name: q.description for name, q in QUANTITIES.items()}
    return {word: (meaning, SHOWN_BY.get(word, (word,))) for word, meaning in (plain | SHORT).items()}


def unknown(signals: Sequence[str]) -> list[str]:
    """A sentence for each word that no campaign has: nothing would ever be looked for there."""
    known = words()
    if isinstance(signals, str):
        # One word in brackets, without a comma, is no tuple.
        return [f'signals=("{signals}"): is read letter by letter; write signals=("{signals}",), with a comma']
    return [f"signals={word!r}: no such quantity{nearest(word, known, 1).rstrip('?')}; docs/effects.md has the words" for word in signals if word not in known]
