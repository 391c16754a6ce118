"""Excel workbooks as measurement files: what stands in the cells is read, nothing is computed, and a stranger's file does no harm."""

import datetime
import io
import zipfile

import numpy as np
import pandas as pd
import pytest
from openpyxl import Workbook, load_workbook

from discrepancy.campaign.guess.propose import propose
from discrepancy.campaign.guess.wishes import Wishes
from discrepancy.campaign.guess.write import checked
from discrepancy.campaign.readers import Options, read_columns, xlsx
from discrepancy.campaign.readers.xlsx import MOST_ROWS
from fmu_src.faults import InputFault

ANGLE = np.arange(0.0, 720.5, 0.5)
ERROR = 15.0 * np.sin(39 * np.radians(ANGLE)) + 5.0 * np.sin(2 * np.radians(ANGLE) + 0.3)
ARCSEC = np.pi / 648_000


def book(path, rows, others=()):
    made = Workbook()
    for row in rows:
        made.active.append(row)
    for title, content in others:
        sheet = made.create_sheet(title)
        for row in content:
            sheet.append(row)
    made.save(path)
    return path


def columns(path, *names, **options):
    return read_columns(path, set(names), Options(**options), "runs[1]")


def test_numbers_texts_dropouts_and_times(tmp_path):
    rows = [
        ["Prüfstand 3"], [], ["t", "te", "n", "at", "ok"],
        [datetime.time(0, 0, 1), "1,5", 1, datetime.datetime(2024, 2, 1, 12, 0, 0), True], [datetime.time(0, 1, 0, 500000), "#NV", 2, None, False],
        [], [datetime.timedelta(hours=1), 2.25, None, datetime.datetime(2024, 2, 1, 12, 0, 1), True],
    ]  # fmt: skip
    found = columns(book(tmp_path / "a.xlsx", rows), "t", "te", "n", "at", "ok", skip_lines=2)
    assert found["t"].tolist() == [1.0, 60.5, 3600.0]
    assert found["te"].tolist() == ["1.5", "#NV", 2.25]
    assert found["n"] == pytest.approx([1.0, 2.0, np.nan], nan_ok=True)
    assert (found["at"][2] - found["at"][0]) == np.timedelta64(1, "s") and np.isnat(found["at"][1])
    assert found["ok"].tolist() == [True, False, True]


def test_of_a_formula_the_saved_value_counts_and_one_without_is_said(tmp_path):
    path = book(tmp_path / "a.xlsx", [["x", "y"], [1, "=A2*2"], [2, 5]])
    with pytest.raises(InputFault, match=r"a\.xlsx: sheet 'Sheet', column 'y', row 2: a formula without its value; open the file in Excel"):
        columns(path, "y")
    assert columns(path, "x")["x"].tolist() == [1.0, 2.0]
    replace_part(path, "xl/worksheets/sheet1.xml", b"<f>A2*2</f><v></v>", b"<f>A2*2</f><v>77</v>", b"<f>A2*2</f><v />")
    assert columns(path, "y")["y"].tolist() == [77.0, 5.0]


def replace_part(path, part, old, new, *more):
    with zipfile.ZipFile(path) as archive:
        parts = {name: archive.read(name) for name in archive.namelist()}
    for text in (old, *more):
        parts[part] = parts[part].replace(text, new)
    with zipfile.ZipFile(path, "w") as archive:
        for name, content in parts.items():
            archive.writestr(name, content)


def test_sheets(tmp_path):
    table = [["x"], [1.0], [2.0]]
    path = book(tmp_path / "a.xlsx", table, [("notes", []), ("second", [["x"], [3.0]])])
    with pytest.raises(InputFault, match=r"several sheets hold something; state sheet = one of 'Sheet', 'second'"):
        columns(path, "x")
    assert columns(path, "x", sheet="second")["x"].tolist() == [3.0]
    with pytest.raises(InputFault, match=r"sheet = 'third': the workbook has no such sheet; it has 'Sheet', 'notes', 'second'"):
        columns(path, "x", sheet="third")
    with pytest.raises(InputFault, match=r"column 'y': the file has no such column; it has x"):
        columns(path, "y", sheet="second")
    with pytest.raises(InputFault, match="no sheet has anything"):
        columns(book(tmp_path / "b.xlsx", []), "x")
    with pytest.raises(InputFault, match="the sheet has 2 columns of this name"):
        columns(book(tmp_path / "c.xlsx", [["x", "x"], [1, 2]]), "x")


def test_a_workbook_becomes_a_campaign(tmp_path):
    """As a bench writes it: a title, the condition, a header with a row of units, a sheet of notes."""
    rows = [["Prüfstand 3"], ["Drehzahl:", 15, "1/min"], ["Probe:", 7], [], [None, "Winkel", "Fehler"], [None, "°", "arcsec"], *[[None, a, e] for a, e in zip(ANGLE, ERROR)]]
    path = book(tmp_path / "te_167Nm_1.xlsx", rows, [("Notizen", [["alles gut"]])])
    proposal = propose([path], Wishes("RV20E-121"))
    record = checked(proposal).records[0]
    assert record.quantity == "transmission_error"
    assert record.axes["angle"] == pytest.approx(np.radians(ANGLE)) and record.values == pytest.approx(ERROR * ARCSEC)
    assert record.factors["load"] == pytest.approx(167.0)
    assert [d.text for d in proposal.doubts if "sheet" in d.text] == ["the sheet 'Sheet' is taken, not 'Notizen'"]
    assert not proposal.needs


def test_a_workbook_without_a_header(tmp_path):
    path = book(tmp_path / "te_1.xlsx", [[a, e] for a, e in zip(ANGLE, ERROR)])
    assert checked(propose([path], Wishes("RV20E-121"))).records[0].values == pytest.approx(ERROR * ARCSEC)


@pytest.mark.parametrize("name, content, said", [
    ("a.xlsx", b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1" + bytes(500), "old Excel .*or one with a password; save it as .xlsx without a password"),
    ("a.xlsx", b"PK\x03\x04 nothing", "not readable as xlsx"),
    ("a.xlsx", b"", "not readable as xlsx"),
])  # fmt: skip
def test_what_is_no_workbook(tmp_path, name, content, said):
    (tmp_path / name).write_bytes(content)
    with pytest.raises(InputFault, match=rf"a\.xlsx: .*{said}"):
        columns(tmp_path / name, "x")


def test_sheets_of_other_programs_are_named(tmp_path):
    (tmp_path / "a.ods").write_bytes(b"PK")
    with pytest.raises(InputFault, match=r"a\.ods: such sheets are not read; save it as \.xlsx"):
        propose([tmp_path / "a.ods"], Wishes("RV20E-121"))


def bomb(path, part, content):
    content_of = io.BytesIO()
    book(content_of, [["x"], [1.0]])
    with zipfile.ZipFile(content_of) as archive, zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as out:
        for name in archive.namelist():
            out.writestr(name, content if name == part else archive.read(name))
    return path


SHEET = '<worksheet xmlns="http://schemas.openxmlformats.org/spreadsheetml/2006/main"><sheetData>{}</sheetData></worksheet>'
ENTITIES = "<!DOCTYPE a [<!ENTITY b '" + 1000 * "c" + "'>" + "".join(f"<!ENTITY b{k} '{10 * ('&b' + str(k - 1 or '') + ';')}'>" for k in range(1, 9)) + "]>"


@pytest.mark.parametrize("content, said", [
    (SHEET.format('<row r="1"><c r="A1" t="inlineStr"><is><t>x</t></is></c></row><row r="99999999"><c r="A99999999"><v>1</v></c></row>'), "beyond 1048576 rows"),
    (ENTITIES + SHEET.format('<row r="1"><c r="A1" t="inlineStr"><is><t>&b8;</t></is></c></row>'), "not readable as xlsx|asks for more memory|has no such column"),
])  # fmt: skip
def test_a_stranger_s_workbook(tmp_path, content, said):
    assert MOST_ROWS == 1_048_576
    with pytest.raises(InputFault, match=rf"a\.xlsx.*({said})"):
        columns(bomb(tmp_path / "a.xlsx", "xl/worksheets/sheet1.xml", content), "x")


def test_a_zip_bomb_is_not_unpacked(tmp_path, monkeypatch):
    monkeypatch.setattr(xlsx, "MOST_UNPACKED", 100_000)
    path = bomb(tmp_path / "a.xlsx", "xl/worksheets/sheet1.xml", SHEET.format(" " * 1_000_000))
    with pytest.raises(InputFault, match="unpacked it has more than"):
        xlsx.read(path, {"x"}, Options())


def test_links_and_macros_are_left_alone(tmp_path):
    """What is not read cannot lead anywhere: a workbook of macros is read as one without."""
    path = book(tmp_path / "a.xlsm", [["x"], [1.0]])
    assert columns(path, "x")["x"].tolist() == [1.0]
    pd.DataFrame({"x": [1.0, 2.0]}).to_excel(tmp_path / "b.xlsx", index=False)
    assert load_workbook(tmp_path / "b.xlsx").active["A1"].value == "x"
    assert columns(tmp_path / "b.xlsx", "x")["x"].tolist() == [1.0, 2.0]
