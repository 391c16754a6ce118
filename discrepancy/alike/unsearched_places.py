"""Parts at which an effect that sits on one of several is not looked for, and of which no other place tells.

A reducer that is turned by a part of a turn onto itself, its discs, cranks and pins each onto others of their kind, does the same as before: an
error of crank 2 at disc 2 shows as one of crank 1 at disc 1 where there are two of both.  With three cranks and two discs no turning does that,
and what sits at the second disc has no candidate.
"""

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import product

from discrepancy.alike.other_places import choices, current, group_of, parts, siblings, words
from discrepancy.model_file import every_effect
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import effect_of
from fmu_src.effect import Effect
from rv_plant.topology import Topology

# Places that are named of an effect.
MOST_NAMED = 4
# Number of the crank or hole in the group's name, or None, and the numbers that are chosen of parts.
Place = tuple[int | None, tuple[int, ...]]


@dataclass(frozen=True)
class Unsearched:
    """``place`` in words; ``setting``: the line of a model file that has the effect looked for there."""

    effect: str
    place: str
    setting: str


def unsearched_text(model: PhysicalModel) -> str:
    """Where the effects among the candidates of a diagnosis are not looked for, and how they would be; empty where all places are reached."""
    found = unsearched_places(model)
    if not found:
        return ""
    told = []
    for effect in dict.fromkeys(one.effect for one in found):
        places = [one.place for one in found if one.effect == effect]
        more = f" and {len(places) - MOST_NAMED} more" if len(places) > MOST_NAMED else ""
        told.append(f"{effect} not at {', '.join(places[:MOST_NAMED])}{more}")
    t = model.file.reducer.topology
    return (
        f"with {t.cranks} cranks and {t.discs} discs the same error shows otherwise at each part, and is not looked for at all of them ({'; '.join(told)}):"
        f" there it is taken for another effect, or for none; a model file with {found[0].setting} in [effects.{found[0].effect}] looks there instead"
    )


def unsearched_places(model: PhysicalModel) -> list[Unsearched]:
    """Places that neither a candidate has nor one that looks like it, because the reducer can be turned onto itself."""
    topology, found = model.file.reducer.topology, []
    groups: dict[tuple[str, str], list[str]] = {}
    for candidate in model.candidates:
        group = group_of(candidate.name)
        # Groups that differ by their number belong together: crank 1, crank 2.
        groups.setdefault((effect_of(candidate.name), group.rstrip("0123456789 ")), []).append(group)
    for (name, _), alike in groups.items():
        effect = every_effect().get(name)
        chosen = choices(effect, alike[0]) if effect and not says_where(effect) else []
        if effect is None or not chosen:
            continue
        searched = [(number_of(group), current(chosen, model)) for group in alike]
        reached = {place for here in searched for place in turned(here, [p.part for p in chosen], topology)}
        for group, numbers in product(siblings(effect, alike[0], topology.cranks), product(*(range(1, parts(p, model) + 1) for p in chosen))):
            if (number_of(group), numbers) not in reached:
                setting = f'{chosen[0].variable.path.rpartition(".")[2]} = {{ value = {numbers[0]}, unit = "1" }}'
                found.append(Unsearched(name, words(group, chosen, numbers), setting))
    return found


def says_where(effect: Effect) -> bool:
    """Whether an angle is fitted that says where on its part the effect acts: it stands for much of which part it is, too."""
    return any(p.kind == "shape" and p.grid and p.variable.unit == "rad" for p in effect.parameters)


def number_of(group: str) -> int | None:
    """Of "crank 2" its 2; None for a group that is of no one crank."""
    last = group.rpartition(" ")[2]
    return int(last) if last.isdigit() else None


def turned(place: Place, names: Sequence[str], topology: Topology) -> Iterator[Place]:
    """Where a place comes to as the reducer is turned onto itself in all ways, itself included; ``names``: disc or crank, of what is chosen."""
    ways = topology.ways
    counts = {"disc": topology.discs, "crank": topology.cranks}

    def after(number: int, part: str, way: int) -> int:
        return (number - 1 + way * counts[part] // ways) % counts[part] + 1

    for way in range(ways):
        yield None if place[0] is None else after(place[0], "crank", way), tuple(after(n, part, way) for n, part in zip(place[1], names))
