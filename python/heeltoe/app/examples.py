"""The cases to start from."""

from __future__ import annotations

from pathlib import Path

#: What the app opens with.
FIRST = "typical-base"
# They stand beside the package where it runs from its sources; an installed one has the case of `heeltoe new` alone.
_FOLDER = Path(__file__).parents[3] / "examples"
_OF_NEW = "new"


def examples() -> list[str]:
    """Return the names of the cases to start from, that which the app opens with first."""
    found = sorted(path.stem for path in _FOLDER.glob("*.toml"))
    return sorted(found, key=lambda name: name != FIRST) or [_OF_NEW]


def example_path(name: str, folder: Path) -> Path | None:
    """Return the file of an example, None where there is none of this name; what has no file is written to `folder`."""
    if name not in examples():
        return None
    if name != _OF_NEW:
        return _FOLDER / f"{name}.toml"
    from heeltoe.case.template import new_case_text

    path = folder / "new.toml"
    path.write_text(new_case_text("new"), encoding="utf-8")
    return path
