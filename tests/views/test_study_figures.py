"""Figures of a study, and the command that writes them."""

import json

import numpy as np
import pytest

from heeltoe import run_study
from heeltoe.views.figures.studies.all import study_figures
from shared.command import command
from shared.studies import DRAWN, GRID, study_file


def drawn(tmp_path, text):
    study = run_study(study_file(tmp_path, text), tmp_path / "out")
    return study, study_figures(study)


def test_a_grid_shows_each_motion_and_the_bands(tmp_path):
    result, figures = drawn(tmp_path, GRID)
    assert set(figures) == {"bands", "slips", "modes"}
    axes = figures["bands"].axes[0]
    thin = axes.collections[0].get_segments()
    assert len(thin) == 30  # 6 dams, 5 motions
    assert thin[0][:, 0] == pytest.approx([0.3, 0.9])
    band = result.bands()["rigid"]
    median = next(line for line in axes.lines if "50 %" in line.get_label())
    assert median.get_ydata() == pytest.approx(1e3 * np.maximum(band["median"], 5e-5))


def test_fragility_curves_stand_on_their_points(tmp_path):
    result, figures = drawn(tmp_path, DRAWN)
    axes = figures["fragility"].axes[0]
    curves = [line for line in axes.lines if not line.get_label().startswith("_")]
    fitted = [item for item in result.fragility if item["median"] is not None]
    assert len(curves) == len(fitted) > 0
    x, y = curves[0].get_data()
    assert np.interp(fitted[0]["median"] / 9.80665, x, y) == pytest.approx(0.5, abs=0.01)
    points = next(line for line in axes.lines if line.get_label().startswith("_"))
    share = np.array(points.get_ydata())
    assert share.min() >= 0.0
    assert share.mean() == pytest.approx(fitted[0]["exceeding"] / fitted[0]["runs"], abs=0.02)
    assert "fragility" in figures
    low, high = result.fragility[0].within(np.array([fitted[0]["median"]]))
    assert low[0] < 0.5 < high[0]


def test_shares_of_modes_make_one(tmp_path):
    _, figures = drawn(tmp_path, GRID)
    axes = figures["modes"].axes[0]
    tops = {}
    for bar in axes.patches:
        tops[bar.get_x()] = tops.get(bar.get_x(), 0.0) + bar.get_height()
    assert list(tops.values()) == pytest.approx([1.0] * len(tops))


def test_what_the_slip_hangs_on_is_drawn_where_the_study_asks(tmp_path):
    one = GRID.replace('"case.toml"\n', '"case.toml"\nmethod = "one at a time"\n', 1)
    _, figures = drawn(tmp_path, one)
    assert [get_yticklabel.get_text() for get_yticklabel in figures["tornado"].axes[0].get_yticklabels()] == [
        "crack.restitution",
        "crack.friction",
    ]


def test_a_study_in_which_nothing_slides_has_no_figures(tmp_path):
    _, figures = drawn(tmp_path, GRID.replace('"0.3 g", "0.9 g"', '"0.001 g", "0.002 g"'))
    assert figures == {}


@pytest.mark.slow
def test_the_command_writes_figures_and_renews_them(tmp_path):
    text = DRAWN.replace('"latin hypercube"\nsamples = 60', '"sensitivity"\nsamples = 32')
    file, out = study_file(tmp_path, text), tmp_path / "out"
    result = command("study", file, "--out", out, "--no-figures", "--details", "--json", tmp_path / "told.json")
    assert result.returncode == 0, result.stderr
    assert "Fields that decide the slip" in result.stdout
    assert not (out / "figures").exists()
    assert len(json.loads((tmp_path / "told.json").read_text())["measures_compared"]["rigid"]["measures"]) == 7
    runs = {path.name: path.read_bytes() for path in (out / "runs").iterdir()}
    for _ in range(2):
        result = command("study", file, "--out", out, "--resume")
        assert result.returncode == 0, result.stderr
        assert "figures" in result.stderr
        names = {path.name for path in (out / "figures").iterdir()}
        assert {"sobol.png", "sobol.svg", "bands.png", "fragility.svg"} <= names
    assert {path.name: path.read_bytes() for path in (out / "runs").iterdir()} == runs
