"""Every writer, with a disk that is full after so many bytes, and killed after so many bytes: run as a script by test_failing_writes.py.

A limit on the size of files does both, in Python and in the libraries: a write beyond it fails (EFBIG, after a short write), or, where the
signal is not ignored, ends the process in the middle of it.
"""

import json
import os
import resource
import signal
import sys
from pathlib import Path

import numpy as np

from discrepancy.model_file import ModelFile, load_model, save_model
from fmu_src import checked_file
from fmu_src.faults import InputFault, RunFault
from fmu_src.package import write_archive
from orchestrator.series import read_series, write_series
from pages.render import written
from reducers.reducer import load_reducer
from studies.checkpoint import load_checkpoint, save_checkpoint
from studies.ensemble.store import Store
from studies.life import Life, LifeSettings
from studies.solve import Turn

# Places in each file where the disk is full: RVWEAR_WRITES=12 for more.
POINTS = int(os.environ.get("RVWEAR_WRITES", "3"))
REDUCER = load_reducer("RV20E-121-rigid")


def series(n):
    return {"time": np.arange(2000.0), "a.x": np.random.default_rng(1).random(2000) + n}


def write_result(path, n):
    write_series(series(n), {"a.x": "m"}, {}, path)


def read_result(path):
    return int(read_series(path)["a.x"][0])


def write_checkpoint(path, n):
    life = Life(LifeSettings(hours=100.0), hours=[0.0], figures=[{"a": 0.0}], errors=[0.0], cycles=n, jumps=2, coarse=[])
    life.surfaces, life.turns = [{"disc_wear": np.random.default_rng(1).random(3000)}], [Turn({"lag": np.zeros(4)})]
    states = {"clock": [0.0, 0, 0.0], "states": {"plant": bytes(80)}}
    life.start = states
    save_checkpoint(path, life, states, {})


def write_model(path, n):
    save_model(ModelFile(f"m{n}", REDUCER, steps=({"effects": ["a" * 3000], "kept": True},)), path)


def write_lives(path, n):
    """What was there before stays, too."""
    store = Store(path, {"seed": 1})
    for number in range(len(store.lives), n):
        store.add({"number": number, "fault": "x" * 300})


WRITERS = {
    "a.nc": (write_result, read_result), "a.csv": (write_result, read_result),
    "a.checkpoint": (write_checkpoint, lambda path: load_checkpoint(path, {})[0].cycles),
    "a.toml": (write_model, lambda path: int(load_model(path).name[1:])),
    "a.html": (lambda path, n: written(str(n) * 5000, path), lambda path: int(path.read_text()[:1]) if len(set(path.read_text())) == 1 and len(path.read_text()) == 5000 else -1),
    "a.fmu": (lambda path, n: write_archive({"a": os.urandom(3000), "n": str(n).encode()}, path), lambda path: int(__import__("zipfile").ZipFile(path).read("n"))),
    "a.lives": (write_lives, lambda path: len(Store(path, {"seed": 1}).lives)),
}  # fmt: skip


def in_child(write, path, limit, killed, at_call):
    """What a process says that writes 2 over 1 with that limit: "saved", the fault, or nothing."""
    reader, writer = os.pipe()
    child = os.fork()
    if child == 0:
        signal.signal(signal.SIGXFSZ, signal.SIG_DFL if killed else signal.SIG_IGN)
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))
        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, resource.RLIM_INFINITY))
        for name, number in (("fsync", at_call), ("replace", at_call - 1)):
            if number == 0:
                failing(name, killed)
        try:
            write(path, 2)
            said = "saved"
        except (InputFault, RunFault) as fault:
            said = f"fault: {fault}"
        except BaseException as problem:  # noqa: BLE001
            said = f"{type(problem).__name__}: {problem}"
        resource.setrlimit(resource.RLIMIT_FSIZE, (resource.RLIM_INFINITY, resource.RLIM_INFINITY))
        os.write(writer, said.encode())
        os._exit(0)
    os.close(writer)
    with os.fdopen(reader, "rb") as stream:
        said = stream.read().decode()
    os.waitpid(child, 0)
    return said


def failing(name, killed):
    def fail(*_):
        if killed:
            os.kill(os.getpid(), signal.SIGKILL)
        raise OSError(5, "Input/output error")

    setattr(checked_file.os, name, fail)


def main(folder):
    trials, wrong = 0, []
    for name, (write, read) in WRITERS.items():
        path = folder / name
        write(path, 1)
        size = path.stat().st_size
        limits = sorted({0, 1, size - 1, size // 2, *np.linspace(0, 2 * size, POINTS).astype(int).tolist()})
        for killed in (False, True):
            for limit, at_call in [*((limit, -1) for limit in limits), (1 << 40, 0), (1 << 40, 1)]:
                path.unlink()
                write(path, 1)
                said = in_child(write, path, limit, killed, at_call)
                trials += 1
                place = f"{name}, {'killed' if killed else 'failing'} after {limit} bytes (call {at_call}): said {said!r}"
                try:
                    found = read(path)
                except Exception as problem:  # noqa: BLE001
                    wrong.append(f"{place}: cannot be read: {problem}")
                    continue
                # A line that was appended and not brought to the disk is said to be missing, and may be there.
                kept = (1, 2) if name == "a.lives" else (1,)
                if found not in (1, 2) or (said == "saved" and found != 2) or (said.startswith("fault") and found not in kept):
                    wrong.append(f"{place}: holds {found}")
                if said != "saved" and not (said == "" if killed else said.startswith("fault") and name in said and "no such" not in said):
                    wrong.append(place)
                left = [other.name for other in folder.iterdir() if other.name.endswith(".part")]
                if left and not killed:
                    wrong.append(f"{place}: left {left}")
                for other in left:
                    (folder / other).unlink()
        path.unlink()
    print(json.dumps({"trials": trials, "wrong": wrong}))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
