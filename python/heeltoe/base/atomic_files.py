"""Writing files: each whole or not at all, a set of them all or none, and nothing of the user's lost.

A single file is written aside, in the directory where it belongs, and then takes its place. Files that belong together
cannot be renamed in one moment: they are written into one directory aside, which gets the name ``.heeltoe-ready`` in
one moment, and from then on the new result is the one that counts. Its files then move to their places, the last of
them the list of all files of ours, ``.heeltoe-files``. A process that is killed before leaves the old result; one that
is killed after leaves the new one, some of it still in ``.heeltoe-ready``, and the next run into this directory moves
that, too (:func:`settle`), if it was written here by this user: a folder of a stranger may hold one as well. Files on
that list may be replaced or removed by later runs, nothing else.

Every directory aside is locked as long as the process that fills it is alive: the next one removes what is not.
"""

from __future__ import annotations

import os
import shutil
import signal
import stat
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import ExitStack, contextmanager, suppress
from fnmatch import fnmatch
from pathlib import Path, PurePosixPath
from tempfile import TemporaryDirectory, mkdtemp
from typing import Any

from heeltoe.errors.error import InputError

if sys.platform != "win32":
    import fcntl

LISTED = ".heeltoe-files"
"""The list of our files in a directory, one in a line."""
READY = ".heeltoe-ready"
"""A new result that is complete, on its way to its places."""
_MARK = ".heeltoe-mark"
_ASIDE = ".heeltoe-"
# Signals that interrupt or end a command; some systems have fewer of them.
_SIGNALS = [getattr(signal, name) for name in ("SIGINT", "SIGTERM", "SIGHUP") if hasattr(signal, name)]
# Places that name an open file, of a shell for example: what is there is written to, not replaced.
_OPEN = ("/dev/fd/", "/dev/std", "/proc/")


def check_file(path: str | Path, field: str) -> None:
    """Refuse a place that a file cannot be written to, before anything is computed.

    Raises
    ------
    InputError
        Then.
    """
    with _refusing(field, path):
        if not str(path) or "\0" in str(path) or str(path).endswith(("/", os.sep)) or Path(path).is_dir():
            raise InputError("no-file", field, repr(str(path)))
        if not Path(path).absolute().parent.is_dir():
            raise InputError("no-directory", str(Path(path).parent))
        target = _target(path)
        if target is None:
            return
        if target.is_symlink() or not target.parent.is_dir():
            raise InputError("cannot-write", field, path, reason="its link leads nowhere")
        if target.exists() and not target.stat().st_mode & 0o222:
            raise InputError("cannot-write", field, path, reason="it is read-only")
        if not os.access(target.parent, os.W_OK | os.X_OK) or (target.exists() and not os.access(target, os.W_OK)):
            raise InputError("cannot-write", field, path, reason="Permission denied")


def check_directory(directory: Path, field: str, names: Sequence[str] = ()) -> None:
    """Refuse a directory that cannot be made or written to, or that has files of the user's under these names.

    Raises
    ------
    InputError
        Then; before anything is computed, if it is called first.
    """
    with _refusing(field, directory):
        for place in (directory, *directory.absolute().parents):
            if place.is_dir():
                break
            if place.exists():
                raise InputError("not-a-directory", field, place, expected="a directory")
        if not os.access(place, os.W_OK | os.X_OK):
            raise InputError("cannot-write", field, directory, reason="Permission denied")
        _check_own(directory, names, files(directory), field)


def check_inside(directory: Path, place: Path, field: str) -> None:
    """Refuse a place in a directory that a link leads out of it: a stranger may have made that.

    Raises
    ------
    InputError
        Then.
    """
    inner = place.relative_to(directory)
    for part in (inner, *inner.parents[:-1]):
        if (directory / part).is_symlink():
            raise InputError("cannot-write", field, place, reason="a link leads out of the directory")


def mark(ready: Path) -> None:
    """Write into a complete result where it is: a copy of it, or one out of an archive, is another directory."""
    (ready / _MARK).write_text(str(ready.stat().st_ino), encoding="utf-8")


def _is_ours(ready: Path) -> bool:
    """Whether this user wrote a complete result, here."""
    here = ready.stat()
    if sys.platform != "win32" and here.st_uid != os.geteuid():
        return False
    try:
        return (ready / _MARK).read_text(encoding="utf-8") == str(here.st_ino)
    except (OSError, UnicodeDecodeError):
        # Nothing but directories is what a removal leaves that did not come to its end.
        return all(path.is_dir() and not path.is_symlink() for path in ready.rglob("*"))


@contextmanager
def written(path: str | Path, field: str = "file", *, within: Path | None = None) -> Iterator[Path]:
    """Yield a place to write a file to, which then replaces the one that `path` means, with the mode of that.

    Links are followed, but for those in a directory `within` which all has to stay. A device or a pipe is written to.

    Raises
    ------
    InputError
        Where it cannot be written; there is then what was there before.
    """
    with _refusing(field, path):
        if within is not None:
            check_inside(within, Path(path), field)
        check_file(path, field)
        target = _target(path)
        if target is None:
            with TemporaryDirectory() as aside:
                fresh = Path(aside) / Path(path).name
                yield fresh
                with fresh.open("rb") as source, os.fdopen(os.open(path, os.O_WRONLY), "wb") as through:
                    shutil.copyfileobj(source, through)
            return
        with _aside(target.parent) as aside_:
            fresh = aside_ / Path(path).name
            yield fresh
            if target.exists():
                before = target.stat()
                if sys.platform != "win32":
                    with suppress(OSError):  # only the owner's own administrator may give a file away
                        os.chown(fresh, before.st_uid, before.st_gid)
                fresh.chmod(stat.S_IMODE(before.st_mode))
            fresh.replace(target)


@contextmanager
def temporary() -> Iterator[Path]:
    """Yield a private directory that is removed afterwards.

    Raises
    ------
    InputError
        Where there is no room for it; elsewhere there may be.
    """
    try:
        with TemporaryDirectory() as name:
            yield Path(name)
    except OSError as error:
        raise InputError("no-room", "TMPDIR", reason=error.strerror or error) from None


def write_text(path: str | Path, text: str, field: str = "file", *, within: Path | None = None) -> Path:
    """Write a file of text, as :func:`written`, and return its path."""
    with written(path, field, within=within) as fresh:
        fresh.write_text(text, encoding="utf-8")
    return Path(path)


def write_whole(
    write: Callable[[Path], None], directory: Path, own: Sequence[str], *, field: str = "--out"
) -> list[Path]:
    """Let `write` fill a place aside, then move all of it into `directory`, and return the paths there.

    Files of ours from an earlier run whose names match one of the patterns `own` go, if they are not replaced. After a
    failure, or an interruption, there is what was there before.

    Raises
    ------
    InputError
        Where the directory cannot be written, or where a file in the way is not one of ours.
    """
    made = next((place for place in (*reversed(directory.parents), directory) if not place.exists()), None)
    try:
        with _refusing(field, directory):
            directory.mkdir(parents=True, exist_ok=True)
            with _aside(directory) as fresh:
                write(fresh)
                return _publish(fresh, directory, own, field)
    except BaseException:
        if made is not None and not (directory / LISTED).exists():
            shutil.rmtree(made, ignore_errors=True)
        raise


def files(directory: Path) -> list[str]:
    """Return the files of ours in a directory, relative to it; none that are elsewhere, whatever its list says."""
    try:
        lines = (directory / LISTED).read_text(encoding="utf-8").splitlines()
    except (OSError, UnicodeDecodeError):
        return []
    root = directory.resolve()
    return [
        line
        for line in lines
        if line and ".." not in PurePosixPath(line).parts and (root / line).parent.resolve().is_relative_to(root)
    ]


def settle(directory: Path) -> None:
    """Complete the result of a run that was killed as its files moved in, and remove what killed runs have left."""
    with _locked(directory):
        _settle(directory)


def _settle(directory: Path) -> None:
    _move_in(directory)
    for place in directory.glob(f"{_ASIDE}*"):
        if place.is_dir() and not place.is_symlink() and _is_left(place):
            shutil.rmtree(place, ignore_errors=True)


def _publish(fresh: Path, directory: Path, own: Sequence[str], field: str) -> list[Path]:
    """Make the files in `fresh` those of the directory."""
    names = sorted(path.relative_to(fresh).as_posix() for path in fresh.rglob("*") if path.is_file())
    with _locked(directory):
        _move_in(directory)
        listed = files(directory)
        _check_own(directory, names, listed, field)
        for name in names:
            check_inside(directory, directory / name, field)
        kept = [name for name in listed if not any(fnmatch(PurePosixPath(name).name, pattern) for pattern in own)]
        (fresh / LISTED).write_text("".join(f"{name}\n" for name in sorted({*kept, *names})), encoding="utf-8")
        mark(fresh)
        with _uninterrupted():
            fresh.rename(directory / READY)
            _move_in(directory)
    return [directory / name for name in names]


def _move_in(directory: Path) -> None:
    """Move a result that is complete to its places; interrupted anywhere, this can be done again.

    Raises
    ------
    InputError
        Where a stranger may have written it, or one of its places is behind a link.
    """
    ready = directory / READY
    if not ready.is_dir() or ready.is_symlink():
        return
    if not _is_ours(ready):
        raise InputError("left-over", "--out", ready)
    if (ready / LISTED).is_file():
        gone = set(files(directory)) - set((ready / LISTED).read_text(encoding="utf-8").splitlines())
        for name in gone:
            (directory / name).unlink(missing_ok=True)
            for folder in (directory / name).relative_to(directory).parents[:-1]:
                with suppress(OSError):  # it holds more
                    (directory / folder).rmdir()
        for source in sorted(path for path in ready.rglob("*") if path.is_file() and path.name not in (LISTED, _MARK)):
            place = directory / source.relative_to(ready)
            check_inside(directory, place, "--out")
            place.parent.mkdir(parents=True, exist_ok=True)
            source.replace(place)
        (ready / LISTED).replace(directory / LISTED)
    shutil.rmtree(ready, ignore_errors=True)


def _check_own(directory: Path, names: Sequence[str], listed: Sequence[str], field: str) -> None:
    for name in names:
        if name not in listed and os.path.lexists(directory / name):
            raise InputError("not-ours", field, directory / name)


@contextmanager
def _refusing(field: str, place: object) -> Iterator[None]:
    """Say in one line that something cannot be written."""
    try:
        yield
    except (OSError, UnicodeEncodeError) as error:
        # As the system says it, whatever a library has made of that.
        number = error.errno if isinstance(error, OSError) else None
        reason = os.strerror(number) if number else str(error).strip().split("\n")[0]
        raise InputError("cannot-write", field, place, reason=reason) from None


def _target(path: str | Path) -> Path | None:
    """Return the regular file, existing or not, at the end of all links of a path; None for anything else."""
    if str(path).startswith(_OPEN):
        return None
    try:
        if not stat.S_ISREG(os.stat(path).st_mode):
            return None
    except FileNotFoundError:
        pass
    return Path(os.path.realpath(path))


@contextmanager
def _aside(directory: Path) -> Iterator[Path]:
    """Yield a new directory in this one, which is not there afterwards."""
    with ExitStack() as stack:
        with _locked(directory), _uninterrupted():
            _settle(directory)
            fresh = Path(mkdtemp(prefix=_ASIDE, dir=directory))
            stack.callback(_remove, fresh)
            stack.enter_context(_locked(fresh))
        yield fresh


def _remove(aside: Path) -> None:
    with _uninterrupted():
        shutil.rmtree(aside, ignore_errors=True)


@contextmanager
def _uninterrupted() -> Iterator[None]:
    """Let a signal that would raise an exception wait: what is short and must not stop halfway is done first."""
    waiting: list[int] = []
    before: dict[int, Any] = {}
    try:
        # Handlers written in Python run in the main thread alone.
        if threading.current_thread() is threading.main_thread():
            for number in _SIGNALS:
                handler = signal.getsignal(number)
                if callable(handler):
                    before[number] = handler
                    signal.signal(number, lambda number, _: waiting.append(number))
        yield
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)
        for number in waiting[:1]:
            signal.raise_signal(number)


@contextmanager
def _locked(directory: Path) -> Iterator[None]:
    """Hold the lock of a directory, where there are such locks; it ends with the process, however that ends."""
    if sys.platform == "win32":
        yield
        return
    with ExitStack() as stack:
        # Some network file systems have no locks, and some directories cannot be read.
        with suppress(OSError):
            handle = os.open(directory, os.O_RDONLY)
            stack.callback(os.close, handle)
            fcntl.flock(handle, fcntl.LOCK_EX)
        yield


def _is_left(place: Path) -> bool:
    """Whether no process writes into a temporary directory any more."""
    if sys.platform == "win32":
        return False
    try:
        handle = os.open(place, os.O_RDONLY)
    except OSError:
        return False
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError:
        return False
    else:
        return True
    finally:
        os.close(handle)
