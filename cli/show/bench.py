"""Figures of a standard test, with their definitions."""

from collections.abc import Mapping, Sequence
from types import MappingProxyType

from rich.table import Table

from cli import screen
from cli.columns import fill
from studies.standard.evaluation import Figure, Test


def show_bench(
    reducer: str, test: Test, found: Mapping[str, Sequence[Figure]], rated: float, ratio: float, curves: int, measured: str | None, as_json: bool,
    unread: Mapping[str, Mapping[str, str]] = MappingProxyType({}),
) -> None:
    """``found``: figures by condition, "" where there is one alone; ``unread``: why others are missing, by condition and name; ``rated`` torque [N m]."""
    if as_json:
        screen.json_text({
            "reducer": reducer, "standard": test.name, "measured": measured, "rated_torque_Nm": rated, "ratio": ratio, "curves": curves, "text": test.text,
            "figures": [{"condition": condition} | figure.as_json() for condition, figures in found.items() for figure in figures],
            "unread": [{"condition": condition, "name": name, "why": why} for condition, own in unread.items() for name, why in own.items()],
        })  # fmt: skip
        return
    many = len(found) > 1
    table = Table(title=f"{measured or reducer}: {test.title}", title_justify="left")
    figures = [figure for own in found.values() for figure in own]
    columns = {"condition": [condition if k == 0 else "" for condition, own in found.items() for k in range(len(own))]} if many else {}
    # A figure's name is what people look for: it is never cut.
    columns |= {"figure": [f.name for f in figures], "value": [f"{f.value:.6g}" for f in figures], "unit": [f.unit for f in figures]}
    spread = ["least to most"] if any(figure.spread for figure in figures) else []
    if spread:
        columns["least to most"] = [f"{figure.spread[0]:.5g} to {figure.spread[1]:.5g}" if figure.spread else "" for figure in figures]
    out = screen.console()
    names = [head for head in columns if head == "condition"]
    fill(table, columns, out.width - screen.BETWEEN_LINES * len(columns) - screen.EDGE, names, spread, ["value", *spread])
    out.print(table)
    out.print(f"rated torque {rated:g} N m, ratio {ratio:g}, {curves} {'curve' if curves == 1 else 'curves'}")
    for condition, own in unread.items():
        for name, why in own.items():
            out.print(screen.styled((f"{name} is not read", "yellow"), f"{f' of {condition}' if condition else ''}: {why}"))
    for name, definition in {figure.name: figure.definition for figure in figures}.items():
        out.print(f"{name}: {definition}")
    out.print(test.text)
