"""Help and completion answer at once: nothing that computes or draws is loaded for them."""

import os
import subprocess
import sys

import pytest

from cli.main import parser
from fmu_src.project import project

HEAVY = {"numpy", "numba", "llvmlite", "pandas", "xarray", "plotly", "scipy", "pydantic", "rich", "fmpy", "jinja2", "pint"}
# CPU seconds, the interpreter's own start included.
SOON = 0.3


def modules_after(arguments: list[str], **environment: str) -> tuple[set[str], float, str]:
    """(modules that ``rvwear`` has loaded when it ends, CPU time [s] that it took, what it printed)."""
    script = (
        "import sys, time\nfrom cli.main import main\ntry:\n    main()\nexcept SystemExit:\n    pass\n"
        "print(time.process_time(), *sorted({name.partition('.')[0] for name in sys.modules}), file=sys.stderr)"
    )
    done = subprocess.run(
        [sys.executable, "-c", script, *arguments], capture_output=True, text=True, env=os.environ | environment, check=True
    )
    seconds, *names = done.stderr.split("\n")[-2].split()
    return set(names), float(seconds), done.stdout


def at_once(arguments: list[str]) -> tuple[set[str], str]:
    """(modules, text) of a command that takes less CPU time than ``SOON``, at least once in three: a shared core makes it longer, nothing shorter."""
    for _ in range(3):
        loaded, seconds, text = modules_after(arguments)
        if seconds < SOON:
            break
    assert seconds < SOON
    return loaded, text


COMMANDS = sorted(next(a for a in parser()._actions if a.dest == "command").choices)


@pytest.mark.parametrize("command", ["", *COMMANDS])
def test_help_loads_nothing_heavy(command):
    loaded, text = at_once([*command.split(), "--help"])
    assert "usage: rvwear" in text
    assert not loaded & HEAVY


def test_the_list_of_claims_loads_nothing_that_computes_or_draws():
    loaded, _, text = modules_after(["reproduce", "--list"])
    assert "T18" in text
    assert not loaded & {"numpy", "llvmlite", "pandas", "xarray", "plotly", "matplotlib", "scipy", "pydantic", "pint"}


@pytest.mark.parametrize("shell, word", [("bash", "complete "), ("zsh", "compdef"), ("fish", "complete ")])
def test_completion_prints_what_the_shell_sources(shell, word):
    loaded, text = at_once(["completion", shell])
    assert word in text and "rvwear" in text
    assert not loaded & HEAVY


@pytest.mark.parametrize("line, offered", [
    ("rvwear hys", ["hysteresis"]), ("rvwear solve --reducer RV", ["RV20E-121", "RV20E-121-rigid"]), ("rvwear compare BX", ["BX-40E", "BX-40E-rigid"]),
    ("rvwear life --first", ["--first-jump"]), ("rvwear completion f", ["fish"]),
])  # fmt: skip
def test_the_shell_is_offered_commands_options_and_reducers(tmp_path, line, offered):
    """Asked as bash asks: the line in the environment, the answer in a file."""
    answer = tmp_path / "answer"
    environment = os.environ | {
        "_ARGCOMPLETE": "1", "_ARGCOMPLETE_IFS": "\n", "_ARGCOMPLETE_STDOUT_FILENAME": str(answer), "COMP_LINE": line,
        "COMP_POINT": str(len(line)),
    }  # fmt: skip
    subprocess.run([sys.executable, "-m", "cli"], env=environment, cwd=tmp_path, check=True)
    assert [word.strip() for word in answer.read_text().split("\n")] == offered


@pytest.mark.parametrize("started", [("-m", "cli"), ("-c", "import sys; from cli.main import main; sys.exit(main())")])
def test_version_is_that_of_the_project(started):
    done = subprocess.run([sys.executable, *started, "--version"], capture_output=True, text=True, check=True)
    assert done.stdout == f"rvwear {project().version}\n"
