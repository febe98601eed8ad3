"""README, docs and paper show the results of the commands beside them, and figures that were measured."""

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


FIRST_RUN = runpy.run_path(str(ROOT / "docs" / "first_run.py"))


@pytest.mark.slow
def test_the_verdict_of_the_readme_is_that_of_its_command():
    text = (ROOT / "README.md").read_text(encoding="utf-8")
    assert f"heeltoe run {FIRST_RUN['CASE']}" in text
    assert FIRST_RUN["renewed"](text, FIRST_RUN["verdict"]()) == text, "run: python docs/first_run.py"


@pytest.mark.parametrize("page", ["docs/other-programs.md", "paper.md"])
def test_the_table_of_speed_is_that_of_the_results(page):
    text = (ROOT / page).read_text(encoding="utf-8")
    assert SHORT["renewed"](text, RESULTS) == text, "run: python benchmarks/short.py"
    assert "pySLAMMER" in SHORT["table"](RESULTS)


def test_a_result_that_changes_changes_the_table():
    shown = next(line.time for line in SHORT["lines"](RESULTS) if line.program.startswith("pySLAMMER"))
    assert SHORT["table"](RESULTS.replace(f"| {shown} ", "| 9.876 ms ")) != SHORT["table"](RESULTS)
    with pytest.raises(SystemExit, match="choose anew"):
        SHORT["table"](RESULTS.replace("| PyBullet |", "| Bullet |"))


def test_rows_in_which_another_program_is_quicker_are_named():
    quicker = [line for line in SHORT["lines"](RESULTS) if line.ratio and float(line.ratio.replace(",", "")) < 1.0]
    text = SHORT["quicker"](RESULTS)
    assert all(f"{line.program} ({line.ratio})" in text for line in quicker)
    assert text.count("(") == len(quicker)
    slower = re.sub(r"(?<!\n)\| 0\.\d+ (?=[|(])", "| 7 ", RESULTS)
    assert SHORT["quicker"](slower).startswith("No program of this table")


def figures(page: str) -> set[str]:
    """Return the measured figures of a page outside its tables: times, memory, ratios; of a section Results if any."""
    text = (ROOT / page).read_text(encoding="utf-8")
    text = re.sub(f"{SHORT['BEGINS']}.*?{SHORT['ENDS']}", "", text, flags=re.DOTALL)
    text = text.split("\n## Results\n")[-1].split("\n## ")[0] if "\n## Results\n" in text else text
    text = re.sub(r"^```.*?^```$|^ {4}.*?$|^\|.*?$", "", text, flags=re.DOTALL | re.MULTILINE)
    text = " ".join(text.split())
    units = re.findall(r"(?<![\w.,])(\d[\d.,]* (?:µs|ms|s|MB))(?!\w)", text)
    ratios = re.findall(r"(?<![\w.,])(?:(\d[\d.,]*) (?:to|and) )?(\d[\d.,]*) times", text)
    return {*units, *(number for pair in ratios for number in pair if number)}


@pytest.mark.parametrize("page", ["README.md", "paper.md", "benchmarks/README.md"])
def test_figures_are_those_of_the_results(page):
    known = RESULTS + SHORT["table"](RESULTS)
    missing = [figure for figure in figures(page) if not re.search(rf"(?<![\d.,]){re.escape(figure)}(?![\d,])", known)]
    assert missing == []


def test_there_are_figures_to_compare():
    assert figures("paper.md")
    assert {"33.1 ms", "1,311", "3,186", "9,683", "485 MB"} <= figures("benchmarks/README.md")


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
