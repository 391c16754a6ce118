"""A short run of the fuzzer of every reader; the long one is `python3 build.py fuzz 60`."""

import pytest

from benchmarks.fuzzing.readers import READERS
from benchmarks.fuzzing.run import trial
from benchmarks.fuzzing.seeds import SEEDS, seeds_of

# Each process takes seconds to import what it reads with: several readers of one kind are as much as one of each.
IN_SHORT = ("reducer", "model", "campaign", "scenario", "mat", "mdf", "ssp", "description", "reference_netcdf", "result", "forged_checkpoint", "lives")


def test_every_reader_has_seeds():
    assert READERS.keys() == SEEDS.keys()


@pytest.mark.parametrize("reader", IN_SHORT)
def test_mutants_are_read_or_refused(reader, tmp_path):
    """All that once failed, and some more."""
    count = len(seeds_of(reader)) + 25
    outcome = trial(reader, 3, 60.0, count, tmp_path)
    assert not outcome.found, "\n".join(outcome.found)
    assert outcome.done > len(seeds_of(reader))


def test_what_breaks_the_property_is_found(tmp_path, monkeypatch):
    """The harness itself: exceptions, deaths, and what is written elsewhere."""
    (tmp_path / "sitecustomize.py").write_text(
        "import os\nfrom benchmarks.fuzzing import readers\n"
        "def bad(path):\n    data = path.read_bytes()\n    if len(data) % 3 == 0: raise KeyError('x')\n"
        "    if len(data) % 3 == 1: open('/tmp/rvwear-elsewhere', 'w').close()\n    os.kill(os.getpid(), 11) if len(data) % 7 == 1 else None\n"
        "readers.READERS['duty'] = ('a.toml', bad)\n", encoding="utf-8")  # fmt: skip
    monkeypatch.setattr("benchmarks.fuzzing.run.MOST_DEATHS", 2)
    monkeypatch.setattr("benchmarks.fuzzing.run.PATH", (str(tmp_path),))
    outcome = trial("duty", 1, 60.0, 60, tmp_path / "fuzz")
    assert all(any(said in text for text in outcome.found) for said in ("KeyError", "elsewhere: open /tmp/rvwear-elsewhere", "the process died: signal 11")), outcome.found
