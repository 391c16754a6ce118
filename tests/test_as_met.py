"""Numbers and units as a person meets them: digits of exported numbers, one name of a unit, one sign of a micrometre."""

import json

import numpy as np
import pytest

from cli.main import main
from exports.decimal_digits import decimal
from exports.tables import Column, Table
from exports.write import write_tables
from fmu_src.units import conversion
from pages import content
from pages.content import Card, Page, Section
from pages.look import Figure, axis, layout
from pages.render import rendered_sections
from pages.words import in_print, units_in_print
from reducers.checking import check
from reducers.completion.known import known_numbers
from reducers.reducer import load_reducer


def test_a_converted_number_is_written_as_somebody_wrote_it_and_all_others_with_every_digit(tmp_path):
    """1450.0000000000002 rpm and 210.00000000000003 deg stood there."""
    there, back = conversion("rpm", "rad/s")[0], conversion("rad/s", "rpm")[0]
    speeds = np.array([back * (there * rpm) for rpm in (1450.0, 900.0, 16.55)] + [1.0 / 3.0, 2.0 ** 0.5, np.nan, np.inf, 0.0, -1e-300])
    assert repr(float(speeds[0])) == "1450.0000000000002"
    write_tables([Table("curve", (Column("speed", "rpm", speeds), Column("name", "", list("abcdefghi")), Column("count", "", range(9))))], tmp_path / "a.csv")
    lines = (tmp_path / "a.csv").read_text(encoding="utf-8").splitlines()
    assert lines[1:4] == ["1450.0,a,0", "900.0,b,1", "16.55,c,2"] and lines[4].startswith("0.3333333333333333,") and lines[6] == ",f,5"
    read = np.array([float(line.split(",")[0] or "nan") for line in lines[1:]])
    assert np.array_equal(read[3:], speeds[3:], equal_nan=True) and np.allclose(read[:3], speeds[:3], rtol=1e-14, atol=0.0)


def test_what_differs_by_more_than_a_conversion_does_stays():
    values = np.array([1.0 + 1e-13, 0.1 + 0.2, 1234567.8901234])
    assert decimal(values).tolist() == [1.0 + 1e-13, 0.3, 1234567.8901234] and decimal([1, 2]) == [1, 2]


def test_a_completed_file_and_its_check_call_an_hour_the_same(tmp_path, capsys):
    """``hour`` stood in one and ``h`` in the other."""
    path = tmp_path / "a.toml"
    assert main(["reducer", "new", "--ratio", "121", "--rated", "167", "--pins", "40", "--output", str(path), "-q", "--json"]) == 0
    made = {n["name"]: n["unit"] for n in json.loads(capsys.readouterr().out)["numbers"]}
    checked = {n.name: n.unit for n in check(load_reducer(path)).numbers}
    assert made["wear.run_in_time"] == checked["wear.run_in_time"] == "h" and 'run_in_time = { value = 300.0, unit = "h"' in path.read_text(encoding="utf-8")
    # Files of former versions have it written out.
    old = path.read_text(encoding="utf-8").replace('value = 300.0, unit = "h"', 'value = 300.0, unit = "hour"')
    (tmp_path / "b.toml").write_text(old, encoding="utf-8")
    assert load_reducer(tmp_path / "b.toml").starts["run_in_time"] == load_reducer(path).starts["run_in_time"] == 300 * 3600.0


def test_pages_have_the_sign_of_a_micrometre_wherever_a_command_writes_um():
    """``um`` stood in the Reducer view and ``µm`` in all others."""
    assert units_in_print("1.5 to 5 um, 9 um/kN (N/(mm um)); 60um of a_um.um um.csv [um]") == "1.5 to 5 µm, 9 µm/kN (N/(mm µm)); 60um of a_um.um um.csv [µm]"
    assert in_print({"unit": "um", "rows": [["um", 3]]}) == {"unit": "µm", "rows": [["µm", 3]]}
    figure = Figure("f", "of 5 um", "caption", [{"type": "scatter", "name": "5 um oval", "x": [1], "y": [2]}], layout(yaxis=axis("depth [um]")))
    page = rendered_sections(Page("kind", "t", "c", "5 um off", [Card("a", "3", unit="um")], [Section("s", "S", "l um", [figure], [content.Table("", ["a"], [["um"]])])], ["9 um"]))
    body = page.partition("</style>")[2].replace(page[page.index('id="plotly"'):page.index("</script>", page.index('id="plotly"'))], "")
    assert " um" not in body and "[um]" not in body and body.count("µm") >= 7


@pytest.mark.parametrize("text", ["bearing.clearance=3µm", "crank.support_compliance=8µm/kN"])
def test_what_a_page_shows_may_be_typed(text):
    assert known_numbers([text])
