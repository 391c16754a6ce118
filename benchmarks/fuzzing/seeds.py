"""Sound files of every kind, small: where mutants begin."""

import io
import json
import shutil
import zipfile
from collections.abc import Callable, Iterator
from functools import cache
from pathlib import Path
from tempfile import TemporaryDirectory

import numpy as np

from benchmarks.fuzzing import CORPUS
from benchmarks.fuzzing.texts import CAMPAIGN, FMI2, FMI3, MODEL, SCENARIO, SSD, SSV
from reducers.library import LIBRARY

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples"
TIME = np.linspace(0.0, 1.0, 20)
COLUMNS = {"time": TIME, "torque": 100.0 * np.sin(TIME), "angle": 1e-3 * np.sin(TIME)}


def saved(write: Callable[[Path], object], name: str) -> bytes:
    """The bytes of a file that a library writes."""
    with TemporaryDirectory() as folder:
        write(Path(folder) / name)
        return (Path(folder) / name).read_bytes()


def zipped(members: dict[str, bytes], compression: int = zipfile.ZIP_STORED) -> bytes:
    content = io.BytesIO()
    with zipfile.ZipFile(content, "w", compression) as archive:
        for name, data in members.items():
            archive.writestr(name, data)
    return content.getvalue()


def csv() -> Iterator[bytes]:
    rows = "\n".join(f"{a:.6g},{b:.6g},{c:.6g}" for a, b, c in zip(*COLUMNS.values()))
    yield f"time,torque,angle\n{rows}\n".encode()
    yield f"# log\ntime;torque;angle\ns;Nm;rad\n{rows.replace(',', ';').replace('.', ',')}\n".encode("cp1252")
    yield f"time\ttorque\tangle\n{rows.replace(',', chr(9))}\n".encode("utf-16")


def mat() -> Iterator[bytes]:
    import h5py
    from scipy.io import savemat

    nested = {"data": {"time": TIME, "torque": COLUMNS["torque"]}, "matrix": np.eye(3), "text": "abc", **COLUMNS}
    yield saved(lambda path: savemat(path, nested), "a.mat")
    yield saved(lambda path: savemat(path, nested, do_compression=True), "a.mat")
    yield saved(lambda path: savemat(path, COLUMNS, format="4"), "a.mat")

    def hdf(path: Path) -> None:
        with h5py.File(path, "w", userblock_size=512) as file:
            for name, column in COLUMNS.items():
                file[name] = column[None]

    yield saved(hdf, "a.mat")


def mdf() -> Iterator[bytes]:
    from asammdf import MDF, Signal

    conversions: list[dict[str, object] | None] = [None, {"a": 2.0, "b": 1.0}, {"formula": "2*X+1"}, {"raw_0": 0, "phys_0": 1.0, "raw_1": 100, "phys_1": 5.0, "interpolation": True}]
    for version in ("4.10", "3.30"):
        for compression in (0, 1):
            def write(path: Path) -> None:
                with MDF(version=version) as file:
                    signals = [Signal(column, TIME, name=name) for name, column in COLUMNS.items() if name != "time"]
                    signals += [Signal(np.arange(20, dtype="i2"), TIME, name=f"c{k}", conversion=c) for k, c in enumerate(conversions) if c]
                    file.append(signals)
                    file.save(path, overwrite=True, compression=compression)

            yield saved(write, "a.mf4" if version > "4" else "a.mdf")


def tdms() -> Iterator[bytes]:
    from nptdms import ChannelObject, TdmsWriter

    def write(path: Path) -> None:
        with TdmsWriter(path) as file:
            file.write_segment([ChannelObject("log", name, column, {"wf_increment": 0.1, "wf_start_offset": 0.0, "wf_samples": 20}) for name, column in COLUMNS.items()])

    yield saved(write, "a.tdms")


def parquet() -> Iterator[bytes]:
    import pandas as pd

    frame = pd.DataFrame(COLUMNS)
    yield saved(frame.to_parquet, "a.parquet")
    yield saved(lambda path: frame.assign(torque=frame.torque.astype(str)).to_parquet(path, compression="gzip"), "a.parquet")


def xlsx() -> Iterator[bytes]:
    """Workbooks, compressed, and bare so that mutants reach their parts."""
    import pandas as pd

    frame = pd.DataFrame(COLUMNS)
    yield saved(lambda path: frame.to_excel(path, index=False), "a.xlsx")
    whole = saved(lambda path: frame.assign(torque=frame.torque.astype(str)).head(3).to_excel(path, index=False), "a.xlsx")
    with zipfile.ZipFile(io.BytesIO(whole)) as archive:
        yield zipped({name: archive.read(name) for name in archive.namelist()}, zipfile.ZIP_STORED)


def xlsx_part() -> Iterator[bytes]:
    """The sheet, the workbook, the texts and the styles: which one is changed is seen from what stands in it."""
    whole = next(xlsx())
    with zipfile.ZipFile(io.BytesIO(whole)) as archive:
        for name in ("xl/worksheets/sheet1.xml", "xl/workbook.xml", "xl/styles.xml", "[Content_Types].xml"):
            yield name.encode() + b"\n" + archive.read(name)


def netcdf() -> Iterator[bytes]:
    from orchestrator.series import write_series

    series = {"time": TIME, "a.x": COLUMNS["torque"], "a.y": np.outer(TIME, [1.0, 2.0])}
    yield saved(lambda path: write_series(series, {"a.x": "m", "a.y": "N"}, {"system": "s"}, path), "a.nc")


def foreign_netcdf() -> Iterator[bytes]:
    import xarray as xr

    dataset = xr.Dataset({"a.x": ("time", COLUMNS["torque"]), "a.y": (("time", "n"), np.outer(TIME, [1.0, 2.0])), "text": ("time", ["a"] * 20)}, {"time": ("time", TIME)})
    for form in ("NETCDF4", "NETCDF3_64BIT"):
        yield saved(lambda path: dataset.drop_vars("text").to_netcdf(path, format=form), "a.nc")
    yield saved(lambda path: dataset.to_netcdf(path, encoding={"a.x": {"zlib": True}}), "a.nc")


@cache
def checkpoint_content() -> bytes:
    """What stands in a checkpoint, behind its checksum."""
    from fmu_src.checked_file import unchecked
    from studies.checkpoint import MARK, save_checkpoint
    from studies.life import Life, LifeSettings
    from studies.solve import Turn

    life = Life(LifeSettings(hours=100.0), hours=[0.0, 50.0], figures=[{"a": 0.0}, {"a": 1.0}], errors=[0.0, 0.1], cycles=1, jumps=2, coarse=[[0.0]])
    life.surfaces = [{"disc_wear": np.zeros((1, 2, 3))}] * 2
    life.turns = [Turn({"lag": np.zeros(4)})] * 2
    life.start = {"clock": [0.0, 0, 0.0], "states": {"plant": bytes(80), "wear": bytes(80)}}
    saved_master = {"clock": [0.0, 0, 0.0], "states": {"plant": bytes(80), "wear": bytes(80)}}
    whole = saved(lambda path: save_checkpoint(path, life, saved_master, {}), "a.checkpoint")
    return unchecked(whole, MARK, Path("a"))


def lives() -> Iterator[bytes]:
    from studies.ensemble.store import line_of

    contents: list[dict[str, object]] = [
        {"ensemble": {"seed": 1}}, {"number": 0, "fault": "x"}, {"number": 1, "hours": [0.0, 1.0], "figures": {"a": [0.0, 1.0]}},
    ]  # fmt: skip
    yield "".join(line_of(content) for content in contents).encode()


def fmu() -> Iterator[bytes]:
    for description in (FMI2, FMI3):
        yield zipped({"modelDescription.xml": description, "resources/unit.json": json.dumps({"source_hash": "x", "specification": {}}).encode()})
        yield zipped({"modelDescription.xml": description}, zipfile.ZIP_DEFLATED)


def ssp() -> Iterator[bytes]:
    yield zipped({"SystemStructure.ssd": SSD, "extra.ssv": SSV, "resources/a.fmu": zipped({"modelDescription.xml": FMI2})})


def message() -> Iterator[bytes]:
    from fmu_src.framing import encode

    yield encode(("done", {"a": [1, 2.0, None, b"x", np.arange(3.0)]}))


def files(*paths: Path) -> Iterator[bytes]:
    return (path.read_bytes() for path in paths)


SEEDS: dict[str, Callable[[], Iterator[bytes]]] = {
    "reducer": lambda: files(*sorted(LIBRARY.glob("*.toml"))[:3]), "model": lambda: iter([MODEL]), "duty": lambda: files(EXAMPLES / "move_and_return.toml"),
    "ensemble": lambda: files(EXAMPLES / "ensemble.toml"), "scenario": lambda: iter([SCENARIO]),
    "campaign": lambda: iter([CAMPAIGN, *files(*sorted(EXAMPLES.glob("*/campaign.toml"))[:2])]), "csv": csv, "mat": mat, "mdf": mdf, "tdms": tdms, "parquet": parquet, "xlsx": xlsx, "xlsx_part": xlsx_part,
    "ssd": lambda: iter([SSD]), "ssv": lambda: iter([SSV]), "ssp": ssp, "fmu": fmu, "description": lambda: iter([FMI2, FMI3]),
    "stamp": lambda: iter([b'{"source_hash": "x", "specification": {"unit": "rv_plant", "sizes": {}}}']),
    "reference_csv": lambda: iter([next(csv())]), "reference_netcdf": foreign_netcdf, "result": netcdf, "checkpoint": lambda: iter([checkpoint_content()]),
    "forged_checkpoint": lambda: iter([checkpoint_content()]), "lives": lives, "forged_lives": lambda: (line.split(b"\t")[0] for line in next(lives()).splitlines()),
    "setting": lambda: iter([b"output.load_torque=150 N.m", b"errors.pin.radius[3]=2um", b"contact.law=palmgren", b"bearing.clearance=3e-6", b"heat.ambient_temperature=30degC"]),
    "message": message,
}  # fmt: skip


def seeds_of(reader: str) -> list[bytes]:
    """The sound files of a reader, and what once failed."""
    kept = sorted((CORPUS / reader).glob("*")) if (CORPUS / reader).is_dir() else []
    return [*SEEDS[reader](), *files(*kept)]


def copy_beside(reader: str, folder: Path) -> None:
    """What a reader needs beside the file that is changed."""
    if reader == "campaign":
        (folder / "log.csv").write_bytes(next(csv()))
    if reader in ("ssd", "ssv"):
        (folder / "resources").mkdir(exist_ok=True)
        (folder / "resources" / "a.fmu").write_bytes(zipped({"modelDescription.xml": FMI2}))
        (folder / "SystemStructure.ssd").write_bytes(SSD)
        (folder / "extra.ssv").write_bytes(SSV)
    if reader == "ensemble":
        shutil.copy(EXAMPLES / "move_and_return.toml", folder)
