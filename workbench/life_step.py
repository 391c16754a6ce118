"""A life on the page: its curves as they grow, its report at the end; paused and gone on with like ``rvwear life --resume``."""

import shlex
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fmu_src.faults import InputFault
from fmu_src.file_name import file_name
from fmu_src.held_file import held
from fmu_src.units import conversion
from studies.figure_units import HELD_IN_LIVES, OVER_TURN, RUNNING, WHAT_IS_OVER_TURN
from workbench.folder import Folder
from workbench.form import SPEED, exactly, in_unit, number
from workbench.told import write_json

if TYPE_CHECKING:
    from discrepancy.model_file import ModelFile
    from reducers.reducer import Reducer
    from studies.life import Life

# What is drawn, by the names of a life's figures: title and unit; those of one pane together.
PANES = (
    ("depth", "µm", (("disc_flank_um", "flank"), ("pin_um", "pin"), ("inner_raceway_um", "inner raceway"), ("outer_raceway_um", "outer raceway"))),
    ("lag over a crank turn", "arcsec", (("mean_lag_arcsec", "lag"),)),
    ("transmission error", "arcsec", ((OVER_TURN, "transmission error, peak to peak"),)),
    ("lost motion, input held", "arcmin", (("lost_motion_arcmin", "lost motion"),)),
    ("torsional stiffness, running", "N m/arcmin", (("torsional_stiffness_Nm_per_arcmin", "running stiffness"),)),
)  # fmt: skip
# Until the life ends nobody goes round a turn of the output at the hour that was reached.
LATEST = "the latest transmission error is one of earlier hours, until the life ends"
# Of hours, of a torque [N m] and of a speed [rpm].
USUAL_HOURS, MOST = 10_000.0, 1e6


def life(folder: Folder, given: dict[str, Any], jobs: int, place: Path) -> bool:
    """True where it was paused: what it has is kept, and the same request goes on."""
    from discrepancy.model_file import load_model
    from discrepancy.named_reducer import reducer_of_model
    from orchestrator.settings import parse_setting
    from studies.kept_life import Paused, WantedLife, belongs_to, checkpoint_of, live_to
    from studies.life import Life, LifeSettings
    from studies.report import write_report

    file = load_model(folder.model(given))
    reducer = reducer_of_model(file)
    hours = positive(given, "hours") or USUAL_HOURS
    texts = settings_of(given)
    settings = [parse_setting(text, [reducer.plant, reducer.wear]) for text in texts]
    wanted = WantedLife(reducer, settings, LifeSettings(hours))
    path = folder.root / "results" / f"{file_name(reducer.name)}_life.nc"
    path.parent.mkdir(exist_ok=True)
    at = duty_words(reducer, given)
    before: dict[str, Any] = {}
    now: dict[str, Any] = {}

    def tell(state: Life, ended: bool = False) -> None:
        nonlocal before, now
        if now and now["pass"] != state.passes:
            before = now
        now = so_far(state, ended) | {"model": str(given["model"]), "until": hours, "at": at}
        write_json(place / "live.json", {"now": now, "before": before})

    with held(path):
        checkpoint = checkpoint_of(path)
        try:
            dataset = live_to(path, wanted, checkpoint.exists() and belongs_to(checkpoint, wanted.inputs), tell, lambda state: tell(state, True))
        except Paused:
            return True
    write_report(dataset, place / "report.html")
    figures = [{name: float(dataset[name][i]) for _, _, lines in PANES for name, _ in lines} for i in range(dataset.sizes["hour"])]
    write_json(place / "result.json", {
        **curves([float(h) for h in dataset["hour"].values], figures), "model": str(given["model"]), "file": path.relative_to(folder.root).as_posix(),
        "title": dataset.attrs["title"], "at": at, "command": command(file, hours, texts, path),
        "size": (place / "report.html").stat().st_size,
    })  # fmt: skip
    return False


def so_far(state: "Life", ended: bool) -> dict[str, Any]:
    """Curves of the present pass, which it is and why; ``ended``: as the result has them."""
    from studies.passes import again_line, before_of

    figures = [known | {OVER_TURN: swing} for known, swing in zip(state.figures, state.over_turn_at_hours())]
    drawn = curves(state.hours, figures)
    if not ended:
        drawn["how"] += f"; {LATEST}"
    why = again_line(state, before_of(state)) if state.passes > 1 else ""
    return drawn | {"jumps": state.jumps, "pass": state.passes, "why": why, "ended": ended}


def curves(hours: list[float], figures: list[dict[str, float]]) -> dict[str, Any]:
    """Of each pane its lines over the hours, and over what they are read."""
    return {
        "hours": list(hours), "how": f"{WHAT_IS_OVER_TURN}; {RUNNING}; {HELD_IN_LIVES}",
        "panes": [{"title": title, "unit": unit, "lines": [{"name": text, "values": [f[name] for f in figures]} for name, text in lines]}
                  for title, unit, lines in PANES],
    }  # fmt: skip


def settings_of(given: dict[str, Any]) -> list[str]:
    """Load and speed of the form, as the command takes them; what is not given stays as the file has it."""
    torque, speed = positive(given, "torque"), positive(given, "speed", SPEED)
    return [*([f"output.load_torque={torque!r}N.m"] if torque else []), *([f"input.speed={speed!r}{SPEED}"] if speed else [])]


def duty_words(reducer: "Reducer", given: dict[str, Any]) -> str:
    """Torque and speed that a life runs at, of the form or as the file has them."""
    torque = positive(given, "torque") or abs(reducer.starts["load_torque"])
    speed = positive(given, "speed", SPEED) or abs(reducer.starts["input_speed"]) * conversion("rad/s", SPEED)[0]
    return f"{torque:,.4g} N m on the output, {speed:,.4g} {SPEED} of the sun"


def positive(given: dict[str, Any], name: str, unit: str = "") -> float | None:
    """A number of the form, in ``unit`` or with one of its own; None where nothing is given."""
    text = str(given.get(name) or "").strip()
    if not text:
        return None
    value = in_unit(text, unit, name) if unit else number(text, name)
    if not 0.0 < value <= MOST:
        raise InputFault(f"{name} = {text}: must lie above 0, up to {MOST:g}")
    return value


def command(file: "ModelFile", hours: float, texts: list[str], path: Path) -> str:
    """The command line that does the same: of a model file, a reducer file or a reducer of the library."""
    known = str(file.path or file.reducer.as_named)
    words = ["rvwear", "life", "--reducer", known, "--hours", exactly(hours)]
    for text in texts:
        words += ["--set", text]
    return shlex.join([*words, "--output", str(path)])
