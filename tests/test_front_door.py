"""``import rvwear``: the names that stay, quick to import, every example in its docstrings true."""

import ast
import doctest
import json
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import numpy as np
import pytest
import xarray as xr

import rvwear
from cli.main import main
from fmu_src.faults import InputFault
from fmu_src.project import project
from reducers.reducer import load_reducer

ROOT = Path(__file__).resolve().parents[1]
# Seconds that the import may take; it takes some milliseconds.
IMPORT = 0.3
MODULES = ("rvwear.reducer", "rvwear.files", "rvwear.measured")
# Examples that take longer than all others together.
LONG = {"life", "diagnose"}


def examples():
    finder = doctest.DocTestFinder(exclude_empty=True)
    for module in MODULES:
        for found in finder.find(import_module(module), module):
            if found.examples:
                name = found.name.rpartition(".")[2]
                yield pytest.param(found, id=name, marks=[pytest.mark.campaign] if name in LONG else [])


@pytest.mark.parametrize("example", list(examples()))
def test_examples_in_docstrings(example, monkeypatch):
    monkeypatch.chdir(ROOT)
    runner = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS)
    said = []
    runner.run(example, out=said.append)
    assert runner.failures == 0, "".join(said)


def test_every_name_is_there_documented_and_in_the_types():
    typed = "if True:" + (ROOT / "rvwear" / "__init__.py").read_text(encoding="utf-8").partition("if TYPE_CHECKING:")[2].partition("# Name")[0]
    assert sorted(rvwear.__all__) == sorted(rvwear.PLACES)
    for name in rvwear.__all__:
        assert getattr(rvwear, name).__doc__, name
    assert set(rvwear.__all__) < set(dir(rvwear)) and rvwear.__version__ == project().version
    assert {name.asname or name.name for node in ast.walk(ast.parse(typed)) if isinstance(node, ast.ImportFrom) for name in node.names} == set(rvwear.__all__)


def test_every_function_of_the_door_has_an_example_or_is_another_s_own():
    shown = {p.id for p in examples()}
    own = {name for name, (module, there) in rvwear.PLACES.items() if module.startswith("rvwear.") and there == name and name[0].islower()}
    assert own - shown == {"read"}


def test_a_wrong_name_is_told():
    with pytest.raises(AttributeError, match="module 'rvwear' has no 'solv'; it has reducers, load_reducer"):
        print(rvwear.solv)


def test_it_is_imported_at_once_and_loads_nothing():
    script = (
        "import sys, time\nstart = time.perf_counter()\nimport rvwear\nprint(time.perf_counter() - start)\n"
        "print([name for name in ('numpy', 'pandas', 'xarray', 'llvmlite', 'pint') if name in sys.modules])"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True, cwd=ROOT)
    seconds, loaded = done.stdout.splitlines()
    assert float(seconds) < IMPORT and loaded == "[]"


def test_results_are_those_of_the_commands(capsys):
    from cli.main import main

    assert main(["solve", "--positions", "8", "--torque", "100Nm", "--json"]) == 0
    figures = json.loads(capsys.readouterr().out)
    turn = rvwear.solve("RV20E-121", settings={"output.load_torque": "100 N.m"}, positions=8)
    for name, value in figures.items():
        if name not in ("reducer", "positions"):
            assert turn[name].item() == pytest.approx(value, rel=1e-12), name
    assert turn["contact_pressure"].attrs["units"] == "MPa" and float(turn["contact_pressure"].max()) == pytest.approx(figures["peak_contact_pressure_MPa"])
    # Figures are read from the curves of their names.
    for curve, figure in (("transmission_error", "transmission_error_pp_arcsec"), ("transmission_error_at_input", "transmission_error_at_input_pp_arcsec")):
        assert float(np.ptp(turn[curve].values)) == pytest.approx(figures[figure]), curve


def test_a_life_says_all_that_it_was_run_with():
    told = []
    lived = rvwear.life(hours=1.0, tolerance=0.5, positions=8, settings={"output.load_torque": "100 N.m"}, progress=told.append)
    inputs = json.loads(lived.attrs["inputs"])
    assert inputs["positions"] == 8 and inputs["settings"] == {"load_torque": 100.0} and told[-1] == pytest.approx(1.0) == lived["hour"][-1].item()
    assert {"life", "duty", "scheme", "units", "source_hash"} <= inputs.keys()


def test_what_is_wrong_is_an_input_fault():
    with pytest.raises(rvwear.InputFault, match=r"output\.load_torque"):
        rvwear.solve(settings={"output.load_torqe": 3.0})
    with pytest.raises(rvwear.InputFault, match="figure 'x': this result has loop"):
        rvwear.figure(rvwear.hysteresis(steps=4, angles=1), "x")
    for steps, angles in ((0, 8), (40, 0), (10**6, 8)):
        with pytest.raises(rvwear.InputFault, match=f"steps = {steps}, angles = {angles}: at least 4 and 1 are needed"):
            rvwear.hysteresis(steps=steps, angles=angles)
    with pytest.raises(rvwear.InputFault, match="positions = 0: at least 8"):
        rvwear.life(positions=0)
    with pytest.raises(rvwear.InputFault, match="acceleration is chosen by the life run itself"):
        rvwear.life(settings={"acceleration": 10.0})
    with pytest.raises(rvwear.InputFault, match="no picture of its own"):
        rvwear.figure_names(xr.Dataset({"x": ("a", [1.0])}))


def test_a_torque_that_no_reducer_takes_is_warned_of_where_it_was_asked_for():
    absurd = {"output.load_torque": "1670 N.m"}
    for asked in (lambda: rvwear.solve(settings=absurd, positions=8), lambda: rvwear.hysteresis(settings=absurd, steps=4, angles=1)):
        with pytest.warns(rvwear.BeyondRated, match=r"1670 N\.m is 10 times the rated torque, 167 N\.m") as said:
            asked()
        assert said[0].filename == __file__


def test_a_plotly_picture():
    found = rvwear.figure(rvwear.hysteresis(steps=4, angles=1), plotly=True)
    assert found.data[0].type == "scatter" and found.layout.xaxis.title.text == "torque [N m]"


def test_a_model_file_stands_for_a_reducer_with_all_that_it_adds(tmp_path):
    path = tmp_path / "warm.toml"
    path.write_text('[model]\nname = "warm"\nreducer = "RV20E-121"\n[effects.thermal_expansion]\nexpansion = { value = 5e-6, unit = "1/K" }\n', encoding="utf-8")
    hot = {"heat.ambient_temperature": "50 degC"}
    plain, warm = (rvwear.hysteresis(r, settings=hot, steps=8, angles=1)["lost_motion_arcmin"].item() for r in ("RV20E-121", path))
    assert warm > 1.5 * plain
    assert main(["hysteresis", "--reducer", str(path), "--set", "heat.ambient_temperature=50degC", "--steps", "8", "--angles", "1"]) == 0
    with pytest.raises(InputFault, match=r"warm\.toml is a model file"):
        load_reducer(path)


def test_a_folder_of_its_name_does_not_hide_the_package(tmp_path):
    """Whoever clones the repository and writes a script beside it."""
    (tmp_path / "rvwear" / "rvwear").mkdir(parents=True)
    done = subprocess.run([sys.executable, "-c", "import rvwear; rvwear.load_reducer"], cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
