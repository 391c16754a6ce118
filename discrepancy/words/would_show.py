"""What an answer is worth that names nothing: how large each effect must have been to be seen, and what the measurements cannot show whatever it is."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from discrepancy.campaign.design import Design
from discrepancy.campaign.findings import Finding, shows_less
from discrepancy.inference.screening.visible import OR_LESS, Visible
from discrepancy.inference.verdict import Diagnosis
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import BASE
from discrepancy.scales import Scale, of_parameter
from discrepancy.words.as_told import effect_name
from fmu_src.effect_words import effect_title, effects_words

# Names in one sentence.
MOST_NAMED = 6
HEAD = ("effect", "number", "seen from", "usual size")


@dataclass(frozen=True)
class WouldShow:
    """``found``, the hardest to see first; ``silent``: effects of which no size changes anything here; ``lacking``: what the runs cannot show."""

    found: list[Visible]
    silent: list[str]
    lacking: list[Finding]

    @property
    def effects(self) -> list[str]:
        return list(dict.fromkeys(v.candidate for v in self.found))

    @property
    def missed(self) -> list[str]:
        """Effects that would not have been seen for sure at their usual size."""
        return list(dict.fromkeys(v.candidate for v in self.found if not v.times <= 1.0))

    @property
    def hard(self) -> list[Visible]:
        """What must have more than a tenth of its usual size to be seen, and is seen somewhere."""
        return [v for v in self.found if not v.times <= OR_LESS and math.isfinite(min(v.size, v.at_best))]

    @property
    def never(self) -> list[str]:
        """Effects of which some number is not seen at any size that a reducer has, wherever."""
        return list(dict.fromkeys(v.candidate for v in self.found if math.isinf(min(v.size, v.at_best))))

    @property
    def easy(self) -> list[str]:
        """Effects of which a tenth of the usual size would have been seen, whichever of their numbers it is."""
        hard = {v.candidate for v in self.hard} | set(self.never)
        return [name for name in self.effects if name not in hard]

    @property
    def says_little(self) -> bool:
        """Whether nothing would have been seen at its usual size."""
        return len(self.missed) == len(self.effects)

    @property
    def sentence(self) -> str:
        """How many would have been seen; of the others the names."""
        count, missed = len(self.effects), self.missed
        if not count:
            return "no effect of the catalogue changes anything here that could be seen: this answer says nothing of them"
        if not missed and count == 1:
            return "the one effect that changes something here would have been seen at its usual size"
        if not missed:
            return f"all {count} effects that change something here would have been seen at their usual size"
        if self.says_little:
            which = f"none of the {count} effects that change something here" if count > 1 else "the one effect that changes something here"
            return f"{which} would {'' if count > 1 else 'not '}have been seen at its usual size: this answer says little"
        names = effects_words(missed[:MOST_NAMED]) + (f" and {len(missed) - MOST_NAMED} more" if len(missed) > MOST_NAMED else "")
        left = count - len(missed)
        seen = f"of {count} effects that change something here, {left} would have been seen at {'its' if left == 1 else 'their'} usual size"
        return f"{seen}; not, or only where they are larger: {names}"

    @property
    def named(self) -> list[str]:
        """What is seen easily, never, and changes nothing, each as a sentence."""
        parts = (
            ("seen at a tenth of its usual size", self.easy), ("not seen at any size that a reducer has, in all their numbers", self.never),
            ("change nothing here, whatever their size", self.silent),
        )  # fmt: skip
        return [f"{what}: {effects_words(names)}" for what, names in parts if names]

    def as_json(self) -> dict[str, Any]:
        return {
            "sentence": self.sentence, "seen_from": [entry(v) for v in self.found], "changes_nothing": self.silent,
            "cannot_show": [{"what": f.text, "remedy": f.remedy} for f in self.lacking],
        }  # fmt: skip


def would_show(diagnosis: Diagnosis, model: PhysicalModel) -> WouldShow:
    """Of a diagnosis that names nothing."""
    found = sorted(diagnosis.visible, key=lambda v: -v.times)
    seen = {v.candidate for v in found}
    silent = dict.fromkeys(c.name for c in model.candidates if c.part != BASE and c.name not in seen)
    return WouldShow(found, list(silent), list(shows_less(Design(model.campaign))))


def scale_of(v: Visible) -> Scale:
    """The unit of both sizes."""
    return of_parameter(v.usual, v.unit)


def size_text(v: Visible) -> str:
    """From which size on it would have been seen."""
    scale = scale_of(v)
    if math.isfinite(v.size):
        return scale.text(v.size, 2) + (" or less" if v.or_less else "")
    return f"not everywhere; {scale.text(v.at_best, 2)} at best"


def rows(found: Sequence[Visible]) -> list[list[str]]:
    """As a table has them, below ``HEAD``; numbers of one effect that are seen alike (a cosine and its sine) stand together."""
    together: dict[tuple[str, str, str], list[str]] = {}
    for v in found:
        number = effect_name(v.candidate.partition(".")[0], v.parameter).rpartition(".")[2]
        together.setdefault((effect_title(v.candidate), size_text(v), scale_of(v).text(v.usual, 2)), []).append(number)
    return [[effect, ", ".join(numbers), size, usual] for (effect, size, usual), numbers in together.items()]


def entry(v: Visible) -> dict[str, Any]:
    """The same as JSON; null where no size would have been seen."""
    scale = scale_of(v)
    si = {key: size if math.isfinite(size) else None for key, size in (("size", v.size), ("at_best", v.at_best), ("usual", v.usual))}
    told = {key: None if size is None else scale.number(size) for key, size in si.items()}
    return {"effect": v.candidate, "parameter": effect_name(v.candidate.partition(".")[0], v.parameter), **told, "unit": scale.unit, "or_less": v.or_less,
            "si": si | {"unit": v.unit}}  # fmt: skip
