"""The examples: cases and studies to start from, which come with the package."""

from __future__ import annotations

import re
import shutil
import tomllib
from pathlib import Path

_PACKAGE = Path(__file__).parents[1]
_SOURCES = _PACKAGE.parents[1]


def examples_folder() -> Path:
    """Return the folder of the examples: that of the sources where the package runs from them, else its own."""
    return (_SOURCES if (_SOURCES / "crates").is_dir() else _PACKAGE) / "examples"


def list_examples() -> list[tuple[str, str]]:
    """Return the examples with a line on each: the first of its comment, or its title."""
    folder = examples_folder()
    return [(path.relative_to(folder).as_posix(), _line(path)) for path in sorted(folder.rglob("*.toml"))]


def _line(path: Path) -> str:
    """Return the first sentence of the comment that a file begins with; its title without one."""
    text = path.read_text(encoding="utf-8")
    comment = list[str]()
    for line in text.splitlines():
        if not line.startswith("#") or not line.strip("# "):
            break
        comment.append(line.strip("# "))
    if not comment:
        return str(tomllib.loads(text).get("title", ""))
    sentence = " ".join(comment)
    end = re.search(r"[.:](?= [A-Z0-9]|$)", sentence)
    return sentence[: end.start()] if end else sentence


def copy_examples(directory: Path) -> None:
    """Copy all cases and studies, in their folders, into a directory that is there."""
    for path in sorted(examples_folder().rglob("*.toml")):
        place = directory / path.relative_to(examples_folder())
        place.parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(path, place)
