"""d' between two rivals, everything else projected out, where it can be reckoned by hand."""

from types import SimpleNamespace

import numpy as np
import pytest
from scipy.stats import norm

from discrepancy.inference.screening.screen import Block, Columns
from discrepancy.inference.separable import best_error, separations
from discrepancy.problem import Candidate, Parameter

ANGLE = 0.4


def candidate(name: str, sign: int = 0, bound: float = 1e6) -> Candidate:
    return Candidate(name, name, (Parameter(name, "1", 0.0, -bound, bound, 1.0, sign),))


def judged(columns: list[np.ndarray], signs: list[int], shapes: list[dict] | None = None, owners: list[int] | None = None, nuisances=None, names="abc"):
    """Separations of effects with one column a block, by (hidden, rival)."""
    owners = owners or list(range(len(columns)))
    jacobian = np.zeros((len(columns[0]), 0)) if nuisances is None else np.column_stack(nuisances)
    space = SimpleNamespace(base=SimpleNamespace(jacobian=jacobian, normal=jacobian.T @ jacobian))
    blocks = tuple(Block(owner, shape, slice(k, k + 1), (sign,)) for k, (owner, shape, sign) in enumerate(zip(owners, shapes or [{}] * len(columns), signs)))
    candidates = [candidate(name) for name in list(names)[: max(owners) + 1]]
    return {(p.hidden, p.rival): p for p in separations(space, candidates, Columns(np.column_stack(columns), blocks), 10.0)}


def at(angle: float, size: float = 1.0, length: int = 5) -> np.ndarray:
    found = np.zeros(length)
    found[:2] = size * np.cos(angle), size * np.sin(angle)
    return found


def test_two_columns_with_an_angle_between_are_apart_by_its_sine():
    found = judged([at(0.0, 3.0), at(ANGLE, 0.01)], [0, 0])
    for pair in (("a", "b"), ("b", "a")):
        assert found[pair].least == pytest.approx(10.0 * np.sin(ANGLE))
        assert found[pair].typical == pytest.approx(10.0 * np.sin(ANGLE))


def test_an_effect_of_one_sign_imitates_nothing_on_the_other_side():
    found = judged([at(0.0), at(np.pi - ANGLE)], [1, 1])
    assert found["a", "b"].least == pytest.approx(10.0)
    found = judged([at(0.0), at(np.pi - ANGLE)], [1, 0])
    assert found["a", "b"].least == pytest.approx(10.0 * np.sin(ANGLE))
    # What is hidden can have either sign: the nearer one counts.
    assert found["b", "a"].least == pytest.approx(10.0 * np.sin(ANGLE))


def test_negative_amplitudes_act_on_their_side():
    assert judged([-at(0.0), at(ANGLE)], [-1, 1])["a", "b"].least == pytest.approx(10.0 * np.sin(ANGLE))


def test_what_may_be_calibrated_is_projected_out():
    """Rivals that differ only by what a nuisance shows cannot be told apart."""
    other = np.array([0.0, 0.0, 1.0, 0.0, 0.0])
    found = judged([at(0.0), at(0.0) + 5.0 * other], [0, 0], nuisances=[other])
    assert found["a", "b"].least == pytest.approx(0.0, abs=1e-6)
    assert judged([at(0.0), at(0.0) + 5.0 * other], [0, 0])["a", "b"].least == pytest.approx(10.0 * 5.0 / np.sqrt(26.0))


def test_an_effect_that_calibration_swallows_is_in_no_pair():
    other = np.array([0.0, 0.0, 1.0, 0.0, 0.0])
    assert set(judged([at(0.0), at(ANGLE), other], [0, 0, 0], nuisances=[other])) == {("a", "b"), ("b", "a")}


def test_shapes_imitate_on_the_grid_and_between():
    shapes = [{"s": 1.0}, {"s": 2.0}, {}]
    between = at(0.0) + at(0.5)
    found = judged([at(0.0), at(0.5), between], [1, 1, 1], shapes, owners=[0, 0, 1])
    assert found["b", "a"].least == pytest.approx(0.0, abs=1e-6)
    # The other way round the stiff one is a quarter of a radian from either end.
    assert found["a", "b"].typical == pytest.approx(10.0 * np.sin(0.25))


def test_least_and_typical_are_over_what_may_be_hidden():
    found = judged([at(0.0), at(0.8), at(0.1)], [1, 1, 1], [{"s": 1.0}, {"s": 2.0}, {}], owners=[0, 0, 1])
    pair = found["a", "b"]
    assert pair.least == pytest.approx(10.0 * np.sin(0.1))
    assert pair.typical == pytest.approx(5.0 * (np.sin(0.1) + np.sin(0.7)))


def test_variants_of_an_effect_are_one():
    found = judged([at(0.0), at(0.3), at(0.3)], [0, 0, 0], names=["pins.radial", "pins.oval", "ring"])
    assert set(found) == {("pins", "ring"), ("ring", "pins")}
    assert found["ring", "pins"].least == pytest.approx(0.0, abs=1e-6)


def test_no_test_is_better_than_the_one_between_two_points():
    """Errors of the likelihood ratio of two known means, counted."""
    rng = np.random.default_rng(1)
    d = 3.0
    noise = rng.standard_normal(100_000)
    assert best_error(d) == pytest.approx(np.mean(noise > 0.5 * d), abs=2e-3)
    assert best_error(d) == pytest.approx(norm.sf(1.5))
    assert best_error(0.0) == 0.5
