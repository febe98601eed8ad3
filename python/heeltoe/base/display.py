"""How a thing shows itself in a notebook and as a figure, without knowing who draws it, and what it says to a name
that it does not have.

What is shown stands below what shows it: cases, motions and results know no views. The root of the package stands above
all of them and hands the faces in.
"""

from __future__ import annotations

from collections.abc import Callable
from os import PathLike
from typing import TYPE_CHECKING, Any, Protocol

from heeltoe.errors.sanitize import near

# Not at run time: who draws nothing does not wait for it.
if TYPE_CHECKING:
    from matplotlib.figure import Figure


class Plot(Protocol):
    """Draws a thing."""

    def __call__(
        self, thing: object, name: str | None, path: str | PathLike[str] | None, units: str | None, /
    ) -> Figure: ...


_FACES: dict[str, Any] = {}


def hand_in(*, html: Callable[[object], str], plot: Plot) -> None:
    """Take over the functions that write an object as HTML and draw it."""
    _FACES.update(html=html, plot=plot)


class Named:
    """An object that suggests an attribute where a name is misspelt."""

    # Type checkers would take any name for one that is there.
    if not TYPE_CHECKING:

        def __getattr__(self, name: str) -> Any:
            """Name the nearest attribute; what a class defines itself says why it is absent."""
            for cls in type(self).__mro__:
                if name in vars(cls) and hasattr(vars(cls)[name], "__get__"):
                    return vars(cls)[name].__get__(self, type(self))
            parent = getattr(super(), "__getattr__", None)
            if parent is not None:
                try:
                    return parent(name)
                except AttributeError:
                    pass
            attributes = (attribute for attribute in dir(self) if not attribute.startswith("_"))
            suggestion = "" if name.startswith("_") else near(name, attributes)
            # With another object Python adds no guess of its own.
            raise AttributeError(f"a {type(self).__name__} has no attribute {name!r}{suggestion}", name=name, obj=None)


class Shown(Named):
    """A thing that notebooks show as more than its name, and that can be drawn."""

    def _repr_html_(self) -> str:
        html: str = _FACES["html"](self)
        return html

    def plot(
        self, name: str | None = None, *, path: str | PathLike[str] | None = None, units: str | None = None
    ) -> Figure:
        """Draw it and return the figure.

        Parameters
        ----------
        name
            Which figure, of those that `heeltoe run --out` writes; the main one where it is not given.
        path
            File to write it to as well; its ending says the format.
        units
            ``"si"`` or ``"us"``; where they are not given, those of a case, and SI for all else.

        Raises
        ------
        InputError
            Where there is no such figure, nothing to draw, or the file cannot be written.
        """
        figure: Figure = _FACES["plot"](self, name, path, units)
        return figure
