"""A life on the page: its curves as they grow, its report at the end; paused and gone on with like ``rvwear life --resume``."""

import math
import shlex
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fmu_src.faults import InputFault
from fmu_src.held_file import held
from reducers.library import LIBRARY
from workbench.folder import Folder
from workbench.told import write_json

if TYPE_CHECKING:
    from fmu_src.table import Table
    from reducers.reducer import Reducer

# What is drawn, by the names of a life's figures: title and unit; those of one pane together.
PANES = (
    ("depth", "µm", (("disc_flank_um", "flank"), ("pin_um", "pin"), ("inner_raceway_um", "inner raceway"), ("outer_raceway_um", "outer raceway"))),
    ("lag of the carrier", "arcsec", (("mean_lag_arcsec", "lag"),)),
    ("transmission error, peak to peak", "arcsec", (("transmission_error_pp_arcsec", "transmission error"),)),
    ("torsional stiffness", "N·m/arcmin", (("torsional_stiffness_Nm_per_arcmin", "stiffness"),)),
)  # fmt: skip
MOST_HOURS = 1e6


def life(folder: Folder, given: dict[str, Any], jobs: int, place: Path) -> bool:
    """True where it was paused: what it has is kept, and the same request goes on."""
    from discrepancy.model_file import load_model
    from orchestrator.settings import parse_setting
    from studies.kept_life import Paused, WantedLife, belongs_to, checkpoint_of, live_to
    from studies.life import Life, LifeSettings
    from studies.report import write_report

    file = load_model(folder.model(given))
    tables = [file.reducer.plant, file.reducer.wear]
    hours = number(given, "hours", 10_000.0)
    texts = [f"{written(tables, name)}={value!r}" for name, value in file.values().items() if written(tables, name)]
    texts += [f"output.load_torque={torque!r}N.m" for torque in [number(given, "torque", math.nan)] if math.isfinite(torque)]
    settings = [parse_setting(text, tables) for text in texts]
    wanted = WantedLife(file.reducer, settings, LifeSettings(hours))
    path = folder.root / "results" / f"{file.name}_life.nc"
    path.parent.mkdir(exist_ok=True)
    before: dict[str, Any] = {}
    now: dict[str, Any] = {}

    def tell(state: Life) -> None:
        nonlocal before, now
        if now and now["jumps"] != state.jumps:
            before = now
        now = curves(state.hours, state.figures) | {"jumps": state.jumps, "model": str(given["model"]), "until": hours}
        write_json(place / "live.json", {"now": now, "before": before})

    with held(path):
        checkpoint = checkpoint_of(path)
        try:
            dataset = live_to(path, wanted, checkpoint.exists() and belongs_to(checkpoint, wanted.inputs), tell)
        except Paused:
            return True
    write_report(dataset, place / "report.html")
    figures = [{name: float(dataset[name][i]) for _, _, lines in PANES for name, _ in lines} for i in range(dataset.sizes["hour"])]
    write_json(place / "result.json", {
        **curves([float(h) for h in dataset["hour"].values], figures), "model": str(given["model"]), "file": path.relative_to(folder.root).as_posix(),
        "title": dataset.attrs["title"], "command": command(folder, file.reducer, hours, texts, path),
    })  # fmt: skip
    return False


def curves(hours: list[float], figures: list[dict[str, float]]) -> dict[str, Any]:
    """Of each pane its lines over the hours."""
    return {
        "hours": list(hours),
        "panes": [{"title": title, "unit": unit, "lines": [{"name": text, "values": [f[name] for f in figures]} for name, text in lines]}
                  for title, unit, lines in PANES],
    }  # fmt: skip


def number(given: dict[str, Any], name: str, usual: float) -> float:
    """A positive number of the form; ``usual`` where nothing is given."""
    text = str(given.get(name) or "").strip().replace(",", ".")
    if not text:
        return usual
    try:
        value = float(text)
    except ValueError:
        raise InputFault(f"{name}: {text!r} is no number") from None
    if not 0.0 < value <= MOST_HOURS:
        raise InputFault(f"{name} = {text}: must lie above 0, up to {MOST_HOURS:g}")
    return value


def written(tables: "Sequence[Table]", name: str) -> str:
    """What a setting calls the variable (or its element); empty for one of the measuring chain, which no life has."""
    base, bracket, rest = name.partition("[")
    variable = next((t.by_name[base] for t in tables if base in t.by_name), None)
    return variable.path + bracket + rest if variable else ""


def command(folder: Folder, reducer: "Reducer", hours: float, texts: list[str], path: Path) -> str:
    """The command line that does the same: effects and settings of the model as settings."""
    known = reducer.name if reducer.path.parent == LIBRARY else str(reducer.path)
    words = ["rvwear", "life", "--reducer", known, "--hours", f"{hours:g}"]
    for text in texts:
        words += ["--set", text]
    return shlex.join([*words, "--output", str(path)])
