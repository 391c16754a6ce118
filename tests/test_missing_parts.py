"""Optional parts that are not installed: nothing else needs them, and what does asks for them by name."""

import json
import os
import subprocess
import sys

import pytest
import scipy.io

from discrepancy.campaign.file_format import FILE

PARTS = ("SALib", "asammdf", "dask", "distributed", "h5py", "joblib", "matplotlib", "nptdms", "openpyxl", "pyarrow", "wasmtime", "ziglang")
SCRIPT = """
import contextlib, io, json, os, sys
for name in {parts}:
    sys.modules[name] = None
sys.path.insert(0, sys.argv[2])
os.environ["PATH"] = os.devnull
from cli.main import main

found = []
for command in json.loads(sys.argv[1]):
    if command[0] == "ensemble" and "--jobs" in command:
        # As if drawing were possible, so that the missing processes show.
        import types
        for name in ("SALib", "SALib.sample", "SALib.sample.sobol", "SALib.analyze", "SALib.analyze.sobol"):
            sys.modules[name] = types.ModuleType(name)
        sys.modules["SALib.sample"].sobol = sys.modules["SALib.sample.sobol"]
        sys.modules["SALib.analyze"].sobol = sys.modules["SALib.analyze.sobol"]
        import numpy
        sys.modules["SALib.sample.sobol"].sample = lambda problem, n, **_: numpy.full((5 * n, problem["num_vars"]), 0.5)
    out, err = io.StringIO(), io.StringIO()
    with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
        code = main(command)
    # How far it is, which a slow machine tells, is no complaint.
    said = "".join(line for line in err.getvalue().splitlines(True) if not line.startswith("rvwear: "))
    found.append((code, said))
print(json.dumps(found))
"""


def without_parts(folder, *commands):
    """(exit code, what went to stderr) of commands, run in a folder by a Python that lacks all optional parts."""
    script = SCRIPT.format(parts=PARTS)
    # Processes that it starts have its path: there, too, they are missing.
    missing = folder / "missing"
    missing.mkdir(exist_ok=True)
    for name in PARTS:
        (missing / f"{name}.py").write_text(f"raise ModuleNotFoundError(name={name!r})", encoding="utf-8")
    done = subprocess.run([sys.executable, "-c", script, json.dumps(commands), str(missing)], cwd=folder, capture_output=True, text=True,
                          check=True, env=os.environ | {"PYTHONPATH": os.pathsep.join(filter(None, sys.path))})  # fmt: skip
    return json.loads(done.stdout)


@pytest.fixture(scope="module")
def found(tmp_path_factory):
    """Results by command: those that need an optional part, and some that need none."""
    folder = tmp_path_factory.mktemp("parts")
    ((code, text),) = without_parts(folder, ["campaign", "template", "plain", "--quantities", "input_torque"])
    assert code == 0, text
    plain = (folder / "plain" / FILE).read_text(encoding="utf-8")
    # A name of a file, and what stands in it.
    contents = {"mf4": b"MDF     4.10", "tdms": b"TDSm", "parquet": b"PAR1", "xlsx": b"PK", "hdf.mat": 512 * b" " + b"\x89HDF\r\n\x1a\n"}
    commands = {"csv": ["campaign", "check", "plain"]}
    for ending, content in contents.items():
        (folder / ending).mkdir()
        (folder / ending / FILE).write_text(plain.replace(".csv", f".{ending}"), encoding="utf-8")
        for path in (folder / "plain").glob("*.csv"):
            (folder / ending / path.name).with_suffix(f".{ending}").write_bytes(content)
        commands[ending] = ["campaign", "check", ending]
    commands["template"] = ["campaign", "template", "new", "--format", "parquet"]
    (folder / "ensemble.toml").write_text(
        'reducer = "RV20E-121"\nsamples = 2\nhours = 1\n[parameters]\n'
        'bearing_clearance = { distribution = "uniform", low = 2, high = 3, unit = "um" }\n', encoding="utf-8"
    )  # fmt: skip
    commands["drawing"] = ["ensemble", "ensemble.toml"]
    commands["processes"] = ["ensemble", "ensemble.toml", "--jobs", "2"]
    commands["cluster"] = ["ensemble", "ensemble.toml", "--jobs", "2", "--backend", "dask", "--scheduler", "tcp://localhost:1"]
    commands["platforms"] = ["build", "--all-platforms"]
    commands["sheet"] = ["hysteresis", "--export", "a.xlsx"]
    commands["picture"] = ["hysteresis", "--picture", "a.svg"]
    commands["both"] = ["hysteresis", "--picture", "a.svg", "--export", "a.parquet", "--export", "a.xlsx", "--export", "b.xlsx"]
    commands["solve"] = ["solve", "--positions", "8"]
    commands["effects"] = ["effects"]
    return dict(zip(commands, without_parts(folder, *commands.values()), strict=True)) | {"folder": folder}


@pytest.mark.parametrize("command, package, part", [
    ("mf4", "asammdf", "measurements"), ("tdms", "nptdms", "measurements"), ("parquet", "pyarrow", "measurements"), ("xlsx", "openpyxl", "measurements"),
    ("hdf.mat", "h5py", "measurements"), ("template", "pyarrow", "measurements"), ("drawing", "SALib", "ensembles"),
    ("processes", "joblib", "ensembles"), ("cluster", "distributed", "ensembles"), ("platforms", "zig", "build"),
    ("sheet", "openpyxl", "measurements"), ("picture", "matplotlib", "pictures"),
])  # fmt: skip
def test_a_missing_part_is_asked_for_by_name(found, command, package, part):
    code, text = found[command]
    assert code == 2
    assert package in text and f'pip install "rvwear[{part}]"' in text
    assert "Traceback" not in text


def test_all_that_a_command_lacks_is_named_at_once(found):
    code, text = found["both"]
    assert code == 2 and 'pip install "rvwear[measurements,pictures]"' in text
    assert "--export a.parquet needs pyarrow, --export a.xlsx needs openpyxl, --picture a.svg needs matplotlib" in " ".join(text.split())


def test_nothing_is_written_before_the_part_is_missed(found):
    assert not (found["folder"] / "new").exists()


@pytest.mark.parametrize("command", ["solve", "effects"])
def test_other_commands_need_none(found, command):
    assert found[command] == [0, ""]


def test_csv_needs_none(found):
    # An empty campaign allows no diagnosis.
    assert found["csv"] == [1, ""]


def test_old_mat_files_need_none(tmp_path):
    scipy.io.savemat(tmp_path / "old.mat", {"te": [1.0, 2.0]})
    script = (
        "import sys\nsys.modules['h5py'] = None\nfrom pathlib import Path\n"
        "from discrepancy.campaign.readers import Options, read_columns\n"
        "print(read_columns(Path('old.mat'), {'te'}, Options(), 'run')['te'].sum())"
    )
    environment = os.environ | {"PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    done = subprocess.run([sys.executable, "-c", script], cwd=tmp_path, capture_output=True, text=True, env=environment, check=True)
    assert done.stdout == "3.0\n"
