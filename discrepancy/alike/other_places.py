"""Where an effect sits that one of several parts can have, and which other place would look like it.

A diagnosis fits such an effect at the part that its choices name, the first.  With two cranks an error of one's eccentric at one disc shows as that of the
other's lobe at the other disc, in every signal of the reducer as a whole: then no fit says which of both is to be opened.  Nor does one where the zero of
the output's angle was found by the base model's pattern: it is as well a wave of that further on, with which the cranks have made half a turn.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from itertools import product
from math import degrees
from typing import Any

import numpy as np

from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.separable import APART
from discrepancy.inference.verdict import STOPPED, Diagnosis
from discrepancy.model_file import every_effect
from discrepancy.prediction.candidates import groups
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import effect_of
from fmu_src.effect import Effect, EffectParameter

# Of what an effect shows, what another place may leave: cages of rollers are placed anew for each fit, and sizes take up some (assumed).
LEFT = 0.02


@dataclass(frozen=True)
class LookAlike:
    """Another place, in words; ``turned`` if it looks so with the angles' zero a wave of the pattern further on; ``candidate`` that looks for the effect
    there, if one does."""

    place: str
    turned: bool
    candidate: str | None


def placed(effects: list[dict[str, Any]], model: PhysicalModel, found: Diagnosis) -> list[dict[str, Any]]:
    """Named effects with their ``place``, in words, empty where an effect has none; the ``other_places`` at which they would show the same, and the
    candidates that ``look_alike``."""
    told = []
    for effect in effects:
        candidate = effect["candidates"][0]
        here, others = place_of(candidate, model), look_alikes(candidate, model, found)
        told.append(effect | {"place": place_text(here, others, model.wave), "other_places": [other.place for other in others],
                              "look_alike": [other.candidate for other in others if other.candidate]})  # fmt: skip
    return told


def place_text(here: str, others: list[LookAlike], wave: float) -> str:
    straight, turned = (" or ".join(other.place for other in others if other.turned == is_turned) for is_turned in (False, True))
    alike = f"{here} or {straight}, which look alike" if straight else here
    further = f"{degrees(wave):g} deg further on than it was found, which the signals leave open"
    return f"{alike}; {turned} if the zero of the output's angle is {further}" if turned else alike


def shortened(place: str, others: int) -> str:
    """Of ``place_text`` the place that was fitted, and how many ``others`` there are in place of their names."""
    here = place.partition("; ")[0].partition(" or ")[0]
    return f"{here}, or {f'one of {others} places that look alike' if others > 1 else 'one that looks alike'}" if others else place


def place_of(candidate: str, model: object) -> str:
    """The part at which a candidate (``effect.variant``) was looked for: "crank 2 at disc 1"; empty for one that has no choice of parts."""
    effect = every_effect().get(effect_of(candidate))
    group = group_of(candidate)
    chosen = choices(effect, group) if effect else []
    return words(group, chosen, current(chosen, model)) if chosen else ""


def look_alikes(candidate: str, model: PhysicalModel, found: Diagnosis) -> list[LookAlike]:
    """Other places where the effect with the same amplitudes, or their opposites, shows the same: what it predicts of the fitted runs differs by less than
    the best test sees, or than ``LEFT`` of what it changes there.  A few predictions each; none for a diagnosis that was stopped.
    """
    own_place = place_of(candidate, model)
    alone = [m for m in found.fits.members if [c.name for c in m.candidates if effect_of(c.name) == effect_of(candidate)] == [candidate]]
    if not own_place or not alone or found.verdict == STOPPED:
        return []
    effect, group, space = every_effect()[effect_of(candidate)], group_of(candidate), found.fits.space
    chosen, topology = choices(effect, group), model.file.reducer.topology
    # What a campaign cannot show of an effect was not fitted: it is off.
    off = {p.variable.name: p.variable.start for p in groups(effect)[group][0]}
    own, fitted = list(off), off | alone[0].fit.values
    rest = {name: value for name, value in fitted.items() if name not in own}
    shows_the_same = as_shown(space, fitted, rest)
    here = current(chosen, model)
    alike: list[LookAlike] = []
    places = list(product(siblings(effect, group, topology.cranks), product(*(range(1, parts(p, model) + 1) for p in chosen))))
    for turned, (sibling, numbers) in product((False, True) if model.zeros else (False,), places):
        place = words(sibling, chosen, numbers)
        if (numbers == here and not turned) or place in (own_place, *(other.place for other in alike)):
            # Fitted itself, or told already.
            continue
        names = [p.variable.name for p in groups(effect)[sibling][0]]
        zeros = {name: rest.get(name, zero) + model.wave * turned for name, zero in model.zeros.items()}
        if turned and not all(map(model.zero_bounds.hold, zeros.values())):
            # The campaign says that angles do not count from there.
            continue
        # Where nobody says the place of loops it is as well half a turn of the cranks on.
        loops = ({}, model.unstated_places.other(fitted)) if model.unstated_places.found else ({},)
        for sign, locked in product((1.0, -1.0), loops):
            there = {new: sign * fitted[old] for old, new in zip(own, names)} | {p.variable.name: float(n) for p, n in zip(chosen, numbers)}
            values = {**rest, **zeros, **there, **locked}
            with model.locked_as(values, fitted):
                same = shows_the_same(values)
            if same:
                looked = f"{effect_of(candidate)}.{sibling.replace(' ', '_')}" if numbers == here and sibling != group else None
                alike.append(LookAlike(place, turned, looked))
                break
    return alike


def as_shown(space: Workspace, fitted: Mapping[str, float], rest: Mapping[str, float]) -> Callable[[Mapping[str, float]], bool]:
    """Whether values show in the fitted runs what the ``fitted`` ones do: by less than the best test sees, or than ``LEFT`` of what these change beside
    the ``rest``, which are without the effect."""
    shown = space.predictions(fitted, space.training)

    def apart(values: Mapping[str, float]) -> float:
        predicted = space.predictions(values, space.training)
        return float(np.linalg.norm(space.whiten({i: a - b for i, a, b in zip(space.training, predicted, shown)})))

    enough = max(APART, LEFT * apart(rest))
    return lambda values: apart(values) < enough


def group_of(candidate: str) -> str:
    return candidate.partition(".")[2].replace("_", " ")


def choices(effect: Effect, group: str) -> list[EffectParameter]:
    """Choices of the part at which the amplitudes of a group act."""
    return [p for p in effect.parameters if p.part and group.startswith(p.group)]


def current(chosen: list[EffectParameter], model: object) -> tuple[int, ...]:
    """What the model's file chooses, or the first."""
    values = model.file.values() if isinstance(model, PhysicalModel) else {}
    return tuple(int(values.get(p.variable.name, float(p.variable.start))) for p in chosen)


def parts(p: EffectParameter, model: PhysicalModel) -> int:
    """How many of them the reducer has."""
    return int({"disc": model.file.reducer.topology.discs, "crank": model.file.reducer.topology.cranks}[p.part])


def siblings(effect: Effect, group: str, cranks: int) -> list[str]:
    """Groups of the same amplitudes for the other cranks, or their holes, with this one."""
    word, _, number = group.rpartition(" ")
    return [name for k in range(1, cranks + 1) if (name := f"{word} {k}") in groups(effect)] if number.isdigit() else [group]


def words(group: str, chosen: list[EffectParameter], numbers: tuple[int, ...]) -> str:
    """A crank stands before the disc."""
    return " at ".join([*filter(None, [group]), *sorted(f"{p.part} {n}" for p, n in zip(chosen, numbers))])
