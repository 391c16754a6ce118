"""A trial of one reader, started again where its process dies, and a short one of several."""

import json
import os
import shutil
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
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
        process = started(reader, str(seed + 1000 * death), str(left), str(count - outcome.done), str(folder))
        part = heard(process.stdout)[reader]
        outcome.done, outcome.refused, outcome.kinds = outcome.done + part.done, outcome.refused + part.refused, max(outcome.kinds, part.kinds)
        outcome.found += part.found
        if process.returncode == 0:
            break
        outcome.found.append(death_of(process.returncode, process.stderr, reader, folder, death))
    return outcome


def together(readers: Sequence[str], seed: int, seconds: float, more: int, folder: Path) -> dict[str, Outcome]:
    """What once failed and ``more`` mutants of each reader, in one process: most of what a process takes is what it loads.  A death ends it."""
    process = started(",".join(readers), str(seed), str(seconds), f"+{more}", str(folder))
    found = heard(process.stdout)
    if process.returncode != 0:
        last = [*found][-1]
        found[last].found.append(death_of(process.returncode, process.stderr, last, folder / last, 0))
    return found


def started(*words: str) -> subprocess.CompletedProcess[str]:
    environment = os.environ | {"PYTHONPATH": os.pathsep.join([*PATH, str(ROOT)])}
    return subprocess.run([sys.executable, "-m", "benchmarks.fuzzing.trial", *words], cwd=ROOT, capture_output=True, text=True, env=environment)


def heard(text: str) -> dict[str, Outcome]:
    """By reader, in the order in which they were run."""
    found: dict[str, Outcome] = {}
    for line in text.splitlines():
        said = json.loads(line)
        outcome = found.setdefault(said["reader"], Outcome(said["reader"]))
        outcome.done = said.get("done", outcome.done)
        outcome.refused += said.get("refused", 0)
        outcome.kinds = max(outcome.kinds, said.get("kinds", 0))
        if "wrong" in said:
            outcome.found.append(f"{said['wrong']} ({said['file']})")
    return found


def death_of(code: int, said: str, reader: str, folder: Path, number: int) -> str:
    kept = folder / f"died-{reader}-{number}"
    current = folder / "work" / READERS[reader][0]
    if current.exists():
        shutil.copy(current, kept)
    how = "more than ten seconds" if code == -signal.SIGPROF else f"signal {-code}" if code < 0 else f"exit code {code}: {said[-300:]}"
    trace = (folder / "trace").read_text(errors="replace") if (folder / "trace").exists() else ""
    return f"the process died: {how} {trace[:300]} ({kept})"
