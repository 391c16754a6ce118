"""Numbers that a bench measured beside those that it set, and conditions that become one by what is stated of them."""

import pytest

from cli.main import main
from discrepancy.campaign.check import check_campaign
from discrepancy.campaign.guess.propose import propose
from discrepancy.campaign.guess.wishes import Wishes
from discrepancy.campaign.guess.write import checked
from fmu_src.faults import InputFault
from workbench.folder import opened
from workbench.intake import view


def error_file(folder, name, *above):
    # No copy of another file.
    rows = "".join(f"{0.5 * k:g};{(k * k) % 7 + (k * len(list(folder.iterdir()))) % 11 / 10:g}\n" for k in range(721))
    (folder / name).write_text("\n".join([*above, "", "angle [deg];te [arcsec]", ""]) + rows, encoding="utf-8")


def proposed(folder, heads, **wishes):
    for name, above in heads.items():
        error_file(folder, name, *above)
    return propose([folder], Wishes("RV20E-121", **wishes))


def actual(proposal):
    return {run.name: dict(run.guessed.actual) for run in proposal.runs}


def test_temperatures_of_repetitions_that_hardly_differ_are_one(tmp_path):
    """25.1 and 25.2 degC made two conditions, in each of which a run stood alone as "repetition 2"."""
    heads = {f"te_{load}Nm_15rpm_{k}.csv": [f"Öltemperatur;25,{k} °C"] for load in (50, 167) for k in (1, 2)}
    proposal = proposed(tmp_path, heads)
    assert {name: stated["temperature"] for name, stated in proposal.conditions.items()} == {"50N.m": "25 degC", "167N.m": "25 degC"}
    assert actual(proposal)["te_50Nm_15rpm_2"] == {"temperature": "25.2 degC"}
    assert [d.place for d in proposal.doubts if "25.1 to 25.2 degC above the tables is taken for 25 degC" in d.text and "(assumed)" in d.text] == ["te_167Nm_15rpm_1.csv and 3 more"]
    assert "one number that was measured" in proposal.runs[0].guessed.factors["temperature"].reason
    campaign = checked(proposal)
    assert sorted(round(record.factors["temperature"], 2) for record in campaign.records) == [298.25, 298.25, 298.35, 298.35]
    assert not {"noise guessed", "noise unknown"} & {finding.code for finding in check_campaign(campaign).findings}


def test_speeds_and_loads_as_measured_are_one(tmp_path):
    heads = {f"te_{k}.csv": [f"Drehzahl: {speed} 1/min", f"Drehmoment: {load} Nm"] for k, (speed, load) in enumerate([(499.7, 166.8), (500.2, 167.1)], 1)}
    proposal = proposed(tmp_path, heads)
    assert list(proposal.conditions.values()) == [{"input_speed": "500 rpm", "load_torque": "167 N.m"}]
    assert actual(proposal) == {"te_1": {"input_speed": "499.7 rpm", "load_torque": "166.8 N.m"}, "te_2": {"input_speed": "500.2 rpm", "load_torque": "167.1 N.m"}}
    assert len([d for d in proposal.doubts if "500 rpm is taken for the input_speed" in d.text]) == 1


def test_a_line_above_the_table_says_whose_speed_the_name_has(tmp_path):
    """It was doubted by its size, beside the line that says it."""
    proposal = proposed(tmp_path, {"te_50Nm_15rpm.csv": ["Rotação de saída: 15 rot/min"], "te_50Nm_900rpm.csv": ["Rotação de entrada: 900 rot/min"]})
    assert {"output_speed": "15 rpm", "load_torque": "50 N.m"} in proposal.conditions.values()
    assert not any("is taken for" in d.text for d in proposal.doubts)
    # The other shaft's is no word for it.
    proposal = proposed(tmp_path, {"te_50Nm_900rpm.csv": ["Rotação de saída: 7.4 rot/min"]})
    assert any("900 rpm is taken for the input_speed" in d.text for d in proposal.doubts)


def test_speeds_that_are_taken_for_one_shafts_are_told_once(tmp_path):
    """A note for each speed said the same."""
    proposal = proposed(tmp_path, {f"te_{load}Nm_{speed}rpm.csv": [] for load in (42, 167) for speed in (1500, 600, 15)})
    (doubt,) = [d for d in proposal.doubts if "for the input_speed" in d.text]
    assert doubt.text == "600 and 1500 rpm are taken for the input_speed: each is faster than outputs turn"
    assert doubt.place == "te_167Nm_1500rpm.csv and 3 more" and "{output_speed}" in doubt.remedy
    assert [d.text for d in proposal.doubts if "output_speed:" in d.text] == ["15 rpm is taken for the output_speed: 15 rpm is slow enough for the output"]


@pytest.mark.parametrize("names, heads", [
    (["te_15rpm_25C_1.csv", "te_15rpm_25p4C_1.csv", "te_15rpm_26C_1.csv"], [[], [], []]),
    (["te_15rpm_1.csv", "te_15rpm_2.csv", "te_15rpm_3.csv"], [["Temperatur: 25 °C"], ["Temperatur: 26 °C"], ["Temperatur: 40.3 °C"]]),
])  # fmt: skip
def test_steps_that_were_set_stay_apart(tmp_path, names, heads):
    proposal = proposed(tmp_path, dict(zip(names, heads)))
    assert len(proposal.conditions) == 3 and not any(actual(proposal).values())


def test_temperatures_that_drift_join_only_what_else_agrees(tmp_path):
    numbers = {50: (25.0, 25.4), 100: (25.9, 26.3), 167: (26.8, 27.1)}
    proposal = proposed(tmp_path, {f"te_{load}Nm_15rpm_{k}.csv": [f"Temperatur: {t} °C"] for load, pair in numbers.items() for k, t in enumerate(pair, 1)})
    assert {stated["load_torque"]: stated["temperature"] for stated in proposal.conditions.values()} == {"50 N.m": "25 degC", "100 N.m": "26 degC", "167 N.m": "27 degC"}


def test_levels_that_would_be_rounded_to_one_number_stay_apart(tmp_path):
    heads = {f"te_15rpm_{k}.csv": [f"Temperatur: {t} °C"] for k, t in enumerate((24.55, 24.6, 25.2, 25.56), 1)}
    assert [stated["temperature"] for stated in proposed(tmp_path, heads).conditions.values()] == ["24.575 degC", "25.38 degC"]


def test_what_is_stated_for_all_wins_over_heads(tmp_path):
    heads = {"te_50Nm_15rpm_1.csv": ["Temperatur: 25.1 °C"], "te_50Nm_15rpm_2.csv": ["Temperatur: 27.2 °C"]}
    assert len(proposed(tmp_path, heads).conditions) == 2
    proposal = proposed(tmp_path, heads, conditions={"temperature": "25degC"})
    assert [stated["temperature"] for stated in proposal.conditions.values()] == ["25 degC"] and not any(actual(proposal).values())
    assert [d.place for d in proposal.doubts if "temperature = 25degC, which is given for all files, counts" in d.text] == ["te_50Nm_15rpm_2.csv"]
    # Of a speed the other shaft's gives way, too.
    (tmp_path / "te_50Nm_15rpm_1.csv").unlink(), (tmp_path / "te_50Nm_15rpm_2.csv").unlink()
    proposal = proposed(tmp_path, {"te_50Nm_1.csv": ["Motordrehzahl: 1499.7 1/min"]}, conditions={"output_speed": "12 rpm"})
    assert list(proposal.conditions.values()) == [{"load_torque": "50 N.m", "output_speed": "12 rpm"}]
    assert not any("taken for the input_speed" in d.text for d in proposal.doubts)


TWO = {"te_50Nm_15rpm_25C_1.csv": [], "te_50Nm_15rpm_28C_1.csv": [], "te_100Nm_15rpm_25C_1.csv": []}


def test_conditions_that_say_the_same_by_what_is_stated_become_one(tmp_path):
    """Twelve temperatures were stated by name, became one, and twelve conditions stayed, each "not repeated"."""
    names = list(proposed(tmp_path, TWO).conditions)
    assert names == ["100N.m_25degC", "50N.m_25degC", "50N.m_28degC"]
    given = {"50N.m_28degC:temperature": "25.0 degC", "50N.m_25degC:hours": "5 h", "50N.m_28degC:hours": "5h"}
    proposal = propose([tmp_path], Wishes("RV20E-121", conditions=given, held_out=("50N.m_28degC",)))
    assert list(proposal.conditions) == names[:2] and proposal.joined == {"50N.m_28degC": "50N.m_25degC"}
    assert proposal.conditions["50N.m_25degC"]["hours"] == "5 h" and proposal.held_out.keys() == {"50N.m_25degC"}
    assert [(run.condition, run.replicate.value) for run in proposal.runs if "50Nm" in run.name] == [("50N.m_25degC", 1), ("50N.m_25degC", 2)]
    # Names are those without what is stated by them, and nothing joins that is alike in between only.
    shifted = propose([tmp_path], Wishes("RV20E-121", conditions={"50N.m_25degC:temperature": "28 degC", "50N.m_28degC:temperature": "31 degC"}))
    assert [stated["temperature"] for stated in shifted.conditions.values()] == ["25 degC", "28 degC", "31 degC"] and not shifted.joined
    with pytest.raises(InputFault, match="there is no condition 50N.m_29degC"):
        propose([tmp_path], Wishes("RV20E-121", conditions={"50N.m_29degC:hours": "1 h"}))


def test_conditions_of_other_words_do_not_join(tmp_path):
    proposal = proposed(tmp_path, {"te_50Nm_15rpm_new.csv": [], "te_60Nm_15rpm_worn.csv": []})
    names = list(proposal.conditions)
    proposal = propose([tmp_path], Wishes("RV20E-121", conditions={f"{name}:load_torque": "55 N.m" for name in names}))
    assert list(proposal.conditions) == names and not proposal.joined


def test_what_is_stated_of_a_condition_wins_over_what_its_runs_had(tmp_path):
    heads = {f"te_{load}Nm_15rpm_{k}.csv": [f"Temperatur: 25.{k} °C"] for load in (50, 167) for k in (1, 2)}
    proposal = proposed(tmp_path, heads, conditions={"50N.m:temperature": "30 degC"})
    assert [name for name, own in actual(proposal).items() if own] == ["te_167Nm_15rpm_1", "te_167Nm_15rpm_2"]


def test_cells_that_make_conditions_alike_join_them_in_the_workbench(tmp_path):
    folder = opened(tmp_path / "b")
    for name in TWO:
        error_file(folder.root, name)
    folder.remember("wishes", {"reducer": "RV20E-121", "conditions": {"50N.m_28degC:temperature": "25 degC"}, "held_out": ["50N.m_28degC"]})
    found = view(folder)
    assert not found["gone"] and found["proposal"]["joined"] == {"50N.m_28degC": "50N.m_25degC"} and found["proposal"]["held_out"].keys() == {"50N.m_25degC"}


def test_one_number_in_two_units_is_one_condition(tmp_path):
    """25 degC and 77 F of one campaign made two conditions."""
    proposal = proposed(tmp_path, {"te_50Nm_15rpm_25C_1.csv": [], "te_50Nm_15rpm_77F_2.csv": [], "te_50Nm_15rpm_80F_3.csv": []})
    assert [stated["temperature"] for stated in proposal.conditions.values()] == ["25 degC", "80 degF"]
    assert len({run.condition for run in proposal.runs[:2]}) == 1


def test_what_is_given_in_another_unit_joins_conditions(tmp_path):
    heads = {"te_50Nm_15rpm_25C_1.csv": [], "te_50Nm_15rpm_40C_2.csv": []}
    names = {run.name: run.condition for run in proposed(tmp_path, heads).runs}
    again = propose([tmp_path], Wishes("RV20E-121", conditions={f"{names['te_50Nm_15rpm_40C_2']}:temperature": "77 degF"}))
    assert list(again.joined.values()) == [names["te_50Nm_15rpm_25C_1"]]


def test_what_a_head_measured_of_a_number_in_the_name_is_kept(tmp_path):
    """25C in the name dropped the 25.1 degC of the head."""
    heads = {f"te_50Nm_15rpm_25C_{k}.csv": [f"Temperature: {25 + k / 10} °C"] for k in (1, 2)}
    proposal = proposed(tmp_path, heads)
    assert [stated["temperature"] for stated in proposal.conditions.values()] == ["25 degC"]
    assert actual(proposal) == {"te_50Nm_15rpm_25C_1": {"temperature": "25.1 degC"}, "te_50Nm_15rpm_25C_2": {"temperature": "25.2 degC"}}
    assert sorted(round(record.factors["temperature"], 2) for record in checked(proposal).records) == [298.25, 298.35]
    assert not [doubt for doubt in proposal.doubts if "temperature" in doubt.text]


@pytest.mark.parametrize("above, doubted", [("40 °C", True), ("77 °F", False)])
def test_a_head_that_says_another_number_than_the_name_is_doubted(tmp_path, above, doubted):
    proposal = proposed(tmp_path, {"te_50Nm_15rpm_25C_1.csv": [f"Temperature: {above}"]})
    said = [doubt.text for doubt in proposal.doubts if "temperature" in doubt.text]
    assert said == (["its name says temperature = 25 degC, which is taken, and a line above its table 40 degC"] if doubted else [])
    assert not any(actual(proposal).values())


def with_columns(folder, **loads):
    for k, (name, load) in enumerate(loads.items()):
        rows = "".join(f"{0.5 * i:g};{(i * i) % 7 + i * k % 11 / 10:g};{load + i % 3 / 100:g};15\n" for i in range(721))
        (folder / f"{name}.csv").write_text("angle [deg];te [arcsec];Torque [Nm];output speed [rpm]\n" + rows, encoding="utf-8")


def test_runs_of_one_condition_that_differ_in_a_column_alone_are_doubted(tmp_path, capsys):
    """50 and 150 N.m that stood in columns were repetitions of one condition, without a word."""
    with_columns(tmp_path, te_1=50, te_2=50, te_3=150)
    assert main(["campaign", "from", str(tmp_path), "--reducer", "RV20E-121"]) == 0
    shown = " ".join(capsys.readouterr().out.split())
    assert "load_torque 50 N m and 150 N m by its column" in shown
    assert "load_torque stands in columns alone and is 50 N m in te_1.csv, te_2.csv, 150 N m in te_3.csv: these runs" in shown and "(50Nm)" in shown


def test_what_columns_say_alike_is_no_doubt(tmp_path):
    with_columns(tmp_path, te_1=50, te_2=50.1)
    assert not [doubt for doubt in propose([tmp_path], Wishes("RV20E-121")).doubts if "columns alone" in doubt.text]
