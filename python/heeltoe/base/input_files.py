"""Reading files of the user's: bounded in size, and in the time that a pipe may take."""

from __future__ import annotations

import csv
import os
import select
import stat
from pathlib import Path
from time import monotonic

_CHUNK = 1 << 16
#: Seconds in which somebody must have written to a pipe.
PATIENCE = 10.0


def read_bounded(path: Path, largest: int) -> bytes:
    """Return the bytes of a file, one more than `largest` at most, so that the caller sees that it is too large.

    Raises
    ------
    OSError
        Where it cannot be read, or is a pipe to which no one writes within :data:`PATIENCE` seconds.
    """
    # Opening a pipe waits for its writer, which may never come.
    handle = os.open(path, os.O_RDONLY | getattr(os, "O_NONBLOCK", 0) | getattr(os, "O_BINARY", 0))
    with os.fdopen(handle, "rb", buffering=0) as file:
        if not stat.S_ISFIFO(os.fstat(handle).st_mode):
            content = bytearray()
            while len(content) <= largest and (part := file.read(min(_CHUNK, largest + 1 - len(content)))):
                content += part
            return bytes(content)
        return _of_pipe(handle, largest)


def read_csv_rows(path: Path, largest: int) -> list[list[str]]:
    """Return the cells of a table in UTF-8, without blanks around them and without empty rows.

    Raises
    ------
    OSError
        Where it cannot be read, see :func:`read_bounded`.
    ValueError
        Where it is larger than `largest` bytes, or no table.
    """
    content = read_bounded(path, largest)
    if len(content) > largest:
        raise ValueError(f"it is larger than {largest // 10**6} MB")
    try:
        # Editors on Windows begin a file with a byte order mark.
        lines = list(csv.reader(content.decode("utf-8-sig").splitlines()))
    except csv.Error as error:
        raise ValueError(str(error)) from None
    return [[cell.strip() for cell in line] for line in lines if any(cell.strip() for cell in line)]


def reason_of(error: OSError | ValueError) -> str:
    """Return why a file cannot be read, in words for a message."""
    if isinstance(error, UnicodeError):
        return "it is not in UTF-8"
    return (getattr(error, "strerror", None) or str(error)).rstrip(".")


def _of_pipe(handle: int, largest: int) -> bytes:
    content, begun = bytearray(), monotonic()
    while len(content) <= largest:
        ready, _, _ = select.select([handle], [], [], max(0.0, begun + PATIENCE - monotonic()))
        try:
            part = os.read(handle, min(_CHUNK, largest + 1 - len(content))) if ready else None
        except BlockingIOError:
            continue
        if part is None:
            raise TimeoutError(f"a pipe, and no one has written all of it within {PATIENCE:g} s")
        if not part:
            break
        content += part
    return bytes(content)
