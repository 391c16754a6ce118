"""The list of all effects: those of plant, wear unit and measuring chain, by number."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

from discrepancy.catalogue.examples import CASES, Case, cases, part_of
from discrepancy.effects import EFFECTS as CHAIN
from discrepancy.model_file import every_effect
from fmu_src.effect import Effect, EffectParameter
from fmu_src.faults import InputFault, nearest
from fmu_src.source_hash import own_effects_hint


@dataclass(frozen=True)
class Entry:
    """An effect with its name, where it acts, and the strengths it is shown at."""

    name: str
    effect: Effect
    part: str
    cases: tuple[Case, ...]

    @property
    def number(self) -> str:
        """Its number in the physics audit; the measuring chain's own have none."""
        return str(self.effect.number) if self.effect.number else "-"

    @property
    def is_own(self) -> bool:
        """Whether it is somebody's own, for whose file ``--check`` is."""
        return self.name not in CASES

    @property
    def text(self) -> str:
        """All that is said of it, to look for words in."""
        e = self.effect
        said = (self.name, e.title, self.part, e.law, e.signature, e.source, *e.signals, *(f"{p.variable.path} {p.variable.description}" for p in e.parameters))
        return " ".join(said).lower().replace("_", " ")

    def as_json(self) -> dict[str, Any]:
        e = self.effect
        return {
            "name": self.name, "number": e.number, "title": e.title, "part": self.part, "law": e.law, "source": e.source,
            "signature": e.signature, "signals": list(e.signals), "parameters": [parameter_json(p) for p in e.parameters],
        }  # fmt: skip


def parameter_json(p: EffectParameter) -> dict[str, Any]:
    v = p.variable
    return {
        "name": v.path, "kind": p.kind, "held": p.is_held, "unit": v.unit, "off": float(v.start), "minimum": v.minimum, "maximum": v.maximum,
        "description": v.description, "source": v.source,
    }  # fmt: skip


def entries() -> list[Entry]:
    """All effects; sensors' own last."""
    found: Mapping[str, Effect] = every_effect() | CHAIN
    listed = [Entry(name, effect, part_of(name), cases(name, effect)) for name, effect in found.items()]
    return sorted(listed, key=lambda e: (e.effect.number == 0, e.effect.number, e.name))


def entry(name: str) -> Entry:
    for found in entries():
        if name in (found.name, found.number) and name != "-":
            return found
    raise InputFault(f"no effect {name!r}{nearest(name, [e.name for e in entries()], 2) or ';'} rvwear effects lists them{own_effects_hint()}")


def found_by(word: str) -> list[Entry]:
    """The effect of this name or number; else all that have all the words in their name, law, signature, signals, source or parameters.

    InputFault with the nearest name if there is none.
    """
    every = entries()
    exact = [e for e in every if word in (e.name, e.number) and word != "-"]
    words = word.lower().replace("_", " ").split()
    found = exact or [e for e in every if words and all(part in e.text for part in words)]
    return found or [entry(word)]
