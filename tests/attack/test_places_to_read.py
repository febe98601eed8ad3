"""What stands where a file should be that is read: nothing, noise, directories, devices, pipes, circles."""

from __future__ import annotations

import os
import socket
import subprocess
import sys
from collections.abc import Callable
from pathlib import Path

import pytest

from shared.attacked import Attack
from shared.dams import BASE, BLOCK, COARSE

SOUND = "# units: time [s], acceleration [g]\n" + "".join(f"{0.01 * k:.2f} {(-1) ** k * 0.2}\n" for k in range(50))


def _filled(content: bytes) -> Callable[[Path], object]:
    return lambda path: path.write_bytes(content)


def _sparse(path: Path) -> None:
    with path.open("wb") as file:
        file.truncate(10**11)


def _fifo(source: str) -> Callable[[Path], object]:
    """Return what makes a pipe, into which another process writes what is there."""

    def make(path: Path) -> subprocess.Popen[bytes]:
        os.mkfifo(path)
        return subprocess.Popen(["sh", "-c", 'cat "$0" > "$1"', source, path], stderr=subprocess.DEVNULL)

    return make


def _socket(path: Path) -> None:
    with socket.socket(socket.AF_UNIX) as made:
        made.bind(str(path.relative_to(Path.cwd())) if len(str(path)) > 100 else str(path))


def _circle(path: Path) -> None:
    path.symlink_to(path.name)


def _unreadable(path: Path) -> None:
    path.write_text(SOUND)
    path.chmod(0)


WHAT: dict[str, Callable[[Path], object]] = {
    "nothing": lambda path: None,
    "empty": _filled(b""),
    "zeros": _filled(bytes(5000)),
    "noise": _filled(bytes(range(256)) * 40),
    "one byte": _filled(b"\xff"),
    "UTF-16": _filled(SOUND.encode("utf-16")),
    "a mark": _filled(b"\xef\xbb\xbf"),
    "blanks": _filled(b" \r\n\t" * 4000),
    "one long line": _filled(b"1 " * 500_000),
    "brackets": _filled(b"[" * 100_000),
    "braces": _filled(b'{"a":' * 50_000),
    "keys": _filled(b"".join(b"k%d = 1\n" % k for k in range(20_000))),
    "a deep key": _filled(b".".join([b"a"] * 1_000) + b" = 1\n"),
    "a picture": _filled(b"\x89PNG\r\n\x1a\n" + bytes(100)),
    "a record": _filled(SOUND.encode()),
    "a directory": lambda path: path.mkdir(),
    "a circle": _circle,
    "a link to nowhere": lambda path: path.symlink_to("none/at/all"),
    "100 GB of nothing": _sparse,
    "no permission": _unreadable,
    "a pipe of noise": _fifo(sys.executable),
    "a pipe of nothing": _fifo(os.devnull),
    "a pipe without end": _fifo("/dev/zero"),
    "a socket": _socket,
    **{
        device: (lambda path, device=device: path.symlink_to(device))
        for device in ("/dev/zero", "/dev/null", "/dev/urandom", "/dev/full", "/proc/self/mem", "/proc/kmsg/x")
    },
}
_COARSE = [word for change in COARSE for word in ("--set", change)]
#: How each is read: the name of the file, and a command with it for "{}".
READERS: dict[str, tuple[str, list[str | Path]]] = {
    "case": ("what", ["run", "{}"]),
    "record": ("what", ["run", BLOCK, "--motion", "{}"]),
    "motion": ("what", ["motion", "{}"]),
    "mesh": ("what.inp", ["periods", BASE, "--set", "flexible.mesh_above={}", *_COARSE]),
    "gmsh": ("what.msh", ["periods", BASE, "--set", "flexible.mesh_above={}", *_COARSE]),
    "section": ("what.csv", ["run", BLOCK, "--set", "section={{file = '{}', unit = 'm'}}"]),
    "criteria": ("what", ["statics", BLOCK, "--criteria", "{}"]),
    "study": ("what", ["study", "{}", "--dry-run"]),
}


@pytest.mark.slow
@pytest.mark.parametrize("reader", READERS)
def test_what_is_there_is_read_or_refused(reader, tmp_path, record_property, monkeypatch):
    if reader in ("mesh", "gmsh"):
        pytest.importorskip("meshio")
    name, words = READERS[reader]
    strikes = Attack(f"places to read, {reader}")
    for what, make in WHAT.items():
        if what == "no permission" and os.geteuid() == 0:
            continue  # permissions are nothing to the administrator
        place = tmp_path / what.replace("/", "-").replace(" ", "-")
        place.mkdir()
        monkeypatch.chdir(place)
        writing = make(place / name)
        end = strikes.strike(f"{reader} {what}", *(str(word).format(place / name) for word in words), cwd=place)
        if isinstance(writing, subprocess.Popen):
            writing.kill()
            writing.wait()
        assert end != "accepted" or what == "a record", what
    strikes.report(record_property)
