#!/usr/bin/env python3
"""Set up and run everything; needs Python 3.11 or newer and nothing else.

    python3 build.py            set up, build and check the FMUs, run the main job, write the report
    python3 build.py test       set up, run the tests (further arguments go to pytest)
    python3 build.py bench      set up, measure the cost of everything against others' (benchmarks/; --quick tries it out)
    python3 build.py COMMAND    set up, then: rvwear COMMAND ...

The main job co-simulates RvPlant.fmu and RvWear.fmu of the RV20E-121 at rated load over
10,000 h.  What is up to date is not done again.
"""

import hashlib
import os
import subprocess
import sys
import venv
from pathlib import Path

HERE = Path(__file__).resolve().parent
ENVIRONMENT = HERE / ".venv"
SCRIPTS = ENVIRONMENT / ("Scripts" if os.name == "nt" else "bin")
REQUIREMENTS = HERE / "requirements.txt"
# What the measurements compare with, and what spreads ensembles.
PEERS = ("scikit-sundae==1.2.0", "exudyn==1.13.6", "joblib==1.6.0", "SALib==1.6.0", "dask==2026.8.0", "distributed==2026.8.0")
STAMP = ENVIRONMENT / "set-up-done"


def set_up() -> None:
    """A virtual environment with the pinned packages and this project; kept while they stay the same."""
    parts = (sys.version.encode(), str(HERE).encode(), REQUIREMENTS.read_bytes(), (HERE / "pyproject.toml").read_bytes())
    wanted = hashlib.sha256(b"\0".join(parts)).hexdigest()
    if STAMP.exists() and STAMP.read_text() == wanted:
        return
    print("setting up .venv (once; about a minute)", flush=True)
    try:
        venv.create(ENVIRONMENT, with_pip=True, clear=not STAMP.exists())
    except subprocess.CalledProcessError:
        sys.exit("build.py: this Python has no ensurepip; on Debian and Ubuntu install the package python3-venv")
    python = SCRIPTS / "python"
    pip = [str(python), "-m", "pip", "--quiet", "--disable-pip-version-check", "install"]
    for arguments in (["-r", str(REQUIREMENTS)], ["--no-deps", "-e", str(HERE)]):
        if subprocess.run(pip + arguments).returncode != 0:
            sys.exit("build.py: pip could not install the packages; its message stands above")
    STAMP.write_text(wanted)


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
    if sys.version_info < (3, 11):
        sys.exit(f"build.py: Python 3.11 or newer is needed, this is {sys.version.split()[0]}")
    set_up()
    if arguments[:1] == ["test"]:
        return subprocess.run([str(SCRIPTS / "python"), "-m", "pytest", *arguments[1:]], cwd=HERE).returncode
    if arguments[:1] == ["bench"]:
        return bench(arguments[1:])
    if arguments:
        return rvwear(*arguments)
    os.chdir(HERE)
    return rvwear("build", "--output", "dist") or rvwear(
        "life", "--reducer", "RV20E-121", "--fmus", "dist", "--reuse", "--output", "results/RV20E-121.nc"
    )


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except KeyboardInterrupt:
        sys.exit(130)
