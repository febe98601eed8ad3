"""The one visual language of all figures: colours, hatches, headings, axes that every figure shares.

Colours are those of Okabe and Ito, which readers with colour-blindness can tell apart. In black and white what they
mean is also told by line style, hatch, place or lightness.
"""

from __future__ import annotations

import re
import textwrap
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from functools import lru_cache, partial, wraps
from typing import Any, ParamSpec, TypeVar

import matplotlib as mpl
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg, RendererAgg
from matplotlib.figure import Figure
from matplotlib.transforms import Bbox, ScaledTranslation

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
#: Colours and dashes of curves beside each other that mean no one thing.
LOOKS = (("slip", "-"), ("rotation", "--"), ("toe", "-."), ("heel", ":"))
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

WIDTH = 6.69
"""Of every figure [in]: the text of a page of A4, so that letters are printed as large as they are drawn."""
# Width of a letter in sizes of it, of the handle of a legend with the gaps around it [pt], and the least size [pt].
_LETTER, _HANDLE, _SMALL = 0.56, 34.0, 7.0
# Room for the numbers of a vertical axis, "−0.0025" with its tick [pt].
_NUMBERS = 42.0
_WAY = re.compile(r"\s*\(\+ [^)]*\)")
# A line of a heading, in sizes of its letters: 10 points.
_LINE = 45.5

STYLE: dict[Any, Any] = {
    "font.size": 8,
    "axes.titlesize": 8,
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
    families = list(dict.fromkeys(family for _, result in parts for family in result))
    text = "\n".join(wrapped(line, _LINE) for line, _ in parts)
    # A dollar in a title is a dollar, no formula.
    figure.suptitle(text, fontsize=10, x=0.01, ha="left", fontfamily=families, parse_math=False)


def describe(figure: Figure, response: Response, *lines: str) -> None:
    """Write above a figure which case, motion and model it shows, and further lines."""
    damping = response.summary.get("damping")
    model = f"{response.model} model" + (f", {damping} damping" if damping else "")
    heading(figure, response.title or "Untitled case", f"{shaken_by(response)}; {model}", *lines)


def shaken_by(response: Response) -> str:
    """Say what shakes the dam, and how strongly."""
    text = f"{response.motion.name}, peak {response.motion.pga / response.gravity:.3g} g"
    others = (("vertical", response.vertical), ("across the valley", response.cross))
    for name, motion in others:
        if motion is not None:
            text += f"; {name} {motion.name}, peak {motion.pga / response.gravity:.3g} g"
    return text


def without_heading(figure: Figure) -> Figure:
    """Take the heading off a figure, for a page that has a caption below it."""
    figure.suptitle("")
    return figure


def align_labels(axes: Sequence[Axes]) -> None:
    """Put the labels of the vertical axes of panels above each other at one distance, beyond the longest number.

    ``Figure.align_ylabels`` does that with the numbers of all panels for each of them, at every drawing.
    """
    for panel in axes:
        beyond = ScaledTranslation(-_NUMBERS / 72.0, 0.0, panel.figure.dpi_scale_trans)
        panel.yaxis.set_label_coords(0.0, 0.5, transform=panel.transAxes + beyond)


def fit_time_label(axes: Axes) -> None:
    """Break the words of an axis of time where they are longer than it is wide: others may stand beside it."""
    label = axes.xaxis.label
    if not label.get_text().startswith("time"):
        return
    room = 72.0 / axes.figure.dpi * float(axes.bbox.width) / (_LETTER * float(label.get_fontsize()))
    label.set_text(textwrap.fill(label.get_text().replace("\n", " "), max(int(1.1 * room), 24)))


def fit_words(figure: Figure) -> None:
    """Let the words of a figure fit: legends below it in as many columns as have room, longer lines broken, and what
    stands beside a panel shorter than the panel is high.

    A report makes figures narrower and lower than those that are files of their own; its captions say which way is
    positive.
    """
    for axes in figure.axes:
        fit_time_label(axes)
        high = 72.0 * float(figure.get_figheight()) * axes.get_position().height
        label = axes.yaxis.label
        for shorter in (lambda text: text, _without_way, lambda text: _without_way(text).replace(" [", "\n[")):
            words = shorter(label.get_text())
            if max(map(len, words.split("\n"))) * _LETTER * float(label.get_fontsize()) <= high:
                break
        label.set_text(words)
    room = 72.0 * float(figure.get_figwidth())
    for legend in list(figure.legends):
        texts, handles = legend.get_texts(), [handle for handle in legend.legend_handles if handle is not None]
        letter = _LETTER * float(texts[0].get_fontsize())
        lines = [textwrap.fill(text.get_text(), int((room - _HANDLE) / letter)) for text in texts]
        widest = max(len(part) for line in lines for part in line.split("\n")) * letter + _HANDLE
        columns = max(1, min(len(lines), int(room / widest)))
        legend.remove()
        figure.legend(handles, lines, loc="outside lower center", ncols=columns, columnspacing=1.2, handlelength=1.8)
    if figure.get_supxlabel():
        words = "\n".join(
            even_lines(line, int(room / (_LETTER * _SMALL))) for line in figure.get_supxlabel().split("\n")
        )
        figure.supxlabel(words, fontsize=_SMALL)


def even_lines(text: str, width: int) -> str:
    """Break a text into as few lines as a width in letters asks for, none much shorter than the others."""
    count = len(textwrap.wrap(text, width))
    longest = max(map(len, text.split()), default=1)
    fitting = (narrow for narrow in range(longest, width) if len(textwrap.wrap(text, narrow)) == count)
    return textwrap.fill(text, next(fitting, width))


def _without_way(text: str) -> str:
    """Take off a label which way is positive."""
    return _WAY.sub("", text)


@contextmanager
def laid_out(figure: Figure) -> Iterator[None]:
    """Lay a figure out once for all files that are made of it; each would do it anew, with a drawing for nothing."""
    engine = figure.get_layout_engine()
    with mpl.rc_context(STYLE | {"figure.constrained_layout.use": False, "figure.autolayout": False}), _steady(figure):
        if engine is not None:
            with _roughly_first(figure), _measured(figure):
                engine.execute(figure)
        figure.set_layout_engine(None)
        try:
            yield
        finally:
            figure.set_layout_engine(engine)


@contextmanager
def _measured(figure: Figure) -> Iterator[None]:
    """Let one renderer measure the words of all figures, as many of them recur."""
    canvas = figure.canvas
    _Ruler(figure)
    try:
        yield
    finally:
        figure.set_canvas(canvas)


class _Ruler(FigureCanvasAgg):
    """A canvas on which nothing is drawn."""

    def get_renderer(self) -> RendererAgg:
        return _ruler(float(self.figure.dpi))


@lru_cache(maxsize=4)
def _ruler(dpi: float) -> RendererAgg:
    return RendererAgg(1, 1, dpi)  # type: ignore[no-untyped-call]


@contextmanager
def _steady(figure: Figure) -> Iterator[None]:
    """Let the axes of a figure, in which nothing is changed meanwhile, find their ticks once for each size, and measure
    the numbers at them once for each place; each spine and label would do it anew."""
    every: list[Any] = [axis for axes in figure.axes for axis in (axes.xaxis, axes.yaxis)]
    # Names inside matplotlib 3.11: a version without them finds all anew.
    held = [
        (axis, name, state)
        for axis in every
        for name, state in (("_update_ticks", _size), ("_get_ticklabel_bboxes", _place))
        if hasattr(axis, name)
    ]
    for axis, name, state in held:
        setattr(axis, name, _Once(getattr(axis, name), partial(state, axis)))
    try:
        yield
    finally:
        for axis, name, _ in held:
            delattr(axis, name)


class _Once:
    """Takes the place of a method as long as the state of its axis is the same."""

    def __init__(self, method: Callable[..., Any], state: Callable[..., Any]) -> None:
        self._method, self._state = method, state
        self._before: Any = None
        self._result: Any = None

    def __call__(self, *args: Any) -> Any:
        state = self._state(*args)
        if state != self._before:
            self._before, self._result = state, self._method(*args)
        return self._result


def _size(axis: Any) -> tuple[float, ...]:
    """Return what the ticks of an axis depend on: its ends, and how large its axes are [in]."""
    box = axis.axes.bbox
    return (*axis.get_view_interval(), *(round(float(side) / axis.axes.figure.dpi, 9) for side in box.size))


def _place(axis: Any, ticks: list[Any], renderer: Any) -> tuple[Any, ...]:
    """Return what the boxes of the numbers at ticks depend on."""
    return (*axis.get_view_interval(), *axis.axes.bbox.bounds, renderer, *ticks)


# Labels around the axes of a panel over time, from the left counter-clockwise [pt].
_AROUND = (50.0, 12.0, 4.0, 12.0)


@contextmanager
def _roughly_first(figure: Figure) -> Iterator[None]:
    """Let the first of the two rounds of a layout, which makes axes about as large as they will be, take an estimate of
    the labels around them; the second round measures these. Maps and their bars are measured twice: their size depends
    on it."""
    panels = list(figure.axes)
    if any(axes.get_aspect() != "auto" or hasattr(axes, "_colorbar") for axes in panels):
        yield
        return
    for axes in panels:
        axes.get_tightbbox = _Estimate(axes)  # type: ignore[method-assign]
    try:
        yield
    finally:
        for axes in panels:
            del axes.get_tightbbox


class _Estimate:
    """Takes the place of the method of axes that measures what stands around them; estimates it when first called."""

    def __init__(self, axes: Axes) -> None:
        self._measure, self._axes, self._asked = axes.get_tightbbox, axes, False

    def __call__(self, renderer: Any = None, **options: Any) -> Any:
        if self._asked:
            return self._measure(renderer, **options)
        self._asked = True
        left, below, right, above = (self._axes.figure.dpi / 72.0 * size for size in _AROUND)
        box = self._axes.get_window_extent()
        return Bbox.from_extents(box.x0 - left, box.y0 - below, box.x1 + right, box.y1 + above)
