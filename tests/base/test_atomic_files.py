"""Files appear whole or not at all, a set of them all or none, and nothing of the user's is lost."""

from __future__ import annotations

import errno
import os
import shutil
import signal
import stat
import subprocess
import sys
import threading
from pathlib import Path

import pytest

from heeltoe.base import atomic_files
from heeltoe.base.atomic_files import (
    LISTED,
    READY,
    check_directory,
    check_file,
    files,
    mark,
    settle,
    temporary,
    write_text,
    write_whole,
    written,
)
from heeltoe.errors.error import InputError


def found(directory):
    """Return all files below a directory, and what is in them."""
    return {path.relative_to(directory).as_posix(): path.read_text() for path in directory.rglob("*") if path.is_file()}


def filling(**content):
    def write(fresh):
        for name, text in content.items():
            path = fresh / name.replace("__", "/")
            path.parent.mkdir(exist_ok=True)
            path.write_text(text)

    return write


def refusal(call, *arguments, **named):
    with pytest.raises(InputError) as refused:
        call(*arguments, **named)
    return refused.value.code


def test_a_file_has_the_mode_of_the_one_before_else_that_of_all_files(tmp_path):
    mask = os.umask(0o027)
    try:
        write_text(tmp_path / "new", "x")
    finally:
        os.umask(mask)
    (tmp_path / "old").write_text("before")
    (tmp_path / "old").chmod(0o604)
    write_text(tmp_path / "old", "after")
    modes = [stat.S_IMODE((tmp_path / name).stat().st_mode) for name in ("new", "old")]
    assert modes == [0o640, 0o604]
    assert found(tmp_path) == {"new": "x", "old": "after"}


def test_links_are_followed(tmp_path):
    (tmp_path / "far").mkdir()
    (tmp_path / "far" / "there").write_text("before")
    for name, target in (("link", "far/there"), ("again", "link"), ("dangling", "far/new")):
        (tmp_path / name).symlink_to(target)
    write_text(tmp_path / "again", "after")
    write_text(tmp_path / "dangling", "made")
    assert found(tmp_path / "far") == {"there": "after", "new": "made"}
    assert all((tmp_path / name).is_symlink() for name in ("link", "again", "dangling"))
    (tmp_path / "circle").symlink_to("circle")
    (tmp_path / "nowhere").symlink_to("none/at/all")
    assert [refusal(write_text, tmp_path / name, "") for name in ("circle", "nowhere")] == ["cannot-write"] * 2


def test_pipes_and_devices_are_written_to(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    read = []
    reader = threading.Thread(target=lambda: read.append(pipe.read_text()))
    reader.start()
    write_text(pipe, "through")
    reader.join(10)
    assert read == ["through"]
    assert stat.S_ISFIFO(pipe.stat().st_mode)
    write_text("/dev/null", "away")
    assert stat.S_ISCHR(os.stat("/dev/null").st_mode)
    if Path("/dev/full").exists():
        assert refusal(write_text, "/dev/full", "more") == "cannot-write"


def test_what_is_read_only_or_no_file_is_refused_before_anything_is_written(tmp_path):
    (tmp_path / "kept").write_text("mine")
    (tmp_path / "kept").chmod(0o444)
    assert refusal(check_file, tmp_path / "kept", "--json") == "cannot-write"
    for path in ("", str(tmp_path), f"{tmp_path}/new/", "a\0b"):
        assert refusal(check_file, path, "--json") == "no-file"
    assert refusal(check_file, tmp_path / "none" / "file", "--json") == "no-directory"
    for path in (tmp_path / ("x" * 300), "\ud800"):
        assert refusal(check_file, path, "--json") == "cannot-write"
        assert refusal(check_directory, Path(path), "--out") == "cannot-write"
    assert found(tmp_path) == {"kept": "mine"}


@pytest.mark.skipif(os.geteuid() == 0, reason="permissions are nothing to the administrator")
def test_a_directory_without_permission_is_refused_before(tmp_path):
    tmp_path.chmod(0o555)
    assert refusal(check_file, tmp_path / "file", "--json") == "cannot-write"
    assert refusal(check_directory, tmp_path / "new", "--out") == "cannot-write"


@pytest.mark.parametrize(
    ("error", "raised"), [(OSError(28, "full"), InputError), (KeyboardInterrupt(), KeyboardInterrupt)]
)
def test_a_failure_leaves_the_file_before(tmp_path, error, raised):
    def fail(path):
        with written(path) as fresh:
            fresh.write_text("half")
            raise error

    (tmp_path / "file").write_text("before")
    with pytest.raises(raised):
        fail(tmp_path / "file")
    assert found(tmp_path) == {"file": "before"}


def test_only_listed_files_are_replaced_or_removed(tmp_path):
    (tmp_path / "events.csv").write_text("mine")
    write_whole(filling(a="1", b="1", sub__c="1"), tmp_path, ("*",))
    assert files(tmp_path) == ["a", "b", "sub/c"]
    write_whole(filling(a="2"), tmp_path, ("a", "b", "c", "events.csv"))
    assert found(tmp_path) == {"events.csv": "mine", "a": "2", LISTED: "a\n"}
    assert not (tmp_path / "sub").exists()
    write_whole(filling(b="3"), tmp_path, ("b",))
    assert files(tmp_path) == ["a", "b"]
    with pytest.raises(InputError) as refused:
        write_whole(filling(a="4", **{"events.csv": "4"}), tmp_path, ("*",))
    assert refused.value.code == "not-ours"
    assert found(tmp_path) == {"events.csv": "mine", "a": "2", "b": "3", LISTED: "a\nb\n"}
    assert refusal(check_directory, tmp_path, "--out", ("events.csv",)) == "not-ours"


def test_a_forged_list_reaches_nothing_outside(tmp_path):
    (tmp_path / "outside").write_text("mine")
    (tmp_path / "far").mkdir()
    (tmp_path / "far" / "file").write_text("mine")
    place = tmp_path / "out"
    place.mkdir()
    (place / "link").symlink_to(tmp_path / "far")
    (place / LISTED).write_text(f"../outside\n{tmp_path}/outside\nlink/file\n\n")
    assert files(place) == []
    write_whole(filling(a="1"), place, ("*",))
    assert (tmp_path / "outside").exists()
    assert (tmp_path / "far" / "file").exists()


@pytest.mark.skipif(sys.platform == "win32", reason="links need rights there")
@pytest.mark.parametrize("left", [True, False])
def test_a_link_in_a_folder_of_a_stranger_leads_nothing_out(tmp_path, left):
    """A left-over result, or a new one, is to go through a directory that is a link to one elsewhere."""
    (tmp_path / "far").mkdir()
    (tmp_path / "far" / "file").write_text("mine")
    place = tmp_path / "out"
    place.mkdir()
    (place / "figures").symlink_to(tmp_path / "far")
    if left:
        (place / READY / "figures").mkdir(parents=True)
        (place / READY / "figures" / "file").write_text("theirs")
        (place / READY / LISTED).write_text("figures/file\n")
        mark(place / READY)
        assert refusal(settle, place) == "cannot-write"

    def fill(fresh):
        (fresh / "figures").mkdir()
        (fresh / "figures" / "new").write_text("ours")

    with pytest.raises(InputError, match="a link leads out of the directory"):
        write_whole(fill, place, ("*",))
    assert found(tmp_path / "far") == {"file": "mine"}
    assert (place / READY).exists() == left


def test_a_left_over_of_a_stranger_is_not_completed(tmp_path):
    """Out of an archive a directory comes back as another one, whatever its files say."""
    (tmp_path / "made" / READY).mkdir(parents=True)
    (tmp_path / "made" / READY / "file").write_text("theirs")
    (tmp_path / "made" / READY / LISTED).write_text("file\n")
    place = tmp_path / "out"
    shutil.copytree(tmp_path / "made", place)
    (place / "file").write_text("mine")
    before = found(place)
    for marked in (False, True):
        if marked:
            mark(tmp_path / "made" / READY)
            shutil.copy(tmp_path / "made" / READY / ".heeltoe-mark", place / READY)
            before = found(place)
        for call in (lambda: settle(place), lambda: write_whole(filling(file="new"), place, ("*",))):
            assert refusal(call) == "left-over"
        assert found(place) == before
    mark(place / READY)
    settle(place)
    assert found(place) == {"file": "theirs", LISTED: "file\n"}


def test_what_a_removal_has_left_is_removed(tmp_path):
    (tmp_path / READY / "figures").mkdir(parents=True)
    settle(tmp_path)
    assert not (tmp_path / READY).exists()


@pytest.mark.skipif(os.name == "nt" or os.geteuid() != 0, reason="only the administrator gives files away")
def test_a_left_over_of_another_user_is_not_completed(tmp_path):
    (tmp_path / READY).mkdir()
    (tmp_path / READY / LISTED).write_text("\n")
    mark(tmp_path / READY)
    os.chown(tmp_path / READY, 12345, 12345)
    assert refusal(settle, tmp_path) == "left-over"


@pytest.mark.skipif(sys.platform == "win32", reason="links need rights there")
def test_a_file_within_a_directory_is_no_link_out_of_it(tmp_path):
    (tmp_path / "mine").write_text("mine")
    place = tmp_path / "study"
    place.mkdir()
    (place / "study.json").symlink_to(tmp_path / "mine")
    with pytest.raises(InputError, match="a link leads out of the directory"):
        write_text(place / "study.json", "theirs", "--out", within=place)
    assert (tmp_path / "mine").read_text() == "mine"


KILLED = """
import os, sys
from pathlib import Path
from heeltoe.base import atomic_files as whole

left = int(sys.argv[2])

def counted(name, real):
    def call(*arguments, **named):
        global left
        left -= 1
        if left < 0:
            os.kill(os.getpid(), 9)
        return real(*arguments, **named)
    return call

for name in ("replace", "rename", "unlink", "mkdir", "write_text", "rmdir"):
    setattr(Path, name, counted(name, getattr(Path, name)))

def write(fresh):
    for name in "abd":
        (fresh / name).write_text("new")
    (fresh / "sub").mkdir()
    (fresh / "sub" / "c").write_text("new")

whole.write_whole(write, Path(sys.argv[1]), ("*",))
print("done")
"""


def test_killed_between_any_two_steps_a_directory_holds_the_old_result_or_the_new(tmp_path):
    """What is in .heeltoe-ready goes before what is beside it, and the next run moves it there."""
    old, new = dict.fromkeys(("a", "b", "gone"), "old"), dict.fromkeys(("a", "b", "d", "sub/c"), "new")
    seen = []
    for steps in range(60):
        place = tmp_path / str(steps)
        write_whole(filling(**old), place, ("*",))
        (place / "notes").write_text("mine")
        ended = subprocess.run(
            [sys.executable, "-c", KILLED, place, str(steps)], capture_output=True, text=True, check=False
        )
        assert (ended.returncode == -9) != ("done" in ended.stdout), ended.stderr
        whole = (place / READY / LISTED).exists()
        settle(place)
        result = found(place)
        assert result.pop("notes") == "mine"
        listed = result.pop(LISTED).split()
        assert set(listed) == set(result)
        assert result == new if whole else result in (old, new)
        assert [path.name for path in place.glob(".heeltoe-*")] == [LISTED]
        seen.append((whole, result == new))
        if ended.returncode == 0:
            break
    # All of it happened: killed before, on the way, and not at all.
    assert {(False, False), (True, True), (False, True)} <= set(seen)
    assert ended.returncode == 0


def test_what_a_process_is_filling_is_left_alone(tmp_path):
    with written(tmp_path / "one") as first:
        first.write_text("1")
        write_text(tmp_path / "two", "2")
        assert first.exists()
    (tmp_path / ".heeltoe-left").mkdir()
    (tmp_path / ".heeltoe-left" / "half").write_text("half")
    write_text(tmp_path / "three", "3")
    assert found(tmp_path) == {"one": "1", "two": "2", "three": "3"}
    assert not (tmp_path / ".heeltoe-left").exists()


def test_no_room_for_what_nobody_shall_see_is_said(monkeypatch):
    def fail(*_):
        raise OSError(errno.ENOSPC, "No space left on device")

    monkeypatch.setattr("heeltoe.base.atomic_files.TemporaryDirectory", fail)
    with pytest.raises(InputError, match="No space left on device") as refused, temporary():
        pass
    assert refused.value.code == "no-room"


@pytest.mark.parametrize("step", ["mkdtemp", "rmtree"])
def test_a_signal_waits_until_what_is_aside_is_known_or_gone(tmp_path, monkeypatch, step):
    def end(*_):
        raise SystemExit

    place = atomic_files if step == "mkdtemp" else atomic_files.shutil
    real = getattr(place, step)

    def interrupted(*words, **options):
        signal.raise_signal(signal.SIGTERM)
        return real(*words, **options)

    before = signal.signal(signal.SIGTERM, end)
    try:
        monkeypatch.setattr(place, step, interrupted)
        with pytest.raises(SystemExit):
            write_text(tmp_path / "text", "new")
    finally:
        signal.signal(signal.SIGTERM, before)
    assert not [path for path in tmp_path.iterdir() if path.is_dir()]
