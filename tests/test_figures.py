"""Figures are written, not empty, and leave out what did not happen."""

from __future__ import annotations

import pytest
from matplotlib.image import imread

from conftest import ROOT
from heeltoe import read_case, rigid
from heeltoe.figures import response_figure, write_figures


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
