"""A life that is kept: its checkpoint after each jump, its result at the end; begun, or gone on with."""

from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import xarray as xr

from fmu_src.checked_file import Damaged, set_aside
from fmu_src.faults import InputFault
from fmu_src.progress import say, task
from fmu_src.source_hash import source_hash
from orchestrator import netcdf
from orchestrator.master import Master
from orchestrator.schemes import SCHEMES
from orchestrator.settings import Setting
from reducers.reducer import Reducer
from studies import results
from studies.checkpoint import load_checkpoint, save_checkpoint
from studies.coupled_master import CoupledMaster
from studies.duty import Segment
from studies.life import Life, LifeSettings, live
from studies.pair import make_pair
from studies.passes import pass_of
from studies.solve import require_positions


@dataclass(frozen=True)
class WantedLife:
    """What a life is to be of; ``fmus``: folder of units to step, or None for the kernels in this process."""

    reducer: Reducer
    settings: list[Setting]
    life: LifeSettings
    positions: int = 72
    duty: tuple[Segment, ...] = ()
    scheme: str = SCHEMES[0]
    fmus: Path | None = None
    inputs: dict[str, Any] = field(init=False)

    def __post_init__(self) -> None:
        """InputFault for numbers that make no life, and where the life sets what it chooses itself."""
        self.life.check()
        require_positions(self.positions)
        if any(setting.name == "acceleration" for setting in self.settings):
            raise InputFault("acceleration is chosen by the life run itself; give hours and tolerance")
        object.__setattr__(self, "inputs", {
            "reducer": self.reducer.name, "starts": self.reducer.starts, "settings": {s.name: s.value for s in self.settings},
            "life": vars(self.life).copy(), "duty": [vars(s) for s in self.duty], "scheme": self.scheme, "positions": self.positions,
            "units": "fmu" if self.fmus else "in process", "source_hash": source_hash(),
        })  # fmt: skip


class Paused(KeyboardInterrupt):
    """Interrupted at ``hours``; a checkpoint goes on from there."""

    def __init__(self, hours: float):
        super().__init__(f"at {hours:g} h")
        self.hours = hours


def checkpoint_of(path: Path) -> Path:
    return path.with_suffix(".checkpoint")


def belongs_to(checkpoint: Path, inputs: dict[str, Any]) -> bool:
    """Whether a run of these inputs left the checkpoint; a damaged one is moved aside, and said."""
    try:
        load_checkpoint(checkpoint, inputs)
    except Damaged as fault:
        say(f"{fault}: moved to {set_aside(checkpoint)}, the life starts anew")
        return False
    except InputFault:
        return False
    return True


def live_to(path: Path, wanted: WantedLife, resume: bool, progress: Callable[[Life], None], ended: Callable[[Life], None] | None = None) -> xr.Dataset:
    """The life from its beginning, or from its checkpoint, to the result at ``path``; ``Paused`` at Ctrl-C."""
    checkpoint = checkpoint_of(path)
    dataset = whole_life(wanted, progress, checkpoint, resume, ended)
    netcdf.write(dataset, path)
    checkpoint.unlink(missing_ok=True)
    return dataset


def whole_life(wanted: WantedLife, progress: Callable[[Life], None], checkpoint: Path | None = None, resume: bool = False,
               ended: Callable[[Life], None] | None = None) -> xr.Dataset:  # fmt: skip
    """The life; ``progress`` is told after each jump, ``ended`` what the result has.

    With a ``checkpoint`` it is kept there, and gone on with from there to ``resume``.
    """
    with task("loading the units"):
        # In this process many steps go into one compiled call.
        pair = make_pair(wanted.reducer, wanted.settings, wanted.fmus, wanted.scheme, wanted.positions, wanted.duty, Master if wanted.fmus else CoupledMaster)
    lived = Life(wanted.life)

    def keep(state: Life) -> None:
        if checkpoint:
            save_checkpoint(checkpoint, state, pair.master.save(), wanted.inputs)

    try:
        first_orders = results.order_spectrum(pair, 0.0)
        if checkpoint and resume:
            lived, saved = load_checkpoint(checkpoint, wanted.inputs)
            pair.master.restore(saved)
        lived.over_turn = lived.over_turn or [[0.0, swing] for swing in results.swings(first_orders).values()]
        with task("hours of life", total=round(wanted.life.hours)) as hours:

            def show(state: Life) -> None:
                # Before the count goes on: whoever sees it looks for what it is of.
                progress(state)
                # It begins again at 0 h with every run.
                hours.what = f"hours since new, {pass_of(state)}"
                hours.done = round(state.hours[-1])

            live(pair, lived, show, keep)
            last_orders = results.order_spectrum(pair, lived.hours[-1])
            lived.over_turn += [[hour, swing] for hour, swing in results.swings(last_orders).items()]
            if ended:
                ended(lived)
        return results.life_dataset(pair, lived, [first_orders, last_orders], wanted.inputs)
    except KeyboardInterrupt as interruption:
        raise Paused(lived.hours[-1] if lived.hours else 0.0) from interruption
    finally:
        pair.master.close()
