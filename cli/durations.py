"""How long tasks took before, so that what is left can be told of those whose steps nobody can count.

Kept by command line and by what is done: the same command again takes about as long, another one of its kind as long as the last did.
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
        return f"{self.command} {task.what}", f"{self.kind} {task.what}"

    def begin(self, task: Task) -> None:
        """Tells the task how long it took before, unless it counts its steps or knows it itself."""
        if task.total is None and task.about is None:
            task.before = next((self.known[key] for key in self.keys(task) if key in self.known), None)

    def end(self, task: Task) -> None:
        """Keeps how long it took, if that was long."""
        if task.total is None and task.about is None and task.passed > LONG:
            kept = {key: seconds for key, seconds in self.known.items() if key not in self.keys(task)}
            kept |= dict.fromkeys(self.keys(task), round(task.passed, 1))
            self.__dict__["known"] = dict(list(kept.items())[-MOST:])
            checked_file.write(self.place, MARK, json.dumps(self.known).encode())
