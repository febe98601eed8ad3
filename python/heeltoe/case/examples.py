"""The examples: cases and studies to start from, which come with the package."""

from __future__ import annotations

import shutil
from pathlib import Path

_PACKAGE = Path(__file__).parents[1]
_SOURCES = _PACKAGE.parents[1]


def examples_folder() -> Path:
    """Return the folder of the examples: that of the sources where the package runs from them, else its own."""
    return (_SOURCES if (_SOURCES / "crates").is_dir() else _PACKAGE) / "examples"


def copy_examples(directory: Path) -> None:
    """Copy all cases and studies, in their folders, into a directory that is there."""
    for path in sorted(examples_folder().rglob("*.toml")):
        place = directory / path.relative_to(examples_folder())
        place.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path, place)
