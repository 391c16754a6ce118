"""What is wrong with an effect of one's own is said with file and line, before anything is compiled."""

import os
import subprocess
import sys
from pathlib import Path

import pytest

from cli.commands.effects import use_of
from cli.main import main
from discrepancy.catalogue.catalogue import entries
from discrepancy.catalogue.documentation import PAGE, own_part
from discrepancy.catalogue.ranges import range_of
from discrepancy.catalogue.signal_words import unknown, words
from fmu_src.effect import shape
from fmu_src.effect_check import UNITS, check_any_file, check_file, folder_findings
from fmu_src.source_hash import ROOT
from studies.effect_code import not_translated
from studies.effect_off import changes_when_off

HEAD = """import math
from fmu_src.effect import Effect, amplitude
from fmu_src.kernel import kernel
from fmu_src.variables import Variable
from rv_plant.gear_stage import planet_radius

EFFECT = Effect(
    0, "mine", "law", "source", "signature",
    (amplitude("my_size", "1", "size", 0.1, 0.0, 1.0),),
    states=(Variable("my_state", "state", "1", "state", 0.0, (2,), ("element",)),),
)


"""
# Lines of a kernel in ``HEAD`` count from here.
FIRST = HEAD.count("\n") + 1


def written(folder: Path, text: str, unit: str = "rv_plant", name: str = "mine") -> Path:
    file = folder / unit / f"{name}.py"
    file.parent.mkdir(exist_ok=True)
    file.write_text(text, encoding="utf-8")
    return file


def told(folder, text, **where) -> list[tuple[int, str]]:
    return [(f.line, f.text) for f in check_any_file(written(folder, text, **where))]


def hook(line: str, name: str = "before(r)") -> str:
    return f"{HEAD}@kernel\ndef {name}:\n    {line}\n"


GOOD = """@kernel
def share(r, gap, k):
    gap[k] += r.my_size * planet_radius(r.crank_circle_radius, 3.0)
    return gap


@kernel
def before(r):
    discs, cranks, rollers = r.roller_gap_now.shape
    for d in range(discs):
        for c in range(cranks):
            gap = r.roller_gap_now[d, c]
            for k in range(rollers):
                share(r, gap, k)
    r.ring_scale *= 1.0 + r.my_size * (r.reducer_temperature - 293.15)
    r.my_state[0] = r.my_state[1] + math.cos(r.ideal_output)
    last = len(r.my_state) - 1
    r.my_state[last] -= 1.0 if r.my_size > 0.0 else 0.0


@kernel
def hold(r):
    tangent, force = r.tangent, r.residual_vector
    tangent[0, 0] += r.my_size
    force[0] += r.my_size * r.z[0]
"""


def test_a_good_effect_and_all_of_the_catalogue_pass(tmp_path):
    assert told(tmp_path, HEAD + GOOD) == []
    for unit in UNITS:
        for file in sorted((ROOT / unit / "effects").glob("*.py")):
            assert file.stem == "__init__" or check_file(file, unit) == []


@pytest.mark.parametrize(("line", "message"), [
    ("r.ring_scale = 2.0", "before must not change r.ring_scale by =, because other effects act on it too: write *="),
    ("r.ring_scale += 2.0", "write *="),
    ("r.roller_gap_now[0, 0, 0] = 1e-6", "write +="),
    ("gap = r.roller_gap_now[0, 0]; gap[0] = 1e-6", "before must not change r.roller_gap_now by =, "),
    ("gap, _ = r.roller_gap_now; gap *= 2.0", "write +="),
    ("r.z[0] = 0.0", "before may not change r.z, a state (departures from ideal kinematics"),
    ("r.load_torque += 1.0", "before may not change r.load_torque, an input (torque on the carrier"),
    ("r.my_size = 1.0", "before may not change r.my_size, a parameter"),
    ("r.pin_x[0] += 1e-6", "(prepare may)"),
    ("r.friction_torque = 1.0", "before may not change r.friction_torque, a state"),
    ("x = r.ring_scale", "before reads r.ring_scale, a state (pin circle radius over that at the reference temperature), on which other"),
    ("r.my_state[0] = r.slider[0]", "which the effect stribeck_friction changes in the same stage"),
    ("r.ring_scale *= r.rign_scale", "the record has no field rign_scale; did you mean ring_scale?"),
    ("for d in range(r.discs): pass", "the record has no field discs; how many there are is the length of a field: r.roller_gap_now.shape[0]"),
    ("for d in range(r.rollers): pass", "the record has no field rollers; how many there are is the length of a field: r.roller_gap_now.shape[2]"),
    ("for d in range(r.pins): pass", "the record has no field pins; how many there are is the length of a field: r.pin_x.shape[0]"),
    ("for d in range(cranks): pass", "cranks is not defined; how many there are is the length of a field: r.roller_gap_now.shape[1]"),
    ("r.ring_scale *= sise", "sise is not defined"),
    ("r.ring_scale *= np.exp(1.0)", "np is not defined: kernels have no numpy; write import math at the head of the file and math.exp and the like, for kernels call"),
    ("r.ring_scale *= exp(1.0)", "exp is not defined: write import math at the head of the file, and math.exp here"),
    ("r.ring_scale *= math.coss(1.0)", "math has no coss; did you mean cos?"),
    ("r.ring_scale *= planet_radius(1.0)", "planet_radius takes 2 arguments (crank_circle_radius, first_stage_ratio), not 1"),
    ("x = [1.0, 2.0]", "a kernel has numbers, loops and fields of the record, not a list"),
    ("raise ValueError", "not raise"),
])  # fmt: skip
def test_a_kernel_that_errs_is_told_where(tmp_path, line, message):
    (found,) = told(tmp_path, hook(line))
    assert found[0] == FIRST + 2 and message in found[1]


def test_prepare_reads_no_input_that_may_change_in_a_run(tmp_path):
    """It would stay what it was at the start, in loops and FMUs alike; the temperature of the surroundings there may be read."""
    text = hook("r.compliance[r.z.shape[0] - 1] += r.my_size / (1.0 + abs(r.load_torque))", "prepare(r)")
    (found,) = told(tmp_path, text)
    assert found == (FIRST + 2, "prepare reads r.load_torque, an input (torque on the carrier, positive against positive rotation): it runs at the start alone, and what comes"
                     " in later in a run would go unseen; read it in warm, before, hold, after, advance or heat, which run at every step")  # fmt: skip
    assert told(tmp_path, text.replace("r.load_torque", "r.temperature")) == []


def test_math_that_nobody_imported_and_modules_that_kernels_lack_are_told_with_what_to_import(tmp_path):
    without = hook("r.ring_scale *= math.exp(1.0)").replace("import math\n", "")
    (found,) = told(tmp_path, without)
    assert found[1] == "math is not defined: write import math at the head of the file"
    for line, module in (("import numpy as np", "np.exp"), ("from numpy import exp", "exp")):
        (found,) = told(tmp_path, hook(f"r.ring_scale *= {module}(1.0)").replace("import math\n", f"import math\n{line}\n"))
        assert found[1] == f"{module} is no kernel, of numpy: kernels call kernels, the functions of math, and abs, min, max, int, float, bool and len"
    assert told(tmp_path, hook("r.ring_scale *= cos(0.0)").replace("import math\n", "import math\nfrom math import cos\n")) == []


def test_kernels_that_a_hook_calls_are_followed(tmp_path):
    text = hook("move(r.z, r)") + "\n\n@kernel\ndef move(where, record):\n    where[0] += 1.0\n    record.ring_scale *= radios\n"
    assert [(line, text[:32]) for line, text in told(tmp_path, text)] == [
        (FIRST + 7, "before may not change r.z, a sta"), (FIRST + 8, "radios is not defined"),
    ]  # fmt: skip


def test_what_a_hook_calls_must_be_a_kernel(tmp_path):
    assert told(tmp_path, hook("x = twice(r.my_size)") + "\n\ndef twice(x):\n    return 2.0 * x\n") == [
        (FIRST + 2, "twice is no kernel: write @kernel above it")
    ]


def test_kernels_that_are_imported_are_followed(tmp_path):
    text = hook("clear_flanks(r)").replace("rv_plant.gear_stage import planet_radius", "rv_plant.mesh import clear_flanks")
    found = check_any_file(written(tmp_path, text))
    assert found and all(f.file == ROOT / "rv_plant" / "mesh.py" and "before may not change" in f.text for f in found)


@pytest.mark.parametrize(("name", "line", "message"), [
    ("befor(r)", FIRST + 1, "befor is no hook and no hook calls it; did you mean before?"),
    ("quux(r)", FIRST + 1, "no hook calls it; hooks are start, prepare, warm, before"),
    ("before(r, time)", FIRST + 1, "the unit calls before(r), here it is before(r, time)"),
])  # fmt: skip
def test_a_wrong_hook_is_told(tmp_path, name, line, message):
    (found,) = told(tmp_path, hook("return", name))
    assert found[0] == line and message in found[1]


def test_a_hook_that_is_no_kernel_is_told(tmp_path):
    ((line, message),) = told(tmp_path, hook("return").replace("@kernel\n", "\n"))
    assert line == FIRST + 1 and "write @kernel above it" in message


def test_a_factor_must_be_returned(tmp_path):
    text = hook("if surface == 0:\n        return 1.0", "factor(r, surface, line_load, radius, speed, depth)")
    text += "\n\n@kernel\ndef prepare(r):\n    r.effects_on += 1\n"
    ((line, message),) = told(tmp_path, text, unit="wear_fmu")
    assert line == FIRST + 1 and "must return a factor" in message


def test_a_factor_that_would_not_be_called_is_told(tmp_path):
    text = hook("return 1.0 + r.my_size", "factor(r, surface, line_load, radius, speed, depth)")
    ((line, message),) = told(tmp_path, text, unit="wear_fmu")
    assert line == FIRST + 1 and "called only where prepare does r.effects_on += 1" in message


def test_the_example_of_the_documentation_passes(tmp_path):
    page = PAGE.read_text(encoding="utf-8")
    assert own_part() in page
    example = page.partition("```python\n")[2].partition("```")[0]
    assert "EFFECT" in example and told(tmp_path, example, name="soft_ring") == []


def test_every_word_of_signals_stands_on_the_page_and_no_other_is_taken():
    """The words were on no page, and a wrong one meant that no diagnosis ever looked for the effect."""
    text = own_part()
    assert all(f"| `{word}` |" in text for word in words())
    assert {s for e in entries() for s in e.effect.signals} <= words().keys()
    assert unknown(("hysteresis", "debris")) == []
    assert "did you mean hysteresis" in unknown(("histeresis",))[0]


@pytest.mark.parametrize(("given", "message"), [
    ('("input_torqe",)', "signals='input_torqe': no such quantity; did you mean input_torque; docs/effects.md has the words"),
    ('("input_torque")', 'signals=("input_torque"): is read letter by letter; write signals=("input_torque",), with a comma'),
])  # fmt: skip
def test_a_mistyped_signal_is_refused_where_it_stands_before_anything_is_compiled(tmp_path, capsys, given, message):
    """It came last, after the compiler, without a line, and a forgotten comma made a finding of every letter."""
    file = written(tmp_path, LAW.replace('("input_torque",)', given), name="lip")
    assert main(["effects", "--check", str(file)]) == 2
    line = 1 + next(n for n, text in enumerate(file.read_text(encoding="utf-8").splitlines()) if "signals=" in text)
    shown = capsys.readouterr()
    assert shown.out.strip() == f"{file}:{line}: {message}" and "translating" not in shown.err


@pytest.mark.parametrize(("old", "new", "line", "message"), [
    ('"my_size"', '"seal_torque"', 9, "the effect drag has a parameter seal_torque already"),
    ('"my_size"', '"pin_radius"', 9, "the unit has a parameter pin_radius already"),
    ('"my_state"', '"my_size"', 10, "the effect itself has a parameter my_size already"),
    ('"my_size"', '"direction"', 9, "the unit has direction already, an array that its kernels compute with; choose another name"),
    ("(2,), ", "(2,), minimum=None, axes=", 10, "variable my_state: minimum = None is no number; leave it out for the usual one"),
    ('"state", 0.0', '"state", "zero"', 10, "variable my_state: start = 'zero' is no number"),
    ('"my_size", "1"', '"my_size", "Nmm"', 9, "my_size: Nmm is no SI unit, and kernels get the number as it stands; declare the SI unit"),
    ('"my_size", "1"', '"my_size", "arcmin"', 9, "my_size: arcmin is no SI unit"),
    ('"my_size", "1"', '"my_size", "m/N.m"', 9, "my_size: m/N.m reads as m/N times m; write m/(N.m)"),
    ("0.0, 1.0)", "0.0, None)", 9, "variable my_size: maximum = None is no number"),
    ("EFFECT =", "EFECT =", 1, "no EFFECT"),
    ("EFFECT = Effect(", "EFFECT = print(", 7, "TypeError"),
    ("import math", "import maths", 1, "No module named 'maths'"),
    ("import planet_radius", "import planet_radios", 5, "cannot import name 'planet_radios'"),
    ("import math", "import math as", 1, "syntax error"),
])  # fmt: skip
def test_a_wrong_declaration_is_told(tmp_path, old, new, line, message):
    assert any(found[0] == line and message in found[1] for found in told(tmp_path, HEAD.replace(old, new, 1) + hook("return")[len(HEAD) :]))


def test_names_are_said_to_be_taken_where_parameters_are_explained():
    for page in (PAGE, PAGE.parent / "tutorials" / "your_effect.md"):
        text = page.read_text(encoding="utf-8")
        assert "must be free" in text and "`soft_ring_direction`" in text
    assert "the unit has direction already, an array that its kernels compute with; choose another name" in text


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


def in_its_own_process(folder: Path, program: str) -> subprocess.CompletedProcess:
    """Effects are taken when the units are imported."""
    return subprocess.run([sys.executable, "-c", program], capture_output=True, text=True, timeout=120,
                          env={**os.environ, "RVWEAR_EFFECTS": str(folder), "RVWEAR_PLAIN_PYTHON": "1", "XDG_CACHE_HOME": str(folder)})


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


LAW = """import math
from fmu_src.effect import Effect, amplitude, shape
from fmu_src.kernel import kernel

EFFECT = Effect(
    0, "lip", "T = a exp(-n/n0)", "own bench", "falls with speed",
    (amplitude("lip_torque", "N.m", "a", 0.1, 0.0, 5.0, sign=1), shape("lip_speed", "rad/s", "n0", 30.0, 12.0, 300.0, "assumed"),
     shape("lip_power", "1", "p", 1.0, 0.5, 2.0, "known", held=True)),
    signals=("input_torque",),
)


@kernel
def after(r):
    speed = abs(r.input_speed)
    r.friction_power += r.lip_torque * math.exp(-((speed / r.lip_speed) ** r.lip_power)) * speed
"""


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
