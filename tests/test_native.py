"""The kernels stay free of Python: what the machine code of each unit needs from outside."""

import math

import numba
import numpy as np
import pytest

import lag_unit
from fmu_src import native
from fmu_src.unit import Unit


@pytest.mark.parametrize("unit", ["RvPlant", "RvWear"])
def test_object_code_needs_nothing_but_libm(codes, unit):
    assert undefined_symbols(codes[unit][native.host_triple()]) <= native.LIBM


def undefined_symbols(code: bytes) -> set[str]:
    """Names without an address in an ELF object's symbol table, read apart from the build's own audit."""
    if code[:4] != b"\x7fELF":
        pytest.skip("not an ELF platform")

    def word(at: int, size: int) -> int:
        return int.from_bytes(code[at : at + size], "little")

    sections = [word(0x28, 8) + i * word(0x3A, 2) for i in range(word(0x3C, 2))]
    table = next(s for s in sections if word(s + 4, 4) == 2)
    strings = word(sections[word(table + 0x28, 4)] + 0x18, 8)
    names = set()
    for symbol in range(word(table + 0x18, 8) + 24, word(table + 0x18, 8) + word(table + 0x20, 8), 24):
        if word(symbol + 6, 2) == 0:
            start = strings + word(symbol, 4)
            names.add(code[start : code.index(b"\0", start)].decode())
    return names


def unit_with(step) -> Unit:
    initialise = numba.njit(error_model="numpy")(lambda records: 0)
    return Unit(lag_unit.lag_table(), initialise, step, {})


def test_allocating_kernel_is_refused():
    @numba.njit(error_model="numpy")
    def step(records, time, duration):
        work = np.zeros(int(duration))
        return int(work.sum())

    with pytest.raises(native.NativeFault, match="Lag.*NRT_"):
        native.unit_module(unit_with(step))


def test_kernel_that_uses_libm_passes():
    @numba.njit(error_model="numpy")
    def step(records, time, duration):
        records[0].x = math.tanh(time) ** duration
        return 0

    assert native.external_symbols(native.unit_module(unit_with(step))) <= native.LIBM


def test_exception_in_a_kernel_becomes_a_status():
    @numba.njit(error_model="numpy")
    def step(records, time, duration):
        if duration < 0.0:
            raise ValueError("negative")
        return 0

    unit = unit_with(step)
    code = native.target_machine().emit_object(native.unit_module(unit))
    functions = native.load_object(code)
    cells = unit.table.new_records().ctypes.data
    assert functions["step"](cells, 0.0, 1.0) == 0
    assert functions["step"](cells, 0.0, -1.0) == -1


# Whole FMUs are built twice in test_fmu.
@pytest.mark.campaign
def test_object_code_is_the_same_twice(rv20e):
    specification = rv20e.specification("wear_fmu")
    triples = (native.host_triple(),)
    assert native.compiled_objects(specification, triples) == native.compiled_objects(specification, triples)


def test_object_code_is_kept_and_serves_other_start_values(rv20e, codes, monkeypatch):
    monkeypatch.setattr(native, "compiled_objects", lambda *_: pytest.fail("compiled again"))
    specification = rv20e.specification("wear_fmu")
    other = specification | {"starts": specification["starts"] | {"mesh_wear_coefficient": 7e-9}}
    assert native.object_codes(other, tuple(codes["RvWear"])) == codes["RvWear"]
    larger = specification | {"sizes": specification["sizes"] | {"resolution": {"flank": 91, "pin": 90, "raceway": 180}}}
    assert native.kept_place(larger, "any") != native.kept_place(specification, "any")


def test_a_folder_that_cannot_be_written_ends_no_build(tmp_path):
    (tmp_path / "file").write_text("in the way")
    native.keep(tmp_path / "file" / "unit.o", b"code")
