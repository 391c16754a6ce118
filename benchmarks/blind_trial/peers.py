"""The same campaigns put through methods that others use: BIC with white noise, PySINDy, selection as PEtab Select does it, sbi's tests.

All get the residual of the calibrated base model and the same library: the response of every candidate at
every shape of its grid, by finite differences.  Those that name terms do not know the noise from replicates; sbi's tests, which
name nothing, do (``misspecified.py``).
"""

import contextlib
import tempfile
import time
import warnings
from collections.abc import Callable, Iterable
from importlib.util import find_spec
from pathlib import Path

import numpy as np

from benchmarks.blind_trial import misspecified
from benchmarks.blind_trial.library import Library, Owners, library_of
from fmu_src.arrays import Floats

MOST_TERMS = 5


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
            before = min(known.values(), default=np.inf)
            for model in iteration["uncalibrated_models"]:
                on = tuple(p for p, value in model.parameters.items() if value == ESTIMATE)
                chosen = [i for p in on for i in use[p]]
                known[on] = criterion(squares(residual, np.column_stack([free, columns[:, chosen]])), n, free.shape[1] + len(chosen), kind)
                model.set_criterion(Criterion[kind], known[on])
            ended = ui.end_iteration(problem, iteration["candidate_space"], iteration["uncalibrated_models"])
            space = ended["candidate_space"]
            # Where nothing was better it would go on through all models of each size.
            if ended["terminate"] or min(known.values(), default=np.inf) >= before or max(map(len, known), default=0) > MOST_TERMS:
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


Method = Callable[[Library], list[str]]
METHODS: dict[str, Method] = {
    "BIC, white noise": lambda given: forward(given.residual, given.nuisances, given.columns, given.owners, "BIC", 1),
    "PEtab Select, forward by AIC": lambda given: petab(given.residual, given.nuisances, given.columns, given.owners, "AIC"),
    "PEtab Select, forward by BIC": lambda given: petab(given.residual, given.nuisances, given.columns, given.owners, "BIC"),
    "PySINDy STLSQ": lambda given: sparse(given.residual, given.nuisances, given.columns, given.owners),
    "sbi, misspecification by MMD": misspecified.by_discrepancy,
    "sbi, misspecification by density": misspecified.by_density,
}


# What they need beside this project's packages, by the names with which they are installed.
PACKAGES = {"pysindy": "pysindy", "petab-select": "petab_select", "sbi": "sbi"}


def lacking() -> str:
    """What must be installed before all methods can be asked; empty if nothing."""
    absent = [package for package, module in PACKAGES.items() if find_spec(module) is None]
    return f"peers are not installed: pip install {' '.join(absent)}" if absent else ""


def peers_of(folder: Path, methods: Iterable[str] = METHODS) -> dict[str, list[str]]:
    """Names by method, best first; empty: nothing is missing; ``UNKNOWN`` alone: something is, said without a name.  Methods that are not
    installed are left out."""
    started = time.perf_counter()
    found: dict[str, list[str]] = {}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            given = library_of(folder)
        except Exception as problem:  # noqa: BLE001
            return {"error": [str(problem)[:200]]}
        for name in methods:
            with contextlib.suppress(ImportError):
                found[name] = METHODS[name](given)
    found["seconds"] = [f"{time.perf_counter() - started:.1f}"]
    return found
