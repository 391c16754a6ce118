"""One reducer: a crank turn, the stiffness test, natural frequencies, a life."""

import warnings
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import pandas as pd
import xarray as xr

from discrepancy.named_reducer import named_reducer
from fmu_src.faults import BeyondRated
from orchestrator import netcdf
from orchestrator.settings import Setting, parse_setting
from reducers.reducer import Reducer

if TYPE_CHECKING:
    from studies.duty import Segment

# A variable of the units by its structured name, and its value: a number in SI, a choice's name, or a text with a unit.
Settings = Mapping[str, float | str]
ReducerLike = Reducer | str | Path


def reducer_of(reducer: ReducerLike) -> Reducer:
    return reducer if isinstance(reducer, Reducer) else named_reducer(reducer)


def settings_of(reducer: Reducer, settings: Settings) -> list[Setting]:
    return [parse_setting(f"{name}={value}", [reducer.plant, reducer.wear]) for name, value in settings.items()]


def warn_of_overload(reducer: Reducer, settings: "Sequence[Setting]", duty: "Sequence[Segment]" = ()) -> None:
    """BeyondRated, at the line that called ``solve``, ``hysteresis`` or ``life``."""
    from studies.overload import overload

    if beyond := overload(reducer, settings, duty):
        warnings.warn(str(beyond), BeyondRated, stacklevel=3)


def solve(reducer: ReducerLike = "RV20E-121", *, settings: Settings | None = None, positions: int = 72) -> xr.Dataset:
    """Forces, pressure, errors and stiffness over one crank turn, without wear.

    ``reducer``: a name of the library, a reducer or model file, or what ``load_reducer`` gave.  ``settings``: any parameter or input, as
    ``{"output.load_torque": "150 N.m", "errors.pin.radius[3]": "2 um"}``; a number alone is in SI units (docs/variables.md).
    ``positions``: equilibria per crank turn, at least 8.

    Series over ``position`` with the coordinate ``crank_angle`` [deg], arrays over ``disc``, ``pin``, ``crank`` and ``roller``; single numbers
    named with their unit.  Every variable has ``units`` and ``long_name``.  InputFault names what is wrong with a file or setting; the warning
    ``BeyondRated`` says of a torque beyond 5 times the rated one what is then untrue, here and in ``hysteresis`` and ``life``.

    >>> import rvwear
    >>> turn = rvwear.solve("RV20E-121", settings={"output.load_torque": "167 N.m"}, positions=24)
    >>> turn["mesh_force"].dims
    ('position', 'disc', 'pin')
    >>> round(turn["peak_pin_force_N"].item())
    299
    >>> turn["lag"].attrs["units"]
    'arcsec'
    """
    from studies.turn import crank_turn

    chosen = reducer_of(reducer)
    parsed = settings_of(chosen, settings or {})
    warn_of_overload(chosen, parsed)
    return crank_turn(chosen, parsed, positions).dataset()


def hysteresis(
    reducer: ReducerLike = "RV20E-121", *, settings: Settings | None = None, steps: int = 16, angles: int = 16, locked_at: float | str | None = None,
) -> xr.Dataset:  # fmt: skip
    """The stiffness test: input locked, torque up and down both ways.

    ``steps``: torques per quarter of the loop; ``angles``: positions of the input, over a turn of the cranks, of which it is the mean;
    ``locked_at``: in their place the one angle of the input at which it is locked (``"90 deg"``; a number is in rad), 0 being where an FMU begins.
    ``torque`` [N.m] and ``turning`` [arcmin] over ``step``, and what is read from them: lost motion at 3 % of the torque, stiffness between
    half and all of it, area of the loop.

    >>> import rvwear
    >>> loop = rvwear.hysteresis("RV20E-121", steps=8, angles=1)
    >>> f"{loop['torsional_stiffness_Nm_per_arcmin'].item():.3g} N.m/arcmin"
    '50.2 N.m/arcmin'
    """
    from discrepancy.campaign.amount import amount
    from studies.hysteresis import hysteresis as measure
    from studies.turn import loop_dataset

    chosen = reducer_of(reducer)
    at = amount(locked_at, "rad", "locked_at") if isinstance(locked_at, str) else locked_at
    parsed = settings_of(chosen, settings or {})
    warn_of_overload(chosen, parsed)
    return loop_dataset(chosen, measure(chosen, parsed, steps, angles, at))


def modes(reducer: ReducerLike = "RV20E-121", *, settings: Settings | None = None, held: bool = True) -> pd.DataFrame:
    """Natural frequencies under load, with the input ``held`` or free to turn with its inertia: a row a mode.

    Columns ``frequency_Hz``, ``damping_ratio``, and the share of each body in the kinetic energy (0 to 1), lowest frequency first.

    >>> import rvwear
    >>> found = rvwear.modes("RV20E-121")
    >>> bool(found["frequency_Hz"].is_monotonic_increasing)
    True
    """
    from studies.modes import modes as natural_modes

    chosen = reducer_of(reducer)
    found = natural_modes(chosen, settings_of(chosen, settings or {}), held)
    return pd.DataFrame([{"frequency_Hz": mode.frequency_Hz, "damping_ratio": mode.damping_ratio, "moves": mode.moves} | mode.energy_share for mode in found])


def life(
    reducer: ReducerLike = "RV20E-121", hours: float = 10_000.0, *, settings: Settings | None = None, duty: str | Path | None = None, tolerance: float = 0.01,
    positions: int = 72, progress: Callable[[float], None] | None = None,
) -> xr.Dataset:  # fmt: skip
    """Wear over operating hours, by jumps whose error is controlled.

    ``tolerance``: error of the depths over those at the end; ``duty``: a file of speeds and torques with their shares; ``progress`` is told the
    hours reached after each jump.  The dataset is that of ``rvwear life``: figures, crank turns and worn surfaces over ``hour``, orders of the
    transmission error when new and at the end.  InputFault, or RunFault where a run cannot go on.

    >>> import rvwear
    >>> lived = rvwear.life("RV20E-121", hours=100, tolerance=0.2, positions=24)
    >>> bool(lived["disc_flank_um"][-1] > 0)
    True
    >>> lived["disc_wear"].dims
    ('hour', 'disc', 'lobe', 'flank_bin')
    """
    from studies.duty import load_duty
    from studies.kept_life import WantedLife, whole_life
    from studies.life import LifeSettings

    chosen = reducer_of(reducer)
    segments = load_duty(duty) if duty is not None else ()
    parsed = settings_of(chosen, settings or {})
    wanted = WantedLife(chosen, parsed, LifeSettings(hours, tolerance), positions, segments)
    warn_of_overload(chosen, parsed, segments)
    return whole_life(wanted, lambda state: progress(state.hours[-1]) if progress else None)


def read(path: str | Path) -> xr.Dataset:
    """A result file (.nc) of ``rvwear life`` or ``rvwear run``; InputFault if it is none, or damaged."""
    return netcdf.read(Path(path))
