"""Enters a method of this repository into the open trial: by the same door as any other, from the campaigns' folders alone.

    python -m benchmarks.blind_trial.enter OPEN answers.json --method "BIC, white noise"

Writes after every campaign, and resumes.
"""

import argparse
import os
import sys
import time
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

from benchmarks.blind_trial.answers import Answer, read_answers, seals_of, write_answers
from benchmarks.blind_trial.publish_open import CAMPAIGNS
from benchmarks.blind_trial.score import effect_of
from benchmarks.blind_trial.words import NONE, ONE, SEVERAL, UNKNOWN
from fmu_src.faults import InputFault

RVWEAR = "rvwear diagnose"
PEERS = (
    "BIC, white noise", "PEtab Select, forward by AIC", "PEtab Select, forward by BIC", "PySINDy STLSQ", "sbi, misspecification by MMD",
    "sbi, misspecification by density",
)  # fmt: skip


def by_names(names: Sequence[str]) -> Answer:
    """The answer of a method that can only name terms, none, one or several, or only say that something is missing."""
    if list(names) == [UNKNOWN]:
        return {"verdict": UNKNOWN, "effects": []}
    found = list(dict.fromkeys(map(effect_of, names)))
    return {"verdict": NONE if not found else ONE if len(found) == 1 else SEVERAL, "effects": [{"name": n} for n in found]}


def by_diagnosis(answer: Mapping[str, Any]) -> Answer:
    """What the diagnosis says, in the words of the trial."""
    keys = ("name", "parameters", "held_out_error_before", "held_out_error_after")
    others = [n for names in answer.get("alternatives", {}).values() for n in names]
    return {"verdict": answer["verdict"], "effects": [{k: e[k] for k in keys if k in e} for e in answer["effects"]],
            "set": [*answer.get("confusable", []), *others], "captured": answer.get("captured", 0.0)}  # fmt: skip


def answer_of(method: str, folder: Path) -> Answer | None:
    """A method's answer to one campaign; None if it failed."""
    if method == RVWEAR:
        from benchmarks.blind_trial import tool

        found = tool.answer_of(folder)
        return None if found["verdict"] == "crash" else by_diagnosis(found)
    from benchmarks.blind_trial.peers import PACKAGES, peers_of

    named = peers_of(folder, [method])
    if method not in named and "error" not in named:
        raise InputFault(f"{method}: its package is not installed; pip install {' '.join(PACKAGES)}")
    return by_names(named[method]) if method in named else None


def enter(folder: Path, path: Path, method: str, ask: Callable[[str, Path], Answer | None] = answer_of) -> dict[str, Answer]:
    """Answers of every campaign that has none yet."""
    answers = read_answers(path)[1] if path.is_file() else {}
    left = [name for name in sorted(seals_of(folder)) if name not in answers]
    for k, name in enumerate(left, 1):
        started = time.perf_counter()
        found = ask(method, folder / CAMPAIGNS / name)
        seconds = time.perf_counter() - started
        said = "failed"
        if found is not None:
            answers[name] = {**found, "seconds": seconds}
            write_answers(path, method, answers)
            said = found["verdict"] + ": " + ", ".join(e["name"] for e in found["effects"])
        print(f"{name} {said} ({seconds:.0f} s) [{k} of {len(left)}]", flush=True)
    return answers


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="folder of the open trial")
    parser.add_argument("answers", type=Path, help="file to write")
    parser.add_argument("--method", choices=(RVWEAR, *PEERS), default=RVWEAR)
    arguments = parser.parse_args()
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    os.environ.setdefault("OMP_NUM_THREADS", "1")
    enter(arguments.folder, arguments.answers, arguments.method)
    return 0


if __name__ == "__main__":
    sys.exit(main())
