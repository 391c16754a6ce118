"""Claims with the sources' numbers, kept between commands: what runs with other numbers are held against is computed once for all of them."""

import hashlib
import os
import pickle
from collections.abc import Callable
from functools import cache
from pathlib import Path

import numpy as np

from fmu_src import checked_file
from fmu_src.cache_folder import cache_folder
from fmu_src.source_hash import source_hash
from reproduce.claim import REGISTRY, Claim
from reproduce.context import Context

MARK = b"rvwear claim 1\n"
PARTS = ("reproduce", "studies", "pages", "orchestrator", "reducers", "rv_reducer", "rv_plant", "wear_fmu", "fmu_src")


def with_sources_numbers(name: str, context: Callable[[], Context]) -> Claim:
    """A claim as an earlier command of this program found it, else computed in what ``context`` makes."""
    content = checked_file.read(place_of(name), MARK)
    if content is not None:
        found = pickle.loads(content)  # noqa: S301 - one's own file in a private folder, and whole
        if isinstance(found, Claim):
            return found
    claim = REGISTRY[name](context())
    keep(claim)
    return claim


def keep(claim: Claim) -> None:
    """Keeps a claim that was computed with the sources' numbers."""
    checked_file.write(place_of(claim.id), MARK, pickle.dumps(claim, protocol=pickle.HIGHEST_PROTOCOL))


def place_of(name: str) -> Path:
    return cache_folder("claims") / hashlib.sha256(f"{name} {program()}".encode()).hexdigest()[:40]


@cache
def program() -> str:
    """All that a claim depends on: kernels that run as plain Python have other last digits."""
    return f"{source_hash(PARTS)} {np.__version__} {os.environ.get('RVWEAR_PLAIN_PYTHON', '')}"
