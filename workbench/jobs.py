"""What takes longer than a moment runs in a process of its own, and tells the folder how far it is.

A job lies in ``.workbench/jobs/KIND``: ``job.json`` says what was asked, ``beat.json`` what is being done (written twice a second: a
job that is silent is gone), ``result.json`` and what else it found, ``log.txt``.  A file ``stop`` asks it to end with what it knows.  So
a server that was killed finds on its return what went on, and nobody ends a process by its number.
"""

import contextlib
import json
import os
import subprocess
import sys
import threading
import time
from pathlib import Path
from typing import Any

from fmu_src.faults import InputFault
from fmu_src.source_hash import ROOT
from workbench.folder import Folder


class Taken(InputFault):
    """Something else is being computed: the page waits for its end and asks again."""


KINDS = ("compare", "diagnose", "next", "extend", "build", "export", "life", "ensemble")
# Silent for so long, a job is gone [s].
SILENT = 8.0
RUNNING, DONE, FAILED, STOPPED, GONE = "running", "done", "failed", "stopped", "gone"
STARTING = threading.Lock()
# Processes that this server started and that have not ended, by place: on a busy machine one may be silent for long.
LIVING: dict[Path, subprocess.Popen[bytes]] = {}


def place_of(folder: Folder, kind: str) -> Path:
    if kind not in KINDS:
        raise InputFault(f"{kind}: there is no such work; choose from {', '.join(KINDS)}")
    return folder.memory / "jobs" / kind


def start(folder: Folder, kind: str, given: dict[str, Any], jobs: int) -> None:
    """Taken where one is running already."""
    place = place_of(folder, kind)
    # Of two clicks at once, in two tabs, one counts.
    with STARTING:
        busy = [other for other in KINDS if status(folder, other)["state"] == RUNNING]
        if busy:
            raise Taken(f"{busy[0]} is being computed: stop it, or wait for its end")
        place.mkdir(parents=True, exist_ok=True)
        # What goes on from where it was shows what it had; anything else nothing of before.
        anew = folder.recall(f"jobs/{kind}/job").get("given") != given
        for name in ("stop", "beat.json", *(["live.json"] if anew else [])):
            (place / name).unlink(missing_ok=True)
        folder.remember(f"jobs/{kind}/job", {"kind": kind, "given": given, "jobs": jobs, "begun": time.time()})
    with (place / "log.txt").open("wb") as log:
        # A session of its own: Ctrl-C at the server is the server's.
        known = {"PYTHONPATH": os.pathsep.join([str(ROOT), *filter(None, [os.environ.get("PYTHONPATH")])])}
        # -P: nothing is imported from wherever the server was started.
        words = [sys.executable, "-P", "-m", "workbench.work", str(folder.root), kind]
        process = subprocess.Popen(words, stdin=subprocess.DEVNULL, stdout=log, stderr=log, env=os.environ | known, start_new_session=True)
    # Its end is heard, so that nothing is left of it in the system's table.
    LIVING[place] = process
    threading.Thread(target=process.wait, daemon=True).start()


def stop(folder: Folder, kind: str) -> None:
    place = place_of(folder, kind)
    if status(folder, kind)["state"] == RUNNING:
        (place / "stop").touch()


def stop_all(folder: Folder) -> None:
    for kind in KINDS:
        stop(folder, kind)


def status(folder: Folder, kind: str, stamps: dict[str, str] | None = None) -> dict[str, Any]:
    """``state``, what is being done, since when; of a job that ended what was said.

    ``stamps`` of the folder by model, which are filled: for those who ask for all jobs at once, files are looked at once.
    """
    place = place_of(folder, kind)
    asked = folder.recall(f"jobs/{kind}/job")
    if not asked:
        return {"state": ""}
    beat = folder.recall(f"jobs/{kind}/beat")
    model = str(asked.get("given", {}).get("model") or "")
    stamps = {} if stamps is None else stamps
    if model not in stamps:
        stamps[model] = folder.stamp(model)
    told = {"begun": asked.get("begun"), "given": asked.get("given", {}), "tasks": beat.get("tasks", []), "whole": beat.get("whole", ""),
            "said": beat.get("said", []), "fault": beat.get("fault", ""), "seconds": beat.get("seconds"),
            "old": beat.get("stamp", "") != stamps[model]}  # fmt: skip
    state = beat.get("state", RUNNING)
    if state == RUNNING and time.time() - max(float(beat.get("at", 0.0)), float(asked["begun"])) > SILENT and not lives(place):
        state = GONE
        told["fault"] = f"the process that computed is gone; its last words: {last_words(place)}"
    return told | {"state": state, "result": (place / "result.json").is_file()}


def lives(place: Path) -> bool:
    """Whether a process that this server started there has not ended."""
    return place in LIVING and LIVING[place].poll() is None


def last_words(place: Path) -> str:
    with contextlib.suppress(OSError):
        text = (place / "log.txt").read_text(encoding="utf-8", errors="replace").strip()
        return text[-400:] or "none"
    return "none"


def result(folder: Folder, kind: str) -> dict[str, Any]:
    """What it found last; InputFault without one."""
    try:
        found = json.loads((place_of(folder, kind) / "result.json").read_text(encoding="utf-8"))
    except (OSError, ValueError):
        raise InputFault(f"{kind}: there is no result yet") from None
    return dict(found)
