"""Fixtures: the two reducers that come with the software."""

import pytest

from fmu_src.link import compiler, host_platform
from fmu_src.native import NativeFault
from fmu_src.package import build_fmu, build_native
from orchestrator.reducer import load_reducer
from small_fmus import build_spring


@pytest.fixture(scope="session")
def rv20e():
    return load_reducer("RV20E-121")


@pytest.fixture(scope="session")
def bx40e():
    return load_reducer("BX-40E")


@pytest.fixture(scope="session")
def fmus(rv20e, tmp_path_factory):
    """Folder with both FMUs of the RV20E-121."""
    folder = tmp_path_factory.mktemp("fmus")
    for name, unit in (("RvPlant", "rv_plant"), ("RvWear", "wear_fmu")):
        build_fmu(name, rv20e.specification(unit), 1e-3, "rvwear test", folder)
    return folder


@pytest.fixture(scope="session")
def native_fmus(rv20e, tmp_path_factory):
    """Folder with the native FMUs of the RV20E-121 in its folders fmi2 and fmi3."""
    try:
        compiler(host_platform(), False)
    except NativeFault as fault:
        pytest.skip(f"no native FMUs: {fault}")
    folder = tmp_path_factory.mktemp("native")
    for name, unit in (("RvPlant", "rv_plant"), ("RvWear", "wear_fmu")):
        build_native(name, rv20e.specification(unit), 1e-3, "rvwear test", folder)
    return folder


@pytest.fixture(scope="session")
def spring(tmp_path_factory):
    """Path of a small FMU."""
    return build_spring(tmp_path_factory.mktemp("spring"))
