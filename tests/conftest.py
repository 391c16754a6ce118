"""Fixtures: the two reducers that come with the software."""

import pytest

from fmu_src.package import build_fmu
from orchestrator.reducer import load_reducer


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
