"""Finished lives, one line each as they come: what is kept when a run is stopped."""

import json
import os
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from fmu_src.checked_file import checksum_line, write_fault, write_text
from fmu_src.faults import InputFault
from fmu_src.reading import reading, require_size
from studies.ensemble.figures import Outcome

REMEDY = "choose another --output, or discard it with --restart"
# Bytes that are read (assumed: a million lives).
MOST = 5_000_000_000


class Store:
    """Append-only file of lives; a life counts once however often it arrives."""

    def __init__(self, path: Path, identity: dict[str, Any], restart: bool = False):
        self.path = path
        self.lives: dict[int, Outcome] = {}
        self.damaged = 0
        # As JSON has it, to compare with what was read.
        identity = json.loads(json.dumps(identity))
        if path.exists() and not restart:
            self.read(identity)
            return
        write_text(path, line_of({"ensemble": identity}))

    def read(self, identity: dict[str, Any]) -> None:
        with reading(self.path, "the lives of an ensemble", REMEDY):
            require_size(self.path, MOST)
            self.take(self.path.read_bytes(), identity)

    def take(self, text: bytes, identity: dict[str, Any]) -> None:
        lines = text.decode("utf-8", "replace").split("\n")
        head = content_of(lines[0]).get("ensemble")
        if not isinstance(head, dict):
            raise InputFault(f"{self.path} holds no ensemble, or its first line is damaged; {REMEDY}")
        different = sorted(key for key in identity.keys() | head.keys() if identity.get(key) != head.get(key))
        if different:
            raise InputFault(f"{self.path} holds lives of another ensemble ({', '.join(different)} differ): --restart discards them")
        for line in lines[1:]:
            # A line that a kill cut off, or that is damaged: that life runs again.
            life = content_of(line)
            if is_life(life):
                self.lives.setdefault(life["number"], life)  # type: ignore[arg-type]
            elif line:
                self.damaged += 1
        if text and not text.endswith(b"\n"):
            with self.path.open("ab") as file:
                file.write(b"\n")

    def add(self, life: Outcome) -> bool:
        """Keep a life; False if it is there already."""
        if life["number"] in self.lives:
            return False
        try:
            with self.path.open("a", encoding="utf-8") as file:
                file.write(line_of(life))
                file.flush()
                os.fsync(file.fileno())
        except OSError as problem:
            raise write_fault(self.path, problem) from None
        self.lives[life["number"]] = life
        return True


def line_of(content: Mapping[str, Any]) -> str:
    """One line: the content as JSON, and its checksum."""
    text = json.dumps(content)
    return f"{text}\t{checksum_line(text.encode()).decode()}"


def content_of(line: str) -> dict[str, Any]:
    """What ``line_of`` was given; empty if the line is not whole."""
    text, _, sum_given = line.rpartition("\t")
    if checksum_line(text.encode()).decode().strip() != sum_given:
        return {}
    found = json.loads(text)
    return found if isinstance(found, dict) else {}


def is_life(life: dict[str, Any]) -> bool:
    """Whether it has what a life has: a number, and a fault or as many figures as hours."""
    if not isinstance(life.get("number"), int):
        return False
    if isinstance(life.get("fault"), str):
        return True
    hours, figures = life.get("hours"), life.get("figures")
    return isinstance(hours, list) and isinstance(figures, dict) and all(isinstance(f, list) and len(f) == len(hours) for f in figures.values())
