"""Where an error of one part is not looked for: held against the model, which shows it otherwise at each part of a reducer with three cranks."""

import re
from dataclasses import replace
from itertools import product
from pathlib import Path

import numpy as np
import pytest

from discrepancy.alike.unsearched_places import turned, unsearched_places, unsearched_text
from discrepancy.campaign.model import Condition
from discrepancy.model_file import ModelFile, load_model
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import Record
from discrepancy.verdict import diagnose
from reducers.reducer import load_reducer
from rv_plant.topology import Topology

FACTORS = {"speed": 209.44, "load": 167.0, "temperature": 293.15, "direction": 1.0}
ANGLES = np.linspace(0.0, 2.0 * np.pi / 39.0, 12, endpoint=False)
THROW = 4e-6


def reducer_file(folder, cranks):
    """The rigid reducer of the library with another number of cranks."""
    text = Path(load_reducer("RV20E-121-rigid").path).read_text(encoding="utf-8")
    path = folder / f"cranks_{cranks}.toml"
    path.write_text(re.sub(r"cranks = \d", f"cranks = {cranks}", text), encoding="utf-8")
    return path


def model_of(file):
    from tests.test_next_run import CAMPAIGN

    record = Record("r", "transmission_error", "rad", "a", 1, np.zeros(len(ANGLES)), {"angle": ANGLES}, FACTORS, stated_noise=1e-7)
    conditions = {"a": Condition("a", FACTORS, "1", False, True)}
    return PhysicalModel(file, replace(CAMPAIGN, reducer=file.reducer, records=(record,), conditions=conditions), zeros={})


@pytest.fixture(scope="module", params=[2, 3])
def model(request, tmp_path_factory):
    return model_of(ModelFile("m", load_reducer(reducer_file(tmp_path_factory.mktemp("places"), request.param))))


def test_the_places_that_turning_reaches_are_those_that_the_model_shows_alike(model):
    topology = model.file.reducer.topology
    places = list(product(range(1, topology.cranks + 1), (1, 2)))
    base = model.predict({})[0]
    shown = {(c, d): model.predict({f"lobe_throw_error_{c}": THROW, "lobe_error_disc": d})[0] - base for c, d in places}
    size = float(np.linalg.norm(shown[1, 1]))
    for here, there in product(places, places):
        reached = (there[0], (there[1],)) in turned((here[0], (here[1],)), ["disc"], topology)
        # Whoever turns the sign does not get the other place, either.
        apart = min(float(np.linalg.norm(shown[here] - sign * shown[there])) for sign in (1.0, -1.0)) / size
        assert (apart < 1e-3) if reached else (apart > 0.1), (here, there)


def test_what_has_no_candidate_is_said_with_the_line_that_looks_there(model, tmp_path):
    found = unsearched_places(model)
    if model.file.reducer.topology.cranks == 2:
        assert found == [] and unsearched_text(model) == ""
        return
    lobes = [one.place for one in found if one.effect == "crank_lobe_errors"]
    assert lobes == ["crank 1 at disc 2", "crank 2 at disc 2", "crank 3 at disc 2"]
    assert {"hole 3 at disc 2", "carrier at crank 2", "carrier at crank 3"} <= {one.place for one in found}
    text = unsearched_text(model)
    assert text.startswith("with 3 cranks and 2 discs") and "crank_lobe_errors not at crank 1 at disc 2, crank 2 at disc 2, crank 3 at disc 2;" in text
    # As the text says.
    line, effect = re.search(r"a model file with (.*) in \[effects\.(\w+)\]", text).groups()
    path = tmp_path / "there.toml"
    path.write_text(f'[model]\nname = "there"\nreducer = "{reducer_file(tmp_path, 3).name}"\n[effects.{effect}]\n{line}\n', encoding="utf-8")
    there = model_of(load_model(path))
    assert [one.place for one in unsearched_places(there) if one.effect == effect] == ["crank 1 at disc 1", "crank 2 at disc 1", "crank 3 at disc 1"]
    assert {f"{effect}.crank_{k}" for k in (1, 2, 3)} <= {c.name for c in there.candidates}


@pytest.mark.parametrize("counts, reached", [
    ((2, 2, 40), {(1, (1,)), (2, (2,))}), ((2, 3, 40), {(1, (1,))}), ((3, 3, 39), {(1, (1,)), (2, (2,)), (3, (3,))}), ((2, 2, 41), {(1, (1,))}),
])  # fmt: skip
def test_a_reducer_is_turned_onto_itself_where_discs_cranks_and_pins_allow(counts, reached):
    discs, cranks, pins = counts
    assert set(turned((1, (1,)), ["disc"], Topology(discs=discs, cranks=cranks, pins=pins, lobes=pins - 1, rollers=16, output_pins=0))) == reached


def test_a_diagnosis_says_it(tmp_path):
    """An error at the second disc of three cranks is taken for another effect, and the answer says where nobody looked."""
    file = ModelFile("m", load_reducer(reducer_file(tmp_path, 3)))
    model = model_of(file)
    shown = model.predict({"lobe_throw_error_1": THROW, "lobe_error_disc": 2})[0]
    rng = np.random.default_rng(1)
    records = tuple(replace(model.records[0], name=f"r{k}", replicate=k, values=shown + 1e-6 * rng.standard_normal(len(shown)), stated_noise=1e-6) for k in (1, 2))
    answer = diagnose(file, replace(model.campaign, records=records), model=PhysicalModel(file, replace(model.campaign, records=records), zeros={}))
    assert [text for text in answer.warnings if "crank_lobe_errors not at crank 1 at disc 2" in text]
