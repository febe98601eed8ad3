"""The real command, killed at any moment of its run: the whole old result or the whole new one."""

from __future__ import annotations

import json
import random
import subprocess
import sys
import time
from pathlib import Path

import pytest

from heeltoe.base.atomic_files import LISTED, READY, files, settle
from shared.dams import BLOCK

KILLS = 30


def start(directory: Path, title: str) -> subprocess.Popen[bytes]:
    command = ["run", str(BLOCK), "--out", str(directory), "--report", "--set", f"title={title}"]
    quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
    return subprocess.Popen([sys.executable, "-m", "heeltoe", *command], **quiet)


def state(directory: Path) -> dict[str, tuple[int, int]]:
    """Return size and time of all files of a result."""
    return {
        name: (status.st_size, status.st_mtime_ns) for name in files(directory) if (status := (directory / name).stat())
    }


def title(directory: Path) -> str:
    return str(json.loads((directory / "result.json").read_text())["title"])


@pytest.mark.product
def test_killed_at_thirty_moments_a_directory_holds_the_old_result_or_the_new(tmp_path):
    place, moments = tmp_path / "out", random.Random("heeltoe")
    assert start(place, "run 0").wait() == 0
    (place / "notes.txt").write_text("mine")
    began = time.monotonic()
    assert start(place, "run 1").wait() == 0
    whole = time.monotonic() - began
    old = new = moving = 0
    for kill in range(KILLS):
        before, title_before = state(place), title(place)
        running = start(place, f"run {kill + 2}")
        try:
            # Over all of the run, and a little beyond its end.
            running.wait(whole * (kill + moments.random()) / KILLS * 1.2)
        except subprocess.TimeoutExpired:
            running.kill()
            running.wait()
        ready = (place / READY / LISTED).exists()
        moving += ready
        settle(place)
        after = state(place)
        assert after.keys() == before.keys() >= {"result.json", "report.pdf", "report.html", "response.png"}
        assert {path.name for path in place.iterdir()} == {*after, LISTED, "notes.txt"}
        if title(place) == title_before and not ready:
            assert after == before
            old += 1
        else:
            assert title(place) == f"run {kill + 2}"
            assert f"run {kill + 2}" in (place / "report.html").read_text(encoding="utf-8")
            assert all(after[name][1] > before[name][1] for name in after)
            new += 1
    print(f"killed {KILLS} times over {whole:.1f} s: {old} old, {new} new, {moving} of them on their way")
    assert old > 0
    assert new > 0
    (place / ".heeltoe-left").mkdir()
    assert start(place, "the last").wait() == 0
    assert {path.name for path in place.iterdir()} == {*files(place), LISTED, "notes.txt"}
    assert (place / "notes.txt").read_text() == "mine"
