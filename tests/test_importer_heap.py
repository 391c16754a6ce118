"""The editable FMUs leave the heap of whoever imports them as it was: watched by valgrind."""

import os
import shutil
import subprocess
import sys

import pytest

# Imports a unit, steps it, frees it and unloads its library, as fmpy does it.
SCRIPT = """
import sys
from fmpy import simulate_fmu
simulate_fmu(sys.argv[1], stop_time=2e-3, output_interval=1e-3)
"""


@pytest.mark.callgrind
@pytest.mark.skipif(not shutil.which("valgrind") or not sys.platform.startswith("linux"), reason="needs valgrind")
def test_wrapper_touches_nothing_that_it_freed(fmus, tmp_path):
    command = ["valgrind", "--num-callers=40", sys.executable, "-c", SCRIPT, str(fmus / "RvPlant.fmu")]
    # Python's own allocator would hide what happens in its blocks.
    done = subprocess.run(command, capture_output=True, text=True, env=os.environ | {"PYTHONMALLOC": "malloc", "TMPDIR": str(tmp_path)})
    assert done.returncode == 0, done.stderr[-2000:]
    assert "ERROR SUMMARY" in done.stderr
    assert "finalizePythonInterpreter" not in done.stderr
