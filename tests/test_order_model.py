"""The model of orders: those of the curve that it predicts, compared, aligned and diagnosed like any other quantity."""

import math

import numpy as np
import pytest

from discrepancy.campaign.load import load_campaign
from discrepancy.campaign.order_analysis import measured_orders
from discrepancy.compare import compare
from discrepancy.model_file import load_model
from discrepancy.prediction.order_curves import turns_of
from discrepancy.prediction.physical_model import PhysicalModel
from fmu_src.faults import InputFault

ARCSEC = math.pi / 648000.0
ORDERS = (1, 2, 3, 39, 40, 78, 80, 120, 156, 160)
HEAD = """
[campaign]
name = "rig"
reducer = "RV20E-121-rigid"
[conditions.{name}]
output_speed = "{speed} rpm"
load_torque = "{load} N.m"
direction = "{direction}"
{more}
"""
RUN = """
[[runs]]
id = "{id}"
quantity = "transmission_order"
condition = "{name}"
noise = "0.05 arcsec"
{keys}
file = "orders.csv"
where = {{ run = "{id}" }}
columns.order = {{ column = "order", unit = "1" }}
columns.value = {{ column = "amplitude", unit = "arcsec" }}
columns.phase = {{ column = "phase", unit = "rad" }}
"""
HIDDEN = {"pin_ring_runout": 4e-6, "resonance_share": 0.8, "resonance_frequency": 25.0, "resonance_damping": 0.04}


def write(folder, conditions, table, keys=""):
    """``conditions`` by name (speed, load, direction, more); ``table`` by run: complex amplitudes [rad]."""
    head, runs = "", ""
    for name, (speed, load, direction, more) in conditions.items():
        text = HEAD.format(name=name, speed=speed, load=load, direction=direction, more=more)
        head += text if not head else text[text.index("[conditions"):]
        runs += RUN.format(id=name, name=name, keys=keys)
    (folder / "campaign.toml").write_text(head + runs)
    rows = [f"{name},{k},{abs(a) / ARCSEC:.9g},{np.angle(a):.9g}" for name, found in table.items() for k, a in found.items()]
    (folder / "orders.csv").write_text("run,order,amplitude,phase\n" + "\n".join(rows) + "\n")
    return load_campaign(folder)


def empty(conditions):
    return {name: dict.fromkeys(ORDERS, 0j) for name in conditions}


CONDITIONS = {
    "slow": (5.0, 160.0, "forward", ""), "fast": (15.0, 160.0, "forward", ""), "light": (15.0, 40.0, "forward", ""), "back": (10.0, 100.0, "reverse", ""),
}  # fmt: skip


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("orders")
    return PhysicalModel(load_model("RV20E-121-rigid"), write(folder, CONDITIONS, empty(CONDITIONS)))


def complex_of(record, values):
    return dict(zip(record.axes["order"][::2], values[::2] + 1j * values[1::2]))


@pytest.mark.parametrize("place", [0, 3])
def test_orders_are_those_of_the_curve_with_its_measuring_chain(made, tmp_path, place):
    """Of a curve over uneven angles of the same condition and effects: to 0.01 arcsec."""
    name = list(CONDITIONS)[place]
    speed, load, direction, _ = CONDITIONS[name]
    angle = 0.7 + 2.0 * np.pi * (np.arange(6000) + np.random.default_rng(0).uniform(-0.2, 0.2, 6000)) / 6000
    angle = angle if direction == "forward" else angle[::-1]
    text = HEAD.format(name=name, speed=speed, load=load, direction=direction, more="") + f"""
[[runs]]
id = "te"
quantity = "transmission_error"
condition = "{name}"
noise = "0.05 arcsec"
file = "te.csv"
columns.angle = {{ column = "a", unit = "rad" }}
columns.value = {{ column = "v", unit = "rad" }}
"""
    (tmp_path / "campaign.toml").write_text(text)
    (tmp_path / "te.csv").write_text("a,v\n" + "\n".join(f"{a:.12g},0" for a in angle))
    values = HIDDEN | {"encoder_cos1[1]": 3e-5}
    curve = PhysicalModel(load_model("RV20E-121-rigid"), load_campaign(tmp_path), zeros={}).predict(values)[0]
    expected, _ = measured_orders(angle, curve, ORDERS, "none", None, "x")
    found = complex_of(made.records[place], made.predict(values, [place])[0])
    assert np.array(list(found.values())) == pytest.approx(expected, abs=0.01 * ARCSEC)
    assert abs(found[1]) > 3.0 * ARCSEC


def test_the_zero_of_the_angle_turns_all_phases_together(made):
    """By k theta_0: one unknown for all orders of a mounting."""
    zero = 0.012
    plain = complex_of(made.records[1], made.predict({"angle_zero[1]": 0.0, "pin_ring_runout": 4e-6}, [1])[0])
    turned = complex_of(made.records[1], made.predict({"angle_zero[1]": zero, "pin_ring_runout": 4e-6}, [1])[0])
    for k in ORDERS:
        # What is fixed to the encoder's angle would stay; the reducer's errors turn.
        assert turned[k] == pytest.approx(plain[k] * np.exp(1j * k * zero), abs=0.01 * ARCSEC)


def test_a_resonance_lifts_what_it_meets(made):
    """Order 80 at 5 rpm is at 6.7 Hz, at 15 rpm at 20 Hz."""
    resonance = {name: value for name, value in HIDDEN.items() if name.startswith("resonance")}
    ratio = []
    for place in (0, 1):
        with_it, without = (complex_of(made.records[place], made.predict(v, [place])[0]) for v in (resonance, {}))
        ratio.append(abs(with_it[80]) / abs(without[80]))
    r = np.array([80 * 5 / 60, 80 * 15 / 60]) / 25.0
    damped = 2j * 0.04 * r
    assert ratio == pytest.approx(np.abs(1.0 + 0.8 * ((1.0 + damped) / (1.0 - r * r + damped) - 1.0)), rel=1e-3)


def test_the_mean_counts_where_the_zero_is_known(tmp_path):
    table = {name: {0: 0j, **found} for name, found in empty(CONDITIONS).items()}
    model = PhysicalModel(load_model("RV20E-121-rigid"), write(tmp_path, CONDITIONS, table, 'zero = "absolute"'))
    means = [values[0] for values in model.predict({})]
    assert means[1] < means[2] < 0.0 < means[3]


def test_how_well_a_zero_is_known(tmp_path):
    table = {name: {0: 0j, **found} for name, found in empty(CONDITIONS).items()}
    write(tmp_path, CONDITIONS, table)
    path = tmp_path / "campaign.toml"
    given = path.read_text()
    path.write_text(given + '[quantities.transmission_order]\nzero = "absolute"\nzero_noise = "8 arcsec"\n')
    assert [r.zero_noise for r in load_campaign(tmp_path).records] == pytest.approx([8.0 * ARCSEC] * 4)
    path.write_text(given + '[quantities.transmission_order]\nzero_noise = "8 arcsec"\n')
    with pytest.raises(InputFault, match='state zero = "absolute"'):
        load_campaign(tmp_path)
    path.write_text(given + '[quantities.transmission_order]\nzero = "absolute"\nzero_noise = "8 N"\n')
    with pytest.raises(InputFault, match="zero_noise"):
        load_campaign(tmp_path)


def test_candidates_of_transmission_errors_are_looked_for(made):
    names = {candidate.name for candidate in made.candidates}
    assert {"torsional_resonance", "encoder_eccentricity", "sensor_gain.transmission_error"} <= names
    assert "sensor_offset.transmission_error" not in names
    assert all("transmission_order" in c.signals for c in made.candidates if "transmission_error" in c.signals)


def test_orders_that_are_no_whole_numbers_take_more_turns():
    assert turns_of(np.array([1.0, 39.0])) == 1
    assert turns_of(np.array([1.0, 0.5, 2.25])) == 4


def test_compared_and_localised_by_order(tmp_path):
    """A run-out of the encoder, which the model lacks, is said to be order 1; the noise is the stated one."""
    table = {}
    model = PhysicalModel(load_model("RV20E-121-rigid"), write(tmp_path, CONDITIONS, empty(CONDITIONS)))
    for record, predicted in zip(model.records, model.predict({"encoder_cos1[1]": 1e-4})):
        table[record.name] = complex_of(record, predicted)
    conditions = CONDITIONS | {"back": (*CONDITIONS["back"][:3], "held_out = true")}
    result = compare(load_model("RV20E-121-rigid"), write(tmp_path, conditions, table))
    assert {(s["signal"], s["held_out"]) for s in result.signals} == {("transmission_order", False), ("transmission_order", True)}
    assert all(s["noise_floor"] == pytest.approx(0.05 * ARCSEC, rel=0.01) for s in result.signals)
    assert all(s["error"] == pytest.approx(1e-4 / np.sqrt(2 * len(ORDERS)), rel=0.01) for s in result.signals)
    # Single orders are shown: the strongest is the one that is missing.
    assert result.diagnostician.localisation.findings[0].feature == "orders: output shaft, 1"
    figure = next(f for f in result.figures if f.name.endswith("order 1"))
    assert figure.measured == pytest.approx(1e-4, rel=0.01) and figure.model < 1e-6


def test_one_order_that_is_far_off_hides_no_other(tmp_path):
    """A run-out of 21 arcsec at order 1 and a resonance that lifts order 80 with the speed: both are said, the latter over the speed."""
    conditions = {f"c{k}": (speed, load, "forward", "") for k, (speed, load) in enumerate((s, t) for s in (4.0, 9.0, 15.0) for t in (40.0, 80.0, 120.0, 160.0))}
    model = PhysicalModel(load_model("RV20E-121-rigid"), write(tmp_path, conditions, empty(conditions)))
    shown = model.predict({name: v for name, v in HIDDEN.items() if name.startswith("resonance")} | {"encoder_cos1[1]": 1e-4})
    table = {record.name: complex_of(record, predicted) for record, predicted in zip(model.records, shown)}
    found = compare(load_model("RV20E-121-rigid"), write(tmp_path, conditions, table)).diagnostician.localisation.findings
    assert ("orders: output shaft, 1", "everywhere") in {(g.feature, g.dependence) for g in found}
    assert ("orders: crank against carrier, 80", "speed") in {(g.feature, g.dependence) for g in found}
