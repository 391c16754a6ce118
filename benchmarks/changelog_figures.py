"""Key figures of fixed designs, and what a change did to them, in the changelog's words.

    python3 -m benchmarks.changelog_figures                       the figures as JSON
    python3 -m benchmarks.changelog_figures --write               into benchmarks/figures.json
    python3 -m benchmarks.changelog_figures --since OLD.json      changes: "flank wear of BX-40E after 10,000 h: 6.41 -> 6.43 um"

The designs are reducers of the library as they stand in their files, at rated speed and load; lives with
the usual tolerance of 1 %.  ``--since`` compares with the figures of now; ``git show v0.1.0:benchmarks/figures.json``
gives those of another version.
"""

import argparse
import json
import sys
from pathlib import Path

from reducers.reducer import load_reducer
from studies.coupled_master import CoupledMaster
from studies.hysteresis import hysteresis
from studies.life import Life, LifeSettings, live
from studies.modes import modes
from studies.pair import make_pair
from studies.solve import measure
from studies.wear_figures import wear_figures

DESIGNS = ("RV20E-121", "BX-40E")
HOURS = 10_000.0
KEPT = Path(__file__).with_name("figures.json")
# Digits of what is kept, below which machines differ, and of what a changelog shows.
KEPT_DIGITS, SHOWN_DIGITS = 5, 3
# Natural frequencies: as many, lowest first.
FREQUENCIES = 4

# Sentence with the design's name -> (value, unit).
Figures = dict[str, tuple[float, str]]


def figures_of(name: str) -> Figures:
    """The key figures of one design."""
    reducer = load_reducer(name)
    pair = make_pair(reducer, master_kind=CoupledMaster)
    _, new = measure(pair)
    live(pair, Life(LifeSettings(HOURS)), lambda _: None, lambda _: None)
    worn = wear_figures(pair.wear.record())
    _, old = measure(pair)
    loop = hysteresis(reducer, [])
    late = f"of {name} after {HOURS:,.0f} h"
    found = {
        f"peak pin force of {name}": (new["peak_pin_force_N"], "N"),
        f"peak roller force of {name}": (new["peak_roller_force_N"], "N"),
        f"peak contact pressure of {name}": (new["peak_contact_pressure_MPa"], "MPa"),
        f"lag of {name}": (new["mean_lag_arcsec"], "arcsec"),
        f"transmission error of {name}": (new["transmission_error_pp_arcsec"], "arcsec"),
        f"torsional stiffness of {name}": (new["torsional_stiffness_Nm_per_arcmin"], "N m/arcmin"),
        f"torsional stiffness of {name}, input locked": (loop.stiffness_Nm_per_arcmin, "N m/arcmin"),
        f"lost motion of {name}": (60.0 * loop.lost_motion_arcmin, "arcsec"),
        f"flank wear {late}": (worn["disc_flank_um"], "um"),
        f"pin wear {late}": (worn["pin_um"], "um"),
        f"inner raceway wear {late}": (worn["inner_raceway_um"], "um"),
        f"outer raceway wear {late}": (worn["outer_raceway_um"], "um"),
        f"peak pin force {late}": (old["peak_pin_force_N"], "N"),
        f"lag {late}": (old["mean_lag_arcsec"], "arcsec"),
        f"transmission error {late}": (old["transmission_error_pp_arcsec"], "arcsec"),
    }
    for k, mode in enumerate(modes(reducer, [])[:FREQUENCIES], 1):
        found[f"natural frequency {k} of {name}"] = (mode.frequency_Hz, "Hz")
    return {what: (float(f"{value:.{KEPT_DIGITS}g}"), unit) for what, (value, unit) in found.items()}


def all_figures() -> Figures:
    return {what: figure for name in DESIGNS for what, figure in figures_of(name).items()}


def changes(before: Figures, now: Figures) -> list[str]:
    """One line for each figure that differs in the digits shown, is new or is gone."""
    lines = []
    for what, (value, unit) in now.items():
        if what not in before:
            lines.append(f"{what}: {shown(value)} {unit} (new)")
        elif shown(before[what][0]) != shown(value):
            lines.append(f"{what}: {shown(before[what][0])} -> {shown(value)} {unit}")
    return lines + [f"{what}: no longer reckoned" for what in before if what not in now]


def shown(value: float) -> str:
    """Three digits, without an exponent: 6.41, 541, 1,110."""
    return f"{float(f'{value:.{SHOWN_DIGITS}g}'):,.10g}"


def read(path: Path) -> Figures:
    return {what: (figure["value"], figure["unit"]) for what, figure in json.loads(path.read_text(encoding="utf-8")).items()}


def as_text(figures: Figures) -> str:
    return json.dumps({what: {"value": value, "unit": unit} for what, (value, unit) in figures.items()}, indent=1) + "\n"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--write", action="store_true", help=f"write them into {KEPT.parent.name}/{KEPT.name}")
    parser.add_argument("--since", type=Path, metavar="OLD.json", help="print the changes instead, as lines of a changelog")
    options = parser.parse_args()
    before = read(options.since) if options.since else None
    now = all_figures()
    if options.write:
        KEPT.write_text(as_text(now), encoding="utf-8")
    if before is not None:
        print("\n".join(f"- {line}" for line in changes(before, now)) or "no figure changes")
    elif not options.write:
        print(as_text(now), end="")
    return 0


if __name__ == "__main__":
    sys.exit(main())
