"""Figures show what they say, with units, inside their canvas, for every example, in SI and US units."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.image import imread

from heeltoe import flexible, read_case, rigid, with_spread
from heeltoe.base.atomic_files import LISTED
from heeltoe.errors.error import InputError
from heeltoe.result.histories import Histories
from heeltoe.result.judge import LimitCheck
from heeltoe.views.figures.all import all_figures
from heeltoe.views.figures.crack import contact_pressure, crack_figure, pressure_figure
from heeltoe.views.figures.dam import mesh_figure, modes_figure
from heeltoe.views.figures.energy import energy_figure, friction_loss
from heeltoe.views.figures.fonts import ems, wrapped
from heeltoe.views.figures.histories import response_figure, slip_by_kind, slip_by_mode_figure
from heeltoe.views.figures.names import NAMES
from heeltoe.views.figures.panels import draw_ribbon
from heeltoe.views.figures.path import path_figure
from heeltoe.views.figures.shaking import until
from heeltoe.views.figures.spectrum import spectrum_figure
from heeltoe.views.figures.stress.deformed import deformed_figure
from heeltoe.views.figures.style import without_heading
from heeltoe.views.figures.write import save_all
from heeltoe.views.files.write import write_all
from models.rigid.test_cross_valley import slab
from shared.dams import ALL_EXAMPLES, BASE, BLOCK, FAST, example
from shared.drawn import check, texts
from shared.evidence import scattered, scattered_below
from shared.responses import with_numbers

ROCKING = ["reservoir.depth=60m", "motion.pga=1.2g", "motion.duration=8s"]


@pytest.fixture
def both(typical_both):
    return typical_both


@pytest.fixture(scope="module")
def rocking():
    return rigid(example("typical-base", *ROCKING))


# One example with parts of every kind and forces of a large dam, and one of a small block, in both systems of units.
US = [pytest.param(BASE, "us", marks=pytest.mark.slow), (BLOCK, "us")]
# Between them and these there is every figure that an example has.
FEW = ("block", "rough-crack", "stepped-crack")


@pytest.mark.parametrize(
    ("path", "units"),
    [
        *(pytest.param(path, "si", marks=() if path.stem in FEW else pytest.mark.product) for path in ALL_EXAMPLES),
        *US,
    ],
    ids=lambda value: getattr(value, "stem", value),
)
def test_every_figure_of_every_example(path, units):
    short = [] if path.stem == "block" else ["motion.duration=3s"]
    case = read_case(path, short)
    elastic_only = case.further_cracks or case.crack.kinks
    responses = [] if elastic_only else [rigid(case)]
    if case.concrete.modulus:
        below = ["flexible.elements_across_below=3"] if case.crack.elevation and not case.crack.kinks else []
        case = read_case(path, [*FAST, *(["flexible.elements_across=3"] if case.crack.kinks else below)])
        responses.append(flexible(case))
    for response in responses:
        figures = all_figures(case, response, units)
        # Of a further crack they are those of its own.
        assert {name.partition("/")[2] or name for name in figures} <= set(NAMES)
        assert {"section", "response", "spectrum"} <= set(figures)
        for name, figure in figures.items():
            check(figure if units == "si" else without_heading(figure), name)
            if units == "us":
                seen = " ".join(text.get_text() for text in texts(figure))
                assert not any(unit in seen for unit in (" m]", "[m]", "mm]", "MN", "MPa", "kPa", "J/m")), name


def test_the_numbers_of_both_systems_agree(both, rocking):
    inch, kip, psi = 0.0254, 4448.2216152605, 6894.757293168
    si, us = (response_figure(rocking, units).axes for units in ("si", "us"))
    assert si[1].lines[0].get_ydata() / us[1].lines[0].get_ydata().clip(1e-9) == pytest.approx(25.4) or np.allclose(
        si[1].lines[0].get_ydata(), 25.4 * us[1].lines[0].get_ydata()
    )
    assert si[3].lines[0].get_ydata() == pytest.approx(1e3 * inch * us[3].lines[0].get_ydata())
    si, us = (energy_figure(both, units).axes[0].lines[0].get_ydata() for units in ("si", "us"))
    assert 1e6 * si == pytest.approx(kip * us)
    maps = [pressure_figure(both, units).axes[1].collections[-1].get_array() for units in ("si", "us")]
    assert 1e6 * maps[0].compressed() == pytest.approx(psi * maps[1].compressed())


def test_units_that_nobody_knows(both):
    with pytest.raises(InputError, match="choose si or us") as refused:
        response_figure(both.beside, "imperial")
    assert refused.value.code == "not-a-choice"


@pytest.mark.parametrize(
    ("changes", "panels"), [pytest.param(["motion.duration=8s"], 3, marks=pytest.mark.slow), (ROCKING, 5)]
)
def test_figures_of_a_rigid_block(tmp_path, changes, panels):
    response = rigid(example("typical-base", *changes))
    assert len(response_figure(response).axes) == panels
    names = {"response", "accelerations", "bearing", "crest", "energy", "spectrum"}
    # What only slides has its slip in the first picture.
    names |= {"path", "slip-by-mode"} if panels == 5 else set()
    paths = save_all(all_figures(None, response), tmp_path)
    assert {path.name for path in paths} == {f"{name}{suffix}" for name in names for suffix in (".png", ".svg")}
    inked(paths)


def test_figures_without_typst_are_the_same_files(tmp_path, monkeypatch):
    response = rigid(example("typical-base", "motion.duration=4s"))
    figures = {"energy": all_figures(None, response)["energy"]}
    (tmp_path / "without").mkdir()
    first = save_all(figures, tmp_path)
    monkeypatch.setattr("heeltoe.views.figures.write.can_compile", lambda: False)
    second = save_all(figures, tmp_path / "without")
    assert [path.name for path in first] == [path.name for path in second] == ["energy.png", "energy.svg"]
    inked(second)
    pictures = [imread(path)[..., :3].mean(axis=2) for path in (first[0], second[0])]
    assert pictures[0].shape == pictures[1].shape
    # One puts its letters on whole pixels, the other does not.
    assert abs(pictures[0] - pictures[1]).mean() < 0.05


def inked(paths):
    for path in paths:
        assert path.stat().st_size > 5000
        # A drawing of hundreds of thousands of rectangles is of no use.
        assert path.stat().st_size < 2_000_000
        if path.suffix == ".png":
            assert imread(path).std() > 0.05


def test_a_run_that_never_started_has_its_section_alone(tmp_path):
    case = example("typical-base", "crack.friction=0.2")
    response = rigid(case)
    assert save_all(all_figures(None, response), tmp_path) == []
    assert set(all_figures(case, response)) == {"section"}
    write_all(response, tmp_path, case)
    assert {path.name for path in tmp_path.iterdir()} == {LISTED, "result.json", "section.png", "section.svg"}


def test_a_run_without_any_motion_has_figures():
    points = 'motion={points=[["0 s","0 g"],["1 s","0 g"]], allow_zero=true}'
    for name, figure in all_figures(None, rigid(example("block", points))).items():
        check(figure, name)


def test_numbers_beyond_all_bounds_are_not_drawn(both):
    h = {name: np.array(values) for name, values in both.histories.items()}
    h["slip_m"][-3:] = np.inf
    blown = replace(both, outcome="blown up", beside=None).with_crack(histories=h)
    assert all_figures(None, blown) == {}
    assert all(name.startswith("rigid/") for name in all_figures(None, replace(blown, beside=both.beside)))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("model", "name", "changes"),
    [
        (rigid, "typical-base", [*ROCKING, "analysis.event_limit=20"]),
        (rigid, "typical-base", ["motion.pga=0.01g", "motion.duration=5s"]),
        (rigid, "typical-base", ["motion.duration=0.001s"]),
        (rigid, "block", ['section.polygon=[["0 m","0 m"],["0.2 m","0 m"],["0.2 m","3 m"],["0 m","3 m"]]']),
        (flexible, "typical-base", [*FAST, "crack.friction=0.4"]),
        (flexible, "typical-base", [*FAST, "motion.pga=0.001g", "reservoir.depth=0m"]),
        (flexible, "typical-base", [*FAST, "motion.duration=0.02s"]),
    ],
    ids=["stopped", "still", "one sample", "slender", "slides away", "hardly shaken", "three frames"],
)
def test_runs_that_end_early_or_hardly_move(model, name, changes):
    case = example(name, *changes)
    for label, figure in all_figures(case, model(case)).items():
        check(figure, label)


@pytest.mark.slow
def test_figures_of_the_flexible_model(typical_written):
    paths = [path for path in typical_written[0].iterdir() if path.suffix in (".png", ".svg")]
    assert {"response", "forces", "energy", "crack", "pressure", "deformed", "mesh", "modes"} <= {p.stem for p in paths}
    inked(paths)


@pytest.mark.slow
def test_a_crack_at_a_height_has_figures(tmp_path):
    case = example("typical-height", *FAST, "flexible.elements_across_below=3")
    for kind in (2, 3, 4):
        changed = case.model_copy(update={"flexible": case.flexible.model_copy(update={"contactors": kind})})
        response = flexible(changed.based_in(case.base_directory))
        for draw in (crack_figure, pressure_figure):
            check(draw(response), draw.__name__)
    # Of all figures those that know of the part below.
    figures = all_figures(None, flexible(case))
    inked(save_all({name: figures[name] for name in ("crack", "pressure", "deformed", "mesh")}, tmp_path))


def test_figures_show_what_they_say(both):
    axes = response_figure(both).axes
    assert len(axes) == 5
    h = both.histories
    assert axes[1].lines[0].get_ydata() == pytest.approx(1e3 * h["slip_m"])
    spans = sum(path.get_extents().width for collection in axes[-1].collections for path in collection.get_paths())
    assert spans == pytest.approx(h["time_s"][-1])
    lines = {line.get_label(): line.get_ydata() for line in energy_figure(both).axes[0].lines}
    assert lines["put in"][-1] == pytest.approx(h["input_energy_j"][-1] / 1e6)
    # What is put in goes somewhere, up to what the time stepping itself loses.
    parts = sum(values[-1] for name, values in lines.items() if name != "put in")
    assert parts == pytest.approx(lines["put in"][-1], rel=0.01)
    colours = crack_figure(both).axes[0].collections[0].get_array()
    assert (colours == both.crack.status.T).all()


def test_rows_of_the_ribbon_tell_modes_apart_without_colour(rocking):
    figure = response_figure(rocking)
    axes = figure.axes[-1]
    names = [label.get_text() for label in axes.get_yticklabels()]
    assert set(names) == {"rest", "slide", "rock", "slide-rock", "drift"} & set(names)
    heights = {path.get_extents().y0 for collection in axes.collections for path in collection.get_paths()}
    assert len(heights) == len(names)


def test_slip_by_mode_and_losses_end_at_the_sums_of_the_run(rocking):
    result = slip_by_kind(rocking)
    assert result["slide"][-1] == pytest.approx(rocking.slip_by_mode_m["sliding"], rel=1e-9)
    assert result["drift"][-1] == pytest.approx(rocking.slip_by_mode_m["drifting"], rel=1e-9)
    assert sum(result.values()) == pytest.approx(rocking.histories["slip_m"], abs=1e-9)
    assert friction_loss(rocking)[-1] == pytest.approx(rocking.energy.friction_j, rel=1e-3)
    curves = {line.get_label(): line.get_ydata() for line in energy_figure(rocking).axes[0].lines}
    assert curves["impacts"][-1] == pytest.approx(rocking.energy.impact_j / 1e6)
    bars = slip_by_mode_figure(rocking).axes[1].patches
    assert bars[-1].get_height() == pytest.approx(1e3 * rocking.residual_slip_m)
    assert sum(bar.get_height() for bar in bars[:-1]) == pytest.approx(bars[-1].get_height())


def test_a_block_with_few_samples_is_drawn_as_it_moves():
    response = rigid(example("block"))
    assert len(response.motion.time) == 4
    figures = all_figures(None, response)
    line = figures["response"].axes[1].lines[0]
    time, slip = line.get_xdata(), line.get_ydata() / 1e3
    g = 9.80665
    exact = np.where(time < 0.1, -0.3 * g * time**2, 0.1 * g * time**2 - 0.08 * g * time + 0.004 * g)
    assert slip == pytest.approx(exact, abs=1e-12)
    # The jump of the ground is a jump.
    ground = figures["response"].axes[0].lines[0]
    assert sorted(ground.get_ydata()[ground.get_xdata() == 0.1]) == pytest.approx([0.0, 0.8])
    lost = figures["energy"].axes[0].lines[0].get_ydata()[-1]
    assert 1e3 * lost == pytest.approx(response.energy.friction_j)


def test_after_the_record_the_ground_stands_still():
    response = rigid(example("block", "motion.duration=2s"))
    time, ground = until(response.motion, response.end_time_s)
    assert (time[-1], ground[-1]) == (2.0, 0.0)
    time, ground = until(rigid(example("block", "motion.duration=0.05s")).motion, 0.05)
    assert (time[-1], ground[-1]) == (0.05, pytest.approx(0.8 * 9.80665))


def test_contact_pressure_carries_the_load(both):
    record = both.crack
    time, pressure = contact_pressure(record)
    along = record.upper_position[0, 0]
    sizes = along[2::2] - along[:-2:2]
    # Simpson's rule over each element gives the nodes' forces back.
    ends, middle = pressure[:, :-2:2] + pressure[:, 2::2], pressure[:, 1:-1:2]
    total = ((ends + 4.0 * middle) / 6.0) @ sizes
    assert time == pytest.approx(record.time)
    assert total == pytest.approx(record.forces()[:, 1].sum(axis=1), rel=1e-9)


def test_shapes_of_the_intact_dam_have_its_periods(both):
    dam = both.crack.dam
    titles = [axes.get_title() for axes in modes_figure(dam).axes]
    assert [float(title.split("=")[1].split("s")[0]) for title in titles] == pytest.approx(
        list(dam.periods[:4]), rel=5e-3
    )
    check(mesh_figure(dam), "mesh")


def test_deformed_dam_at_a_moment(both):
    seen = " ".join(text.get_text() for text in texts(deformed_figure(both, 1.5)))
    assert "t = 1.50 s;" in seen
    assert "exaggerated" in seen
    largest = deformed_figure(both)
    assert "the largest tension of the run" in largest._supxlabel.get_text()


def test_the_spectrum_marks_the_periods(both):
    marked = [line.get_xdata()[0] for line in spectrum_figure(both).axes[0].lines if len(line.get_xdata()) == 2]
    assert set(np.round(both.periods_s[:4], 9)) <= set(np.round(marked, 9))
    own = spectrum_figure(both.beside, periods_s=[0.5]).axes[0]
    assert any(list(line.get_xdata()) == [0.5, 0.5] for line in own.lines)


@pytest.mark.slow
def test_a_decoupled_response_shows_the_motion_at_its_crack(koyna):
    response = koyna
    h = response.histories
    axes = response_figure(response).axes[0]
    assert axes.lines[0].get_label() == "at the crack"
    assert axes.lines[0].get_ydata() == pytest.approx(h["crack_acceleration_m_s2"] / response.gravity)
    figures = all_figures(None, response)
    assert "crack-level" in figures
    for name, figure in figures.items():
        check(figure, name)


def overturned(response):
    """A response whose block turns over in the end."""
    h = {name: np.array(values) for name, values in response.histories.items()}
    time = h["time_s"]
    fall = np.clip(0.002 * np.exp(3.0 * (time - time[-1] + 2.2)) - 0.002, 0.0, np.pi / 2.0)
    h["rotation_rad"] -= fall
    h["gap_heel_m"] += fall * response.crack_width_m
    fallen = with_numbers(response, largest_gap_heel_m=float(h["gap_heel_m"].max()))
    return replace(fallen, outcome="overturned").with_crack(histories=h)


@pytest.mark.slow
def test_a_block_that_overturns_stays_readable(rocking, both):
    response = overturned(rocking)
    figures = all_figures(None, response)
    for name, figure in figures.items():
        check(figure, name)
    rotation = figures["response"].axes[2]
    turned = rotation.lines[0].get_ydata()
    low, high = rotation.get_ylim()
    assert low <= turned.min() <= turned.max() <= high
    # The rocking before takes a good part of the panel, although the block turns a thousand times as far.
    scale = np.abs(turned).max() / np.abs(response.histories["rotation_rad"]).max()
    before = scale * abs(rocking.histories["rotation_rad"]).max()
    heights = rotation.transData.transform([(0.0, value) for value in (low, 0.0, before, high)])[:, 1]
    assert heights[2] - heights[1] > 0.08 * (heights[3] - heights[0])
    assert any("overturns downstream" in text.get_text() for text in texts(figures["response"]))
    check(all_figures(None, replace(both, beside=response))["comparison"], "comparison")


@pytest.mark.slow
@pytest.mark.parametrize(
    "title",
    [
        "三峡大坝 地震 " * 12,
        "Бурейская плотина, секция 12",
        "Barrage d'Émosson $1 & $2_x^ \\frac{<b>",
        "سد " * 8,
        "\U0001f30a wave\x00\n\ttab \U000e0001",
        "W" * 400,
        "",
    ],
)
def test_titles_of_any_kind(both, tmp_path, title):
    response = replace(both.beside, title=title)
    figure = response_figure(response)
    check(figure, "response")
    height = figure._suptitle.get_window_extent(FigureCanvasAgg(figure).get_renderer()).height
    assert height < 0.2 * figure.bbox.height
    # All figures have their title from one function.
    assert len(save_all({"response": figure}, tmp_path)) == 2


def test_letters_without_a_font_become_squares(both, monkeypatch):
    monkeypatch.setattr("heeltoe.views.figures.fonts._other_fonts", lambda: ())
    figure = response_figure(replace(both.beside, title="大坝 5"))
    assert figure._suptitle.get_text().startswith("□□ 5")
    check(figure, "response")


def test_a_crack_that_stays_closed_has_no_panel_of_openings():
    quiet = [*FAST, "motion.pga=0.05g", "reservoir.depth=20m"]
    response = flexible(example("typical-base", *quiet))
    assert len(response_figure(response).axes) == 3
    assert "path" not in all_figures(None, response)


def test_the_spread_is_a_band():
    case = example("typical-base")
    plain = rigid(case)
    response = with_spread(plain, case)
    assert not response_figure(plain).axes[1].collections
    (band,) = response_figure(response).axes[1].collections
    spread = response.spread["residual_slip_m"]
    edges = band.get_paths()[0].vertices[:, 1]
    assert (edges.min(), edges.max()) == pytest.approx((1e3 * spread["min"], 1e3 * spread["max"]))


def test_path_of_a_block_that_lifts_off(rocking):
    axes = path_figure(rocking).axes
    lifts = [max(path.get_extents().y1 for c in a.collections for path in c.get_paths()) for a in axes]
    h = rocking.histories
    assert lifts[0] == pytest.approx(1e3 * h["gap_heel_m"].max(), rel=1e-6)
    assert lifts[2] == pytest.approx(1e3 * h["gap_toe_m"].max(), rel=1e-6)


def test_a_ribbon_without_events():
    figure = response_figure(rigid(example("typical-base", "motion.duration=1s")))
    draw_ribbon(
        figure.axes[0],
        SimpleNamespace(event_log={}, histories=Histories({"time_s": np.array([1.0, 2.0])}), mode=("rest", "sliding")),
    )
    assert [label.get_text() for label in figure.axes[0].get_yticklabels()] == ["slide", "rest"]


def test_comparison_figure(both, tmp_path):
    inked(save_all({"comparison": all_figures(None, both)["comparison"]}, tmp_path))
    never = rigid(example("typical-base", "crack.friction=0.2"))
    assert "comparison" not in all_figures(None, replace(both, beside=never))
    figures = all_figures(None, both, "us")
    assert next(iter(figures)) == "comparison"
    assert {"rigid/response", "deformed"} <= set(figures)


def test_what_a_crack_with_a_law_bears_stays_below_what_it_could():
    law = {"name": "slip weakening", "peak_friction": 1.0, "residual_friction": 0.7, "slip": "20 mm"}
    points = [["0 s", "0 g"], ["0.1 s", "-0.8 g"], ["0.3 s", "0.5 g"], ["0.5 s", "0 g"]]
    motion = {"points": points, "pga": None, "duration": None}
    response = rigid(read_case(BASE, [{"crack.law": law, "motion": motion}]))
    figures = all_figures(None, response)
    assert "friction" in figures
    could, slip = (axes.lines[0] for axes in figures["friction"].axes)
    assert could.get_ydata()[0] > could.get_ydata()[-1]
    assert np.all(np.diff(slip.get_ydata()) >= 0.0)
    assert "friction" not in all_figures(None, rigid(read_case(BASE, [{"motion": motion}])))


def test_a_slip_that_scatters_has_a_histogram(both):
    """By hand: 40 runs at 0.1 m and 60 at 0.3 m, whose mean is 0.22 m."""
    response = scattered(both, [0.1] * 40 + [0.3] * 60)
    limit = LimitCheck(name="residual_slip", value=0.3, allowed=0.25, failed=False, exceeding=0.6)
    response = replace(response, limits=(limit,))
    assert "scatter" not in all_figures(None, both)
    further = [name for name in all_figures(None, scattered_below(both, [0.1, 0.3])) if "scatter" in name]
    assert further == ["crack-2/scatter"]
    axes = all_figures(None, response)["scatter"].axes[0]
    assert [bar.get_height() for bar in axes.patches if bar.get_height()] == [40.0, 60.0]
    lines = {line.get_label(): line.get_xdata()[0] for line in axes.lines}
    assert lines == pytest.approx(
        {"mean": 220.0, "16 % of the runs keep to": 100.0, "84 % of the runs keep to": 300.0, "limit": 250.0}
    )


@pytest.mark.parametrize(
    ("allowed", "left", "right"),
    [
        (0.25, "", ""),
        (0.15, "← limit 150.0 mm, to the left", ""),
        (0.85, "", "limit 850.0 mm, to the right →"),
    ],
)
def test_a_limit_far_from_all_runs_is_a_note(both, allowed, left, right):
    """Runs from 0.4 to 0.6 m: a limit within 0.2 m of them is a line, any other leaves their bars as they are."""
    limit = LimitCheck(name="residual_slip", value=0.6, allowed=allowed, failed=False)
    response = replace(scattered(both, [0.4] * 40 + [0.6] * 60), limits=(limit,))
    axes = all_figures(None, response)["scatter"].axes[0]
    assert (axes.get_title(loc="left"), axes.get_title(loc="right")) == (left, right)
    assert ("limit" in [line.get_label() for line in axes.lines]) == (not left + right)


@pytest.mark.parametrize(("gaps", "drawn"), [(["3 mm", "10 mm"], [3.0, -10.0]), (["10 m", "2 mm"], [-2.0])])
def test_neighbours_that_a_path_comes_near_are_drawn(gaps, drawn):
    case = read_case(slab(crack={"side_gap": gaps}))
    (axes,) = all_figures(case, rigid(case))["plan"].axes
    levels = [line.get_ydata()[0] for line in axes.lines if line.get_linestyle() == "--"]
    assert levels == pytest.approx(drawn)
    assert len(axes.texts) == len(drawn)
    assert axes.get_ylim()[0] < min(drawn)


@pytest.mark.parametrize(("gaps", "aspect"), [("free", 1.0), ("3 mm", "auto")])
def test_a_path_that_would_be_a_line_with_equal_scales_has_its_own(gaps, aspect):
    case = read_case(slab(crack={"side_gap": gaps}))
    figure = all_figures(case, rigid(case))["plan"]
    assert figure.axes[0].get_aspect() == aspect
    assert ("the two axes have different scales" in figure.get_suptitle()) == (aspect == "auto")


def test_a_heading_does_not_break_an_acceleration():
    width = ems("peak 0.533") + 0.1
    assert wrapped("peak 0.533 g; rigid", width, 3) == "peak\n0.533 g;\nrigid"
