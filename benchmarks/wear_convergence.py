"""Wear to 10,000 h over positions, bins, and the tolerance of the life: the table of docs/decisions.md.

    python -m benchmarks.wear_convergence [--reducer RV20E-121-rigid] [--hours 10000]

Depths [um] of inner race, outer race and disc flank, deepest each; the last row lets races alone wear.
"""

import argparse
from dataclasses import replace

from orchestrator.settings import parse_setting
from reducers.reducer import load_reducer
from studies.coupled_master import CoupledMaster
from studies.life import Life, LifeSettings, live
from studies.pair import make_pair
from studies.wear_figures import wear_figures
from wear_fmu.variables import Resolution

FIGURES = ("inner_raceway_um", "outer_raceway_um", "disc_flank_um")
# As close to none as bounds let it be.
NO_FLANK_WEAR = "wear.mesh_coefficient=1e-15"
USUAL = Resolution()


def lived(name: str, *texts: str, hours: float = 10_000.0, positions: int = 72, tolerance: float = 0.03, resolution: Resolution = USUAL) -> dict[str, float]:
    """Depths after so many hours, with further settings ``texts`` (``NAME=VALUE``)."""
    reducer = replace(load_reducer(name), resolution=resolution)
    settings = [parse_setting(text, [reducer.plant, reducer.wear]) for text in texts]
    pair = make_pair(reducer, settings, positions=positions, master_kind=CoupledMaster)
    live(pair, Life(LifeSettings(hours, tolerance)), lambda _: None, lambda _: None)
    return wear_figures(pair.wear.record())


def rows(name: str, hours: float) -> list[tuple[str, dict[str, float]]]:
    """(what differs from the usual resolution, depths)."""
    def at(*texts: str, positions: int = 72, tolerance: float = 0.01, resolution: Resolution = USUAL) -> dict[str, float]:
        return lived(name, *texts, hours=hours, positions=positions, tolerance=tolerance, resolution=resolution)

    return [
        ("72 positions a turn, usual bins, tolerance 1 %", at()),
        *((f"{count} positions", at(positions=count)) for count in (36, 144, 288)),
        *((f"{bins} bins a race", at(resolution=replace(USUAL, raceway=bins))) for bins in (180, 720)),
        *((f"tolerance {100 * share:g} %", at(tolerance=share)) for share in (0.03, 0.003)),
        ("flanks and pins that do not wear", at(NO_FLANK_WEAR)),
    ]  # fmt: skip


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--reducer", default="RV20E-121-rigid")
    parser.add_argument("--hours", type=float, default=10_000.0, help="operating hours (default 10000)")
    options = parser.parse_args()
    for what, depths in rows(options.reducer, options.hours):
        print(f"{what:50}" + ", ".join(f"{name} {depths[name]:.3f}" for name in FIGURES))


if __name__ == "__main__":
    main()
