"""Writing files into a directory: all of them or none."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from shutil import rmtree
from tempfile import TemporaryDirectory

from heeltoe.errors import InputError

VTK = "vtk"
"""The directory of the series of VTK files, one for each frame, of which only what lists them is told."""


def write_whole(
    write: Callable[[Path], None], directory: Path, own: tuple[str, ...], *, field: str = "--out"
) -> list[Path]:
    """Let `write` fill a place aside, then move all of it into `directory`, where files of the names `own` go.

    After a failure, or an interruption, there is what was there before.
    """
    made = next((place for place in (*reversed(directory.parents), directory) if not place.exists()), None)
    try:
        directory.mkdir(parents=True, exist_ok=True)
        with TemporaryDirectory(dir=directory) as fresh:
            write(Path(fresh))
            return _move(Path(fresh), directory, own)
    except BaseException as error:
        if made is not None:
            rmtree(made, ignore_errors=True)
        if isinstance(error, OSError):
            raise InputError("cannot-write", field, directory, reason=error.strerror or error) from None
        raise


def _move(fresh: Path, directory: Path, own: tuple[str, ...]) -> list[Path]:
    """Move all files to where they belong; remove what an earlier run has left there under the names `own`."""
    sources = sorted(path for path in fresh.rglob("*") if path.is_file())
    for folder in {source.parent.relative_to(fresh) for source in sources}:
        for name in own:
            (directory / folder / name).unlink(missing_ok=True)
        if folder.name == VTK:
            for series in ("dam", "crack"):
                for path in (directory / folder).glob(f"{series}-*.vtu"):
                    path.unlink()
    written = []
    for source in sources:
        place = directory / source.relative_to(fresh)
        place.parent.mkdir(parents=True, exist_ok=True)
        source.replace(place)
        # There are as many VTK files as frames; those that list them are the ones to open.
        if place.suffix != ".vtu":
            written.append(place)
    return written
