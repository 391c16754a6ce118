"""Finished lives, one line each as they come: what is kept when a run is stopped."""

import json
from pathlib import Path
from typing import Any

from fmu_src.faults import InputFault
from studies.ensemble.figures import Outcome


class Store:
    """Append-only file of lives; a life counts once however often it arrives."""

    def __init__(self, path: Path, identity: dict[str, Any], restart: bool = False):
        self.path = path
        self.lives: dict[int, Outcome] = {}
        # As JSON has it, to compare with what was read.
        identity = json.loads(json.dumps(identity))
        path.parent.mkdir(parents=True, exist_ok=True)
        if path.exists() and not restart:
            self.read(identity)
            return
        path.write_text(json.dumps({"ensemble": identity}) + "\n", encoding="utf-8")

    def read(self, identity: dict[str, Any]) -> None:
        text = self.path.read_bytes()
        lines = text.decode("utf-8", "replace").split("\n")
        try:
            head = json.loads(lines[0])["ensemble"]
        except (ValueError, KeyError, TypeError):
            raise InputFault(f"{self.path} holds no ensemble; choose another --output, or --restart") from None
        different = sorted(key for key in identity.keys() | head.keys() if identity.get(key) != head.get(key))
        if different:
            raise InputFault(f"{self.path} holds lives of another ensemble ({', '.join(different)} differ): --restart discards them")
        for line in lines[1:]:
            try:
                life = json.loads(line)
                self.lives.setdefault(life["number"], life)
            except (ValueError, KeyError, TypeError):
                # A line that a kill cut off: that life runs again.
                continue
        if text and not text.endswith(b"\n"):
            with self.path.open("ab") as file:
                file.write(b"\n")

    def add(self, life: Outcome) -> bool:
        """Keep a life; False if it is there already."""
        if life["number"] in self.lives:
            return False
        self.lives[life["number"]] = life
        with self.path.open("a", encoding="utf-8") as file:
            file.write(json.dumps(life) + "\n")
        return True
