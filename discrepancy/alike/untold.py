"""What a campaign does not tell of effects that are named: which of two things they come from, and what does."""

from collections.abc import Container, Iterable, Mapping, Sequence
from typing import Any

from discrepancy.campaign.design import Design, turns
from discrepancy.campaign.model import Campaign
from discrepancy.campaign.pairs import PAIRS, Pair, judge
from discrepancy.model_file import ModelFile
from discrepancy.problem import ERROR
from fmu_src.effect_words import effect_words

# By how an amplitude of the ring begins: what a ring is that has it.
RINGS = {"pin_ring_runout": "off centre", "pin_ring_ovality": "oval", "pin_ring_trilobe": "three-lobed", "pin_ring_cos": "wavy", "pin_ring_sin": "wavy"}
NOT_TOLD = "this campaign does not tell"
# Turns of the output, less what a record lacks at its end.
WHOLE_TURN = 0.99
# Of an effect at one of several parts with which the reducer as a whole does the same.
SAME_WITH_EACH = (
    "no other run of these signals tells, for they are the same with each; measure these parts, or exchange one of them for that of another unit and"
    " repeat a run: if the effect changes with it, it was in that part"
)


def parts_untold(effects: Sequence[Mapping[str, Any]]) -> list[str]:
    """Of named effects that would show the same at other parts: that no run tells at which they are, and what does."""
    several = (effect for effect in effects if effect.get("other_places"))
    return [f"at which part it is ({effect_words(effect['name'])} at {effect['place']}) stays open; {SAME_WITH_EACH}" for effect in several]


def other_forms(effects: Sequence[Mapping[str, Any]], added: str, names: Container[str]) -> dict[str, str]:
    """Forms that fit as well as the one ``added`` and stand for it in the ``effects`` that a diagnosis names, each with what is said of its fit; those
    of ``names`` are added, too."""
    for effect in effects:
        if added not in effect["candidates"] or effect["forms"]:
            continue
        # What is said is in comparison with the first.
        reasons = {f["candidates"][0]: f.get("reason", "") for f in effect.get("other_forms", ()) if added == effect["candidates"][0]}
        return {c: reasons.get(c, "") for c in effect["candidates"] if c not in names}
    return {}


def forms_untold(forms: Mapping[str, Mapping[str, str]]) -> list[str]:
    """By what was added its ``other_forms``: that these runs do not tell which it is, and how another is chosen."""
    def told(others: Mapping[str, str]) -> str:
        return ", or ".join(name + (f" ({reason})" if reason.startswith("fits worse") else "") for name, reason in others.items())

    return [
        f"which form of {effect_words(added.partition('.')[0])} it is {NOT_TOLD}: {added} was added, and {told(others)} fits as well; rvwear next says what"
        f" would tell them apart, and rvwear extend with --effect {next(iter(others))} in place of {added} adds"
        f" {'that' if len(others) == 1 else 'the first of these'} instead"
        for added, others in forms.items() if others
    ]


def parts_untold_before(file: ModelFile) -> list[str]:
    """The same of effects that stand in a model file, as it was when they were added."""
    return [text for step in file.steps if step.get("kept", True) for text in step.get("untold", ())]


def origins_untold(effects: Sequence[Mapping[str, Any]], file: ModelFile, campaign: Campaign) -> list[str]:
    """Of ``effects`` that are named, or that the model has, and may come from one thing or another: that this campaign does not tell which, and what does."""
    return origins_untold_of([*(name for effect in effects for name in effect["parameters"]), *file.values()], campaign)


def origins_untold_of(known: Iterable[str], campaign: Campaign) -> list[str]:
    """The same of parameters by their names."""
    names, design = list(known), Design(campaign)
    verdicts = (judge(pair, design) for pair in PAIRS if pair.within and any(name.startswith(pair.within) for name in names))
    return [
        f"whether it is {', or '.join(origins_of(v.pair, names))}, {NOT_TOLD}: {v.pair.experiment}{stated_text(v.pair, design)}"
        for v in verdicts if v.status == "not separable"
    ]  # fmt: skip


def origins_of(pair: Pair, names: Sequence[str]) -> tuple[str, ...]:
    """What an effect may come from, the ring by the shape that it has."""
    rings = dict.fromkeys(ring for start, ring in RINGS.items() if start.startswith(pair.within) and any(name.startswith(start) for name in names))
    return (*pair.effects[:-1], f"a ring that is {' and '.join(rings)} or clamped so") if rings else pair.effects


def stated_text(pair: Pair, design: Design) -> str:
    """How a campaign states what is done to the unit between two runs."""
    done = dict.fromkeys(need.intervention for needs in pair.alternatives for need in needs if need.intervention and not need.met(design))
    return "".join(f'; the runs after it are a condition of their own, with interventions = ["{word}"]' for word in done)


def asked_of_runs(untold: Sequence[str]) -> list[str]:
    """Of what is untold what runs can answer, once a part was changed or turned."""
    return [text for text in untold if any(word in text for word in (SAME_WITH_EACH, NOT_TOLD))]


def repeated(campaign: Campaign) -> str:
    """Which condition is repeated for that: one of transmission errors over a whole turn, if there is one."""
    turned = [record for record in campaign.training if record.quantity == ERROR and turns(record) >= WHOLE_TURN]
    found = next(iter(turned or campaign.training), None)
    what = "a condition of transmission_error over a whole turn" if turned else "a condition"
    return f"{what}{f', such as {found.condition}' if found else ''}"
