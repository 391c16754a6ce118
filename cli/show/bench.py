"""Figures of a standard test, with their definitions."""

from collections.abc import Mapping, Sequence

from rich.table import Table

from cli import screen
from studies.standard.evaluation import Figure, Test


def show_bench(
    reducer: str, test: Test, found: Mapping[str, Sequence[Figure]], rated: float, ratio: float, curves: int, measured: str | None, as_json: bool
) -> None:
    """``found``: figures by condition, "" where there is one alone; ``rated`` torque [N m]."""
    if as_json:
        screen.json_text({
            "reducer": reducer, "standard": test.name, "measured": measured, "rated_torque_Nm": rated, "ratio": ratio, "curves": curves, "text": test.text,
            "figures": [{"condition": condition} | figure.as_json() for condition, figures in found.items() for figure in figures],
        })  # fmt: skip
        return
    many = len(found) > 1
    table = Table(title=f"{measured or reducer}: {test.title}", title_justify="left")
    spread = any(figure.spread for figures in found.values() for figure in figures)
    for head in (*(["condition"] if many else []), "figure", "value", "unit", *(["least to most"] if spread else [])):
        # A figure's name is what people look for: it is never cut.
        table.add_column(head, justify="right" if head in ("value", "least to most") else "left", no_wrap=head == "figure", overflow="fold")
    definitions: dict[str, str] = {}
    for condition, figures in found.items():
        for k, figure in enumerate(figures):
            between = [f"{figure.spread[0]:.5g} to {figure.spread[1]:.5g}" if figure.spread else ""] if spread else []
            table.add_row(*([condition if k == 0 else ""] if many else []), figure.name, f"{figure.value:.6g}", figure.unit, *between)
            definitions[figure.name] = figure.definition
    out = screen.console()
    out.print(table)
    out.print(f"rated torque {rated:g} N.m, ratio {ratio:g}, {curves} {'curve' if curves == 1 else 'curves'}")
    for name, definition in definitions.items():
        out.print(f"{name}: {definition}")
    out.print(test.text)
