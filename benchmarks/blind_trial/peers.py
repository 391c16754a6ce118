"""The same campaigns put through methods that others use: BIC with white noise, PySINDy, selection as PEtab Select does it.

All get the residual of the calibrated base model and the same library: the response of every candidate at
every shape of its grid, by finite differences.  None of them knows the noise from replicates.
"""

import contextlib
import tempfile
import time
import warnings
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path

import numpy as np

from benchmarks.blind_trial.tool import model_of
from discrepancy.campaign.load import load_campaign
from discrepancy.prediction.physical_model import PhysicalModel
from discrepancy.problem import BASE, Record
from fmu_src.arrays import Floats

MOST_TERMS = 5
# Of every candidate the numbers of its columns.
Owners = list[tuple[str, list[int]]]


def library(folder: Path) -> tuple[Floats, Floats, Floats, Owners]:
    """(residual, nuisance columns, columns, [(candidate, its columns)]), quantities scaled to one residual size."""
    campaign = load_campaign(folder)
    model = PhysicalModel(model_of(campaign), campaign)
    which = [i for i, r in enumerate(model.records) if not r.held_out]
    records = [model.records[i] for i in which]
    values = {p.name: p.off for p in model.nuisances}
    quantities = [r.quantity for r in records]

    def stack(arrays: Iterable[Floats]) -> Floats:
        return np.concatenate([np.asarray(a, np.float64) for a in arrays])

    def difference(change: dict[str, float], base: list[Floats]) -> Floats:
        return stack([a - b for a, b in zip(model.predict({**values, **change}, which), base)])

    measured = stack([r.values for r in records])
    nuisances = []
    for _ in range(2):
        base = model.predict(values, which)
        residual = measured - stack(base)
        nuisances = [difference({p.name: values[p.name] + 0.01 * p.scale}, base) / (0.01 * p.scale) for p in model.nuisances]
        if not nuisances:
            break
        scale = np.array([p.scale for p in model.nuisances])
        weights = weights_of(residual, quantities, records)
        shift = np.linalg.lstsq(np.column_stack(nuisances) * scale * weights[:, None], residual * weights, rcond=None)[0] * scale
        values = {p.name: float(np.clip(values[p.name] + s, p.lower, p.upper)) for p, s in zip(model.nuisances, shift)}
    base = model.predict(values, which)
    residual = measured - stack(base)
    weights = weights_of(residual, quantities, records)
    columns: list[Floats] = []
    owners: Owners = []
    for c in (c for c in model.candidates if c.part != BASE):
        own = []
        for shapes in c.shape_grid or ({},):
            for p in c.amplitudes:
                step = 0.1 * p.scale * (-1.0 if p.sign < 0 else 1.0)
                column = difference({**shapes, p.name: p.off + step}, base) * weights
                size = np.linalg.norm(column)
                if size > 1e-9:
                    own.append(len(columns))
                    columns.append(column / size)
        if own:
            owners.append((c.name, own))
    ok = np.isfinite(residual)
    free = np.column_stack(nuisances)[ok] * weights[ok, None] if nuisances else np.zeros((ok.sum(), 0))
    return (residual * weights)[ok], free, np.column_stack(columns)[ok], owners


def weights_of(residual: Floats, quantities: Sequence[str], records: Sequence[Record]) -> Floats:
    """One over the size of the residual of a record's quantity: no quantity outweighs another by its unit."""
    sizes: dict[str, float] = {}
    parts: dict[str, list[Floats]] = {}
    start = 0
    for q, r in zip(quantities, records):
        parts.setdefault(q, []).append(residual[start : start + len(r.values)])
        start += len(r.values)
    for q, found in parts.items():
        sizes[q] = float(np.nanstd(np.concatenate(found))) or 1.0
    return np.concatenate([np.full(len(r.values), 1.0 / sizes[q]) for q, r in zip(quantities, records)])


def squares(residual: Floats, columns: Floats) -> float:
    if not columns.shape[1]:
        return float(residual @ residual)
    left = residual - columns @ np.linalg.lstsq(columns, residual, rcond=None)[0]
    return float(left @ left)


def criterion(rss: float, n: int, k: int, kind: str) -> float:
    """AIC or BIC of white normal noise of unknown size."""
    return float(n * np.log(max(rss, 1e-300) / n) + (np.log(n) if kind == "BIC" else 2.0) * (k + 1))


def best_of(residual: Floats, free: Floats, columns: Floats, own: list[int], chosen: list[int], groups: int) -> tuple[float, list[int]]:
    """Least squares of one candidate beside those chosen: its best shape."""
    found = (np.inf, own)
    for k in range(0, len(own), groups):
        use = own[k : k + groups]
        found = min(found, (squares(residual, np.column_stack([free, columns[:, chosen + use]])), use))
    return found


def forward(residual: Floats, free: Floats, columns: Floats, owners: Owners, kind: str, most: int) -> list[str]:
    """Candidates added while the criterion falls."""
    n = len(residual)
    names: list[str] = []
    chosen: list[int] = []
    now = criterion(squares(residual, free), n, free.shape[1], kind)
    while len(names) < most:
        trials = []
        for name, own in owners:
            if name not in names:
                rss, use = best_of(residual, free, columns, own, chosen, 1 if len(own) > 4 else len(own))
                trials.append((criterion(rss, n, free.shape[1] + len(chosen) + len(use), kind), name, use))
        best = min(trials)
        if best[0] >= now:
            break
        now, name, use = best
        names.append(name)
        chosen += use
    return names


def sparse(residual: Floats, free: Floats, columns: Floats, owners: Owners) -> list[str]:
    """PySINDy's STLSQ on the library, its threshold a tenth of what the best term alone would have."""
    from pysindy.optimizers import STLSQ

    if free.shape[1]:
        basis = np.linalg.qr(free)[0]
        residual = residual - basis @ (basis.T @ residual)
        columns = columns - basis @ (basis.T @ columns)
    owner = {i: name for name, own in owners for i in own}
    optimiser = STLSQ(threshold=float(0.1 * np.abs(columns.T @ residual).max()), alpha=0.05, max_iter=20)
    optimiser.fit(columns, residual[:, None])
    weights = np.abs(np.asarray(optimiser.coef_).ravel())
    names: dict[str, float] = {}
    for i in np.argsort(-weights):
        if weights[i] > 0.0:
            names.setdefault(owner[int(i)], float(weights[i]))
    return list(names)


def petab(residual: Floats, free: Floats, columns: Floats, owners: Owners, kind: str) -> list[str]:
    """PEtab Select's forward method over models in which every candidate is on or off; criteria by least squares."""
    from petab_select import ESTIMATE, Criterion, Problem, ui

    n = len(residual)
    use = {f"p{k}": best_of(residual, free, columns, own, [], 1 if len(own) > 4 else len(own))[1] for k, (_, own) in enumerate(owners)}
    names = {f"p{k}": name for k, (name, _) in enumerate(owners)}
    with tempfile.TemporaryDirectory() as folder:
        problem = Problem.from_yaml(write_problem(Path(folder), list(use), kind))
        space = None
        known: dict[tuple[str, ...], float] = {}
        while True:
            iteration = ui.start_iteration(problem, candidate_space=space)
            for model in iteration["uncalibrated_models"]:
                on = tuple(p for p, value in model.parameters.items() if value == ESTIMATE)
                chosen = [i for p in on for i in use[p]]
                known[on] = criterion(squares(residual, np.column_stack([free, columns[:, chosen]])), n, free.shape[1] + len(chosen), kind)
                model.set_criterion(Criterion[kind], known[on])
            ended = ui.end_iteration(problem, iteration["candidate_space"], iteration["uncalibrated_models"])
            space = ended["candidate_space"]
            if ended["terminate"] or max(map(len, known), default=0) > MOST_TERMS:
                break
    known[()] = criterion(squares(residual, free), n, free.shape[1], kind)
    best = min(known, key=lambda on: known[on])
    # The strongest first: what its removal would cost.
    return [names[p] for p in sorted(best, key=lambda p: known.get((p,), 0.0))]


def write_problem(folder: Path, parameters: list[str], kind: str) -> Path:
    """A selection problem whose only content is the model space: calibration is done here."""
    (folder / "petab.yaml").write_text(
        "format_version: 1\nparameter_file: parameters.tsv\nproblems:\n- sbml_files: []\n  condition_files: []\n"
        "  measurement_files: []\n  observable_files: []\n", encoding="utf-8")  # fmt: skip
    head = "parameterId\tparameterScale\tlowerBound\tupperBound\tnominalValue\testimate\n"
    (folder / "parameters.tsv").write_text(head + "".join(f"{p}\tlin\t-1\t1\t0\t1\n" for p in parameters), encoding="utf-8")
    row = "\t".join(["M", "petab.yaml", *("0;estimate" for _ in parameters)])
    (folder / "space.tsv").write_text("\t".join(["model_subspace_id", "model_subspace_petab_yaml", *parameters]) + f"\n{row}\n", encoding="utf-8")
    path = folder / "select.yaml"
    path.write_text(f"format_version: 1.0.0\ncriterion: {kind}\nmethod: forward\nmodel_space_files:\n- space.tsv\n", encoding="utf-8")
    return path


Method = Callable[[Floats, Floats, Floats, Owners], list[str]]
# What of each is not installed is left out.
METHODS: dict[str, Method] = {
    "BIC, white noise": lambda residual, free, columns, owners: forward(residual, free, columns, owners, "BIC", 1),
    "PEtab Select, forward by AIC": lambda residual, free, columns, owners: petab(residual, free, columns, owners, "AIC"),
    "PEtab Select, forward by BIC": lambda residual, free, columns, owners: petab(residual, free, columns, owners, "BIC"),
    "PySINDy STLSQ": sparse,
}


def peers_of(folder: Path, methods: Iterable[str] = METHODS) -> dict[str, list[str]]:
    """Names by method, best first; empty: nothing is missing."""
    started = time.perf_counter()
    found: dict[str, list[str]] = {}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            given = library(folder)
        except Exception as problem:  # noqa: BLE001
            return {"error": [str(problem)[:200]]}
        for name in methods:
            with contextlib.suppress(ImportError):
                found[name] = METHODS[name](*given)
    found["seconds"] = [f"{time.perf_counter() - started:.1f}"]
    return found
