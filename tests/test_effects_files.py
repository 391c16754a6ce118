"""Files of effects of one's own: where they lie, what the command says of them, what they do while they are off, and that they act."""

import os
import subprocess
import sys
from pathlib import Path

import pytest
from own_effects import FIRST, GOOD, HEAD, LAW, hook, in_its_own_process, told, written

from cli.commands.effects import use_of
from cli.main import main
from discrepancy.catalogue.ranges import range_of
from fmu_src.effect import shape
from fmu_src.effect_check import check_any_file, folder_findings
from studies.effect_code import not_translated
from studies.effect_off import changes_when_off


def test_what_editors_leave_beside_a_file_is_no_effect(tmp_path):
    file = written(tmp_path, hook("r.roller_gap_now[0, 0, 0] += r.my_size"))
    (file.parent / ".#mine.py").symlink_to("somebody@somewhere:1")
    (file.parent / "._mine.py").write_bytes(b"\0\5\x16\7")
    assert folder_findings(tmp_path) == [] == check_any_file(file)
    assert started(tmp_path).returncode == 0


def test_a_file_that_cannot_be_read_is_told(tmp_path):
    (written(tmp_path, GOOD).parent / "gone.py").symlink_to("nowhere.py")
    (found,) = folder_findings(tmp_path)
    assert found.file.name == "gone.py" and "cannot be read" in found.text
    assert check_any_file(found.file)[0].text == "there is no such file, or it cannot be read"


@pytest.mark.parametrize("name, text, said", [
    ("class", hook("pass"), "class.py:1: the file's name must be a Python name"),
    ("mine", f"import sys\nsys.exit()\n{hook('pass')}", "mine.py:2: SystemExit"),
])  # fmt: skip
def test_a_file_that_would_end_the_start_is_told(tmp_path, name, text, said):
    written(tmp_path, text, name=name)
    done = started(tmp_path)
    assert done.returncode == 2 and said in done.stderr and "Traceback" not in done.stderr


def test_a_link_lies_where_it_lies(tmp_path):
    (tmp_path / "rv_plant").mkdir()
    elsewhere = tmp_path / "elsewhere.txt"
    elsewhere.write_text(hook("r.roller_gap_now[0, 0, 0] += r.my_size"), encoding="utf-8")
    (tmp_path / "rv_plant" / "mine.py").symlink_to(elsewhere)
    assert check_any_file(tmp_path / "rv_plant" / "mine.py") == []


def started(folder: Path) -> subprocess.CompletedProcess[str]:
    """The list of ``rvwear effects`` with those of a folder, without the compiler: what is wrong with them is told before."""
    environment = os.environ | {"RVWEAR_EFFECTS": str(folder), "RVWEAR_PLAIN_PYTHON": "1"}
    return subprocess.run([sys.executable, "-m", "cli", "effects"], capture_output=True, text=True, env=environment)


def test_names_of_a_neighbour_are_told(tmp_path):
    written(tmp_path, HEAD + GOOD, name="neighbour")
    assert (9, "the effect neighbour has a parameter my_size already; choose another name") in told(tmp_path, HEAD + GOOD)


def test_wrong_places_are_told(tmp_path):
    assert "there is an effect drag already" in told(tmp_path, hook("return"), name="drag")[0][1]
    assert "must be a Python name" in told(tmp_path, hook("return"), name="my-effect")[0][1]
    (beside,) = check_any_file(written(tmp_path, hook("return"), unit="."))
    assert "put it into DIR/rv_plant/ or DIR/wear_fmu/" in beside.text
    found = folder_findings(tmp_path)
    assert [f.file.name for f in found] == ["mine.py"] and "no unit looks here" in found[0].text
    assert "there is none" in folder_findings(tmp_path / "missing")[0].text
    (tmp_path / "empty").mkdir()
    assert "neither rv_plant nor wear_fmu" in folder_findings(tmp_path / "empty")[0].text


def test_command_says_what_it_finds(tmp_path, capsys):
    good, bad = written(tmp_path, HEAD + GOOD), written(tmp_path, hook("r.z[0] = 0.0").replace("my_", "other_"), name="other")
    assert main(["effects", "--check", str(good)]) == 0
    assert main(["effects", "--check", str(good), str(bad)]) == 2
    assert f"{bad}:{FIRST + 2}: before may not change r.z" in capsys.readouterr().out
    # A folder is all that it holds.
    for folder in (tmp_path, good.parent):
        assert main(["effects", "--check", str(folder)]) == 2
        said = capsys.readouterr().out
        assert f"{bad}:{FIRST + 2}: before may not change r.z" in said and f"{good}: nothing wrong" in said
    (tmp_path / "none").mkdir()
    assert main(["effects", "--check", str(tmp_path / "none")]) == 2
    assert "no effect in this folder; effects lie in DIR/rv_plant/ or DIR/wear_fmu/" in capsys.readouterr().err


OFF = [
    ("rv_plant", HEAD + "@kernel\ndef prepare(r):\n    r.compliance[0] += 1e-9 + r.my_size\n", "prepare changes r.compliance by up to 1e-09"),
    ("rv_plant", HEAD + "@kernel\ndef before(r):\n    r.ring_scale *= 1.0 - 1e-9 / r.my_size\n", "before changes r.ring_scale"),
    ("wear_fmu", HEAD + "@kernel\ndef factor(r, surface, line_load, radius, speed, depth):\n    return 1.2 + r.my_size\n\n\n"
     "@kernel\ndef prepare(r):\n    if r.my_size != 0.0:\n        r.effects_on += 1\n", "factor returns 1.2, not 1.0"),
    ("wear_fmu", HEAD + "@kernel\ndef factor(r, surface, line_load, radius, speed, depth):\n    return 2.0 if line_load > 8e5 else 1.0 + r.my_size\n\n\n"
     "@kernel\ndef prepare(r):\n    if r.my_size != 0.0:\n        r.effects_on += 1\n", "factor returns 2, not 1.0 (surface 0, 1e+06 N/m"),
]  # fmt: skip


def test_a_file_outside_of_the_folders_of_units_is_told_where_it_goes_with_all_else_that_is_wrong(tmp_path, capsys):
    """It ended with a KeyError of the folder's name."""
    file = written(tmp_path, hook("r.lobe_torque_x[0] += r.my_size"), unit="elsewhere", name="dowel_slip")
    for json in ([], ["--json"]):
        assert main(["effects", "--check", str(file), *json]) == 2
        told = capsys.readouterr().out
        assert "put it into DIR/rv_plant/ or DIR/wear_fmu/" in told and str(file) in told and "lobe_torque_x" in told


def test_what_the_compiler_refuses_is_told_before_anything_is_built(tmp_path):
    file = written(tmp_path, HEAD + "@kernel\ndef before(r):\n    r.crank_turn_added += r.my_size\n")
    (found,) = not_translated(file)
    assert (found.file, found.line) == (file, FIRST + 2) and "crank_turn_added is an array" in found.text
    assert not not_translated(written(tmp_path, HEAD + "@kernel\ndef before(r):\n    r.crank_turn_added[0] += r.my_size\n"))


@pytest.mark.parametrize("bounds, said", [("0.1, 1.0, 0.0", "not below the highest"), ("0.1, 0.5, 1.0", "outside of its bounds")])
def test_bounds_that_cannot_be_are_told(tmp_path, bounds, said):
    found = check_any_file(written(tmp_path, HEAD.replace("0.1, 0.0, 1.0", bounds)))
    assert any(said in f.text and f.line == 9 for f in found)


@pytest.mark.parametrize(("unit", "text", "said"), OFF)
def test_an_effect_that_acts_while_it_is_off_is_told(tmp_path, unit, text, said):
    (found,) = changes_when_off(written(tmp_path, text, unit))
    assert found.line == text[: text.index("@kernel")].count("\n") + 1 and said in found.text


def test_nothing_of_the_catalogue_acts_while_it_is_off(tmp_path):
    # All at once: each hook is looked at by itself.  Those of output pins need another reducer.
    program = (
        "from studies.effect_off import UNITS, changes_of\n"
        "for unit, (effects, _) in UNITS.items():\n"
        "    for needs in (True, False):\n"
        "        names = [name for name, effect in effects.EFFECTS.items() if (effect.needs == 'output pins') is needs]\n"
        "        told = changes_of(unit, *names) if names else {}\n"
        "        [print(name, found) for name, found in told.items() if found]\n"
    )
    (tmp_path / "rv_plant").mkdir()
    done = in_its_own_process(tmp_path, program)
    assert done.returncode == 0 and done.stdout == "", done.stdout + done.stderr


def test_a_faulty_effect_ends_a_command_with_one_message(tmp_path):
    bad, worse = written(tmp_path, hook("r.z[0] = 0.0")), written(tmp_path, "import maths\n", name="worse")
    done = in_its_own_process(tmp_path, "from cli.main import main; raise SystemExit(main(['solve']))")
    assert done.returncode == 2 and "Traceback" not in done.stderr
    assert f"{bad}:{FIRST + 2}: before may not change r.z" in done.stderr and f"{worse}:1: " in done.stderr


def test_effects_act_whatever_their_files_are_called(tmp_path):
    """Three files add to the ring's compliance, before and after the catalogue's own in the order of names."""
    for name in ("a_ring", "ring_compliance", "uneven_ring"):
        text = hook("r.compliance[r.z.shape[0] - 1] += r.my_size", "prepare(r)").replace("my_", f"{name}_")
        written(tmp_path, text.replace("r.my_size", f"r.{name}_size"), name=name)
    program = (
        "import numpy as np; from reducers.reducer import load_reducer; from rv_plant import plant\n"
        "for values in ({'housing_compliance': 4e-7}, {'housing_compliance': 1e-7, 'a_ring_size': 1e-7, 'ring_compliance_size': 1e-7,"
        " 'uneven_ring_size': 1e-7}):\n"
        "    records = load_reducer('RV20E-121-rigid').plant.new_records().view(np.recarray)\n"
        "    for name, value in values.items(): records[name] = value\n"
        "    assert plant.initialise(records) == 0; print(records.transmission_error[0])\n"
    )
    done = in_its_own_process(tmp_path, program)
    assert done.returncode == 0, done.stderr
    first, second = map(float, done.stdout.split())
    assert first == pytest.approx(second, rel=1e-12)


def test_an_effect_of_ones_own_goes_into_the_fmus(tmp_path):
    """Compiled, packed in every flavour, and acting there as in process."""
    text = hook("r.compliance[r.z.shape[0] - 1] += r.my_size", "prepare(r)")
    written(tmp_path, text, name="my_ring")
    program = (
        "from pathlib import Path; import fmpy, sys; from fmu_src.link import NativeFault, compiler, host_platform\n"
        "from fmu_src.native import host_triple, object_codes; from fmu_src.package import build_fmu, build_native, triples_for, validate\n"
        "from orchestrator.component import InProcess; from reducers.reducer import load_reducer\n"
        "wanted = load_reducer('RV20E-121-rigid').specification('rv_plant'); folder = Path(sys.argv[1])\n"
        "codes = object_codes(wanted, triples_for(False)); paths = [build_fmu('RvPlant', wanted, 1e-3, 'test', folder, codes[host_triple()])]\n"
        "try:\n    compiler(host_platform(), False); paths += build_native('RvPlant', wanted, 1e-3, 'test', folder, codes=codes)\n"
        "except NativeFault:\n    pass\n"
        "plant = InProcess('plant', wanted); plant.set('my_size', 1e-6); plant.exit_initialisation(); plant.step(0.0, 1e-3)\n"
        "print(repr(plant.get('lag')))\n"
        "for path in paths:\n"
        "    validate(path)\n"
        "    seen = fmpy.simulate_fmu(str(path), stop_time=1e-3, step_size=1e-3, start_values={'effects.my_ring.size': 1e-6}, output=['output.lag'])\n"
        "    print(repr(float(seen['output.lag'][-1])))\n"
    )
    done = subprocess.run([sys.executable, "-c", program, str(tmp_path / "fmus")], capture_output=True, text=True, timeout=300,
                          env={**os.environ, "RVWEAR_EFFECTS": str(tmp_path), "XDG_CACHE_HOME": str(tmp_path)})
    assert done.returncode == 0, done.stderr
    in_process, *as_fmus = done.stdout.split()
    assert as_fmus and set(as_fmus) == {in_process}


def test_bounds_of_a_direction_are_told_alike_by_the_check_and_the_list():
    turn = shape("side", "rad", "where", 0.5, -3.15, 3.15, "assumed")
    assert use_of(turn).startswith("shape, fitted to any direction, first tried at ") and range_of(turn) == ("deg", "28.65", "any")
    # Neither a direction in a quarter nor the width of a pit may be any.
    part = shape("width", "rad", "how wide", 0.1, 0.005, 2.0, "assumed", held=True)
    assert range_of(part)[2] == "0.2865 to 114.6" and "any" not in use_of(shape("part", "rad", "where", 0.7, 0.0, 1.571, "assumed"))


def test_check_says_of_every_parameter_its_units_and_what_a_diagnosis_does_with_it(tmp_path, capsys):
    law = LAW.replace('"known", held=True)', '"known", held=True),\n     shape("lip_onset", "K", "T0", 303.15, 273.15, 353.15, "assumed")')
    law = law.replace('("input_torque",)', '("input_torque", "no_load_torque", "efficiency")')
    assert main(["effects", "--check", str(written(tmp_path, law, name="lip"))]) == 0
    assert capsys.readouterr().out.splitlines()[1:] == [
        "  lip_torque: in N.m, here and in answers; amplitude, fitted within 0 to 5 N.m",
        # A third of the start lies below the bounds.
        "  lip_speed: in rad/s here, for kernels, in rpm in answers at its usual size (1 rad/s is 9.5493 rpm);"
        " shape, fitted within 12 to 300 rad/s, first tried at 30, 90",
        "  lip_power: a number without a unit; shape, held at 1, not fitted: held=True",
        "  lip_onset: in K here, for kernels, in degC in answers at its usual size (0 degC is 273.15 K);"
        " shape, fitted within 273.15 to 353.15 K, first tried at 303.15",
    ]
