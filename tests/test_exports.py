"""Results for other programs and for papers: what is written is what was computed, with units, and other programs read it."""

import codecs
import json
import re
from itertools import pairwise
from types import SimpleNamespace

import numpy as np
import pandas as pd
import pytest
import scipy.io
import xarray as xr

from cli.altered import note_of, noted_figure, noted_tables
from cli.exporting import write_exports
from cli.main import main
from discrepancy.campaign.guess.propose import propose
from discrepancy.campaign.guess.wishes import Wishes
from discrepancy.campaign.readers import Options
from discrepancy.campaign.readers.csv import read
from discrepancy.page import maps
from discrepancy.tables import tables_of as measured_tables
from exports.plain import plain, plain_json
from exports.tables import Column, Table, tables_of
from exports.write import write_tables
from fmu_src.faults import InputFault
from pages import look
from pages.charts import Curve, chart, polar
from pages.look import Figure
from pages.paper import drawn, save, width_of, write_pictures
from pages.words import number
from reducers.reducer import load_reducer
from reproduce.context import BX, RV, Context
from reproduce.judging import run
from studies.ensemble.tables import tables_of as ensemble_tables
from studies.report.turn import turn_figures
from studies.turn import crank_turn
from tests.test_discrepancy_page import compared, model_of

DATASET = xr.Dataset(
    {
        "lag": ("position", [1.0, 2.0, np.nan], {"units": "arcsec"}), "force": (("position", "pin"), [[1.0, 2.0], [3.0, 4.0], [5.0, 6.0]], {"units": "N"}),
        "map": (("position", "bin"), np.arange(900.0).reshape(3, 300), {"units": "um"}), "peak": ((), 7.0, {"units": "N"}),
    },
    {"angle": ("position", [0.0, 10.0, 20.0], {"units": "deg"}), "place": ("bin", np.arange(300.0), {"units": "deg"})},
)  # fmt: skip
HEADS = ["angle [deg]", "lag [arcsec]", "force[1] [N]", "force[2] [N]"]


def frame_of(path):
    match path.suffix:
        case ".csv":
            return pd.read_csv(path)
        case ".parquet":
            return pd.read_parquet(path)
        case ".xlsx":
            return pd.read_excel(path, sheet_name="position")
    content = scipy.io.loadmat(path, simplify_cells=True)["position"]
    units = content.pop("units")
    written = {name: re.sub(r"_([12])$", r"[\1]", name) for name in content}
    return pd.DataFrame({f"{written[name]} [{units[name]}]": values for name, values in content.items()})


@pytest.mark.parametrize("ending", ["csv", "parquet", "xlsx", "mat"])
def test_a_dataset_comes_back(tmp_path, ending):
    written = write_tables(tables_of(DATASET), tmp_path / f"a.{ending}")
    assert [p.name for p in written] == ([f"a.{ending}"] if ending in ("xlsx", "mat") else [f"a.{ending}", f"a_map.{ending}", f"a_figures.{ending}"])
    frame = frame_of(written[0])
    assert list(frame.columns) == HEADS
    assert frame.to_numpy(float) == pytest.approx(np.array([[0, 1, 1, 2], [10, 2, 3, 4], [20, np.nan, 5, 6]], float), nan_ok=True)
    assert {p.name for p in tmp_path.iterdir()} == {p.name for p in written}


def test_maps_are_a_row_a_value_and_single_numbers_a_table():
    position, bins, figures = tables_of(DATASET)
    assert list(bins.frame().columns) == ["angle [deg]", "place [deg]", "map [um]"] and len(bins.frame()) == 900
    assert bins.frame().iloc[301].tolist() == [10.0, 1.0, 301.0]
    assert figures.frame().values.tolist() == [["peak", 7.0, "N"]] and position.name == "position"


def test_names_of_matlab_are_each_there_once(tmp_path):
    table = Table("1 a", tuple(Column(name, "", [1.0]) for name in ("a[1]", "a(1)", "1", "b" * 70)))
    write_tables([table], tmp_path / "a.mat")
    content = scipy.io.loadmat(tmp_path / "a.mat", simplify_cells=True)["x1_a"]
    assert list(content) == ["a_1", "a_1_2", "x1", "b" * 63, "units"]


@pytest.mark.parametrize("option, said", [
    (["--export", "a.xls"], r"--export a\.xls: the ending says what is written: \.csv, \.parquet, \.mat, \.xlsx"),
    (["--picture", "a.jpg"], r"--picture a\.jpg: the ending says what is drawn: \.svg, \.pdf, \.png"),
    (["--width", "85mm"], r"--width 85mm without --picture FILE: a width is one of pictures"),
    (["--picture", "a.svg", "--width", "3 parsec"], r"--width 3 parsec: give single, middle, double or a width from 30 to 1000 mm"),
])  # fmt: skip
def test_what_cannot_be_written_is_said_before_the_work(capsys, option, said):
    assert main(["hysteresis", *option]) == 2
    assert re.search(said, capsys.readouterr().err)


def test_loop_and_turn_from_the_command_line(tmp_path, capsys):
    """The curves as files; a loop that was exported is read as if a bench had measured it."""
    loop, turn = tmp_path / "loop_1.csv", tmp_path / "turn.xlsx"
    assert main(["hysteresis", "--steps", "4", "--angles", "1", "--export", str(loop), "--picture", str(tmp_path / "loop.svg"), "--width", "double"]) == 0
    assert main(["solve", "--positions", "8", "--export", str(turn), "--json"]) == 0
    shown = capsys.readouterr()
    assert str(loop) in shown.out and str(turn) in shown.err and str(turn) not in shown.out
    assert len(pd.read_excel(turn, sheet_name="position")) == 8
    svg = (tmp_path / "loop.svg").read_text(encoding="utf-8")
    assert float(re.search(r'width="([\d.]+)pt"', svg)[1]) == pytest.approx(190.0 / 25.4 * 72.0, rel=1e-3)
    (run,) = propose([loop], Wishes("RV20E-121")).runs
    assert run.guessed.quantity.value == "hysteresis"
    assert {role: (entry.header, entry.unit.value) for role, entry in run.guessed.columns.items()} == {
        "torque": ("torque [N.m]", "N.m"), "value": ("turning [arcmin]", "arcmin"),
    }  # fmt: skip


@pytest.mark.parametrize("name, beside", [
    ("turn", ["turn", "turn_force", "turn_teeth"]), ("my_turn", ["my_turn", "my_turn_force", "my_turn_teeth"]), ("return", ["return", "return_turn_force", "return_turn_teeth"]),
])  # fmt: skip
def test_what_a_pictures_name_ends_with_is_not_said_twice(tmp_path, name, beside):
    figures = [chart(figure, "t", "", [Curve("c", [0.0, 1.0], [0.0, 1.0])], "x [m]", "y [m]") for figure in ("turn_error", "turn_force", "turn_teeth")]
    assert [path.stem for path in write_pictures(figures, tmp_path / f"{name}.svg")] == beside


def test_comparison_as_tables():
    result = compared(model_of({"gap": 2e-6}))
    tables = {table.name: table.frame() for table in measured_tables(result)}
    assert list(tables)[:3] == ["runs", "signals", "key_figures"]
    runs, curve = tables["runs"], tables["transmission_error"]
    assert set(runs["unit"]) == {"arcsec", "N.m"}
    record = result.model.records[0]
    rows = curve[curve["run"] == record.name]
    kept = result.diagnostician.space.noise.whiteners[0].kept
    assert rows["measured [arcsec]"].to_numpy() == pytest.approx(np.degrees(record.values[kept]) * 3600)
    assert rows["predicted [arcsec]"].to_numpy() == pytest.approx(np.degrees(result.predictions[0][kept]) * 3600)
    assert rows["angle [deg]"].to_numpy() == pytest.approx(np.degrees(record.axes["angle"][kept]))
    assert (curve["noise [arcsec]"] > 0).all() and set(curve["load_set [N.m]"]) == {50.0, 100.0, 130.0, 167.0, 80.0}


X = np.linspace(0.0, 1.0, 5)


def figures():
    curves = [Curve("one", X, X**2), Curve("two & <b>more</b>", X, X, dash="dash", mode="lines+markers")]
    yield chart("lines", "t", "", curves, "torque [N·m]", "a title that is very long and so goes onto two lines, whatever it says [arcmin]", marks=[(0.5, "here")])
    yield chart("log", "t", "", curves, "x", "y", y_axis={"type": "log"})
    yield polar("polar", "t", "", [Curve("one", 360 * X, X)])
    heat = {"type": "heatmap", "z": [[1.0, None], [3.0, 4.0]], "x": ["a", "b"], "y": ["c", "d"], "text": [["1", ""], ["3", "4"]],
            "colorscale": look.colour_scale(look.DEPTH), "colorbar": {"title": {"text": "p"}, "tickvals": [1, 4], "ticktext": ["low", "high"]}}  # fmt: skip
    yield Figure("heat", "t", "", [heat], look.layout(xaxis=look.axis(""), yaxis=look.axis("")), 12, 190)
    bars = [{"type": "bar", "orientation": "h", "x": [1.0, 2.0], "y": ["a", "b"], "text": ["1", "2"], "name": n, "marker": {"color": "rgba(11,79,148,0.5)"}} for n in "mn"]
    band = {"type": "scatter", "x": [0, 1, 1, 0], "y": [0, 0, 1, 1], "fill": "toself", "fillcolor": "#eceff2", "yaxis": "y2", "name": "band", "mode": "lines"}
    yield Figure("bars", "t", "", bars, look.layout(xaxis=look.axis("$ x"), yaxis=look.axis("y"), showlegend=True))
    split = look.layout(xaxis=look.axis("x"), yaxis=look.axis("y", domain=[0.4, 1.0]), yaxis2=look.axis("z", domain=[0.0, 0.3]))
    stretch = {"type": "scatter", "mode": "markers", "x0": 2.0, "dx": 0.5, "y": [1, 2, None], "error_y": {"array": [1, 1, 1]}, "marker": {"color": ["#000000"] * 3}}
    yield Figure("split", "t", "", [stretch, band], split, 12, 380)


@pytest.mark.parametrize("ending, most", [("svg", 9), ("pdf", 2), ("png", 2)])
def test_pictures_of_all_kinds(tmp_path, ending, most):
    made = list(figures())[:most]
    written = write_pictures(made, tmp_path / f"a.{ending}", 88.0)
    assert [p.name for p in written] == [f"a.{ending}", *(f"a_{figure.name}.{ending}" for figure in made[1:])]
    assert all(p.stat().st_size > 2000 for p in written)
    before = written[0].read_bytes()
    write_pictures(made[:1], tmp_path / f"b.{ending}", 88.0)
    assert (tmp_path / f"b.{ending}").read_bytes() == before


def test_a_picture_shows_what_the_page_shows():
    lines, log, _, heat, bars, split = (drawn(figure, 88.0) for figure in figures())
    (axes,) = lines.get_axes()
    one, two, _ = axes.get_lines()
    assert one.get_ydata() == pytest.approx(X**2, abs=1e-3) and two.get_label() == "two & more"
    assert axes.get_ylabel().endswith("\n[arcmin]") and axes.texts[0].get_text() == "here"
    assert log.get_axes()[0].get_yscale() == "log"
    cells = heat.get_axes()[0]
    assert [t.get_text() for t in cells.texts] == ["1", "", "3", "4"] and [t.get_text() for t in cells.get_xticklabels()] == ["a", "b"]
    assert [patch.get_width() for patch in bars.get_axes()[0].patches] == [1.0, 2.0, 1.0, 2.0]
    upper, lower = split.get_axes()
    assert upper.get_lines() == [] or upper.collections
    assert lower.get_xlabel() == "x" and upper.get_xlabel() == ""


def test_what_is_drawn_about_its_mean_says_so_and_the_mean():
    """A picture has no title: a lag of 134 arcsec was drawn about 0 without a word."""
    turn = crank_turn(load_reducer("RV20E-121-rigid"), [], 24).dataset()
    figure = turn_figures(turn)[0]
    lag = float(turn["lag"].mean())
    assert [trace["name"] for trace in figure.data][1] == f"lag of the carrier, less {number(lag)} arcsec"
    assert "about its mean" in figure.layout["yaxis"]["title"]["text"]


@pytest.mark.parametrize("note", ["", "pins altered by 3 µm"])
def test_csv_with_signs_outside_ascii_tells_excel_that_it_is_utf8(tmp_path, note):
    """Names of conditions in Chinese were read in the machine's code page."""
    columns = Column("condition", "", ["滞回曲线_1", "滞回曲线_2"]), Column("angle", "deg", [1.0, 2.0])
    write_tables([Table("curve", columns, note)], tmp_path / "a.csv")
    write_tables([Table("curve", columns[1:])], tmp_path / "b.csv")
    assert (tmp_path / "a.csv").read_bytes().startswith(codecs.BOM_UTF8) and (tmp_path / "b.csv").read_bytes().startswith(b"angle")
    for file, names in (("a", {"condition", "angle [deg]"}), ("b", {"angle [deg]"})):
        assert list(read(tmp_path / f"{file}.csv", names, Options())["angle [deg]"]) == [1.0, 2.0]


def test_what_is_altered_says_so_wherever_it_goes(tmp_path):
    note = note_of(["pin.radius=3mm"])
    table = noted_tables([Table("curve", (Column("x", "m", [1.0, 2.0]),))], note)
    for ending in ("csv", "xlsx", "mat", "parquet"):
        write_tables(table, tmp_path / f"a.{ending}")
    assert (tmp_path / "a.csv").read_text(encoding="utf-8").splitlines()[0] == f"# {note}" and list(pd.read_csv(tmp_path / "a.csv", comment="#").columns) == ["x [m]"]
    assert pd.read_parquet(tmp_path / "a.parquet").attrs["note"] == note
    assert pd.read_excel(tmp_path / "a.xlsx", sheet_name="note").columns[0] == note
    assert scipy.io.loadmat(tmp_path / "a.mat", simplify_cells=True)["curve"]["note"] == note
    curve = Curve("a", np.array([0.0, 90.0, 180.0]), np.array([1.0, 2.0, 1.0]), "#123456")
    flat, round_ = noted_figure(chart("c", "t", "", [curve], "x [m]", "y [m]"), note), noted_figure(polar("p", "t", "", [curve, curve]), note)
    assert "instead of the sources'" in drawn(flat).axes[0].get_xlabel() and drawn(flat).axes[0].get_xlabel().startswith("x [m]")
    assert any("instead of the" in text.get_text() for legend in drawn(round_).legends for text in legend.get_texts())
    assert not note_of([]) and noted_figure(flat, "") is flat


def test_what_is_altered_says_which_reducers_had_what():
    context = Context(changes=["crank.eccentricity=1.1mm", "wear.pins=stand"])
    context.reducer(BX), context.reducer(RV)
    assert context.altered == ("crank.eccentricity=1.1mm (BX-40E-rigid had 1.3 mm, RV20E-121-rigid had 0.9 mm)", "wear.pins=stand (BX-40E-rigid had turn, RV20E-121-rigid had turn)")
    (claim,) = run(["T01"], changes=["crank.eccentricity=1.1mm"])
    assert claim.altered[0].startswith("crank.eccentricity=1.1mm (") and "had" in note_of(claim.altered)


def test_the_note_of_a_figure_names_the_reducers_that_it_shows():
    """Numbers of T08 are of both, its figure of one: the note spoke of both."""
    (claim,) = run(["T08"], changes=["crank.eccentricity=1.1mm"])
    assert "RV20E-121-rigid had 0.9 mm" in claim.altered[0] and {n.label.partition(":")[0] for n in claim.numbers} == {BX, RV}
    assert claim.drawn_with == (("crank.eccentricity=1.1mm (BX-40E-rigid had 1.3 mm)",),) and len(claim.figures) == 1


def test_curves_have_half_of_their_picture_however_much_is_said_of_them():
    curves = [Curve(f"a curve that is told from others by its rather long name, {k}", np.array([0.0, 1.0]), np.array([0.0, k])) for k in range(6)]
    picture = drawn(noted_figure(chart("c", "t", "", curves, "phase on the tooth", "depth [um]", 12, 340), note_of(["pin.radius=3mm (BX-40E-rigid had 3.5 mm)"])), 85.0)
    picture.draw_without_rendering()
    (axes,) = picture.get_axes()
    title = axes.xaxis.label.get_window_extent()
    assert title.x0 > 0.0 and title.x1 < picture.bbox.width
    assert axes.get_position().height > 0.45 and picture.get_figwidth() == pytest.approx(85.0 / 25.4)


def test_each_file_of_tables_says_what_it_holds(tmp_path, capsys):
    tables = [Table(name, (Column("x", "m", [1.0]),)) for name in ("numbers", "verdicts", "other")]
    options = SimpleNamespace(export=[str(tmp_path / "a.csv"), str(tmp_path / "a.mat")], picture=[], json=False)
    write_exports(options, lambda: tables, list, {"numbers": "of the claims", "verdicts": "of the judge"})
    assert [line.partition("a")[2] for line in capsys.readouterr().out.replace(str(tmp_path), "").split("\n")[:4]] == [
        ".csv  of the claims", "_verdicts.csv  of the judge", "_other.csv", ".mat"]  # fmt: skip


def worded(rows, columns):
    """A map with names as pages have them."""
    z = [[float(i + k) for k in range(columns)] for i in range(rows)]
    trace = maps.heat(z, [f"130N.m_15rpm_{k}degC" + ("<br>(held out)" if k else "") for k in range(columns)],
                      [f"transmission error · orders: sun (order {i} also 3 x crank against carrier)" for i in range(rows)],
                      [["< 1 %"] * columns] * rows, z, "error / noise", 0.0, 5.0, {0.0: "≤ 1e−12", 5.0: "1"})  # fmt: skip
    return Figure("map", "t", "", [trace], maps.layout([]), 12, 90 + 20 * rows)


@pytest.mark.parametrize("rows, columns", [(1, 1), (3, 8), (12, 3), (4, 14), (30, 6)])
def test_a_map_keeps_its_names_and_numbers_in_the_width_of_a_column(rows, columns, tmp_path):
    picture = drawn(worded(rows, columns), 90.0)
    # Warnings are errors: the layout has found room.
    save(picture, tmp_path / "a.svg")
    cells, scale = picture.get_axes()
    whole, inside = picture.bbox, cells.get_window_extent()
    texts = [*cells.get_xticklabels(), *cells.get_yticklabels(), *scale.get_yticklabels(), scale.yaxis.label]
    for box in (text.get_window_extent() for text in texts):
        assert box.x0 >= whole.x0 - 1 and box.x1 <= whole.x1 + 1 and box.y0 >= whole.y0 - 1 and box.y1 <= whole.y1 + 1
    names = sorted((text.get_window_extent() for text in cells.get_yticklabels()), key=lambda box: box.y0)
    assert all(low.y1 <= high.y0 + 1 for low, high in pairwise(names))
    assert inside.width > 0.1 * whole.width and all(text.get_window_extent().height < inside.height / rows for text in cells.texts)
    assert columns > 8 or all(text.get_window_extent().width < inside.width / columns + 1 for text in cells.texts)


def test_a_title_is_no_longer_than_its_axis(tmp_path):
    long = "a title of many words that would not stand beside it, were it one line [arcsec]"
    picture = drawn(Figure("a", "t", "", [look.line([0, 1], [0, 1], "#000000"), look.line([0, 1], [0, 1], "#000000", yaxis="y2")],
                           look.layout(xaxis=look.axis("x"), yaxis=look.axis(long, domain=[0.4, 1.0]), yaxis2=look.axis(long, domain=[0.0, 0.3]))), 90.0)  # fmt: skip
    save(picture, tmp_path / "a.svg")
    for axes in picture.get_axes():
        box = axes.yaxis.label.get_window_extent()
        assert box.y0 >= picture.bbox.y0 and box.y1 <= picture.bbox.y1


def test_a_legend_is_never_wider_than_its_picture():
    curves = [Curve(f"{k}: a name that is much too long to stand beside another one in a column", X, k * X) for k in range(5)]
    for width in (60.0, 85.0, 190.0):
        picture = drawn(chart("long", "t", "", curves, "x", "y"), width)
        picture.canvas.draw()
        (legend,) = picture.legends
        box, whole = legend.get_window_extent(), picture.bbox
        assert box.x0 >= whole.x0 and box.x1 <= whole.x1 and box.y0 >= whole.y0
        assert picture.get_axes()[0].get_window_extent().height > 0.3 * 25.4 * width * picture.dpi / 25.4**2


@pytest.mark.parametrize("text, width", [("single", 90.0), ("85mm", 85.0), ("8.5 cm", 85.0), ("3.5in", 88.9), ("120", 120.0)])
def test_widths(text, width):
    assert width_of(text) == pytest.approx(width)


@pytest.mark.parametrize("text", ["", "5mm", "1..2mm", "wide", "2m"])
def test_no_widths(text):
    with pytest.raises(InputFault, match="--width"):
        width_of(text)


def test_nothing_to_draw_is_said(tmp_path):
    with pytest.raises(InputFault, match="there is nothing to draw"):
        write_pictures([], tmp_path / "a.png")


def test_more_rows_than_excel_holds(tmp_path):
    with pytest.raises(InputFault, match="more than Excel holds; export .parquet or .csv"):
        write_tables([Table("a", (Column("x", "", np.zeros(1_048_576)),))], tmp_path / "a.xlsx")


def test_modes_ladders_and_ensembles_are_tables(tmp_path, capsys):
    model = tmp_path / "m.toml"
    model.write_text(
        '[model]\nname = "m"\nreducer = "RV20E-121"\n[[steps]]\neffects = ["thermal_expansion"]\nverdict = "helped"\n'
        'held_out_before = 5.8\nheld_out_after = 1.9\n', encoding="utf-8")  # fmt: skip
    assert main(["ladder", str(model), "--export", str(tmp_path / "steps.csv"), "--quiet"]) == 0
    assert capsys.readouterr().out == f"{tmp_path / 'steps.csv'}\n"
    steps = pd.read_csv(tmp_path / "steps.csv")
    assert steps[["effects", "held_out_after"]].values.tolist() == [["thermal_expansion", 1.9]] and steps["training_after"].isna().all()
    assert main(["modes", "--export", str(tmp_path / "modes.csv"), "--json"]) == 0
    told = json.loads(capsys.readouterr().out)["modes"]
    assert pd.read_csv(tmp_path / "modes.csv")["frequency_Hz"].tolist() == pytest.approx([mode["frequency_Hz"] for mode in told])
    found = {
        "distributions": {"pin_um": {"mean": {"value": 1.0, "low": 0.5, "high": 1.5}}}, "life_hours": {"50 %": {"value": None, "low": 9e3, "high": None}},
        "sensitivity": {"pin_um": {"bearing.clearance": {"alone": 0.2, "total": 0.3}}},
    }  # fmt: skip
    distributions, shares = (table.frame() for table in ensemble_tables(found))
    assert distributions.iloc[0].tolist() == ["pin_um", "mean", "um", 1.0, 0.5, 1.5] and np.isnan(distributions.iloc[1]["value"])
    assert shares.values.tolist() == [["pin_um", "bearing.clearance", 0.2, 0.3]]


def test_what_json_and_excel_have_no_sign_for_is_nothing():
    assert plain({"a": (1.0, np.nan), 2: np.array([[np.inf, 0.5]]), "c": Column("x", "m", [np.float64(np.nan)])}) == {
        "a": [1.0, None], "2": [[None, 0.5]], "c": {"name": "x", "unit": "m", "values": [None]},
    }  # fmt: skip
    assert plain_json({"b": np.bool_(True), "t": "µm", "n": -np.inf}) == '{"b": true, "t": "\\u00b5m", "n": null}'
