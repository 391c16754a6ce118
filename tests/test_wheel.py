"""The wheel: everything is in it, and everything works where it is installed, far from any checkout."""

import json
import os
import shutil
import subprocess
import sys
import tarfile
import venv
import zipfile
from pathlib import Path

import pytest

from cli.commands.example import EXAMPLES
from fmu_src.project import project
from fmu_src.source_hash import source_hash

ROOT = Path(__file__).resolve().parents[1]
PRODUCT = sorted({path.parent.name for path in ROOT.glob("*/__init__.py")} - {"benchmarks"})
LITTER = {".pyc", ".pyo"}


def files_below(folder, name):
    """Files of a folder, as the wheel should have them under ``name``."""
    return {f"{name}/{path.relative_to(folder).as_posix()}" for path in folder.rglob("*") if path.is_file() and path.suffix not in LITTER}


def made(folder, source, kind):
    """The wheel or sdist of a copy of the sources; setuptools alone, nothing is fetched."""
    script = f"import sys; from setuptools.build_meta import build_{kind}; print(build_{kind}(sys.argv[1]))"
    done = subprocess.run([sys.executable, "-c", script, str(folder)], cwd=source, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return folder / done.stdout.split()[-1]


@pytest.fixture(scope="module")
def sources(tmp_path_factory):
    """A copy: a build leaves its own folders behind."""
    folder = tmp_path_factory.mktemp("sources")
    for name in (*PRODUCT, "examples"):
        shutil.copytree(ROOT / name, folder / name)
    for path in ROOT.iterdir():
        if path.is_file():
            shutil.copyfile(path, folder / path.name)
    # What was imported and what was looked at leaves things behind, too.
    for name in ("cli", "examples"):
        (folder / name / "__pycache__").mkdir(exist_ok=True)
        (folder / name / "__pycache__" / "some.cpython-311.pyc").write_bytes(b"")
    return folder


@pytest.fixture(scope="module")
def wheel(sources, tmp_path_factory):
    return made(tmp_path_factory.mktemp("wheel"), sources, "wheel")


def names_of(wheel):
    with zipfile.ZipFile(wheel) as archive:
        return {name for name in archive.namelist() if ".dist-info/" not in name}


def test_every_file_is_in_the_wheel_and_nothing_else(sources, wheel):
    wanted = {name for part in PRODUCT for name in files_below(sources / part, part)}
    assert names_of(wheel) == wanted | files_below(sources / "examples", "rvwear_examples")


def test_every_example_can_be_asked_for():
    entries = {path.name for path in (ROOT / "examples").iterdir() if path.name != "__pycache__"}
    assert entries == EXAMPLES.keys()


@pytest.mark.campaign
def test_wheel_of_the_sdist_is_the_same(sources, wheel, tmp_path):
    with tarfile.open(made(tmp_path, sources, "sdist")) as archive:
        archive.extractall(tmp_path, filter="data")
    (unpacked,) = (path for path in tmp_path.iterdir() if path.is_dir())
    assert names_of(made(tmp_path, unpacked, "wheel")) == names_of(wheel)


@pytest.fixture(scope="module")
def installed(wheel, tmp_path_factory):
    """A fresh environment with the wheel, and beside it what this one has, but not the project."""
    folder = tmp_path_factory.mktemp("installed") / "environment"
    venv.create(folder)
    scripts = folder / ("Scripts" if os.name == "nt" else "bin")
    pip = [sys.executable, "-m", "pip", "--disable-pip-version-check", "--python", scripts / "python"]
    subprocess.run([*pip, "install", "--quiet", "--no-deps", "--no-index", "--no-compile", wheel], check=True)
    own = Path(subprocess.run([scripts / "python", "-c", "import sysconfig; print(sysconfig.get_path('purelib'))"],
                              capture_output=True, text=True, check=True).stdout.strip())  # fmt: skip
    # Folders alone: what .pth files of theirs bring along, the checkout for instance, stays away.
    theirs = dict.fromkeys(path for path in sys.path if "packages" in Path(path).name)
    (own / "others.pth").write_text("\n".join(theirs), encoding="utf-8")
    # What other people's wheels leave there.
    (own / "examples").mkdir()
    (own / "pyproject.toml").write_text('[project]\nname = "other"\nversion = "9"\n', encoding="utf-8")
    return scripts


@pytest.fixture(scope="module")
def ran(installed, tmp_path_factory):
    """Runs a command of the installed wheel in an empty folder, and those after it in the same."""
    folder = tmp_path_factory.mktemp("outside")
    environment = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "RVWEAR_EFFECTS")}

    def run(*command, below=".", **more):
        program = [installed / command[0], *command[1:]]
        done = subprocess.run(program, cwd=folder / below, capture_output=True, encoding="utf-8", env=environment | more)
        assert done.returncode == 0, f"{command}: {done.stdout}\n{done.stderr}"
        return done.stdout

    run.folder = folder
    return run


FINDS = "import cli, fmu_src.source_hash as s; print(cli.__file__); print(s.source_hash())"


@pytest.mark.campaign
def test_installed_is_the_wheel_with_the_same_sources(ran, installed):
    file, digest = ran("python", "-c", FINDS).split()
    assert Path(file).is_relative_to(installed.parent)
    assert digest == source_hash()
    assert ran("rvwear", "--version") == ran("python", "-m", "cli", "--version") == f"rvwear {project().version}\n"


@pytest.mark.campaign
@pytest.mark.parametrize("command", [
    "solve --reducer BX-40E", "hysteresis", "modes", "run --turns 0.2", "life --hours 60 --positions 8", "effects", "completion bash",
    "effects needle_clearance --html effect.html", "dynamics-wear --hours 1 --cycles 1 --speeds 1", "reproduce T01",
    "campaign template bench", "doctor", "schema reducer", "reducer list", "hysteresis --steps 4 --angles 1 --export loop.mat",
])  # fmt: skip
def test_commands(ran, command):
    assert ran("rvwear", *command.split())


@pytest.mark.campaign
def test_the_front_door_opens(ran):
    script = "import rvwear; print(rvwear.__version__, *rvwear.hysteresis(steps=4, angles=1)['torque'].dims); print(*rvwear.reducers())"
    assert ran("python", "-c", script).startswith(f"{project().version} step\nBX-40E")


@pytest.mark.campaign
def test_results_have_pages(ran):
    ran("rvwear", "life", "--hours", "60", "--positions", "8", "--output", "again.nc", "--no-report")
    ran("rvwear", "report", "again.nc")
    assert (ran.folder / "again.html").stat().st_size > 1e6


@pytest.fixture(scope="module")
def built(ran):
    """FMUs of all flavours."""
    made = json.loads(ran("rvwear", "build", "--output", "dist", "--json"))["fmus"]
    assert {Path(entry["fmu"]).parent.name for entry in made} >= {"dist"}
    return made


@pytest.mark.campaign
def test_fmus_are_those_of_the_checkout(ran, built, tmp_path):
    environment = os.environ | {"PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-m", "cli", "build", "--output", str(tmp_path)]
    subprocess.run(command, cwd=tmp_path, env=environment, check=True, capture_output=True)
    for entry in built:
        path = Path(entry["fmu"])
        assert (ran.folder / path).read_bytes() == (tmp_path / path.relative_to("dist")).read_bytes()


@pytest.mark.campaign
def test_fmus_run(ran, built):
    for name in ("pair", "five_lines"):
        ran("rvwear", "example", name)
    ran("rvwear", "run", "examples/pair.toml", "--output", "pair.nc")
    assert "deepest flank" in ran("python", "examples/five_lines.py")
    assert ran("rvwear", "check", "examples/pair.toml", "--reference", "pair.nc", "--isolate")
    assert ran("rvwear", "life", "--fmus", "dist", "--hours", "60", "--positions", "8", "--output", "fmus.nc")
    for entry in built:
        ran("rvwear", "run", entry["fmu"], "--duration", "0.01", "--step", "0.001", "--output", "unit.nc")


@pytest.mark.campaign
def test_a_campaign_is_diagnosed_and_the_model_extended(ran):
    ran("rvwear", "example", "hidden_effect")
    below = "examples/hidden_effect"
    ran("rvwear", "campaign", "check", "campaign", below=below)
    ran("rvwear", "compare", "RV20E-121-rigid", "campaign", "--html", "compare.html", below=below)
    ran("rvwear", "extend", "RV20E-121-rigid", "campaign", "--effect", "thermal_expansion.expansion", "--output", "better.toml", below=below)
    ran("rvwear", "ladder", "better.toml", "--html", "ladder.html", below=below)
    ran("rvwear", "example", "raceway_depths")
    ran("rvwear", "diagnose", "RV20E-121-rigid", "examples/raceway_depths", "--html", "diagnosis.html")
    ran("rvwear", "next", "RV20E-121-rigid", "examples/raceway_depths", "--html", "next.html")


@pytest.mark.campaign
def test_an_ensemble_runs(ran):
    ran("rvwear", "example", "ensemble")
    path = ran.folder / "examples" / "ensemble.toml"
    path.write_text(path.read_text(encoding="utf-8").replace("hours = 6000", "hours = 100"), encoding="utf-8")
    assert "10 of 10" in ran("rvwear", "ensemble", "examples/ensemble.toml", "--samples", "2", "--jobs", "2")
