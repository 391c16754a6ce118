"""Runs at nodes: samples follow from them as exactly as the noise can tell, in a small part of the time."""

from types import SimpleNamespace

import numpy as np
import pytest

from discrepancy.model_file import load_model
from discrepancy.prediction.bench import Bench
from discrepancy.prediction.curves import signal
from discrepancy.prediction.fineness import SEEN, Fineness, fast_noise, hidden
from discrepancy.prediction.observe import hysteresis, transmission_error
from discrepancy.prediction.over_angle import OverAngle
from discrepancy.prediction.over_torque import OverTorque, loop_change
from discrepancy.prediction.support import BANDS, COMB, PER_TURN, AngleNodes, angle_nodes, banded_nodes, reversals, torque_nodes
from discrepancy.problem import Record

TURN = 2.0 * np.pi
SAMPLES, NOISE = 4000, 4e-6
RATED = {"speed": 2000 * TURN / 60, "load": 167.0, "temperature": 293.15, "hours": 0.0, "direction": 1.0}
HIDDEN = {"pin_ring_runout": 2e-6}


def over_angle(direction: int = 1) -> Record:
    angle = np.linspace(0.0, TURN, SAMPLES, endpoint=False)[::direction]
    noise = np.random.default_rng(1).normal(0.0, NOISE, SAMPLES)
    return Record("te", "transmission_error", "rad", "rated", 1, noise, {"angle": angle}, RATED | {"direction": direction})


def way(samples: int, noise: float = 0.0) -> np.ndarray:
    quarter = np.linspace(0.0, 1.0, samples // 4, endpoint=False)
    torque = 167.0 * np.concatenate([quarter, 1.0 - quarter, -quarter, quarter - 1.0])
    return torque + np.random.default_rng(2).normal(0.0, noise, len(torque))


def over_torque(noise: float = 0.0) -> Record:
    torque = way(1200, noise)[np.abs(way(1200)) > 3.0]
    values = np.random.default_rng(3).normal(0.0, 1e-5, len(torque))
    return Record("loop", "hysteresis", "rad", "rated", 1, values, {"torque": torque}, RATED, tags={"locked": "input"})


@pytest.fixture(scope="module")
def benches():
    """Of a campaign that is computed at nodes, and at every sample."""
    reducer = load_model("RV20E-121-rigid").reducer
    at_nodes, directly = Bench(reducer, {}), Bench(reducer, {})
    at_nodes.fineness = Fineness([over_angle(), over_torque()])
    return at_nodes, directly


@pytest.mark.parametrize("direction", [1, -1])
def test_transmission_error_at_nodes_is_that_at_every_sample(benches, direction):
    record = over_angle(direction)
    at_nodes, directly = (transmission_error(bench, record, HIDDEN) for bench in benches)
    assert np.std(directly) > 1e-6
    chi2 = np.sum((at_nodes - directly) ** 2) / NOISE**2
    # The base model and the change may each add as much; noise adds 4000.
    assert chi2 < 2.0 * (2.0 * SEEN) ** 2


def test_it_takes_far_fewer_equilibria(benches):
    nodes = OverAngle(benches[0], over_angle(), "transmission_error").nodes(benches[0].fineness.base["transmission_error", "rated"])
    assert nodes is not None and len(nodes.angles) < 0.5 * SAMPLES


@pytest.mark.parametrize("noise", [0.0, 0.3])
def test_a_loop_at_nodes_is_that_at_every_sample(benches, noise):
    """Noise of the torque sensor makes no reversals."""
    record = over_torque(noise)
    smooth = over_torque()
    at_nodes = hysteresis(benches[0], record, {"needle_clearance_added": 1e-6})
    directly = hysteresis(benches[1], smooth, {"needle_clearance_added": 1e-6})
    stiffness = 167.0 / np.abs(directly).max()
    assert np.sqrt(np.mean((at_nodes - directly) ** 2)) < 2e-7 + 2.0 * noise / stiffness
    assert len(torque_nodes(record.axes["torque"], 1.5, 0).torques) < 80


def test_a_loops_change_to_first_order_is_that_of_whole_runs(benches):
    record, step = over_torque(), {"needle_clearance_added": 1e-9}
    whole = signal(OverTorque(benches[1], record), step) - signal(OverTorque(benches[1], record), {})
    for bench in benches:
        first = loop_change(bench, record, step, {})
        # Where the sign of the torque has just changed, contacts open and close within the step.
        assert np.quantile(np.abs(first - whole), 0.99) < 0.02 * np.abs(whole).max()


def test_reversals_of_a_noisy_torque_are_those_of_the_torque():
    assert list(reversals(way(400))) == [0, 100, 300, 399]
    found = reversals(way(400, 0.5))
    assert len(found) == 4 and np.abs(found - [0, 100, 300, 399]).max() < 8


def test_an_order_between_the_nodes_is_noticed():
    """On equally spaced nodes an order of 1520 looks smooth at 727 of them."""
    for level in range(3):
        nodes = angle_nodes(np.linspace(0.0, TURN, 9000), 1, level)
        assert nodes.error(1e-6 * np.sin(1520 * nodes.angles)) > 2e-7
        assert nodes.error(1e-6 * np.sin(40 * nodes.angles)) < 2e-9


def test_a_wave_faster_than_the_nodes_is_no_jump():
    """Teeth of a first stage, order 1,440, are an order 7 on 1,447 nodes, and their error is the same at all coarser levels."""
    fineness, record = Fineness([]), SimpleNamespace(quantity="transmission_error", condition="c")
    fineness.allowed = {("transmission_error", "c"): 1e-15}

    def level_of(change):
        def errs(level):
            nodes = angle_nodes(np.linspace(0.0, TURN, 90000), 1, max(level, 0))
            at = 1e-6 * change(nodes.angles)
            return nodes.error(at), float(np.std(at))

        return max(fineness.roughly().level_of_slopes(record, {"a": 1.0}, errs), 0)

    # 4,099 nodes of a turn show it; a jump, which no level shows better, needs no more than few.
    assert PER_TURN[level_of(lambda angles: np.sin(1440 * angles))] >= 4099
    assert PER_TURN[level_of(lambda angles: np.sign(np.sin(3 * angles)))] < 1500


def test_what_is_added_by_interpolation_is_no_more_than_is_allowed():
    """A relieved profile beside 1,447 nodes: orders 1,400 to 1,720, of pins and lobes together, had added 90 of chi-square where 13 were allowed, and
    nodes beside each other told of as little."""
    bench, noise, profile = Bench(load_model("RV20E-121").reducer, {}), 2.4e-6, {"equidistant_added": -8e-6, "shift_added": -12e-6}
    angle = np.linspace(0.0, TURN, 9000, endpoint=False)
    record = Record("te", "transmission_error", "rad", "rated", 1, np.random.default_rng(1).normal(0.0, noise, 9000), {"angle": angle}, RATED)
    directly = transmission_error(bench, record, profile)
    bench.fineness = Fineness([record])
    off = transmission_error(bench, record, profile) - directly
    # The base model and the change may each add as much.
    assert np.sum((off - off.mean()) ** 2) / noise**2 < 2.5 * hidden(9000)


def test_error_that_is_foretold_is_that_which_is_made():
    angles = np.linspace(0.0, TURN, 9000)
    kinked = lambda x: 1e-5 * np.abs(np.sin(20.0 * x))
    for level in range(6):
        nodes = angle_nodes(angles, 1, level)
        made = np.sqrt(np.mean((nodes.samples(kinked(nodes.angles), angles) - kinked(angles)) ** 2))
        assert 0.4 * made < nodes.error(kinked(nodes.angles)) < 3.0 * made


def test_noise_that_jumps_is_measured_beside_what_is_smooth():
    x = np.linspace(0.0, TURN, 3000)
    noise = np.random.default_rng(5).normal(0.0, 1e-6, len(x))
    assert fast_noise(1e-5 * np.sin(80 * x) + noise) == pytest.approx(1e-6, rel=0.1)
    # A coarse converter's steps count as noise of their width over the root of twelve; thirty samples on one step say what one says.
    assert fast_noise(np.round(np.linspace(0.0, 1.0, 3000), 2)) == pytest.approx(0.01 / np.sqrt(12.0) * np.sqrt(30.0), rel=0.02)


def test_samples_without_noise_are_each_computed(benches):
    record = Record(**{**over_angle().__dict__, "values": np.zeros(SAMPLES)})
    bench = Bench(benches[0].reducer, {})
    bench.fineness = Fineness([record])
    assert transmission_error(bench, record, {}) == pytest.approx(transmission_error(benches[1], record, {}), abs=1e-15)


def test_few_samples_are_each_computed():
    assert angle_nodes(np.linspace(0.0, TURN, 360), 1, 0) is None
    assert isinstance(angle_nodes(np.linspace(0.0, TURN, 1000), 1, 0), AngleNodes)
    assert torque_nodes(way(40), 1.5, 0) is None


def test_curves_know_where_their_samples_lie(benches):
    record = over_angle()
    curve = OverAngle(benches[0], record, "transmission_error")
    assert curve.places({"angle_zero[1]": 0.01}) == pytest.approx(record.axes["angle"] + 0.01)


@pytest.mark.parametrize("level", BANDS)
@pytest.mark.parametrize("direction", [1, -1])
def test_few_nodes_suffice_for_the_orders_that_a_drive_shows(level: int, direction: int) -> None:
    nodes = banded_nodes(39, 40, level, direction)
    assert len(nodes.angles) < (900 if level == COMB else PER_TURN[0] / 2)

    def signal(angles: np.ndarray) -> np.ndarray:
        return 1.0 + np.cos(angles - 0.3) + 0.5 * np.sin(40 * angles) + 0.2 * np.cos(79 * angles + 1.0) - 0.1 * np.sin(156 * angles)

    places = np.linspace(0.1, 0.1 + 1.5 * TURN, 777)
    assert nodes.samples(signal(nodes.angles), places) == pytest.approx(signal(places), abs=2e-3)
    assert nodes.error(signal(nodes.angles)) < 1e-9

    # Teeth come into contact as often as pins and lobes meet.
    fast = np.cos(1640 * places - 0.2)
    assert (nodes.samples(np.cos(1640 * nodes.angles - 0.2), places) == pytest.approx(fast, abs=2e-3)) == (level == COMB)

    # An order that lies between the bands is seen as an error.
    other = np.sin(58 * nodes.angles)
    assert nodes.error(other) > 0.5


def test_no_search_looks_at_more_nodes_than_a_report(benches):
    bench, record = benches[0].rougher, over_angle()
    found, whole = (transmission_error(b, record, {"disc_runout": 3e-6}) - transmission_error(b, record, {}) for b in (bench, benches[1]))
    assert np.std(found - whole) < 0.1 * np.std(whole)
    assert min(bench.fineness.added[key][0][1] for key in bench.fineness.added) < 0
