"""Of a number that another one would show as well, a model file carries both, and whatever is told of it later says so."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from cli.show.comparison import show_extension
from discrepancy.compare import compare
from discrepancy.experiment.next_run import questions_left
from discrepancy.extend import either_told, extend
from discrepancy.model_file import ModelFile, load_model, save_model
from discrepancy.page.extension import extension_page, model_page, parameters
from discrepancy.prediction.candidates import candidates
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import Record
from reducers.reducer import load_reducer
from tests.test_next_run import CAMPAIGN
from tests.test_opposite_sign import FACTORS
from workbench.reducers import added

ANGLE = "effects.pin_position_errors.ring_trilobe_angle"


@pytest.fixture(scope="module")
def campaign():
    """Transmission errors over a turn of the output, twice, of a ring with three lobes."""
    reducer, rng = load_reducer("RV20E-121"), np.random.default_rng(1)
    angle = np.linspace(0.0, 2.0 * np.pi, 900, endpoint=False)
    blank = Record("r", "transmission_error", "rad", "a", 1, np.zeros(900), {"angle": angle}, FACTORS, stated_noise=1e-7)
    made = replace(CAMPAIGN, reducer=reducer, records=(blank,))
    (shown,) = PhysicalModel(ModelFile(reducer.name, reducer), made, zeros={}).predict({"pin_ring_trilobe": 4e-6, "pin_ring_trilobe_angle": 0.3})
    records = tuple(replace(blank, name=f"r{k}", replicate=k, values=shown + 1e-7 * rng.standard_normal(900)) for k in (1, 2))
    return replace(made, records=records, conditions={"a": SimpleNamespace(interventions=(), factors={})})


@pytest.fixture(scope="module")
def extension(campaign):
    return extend(ModelFile("RV20E-121", campaign.reducer), campaign, ["pin_position_errors.trilobe"], anyway=True)


def test_the_other_angle_stays_with_the_one_that_was_added(campaign, extension, tmp_path, capsys):
    """76.3 deg was told by the diagnosis alone: the file had 16.3 deg with 0.3 deg round it, and ``untold = []``."""
    save_model(extension.file, tmp_path / "better.toml")
    file = load_model(tmp_path / "better.toml")
    entry = file.effects["pin_position_errors"]["pin_ring_trilobe_angle"]
    assert abs(entry["alike"] - entry["value"]) == pytest.approx(np.pi / 3.0)
    assert "alike" not in file.effects["pin_position_errors"]["pin_ring_trilobe"]
    (told,) = file.steps[0]["untold"]
    assert told.startswith(f"{ANGLE}: it is in one of 2 places, which show the same: ") and told.endswith("measure the ring itself at these places")
    # On the screen, on pages, in what is compared and asked next, and in the workbench.
    show_extension(extension)
    assert "measure the ring itself at these places" in " ".join(capsys.readouterr().out.split())
    assert told in extension_page(extension).warnings and told in model_page(file).warnings
    assert told in compare(file, campaign).warnings
    answer = SimpleNamespace(effects=[], untold=[], model=SimpleNamespace(file=file))
    assert questions_left(answer, campaign)[-1] == told
    (row,) = [r for r in added(file) if r["name"] == ANGLE]
    assert row["value"].count(" or ") == 1 and row["source"].count(" to ") == 2
    (shown,) = [r for r in parameters(file).tables[0].rows if r[1] == ANGLE]
    assert shown[2].count(" or ") == 1 and shown[3].count(" to ") == 2
    assert extension.as_json()["effects"]["pin_position_errors"][ANGLE]["alike"] == pytest.approx(np.degrees(entry["alike"]))


def test_a_pin_of_a_model_is_told_as_a_whole_number_and_where_it_is_stays_with_it(campaign):
    """The file's list and the page of the model had 19.002, 18.986 to 19.019, and the step nothing."""
    number = {"value": 19.00239, "unit": "1", "low": 18.98578, "high": 19.019}
    file = replace(load_model("RV20E-121"), effects={"pin_position_errors": {"proud_pin": {"value": 6e-6, "unit": "m"}, "proud_pin_number": number}})
    (row,) = [r for r in added(file) if r["name"].endswith("proud_pin_number")]
    assert row["value"] == "19 or 39" and row["source"].endswith("interval 19 or 39")
    (shown,) = [r for r in parameters(file).tables[0].rows if r[1].endswith("proud_pin_number")]
    assert shown[2:4] == ["19 or 39", "19 or 39"]
    (proud,) = [c for c in candidates(list(campaign.records), {}, set(), []) if c.name == "pin_position_errors.proud"]
    values = {"proud_pin": 6e-6, "proud_pin_number": 19.00239, "angle_zero[1]": np.radians(5.7)}
    fit = SimpleNamespace(candidates=(proud,), fit=SimpleNamespace(values=values))
    (left,) = either_told(fit, {}, load_model("RV20E-121"))
    assert left.startswith("effects.pin_position_errors.proud_pin_number: it is one of 2 pins, which show the same: 156.3 or 336.3 deg from crank 1")
