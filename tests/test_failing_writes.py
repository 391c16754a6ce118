"""Writers when the disk is full or fails, and when they are killed: the old or the new file, whole; what was said to be saved is there."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[1]


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="limits of file sizes are heard everywhere under Linux alone")
def test_no_write_that_fails_or_is_killed_loses_anything(tmp_path):
    done = subprocess.run([sys.executable, ROOT / "tests" / "failing_writes.py", tmp_path], capture_output=True, text=True,
                          env=os.environ | {"PYTHONPATH": str(ROOT), "OPENBLAS_NUM_THREADS": "1"})  # fmt: skip
    assert done.returncode == 0, done.stderr[-3000:]
    found = json.loads(done.stdout)
    assert found["trials"] > 100 and not found["wrong"], "\n".join(found["wrong"])
