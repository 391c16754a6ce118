"""A trial of one reader, started again where its process dies."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

from benchmarks.fuzzing.readers import READERS

ROOT = Path(__file__).resolve().parents[2]
# Where Python looks before this project.
PATH: tuple[str, ...] = ()
# A reader whose process dies so often is left.
MOST_DEATHS = 20


@dataclass
class Outcome:
    """How many mutants were read, refused, in how many ways, and what was found wrong."""

    reader: str
    done: int = 0
    refused: int = 0
    kinds: int = 0
    found: list[str] = field(default_factory=list)


def trial(reader: str, seed: int, seconds: float, count: int, folder: Path) -> Outcome:
    outcome = Outcome(reader)
    folder.mkdir(parents=True, exist_ok=True)
    ends = time.monotonic() + seconds
    for death in range(MOST_DEATHS):
        left = ends - time.monotonic()
        if left <= 0.0 or outcome.done >= count:
            break
        command = [sys.executable, "-m", "benchmarks.fuzzing.trial", reader, str(seed + 1000 * death), str(left), str(count - outcome.done), str(folder)]
        process = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, env=os.environ | {"PYTHONPATH": os.pathsep.join([*PATH, str(ROOT)])})
        done = 0
        for line in process.stdout.splitlines():
            said = json.loads(line)
            done = said.get("done", done)
            outcome.refused += said.get("refused", 0)
            outcome.kinds = max(outcome.kinds, said.get("kinds", 0))
            if "wrong" in said:
                outcome.found.append(f"{said['wrong']} ({said['file']})")
        outcome.done += done
        if process.returncode == 0:
            break
        outcome.found.append(death_of(process.returncode, process.stderr, reader, folder, death))
    return outcome


def death_of(code: int, said: str, reader: str, folder: Path, number: int) -> str:
    kept = folder / f"died-{reader}-{number}"
    current = folder / "work" / READERS[reader][0]
    if current.exists():
        shutil.copy(current, kept)
    how = "more than ten seconds" if code == -signal.SIGPROF else f"signal {-code}" if code < 0 else f"exit code {code}: {said[-300:]}"
    trace = (folder / "trace").read_text(errors="replace") if (folder / "trace").exists() else ""
    return f"the process died: {how} {trace[:300]} ({kept})"
