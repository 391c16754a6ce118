"""What this installation has, what it lacks, and what each lack means."""

import os
import platform
import re
import shutil
import subprocess
import sys
import time
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

from fmu_src.cache_folder import root
from fmu_src.faults import InputFault, RunFault
from fmu_src.project import NAME, project, requirements
from fmu_src.source_hash import USER_EFFECTS

GOOD, ABSENT, WRONG = "ok", "absent", "wrong"
# What the optional parts are for; those that only builders of this project need are left out.
PARTS = {
    "measurements": "reading MAT 7.3, MDF, TDMS, Parquet and Excel; writing Parquet and Excel",
    "pictures": "figures as SVG, PDF and PNG (--picture)",
    "workbench": "the whole loop in a browser (rvwear workbench)",
    "ensembles": "lives of many reducers on all cores or a cluster (rvwear ensemble)",
    "build": "FMUs for other platforms, and for this one without a C compiler",
    "rivals": "trees that know no physics beside the answer of examples/rv_reducer_te",
    "wasm": "stepping FMUs as WebAssembly (rvwear run --wasm)",
}  # fmt: skip
REQUIREMENT = re.compile(r"([A-Za-z0-9._-]+)(?:\[.*?\])?\s*(?:>=\s*([\d.]+))?")
# Bytes without which results and units do not find room (assumed).
LITTLE_ROOM = 500_000_000


@dataclass(frozen=True)
class Finding:
    """``state``: ok, absent (optional) or wrong; ``remedy``: what to do, empty where nothing is."""

    what: str
    state: str
    text: str
    remedy: str = ""

    def as_json(self) -> dict[str, str]:
        return asdict(self)


def findings() -> list[Finding]:
    return [*environment(), *packages(), *compiler(), *places(), *own_effects(), works()]


def environment() -> Iterator[Finding]:
    yield Finding(NAME, GOOD, f"{project().version}, in {Path(__file__).resolve().parents[1]}")
    cores = len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
    yield Finding("Python", GOOD, f"{platform.python_version()}, {sys.executable}")
    yield Finding("machine", GOOD, f"{platform.system()} {platform.machine()}, {cores} cores")
    encoding = (sys.stdout.encoding or "").lower()
    text = "signs that it does not know are shown as ?"
    knows_all = encoding.startswith("utf")
    yield Finding("console", GOOD if knows_all else ABSENT, encoding or "none", "" if knows_all else f"{text}; set PYTHONUTF8=1")


def packages() -> Iterator[Finding]:
    """What is needed in one line, or one for each that is missing; the optional parts a line each."""
    for part, needed in requirements().items():
        if part and part not in PARTS:
            continue
        missing = [text for name, text in map(lack_of, needed) if text]
        if not part:
            remedy = f'{pip()} install --upgrade "{NAME}"'
            yield Finding("packages", WRONG if missing else GOOD, ", ".join(missing) or f"all {len(needed)} that are needed", remedy if missing else "")
        else:
            remedy = f'{pip()} install "{NAME}[{part}]"'
            state = ABSENT if missing else GOOD
            yield Finding(f"[{part}]", state, f"{PARTS[part]}" + (f": {', '.join(missing)}" if missing else ""), remedy if missing else "")


def pip() -> str:
    """The command that installs into this Python, and no other."""
    found = shutil.which("pip")
    return "pip" if found and Path(found).parent == Path(sys.executable).parent else f"{sys.executable} -m pip"


def lack_of(requirement: str) -> tuple[str, str]:
    """(name, what is wrong with it or "") of a requirement like ``numpy>=2.4``."""
    match = REQUIREMENT.match(requirement)
    if match is None:
        return requirement, ""
    name, least = match[1], match[2]
    try:
        found = version(name)
    except PackageNotFoundError:
        return name, f"{name} is not installed"
    if least and numbers_of(found) < numbers_of(least):
        return name, f"{name} {found} is older than {least}"
    return name, ""


def numbers_of(text: str) -> tuple[int, ...]:
    return tuple(int(number) for number in re.findall(r"\d+", text.partition("+")[0])[:3])


def compiler() -> Iterator[Finding]:
    """Native FMUs need a C compiler; all else does without."""
    from fmu_src.link import compiler as compiler_of
    from fmu_src.link import host_platform
    from fmu_src.native import NativeFault

    try:
        command = compiler_of(host_platform(), False)
    except NativeFault as fault:
        yield Finding("C compiler", ABSENT, "native FMUs and those of sources cannot be built", str(fault))
        return
    said = subprocess.run([command[0], *(["-m", "ziglang", "version"] if "ziglang" in command else ["--version"])], capture_output=True, text=True)
    if said.returncode:
        yield Finding("C compiler", WRONG, f"{command[0]} does not run: {said.stderr.strip()[:200]}", "repair it, or name another by CC")
    else:
        yield Finding("C compiler", GOOD, f"{said.stdout.splitlines()[0].strip() if said.stdout else command[0]} (for {host_platform().name})")


def places() -> Iterator[Finding]:
    folder = root()
    size = sum(path.stat().st_size for path in folder.rglob("*") if path.is_file())
    kept = "rvwear-" not in folder.name
    remedy = "set XDG_CACHE_HOME to a folder of your own: kernels are compiled anew in each run"
    yield Finding("cache", GOOD if kept else WRONG, f"{folder}, {size / 1e6:.0f} MB", "" if kept else remedy)
    for what, place in (("room here", Path.cwd()), ("room for temporary files", Path(os.environ.get("TMPDIR", "/tmp" if os.name == "posix" else ".")))):
        left = shutil.disk_usage(place).free
        enough = left > LITTLE_ROOM and os.access(place, os.W_OK)
        yield Finding(what, GOOD if enough else WRONG, f"{left / 1e9:.1f} GB in {place}", "" if enough else "make room, or work in another folder")


def own_effects() -> Iterator[Finding]:
    from fmu_src.effect_check import check_any_file
    from fmu_src.source_hash import user_effect_files

    chosen = os.environ.get(USER_EFFECTS)
    if not chosen:
        yield Finding("own effects", GOOD, f"none ({USER_EFFECTS} is not set)")
        return
    if not Path(chosen).is_dir():
        yield Finding("own effects", WRONG, f"{USER_EFFECTS}={chosen} is no folder", "name the folder that holds rv_plant/ or wear_fmu/")
        return
    files = [file for unit in ("rv_plant", "wear_fmu") for _, file in user_effect_files(unit)]
    faults = [str(finding) for file in files for finding in check_any_file(file)]
    text = f"{len(files)} in {chosen}" + (f"; {faults[0]}" if faults else "")
    remedy = "rvwear effects --check FILE says all" if faults else "" if files else "files go into rv_plant/ or wear_fmu/ there"
    yield Finding("own effects", WRONG if faults or not files else GOOD, text, remedy)


def works() -> Finding:
    """One equilibrium of the usual reducer, compiled where it was not before."""
    from orchestrator.component import InProcess
    from reducers.reducer import load_reducer

    start = time.perf_counter()
    try:
        plant = InProcess("plant", load_reducer("RV20E-121-rigid").specification("rv_plant"))
        plant.exit_initialisation()
        force = plant.number("largest_pin_force")
    except (InputFault, RunFault, OSError) as fault:
        return Finding("kernels", WRONG, f"the plant does not start: {fault}", "report this with the output of rvwear doctor --json")
    right = abs(force - 275.0) < 50.0
    text = f"largest pin force of RV20E-121-rigid {force:.1f} N, after {time.perf_counter() - start:.1f} s"
    return Finding("kernels", GOOD if right else WRONG, text, "" if right else "report this with the output of rvwear doctor --json")
