"""Numbers that were converted twice are doubted with the factor in words and the line of campaign.toml that takes it out."""

import json

import numpy as np
import pandas as pd
import pytest
from test_campaign_check import campaign, condition
from test_campaign_doubts import LOOP, RATED, loop_file

from cli.main import main
from discrepancy.campaign.load import load_campaign
from discrepancy.campaign.model import Source
from discrepancy.doubts.known_factors import known_factor
from discrepancy.doubts.plausible import scale_doubts

PER_RAD = 10800.0 / np.pi


@pytest.mark.parametrize(("times", "stated", "words"), [
    (3426.0, "arcmin", "3,438 = arcmin in a rad: converted twice?"), (3426.0, "deg", "3,438 = arcmin in a rad"), (3500.0, "arcsec", "3,600 = arcsec in a deg"),
    (210000.0, "arcsec", "206,265 = arcsec in a rad"), (57.0, "deg", "57.3 = deg in a rad"), (58.0, "arcmin", "60 = arcmin in a deg"),
    (1.0 / 57.0, "rad", "57.3 = deg in a rad"), (1000.0, "arcsec", "1,000 = a prefix"), (1.1e6, "rad", "1,000,000 = two prefixes"),
    (125.0, "arcmin", "121 = the ratio of the reducer"), (1.0 / 125.0, "arcmin", "121 = the ratio of the reducer"),
    (300.0, "arcmin", ""), (12.0, "arcmin", ""), (20000.0, "arcmin", ""),
])  # fmt: skip
def test_the_factor_is_named_that_leads_to_the_stated_unit(times, stated, words):
    found = known_factor(times, stated, "rad", 121.0)
    assert (found is not None) == bool(words) and (found is None or (found.words.startswith(words) and (found.size > 1.0) == (times > 1.0)))


def test_torques_have_no_angles_factors():
    assert known_factor(3438.0, "N.m", "N.m", 121.0) is None and known_factor(121.0, "N.m", "N.m", 121.0).words.startswith("121 = the ratio")
    assert known_factor(1000.0, "N.m", "N.m", None).remedy(Source("a.csv", "value", "N.m", 1.0), "N.m").endswith("divide the numbers by 1000 then")


def test_the_line_that_is_told_mends_the_campaign(tmp_path):
    campaign(tmp_path, {"a": condition()}, [loop_file(tmp_path, size=1.1 * PER_RAD)])
    (found,) = scale_doubts(load_campaign(tmp_path))
    line = found.remedy.partition("each of its runs in campaign.toml: ")[2]
    assert "in urad" not in found.remedy and line.startswith('columns.value = { column = "phi", unit = "arcmin", scale = 0.0002908')
    text = (tmp_path / "campaign.toml").read_text()
    (tmp_path / "campaign.toml").write_text("\n".join(line if old.startswith("columns.value") else old for old in text.splitlines()))
    mended = load_campaign(tmp_path)
    assert not scale_doubts(mended) and np.degrees(np.abs(mended.records[0].values).max()) * 60.0 == pytest.approx(1.1, rel=1e-4)


def test_campaign_from_tells_scales_and_single_samples(tmp_path, capsys):
    rng = np.random.default_rng(1)
    for k in (1, 2):
        twist = PER_RAD * (2.9 * LOOP / RATED + 0.01 * rng.standard_normal(len(LOOP)))
        twist[60] += 5.0 * PER_RAD * (k == 2)
        pd.DataFrame({"torque [Nm]": LOOP, "twist [arcmin]": twist}).to_csv(tmp_path / f"loop_{k}.csv", index=False)
    words = ["campaign", "from", str(tmp_path), "--reducer", "RV20E-121", "--tag", "locked=input", "--condition", "locked_at=mean", "--dry-run"]
    assert main([*words, "--json"]) == 0
    scale, sample = sorted(json.loads(capsys.readouterr().out)["findings"], key=lambda found: found["code"])
    assert scale["code"] == "implausible scale" and scale["remedy"].startswith("3,438 = arcmin in a rad: converted twice?") and "alike loop_2" in scale["text"]
    assert sample["code"] == "outlying samples" and "run loop_2" in sample["text"] and "(sample 61)" in sample["text"]
    assert main(words) == 0
    shown = " ".join(capsys.readouterr().out.split())
    assert "not sure run loop_2" in shown and "scale = 0.000290888" in shown
