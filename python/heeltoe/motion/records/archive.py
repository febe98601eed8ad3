"""Records in a zip or a tar, or behind gzip or bzip2: unpacked in memory alone, up to a bound, whatever an archive says
of itself."""

from __future__ import annotations

import io
from collections.abc import Iterator
from functools import partial
from pathlib import PurePosixPath
from typing import IO

from heeltoe.errors.error import InputError

#: No record comes near; what is larger is something else.
LARGEST_BYTES = 64_000_000
# An event has three files for each station, and a readme or two.
_MOST_MEMBERS = 200
_GZIP, _ZIP = b"\x1f\x8b", (b"PK\x03\x04", b"PK\x05\x06")
# Of bzip2 the size of its blocks comes between.
_BZIP2, _BLOCK = b"BZh", (b"1AY&SY", b"\x17rE8P\x90")
_OLD_WORKBOOK = b"\xd0\xcf\x11\xe0\xa1\xb1\x1a\xe1"
_WORKBOOK = (b"xl/workbook.", b"mimetypeapplication/vnd.oasis.opendocument.spreadsheet")
_TAR_AT, _TAR = 257, b"ustar"


def is_workbook(data: bytes) -> bool:
    """Whether a file is of a spreadsheet program: one of its formats of today, which are zips, or of before."""
    if data.startswith(_OLD_WORKBOOK):
        return True
    return data.startswith(_ZIP) and any(mark in data for mark in _WORKBOOK)


def is_archive(data: bytes) -> bool:
    """Whether a file holds others."""
    return data.startswith((_GZIP, *_ZIP)) or _is_bzip2(data) or _is_tar(data)


def _is_bzip2(data: bytes) -> bool:
    return data.startswith(_BZIP2) and data[4:].startswith(_BLOCK)


def _is_tar(data: bytes) -> bool:
    return data.startswith(_TAR, _TAR_AT)


def unpacked(data: bytes, name: str) -> list[tuple[str, bytes]]:
    """Return the files in an archive, each with its name.

    Nothing is written anywhere, so that a name may say what it likes. Archives in archives stay as they are, but for a
    tar that is compressed as a whole.

    Raises
    ------
    InputError
        Where it is damaged, encrypted, or holds more than any record.
    """
    try:
        if data.startswith(_ZIP):
            return _taken(_zip_members(data, name), name)
        if not _is_tar(data):
            data, name = _inflated(data, name), name.removesuffix(".gz").removesuffix(".bz2")
            if not _is_tar(data):
                return [(name, data)]
        return _taken(_tar_members(data), name)
    except (InputError, MemoryError):
        raise
    except Exception as error:  # a damaged archive ends in whatever its readers stumble over
        reason = " ".join(str(error).split())[:80] or type(error).__name__
        raise _unreadable(name, reason=reason) from None


def _inflated(data: bytes, name: str) -> bytes:
    """Decompress gzip or bzip2 data, all stretches of it."""
    import bz2
    import gzip

    with gzip.GzipFile(fileobj=io.BytesIO(data)) if data.startswith(_GZIP) else bz2.BZ2File(io.BytesIO(data)) as stream:
        content = stream.read(LARGEST_BYTES + 1)
    if len(content) > LARGEST_BYTES:
        raise _too_large(name)
    return content


_unreadable = partial(InputError, "source-unreadable", expected="the record, unpacked")
# Of each file of an archive: what it is called, and where its content is read.
_Members = Iterator[tuple[str, IO[bytes]]]


def _taken(members: _Members, name: str) -> list[tuple[str, bytes]]:
    """Read files, which may state any size, until there are too many of them or too much is in them."""
    contents: list[tuple[str, bytes]] = []
    left = LARGEST_BYTES
    for own, member in members:
        if len(contents) == _MOST_MEMBERS:
            raise _unreadable(name, reason=f"it holds more than {_MOST_MEMBERS} files")
        with member:
            content = member.read(left + 1)
        left -= len(content)
        if left < 0:
            raise _too_large(name)
        contents.append((PurePosixPath(own.replace("\\", "/")).name or name, content))
    return contents


def _zip_members(data: bytes, name: str) -> _Members:
    import zipfile

    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        for entry in archive.infolist():
            if entry.flag_bits & 1:
                raise _unreadable(name, reason="it is encrypted")
            if not entry.is_dir():
                yield entry.filename, archive.open(entry)


def _tar_members(data: bytes) -> _Members:
    import tarfile

    with tarfile.open(fileobj=io.BytesIO(data), mode="r:") as archive:
        headers = 0
        # Links and devices lead elsewhere and hold nothing of their own.
        while (entry := archive.next()) is not None:
            headers += 1
            if headers > 2 * _MOST_MEMBERS or entry.size < 0:
                raise ValueError("it never ends")
            member = archive.extractfile(entry) if entry.isreg() else None
            if member is not None:
                yield entry.name, member
        # A header that is damaged ends it as its end does.
        if data[archive.offset : archive.offset + tarfile.BLOCKSIZE].strip(b"\0"):
            raise ValueError("it is damaged")


def _too_large(name: str) -> InputError:
    return InputError(
        "too-large", name, f"{LARGEST_BYTES // 10**6} MB when unpacked", expected="a file with one record"
    )
