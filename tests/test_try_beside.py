"""Try: a large effect stands where a diagnosis of the same measurements has found zero, lag and cages; without one the page says that it does not."""

import math

import numpy as np
import pytest
from zero_campaign import HIDDEN, NAME, REDUCER, TURNED, ZERO, written

from discrepancy.campaign.load import load_campaign
from discrepancy.held_names import LOCKED_AT
from discrepancy.inference.verdict import Settings
from discrepancy.model_file import load_model
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import Record
from discrepancy.remembered import place_of, write
from discrepancy.verdict import diagnose
from workbench.beside import Known, fewer
from workbench.folder import Folder
from workbench.own_zero import as_in_look
from workbench.thinned import thinned
from workbench.trying import Trial, error_of

SUITS = "angles count from where what is tried fits best; phases of cages are those of the model without"
WITHOUT, BESIDE = "zero and phases are those of the model without what is tried", "zero and phases are those that the diagnosis found beside"


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    return Folder(written(tmp_path_factory.mktemp("try"), loop=True))


@pytest.fixture
def cache(tmp_path, monkeypatch):
    monkeypatch.setattr("discrepancy.remembered.cache_folder", lambda name: tmp_path)


def tried(trial, folder, run, values):
    return trial.curve(folder, REDUCER, run, values)[0]


def test_a_large_effect_stands_where_the_diagnosis_found_it(folder, cache):
    """Discs off centre as they are made the curve look worse than it was without them: it stood at the zero of the base model.  Without a diagnosis it
    stands at the zero that suits it, but for cages and lag; while the hand moves at the last one."""
    trial = Trial()
    assert trial.curve(folder, REDUCER, "at_160_1", HIDDEN, roughly=True)[0]["placed"].startswith(WITHOUT)
    before = {run: tried(trial, folder, run, HIDDEN) for run in ("at_160_1", "loop")}
    assert all(told["placed"].startswith(SUITS) and told["rms"][1] < 0.05 * told["rms"][0] for told in before.values())
    assert trial.curve(folder, REDUCER, "at_160_1", HIDDEN, roughly=True)[0]["rms"][1] < 0.5
    assert not tried(trial, folder, "loop", {})["placed"]
    file, campaign = load_model(REDUCER), load_campaign(folder.root)
    model = PhysicalModel(file, campaign)
    [other] = [p for c in model.candidates if c.name == "needle_clearance" for p in c.amplitudes]
    model.candidates = tuple(c for c in model.candidates if c.name == NAME)
    write(place_of(file, campaign, Settings()), diagnose(file, campaign, model=model))
    # Of what is tried the diagnosis knows nothing: as before.
    assert tried(trial, folder, "at_160_1", {other.name: other.scale})["placed"].startswith(WITHOUT)
    for run, told in before.items():
        found = tried(trial, folder, run, HIDDEN)
        assert found["placed"].startswith(BESIDE) and found["rms"][0] == told["rms"][0]
        assert found["rms"][1] < told["rms"][1]
    # Noise is 0.05 arcsec.
    assert tried(trial, folder, "at_160_1", HIDDEN)["rms"][1] < 0.06


def test_what_cages_add_is_thinned_as_the_run_is(folder):
    campaign, count = load_campaign(folder.root), 6000
    record = Record("r", "transmission_error", "rad", "c", 1, np.zeros(count), {"angle": np.linspace(0.0, 12.0, count)}, {})
    ripple = np.arange(float(count))
    few = fewer(ripple, record, campaign)
    np.testing.assert_allclose(thinned(record).axes["angle"], record.axes["angle"][few.astype(int)])


def test_loops_are_locked_where_the_last_comparison_has_the_zero(folder, cache):
    """The pattern alone told the zero roughly: a loop of a model with a large effect stood 4 deg of the input beside, 7 times its noise off."""
    before = Trial().opened(folder, REDUCER).model
    zero = before.zeros[ZERO] + math.radians(3.0) / before.bench.ratio
    folder.remember("jobs/compare/result", {"model": REDUCER, "nuisances": {ZERO: zero}})
    [place] = [r.factors[LOCKED_AT] for r in before.records if r.quantity == "hysteresis"]
    after = Trial().opened(folder, REDUCER).model
    [loop] = [r for r in after.records if r.quantity == "hysteresis"]
    assert after.as_seen(loop, after.standing())[0].factors[LOCKED_AT] == pytest.approx(place + math.radians(3.0))


def test_of_a_large_effect_nothing_is_left_that_a_rough_look_would(folder, cache):
    trial = Trial()
    trial.opened(folder, REDUCER).known = [Known(frozenset(HIDDEN), "discs off centre", {ZERO: TURNED})]
    for row in trial.everywhere(folder, REDUCER, HIDDEN):
        if row["signal"] == "transmission_error":
            exact = tried(trial, folder, "at_160_1", HIDDEN)["rms"][1]
            assert float(row["after"].split()[0]) < 1.5 * exact


def test_why_an_error_is_another_one_than_in_look_stands_beside_it(cache, tmp_path):
    """1.00 arcsec in Look and 0.689 in Try, of one model and one campaign: nothing beside either said what differs."""
    (tmp_path / "look").mkdir()
    own = Folder(written(tmp_path / "look", {}, loop=True))
    trial = Trial()
    zero = trial.opened(own, REDUCER).model.zeros[ZERO] + 2e-3
    at_look = {run: tried(trial, own, run, {}) for run in ("at_160_1", "loop")}
    # Without a comparison of this model there is no other number.
    assert not any(told["look"] for told in at_look.values())
    own.remember("jobs/compare/result", {"model": REDUCER, "nuisances": {ZERO: zero}})
    told = tried(trial, own, "at_160_1", {})
    beside = trial.opened(own, REDUCER)
    [record] = [r for r in beside.model.records if r.name == "at_160_1"]
    in_common = error_of(record, beside.model.one(record, beside.standing)) * 180.0 * 3600.0 / math.pi
    assert told["rms"][0] < 0.9 * in_common and told["look"].startswith(f"{in_common:.3g} arcsec at the one zero and lag that Look has for all runs")
    assert "deg to its own" in told["look"] and not tried(trial, own, "loop", {})["look"]
    rows = {row["signal"].partition("[")[0]: row for row in trial.everywhere(own, REDUCER, HIDDEN)}
    assert "arcsec" in rows["transmission_error"]["look"] and rows["transmission_error"]["look"].startswith("fitted ") and not rows["hysteresis"]["look"]
    assert as_in_look(0.6901, 0.69, "arcsec", 1e-5) == ""
