"""The picture of the house holds: every import is in the table, none goes in a circle."""

from collections import Counter

import pytest

from docs import make_architecture
from docs.imports import TABLE, arrows, circles, entry_of, permission, sources


def test_every_import_is_in_the_table():
    """If this fails: turn the arrow round, or say in docs/architecture.toml why it must be."""
    wrong = [
        f"{source}.py, line {line}: {entry_of(source)} may not import {target}"
        for source, targets in arrows().items() for target, line in targets if permission(source, target) is None
    ]  # fmt: skip
    assert not wrong, "\n".join(wrong)


def test_every_arrow_of_the_table_is_used():
    used = Counter((entry_of(s), permission(s, t)) for s, targets in arrows().items() for t, _ in targets)
    idle = [f"{name} -> {folder}" for name, entry in TABLE.items() for folder in entry["imports"] if (name, folder) not in used]
    assert not idle, f"struck from docs/architecture.toml, for nobody imports so: {', '.join(idle)}"


def test_no_file_imports_itself_around_others():
    assert circles(arrows()) == []


def test_a_circle_would_be_found():
    graph = {"a": [("b", 1)], "b": [("c", 1)], "c": [("a", 1), ("d", 1)], "d": [], "e": [("d", 1)]}
    assert circles(graph) == [["a", "b", "c"]]


@pytest.mark.parametrize("name", [name for name in TABLE if "row" in TABLE[name]])
def test_the_table_itself_points_down(name):
    rows = {target.partition("/")[0] for target in TABLE[name]["imports"]} - {name}
    assert all(TABLE[target]["row"] > TABLE[name]["row"] for target in rows)


def test_every_package_is_in_the_table():
    root = make_architecture.ROOT
    packages = {path.parent.name for path in root.glob("*/__init__.py")}
    assert packages <= {name.partition("/")[0] for name in TABLE}
    assert all(name in sources() or (root / name).is_dir() or (root / f"{name}.py").is_file() for name in TABLE)


def test_the_picture_is_that_of_the_code():
    """If this fails: python docs/make_architecture.py."""
    kept = make_architecture.PICTURE.read_text(encoding="utf-8")
    shown = make_architecture.shown_lines(kept)
    now = make_architecture.lines_of()
    assert shown.keys() == now.keys()
    far = [f"{name}: {shown[name]} shown, {lines} there" for name, lines in now.items() if abs(shown[name] - lines) > 0.1 * lines + 50]
    assert not far, "\n".join(far)
    # Lines change with every commit; all else must be as drawn now.
    assert make_architecture.picture(shown) == kept
