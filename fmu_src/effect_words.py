"""Names of effects as people say them: lobes are those of a disc, what a crank has is an eccentric.  Keys, which files and commands hold, stay."""

from collections.abc import Iterable

SAID = {"crank lobe": "crank eccentric"}


def effect_words(name: str) -> str:
    """``crank_lobe_errors`` as "crank eccentric errors"."""
    words = name.replace("_", " ")
    for key, said in SAID.items():
        words = words.replace(key, said)
    return words


def effect_title(name: str) -> str:
    """``sensor_gain.input_torque`` as "sensor gain (input torque)"."""
    effect, _, form = effect_words(name).partition(".")
    return effect + (f" ({form})" if form else "")


def effects_words(names: Iterable[str]) -> str:
    """Forms behind their effects: "disc tooth errors (runout, ovality), drag"."""
    forms: dict[str, list[str]] = {}
    for name in names:
        effect, _, form = effect_words(name).partition(".")
        forms.setdefault(effect, []).extend([form] if form else [])
    return ", ".join(effect + (f" ({', '.join(own)})" if own else "") for effect, own in forms.items())
