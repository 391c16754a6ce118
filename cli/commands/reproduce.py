"""``rvwear reproduce``: the claims of the sources, held against the computation."""

import argparse
import sys
from pathlib import Path

from cli.options import add_json


def add_commands(sub: "argparse._SubParsersAction[argparse.ArgumentParser]") -> None:
    claims = sub.add_parser("reproduce", help="every claim of the sources held against the computation")
    claims.add_argument("claims", nargs="*", help="ids or prefixes: T, N16, C (default all)")
    claims.add_argument("--output", default="results/reproduce.html", help="the page")
    add_json(claims)
    claims.set_defaults(run=reproduce)


def reproduce(options: argparse.Namespace) -> int:
    """``rvwear reproduce``: the sources' claims, judged."""
    from cli import screen
    from reproduce import as_json, print_table, write_page
    from reproduce import run as judge

    claims = judge(options.claims or None, lambda text: print(text, file=sys.stderr, flush=True))
    page = write_page(claims, Path(options.output))
    if options.json:
        screen.json_text(as_json(claims) | {"page": str(page)})
    else:
        print_table(claims)
        print(f"page  {page}")
    return 0 if all(claim.stands for claim in claims) else 1
