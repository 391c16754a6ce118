"""The kernels stay free of Python: what the machine code of each unit needs from outside."""

import math
import subprocess
import sys

import lag_unit
import pytest

from fmu_src import native
from fmu_src.compiler import loading
from fmu_src.compiler.types import KernelFault, Layout
from fmu_src.kernel import kernel
from fmu_src.source_hash import ROOT
from fmu_src.wasm.linking import TRIPLE


@pytest.mark.parametrize("unit", ["RvPlant", "RvWear"])
def test_object_code_needs_nothing_but_libm(codes, unit):
    assert undefined_symbols(codes[unit][native.host_triple()]) <= loading.LIBM


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


def test_a_kernel_that_uses_libm_passes_and_another_library_does_not(monkeypatch):
    @kernel
    def initialise(records):
        return 0

    @kernel
    def step(records, time, duration):
        records[0].x = math.tanh(time) ** duration
        return 0

    layout = Layout(lag_unit.lag_table().dtype)
    functions = native.load_object(loading.unit_code(initialise, step, layout, (native.host_triple(),))[native.host_triple()])
    records = lag_unit.lag_table().new_records()
    assert functions["step"](records.ctypes.data, 0.5, 2.0) == 0
    assert records["x"][0] == pytest.approx(math.tanh(0.5) ** 2.0, rel=1e-15)
    monkeypatch.setattr(loading, "LIBM", loading.LIBM - {"tanh"})
    monkeypatch.setattr(loading.store, "read", lambda name: None)
    with pytest.raises(KernelFault, match="tanh"):
        loading.unit_code(initialise, step, layout, (native.host_triple(),))


SCATTERED = """
import ctypes
from mmap import MAP_ANONYMOUS, MAP_PRIVATE
import reducers.reducer, rvwear.reducer

c = ctypes.CDLL(None)
c.mmap.restype, c.mmap.argtypes = ctypes.c_void_p, (ctypes.c_void_p, ctypes.c_size_t, *3 * [ctypes.c_int], ctypes.c_long)
c.munmap.argtypes = ctypes.c_void_p, ctypes.c_size_t

def taken(size):
    return c.mmap(None, size, 0, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)

below = taken(3 << 30)
above = []
while (page := taken(4096)) > below:
    above.append(page)
for page in above[::2]:
    c.munmap(page, 4096)
print(rvwear.reducer.solve("BX-40E").attrs["reducer"])
"""


@pytest.mark.skipif(sys.platform != "linux", reason="memory is laid out as Linux does")
def test_kernels_are_loaded_where_the_memory_of_the_process_is_scattered():
    """All holes above 3 GB that are in use are full but for one page: it went to the constants, and the code went below."""
    ended = subprocess.run([sys.executable, "-c", SCATTERED], cwd=ROOT, capture_output=True, text=True, check=False)
    assert (ended.returncode, ended.stdout) == (0, "BX-40E\n"), ended.stderr


def test_an_entry_point_gives_back_a_status_code():
    @kernel
    def initialise(records):
        return 0.5

    with pytest.raises(KernelFault, match="test_native.py:.*initialise must return a status code"):
        loading.unit_code(initialise, initialise, Layout(lag_unit.lag_table().dtype), (native.host_triple(),))


def test_object_code_is_the_same_twice_and_serves_other_start_values(rv20e, codes, monkeypatch):
    specification = rv20e.specification("wear_fmu")
    other = specification | {"starts": specification["starts"] | {"mesh_wear_coefficient": 7e-9}}
    triples = tuple(codes["RvWear"])
    with monkeypatch.context() as nothing_kept:
        nothing_kept.setattr(loading.store, "read", lambda name: None)
        # Whatever was made in between: LLVM's target for WebAssembly changes the others.
        native.object_codes(specification, (TRIPLE,))
        assert native.object_codes(specification, triples) == codes["RvWear"]
    monkeypatch.setattr(loading, "optimised", lambda *_: pytest.fail("compiled again"))
    assert native.object_codes(other, triples) == codes["RvWear"]
    larger = specification | {"sizes": specification["sizes"] | {"resolution": {"flank": 91, "pin": 90, "raceway": 180}}}
    with pytest.raises(pytest.fail.Exception, match="compiled again"):
        native.object_codes(larger, triples)
