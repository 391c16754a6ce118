"""Records of very many samples: answered as those of few, in a small part of the time that their samples would take."""

import numpy as np
import pytest
from nothing import Nothing

from discrepancy.inference.base_fit.workspace import Workspace
from discrepancy.inference.misfit import localise
from discrepancy.inference.misfit.features import features, samples_of_a_wave
from discrepancy.inference.misfit.localise import Localiser, step_of, stepped
from discrepancy.model_file import load_model
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.cages import Cages, likeliest, resultant, weights
from discrepancy.prediction.conditions import distinct_conditions, row_conditions
from discrepancy.prediction.curves import level_of, signal
from discrepancy.prediction.fewer import ENOUGH, fewer
from discrepancy.prediction.fineness import EVERY_SAMPLE, SOLVED, Fineness
from discrepancy.prediction.observe import ripples_of_cages
from discrepancy.prediction.over_angle import OverAngle
from discrepancy.problem import Record
from fmu_src.threads import Threads

TURN = 2.0 * np.pi
ORDERS = {"output shaft": (1.0, 2.0), "ring pins": (78.0,)}
RATED = {"speed": 2000 * TURN / 60, "load": 167.0, "temperature": 293.15, "hours": 0.0, "direction": 1.0}


def curve(samples: int, noise: float = 1e-6, replicate: int = 1, turns: float = 1.0) -> Record:
    angle = np.linspace(0.0, turns * TURN, samples, endpoint=False)
    values = 3e-6 * np.cos(78 * angle) + np.random.default_rng(replicate).normal(0.0, noise, samples)
    return Record(f"te{replicate}", "transmission_error", "rad", "a", replicate, values, {"angle": angle}, RATED)


def test_means_of_neighbours_are_the_record_with_fewer_samples():
    record = curve(4 * ENOUGH)
    few = fewer(record, 1.0)
    assert len(few.values) == ENOUGH and few.axes["angle"][0] == pytest.approx(np.mean(record.axes["angle"][:4]))
    assert np.std(few.values - 3e-6 * np.cos(78 * few.axes["angle"])) == pytest.approx(0.5e-6, rel=0.05)
    assert fewer(curve(2000), 1.0) is not None and len(fewer(curve(2000), 1.0).values) == 2000
    # Neighbours across the end of a turn have nothing in common.
    again = Record(**{**record.__dict__, "axes": {"angle": record.axes["angle"] * 2.0 % TURN}})
    assert fewer(again, 1.0) is again


def test_a_record_of_many_equal_rows_has_one_condition():
    bench, record = Bench(load_model("RV20E-121-rigid").reducer, {}), curve(30_000)
    assert distinct_conditions(bench, record) == [row_conditions(bench, record)[0]]
    ramp = Record(**{**record.__dict__, "axes": {"speed": np.repeat([100.0, 200.0, 100.0], 10_000)}})
    assert [c.speed for c in distinct_conditions(bench, ramp)] == [100.0, 200.0]


def test_no_more_equilibria_are_solved_than_the_solver_can_tell_apart():
    """Half a million samples without noise, and with the cages' kinks: at nodes, and the same to a hundred thousandth of an arc second."""
    bench, record = Bench(load_model("RV20E-121-rigid").reducer, {}), curve(100_000, noise=0.0, turns=0.2)
    bench.fineness = Fineness([record])
    assert bench.fineness.allowed["transmission_error", "a"] == SOLVED
    over = OverAngle(bench, record, "transmission_error")
    level = level_of(over, {})
    assert level < EVERY_SAMPLE and len(over.nodes(level).angles) < 0.6 * len(record.values)
    some = slice(0, 20_000)
    part = Record(**{**record.__dict__, "values": record.values[some], "axes": {"angle": record.axes["angle"][some]}})
    directly = signal(OverAngle(Bench(load_model("RV20E-121-rigid").reducer, {}), part, "transmission_error"), {})
    assert np.sqrt(np.mean((signal(over, {})[some] - directly) ** 2)) < 2.0 * SOLVED


def test_functions_of_steps_find_what_whole_functions_find(monkeypatch):
    space = Workspace(Nothing([curve(8_000, replicate=k) for k in (1, 2)]))
    space.fit_base()
    whole = Localiser(space, ORDERS).test(space.base)
    monkeypatch.setattr(localise, "MANY", 2_000)
    assert step_of(space.records[0], ORDERS) == 4
    few = Localiser(space, ORDERS)
    assert len(few.cells[0][0]) == 2_000
    found = few.test(space.base)
    assert [g.feature for g in found.findings] == [g.feature for g in whole.findings] == ["orders: ring pins"]
    assert found.findings[0].statistic == pytest.approx(whole.findings[0].statistic, rel=0.02)


def test_steps_keep_products():
    rows, other = np.random.default_rng(1).normal(size=(2, 103, 3))
    smooth = np.repeat(rows[::10][:11], 10, axis=0)[:103]
    assert np.allclose(stepped(smooth, 10).T @ stepped(other, 10), smooth.T @ other)
    assert stepped(rows, 1) is rows


def test_the_shortest_wave_is_that_of_the_functions():
    record = curve(8_000)
    assert samples_of_a_wave(record, ORDERS) == pytest.approx(8_000 / 78)
    # Each order of the comb is a cosine and a sine, however it was made.
    comb = {f.name: f.columns for f in features(record, ORDERS)}
    assert np.allclose(comb["order 37"], np.column_stack([np.cos(37 * record.axes["angle"]), np.sin(37 * record.axes["angle"])]), atol=1e-12)


def test_the_place_of_the_cages_counts_every_sample_that_a_mean_stands_for():
    random = np.random.default_rng(3)
    phase = 20.0 * np.linspace(0.0, TURN, 40_000, endpoint=False)
    basis = np.column_stack([np.cos(phase), np.sin(phase)])
    misfit = 0.02 * np.cos(phase - 1.0) + random.normal(0.0, 1.0, len(phase))
    means = lambda values: values.reshape(-1, 10, *values.shape[1:]).mean(axis=1)
    share, sure = resultant(basis, misfit)
    assert resultant(means(basis), means(misfit)) == pytest.approx((share, sure), abs=0.02)


def test_the_cages_ripple_is_computed_at_nodes_too(monkeypatch):
    bench, record = Bench(load_model("RV20E-121-rigid").reducer, {}), curve(60_000, noise=1.5e-6)
    bench.fineness = Fineness([record])
    lengths = []
    running = Bench.running_places
    monkeypatch.setattr(Bench, "running_places", lambda self, c, v, angles, *a, **more: lengths.append(len(angles)) or running(self, c, v, angles, *a, **more))
    [ripple] = ripples_of_cages(bench, record, {}, [0.3])
    assert np.std(ripple) > 1e-8 and max(lengths) < 20_000


def test_the_place_of_the_cages_is_seen_through_slow_noise():
    """Noise of an encoder is slow: a ripple of a twentieth of it is plain to see where the noise is not."""
    random = np.random.default_rng(5)
    phase = 140.0 * np.linspace(0.0, TURN, 500, endpoint=False)
    basis = np.column_stack([np.cos(phase), np.sin(phase)])
    slow = np.convolve(random.normal(0.0, 1.0, 540), np.hanning(41), "valid")[:500]
    ripple = 0.05 * float(np.std(slow)) * np.cos(phase - 2.0)
    share, sure = resultant(basis, slow + ripple + 0.005 * random.normal(0.0, 1.0, 500))
    assert share * TURN == pytest.approx(2.0, abs=0.1) and sure > 0.98


def test_the_likeliest_place_is_found_by_the_ripple_at_others():
    random = np.random.default_rng(6)
    phase = 140.0 * np.linspace(0.0, TURN, 500, endpoint=False)
    # No sine: a kink in every wave.
    kinked = lambda share: np.abs(np.sin(0.5 * (phase - TURN * share)))
    misfit = kinked(0.337) + 0.05 * random.normal(0.0, 1.0, 500)
    ripples = np.array([kinked(s) for s in np.arange(8) / 8])
    assert likeliest(ripples, misfit, 0.3) == pytest.approx(0.337, abs=0.01)


def test_a_series_through_equal_places_has_the_harmonics_that_they_can_have():
    shares, places = np.linspace(-0.7, 1.3, 41), np.arange(8) / 8
    for h in range(4):
        for wave in (np.cos, np.sin):
            assert weights(shares, 8) @ wave(h * TURN * places) == pytest.approx(wave(h * TURN * shares), abs=1e-12)
    assert weights(places, 8) == pytest.approx(np.eye(8), abs=1e-12)


def test_the_ripple_is_computed_at_so_many_places_that_nobody_sees_what_is_missed():
    """Two runs of one condition share them: the second costs nothing."""
    bench, record = Bench(load_model("RV20E-121-rigid").reducer, {}), curve(400, noise=2e-7)
    bench.fineness = Fineness([record])
    cages = Cages(bench, [record], lambda r, values: dict(values), Threads())
    shares = np.array([0.1, 0.37, 0.81])
    exact = np.array(ripples_of_cages(bench, record, {}, shares, True))
    few = np.array([np.zeros(400), *ripples_of_cages(bench, record, {}, (0.25, 0.5, 0.75), True)])
    closer = cages.closer(record, {}, few)
    error = lambda ripples: float(np.sqrt(np.mean((weights(shares, len(ripples)) @ ripples - exact) ** 2)))
    assert 4 < len(closer) <= 16 and error(closer) < 0.6 * error(few)
    assert len(closer) == 16 or error(closer) < bench.allowed(record)
