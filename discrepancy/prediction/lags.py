"""What effects add to the output's lag behind its input: a clearance adds the same at any load, which no share of the base model's own lag is.

Samples of an encoder on the output are placed by it, as finely as matters when an effect is fitted for good.
"""

from collections.abc import Mapping, Sequence

from discrepancy.prediction.bench import Bench
from discrepancy.prediction.by_effects import ByEffects
from discrepancy.prediction.conditions import condition_of, lag_added
from discrepancy.problem import Record

# Two seconds of arc: an order of 80 that is 10" high moves by less than a hundredth of one.
NEAR = 1e-5


class Lags(ByEffects):
    """Additions [rad] by condition (``conditions.lag_added``)."""

    def __init__(self, bench: Bench, records: Sequence[Record]):
        super().__init__({}, NEAR)
        self.bench = bench
        self.conditions = {lag_added(r): condition_of(bench, r) for r in records if r.of_output}

    def now(self, values: Mapping[str, float]) -> dict[str, float]:
        return {name: self.bench.average("transmission_error", c, values) - self.bench.lag(c) for name, c in self.conditions.items()}
