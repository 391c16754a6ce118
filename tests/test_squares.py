"""What a test is worth along directions in which noise is known from few replicates."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.special import chdtrc, fdtrc

from discrepancy.inference.base_fit.components import effective_dof
from discrepancy.inference.base_fit.squares import PRIOR, chance

DOF = {("loop", "main"): 100.0, ("loop", "drift"): 2.0, ("loop", "offset"): 60.0, PRIOR: 1e6}
SPACE = SimpleNamespace(noise=SimpleNamespace(dof=DOF.__getitem__))
WIDTH, DRAWS = 5, 6000


def grams_of(shares, random):
    """Parts of the noise of five directions, turned anyhow; some of them are drift to these ``shares``."""
    turn = np.linalg.qr(random.standard_normal((WIDTH, WIDTH)))[0]
    along = sum(share * np.outer(t, t) for share, t in zip(shares, turn))
    return {("loop", "drift"): along, ("loop", "main"): np.eye(WIDTH) - along}


def scores(grams, random, draws=DRAWS):
    """Of noise alone, in units of what was taken for it: each part is larger than that by as much as its estimate was too small."""
    found = np.zeros((draws, WIDTH))
    for c, gram in grams.items():
        values, vectors = np.linalg.eigh(gram)
        root = vectors * np.sqrt(np.maximum(values, 0.0))
        found += np.sqrt(DOF[c] / random.chisquare(DOF[c], draws))[:, None] * (random.standard_normal((draws, WIDTH)) @ root.T)
    return found


def test_of_well_known_noise_it_is_the_f_test():
    grams = {("loop", "main"): 0.7 * np.eye(WIDTH), ("loop", "offset"): 0.3 * np.eye(WIDTH)}
    score = np.array([1.0, 2.0, -2.0, 0.5, 3.0])
    statistic, p = chance(SPACE, score, grams, {("loop", "main"): 1.5})
    assert statistic == pytest.approx(18.25 / (0.7 * 1.5 + 0.3))
    shares = {("loop", "main"): 0.7, ("loop", "offset"): 0.3}
    assert p == pytest.approx(fdtrc(WIDTH, effective_dof(SPACE, shares), statistic / WIDTH))


@pytest.mark.parametrize("drift", [(0.0,), (0.03,), (0.3,), (0.9,), (0.99, 0.5)], ids=str)
def test_noise_alone_is_significant_as_often_as_it_is_said_to_be(drift):
    """With Satterthwaite's degrees of freedom of all five directions it is so at 0.1 % in 0.3 to 4 % of cases here."""
    random = np.random.default_rng([7, int(1000 * drift[0])])
    grams = grams_of(drift, random)
    p = np.array([chance(SPACE, s, grams, {})[1] for s in scores(grams, random)])
    for level in (0.3, 0.1, 0.01, 0.001):
        assert np.mean(p < level) == pytest.approx(level, abs=4.0 * np.sqrt(level / DRAWS)), level


def test_a_trace_of_poorly_known_noise_takes_nothing_from_what_is_beyond_doubt():
    grams = {("loop", "drift"): 1e-5 * np.eye(2), ("loop", "main"): (1.0 - 1e-5) * np.eye(2)}
    assert chance(SPACE, np.array([20.0, 14.0]), grams, {})[1] == pytest.approx(fdtrc(2, 100.0, 298.0), rel=0.01)


def test_what_is_off_along_a_well_known_direction_is_seen_beside_a_poorly_known_one():
    random = np.random.default_rng(8)
    grams = grams_of((0.9,), random)
    vectors = np.linalg.eigh(grams[("loop", "drift")])[1]
    assert chance(SPACE, 6.0 * vectors[:, 0], grams, {})[1] < 1e-4
    assert chance(SPACE, 6.0 * vectors[:, -1], grams, {})[1] > 0.05


def test_what_noise_does_not_make_is_well_known():
    """A number with a prior adds to the variance, and no degrees of freedom are missing of it."""
    score = np.array([4.0, 1.0])
    noise = {("loop", "drift"): np.diag([0.2, 0.0])}
    alike = {**noise, ("loop", "main"): np.diag([0.8, 1.0])}
    _, p = chance(SPACE, score, noise, {})
    assert p == pytest.approx(chance(SPACE, score, alike, {})[1], rel=0.2)
    assert chance(SPACE, 3.0 * score, {}, {})[1] == pytest.approx(chdtrc(2, 153.0))
