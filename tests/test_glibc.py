"""Native units of this machine load beside the C library of 2012: versions read from the binaries, numbers unchanged."""

import ctypes
import re
import shutil
import subprocess
import sys
import zipfile

import numpy as np
import pytest
from conftest import UNITS

from fmu_src import glibc
from fmu_src.audit import Elf, require_only_system_libraries
from fmu_src.link import host_platform
from fmu_src.native import NativeFault

pytestmark = pytest.mark.skipif(not sys.platform.startswith("linux"), reason="versions of symbols are a matter of Linux")


@pytest.fixture(params=[f"{version}/{name}" for version in ("fmi2", "fmi3") for name in UNITS])
def library(request, native_fmus):
    with zipfile.ZipFile(native_fmus / f"{request.param}.fmu") as archive:
        (name,) = (n for n in archive.namelist() if n.startswith("binaries/"))
        return archive.read(name)


def test_units_ask_for_nothing_newer_than_glibc_2_17(library):
    versions = Elf(library).versions
    assert any("exp" in symbols for symbols in versions.values())
    assert max(map(glibc.number_of, versions)) <= (2, 17)


@pytest.mark.skipif(shutil.which("readelf") is None, reason="no readelf")
def test_versions_are_those_that_readelf_reads(library, tmp_path):
    (tmp_path / "unit.so").write_bytes(library)
    said = subprocess.run(["readelf", "--dyn-syms", "-W", tmp_path / "unit.so"], capture_output=True, text=True).stdout
    theirs = set(re.findall(r"UND (\w+)@(\w+(?:\.\d+)*)", said))
    assert theirs == {(symbol, version) for version, symbols in Elf(library).versions.items() for symbol in symbols}


@pytest.mark.skipif(shutil.which("cc") is None, reason="a C compiler")
def test_library_of_a_newer_system_is_refused_with_the_remedy(tmp_path):
    (tmp_path / "new.c").write_text("double exp(double x);\ndouble fmi2Exp(double x)\n{\n    return exp(x);\n}\n")
    command = ["cc", "-O2", "-shared", "-fPIC", "-nostartfiles", "new.c", "-o", "new.so", "-lm"]
    subprocess.run(command, cwd=tmp_path, check=True)
    new = (tmp_path / "new.so").read_bytes()
    if max(map(glibc.number_of, Elf(new).versions), default=()) <= glibc.OLDEST:
        pytest.skip("the C library here is old itself")
    with pytest.raises(NativeFault, match=r"RvPlant needs GLIBC_2\.29 \(exp\).*load from 2\.17 on.*rvwear\[build\]"):
        require_only_system_libraries(new, "RvPlant")


@pytest.mark.parametrize("version, number", [
    ("GLIBC_2.2.5", (2, 2, 5)), ("GLIBC_2.17", (2, 17)), ("GLIBC_2.38", (2, 38)), ("GLIBC_ABI_DT_RELR", (99,)), ("GCC_3.0", ()),
])
def test_versions_are_compared_as_numbers(version, number):
    assert glibc.number_of(version) == number


@pytest.mark.parametrize("name", glibc.RENEWED)
def test_oldest_version_gives_the_newest_ones_bits(name):
    if not glibc.can_name_versions(host_platform().name):
        pytest.skip("another C library")
    mathematics = ctypes.CDLL("libm.so.6")
    dlvsym = ctypes.CDLL(None).dlvsym
    dlvsym.restype, dlvsym.argtypes = ctypes.c_void_p, [ctypes.c_void_p, ctypes.c_char_p, ctypes.c_char_p]
    address = dlvsym(mathematics._handle, name.encode(), glibc.FIRST_VERSION[host_platform().name].encode())
    kind = ctypes.CFUNCTYPE(ctypes.c_double, *[ctypes.c_double] * glibc.RENEWED[name])
    old, new = kind(address), kind(ctypes.cast(getattr(mathematics, name), ctypes.c_void_p).value)
    spread = np.random.default_rng(1).uniform(-50.0, 50.0, (5000, glibc.RENEWED[name]))
    numbers = np.concatenate([spread, np.abs(spread), [[0.0], [1e308], [1e-310]] * np.ones(glibc.RENEWED[name])])
    theirs = np.array([[call(*row) for call in (old, new)] for row in numbers])
    assert np.array_equal(theirs[:, 0], theirs[:, 1], equal_nan=True)
