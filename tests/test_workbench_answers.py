"""A question under In offers the answer that was guessed; a click states it, and names of conditions stay what they were."""

from types import SimpleNamespace

import pytest

from discrepancy.campaign.guess.propose import propose
from discrepancy.campaign.guess.wishes import Wishes
from discrepancy.campaign.guess.write import checked
from fmu_src.faults import InputFault
from workbench.confirming import answer_of
from workbench.folder import opened
from workbench.intake import view, wish, wishes_of
from workbench.left_open import left_open

LOOP = "出力トルク[N・m],ねじれ角[arcmin]\n" + "\n".join(f"{t},{0.02 * t + (0.3 if k < 11 else -0.3):.3f}" for k, t in enumerate([*range(-160, 161, 32), *range(160, -161, -32)]))
ERROR = "出力角度[deg],角度伝達誤差[arcsec]\n" + "\n".join(f"{1.8 * k:.1f},{(7 * k) % 11}" for k in range(201))


@pytest.fixture
def bench(tmp_path):
    """Loops whose names hold an angle that may be of a temperature as well, and transmission errors at speeds without a side."""
    for place in (210, 90):
        (tmp_path / f"ヒステリシス_入力軸固定_{place}度_1回目.csv").write_text(LOOP, encoding="utf-8")
    for speed in (900, 1450):
        (tmp_path / f"角度伝達誤差_100Nm_{speed}rpm_1回目.csv").write_text(ERROR.replace("\n0.0,", f"\n0.0{speed},"), encoding="utf-8")
    return opened(tmp_path)


def answered(folder):
    return {d["text"]: d for d in view(folder)["proposal"]["doubts"]}


def test_each_question_offers_what_was_guessed_and_is_settled_by_it(bench):
    wish(bench, {"reducer": "RV20E-121"})
    asked = answered(bench)
    offers = {d["yes"]: d for d in asked.values() if "yes" in d}
    assert offers.keys() == {"Yes: locked at 210 deg, 90 deg, as their names say", "Yes: it is an encoder's on the output", "Yes: of the input"} and len(asked) == 3
    assert offers["Yes: of the input"]["guess"] == "speeds are those of the input"
    names = list(view(bench)["proposal"]["conditions"])
    given: dict = {"reducer": "RV20E-121", "conditions": {}}
    for offer in offers.values():
        given |= {k: given.get(k, {}) | v if isinstance(v, dict) else v for k, v in offer["stated"].items()}
    wish(bench, given)
    proposal = view(bench)["proposal"]
    assert not proposal["doubts"] and list(proposal["conditions"]) == names
    assert {name: stated.get("locked_at") for name, stated in proposal["conditions"].items() if "固定" in name} == {"入力軸固定_210度": "210 deg", "入力軸固定_90度": "90 deg"}


def test_a_side_that_is_stated_of_one_speed_leaves_the_question_of_the_others(bench):
    given = {"reducer": "RV20E-121", "conditions": {"900rpm_100N.m:input_speed": "900 rpm"}}
    [doubt] = [d for d in propose(bench.measurements(), wishes_of(given)).doubts if "taken for the input_speed" in d.text]
    assert doubt.text.startswith("1450 rpm is taken")


def test_a_question_without_a_guess_offers_none(tmp_path):
    (tmp_path / "loop_warm.csv").write_text(LOOP, encoding="utf-8")
    proposal = propose([tmp_path], Wishes("RV20E-121", tags={"locked": "input"}))
    assert len(proposal.unplaced) == 1 and not any(answer_of(doubt, proposal) for doubt in proposal.doubts)


def test_what_is_left_open_of_an_answer_is_told_once_each():
    """Parts that look alike, one of two origins, and a direction that half a turn on shows the same."""
    four = {"name": "crank_lobe_errors", "place": "crank 1 at disc 1 or crank 2 at disc 2, which look alike", "other_places": ["crank 2 at disc 2"]}
    pins = "whether it is pins off their places, or a ring clamped so, this campaign does not tell: turn the ring"
    turned = "effects.ring_pin_errors.direction: -139.1 deg shows the same in the runs that were fitted as 40.9 deg; they do not tell which of the two it is"
    said = left_open(SimpleNamespace(effects=[four, {"name": "drag"}], untold=[pins, turned], warnings=[pins, turned, "another"]))
    assert [text[:24] for text in said] == ["At which part it is (cra", "Whether it is pins off t", "effects.ring_pin_errors."]


def test_a_known_zero_is_said_of_its_quantity_and_refused_of_what_has_none(bench):
    """In had no field for it; angle_of of the same table stays beside it."""
    wish(bench, {"reducer": "RV20E-121", "zeros": {"transmission_error": "absolute", "hysteresis": "absolute", "transmission_order": "absolute"}})
    found = view(bench)
    known = {record.quantity: record.zero_known for record in checked(propose(bench.measurements(), wishes_of(found["wishes"]))).records}
    assert known == {"transmission_error": True, "hysteresis": True}
    assert found["text"].count("[quantities.transmission_error]") == 1 and 'angle_of = "output"' in found["text"]
    assert "--zero transmission_error=absolute" in found["command"]
    assert [d["place"] for d in found["proposal"]["doubts"] if d["text"].startswith("zero transmission_order=absolute says nothing")] == ["campaign"]
    for zeros, said in (({"wear_depth": "absolute"}, "--zero wear_depth"), ({"hysteresis": "none"}, "--zero QUANTITY none")):
        with pytest.raises(InputFault, match=f"{said}: there is no such thing; choose from"):
            wishes_of({"zeros": zeros})
