"""SI values in the units of a bench, for axes and for text."""

import re
from functools import cache
from typing import Any

import numpy as np
import numpy.typing as npt

from discrepancy.figures.figure_digits import figure_texts
from discrepancy.figures.key_figures import KeyFigure
from discrepancy.model_file import every_effect
from discrepancy.problem import BASE
from discrepancy.scales import AXES, Scale, of_estimate, of_signal
from discrepancy.words.intervals import both_texts, is_any
from fmu_src.arrays import Floats
from fmu_src.effect_words import effect_title
from fmu_src.unit_words import unit_on_screen
from pages.words import number

TITLES = {
    "speed": "input speed",
    "load": "load torque",
    "hours": "operating hours",
    "angle": "output angle",
    "locked_at": "input locked at",
    "depth_angle": "place on the surface",
    "order": "order of the output's turn",
}


def pretty(unit: str) -> str:
    """A unit's name in print."""
    plain = "" if unit == "1" else "°" if unit == "deg" else unit
    return unit_on_screen(plain).replace("um", "µm").replace("g.mm", "g mm").replace("degC", "°C").replace("^2", "²")


def scale(unit: str, signal: str = "") -> tuple[float, str]:
    """(factor, unit) of a difference in a signal [its SI unit]; temperatures stay in kelvin."""
    found = of_signal(signal, unit)
    return found.factor, pretty(found.unit)


def text(value: float | None, unit: str, signal: str = "") -> str:
    """A signal's value with its unit."""
    if value is None:
        return "–"
    factor, name = scale(unit, signal)
    return f"{number(factor * value)} {name}".rstrip()


def figure_cells(figure: KeyFigure, *models: float) -> list[str]:
    """A key figure as measured, its noise, and what models have of it, each with its unit."""
    unit, texts = figure_texts(figure, *models)
    return [f"{told} {pretty(unit)}".rstrip() for told in texts]


def axis_values(name: str, values: npt.ArrayLike, speed: Scale = AXES["speed"]) -> Floats:
    """As the axis' title says; ``speed`` is how the campaign tells one."""
    scale = speed if name == "speed" else AXES.get(name, Scale())
    return scale.factor * np.asarray(values, np.float64) + scale.offset


def axis_title(name: str, speed: Scale = AXES["speed"]) -> str:
    unit = pretty(AXES[name].unit) if name in AXES else ""
    title = "output speed" if name == "speed" and speed != AXES["speed"] else TITLES.get(name, name.replace("_", " "))
    return f"{title} [{unit}]" if unit else title


def effects_title(names: str) -> str:
    """``hole_position_errors.hole_2 + play`` as words."""
    return " + ".join(effect_title(name) for name in names.split(" + "))


def signal_title(signal: str) -> str:
    """``wear_depth[surface=pin]`` as words."""
    name, _, tags = signal.partition("[")
    words = name.replace("_", " ")
    return words + (f" ({tags.rstrip(']').replace('=', ' ').replace(',', ', ').replace('_', ' ')})" if tags else "")


def with_titles(text: str) -> str:
    """A text whose signals stand as ``wear_depth[surface=pin]``, with their words instead."""
    return re.sub(r"[a-z_]+\[[a-z_]+=[^\]]*\]", lambda match: signal_title(match[0]), text)


@cache
def effect_names() -> re.Pattern[str]:
    """Names of effects with their form, and of numbers of the base model; not where they are part of a longer name or of a key."""
    return re.compile(rf"(?<![\w.])(?:{'|'.join(sorted({*every_effect(), BASE}, key=len, reverse=True))})(?:\.[a-z]\w*)?(?!\w)")


def in_words(text: str) -> str:
    """A text whose effects and signals stand as their keys, with their words instead: what is told on the way, and why a verdict is what it is."""
    return effect_names().sub(lambda name: effect_title(name[0]), with_titles(text))


def with_minus(text: str) -> str:
    """A text whose numbers have a minus, as those of tables do; hyphens of names stay."""
    return re.sub(r"(?<!\w)-(?=\.?\d)|(?<=\de)-(?=\d)", "−", text)


def signal_axis(signal: str, unit: str) -> str:
    """Without tags, which the figure's title has."""
    name = scale(unit, signal)[1]
    return signal_title(signal.partition("[")[0]) + (f" [{name}]" if name else "")


def estimate(entry: dict[str, Any]) -> tuple[str, str, str]:
    """(value, interval, unit) of a parameter, all in one unit that suits its size."""
    found = of_estimate(entry)
    return *both_texts(entry, found.number, 3, number), "" if is_any(entry) else pretty(found.unit)
