"""rvwear check and the files of series: agreement, difference, JUnit, exit codes."""

import json
import math
from xml.etree import ElementTree

import numpy as np
import pytest

from cli.main import main
from fmu_src.faults import InputFault
from orchestrator.regression import compare, parse_tolerance
from orchestrator.series import read_series, write_series
from orchestrator.ssp.exporter import Experiment, export_ssp


@pytest.fixture
def ring(tmp_path, spring):
    links = [("a.x", "b.u"), ("b.x", "a.u")]
    return export_ssp(tmp_path / "ring.ssp", "ring", {"a": spring, "b": spring}, links, Experiment(0.1, 2.0), {})


@pytest.mark.parametrize("ending", ["csv", "nc"])
def test_run_agrees_with_itself_and_differs_from_another(tmp_path, ring, ending, capsys):
    reference, junit = tmp_path / f"reference.{ending}", tmp_path / "verdicts" / "junit.xml"
    start = ("--set", "a.x=1")
    assert main(["run", str(ring), *start, "--record", "a.x", "--record", "b.*", "--output", str(reference)]) == 0
    common = ["check", str(ring), "--reference", str(reference), "--junit", str(junit)]
    assert main([*common, *start]) == 0
    suite = ElementTree.parse(junit).getroot().find("testsuite")
    assert (suite.get("failures"), suite.get("name")) == ("0", "ring")
    assert {case.get("name") for case in suite.iter("testcase")} >= {"a.x", "b.v"}
    capsys.readouterr()

    assert main([*common, *start, "--set", "b.c=0.6"]) == 1
    assert "a.x = " in capsys.readouterr().out
    suite = ElementTree.parse(junit).getroot().find("testsuite")
    assert int(suite.get("failures")) == len(suite.findall("testcase/failure")) > 0
    assert main([*common, *start, "--set", "b.c=0.6", "--tolerance", "1.5", "--tolerance", "b.c=0,0.2"]) == 0


def test_shorter_reference_and_json(tmp_path, ring, capsys):
    reference = tmp_path / "reference.csv"
    assert main(["run", str(ring), "--set", "a.x=1", "--duration", "0.5", "--output", str(reference)]) == 0
    capsys.readouterr()
    assert main(["check", str(ring), "--set", "a.x=1", "--reference", str(reference), "--json"]) == 0
    assert json.loads(capsys.readouterr().out)["failed"] == []


@pytest.mark.parametrize("arguments, said", [
    (("--reference", "{tmp}/none.csv"), "no file at"),
    (("--reference", "{tmp}/empty.csv"), "empty"),
    (("--reference", "{tmp}/other.csv"), "no variable 'y'"),
    (("--reference", "{tmp}/ragged.csv"), "line 3 has 1 values"),
    (("--reference", "{tmp}/good.csv", "--tolerance", "a.x=big"), "write 1e-6"),
    (("--reference", "{tmp}/good.csv", "--tolerance", "-1"), "negative"),
    (("--reference", "{tmp}/good.csv", "--set", "a.x"), "component.variable=value"),
    (("--reference", "{tmp}/good.csv", "--set", "a.y=1"), "no variable 'y'"),
    (("--reference", "{tmp}/good.csv", "--duration", "0.2"), "the reference reaches from 0 to 1 s"),
])  # fmt: skip
def test_bad_check_is_bad_input(tmp_path, ring, arguments, said, capsys):
    (tmp_path / "empty.csv").write_text("")
    (tmp_path / "other.csv").write_text("time,a.y\n0,0\n")
    (tmp_path / "ragged.csv").write_text("time,a.x\n0,0\n1\n")
    (tmp_path / "good.csv").write_text("time,a.x\n0,0\n1,0\n")
    assert main(["check", str(ring), *(text.format(tmp=tmp_path) for text in arguments)]) == 2
    assert said in capsys.readouterr().err


def test_crash_of_an_isolated_unit_ends_with_1(ring, capsys):
    assert main(["run", str(ring), "--isolate", "--set", "b.mode=1"]) == 1
    assert "signal 11" in capsys.readouterr().err


def test_options_of_the_command_reach_the_master(tmp_path, ring, capsys):
    assert main(["run", str(ring), "--set", "a.x=1", "--step", "0.5", "--extrapolation", "1", "--step-control", "1e-3",
                 "--scheme", "jacobi", "--loops", "fixed-point", "--output", str(tmp_path / "r.nc"), "--json"]) == 0  # fmt: skip
    assert json.loads(capsys.readouterr().out)["steps accepted"] > 4
    assert main(["run", "--step", "0.1"]) == 2


def test_worst_place_is_named_and_nan_never_agrees():
    time = np.arange(5.0)
    series = {"time": time, "a.x": time.copy(), "a.y": np.full(5, math.nan)}
    reference = {"time": time, "a.x": np.array([0, 1, 2.5, 3, 4.0]), "a.y": np.zeros(5)}
    x, y = compare(series, reference, [parse_tolerance("0.05")])
    assert not x.passed and (x.time, x.difference, x.allowed) == (2.0, 0.5, 0.2)
    assert not y.passed
    assert compare(series, {"time": np.array([0.5]), "a.x": np.array([0.5])}, [])[0].passed
    with pytest.raises(InputFault, match="has no a.z"):
        compare(series, reference | {"a.z": time}, [])


def test_series_survive_both_formats(tmp_path):
    series = {"time": np.arange(3.0), "u.a": np.arange(12.0).reshape(3, 2, 2), "u.on": np.array([True, False, True])}
    units = {"u.a": "N", "u.on": "1"}
    files = [write_series(series, units, {}, tmp_path / f"s.{ending}") for ending in ("csv", "nc")]
    for file in files:
        back = read_series(file)
        assert back["u.a[2,1]"] == pytest.approx([2.0, 6.0, 10.0])
        assert back["u.on"] == pytest.approx([1, 0, 1])
