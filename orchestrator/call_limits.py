"""How long the calls of an isolated unit may take."""

import math
from collections.abc import Mapping
from dataclasses import dataclass, fields, replace

from fmu_src.faults import InputFault, nearest

# A unit that gives no answer for so long hangs (assumed: the slowest unit known needs a tenth for its slowest step).
USUAL = 600.0


@dataclass(frozen=True)
class CallLimits:
    """The longest time [s] of one call, by what it is for; ``values`` are get and set, ``state`` everything with the state."""

    start: float = USUAL
    initialise: float = USUAL
    step: float = USUAL
    values: float = USUAL
    state: float = USUAL
    end: float = 2.0

    def __post_init__(self) -> None:
        for name, value in vars(self).items():
            if not 0.0 < value < math.inf:
                raise InputFault(f"call limit {name} = {value:g} s: a positive number of seconds is needed")

    @property
    def least(self) -> float:
        return min(float(value) for value in vars(self).values())

    def with_changes(self, given: "float | Mapping[str, float] | CallLimits | None") -> "CallLimits":
        """With one number for all calls but the end, or numbers by their names; InputFault if one is none."""
        if given is None:
            return self
        if isinstance(given, CallLimits):
            return given
        known = [field.name for field in fields(self)]
        if not isinstance(given, Mapping):
            given = dict.fromkeys([name for name in known if name != "end"], given)
        for name, value in given.items():
            if name not in known:
                raise InputFault(f"call limit {name!r}: there is no such call{nearest(name, known, 1) or '; there are ' + ', '.join(known)}")
            if isinstance(value, bool) or not isinstance(value, (int, float)):
                raise InputFault(f"call limit {name} = {value!r}: a number of seconds is needed")
        return replace(self, **{name: float(value) for name, value in given.items()})


# What holds where nothing is said.
USUAL_LIMITS = CallLimits()


def parse_limits(texts: list[str]) -> dict[str, float] | None:
    """``30`` for all calls, or ``step=30``; what comes later goes before."""
    found: dict[str, float] = {}
    for text in texts:
        name, _, number = text.rpartition("=")
        try:
            value = float(number)
        except ValueError:
            raise InputFault(f"--call-limit {text!r}: write seconds for all calls, 30, or for one kind, step=30") from None
        found |= {name.strip(): value} if name else dict.fromkeys([f.name for f in fields(CallLimits) if f.name != "end"], value)
    return found or None
