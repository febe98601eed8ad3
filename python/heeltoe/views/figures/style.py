"""The one visual language of all figures: colours, hatches, headings, axes that every figure shares.

Colours are those of Okabe and Ito, which readers with colour-blindness can tell apart. In black and white what they
mean is also told by line style, hatch, place or lightness.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from functools import wraps
from typing import Any, ParamSpec, TypeVar

import matplotlib as mpl
from matplotlib.figure import Figure

from heeltoe.errors.sanitize import plain
from heeltoe.result.response import Response
from heeltoe.views.figures.fonts import PLAIN, readable, wrapped

COLOURS = {
    "ground": "#000000",
    "slip": "#0072B2",
    "rotation": "#D55E00",
    "heel": "#CC79A7",
    "toe": "#009E73",
    "limit": "#777777",
    "concrete": "#D0D0D0",
    "concrete below": "#ECECEC",
    "water": "#CFE6F5",
    "silt": "#E3D3B0",
    "crack": "#B22222",
}
MODE_COLOURS = {
    "rest": "#BBBBBB",
    "slide": "#56B4E9",
    "rock": "#E69F00",
    "slide-rock": "#D55E00",
    "drift": "#000000",
}
"""Of the kinds of motion; each has its own row in the ribbon, which tells them apart in black and white."""
MODE_DASHES = {"slide": "-", "rock": ":", "slide-rock": "--", "drift": "-."}
MODE_HATCHES = {"rest": "", "slide": "", "rock": "...", "slide-rock": "///", "drift": "xxx"}

WIDTH = 7.5
"""Of every figure [in]: the text of a page of A4 or Letter."""
# A line of a heading, in sizes of its letters: 10 points.
_LINE = 51.0

STYLE: dict[Any, Any] = {
    "font.size": 9,
    "font.family": [PLAIN],
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "grid.color": "#E6E6E6",
    "grid.linewidth": 0.6,
    "axes.axisbelow": True,
    "legend.frameon": False,
    "hatch.linewidth": 0.5,
    "svg.fonttype": "none",
    # The same figure makes the same file.
    "svg.hashsalt": "heeltoe",
}

_P = ParamSpec("_P")
_F = TypeVar("_F", Figure, Figure | None)


def styled(draw: Callable[_P, _F]) -> Callable[_P, _F]:
    """Let a function draw in this style, whoever calls it."""

    @wraps(draw)
    def drawn(*args: _P.args, **kwargs: _P.kwargs) -> _F:
        with mpl.rc_context(STYLE):
            return draw(*args, **kwargs)

    return drawn


def heading(figure: Figure, *lines: str) -> None:
    """Write lines above a figure, from the left; they may say anything, at any length."""
    parts = [readable(plain(line)) for line in lines if line]
    families = list(dict.fromkeys(family for _, found in parts for family in found))
    text = "\n".join(wrapped(line, _LINE) for line, _ in parts)
    # A dollar in a title is a dollar, no formula.
    figure.suptitle(text, fontsize=10, x=0.01, ha="left", fontfamily=families, parse_math=False)


def describe(figure: Figure, response: Response) -> None:
    """Write above a figure which case, motion and model it shows."""
    damping = response.summary.get("damping")
    model = f"{response.model} model" + (f", {damping} damping" if damping else "")
    heading(figure, response.title or "Untitled case", f"{shaken_by(response)}; {model}")


def shaken_by(response: Response) -> str:
    """Say what shakes the dam, and how strongly."""
    text = f"{response.motion.name}, peak {response.motion.pga / response.gravity:.3g} g"
    up = response.vertical
    return text if up is None else f"{text}; vertical {up.name}, peak {up.pga / response.gravity:.3g} g"


def without_heading(figure: Figure) -> Figure:
    """Take the heading off a figure, for a page that has a caption below it."""
    figure.suptitle("")
    return figure


@contextmanager
def laid_out(figure: Figure) -> Iterator[None]:
    """Lay a figure out once for all files that are made of it; each would do it anew, with a drawing for nothing."""
    engine = figure.get_layout_engine()
    with mpl.rc_context(STYLE | {"figure.constrained_layout.use": False, "figure.autolayout": False}):
        if engine is not None:
            engine.execute(figure)
        figure.set_layout_engine(None)
    try:
        yield
    finally:
        figure.set_layout_engine(engine)
