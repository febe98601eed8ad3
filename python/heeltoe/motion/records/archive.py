"""Records in a zip or behind gzip: unpacked in memory alone, up to a bound, whatever an archive says of itself."""

from __future__ import annotations

import io
import zipfile
import zlib
from pathlib import PurePosixPath

from heeltoe.errors import InputError

#: No record comes near; what is larger is something else.
LARGEST_BYTES = 64_000_000
# An event has three files for each station, and a readme or two.
_MOST_MEMBERS = 200
_GZIP, _ZIP = b"\x1f\x8b", (b"PK\x03\x04", b"PK\x05\x06")
_PIECE = 1 << 20


def is_archive(data: bytes) -> bool:
    """Whether a file holds others."""
    return data.startswith((_GZIP, *_ZIP))


def unpacked(data: bytes, name: str) -> list[tuple[str, bytes]]:
    """Return the files in an archive, each with its name.

    Nothing is written anywhere, so that a name may say what it likes. Archives in archives stay as they are.

    Raises
    ------
    InputError
        Where it is damaged, encrypted, or holds more than any record.
    """
    try:
        if data.startswith(_GZIP):
            return [(name.removesuffix(".gz"), _inflated(data, name))]
        return _members(data, name)
    # A way of packing that is not known here is a RuntimeError.
    except (zipfile.BadZipFile, zlib.error, EOFError, RuntimeError, ValueError, OSError) as error:
        reason = " ".join(str(error).split())[:80] or type(error).__name__
        raise InputError("record-archive", name, reason=reason) from None


def _inflated(data: bytes, name: str) -> bytes:
    """The stretches behind gzip, one behind the other."""
    whole = bytearray()
    while data.startswith(_GZIP):
        stretch = zlib.decompressobj(wbits=31)
        while data and not stretch.eof:
            whole += stretch.decompress(data, _PIECE)
            data = stretch.unconsumed_tail
            if len(whole) > LARGEST_BYTES:
                raise _too_large(name)
        if not stretch.eof:
            raise EOFError("it ends too early")
        data = stretch.unused_data
    return bytes(whole)


def _members(data: bytes, name: str) -> list[tuple[str, bytes]]:
    found: list[tuple[str, bytes]] = []
    left = LARGEST_BYTES
    with zipfile.ZipFile(io.BytesIO(data)) as archive:
        listed = [each for each in archive.infolist() if not each.is_dir()]
        if len(listed) > _MOST_MEMBERS:
            raise InputError("record-archive", name, reason=f"it holds {len(listed)} files")
        for each in listed:
            if each.flag_bits & 1:
                raise InputError("record-archive", name, reason="it is encrypted")
            # The size that an archive states may be a lie.
            with archive.open(each) as member:
                content = member.read(left + 1)
            left -= len(content)
            if left < 0:
                raise _too_large(name)
            found.append((PurePosixPath(each.filename.replace("\\", "/")).name or name, content))
    return found


def _too_large(name: str) -> InputError:
    return InputError("record-large", name, f"more than {LARGEST_BYTES // 10**6} MB when unpacked")
