"""The C master of FMI 3.0 units (examples/pair_master.c): whole arrays connected, the numbers of rvwear run, sound memory, plain words."""

import re
import shutil
import subprocess
import sys
import zipfile

import pytest

from fmu_src.link import FMI_HEADERS
from fmu_src.source_hash import ROOT
from orchestrator.fmu import Fmu
from orchestrator.master import Master
from studies.pair import CONNECTIONS

pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux") or shutil.which("cc") is None, reason="a C compiler on Linux")
STEP, STEPS, ACCELERATION = 1.3e-3, 40, 1e6
DEPTHS = ("flank.depth", "inner_race.depth", "outer_race.depth")


def compiled(folder, *options):
    command = ["cc", "-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Werror", *options, f"-I{FMI_HEADERS}", ROOT / "examples" / "pair_master.c",
               "-o", folder / "pair_master", "-ldl"]  # fmt: skip
    return subprocess.run(command, capture_output=True, text=True)


@pytest.fixture
def folder(native_fmus, tmp_path):
    """Folder with both units unpacked and the program."""
    for name in ("plant", "wear"):
        with zipfile.ZipFile(native_fmus / "fmi3" / f"Rv{name.title()}.fmu") as archive:
            archive.extractall(tmp_path / name)
    done = compiled(tmp_path)
    assert done.returncode == 0, done.stderr
    return tmp_path


def run(folder, *arguments):
    return subprocess.run(["./pair_master", *map(str, arguments)], cwd=folder, capture_output=True, text=True, timeout=60, env={})


@pytest.mark.parametrize("scheme", ["gauss-seidel", "jacobi"])
def test_depths_are_those_of_the_master_to_all_digits(folder, native_fmus, scheme):
    done = run(folder, "plant", "wear", scheme, STEP, STEPS, ACCELERATION)
    assert done.returncode == 0, done.stderr
    theirs = {name: [float(value) for value in re.findall(rf"wear\.{re.escape(name)}\[\d+\] = (\S+) m", done.stdout)] for name in DEPTHS}
    units = {name: Fmu(name, native_fmus / "fmi3" / f"Rv{name.title()}.fmu") for name in ("plant", "wear")}
    units["wear"].set("acceleration", ACCELERATION)
    master = Master(units, CONNECTIONS, STEP, scheme=scheme)
    master.initialise()
    master.run(STEPS)
    ours = {name: units["wear"].get(name).ravel().tolist() for name in DEPTHS}
    master.close()
    assert theirs == ours and min(ours["flank.depth"]) > 1e-8


def test_memory_is_sound(folder):
    done = compiled(folder, "-g", "-fsanitize=address,undefined", "-fno-sanitize-recover=all")
    if done.returncode != 0:
        pytest.skip("the C compiler has no sanitizers")
    done = run(folder, "plant", "wear", "jacobi", STEP, 5)
    assert done.returncode == 0, done.stderr[-3000:]
    assert done.stdout.count(" m\n") == 10


@pytest.mark.parametrize("arguments, said", [
    (("plant",), r"pair_master PLANT WEAR \[gauss-seidel\|jacobi"),
    (("plant", "wear", "fixed"), "scheme = fixed: give gauss-seidel or jacobi"),
    (("plant", "wear", "jacobi", "-1e-3"), "step = -1e-3: a positive time in s is needed"),
    (("plant", "wear", "jacobi", "1e-3", "few"), "steps = few: a positive whole number is needed"),
    (("plant", "wear", "jacobi", "1e-3", "2", "0"), "acceleration = 0: a positive number"),
    (("plant", "none"), "wear: cannot read none/modelDescription.xml"),
    (("wear", "plant"), "plant: cannot load its library: .*RvPlant.so"),
    (("plant", "wear", "jacobi", "4000"), "DoStep.*refused"),
])
def test_bad_input_is_told(folder, arguments, said):
    done = run(folder, *arguments)
    assert done.returncode in (1, 2) and re.search(said, done.stderr, re.DOTALL), done.stderr
