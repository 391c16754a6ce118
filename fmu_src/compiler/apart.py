"""Object code in a process of its own, for targets whose mere use changes what this process makes for others.

LLVM keeps the least size of a jump table for all targets in one place, and its WebAssembly target sets it: code for other machines that is made after
that in the same process has other bytes.
"""

import subprocess
import sys

import llvmlite.binding as llvm

from fmu_src.child_process import command_of
from fmu_src.compiler.module import emit_object

APART = "wasm"


def object_code(module: llvm.ModuleRef, triple: str) -> bytes:
    """Object code for one target; the module was made for this machine, its code holds for all."""
    if not triple.startswith(APART):
        return emit_object(module, triple)
    done = subprocess.run(command_of("fmu_src.compiler.apart:main", sys.path, triple), input=module.as_bitcode(), capture_output=True, check=False)
    if done.returncode:
        raise RuntimeError(f"no object code for {triple}: {done.stderr.decode(errors='replace')[-2000:]}")
    return bytes(done.stdout)


def main(triple: str) -> None:
    """Bitcode from standard input, object code to standard output."""
    sys.stdout.buffer.write(emit_object(llvm.parse_bitcode(sys.stdin.buffer.read()), triple))
