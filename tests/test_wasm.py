"""Units as WebAssembly components (draft FMI-LS-WASM): valid, sandboxed, the same bits as C with the same libm."""

import shutil
import subprocess
import zipfile
from pathlib import Path
from xml.etree import ElementTree

import numpy as np
import pytest

from cli.main import main
from fmu_src.faults import InputFault, MissingPart, RunFault
from fmu_src.link import zig
from fmu_src.package import build_native, build_source
from fmu_src.unit import make_unit
from fmu_src.verification import verify
from fmu_src.wasm import interface
from fmu_src.wasm.encoding import number, type_index
from orchestrator import wasm
from orchestrator.opening import open_fmu

try:
    import wasmtime
except ImportError:
    wasmtime = None

HERE = Path(__file__).parent
UNITS = {"RvPlant": "rv_plant", "RvWear": "wear_fmu", "RvReducer": "rv_reducer"}
built = [
    pytest.mark.platforms,
    pytest.mark.skipif(zig() is None, reason='no zig: pip install "rvwear[build]"'),
    pytest.mark.skipif(wasmtime is None, reason='no wasmtime: pip install "rvwear[wasm]"'),
]


def with_wasm(test):
    for mark in built:
        test = mark(test)
    return test


@pytest.fixture(scope="module")
def wasm_fmus(rv20e, tmp_path_factory):
    """Folder with FMUs of FMI 3.0 that carry a component besides."""
    folder = tmp_path_factory.mktemp("wasm")
    for name, unit in UNITS.items():
        build_native(name, rv20e.specification(unit), 1e-3, "rvwear test", folder, ("3",), wasm=True)
        build_source(name, rv20e.specification(unit), 1e-3, "rvwear test", folder, ("3",))
    return folder


@pytest.fixture
def plant(wasm_fmus):
    unit = open_fmu("plant", wasm_fmus / "fmi3" / "RvPlant.fmu", wasm=True)
    yield unit
    unit.close()


SETTINGS = [
    ("RvPlant", {"output.load_torque": 100.0}), ("RvPlant", {"fidelity": 1}), ("RvWear", {"acceleration": 1e7, "crank.speed": 300.0}),
    ("RvReducer", {"acceleration": 1e6}), ("RvReducer", {"acceleration": 1e6, "fidelity": 1}),
]  # fmt: skip


@with_wasm
@pytest.mark.parametrize("name, settings", SETTINGS, ids=str)
def test_the_same_bits_as_c_with_the_same_libm(rv20e, wasm_fmus, tmp_path, name, settings):
    with zipfile.ZipFile(wasm_fmus / "source" / "fmi3" / f"{name}.fmu") as archive:
        archive.extractall(tmp_path)
    unit = open_fmu("unit", wasm_fmus / "fmi3" / f"{name}.fmu", wasm=True)
    table = make_unit(rv20e.specification(UNITS[name])).table
    given = [unit.description.instantiationToken]
    for key, value in settings.items():
        unit.set(key, value)
        given += ["i" if table.find(key).is_integer else "r", str(table.cell_index(key)), repr(value)]
    shutil.copy(HERE / "same_libm.c", tmp_path / "sources")
    command = [*zig(), "-target", "x86_64-linux-musl", "-static", "-std=c99", "-O2", "-fno-sanitize=all", "same_libm.c", "-o", "program"]
    subprocess.run(command, cwd=tmp_path / "sources", check=True)
    done = subprocess.run([tmp_path / "sources" / "program", *given], capture_output=True)
    assert done.returncode == 0, done.stderr
    unit.enter_initialisation(0.0)
    unit.exit_initialisation()
    for n in range(40):
        unit.step(n * 2.0**-10, 2.0**-10)
    assert unit.save() == done.stdout
    unit.close()


@with_wasm
@pytest.mark.parametrize("name, settings", SETTINGS, ids=str)
def test_agrees_with_the_native_library(wasm_fmus, name, settings):
    """The libm is another: the last digits differ."""
    units = [open_fmu("unit", wasm_fmus / "fmi3" / f"{name}.fmu", wasm=way) for way in (False, True)]
    for unit in units:
        for key, value in settings.items():
            unit.set(key, value)
        unit.enter_initialisation(0.0)
        unit.exit_initialisation()
        for n in range(40):
            unit.step(n * 1e-3, 1e-3)
    # In motion a step is accepted or not by the last digit; the forces of an equilibrium are differences of large numbers.
    digits = 1e-6 if settings.get("fidelity") else 1e-10
    for signal in ("output.lag", "output.angle", "mesh.force", "roller.force", "flank.depth", "life.worst_race_depth"):
        if units[0].has(signal):
            a, b = (np.asarray(unit.get(signal)) for unit in units)
            assert np.abs(a - b).max() <= digits * np.abs(a).max(), signal
    for unit in units:
        unit.close()


@with_wasm
def test_archive_is_as_the_draft_wants_it(wasm_fmus):
    with zipfile.ZipFile(wasm_fmus / "fmi3" / "RvPlant.fmu") as archive:
        names = archive.namelist()
        layer = ElementTree.fromstring(archive.read("extra/org.modelica.fmi-ls-wasm/manifest.xml"))
        component = archive.read("binaries/wasm32-wasip2/RvPlant.wasm")
    assert "binaries/x86_64-linux/RvPlant.so" in names or len([n for n in names if n.startswith("binaries/")]) == 2
    space = "{http://fmi-standard.org/fmi-ls-manifest}"
    assert layer.get(f"{space}fmi-ls-name") == "org.modelica.fmi-ls-wasm"
    assert component.startswith(b"\0asm\x0d\0\x01\0")
    from wasmtime.component import Component

    kind = Component(wasm.engine(), component).type
    # Nothing of the machine is asked for: no file, no clock, no random number.
    assert set(kind.imports(wasm.engine())) == {"fmi:fmi3/types@3.0.0", "fmi:fmi3/callbacks@3.0.0"}
    assert set(kind.exports(wasm.engine())) == {"fmi:fmi3/common@3.0.0", "fmi:fmi3/co-simulation@3.0.0"}


@with_wasm
def test_every_function_of_the_draft_is_there_and_what_is_missing_is_refused(plant):
    calls = plant.calls
    for method in interface.METHODS:
        assert calls.function(f"[method]{interface.INSTANCE}.{method}") is not None
    index = calls.unit.get_export_index(calls.store, "get-version", calls.unit.get_export_index(calls.store, "fmi:fmi3/common@3.0.0"))
    assert calls.unit.get_func(calls.store, index)(calls.store) == "3.0"
    for kind in interface.VALUES:
        assert len(calls.call(f"get-{kind}", [])) == 0
        assert calls.call(f"set-{kind}", [], b"" if kind == "uint8" else []) == "ok"
    assert calls.call("get-boolean", [0]) == "error" and "no Boolean variables" in plant.messages[-1]
    assert calls.call("get-clock", [0]) == "error" and "no clocks" in plant.messages[-1]
    assert calls.call("set-shift-fraction", [0], []) == "error"
    assert calls.call("enter-event-mode") == "error" and "no event mode" in plant.messages[-1]
    assert calls.call("update-discrete-states") == "error"
    assert calls.call("get-adjoint-derivative", [0], [0], [1.0]) == "error"
    assert calls.call("get-number-of-variable-dependencies", 0) == "error"
    assert calls.call("set-debug-logging", True, ["logStatusError"]) == "ok"
    assert calls.call("set-debug-logging", True, ["none"]) == "error"


@with_wasm
def test_directional_derivatives_are_those_of_the_library(wasm_fmus):
    found = []
    for way in (False, True):
        unit = open_fmu("plant", wasm_fmus / "fmi3" / "RvPlant.fmu", wasm=way)
        unit.enter_initialisation(0.0)
        unit.exit_initialisation()
        lag, torque = (next(v.valueReference for v in unit.description.modelVariables if v.name == name) for name in ("output.lag", "output.load_torque"))
        call = unit.calls
        if way:
            found += call.call("get-directional-derivative", [lag], [torque], [1.0])
        else:
            found += call.slave.getDirectionalDerivative([lag], [torque], [1.0])
        unit.close()
    assert found[0] == pytest.approx(found[1], rel=1e-6) and found[0] > 0.0


@with_wasm
def test_refusals_reach_the_user(plant):
    with pytest.raises(RunFault, match="DoStep is not allowed before initialisation"):
        plant.step(0.0, 1e-3)
    with pytest.raises(RunFault, match="output.load_torque = nan N.m is not a finite number"):
        plant.set("output.load_torque", float("nan"))
    plant.enter_initialisation(0.0)
    plant.exit_initialisation()
    with pytest.raises(RunFault, match="give a positive one of at most 3600 s"):
        plant.step(0.0, -1.0)
    saved = plant.save()
    with pytest.raises(RunFault, match="checksum"):
        plant.restore(saved[:300] + bytes([saved[300] ^ 64]) + saved[301:])
    plant.step(0.0, 1e-3)
    plant.restore(saved)
    assert plant.save() == saved


@with_wasm
def test_state_goes_from_component_to_library_and_back(wasm_fmus):
    one, other = (open_fmu("wear", wasm_fmus / "fmi3" / "RvWear.fmu", wasm=way) for way in (True, False))
    for unit in (one, other):
        unit.enter_initialisation(0.0)
        unit.exit_initialisation()
    one.set("mesh.force", 300.0)
    one.step(0.0, 1e-3)
    other.restore(one.save())
    assert other.save() == one.save()
    one.close()
    other.close()


@with_wasm
def test_run_verify_and_a_foreign_machine(wasm_fmus, tmp_path, monkeypatch, capsys):
    fmu = wasm_fmus / "fmi3" / "RvReducer.fmu"
    assert main(["run", str(fmu), "--wasm", "--duration", "0.005", "--step", "1e-3", "--output", str(tmp_path / "r.nc"), "--json"]) == 0
    assert (tmp_path / "r.nc").is_file()
    assert verify(fmu).problems == []
    # Where there is no library for the machine, the component is taken.
    monkeypatch.setattr("fmpy.platform_tuple", "riscv64-linux")
    unit = open_fmu("unit", fmu)
    assert isinstance(unit.calls, wasm.Wasm)
    unit.close()


def test_fmu_without_component_is_refused(native_fmus):
    with pytest.raises(InputFault, match=r"has no binaries/wasm32-wasip2/\*\.wasm.*rvwear build --wasm"):
        open_fmu("plant", native_fmus / "fmi3" / "RvPlant.fmu", wasm=True)


def test_without_wasmtime_it_is_asked_for(monkeypatch):
    monkeypatch.setattr("importlib.util.find_spec", lambda name: None)
    wasm.engine.cache_clear()
    with pytest.raises(MissingPart, match=r'pip install "rvwear\[wasm\]"'):
        wasm.engine()
    wasm.engine.cache_clear()


@pytest.mark.parametrize("value, made", [(0, b"\0"), (63, b"\x3f"), (64, b"\xc0\0"), (127, b"\xff\0"), (300, b"\xac\x02")])
def test_numbers_of_types_are_signed(value, made):
    assert type_index(value) == made
    assert number(300) == b"\xac\x02"
