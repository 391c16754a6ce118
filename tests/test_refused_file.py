"""A model file that holds nothing but refused effects is its reducer: no list offers it, and results of it say so."""

import pytest

from cli.completion import reducer_completions
from discrepancy.model_file import ModelFile, load_model, save_model
from discrepancy.refused_file import only_refused
from reducers.reducer import load_reducer
from workbench.folder import opened

REFUSED = {"campaign": "c", "effects": ["race_spall.outer_race"], "verdict": "did not help", "kept": False}
KEPT = {"campaign": "c", "effects": ["sensor_drift"], "verdict": "helped", "kept": True}
DRIFT = {"sensor_drift": {"sensor_drift": {"value": 0.02, "unit": "1"}}}


@pytest.fixture
def folder(tmp_path, monkeypatch):
    reducer = load_reducer("RV20E-121")
    save_model(ModelFile("RV20E-121", reducer, steps=(REFUSED,)), tmp_path / "refused.toml")
    save_model(ModelFile("RV20E-121", reducer, effects=DRIFT, steps=(KEPT, REFUSED)), tmp_path / "better.toml")
    save_model(ModelFile("RV20E-121", reducer, settings={"bearing_clearance": 3e-6}, steps=(REFUSED,)), tmp_path / "set.toml")
    save_model(ModelFile("RV20E-121", reducer), tmp_path / "plain.toml")
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_lists_of_models_leave_it_out(folder):
    """refused.toml stood in the workbench's lists and beside "compare two models" as a model of its own."""
    assert opened(folder).models() == ["better.toml", "plain.toml", "set.toml"]
    pytest.importorskip("argcomplete", reason="the shell's completion needs argcomplete")
    offered = reducer_completions("")
    assert {"better.toml", "plain.toml", "set.toml", "RV20E-121"} <= {*offered} and "refused.toml" not in offered


def test_results_of_it_say_what_was_refused(folder):
    assert load_model("refused.toml").heading == "refused.toml (RV20E-121; refused: race_spall.outer_race)"
    assert load_model("better.toml").heading == "better.toml (RV20E-121)"


def test_a_file_of_a_reducer_is_none_of_these():
    assert not only_refused({"reducer": {"name": "mine"}}) and not only_refused({"model": {}, "steps": [{"effects": ["play"]}]})
