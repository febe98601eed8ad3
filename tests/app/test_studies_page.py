"""The page "Studies" in a browser: define, look, run, cancel, go on, come back, take away."""

from __future__ import annotations

import csv
import io
import zipfile

import pytest

pytest.importorskip("playwright")

LOOKED = "() => /runs? \\(/.test(document.querySelector('.outlook').textContent)"


@pytest.fixture
def studies(page):
    """Open the page, with a grid in its form."""
    page.click("#tab-studies")
    page.wait_for_function(LOOKED, timeout=60_000)
    return page


def small(page) -> None:
    """Ask for three runs."""
    page.fill("[data-field='vary.crack.friction['] input", "0.9, 1.0, 1.1")
    page.click("text=Remove >> nth=1")
    page.wait_for_function("() => /^3 runs/.test(document.querySelector('.outlook').textContent)", timeout=60_000)


def ran(page) -> None:
    """Run it and wait for what it says."""
    page.click("text=Run the study")
    page.wait_for_selector(".document figure img", timeout=120_000)


def saved(page, label: str) -> bytes:
    """Fetch what a button offers."""
    with page.expect_download(timeout=60_000) as waiting:
        page.click(f"button:text-is('{label}')")
    return waiting.value.path().read_bytes()


def test_a_study_is_counted_run_and_taken_away(studies, picture):
    picture(studies, "studies-form")
    small(studies)
    ran(studies)
    assert "residual slip" in studies.inner_text(".document")
    picture(studies, "studies-answers")
    rows = list(csv.DictReader(io.StringIO(saved(studies, "Runs (CSV)").decode())))
    assert [float(row["crack.friction"]) for row in rows] == [0.9, 1.0, 1.1]
    names = zipfile.ZipFile(io.BytesIO(saved(studies, "All of it (zip)"))).namelist()
    parts = {name.split("/", 1)[1] for name in names}
    assert {"case.toml", "study.toml", "study/study.json", "study/runs/part-00000000.parquet"} <= parts
    assert any(name.startswith("study/figures/") for name in parts)
