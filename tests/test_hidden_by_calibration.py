"""An effect that a calibrated number imitates so well that a score at the base fit sees little of it; a fit of both sees the rest."""

import numpy as np
import pytest

from discrepancy.inference.diagnose import HIDDEN, Diagnostician
from discrepancy.inference.verdict import NONE
from discrepancy.problem import Candidate, Parameter, Record

LOADS = (50.0, 75.0, 100.0, 125.0)
# Over the loads, with no mean and nothing in common: what an effect shows beside the coefficient while it is small, and where it is large.
SMALL, LARGE = dict(zip(LOADS, (1.0, -1.0, -1.0, 1.0))), dict(zip(LOADS, (-1.0, -1.0, 1.0, 1.0)))
OTHERS = [f"other_{k}" for k in range(8)]


class Worn:
    """Depths with a coefficient that is calibrated, and a film that moves it."""

    nuisances = (Parameter("coefficient", "um", 10.0, -1e3, 1e3, 1.0),)
    candidates = (
        Candidate("film", "Film", (Parameter("film", "1", 0.0, 0.0, 50.0, 0.2, 1),), signals=("wear_depth",)),
        *(Candidate(name, name, (Parameter(name, "um", 0.0, -10.0, 10.0, 0.1),), signals=("wear_depth",)) for name in OTHERS),
    )

    def __init__(self, film, seed, noise=0.2):
        rng, places = np.random.default_rng(seed), np.linspace(0.0, 1.0, 24)
        self.waves = {load: rng.standard_normal((len(OTHERS), len(places))) for load in LOADS}
        self.records = [Record(f"depth_{load:g}_{k}", "wear_depth", "um", f"load_{load:g}", k, np.zeros(len(places)), {"x": places}, {"load": load})
                        for load in LOADS for k in (1, 2)]  # fmt: skip
        for record, y in zip(self.records, self.predict({"film": film})):
            record.values[:] = y + noise * rng.standard_normal(len(y))

    def predict(self, values, which=None):
        return [self.law(self.records[i], values) for i in (range(len(self.records)) if which is None else which)]

    def law(self, record, v):
        load, film = record.factors["load"], v.get("film", 0.0)
        y = v.get("coefficient", 10.0) - film + 0.02 * film * SMALL[load] + 0.045 * film**2 * LARGE[load]
        return y + np.array([v.get(name, 0.0) for name in OTHERS]) @ self.waves[load]


@pytest.mark.parametrize("seed", [3, 4])
def test_what_a_coefficient_hides_is_fitted_and_then_named(seed):
    diagnostician = Diagnostician(Worn(2.0, seed))
    found = diagnostician.run()
    [film] = [s for s in diagnostician.screening.scores if s.name == "film"]
    # A score alone would have named nothing.
    assert film.left < HIDDEN and film.p_adjusted > diagnostician.settings.naming_level
    assert [e.name for e in found.effects] == ["film"]
    low, high = found.effects[0].parameters["film"]["interval"]
    assert low < 2.0 < high


@pytest.mark.parametrize("seed", [1, 2, 3, 4, 5, 6])
def test_noise_hides_nothing(seed):
    assert Diagnostician(Worn(0.0, seed)).run().verdict == NONE
