"""The process of a job: ``python -m workbench.work FOLDER KIND``."""

import os
import signal
import sys
import threading
import time
import traceback
from pathlib import Path
from types import FrameType

from fmu_src.durations import Durations
from fmu_src.faults import InputFault, RunFault
from fmu_src.progress import Task, left_in_all, told_to
from workbench import jobs
from workbench.folder import Folder
from workbench.page_words import on_page
from workbench.told import in_words

# How often the folder is told how far it is [s], and how many lines of results on the way are kept.
BEAT, MOST_SAID = 0.4, 200
# What its tasks may be told of at once.
MOST_TASKS = 6


class Teller:
    """Listens to the tasks, writes them to ``beat.json`` and looks for ``stop``."""

    def __init__(self, folder: Folder, kind: str):
        self.folder, self.kind = folder, kind
        self.place = jobs.place_of(folder, kind)
        self.tasks: list[Task] = []
        self.said: list[str] = []
        self.model = str(folder.recall(f"jobs/{kind}/job").get("given", {}).get("model") or "")
        self.stamp = folder.stamp(self.model)
        # As the command's, which took as long.
        self.durations = Durations([kind, str(folder.root), self.model])
        self.begun = time.monotonic()
        self.ended = threading.Event()
        self.asked = False
        self.thread = threading.Thread(target=self.beat, daemon=True)
        self.thread.start()

    def begin(self, task: Task) -> None:
        self.durations.begin(task)
        self.tasks.append(task)

    def end(self, task: Task) -> None:
        self.tasks.remove(task)
        self.durations.end(task)

    def say(self, text: str) -> None:
        self.said.append(in_words(text))
        del self.said[:-MOST_SAID]

    def beat(self) -> None:
        while not self.ended.wait(BEAT):
            self.write(jobs.RUNNING)
            if not self.asked and (self.place / "stop").exists():
                self.asked = True
                # As Ctrl-C at the command.
                if os.name == "posix":
                    os.kill(os.getpid(), signal.SIGINT)
                else:
                    signal.raise_signal(signal.SIGINT)

    def write(self, state: str, fault: str = "") -> None:
        tasks = [{"what": in_words(t.what), "done": t.done, "total": t.total, "left": t.left, "before": t.before, "span": t.span,
                  "sentence": in_words(t.sentence())} for t in self.tasks[-MOST_TASKS:]]  # fmt: skip
        beat = {"state": state, "at": time.time(), "seconds": time.monotonic() - self.begun, "tasks": tasks, "whole": left_in_all(self.tasks[:-1]),
                "said": self.said, "fault": fault, "stamp": self.stamp}  # fmt: skip
        try:
            self.folder.remember(f"jobs/{self.kind}/beat", beat)
        except (InputFault, RunFault) as problem:
            print(problem, file=sys.stderr, flush=True)

    def close(self, state: str, fault: str = "") -> None:
        self.ended.set()
        self.thread.join()
        self.tasks.clear()
        # An effect that is added changes the folder itself: its result is not old by that.
        self.stamp = self.folder.stamp(self.model)
        self.write(state, fault)


def interrupt(_: int, __: FrameType | None) -> None:
    raise KeyboardInterrupt


def main(root: str, kind: str) -> int:
    from workbench import steps

    signal.signal(signal.SIGINT, interrupt)
    folder = Folder(Path(root))
    asked = folder.recall(f"jobs/{kind}/job")
    teller = Teller(folder, kind)
    try:
        with told_to(teller):
            stopped = steps.STEPS[kind](folder, asked["given"], int(asked["jobs"]), teller.place)
        teller.close(jobs.STOPPED if stopped else jobs.DONE)
    except KeyboardInterrupt:
        teller.close(jobs.STOPPED)
    except (InputFault, RunFault, OSError) as fault:
        teller.close(jobs.FAILED, on_page(str(fault)))
        return 1
    except BaseException as problem:
        traceback.print_exc()
        teller.close(jobs.FAILED, f"{type(problem).__name__}: {problem} (a fault of the program; the whole of it is in {teller.place / 'log.txt'})")
        raise
    return 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
