"""Fixtures: the two reducers that come with the software."""

import pytest

from fmu_src.link import compiler, host_platform
from fmu_src.native import NativeFault, host_triple, object_codes
from fmu_src.package import build_fmu, build_native, triples_for
from orchestrator.reducer import load_reducer
from small_fmus import build_spring


@pytest.fixture(scope="session")
def rv20e():
    return load_reducer("RV20E-121")


@pytest.fixture(scope="session")
def bx40e():
    return load_reducer("BX-40E")


UNITS = {"RvPlant": "rv_plant", "RvWear": "wear_fmu"}


@pytest.fixture(scope="session")
def codes(rv20e):
    """Object code of both units of the RV20E-121 for this machine, by unit and triple."""
    return {name: object_codes(rv20e.specification(unit), triples_for(False)) for name, unit in UNITS.items()}


@pytest.fixture(scope="session")
def fmus(rv20e, codes, tmp_path_factory):
    """Folder with both editable FMUs of the RV20E-121."""
    folder = tmp_path_factory.mktemp("fmus")
    for name, unit in UNITS.items():
        build_fmu(name, rv20e.specification(unit), 1e-3, "rvwear test", folder, codes[name][host_triple()])
    return folder


@pytest.fixture(scope="session")
def native_fmus(rv20e, codes, tmp_path_factory):
    """Folder with the folders fmi2 and fmi3 of the native FMUs of the RV20E-121, for this machine."""
    try:
        compiler(host_platform(), False)
    except NativeFault as fault:
        pytest.skip(f"no native FMUs: {fault}")
    folder = tmp_path_factory.mktemp("native")
    for name, unit in UNITS.items():
        build_native(name, rv20e.specification(unit), 1e-3, "rvwear test", folder, codes=codes[name])
    return folder


@pytest.fixture(scope="session")
def spring(tmp_path_factory):
    """Path of a small FMU."""
    return build_spring(tmp_path_factory.mktemp("spring"))
