"""What README and paper show of results is what the commands beside it make."""

from __future__ import annotations

import re
import runpy

import numpy as np
import pytest
from matplotlib.image import imread

from heeltoe.views.figures.write import save
from shared.dams import ROOT

RESULTS = (ROOT / "benchmarks" / "results.md").read_text(encoding="utf-8")
SHORT = runpy.run_path(str(ROOT / "benchmarks" / "short.py"))


@pytest.mark.parametrize("page", ["README.md", "paper.md"])
def test_the_table_of_speed_is_that_of_the_results(page):
    text = (ROOT / page).read_text(encoding="utf-8")
    assert SHORT["renewed"](text, RESULTS) == text, "run: python benchmarks/short.py"
    assert "pySLAMMER" in SHORT["table"](RESULTS)


def test_a_result_that_changes_changes_the_table():
    assert SHORT["table"](RESULTS.replace("3.06 ms", "9.06 ms")) != SHORT["table"](RESULTS)
    with pytest.raises(SystemExit, match="choose anew"):
        SHORT["table"](RESULTS.replace("| PyBullet |", "| Bullet |"))


def test_times_in_the_paper_are_measured():
    text = (ROOT / "paper.md").read_text(encoding="utf-8")
    text = "".join(re.split(f"{SHORT['BEGINS']}.*{SHORT['ENDS']}", text, flags=re.DOTALL))
    times = re.findall(r"\d[\d.]* (?:µs|ms|s)\b", text)
    assert times
    assert [time for time in times if time not in RESULTS] == []


def test_sources_of_the_paper_are_there():
    text = (ROOT / "paper.md").read_text(encoding="utf-8")
    listed = re.findall(r"^@\w+\{(\w+),", (ROOT / "paper.bib").read_text(encoding="utf-8"), re.MULTILINE)
    assert sorted(set(re.findall(r"@(\w+)", text))) == sorted(listed)


def test_the_picture_of_the_readme_is_the_one_that_is_made(tmp_path):
    assert "](docs/koyna-top.png)" in (ROOT / "README.md").read_text(encoding="utf-8")
    save(runpy.run_path(str(ROOT / "docs" / "make_figures.py"))["koyna_top"](), tmp_path / "made.png", dpi=110)
    shown, made = imread(ROOT / "docs" / "koyna-top.png"), imread(tmp_path / "made.png")
    # Other versions of fonts and of the drawing move letters by parts of a pixel; another curve is far more than that.
    assert shown.shape == made.shape
    assert np.mean(np.abs(shown - made)) < 0.002
