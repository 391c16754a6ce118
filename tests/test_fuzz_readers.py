"""A short run of the fuzzer of every reader; the long one is `python3 build.py fuzz 60`."""

from benchmarks.fuzzing.readers import READERS
from benchmarks.fuzzing.run import together, trial
from benchmarks.fuzzing.seeds import SEEDS, seeds_of

# Mutants of each that are looked at beside all that once failed.
MORE = 25


def test_every_reader_has_seeds():
    assert READERS.keys() == SEEDS.keys()


def test_mutants_are_read_or_refused(tmp_path):
    """All that once failed, and some more."""
    found = together(list(READERS), 3, 60.0, MORE, tmp_path)
    assert not [text for outcome in found.values() for text in outcome.found]
    assert {reader: outcome.done for reader, outcome in found.items()} == {reader: len(seeds_of(reader)) + MORE for reader in READERS}


def test_what_breaks_the_property_is_found(tmp_path, monkeypatch):
    """The harness itself: exceptions, deaths, and what is written elsewhere."""
    (tmp_path / "sitecustomize.py").write_text(
        "import os\nfrom benchmarks.fuzzing import readers\n"
        "def bad(path):\n    data = path.read_bytes()\n    if len(data) % 3 == 0: raise KeyError('x')\n"
        "    if len(data) % 3 == 1: open('/tmp/rvwear-elsewhere', 'w').close()\n    os.kill(os.getpid(), 11) if len(data) % 7 == 1 else None\n"
        "readers.READERS['duty'] = ('a.toml', bad)\n", encoding="utf-8")  # fmt: skip
    monkeypatch.setattr("benchmarks.fuzzing.run.MOST_DEATHS", 2)
    monkeypatch.setattr("benchmarks.fuzzing.run.PATH", (str(tmp_path),))
    said = together(("duty", "lives"), 1, 60.0, 60, tmp_path / "together")["duty"].found
    assert any("KeyError" in text for text in said) and any("the process died: signal 11" in text for text in said), said
    outcome = trial("duty", 1, 60.0, 60, tmp_path / "fuzz")
    assert all(any(said in text for text in outcome.found) for said in ("KeyError", "elsewhere: open /tmp/rvwear-elsewhere", "the process died: signal 11")), outcome.found
