"""A user's own clone of a public data set of a real RV reducer, ratio 81, turned into a campaign of orders.

Source of the data: XiLab-Robotics/Physics-Informed-Neural-Networks (GitHub), rig in Robotics and Computer-Integrated Manufacturing 2025,
102838.  It states no licence: nothing of it comes with this software.  Read are
- ``data/polished_dataset/{forward,backward}/25degree/1000rpm/1000.0rpm100.0Nm25.0deg.csv``: theta, theta_dot, tau_load, T, theta_TE;
- ``data/simplified_dataset/Test_25degree/1000rpm/1000.0rpm100.0Nm25.0deg.csv``: both senses side by side, without torque and temperature;
- a table with one row a condition: dir, rpm, T, tor and a_k, p_k of every order [1e-6 deg, rad].
theta is the input's angle over the ratio [deg], within one turn, falling backward; theta_TE is the output's angle less theta [deg].
"""

import csv
import math
import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np
import pandas as pd

from discrepancy.campaign.order_analysis import Complex, measured_orders
from fmu_src.arrays import Floats
from fmu_src.faults import InputFault
from fmu_src.progress import task

RATIO = 81.0
ORDERS = (0, 1, 3, 39, 40, 78, 81, 156, 162, 240)
DATA = ("data/polished_dataset", "data/simplified_dataset", "polished_dataset", "simplified_dataset", ".")
NAME = re.compile(r"([0-9.]+)rpm([0-9.]+)Nm([0-9.]+)deg\w*\.csv$")
POLISHED = ("theta", "theta_TE", "tau_load", "T")
SIMPLIFIED = {
    "forward": ("Poisition_Output_Reducer_Fw", "Transmission_Error_Fw"), "reverse": ("Position_Output_Reducer_Bw", "Transmission_Error_Bw"),
}  # fmt: skip
SENSES = {"fw": "forward", "bw": "reverse", "forward": "forward", "backward": "reverse"}
LFS = b"version https://git-lfs"
# The table's a0 has lost its sign.  Raw curves: the output lags, the more the higher the load; backward it leads below 200 N m or so.
LAGS_FROM, LEADS_TO = 300.0, 100.0
# A measured load that is so far off what the file's name says, in share and N m, is another condition.
OFF_SHARE, OFF_TORQUE = 0.1, 20.0


@dataclass(frozen=True)
class Measured:
    """Orders of one run.  ``amplitudes`` [rad] of TE = output - input/ratio over an angle that is counted forward."""

    direction: str
    speed: float
    torque: float
    temperature: float
    orders: tuple[float, ...]
    amplitudes: Complex
    # What was reached, where the file says: N m, degC.
    actual: dict[str, float] = field(default_factory=dict)

    @property
    def condition(self) -> str:
        return f"{'fw' if self.direction == 'forward' else 'bw'}_{self.speed:g}rpm_{self.torque:g}Nm_{self.temperature:g}degC"


def measured_in(source: Path, orders: Sequence[float] = ORDERS) -> tuple[list[Measured], list[str]]:
    """(runs, what was wrong with files that were left out) of a clone, or of a table of orders; one file in memory at a time."""
    if source.is_file():
        return list(of_table(source)), []
    if not source.is_dir():
        raise InputFault(f"{source}: there is no such folder or file; give the clone of the repository, or a table of orders (.csv)")
    for folder in (source / name for name in DATA):
        if files := sorted(path for path in folder.rglob("*.csv") if NAME.search(path.name)):
            break
    else:
        raise InputFault(f"{source}: holds no file like 1000.0rpm100.0Nm25.0deg.csv, neither in {', '.join(DATA[:2])} nor anywhere; give the clone's folder")
    found: list[Measured] = []
    wrong: list[str] = []
    with task("reading curves", total=len(files)) as reading:
        for path in files:
            try:
                found += of_file(path, orders)
            except InputFault as fault:
                wrong.append(str(fault))
            reading.advance()
    if not found:
        raise InputFault(f"{source}: none of {len(files)} files could be used; the first: {wrong[0]}")
    return found, wrong


def of_file(path: Path, orders: Sequence[float]) -> list[Measured]:
    """The one or two runs of a raw file."""
    match = NAME.search(path.name)
    assert match is not None
    speed, torque, temperature = (float(text) for text in match.groups())
    columns = columns_of(path)
    if set(POLISHED) <= columns.keys():
        folder = next((part for part in reversed(path.parts[:-1]) if part in ("forward", "backward")), None)
        if folder is None:
            raise InputFault(f"{path}: lies in no folder forward or backward, which says how it turned; keep the folders of the repository")
        curves = [(SENSES[folder], "theta", "theta_TE")]
    else:
        curves = [(sense, *names) for sense, names in SIMPLIFIED.items()]
    found = []
    for sense, angle_name, error_name in curves:
        angle, error = columns[angle_name], columns[error_name]
        known = np.isfinite(angle) & np.isfinite(error)
        place = f"{path}: columns {angle_name}, {error_name} [deg]"
        turned = np.radians(np.unwrap(angle[known], period=360.0))
        if len(turned) > 1 and (turned[-1] > turned[0]) != (sense == "forward"):
            raise InputFault(f"{place}: the angle {'rises' if sense == 'reverse' else 'falls'} though it turned {sense}; leave the file out")
        amplitudes, _ = measured_orders(turned, np.radians(error[known]), orders, "none", None, place)
        actual = reached(columns, torque, path)
        found.append(Measured(sense, speed, torque, temperature, tuple(map(float, orders)), amplitudes, actual))
    return found


def columns_of(path: Path) -> dict[str, Floats]:
    with path.open("rb") as file:
        head = file.readline()
    if head.startswith(LFS):
        raise InputFault(f"{path}: is a pointer of Git LFS and no measurement; fetch the data by git lfs pull")
    names = [name.strip() for name in head.decode("utf-8-sig", "replace").split(",")]
    wanted = [n for n in POLISHED if n in names] or [n for pair in SIMPLIFIED.values() for n in pair if n in names]
    if set(wanted) not in (set(POLISHED), {n for pair in SIMPLIFIED.values() for n in pair}):
        raise InputFault(
            f"{path}: has the columns {', '.join(names)[:200]}; needed are {', '.join(POLISHED)} (polished), or"
            f" {', '.join(n for pair in SIMPLIFIED.values() for n in pair)} (simplified)"
        )
    try:
        frame = pd.read_csv(path, usecols=wanted, dtype=np.float64, skipinitialspace=True)
    except (ValueError, pd.errors.ParserError) as problem:
        raise InputFault(f"{path}: is no table of numbers ({str(problem).strip()}); check out the file anew") from None
    return {name: frame[name].to_numpy() for name in wanted}


def reached(columns: dict[str, Floats], torque: float, path: Path) -> dict[str, float]:
    """Load [N m] and oil temperature [degC] as measured."""
    if "tau_load" not in columns:
        return {}
    load = abs(float(np.nanmean(columns["tau_load"])))
    if abs(load - torque) > OFF_SHARE * torque + OFF_TORQUE:
        raise InputFault(f"{path}: column tau_load has a mean of {load:.4g} N.m, the file's name says {torque:g} N.m: another condition; left out")
    actual = {"temperature": float(np.nanmean(columns["T"]))}
    # Without load the torque meter's zero shows.
    return actual | {"load_torque": load} if torque > 0.0 else actual


def of_table(path: Path) -> Iterator[Measured]:
    with path.open(encoding="utf-8-sig", newline="") as file:
        rows = list(csv.DictReader(file))
    heads = [name for name in rows[0] if name] if rows else []
    orders = [int(name[1:]) for name in heads if re.fullmatch(r"a[1-9]\d*", name)]
    missing = [n for n in ("dir", "rpm", "T", "tor", *(f"p{k}" for k in orders)) if n not in heads]
    if missing or not orders:
        raise InputFault(f"{path}: has no column {(missing or ['a1'])[0]!r}; a table of orders has dir, rpm, T, tor, a0, a1, p1 ... (1e-6 deg, rad)")
    for number, row in enumerate(rows, start=2):
        place = f"{path}: line {number}"
        if None in row:
            raise InputFault(f"{place}: has {len(row[None])} cells more than the head has columns; correct it or delete the line")
        if row["dir"] not in SENSES:
            raise InputFault(f"{place}: column dir = {row['dir']!r}; fw or bw is needed")
        speed, torque, temperature = (figure(row, name, place) for name in ("rpm", "tor", "T"))
        waves = [(float(k), figure(row, f"a{k}", place) * np.exp(1j * figure(row, f"p{k}", place))) for k in orders]
        sign = sign_of_mean(SENSES[row["dir"]], torque)
        mean = [(0.0, sign * figure(row, "a0", place) + 0j)] if sign and "a0" in heads else []
        amplitudes = np.array([a for _, a in mean + waves], np.complex128) * math.radians(1e-6)
        yield Measured(SENSES[row["dir"]], speed, torque, temperature, tuple(k for k, _ in mean + waves), amplitudes)


def figure(row: dict[str, str], name: str, place: str) -> float:
    try:
        value = float(row[name])
    except (TypeError, ValueError):
        value = math.nan
    if not math.isfinite(value):
        raise InputFault(f"{place}: column {name} = {row[name]!r} is no number; correct it or delete the line")
    return value


def sign_of_mean(direction: str, torque: float) -> int:
    """Of the table's a0, which is a modulus; 0 where it is not known."""
    if direction == "forward":
        return -1
    return 1 if torque >= LAGS_FROM else -1 if torque <= LEADS_TO else 0
