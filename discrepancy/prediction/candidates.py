"""From the catalogue of effects to what the statistics may look for in a campaign."""

from collections.abc import Iterable
from dataclasses import replace
from itertools import product

from discrepancy.effects import MODULES
from discrepancy.held_names import HELD
from discrepancy.model_file import every_effect, halves_of
from discrepancy.prediction.orders import ROLLERS
from discrepancy.problem import CHAIN, ERROR, ORDERS, Candidate, Parameter, Record, is_unplaced
from fmu_src.effect import Effect, EffectParameter
from rv_plant.effects import EFFECTS as PLANT
from rv_plant.pin_numbers import PIN_NUMBERS

# Quantities that show what an effect's ``signals`` name in short.
SHOWN_BY = {
    "vibration": ("vibration", "vibration_order"), "debris": ("debris_iron",),
    "pin_on_disc": ("pin_on_disc_depth", "pin_on_disc_mass"), ERROR: (ERROR, ORDERS),
}  # fmt: skip
# Searched by hand only: a constant moment on the flange shows as discs that are misaligned with the ring, which stand for both.
NOT_SEARCHED = {"constant moment"}
# So many numbers of a group fit any few depths or torques: looked for only where a pattern over the angle tells.
PATTERNS = {"harmonics": (ERROR, ORDERS)}
# What these change in loops at a few places, or in their mean, any spring does as well: looked for only where other signals show them, too.
NOT_BY_LOOPS = {"carrier_stiffness", "first_stage_play", "pin_seats", "race_spall", "ring_stiffness", "tilting_moment"}
MOST_CRANKS = 3
# From this on two speeds are two.
SPEEDS_DIFFER = 1.1


def parameter_of(p: EffectParameter, value: float, name: str = "", prior: float | None = None) -> Parameter:
    v = p.variable
    return Parameter(name or v.name, v.unit, value, v.minimum, v.maximum, p.scale, p.sign, prior, v.description)


def shown_by(effect: Effect) -> tuple[str, ...]:
    """Quantities that show the effect; none: any."""
    return tuple(q for s in effect.signals for q in SHOWN_BY.get(s, (s,)))


def groups(effect: Effect) -> dict[str, tuple[list[EffectParameter], list[EffectParameter]]]:
    """Amplitudes and shapes of each group of an effect."""
    found: dict[str, tuple[list[EffectParameter], list[EffectParameter]]] = {}
    for p in effect.amplitudes():
        found.setdefault(p.group, ([], []))[0].append(p)
    for p in effect.parameters:
        if p.kind == "shape":
            for name, (_, shapes) in found.items():
                if not p.group or name in p.group.split():
                    shapes.append(p)
    return found


def within_ring(p: Parameter, pins: int) -> Parameter:
    """A shape, the number of a pin with those of this ring as its bounds."""
    return replace(p, upper=float(pins), counts=True) if p.name in PIN_NUMBERS else p


def shape_grid(shapes: Iterable[EffectParameter], pins: int) -> tuple[dict[str, float], ...]:
    """Values of all shapes at once; of the numbers of pins those of the first ``pins``."""
    grids = {p.variable.name: [v for v in p.grid if v <= pins] if p.variable.name in PIN_NUMBERS else p.grid for p in shapes if p.grid}
    return tuple(dict(zip(grids, values)) for values in product(*grids.values()))


def candidates(
    records: list[Record], present: dict[str, float], excluded: set[str], mountings: list[str], output_pins: int = 0, cranks: int = 2,
    pins: int = 40, ways: int = 2,
) -> tuple[Candidate, ...]:
    """Every effect that the records can show and that is not among the nuisances.

    ``present`` are values that the model already has; an effect that is in it is not a
    candidate again.  The reducer is turned onto itself in so many ``ways`` (``Topology``): of its ``pins`` those of one share
    show another curve.
    """
    quantities = list(dict.fromkeys(r.quantity for r in records))
    there = {
        "": True, "output pins": output_pins > 0, "locked output": any(r.tags.get("locked") == "output" for r in records), "speeds": several_speeds(records),
        "unknown position": any(is_unplaced(r) for r in records),
    }  # fmt: skip
    # Groups of cranks and holes that this reducer does not have.
    beyond = {f"{part} {k}" for part in ("crank", "hole") for k in range(cranks + 1, MOST_CRANKS + 1)}
    found = []
    for name, effect in every_effect().items():
        part = CHAIN if name in MODULES else "plant" if name in PLANT else "wear"
        halves = [half for half in halves_of(name) if set(shown_by(half)) & set(quantities)]
        if len(halves) == 1:
            # Of the other half nothing shows: its parameters would stay where they are, its shapes are no shapes here.
            effect = halves[0]
        signals = shown_by(effect)
        if (signals and not set(signals) & set(quantities)) or not there[effect.needs]:
            continue
        if part == CHAIN and MODULES[name].PER == "loops":
            found += loop_candidates(name, effect, records, present.keys() | excluded)
            continue
        if part == CHAIN:
            # Where nobody knows a zero an offset shows nothing.
            # Nor in orders without the mean.
            known = {r.quantity for r in records if (r.zero_known if r.quantity == ORDERS else not r.free_zero)}
            measured = list(dict.fromkeys(ERROR if q == ORDERS else q for q in quantities if name != "sensor_offset" or q in known))
            found += chain_candidates(name, effect, signals, measured, mountings, present.keys() | excluded)
            continue
        for group, (amplitudes, shapes) in groups(effect).items():
            names = {p.variable.name for p in amplitudes}
            seen = PATTERNS.get(group, tuple(q for q in signals if q not in HELD) if name in NOT_BY_LOOPS else signals)
            if group in NOT_SEARCHED | beyond or names & excluded or names & present.keys() or (seen and not set(seen) & set(quantities)):
                continue
            estimated = [p for p in shapes if p.grid and p.variable.name not in excluded]
            title = f"{effect.title}: {group}" if group else effect.title
            found.append(Candidate(
                f"{name}.{group.replace(' ', '_')}" if group else name, title,
                tuple(parameter_of(p, float(p.variable.start)) for p in amplitudes),
                tuple(within_ring(parameter_of(p, float(p.variable.start)), pins) for p in estimated),
                shape_grid(estimated, pins // ways), seen, part, ROLLERS if effect.rolled_over else (),
            ))  # fmt: skip
    return tuple(found)


def several_speeds(records: Iterable[Record]) -> bool:
    """Whether transmission errors were measured at speeds that differ by more than a tenth."""
    speeds = [abs(r.factors["speed"]) for r in records if r.quantity in (ERROR, ORDERS) and "speed" in r.factors]
    return bool(speeds) and max(speeds) > SPEEDS_DIFFER * min(speeds)


def loop_candidates(name: str, effect: Effect, records: Iterable[Record], taken_names: set[str]) -> list[Candidate]:
    """One for a rig that stood still for all loops, and where these have several conditions one for a rig that was turned between them."""
    conditions = list(dict.fromkeys(r.condition for r in records if is_unplaced(r) and not r.held_out))
    found = []
    for variant, places in (("", [""]), (".each", [f"[{condition}]" for condition in conditions if len(conditions) > 1])):
        amplitudes = tuple(parameter_of(p, 0.0, f"{p.variable.name}{place}", MODULES[name].PRIOR) for place in places for p in effect.amplitudes())
        if amplitudes and not any(a.name in taken_names for a in amplitudes):
            title = f"{effect.title}, another in each condition" if variant else effect.title
            found.append(Candidate(name + variant, title, amplitudes, (), (), effect.signals, CHAIN))
    return found


def chain_candidates(
    name: str, effect: Effect, signals: tuple[str, ...], quantities: list[str], mountings: list[str], taken_names: set[str]
) -> list[Candidate]:
    per = MODULES[name].PER
    places = {"quantity": quantities, "mounting": mountings, "campaign": [""]}[per]

    def called(p: EffectParameter, place: str) -> str:
        return f"{p.variable.name}[{place}]" if place else p.variable.name

    def shapes(place: str) -> tuple[tuple[Parameter, ...], tuple[dict[str, float], ...]]:
        """Shapes that are estimated, with their grid, under the names that they have at a place."""
        searched = [p for p in effect.parameters if p.kind == "shape" and p.grid and called(p, place) not in taken_names]
        points = product(*(p.grid for p in searched))
        grid = tuple(dict(zip((called(p, place) for p in searched), point)) for point in points) if searched else ()
        return tuple(parameter_of(p, float(p.variable.start), called(p, place)) for p in searched), grid

    if per == "mounting":
        amplitudes = tuple(parameter_of(p, 0.0, called(p, m)) for m in places for p in effect.amplitudes())
        taken = any(a.name in taken_names for a in amplitudes)
        return [] if taken else [Candidate(name, effect.title, amplitudes, (), (), signals, CHAIN)]
    return [
        Candidate(
            f"{name}.{place}" if place else name, f"{effect.title}: {place}" if place else effect.title,
            tuple(parameter_of(p, 0.0, called(p, place)) for p in effect.amplitudes()), *shapes(place),
            SHOWN_BY.get(place, (place,)) if place else signals, CHAIN,
        )
        for place in places if not any(called(p, place) in taken_names for p in effect.amplitudes())
    ]  # fmt: skip
