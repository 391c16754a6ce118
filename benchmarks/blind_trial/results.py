"""What a trial and its experiments leave in their folder."""

import json
import lzma
from pathlib import Path
from typing import Any

from benchmarks.blind_trial.criteria import CRITERIA
from benchmarks.blind_trial.final import SEED
from benchmarks.blind_trial.score import counted
from benchmarks.blind_trial.words import ABOUT, BESIDE, EXPERIMENTS, PROPOSED, RANDOM, RESULTS, SEALS

# Who chooses an experiment.
KINDS = (PROPOSED, RANDOM, *CRITERIA)


def finished(folder: Path) -> dict[int, dict[str, Any]]:
    """Results so far, with what peers said afterwards."""
    found = by_number(folder / RESULTS)
    for number, peers in peers_in(folder).items():
        if number in found:
            found[number]["peers"] = peers
    return found


def peers_in(folder: Path) -> dict[int, dict[str, list[str]]]:
    """What the peers said of campaigns of a trial after it, by number."""
    return {number: line["peers"] for number, line in by_number(folder / BESIDE).items()}


def by_number(path: Path) -> dict[int, dict[str, Any]]:
    """The lines of a file; a last one that was cut off is ignored."""
    found = {}
    if path.is_file():
        for line in path.read_text(encoding="utf-8").splitlines():
            try:
                result = json.loads(line)
            except json.JSONDecodeError:
                continue
            found[result["number"]] = result
    return found


# What a final trial has done so far, with its seals, what peers said and what experiments were worth, for whoever goes on with it or judges it anew.
PACKED = Path(__file__).parent / "final.json.xz"
# Of that, what lies in lines by campaign.
LINES = {"results": RESULTS, "beside": BESIDE, "experiments": EXPERIMENTS}


def packed(seed: int) -> Path:
    """Where a final trial's results are kept: of the published one in PACKED, of the next one, which takes longer than a sitting, beside it."""
    return PACKED if seed == SEED else PACKED.with_name(f"final_{seed}.json.xz")


def pack(folder: Path, place: Path) -> None:
    """Keeps a folder's results, seals and plan in one file."""
    content = {
        "about": json.loads((folder / ABOUT).read_text(encoding="utf-8")), "seals": (folder / SEALS).read_text(encoding="utf-8").splitlines(),
    }  # fmt: skip
    content |= {kind: [line for _, line in sorted(by_number(folder / name).items())] for kind, name in LINES.items()}
    place.write_bytes(lzma.compress(json.dumps(content, sort_keys=True).encode(), preset=9))


def unpack(folder: Path, place: Path) -> None:
    """Lays the kept results into a folder that has none."""
    content = json.loads(lzma.decompress(place.read_bytes()))
    folder.mkdir(parents=True, exist_ok=True)
    (folder / ABOUT).write_text(json.dumps(content["about"]), encoding="utf-8")
    (folder / SEALS).write_text("".join(f"{line}\n" for line in content["seals"]), encoding="utf-8")
    for kind, name in LINES.items():
        if lines := content.get(kind):
            (folder / name).write_text("".join(json.dumps(line) + "\n" for line in lines), encoding="utf-8")


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
