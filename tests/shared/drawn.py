"""What a drawn figure says, and whether it can be read."""

from __future__ import annotations

from itertools import combinations

from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.text import Text
from matplotlib.transforms import Bbox


def texts(figure):
    """Return all texts of a figure that are seen."""
    drawn = [text for axes in figure.axes for text in axes.findobj(Text)]
    drawn += list(figure.texts) + ([figure._suptitle] if figure._suptitle else [])
    drawn += [text for legend in figure.legends for text in legend.get_texts()]
    return [text for text in drawn if text.get_text().strip() and text.get_visible()]


def check(figure, name):
    """Everything has its unit and its place."""
    renderer = FigureCanvasAgg(figure).get_renderer()
    # All is placed, and no pixel painted: what is painted is looked at in files.
    figure.draw_without_rendering()
    canvas = figure.bbox.padded(1.0)
    for axes in figure.axes:
        for label in (axes.get_xlabel(), axes.get_ylabel()):
            assert "[" in label or label in ("", "mode"), (name, label)
        assert axes.get_xlabel() or axes.get_ylabel() or name.endswith(("path", "deformed", "modes", "energy", "mode"))
        # Nothing is drawn in an empty panel.
        assert axes.lines or axes.collections or axes.patches or axes.images, name
    # Ticks beyond the limits of an axis are not drawn.
    ticks = {
        label
        for axes in figure.axes
        for axis in (axes.xaxis, axes.yaxis)
        for tick in axis.get_major_ticks() + axis.get_minor_ticks()
        for label in (tick.label1, tick.label2)
    }
    for text in texts(figure):
        if text not in ticks:
            box = text.get_window_extent(renderer)
            assert canvas.x0 <= box.x0, (name, text.get_text())
            assert box.x1 <= canvas.x1, (name, text.get_text())
            assert canvas.y0 <= box.y0, (name, text.get_text())
            assert box.y1 <= canvas.y1, (name, text.get_text())
    if name.rpartition("/")[2] not in ("section", "deformed", "mesh", "modes"):
        check_labels(figure, name, renderer)
    boxes = [(legend, legend.get_window_extent(renderer)) for legend in figure.legends]
    for legend, box in boxes:
        for axes in figure.axes:
            assert not box.overlaps(axes.get_window_extent(renderer)), (name, legend)
            for label in (axes.xaxis.label, axes.yaxis.label):
                assert not label.get_text() or not box.padded(-0.5).overlaps(label.get_window_extent(renderer)), name
    labels = [axes.yaxis.label for axes in figure.axes if axes.get_ylabel()]
    for one, other in combinations(labels, 2):
        assert not one.get_window_extent(renderer).overlaps(other.get_window_extent(renderer)), name


def check_labels(figure, name, renderer):
    """No label lies on a curve, and no two labels on each other."""
    for axes in figure.axes:
        labels = [label for label in (*axes.texts, axes.title, axes._left_title, axes._right_title) if label.get_text()]
        labels += [axes.get_legend()] if axes.get_legend() else []
        boxes = [(label, label.get_window_extent(renderer)) for label in labels]
        for (one, first), (other, second) in combinations(boxes, 2):
            assert not first.padded(-0.5).overlaps(second), (name, str(one), str(other))
        inside = axes.get_window_extent(renderer)
        for label, box in boxes:
            # What lies outside is cut off, and so no curve that could be covered.
            seen = Bbox.intersection(box.padded(-0.5), inside)
            if seen is None or 0.0 in (seen.width, seen.height):
                continue
            for curve in axes.lines:
                path = curve.get_transform().transform_path(curve.get_path())
                assert not path.intersects_bbox(seen, filled=False), (name, str(label), curve.get_label())
