"""FMUs of C99: valid, compiled by a compiler alone without a word, the same bits as in process."""

import shutil
import subprocess
import sys
import zipfile

import fmpy
import numpy as np
import pytest
from conftest import UNITS
from fmpy.build import build_platform_binary
from shared import problems_of

from fmu_src.compiler.assembly import definitions
from fmu_src.compiler.c_expressions import number
from fmu_src.compiler.types import KernelFault
from fmu_src.faults import InputFault
from fmu_src.link import zig
from fmu_src.package import build_source, compile_sources
from fmu_src.source_code import kernels_source
from fmu_src.unit import make_unit
from orchestrator.component import InProcess
from orchestrator.opening import open_fmu

VERSIONS = ("fmi2", "fmi3")
gcc = pytest.mark.skipif(shutil.which("gcc") is None, reason="no gcc")


@pytest.fixture(scope="module")
def sources(rv20e, tmp_path_factory):
    """Folder with the source FMUs of plant and wear."""
    folder = tmp_path_factory.mktemp("sources")
    for name, unit in UNITS.items():
        build_source(name, rv20e.specification(unit), 1e-3, "rvwear test", folder)
    return folder / "source"


@pytest.fixture(params=[(v, n) for v in VERSIONS for n in UNITS], ids="-".join)
def path(request, sources):
    return sources / request.param[0] / f"{request.param[1]}.fmu"


def unpacked(path, folder):
    with zipfile.ZipFile(path) as archive:
        archive.extractall(folder)
    return folder


def test_validation_finds_no_problem(path, monkeypatch):
    assert problems_of(path, monkeypatch) == []


def test_holds_sources_and_no_binaries(path):
    with zipfile.ZipFile(path) as archive:
        names = archive.namelist()
    assert "sources/all.c" in names and not any(name.startswith("binaries/") for name in names)
    assert not any("slave" in name or name.endswith(".py") for name in names)
    description = fmpy.read_model_description(str(path))
    assert [f for c in description.buildConfigurations for s in c.sourceFileSets for f in s.sourceFiles] or path.parent.name == "fmi2"
    if path.parent.name == "fmi2":
        with zipfile.ZipFile(path) as archive:
            assert b'<File name="all.c"' in archive.read("modelDescription.xml")


@gcc
def test_c99_compiler_has_no_objection(path, tmp_path):
    folder = unpacked(path, tmp_path) / "sources"
    more = ["-Wextra", "-Wno-unused-parameter", "-Wshadow=local", "-fPIC", "-shared"]
    command = ["gcc", "-std=c99", "-pedantic", "-Wall", "-Werror", *more, "all.c", "-o", "unit.so", "-lm"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0 and not done.stderr, done.stderr


@pytest.mark.skipif(zig() is None, reason='no zig: pip install "rvwear[build]"')
def test_clang_has_no_objection(sources, tmp_path):
    folder = unpacked(sources / "fmi3" / "RvPlant.fmu", tmp_path) / "sources"
    # FMI's own header has callbacks without a prototype.
    command = [*zig(), "-std=c99", "-pedantic", "-Wall", "-Werror", "-Wno-strict-prototypes", "-c", "all.c", "-o", "all.o"]
    done = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


@gcc
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="the same libm only where native units use the system's")
@pytest.mark.parametrize("name, version, settings", [
    ("RvPlant", "fmi2", {"fidelity": 0}), ("RvPlant", "fmi3", {"fidelity": 1}), ("RvWear", "fmi3", {"acceleration": 1e7}),
])  # fmt: skip
def test_the_same_bits_as_in_process(rv20e, sources, tmp_path, name, version, settings):
    """Object code by LLVM, C by gcc: one rounding after the other, so not a bit differs."""
    compiled = compile_sources(sources / version / f"{name}.fmu", tmp_path / f"{name}.fmu")
    units = [InProcess("unit", rv20e.specification(UNITS[name])), open_fmu("unit", compiled)]
    for unit in units:
        for key, value in settings.items():
            unit.set(key, value)
        unit.enter_initialisation(0.0)
        unit.exit_initialisation()
        for n in range(25):
            if name == "RvWear":
                unit.set("crank.angle", 0.1 * n)
                unit.set("mesh.force", 300.0 + n)
                unit.set("roller.force", 100.0)
            unit.step(n * 1e-4, 1e-4)
    for v in units[0].table.variables:
        if v.role != "scratch":
            assert np.array_equal(units[0].record()[v.name], units[1].record()[v.name]), v.name
    moved = "output.angle" if name == "RvPlant" else "flank.depth"
    assert np.max(np.abs(units[0].get(moved))) > 0.0
    units[1].close()


@gcc
@pytest.mark.skipif(shutil.which("cmake") is None, reason="no cmake")
def test_fmpy_compiles_and_simulates(sources, tmp_path):
    folder = unpacked(sources / "fmi3" / "RvPlant.fmu", tmp_path / "unit")
    (tmp_path / "build").mkdir()
    build_platform_binary(folder, tmp_path / "build", cmake_options={"CMAKE_C_FLAGS:STRING": "-Werror"})
    result = fmpy.simulate_fmu(str(folder), stop_time=0.01, output_interval=1e-3)
    assert 2e-4 < result["output.lag"][-1] < 3e-4


@gcc
@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="nm")
def test_two_units_link_into_one_program(sources, tmp_path):
    """As on a real-time target: all but FMI's functions is static, and these have a prefix."""
    objects = []
    for name in UNITS:
        folder = unpacked(sources / "fmi3" / f"{name}.fmu", tmp_path / name) / "sources"
        objects.append(folder / "unit.o")
        subprocess.run(["gcc", "-std=c99", "-O0", f"-DFMI3_FUNCTION_PREFIX={name}_", "-c", "all.c", "-o", "unit.o"], cwd=folder, check=True)
        shown = subprocess.run(["nm", "--defined-only", "-g", "unit.o"], cwd=folder, capture_output=True, text=True, check=True).stdout
        assert {line.split()[2].partition("_fmi3")[0] for line in shown.splitlines()} == {name}
    main = tmp_path / "main.c"
    main.write_text("const char *RvPlant_fmi3GetVersion(void);\nconst char *RvWear_fmi3GetVersion(void);\n"
                    "int main(void) { return RvPlant_fmi3GetVersion()[0] != RvWear_fmi3GetVersion()[0]; }\n", encoding="utf-8")  # fmt: skip
    subprocess.run(["gcc", main, *objects, "-o", tmp_path / "both", "-lm"], check=True)
    assert subprocess.run([tmp_path / "both"]).returncode == 0


def test_two_builds_are_byte_equal(rv20e, sources, tmp_path):
    for again in build_source("RvWear", rv20e.specification("wear_fmu"), 1e-3, "rvwear test", tmp_path):
        assert again.read_bytes() == (sources / again.relative_to(tmp_path / "source")).read_bytes()


def test_no_memory_is_taken_but_for_instances_and_states(sources):
    with zipfile.ZipFile(sources / "fmi3" / "RvPlant.fmu") as archive:
        texts = {name: archive.read(name).decode() for name in archive.namelist() if name.endswith(".c")}
    takes = {name.rpartition("/")[2] for name, text in texts.items() if "malloc(" in text or "calloc(" in text}
    assert takes == {"life_cycle.c", "state.c"}
    assert not any("setjmp" in text.partition("#define")[2] or "goto *" in text for text in texts.values())


def test_c_has_the_names_of_the_sources(rv20e):
    text = kernels_source(make_unit(rv20e.specification("wear_fmu")))
    assert "/* wear_fmu/wear_laws.py: wear_coefficient." in text and "at_crank_angle" in text


@pytest.mark.parametrize("operand, text", [
    ("0x3FF8000000000000", "1.5"), ("0x3FB999999999999A", "0x1.999999999999ap-4"), ("0x7FF0000000000000", "INFINITY"),
    ("0xFFF0000000000000", "-INFINITY"), ("0x8000000000000000", "-0.0"), ("0x7FF8000000000000", "NAN"), ("7", "7"),
    ("-9223372036854775808", "INT64_MIN"), ("5000000000", "INT64_C(5000000000)"), ("true", "1"),
])  # fmt: skip
def test_numbers_keep_their_bits(operand, text):
    assert number(operand).text == text


def test_unknown_instruction_is_named():
    with pytest.raises(KernelFault, match="the instruction fence is none that kernels are made of"):
        definitions("define i64 @step(ptr %cells) #0 {\n  fence seq_cst\n}\n")


def test_fmu_without_sources_is_refused(tmp_path):
    with zipfile.ZipFile(tmp_path / "empty.fmu", "w") as archive:
        archive.writestr("modelDescription.xml", "")
    with pytest.raises(InputFault, match=r"has no sources/all\.c; build one that has: rvwear build --flavour source"):
        compile_sources(tmp_path / "empty.fmu", tmp_path / "made.fmu")
    (tmp_path / "none.fmu").write_bytes(b"no archive")
    with pytest.raises(InputFault, match="none.fmu: not readable as an FMU"):
        compile_sources(tmp_path / "none.fmu", tmp_path / "made.fmu")
