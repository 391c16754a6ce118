"""Options that several commands share, and what is made of them."""

import argparse
import os
import re
from pathlib import Path
from typing import TYPE_CHECKING, NamedTuple

from cli.completion import completed_by, reducer_completions
from fmu_src.faults import InputFault
from fmu_src.file_name import file_name
from orchestrator.schemes import SCHEMES
from reducers.library import available

if TYPE_CHECKING:
    from collections.abc import Callable

    from orchestrator.settings import Setting
    from reducers.reducer import Reducer

USUAL_REDUCER = "RV20E-121"
# On rigid supports, without losses: what an effect does shows by itself.
IDEAL_REDUCER = "RV20E-121-rigid"
# Exit code of an extension that unused runs did not bear out, or that the diagnosis calls for none of: no failure of the program, and no bad input.
NOTHING_ADDED_CODE = 3
REDUCER_HELP = f"{', '.join(available())}, or a reducer file (default {USUAL_REDUCER})"

# Options that are shorthands of settings: option -> (variable, unit).
SHORTHANDS = {
    "torque": ("output.load_torque", "N.m"),
    "bearing_clearance": ("bearing.clearance", "um"),
    "equidistant": ("disc.equidistant_modification", "um"),
    "shift": ("disc.shift_modification", "um"),
    "stiffness_reading": ("contact.stiffness_reading", ""),
    "contact_law": ("contact.law", ""),
}

PAGES = (".html", ".htm")
PLAIN = re.compile(r"\s*[+-]?(?:\d+\.?\d*|\.\d+)(?:[eE][+-]?\d+)?\s*")


def add_json(command: argparse.ArgumentParser, what: str = "print figures as JSON, nothing else") -> None:
    command.add_argument("--json", action="store_true", help=what)


def add_reducer(command: argparse.ArgumentParser, text: str = REDUCER_HELP, usual: str = USUAL_REDUCER) -> None:
    completed_by(command.add_argument("--reducer", default=usual, help=text), reducer_completions)


def add_reducer_options(command: argparse.ArgumentParser, positions: bool = True) -> None:
    add_reducer(command)
    command.add_argument("--torque", metavar="NM", help="output torque, opposing the motion: 167 (N m), 167Nm, 17kgf.m")
    command.add_argument("--bearing-clearance", metavar="UM", help="radial needle clearance: 10 (um), 0.01mm")
    command.add_argument("--equidistant", metavar="UM", help="equidistant modification [um], > 0 is a gap")
    command.add_argument("--shift", metavar="UM", help="shift modification [um], < 0 is a gap")
    command.add_argument("--stiffness-reading", metavar="SI|literal", help="how the printed stiffnesses are read")
    command.add_argument("--contact-law", metavar="LAW", help="line, lankarani-nikravesh or palmgren")
    command.add_argument(
        "--set", action="append", default=[], metavar="NAME=VALUE",
        help="any parameter or input, with a unit if it is not SI: --set errors.pin.radius[3]=2um",
    )  # fmt: skip
    if positions:
        command.add_argument("--positions", type=int, default=72, help="equilibria per crank turn (default 72)")


def add_coupling_options(command: argparse.ArgumentParser, scheme: str | None = SCHEMES[0]) -> None:
    command.add_argument("--fmus", metavar="FOLDER", help="step the FMUs of this folder instead of the kernels")
    command.add_argument("--scheme", default=scheme, help="gauss-seidel (default) or jacobi")


def settings_of(options: argparse.Namespace, reducer: "Reducer") -> list["Setting"]:
    """Settings from the shorthand options and ``--set``, in this order."""
    from orchestrator.settings import parse_setting

    tables = [reducer.plant, reducer.wear]
    found = []
    for option, (name, unit) in SHORTHANDS.items():
        if (value := getattr(options, option)) is not None:
            try:
                # A number alone is in the option's own unit.
                found.append(parse_setting(f"{name}={value}{unit if PLAIN.fullmatch(value) else ''}", tables))
            except InputFault as fault:
                raise InputFault(f"--{option.replace('_', '-')} {value}: {fault}") from None
    return found + [parse_setting(text, tables) for text in options.set]


def reducer_of(name: str) -> "Reducer":
    """The reducer that ``--reducer`` names."""
    from discrepancy.named_reducer import named_reducer

    return named_reducer(name)


def chosen(options: argparse.Namespace) -> tuple["Reducer", list["Setting"], int]:
    """The reducer, its settings and the positions of a crank turn that the options of ``add_reducer_options`` name.

    InputFault if one of them is none that there is.
    """
    from studies.solve import require_positions

    positions = require_positions(options.positions)
    reducer = reducer_of(options.reducer)
    return reducer, settings_of(options, reducer), positions


class Told(NamedTuple):
    """A number in the unit of its option, and as it was typed."""

    value: float
    text: str


def number_in(unit: str) -> "Callable[[str], float]":
    """What argparse makes of a number in ``unit``, alone or with a unit of its own: 1600, 1600Nm, 1.6kNm."""

    def parsed(text: str) -> float:
        from discrepancy.campaign.amount import amount
        from orchestrator.settings import NUMBER, require_point

        try:
            require_point(text)
        except InputFault as fault:
            raise argparse.ArgumentTypeError(str(fault)) from None
        if not NUMBER.match(text):
            raise argparse.ArgumentTypeError(f"{text!r} is no number; give one in {unit}, or with another unit of its kind, for instance 15{unit}")
        try:
            return amount(f"{text} {unit}" if PLAIN.fullmatch(text) else text, unit, "the number")
        except InputFault as fault:
            raise argparse.ArgumentTypeError(str(fault)) from None

    return parsed


def told_in(unit: str) -> "Callable[[str], Told]":
    """As ``number_in``, with what was typed: a fault shows it."""
    parsed = number_in(unit)
    return lambda text: Told(parsed(text), text)


def folder(text: str | None) -> Path | None:
    return Path(text) if text else None


def result_path(text: str | None, name: str, endings: tuple[str, ...] = (".nc",)) -> Path:
    """Where a result goes; checked before the work, so that none is lost."""
    path = Path(text or f"results/{file_name(name)}.nc")
    if path.suffix not in endings:
        if len(endings) > 1:
            raise InputFault(f"--output {path}: the name must end in {' or '.join(endings)}")
        raise InputFault(f"--output {path}: a result is a NetCDF file; give a name that ends in .nc")
    try:
        str(path).encode()
    except UnicodeEncodeError:
        raise InputFault(f"--output {path}: the NetCDF library takes names in UTF-8 alone; give another one") from None
    require_place(path, "--output", ".nc")
    return path


def page_path(text: str | None) -> Path | None:
    """Where the page of ``--html`` goes, if one is asked for; checked before the work, too."""
    if not text:
        return None
    path = Path(text)
    if path.suffix.lower() not in PAGES:
        raise InputFault(f"--html {path}: the name must end in .html")
    require_place(path, "--html", ".html")
    return path


def require_place(path: Path, option: str, ending: str) -> None:
    """InputFault where no file can be written; its folder is made."""
    if path.is_dir():
        raise InputFault(f"{option} {path} is a folder; give a file name in it that ends in {ending}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
    except OSError as problem:
        raise InputFault(f"{option} {path}: the folder {path.parent} cannot be made ({problem.strerror}); give another place") from None
    if not os.access(path.parent, os.W_OK):
        raise InputFault(f"{option} {path}: the folder {path.parent} cannot be written to")


def all_cores() -> int:
    """Cores that this process may use."""
    return len(os.sched_getaffinity(0)) if hasattr(os, "sched_getaffinity") else os.cpu_count() or 1
