"""The folder of a running app: the next app sees whose app has died, and removes what that left behind."""

from __future__ import annotations

import os
import shutil
import stat
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path
from typing import IO

if sys.platform != "win32":
    import fcntl

_PREFIX = "heeltoe-app-"
# A file in it that is held as long as the app runs, however that ends.
_HELD = "held"


@contextmanager
def folder_of_app() -> Iterator[Path]:
    """Make a folder for this app and its user alone, which goes with it; those of apps that have died go first."""
    for folder in Path(tempfile.gettempdir()).glob(f"{_PREFIX}*"):
        if _is_own(folder) and _is_left(folder):
            shutil.rmtree(folder, ignore_errors=True)
    with tempfile.TemporaryDirectory(prefix=_PREFIX, ignore_cleanup_errors=True) as name, _held(Path(name)):
        yield Path(name)


def _held(folder: Path) -> IO[bytes]:
    if sys.platform == "win32":
        # Files that are open there cannot be removed.
        return (folder / _HELD).open("xb")
    # It has its name, by which others look for it, when it is held.
    fresh = folder / f"{_HELD}-soon"
    held = fresh.open("xb")
    # Some file systems have no locks: there nothing of the dead is recognised.
    with suppress(OSError):
        fcntl.flock(held, fcntl.LOCK_EX | fcntl.LOCK_NB)
    fresh.rename(folder / _HELD)
    return held


def _is_own(folder: Path) -> bool:
    """Whether it is a folder of this user, and no link."""
    try:
        status = folder.lstat()
    except OSError:
        return False
    return stat.S_ISDIR(status.st_mode) and (sys.platform == "win32" or status.st_uid == os.getuid())


def _is_left(folder: Path) -> bool:
    """Whether the app of a folder has ended."""
    try:
        if sys.platform == "win32":
            (folder / _HELD).unlink()
        else:
            with (folder / _HELD).open("rb") as held:
                fcntl.flock(held, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    return True
