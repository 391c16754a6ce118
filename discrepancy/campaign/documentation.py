"""The tables of docs/campaigns.md, from the declarations.

    python -m discrepancy.campaign.documentation

writes them anew below the mark in the page.
"""

from collections.abc import Iterable, Sequence
from pathlib import Path

from discrepancy.campaign.pairs import HOLDS_FOR, PAIRS
from discrepancy.campaign.quantities import AXES, FACTORS, INTERVENTIONS, QUANTITIES, TAGS, keys_for

PAGE = Path(__file__).resolve().parents[2] / "docs" / "campaigns.md"
MARK = "<!-- From here on made by: python -m discrepancy.campaign.documentation -->\n"


def table(heads: Sequence[str], rows: Sequence[Sequence[object]]) -> str:
    lines: list[Sequence[object]] = [heads, ("---",) * len(heads), *rows]
    return "\n".join(f"| {' | '.join(str(cell).replace('|', '/') for cell in line)} |" for line in lines) + "\n"


def code(names: Iterable[str]) -> str:
    return ", ".join(f"`{name}`" for name in names)


def tables() -> str:
    """Everything below the mark."""
    quantities = [
        (f"`{q.name}`", q.usual_unit, q.description, code(k for a in q.axes for k in keys_for(a)),
         code(k for a in q.optional_axes for k in keys_for(a)), code(q.factors), code(q.tags), code(q.optional_tags))
        for q in QUANTITIES.values()
    ]  # fmt: skip
    keys = [
        (f"`{k.key}`", k.unit, "column" if k in AXES else "condition, `actual` or column", k.description)
        for k in (*AXES, *FACTORS)
    ]
    tags = [(f"`tags.{t.name}`", code(t.choices) or ("a number" if t.counted else "any word"), t.description) for t in TAGS.values()]
    interventions = [(f"`{name}`", meaning) for name, meaning in INTERVENTIONS.items()]
    pairs = [
        (p.number, " / ".join(p.effects), p.experiment,
         " **or** ".join("; ".join(need.text for need in needs) for needs in p.alternatives))
        for p in PAIRS
    ]  # fmt: skip
    return "\n".join((
        "## Quantities\n",
        "A quantity of another unit of the same kind is converted. What it needs to know of the condition may stand in the"
        " condition or in columns.\n",
        table(("quantity", "usual unit", "what it is", "needs the columns", "may have", "needs to know", "needs tags",
               "tags it may have"), quantities),
        "## Columns and numbers of a condition\n",
        table(("key", "kind of unit", "stated as", "meaning"), keys),
        "## Tags\n",
        table(("key", "words", "meaning"), tags),
        "## Interventions\n",
        table(("word", "what was done before the condition"), interventions),
        "## Effects that look alike\n",
        "`rvwear campaign check` says of each pair whether the campaign has an experiment that separates it, and what is missing."
        f" The pairs are {HOLDS_FOR}: \"not separable\" says that the experiment below is missing, \"separable\" that it is there; whether"
        " the noise lets it succeed is for `rvwear diagnose` to say, and for `rvwear campaign check --separable` of effects of a stated size.\n",
        table(("", "effects", "what separates them", "what the check asks for"), pairs),
    ))  # fmt: skip


def page() -> str:
    """The page with its tables made anew."""
    return PAGE.read_text(encoding="utf-8").partition(MARK)[0] + MARK + "\n" + tables()


if __name__ == "__main__":
    PAGE.write_text(page(), encoding="utf-8")
