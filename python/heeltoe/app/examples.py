"""The cases to start from."""

from __future__ import annotations

from pathlib import Path

from heeltoe.case.examples import examples_folder

#: What the app opens with.
FIRST = "typical-base"


def examples() -> list[str]:
    """Return the names of the cases to start from, that which the app opens with first."""
    found = sorted(path.stem for path in examples_folder().glob("*.toml"))
    return sorted(found, key=lambda name: name != FIRST)


def example_path(name: str) -> Path | None:
    """Return the file of an example, None where there is none of this name."""
    return examples_folder() / f"{name}.toml" if name in examples() else None
