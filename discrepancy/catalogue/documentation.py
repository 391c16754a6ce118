"""The page docs/effects.md: every effect with its law, parameters, and computed signature.

    python -m discrepancy.catalogue.documentation
"""

from collections.abc import Mapping
from pathlib import Path

from discrepancy.campaign.documentation import table
from discrepancy.catalogue.catalogue import Entry, entries
from discrepancy.catalogue.examples import AUDITED
from discrepancy.catalogue.signature import SURFACES, Signature, largest, new_bench, number, signature

PAGE = Path(__file__).resolve().parents[2] / "docs" / "effects.md"
COMPUTED = "**Computed**"
# Rows of a table; the rest is in ``rvwear effects NAME``.
MOST_ROWS = 10
DEPTH = " depth"
HEAD = """# Effects

Made by `python -m discrepancy.catalogue.documentation`. What a real reducer and its sensors may do beyond the ideal
model: one file each, compiled into the units, off by default (then figures are the same to the last bit).
*Expected* is the signature that physics demands, *computed* what the virtual bench shows for RV20E-121 (quasi-static, radial
needle clearance 2.5 um, rated 167 N m at 2000 rpm): figure without and with the effect, the largest changes first
in the order of the bench. Orders are those of one turn of the output, wear after 1,000 h at rated speed or as many
turns. `rvwear effects NAME` shows all figures, `rvwear effects --html FILE` pictures.
"""
AUDIT_HEAD = """## Against the physics audit

Figures of an independent solver. It gives the lag of the second stage where the bench gives the transmission error of the
whole reducer, 2 to 4 % smaller. The audit's proud pin stands inwards, here it is thicker, which takes more gap;
random places are other random numbers; worn races are its wear print, here a smooth hollow.

"""


def static_part(entry: Entry) -> str:
    """Title, law, source, expectation and parameters."""
    e = entry.effect
    parameters = [
        (f"`{p.variable.name}`", p.kind, p.variable.unit, f"{float(p.variable.start):g}",
         f"{p.variable.minimum:g} to {p.variable.maximum:g}", p.variable.description)
        for p in e.parameters
    ]  # fmt: skip
    heads = ("parameter", "kind", "unit", "off or start", "bounds", "meaning")
    return "\n".join((
        f"## {entry.number}. {e.title}" if e.number else f"## {e.title}", "",
        f"`{entry.name}`, acts in the {entry.part}.", "", f"**Law:** {e.law}", "", f"**Source:** {e.source}", "",
        f"**Expected:** {e.signature}", "", table(heads, parameters),
    ))  # fmt: skip


def computed_part(entry: Entry, found: list[Signature]) -> str:
    """Per case the figures that change, and for effects of the wear unit how much faster which surface wears."""
    parts = []
    for s in found:
        wears = "wear" in entry.part
        rows = [(r.figure, r.condition, number(r.without), number(r.present), "" if r.unit == "1" else r.unit)
                for r in largest(s, MOST_ROWS, DEPTH if wears else "")]
        shown = [table(("figure", "condition", "without", "with", "unit"), rows)] if rows else []
        shown += [wear_table(s)] if wears else []
        parts.append(f"{COMPUTED}, {s.case.title}:\n\n" + "\n".join(shown or ["nothing that the bench measures changes\n"]))
    return "\n".join(parts)


def wear_table(s: Signature) -> str:
    """Depth with over depth without the effect, by condition and surface."""
    rows = {}
    for r in s.rows:
        if r.figure.endswith(DEPTH):
            rows.setdefault(r.condition, []).append(f"{r.present / r.without:.2f}")
    return table(("wear with / without", *(name.replace("_", " ") for name in SURFACES)), [(c, *ratios) for c, ratios in rows.items()])


def audit_table(found: Mapping[str, list[Signature]]) -> str:
    """Computed figures beside those of the physics audit."""
    rows = []
    for name, case, figure, condition, audited in AUDITED:
        row = found[name][case].row(figure, condition)
        rows.append((f"`{name}`", found[name][case].case.title, figure, condition, number(row.present), number(audited), row.unit))
    return AUDIT_HEAD + table(("effect", "case", "figure", "condition", "here", "audit", "unit"), rows)


def page(found: Mapping[str, list[Signature]]) -> str:
    parts = [f"{static_part(e)}\n{computed_part(e, found[e.name])}" for e in entries()]
    return "\n".join((HEAD, *parts, audit_table(found)))


def main() -> None:
    bench = new_bench()
    found = {e.name: [signature(bench, e.name, case) for case in e.cases] for e in entries()}
    PAGE.write_text(page(found), encoding="utf-8")


if __name__ == "__main__":
    main()
