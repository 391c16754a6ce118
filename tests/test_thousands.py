"""1,234: a thousand where other cells can be no number otherwise, or where the columns look like that; asked where nothing tells."""

import pytest

from cli.main import main
from discrepancy.campaign.guess.propose import propose
from discrepancy.campaign.guess.wishes import Wishes
from discrepancy.campaign.guess.write import checked
from discrepancy.campaign.readers.csv import sniff_decimal
from discrepancy.campaign.readers.figures import contradictions

# Torques in N mm and turnings in arcsec, as in a loop up to the rated torque.
UP = [0, 42820, 85640, 128460, 167000]
TORQUES = [*UP, *UP[-2::-1], *(-t for t in UP[1:]), *(-t for t in UP[-2::-1])]


def lines(first, sign, point, delimiter=";"):
    """Thousands set apart by ``sign``, fractions by ``point``; ``first`` turning at no torque."""
    rows = [f'{delimiter.join((f"{t:,}".replace(",", sign), f"{first + t / 3000:.3f}".replace(".", point)))}\n' for t in TORQUES]
    return f"torque [Nmm]{delimiter}twist [arcsec]\n" + "".join(rows)


@pytest.mark.parametrize("sign, point", [(",", "."), (".", ",")])
@pytest.mark.parametrize("first, sure", [(0.346, True), (90.346, False)])
def test_the_reading_that_contradicts_no_cell(tmp_path, sign, point, first, sure):
    """A 0.346 can be no thousand; without it whole numbers beside groups of three tell, which is said."""
    (tmp_path / "loop_1.csv").write_text(lines(first, sign, point))
    proposal = propose([tmp_path], Wishes("RV20E-121"))
    record = checked(proposal).records[0]
    assert record.axes["torque"].max() == pytest.approx(167.0)
    assert record.values.max() == pytest.approx((first + 167 / 3) * 4.8481368e-6, rel=1e-4)
    assert any("taken for thousands" in doubt.text for doubt in proposal.doubts) != sure


def test_where_nothing_tells_the_next_line_is_not_carefree(tmp_path, capsys):
    rows = "".join(f"{t:,};{90 + t / 3000:.3f}\n" for t in TORQUES if t)
    (tmp_path / "loop_1.csv").write_text(f"torque [Nmm];twist [arcsec]\n{rows}")
    assert main(["campaign", "from", str(tmp_path), "--reducer", "RV20E-121", "--tag", "locked=input"]) == 0
    said = " ".join(capsys.readouterr().out.split())
    assert "nothing in the file tells which; look at the ranges; if they are fractions: decimal = " in said and f"look at what is not sure, then: rvwear campaign check {tmp_path} rvwear compare" in said


@pytest.mark.parametrize("fields, decimal", [
    (["0", "0.346", "4,282", "6.463"], "."), (["0", "0,346", "4.282", "6,463"], ","), (["1,5", "2.346"], ","), (["4,282", "6.463"], ","), (["1,5", "12.03"], ","),
])  # fmt: skip
def test_decimal_signs(fields, decimal):
    assert sniff_decimal([";".join(fields)], ";") == decimal


@pytest.mark.parametrize("cell, wrong", [("0.346", True), ("6.46", True), (".346", True), ("1234.567", True), ("6.463", False), ("-12.346", False), ("6", False), ("1.346e2", True), ("ok", False)])
def test_what_can_be_no_thousand(cell, wrong):
    assert bool(contradictions([cell], ",")) == wrong
