"""A guess that is right is stated on the command line, too, and is not asked again."""

import shlex

import numpy as np
import pytest

from cli.main import main


def written(folder, name, head, columns):
    rows = "\n".join(",".join(f"{number:.9g}" for number in row) for row in np.transpose(columns))
    (folder / name).write_text(f"{head}\n{rows}\n", encoding="utf-8")


def bench(folder):
    """Loops and transmission errors of which nothing says the side that was locked, the shaft of the speeds, or whose the angle is."""
    torque = 160.0 * np.sin(np.linspace(0.0, 4.0 * np.pi, 200))
    written(folder, "hysteresis_locked_90deg_1.txt", "torque (Nm),twist (arcmin)", [torque, torque / 45.0])
    angle = np.linspace(0.0, 359.0, 1800)
    for speed in (900, 1450):
        error = 3.0 * np.sin(np.radians(40.0 * angle)) + 0.1 * np.sin(np.radians(angle))
        written(folder, f"te_100Nm_{speed}rpm_1.txt", "output angle (deg),transmission error (arcsec)", [angle, error])
    return folder


def unsure(told):
    return [line for line in told.splitlines() if line.startswith("not sure")]


def test_the_printed_line_states_all_guesses_and_they_are_silent(tmp_path, capsys):
    """"not sure" stood there with the option for what was wrong alone: who took the guess for right was asked at every call."""
    folder = bench(tmp_path)
    assert main(["campaign", "from", str(folder), "--reducer", "RV20E-121"]) == 0
    told = capsys.readouterr().out
    plain = " ".join(told.split())
    assert "locked = input is assumed; --tag locked=input if so; " in plain
    assert "are taken for the input_speed: each is faster than outputs turn; --condition input_speed=named if so; " in plain
    assert "whose the angle is; --angle-of output if so; --angle-of input if it is the input's over the ratio" in plain
    assert "this line states what was guessed, and where the input was locked, so that it is not asked again; leave out what is wrong" in plain
    line = next(line for line in told.splitlines() if line.startswith("  rvwear campaign from"))
    assert main(shlex.split(line)[1:]) == 0
    again = capsys.readouterr().out
    assert not unsure(again) and "this line states" not in again and "input_speed 900 rpm" in again


def test_the_speeds_may_be_said_to_be_of_the_other_shaft(tmp_path, capsys):
    folder = bench(tmp_path)
    assert main(["campaign", "from", str(folder), "--reducer", "RV20E-121", "--condition", "output_speed=named", "--dry-run"]) == 0
    told = capsys.readouterr().out
    assert "output_speed 900 rpm" in told and "are taken for the input_speed" not in " ".join(told.split())
    # Of one condition it is a number.
    assert main(["campaign", "from", str(folder), "--reducer", "RV20E-121", "--condition", "900rpm_100N.m:input_speed=named", "--dry-run"]) == 2


@pytest.mark.parametrize(("head", "option"), [("torque (Nm),twist", "--unit 'twist=arcmin' if so"), ("torque,twist (arcmin)", "--unit torque=N.m if so")])
def test_a_unit_that_was_guessed_is_stated(tmp_path, capsys, head, option):
    torque = 160.0 * np.sin(np.linspace(0.0, 4.0 * np.pi, 200))
    written(tmp_path, "hysteresis_input_locked_at_90deg.txt", head, [torque, torque / 45.0])
    command = ["campaign", "from", str(tmp_path), "--reducer", "RV20E-121", "--overwrite"]
    assert main(command) == 0
    told = capsys.readouterr().out
    assert option.replace("'", "") in " ".join(told.split()).replace("'", "")
    line = next(line for line in told.splitlines() if line.startswith("  rvwear campaign from"))
    assert main(shlex.split(line)[1:]) == 0
    assert not unsure(capsys.readouterr().out)
