"""The compiler of kernels: what it makes of the subset, what it refuses, and that neither depends on what is on disk."""

import math
import os
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np
import pytest

from fmu_src import cache_folder as cache
from fmu_src import checked_file
from fmu_src.compiler import loading, store
from fmu_src.compiler.types import KernelFault
from fmu_src.kernel import kernel
from fmu_src.units import MARK

POINT = np.dtype([("x", "f8"), ("count", "i8"), ("row", "f8", (3,)), ("table", "f8", (2, 3))])
LIMIT, WEIGHTS = 3, (1.0, 0.5, 0.25)


@kernel
def total_and_largest(row):
    total, largest = 0.0, row[0]
    for i in range(row.shape[0]):
        total += row[i]
        largest = max(largest, row[i])
    return total, largest, row.shape[0]


@kernel
def read_backwards(row):
    """Whole numbers that fall below zero later than they are used, one through another."""
    found, i, last = 0.0, row.shape[0] - 1, 0
    j = 0
    for _ in range(row.shape[0] + 2):
        k = j
        found = 10.0 * found + row[k]
        j = last
        last = last - 1
    for i in range(row.shape[0] - 1, -1, -1):
        found = 10.0 * found + row[i]
    for i in range(2, -row.shape[0] - 1, -1):
        found = 10.0 * found + row[i]
    return found


@kernel
def steps_to_one(n):
    steps = 0
    while n != 1:
        n = n // 2 if n % 2 == 0 else 3 * n + 1
        steps += 1
    return steps


@kernel
def first_above(row, limit):
    for i in range(row.shape[0]):
        if row[i] > limit:
            break
    else:
        return -1
    return i


@kernel
def fill(r):
    discs, pins = r.table.shape
    for i in range(discs):
        row = r.table[i]
        for j in range(pins):
            row[j] = r.x * i + WEIGHTS[j]
    r.row[-1] = r.row[0] = 7.0
    r.count += LIMIT


@kernel
def of_all(records):
    total = 0.0
    for i in range(records.shape[0]):
        total += records[i].x
    return total


@kernel
def swapped(a, b):
    a, b = b, a
    return a, b, not 0.0 <= a < b or b == 2.0


def test_an_index_that_falls_below_zero_counts_from_the_end():
    row = np.array([1.0, 2.0, 3.0])
    assert read_backwards(row) == read_backwards.__wrapped__(row)


def test_numbers_arrays_and_tuples_go_in_and_come_out():
    row = np.array([1.0, 4.0, 2.0])
    assert total_and_largest(row) == (7.0, 4.0, 3)
    assert [type(v) for v in total_and_largest(row)] == [float, float, int]
    assert steps_to_one(27) == 111
    assert first_above(row, 1.5) == 1 and first_above(row, 9.0) == -1
    assert swapped(1.0, 2.0) == (2.0, 1.0, True) and swapped(3.0, 1.0) == (1.0, 3.0, False)


def test_a_tuple_of_one_is_a_tuple():
    @kernel
    def alone(x):
        return (2.0 * x,)

    @kernel
    def first(x):
        return alone(x)[0] + 1.0

    assert alone(1.5) == (3.0,)
    assert first(1.5) == 4.0


def test_records_are_read_and_written():
    points = np.zeros(2, POINT)
    points["x"] = 2.0, 5.0
    fill(points[1])
    assert points["table"][1].tolist() == [[1.0, 0.5, 0.25], [6.0, 5.5, 5.25]]
    assert points["row"][1].tolist() == [7.0, 0.0, 7.0]
    assert points["count"].tolist() == [0, 3]
    assert of_all(points) == 7.0


def test_a_variable_that_gets_whole_and_other_numbers_holds_both():
    @kernel
    def grown(n):
        x = 0
        for i in range(n):
            x = x + 0.5 * i
        return x

    assert grown(4) == 3.0


REFUSED = {
    "list": ("    return [a, a]", "no List"),
    "unknown name": ("    return tolerence", "there is no tolerence; did you mean tolerance"),
    "unknown field": ("    return a.hight", "did you mean height"),
    "slice": ("    return a.row[0:2]", "no slices"),
    "string": ("    b = 'text'\n    return 1.0", "no Constant: 'text'"),
    "raise": ("    raise ValueError('no')", "no raise"),
    "allocation": ("    return np.zeros(3)[0]", "np.zeros is no kernel"),
    "two meanings": ("    b = 1.0\n    b = a.row\n    return b", "b is a number here and an array of 1 dimension there; use two names"),
    "no value yet": ("    if a.height > 1.0:\n        pass\n    return b + 1.0\n    b = 2.0", "b is used before it has a value"),
    "fraction as index": ("    return a.row[0.5]", "an index must be a whole number"),
    "fraction in a whole field": ("    a.count = 0.5\n    return 1.0", "say int"),
    "not of math": ("    return math.gamma(a.height)", "no math.gamma"),
    "python function": ("    return sorted(a.height)", "sorted is no kernel"),
    "itself": ("    return refused(a)", "calls itself"),
}  # fmt: skip


@pytest.mark.parametrize("case", REFUSED)
def test_what_is_outside_of_the_subset_is_refused_with_its_line(tmp_path, monkeypatch, case):
    body, message = REFUSED[case]
    file = tmp_path / "refused_kernel.py"
    file.write_text(
        f"import math\nimport numpy as np\nfrom fmu_src.kernel import kernel\ntolerance = 1.0\n\n\n@kernel\ndef refused(a):\n{body}\n",
        encoding="utf-8",
    )
    monkeypatch.syspath_prepend(tmp_path)
    monkeypatch.delitem(sys.modules, "refused_kernel", raising=False)
    import refused_kernel

    record = np.zeros(1, [("height", "f8"), ("count", "i8"), ("row", "f8", (3,))])
    with pytest.raises(KernelFault, match="refused_kernel.py:(9|10|11): ") as fault:
        refused_kernel.refused(record[0])
    assert message in str(fault.value)


def test_arguments_that_no_kernel_takes_are_refused():
    with pytest.raises(TypeError, match="str is nothing that a kernel takes"):
        steps_to_one("27")
    with pytest.raises(TypeError, match="an array with gaps"):
        total_and_largest(np.zeros((4, 4))[:, 0])
    with pytest.raises(TypeError, match="an array of float32"):
        total_and_largest(np.zeros(4, "f4"))
    with pytest.raises(KernelFault, match="takes 1 arguments, not 2"):
        steps_to_one(1, 2)


# What is kept on disk.


@pytest.fixture
def kept(tmp_path, monkeypatch):
    """A cache of its own, as outside of a virtual environment; gives the folder of code."""
    monkeypatch.setattr(cache, "root", lambda: tmp_path)
    monkeypatch.setattr(sys, "prefix", sys.base_prefix)
    for known in (cache.cache_folder, store.folder):
        known.cache_clear()
    yield tmp_path / "code"
    for known in (cache.cache_folder, store.folder):
        known.cache_clear()


def test_code_is_kept_with_the_environment(kept, tmp_path, monkeypatch):
    monkeypatch.setattr(sys, "prefix", str(tmp_path / "environment"))
    assert compile_anew()
    assert entry_of(tmp_path / "environment" / "share" / "rvwear" / "code").is_file()
    assert not kept.exists()
    assert not compile_anew()


@pytest.mark.skipif(os.name != "posix", reason="modes of POSIX")
def test_in_an_environment_that_is_not_ones_own_code_is_kept_by_the_user(kept, tmp_path, monkeypatch, capsys):
    shared = tmp_path / "environment" / "share" / "rvwear" / "code"
    shared.mkdir(parents=True)
    shared.chmod(0o777)
    monkeypatch.setattr(sys, "prefix", str(tmp_path / "environment"))
    assert compile_anew()
    assert entry_of(kept).is_file() and not list(shared.iterdir())
    assert not capsys.readouterr().err


def compile_anew():
    """Compiles a kernel without what this process knows of it; returns whether anything was compiled."""
    optimised, made = loading.optimised, []
    loading.optimised = lambda *arguments: made.append(1) or optimised(*arguments)
    try:
        steps_to_one.callers.clear()
        assert steps_to_one(27) == 111
    finally:
        loading.optimised = optimised
    return bool(made)


def entry_of(folder: Path) -> Path:
    (entry,) = folder.iterdir()
    return entry


def test_code_is_compiled_once(kept):
    assert compile_anew()
    assert not compile_anew()


@pytest.mark.parametrize("damage", [
    lambda content: b"", lambda content: content[: len(content) // 2], lambda content: content + b"more",
    lambda content: content[:-100] + bytes([content[-100] ^ 1]) + content[-99:], lambda content: b"something else",
    lambda content: content.replace(b"object code 1", b"object code 0"),
])  # fmt: skip
def test_an_entry_that_is_not_whole_is_made_again(kept, damage):
    assert compile_anew()
    sound = entry_of(kept).read_bytes()
    entry_of(kept).write_bytes(damage(sound))
    assert compile_anew()
    assert entry_of(kept).read_bytes() == sound
    assert not compile_anew()


def test_other_sources_and_constants_are_compiled_again(kept, monkeypatch):
    assert compile_anew()
    monkeypatch.setattr(loading, "source_digest", lambda module: "edited")
    assert compile_anew()
    assert not loading.is_current({"sources": {}, "constants": [[__name__, "LIMIT", "4"]]})
    assert loading.is_current({"sources": {}, "constants": [[__name__, "LIMIT", "3"], ["math", "pi", repr(math.pi)]]})


def test_a_folder_that_cannot_be_written_ends_nothing(kept, monkeypatch):
    (kept.parent / "file").write_text("in the way")
    monkeypatch.setattr(store, "place_of", lambda name: kept.parent / "file" / name)
    assert compile_anew()
    assert compile_anew()


def test_what_nobody_used_for_a_month_goes(kept):
    assert compile_anew()
    recent, old = kept / "recent", kept / "old"
    for file, days in ((recent, cache.KEPT_DAYS - 1), (old, cache.KEPT_DAYS + 1)):
        file.write_bytes(b"code")
        os.utime(file, (file.stat().st_mtime - days * 86400.0,) * 2)
    cache.remove_unused(kept)
    assert recent.exists() and not old.exists()


SHOWN = "from fmu_src.cache_folder import cache_folder; print(cache_folder('code')); assert cache_folder('code').is_dir()"


def folder_used(**environment: str | None) -> tuple[Path, str]:
    """(cache folder, what was said) of a process with this environment; None takes a variable away."""
    settings = {name: value for name, value in {**os.environ, **environment}.items() if value is not None}
    done = subprocess.run([sys.executable, "-c", SHOWN], capture_output=True, text=True, env=settings, check=True)
    return Path(done.stdout.strip()), done.stderr


def test_the_cache_is_private_to_its_owner(tmp_path):
    folder, said = folder_used(XDG_CACHE_HOME=str(tmp_path))
    assert folder == tmp_path / "rvwear" / "code" and not said
    assert folder.stat().st_mode & 0o777 == 0o700


@pytest.mark.skipif(os.name != "posix", reason="modes of POSIX")
def test_a_cache_that_others_can_write_is_not_used(tmp_path):
    (tmp_path / "rvwear").mkdir()
    (tmp_path / "rvwear").chmod(0o777)
    folder, said = folder_used(XDG_CACHE_HOME=str(tmp_path))
    assert tmp_path not in folder.parents
    assert said.count("\n") == 1 and "others can write to" in said and "XDG_CACHE_HOME" in said


@pytest.mark.parametrize("missing", ["file", "nobody/here"])
def test_no_home_means_a_temporary_folder_and_one_line(tmp_path, missing):
    """No home is made for who has none, and nothing is left behind."""
    (tmp_path / "file").write_text("")
    folder, said = folder_used(XDG_CACHE_HOME=None, HOME=str(tmp_path / missing))
    assert not folder.exists() and tmp_path not in folder.parents and folder.parent.parent == Path(tempfile.gettempdir())
    assert said.count("\n") == 1 and "no cache between runs" in said
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


PARSED = "from fmu_src.units import parse; print(parse('um'))"


@pytest.mark.parametrize("damage", [lambda content: b"", lambda content: content[:1000], lambda content: content[:-9] + b"x" + content[-8:]])
def test_kept_units_that_are_not_whole_are_made_again(tmp_path, damage):
    def read():
        done = subprocess.run([sys.executable, "-c", PARSED], capture_output=True, text=True, env=os.environ | {"XDG_CACHE_HOME": str(tmp_path)})
        assert done.stdout.strip() == "micrometer", done.stderr
        (file,) = (tmp_path / "rvwear" / "units").iterdir()
        return file

    file = read()
    file.write_bytes(damage(file.read_bytes()))
    assert checked_file.read(file, MARK) is None
    read()
    assert checked_file.read(file, MARK)
