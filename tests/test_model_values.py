"""Values in a model file: with a unit as one text, or as a table."""

import pytest

from discrepancy.model_file import load_model
from fmu_src.faults import InputFault

HEAD = '[model]\nname = "m"\nreducer = "RV20E-121"\n'


def loaded(tmp_path, text):
    path = tmp_path / "m.toml"
    path.write_text(HEAD + text, encoding="utf-8")
    return load_model(path)


@pytest.mark.parametrize("entry", ['"0.07 N.m"', '"70mNm"', '{ value = 0.07, unit = "N.m" }', "{ value = 0.07 }"])
def test_an_effects_value_is_a_text_or_a_table(tmp_path, entry):
    assert loaded(tmp_path, f"[effects.drag]\nseal_torque = {entry}\n").values() == pytest.approx({"seal_torque": 0.07})


@pytest.mark.parametrize(("entry", "said"), [
    ('"0.07"', "effects.drag.seal_torque = '0.07' is not a number with a unit"), ('"0.07 mm"', "unit 'mm' does not fit"), ("0.07", 'write "0.07 N.m"'),
    ('"0,07 N.m"', "'0,07 N.m' has a comma in its number; write 0.07 N.m"), ('"-3 N.m"', "seal_torque"),
])  # fmt: skip
def test_what_is_no_amount_is_refused_with_its_place(tmp_path, entry, said):
    with pytest.raises(InputFault, match=r"m.toml: effects.drag") as fault:
        loaded(tmp_path, f"[effects.drag]\nseal_torque = {entry}\n")
    assert said in str(fault.value)
