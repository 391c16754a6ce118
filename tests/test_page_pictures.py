"""Pieces of the pages' pictures: bands of loops, maps of a misfit."""

from itertools import pairwise

import numpy as np
import pytest

from discrepancy.page import maps
from discrepancy.page.panels import band, ways
from pages import look
from pages.look import Figure


def area_of(trace):
    """Area of all polygons of a band by the shoelace formula; those of opposite sense take from each other, as they do where they are drawn."""
    xs, ys = ([[]], [[]])
    for x, y in zip(trace["x"], trace["y"]):
        if x is None:
            xs.append([])
            ys.append([])
        else:
            xs[-1].append(x)
            ys[-1].append(y)
    return abs(sum(0.5 * (np.dot(x, np.roll(y, 1)) - np.dot(y, np.roll(x, 1))) for x, y in zip(xs, ys)))


def test_band_of_a_loop_covers_both_ways():
    up = np.linspace(-1.0, 1.0, 50)
    x = np.concatenate([up, up[::-1][1:]]) + 0.004 * np.sin(np.arange(99) * 2.4)
    y = np.where(np.arange(99) < 50, 1.0, -1.0)
    assert [(w.start, w.stop) for w in ways(up)] == [(0, 50)] and len(ways(x)) == 2
    # One way after the other, with a gap between: each band is twice as high as the noise on either side.
    assert area_of(band(x, y - 0.1, y + 0.1, "")) == pytest.approx(2 * 2.0 * 0.2, rel=0.1)
    assert ways(np.array([0.0, 1.0, 0.0, -1.0, 0.0])) == [slice(0, 2), slice(1, 4), slice(3, 5)]
    assert ways(np.zeros(0)) == [] and band(np.zeros(0), np.zeros(0), np.zeros(0), "")["x"] == []


def test_a_map_of_one_column_is_a_table():
    places = [{"signal": "hysteresis", "feature": f, "dependence": "everywhere", "p": p, "share": 0.5, "statistic": 9.0, "chi_square": 9.0, "width": 1, "dof": 40.0}
              for f, p in (("mean", 0.5), ("along torque", 1e-9))]  # fmt: skip
    figures, tables = maps.localisation("place", places, 1e-3)
    assert not figures and tables[0].title == "Misfit at all conditions alike"
    assert [(row[1], row[4]) for row in tables[0].rows] == [("along torque", "yes"), ("mean", "no")]
    figures, tables = maps.localisation("place", [*places, places[0] | {"dependence": "load"}], 1e-3)
    # Beside a map, what is significant answers for itself.
    assert len(figures) == 1 and [row[1] for row in tables[0].rows] == ["along torque"]


def test_orders_in_a_picture_have_names_that_stand_apart_and_a_whole_title():
    """Of neighbours the tallest is named; bars are high enough for the title beside them."""
    pytest.importorskip("matplotlib", reason="no matplotlib: pip install matplotlib")
    from pages.paper import drawn

    orders = [*range(111, 123), 156, 195]
    heights = [0.1] * 5 + [3.0] + [0.2] * 6 + [1.0, 2.0]
    data = [{"type": "bar", "name": name, "x": [str(o) for o in orders], "y": heights} for name in ("measured", "predicted")]
    layout = look.layout(barmode="group", showlegend=True, xaxis=look.axis("order", type="category", tickangle=0), yaxis=look.axis("transmission error [arcsec]"))
    picture = drawn(Figure("response_orders_x", "", "", data, layout, 12, 260))
    picture.canvas.draw()
    (axes,) = picture.axes
    named = [label for label in axes.get_xticklabels() if label.get_text()]
    boxes = [label.get_window_extent() for label in named]
    assert all(left.x1 < right.x0 for left, right in pairwise(boxes)) and {"116", "195"} <= {label.get_text() for label in named}
    title, whole = axes.yaxis.label.get_window_extent(), picture.bbox
    assert whole.y0 <= title.y0 and title.y1 <= whole.y1 and "transmission error" in axes.get_ylabel().replace("\n", " ")
    assert axes.get_window_extent().height / picture.dpi * 25.4 > 20.0


def test_a_title_below_a_plot_ends_before_the_edge_of_the_picture():
    """What was changed stands below the axis, whose middle is not that of the picture."""
    pytest.importorskip("matplotlib", reason="no matplotlib: pip install matplotlib")
    from cli.altered import note_of, noted_figure
    from pages.charts import Curve, chart
    from pages.paper import drawn
    from pages.words import units_in_print

    note = note_of(["bearing.clearance=10um (RV20E-121 had 2.5 um)"])
    for y_title in ("F / F max", "force along the pressure angle and beyond it [kN]"):
        figure = chart("sine", "", "", [Curve("a", np.arange(9.0), np.arange(9.0))], "sin", y_title)
        for width in (60.0, 90.0, 190.0):
            picture = drawn(noted_figure(figure, note), width)
            picture.canvas.draw()
            label = picture.axes[0].xaxis.label
            box, words = label.get_window_extent(), label.get_text().replace("\n", " ")
            assert picture.bbox.x0 <= box.x0 and box.x1 <= picture.bbox.x1 and picture.bbox.y0 <= box.y0, (width, label.get_text())
            assert words == f"sin {units_in_print(note)}"
    # Where there is room, nothing is folded that was not.
    assert label.get_text().count("\n") == 1


def names_of_columns(names, width):
    """Boxes of the names below a map of one row, as drawn."""
    from pages.paper import drawn

    cells = {("transmission_error", name): 3.0 + k for k, name in enumerate(names)}
    picture = drawn(maps.grid("", "", "error_map", cells), width)
    picture.canvas.draw()
    return picture, picture.axes[0].get_xticklabels()


@pytest.mark.parametrize("names", [
    ["1500rpm_167N.m", "600rpm_167N.m", "1500rpm_42N.m", "600rpm_42N.m", "600rpm_84N.m", "warm"], [f"滞回曲线_输入{k}" for k in range(7)],
])  # fmt: skip
def test_names_of_conditions_stand_apart_below_a_map(names):
    """They were level, and ran into one another: digits are wider than other signs, Chinese ones twice as wide.  Without a font for these nothing warns."""
    pytest.importorskip("matplotlib", reason="no matplotlib: pip install matplotlib")
    picture, labels = names_of_columns(names, 190.0)
    boxes = [label.get_window_extent() for label in labels]
    assert all(label.get_rotation() > 0.0 for label in labels) or all(left.x1 < right.x0 for left, right in pairwise(boxes))
    assert min(box.y0 for box in boxes) >= picture.bbox.y0 and [label.get_text() for label in labels] == names
    assert picture.axes[0].get_window_extent().height / picture.dpi * 25.4 > 5.0
    assert all(label.get_rotation() == 0.0 for label in names_of_columns(["warm", "cold"], 190.0)[1])


def test_fonts_with_chinese_signs_stand_behind_the_latin_one():
    """Only installed ones: of others matplotlib would say that it did not find them."""
    mpl = pytest.importorskip("matplotlib", reason="no matplotlib: pip install matplotlib")
    from pages.fonts import LATIN, families, printed

    with printed({}):
        # Behind "sans-serif" matplotlib would look at one font alone.
        assert mpl.rcParams["font.family"][0] == LATIN
    assert families([]) == [LATIN] and families(["SimHei", "Arial", "Noto Sans CJK JP"]) == [LATIN, "Noto Sans CJK JP", "SimHei"]
