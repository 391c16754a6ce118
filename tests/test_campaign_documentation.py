"""docs/campaigns.md: its tables follow the code, its examples load."""

import re

from discrepancy.campaign.check import check_campaign
from discrepancy.campaign.documentation import PAGE, page
from discrepancy.campaign.load import load_campaign

BLOCK = re.compile(r"```(?:toml|csv)\n# (\S+)\n(.*?)```", re.DOTALL)


def examples() -> list[dict[str, str]]:
    """The page's campaigns, each as its files; a campaign.toml begins a new one."""
    found: list[dict[str, str]] = []
    for name, text in BLOCK.findall(PAGE.read_text(encoding="utf-8")):
        if name == "campaign.toml":
            found.append({})
        found[-1][name] = text
    return found


def write(folder, example: int) -> None:
    for name, text in examples()[example].items():
        (folder / name).write_text(text, encoding="utf-8")


def test_tables_are_up_to_date():
    """If this fails: python -m discrepancy.campaign.documentation."""
    assert PAGE.read_text(encoding="utf-8") == page()


def test_first_example(tmp_path):
    write(tmp_path, 0)
    campaign = load_campaign(tmp_path)
    assert [record.name for record in campaign.held_out] == ["te_half"]
    assert campaign.rows["te_rated_2"].dropped == 1
    assert len(campaign.of("input_torque")[0].axes["speed"]) == 3
    assert not check_campaign(campaign).problems


def test_second_example_needs_no_file(tmp_path):
    write(tmp_path, 1)
    campaign = load_campaign(tmp_path)
    assert len(campaign.of("lost_motion")[0].values) == 3
    assert {record.tags["surface"] for record in campaign.of("wear_depth")} == {"inner_race", "outer_race"}
    assert not check_campaign(campaign).problems
