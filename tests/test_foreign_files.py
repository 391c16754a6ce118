"""Files of others: nothing in one decides where we write, how long we run or how much memory we take, and none passes that says nothing."""

import gzip
import io
import zipfile

import numpy as np
import pytest
from test_ssp import NAMES, NESTED, package

from cli.main import main
from discrepancy.campaign import file_format
from discrepancy.campaign.load import load_campaign
from discrepancy.campaign.readers import csv as csv_reader
from discrepancy.campaign.readers.formula import FormulaFault, computed
from discrepancy.model_file import load_model
from fmu_src import reading
from fmu_src.faults import InputFault
from fmu_src.file_name import file_name, name_of_folder
from fmu_src.reading import unpack_archive
from orchestrator.fmu import Fmu
from orchestrator.regression import parse_tolerance
from orchestrator.series import read_series
from orchestrator.ssp.importer import read_ssp
from orchestrator.system import load
from studies.duty import load_duty

# Archives


def archive(path, *members, content=b"x"):
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as file:
        for member in members:
            file.writestr(member, content)
    return path


@pytest.mark.parametrize("name", ["../x", "/tmp/rvwear_x", "a/../../x", "C:\\x", "..\\x", "\\x", "/".join("a" * 50)])
def test_no_member_of_an_archive_leaves_its_folder(tmp_path, name):
    (tmp_path / "folder").mkdir()
    with pytest.raises(InputFault, match=r"bad.zip: the archive holds .* a path that leads out of it"):
        unpack_archive(archive(tmp_path / "bad.zip", "good", name), tmp_path / "folder", "FMU")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["bad.zip", "folder"] and not list((tmp_path / "folder").iterdir())


def test_links_and_passwords_in_an_archive_are_refused(tmp_path):
    link = zipfile.ZipInfo("link")
    link.external_attr = 0o120777 << 16
    with pytest.raises(InputFault, match="'link', a link; pack the file"):
        unpack_archive(archive(tmp_path / "link.zip", link), tmp_path, "FMU")


def test_archive_that_grows_without_end_is_left(tmp_path, monkeypatch):
    path = archive(tmp_path / "bomb.zip", "bomb", content=bytes(20_000_000))
    with pytest.raises(InputFault, match="unpacked it is larger than"):
        unpack_archive(path, tmp_path, "FMU", 5_000_000)
    # Also where its directory says that it is small.
    data = bytearray(path.read_bytes())
    for place in (22, data.rindex(b"PK\x01\x02") + 24):
        data[place : place + 4] = (10).to_bytes(4, "little")
    path.write_bytes(data)
    with pytest.raises(InputFault, match=r"bomb.zip"):
        unpack_archive(path, tmp_path, "FMU", 5_000_000)
    monkeypatch.setattr(reading, "MOST_MEMBERS", 3)
    with pytest.raises(InputFault, match="4 files in it, more than 3"):
        unpack_archive(archive(tmp_path / "many.zip", *"abcd"), tmp_path, "FMU")


def test_csv_that_grows_without_end_is_left(tmp_path, monkeypatch):
    monkeypatch.setattr(csv_reader, "MOST_UNPACKED", 1000)
    (tmp_path / "a.csv.gz").write_bytes(gzip.compress(b"a,b\n" + b"0,0\n" * 1000))
    with pytest.raises(InputFault, match="unpacked it has more than"):
        csv_reader.scan(tmp_path / "a.csv.gz")


# SSP


@pytest.mark.parametrize("name, expected", [("../../x", "_.._x"), ("/etc/x", "_etc_x"), ("..", "unnamed"), ("", "unnamed"), ("a b-1.c", "a b-1.c"), ("a\\b:c\n", "a_b_c_"),
                                            ("x" * 500, "x" * 100)])  # fmt: skip
def test_name_of_a_system_is_no_path(name, expected):
    assert file_name(name) == expected


@pytest.mark.parametrize("folder, expected", [("Messung Prüfstand 7", None), ("Mu\u0308ller", "Müller"), ("測定 7", None), ("Łódź (2) & Ø", None), ("-.x", "x"), ("a\ud800b", "a_b"),
                                              ("...", "unnamed"), ("測" * 300, "測" * 66), ("7: a?", "7_ a_")])  # fmt: skip
def test_name_of_a_folder_keeps_letters_of_any_alphabet(folder, expected):
    """As the name of its campaign, which campaign.toml takes."""
    name = name_of_folder(folder)
    assert name == (expected or folder)
    assert file_format.Head(name=name).name == name


def test_result_of_a_system_stays_in_the_folder_of_results(tmp_path, spring, monkeypatch, capsys):
    (tmp_path / "s" / "t").mkdir(parents=True)
    package(tmp_path, spring, NESTED.replace('version="1.0" name="nested"', 'version="1.0" name="../../x"'))
    monkeypatch.chdir(tmp_path / "s" / "t")
    assert main(["run", str(tmp_path / "nested.ssp"), "--json"]) == 0
    assert capsys.readouterr().out and [path.name for path in (tmp_path / "s" / "t" / "results").iterdir()] == ["_.._x.nc"]
    assert not list(tmp_path.glob("*.nc")) and not list((tmp_path / "s").glob("*.nc"))


def ssd(tmp_path, elements="", connections="", more=""):
    (tmp_path / "SystemStructure.ssd").write_text(
        f'<ssd:SystemStructureDescription {NAMES} name="s" version="1.0"><ssd:System name="r"><ssd:Elements>{elements}</ssd:Elements>'
        f"<ssd:Connections>{connections}</ssd:Connections></ssd:System>{more}</ssd:SystemStructureDescription>", encoding="utf-8")  # fmt: skip
    return tmp_path


UNIT = '<ssd:Component name="a" source="a.fmu"><ssd:Connectors><ssd:Connector name="u" kind="input"/></ssd:Connectors></ssd:Component>'
SUBSYSTEMS = "".join(f'<ssd:System name="{name}"><ssd:Connectors><ssd:Connector name="c" kind="inout"/></ssd:Connectors></ssd:System>' for name in "xy")


def link(start, end):
    return f'<ssd:Connection startElement="{start[0]}" startConnector="{start[1]}" endElement="{end[0]}" endConnector="{end[1]}"/>'


def test_connectors_in_a_circle_are_told(tmp_path):
    circle = link("yc", "xc") + link("xc", "yc") + link("xc", "au")
    with pytest.raises(InputFault, match=r"connection to a.u: it goes in a circle through"):
        read_ssp(ssd(tmp_path, UNIT + SUBSYSTEMS, circle))


def test_value_that_goes_in_a_circle_is_told(tmp_path):
    value = ('<ssd:ParameterBindings><ssd:ParameterBinding prefix="x."><ssd:ParameterValues><ssv:ParameterSet><ssv:Parameters><ssv:Parameter name="c">'
             '<ssv:Real value="1"/></ssv:Parameter></ssv:Parameters></ssv:ParameterSet></ssd:ParameterValues></ssd:ParameterBinding></ssd:ParameterBindings>')  # fmt: skip
    path = ssd(tmp_path, SUBSYSTEMS, link("yc", "xc") + link("xc", "yc"))
    text = (path / "SystemStructure.ssd").read_text().replace('<ssd:System name="r">', '<ssd:System name="r">' + value)
    (path / "SystemStructure.ssd").write_text(text)
    with pytest.raises(InputFault, match="it goes in a circle from connector to connector"):
        read_ssp(path)


def test_system_that_contains_itself_is_told(tmp_path):
    with pytest.raises(InputFault, match=r"SystemStructure.ssd: the system contains itself, as me: take it out"):
        read_ssp(ssd(tmp_path, '<ssd:Component name="me" source="SystemStructure.ssd"/>'))
    with pytest.raises(InputFault, match="more than 20 deep"):
        read_ssp(ssd(tmp_path, '<ssd:System name="x"><ssd:Elements>' * 25 + "</ssd:Elements></ssd:System>" * 25))


def test_package_that_contains_itself_is_told(tmp_path):
    """Each package within the other is unpacked anew: only the depth tells."""
    text = f'<ssd:SystemStructureDescription {NAMES} name="s"><ssd:System name="r"><ssd:Elements>%s</ssd:Elements></ssd:System></ssd:SystemStructureDescription>'
    content = text % ""
    for _ in range(25):
        inner = io.BytesIO()
        with zipfile.ZipFile(inner, "w") as file:
            file.writestr("SystemStructure.ssd", content if isinstance(content, str) else text % '<ssd:Component name="c" source="inner.ssp"/>')
            if not isinstance(content, str):
                file.writestr("inner.ssp", content)
        content = inner.getvalue()
    (tmp_path / "deep.ssp").write_bytes(content)
    with pytest.raises(InputFault, match="systems within systems more than 20 deep; does one contain itself"):
        read_ssp(tmp_path / "deep.ssp")


@pytest.mark.parametrize("source", ["/etc/passwd", "../x.fmu", "a/../../x.fmu", "file:/etc/passwd", "FILE:///etc/passwd", "C:/x.fmu", "..%2Fx.fmu", ""])
def test_sources_outside_of_the_package_are_refused(tmp_path, source):
    with pytest.raises(InputFault, match="is not a file of the package"):
        read_ssp(ssd(tmp_path, f'<ssd:Component name="a" source="{source}"/>'))


def test_senseless_numbers_of_a_system_are_told(tmp_path, spring):
    for before, after in (('stopTime="3"', 'stopTime="1e300"'), ('stopTime="3"', 'stopTime="nan"'), ('stepSize="0.05"', 'stepSize="-1"'), ('m="1"', 'm="1e9"'),
                          ('factor="0.001"', 'factor="0"')):  # fmt: skip
        assert before in NESTED
        with pytest.raises(InputFault):
            load(package(tmp_path, spring, NESTED.replace(before, after)))


def test_recording_that_fills_the_memory_is_refused(spring, monkeypatch):
    monkeypatch.setattr("orchestrator.system.MOST_RECORDED", 1e6)
    system = load(spring, 1e-3)
    with pytest.raises(InputFault, match=r"take .* GB: record fewer"):
        system.run(9.9e3, record=["*"])
    system.close()


# FMUs


@pytest.mark.parametrize("content, said", [
    ("", "holds no modelDescription.xml"), ("<a", "not readable as an FMU"),
    ('<fmiModelDescription fmiVersion="2.0" modelName="a" guid="g"><CoSimulation modelIdentifier="../../a"/><ModelVariables/><ModelStructure/></fmiModelDescription>',
     "modelIdentifier = '../../a': letters, digits"),
])  # fmt: skip
def test_broken_fmu_is_told(tmp_path, content, said):
    with zipfile.ZipFile(tmp_path / "a.fmu", "w") as file:
        if content:
            file.writestr("modelDescription.xml", content)
    with pytest.raises(InputFault, match=said):
        Fmu("a", tmp_path / "a.fmu")


def test_file_of_our_name_in_an_fmu_of_others_does_no_harm(tmp_path, spring):
    for number, text in enumerate(("[]", "{}", '"x"')):
        path = tmp_path / f"{number}.fmu"
        path.write_bytes(spring.read_bytes())
        with zipfile.ZipFile(path, "a") as file:
            file.writestr("resources/unit.json", text)
        Fmu("a", path).close()


# References


def write(path, text):
    path.write_text(text)
    return path


@pytest.mark.parametrize("text, said", [
    ("time,a.x\n0,inf\n1,2\n", r"a.x = inf at time 0 s \(row 1\): a finite number is needed"), ("time,a.x\n0,1\n1,nan\n", "a.x = nan at time 1 s"),
    ("time\n0\n1\n", "nothing but the time"), ("time,a.x,a.x\n0,1,2\n1,1,2\n", "a.x: more than one column of this name"), ("time,a.x\ninf,1\n", "time = inf"),
    ("time,a.x\n", "no rows"), ("a.x\n1\n", "no column 'time'"), ("", "is empty"), ("time,a.x\n0,x\n", "could not convert"), ("time,a.x\n0\n", "line 2 has 1 values"),
])  # fmt: skip
def test_reference_that_cannot_fail_anything_is_refused(tmp_path, text, said):
    with pytest.raises(InputFault, match=said):
        read_series(write(tmp_path / "ref.csv", text))


def test_netcdf_reference_without_numbers_over_time_is_refused(tmp_path):
    import xarray as xr

    for name, dataset in (("none", xr.Dataset({}, {"time": ("time", [0.0, 1.0])})), ("other", xr.Dataset({"x": ("n", [1.0])}, {"time": ("time", [0.0])})),
                          ("inf", xr.Dataset({"x": ("time", [np.inf])}, {"time": ("time", [0.0])})), ("text", xr.Dataset({"x": ("time", ["a"])}, {"time": ("time", [0.0])})),
                          ("scalar", xr.Dataset({"x": 1.0, "time": 2.0}))):  # fmt: skip
        dataset.to_netcdf(tmp_path / f"{name}.nc", engine="netcdf4")
        with pytest.raises(InputFault, match=name):
            read_series(tmp_path / f"{name}.nc")


@pytest.mark.parametrize("text", ["inf", "a.x=inf", "nan", "1e-6,inf"])
def test_tolerance_that_cannot_fail_anything_is_refused(text):
    with pytest.raises(InputFault, match="finite numbers"):
        parse_tolerance(text)


# Formulas


@pytest.mark.parametrize("formula, expected", [
    ("2*X+1", lambda x: 2 * x + 1), ("X1^2 + -X", lambda x: x**2 - x), ("sqrt(X)/10", lambda x: np.sqrt(x) / 10), ("pow(X, 2)", lambda x: x**2), ("3", lambda x: 3 + 0 * x),
])  # fmt: skip
def test_formula_is_computed(formula, expected):
    raw = np.array([1, 2, 3], "i2")
    assert np.allclose(computed(formula, raw), expected(raw.astype(float)))


@pytest.mark.parametrize("formula", [
    "9**9**9**9", "X/0", "__import__('os').system('true')", "X.real", "[X for X in X]", "(lambda: X)()", "X if X else 0", "Y", "", "1e400*X", "sin()", "sin(X, X)", "X+" * 400 + "X",
    "'a'*9", "True*X", "(" * 300 + "X" + ")" * 300, "X\0",
])  # fmt: skip
def test_formula_that_cannot_be_computed_is_told(formula):
    with pytest.raises(FormulaFault, match="formula"):
        computed(formula, np.arange(3.0))


@pytest.mark.parametrize("version", ["4.10", "3.30"])
def test_formulas_in_measurements_are_arithmetic_or_a_fault(tmp_path, version):
    asammdf = pytest.importorskip("asammdf")
    from discrepancy.campaign.readers import Options, read_columns

    def read(formula):
        with asammdf.MDF(version=version) as file:
            file.append([asammdf.Signal(np.arange(5, dtype="i2"), np.arange(5.0), name="a", conversion={"formula": formula})])
            path = file.save(tmp_path / f"m.{'mf4' if version > '4' else 'mdf'}", overwrite=True)
        return read_columns(path, {"a"}, Options(), "runs[1]")["a"]

    assert np.array_equal(read("2*X+1"), 2 * np.arange(5.0) + 1)
    marker = tmp_path / "ran"
    for formula in ("9**9**9**9", "X + Y", f"__import__('pathlib').Path({str(marker)!r}).touch()"):
        with pytest.raises(InputFault, match=r"runs\[1\].*column 'a': .*formula.*export it with physical values"):
            read(formula)
    assert not marker.exists()


# Keys


@pytest.mark.parametrize("text, said", [
    ('[model]\nname="m"\nreducer="RV20E-121"\n[setings]\nbearing_clearance="3 um"\n', "setings = .* is not a key here; did you mean settings"),
    ('[model]\nname="m"\nreducer="RV20E-121"\nredcer="x"\n', "model.redcer .*did you mean reducer"),
    ('[model]\nname="../m"\nreducer="RV20E-121"\n', "model.name = '../m'"), ('[model]\nname="m"\n', "model.reducer is missing"),
    ('[model]\nname="m"\nreducer="RV20E-121"\n[effects.needle_clearance]\nneedle_clearance_added={value=2e-6,uint="m"}\n', "uint: there is no such key; did you mean unit"),
    ('[model]\nname="m"\nreducer="RV20E-121"\n[effects.needle_clearance]\nneedle_clearance_added={value="x",unit="m"}\n', "needle_clearance_added"),
    ('[model]\nname="m"\nreducer="RV20E-121"\n[effects.needle_clearance]\nneedle_clearance_added={value=2e9,unit="m"}\n', "out of range"),
    ('[model]\nname="m"\nreducer="RV20E-121"\n[effects.needle_clearance]\nneedle_clearance_added={value=2,unit="kg"}\n', "'kg' does not fit"),
    ('[model]\nname="m"\nreducer="RV20E-121"\n[effects.neddle_clearance]\n', "no such effect; did you mean needle_clearance"),
    ('[model]\nname="m"\nreducer="RV20E-121"\n[[steps]]\neffcts=[]\n', "effects is missing|did you mean effects"),
    ("model = 3\n", "model"), ("model = {}\nx = 1979-05-27\n", "a date or time"), ("x = " + "[" * 5000, "nested too deeply"), ("x = " + "9" * 5000, "not readable as a TOML file"),
    ("x = 99999999999999999999", "beyond 64 bits"), ("x = " + "[" * 30 + "]" * 30, "nested more than 20 deep"), ("\xff", "line 1: the byte 0xff is no UTF-8"),
])  # fmt: skip
def test_every_key_of_a_model_file_is_checked(tmp_path, text, said):
    (tmp_path / "m.toml").write_bytes(text.encode("latin-1"))
    with pytest.raises(InputFault, match=said):
        load_model(tmp_path / "m.toml")


def test_unit_of_an_effects_number_counts(tmp_path):
    text = '[model]\nname="m"\nreducer="RV20E-121"\n[effects.needle_clearance]\nneedle_clearance_added={value=2.0,unit="um",low=1.0}\n'
    model = load_model(write(tmp_path / "m.toml", text))
    assert model.effects["needle_clearance"]["needle_clearance_added"] == {"value": pytest.approx(2e-6), "unit": "m", "low": pytest.approx(1e-6)}


def test_other_files_name_the_nearest_key(tmp_path):
    with pytest.raises(InputFault, match=r"segment\[1\].torqe = .* is not a key here; did you mean torque"):
        load_duty(write(tmp_path / "d.toml", '[[segment]]\nspeed={value=1,unit="rpm"}\ntorqe={value=1,unit="N.m"}\nshare=1\n'))
    with pytest.raises(InputFault, match=r"scenario.durration = .*did you mean duration"):
        load(write(tmp_path / "s.toml", '[scenario]\nname="s"\nstep={value=1,unit="s"}\nduration={value=1,unit="s"}\ndurration=1\n[components.a]\nfmu="x"\n'))


CAMPAIGN = """
[campaign]
name = "c"
reducer = "RV20E-121"
[conditions.a]
input_speed = "15 rpm"
load_torque = "100 N.m"
[[runs]]
id = "r"
quantity = "lost_motion"
condition = "a"
value = "1 arcmin"
[nuisances.NAME]
unit = "1"
lower = -1
upper = 1
"""


def test_unknown_nuisance_is_told_by_the_check(tmp_path, capsys):
    write(tmp_path / "campaign.toml", CAMPAIGN.replace("NAME", "sensor_gian"))
    load_campaign(tmp_path)
    assert main(["campaign", "check", str(tmp_path)]) == 2
    assert "nuisances.sensor_gian: the model has no such parameter; did you mean sensor_gain" in capsys.readouterr().err
