#!/usr/bin/env python3
"""Set up and run everything; needs Python 3.11 or newer and nothing else.

    python3 build.py            set up, build and check the FMUs, run the main job, write the report
    python3 build.py test       set up, run the tests (further arguments go to pytest; --coverage shows what they reach)
    python3 build.py bench      set up, measure the cost of everything against others' (benchmarks/; --quick tries it out)
    python3 build.py fuzz [minutes]     set up, feed every reader with mutants of its files (benchmarks/fuzzing)
    python3 build.py docs       set up, build the documentation site: results/site/index.html
    python3 build.py COMMAND    set up, then: rvwear COMMAND ...

The main job co-simulates RvPlant.fmu and RvWear.fmu of the RV20E-121 at rated load over
10,000 h.  What is up to date is not done again.
"""

import hashlib
import os
import subprocess
import sys
import threading
import time
import venv
from collections.abc import Iterable
from pathlib import Path

HERE = Path(__file__).resolve().parent
ENVIRONMENT = HERE / ".venv"
SCRIPTS = ENVIRONMENT / ("Scripts" if os.name == "nt" else "bin")
# What runs the product, and what tests and measurements need besides.
REQUIREMENTS, FOR_TESTS = HERE / "requirements.txt", HERE / "requirements-test.txt"
REDUCER = "RV20E-121"
# What the measurements compare with, and what spreads ensembles.
PEERS = ("scikit-sundae==1.2.0", "exudyn==1.13.6", "joblib==1.6.0", "SALib==1.6.0", "dask==2026.8.0", "distributed==2026.8.0")
PIP = ("-m", "pip", "--disable-pip-version-check", "install", "--no-compile", "--no-deps")
# What pip warns of for each package where a machine has indexes in folders and one of them lacks it: another has it, or pip ends with an error.
OF_NO_USE = "is ignored: it is neither a file nor a directory"


def set_up(for_tests: bool = False) -> None:
    """A virtual environment with the pinned packages and this project; kept while they stay the same."""
    stamp = ENVIRONMENT / "set-up-done"
    described = (HERE / name for name in ("requirements.txt", "pyproject.toml", "setup.py"))
    parts = (sys.version.encode(), str(HERE).encode(), *(path.read_bytes() for path in described))
    if not is_done(stamp, *parts):
        say("setting up .venv, once: about half a minute")
        try:
            venv.create(ENVIRONMENT, with_pip=True, clear=not stamp.exists())
        except subprocess.CalledProcessError:
            sys.exit("build.py: this Python has no ensurepip; on Debian and Ubuntu install the package python3-venv")
        install("what the product needs", "-r", str(REQUIREMENTS))
        # By its path: else a folder that holds the clone hides the package of its name.
        install("the project itself", "--config-settings", "editable_mode=compat", "-e", str(HERE))
        done(stamp, *parts)
    stamp, parts = ENVIRONMENT / "set-up-for-tests-done", (stamp.read_bytes(), FOR_TESTS.read_bytes())
    if for_tests and not is_done(stamp, *parts):
        install("what the tests need besides", "-r", str(FOR_TESTS))
        done(stamp, *parts)


def say(text: str) -> None:
    print(text, file=sys.stderr, flush=True)


def install(what: str, *arguments: str) -> None:
    """pip, with a line every few seconds that says how far it is."""
    count = sum(1 for line in Path(arguments[1]).read_text(encoding="utf-8").splitlines() if line) if arguments[0] == "-r" else 1
    command = [str(SCRIPTS / "python"), *PIP, *arguments]
    with subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE, encoding="utf-8", errors="replace") as pip:
        told, fetched, installing, lines = time.monotonic(), 0, False, []
        assert pip.stdout is not None and pip.stderr is not None
        # Beside its progress: a pipe that nobody reads holds pip.
        warnings = threading.Thread(target=pass_on, args=(pip.stderr,))
        warnings.start()
        for line in pip.stdout:
            lines.append(line)
            # "Processing" where an index names files of this machine.
            fetched += line.startswith(("Collecting", "Processing"))
            if line.startswith("Installing collected"):
                installing = True
                say(f"  {what}: installing")
            elif not installing and time.monotonic() - told > 3.0:
                told = time.monotonic()
                say(f"  {what}: fetching {fetched} of {count}")
        warnings.join()
    if pip.returncode != 0:
        sys.exit("".join(lines[-5:]) + "build.py: pip could not install the packages; its message stands above")


def pass_on(warnings: Iterable[str]) -> None:
    """What pip warns of and fails by, but for ``OF_NO_USE``."""
    for line in warnings:
        if OF_NO_USE not in line:
            say(line.rstrip())


def is_done(stamp: Path, *parts: bytes) -> bool:
    return stamp.exists() and stamp.read_text(encoding="utf-8") == digest(parts)


def done(stamp: Path, *parts: bytes) -> None:
    stamp.write_text(digest(parts), encoding="utf-8")


def digest(parts: tuple[bytes, ...]) -> str:
    return hashlib.sha256(b"\0".join(parts)).hexdigest()


def rvwear(*arguments: str) -> int:
    return subprocess.run([str(SCRIPTS / "rvwear"), *arguments]).returncode


def bench(arguments: list[str]) -> int:
    """The measurements; what they compare with is installed if it can be, and left out if not."""
    python = str(SCRIPTS / "python")
    peers = [python, "-c", "import sksundae, exudyn, joblib, SALib, distributed"]
    if subprocess.run(peers, stderr=subprocess.DEVNULL).returncode != 0:
        pip = [python, "-m", "pip", "--quiet", "--disable-pip-version-check", "install"]
        if subprocess.run([*pip, *PEERS]).returncode != 0:
            print("build.py: pip could not install the packages compared with; their rows are missing", file=sys.stderr)
    return subprocess.run([python, "-m", "benchmarks", *arguments], cwd=HERE).returncode


def main(arguments: list[str]) -> int:
    if sys.version_info < (3, 11):  # noqa: UP036
        sys.exit(f"build.py: Python 3.11 or newer is needed, this is {sys.version.split()[0]}")
    set_up(for_tests=arguments[:1] in (["test"], ["bench"], ["fuzz"], ["docs"]))
    if arguments[:1] == ["test"]:
        tests = ["tests/measure_coverage.py"] if "--coverage" in arguments else ["-m", "pytest"]
        arguments = [argument for argument in arguments[1:] if argument != "--coverage"]
        return subprocess.run([str(SCRIPTS / "python"), *tests, *arguments], cwd=HERE).returncode
    if arguments[:1] == ["bench"]:
        return bench(arguments[1:])
    if arguments[:1] == ["fuzz"]:
        return subprocess.run([str(SCRIPTS / "python"), "-m", "benchmarks.fuzzing", *arguments[1:]], cwd=HERE).returncode
    if arguments[:1] == ["docs"]:
        return subprocess.run([str(SCRIPTS / "python"), "-m", "sphinx", "-q", "-W", "--keep-going", "docs", "results/site"], cwd=HERE).returncode
    if arguments:
        return rvwear(*arguments)
    os.chdir(HERE)
    if problem := rvwear("build", "--output", "dist"):
        return problem
    # What later commands compute with is compiled now; beside the life, which leaves a core.  Ctrl-C is for the life: this takes seconds and ends by itself.
    ahead = subprocess.Popen([str(SCRIPTS / "python"), "-m", "discrepancy.prediction.compiled_ahead", REDUCER], start_new_session=True)
    problem = rvwear("life", "--reducer", REDUCER, "--fmus", "dist", "--reuse", "--output", f"results/{REDUCER}.nc")
    return ahead.wait() or problem


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except KeyboardInterrupt:
        sys.exit(130)
