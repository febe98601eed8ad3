"""How a thing shows itself in a notebook, without knowing who draws it.

What is shown stands below what shows it: cases, motions and results know no views. The root of the package stands above
all of them and hands the faces in.
"""

from __future__ import annotations

from collections.abc import Callable

_FACES: dict[str, Callable[[object], str]] = {}


def hand_in(*, html: Callable[[object], str]) -> None:
    """Take over what writes a thing as HTML."""
    _FACES["html"] = html


class Shown:
    """A thing that notebooks show as more than its name."""

    def _repr_html_(self) -> str:
        return _FACES["html"](self)
