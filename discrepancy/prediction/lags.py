"""What effects add to the output's lag behind its input: a clearance adds the same at any load, which no share of the base model's own lag is.

Samples of an encoder on the output are placed by it, as finely as matters when an effect is fitted for good.
"""

from collections.abc import Mapping, Sequence

from discrepancy.prediction.bench import Bench
from discrepancy.prediction.by_effects import Effects, with_most
from discrepancy.prediction.conditions import condition_of, lag_added
from discrepancy.problem import Record

# Two seconds of arc: an order of 80 that is 10" high moves by less than a hundredth of one.
NEAR = 1e-5


class Lags:
    """Additions [rad] by condition (``conditions.lag_added``) and by set of effects."""

    def __init__(self, bench: Bench, records: Sequence[Record]):
        self.bench = bench
        self.conditions = {lag_added(r): condition_of(bench, r) for r in records if r.of_output}
        self.found: dict[Effects, dict[str, float]] = {}

    def taken(self, effects: Effects) -> Mapping[str, float]:
        """Those found with these effects, else with the most of them."""
        return with_most(self.found, effects, {})

    def place(self, effects: Effects, values: Mapping[str, float]) -> bool:
        """Takes the lags of ``values`` for these effects; False if that changes nothing."""
        now = self.added(values)
        if not self.differ(effects, now):
            return False
        self.found[effects] = now
        return True

    def are_elsewhere(self, effects: Effects, values: Mapping[str, float]) -> bool:
        return self.differ(effects, self.added(values))

    def differ(self, effects: Effects, now: Mapping[str, float]) -> bool:
        taken = self.taken(effects)
        return any(abs(added - taken.get(name, 0.0)) > NEAR for name, added in now.items())

    def added(self, values: Mapping[str, float]) -> dict[str, float]:
        return {name: self.bench.average("transmission_error", c, values) - self.bench.lag(c) for name, c in self.conditions.items()}
