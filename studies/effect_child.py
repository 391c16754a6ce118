"""An effect of one's own, tried in a Python of its own: nothing of it stays in this process, and kernels may run there as plain Python."""

import json
import os
import subprocess
import sys
from pathlib import Path

from fmu_src.child_process import command_of
from fmu_src.effect_check import all_sound
from fmu_src.effect_finding import Finding
from fmu_src.source_hash import ROOT, USER_EFFECTS

PLAIN = "RVWEAR_PLAIN_PYTHON"


def findings_by(main: str, file: Path, tried: str, patience: float, plain: bool) -> list[Finding]:
    """What ``main`` ("module:function") prints of a sound effect's file as JSON, a list of (file, line, text); the file lies in its unit's folder.

    With faulty files beside it no unit starts, so that nothing can be said.  ``tried`` says what is being done, if it fails or takes longer than
    ``patience`` [s].
    """
    folder = file.parent.parent
    if not all_sound(folder):
        return []
    environment = {k: v for k, v in os.environ.items() if k != PLAIN} | {USER_EFFECTS: str(folder)} | ({PLAIN: "1"} if plain else {})
    try:
        done = subprocess.run(
            # Of these sources, whatever unit's own copy of them this process has loaded.
            command_of(main, [str(ROOT), *sys.path], str(file)),
            capture_output=True, text=True, encoding="utf-8", errors="replace", env=environment, timeout=patience, check=False,
        )  # fmt: skip
    except subprocess.TimeoutExpired:
        return [Finding(file, 0, f"not {tried}: it takes more than {patience:g} s")]
    if done.returncode:
        return [Finding(file, 0, f"not {tried}: {(done.stderr.strip() or 'no word').splitlines()[-1]}")]
    return [Finding(Path(place), line, text) for place, line, text in json.loads(done.stdout.splitlines()[-1])]
