"""The streams of the process: where they are closed, full or broken, a command ends quietly or with one line.

Whoever reads our output may close it, as ``head`` does: then the process ends as others do, by SIGPIPE.
"""

from __future__ import annotations

import errno
import os
import signal
import sys
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from types import FrameType
from typing import TYPE_CHECKING

from heeltoe.errors.error import InputError

if TYPE_CHECKING:
    from rich.console import Console

#: Consoles that say to be narrower than this say nothing of use.
_NARROWEST, _USUAL = 20, 80
# Signals that ask a command to end.
_ENDINGS = ("SIGTERM", "SIGHUP")
#: So long Python may not hear of an interruption [s].
_PATIENCE = 1.5
# Where signals are written to, while a command listens for an interruption beside Python.
_LISTENING: list[int] = []
# What the system says of streams and files that cannot be written.
_NOT_WRITTEN = (
    *(errno.ENOSPC, errno.EDQUOT, errno.EFBIG, errno.EIO, errno.EBADF, errno.EPIPE, errno.EINVAL, errno.EAGAIN),
    *(errno.EROFS, errno.EACCES, errno.EPERM, errno.ENXIO, errno.ENODEV, errno.ECONNRESET, errno.ETIMEDOUT),
)


def console(*, stderr: bool = False) -> Console:
    """Return where words go."""
    from rich.console import Console

    console = Console(stderr=stderr, highlight=False, emoji=False)
    if console.width < _NARROWEST:
        console.width = _USUAL
    return console


def print_data(text: str) -> None:
    """Print what programs read: UTF-8 wherever it goes; what no text may hold (lone surrogates) escaped, as in JSON."""
    _say_all(sys.stdout, "utf-8")
    print(text)


@contextmanager
def streams() -> Iterator[None]:
    """Guard the standard streams while a command runs, and flush them at its end.

    Raises
    ------
    InputError
        Where standard output, or a file that nothing else has guarded, cannot be written.
    """
    _open()
    before = signal.signal(signal.SIGPIPE, signal.SIG_DFL) if hasattr(signal, "SIGPIPE") else None
    # Who lets a command run on when its terminal goes has the signal ignored.
    numbers = [getattr(signal, name) for name in _ENDINGS if hasattr(signal, name)]
    ending = [number for number in numbers if signal.getsignal(number) is signal.SIG_DFL]
    for number in ending:
        signal.signal(number, _end)
    try:
        try:
            yield
        finally:
            _listen_no_more()
            sys.stdout.flush()
    except OSError as error:
        if error.errno not in _NOT_WRITTEN:
            raise
        if error.filename is not None:  # what fails on a stream has none
            raise InputError("cannot-write", str(error.filename), reason=error.strerror, value="it") from None
        # What could not be written shall not be tried again at the end of the process.
        with suppress(OSError):
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        raise InputError("cannot-write", "standard output", reason=error.strerror or error, value="it") from None
    finally:
        for number in ending:
            signal.signal(number, signal.SIG_DFL)
        if before is not None:
            signal.signal(signal.SIGPIPE, before)


def end_if_deaf() -> None:
    """Let Ctrl-C end a command within two seconds even where it is deep in a library that does not look out for it:
    what it has written stays whole, and what it has put aside the next one removes."""
    if sys.platform == "win32" or signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        return
    from heeltoe.kernel import interruption

    reading, writing = os.pipe()
    os.set_blocking(writing, False)
    signal.set_wakeup_fd(writing, warn_on_full_buffer=False)
    interruption.end_if_deaf(reading, _PATIENCE)

    def interrupted(number: int, frame: FrameType | None) -> None:
        interruption.hear_interruption()
        signal.default_int_handler(number, frame)

    signal.signal(signal.SIGINT, interrupted)
    _LISTENING.append(writing)


def _listen_no_more() -> None:
    """Leave the signals as they were: a command may run in a program that goes on."""
    while _LISTENING:
        signal.signal(signal.SIGINT, signal.default_int_handler)
        signal.set_wakeup_fd(-1)
        os.close(_LISTENING.pop())


def _end(number: int, _: object) -> None:
    """End the command as an error would: what it has put aside goes, and what it has written stays whole."""
    print(f"heeltoe: ended by {signal.Signals(number).name}", file=sys.stderr)
    sys.exit(128 + number)


def _open() -> None:
    """Let no file that a command opens take the number of a closed stream, and every letter find its way out."""
    if sys.stdin is None:
        os.open(os.devnull, os.O_RDONLY)
    if sys.stdout is None:
        # Not for writing: what should be told and cannot is an error.
        sys.stdout = os.fdopen(os.open(os.devnull, os.O_RDONLY), "w")
    if sys.stderr is None:
        sys.stderr = os.fdopen(os.open(os.devnull, os.O_WRONLY), "w")
    for stream in (sys.stdout, sys.stderr):
        _say_all(stream)


def _say_all(stream: object, encoding: str | None = None) -> None:
    """Let a stream escape what its encoding cannot say."""
    if hasattr(stream, "reconfigure"):  # tests have others
        stream.reconfigure(encoding=encoding, errors="backslashreplace")
