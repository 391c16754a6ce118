"""``rvwear example``: the examples that come with the software, and a copy of one."""

import argparse
import shutil
from pathlib import Path

from cli.completion import completed_by
from cli.options import add_json
from cli.written import say_file
from fmu_src.faults import InputFault, nearest

# File or folder in ``examples/`` -> what it shows.
EXAMPLES = {
    "browser": "a page in which a reducer turns, wears and shows its forces: python examples/browser/make.py",
    "catalogue_stiffness": "stiffness and lost motion of a catalogue against those of the contacts alone",
    "cycloidal_actuator": "torque ramps of a printed cycloidal drive (its measurements: docs/real_data.md)",
    "durability_test": "lost motion over a published test of 1550 h",
    "ensemble.toml": "parts, load and wear coefficients that scatter: rvwear ensemble examples/ensemble.toml",
    "five_lines.py": "the package of both FMUs, stepped from Python",
    "hidden_effect": "a campaign with data and an effect to find, with a guide: examples/hidden_effect/README.md",
    "load_fmu.c": "a native FMU, stepped from C",
    "pair_master.c": "plant and wear unit of FMI 3.0, stepped together from C",
    "milling_wear": "a negative control: milling cutters, to which no effect may be added (docs/real_data.md)",
    "move_and_return.toml": "a table of speeds and torques: rvwear life --duty examples/move_and_return.toml",
    "pair.toml": "the FMUs of plant and wear, connected: rvwear build, rvwear run examples/pair.toml",
    "raceway_depths": "two depths after a test of 10,000 h: rvwear diagnose RV20E-121-rigid examples/raceway_depths",
    "rv_reducer_te": "orders of a real RV reducer from your clone of public data: examples/rv_reducer_te/README.md",
    "two_loops": "two torque loops as a bench wrote them, cold and warm: docs/tutorials/two_files.md",
    "robot_joint": "a joint with motor, drive and controller: python examples/robot_joint/robot_joint.py",
}
# Where a copy goes, so that every command in README, docs and the examples themselves finds it.
TARGET = Path("examples")
ROOT = Path(__file__).resolve().parents[2]
LITTER = "__pycache__"


def add_commands(sub: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    command = sub.add_parser("example", help="copy an example, its data included, into the folder examples")
    completed_by(command.add_argument("name", nargs="?", metavar="NAME", help="example to copy (default: list all)"), completions)
    add_json(command, "print as JSON, nothing else")
    command.set_defaults(run=run)


def completions(prefix: str, **_: object) -> list[str]:
    return [name for name in EXAMPLES if name.startswith(prefix)]


def shipped() -> Path:
    """The folder of the examples: a wheel has them under a name of their own, a checkout in ``examples``."""
    installed = ROOT / "rvwear_examples"
    return installed if installed.is_dir() else ROOT / "examples"


def run(options: argparse.Namespace) -> int:
    """``rvwear example``: list, or copy one."""
    if not options.name:
        return show_list(options.json)
    made = copy(options.name)
    if options.json:
        from cli.screen import json_text

        json_text({"example": options.name, "path": str(made)})
    else:
        say_file(made)
    return 0


def show_list(as_json: bool) -> int:
    if as_json:
        from cli.screen import json_text

        json_text({"examples": EXAMPLES})
        return 0
    width = max(map(len, EXAMPLES))
    for name, text in EXAMPLES.items():
        print(f"{name:{width}}  {text}")
    return 0


def copy(name: str) -> Path:
    """Copy an example, with or without the ending of its name; InputFault where something of it is there already."""
    found = [known for known in EXAMPLES if name in (known, Path(known).stem)]
    if not found:
        every = ", ".join(EXAMPLES)
        raise InputFault(f"no example {name!r}{nearest(name, EXAMPLES, 1) or f': give one of {every}'}")
    source, target = shipped() / found[0], TARGET / found[0]
    if target.exists():
        raise InputFault(f"{target} exists already and is not overwritten; move it away, or go to another folder")
    files = sorted(path for path in source.rglob("*") if path.is_file() and LITTER not in path.parts) if source.is_dir() else [source]
    for path in files:
        place = target / path.relative_to(source)
        place.parent.mkdir(parents=True, exist_ok=True)
        # The contents alone: an installation may be read-only, a copy is to be worked on.
        shutil.copyfile(path, place)
    return target
