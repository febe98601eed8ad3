"""Figures are written, not empty, and leave out what did not happen."""

from __future__ import annotations

from dataclasses import replace

import pytest
from matplotlib.image import imread

from conftest import ROOT
from heeltoe import compare, flexible, read_case, rigid, with_spread
from heeltoe.figures import crack_figure, energy_figure, response_figure, write_comparison_figure, write_figures

FAST = ["flexible.elements_across=2", "flexible.convergence_check=false", "motion.duration=3s"]


@pytest.mark.parametrize(("changes", "panels"), [([], 3), (["reservoir.depth=60m", "motion.pga=1.2g"], 5)])
def test_figures(tmp_path, changes, panels):
    response = rigid(read_case(ROOT / "examples" / "typical-base.toml", changes))
    assert len(response_figure(response).axes) == panels
    paths = write_figures(response, tmp_path)
    assert {path.name for path in paths} == {
        f"{name}{suffix}" for name in ("response", "accelerations") for suffix in (".png", ".svg")
    }
    for path in paths:
        assert path.stat().st_size > 5000
        if path.suffix == ".png":
            assert imread(path).std() > 0.05


def test_labels_carry_units():
    figure = response_figure(rigid(read_case(ROOT / "examples" / "koyna-top.toml", ["motion.pga=1g"])))
    for axes in figure.axes[:-1]:
        assert "[" in axes.get_ylabel()
    assert figure.axes[-1].get_xlabel() == "time [s]"


def test_a_run_that_never_started_has_no_figures(tmp_path):
    response = rigid(read_case(ROOT / "examples" / "typical-base.toml", ["crack.friction=0.2"]))
    assert write_figures(response, tmp_path) == []


@pytest.fixture(scope="module")
def both():
    return compare(read_case(ROOT / "examples" / "typical-base.toml", FAST))


def inked(paths):
    for path in paths:
        assert path.stat().st_size > 5000
        # A drawing of hundreds of thousands of rectangles is of no use.
        assert path.stat().st_size < 3_000_000
        if path.suffix == ".png":
            assert imread(path).std() > 0.05


def test_figures_of_the_flexible_model(both, tmp_path):
    paths = write_figures(both.flexible, tmp_path)
    assert {path.stem for path in paths} == {"response", "forces", "energy", "crack"}
    inked(paths)


def test_a_crack_at_a_height_has_figures(tmp_path):
    case = read_case(ROOT / "examples" / "typical-height.toml", [*FAST, "flexible.elements_across_below=3"])
    for kind in (2, 3, 4):
        changed = case.model_copy(update={"flexible": case.flexible.model_copy(update={"contactors": kind})})
        crack_figure(flexible(changed.based_in(case.base_directory)))
    inked(write_figures(flexible(case), tmp_path))


def test_figures_show_what_they_say(both):
    axes = response_figure(both.flexible).axes
    assert len(axes) == 5
    h = both.flexible.histories
    assert axes[1].lines[0].get_ydata() == pytest.approx(1e3 * h["slip_m"])
    spans = sum(path.get_extents().width for collection in axes[-1].collections for path in collection.get_paths())
    assert spans == pytest.approx(h["time_s"][-1])
    lines = {line.get_label(): line.get_ydata() for line in energy_figure(both.flexible).axes[0].lines}
    assert lines["put in"][-1] == pytest.approx(h["input_energy_j"][-1] / 1e6)
    # What is put in goes somewhere, up to what the time stepping itself loses.
    parts = sum(values[-1] for name, values in lines.items() if name != "put in")
    assert parts == pytest.approx(lines["put in"][-1], rel=0.01)
    colours = crack_figure(both.flexible).axes[1].collections[0].get_array()
    assert (colours == both.flexible.crack.status.T).all()


def test_a_crack_that_stays_closed_has_no_panel_of_openings():
    quiet = [*FAST, "motion.pga=0.05g", "reservoir.depth=20m"]
    response = flexible(read_case(ROOT / "examples" / "typical-base.toml", quiet))
    assert len(response_figure(response).axes) == 3


def test_the_spread_is_a_band():
    case = read_case(ROOT / "examples" / "typical-base.toml")
    plain = rigid(case)
    response = with_spread(plain, case)
    assert not response_figure(plain).axes[1].patches
    (band,) = response_figure(response).axes[1].patches
    spread = response.spread["residual_slip_m"]
    assert (band.get_y(), band.get_y() + band.get_height()) == pytest.approx((1e3 * spread["min"], 1e3 * spread["max"]))


def test_comparison_figure(both, tmp_path):
    paths = write_comparison_figure(both, tmp_path)
    assert {path.name for path in paths} == {"comparison.png", "comparison.svg"}
    inked(paths)
    never = rigid(read_case(ROOT / "examples" / "typical-base.toml", ["crack.friction=0.2"]))
    assert write_comparison_figure(replace(both, rigid=never), tmp_path) == []
