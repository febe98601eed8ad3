"""A study on a disk that is full: one line, nothing lost, and it goes on once there is room."""

from __future__ import annotations

import subprocess
import sys

import pytest

from heeltoe import open_study, run_study
from shared.command import process
from shared.studies import DRAWN, study_file


@pytest.fixture
def small_disk(tmp_path):
    """A file system of its own, of a megabyte, and what makes it larger."""
    place = tmp_path / "disk"
    place.mkdir()

    def mount(options):
        done = subprocess.run(["mount", *options, str(place)], capture_output=True, text=True, check=False)
        return done.returncode == 0

    if sys.platform != "linux" or not mount(["-t", "tmpfs", "-o", "size=1m", "tmpfs"]):
        pytest.skip("a file system can be mounted by the administrator of a Linux machine alone")
    yield place, lambda: mount(["-o", "remount,size=64m"])
    subprocess.run(["umount", str(place)], check=True)


@pytest.mark.slow
def test_a_disk_that_fills(tmp_path, small_disk):
    disk, grow = small_disk
    file = study_file(tmp_path, DRAWN.replace("samples = 60", "samples = 12000"))
    whole = run_study(file, tmp_path / "whole").to_table()
    message = process("study", file, "--out", disk / "out")
    assert message.returncode == 2
    assert message.stderr.splitlines()[-1].endswith("(No space left on device); give a place where you may write")
    assert "Traceback" not in message.stderr
    assert not open_study(disk / "out").complete
    before = {path: path.stat().st_mtime_ns for path in (disk / "out" / "runs").glob("part-*")}
    assert grow()
    again = process("study", file, "--out", disk / "out", "--resume")
    assert again.returncode == 0, again.stderr
    assert open_study(disk / "out").to_table().equals(whole)
    # What was there has not been run again.
    assert all(path.stat().st_mtime_ns == time for path, time in before.items())
    assert not [path for path in (disk / "out").rglob(".heeltoe-*") if path.is_dir()]
