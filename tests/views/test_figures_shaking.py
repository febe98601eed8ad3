"""What shakes the dam is on the figures, both ways, with what it takes to move the dam, as long as anything happens."""

from __future__ import annotations

import re
from dataclasses import replace
from io import StringIO

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from rich.console import Console

from heeltoe import flexible, read_case, rigid, write_report
from heeltoe.models.run import run
from heeltoe.study.small.run_table import parse_axes, run_small
from heeltoe.views.figures.all import all_figures
from heeltoe.views.figures.energy import energy_figure
from heeltoe.views.figures.histories import response_figure
from heeltoe.views.figures.runs import residual_slip_figure, slips_figure
from heeltoe.views.figures.section import section_figure
from heeltoe.views.figures.spectrum import spectrum_figure
from heeltoe.views.figures.time_axis import shown_until
from heeltoe.views.terminal.response import print_response
from heeltoe.views.words.starts import starts
from shared.dams import BASE, ENDS, FAST, KOYNA, SLENDER, example
from shared.drawn import check, texts

G = 9.80665
# Two jolts up and down while the ground goes upstream ever faster: the second, down, lets the dam slide.
UP = 'motion.vertical={points=[["0 s","0 g"],["0.2 s","0.3 g"],["0.4 s","-0.3 g"],["1 s","0 g"]]}'
PUSHED = 'motion={points=[["0 s","0 g"],["0.5 s","-0.3 g"],["1 s","0 g"],["9 s","0 g"]], duration="9 s"}'


@pytest.fixture(scope="module")
def lifted():
    return rigid(read_case(BASE, [PUSHED, UP]))


def printed(response):
    console = Console(width=120, record=True, file=StringIO())
    print_response(response, console, details=read_case(BASE, [PUSHED, UP]))
    return console.export_text()


def test_the_vertical_motion_is_on_the_figures(lifted):
    figures = all_figures(None, lifted)
    for name in ("response", "accelerations"):
        panel = figures[name].axes[1]
        assert panel.get_ylabel() == "vertical\n(+ up) [g]"
        line = panel.lines[0]
        assert np.interp(0.2, line.get_xdata(), line.get_ydata()) == pytest.approx(0.3)
        assert "peak 0.3 g" in figures[name]._suptitle.get_text()
        check(figures[name], name)
    labels = [text.get_text() for text in spectrum_figure(lifted).legends[0].get_texts()]
    assert "vertical ground motion, 5 % damping" in labels


def test_the_line_where_sliding_starts_moves_with_the_vertical_motion(lifted):
    """The first event of the walk, which is exact, lies where the ground meets that line."""
    ground, line = response_figure(lifted).axes[0].lines[:2]
    first = lifted.event_log["time_s"][0]
    assert lifted.event_log["mode_after"][0].startswith("slide")
    # A straight line between moments of the histories, as the motions are.
    met = np.interp(first, line.get_xdata(), line.get_ydata())
    assert met == pytest.approx(np.interp(first, ground.get_xdata(), ground.get_ydata()), rel=1e-9)
    assert met != pytest.approx(-lifted.static["critical_acceleration_g"]["sliding_downstream"], rel=0.05)


def test_vertical_motion_shifts_the_limits_as_a_heavier_block_would():
    """Upward at 0.25 g, weight and with it friction are a quarter more; the water presses as before."""
    case = example("typical-base")
    static = rigid(case).static
    limit, change = (static[f"critical_acceleration_{key}"] for key in ("g", "per_vertical"))
    mass, virtual = static["concrete_mass_kg"], static["virtual_mass_kg"]
    mu = case.crack.mu_static
    needed = mu * (static["normal_force_n"] + 0.25 * mass * G) - static["horizontal_force_n"]
    assert limit["sliding_downstream"] + 0.25 * change["sliding_downstream"] == pytest.approx(
        needed / (mass + virtual) / G, rel=1e-12
    )


@pytest.mark.parametrize("model", [rigid, flexible])
def test_terminal_and_figures_say_the_same_limits(model):
    response = model(example("typical-base", *FAST))
    message = printed(response)
    result = starts(response)
    assert re.search(rf"Sliding downstream starts at +{re.escape(str(result['sliding', 'downstream']))}", message)
    panel = response_figure(response).axes[0]
    title = panel._right_title.get_text()
    assert f"sliding starts at {result['sliding', 'downstream']} downstream" in title
    assert "-0." not in title
    limit = next(line for line in panel.lines if len(line.get_xdata()) == 2)
    assert limit.get_ydata()[0] == pytest.approx(-result["sliding", "downstream"].value)
    legend = " ".join(text.get_text() for text in spectrum_figure(response).legends[0].get_texts())
    assert str(result["sliding", "downstream"]) in legend


def test_terminal_says_what_the_vertical_motion_does_to_the_limits(lifted):
    result = starts(lifted)["sliding", "downstream"]
    assert result.varied
    assert result.varied in " ".join(printed(lifted).split())
    assert float(result.varied.split()[0]) == pytest.approx(result.value - 0.3 * result.per_vertical, abs=1e-4)


@pytest.mark.slow
def test_the_report_says_it_too(lifted, tmp_path):
    for response, there in ((lifted, True), (rigid(read_case(BASE, [PUSHED])), False)):
        write_report(read_case(BASE, [PUSHED]), response, tmp_path, kinds=("html",))
        text = (tmp_path / "report.html").read_text(encoding="utf-8")
        for start in starts(lifted).values():
            assert (start.varied in text) == there


def test_the_axis_of_time_ends_when_nothing_happens_any_more(lifted):
    axes = response_figure(lifted).axes[-1]
    end = axes.get_xlim()[1]
    last = lifted.event_log["time_s"][-1]
    assert last < end == shown_until(lifted) < 1.2 * max(last, 1.0)
    assert axes.get_xlabel() == "time [s]; at rest from here to the end at 9 s"
    # One that still moves is shown to its end.
    on = rigid(read_case(BASE, [PUSHED, "motion.duration=0.6s", ENDS]))
    assert shown_until(on) == 0.6
    assert response_figure(on).axes[-1].get_xlabel() == "time [s]"


def test_the_end_of_the_ground_motion_is_marked_where_silence_follows():
    response = rigid(read_case(BASE, [PUSHED, "motion.duration=0.6s"]))
    figure = response_figure(response)
    words = "time [s]; ground motion until 0.6 s (dotted); at rest from here to the end at 3.1 s"
    assert figure.axes[-1].get_xlabel().replace("\n", " ") == words
    for axes in figure.axes:
        assert [0.6, 0.6] in [list(line.get_xdata()) for line in axes.lines]
    # The words have room in the narrow panels, too.
    for name, drawn in all_figures(None, response).items():
        check(drawn, name)


def test_labels_of_a_block_that_overturns_cover_no_curve():
    for name, figure in all_figures(None, rigid(read_case(SLENDER))).items():
        check(figure, name)


def test_values_of_the_energy_stand_in_rows_of_their_own():
    response = rigid(read_case(SLENDER))
    figure = energy_figure(response)
    check(figure, "energy")
    rows = [label.get_text().split("  ")[0] for label in figure.axes[1].get_yticklabels()]
    assert rows == ["put in", "friction", "impacts", "stored"]


def test_a_table_of_runs_says_all_its_peaks():
    variations = parse_axes(["motion.pga=0.2g,0.6g", "crack.friction=0.8,1.0"])
    grid = run_small(KOYNA, ["motion.duration=6s"], variations, lambda case: run(case, "rigid"))
    figure = slips_figure(grid)
    assert "peaks 0.2 to 0.6 g" in figure._suptitle.get_text()
    check(figure, "slips")
    over = residual_slip_figure(grid)
    (axes,) = over.axes
    assert axes.get_xlabel() == "motion.pga [g]"
    lines = {line.get_label(): line.get_xydata() for line in axes.lines if not line.get_label().startswith("_")}
    strong = [response.residual_slip_m for cell, response in zip(grid.cells, grid.responses, strict=True)]
    assert lines["crack.friction 0.8"][:, 0].tolist() == [0.2, 0.6]
    assert lines["crack.friction 0.8"][-1, 1] in [pytest.approx(1e3 * slip) for slip in strong]
    check(over, "residual-slip")
    one = run_small(KOYNA, ["motion.duration=6s"], variations[1:], lambda case: run(case, "rigid"))
    assert "peak 0.49 g" in slips_figure(one)._suptitle.get_text()


def test_anchors_do_not_hide_the_heel():
    anchors = 'anchors=[{distance="0.3 m",prestress="1.5 MN/m"},{distance="1 m",prestress="1.5 MN/m"}]'
    figure = section_figure(example("anchored", anchors))
    renderer = FigureCanvasAgg(figure).get_renderer()
    figure.draw(renderer)
    box = next(text for text in texts(figure) if text.get_text() == "heel").get_window_extent(renderer)
    drawn = [line for line in figure.axes[0].lines if line.get_color() == "#B22222" and line.get_linestyle() == "-."]
    assert len(drawn) == 2
    for line in drawn:
        assert not line.get_transform().transform_path(line.get_path()).intersects_bbox(box, filled=False)


def test_an_elastic_dam_that_still_swings_is_not_said_to_rest():
    response = flexible(example("typical-base", *FAST))
    time = response.histories["time_s"]
    end = float(time[-1])
    swung = response.histories["slip_m"] + 1e-3 * np.sin(2.0 * np.pi * time)
    still = response.with_crack(histories={**response.histories, "slip_m": swung}, mode=("rest",) * len(response.mode))
    assert shown_until(still) == end
    assert "at rest" not in response_figure(still).axes[-1].get_xlabel()


def test_the_axis_of_time_goes_on_while_any_of_several_cracks_moves():
    response = rigid(example("two-cracks", "motion.pga=0.35g", "crack.friction=0.8", "further_cracks[0].friction=2"))
    still, moving = sorted((response.at_crack(place) for place in range(2)), key=shown_until)
    assert still.residual_slip_m == 0.0 != moving.residual_slip_m
    # Also where the crack that does not move is the one that is asked for.
    for asked in range(2):
        assert shown_until(replace(response, asked=asked)) == shown_until(moving) > shown_until(still)
