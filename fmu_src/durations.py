"""How long tasks took before, so that what is left can be told of those whose steps nobody can count, or differ in cost.

Of counted steps it is the time of one.  Kept by command line and by what is done: the same command again takes about as long,
another one of its kind as long as the last did.
"""

import hashlib
import json
from functools import cached_property
from pathlib import Path

from fmu_src import checked_file
from fmu_src.cache_folder import cache_folder
from fmu_src.progress import Task

MARK = b"rvwear durations 1\n"
# What is over sooner needs no estimate [s]; so many are kept.
LONG, MOST = 2.0, 500


class Durations:
    """Of one command, told by its words; read when the first task asks, written when a long one ends."""

    def __init__(self, words: list[str]):
        self.command = hashlib.sha256("\0".join(words).encode("utf-8", "surrogatepass")).hexdigest()[:16]
        self.kind = words[0] if words else ""

    @cached_property
    def place(self) -> Path:
        return cache_folder("durations") / "tasks"

    @cached_property
    def known(self) -> dict[str, float]:
        """Seconds by key; nothing where there is nothing that can be read."""
        try:
            found = json.loads(checked_file.read(self.place, MARK) or b"{}")
        except (ValueError, OSError):
            return {}
        return {str(k): float(v) for k, v in found.items() if isinstance(v, (int, float))} if isinstance(found, dict) else {}

    def keys(self, task: Task) -> tuple[str, str]:
        name = f"one of {task.name}" if task.total else task.name
        return f"{self.command} {name}", f"{self.kind} {name}"

    def begin(self, task: Task) -> None:
        """Tells the task how long it took before, unless it knows it itself."""
        if task.about is None:
            own, alike = self.keys(task)
            # Another model or campaign may take another time; what is found decides how long the whole takes, and says nothing of another.
            before = self.known.get(own, None if task.whole else self.known.get(alike))
            task.like = "" if before is None or own in self.known else f"the last {self.kind}"
            task.before = before if before is None or not task.total else before * task.total

    def end(self, task: Task) -> None:
        """Keeps how long it took, if that was long; the first of many steps say little of the others, and what was interrupted of the whole."""
        if not task.broken and task.about is None and task.passed > LONG and task.done >= (task.total or 0):
            seconds = task.passed / (task.total or 1)
            kept = {key: known for key, known in self.known.items() if key not in self.keys(task)}
            kept |= dict.fromkeys(self.keys(task), float(f"{seconds:.3g}"))
            self.__dict__["known"] = dict(list(kept.items())[-MOST:])
            checked_file.write(self.place, MARK, json.dumps(self.known).encode())
