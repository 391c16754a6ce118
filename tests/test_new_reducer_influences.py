"""What a completed reducer's page draws, and which of its numbers matter."""

import json
import re
import shlex

import numpy as np
import pytest

from cli.main import main
from fmu_src.faults import InputFault
from pages.render import rendered_sections
from reducers.completion.complete import complete
from reducers.completion.file import reducer_at
from reducers.completion.given import Given
from reducers.reducer import load_reducer
from studies.completed_ranges import Influence, influences, what_matters
from studies.report.assembly import contact_points, outline, pin_forces, pin_places
from studies.report.completed import page_of

RIG = ["reducer", "new", "--ratio", "81", "--pins", "40", "--rated", "1600"]


@pytest.fixture(scope="module")
def rig():
    return complete(Given(81, 40, 1600.0))


def test_the_drawing_is_to_scale_and_every_pin_touches_both_discs(rig):
    reducer = reducer_at(rig, {})
    radius = 1e3 * reducer.starts["pin_radius"]
    for d in range(2):
        drawn, pins = outline(reducer, d), pin_places(reducer)
        nearest = np.abs(pins[:, None] - drawn[None, :]).min(axis=1)
        # An unmodified disc touches all pins; the drawn points lie some tenths of a millimetre apart.
        assert nearest == pytest.approx(radius, abs=0.02)
        points, normals = contact_points(reducer, d)
        assert np.abs(points - pins) == pytest.approx(radius) and np.abs(normals) == pytest.approx(1.0)
        assert np.abs(points[:, None] - drawn[None, :]).min(axis=1).max() < 0.51 * np.abs(np.diff(drawn)).max()
    # Together the forces carry the torque about the ring's centre.
    force = pin_forces(reducer)
    moments = [float(np.sum(force[d] * np.imag(np.conj(contact_points(reducer, d)[0]) * contact_points(reducer, d)[1]))) for d in range(2)]
    assert abs(sum(moments)) * 1e-3 == pytest.approx(1600.0, rel=0.03)


def test_page_shows_parts_numbers_and_influences(rig):
    found = [Influence("K1", "lost_motion_arcmin", 0.5, 1.0, 1.3), Influence("gap", "lost_motion_arcmin", 1.0, 1.0, 1.001)]
    page = page_of(rig, reducer_at(rig, {}), found)
    html = rendered_sections(page)
    assert "completed reducer" in html and "eccentricity times pins" in html
    (table,) = page.sections[1].tables
    assert [row[0] for row in table.rows] == ["lost motion"] and table.rows[0][-1] == "40"
    assert len(page_of(rig, reducer_at(rig, {}), []).sections) == 2


def test_ranges_move_the_signals_that_they_must():
    found = {(one.dial, one.signal): one for one in influences(complete(Given(121, 40, 167.0)), ("gap", "wear.mesh_coefficient"))}
    lost, stiffness = "lost_motion_arcmin", "torsional_stiffness_Nm_per_arcmin"
    gap = found["gap", lost]
    # From no gap to half an arcmin on either flank.
    assert gap.high - gap.low == pytest.approx(1.0, abs=0.1)
    wear = found["wear.mesh_coefficient", "disc_flank_um"]
    # A flank wears with its coefficient, and less the more it has spread the load by then.
    assert 2.0 < wear.high / wear.middle < 5.0 and 2.0 < wear.middle / wear.low <= 5.0
    assert found["wear.mesh_coefficient", stiffness].share == 0.0 and found["wear.mesh_coefficient", lost].share == 0.0
    # Losses and frequencies are signals of a bench, too: neither hangs on what wears, both are there.
    for signal in ("efficiency_percent", "no_load_torque_Nm", "natural_frequency_1_Hz", "natural_frequency_2_Hz"):
        assert found["gap", signal].middle > 0.0 and found["wear.mesh_coefficient", signal].share == 0.0
    strongest = what_matters(list(found.values()))
    assert strongest[lost][0].dial == "gap" and strongest["disc_flank_um"][0].dial == "wear.mesh_coefficient"


def test_seals_move_the_torque_without_load_and_masses_the_frequencies():
    found = {(one.dial, one.signal): one for one in influences(complete(Given(121, 40, 167.0)), ("seal_share", "carrier_bulk"))}
    seals, mass = found["seal_share", "no_load_torque_Nm"], found["carrier_bulk", "natural_frequency_1_Hz"]
    assert seals.low < seals.middle < seals.high and mass.high < mass.low
    assert found["seal_share", "efficiency_percent"].high < found["seal_share", "efficiency_percent"].low
    assert found["carrier_bulk", "efficiency_percent"].share < 1e-6


def test_the_command_draws_and_tells_what_matters(tmp_path, capsys, monkeypatch):
    one = Influence("K1", "lost_motion_arcmin", 0.5, 1.0, 1.3)
    monkeypatch.setattr("studies.completed_ranges.influences", lambda completion, advance: advance() or [one])
    page, words = tmp_path / "rig.html", [*RIG, "--output", str(tmp_path / "rig.toml"), "--overwrite", "--sensitivity"]
    assert main([*words, "--html", str(page), "--json"]) == 0
    (told,) = json.loads(capsys.readouterr().out)["sensitivity"]
    assert told["dial"] == "K1" and told["share"] == pytest.approx(0.4)
    assert "The parts to scale" in page.read_text(encoding="utf-8")
    assert main(words) == 0
    assert "eccentricity times pins over pin circle" in capsys.readouterr().out
    assert main([*RIG, "--output", str(tmp_path / "other.toml"), "--html", str(tmp_path / "rig.pdf")]) == 2
    assert "must end in .html" in capsys.readouterr().err and not (tmp_path / "other.toml").exists()


def test_a_number_that_moves_only_with_others_says_what_moves_it(tmp_path, capsys):
    """In the file, and where somebody changed it alone; the command that is named does it, and what was given before stays."""
    path = tmp_path / "my81.toml"
    assert main(["reducer", "new", "--ratio", "81", "--pins", "40", "--rated", "412", "--cranks", "3", "--known", "pin.radius=4mm",
                 "--name", "my81", "--output", str(path), "-q"]) == 0  # fmt: skip
    text = path.read_text(encoding="utf-8")
    assert "# may be 10, 11, 12, 13, 14, 15, 16, 17, 18, 19 or 20, but not alone, for teeth are whole: complete again with --known first_stage.sun_teeth=11" in text
    assert "not alone, for races and rollers fit each other: complete again with --known roller.radius=...mm" in text
    path.write_text(text.replace("sun_teeth = { value = 10.0", "sun_teeth = { value = 12.0"), encoding="utf-8")
    assert main(["reducer", "check", str(path)]) == 2
    said = capsys.readouterr().err
    assert "[first_stage] sun_teeth = 12: the file's range is another single value" in said and "12 1" not in said
    words = shlex.split(re.search("complete again: (rvwear .*?); or leave", said)[1])
    assert words[1:11] == ["reducer", "new", "--ratio", "81", "--pins", "40", "--rated", "412", "--speed", "15"]
    assert "first_stage.sun_teeth=12" in words and "pin.radius=4mm" in words
    assert main([*words[1:], "--output", str(tmp_path / "anew.toml"), "-q"]) == 0
    assert load_reducer(tmp_path / "anew.toml").starts["sun_teeth"] == 12.0


def test_a_range_of_a_number_without_unit_is_told_without_one(tmp_path):
    path = tmp_path / "a.toml"
    assert main([*RIG, "--output", str(path), "-q"]) == 0
    text = path.read_text(encoding="utf-8")
    path.write_text(text.replace("poisson_ratio = { value = 0.3,", "poisson_ratio = { value = 0.4,"), encoding="utf-8")
    with pytest.raises(InputFault, match=r"value = 0\.4 lies outside; give \[lowest, highest\]$"):
        load_reducer(path)
