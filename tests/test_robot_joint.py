"""The example of a robot joint, in a short form: wear of the reducer shows at the flange, not at the motor."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "examples" / "robot_joint"))
import robot_joint

MOVE, PAUSE = 0.2, 0.15
REVERSAL, LARGEST = "between rest on either side [arcsec]", "largest error [arcsec]"


@pytest.fixture(scope="module")
def runs(rv20e, tmp_path_factory):
    """Moves of a new joint, and of one whose raceways lack 4 um all round."""
    fmus = robot_joint.build_fmus(tmp_path_factory.mktemp("joint"))
    found = []
    for depth in (0.0, 4e-6):
        joint = robot_joint.make_joint(rv20e, {"inner_race_wear": depth})
        system = robot_joint.make_system(fmus, joint)
        for name, value in {"reach": 0.05, "move_time": MOVE, "pause": PAUSE}.items():
            system[f"controller.{name}"] = value
        found.append((robot_joint.move(system, 4.0 * (MOVE + PAUSE)), joint.get("lost_motion") * robot_joint.ARCSEC))
        system.close()
    return found


def test_the_joint_follows_its_target(runs):
    for run, _ in runs:
        assert abs(run["motor error"]).max() * robot_joint.ARCSEC < 150.0
        assert abs(run["target"]).max() == pytest.approx(0.05)
        assert abs(run["flange error"][-1]) * robot_joint.ARCSEC < 100.0


def test_wear_shows_where_the_load_changes_sides(runs):
    (new, new_lost_motion), (worn, worn_lost_motion) = runs
    new, worn = (robot_joint.figures(run, MOVE, PAUSE) for run in (new, worn))
    assert worn_lost_motion > new_lost_motion + 40.0
    assert worn[REVERSAL] > new[REVERSAL] + 20.0
    assert worn[LARGEST] > new[LARGEST]


def test_the_page_shows_both(runs, tmp_path):
    page = robot_joint.draw({"new": runs[0][0], "worn": runs[1][0]}, tmp_path / "joint.html")
    text = page.read_text(encoding="utf-8")
    assert "worn" in text and "current [A]" in text
