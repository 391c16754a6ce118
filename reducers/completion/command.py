"""The command that completes a reducer, from what is given of it."""

from reducers.completion.complete import UNITS
from reducers.completion.given import Given


def words_of(given: Given) -> list[str]:
    """``rvwear reducer new`` with all options but names of reducer and file; what is usual is left out, but for speed and rollers."""
    words = ["rvwear", "reducer", "new", "--ratio", f"{given.ratio:.12g}", "--pins", str(given.pins), "--rated", f"{given.rated:.6g}"]
    words += ["--speed", f"{given.speed:.12g}", *(["--cranks", str(given.cranks)] if given.cranks is not None else []), "--rollers", str(given.rollers)]
    words += ["--diameter", f"{given.diameter:.12g}"] if given.diameter is not None else []
    words += ["--lost-motion", f"{given.lost_motion:.12g}"] if given.lost_motion != Given.lost_motion else []
    for name, value in given.known.items():
        words += ["--known", f"{name}={value:.12g}{'' if UNITS[name] == '1' else UNITS[name]}"]
    return words


def usual_name(given: Given) -> str:
    """What a completed reducer is called that nobody gives a name."""
    return f"ratio-{given.ratio:g}-{given.rated:g}Nm"


def described(given: Given) -> str:
    """The description of a completed reducer in its file."""
    return f"ratio {given.ratio:g}, rated {given.rated:g} N m at {given.speed:g} rpm of the output, completed by design rules"
