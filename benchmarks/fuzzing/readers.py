"""Each reader as it is called on a file of unknown contents."""

import io
import zipfile
from collections.abc import Callable
from pathlib import Path
from typing import Any

from benchmarks.fuzzing.seeds import zipped
from benchmarks.fuzzing.texts import FMI2
from fmu_src.checked_file import checked, checksum_line


class Wrong(AssertionError):
    """A file that was read as if it were good, and is not."""


def reducer(path: Path) -> None:
    from reducers.reducer import load_reducer

    load_reducer(path)


def model(path: Path) -> None:
    from discrepancy.model_file import load_model

    load_model(path)


def duty(path: Path) -> None:
    from studies.duty import load_duty

    load_duty(path)


def ensemble(path: Path) -> None:
    from studies.ensemble.ensemble_file import load_ensemble

    load_ensemble(path)


def scenario(path: Path) -> None:
    from orchestrator.scenario import read_scenario

    for component in read_scenario(path).components.values():
        component.close()


def campaign(path: Path) -> None:
    from discrepancy.campaign.load import load_campaign

    load_campaign(path.parent)


def measurement(path: Path) -> None:
    from discrepancy.campaign.readers import Options, read_columns
    from fmu_src.faults import InputFault

    faults = []
    for names in ({"time", "torque", "angle"}, {"torque"}, {"c1"}, {"c2", "c3"}):
        try:
            read_columns(path, names, Options(), f"{path}: runs[1]")
        except InputFault as fault:
            faults.append(fault)
    if faults:
        raise faults[0]


def workbook_part(path: Path) -> None:
    """A sound workbook with one of its parts, named in the first line, as the file has it."""
    from benchmarks.fuzzing.seeds import xlsx

    name, _, part = path.read_bytes().partition(b"\n")
    (whole,) = KNOWN.setdefault("workbook", [next(xlsx())])
    with zipfile.ZipFile(io.BytesIO(whole)) as archive:
        parts = {member: archive.read(member) for member in archive.namelist()}
    known = name.decode("latin-1")
    path.with_suffix(".xlsx").write_bytes(zipped(parts | {known if known in parts else "xl/worksheets/sheet1.xml": part}))
    measurement(path.with_suffix(".xlsx"))


def ssp(path: Path) -> None:
    from orchestrator.ssp.importer import read_ssp

    structure = read_ssp(path if path.suffix == ".ssp" else path.parent / "SystemStructure.ssd")
    for folder in structure.folders:
        folder.remove()


def fmu(path: Path) -> None:
    from orchestrator.fmu import Fmu

    Fmu("a", path).close()


def description(path: Path) -> None:
    path.with_suffix(".fmu").write_bytes(zipped({"modelDescription.xml": path.read_bytes()}))
    fmu(path.with_suffix(".fmu"))


def stamp(path: Path) -> None:
    path.with_suffix(".fmu").write_bytes(zipped({"modelDescription.xml": FMI2, "resources/unit.json": path.read_bytes()}))
    fmu(path.with_suffix(".fmu"))


def reference(path: Path) -> None:
    from orchestrator.series import read_series

    read_series(path)


def result(path: Path) -> None:
    """With its checksum every change must be seen."""
    from benchmarks.fuzzing.seeds import SEEDS
    from orchestrator.netcdf import SEALED, read

    content = path.read_bytes()
    read(path)
    if content not in KNOWN.setdefault("result", list(SEEDS["result"]())) and SEALED.encode() in content:
        raise Wrong("a result that was changed is read as good")


def checkpoint(path: Path) -> None:
    """The head and the checksum of one content before another."""
    from benchmarks.fuzzing.seeds import checkpoint_content
    from studies.checkpoint import MARK, load_checkpoint

    good, content = checkpoint_content(), path.read_bytes()
    path.write_bytes(checked(good, MARK)[: -len(good)] + content)
    load_checkpoint(path, {})
    if content != good:
        raise Wrong("a checkpoint that was changed is read as good")


def forged_checkpoint(path: Path) -> None:
    from studies.checkpoint import MARK, load_checkpoint

    path.write_bytes(checked(path.read_bytes(), MARK))
    load_checkpoint(path, {})


def lives(path: Path) -> None:
    from studies.ensemble.store import Store

    Store(path, {"seed": 1})


def forged_lives(path: Path) -> None:
    rows = path.read_bytes().split(b"\n")
    head = b'{"ensemble": {"seed": 1}}'
    path.write_bytes(b"".join(row + b"\t" + checksum_line(row) for row in (head, *rows)))
    lives(path)


def setting(path: Path) -> None:
    from fmu_src.faults import InputFault
    from orchestrator.settings import parse_setting
    from reducers.reducer import load_reducer

    text = path.read_bytes().decode("utf-8", "replace")
    known = KNOWN.setdefault("tables", [load_reducer("RV20E-121")])
    try:
        parse_setting(text, [known[0].plant, known[0].wear])
    except InputFault as fault:
        # There is no file to name here.
        raise InputFault(f"{path}: {fault}") from None


def message(path: Path) -> None:
    from fmu_src.faults import InputFault
    from fmu_src.framing import FrameFault, decode

    try:
        decode(path.read_bytes())
    except FrameFault as fault:
        raise InputFault(f"{path}: {fault}") from None


KNOWN: dict[str, list[Any]] = {}
# Reader -> (name of the file that is changed, how it is read).
READERS: dict[str, tuple[str, Callable[[Path], None]]] = {
    "reducer": ("a.toml", reducer), "model": ("a.toml", model), "duty": ("a.toml", duty), "ensemble": ("a.toml", ensemble), "scenario": ("a.toml", scenario),
    "campaign": ("campaign.toml", campaign), "csv": ("a.csv", measurement), "mat": ("a.mat", measurement), "mdf": ("a.mf4", measurement),
    "tdms": ("a.tdms", measurement), "parquet": ("a.parquet", measurement), "xlsx": ("a.xlsx", measurement), "xlsx_part": ("a.txt", workbook_part), "ssd": ("SystemStructure.ssd", ssp), "ssv": ("extra.ssv", ssp), "ssp": ("a.ssp", ssp),
    "fmu": ("a.fmu", fmu), "description": ("a.xml", description), "stamp": ("a.json", stamp), "reference_csv": ("a.csv", reference),
    "reference_netcdf": ("a.nc", reference), "result": ("a.nc", result), "checkpoint": ("a.checkpoint", checkpoint),
    "forged_checkpoint": ("a.checkpoint", forged_checkpoint), "lives": ("a.lives", lives), "forged_lives": ("a.lives", forged_lives), "setting": ("a.txt", setting),
    "message": ("a.bin", message),
}  # fmt: skip
