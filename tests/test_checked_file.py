"""Files that are written whole or not at all, that tell when they are damaged, and that two do not write at once."""

import json
import os
import random
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from fmu_src import checked_file
from fmu_src.checked_file import Damaged, replacing, set_aside, write_text
from fmu_src.faults import InputFault, RunFault
from fmu_src.held_file import held
from orchestrator import netcdf
from orchestrator.series import read_series, write_series
from studies.ensemble.store import Store

ROOT = Path(__file__).resolve().parents[1]


def python(text: str, *arguments: object, **more: object) -> "subprocess.Popen[str]":
    return subprocess.Popen([sys.executable, "-c", text, *map(str, arguments)], env=os.environ | {"PYTHONPATH": str(ROOT)}, text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, **more)  # fmt: skip


def files(folder: Path) -> list[str]:
    return sorted(path.name for path in folder.iterdir())


def test_two_processes_that_write_one_file_leave_it_whole(tmp_path):
    text = "import sys\nfrom pathlib import Path\nfrom fmu_src.checked_file import write_text\nfor _ in range(200): write_text(Path(sys.argv[1]), sys.argv[2] * 5000)"
    writers = [python(text, tmp_path / "file", sign) for sign in "ab"]
    assert [(writer.communicate(timeout=60)[1], writer.returncode) for writer in writers] == [("", 0)] * 2
    content = (tmp_path / "file").read_text()
    assert content in ("a" * 5000, "b" * 5000)
    assert files(tmp_path) == ["file"]


def write_half(place):
    with replacing(place) as partial:
        partial.write_text("half")
        raise ZeroDivisionError


def test_what_fails_leaves_the_file_as_it_was(tmp_path):
    place = tmp_path / "file"
    write_text(place, "before")
    with pytest.raises(ZeroDivisionError):
        write_half(place)
    assert place.read_text() == "before" and files(tmp_path) == ["file"]


def test_kill_at_any_moment_leaves_the_old_or_the_new(tmp_path):
    text = "import sys\nfrom pathlib import Path\nfrom fmu_src.checked_file import write_text\nprint(flush=True)\nn = 0\nwhile True:\n    n += 1\n    write_text(Path(sys.argv[1]), str(n) * 100000)"
    place = tmp_path / "file"
    for seed in range(5):
        process = python(text, place)
        process.stdout.readline()
        time.sleep(random.Random(seed).uniform(0.02, 0.1))
        process.kill()
        process.communicate()
        content = place.read_text()
        assert content == content[: len(content) // 100000] * 100000
        # Old enough, what was left behind goes with the next write.
        for name in files(tmp_path):
            if name.endswith(".part"):
                os.utime(tmp_path / name, (0, 0))
    write_text(place, "")
    assert files(tmp_path) == ["file"]


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full")
def test_full_disk_is_a_fault_that_names_the_file(tmp_path, monkeypatch):
    monkeypatch.setattr(checked_file.os, "fsync", lambda _: (_ for _ in ()).throw(OSError(28, "No space left on device")))
    with pytest.raises(RunFault, match="result.nc was not written: No space left on device; what stood there before is unharmed"):
        write_series({"time": np.arange(3.0), "x": np.zeros(3)}, {"x": "1"}, {}, tmp_path / "result.nc")
    assert files(tmp_path) == []


def test_place_that_cannot_be_written_is_told(tmp_path):
    (tmp_path / "folder").mkdir()
    with pytest.raises(InputFault, match="folder cannot be written: Is a directory; choose another place"):
        write_text(tmp_path / "folder", "")


def test_damaged_file_is_set_aside_under_a_name_of_its_own(tmp_path):
    for expected in ("file.damaged", "file.damaged-2"):
        write_text(tmp_path / "file", "x")
        assert set_aside(tmp_path / "file").name == expected


def test_second_holder_is_told_who_holds_it(tmp_path):
    text = "import sys\nfrom pathlib import Path\nfrom fmu_src.held_file import held\nwith held(Path(sys.argv[1])):\n    print(flush=True)\n    sys.stdin.readline()"
    process = python(text, tmp_path / "result.nc", stdin=subprocess.PIPE)
    process.stdout.readline()
    with pytest.raises(InputFault, match=rf"result.nc is in the hands of process {process.pid} on .*, since 2.*: wait for it"), held(tmp_path / "result.nc"):
        pass
    process.kill()
    process.communicate()
    # A process that is gone holds nothing.
    with held(tmp_path / "result.nc"):
        pass
    assert files(tmp_path) == []


def test_two_builds_and_two_extensions_of_one_place_are_kept_apart(tmp_path, capsys):
    from cli.main import main

    with held(tmp_path / "FMUs"), held(tmp_path / "better.toml"):
        assert main(["build", "--output", str(tmp_path)]) == 2
        assert f"FMUs is in the hands of process {os.getpid()}" in capsys.readouterr().err
        campaign = str(ROOT / "examples" / "raceway_depths")
        assert main(["extend", "RV20E-121", campaign, "--effect", "x", "--output", str(tmp_path / "better.toml")]) == 2
        assert "better.toml is in the hands of process" in capsys.readouterr().err


@pytest.fixture(scope="module")
def result(tmp_path_factory):
    time = np.linspace(0.0, 1.0, 50)
    return write_series({"time": time, "a.x": np.sin(time), "a.y": np.outer(time, [1.0, 2.0])}, {"a.x": "m", "a.y": "N"}, {"system": "s"},
                        tmp_path_factory.mktemp("result") / "good.nc")  # fmt: skip


def test_result_comes_back_and_other_tools_read_it(result):
    from netCDF4 import Dataset

    assert read_series(result)["a.y[2]"][-1] == 2.0
    with Dataset(result) as file:
        assert file["a.x"].units == "m"


def test_no_damaged_result_is_read_as_good(result, tmp_path):
    """Bits turned anywhere, the end cut off, bytes behind it: each is named, none is read."""
    good, path, chance = result.read_bytes(), tmp_path / "result.nc", random.Random(1)
    for trial in range(300):
        bad = bytearray(good)
        if trial % 3 == 0:
            bad = bad[: chance.randrange(len(good))]
        elif trial % 3 == 1:
            bad += bytes([chance.randrange(256)])
        else:
            bad[chance.randrange(len(bad))] ^= 1 << chance.randrange(8)
        path.write_bytes(bad)
        with pytest.raises(InputFault, match="result.nc"):
            netcdf.read(path)


def test_damaged_lives_of_an_ensemble_run_again(tmp_path):
    store = Store(tmp_path / "lives", {"seed": 1})
    for number in range(3):
        store.add({"number": number, "hours": [0.0], "figures": {"a": [1.0]}})
    text = (tmp_path / "lives").read_text().replace('"number": 1', '"number": 7')
    (tmp_path / "lives").write_text(text)
    again = Store(tmp_path / "lives", {"seed": 1})
    assert sorted(again.lives) == [0, 2] and again.damaged == 1
    (tmp_path / "lives").write_text(text.replace("seed", "feed"))
    with pytest.raises(InputFault, match="its first line is damaged; choose another --output"):
        Store(tmp_path / "lives", {"seed": 1})


def test_checked_content_is_told_from_damaged(tmp_path):
    whole = checked_file.checked(b"content", b"mark\n")
    assert checked_file.unchecked(whole, b"mark\n", tmp_path) == b"content"
    for place in range(len(whole)):
        with pytest.raises(Damaged):
            checked_file.unchecked(whole[:place] + bytes([whole[place] ^ 1]) + whole[place + 1 :], b"mark\n", tmp_path)


def test_a_cached_entry_under_another_name_is_foreign(tmp_path):
    """Two swapped entries of object code, each of them sound, ran in each other's place."""
    for name in ("plant", "wear"):
        checked_file.write(tmp_path / name, b"mark\n", name.encode())
    plant, wear = ((tmp_path / name).read_bytes() for name in ("plant", "wear"))
    (tmp_path / "plant").write_bytes(wear)
    (tmp_path / "wear").write_bytes(plant)
    assert [checked_file.read(tmp_path / name, b"mark\n") for name in ("plant", "wear")] == [None, None]
    checked_file.write(tmp_path / "plant", b"mark\n", b"anew")
    assert checked_file.read(tmp_path / "plant", b"mark\n") == b"anew"


def rvwear(*words: object, **more: object) -> "subprocess.Popen[str]":
    return subprocess.Popen([sys.executable, "-m", "cli", *map(str, words)], env=os.environ | {"PYTHONPATH": str(ROOT)}, text=True,
                            stdout=subprocess.PIPE, stderr=subprocess.PIPE, **more)  # fmt: skip


LIFE = ("life", "--hours", "1e-3", "--positions", "24", "--tolerance", "0.5", "--no-report", "--json")


def test_damaged_results_and_checkpoints_are_set_aside_and_made_again(tmp_path, capsys):
    from cli.main import main

    result, checkpoint = tmp_path / "life.nc", tmp_path / "life.checkpoint"
    assert main([*LIFE, "--output", str(result)]) == 0
    good = json.loads(capsys.readouterr().out)
    whole = result.read_bytes()
    result.write_bytes(whole[:5000] + b"damage" + whole[5006:])
    checkpoint.write_bytes(b"rvwear checkpoint 1\n" + b"damage")
    assert main(["report", str(result)]) == 2
    assert "its checksum does not fit; rvwear life with --reuse computes it again" in capsys.readouterr().err
    assert main([*LIFE, "--output", str(result), "--resume"]) == 2
    assert "life.checkpoint is damaged: its checksum does not fit; start anew with --restart" in capsys.readouterr().err
    assert main([*LIFE, "--output", str(result), "--reuse"]) == 0
    said = capsys.readouterr()
    assert json.loads(said.out) == good
    assert "life.nc.damaged" in said.err and "life.checkpoint.damaged" in said.err
    assert files(tmp_path) == ["life.checkpoint.damaged", "life.nc", "life.nc.damaged"]


def test_second_life_on_one_output_is_refused_and_termination_can_be_resumed(tmp_path):
    result = tmp_path / "life.nc"
    # Thousands of short jumps: it lasts as long as it is let, and nothing is worn through.
    first = rvwear("life", "--hours", "4e3", "--first-jump", "1", "--largest-jump", "1", "--positions", "400", "--no-report", "--output", result)
    while not (tmp_path / "life.checkpoint").exists() and first.poll() is None:
        time.sleep(0.05)
    second = rvwear(*LIFE, "--output", result)
    out, said = second.communicate(timeout=60)
    assert second.returncode == 2 and f"in the hands of process {first.pid}" in said and not out
    first.send_signal(signal.SIGTERM)
    said = first.communicate(timeout=60)[1]
    assert first.returncode == 143 and "go on with --resume" in said and "Traceback" not in said
    assert files(tmp_path) == ["life.checkpoint"]


@pytest.mark.skipif(not Path("/dev/full").exists(), reason="no /dev/full")
def test_output_that_cannot_be_printed_is_a_failed_run():
    with open("/dev/full", "w") as full:
        process = subprocess.run([sys.executable, "-m", "cli", "example", "--json"], env=os.environ | {"PYTHONPATH": str(ROOT)}, stdout=full,
                                 stderr=subprocess.PIPE, text=True)  # fmt: skip
    assert process.returncode == 1 and "No space left" in process.stderr and "Traceback" not in process.stderr


def test_reader_that_has_seen_enough_is_no_failure_and_a_lost_process_is(monkeypatch, capsys):
    from cli.commands import example
    from cli.main import main

    with rvwear("example", "--json") as process:
        process.stdout.close()
        assert (process.stderr.read(), process.wait(30)) == ("", 0)

    def lose(_):
        raise BrokenPipeError(32, "Broken pipe")

    monkeypatch.setattr(example, "run", lose)
    assert main(["example"]) == 1
    assert "a process that computed for this one is gone" in capsys.readouterr().err
