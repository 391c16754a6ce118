"""Folders of compiled kernels that nobody uses go; those in use stay."""

import os
import time

from fmu_src.kernel import KEPT_DAYS, use_cache_folder

DAY = 86400.0


def folder_of_age(place, days):
    place.mkdir(parents=True)
    (place / "kernel.nbc").write_bytes(b"code")
    os.utime(place, (time.time() - days * DAY,) * 2)
    return place


def test_a_new_folder_replaces_those_unused_for_long(tmp_path):
    old, recent = folder_of_age(tmp_path / "old", KEPT_DAYS + 1), folder_of_age(tmp_path / "recent", KEPT_DAYS - 1)
    use_cache_folder(tmp_path / "new")
    assert not old.exists()
    assert (recent / "kernel.nbc").exists() and (tmp_path / "new").is_dir()


def test_use_keeps_a_folder_and_removes_no_other(tmp_path):
    used, old = folder_of_age(tmp_path / "used", KEPT_DAYS + 1), folder_of_age(tmp_path / "old", KEPT_DAYS + 1)
    use_cache_folder(used)
    assert old.exists()
    use_cache_folder(tmp_path / "new")
    assert (used / "kernel.nbc").exists() and not old.exists()


def test_a_cache_that_cannot_be_written_ends_nothing(tmp_path):
    (tmp_path / "file").write_text("")
    use_cache_folder(tmp_path / "file" / "rvwear" / "new")
