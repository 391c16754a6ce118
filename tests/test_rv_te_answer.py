"""The answer on the rig of ratio 81: the fit finds what a made campaign hides, rivals and errors are what they say; the rig itself where its table is there."""

import sys
from pathlib import Path

import numpy as np
import pytest
from test_rv_te import DATA, ROOT

from discrepancy.effects import EFFECTS as CHAIN
from discrepancy.model_file import load_model

FOLDER = ROOT / "examples" / "rv_reducer_te"
ARCSEC = np.pi / 648000.0
ORDERS = (1, 3, 39, 40, 78, 81, 156, 162, 240)


@pytest.fixture(scope="module")
def example():
    sys.path.insert(0, str(FOLDER))
    try:
        import answer
        import named_physics
        import rivals
    finally:
        sys.path.remove(str(FOLDER))
    return answer, named_physics, rivals


def table(path: Path, rows: list[tuple[str, int, int]]) -> Path:
    head = "dir,rpm,T,tor,a0," + ",".join(f"a{k},p{k}" for k in ORDERS)
    path.write_text("\n".join([head, *(f"{d},{rpm},25,{torque},60000," + ",".join("100,0" for _ in ORDERS) for d, rpm, torque in rows)]) + "\n")
    return path


@pytest.fixture(scope="module")
def prepared(example, tmp_path_factory):
    folder = tmp_path_factory.mktemp("rig")
    source = table(folder / "orders.csv", [(d, rpm, torque) for d in ("fw", "bw") for rpm, torque in ((100, 400), (1000, 800), (1000, 1800), (100, 1500))])
    return example[0].prepared(source, folder)[0]


def test_the_fit_finds_what_was_hidden(example, prepared):
    """Five rungs of hidden numbers, one run of eight spoilt: the others are found."""
    _, physics, _ = example
    rungs = [r for r in physics.LADDER if r.effect in ("sensor_offset", "support_compliance", "pin_seats", "tilting_moment", "carrier_stiffness")]
    truth = {"sensor_offset[transmission_error]": -1.0, "carrier_compliance": 5e-7, "pin_seat_cos_2": -3e-10, "pin_seat_sin_2": 3e-9,
             "tilting_share_x": 0.15, "tilting_share_y": -0.1, "carrier_crank_cos": 2e-9, "carrier_crank_sin": -7e-9}  # fmt: skip
    measured = prepared.predict(truth)
    for record, values in zip(prepared.records, measured):
        record.values[:] = values
    prepared.records[3].values[0] += 100.0 * ARCSEC
    fitter = physics.Fitter(prepared)
    fitted = fitter.fit(rungs, range(8))
    for name, value in truth.items():
        # Huber's weights let a blunder pull by half a deviation, whatever its size.
        assert fitted.values[name] == pytest.approx(value, rel=0.03), name


def test_errors_of_a_curve(example, prepared):
    """A wave of 3 arcsec is off by 6/pi on average, a mean of 5 by 5."""
    answer, _, _ = example
    record = prepared.records[0]
    order, part = (np.asarray(record.axes[name]) for name in ("order", "part"))
    off = 3.0 * ARCSEC * ((order == 78.0) & (part == 1.0))
    found = answer.errors(prepared.records, {0: record.values + off})
    (word,) = found.whole
    assert found.whole[word] == pytest.approx(6.0 / np.pi, rel=1e-3) and found.waves == found.whole and found.means[word] == 0.0
    found = answer.errors(prepared.records, {0: record.values - 5.0 * ARCSEC * (order == 0.0)})
    assert found.whole[word] == pytest.approx(5.0) and found.waves[word] == 0.0


def test_rivals_see_the_training_runs_alone(example, prepared):
    _, _, rivals = example
    simple = [name for name in rivals.RIVALS if name != rivals.TREES]
    before = {name: rivals.predictions(name, prepared.records, [0, 1, 2, 4, 5, 6], [3, 7]) for name in simple}
    for i in (3, 7):
        prepared.records[i].values[:] += 1.0
    after = {name: rivals.predictions(name, prepared.records, [0, 1, 2, 4, 5, 6], [3, 7]) for name in rivals.RIVALS}
    for name, found in before.items():
        assert all(np.array_equal(found[i], after[name][i]) for i in (3, 7))
    assert np.allclose(rivals.predictions("mean of each order", prepared.records, [0, 1, 2], [3])[3], np.mean([prepared.records[i].values for i in (0, 1, 2)], axis=0))
    x = np.random.default_rng(0).uniform(-1.0, 1.0, (30, 3))
    y = 1.0 + x[:, 0] - 2.0 * x[:, 1] * x[:, 2] + x[:, 2] ** 2
    assert np.allclose(rivals.by_quadratic(x[:20], y[:20], x[20:]), y[20:])


def test_numbers_are_counted_and_saved(example, prepared, tmp_path):
    answer, physics, _ = example
    numbers = physics.numbers_of(physics.LADDER)
    assert len({n.name for n in numbers}) == len(numbers) <= 20
    fitted = physics.Fitted(tuple(numbers), {n.name: n.start for n in numbers}, np.eye(len(numbers)), [])
    answer.save_model(answer.model_file(prepared, fitted), tmp_path / "model.toml")
    again = load_model(tmp_path / "model.toml")
    assert set(again.effects) == {r.effect for r in physics.LADDER} - {physics.ZERO} and set(again.effects) & set(CHAIN)


def test_rungs_are_steps_of_the_model(example, prepared, tmp_path):
    """`rvwear ladder` reads them; a rung that earns in the waves alone has helped, although the means got worse."""
    answer, physics, _ = example
    before, *rungs = (
        {kind: {"whole": {"forward": whole, "backward": whole}, "waves": {"forward": waves, "backward": waves}} for kind in ("training", "held_out")}
        for whole, waves in ((110.0, 40.0), (11.0, 40.0), (11.5, 5.0), (11.4, 4.95))
    )
    rungs = [row | {"effect": rung.effect, "says": rung.says, "numbers": 1} for row, rung in zip(rungs, physics.LADDER)]
    whole = physics.numbers_of(physics.LADDER)
    fitted = physics.Fitted(tuple(whole), {n.name: n.start for n in whole}, np.eye(len(whole)), [])
    answer.save_model(answer.model_file(prepared, fitted, answer.steps_of(before, rungs)), tmp_path / "model.toml")
    again = load_model(tmp_path / "model.toml").steps
    assert [s["effects"] for s in again] == [[r.effect] for r in physics.LADDER[:3]]
    assert [s["verdict"] for s in again] == ["helped", "helped", "did not help"]
    assert again[0]["held_out_before"] == pytest.approx(100.0) and again[0]["held_out_after"] == pytest.approx(again[1]["held_out_before"])


@pytest.mark.campaign
@pytest.mark.skipif(not DATA.is_file(), reason=f"no measurements at {DATA}; set RVWEAR_DATA to their folder")
def test_the_rig_itself(example, tmp_path):
    """The four rungs of order 1 and the means, one fit: what is left is far below what a mean of each order leaves."""
    answer, physics, _ = example
    model, _ = answer.prepared(DATA, tmp_path)
    held = answer.chosen(model.records, None)
    fitted = physics.Fitter(model).fit(physics.LADDER[:3], answer.others(model.records, held))
    found = answer.errors(model.records, {i: fitted.predicted[i] for i in held})
    assert found.whole["forward"] < 14.0 and found.whole["backward"] < 8.0
    assert answer.of_rivals(model.records, held)["mean of each order"].whole["forward"] > 70.0
