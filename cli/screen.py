"""Results on the screen."""

import json
from collections.abc import Mapping

from rich.console import Console
from rich.table import Table

from studies.figure_units import figure_unit


def json_text(content: Mapping[str, object]) -> None:
    """NaN and infinity are not JSON: they become null."""
    print(json.dumps(json.loads(json.dumps(content), parse_constant=lambda _: None), indent=1))


def figures(title: str, values: Mapping[str, object]) -> None:
    """Two columns: what and how much."""
    table = Table(title=title, title_justify="left")
    table.add_column("figure")
    table.add_column("value", justify="right")
    table.add_column("unit")
    for name, value in values.items():
        text = f"{value:.6g}" if isinstance(value, float) else str(value)
        unit = figure_unit(name)
        table.add_row(name, text, "" if unit == "1" else unit)
    Console().print(table)
