"""What lies in the archive of a native FMU: the same bytes twice, a library that needs little, and calls in any order."""

import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from conftest import UNITS

from benchmarks import fuzz
from fmu_src import audit
from fmu_src.compiler.loading import LIBM
from fmu_src.link import FMI_HEADERS
from fmu_src.package import build_native
from orchestrator.component import InProcess

ROOT = Path(__file__).resolve().parents[1]


@pytest.fixture(params=[(v, n) for v in ("fmi2", "fmi3") for n in UNITS], ids="-".join)
def path(request, native_fmus):
    return native_fmus / request.param[0] / f"{request.param[1]}.fmu"


@pytest.mark.parametrize("name", UNITS)
def test_two_builds_are_byte_equal(name, rv20e, codes, native_fmus, tmp_path):
    specification = rv20e.specification(UNITS[name])
    for again in build_native(name, specification, 1e-3, "rvwear test", tmp_path, codes=codes[name]):
        assert again.read_bytes() == (native_fmus / again.relative_to(tmp_path)).read_bytes()


def test_library_needs_nothing_but_c_and_mathematics(path):
    for library in libraries(path):
        imported = {name.lstrip("_") for name in audit.imported_symbols(library)}
        assert imported <= LIBM | {"calloc", "malloc", "free", "snprintf", "vsnprintf", "memcmp", "strcmp", "strlen", "strcpy", "strncpy"}
        assert len(audit.exported_symbols(library)) > 100


@pytest.mark.skipif(shutil.which("readelf") is None, reason="no readelf")
def test_audit_agrees_with_readelf(path, tmp_path):
    library = tmp_path / "unit.so"
    library.write_bytes(libraries(path)[0])
    said = subprocess.run(["readelf", "-d", "--dyn-syms", "-W", library], capture_output=True, text=True).stdout
    lines = [line.split() for line in said.splitlines()]
    assert {w[-1].strip("[]") for w in lines if "(NEEDED)" in w} == audit.needed_libraries(library.read_bytes())
    undefined = {w[7].partition("@")[0] for w in lines if len(w) >= 8 and w[6] == "UND"}
    assert undefined == audit.imported_symbols(library.read_bytes())


def libraries(path) -> list[bytes]:
    with zipfile.ZipFile(path) as archive:
        return [archive.read(name) for name in archive.namelist() if name.startswith("binaries/")]


@pytest.mark.skipif(not sys.platform.startswith("linux") or shutil.which("cc") is None, reason="a C compiler on Linux")
def test_c_program_runs_the_unit_without_python(rv20e, native_fmus, tmp_path):
    with zipfile.ZipFile(native_fmus / "fmi2" / "RvPlant.fmu") as archive:
        archive.extractall(tmp_path / "plant")
    source, program = ROOT / "examples" / "load_fmu.c", tmp_path / "load_fmu"
    subprocess.run(["cc", "-Wall", "-Werror", f"-I{FMI_HEADERS}", source, "-o", program, "-ldl"], check=True)
    library = next((tmp_path / "plant" / "binaries").glob("*/*"))
    done = subprocess.run([program, "plant", f"{library.parent.name}/{library.name}"], cwd=tmp_path, capture_output=True,
                          text=True, env={"PATH": os.devnull})
    assert done.returncode == 0, done.stderr
    inside = InProcess("plant", rv20e.specification("rv_plant"))
    inside.set("bearing_clearance", 3e-6)
    inside.enter_initialisation(0.0)
    inside.exit_initialisation()
    for n in range(100):
        inside.step(1e-3 * n, 1e-3)
    force = inside.get("mesh_force[1,30]")
    assert force > 0.0 and done.stdout.splitlines()[-1] == f"0.100 s  lag {inside.get('lag'):.17g} rad  force {force:.17g} N"


@pytest.fixture(scope="module")
def fuzzers(tmp_path_factory):
    """Folder in which the fuzzers have the instrumented shell in common."""
    return tmp_path_factory.mktemp("fuzzers")


def call_at_random(folder, unit, seconds, seed):
    try:
        fuzzer = fuzz.build(unit, folder)
    except (subprocess.CalledProcessError, FileNotFoundError):
        pytest.skip("no C compiler with sanitizers")
    done = subprocess.run([fuzzer, str(seconds), str(seed)], cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr[-3000:]


@pytest.mark.parametrize("unit", fuzz.UNITS)
def test_random_calls_under_the_sanitizers(fuzzers, unit):
    call_at_random(fuzzers, unit, 1, 5)


@pytest.mark.campaign
@pytest.mark.parametrize("seed", [6, 7])
@pytest.mark.parametrize("unit", fuzz.UNITS)
def test_minutes_of_random_calls_under_the_sanitizers(fuzzers, unit, seed):
    call_at_random(fuzzers, unit, 90, seed)
