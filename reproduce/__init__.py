"""Every claim of the two source documents and of later literature, held against the computation.

    claims = run(None, print)
    print_table(claims); write_page(claims, "results/reproduce.html"); as_json(claims)

``claim`` says what a claim is, ``context`` runs what several of them share, the modules
``*_claims`` hold the claims, ``printed_forms`` the formulas as printed; ``table`` and
``page`` show the outcome.  Equal code gives equal results, byte for byte.
"""

import time
from collections.abc import Callable, Sequence
from itertools import groupby
from operator import itemgetter
from pathlib import Path

from fmu_src.faults import InputFault, nearest
from pages.render import written
from reproduce import (  # noqa: F401  each registers its claims
    bearing_claims,
    coefficient_claims,
    completion_claims,
    flank_wear_claims,
    force_claims,
    geometry_claims,
    individuality_claims,
    literature_claims,
    loading_claims,
    loss_claims,
    motion_claims,
    pin_wear_claims,
    pressure_claims,
    prototype_claims,
    raceway_claims,
    raceway_law_claims,
    recent_claims,
    rig_claims,
    rigidity_claims,
    sliding_claims,
    stiffness_claims,
)  # fmt: skip
from reproduce.claim import REGISTRY, STATED, Claim, has_figure
from reproduce.context import Context
from reproduce.page import page_of
from reproduce.table import as_json, print_table, tables_of

__all__ = ["Claim", "as_json", "available_claims", "chosen", "has_figure", "print_table", "run", "stated", "tables_of", "write_page"]


def available_claims() -> list[str]:
    """The ids of all claims."""
    return sorted(REGISTRY, key=lambda name: ("TNLCI".index(name[0]), name))


def chosen(selected: list[str] | None) -> list[str]:
    """The ids that ids or prefixes of them name, in capitals or not; InputFault for one that names none."""
    ids = available_claims()
    selected = [name.upper() for name in selected or ()]
    for name in selected:
        if not any(known.startswith(name) for known in ids):
            groups = [list(group) for _, group in groupby(ids, key=itemgetter(0))]
            there = ", ".join(f"{group[0]} to {group[-1]}" for group in groups)
            raise InputFault(f"claim {name!r}: there is none{nearest(name, ids) or f'; there are {there}'}; --list says what each is")
    return [known for known in ids if not selected or known.startswith(tuple(selected))]


def stated(selected: list[str] | None = None) -> dict[str, tuple[str, str, str]]:
    """(source, title, what the source says) of claims by id; nothing is computed."""
    return {name: STATED[name] for name in chosen(selected)}


def run(selected: list[str] | None = None, progress: Callable[[str], None] = lambda _: None, changes: Sequence[str] = ()) -> list[Claim]:
    """Judge the claims of the given ids or id prefixes ("T", "N1"), or all; ``progress`` gets lines of text.

    ``changes``: other numbers of the reducers than the sources', ``name=value``; what the sources' numbers carry need not hold then.
    """
    ids = chosen(selected)
    context = Context(lambda text: progress(f"  run   {text}"), changes)
    claims = []
    for i, name in enumerate(ids, 1):
        begun = time.perf_counter()
        claims.append(REGISTRY[name](context))
        progress(f"{i:3d}/{len(ids)}  {name}  {claims[-1].title}: {claims[-1].verdict} "
                 f" ({time.perf_counter() - begun:.1f} s)")
    return claims


def write_page(claims: list[Claim], path: Path, changes: Sequence[str] = ()) -> Path:
    """Write the claims as one HTML file that opens offline."""
    return written(page_of(claims, changes), path)
