"""Checkpoints of a life run: everything needed to go on to the same result."""

import io
import json
from dataclasses import asdict
from pathlib import Path
from typing import Any

import numpy as np

from fmu_src.checked_file import Damaged, checked, replacing, unchecked
from fmu_src.faults import InputFault
from fmu_src.reading import reading, require_size
from studies.life import Life, LifeSettings
from studies.solve import Turn

MARK = b"rvwear checkpoint 1\n"
REMEDY = "start anew with --restart"
# Bytes that are read of a checkpoint (assumed: far beyond those of the longest life).
MOST = 2_000_000_000
# Fields of Life that are plain numbers or lists of them.
PLAIN = ("hours", "figures", "errors", "cycles", "jumps", "passes", "coarse", "error_before", "over_turn", "drifted")


def save_checkpoint(path: Path, life: Life, saved: dict[str, Any], inputs: dict[str, Any]) -> None:
    """Write beside the target and move: a kill at any moment leaves a whole file."""
    assert life.start is not None, "a life that was not begun"
    arrays: dict[str, Any] = {f"state.{name}": np.frombuffer(state, "u1") for name, state in saved["states"].items()}
    arrays |= {f"start.{name}": np.frombuffer(state, "u1") for name, state in life.start["states"].items()}
    for name in life.surfaces[0]:
        arrays[f"surface.{name}"] = np.stack([surface[name] for surface in life.surfaces])
    for name in life.turns[0].series:
        arrays[f"turn.{name}"] = np.stack([turn[name] for turn in life.turns])
    head = {
        "inputs": inputs, "clock": saved["clock"], "start_clock": life.start["clock"], "settings": asdict(life.settings),
        "life": {name: getattr(life, name) for name in PLAIN},
    }
    content = io.BytesIO()
    np.savez_compressed(content, head=np.frombuffer(json.dumps(head).encode(), "u1"), **arrays)
    with replacing(path) as partial:
        partial.write_bytes(checked(content.getvalue(), MARK))


def load_checkpoint(path: Path, inputs: dict[str, Any]) -> tuple[Life, dict[str, Any]]:
    """(life, saved master) of a checkpoint; Damaged if it is not what was written, InputFault if it belongs to other inputs."""
    if not path.is_file():
        raise InputFault(f"no checkpoint at {path}: start the run without --resume")
    with reading(path, "a checkpoint", REMEDY):
        require_size(path, MOST)
        try:
            content = unchecked(path.read_bytes(), MARK, path)
        except Damaged as fault:
            raise Damaged(f"{fault}; {REMEDY}") from None
        return life_of(content, path, inputs)


def life_of(content: bytes, path: Path, inputs: dict[str, Any]) -> tuple[Life, dict[str, Any]]:
    with np.load(io.BytesIO(content)) as arrays:
        head = json.loads(arrays["head"].tobytes())
        data = {name: arrays[name] for name in arrays.files if name != "head"}
    different = [k for k in inputs.keys() | head["inputs"].keys() if inputs.get(k) != head["inputs"].get(k)]
    if different:
        changes = "; ".join(f"{k} was {head['inputs'].get(k)}, is {inputs.get(k)}" for k in sorted(different))
        raise InputFault(f"{path} belongs to a run with other inputs: {changes}. Give the same, or --restart")
    life = Life(LifeSettings(**head["settings"]), **head["life"])
    count = len(life.hours)
    life.surfaces = [rows(data, "surface.", i) for i in range(count)]
    life.turns = [Turn(rows(data, "turn.", i)) for i in range(count)]
    life.start = {"clock": head["start_clock"], "states": states(data, "start.")}
    return life, {"clock": head["clock"], "states": states(data, "state.")}


def states(data: dict[str, np.ndarray], prefix: str) -> dict[str, bytes]:
    return {name.removeprefix(prefix): data[name].tobytes() for name in data if name.startswith(prefix)}


def rows(data: dict[str, np.ndarray], prefix: str, i: int) -> dict[str, np.ndarray]:
    return {name.removeprefix(prefix): data[name][i] for name in data if name.startswith(prefix)}
