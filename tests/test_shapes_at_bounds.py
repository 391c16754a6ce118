"""Beside other effects one may be far larger than it seems alone: where its shape ran to a bound on the way, it begins anew."""

import numpy as np
import pytest
from test_few_numbers import Numbers, number

from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.refit.effect_fit import fit_effects
from discrepancy.problem import Candidate, Parameter

SPRING = Candidate("spring", "spring", (Parameter("spring", "1", 0.0, 0.0, 1e3, 10.0, 1),))
FRICTION = Candidate("friction", "friction", (Parameter("friction", "1", 0.0, 0.0, 1e3, 10.0, 1),), (Parameter("before", "1", 0.2, 1e-5, 10.0, 0.2),))
WAY = np.linspace(-1.0, 1.0, 200)


def loop(record, values):
    """Friction that has turned round after a way of its own, on a spring."""
    return values.get("spring", 0.0) * WAY + values.get("friction", 0.0) * np.tanh(WAY / values.get("before", 0.2))


@pytest.mark.parametrize("before", [0.02, 0.05])
def test_friction_that_began_a_thousand_times_too_small_is_found_on_a_soft_seat(before):
    """Both were hidden in dense loops of a base on rigid supports: friction 0.060 had ended at 0.040, its way at a bound, 330 of chi-square worse, and a seat with
    memory beside a sensor's gain was named."""
    rng, truth = np.random.default_rng(1), {"spring": 100.0, "friction": 10.0, "before": 0.25}
    runs = [number("loop", loop(None, truth) + 0.5 * rng.standard_normal(WAY.size), replicate=k, noise=0.5) for k in (1, 2)]
    space = Workspace(Numbers(runs, loop, candidates=(SPRING, FRICTION)))
    space.fit_base()
    found = fit_effects(space, [SPRING, FRICTION], [{"spring": 105.0, "friction": 0.01, "before": before}])
    assert found.chi2 < 1.25 * 2 * WAY.size
    assert found.values == pytest.approx(truth, rel=0.05)
