"""A base model that is a little off is no missing effect: its numbers have ranges, and the diagnosis says which is off and by how much."""

from dataclasses import dataclass, replace

import numpy as np
import pytest

from discrepancy.campaign.model import Campaign
from discrepancy.experiment.next_run import proposal_for
from discrepancy.extend import extend
from discrepancy.inference.diagnose import Diagnostician
from discrepancy.inference.diagnose import diagnose as inferred
from discrepancy.inference.screening import screen
from discrepancy.inference.verdict import BASE_OFF, NONE, ONE, UNKNOWN, BaseError, Settings, decide
from discrepancy.model_file import load_model, save_model
from discrepancy.prediction.base_numbers import base_numbers
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import BASE, Candidate, Parameter, Record
from discrepancy.repetitions import outlying, with_left_out
from discrepancy.verdict import diagnose
from discrepancy.words.wording import beyond_text
from fmu_src.faults import InputFault
from reducers.reducer import load_reducer

LOADS = (20.0, 50.0, 90.0, 140.0, 200.0)


def amplitude(name, scale=1.0, sign=0):
    return Parameter(name, "1", 0.0, 0.0 if sign > 0 else -1e3, 1e3, scale, sign)


NUMBER = Parameter("stiffness", "1", 1.0, 0.9, 1.1, 0.02, 0, 0.2 / 12.0**0.5, "stiffness of the file")
CANDIDATES = (
    # Nearly what a wrong stiffness does: together two effects would fit as well.
    Candidate("spring", "spring", (amplitude("spring", 0.01, 1),)),
    Candidate("gain", "gain", (amplitude("gain", 0.01),), part="chain"),
    Candidate("play", "play", (amplitude("play", 1.0, 1),)),
    Candidate(f"{BASE}.stiffness", "stiffness of the reducer file", (NUMBER,), part=BASE),
)


@dataclass
class Bench:
    """Turning over the load of a spring that is not quite linear; ``shares`` of the model's own error are a nuisance."""

    records: list
    nuisances: tuple = ()
    candidates: tuple = CANDIDATES

    def predict(self, values, which=None):
        return [law(self.records[i], values) for i in (range(len(self.records)) if which is None else which)]


def law(record, v):
    load = record.factors["load"]
    y = 100.0 * (load / 100.0) ** 0.9 / v.get("stiffness", 1.0) + 100.0 * v.get("spring", 0.0) * load / 100.0 + v.get("play", 0.0)
    return np.full(8, y * (1.0 + v.get("gain", 0.0)) * (1.0 + v.get("model_error", 0.0)))


def bench(truth, noise=0.4, **more):
    random = np.random.default_rng(3)
    records = [
        Record(f"{load:g}/{k}", "turning", "arcsec", f"{load:g}", k, np.zeros(8), {"time": np.arange(8.0)}, {"load": load})
        for load in LOADS for k in (1, 2, 3)
    ]  # fmt: skip
    model = Bench(records, **more)
    values = [y + noise * random.standard_normal(8) for y in model.predict(truth)]
    model.records = [Record(**{**r.__dict__, "values": v}) for r, v in zip(records, values)]
    return model


def test_assumed_number_that_is_off_is_said_and_no_effect_is_named():
    found = inferred(bench({"stiffness": 0.95}))
    assert (found.verdict, found.effects) == (BASE_OFF, [])
    (off,) = found.base_off
    assert (off.name, off.assumed, off.within) == ("stiffness", 1.0, (0.9, 1.1))
    assert off.interval[0] < 0.95 < off.interval[1]
    # What is named is no rival of itself, and is what is shown in the model.
    assert "base.stiffness" not in [r["name"] for r in found.rejected] and found.fits.members[0].name == "base.stiffness"
    plain = found.to_dict()["base_off"][0]
    assert plain["name"] == "stiffness" and plain["interval"] == list(off.interval)


def test_one_bad_repetition_of_three_is_no_alarm():
    model = bench({})
    model.records[7] = replace(model.records[7], values=4.0 * model.records[7].values)
    model.records = with_left_out(model.records, outlying(model.records))
    assert [r.name for r in model.records if r.left_out] == [model.records[7].name]
    found = inferred(model)
    assert found.verdict == NONE and not found.base_off and len(found.fits.space.training) == len(model.records) - 1


def test_effect_that_no_number_of_the_base_imitates_is_named():
    found = inferred(bench({"play": 4.0}))
    assert found.verdict == ONE and [e.name for e in found.effects] == ["play"] and found.base_off == []


def test_number_beyond_its_range_is_not_the_base():
    found = inferred(bench({"stiffness": 0.7}))
    assert found.verdict != BASE_OFF and found.verdict != NONE


def test_error_of_what_the_base_computes_is_said_where_it_is_larger_than_assumed():
    error = Parameter("model_error", "1", 0.0, -0.5, 0.5, 0.02, 0, 0.02, "error of what the model computes, as a share", of_base=True)
    candidates = tuple(c for c in CANDIDATES if c.name == "play")
    right = inferred(bench({"model_error": 0.02}, nuisances=(error,), candidates=candidates))
    assert (right.verdict, right.base_off) == (NONE, [])
    off = inferred(bench({"model_error": 0.06}, nuisances=(error,), candidates=candidates))
    assert off.verdict == BASE_OFF and off.base_off[0].name == "model_error" and off.base_off[0].value == pytest.approx(0.06, abs=0.01)


def test_something_left_beside_a_number_that_is_off_is_unknown():
    settings = Settings()
    assert decide(True, True, 0, 1, 0.9, False, settings)[0] == BASE_OFF
    assert decide(True, True, 0, 1, 0.9, True, settings)[0] == decide(True, True, 0, 1, 0.9, False, settings, unproved="grew")[0] == UNKNOWN


def test_ranges_of_a_reducer_file(tmp_path):
    text = load_reducer("RV20E-121-rigid").path.read_text()
    reducer = load_reducer("RV20E-121-rigid")
    assert reducer.ranges["roller_stiffness"] == (4.7e5, 5.5e5) and reducer.ranges["run_in_time"] == (50.0 * 3600.0, 500.0 * 3600.0)
    # Assumed without a range: a tenth to either side.  From a source without one: known.
    assert reducer.ranges["roller_stiffness_lankarani"] == pytest.approx((0.9 * 5.26e6, 1.1 * 5.26e6))
    assert "mesh_width" not in reducer.ranges
    file = tmp_path / "own.toml"
    for wrong, message in (("[5.2e5, 6e5]", "stiffness.*outside"), ("[1e5, -1]", "stiffness.*outside"), ("5", "stiffness.range")):
        file.write_text(text.replace("[4.7e5, 5.5e5]", wrong))
        with pytest.raises(InputFault, match=message):
            load_reducer(file)


def test_numbers_that_are_declared_set_or_an_effect_of_the_catalogue_are_no_candidates():
    reducer = load_reducer("RV20E-121-rigid")
    names = {c.name for c in base_numbers(reducer, {"mesh_wear_coefficient"})}
    assert {"base.mesh_stiffness", "base.roller_stiffness", "base.raceway_wear_coefficient"} <= names
    assert not names & {"base.mesh_wear_coefficient", "base.bearing_clearance", "base.shift_modification", "base.pin_radius", "base.load_torque"}


def test_number_at_an_end_of_its_range_goes_one_way():
    numbers = {c.name: c.amplitudes[0] for c in base_numbers(load_reducer("RV20E-121-rigid"), ())}
    assert numbers["base.pressure_viscosity"].sign == 1 and numbers["base.mesh_stiffness"].sign == 0


def test_number_may_be_beyond_its_range_where_it_is_no_length():
    numbers = {c.name: c.amplitudes[0] for c in base_numbers(load_reducer("RV20E-121-rigid"), ())}
    stiffness, radius = numbers["base.roller_stiffness"], numbers["base.crank_circle_radius"]
    assert stiffness.said == (4.7e5, 5.5e5) and (stiffness.lower, stiffness.upper) == (2.55e5, 1.02e6)
    assert radius.said == (radius.lower, radius.upper)
    # Known beforehand by its range all the same.
    assert stiffness.prior == pytest.approx(12.0**-0.5 * 0.8e5)


def test_number_beyond_its_range_is_said_to_be():
    said, beyond = (BaseError("roller_stiffness", "t", value, (value - 1e3, value + 1e3), "N", 5.1e5, (4.7e5, 5.5e5), 9.0) for value in (4.8e5, 3.7e5))
    assert beyond_text(said) == "" and beyond_text(beyond) == ", beyond which it is"


def test_sizes_that_were_seen_at_other_places_are_computed_whole(monkeypatch):
    model = bench({"stiffness": 0.95})
    doctor = Diagnostician(model)
    doctor.prepare()
    whole = doctor.screened().scores
    glimpse = screen._glimpse
    lengths = {screen.TYPICAL: 50, screen.SMALL: 40, -screen.TYPICAL: 30}
    monkeypatch.setattr(screen, "_glimpse", lambda space, c, at, which, size: glimpse(space, c, at, which, size)[: lengths[size]])
    again = doctor.screened().scores
    assert {s.name: s.statistic for s in again} == pytest.approx({s.name: s.statistic for s in whole}, rel=0.05)


def test_stiffer_contacts_of_the_reducer_are_the_base(tmp_path):
    file = load_model("RV20E-121-rigid")
    records = tuple(
        Record(f"s{t:g}/{k}", "torsional_stiffness", "N.m/rad", f"{t:g} degC", k, np.zeros(1), {}, {"temperature": 273.15 + t}, held_out=t == 30.0)
        for t in (20.0, 30.0, 40.0) for k in (1, 2, 3, 4)
    )  # fmt: skip
    blank = Campaign(None, "bench", "", file.reducer, 121.0, 167.0, {}, records, {}, {}, (), None, "")
    truth = 1.06 * file.reducer.starts["mesh_stiffness"]
    model = PhysicalModel(file, blank, zeros={})
    random = np.random.default_rng(1)
    whole = [y * (1.0 + 0.002 * random.standard_normal()) for y in model.predict({"mesh_stiffness": truth})]
    campaign = Campaign(**{**blank.__dict__, "records": tuple(Record(**{**r.__dict__, "values": y}) for r, y in zip(records, whole))})
    answer = diagnose(file, campaign)
    assert answer.verdict == BASE_OFF and answer.effects == []
    off = {e["name"]: e for e in answer.as_json()["base_off"]}
    low, high = off["mesh.stiffness"]["si"]["interval"]
    assert low < truth < high and off["mesh.stiffness"]["interval"] == pytest.approx([low / 1e3, high / 1e3]) and off["mesh.stiffness"]["unit"] == "kN"
    # Springs, gain and other numbers do the same to one stiffness: said, none of them named.
    assert len(off) > 1 and f"which of {len(off)} numbers" in answer.reason
    assert "sensor_gain.torsional_stiffness" in next(iter(answer.diagnosis.alternatives.values()))
    assert {"base.roller_stiffness", "sensor_gain.torsional_stiffness"} <= set(proposal_for(answer, campaign).rivals)
    # The number is taken as it was measured, as a setting of the model; nothing is left then.
    extension = extend(file, campaign, ["base.mesh_stiffness"])
    assert extension.file.effects == {} and extension.file.settings["mesh_stiffness"] == pytest.approx(truth, rel=0.03)
    save_model(extension.file, tmp_path / "better.toml")
    again = diagnose(load_model(tmp_path / "better.toml"), campaign)
    assert again.verdict == NONE
