"""Traces of a scene over time with a cursor, for a video (matplotlib)."""

from __future__ import annotations

from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import PathCollection
from matplotlib.figure import Figure
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle
from matplotlib.path import Path as Outline
from matplotlib.transforms import Affine2D, IdentityTransform, Transform

from heeltoe.base.arrays import Floats
from heeltoe.views.animation import look
from heeltoe.views.animation.frames import Scene, Trace
from heeltoe.views.figures.panels import kind_of

# Places as parts of the picture.
_LEFT, _WIDTH, _TOP, _BOTTOM = 0.715, 0.269, 0.79, 0.125
_RIBBON, _BETWEEN = 0.03, 0.062
# Width of a digit of the time, and of the point behind them.
_DIGIT, _POINT_AT = 0.0129, 0.007
# Diameter of the points of the traces [pt].
_POINT = 5.0


class Charts:
    """Traces and modes over time with a cursor, the time, and the mode of motion."""

    def __init__(self, figure: Figure, scene: Scene) -> None:
        self.scene = scene
        self.axes: list[Axes] = []
        self.traces: list[tuple[Axes, str, Floats]] = []
        groups: dict[str, list[Trace]] = {}
        for trace in scene.traces:
            groups.setdefault(trace.chart, []).append(trace)
        height = (_TOP - _BOTTOM - _RIBBON - _BETWEEN * len(groups)) / len(groups)
        y = _TOP
        for name, traces in groups.items():
            axes = figure.add_axes((_LEFT, y - height, _WIDTH, height))
            self._traces(axes, name, traces)
            y -= height + _BETWEEN
        axes = figure.add_axes((_LEFT, _BOTTOM, _WIDTH, _RIBBON))
        self._ribbon(axes)
        self._moving(figure)
        # The point of the time stays where it is, so that few pieces of text make all moments.
        point = _LEFT + _POINT_AT + _DIGIT * len(str(int(scene.times[-1])))
        style: dict[str, Any] = {"fontsize": 17, "fontweight": "bold", "va": "center"}
        self.seconds = animated(figure.text(point, 0.852, "", ha="right", **style))
        self.hundredths = animated(figure.text(point + 0.0015, 0.852, "", **style))
        self.mode = animated(figure.text(_LEFT + 0.125, 0.852, "", fontsize=9.5, va="center", parse_math=False))
        swatch = Rectangle((_LEFT + 0.105, 0.839), 0.0146, 0.026, transform=figure.transFigure)
        swatch.set(edgecolor="#888888", linewidth=0.6)
        self.swatch = animated(figure.add_artist(swatch))

    def _moving(self, figure: Figure) -> None:
        """Add what moves in all charts as two artists, in pixels: each of its own would take most of the time."""
        ends = [[box.y0, box.y1, np.nan] for box in (axes.get_window_extent() for axes in self.axes)]
        self.cursor = Line2D([], np.ravel(ends), color="#c00000", linewidth=1.2, transform=IdentityTransform())
        places = []
        for axes, _, values in self.traces:
            axes.autoscale_view()
            places.append(axes.transData.transform(np.column_stack([self.scene.times, values])))
        self.places = np.stack(places, axis=1)
        self.points = dots([colour for _, colour, _ in self.traces], _POINT, self.places[0], IdentityTransform())
        for artist in (self.cursor, self.points):
            animated(figure.add_artist(artist))

    def _traces(self, axes: Axes, name: str, traces: list[Trace]) -> None:
        scene, right = self.scene, 1.0
        # From the right to the left.
        for trace in reversed(traces):
            if trace.label:
                axes.text(
                    right,
                    1.03,
                    trace.label,
                    color=look.TRACES[trace.role],
                    fontsize=9,
                    ha="right",
                    transform=axes.transAxes,
                )
                right -= 0.05 + 0.022 * len(trace.label)
        # What reaches far would hide what does not.
        for trace in sorted(traces, key=lambda curve: -float(np.abs(curve.values).max())):
            colour = look.TRACES[trace.role]
            axes.plot(scene.history_times, trace.values, color=colour, linewidth=0.9)
            self.traces.append((axes, colour, np.interp(scene.times, scene.history_times, trace.values)))
        label = f"{name} [{traces[0].unit}]{', + downstream' if name == 'slip' else ''}"
        axes.set_title(label, fontsize=9, loc="left", pad=3)
        axes.tick_params(labelsize=8, labelbottom=False)
        axes.spines[["top", "right"]].set_visible(False)
        axes.grid(color="#e6e6e6", linewidth=0.6)
        axes.margins(y=0.08)
        self._time_axis(axes)

    def _ribbon(self, axes: Axes) -> None:
        scene = self.scene
        change = np.flatnonzero(np.diff(scene.history_mode)) + 1
        starts = np.concatenate([[0], change])
        ends = np.concatenate([change, [scene.history_mode.size - 1]])
        begin, end = scene.history_times[starts], scene.history_times[ends]
        colours = [look.MODES[kind_of(scene.modes[k])] for k in scene.history_mode[starts]]
        spans = list(zip(begin.tolist(), (end - begin).tolist(), strict=True))
        axes.broken_barh(spans, (0.0, 1.0), facecolors=colours)
        axes.set_ylim(0.0, 1.0)
        axes.set_yticks([])
        axes.set_title("mode", fontsize=9, loc="left", pad=3)
        axes.tick_params(labelsize=8)
        axes.spines[["top", "right"]].set_visible(False)
        self._time_axis(axes)
        axes.set_xlabel("time [s]", fontsize=9, loc="right", labelpad=1)
        seen = {kind_of(scene.modes[k]) for k in np.unique(scene.history_mode)}
        x = _LEFT
        for kind in (kind for kind in look.MODES if kind in seen):
            box = Rectangle((x, 0.029), 0.01, 0.018, transform=axes.figure.transFigure, facecolor=look.MODES[kind])
            axes.figure.add_artist(box)
            axes.figure.text(x + 0.013, 0.038, kind, fontsize=9, va="center")
            x += 0.025 + 0.0056 * len(kind)

    def _time_axis(self, axes: Axes) -> None:
        times = self.scene.times
        axes.set_xlim(times[0], times[-1])
        self.axes.append(axes)

    def at(self, frame: int) -> list[Any]:
        """Move cursors and texts to a moment and return them."""
        scene = self.scene
        now = float(scene.times[frame])
        self.cursor.set_xdata(np.full(3 * len(self.axes), self.places[frame, 0, 0]))
        self.points.set_offsets(self.places[frame])
        mode = scene.modes[scene.mode[frame]]
        seconds, _, hundredths = f"{now:.2f}".partition(".")
        self.seconds.set_text(f"{seconds}.")
        self.hundredths.set_text(f"{hundredths} s")
        self.mode.set_text(mode)
        self.swatch.set_facecolor(look.MODES[kind_of(mode)])
        return [self.cursor, self.points, self.swatch, self.seconds, self.hundredths, self.mode]


def dots(colours: Any, size: float, places: Floats, transform: Transform, **look: Any) -> PathCollection:
    """Return dots of a diameter [pt] as one artist."""
    circle = Affine2D().scale(0.5).transform_path(Outline.unit_circle())
    artist = PathCollection(
        [circle], sizes=[size**2], facecolors=colours, offsets=places, offset_transform=transform, **look
    )
    artist.set_transform(IdentityTransform())
    return artist


def animated(artist: Any) -> Any:
    """Leave an artist out when the figure is drawn as a whole."""
    artist.set_animated(True)
    return artist
