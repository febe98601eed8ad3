"""The scene drawn for a video: what stays is drawn once, what moves is drawn over it (matplotlib, Agg)."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple, cast

import numpy as np
from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.colors import to_rgba_array
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import PathPatch, Polygon, Rectangle
from matplotlib.path import Path as Outline
from matplotlib.text import Text

from heeltoe.base.arrays import Floats
from heeltoe.views.animation import look
from heeltoe.views.animation.bodies import Part
from heeltoe.views.animation.charts import Charts, animated, dots
from heeltoe.views.animation.frames import ARROW, CUT, Scene
from heeltoe.views.figures.fonts import readable, wrapped

#: Of the picture [inches]; with 100 pixels to the inch 1280 x 720.
SIZE = (12.8, 7.2)
# Room for the lines above, in sizes of their letters.
_TITLE_EMS, _SUBTITLE_EMS = 56.0, 60.0
# Places of the views as parts of the picture: left, bottom, width, height.
_ONE = (0.016, 0.115, 0.66, 0.765)
_WHOLE, _NEAR = (0.016, 0.28, 0.24, 0.6), (0.266, 0.115, 0.41, 0.765)


class Picture:
    """Draws a scene moment by moment into the same pixels.

    Parameters
    ----------
    scene
        What to draw.
    pixels_per_inch
        The picture is 12.8 x 7.2 inches large.
    """

    def __init__(self, scene: Scene, pixels_per_inch: int) -> None:
        self.figure = Figure(figsize=SIZE, dpi=pixels_per_inch, facecolor="white")
        # matplotlib has no types for what follows.
        self.canvas = cast(Any, FigureCanvasAgg(self.figure))
        _heading(self.figure, scene)
        places = [_ONE] if len(scene.views) == 1 else [_WHOLE, _NEAR]
        views = [_View(_fitted(self.figure, view, at), scene) for view, at in zip(scene.views, places, strict=True)]
        views[0].add_ground_arrow()
        views[-1].add_crack()
        if len(views) > 1:
            views[0].add_frame(scene.views[1])
        self.moving: list[_View | Charts] = [*views, Charts(self.figure, scene)]
        self.canvas.draw()
        self.still = self.canvas.copy_from_bbox(self.figure.bbox)
        self.words: dict[tuple[int, str], Any] = {}

    @property
    def size(self) -> tuple[int, int]:
        """Width and height in pixels."""
        width, height = self.canvas.get_width_height()
        return int(width), int(height)

    def draw(self, frame: int) -> memoryview:
        """Draw one moment and return its pixels, row by row from the top: red, green, blue and opacity."""
        self.canvas.restore_region(self.still)
        renderer = self.canvas.get_renderer()
        for part in self.moving:
            for artist in part.at(frame):
                if isinstance(artist, Text):
                    self._write(artist, renderer)
                else:
                    artist.draw(renderer)
        pixels: memoryview = self.canvas.buffer_rgba()
        return pixels

    def _write(self, words: Text, renderer: Any) -> None:
        """Draw words that stay where they are, on an empty place: what they look like is kept, as to draw them takes
        a third of all the time."""
        key = (id(words), words.get_text())
        if key in self.words:
            self.canvas.restore_region(self.words[key])
        else:
            words.draw(renderer)
            self.words[key] = self.canvas.copy_from_bbox(words.get_window_extent(renderer).padded(2.0))


def _heading(figure: Figure, scene: Scene) -> None:
    lines: tuple[tuple[str, float, dict[str, Any]], ...] = (
        (wrapped(scene.title, _TITLE_EMS, 1), 0.955, {"fontsize": 15, "fontweight": "bold"}),
        (wrapped(scene.subtitle, _SUBTITLE_EMS, 1), 0.908, {"fontsize": 10, "color": "#444444"}),
    )
    for line, height, style in lines:
        shown, families = readable(line)
        figure.text(0.016, height, shown, va="center", parse_math=False, fontfamily=families, **style)
    text = look.exaggeration_text(scene.exaggeration)
    figure.text(0.984, 0.908, text, fontsize=11, color="#a03000", va="center", ha="right")


def _fitted(figure: Figure, view: tuple[float, float, float, float], place: tuple[float, float, float, float]) -> Axes:
    """Return axes in a place that show a view whole and to scale, as low as the place allows or filling it."""
    x0, x1, z0, z1 = view
    left, bottom, width, height = place
    wide, high = width * SIZE[0], height * SIZE[1]
    scale = max((x1 - x0) / wide, (z1 - z0) / high)
    missing = (scale * wide - (x1 - x0)) / 2.0
    # A picture higher than it needs to be is cut at its foot rather than filled with sky.
    used = min(height, 1.12 * (z1 - z0) / scale / SIZE[1])
    axes = figure.add_axes((left, bottom + height - used, width, used))
    axes.set_xlim(x0 - missing, x1 + missing)
    axes.set_ylim(z0, z0 + scale * used * SIZE[1])
    axes.set_xticks([])
    axes.set_yticks([])
    for spine in axes.spines.values():
        spine.set_color("#cccccc")
    return axes


class _Body(NamedTuple):
    part: Part
    fill: Polygon
    grid: Line2D
    crack: Line2D


class _View:
    """One picture of the dam."""

    def __init__(self, axes: Axes, scene: Scene) -> None:
        self.axes, self.scene = axes, scene
        self.sides = axes.get_xlim()
        self.foot = axes.get_ylim()[0]
        # Where there is a picture of the crack, the other one is too small for lines between elements.
        self.detailed = False
        # Told the frame and where the parts are drawn; they return what is drawn over the dam.
        self.overlays: list[Callable[[int, dict[int, Floats]], list[Any]]] = []
        x0, x1 = self.sides
        if scene.base > self.foot:
            depth = scene.base - self.foot
            axes.add_patch(Rectangle((x0, self.foot), x1 - x0, depth, facecolor=look.GROUND, edgecolor="none"))
            axes.plot([x0, x1], [scene.base, scene.base], color=look.EDGE, linewidth=1.0)
        self.waters = []
        for level, upstream in ((scene.water, True), (scene.tailwater, False)):
            if level is not None and level > max(scene.base, self.foot):
                water = animated(axes.add_patch(Polygon([(0, 0)], facecolor=look.WATER, edgecolor="none")))
                box = Rectangle((x0, self.foot), x1 - x0, level - self.foot, transform=axes.transData)
                water.set_clip_path(box)
                surface = animated(axes.plot([], [], color=look.SURFACE, linewidth=1.4)[0])
                self.waters.append((water, surface, level, upstream))
        # The part below the crack behind the part above.
        self.bodies = [
            self._body(part, look.LOWER if place > scene.above else look.UPPER)
            for place, part in enumerate(scene.parts)
        ][::-1]
        # Where the part above the crack was before the earthquake, against which its slip is seen.
        upper = scene.parts[scene.above]
        before = upper.points[[*upper.outline, upper.outline[0]]].T
        line = animated(axes.plot(*before, color=look.BEFORE, linewidth=0.8, dashes=(5, 4))[0])
        self.overlays.append(lambda frame, drawn: [line])
        if scene.anchors:
            self._add_anchors()

    def _add_anchors(self) -> None:
        """Draw the anchors from foot to head as the parts carry them."""
        scene = self.scene
        # The head has a mark.
        style: dict[str, Any] = {"linewidth": 1.2, "linestyle": "-.", "marker": "s", "markersize": 3, "markevery": [1]}
        lines = [animated(self.axes.plot([], [], color=look.ANCHOR, **style)[0]) for _ in scene.anchors]
        rest = [part.points for part in scene.parts]

        def move(frame: int, drawn: dict[int, Floats]) -> list[Any]:
            now = [drawn[id(part)] for part in scene.parts]
            for line, anchor in zip(lines, scene.anchors, strict=True):
                line.set_data(*anchor.drawn(now, rest).T)
            return lines

        self.overlays.append(move)

    def _body(self, part: Part, colour: str) -> _Body:
        fill = Polygon([(0, 0)], facecolor=colour, edgecolor=look.EDGE, linewidth=0.9)
        grid, crack = self.axes.plot([], [], look.GRID, [], [], look.EDGE)
        grid.set_linewidth(0.5)
        crack.set_linewidth(1.8)
        return _Body(part, animated(self.axes.add_patch(fill)), animated(grid), animated(crack))

    def add_frame(self, near: tuple[float, float, float, float]) -> None:
        """Show what the picture of the crack shows."""
        x0, x1, z0, z1 = near
        box = Rectangle((x0, z0), x1 - x0, z1 - z0, fill=False, linestyle="--", edgecolor="#666666", linewidth=0.8)
        self.axes.add_patch(animated(box))
        self.overlays.append(lambda frame, drawn: [box])

    def add_ground_arrow(self) -> None:
        """Add the arrow of the ground's acceleration below the dam."""
        scene = self.scene
        trace = scene.traces[0]
        peak = float(np.abs(trace.values).max()) or 1.0
        wide = np.ptp(self.sides)
        lengths = np.interp(scene.times, scene.history_times, trace.values) / peak * 0.13 * wide
        depth = scene.base - self.foot
        # Upstream of the dam, where no forces are drawn.
        at = np.array([self.sides[0] + 0.18 * wide, scene.base - 0.66 * depth])
        arrow = self._arrows("#222222")
        self.axes.text(
            self.sides[0] + 0.02 * wide, scene.base - 0.06 * depth, "ground accelerates", fontsize=8, va="top"
        )
        # As high as the ground allows.
        width = min(0.14 * depth, 0.015 * wide)

        def move(frame: int, drawn: dict[int, Floats]) -> list[Any]:
            vector = np.array([[lengths[frame], 0.0]])
            arrow.set_path(arrow_outlines(at + vector, vector, width))
            return [arrow]

        self.overlays.append(move)

    def add_crack(self) -> None:
        """Add forces and dots of the crack, with their legend below the picture."""
        self.detailed = True
        scene = self.scene
        upper = scene.parts[scene.above]
        few = scene.forces.shape[1] == 2
        bottom, top = scene.views[-1][2:]
        longest, width = ARROW * (top - bottom), (0.008 if few else 0.005) * (top - bottom)
        whole, cut = self._arrows(look.FORCE), self._arrows(look.FORCE_CUT)
        colours = to_rgba_array(look.STATUS[: len(scene.statuses)])
        size = 8.0 if few else 4.5
        nodes = dots(colours, size, np.empty((0, 2)), self.axes.transData, edgecolors=look.EDGE, linewidths=0.8)
        animated(self.axes.add_collection(nodes, autolim=False))

        def move(frame: int, drawn: dict[int, Floats]) -> list[Any]:
            at = drawn[id(upper)][upper.crack]
            forces = scene.forces[frame] / scene.force_scale
            sizes = np.hypot(*forces.T)
            fits = sizes <= CUT
            forces = longest * forces * np.minimum(1.0, CUT / np.where(sizes > 0.0, sizes, 1.0))[:, None]
            whole.set_path(arrow_outlines(at[fits], forces[fits], width))
            cut.set_path(arrow_outlines(at[~fits], forces[~fits], width))
            known = scene.status[frame] >= 0
            nodes.set_offsets(at[known])
            nodes.set_facecolor(colours[scene.status[frame][known]])
            return [whole, nodes] if fits.all() else [whole, cut, nodes]

        self.overlays.append(move)
        self._legend(longest)

    def _legend(self, longest: float) -> None:
        scene, figure = self.scene, self.axes.figure
        place = self.axes.get_position()
        long = longest / (self.sides[1] - self.sides[0]) * place.width
        y, x = 0.078, place.x0
        style = {"arrowstyle": "-|>,head_width=0.3", "color": look.FORCE, "linewidth": 2.2, "shrinkA": 0, "shrinkB": 0}
        self.axes.annotate("", (x + long, y), (x, y), "figure fraction", "figure fraction", arrowprops=style)
        text = look.force_text(scene.force_scale, scene.force_unit, CUT)
        figure.text(x + long + 0.008, y, text, fontsize=9, va="center")
        for colour, name in list(zip(look.STATUS, look.STATUS_NAMES, strict=True))[: len(scene.statuses)]:
            dot = Line2D([x + 0.005], [0.038], marker="o", color=colour, markeredgecolor=look.EDGE, markersize=6)
            figure.add_artist(dot)
            figure.text(x + 0.013, 0.038, name, fontsize=9, va="center")
            x += 0.03 + 0.006 * len(name)
        figure.add_artist(Line2D([x, x + 0.018], [0.038, 0.038], color=look.BEFORE, linewidth=0.8, dashes=(5, 4)))
        figure.text(x + 0.023, 0.038, "before", fontsize=9, va="center")
        if scene.anchors:
            line = Line2D([x + 0.075, x + 0.093], [0.038, 0.038], color=look.ANCHOR, linewidth=1.2, linestyle="-.")
            figure.add_artist(line)
            figure.text(x + 0.098, 0.038, "anchor", fontsize=9, va="center")

    def _arrows(self, colour: str) -> Any:
        return animated(
            self.axes.add_patch(PathPatch(Outline(np.zeros((1, 2))), facecolor=colour, edgecolor="none", zorder=5))
        )

    def at(self, frame: int) -> list[Any]:
        """Move everything to a moment and return what is to be drawn, from back to front."""
        scene = self.scene
        drawn = {id(part): part.drawn(frame, scene.exaggeration) for part in scene.parts}
        artists: list[Any] = []
        for water, surface, level, upstream in self.waters:
            edge = self.sides[0 if upstream else 1]
            face, back = (
                np.vstack(
                    [drawn[id(part)][part.upstream if side else part.downstream] for part in reversed(scene.parts)]
                )
                for side in (upstream, not upstream)
            )
            shore, end = shore_of(face, back[-1], level)
            water.set_xy(np.vstack([[edge, face[0, 1]], shore, [edge, shore[-1, 1]]]))
            surface.set_data([edge, end], [level, level])
            artists += [water, surface]
        for body in self.bodies:
            points = drawn[id(body.part)]
            body.fill.set_xy(points[body.part.outline])
            body.crack.set_data(*points[body.part.crack].T)
            artists.append(body.fill)
            if self.detailed and len(body.part.grid):
                body.grid.set_data(*_broken(points[body.part.grid]))
                artists.append(body.grid)
            artists.append(body.crack)
        return [*artists, *(artist for overlay in self.overlays for artist in overlay(frame, drawn))]


def arrow_outlines(tips: Floats, vectors: Floats, width: float) -> Outline:
    """Return arrows with these tips (k, 2) and lengths (k, 2) as one path; what has no length has no arrow."""
    sizes = np.hypot(*vectors.T)
    seen = sizes > 1e-3 * width
    if not seen.any():
        return Outline(np.empty((0, 2)))
    tips, along = tips[seen], vectors[seen] / sizes[seen][:, None]
    sizes = sizes[seen]
    across = np.column_stack([-along[:, 1], along[:, 0]])
    # A short arrow is all head.
    head = np.minimum(4.0 * width, sizes)
    half = 0.35 * head
    shaft = np.minimum(width / 2.0, half)
    corners = (
        (sizes, shaft),
        (head, shaft),
        (head, half),
        (np.zeros_like(sizes), np.zeros_like(sizes)),
        (head, -half),
        (head, -shaft),
        (sizes, -shaft),
        (sizes, shaft),
    )
    outline = np.stack([tips - back[:, None] * along + side[:, None] * across for back, side in corners], axis=1)
    codes = [Outline.MOVETO, *[Outline.LINETO] * 6, Outline.CLOSEPOLY]
    return Outline(outline.reshape(-1, 2), np.tile(codes, len(tips)))


def _broken(segments: Floats) -> Floats:
    """Return points (2, 3 e) of lines (e, 2, 2) as one line with breaks, which is drawn faster than many."""
    ends = np.full((len(segments), 1, 2), np.nan)
    path: Floats = np.concatenate([segments, ends], axis=1).reshape(-1, 2).T
    return path


def shore_of(face: Floats, far_top: Floats, level: float) -> tuple[Floats, float]:
    """Return what bounds the water before a face, and where its surface ends: above the crest at its far edge."""
    if level <= face[-1, 1]:
        return face, _at_level(face, level)
    return np.vstack([face, far_top, [far_top[0], level]]), float(far_top[0])


def _at_level(face: Floats, level: float) -> float:
    """Return where a face reaches a level first; its top where it does not."""
    above = np.flatnonzero(face[:, 1] >= level)
    last = int(above[0]) if above.size else len(face) - 1
    if last == 0 or not above.size:
        return float(face[last, 0])
    (x0, z0), (x1, z1) = face[last - 1], face[last]
    return float(x0 + (x1 - x0) * (level - z0) / (z1 - z0))
