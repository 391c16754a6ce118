"""A held output's loop does not depend on where its equilibria are looked for, whatever remembers the way."""

import numpy as np
import pytest

from discrepancy.model_file import load_model
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.lives import SHORT_CYCLE
from discrepancy.prediction.torque_way import entered
from discrepancy.prediction.units import Condition
from studies import coupled

POSITIONS = 2


@pytest.mark.parametrize("name", ["RV20E-121", "BX-40E"])
@pytest.mark.parametrize("values", [
    {"needle_clearance_added": 1e-6}, {"friction_coefficient": 0.02}, {"equidistant_added": -3e-6},
    {"support_slip_compliance": 2e-8, "support_slip_torque": 30.0, "friction_coefficient": 0.01},
], ids="+".join)  # fmt: skip
def test_a_loop_that_starts_beside_a_similar_one_is_that_along_its_own_way(name, values):
    """Friction's elements follow the last equilibrium, not the place from which the next is looked for: 1e-10 rad is 2e-5 arcsec."""
    bench = Bench(load_model(name).reducer, {})
    # A coarse loop: far steps, on which a start from elsewhere would show; none at no torque, where the output floats.
    path, _ = entered(bench.rated_load * np.cos(np.linspace(0.0, 2.0 * np.pi, 24)), bench.rated_load)
    condition = Condition(bench.rated_speed, bench.rated_load)
    beside = bench.held_turnings(condition, values, path, POSITIONS, SHORT_CYCLE)
    for k, angle in enumerate(bench.held_at(condition, POSITIONS)):
        turning, places = np.zeros(len(path)), np.zeros((len(path), bench.templates[0]["z"].shape[1]))
        plants = bench.new_held(condition, values, angle, path, np.zeros(places.shape[1]))
        assert coupled.torque_sweep(plants, path, turning, places, places, False) == 0
        assert beside[k] == pytest.approx(turning, abs=2e-10)
        # Friction opens the loop by far more than that.
        assert np.ptp(turning) > 1e-4
