"""Numbers of the reducer file that are not known for sure, as candidates: a base that is a little off is no missing effect."""

from collections.abc import Container

from discrepancy.problem import BASE, Candidate, Parameter
from reducers.reducer import Reducer

# Standard deviation of a number of which only its range is known, over the range: that of a uniform distribution.
SPREAD = 12.0**-0.5
# Typical error, for steps, over that deviation.
STEP = 0.5
# So many times its value, or such a part of it, a number may be all the same where what was measured outweighs its source; a length was read off a drawing.
BEYOND, LENGTH = 2.0, "m"
# The catalogue has an effect that is this number's error: it is named by that.
AS_EFFECTS = ("bearing_clearance", "output_clearance", "equidistant_modification", "shift_modification", "load_exponent", "run_in_ratio", "run_in_time")


def base_numbers(reducer: Reducer, taken: Container[str]) -> list[Candidate]:
    """One candidate per number with a range that is neither among ``taken`` (set or declared as a nuisance) nor a condition of the bench."""
    found = []
    for name, (low, high) in sorted(reducer.ranges.items()):
        variable = next((t.by_name[name] for t in (reducer.plant, reducer.wear) if name in t.by_name), None)
        if variable is None or variable.role != "parameter" or variable.shape or name in taken or name in AS_EFFECTS:
            continue
        deviation = SPREAD * (high - low)
        text = f"{variable.description} ({reducer.sources[name].partition(':')[0]})"
        value = reducer.starts[name]
        sign = 1 if value == low else -1 if value == high else 0
        least, most = low, high
        if sign == 0 and variable.unit != LENGTH:
            least, most = min(low, value / BEYOND), max(high, value * BEYOND)
        number = Parameter(name, variable.unit, value, least, most, STEP * deviation, sign, deviation, text, said=(low, high))
        found.append(Candidate(f"{BASE}.{name}", f"{variable.path} of the reducer file", (number,), part=BASE))
    return found
