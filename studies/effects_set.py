"""Which effects of the plant a run's settings switch on or off, for the line above its figures."""

from collections.abc import Sequence

from fmu_src.effect_words import effect_words
from orchestrator.settings import ArraySetting, Setting
from reducers.reducer import Reducer
from rv_plant.effects import EFFECTS


def effects_set(reducer: Reducer, settings: Sequence[Setting | ArraySetting]) -> str:
    """``, with thermal expansion, without drive friction``: what the settings say of effects, beside what the reducer's file has; empty for nothing."""
    starts = {name.partition("[")[0]: value for name, value in reducer.starts.items()}
    given = {setting.name.partition("[")[0]: setting.value for setting in settings if isinstance(setting, Setting)}
    told = []
    for name, effect in EFFECTS.items():
        amplitudes = [p.variable for p in effect.amplitudes()]
        was, now = (any(values.get(v.name, v.start) != v.start for v in amplitudes) for values in (starts, starts | given))
        if now and any(v.name in given for v in amplitudes):
            told.append(f", with {effect_words(name)}")
        elif was and not now:
            told.append(f", without {effect_words(name)}")
    return "".join(told)
