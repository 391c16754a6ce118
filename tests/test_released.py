"""Results, checkpoints and states that released versions wrote: they open as what they are, or are refused with the reason.

``tests/released/VERSION`` holds a life of the RV20E-121 over 20 h with its last checkpoint, and a state of RvPlant, written by that version.
"""

import lzma
from pathlib import Path

import numpy as np
import pytest

from cli.main import main
from fmu_src.faults import RunFault
from orchestrator import netcdf
from orchestrator.opening import open_fmu

RELEASED = Path(__file__).parent / "released"
VERSIONS = sorted(path.name for path in RELEASED.iterdir())


@pytest.fixture(params=VERSIONS)
def version(request):
    return RELEASED / request.param


@pytest.fixture
def result(version, tmp_path):
    (tmp_path / "life.nc").write_bytes(lzma.decompress((version / "life.nc.xz").read_bytes()))
    return tmp_path / "life.nc"


def test_there_are_files_of_every_version_before_this_one():
    assert VERSIONS == ["0.1.0", "0.2.0"]


def test_result_opens_with_the_figures_that_it_had_and_makes_a_page(result, capsys):
    dataset = netcdf.read(result)
    assert dataset.attrs["title"] == "wear of RV20E-121 over 20 h" and float(dataset["hour"][-1]) == pytest.approx(20.0)
    assert float(dataset["disc_flank_um"][-1]) == pytest.approx(1e6 * float(np.max(dataset["disc_wear"][-1])), rel=1e-2)
    assert 0.01 < float(dataset["disc_flank_um"][-1]) < 1.0
    assert main(["report", str(result)]) == 0
    assert "RV20E-121" in result.with_suffix(".html").read_text(encoding="utf-8")[:5000]


def test_checkpoint_is_refused_with_the_reason(version, tmp_path, capsys):
    (tmp_path / "life.checkpoint").write_bytes((version / "life.checkpoint").read_bytes())
    assert main(["life", "--hours", "20", "--resume", "--output", str(tmp_path / "life.nc")]) == 2
    assert "of another kind or version" in capsys.readouterr().err and not (tmp_path / "life.nc").exists()


def test_state_is_refused_with_the_reason(version, native_fmus):
    plant = open_fmu("plant", native_fmus / "fmi2" / "RvPlant.fmu")
    plant.enter_initialisation(0.0)
    plant.exit_initialisation()
    before = plant.save()
    with pytest.raises(RunFault, match="the state is of unit .*: it must come from the same build|not a state of this kind of unit"):
        plant.restore((version / "plant.state").read_bytes())
    assert plant.save() == before
    plant.close()
