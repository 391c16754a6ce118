"""Native FMUs of all platforms in one archive: needs zig; runs Windows under wine and Arm under qemu where they are.

    pytest -m platforms
"""

import re
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import fmpy.validation
import pytest
from conftest import UNITS

from fmu_src import audit
from fmu_src.link import FMI_HEADERS, zig
from fmu_src.package import build_native

pytestmark = [pytest.mark.platforms, pytest.mark.skipif(zig() is None, reason='no zig: pip install "rvwear[build]"')]
EXAMPLE = Path(__file__).resolve().parents[1] / "examples" / "load_fmu.c"


@pytest.fixture(scope="module")
def everywhere(rv20e, tmp_path_factory):
    """Folder with the native FMUs of all platforms."""
    folder = tmp_path_factory.mktemp("everywhere")
    for name, unit in UNITS.items():
        build_native(name, rv20e.specification(unit), 1e-3, "rvwear test", folder, all_platforms=True)
    return folder


@pytest.fixture(scope="module")
def unpacked(everywhere):
    """Folder with RvPlant, FMI 2.0, unpacked as "plant"."""
    with zipfile.ZipFile(everywhere / "fmi2" / "RvPlant.fmu") as archive:
        archive.extractall(everywhere / "plant")
    return everywhere


def trajectory(folder, target, program, library, *runner) -> list[float]:
    """What the example prints for a platform's library, run by a command."""
    options = [] if target.startswith("x86_64-windows") else ["-ldl"]
    command = [sys.executable, "-m", "ziglang", "cc", "-target", target, f"-I{FMI_HEADERS}", EXAMPLE, "-o", program, *options]
    subprocess.run(command, cwd=folder, check=True)
    done = subprocess.run([*runner, f"./{program}", "plant", library], cwd=folder, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    values = [float(text) for text in re.findall(r"lag (\S+) rad", done.stdout)]
    assert len(values) == 100
    return values


@pytest.fixture(scope="module")
def here(unpacked):
    return trajectory(unpacked, "x86_64-linux-gnu.2.17", "load_fmu", "linux64/RvPlant.so")


@pytest.mark.parametrize("version, count", [("fmi2", 4), ("fmi3", 5)])
@pytest.mark.parametrize("name", UNITS)
def test_one_archive_has_all_platforms(everywhere, version, count, name):
    path = everywhere / version / f"{name}.fmu"
    assert fmpy.validation.validate_fmu(str(path)) == []
    with zipfile.ZipFile(path) as archive:
        binaries = [archive.read(n) for n in archive.namelist() if n.startswith("binaries/")]
    assert len(binaries) == count
    for library in binaries:
        if library[:4] != b"\xca\xfe\xba\xbe":
            audit.require_only_system_libraries(library, name)


@pytest.mark.parametrize("name", UNITS)
def test_two_builds_are_byte_equal(everywhere, rv20e, tmp_path, name):
    for again in build_native(name, rv20e.specification(UNITS[name]), 1e-3, "rvwear test", tmp_path, all_platforms=True):
        assert again.read_bytes() == (everywhere / again.relative_to(tmp_path)).read_bytes()


def test_universal_library_holds_both_processors(everywhere):
    with zipfile.ZipFile(everywhere / "fmi2" / "RvPlant.fmu") as two, zipfile.ZipFile(everywhere / "fmi3" / "RvPlant.fmu") as three:
        both = two.read("binaries/darwin64/RvPlant.dylib")
        for processor in ("x86_64", "aarch64"):
            assert three.read(f"binaries/{processor}-darwin/RvPlant.dylib") in both


@pytest.mark.skipif(shutil.which("wine") is None, reason="no wine")
def test_windows_library_agrees_under_wine(unpacked, here):
    there = trajectory(unpacked, "x86_64-windows-gnu", "load_fmu.exe", "win64/RvPlant.dll", "wine")
    # Windows has its own pow.
    assert there == pytest.approx(here, rel=1e-10)


@pytest.mark.skipif(shutil.which("qemu-aarch64") is None or not Path("/usr/aarch64-linux-gnu").exists(), reason="no qemu-user")
def test_arm_library_is_bit_equal_under_qemu(unpacked, here):
    there = trajectory(unpacked, "aarch64-linux-gnu.2.17", "load_fmu_arm", "aarch64-linux/RvPlant.so", "qemu-aarch64", "-L",
                       "/usr/aarch64-linux-gnu")
    assert there == here
