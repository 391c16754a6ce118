"""Object code into this process: from the store if it is there and its sources are unchanged, else compiled now."""

import ctypes
import hashlib
import itertools
import linecache
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass, field
from functools import cache
from typing import Any

import llvmlite
import llvmlite.binding as llvm

from fmu_src.arrays import field_of
from fmu_src.compiler import store
from fmu_src.compiler.apart import object_code
from fmu_src.compiler.module import Module, external_symbols, host_triple, optimised, target_machine
from fmu_src.compiler.source import Source
from fmu_src.compiler.types import FLOAT, INTEGER, TRUTH, Group, KernelFault, Layout, Number, Record, Records, Type
from fmu_src.progress import task

# What object code may ask of the C library.
LIBM = {
    "acos", "asin", "atan", "atan2", "ceil", "cos", "exp", "expm1", "fabs", "floor", "fmod", "hypot", "ldexp",
    "log", "log10", "log1p", "log2", "pow", "round", "sin", "sinh", "cosh", "sqrt", "tan", "tanh", "trunc",
    "sincos", "memcpy", "memmove", "memset",
}  # fmt: skip

# A plant takes that long [s], all else less.
USUAL_TIME = 3.0

# Arguments of a unit's entry points after its records, all numbers.
ENTRY_POINTS: dict[str, tuple[Number, ...]] = {"initialise": (), "step": (FLOAT, FLOAT)}

CType = type[ctypes.c_double | ctypes.c_int64 | ctypes.c_int8 | ctypes.c_void_p]


@dataclass
class Code:
    """Object code and what is known about it: ``results`` by symbol, ``needs`` as (symbol, module, kernel, layout's digest)."""

    objects: dict[str, bytes]
    results: dict[str, str]
    needs: list[list[str]] = field(default_factory=list)


def entry_symbol(kernel: Source, layout: Layout) -> str:
    return f"{kernel.module}.{kernel.name}/{layout.digest}"


def separate(kernel: Source, arguments: tuple[Type, ...]) -> str | None:
    """The symbol of an entry point that has object code of its own."""
    if kernel.is_entry and arguments and isinstance(arguments[0], Records):
        return entry_symbol(kernel, arguments[0].layout)
    return None


def unit_code(initialise: Source, step: Source, layout: Layout, triples: tuple[str, ...]) -> dict[str, bytes]:
    """Object code of a unit's entry points for targets: C functions ``initialise(cells)`` and ``step(cells, time, duration)``."""
    def fill(module: Module) -> dict[str, Type]:
        return fill_unit(module, initialise, step, layout)

    return compiled(initialise.module.partition(".")[0], ("unit", initialise.origin, step.origin, layout.digest), Module(), fill, triples).objects


def fill_unit(module: Module, initialise: Source, step: Source, layout: Layout) -> dict[str, Type]:
    """Writes a unit's entry points and all that they call into a module."""
    records = Records(layout)
    return {kernel.name: module.unit_entry(kernel, (records, *ENTRY_POINTS[kernel.name])) for kernel in (initialise, step)}


def unit_source(initialise: Source, step: Source, layout: Layout) -> str:
    """A unit's entry points as C99."""
    from fmu_src.compiler.c_source import c_source

    module = Module()
    fill_unit(module, initialise, step, layout)
    return c_source(module)


def call_code(kernel: Source, arguments: tuple[Type, ...]) -> Code:
    """Object code of one kernel for argument types, under the symbol ``call``."""
    def fill(module: Module) -> dict[str, Type]:
        return {"call": module.entry(kernel, arguments, "call")}

    signature = "".join(kind.code for kind in arguments)
    triples = (host_triple(),)
    return compiled(f"{kernel.module}.{kernel.name}", ("call", kernel.origin, signature), Module(separate), fill, triples)


def compiled(what: str, key: tuple[str, ...], module: Module, fill: Callable[[Module], dict[str, Type]], triples: tuple[str, ...]) -> Code:
    """From the store, or made now and stored."""
    versions = (*sys.version_info[:2], llvmlite.__version__)
    names = {triple: store.key(*key, *versions, triple) for triple in triples}
    found = {triple: entry for triple, name in names.items() if (entry := store.read(name)) and is_current(entry[0])}
    missing = [triple for triple in triples if triple not in found]
    if missing:
        with task(f"compiling {what}, once", about=USUAL_TIME):
            results = fill(module)
            optimised_module = optimised(module.text(host_triple()), list(results))
        foreign = external_symbols(optimised_module) - LIBM - set(module.needs)
        if foreign:
            raise KernelFault(f"{what}: the kernels need {', '.join(sorted(foreign))}, which the C library does not have")
        header: dict[str, Any] = {
            "what": what, "results": {symbol: kind.code for symbol, kind in results.items()},
            "needs": [
                [symbol, kernel.module, kernel.name, records.layout.digest]
                for symbol, (kernel, (records, *_)) in sorted(module.needs.items()) if isinstance(records, Records)
            ],
            "sources": {name: source_digest(name) for name in sorted(module.modules())},
            "constants": [[owner, name, repr(value)] for (owner, name), value in sorted(module.constants.items())],
        }  # fmt: skip
        for triple in missing:
            found[triple] = (header, object_code(optimised_module, triple))
            store.write(names[triple], *found[triple])
    header = found[triples[0]][0]
    return Code({triple: code for triple, (_, code) in found.items()}, header["results"], header["needs"])


def is_current(header: dict[str, Any]) -> bool:
    """Whether what the code was made from is what this process would make it from."""
    return all(source_digest(name) == digest for name, digest in header["sources"].items()) and all(
        repr(outer_value(owner, name)) == value for owner, name, value in header["constants"]
    )


@cache
def source_digest(module: str) -> str | None:
    """Of the text of a module that is imported, or None."""
    file = getattr(sys.modules.get(module), "__file__", None)
    if file is None:
        return None
    linecache.checkcache(file)
    return hashlib.sha256("".join(linecache.getlines(file)).encode()).hexdigest()


def outer_value(module: str, name: str) -> Any:
    """The number that a module knows by a name, ``math.pi`` for instance."""
    value: Any = sys.modules.get(module)
    for part in name.split("."):
        value = getattr(value, part, None)
    return value


@cache
def linker() -> llvm.LLJIT:
    """Of this process.  Kernels reach their constants by 32 bits: JITLink lays the sections of an object beside one another, however the memory of a
    large process is scattered (LLVM's older linker does not, and ends the process where they lie too far apart)."""
    return llvm.create_lljit_compiler(target_machine(host_triple()), use_jit_link=sys.platform != "win32")


_names = itertools.count()
_loaded: list[llvm.ResourceTracker] = []


def load_object(code: bytes, symbols: tuple[str, ...], needs: dict[str, int] | None = None) -> tuple[int, ...]:
    """Addresses of symbols of an object that calls the C library and ``needs`` (addresses by symbol); what is loaded stays as long as the process."""
    library = llvm.JITLibraryBuilder().add_object_img(code).add_current_process()
    for symbol, address in (needs or {}).items():
        library.import_symbol(symbol, address)
    for symbol in symbols:
        library.export_symbol(symbol)
    loaded = library.link(linker(), f"kernels {next(_names)}")
    _loaded.append(loaded)
    return tuple(loaded[symbol] for symbol in symbols)


_units: dict[tuple[Source, Source, str], dict[str, int]] = {}


def module_addresses(kernel: Source, layout: Layout) -> dict[str, int]:
    """Addresses of the entry points of the module that an entry point stands in."""
    beside = kernel.function.__globals__
    initialise, step = (beside[name] for name in ENTRY_POINTS)
    return unit_addresses(initialise, step, layout)


def unit_addresses(initialise: Source, step: Source, layout: Layout) -> dict[str, int]:
    """Addresses of a unit's entry points for records of this layout."""
    key = (initialise, step, layout.digest)
    if key not in _units:
        triple = host_triple()
        code = unit_code(initialise, step, layout, (triple,))[triple]
        _units[key] = dict(zip(ENTRY_POINTS, load_object(code, tuple(ENTRY_POINTS))))
    return _units[key]


def call_address(kernel: Source, arguments: tuple[Type, ...]) -> tuple[int, str]:
    """(address, code of the result's type) of a kernel for argument types."""
    code = call_code(kernel, arguments)
    known = {layout.digest: layout for kind in arguments for layout in layouts_in(kind)}
    needs = {symbol: module_addresses(getattr(sys.modules[module], name), known[digest])[name] for symbol, module, name, digest in code.needs}
    (address,) = load_object(code.objects[host_triple()], ("call",), needs)
    return address, code.results["call"]


def layouts_in(kind: Type) -> list[Layout]:
    """The layout of a record and those of the records in it."""
    if not isinstance(kind, (Record, Records)):
        return []
    found = [kind.layout]
    for name in kind.layout.dtype.names or ():
        base = field_of(kind.layout.dtype, name)[0].base
        if base.names:
            found += layouts_in(Record(Layout(base)))
    return found


NUMBERS = {"f": FLOAT, "i": INTEGER, "b": TRUTH}


def result_type(code: str) -> Type:
    """The type of a result from its letters: a number or a tuple of numbers."""
    if code in NUMBERS:
        return NUMBERS[code]
    return Group(tuple(NUMBERS[letter] for letter in code[1:-1]))


def c_function(address: int, arguments: Sequence[CType], result: CType | None) -> Callable[..., Any]:
    return ctypes.CFUNCTYPE(result, *arguments)(address)
