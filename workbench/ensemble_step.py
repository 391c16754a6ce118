"""Many lives on the page: parts, load and coefficients that scatter, as bands over the hours that narrow life by life."""

import shlex
import time
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from fmu_src.checked_file import write_text
from fmu_src.faults import InputFault, MissingPart
from fmu_src.held_file import held
from fmu_src.progress import task
from pages.words import units_in_print
from workbench.folder import Folder
from workbench.form import number, settings_of, whole
from workbench.told import write_json

if TYPE_CHECKING:
    from studies.ensemble.ensemble_file import Ensemble
    from studies.ensemble.figures import Outcome

FILE = "ensemble.toml"
# How often the page is told [s].
OFTEN = 1.0
# Of the optional part "ensembles".
NEEDED = ("SALib", "dask", "distributed", "joblib")


def ensemble(folder: Folder, given: dict[str, Any], jobs: int, place: Path) -> bool:
    """What the form says becomes ensemble.toml; lives that are there already are kept."""
    try:
        return lives(folder, given, jobs, place)
    except ModuleNotFoundError as missing:
        if missing.name is None or missing.name.partition(".")[0] not in NEEDED:
            raise
        raise MissingPart("an ensemble", missing.name, "ensembles") from None


def lives(folder: Folder, given: dict[str, Any], jobs: int, place: Path) -> bool:
    from fmu_src.source_hash import source_hash
    from studies.ensemble.backends import through_joblib
    from studies.ensemble.bands import kept
    from studies.ensemble.ensemble_file import load_ensemble
    from studies.ensemble.member import run
    from studies.ensemble.sampling import tasks_of
    from studies.ensemble.store import Store
    from studies.ensemble.summary import summarise

    file = folder.root / FILE
    write_text(file, text_of(folder, given))
    drawn = load_ensemble(file)
    tasks = tasks_of(drawn)
    path = folder.root / "results" / "ensemble.json"
    with held(path):
        identity = drawn.identity() | {"source_hash": source_hash()}
        store = opened(Store, path.with_suffix(".lives"), identity)
        missing = [one for one in tasks if one.number not in store.lives]
        arriving = through_joblib(run, missing, jobs)
        told = 0.0
        stopped = False
        try:
            with task("lives", total=len(missing)) as living:
                for life in arriving:
                    living.advance(int(store.add(life)))
                    if time.monotonic() - told > OFTEN:
                        told = time.monotonic()
                        write_json(place / "live.json", shown(drawn, store.lives, len(tasks)))
        except KeyboardInterrupt:
            arriving.close()
            stopped = True
        found = summarise(drawn, store.lives, len(tasks))
        write_json(path, kept(found, drawn, store.lives, len(tasks)))
    write_json(place / "result.json", {
        **shown(drawn, store.lives, len(tasks)), "summary": found, "file": path.relative_to(folder.root).as_posix(),
        "command": f"rvwear ensemble {shlex.quote(str(file))} --output {shlex.quote(str(path))}",
    })  # fmt: skip
    return stopped


def opened(store: Any, path: Path, identity: dict[str, Any]) -> Any:
    """The lives of this ensemble that are there; those of another one are put aside by beginning anew."""
    try:
        return store(path, identity)
    except InputFault:
        return store(path, identity, restart=True)


def shown(drawn: "Ensemble", found: "Mapping[int, Outcome]", planned: int) -> dict[str, Any]:
    """The bands in the page's units."""
    from studies.ensemble.bands import bands

    told = bands(drawn, found, planned)
    return told | {"panes": [pane | {"unit": units_in_print(pane["unit"])} for pane in told["panes"]]}


def text_of(folder: Folder, given: Mapping[str, Any]) -> str:
    """The file of the form; InputFault in its words."""
    reducer = folder.model(dict(given))
    rows = given.get("scatters") or []
    if not isinstance(rows, list) or not rows:
        raise InputFault("nothing scatters: add a number with its spread")
    samples = whole(given.get("samples"), "base samples")
    if samples < 2 or samples & (samples - 1):
        raise InputFault(f"base samples = {samples}: must be a power of two, 8 or 16 for instance")
    from discrepancy.model_file import load_model

    file = load_model(reducer)
    own = str(file.reducer.path.relative_to(folder.root)) if file.reducer.path.is_relative_to(folder.root) else file.reducer.name
    lines = [f'reducer = "{own}"', f"samples = {samples}", f"hours = {number(given.get('hours') or 10_000, 'hours')!r}"]
    settings = settings_of(file)
    lines += [f"settings = [{', '.join(f'{chr(34)}{text}{chr(34)}' for text in settings)}]"] if settings else []
    lines += ["", "[parameters]"]
    for row in rows:
        name, unit, kind = str(row.get("name", "")), str(row.get("unit") or "1"), str(row.get("distribution"))
        first, second = (number(row.get(k), f"{name}, {k} number") for k in ("first", "second"))
        keys = {"normal": ("mean", "deviation"), "uniform": ("low", "high"), "lognormal": ("median", "factor")}.get(kind)
        if keys is None or not is_name(name) or '"' in unit:
            raise InputFault(f"{name or 'what scatters'}: there is no such distribution or number")
        lines.append(f'{name} = {{ distribution = "{kind}", {keys[0]} = {first!r}, {keys[1]} = {second!r}, unit = "{unit}" }}')
    limits = {name: number(value, name) for name, value in dict(given.get("limits") or {}).items() if str(value).strip()}
    if wrong := next((name for name in limits if not is_name(name)), None):
        raise InputFault(f"{wrong}: there is no such limit")
    lines += ["", "[limits]", *(f"{name} = {value!r}" for name, value in limits.items())] if limits else []
    return "\n".join(lines) + "\n"


def is_name(name: str) -> bool:
    """Whether it may be that of a number; whether there is one is said where the file is read."""
    return bool(name) and all(c.isalnum() or c in "._[],*" for c in name)
