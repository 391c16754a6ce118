"""What is wrong with an effect of one's own is said with file and line, before anything is compiled."""


import pytest
from own_effects import FIRST, GOOD, HEAD, LAW, hook, told, written

from cli.main import main
from discrepancy.catalogue.catalogue import entries
from discrepancy.catalogue.documentation import PAGE, own_part
from discrepancy.catalogue.signal_words import unknown, words
from fmu_src.effect_check import UNITS, check_any_file, check_file
from fmu_src.source_hash import ROOT


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
