"""What a trial and its experiments leave in their folder."""

import json
from pathlib import Path
from typing import Any

from benchmarks.blind_trial.criteria import CRITERIA
from benchmarks.blind_trial.score import counted
from benchmarks.blind_trial.words import EXPERIMENTS, PROPOSED, RANDOM, RESULTS

# Who chooses an experiment.
KINDS = (PROPOSED, RANDOM, *CRITERIA)


def finished(folder: Path) -> dict[int, dict[str, Any]]:
    """Results so far; a last line that was cut off is ignored."""
    found = {}
    path = folder / RESULTS
    if path.is_file():
        for line in path.read_text(encoding="utf-8").splitlines():
            try:
                result = json.loads(line)
            except json.JSONDecodeError:
                continue
            found[result["number"]] = result
    return found


def end_line(path: Path) -> None:
    """Ends a last line that was cut off, so that the next one stands alone."""
    if path.is_file() and (text := path.read_bytes()) and not text.endswith(b"\n"):
        with path.open("ab") as lines:
            lines.write(b"\n")


def resolved(folder: Path) -> dict[str, dict[str, Any]]:
    """Shares of campaigns that were resolved, with 95 % intervals."""
    lines = [json.loads(line) for line in (folder / EXPERIMENTS).read_text(encoding="utf-8").splitlines()]
    every = [line for line in lines if PROPOSED in line]
    return {kind: counted([line[kind] for line in every if kind in line], lambda found: found["resolved"]) for kind in KINDS}
