"""The open trial: sealed campaigns, the answers' format, the scorer's command, and the one door for every method."""

import json
import sys

import pytest

from benchmarks.blind_trial import enter, publish_open, run, score
from benchmarks.blind_trial.answers import FORMAT, VERDICTS, read_answers, results_of, seals_of, write_answers, wrong_with
from benchmarks.blind_trial.generator.make import Task
from benchmarks.blind_trial.words import SEALS
from discrepancy.campaign.load import load_campaign
from fmu_src.faults import InputFault

TASKS = [Task(0, 3, "null", size="tiny"), Task(1, 5, "effect", ("drag of seals and grease",), 12.0, "tiny", rivals=True)]


@pytest.fixture
def trial(tmp_path, monkeypatch):
    """(folder that is given away, folder of the truths) of two tiny campaigns."""
    monkeypatch.setattr(publish_open, "final_plan", lambda seed: TASKS)
    assert publish_open.publish(tmp_path / "open", tmp_path / "sealed", 2, 1, 1) == ["campaign_00000", "campaign_00001"]
    return tmp_path / "open", tmp_path / "sealed"


def test_nothing_that_is_given_away_tells(trial):
    folder, sealed = trial
    for name, seal in seals_of(folder).items():
        assert load_campaign(folder / "campaigns" / name).seal == f"sha256:{seal}"
    given = "".join(p.read_text(encoding="utf-8") for p in folder.rglob("*") if p.is_file())
    assert not any(word in given for word in ("drag", "grease", "d_prime", "truth", "seed", "rivals"))
    assert (sealed / "seed.txt").is_file()


def test_campaigns_that_are_there_are_not_made_again(trial, monkeypatch):
    folder, sealed = trial
    monkeypatch.setattr(publish_open, "one", lambda *a: pytest.fail("made again"))
    assert len(publish_open.publish(folder, sealed, 2, 1, 1)) == 2


def test_the_truths_do_not_go_below_what_is_given_away(tmp_path, monkeypatch):
    monkeypatch.setattr(sys, "argv", ["publish_open", str(tmp_path), "--sealed", str(tmp_path / "x")])
    with pytest.raises(SystemExit):
        publish_open.main()


def test_command_scores_an_answers_file(trial, tmp_path, monkeypatch, capsys):
    folder, sealed = trial
    right = {"campaign_00000": {"verdict": "none"}, "campaign_00001": {"verdict": "one effect", "effects": [{"name": "drag"}], "seconds": 2.0}}
    write_answers(tmp_path / "right.json", "a good one", right)
    write_answers(tmp_path / "half.json", "a lazy one", {"campaign_00000": {"verdict": "one effect", "effects": [{"name": "unbalance"}]}})
    monkeypatch.setattr(sys, "argv", ["score", *(str(tmp_path / f"{n}.json") for n in ("right", "half")), "--trial", str(folder), "--sealed", str(sealed)])
    assert score.main() == 0
    good, lazy = capsys.readouterr().out.split("a lazy one")
    assert "right name first, d' from 10: 100.0 % of 1 (at least 95 %: met)" in good
    # What is not answered is not right.
    assert "right name first, d' from 10: 0.0 % of 1" in lazy
    assert "included: 100.0 % of 1 (at most 2 %: missed)" in lazy


def test_example_of_an_answers_file_can_be_scored(trial):
    folder, sealed = trial
    method, answers = read_answers(folder / publish_open.EXAMPLE)
    figures = score.score(results_of(answers, folder, sealed))
    assert method == "nothing is ever missing"
    assert figures["judged"]["false_alarms"]["share"] == figures["judged"]["first_from_10"]["share"] == 0.0


def test_a_truth_that_was_changed_is_refused(trial):
    folder, sealed = trial
    path = sealed / "campaign_00001.json"
    path.write_text(path.read_text(encoding="utf-8").replace("drag", "unbalance"), encoding="utf-8")
    with pytest.raises(InputFault, match="not the truth that was sealed"):
        results_of({}, folder, sealed)
    with pytest.raises(InputFault, match="no such campaign"):
        results_of({"campaign_9": {"verdict": "none"}}, folder, sealed)


@pytest.mark.parametrize(("answer", "said"), [
    ({"verdict": "maybe"}, "verdict must be one of"), ([], "verdict must be"), ({"verdict": "one effect"}, "names no effect"),
    ({"verdict": "one effect", "effects": [{"name": "a"}, {"name": "b"}]}, "names 2"), ({"verdict": "none", "effect": []}, "effect is not known"),
    ({"verdict": "set", "effects": ["a"]}, "effects is a list"), ({"verdict": "set", "effects": [{"name": "a", "p": 1}]}, "effects[0].p is not known"),
    ({"verdict": "none", "seconds": "3"}, "seconds must be a number"), ({"verdict": "none", "set": [1]}, "set is a list of names"),
])  # fmt: skip
def test_answers_that_cannot_be_scored_are_refused(answer, said):
    assert said in wrong_with(answer)


def test_every_verdict_is_an_answer(tmp_path):
    for verdict in VERDICTS:
        assert wrong_with({"verdict": verdict, "effects": [{"name": "a"}] if verdict not in ("none", "unknown", "base off") else []}) == ""
    (tmp_path / "a.json").write_text(json.dumps({"format": "other"}), encoding="utf-8")
    with pytest.raises(InputFault, match=FORMAT):
        read_answers(tmp_path / "a.json")


def test_every_method_goes_through_the_same_door(trial, tmp_path):
    folder, _ = trial
    asked = []

    def ask(method, campaign):
        asked.append(campaign.name)
        return None if campaign.name.endswith("1") and len(asked) < 3 else enter.by_names(["drag", "first_stage_error.sun", "first_stage_error.mesh"])

    path = tmp_path / "answers.json"
    assert set(enter.enter(folder, path, "x", ask)) == {"campaign_00000"}
    # It goes on where it failed or was stopped.
    answers = enter.enter(folder, path, "x", ask)
    assert asked == ["campaign_00000", "campaign_00001", "campaign_00001"]
    assert [e["name"] for e in answers["campaign_00001"]["effects"]] == ["drag", "first_stage_error"]
    assert read_answers(path)[1].keys() == seals_of(folder).keys()
    assert (folder / SEALS).is_file()


def test_a_method_that_names_nothing_says_none():
    assert enter.by_names([]) == {"verdict": "none", "effects": []}
    assert enter.by_names(["a.x", "a.y"])["verdict"] == "one effect"
    assert enter.by_names(["a", "b"])["verdict"] == "several effects"


def test_a_method_that_is_not_installed_says_so(trial, monkeypatch):
    monkeypatch.setattr("benchmarks.blind_trial.peers.peers_of", lambda folder, methods: {"seconds": ["1.0"]})
    with pytest.raises(InputFault, match="pip install pysindy"):
        enter.answer_of("PySINDy STLSQ", trial[0] / "campaigns" / "campaign_00001")


def test_a_trial_with_peers_is_not_begun_without_them(tmp_path, monkeypatch, capsys):
    monkeypatch.setattr("benchmarks.blind_trial.peers.PACKAGES", {"pysindy": "no_such_module", "joblib": "joblib"})
    monkeypatch.setattr(sys, "argv", ["run", "--campaigns", "1", "--seed", "3", "--peers", "1", "--folder", str(tmp_path)])
    with pytest.raises(SystemExit):
        run.main()
    assert capsys.readouterr().err.endswith("peers are not installed: pip install pysindy\n") and not list(tmp_path.iterdir())


def test_bic_answers_from_the_folder_alone(trial):
    folder, _ = trial
    found = enter.answer_of("BIC, white noise", folder / "campaigns" / "campaign_00001")
    assert wrong_with(found) == ""
    assert len(found["effects"]) == 1
