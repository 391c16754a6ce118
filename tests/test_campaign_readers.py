"""Small real files of every format give the same records."""

import gzip

import h5py
import numpy as np
import pandas as pd
import pytest
import scipy.io
from asammdf import MDF, Signal
from nptdms import ChannelObject, TdmsWriter

from discrepancy.campaign.load import load_campaign
from fmu_src.faults import InputFault

ANGLE = np.array([0.0, 90.0, 180.0, 270.0, 360.0])
ERROR = np.array([1.0, 2.5, -0.5, 0.0, 1.5])
ARCSEC = np.pi / 648_000

HEAD = """
[campaign]
name = "small"
reducer = "RV20E-121-rigid"
[conditions.a]
output_speed = "15 rpm"
load_torque = "50 %"
"""


def campaign(folder, run: str, head: str = HEAD):
    """A campaign of one run."""
    text = f'{head}\n[[runs]]\nid = "r"\ncondition = "a"\nquantity = "transmission_error"\n{run}\n'
    (folder / "campaign.toml").write_text(text, encoding="utf-8")
    return load_campaign(folder)


def columns(angle="phi", value="te") -> str:
    return (
        f'columns.angle = {{ column = "{angle}", unit = "deg" }}\ncolumns.value = {{ column = "{value}", unit = "arcsec" }}'
    )


def is_measured(record) -> None:
    assert record.unit == "rad"
    assert record.axes["angle"] == pytest.approx(np.radians(ANGLE))
    assert record.values == pytest.approx(ERROR * ARCSEC)


@pytest.mark.parametrize("text, options", [
    ("# bench 3\nphi,te\n0,1\n90,2.5\n180,-0.5\n270,0\n360,1.5\n", ""),
    ("phi;te\n0;1\n90;2,5\n180;-0,5\n270;0\n360;1,5\n", ""),
    ("phi\tte\n0\t1\n90\t2.5\n180\t-0.5\n270\t0\n360\t1.5\n", ""),
    ("phi   te\n0   1\n90  2.5\n180 -0.5\n270 0\n360 1.5\n", ""),
    ("# a\n\n# b\nno #1,phi,te\n7,0,1\n7,90,2.5\n# pause\n7,180,-0.5\n7,270,0\n7,360,1.5\n", ""),
    ("phi,te,\n0,1,\n90,2.5,\n180,-0.5,\n270,0,\n360,1.5,\n", ""),
    ("phi;te\ndeg;arcsec\n0;1\n90;2,5\n180;-0,5\n270;0\n360;1,5\n", 'decimal = ","\nunits_line = true'),
    ("Prüfstand\nvom Montag\nphi,te\n0,1\n90,2.5\n180,-0.5\n270,0\n360,1.5\n", "skip_lines = 2"),
])  # fmt: skip
@pytest.mark.parametrize("encoding", ["utf-8", "utf-8-sig", "cp1252", "utf-16", "utf-16-be", "utf-16-le"])
def test_delimited_text(tmp_path, text, options, encoding):
    (tmp_path / "a.csv").write_text(text, encoding=encoding)
    is_measured(campaign(tmp_path, f'file = "a.csv"\n{options}\n{columns()}').records[0])


@pytest.mark.parametrize("word", ["#NV", "---", "OL", ""])
@pytest.mark.parametrize("units", [False, True])
def test_one_word_in_a_column_with_decimal_commas(tmp_path, word, units):
    """As the message advises: listed in ``missing`` it stands for nothing measured."""
    rows = "deg;arcsec\n" * units + f"0;1,0\n45;{word}\n90;2,5\n180;-0,5\n270;0,0\n360;1,5\n"
    (tmp_path / "a.csv").write_text("phi;te\n" + rows)
    run = f'file = "a.csv"\n{columns()}\nunits_line = {str(units).lower()}'
    if word:
        with pytest.raises(InputFault, match=rf"column 'te', row \d: '{word}' is not a number.*missing = \['{word}'\]"):
            campaign(tmp_path, run)
        run += f"\nmissing = ['{word}']"
    loaded = campaign(tmp_path, run)
    is_measured(loaded.records[0])
    assert loaded.rows["r"].dropped == 1


@pytest.mark.parametrize("text", [
    "phi;te\n0;1.001,0\n90;1.002,5\n180;999,5\n270;1.000,0\n360;1.001,5\n",
    'phi,te\n0,"1,001.0"\n90,"1,002.5"\n180,999.5\n270,"1,000"\n360,"1,001.5"\n',
    "phi\tte\n0\t1 001,0\n90\t1 002,5\n180\t999,5\n270\t1 000,0\n360\t1 001,5\n",
    "phi;te\n0;1'001.0\n90;1'002.5\n180;999.5\n270;1'000\n360;1'001.5\n",
    'phi,te\n0,"1001,0"\n90,"1002,5"\n180,"999,5"\n270,"1000,0"\n360,"1001,5"\n',
])  # fmt: skip
def test_thousands_set_apart(tmp_path, text):
    (tmp_path / "a.csv").write_text(text, encoding="utf-8")
    assert campaign(tmp_path, f'file = "a.csv"\n{columns()}').records[0].values == pytest.approx((ERROR + 1000) * ARCSEC)


def test_what_may_be_a_thousand_or_a_fraction_is_asked(tmp_path):
    (tmp_path / "a.csv").write_text("phi;te\n0,5;1.001\n90,5;1.002\n")
    with pytest.raises(InputFault, match=r"column 'te', row 1: '1.001' may be a thousand or a fraction; state thousands"):
        campaign(tmp_path, f'file = "a.csv"\n{columns()}')
    stated = campaign(tmp_path, f'file = "a.csv"\nthousands = "."\n{columns()}').records[0]
    assert stated.values == pytest.approx(np.array([1001, 1002]) * ARCSEC)


@pytest.mark.parametrize("angle, encoding", [("输出角度", "gb18030"), ("出力角度", "cp932"), ("Drehwinkel größer µ°", "cp1252"), ("Abtriebswinkel°", "cp1252")])
def test_encodings_of_windows(tmp_path, angle, encoding):
    (tmp_path / "a.csv").write_text(f"{angle},te\n0,1\n90,2.5\n180,-0.5\n270,0\n360,1.5\n", encoding=encoding)
    is_measured(campaign(tmp_path, f'file = "a.csv"\n{columns(angle)}').records[0])
    is_measured(campaign(tmp_path, f'file = "a.csv"\nencoding = "{encoding}"\n{columns(angle)}').records[0])
    with pytest.raises(InputFault, match="encoding = 'klingon' is not known"):
        campaign(tmp_path, f'file = "a.csv"\nencoding = "klingon"\n{columns(angle)}')


def test_gzipped_text_and_columns_by_number(tmp_path):
    with gzip.open(tmp_path / "a.csv.gz", "wt") as file:
        file.writelines(f"{a} {e}\n" for a, e in zip(ANGLE, ERROR))
    is_measured(campaign(tmp_path, f'file = "a.csv.gz"\nheader = false\n{columns("1", "2")}').records[0])


@pytest.mark.parametrize("text, said", [
    ("phi,te\n0,1,5\n90,2,5\n", "delimiter ',' and decimal '.'.*state delimiter and decimal"),
    ("phi,te,te\n0,1,5\n90,2,5\n", "'te': the file has 2 columns of this name; rename one"),
    ("", "the file is empty; it needs a line of column names"),
])  # fmt: skip
def test_doubtful_text_is_refused(tmp_path, text, said):
    (tmp_path / "a.csv").write_text(text)
    with pytest.raises(InputFault, match=rf"(?s)a\.csv: .*{said}"):
        campaign(tmp_path, f'file = "a.csv"\n{columns()}')


def test_single_column_with_decimal_comma(tmp_path):
    (tmp_path / "a.csv").write_text("T\n1,5\n2,5\n")
    head = HEAD.replace("[conditions.a]", "[layouts.x]\nquantity = 'input_torque'\n[conditions.a]")
    (tmp_path / "campaign.toml").write_text(
        f'{head}\n[[runs]]\nlayout = "x"\nid = "r"\ncondition = "a"\nfile = "a.csv"\n'
        'columns.value = { column = "T", unit = "N.m" }'
    )
    assert load_campaign(tmp_path).records[0].values == pytest.approx([1.5, 2.5])


def test_parquet(tmp_path):
    pd.DataFrame({"phi": ANGLE, "te": ERROR}).to_parquet(tmp_path / "a.parquet")
    is_measured(campaign(tmp_path, f'file = "a.parquet"\n{columns()}').records[0])


@pytest.mark.parametrize("names", [("phi", "te"), ("run.phi", "run.te"), ("m[1]", "m[2]")])
def test_mat(tmp_path, names):
    content = {"phi": ANGLE, "te": ERROR[:, None], "run": {"phi": ANGLE, "te": ERROR}, "m": np.column_stack([ANGLE, ERROR])}
    scipy.io.savemat(tmp_path / "a.mat", content)
    is_measured(campaign(tmp_path, f'file = "a.mat"\n{columns(*names)}').records[0])


@pytest.mark.parametrize("names", [("phi", "te"), ("run.phi", "run.te"), ("m[1]", "m[2]")])
def test_mat_7_3(tmp_path, names):
    with h5py.File(tmp_path / "a.mat", "w") as file:
        for group in (file, file.create_group("run")):
            group["phi"], group["te"] = ANGLE[None, :], ERROR[None, :]
        file["m"] = np.column_stack([ANGLE, ERROR]).T
    is_measured(campaign(tmp_path, f'file = "a.mat"\n{columns(*names)}').records[0])


def write_mdf(path, version="4.10") -> None:
    time, slow = np.linspace(0.0, 4.0, 5), np.linspace(0.0, 4.0, 9)
    with MDF(version=version) as file:
        file.append([Signal(ANGLE, time, name="phi"), Signal(ERROR, time, name="te")])
        file.append([Signal(np.interp(slow, time, ERROR), slow, name="te_fast")])
        file.save(path, overwrite=True)


def test_mdf4(tmp_path):
    write_mdf(tmp_path / "a.mf4")
    run = f'file = "a.mf4"\n{columns()}\ncolumns.time = {{ column = "time", unit = "s" }}'
    record = campaign(tmp_path, run).records[0]
    is_measured(record)
    assert record.axes["time"] == pytest.approx(np.arange(5.0))


def test_groups_of_mdf3_go_by_their_number(tmp_path):
    write_mdf(tmp_path / "a.mdf", "3.30")
    is_measured(campaign(tmp_path, f'file = "a.mdf"\n{columns()}\ngroup = "0"').records[0])
    with pytest.raises(InputFault, match="column 'phi': the file has no such column"):
        campaign(tmp_path, f'file = "a.mdf"\n{columns()}\ngroup = "1"')


def test_channels_of_different_rates_are_interpolated_only_on_demand(tmp_path):
    write_mdf(tmp_path / "a.mf4")
    run = f'file = "a.mf4"\n{columns(value="te_fast")}'
    with pytest.raises(InputFault, match=r'a\.mf4: columns phi, te_fast were not sampled at the same times .*align = "phi"'):
        campaign(tmp_path, run)
    is_measured(campaign(tmp_path, f'{run}\nalign = "phi"').records[0])


def test_tdms(tmp_path):
    properties = {"wf_increment": 0.5, "wf_start_offset": 0.0}
    with TdmsWriter(tmp_path / "a.tdms") as file:
        channels = [ChannelObject(g, n, v, properties) for g in ("one", "two") for n, v in (("phi", ANGLE), ("te", ERROR))]
        file.write_segment(channels)
    run = f'file = "a.tdms"\n{columns()}\ncolumns.time = {{ column = "time", unit = "s" }}'
    record = campaign(tmp_path, f'{run}\ngroup = "two"').records[0]
    is_measured(record)
    assert record.axes["time"] == pytest.approx(0.5 * np.arange(5))
    is_measured(campaign(tmp_path, f'file = "a.tdms"\n{columns("one/phi", "one/te")}').records[0])
    with pytest.raises(InputFault, match="in several groups; write group/"):
        campaign(tmp_path, run)


@pytest.mark.parametrize("name", ["a.parquet", "a.mat", "a.mf4", "a.tdms"])
def test_broken_files_are_named(tmp_path, name):
    (tmp_path / name).write_bytes(b"this is not a measurement")
    with pytest.raises(InputFault, match=rf"runs\[1\] \(r\): .*{name}: not readable"):
        campaign(tmp_path, f'file = "{name}"\n{columns()}')
