"""Which conditions are proposed to be held out: those whose place the conditions that stay cover, so that a fit to these keeps what it needs."""

from collections.abc import Collection, Mapping, Sequence

from discrepancy.campaign.findings import LEAST_CONDITIONS
from discrepancy.campaign.guess.said import Guess
from discrepancy.campaign.guess.same_number import ANY_REDUCER
from discrepancy.campaign.quantities import FACTOR_KEYS
from discrepancy.held_names import LOCKED_AT

# What the conditions that stay have to cover first: several numbers that are calibrated, as lag and angle of an encoder, are told apart by loads alone.
FIRST = ("load", "temperature", "speed")
# What a condition states in words.
WORDS = ("direction", "mounting")
KEPT = "kept for the test of what is found"


def held_out(
    conditions: Mapping[str, Mapping[str, str]], quantities: Mapping[str, Sequence[str]], repeated: Mapping[str, Collection[str]] | None = None
) -> dict[str, Guess[bool]]:
    """Conditions to keep for the test of what is found: of each quantity that has enough one that its others cover.

    An effect that shows in one quantity alone is proven there or nowhere.  One condition may serve several quantities; none is taken that
    would leave a quantity fewer than two to fit, or without the only repetitions that tell its noise.  ``conditions``: name -> what is
    stated; ``quantities``: name -> what was measured in it; ``repeated``: name -> what of that was measured more than once.
    """
    measured: dict[str, list[str]] = {}
    for name in conditions:
        for quantity in dict.fromkeys(quantities.get(name, ())):
            measured.setdefault(quantity, []).append(name)
    repeats = {quantity: [n for n in names if quantity in (repeated or {}).get(n, ())] for quantity, names in measured.items()}
    found: dict[str, Guess[bool]] = {}
    # Those with fewest conditions choose first: theirs may serve the others, too.
    for names in sorted(measured.values(), key=len):
        if len(names) < LEAST_CONDITIONS or found.keys() & set(names):
            continue
        free = [n for n in names if all(sum(m not in found for m in others) >= LEAST_CONDITIONS for others in measured.values() if n in others)]
        free = [n for n in free if not any([m for m in alike if m not in found] == [n] for alike in repeats.values())]
        if chosen := covered(names, conditions, free):
            found[chosen[0]] = Guess(True, f"{KEPT}: {chosen[1]}", False)
    return {name: found[name] for name in conditions if name in found}


def covered(names: Sequence[str], conditions: Mapping[str, Mapping[str, str]], free: Sequence[str]) -> tuple[str, str] | None:
    """Of those that are ``free`` the condition whose numbers, the first ones first, lie within those of the other ``names``, and the reason;
    of several the nearest to the middle.  None where each lies beyond the others in the first number that differs.  Places at which the input
    was locked go round: none is beyond the others."""
    keys = FACTOR_KEYS.keys() - {LOCKED_AT}
    levels = {name: {key: ANY_REDUCER.number(FACTOR_KEYS[key], text, key) for key, text in conditions[name].items() if key in keys} for name in names}
    differing = sorted((key for key in levels[names[0]] if all(key in found for found in levels.values()) and len(values_of(levels, key)) > 1), key=rank)
    beyond = {name: [key for key in differing if is_beyond(levels[name][key], [levels[n][key] for n in names if n != name])] for name in free}
    fitting = [name for name in free if not differing or differing[0] not in beyond[name]]
    if not fitting:
        return None

    def order(name: str) -> tuple[object, ...]:
        alone = [word for word in WORDS if conditions[name].get(word) not in [conditions[n].get(word) for n in names if n != name]]
        far = max((from_middle(levels[name][key], values_of(levels, key)) for key in differing if len(values_of(levels, key)) > 2), default=1.0)
        # At the ends of everything the last one: it is the nearest to what comes.
        return [key in beyond[name] for key in differing], len(alone), far, names.index(name) * (-1 if far == 1.0 else 1)

    chosen = min(fitting, key=order)
    if not differing:
        return chosen, f"the last one; {not_told([conditions[name] for name in names])}"
    if not beyond[chosen]:
        return chosen, "inside the range of the others"
    within = [key for key in differing if key not in beyond[chosen]]
    return chosen, f"its {listed(within)} within the others', only its {listed(beyond[chosen])} beyond"


def not_told(stated: Sequence[Mapping[str, str]]) -> str:
    """Why any of the conditions would do."""
    places = list(dict.fromkeys(one[LOCKED_AT] for one in stated if LOCKED_AT in one))
    if len(places) < 2:
        return "nothing says which lies inside the others"
    return f"they differ by where the input was locked alone ({', '.join(places)}), and angles go round: none lies beyond the others, any would do"


def rank(key: str) -> int:
    name = FACTOR_KEYS[key].name
    return FIRST.index(name) if name in FIRST else len(FIRST)


def values_of(levels: Mapping[str, Mapping[str, float]], key: str) -> list[float]:
    """The different numbers of a key, rising."""
    return sorted({found[key] for found in levels.values()})


def is_beyond(value: float, others: Sequence[float]) -> bool:
    return not min(others) <= value <= max(others)


def from_middle(value: float, values: Sequence[float]) -> float:
    """0 in the middle of the range, 1 at its ends."""
    return round(abs(2.0 * (value - values[0]) / (values[-1] - values[0]) - 1.0), 9)


def listed(keys: Sequence[str]) -> str:
    return " and ".join(FACTOR_KEYS[key].name.replace("_", " ") for key in keys)
