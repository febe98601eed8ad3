"""Labels of figures: beside a panel they are no longer than it is high, and page 1 names what strengthens the dam."""

from __future__ import annotations

import io
from contextlib import nullcontext

import matplotlib as mpl
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure

from heeltoe import rigid
from heeltoe.views.content.drawings import drawing
from heeltoe.views.figures.all import all_figures
from heeltoe.views.figures.style import STYLE, align_labels, even_lines, fit_words, laid_out
from heeltoe.views.figures.summary import summary_figure
from shared.dams import example


@pytest.mark.parametrize(
    ("high", "label"),
    [(9.0, "slip [mm]\n(+ downstream)"), (5.0, "slip [mm]"), (3.0, "slip\n[mm]")],
)
def test_a_label_is_as_long_as_its_panel_is_high(high, label):
    figure = Figure(figsize=(6.0, high))
    panels = figure.subplots(4, 1)
    for axes in panels:
        axes.set_ylabel("slip [mm]\n(+ downstream)", fontsize=8)
    fit_words(figure)
    assert panels[0].get_ylabel() == label


@mpl.rc_context(STYLE)
def test_labels_of_panels_stand_at_one_distance_beyond_their_numbers():
    figure = Figure(figsize=(6.0, 4.0))
    panels = figure.subplots(3, 1)
    for axes, top in zip(panels, (1.0, 2000.0, 0.02), strict=True):
        axes.plot([0.0, 1.0], [-top, top])
        axes.set_ylabel("slip [mm]")
    align_labels(panels)
    figure.draw_without_rendering()
    renderer = FigureCanvasAgg(figure).get_renderer()
    labels = [axes.yaxis.label.get_window_extent(renderer) for axes in panels]
    assert labels[0].x1 == pytest.approx(labels[1].x1) == pytest.approx(labels[2].x1)
    for axes, box in zip(panels, labels, strict=True):
        assert all(box.x1 <= number.get_window_extent(renderer).x0 for number in axes.get_yticklabels())


def test_page_one_names_anchors_and_drains():
    texts = [text.get_text() for text in summary_figure(example("anchored"), ()).axes[0].texts]
    assert "anchors" in texts
    assert "drains" in texts
    assert "drains" not in [text.get_text() for text in summary_figure(example("typical-base"), ()).axes[0].texts]


@mpl.rc_context(STYLE)
def test_words_of_time_fit_below_a_narrow_panel_and_others_stay():
    figure = Figure(figsize=(6.0, 3.0))
    left, right = figure.subplots(1, 2)
    left.set_xlabel("time [s]; ground motion until 115 s (dotted); further motions begin at the dotted lines")
    right.set_xlabel("tension [MPa]\nlargest 3.15 MPa")
    fit_words(figure)
    assert right.get_xlabel() == "tension [MPa]\nlargest 3.15 MPa"
    FigureCanvasAgg(figure).draw()
    words = left.xaxis.label.get_window_extent()
    assert words.width < 1.2 * left.get_window_extent().width
    assert not words.overlaps(right.xaxis.label.get_window_extent())


def _drawn(case):
    file = io.BytesIO()
    figure = summary_figure(case, (rigid(case),))
    with laid_out(figure):
        figure.savefig(file, format="svg", metadata={"Date": None})
    return file.getvalue()


def test_ticks_found_once_and_words_measured_together_make_the_same_drawing(monkeypatch):
    case = example("typical-base", "motion.duration=4s")
    quick = _drawn(case)
    monkeypatch.setattr("heeltoe.views.figures.style._steady", lambda figure: nullcontext())
    monkeypatch.setattr("heeltoe.views.figures.style._measured", lambda figure: nullcontext())
    assert _drawn(case) == quick


def test_a_figure_that_was_laid_out_is_as_before():
    figure = Figure(layout="constrained")
    axes, canvas, engine = figure.subplots(), figure.canvas, figure.get_layout_engine()
    with laid_out(figure):
        assert "_update_ticks" in vars(axes.xaxis)
    assert "_update_ticks" not in vars(axes.xaxis)
    assert figure.canvas is canvas
    assert figure.get_layout_engine() is engine
    axes.set_xlim(0.0, 5000.0)
    FigureCanvasAgg(figure).draw()
    assert axes.get_xticklabels()[-1].get_text() == "5000"


def test_ticks_of_a_report_are_those_of_its_letters():
    response = rigid(example("typical-base", "motion.duration=4s"))
    reports = []
    for size in (8.0, 30.0):
        with mpl.rc_context({"font.size": size}):
            reports.append(drawing("spectrum", all_figures(None, response)["spectrum"], "The spectrum.").svg)
    assert reports[0] == reports[1]


def test_lines_of_words_are_about_equally_long():
    assert even_lines("displacements exaggerated 20 times", 28) == "displacements\nexaggerated 20 times"
    assert even_lines("short", 28) == "short"
    assert even_lines("", 28) == ""
