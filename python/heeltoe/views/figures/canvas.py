"""Drawing on a section at one scale both ways: arrows, dimensions, and labels that keep out of each other's way."""

from __future__ import annotations

import math
from dataclasses import dataclass, field
from typing import Any

import numpy as np
import shapely
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.text import Text
from matplotlib.transforms import Bbox
from numpy.typing import ArrayLike

from heeltoe.base.arrays import Floats
from heeltoe.units.systems import Scale

_TEXT = 8.0
# Where a label may go, seen from what it explains: direction, in the order of preference.
_AROUND = ((1, 1), (-1, 1), (1, -1), (-1, -1), (1, 0), (-1, 0), (0, 1), (0, -1))
_SIDES = {1: "left", 0: "center", -1: "right"}
_LEVELS = {1: "bottom", 0: "center", -1: "top"}
_FAR = (4.0, 14.0, 28.0, 45.0, 62.0, 80.0)


@dataclass(eq=False)
class Canvas:
    """Axes that show a part of the section.

    Attributes
    ----------
    axes
        To draw on.
    length
        Unit of length in which they are; everything handed over here is in metres.
    size
        Of what is shown [m], to which margins and arrows are measured.
    taken
        Where on the picture labels and lines are already [pixels].
    """

    axes: Axes
    length: Scale
    size: float
    taken: list[Bbox] = field(default_factory=list)

    def look_at(self, low: ArrayLike, high: ArrayLike) -> None:
        """Show what is between two corners [m], and as much more as the shape of the axes asks for."""
        figure = self.axes.figure
        assert isinstance(figure, Figure)
        low, high = np.asarray(low, dtype=float), np.asarray(high, dtype=float)
        box = self.axes.get_position()
        wide, tall = (box.width, box.height) * figure.get_size_inches()
        span = high - low
        wanted = np.maximum(span, [span[1] * wide / tall, span[0] * tall / wide])
        middle = (low + high) / 2.0
        # Extra room goes to both sides and to the top.
        left, right = middle[0] - wanted[0] / 2.0, middle[0] + wanted[0] / 2.0
        self.axes.set_xlim(self.length(left), self.length(right))
        self.axes.set_ylim(self.length(low[1]), self.length(low[1] + wanted[1]))
        self.axes.set_aspect("equal")

    def points(self, places: ArrayLike) -> Floats:
        """Return places (n, 2) [m] as numbers on the axes."""
        points: Floats = self.length(np.atleast_2d(np.asarray(places, dtype=float)))
        return points

    def fill(self, shape: shapely.Geometry | ArrayLike, **look: Any) -> None:
        """Fill polygons, or the corners of one."""
        if not isinstance(shape, shapely.Geometry):
            self.axes.fill(*self.points(shape).T, **look)
            return
        for part in shapely.get_parts(shape):
            if part.geom_type == "Polygon":
                self.axes.fill(*self.points(shapely.get_coordinates(part.exterior)).T, **look)

    def line(self, places: ArrayLike, *, keep_off: bool = False, **look: Any) -> None:
        """Draw a line from place to place; labels keep off it on request."""
        points = self.points(places)
        self.axes.plot(*points.T, **look)
        if keep_off:
            self._take(points)

    def arrow(self, tail: ArrayLike, tip: ArrayLike, colour: str, *, width: float = 2.0) -> None:
        """Draw an arrow whose head does not outgrow it."""
        points = self.points(np.stack([tail, tip]))
        pixels = self.axes.transData.transform(points)
        figure = self.axes.figure
        long = 72.0 / figure.dpi * float(np.hypot(*(pixels[1] - pixels[0])))
        style = {
            "arrowstyle": "-|>",
            "color": colour,
            "linewidth": min(width, max(0.6, 0.2 * long)),
            "mutation_scale": min(13.0, max(3.0, 0.9 * long)),
            "shrinkA": 0.0,
            "shrinkB": 0.0,
        }
        self.axes.annotate("", points[1], points[0], arrowprops=style, zorder=6)
        self._take(points)

    def dimension(self, start: ArrayLike, end: ArrayLike, shift: ArrayLike = (0.0, 0.0)) -> None:
        """Draw a dimension line, `shift` [m] away from the measured length, with its value on it."""
        ends = np.stack([np.asarray(start, dtype=float), np.asarray(end, dtype=float)])
        moved = ends + np.asarray(shift, dtype=float)
        for place, far in zip(ends, moved, strict=True):
            # Below the dam, whose outline it would cover.
            self.line(np.stack([place, far]), color="#888888", linewidth=0.5, zorder=1.6)
        points = self.points(moved)
        style = {"arrowstyle": "<|-|>", "color": "#444444", "linewidth": 0.7, "mutation_scale": 7.0}
        self.axes.annotate("", points[1], points[0], arrowprops=style | {"shrinkA": 0.0, "shrinkB": 0.0})
        along = self.axes.transData.transform(points)
        level = abs(along[1, 0] - along[0, 0]) > abs(along[1, 1] - along[0, 1])
        drawn = self.axes.annotate(
            f"{self.length(math.dist(*ends)):.4g} {self.length.unit}",
            points.mean(axis=0),
            xytext=(0.0, 0.0),
            textcoords="offset points",
            rotation=0.0 if level else 90.0,
            ha="center",
            va="center",
            fontsize=_TEXT,
            color="#222222",
            bbox={"facecolor": "white", "edgecolor": "none", "pad": 0.8},
            zorder=7,
        )
        box = drawn.get_window_extent(self._renderer())
        if 1.5 * max(box.width, box.height) > float(np.hypot(*(along[1] - along[0]))):
            # No room between the arrows: beside them.
            drawn.set_rotation(0.0)
            drawn.set(**({"va": "bottom"} if level else {"ha": "left"}))
            drawn.xyann = (0.0, 3.0) if level else (4.0, 0.0)
        self._take(points)
        self.taken.append(drawn.get_window_extent(self._renderer()).padded(3.0))

    def label(self, text: str, place: ArrayLike, colour: str = "#000000", *, first: tuple[int, int] = (1, 1)) -> None:
        """Write next to a place [m], where nothing else is; `first` is the direction to try first."""
        point = self.points(place)[0]
        drawn = self.axes.annotate(
            text,
            point,
            xytext=(0.0, 0.0),
            textcoords="offset points",
            fontsize=_TEXT,
            color=colour,
            zorder=8,
            bbox={"facecolor": "white", "edgecolor": "none", "alpha": 0.75, "pad": 0.6},
        )
        renderer, inside = self._renderer(), self.axes.get_window_extent(self._renderer())
        pixel = self.axes.transData.transform(point)
        best, least = (drawn.xyann, "left", "bottom", drawn.get_window_extent(renderer)), math.inf
        for far in _FAR:
            for right, up in (first, *_AROUND):
                aligned = _SIDES[right], _LEVELS[up]
                drawn.set(ha=aligned[0], va=aligned[1])
                drawn.xyann = (far * right, far * up)
                box = drawn.get_window_extent(renderer)
                crowd = sum(_overlap(box, other) for other in self.taken)
                outside = box.width * box.height - _overlap(box, inside)
                if crowd + 10.0 * outside < least - 1e-9:
                    best, least = (drawn.xyann, *aligned, box), crowd + 10.0 * outside
            if least <= 1e-9:
                break
        drawn.set(ha=best[1], va=best[2])
        drawn.xyann = best[0]
        if math.hypot(*best[0]) > _FAR[1]:
            end = self.axes.transData.inverted().transform(
                (np.clip(pixel[0], best[3].x0, best[3].x1), np.clip(pixel[1], best[3].y0, best[3].y1))
            )
            self.axes.plot(*np.stack([point, end]).T, color=colour, linewidth=0.5, zorder=5.5)
        self.taken.append(best[3].padded(2.0))

    def keep_off(self, places: ArrayLike) -> None:
        """Keep labels off a line that is drawn already [m]."""
        self._take(self.points(places))

    def keep_off_text(self, drawn: Text) -> None:
        """Keep labels off a text that is drawn already."""
        self.taken.append(drawn.get_window_extent(self._renderer()).padded(2.0))

    def _renderer(self) -> Any:
        figure: Any = self.axes.figure
        canvas: Any = figure.canvas if isinstance(figure.canvas, FigureCanvasAgg) else FigureCanvasAgg(figure)
        return canvas.get_renderer()

    def _take(self, points: Floats) -> None:
        """Keep labels off a line, in pieces, so that a slanting one does not take the whole of its box."""
        pixels = self.axes.transData.transform(points)
        pieces = np.linspace(pixels[:-1], pixels[1:], 9)
        for start, end in zip(pieces[:-1].reshape(-1, 2), pieces[1:].reshape(-1, 2), strict=True):
            low, high = np.minimum(start, end) - 2.0, np.maximum(start, end) + 2.0
            self.taken.append(Bbox([low, high]))


def _overlap(one: Bbox, other: Bbox) -> float:
    wide = min(one.x1, other.x1) - max(one.x0, other.x0)
    tall = min(one.y1, other.y1) - max(one.y0, other.y0)
    return float(max(wide, 0.0) * max(tall, 0.0))
