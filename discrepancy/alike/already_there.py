"""An effect that a model has already: said with its numbers, and what fits all of them anew."""

from typing import Any

from discrepancy.model_file import ModelFile, every_effect
from discrepancy.problem import BASE, effect_of
from discrepancy.scales import largest, of_parameter
from discrepancy.words.as_told import effect_name, tables_of, told_name
from fmu_src.faults import InputFault


class AlreadyThere(InputFault):
    """``lacking``: forms of it that the model does not have; ``names``: what ``extend`` adds to the base model to have all of it again, fitted together."""

    def __init__(self, name: str, file: ModelFile, numbers: dict[str, dict[str, Any]], lacking: list[str]):
        told = ", ".join(f"{path} = {of_parameter(largest(n['value']), n['unit']).text(n['value'], 4)}" for path, n in numbers.items())
        other = f" (other forms have names of their own: {', '.join(lacking)})" if lacking else ""
        super().__init__(f"effect {name!r}: {file.path or file.name} has it already ({told}), and nothing is added twice{other}")
        self.names = names_of(file)


def numbers_of(name: str, file: ModelFile) -> dict[str, dict[str, Any]]:
    """What the model has of ``effect``, ``effect.variant`` or ``base.NUMBER``, by structured names; nothing where it lacks it."""
    effect, _, variant = name.partition(".")
    if effect == BASE:
        tables = tables_of(file)
        unit = next((t.by_name[variant].unit for t in tables if variant in t.by_name), "1")
        return {told_name(variant, tables): {"value": file.settings[variant], "unit": unit}} if variant in file.settings else {}
    own = file.effects.get(effect, {})
    group = {p.variable.name for p in every_effect()[effect].parameters if p.group.replace(" ", "_") == variant} if own else set()
    return {effect_name(effect, key): entry for key, entry in own.items() if not variant or key in group or key.endswith(f"[{variant}]")}


def names_of(file: ModelFile) -> list[str]:
    """Of all that the model has: as steps added it, else by the effect's name."""
    added = dict.fromkeys(name for step in file.steps if step.get("kept", True) for name in step["effects"] if numbers_of(name, file))
    return [*added, *(effect for effect in file.effects if effect not in {effect_of(name) for name in added})]


def own_settings(file: ModelFile) -> bool:
    """Whether it has settings that no step of its ladder added."""
    return bool(file.settings.keys() - {name.partition(".")[2] for name in names_of(file) if name.partition(".")[0] == BASE})
