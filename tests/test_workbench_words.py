"""The workbench's server: what pages say in words of the page.  No browser."""


import pytest
from workbench_server import CSV

from workbench.folder import opened
from workbench.intake import view

pytest.importorskip("starlette", reason='the workbench needs starlette: pip install "rvwear[workbench]"')


# what the page is told ------------------------------------------------------------------------
@pytest.mark.parametrize(("said", "told"), [
    ("count them, and give --pins", "count them, and give 'pins in the ring'"),
    ("--ratio 3 with --pins 40: look at --lost-motion", "ratio 3 with 'pins in the ring' 40: look at 'lost motion of the catalogue'"),
    ("--known pin.radius=2: give a number with its unit, for instance --known pin.radius=3mm",
     "pin.radius = 2 in 'Every number of its file' below: give a number with its unit, for instance 3mm"),
    ("diameter 5 mm: must lie from 20 to 2000 mm", "'outer diameter of the housing' 5 mm: must lie from 20 to 2000 mm"),
    ("A and B. rvwear next proposes what would.", "A and B. 'Propose the next experiment' proposes what would."),
    ("correct it (rvwear extend), or see `rvwear compare`", "correct it ('Add it'), or see Look"),
    # Nothing on the page does these, and a line to type is one.
    ("rvwear hysteresis and bench give them without it", "rvwear hysteresis and bench give them without it"),
    ("completed anew by: rvwear reducer new --ratio 121 --pins 40", "completed anew by: rvwear reducer new --ratio 121 --pins 40"),
])  # fmt: skip
def test_what_commands_and_page_share_names_fields_and_buttons_on_the_page(said, told):
    """"give --pins" stood where nobody has typed a command."""
    from workbench.reducers import plainly

    assert plainly(said) == told


def test_the_remedy_of_a_scale_is_said_in_words_of_the_page():
    from discrepancy.campaign.model import Source
    from discrepancy.doubts.known_factors import known_factor
    from workbench.page_words import on_page

    factor = known_factor(3438.0, "arcmin", "rad", None)
    for header in ("y", "two words"):
        remedy = factor.remedy(Source("a.csv", f"column {header}", "arcmin", 2.9e-4), "rad")
        told = on_page(remedy)
        assert f"takes it out, typed under In as the scale of column {header}, or in each of its runs in campaign.toml: columns.value" in told
        assert "--" in remedy and "--" not in told and "rvwear" not in told


def test_a_file_that_is_no_measurement_says_what_to_do_without_options(tmp_path):
    """"give units by unit 'COLUMN=UNIT'" stood in its row, which has no such field."""
    folder = opened(tmp_path / "b")
    folder.new_file("notes.csv", b"time [s]\n1\n3\n5\n")
    folder.new_file("loop_20degC_1.csv", CSV.encode())
    (reason,) = view(folder)["unread"].values()
    assert "fits; write units into the heads of its columns" in reason and "lost motion" in reason and "COLUMN" not in reason


def test_signals_in_what_a_page_says_have_one_form():
    from discrepancy.page.amounts import with_titles

    said = "misfit: hysteresis[locked=input], along torque; wear_depth[hours=9,surface=inner_race] in errors.pin[2]=7um"
    assert with_titles(said) == "misfit: hysteresis (locked input), along torque; wear depth (hours 9, surface inner race) in errors.pin[2]=7um"


def test_numbers_in_what_a_page_says_have_a_minus_and_names_their_hyphen():
    """-22.95 um under Diagnose stood beside −22.95 in tables."""
    from discrepancy.page.amounts import with_minus

    assert with_minus("y = a + b x, a = -0.01 (-.02 to 1e-05), RV20E-121 at half-load") == "y = a + b x, a = −0.01 (−.02 to 1e−05), RV20E-121 at half-load"


def test_numbers_have_as_many_decimals_as_their_noise():
    from discrepancy.figures.figure_digits import decimals_of, text_of

    assert [decimals_of(noise) for noise in (22.0, 1.9, 0.0073, 0.0)] == [0, 1, 4, 4]
    assert text_of(-0.011412, decimals_of(0.0082)) == "−0.0114" and text_of(1440.951, 0) == "1,441"
    # Neither many digits nor many zeros, however far measurement and noise lie apart.
    told = [text_of(value, decimals_of(noise)) for value, noise in ((424.77270608, 1.9e-7), (4.18e-6, 1.9e-7), (57_276_516.0, 744_836.0), (2e-7, 744_836.0), (-0.004, 0.1))]
    assert told == ["424.773", "4.18·10⁻⁶", "5.728·10⁷", "0", "0.00"]
