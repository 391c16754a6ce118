"""What is made once per run of the tests, whichever worker of pytest-xdist asks first; what several tests ask."""

import base64
import gzip
import os
import re
import time
from collections.abc import Callable
from contextlib import contextmanager
from pathlib import Path

import lark
from fmpy.validation import validate_fmu

try:
    import fcntl
except ImportError:  # Windows: every worker makes its own.
    fcntl = None


@contextmanager
def alone(path: Path):
    """Only one process at a time gets in here; the system lets go of a process that is gone."""
    with path.open("wb") as file:
        fcntl.flock(file, fcntl.LOCK_EX)
        yield


def made_once(tmp_path_factory, name: str, make: Callable[[Path], None]) -> Path:
    """The folder ``name`` that ``make`` fills; a second worker waits for it and takes it as it is."""
    own = tmp_path_factory.getbasetemp()
    if fcntl is None or "PYTEST_XDIST_WORKER" not in os.environ:
        make(own / name)
        return own / name
    folder, complete = own.parent / name, own.parent / f"{name}.complete"
    with alone(own.parent / f"{name}.lock"):
        if not complete.exists():
            make(folder)
            complete.touch()
    return folder


class Names(lark.Lark):
    """The grammar of names takes a run of digits wherever it takes one: what differs in digits alone is parsed once."""

    known: set[str] = set()

    def parse(self, text, *arguments, **named):
        alike = re.sub("[0-9]+", "1", text)
        if alike not in self.known:
            super().parse(text, *arguments, **named)
            self.known.add(alike)


def problems_of(fmu: Path, monkeypatch) -> list[str]:
    """All that fmpy's validation finds, in a tenth of its time, which goes into the names of the arrays' elements."""
    monkeypatch.setattr(lark, "Lark", Names)
    return validate_fmu(str(fmu))


def gone(group: int, seconds: float = 10.0) -> bool:
    """Whether all processes of a group end soon."""
    until = time.monotonic() + seconds
    while time.monotonic() < until:
        try:
            os.killpg(group, 0)
        except ProcessLookupError:
            return True
        time.sleep(0.1)
    return False


def unpacked(page: str) -> str:
    """The library that a page carries packed."""
    packed = page.partition('id="plotly">')[2].partition("<")[0]
    return gzip.decompress(base64.b64decode(packed)).decode()
