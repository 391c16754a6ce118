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
from reducers.library import LIBRARY

ROOT = Path(__file__).resolve().parents[2]
EXAMPLES = ROOT / "examples"
TIME = np.linspace(0.0, 1.0, 20)
COLUMNS = {"time": TIME, "torque": 100.0 * np.sin(TIME), "angle": 1e-3 * np.sin(TIME)}

MODEL = b"""[model]
name = "gearbox 7"
reducer = "RV20E-121"
[settings]
bearing_clearance = "3 um"
[effects.needle_clearance]
needle_clearance_added = { value = 2.1e-6, unit = "m", low = 1.9e-6, high = 2.3e-6 }
[[steps]]
campaign = "c"
effects = ["needle_clearance"]
verdict = "helped"
training_before = 5.0
training_after = 2.0
kept = true
nuisances = { sensor_gain = 1.0 }
signals = [{ signal = "a", held_out = true, unit = "m", before = 2.0, after = 1.0, noise_floor = 0.5 }]
"""
SCENARIO = b"""[scenario]
name = "pair"
step = { value = 1.3, unit = "ms" }
duration = { value = 26, unit = "ms" }
start = { value = 0, unit = "s" }
scheme = "gauss-seidel"
extrapolation = 1
power_threshold = 0.01
call_limit = { step = 30 }
[components.plant]
reducer = "RV20E-121"
unit = "plant"
ratio = 1
parameters = { load_torque = "100 N.m", contact_law = "line" }
record = ["lag", "mesh_force[1,2]"]
[components.wear]
reducer = "RV20E-121"
unit = "wear"
[[connections]]
from = "plant.mesh.force_path"
to = "wear.mesh.force_path"
factor = 1.0
[step_control]
tolerance = 1e-4
[loops]
method = "newton"
[[power_bonds]]
effort = "plant.output.load_torque"
flow = "plant.output.speed"
"""
CAMPAIGN = b"""[campaign]
name = "c"
reducer = "RV20E-121"
rated_torque = "167 N.m"
[conditions.a]
input_speed = { value = 15, unit = "rpm" }
load_torque = "100 N.m"
temperature = "30 degC"
hours = 0
[conditions.b]
output_speed = "1 rpm"
load_torque = "50 N.m"
held_out = true
interventions = []
[layouts.log]
file = "log.csv"
delimiter = ","
columns = { value = { column = "angle", unit = "rad" }, torque = { column = "torque", unit = "N.m" } }
[[runs]]
id = "r1"
layout = "log"
quantity = "hysteresis"
condition = "a"
where = { time = { min = 0.1, max = 0.9 } }
average = { points = 2 }
noise = "1 arcsec"
[[runs]]
id = "r2"
quantity = "lost_motion"
condition = "b"
value = "1 arcmin"
tags = {}
[[runs]]
id = "r3"
quantity = "hysteresis"
condition = "b"
table = { torque = { values = [0, 10, 0, -10, 0], unit = "N.m" }, value = { values = [0, 1, 0, -1, 0], unit = "arcmin" } }
[nuisances.sensor_gain]
unit = "1"
lower = 0.9
start = 1.0
upper = 1.1
per = "campaign"
[rig]
input_speed = ["1 rpm", "100 rpm"]
quantities = ["hysteresis"]
cost_per_run = 1
[quantities.hysteresis]
zero = "free"
[orders]
pins = [40, 80]
"""
NAMES = b'xmlns:ssd="a" xmlns:ssc="b" xmlns:ssv="c" xmlns:ssm="d"'
SSD = b"""<?xml version="1.0"?>
<ssd:SystemStructureDescription %s version="1.0" name="nested">
<ssd:System name="root">
<ssd:ParameterBindings><ssd:ParameterBinding prefix="inner." source="extra.ssv"><ssd:ParameterMapping><ssm:ParameterMapping>
<ssm:MappingEntry source="k" target="k"><ssc:LinearTransformation factor="3" offset="1"/></ssm:MappingEntry></ssm:ParameterMapping></ssd:ParameterMapping>
</ssd:ParameterBinding></ssd:ParameterBindings>
<ssd:Elements>
<ssd:Component name="a" source="resources/a.fmu"><ssd:Connectors><ssd:Connector name="x" kind="output"><ssc:Real unit="mm"/></ssd:Connector>
<ssd:Connector name="u" kind="input"><ssc:Real/></ssd:Connector></ssd:Connectors></ssd:Component>
<ssd:System name="inner"><ssd:Connectors><ssd:Connector name="in" kind="input"><ssc:Real/></ssd:Connector><ssd:Connector name="out" kind="output"/>
<ssd:Connector name="k" kind="parameter"/></ssd:Connectors>
<ssd:Elements><ssd:Component name="b" source="resources/a.fmu"><ssd:Connectors><ssd:Connector name="u" kind="input"><ssc:Real unit="m"/></ssd:Connector>
<ssd:Connector name="x" kind="output"/></ssd:Connectors></ssd:Component></ssd:Elements>
<ssd:Connections><ssd:Connection startConnector="in" endElement="b" endConnector="u"><ssc:LinearTransformation factor="-1"/></ssd:Connection>
<ssd:Connection startElement="b" startConnector="x" endConnector="out"/><ssd:Connection startConnector="k" endElement="b" endConnector="k"/></ssd:Connections>
</ssd:System></ssd:Elements>
<ssd:Connections><ssd:Connection startElement="a" startConnector="x" endElement="inner" endConnector="in"/>
<ssd:Connection startElement="inner" startConnector="out" endElement="a" endConnector="u"/></ssd:Connections>
</ssd:System>
<ssd:Units><ssc:Unit name="m"><ssc:BaseUnit m="1"/></ssc:Unit><ssc:Unit name="mm"><ssc:BaseUnit m="1" factor="0.001"/></ssc:Unit></ssd:Units>
<ssd:DefaultExperiment startTime="1" stopTime="3"><ssd:Annotations><ssc:Annotation type="t"><M:Master xmlns:M="m" step="0.05"/></ssc:Annotation></ssd:Annotations>
</ssd:DefaultExperiment>
</ssd:SystemStructureDescription>
""" % NAMES
SSV = b"""<ssv:ParameterSet %s version="1.0" name="extra"><ssv:Parameters>
<ssv:Parameter name="k"><ssv:Real value="2" unit="mm"/></ssv:Parameter><ssv:Parameter name="n"><ssv:Integer value="7"/></ssv:Parameter>
<ssv:Parameter name="s"><ssv:String value="x"/></ssv:Parameter><ssv:Parameter name="e"><ssv:Enumeration name="x"/></ssv:Parameter>
</ssv:Parameters><ssv:Units><ssc:Unit name="mm"><ssc:BaseUnit m="1" factor="0.001"/></ssc:Unit></ssv:Units></ssv:ParameterSet>
""" % NAMES
FMI2 = b"""<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="a" guid="{g}" generationTool="t" numberOfEventIndicators="0">
<CoSimulation modelIdentifier="a" canHandleVariableCommunicationStepSize="true" canGetAndSetFMUstate="true" canInterpolateInputs="false"/>
<UnitDefinitions><Unit name="mm"><BaseUnit m="1" factor="0.001"/></Unit></UnitDefinitions>
<TypeDefinitions><SimpleType name="E"><Enumeration><Item name="one" value="1"/><Item name="two" value="2"/></Enumeration></SimpleType></TypeDefinitions>
<DefaultExperiment startTime="0" stopTime="1" stepSize="0.1"/>
<ModelVariables>
<ScalarVariable name="x[1]" valueReference="0" causality="output" variability="continuous"><Real unit="mm" nominal="2"/></ScalarVariable>
<ScalarVariable name="x[2]" valueReference="1" causality="output" variability="continuous"><Real unit="mm"/></ScalarVariable>
<ScalarVariable name="u" valueReference="2" causality="input" variability="continuous"><Real start="0"/></ScalarVariable>
<ScalarVariable name="n" valueReference="0" causality="parameter" variability="fixed"><Integer start="1"/></ScalarVariable>
<ScalarVariable name="e" valueReference="1" causality="parameter" variability="fixed"><Enumeration declaredType="E" start="1"/></ScalarVariable>
<ScalarVariable name="b" valueReference="0" causality="parameter" variability="fixed"><Boolean start="true"/></ScalarVariable>
<ScalarVariable name="s" valueReference="0" causality="parameter" variability="fixed"><String start="x"/></ScalarVariable>
</ModelVariables>
<ModelStructure><Outputs><Unknown index="1" dependencies="3"/><Unknown index="2"/></Outputs></ModelStructure>
</fmiModelDescription>
"""
FMI3 = b"""<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="3.0" modelName="a" instantiationToken="{g}">
<CoSimulation modelIdentifier="a" canGetAndSetFMUState="true"/>
<UnitDefinitions><Unit name="mm"><BaseUnit m="1" factor="0.001"/></Unit></UnitDefinitions>
<DefaultExperiment stepSize="0.1"/>
<ModelVariables>
<Float64 name="x" valueReference="0" causality="output" unit="mm"><Dimension start="2"/><Dimension valueReference="3"/></Float64>
<Float64 name="u" valueReference="1" causality="input" start="0"/>
<Int32 name="n" valueReference="2" causality="parameter" variability="fixed" start="1"/>
<UInt64 name="d" valueReference="3" causality="structuralParameter" variability="fixed" start="3"/>
<Boolean name="b" valueReference="4" causality="parameter" variability="fixed" start="true"/>
</ModelVariables>
<ModelStructure><Output valueReference="0" dependencies="1"/></ModelStructure>
</fmiModelDescription>
"""


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
    "message": lambda: iter([__import__("fmu_src.framing", fromlist=["encode"]).encode(("done", {"a": [1, 2.0, None, b"x", np.arange(3.0)]}))]),
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
