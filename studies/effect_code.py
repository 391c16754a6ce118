"""An effect of one's own, translated as its unit would be: what the compiler has to say of it is said before anything is built."""

import json
import os
import re
import subprocess
import sys
from pathlib import Path

from fmu_src.child_process import command_of
from fmu_src.compiler.loading import fill_unit
from fmu_src.compiler.module import Module
from fmu_src.compiler.types import KernelFault, Layout
from fmu_src.effect_check import Finding, all_sound
from fmu_src.source_hash import ROOT, USER_EFFECTS
from fmu_src.unit import make_unit
from reducers.reducer import load_reducer

REDUCER = "RV20E-121-rigid"
PATIENCE = 60.0
PLACE = re.compile(r"(?P<file>.*?):(?P<line>\d+): (?P<text>.*)", re.DOTALL)


def not_translated(file: Path) -> list[Finding]:
    """What the compiler refuses of the unit with this sound effect in it; the file lies in its unit's folder.

    With faulty files beside it no unit starts, so that nothing can be said.
    """
    if not all_sound(file.parent.parent):
        return []
    environment = {k: v for k, v in os.environ.items() if k != "RVWEAR_PLAIN_PYTHON"} | {USER_EFFECTS: str(file.parent.parent)}
    command = command_of("studies.effect_code:main", [str(ROOT), *sys.path], file.parent.name)
    try:
        done = subprocess.run(command, capture_output=True, text=True, encoding="utf-8", errors="replace", env=environment, timeout=PATIENCE, check=False)
    except subprocess.TimeoutExpired:
        return [Finding(file, 0, f"not translated within {PATIENCE:g} s")]
    if done.returncode:
        return [Finding(file, 0, f"not translated: {(done.stderr.strip() or 'no word').splitlines()[-1]}")]
    found = PLACE.fullmatch(json.loads(done.stdout.splitlines()[-1]))
    return [Finding(Path(found["file"]), int(found["line"]), found["text"])] if found else []


def main(unit: str) -> None:
    """In the process itself: prints what the compiler says as JSON, nothing for nothing."""
    said = ""
    try:
        made = make_unit(load_reducer(REDUCER).specification(unit))
        if made.kernels is not None:
            fill_unit(Module(), *made.kernels, Layout(made.table.dtype))
    except KernelFault as fault:
        said = str(fault)
    print(json.dumps(said))
