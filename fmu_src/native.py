"""Kernel to machine code without Python: LLVM code, its audit, object code, loading.

numba compiles an entry point; its LLVM code is cut down to what the entry point needs,
wrapped in plain C functions

    int64 initialise(void *cells)
    int64 step(void *cells, double time, double duration)

and emitted as object files, for this machine or for any other.  Where Python
runs, llvmlite loads such an object in a few milliseconds, so an importing process need
not compile; ``link`` makes shared libraries of them.  The result is refused if it needs
any symbol beyond libm and the memory functions of libc.
"""

import ctypes
import hashlib
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable
from pathlib import Path

import llvmlite
import llvmlite.binding as llvm
import numba
import numpy as np

from fmu_src.kernel import CACHE_FOLDER
from fmu_src.source_hash import source_hash
from fmu_src.unit import Unit, make_unit

ENTRY_POINTS = {"initialise": (), "step": ("double", "double")}
LIBM = {
    "acos", "asin", "atan", "atan2", "ceil", "cos", "exp", "expm1", "fabs", "floor", "fmod", "hypot", "ldexp",
    "log", "log10", "log1p", "pow", "round", "sin", "sinh", "cosh", "sqrt", "tan", "tanh", "trunc",
    "sincos", "memcpy", "memmove", "memset",
}  # fmt: skip
# Reference counting of records that own nothing: calls are dropped.
DROPPED = ("NRT_incref", "NRT_decref")


class NativeFault(RuntimeError):
    """Code that would not run without Python."""


def host_triple() -> str:
    return llvm.get_process_triple()


def entry_point_llvm(function, name: str, dtype: np.dtype) -> str:
    """LLVM code of one entry point with everything it calls, and its C wrapper."""
    from numba import types
    from numba.np.numpy_support import from_dtype

    arguments = ENTRY_POINTS[name]
    signature = (types.Array(from_dtype(dtype), 1, "C"), *(types.float64 for _ in arguments))
    function.compile(signature)
    compiled = function.overloads[signature]
    target = compiled.fndesc.llvm_func_name
    body = compiled.library.get_llvm_str()
    extra = "".join(f", double %a{i}" for i in range(len(arguments)))
    # numba's calling convention: result, exception, then the array's seven members.
    wrapper = f"""
define i64 @{name}(i8* %cells{extra}) {{
  %result = alloca i64
  %exception = alloca i8*
  %status = call i32 @"{target}"(i64* %result, i8** %exception, i8* null, i8* null, i64 1,
    i64 {dtype.itemsize}, i8* %cells, i64 1, i64 {dtype.itemsize}{extra})
  %raised = icmp ne i32 %status, 0
  %value = load i64, i64* %result
  %code = select i1 %raised, i64 -1, i64 %value
  ret i64 %code
}}
declare i32 @"{target}"(i64*, i8**, i8*, i8*, i64, i64, i8*, i64, i64{", double" * len(arguments)})
"""
    module = llvm.parse_assembly(body)
    module.link_in(llvm.parse_assembly(wrapper.replace("define", f'target triple = "{module.triple}"\ndefine', 1)))
    return str(module)


def reduce_module(text: str, keep: tuple[str, ...]) -> llvm.ModuleRef:
    """Drop everything that the kept functions do not need."""
    lines = []
    for line in text.splitlines():
        if "call" in line and any(f"@{name}(" in line for name in DROPPED):
            continue
        lines.append(line)
    module = llvm.parse_assembly("\n".join(lines))
    for function in module.functions:
        if function.name in keep:
            function.visibility = "hidden"
        elif not function.is_declaration:
            function.linkage = "internal"
    for variable in module.global_variables:
        if not variable.is_declaration:
            variable.linkage = "internal"
    passes = llvm.create_pass_builder(target_machine(), llvm.create_pipeline_tuning_options(speed_level=2))
    manager = llvm.create_new_module_pass_manager()
    manager.add_global_dead_code_eliminate_pass()
    manager.run(module, passes)
    return module


def external_symbols(module: llvm.ModuleRef) -> set[str]:
    """Symbols that the module needs from outside, LLVM's own intrinsics apart."""
    functions = {f.name for f in module.functions if f.is_declaration and not f.name.startswith("llvm.")}
    variables = {v.name for v in module.global_variables if v.is_declaration}
    intrinsics = {f.name for f in module.functions if f.name.startswith("llvm.x86.")}
    return functions | variables | intrinsics


def target_machine(triple: str | None = None) -> llvm.TargetMachine:
    llvm.initialize_all_targets()
    llvm.initialize_all_asmprinters()
    target = llvm.Target.from_triple(triple or host_triple())
    return target.create_target_machine(opt=2, reloc="pic", codemodel="default")


def emit_object(module: llvm.ModuleRef, triple: str) -> bytes:
    """Object code for one target; the module was made for this machine, its code holds for all."""
    machine = target_machine(triple)
    retargeted = module.clone()
    retargeted.triple = triple
    retargeted.data_layout = str(machine.target_data)
    return machine.emit_object(retargeted)


def unit_module(unit: Unit) -> llvm.ModuleRef:
    """Both entry points of a unit in one module; needs a process without a kernel cache."""
    merged: llvm.ModuleRef | None = None
    for name in ENTRY_POINTS:
        text = entry_point_llvm(getattr(unit, name), name, unit.table.dtype)
        module = reduce_module(text, (name,))
        if merged is None:
            merged = module
        else:
            merged.link_in(module)
    foreign = external_symbols(merged) - LIBM
    if foreign:
        raise NativeFault(
            f"{unit.table.name}: the compiled kernels need {', '.join(sorted(foreign))}, which only Python has."
            " A kernel allocates, prints or uses an array expression; write it with scalars and loops"
        )
    return merged


def object_code(specification: dict, triple: str | None = None) -> bytes:
    """Object code of a unit for one target (default this machine), plain instructions only."""
    triple = triple or host_triple()
    return object_codes(specification, (triple,))[triple]


def object_codes(specification: dict, triples: tuple[str, ...]) -> dict[str, bytes]:
    """Object code of a unit for several targets (LLVM triples), kept per user like the kernels."""
    places = {triple: kept_place(specification, triple) for triple in triples}
    missing = tuple(triple for triple, place in places.items() if not place.is_file())
    made = compiled_objects(specification, missing) if missing else {}
    for triple, code in made.items():
        keep(places[triple], code)
    return {triple: made[triple] if triple in made else places[triple].read_bytes() for triple in triples}


def kept_place(specification: dict, triple: str) -> Path:
    """Where the object code is kept: sources and array sizes decide it, start values do not."""
    versions = (*sys.version_info[:2], numba.__version__, llvmlite.__version__, np.__version__)
    decided_by = json.dumps([source_hash(), specification["unit"], specification["sizes"], versions], sort_keys=True)
    name = hashlib.sha256(decided_by.encode()).hexdigest()[:32]
    return CACHE_FOLDER / "objects" / f"{specification['unit']}-{name}-{triple}.o"


def keep(place: Path, code: bytes) -> None:
    """Writes at once or not at all; a folder that cannot be written ends no build."""
    try:
        place.parent.mkdir(parents=True, exist_ok=True)
        partial = place.with_suffix(f".{os.getpid()}")
        partial.write_bytes(code)
        partial.replace(place)
    except OSError:
        pass


def compiled_objects(specification: dict, triples: tuple[str, ...]) -> dict[str, bytes]:
    """Compiled in a process of its own: the processor's name is global to numba, and code
    that comes from a kernel cache has no LLVM text.
    """
    with tempfile.TemporaryDirectory() as folder:
        environment = os.environ | {
            "NUMBA_CACHE_DIR": folder, "NUMBA_CPU_NAME": "generic", "NUMBA_CPU_FEATURES": "",
            "PYTHONPATH": str(Path(__file__).resolve().parents[1]),
        }
        done = subprocess.run(
            [sys.executable, "-m", "fmu_src.native", folder, *triples], input=json.dumps(specification), text=True,
            env=environment, capture_output=True,
        )
        if done.returncode != 0:
            raise NativeFault(done.stderr.strip().splitlines()[-1] if done.stderr.strip() else "compiler failed")
        return {triple: Path(folder, f"{triple}.o").read_bytes() for triple in triples}


def load_object(code: bytes) -> dict[str, Callable]:
    """The entry points of an object, callable as ``f(record array, ...)``.

    The loaded code lives as long as the process; loading the same bytes twice gives the
    same functions.
    """
    if code not in _loaded:
        engine = llvm.create_mcjit_compiler(llvm.parse_assembly(""), target_machine())
        engine.add_object_file(llvm.ObjectFileRef.from_data(code))
        engine.finalize_object()
        functions = {}
        for name, arguments in ENTRY_POINTS.items():
            prototype = ctypes.CFUNCTYPE(ctypes.c_int64, ctypes.c_void_p, *(ctypes.c_double for _ in arguments))
            functions[name] = prototype(engine.get_function_address(name))
        _loaded[code] = (engine, functions)
    return _loaded[code][1]


_loaded: dict[bytes, tuple] = {}


if __name__ == "__main__":
    module = unit_module(make_unit(json.load(sys.stdin)))
    for target_triple in sys.argv[2:]:
        Path(sys.argv[1], f"{target_triple}.o").write_bytes(emit_object(module, target_triple))
