"""The command that completes a reducer, from what is given of it."""

import math

from fmu_src.display import read_in, read_text
from reducers.completion.complete import UNITS
from reducers.completion.doubts import FREE
from reducers.completion.given import Given

# Digits that somebody may have typed, and those of a number with more.
MOST_TYPED, CONVERTED = 8, 6

# What the description of a file says of pins that nobody counted.
PINS_ASSUMED = "pins assumed"


def words_of(given: Given) -> list[str]:
    """``rvwear reducer new`` with all options but names of reducer and file; what is usual is left out, but for speed and rollers."""
    words = ["rvwear", "reducer", "new", "--ratio", f"{given.ratio:.12g}", *(["--pins", str(given.pins)] if given.pins_counted else [])]
    words += ["--rated", typed(given.rated)]
    words += ["--speed", typed(given.speed), *(["--cranks", str(given.cranks)] if given.cranks is not None else []), "--rollers", str(given.rollers)]
    words += ["--diameter", typed(given.diameter)] if given.diameter is not None else []
    words += ["--lost-motion", typed(given.lost_motion)] if given.asks_lost_motion else []
    words += ["--stiffness", typed(given.stiffness)] if given.stiffness is not None else []
    for name, value in measured(given).items():
        words += ["--known", f"{name}={with_unit(value, UNITS[name])}"]
    return words


def measured(given: Given) -> dict[str, float]:
    """What is known but for supports that were found to make the catalogue's stiffness: with other numbers others do."""
    return {name: value for name, value in given.known.items() if name != FREE or given.stiffness is None}


def given_words(given: Given) -> str:
    """What was given in words, each number with the unit that it is read in; of speed and rollers those that nobody gave are said to be usual."""
    said = [f"ratio {given.ratio:g}", *([f"{given.pins} pins"] if given.pins_counted else []), f"rated torque {given.rated:g} N m"]
    said += [f"diameter {given.diameter:g} mm"] if given.diameter is not None else []
    said += [f"{given.cranks} cranks"] if given.cranks is not None else []
    own = {"speed": f"{given.speed:g} rpm of the output", "rollers": f"{given.rollers} rollers a bearing"}
    said += [f"{text} (as usual)" if name in given.usual else text for name, text in own.items()]
    said += [f"lost motion {given.lost_motion:g} arcmin"] if given.asks_lost_motion else []
    said += [f"torsional stiffness {given.stiffness:g} N m/arcmin"] if given.stiffness is not None else []
    return ", ".join([*said, *(f"{name} {read_text(value, UNITS[name], CONVERTED)}" for name, value in measured(given).items())])


def typed(value: float) -> str:
    """With the digits that were given; six of a number that another unit made."""
    return f"{value:.{MOST_TYPED if is_typed(value) else CONVERTED}g}"


def is_typed(value: float) -> bool:
    """Whether somebody may have typed it: few digits say it all."""
    return math.isclose(float(f"{value:.{MOST_TYPED}g}"), value, rel_tol=1e-12)


def with_unit(value: float, unit: str) -> str:
    """In the unit that people read it in, or in ``unit`` if it was typed in that."""
    usual, (converted,) = read_in(unit, value)
    found, number = (unit, value) if is_typed(value) and not is_typed(converted) else (usual, converted)
    return f"{typed(number)}{'' if found == '1' else found}"


def usual_name(given: Given) -> str:
    """What a completed reducer is called that nobody gives a name."""
    return f"ratio-{given.ratio:g}-{given.rated:g}Nm"


def described(given: Given) -> str:
    """The description of a completed reducer in its file."""
    assumed = "" if given.pins_counted else f", {PINS_ASSUMED}"
    return f"ratio {given.ratio:g}, rated {given.rated:g} N m at {given.speed:g} rpm of the output{assumed}, completed by design rules"
