"""Zeros that look alike, of which transmission errors prefer one and loops, as they stand, the other: a fit of both says which is right."""

from dataclasses import replace

import numpy as np
import pytest

from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.refit.refits import Refits
from discrepancy.problem import Candidate, Parameter, Record

ANGLE, TORQUE = np.linspace(0.0, 2.0 * np.pi, 200, endpoint=False), np.linspace(-1.0, 1.0, 80)
RING = Candidate("ring", "ring", (Parameter("ring", "1", 0.0, -9.0, 9.0, 1.0),))
ALIKE, TRUE = 2.0 * np.pi / 3.0, 2.0 * np.pi / 3.0 + 0.01


class Bench:
    """Three waves of a ring look alike a third of a turn on, but for a slight one; loops are turned by a lag that nobody else tells, and bent by the zero."""

    nuisances = (Parameter("zero", "rad", 0.0, -9.0, 9.0, 0.01), Parameter("lag", "1", 0.0, -99.0, 99.0, 1.0))
    candidates = (RING,)

    def __init__(self, bent, lag):
        """``bent`` [100 urad]: the cube that loops are predicted with beside the zero at 0 and beside the other; they were measured with none, and with ``lag``."""
        self.bent, random = bent, np.random.default_rng(4)
        shown = [self.error(1.0, TRUE) + 3e-7 * random.standard_normal(200) for _ in range(2)]
        shown += [1e-4 * lag * TORQUE + 1e-6 * random.standard_normal(80) for _ in range(2)]
        axes = [{"angle": ANGLE}, {"angle": ANGLE}, {"torque": TORQUE}, {"torque": TORQUE}]
        names = ["transmission_error", "transmission_error", "hysteresis", "hysteresis"]
        self.records = [Record(f"{q}/{k}", q, "rad", q, k % 2 + 1, y, a, {}) for k, (q, y, a) in enumerate(zip(names, shown, axes))]

    def error(self, ring, zero):
        return 1e-5 * ring * (np.sin(3.0 * (ANGLE + zero)) + 0.01 * np.sin(ANGLE + zero))

    def predict(self, values, which=None):
        ring, zero, lag = (values.get(name, 0.0) for name in ("ring", "zero", "lag"))
        loop = 1e-4 * lag * TORQUE + (self.bent[0] + (self.bent[1] - self.bent[0]) * zero / ALIKE) * 1e-4 * TORQUE**3
        every = [self.error(ring, zero)] * 2 + [loop] * 2
        return [every[i] for i in (range(4) if which is None else which)]

    def waves_on(self, values, directions):
        return [{"zero": values["zero"] + ALIKE}], [0, 1]

    def unseen(self, values):
        return []

    def places(self, values):
        return ()

    def put(self, values, places):
        pass

    placed_anew = otherwise = elsewhere = unplaced = unseen


@pytest.mark.parametrize(("bent", "right"), [((0.4, 0.0), TRUE), ((0.0, -0.4), 0.01)], ids=["errors", "loops"])
def test_a_fit_of_all_says_which_zero_is_right(bent, right):
    """Before the lag is fitted loops look worse beside the zero that errors prefer; then only that stays which no lag takes away."""
    space = Workspace(Bench(bent, lag=5.0))
    space.fit_base()
    refits = Refits(space, [RING])
    result = refits.fit(["ring"], {"ring": 1.0})
    began = replace(result, fit=replace(result.fit, values={"ring": 1.0, "zero": 0.01, "lag": 0.0}))
    found = refits.at_its_zero(began).fit.values
    # All that stands beside an effect was placed with each of the zeros: not once more.
    assert abs(refits.settled[began.key]["zero"] - found["zero"]) < 5e-3
    assert found["zero"] == pytest.approx(right, abs=5e-3)
    # At the other zero the lag was fitted after that: what was placed stands where it was placed.
    assert (abs(refits.settled[began.key]["lag"] - found["lag"]) > 1.0) == (right == TRUE)
    assert (refits.gained_elsewhere(began) > 25.0) == (right == TRUE)
