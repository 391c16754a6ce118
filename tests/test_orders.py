"""Orders of transmission errors: from curves and tables to a campaign's records."""

import math

import numpy as np
import pytest

from discrepancy.campaign.check import check_campaign
from discrepancy.campaign.load import load_campaign
from discrepancy.campaign.order_analysis import even_curve, leakage, measured_orders
from discrepancy.campaign.planned import with_planned
from discrepancy.campaign.template import write_template
from fmu_src.faults import InputFault

ARCSEC = math.pi / 648000.0
WAVES = {1: (61.9, 0.3), 39: (2.7, -1.6), 78: (1.2, 2.9), 240: (0.8, -2.4)}
CAMPAIGN = """
[campaign]
name = "rig"
reducer = "RV20E-121-rigid"
[conditions.a]
output_speed = "15 rpm"
load_torque = "100 N.m"
direction = "{direction}"
[layouts.t]
quantity = "transmission_order"
condition = "a"
noise = "0.1 arcsec"
[[runs]]
id = "r"
layout = "t"
{run}
"""
TABLE = """
table.order = { values = [0, 1, 39, 78], unit = "1" }
table.value = { values = [-20, 61.9, 2.7, 1.2], unit = "arcsec" }
table.phase = { values = [0, 0.3, -1.6, 2.9], unit = "rad" }
"""


def error(angle):
    """[arcsec]"""
    return 20.0 + sum(a * np.cos(k * angle + p) for k, (a, p) in WAVES.items())


def trembling(turns, per_turn, rng, start=1.234):
    """Angles [rad] of an encoder read at uneven times."""
    even = start + 2.0 * np.pi * np.arange(round(turns * per_turn)) / per_turn
    return even + rng.uniform(-0.3, 0.3, len(even)) * 2.0 * np.pi / per_turn


@pytest.fixture
def record(tmp_path):
    def load(run, direction="forward", head=CAMPAIGN):
        (tmp_path / "campaign.toml").write_text(head.format(run=run, direction=direction))
        return load_campaign(tmp_path).records[0]

    return load


def complex_of(record):
    """A_k by order."""
    parts = list(zip(record.axes["order"], record.axes["part"], record.values))
    return {k: complex(sum(v for o, p, v in parts if o == k and p == 0.0), sum(v for o, p, v in parts if o == k and p == 1.0)) for k in record.axes["order"]}


@pytest.mark.parametrize("window", ["none", "hann"])
@pytest.mark.parametrize("sense", [1.0, -1.0])
def test_orders_of_a_curve_over_uneven_angles_and_more_than_whole_turns(window, sense):
    """To 0.1 % of each wave, though the record ends in the midst of a turn and the encoder steps unevenly."""
    angle = trembling(2.63, 4000, np.random.default_rng(1))[:: int(sense)]
    found, _ = measured_orders(angle, error(angle), [0, *WAVES], window, None, "x")
    assert found[0].real == pytest.approx(20.0, abs=1e-3)
    for (a, p), amplitude in zip(WAVES.values(), found[1:]):
        assert abs(amplitude - a * np.exp(1j * p)) < 1e-3 * a + 1e-4


def test_whole_orders_do_not_leak_into_each_other():
    angle = 2.0 * np.pi * np.arange(12000) / 4000
    quiet, _ = measured_orders(angle, error(angle), [2, 38, 40, 77, 79, 239], "none", None, "x")
    assert np.abs(quiet).max() < 1e-5


def test_fewer_steps_fold_nothing():
    """Order 239 at 200 steps a turn would show as 39."""
    angle = 2.0 * np.pi * np.arange(4000) / 4000
    curve = even_curve(angle, 5.0 * np.cos(239 * angle) + np.cos(39 * angle), 200, "x")
    assert curve.values == pytest.approx(np.cos(39 * curve.angle), abs=1e-3)


@pytest.mark.parametrize("window", ["none", "hann"])
def test_a_drift_leaks_as_the_formula_says(window):
    """A ramp of 3 arcsec from end to end of three turns: 3/(pi k N), under Hann's window 3/(pi m (m^2 - 1))."""
    angle = 2.0 * np.pi * np.arange(12000) / 4000
    orders = [1.0, 2.0, 39.0]
    ramp = 3.0 * angle / (6.0 * np.pi)
    found, _ = measured_orders(angle, ramp, orders, window, None, "x")
    line = 3.0 * np.array(orders)
    expected = 3.0 / (np.pi * line * (line**2 - 1.0 if window == "hann" else 1.0))
    assert np.abs(found) == pytest.approx(expected, rel=2e-3, abs=1e-9)
    assert leakage(even_curve(angle, ramp, None, "x"), orders, window) == pytest.approx(expected, rel=2e-3)


def test_counts_of_an_encoder_are_fine_enough():
    """An output encoder of 2^16 counts (20 arcsec) at 4000 uneven samples a turn: below 1 arcsec at each order."""
    angle = trembling(3.01, 4000, np.random.default_rng(2))
    count = 2.0 * np.pi / 2**16
    counted = np.round((angle + error(angle) * ARCSEC) / count) * count
    found, _ = measured_orders(angle, (counted - angle) / ARCSEC, list(WAVES), "hann", None, "x")
    for (a, p), amplitude in zip(WAVES.values(), found):
        assert abs(amplitude - a * np.exp(1j * p)) < 1.0


@pytest.mark.parametrize(
    "turns, per_turn, orders, window, says",
    [
        (0.9, 4000, [1], "none", "spans 323.9 deg in one sense: orders need at least one whole turn"),
        (1.2, 4000, [1], "hann", "needs two turns"),
        (1.2, 400, [78], "none", "needs 468 samples per turn"),
        (1.2, 4000, [1.5], "none", "1.5 waves in 1 turn"),
    ],
)
def test_what_a_curve_cannot_show_is_refused(turns, per_turn, orders, window, says):
    angle = 2.0 * np.pi * np.arange(round(turns * per_turn)) / per_turn
    with pytest.raises(InputFault, match=says):
        measured_orders(angle, error(angle), orders, window, None, "x")


def test_a_gap_is_refused():
    angle = np.delete(2.0 * np.pi * np.arange(4000) / 4000, slice(1000, 1050))
    with pytest.raises(InputFault, match=r"after 89\.\d+ deg the angle leaps by 4\.\d+ deg, 51 times"):
        measured_orders(angle, error(angle), [1], "none", None, "x")


def test_numbers_stand_by_order_with_what_their_row_states(record):
    """Real part before imaginary part, whatever the order of the rows; a condition's column goes with them."""
    rows = TABLE.replace("[0, 1, 39, 78]", "[0, 78, 1, 39]") + 'table.temperature = { values = [20, 21, 22, 23], unit = "degC" }\nzero = "absolute"'
    found = record(rows)
    assert list(found.axes["order"]) == [0, 1, 1, 39, 39, 78, 78]
    assert list(found.axes["part"]) == [0, 0, 1, 0, 1, 0, 1]
    assert found.axes["temperature"] - 273.15 == pytest.approx([20, 22, 22, 23, 23, 21, 21])


def test_a_table_is_two_numbers_an_order(record):
    """Without the mean as long as the zero is free."""
    found = complex_of(record(TABLE))
    assert list(found) == [1, 39, 78]
    for k, a in found.items():
        assert a == pytest.approx(WAVES[k][0] * ARCSEC * np.exp(1j * WAVES[k][1]))
    with_mean = complex_of(record(TABLE + 'zero = "absolute"'))
    assert with_mean[0] == pytest.approx(-20.0 * ARCSEC)
    assert record(TABLE).stated_noise == pytest.approx(0.1 * ARCSEC)


@pytest.mark.parametrize(
    "convention, direction, wave",
    [
        ('wave = "sine"', "forward", lambda x, a, p: a * np.sin(39 * x + p)),
        ('wave = "sine", phase = "minus"', "forward", lambda x, a, p: a * np.sin(39 * x - p)),
        ('phase = "minus"', "reverse", lambda x, a, p: a * np.cos(39 * x - p)),
        ('angle = "backward", wave = "sine"', "forward", lambda x, a, p: a * np.sin(-39 * x + p)),
        ('angle = "motion"', "reverse", lambda x, a, p: a * np.cos(-39 * x + p)),
        ('angle = "motion"', "forward", lambda x, a, p: a * np.cos(39 * x + p)),
        ('minus = "output"', "forward", lambda x, a, p: -a * np.cos(39 * x + p)),
    ],
)
def test_conventions(record, convention, direction, wave):
    """Each turns the numbers into the wave that it says."""
    found = complex_of(record(TABLE + f"convention = {{ {convention} }}", direction))[39.0]
    x = np.linspace(0.0, 1.0, 50)
    a, p = WAVES[39]
    assert np.real(found * np.exp(39j * x)) == pytest.approx(wave(x, a, p) * ARCSEC)


def write_encoders(path, direction=1.0):
    """Counts of both encoders and time; the output's with 2^20 a turn, the input's with 4096; ratio 121."""
    angle = direction * trembling(2.4, 3000, np.random.default_rng(3))
    output = np.round((angle + error(angle) * ARCSEC) / (2.0 * np.pi) * 2**20)
    given = np.round(angle * 121.0 / (2.0 * np.pi) * 4096)
    rows = "\n".join(f"{t * 1e-3:.4f},{o:.0f},{i:.0f}" for t, (o, i) in enumerate(zip(output, given)))
    path.write_text(f"t,out,in\n{rows}\n")


ENCODERS = """
file = "enc.csv"
columns.time = { column = "t", unit = "s" }
columns.angle = { column = "out", unit = "turn", scale = 9.5367431640625e-7 }
columns.input_angle = { column = "in", unit = "turn", scale = 2.44140625e-4 }
"""


@pytest.mark.parametrize("direction, sense", [("forward", 1.0), ("reverse", -1.0)])
def test_counts_of_both_encoders_become_orders(tmp_path, record, direction, sense):
    write_encoders(tmp_path / "enc.csv", sense)
    found = complex_of(record(ENCODERS + "orders = [1, 39, 78]", direction))
    for k, a in found.items():
        assert abs(a - WAVES[k][0] * ARCSEC * np.exp(1j * WAVES[k][1])) < 0.06 * ARCSEC, k


def test_counts_of_both_encoders_become_an_even_curve(tmp_path, record):
    """By the same code: 1000 steps a turn, two whole turns of 2.4."""
    write_encoders(tmp_path / "enc.csv")
    found = record(ENCODERS + "per_turn = 1000", head=CAMPAIGN.replace("transmission_order", "transmission_error"))
    angle = found.axes["angle"]
    assert len(angle) == 2000 and np.diff(angle) == pytest.approx(2.0 * np.pi / 1000)
    # Half a count of either encoder: 0.6 and 1.3 arcsec.
    assert np.abs(found.values - error(angle) * ARCSEC).max() < 1.9 * ARCSEC


@pytest.mark.parametrize(
    "run, says",
    [
        (TABLE + "orders = [1]", r"runs\[1\] \(r\).orders is for runs of transmission_order with the columns of a curve"),
        (TABLE + "per_turn = 100", r"per_turn is for curves"),
        (ENCODERS, r"says no orders of the curve; add orders"),
        (ENCODERS + 'orders = [1]\nconvention = { wave = "sine" }', "convention is for tables of orders"),
        (TABLE.replace("61.9", "-61.9"), "of order 1 is negative"),
        (TABLE.replace("[0, 1, 39, 78]", "[0, 1, 39, 39]"), "order 39 stands in 2 rows"),
        ('value = "1 arcsec"', "needs order or input_order"),
        (TABLE.replace('table.phase = { values = [0, 0.3, -1.6, 2.9], unit = "rad" }', ""), "needs phase"),
    ],
)
def test_faults_say_where_and_what_to_do(tmp_path, record, run, says):
    write_encoders(tmp_path / "enc.csv")
    with pytest.raises(InputFault, match=says):
        record(run)


def test_the_check_takes_orders_for_a_transmission_error(tmp_path):
    (tmp_path / "campaign.toml").write_text(CAMPAIGN.format(run=TABLE, direction="forward"))
    check = check_campaign(load_campaign(tmp_path))
    assert not check.problems
    assert "one mounting" in {finding.code for finding in check.findings}
    assert not {"record too short", "sampling too coarse"} & {finding.code for finding in check.findings}


def test_planned_tables_have_their_orders(tmp_path):
    """Of a template that nobody has filled in: two numbers an order."""
    write_template(tmp_path / "t", ("transmission_order",))
    campaign, names = with_planned(load_campaign(tmp_path / "t"))
    assert len(names) == 3
    assert np.array_equal(campaign.records[0].axes["order"][:4], [1, 1, 2, 2])
    assert np.array_equal(campaign.records[0].axes["part"][:4], [0, 1, 0, 1])
