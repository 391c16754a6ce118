"""The loop from a campaign to a better model, on small campaigns of the virtual bench with known additions."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from cli.progress import new_screen
from discrepancy.campaign.model import Campaign, Rig
from discrepancy.compare import compare
from discrepancy.experiment.next_run import proposal_for
from discrepancy.extend import DID_NOT_HELP, HELPED, NOT_PROVEN, extend
from discrepancy.inference.chi_square import chi_text
from discrepancy.model_file import extended_reducer, load_model, save_model
from discrepancy.page.comparison import page as page_of_comparison
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import Parameter, Record
from discrepancy.verdict import diagnose
from fmu_src.faults import InputFault
from fmu_src.progress import told_to

pytestmark = pytest.mark.usefixtures("shared_runs")
NOISE = {"transmission_error": 2e-6, "input_torque": 0.01, "lost_motion": 5e-6}
CLEARANCE = "needle_clearance_added"
SAMPLES = 150


def records(held_out=True):
    """Transmission error at three loads, input torque over speed, lost motion; two of each; one load held out."""
    angle = np.linspace(0.0, 2.0 * np.pi, SAMPLES, endpoint=False)
    found = []
    for k, load in enumerate((167.0, 60.0, 110.0)):
        for replicate in (1, 2):
            factors = {"speed": 209.0, "load": load, "temperature": 293.0, "direction": 1}
            aside = held_out and k == 2
            found.append(Record(f"te{k}{replicate}", "transmission_error", "rad", f"load {k}", replicate, np.zeros(SAMPLES),
                                {"angle": angle}, factors, held_out=aside))
            found.append(Record(f"tq{k}{replicate}", "input_torque", "N.m", f"load {k}", replicate, np.zeros(1), {}, factors,
                                held_out=aside))
    for replicate in (1, 2, 3):
        found.append(Record(f"lm{replicate}", "lost_motion", "rad", "held", replicate, np.zeros(1), {}, {"temperature": 293.0}))
    return tuple(found)


def campaign_of(file, truth, seed, held_out=True):
    """A campaign that the virtual bench has measured with ``truth`` added, and white noise."""
    blank = Campaign(None, "bench", "", file.reducer, 121.0, 167.0, {}, records(held_out), {}, {}, (), None, "")
    random = np.random.default_rng(seed)
    predicted = PhysicalModel(file, blank, zeros={}).predict(truth)
    noisy = [replace(r, values=y + NOISE[r.quantity] * random.standard_normal(len(y))) for r, y in zip(blank.records, predicted)]
    return replace(blank, records=tuple(noisy))


@pytest.fixture(scope="module")
def file():
    return load_model("RV20E-121-rigid")


@pytest.fixture(scope="module")
def wide(file):
    return campaign_of(file, {CLEARANCE: 0.6e-6}, 3)


@pytest.fixture(scope="module")
def diagnosed(file, wide):
    return diagnose(file, wide)


def test_model_that_is_right_errs_by_the_noise(file):
    comparison = compare(file, campaign_of(file, {}, 2))
    # The noise of two or three single numbers is known too badly for more.
    assert all(row["ratio"] < 1.2 for row in comparison.signals if row["signal"] == "transmission_error")
    assert comparison.diagnostician.localisation.findings == []


def test_wider_needle_bearings_are_found_and_added(file, wide, diagnosed, tmp_path):
    answer = diagnosed
    assert answer.as_json()["verdict"] == "one effect"
    first = answer.effects[0]
    assert first["name"] == "needle_clearance"
    low, high = first["parameters"][CLEARANCE]["interval"]
    assert low < 0.6e-6 < high and high - low < 0.3e-6
    extension = extend(file, wide, [first["name"]])
    assert extension.verdict == HELPED
    step = extension.step
    assert step["held_out_after"] < 1.6 < step["held_out_before"]
    # One fit, one number: what is added is what was named, with the same errors.
    kept = extension.file.effects["needle_clearance"][CLEARANCE]
    assert [kept["value"], kept["low"], kept["high"]] == pytest.approx([first["parameters"][CLEARANCE]["value"], low, high], rel=1e-6)
    assert [step["held_out_before"], step["held_out_after"]] == pytest.approx([first["held_out_error_before"], first["held_out_error_after"]], rel=1e-6)
    assert step["nuisances"] == pytest.approx(answer.in_si()["nuisances"], rel=1e-6, abs=1e-12)
    # The file keeps the effect and the ladder, and the reducer for the FMUs has the value as its start.
    save_model(extension.file, tmp_path / "better.toml")
    again = load_model(tmp_path / "better.toml")
    assert again.values()[CLEARANCE] == pytest.approx(0.6e-6, rel=0.2)
    assert again.steps[0]["verdict"] == HELPED
    starts = {v.name: v.start for v in extended_reducer(again).plant.variables}
    assert starts[CLEARANCE] == again.values()[CLEARANCE]
    # What is in the model is no candidate any more, and the model errs by the noise.
    after = compare(again, wide)
    assert after.diagnostician.localisation.findings == []
    # Key figures before and with it are those that a comparison of either model says.
    was, now = compare(file, wide).figures, after.figures
    for (before, changed), one, other in zip(extension.figures, was, now, strict=True):
        assert (before.condition, before.name, before.measured, before.model) == (one.condition, one.name, one.measured, one.model)
        assert (changed.measured, changed.model) == pytest.approx((other.measured, other.model), abs=max(0.2 * other.noise, 1e-9 * abs(other.model)))
    told = extension.as_json()
    assert len(told["key_figures"]) == len(told["key_figures_after"]) == len(now) and told["key_figures"][0]["unit"] == told["key_figures_after"][0]["unit"]
    assert after.model.candidates and all(c.name != "needle_clearance" for c in after.model.candidates)


@pytest.mark.campaign
def test_nothing_is_left_to_find_in_the_extended_model(file, wide):
    assert diagnose(extend(file, wide, ["needle_clearance"]).file, wide).verdict == "none"


def test_effect_that_only_fits_noise_is_refused(file):
    heard = []
    with told_to(SimpleNamespace(begin=lambda task: heard.append(task.what), end=lambda task: None, say=lambda text: None)):
        extension = extend(file, campaign_of(file, {}, 3), ["pin_position_errors.scatter"])
    # Minutes, of which nothing said what they were for.
    steps = [what for what in heard if what.startswith(("fitting the base", "looking", "fitting pin", "judging"))]
    assert steps == ["fitting the base model", "looking at what pin_position_errors.scatter would do", "fitting pin_position_errors.scatter", "judging it on unused runs"]
    assert extension.verdict in (DID_NOT_HELP, NOT_PROVEN)
    assert extension.file.effects == {} and extension.file.steps[0]["kept"] is False


def test_gain_on_fitted_runs_alone_proves_nothing(file):
    campaign = campaign_of(file, {CLEARANCE: 0.6e-6}, 4, held_out=False)
    assert extend(file, campaign, ["needle_clearance"]).verdict == NOT_PROVEN


def test_saved_settings_are_read_again(tmp_path):
    given, again = tmp_path / "given.toml", tmp_path / "again.toml"
    given.write_text("[model]\nname = 'x'\nreducer = 'RV20E-121-rigid'\n[settings]\nmesh_wear_law = 'constant'\nroughness = '0.3 um'\n")
    save_model(load_model(given), again)
    assert load_model(again).settings == load_model(given).settings == {"mesh_wear_law": 0, "roughness": pytest.approx(3e-7)}


def test_unknown_effect_is_named_in_the_fault(file, wide):
    with pytest.raises(InputFault, match="phlogiston.*needle_clearance"):
        extend(file, wide, ["phlogiston"])


def test_declared_nuisance_is_calibrated_and_no_candidate(file):
    from discrepancy.campaign.model import Nuisance

    campaign = campaign_of(file, {"friction_coefficient": 0.02}, 5)
    level = Nuisance(Parameter("friction_coefficient", "1", 0.0, 0.0, 0.5, 0.01))
    comparison = compare(file, replace(campaign, nuisances=(level,)))
    assert comparison.nuisances["friction_coefficient"] == pytest.approx(0.02, abs=0.004)
    assert all(c.name != "stribeck_friction.mesh" for c in comparison.model.candidates)


def test_record_counted_from_another_angle_is_aligned(file):
    campaign = campaign_of(file, {}, 6)
    zero = 0.02
    moved = [replace(r, axes={"angle": r.axes["angle"] - zero}) if r.axes else r for r in campaign.records]
    comparison = compare(file, replace(campaign, records=tuple(moved)))
    period = 2.0 * np.pi / 80.0
    found = comparison.nuisances["angle_zero[1]"]
    assert abs((found - zero + period / 2) % period - period / 2) < 5e-4
    assert all(row["ratio"] < 1.2 for row in comparison.signals if row["signal"] == "transmission_error")


@pytest.mark.parametrize(("text", "message"), [
    ("[model]\nname = 'x'\n", "model.reducer"),
    ("[model]\nname = 'x'\nreducer = 'RV20E-121-rigid'\n[effects.phlogiston]\n", "phlogiston.*RVWEAR_EFFECTS=DIR"),
    ("[model]\nname = 'x'\nreducer = 'RV20E-121-rigid'\n[effects.drag]\nwind = { value = 1.0, unit = 'N.m' }\n", "wind"),
    ("[model]\nname = 'x'\nreducer = 'RV20E-121-rigid'\n[effects.drag]\nseal_torque = 0.1\n", "seal_torque"),
    ("[model]\nname = 'x'\nreducer = 'RV20E-121-rigid'\n[settings]\nbearing_clearance = '3 kg'\n", "bearing_clearance"),
])  # fmt: skip
def test_faulty_model_files_say_what_is_wrong(tmp_path, text, message):
    path = tmp_path / "model.toml"
    path.write_text(text)
    with pytest.raises(InputFault, match=message):
        load_model(path)


def test_unknown_nuisance_is_refused(file, wide):
    from discrepancy.campaign.model import Nuisance

    vague = Nuisance(Parameter("bearing_clearence", "m", 0.0, 0.0, 1.0, 1.0))
    with pytest.raises(InputFault, match="bearing_clearence.*bearing_clearance"):
        PhysicalModel(file, replace(wide, nuisances=(vague,)))


def test_mean_counts_where_the_zero_is_known(file):
    angle = np.linspace(0.0, 0.2, 60)
    free = Record("a", "transmission_error", "rad", "c", 1, np.full(60, 5e-5), {"angle": angle}, {"speed": 209.0, "load": 167.0, "direction": 1})
    known = replace(free, name="b", zero_known=True)
    campaign = Campaign(None, "bench", "", file.reducer, 121.0, 167.0, {}, (free, known), {}, {}, (), None, "")
    model = PhysicalModel(file, campaign, zeros={})
    first, second = model.predict({})
    assert first.mean() == pytest.approx(5e-5)
    # The carrier lags by 52 arcsec at the rated load.
    assert second.mean() == pytest.approx(-52.0 * np.pi / 180.0 / 3600.0, rel=0.05)
    assert first - first.mean() == pytest.approx(second - second.mean(), abs=1e-12)
    beside = model.predict_beside({"needle_clearance_added": 1e-7}, {}, [1])[0]
    assert beside.mean() == pytest.approx(model.predict({"needle_clearance_added": 1e-7}, [1])[0].mean(), rel=0.01)


def test_repetition_that_stands_out_is_shown_by_compare(file):
    campaign = campaign_of(file, {}, 8)
    more = [replace(r, name=f"lm{k}", replicate=k, values=np.array(r.values) * (8.0 if k == 5 else 1.0))
            for k, r in zip((4, 5), [r for r in campaign.records if r.quantity == "lost_motion"])]
    comparison = compare(file, replace(campaign, records=(*campaign.records, *more)))
    (found,) = comparison.outlying
    assert found.run == "lm5" and comparison.as_json()["outlying"][0]["weight"] == 0.0
    # It is looked for once.
    assert comparison.outlying is comparison.model.outlying
    said = next(text for text in comparison.warnings if "run lm5" in text)
    assert "left out of fit, errors and key figures (pages draw it in grey), for its repetitions agree without it" in said
    drawn = page_of_comparison(comparison)
    assert "left out: lm5" in drawn.conditions and f"of {len(comparison.runs) - 1} runs err" in drawn.finding
    # It was not drawn at all.
    figure = next(f for s in drawn.sections for f in s.figures if f.name.startswith("run_number_lost_motion"))
    assert [(t["name"], t["text"]) for t in figure.data if t["name"] == "left out"] == [("left out", ["lm5"])] and "Grey rings" in figure.caption
    assert all(choice.traces[-1]["text"] == ["lm5"] for choice in figure.choices) and not any("lm5" in t.get("text", ()) for t in figure.data[:-1])
    # It takes no part in the errors of its signal either.
    rows = {r["run"]: r for r in comparison.runs}
    assert rows["lm5"]["left_out"] and rows["lm5"]["ratio"] > 20.0
    assert sum(r["runs"] for r in comparison.signals if r["signal"] == "lost_motion") == sum(r["signal"] == "lost_motion" for r in comparison.runs) - 1
    assert all(r["ratio"] < 2.0 for r in comparison.signals if r["signal"] == "lost_motion")
    assert any("run lm5" in text and "the model errs there by" in text and "arcmin" in text for text in comparison.warnings)


def test_compare_doubts_a_scale_that_no_reducer_has(file):
    campaign = campaign_of(file, {}, 9)
    milli = [replace(r, values=1000.0 * np.array(r.values)) if r.quantity == "input_torque" else r for r in campaign.records]
    warnings = compare(file, replace(campaign, records=tuple(milli))).warnings
    assert sum("what the model predicts" in text and 'unit = "mN.m"' in text for text in warnings) == 1


def test_of_an_effect_that_stands_alone_the_nearest_rival_and_what_confirms_it_are_told(wide, diagnosed):
    """"Needle clearance stands alone" stood there, and nothing of what it was held against."""
    run = proposal_for(diagnosed, wide)
    start, _, rest = run.verdict.partition("; ")
    assert start == "nothing is left to separate: needle clearance stands alone" and run.result is None
    fits = diagnosed.diagnosis.fits
    worse = min(r.fit.chi2 for r in fits.rivals if r.name != "needle_clearance") - fits.members[0].fit.chi2
    assert rest.startswith("nearest of other effects comes ") and f"which fits worse by {chi_text(worse)} in chi-square" in rest
    # What is decided is not proposed, and the runs have the names of the campaign.
    at_20 = next(r.condition for r in wide.records if r.quantity == "lost_motion")
    assert f"the runs of lost_motion in {at_20} tell them apart already (they differ there by " in rest and "repeating" not in rest
    # What this rig cannot tell it does not promise.
    blind = replace(wide, rig=Rig({}, (1,), ("cage_speed",), (), 100.0, 1.0, 0.0, "EUR"))
    assert "confirmed" not in proposal_for(diagnosed, blind).verdict and "nearest of other effects comes " in proposal_for(diagnosed, blind).verdict


def test_what_is_computed_to_draw_a_diagnosis_is_kept_with_it(file, wide, diagnosed, tmp_path, monkeypatch):
    """Drawing one that was found again took up to 12 s: profiles of its parameters were computed anew."""
    from discrepancy import remembered
    from discrepancy.page.write import page_of

    wide = replace(wide, folder=tmp_path / "first")
    monkeypatch.setattr(remembered, "cache_folder", lambda name: tmp_path)
    monkeypatch.setattr(remembered, "diagnose", lambda *arguments, **options: replace(diagnosed, profiles={}))
    heard = []
    with told_to(SimpleNamespace(begin=heard.append, end=lambda task: None, say=lambda text: None)):
        first = remembered.diagnosed(file, wide)
        with remembered.with_profiles(first, file, wide):
            drawn = page_of(first)
    assert "looking at how well each parameter is known" in [task.name for task in heard] and first.profiles

    def anew(*given):
        raise AssertionError("computed anew")

    monkeypatch.setattr("discrepancy.page.profiles.profiles", anew)
    again = remembered.diagnosed(file, wide)
    pictures = [[f.data for s in page.sections if s.id == "profiles" for f in s.figures] for page in (drawn, page_of(again))]
    assert pictures[0] and pictures[0] == pictures[1]
    # One that was stopped is not kept for the whole.
    (kept,) = tmp_path.iterdir()
    kept.unlink()
    again.profiles.clear()
    with remembered.with_profiles(again, file, wide):
        again.profiles["any"] = []
    assert not list(tmp_path.iterdir())


def test_a_diagnosis_is_kept_and_gone_on_from(file, wide, diagnosed, tmp_path, monkeypatch, capsys):
    from discrepancy import remembered

    monkeypatch.setattr(remembered, "cache_folder", lambda name: tmp_path)
    monkeypatch.setattr(remembered, "diagnose", lambda *arguments, **options: diagnosed)
    wide = replace(wide, folder=tmp_path / "first")
    first = remembered.diagnosed(file, wide)
    assert len(list(tmp_path.iterdir())) == 1

    def again(*arguments, **options):
        raise AssertionError("computed anew")

    monkeypatch.setattr(remembered, "diagnose", again)
    screen = new_screen(["diagnose"])
    with told_to(screen):
        second = remembered.diagnosed(file, wide)
    assert second.as_json() == first.as_json()
    # An answer at once is no new one, and that is said.
    (said,) = [line for line in capsys.readouterr().err.splitlines() if not line.startswith("rvwear: ")]
    assert said.startswith("found again: the diagnosis of this model and these measurements, made ") and said.endswith(" of computing; none of it is computed anew")
    assert " from the folder " not in said
    # What is kept goes by contents: the same files in another folder have it too, and whoever never diagnosed there is told whose it is.
    with told_to(screen):
        remembered.diagnosed(file, replace(wide, folder=tmp_path / "copy"))
    (elsewhere,) = [line for line in capsys.readouterr().err.splitlines() if not line.startswith("rvwear: ")]
    assert f", from the folder {wide.folder.resolve()} with the same files, in " in elsewhere
    # So it is where an effect is added by name alone.
    monkeypatch.setattr("discrepancy.extend.extend", lambda *arguments, **options: options["answer"])
    for further, lines in (({}, [said]), ({"said": True}, [])):
        with told_to(screen):
            assert remembered.extended(file, wide, ["any"], **further).as_json() == first.as_json()
        assert [line for line in capsys.readouterr().err.splitlines() if not line.startswith("rvwear: ")] == lines
    # What was found is added without a search, and is the same to the last digit.
    name = first.effects[0]["name"]
    fits = second.doctor.space.predictions.calls
    steps = [extend(file, wide, [name], answer=answer) for answer in (first, second)]
    assert steps[0].as_json() == steps[1].as_json()
    # What is left are the slopes by which unused runs are held against it.
    assert second.doctor.space.predictions.calls - fits <= 5
    # Called otherwise, in another folder, it is the same that was measured; the answer is told of the present one.
    moved = replace(wide, name="moved", text='# a copy\n[campaign]\nname = "moved"\ndata = "../bench"\n')
    assert remembered.remembered(file, moved).as_json()["campaign"] == "moved"
    assert remembered.remembered(file, replace(moved, text=moved.text + 'orders = { motor = [3] }\n')) is None
    # So it is where the model file lies elsewhere, and where something was tried in vain: not where it was kept.
    tried, kept = (replace(file, steps=(*file.steps, {"effects": ["drag"], "kept": kept})) for kept in (False, True))
    assert remembered.remembered(replace(tried, path=tmp_path / "elsewhere.toml"), wide).model.file.path == tmp_path / "elsewhere.toml"
    assert remembered.remembered(kept, wide) is None
    # Other measurements, and a file that is not whole, are no answer.
    other = replace(wide, records=(*wide.records[:-1], replace(wide.records[-1], values=wide.records[-1].values * 1.001)))
    assert remembered.remembered(file, other) is None
    whole = next(tmp_path.iterdir())
    whole.write_bytes(whole.read_bytes()[:-1] + b"x")
    assert remembered.remembered(file, wide) is None


def test_one_sample_far_off_is_named_and_tells_neither_error_nor_peak_to_peak(file):
    campaign = campaign_of(file, {}, 8)
    spoilt = [np.where(np.arange(len(r.values)) == 70, 3e-4, r.values) if r.name in ("te02", "te22") else r.values for r in campaign.records]
    plain, off = (compare(file, c) for c in (campaign, replace(campaign, records=tuple(replace(r, values=v) for r, v in zip(campaign.records, spoilt)))))
    named = [text for text in off.warnings if "samples stands" in text]
    assert len(named) == 2 and named[0].startswith("run te02: 1 of 150 samples stands") and "at 168 deg (sample 71)" in named[0]
    for before, after in zip(plain.signals, off.signals):
        assert after["ratio"] == pytest.approx(before["ratio"], rel=0.05)
    span = [next(f for f in c.figures if f.name == "peak to peak" and f.condition == "load 0") for c in (plain, off)]
    assert span[1].measured == pytest.approx(span[0].measured, rel=0.02) and span[1].noise < 2.0 * span[0].noise
    assert not any("samples stand" in text for text in plain.warnings)
