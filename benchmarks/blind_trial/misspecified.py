"""Whether the base model is misspecified at all, by the two tests of sbi (simulation-based inference); they name nothing.

What was measured is one draw; what the model would give is simulated: noise with the spectrum of the deviations among repetitions
(their phases drawn anew; white where no run is repeated), calibrated as the measured data were.  Both judge at sbi's level of 5 %.

- *MMD* (Schmitt et al. 2021): maximum mean discrepancy with a Gaussian kernel between the draw and the simulations, against that
  among simulations.
- *density*: a normalising flow learns the distribution of a few summaries of the simulations, and a draw whose density is low among
  theirs is refused.  Summaries are the data along the strongest directions of all candidates together, and what is left of each.
"""

import contextlib
import io
import tempfile
from typing import Any

import numpy as np

from benchmarks.blind_trial.library import Library
from benchmarks.blind_trial.words import UNKNOWN
from fmu_src.arrays import Floats

LEVEL = 0.05
SEED = 20_261_125
DRAWS, TRAINING, SHUFFLES, DIRECTIONS = 200, 2_000, 1_000, 10


def simulated(given: Library, count: int) -> tuple[Floats, Floats]:
    """(measured (1, n), simulated (count, n)) in units of the noise, what may be calibrated taken out of both."""
    known = told(given)
    size = given.noise[known]
    basis = np.linalg.qr(given.nuisances[known] / size[:, None])[0]
    rng = np.random.default_rng(SEED)
    noise = np.hstack([alike(d, count, rng) for d in given.deviations])[:, known]
    draws = np.vstack([given.residual[known] / size, noise])
    draws -= (draws @ basis) @ basis.T
    return draws[:1], draws[1:]


def told(given: Library) -> Any:
    """Of which values the noise is known."""
    return np.isfinite(given.noise) & (given.noise > 0.0)


def alike(deviations: Floats, count: int, rng: np.random.Generator) -> Floats:
    """(count, n): noise of the spectrum of one of the rows (k, n), drawn anew each time; white if there is none."""
    n = deviations.shape[1]
    if not len(deviations):
        return rng.standard_normal((count, n))
    waves = np.fft.rfft(deviations[rng.integers(len(deviations), size=count)])
    phases = np.exp(2j * np.pi * rng.random(waves.shape))
    # What has no phase keeps a sign of its own.
    phases[:, 0] = np.sign(phases[:, 0].real)
    if n % 2 == 0:
        phases[:, -1] = np.sign(phases[:, -1].real)
    return np.fft.irfft(waves * phases, n)


def seeded() -> Any:
    import torch

    torch.manual_seed(SEED)
    return torch


def by_discrepancy(given: Library) -> list[str]:
    torch = seeded()
    from sbi.diagnostics.misspecification import calc_misspecification_mmd

    measured, draws = simulated(given, DRAWS)
    if not measured.size:
        return []
    p, _ = calc_misspecification_mmd(torch.as_tensor(measured), torch.as_tensor(draws), n_shuffle=SHUFFLES, max_samples=DRAWS)
    return [UNKNOWN] if p < LEVEL else []


def by_density(given: Library) -> list[str]:
    torch = seeded()
    from sbi.diagnostics.misspecification import calc_misspecification_logprob
    from sbi.inference import MarginalTrainer

    known = told(given)
    if not known.any():
        return []
    directions = np.linalg.svd(given.columns[known] / given.noise[known, None], full_matrices=False)[0][:, :DIRECTIONS]
    measured, draws = (torch.as_tensor(summaries(x, directions), dtype=torch.float32) for x in simulated(given, TRAINING))
    # Its log of the training and its progress go where nobody looks.
    with tempfile.TemporaryDirectory() as folder, contextlib.chdir(folder), contextlib.redirect_stdout(io.StringIO()):
        half = len(draws) // 2
        flow = MarginalTrainer("maf", show_progress_bars=False).append_samples(draws[:half]).train()
        _, refused = calc_misspecification_logprob(draws[half:], measured, flow, alpha=LEVEL)
    return [UNKNOWN] if bool(refused) else []


def summaries(draws: Floats, directions: Floats) -> Floats:
    """(m, k + 1): along each direction, and the logarithm of the mean square of what is left."""
    along = draws @ directions
    left = draws - along @ directions.T
    return np.column_stack([along, np.log(np.mean(left**2, axis=1))])
