"""Runs of both units on a bench: from which equilibria one starts, and in which parts it is computed."""

from collections.abc import Callable, Hashable, Iterable, Mapping, Sequence
from itertools import pairwise

import numpy as np

from discrepancy.prediction.lives import Lives
from discrepancy.prediction.twins import Twins
from discrepancy.prediction.units import Condition
from discrepancy.problem import NEAR
from fmu_src.arrays import Floats
from fmu_src.threads import Threads
from wear_fmu import accumulator

# Equilibria that are worth a thread of their own; always parted so, for the same angles are the same whoever computes them.
PART = 1024
# Of durations or torques.
NONE = np.zeros(0)
# A step on the spot takes the wear unit's contacts to angles that were set; one of no length only reads where they are, and FMUs refuse it [s].
MOMENT = 1e-12


class Runs(Lives):
    """What running and held tests have in common; ``threads`` share the parts of one run."""

    twins: Twins
    threads: Threads

    def has(self, names: Iterable[str], values: Mapping[str, float]) -> bool:
        """Whether one of the plant's parameters that are off at 0 is on."""
        return any(values.get(name, self.starts[0][name]) != 0.0 for name in names)

    def beside(self, key: tuple[Hashable, ...], base: Callable[[], tuple[Floats, Floats]], ways: Sequence[Floats] = ()) -> Floats:
        """Equilibria where the run of ``key`` (kind, condition, relevant values, way, ...) starts: those of one whose values are said to be near, or
        of the same values, along the same way or one of other ``ways``, if it was made; else of the ``base`` model's."""
        kind, condition, relevant, own_way, *rest = key
        assert isinstance(condition, Condition)
        near = self.relevant(NEAR.get() or {}, condition.hours > 0.0)
        for way in (own_way, *(other.tobytes() for other in ways)):
            for values in (near, relevant) if near else (relevant,):
                like = (kind, condition, values, way, *rest)
                found = self.runs.peek(like) if like != key else None
                if isinstance(found, tuple):
                    equilibria: Floats = found[1]
                    return equilibria
        return base()[1]

    def put_wear(self, wears: np.ndarray, plants: np.ndarray) -> None:
        """Profile errors of worn surfaces at the present angles, to which their unit (a copy that may be turned) is turned without wear."""
        for name in ("crank_angle", "output_angle", "cage_angle"):
            wears[name] = wears[f"{name}_before"] = plants[name]
        wears["acceleration"] = wears["crank_speed"] = 0.0
        self.check((0, accumulator.step(wears, 0.0, MOMENT)), plants, wears)
        for name in ("mesh_profile_error", "roller_profile_error"):
            plants[name] = wears[name]


def parts(count: int, equilibria: int = 1) -> list[slice]:
    """So many angles, of so many ``equilibria`` each, in parts of about the same length."""
    wanted = min(count, max(1, round(count * equilibria / PART)))
    ends = [k * count // wanted for k in range(wanted + 1)]
    return [slice(*pair) for pair in pairwise(ends)]
