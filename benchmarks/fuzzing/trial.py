"""Mutants of a reader, one after the other in a process of their own: ``python -m benchmarks.fuzzing.trial READERS SEED SECONDS COUNT FOLDER``.

Several readers, with commas between them, take turns in one process, each in a folder of its own; COUNT ``+25``: so many besides what once
failed.  The process prints a line of JSON for each finding and one at the end of each reader.  Where it dies, ``FOLDER/work`` holds what it died of.
"""

import contextlib
import faulthandler
import hashlib
import json
import os
import random
import re
import resource
import signal
import sys
import tempfile
import time
import traceback
import warnings
from pathlib import Path

from benchmarks.fuzzing.mutations import mutant
from benchmarks.fuzzing.readers import READERS
from benchmarks.fuzzing.seeds import SEEDS, copy_beside, seeds_of
from fmu_src.faults import InputFault, RunFault

CPU_SECONDS, WALL_SECONDS, MEMORY = 10.0, 120.0, 1 << 30
# A message longer than this [signs] helps nobody.
LONGEST = 3000
# Mutants that became seeds because their message was new.
MOST_SEEDS = 300
STARTS = ("os.system", "os.exec", "os.posix_spawn", "os.fork", "subprocess.Popen", "pickle.find_class", "socket.connect")
WRITES = {"os.mkdir": 0, "os.remove": 0, "os.rmdir": 0, "os.rename": 1, "os.symlink": 1, "os.link": 1, "os.truncate": 0, "shutil.rmtree": 0}


class Elsewhere(Exception):
    """Something was written where it should not be, or started."""


class Guard:
    """Hears of every file that is opened and every process that is started while a mutant is read."""

    def __init__(self, *allowed: Path):
        self.allowed = tuple(str(path.resolve()) + os.sep for path in allowed)
        self.is_on, self.found = False, ""
        sys.addaudithook(self.hear)

    def hear(self, event: str, arguments: tuple[object, ...]) -> None:
        if not self.is_on:
            return
        if event.startswith(STARTS) and "fmu_src.reading_apart" not in repr(arguments):
            self.found = f"{event} {arguments!r}"[:300]
        elif event in WRITES or (event == "open" and isinstance(arguments[2], int) and arguments[2] & (os.O_WRONLY | os.O_RDWR | os.O_CREAT)):
            place = arguments[WRITES.get(event, 0)]
            if isinstance(place, (str, bytes, os.PathLike)):
                path = os.path.realpath(os.fsdecode(place))
                if not (path + os.sep).startswith(self.allowed) and path != os.devnull:
                    self.found = f"{event} {path}"[:300]


def kind_of(fault: BaseException, work: Path) -> str:
    """The message without what differs from mutant to mutant."""
    return re.sub(r"['\"].*['\"]|[0-9.e+-]+|\\x\w\w", "#", str(fault).replace(str(work), ""))[:100]


def judged(reader: str, path: Path, guard: Guard) -> tuple[str, str]:
    """(what is wrong or "", the kind of its refusal) of one file."""
    guard.found, guard.is_on = "", True
    kind = "read"
    try:
        READERS[reader][1](path)
    except (InputFault, RunFault) as fault:
        kind = kind_of(fault, path.parent)
        text = str(fault)
        if path.stem not in text and str(path.parent) not in text:
            return f"the message does not name the file: {text[:300]}", kind
        if len(text) > LONGEST:
            return f"a message of {len(text)} signs: {text[:300]}", kind
    except BaseException as problem:  # noqa: BLE001
        where = traceback.extract_tb(problem.__traceback__)[-1]
        return f"{type(problem).__name__} in {Path(where.filename).name}:{where.lineno}: {str(problem)[:200]}", kind
    finally:
        guard.is_on = False
    return (f"elsewhere: {guard.found}" if guard.found else ""), kind


def main(reader: str, seed: int, seconds: float, count: str, folder: Path) -> None:
    print(json.dumps({"reader": reader, "done": 0}), flush=True)
    work = folder / "work"
    work.mkdir(parents=True, exist_ok=True)
    (folder / "temporary").mkdir(exist_ok=True)
    tempfile.tempdir = str(folder / "temporary")
    os.chdir(folder)
    warnings.simplefilter("ignore")
    sys.stderr = open(os.devnull, "w")  # noqa: SIM115
    chance, seeds = random.Random(seed), seeds_of(reader)
    most = len(seeds) + int(count) if count.startswith("+") else int(count)
    name = READERS[reader][0]
    copy_beside(reader, work)
    for data in seeds:
        # What libraries start and read when they are used for the first time.
        (work / name).write_bytes(data)
        with contextlib.suppress(InputFault, RunFault):
            READERS[reader][1](work / name)
    guard = Guard(folder, Path(os.environ.get("XDG_CACHE_HOME", Path.home() / ".cache")) / "rvwear")
    trace = (folder / "trace").open("w")
    kinds: set[str] = set()
    found: set[str] = set()
    started, done, refused = time.monotonic(), 0, 0
    # What once failed is read as it is: its neighbours would crash the libraries again and again.
    grown = list(SEEDS[reader]())
    while done < most and time.monotonic() - started < seconds:
        # All seeds as they are come first.
        data = seeds[done] if done < len(seeds) else mutant(chance.choice(grown), seeds, chance)
        (work / name).write_bytes(data)
        signal.setitimer(signal.ITIMER_PROF, CPU_SECONDS)
        faulthandler.dump_traceback_later(WALL_SECONDS, exit=True, file=trace)
        wrong, kind = judged(reader, work / name, guard)
        signal.setitimer(signal.ITIMER_PROF, 0.0)
        faulthandler.cancel_dump_traceback_later()
        if done == len(seeds):
            # What the libraries take for themselves is theirs.
            before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
        if done > len(seeds) and resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before > MEMORY // 1024:
            before, wrong = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, "more than 1 GiB of memory"
        done += 1
        refused += kind != "read"
        if kind not in kinds and done > len(seeds):
            kinds.add(kind)
            if len(grown) < MOST_SEEDS:
                grown.append(data)
        short = re.sub(r"[0-9]+|'.*'", "#", wrong)
        if wrong and short not in found:
            found.add(short)
            kept = folder / f"found-{reader}-{hashlib.sha256(data).hexdigest()[:12]}"
            kept.write_bytes(data)
            print(json.dumps({"reader": reader, "wrong": wrong, "file": str(kept)}), flush=True)
        if done % 200 == 0:
            print(json.dumps({"reader": reader, "done": done}), flush=True)
    print(json.dumps({"reader": reader, "done": done, "refused": refused, "kinds": len(kinds)}), flush=True)


if __name__ == "__main__":
    chosen, place = sys.argv[1].split(","), Path(sys.argv[5])
    for one in chosen:
        main(one, int(sys.argv[2]), float(sys.argv[3]), sys.argv[4], place / one if len(chosen) > 1 else place)
