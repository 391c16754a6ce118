"""Conditions under which a reducer does the same.

How warm it is and how fast it turns shows in a new reducer's play and yielding only where an effect asks for it.  Whether it shows
in a run is seen at a few of its places: where these repeat another condition's run, that one is taken for all of it.
"""

import threading
from collections.abc import Callable, Hashable, Iterable
from dataclasses import replace

import numpy as np
import numpy.typing as npt

from discrepancy.prediction.units import Condition
from fmu_src.arrays import Floats

# Where in a run.
Places = npt.NDArray[np.intp]
# A run is compared at so many of its places; one of hardly more is made.
PLACES, HARDLY_MORE = 5, 12
# What counts as the same: of what values change in it, and of how far the curve goes at all (its equilibria are as good).
OF_CHANGE, OF_CURVE = 1e-6, 1e-6
# So many other conditions are looked at.
MOST = 3
# Of fewer conditions than these all are computed.
HARDLY_MORE_CONDITIONS = 4


class Twins:
    """By run, which conditions were computed themselves and which repeat one of these."""

    def __init__(self) -> None:
        self.own: dict[Hashable, list[Condition]] = {}
        self.found: dict[tuple[Hashable, Condition], Condition] = {}
        self.lock = threading.Lock()

    def __getstate__(self) -> dict[str, object]:
        """What was found can be found again."""
        return {}

    def __setstate__(self, state: dict[str, object]) -> None:
        self.__init__()  # type: ignore[misc]

    def of(self, run: Hashable, condition: Condition, places: Places | None, repeats: Callable[[Condition, Places], bool]) -> Condition:
        """The condition whose ``run`` is to be taken for that of ``condition``: its own, or one that it ``repeats`` at some ``places``.

        Only new reducers have such: a life under other conditions is another one.
        """
        if condition.hours > 0.0 or places is None:
            return condition
        asked = (run, condition)
        if asked in self.found:
            return self.found[asked]
        alike = (run, replace(condition, speed=0.0, temperature=0.0))
        with self.lock:
            others = self.own.setdefault(alike, [])
            if not others:
                others.append(condition)
                self.found[asked] = condition
                return condition
            known = others[:MOST]
        twin = next((other for other in known if other == condition or repeats(other, places)), condition)
        with self.lock:
            if twin == condition and condition not in others:
                others.append(condition)
            self.found[asked] = twin
        return twin


def places_of(count: int) -> Places | None:
    """Of ``count`` places those at which a run is compared, the first among them; None where that is hardly cheaper than all of it."""
    return None if count < HARDLY_MORE else np.linspace(0, count - 1, PLACES).astype(np.intp)


def same(seen: Floats, known: Floats, curve: Floats, base: Floats, left: float = 0.0) -> bool:
    """Whether what is ``seen`` at some places is what was ``known`` there, of a ``curve`` that is ``base`` without the values.

    ``left`` is what is nothing but rounding.
    """
    allowed = left + OF_CHANGE * float(np.abs(curve - base).max()) + OF_CURVE * float(np.ptp(base))
    return bool(np.abs(seen - known).max() <= allowed)


def corners(condition: Condition, others: Iterable[Condition]) -> list[Condition]:
    """Of the new reducer's conditions with this load those furthest out in speed and temperature, if ``condition`` lies between them and is none.

    What they have in common all between them have: nothing that depends on speed or temperature is the same slow and fast, cold and warm.
    Empty where there are hardly more.
    """
    group = list({c for c in others if c.hours == condition.hours == 0.0 and (c.load, c.direction) == (condition.load, condition.direction)})
    if len(group) <= HARDLY_MORE_CONDITIONS:
        return []
    speeds, temperatures = (np.array([getattr(c, name) for c in group]) for name in ("speed", "temperature"))
    inside = speeds.min() <= condition.speed <= speeds.max() and temperatures.min() <= condition.temperature <= temperatures.max()
    wide, warm = max(float(np.ptp(speeds)), 1e-9), max(float(np.ptp(temperatures)), 1e-9)
    found = [group[int(np.argmax(a * speeds / wide + b * temperatures / warm))] for a, b in ((-1, -1), (-1, 1), (1, -1), (1, 1))]
    return sorted(set(found), key=lambda c: (c.speed, c.temperature)) if inside and condition not in found else []
