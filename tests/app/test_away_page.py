"""The page "Take away" in a browser: files are made and fetched, and the words for them stand there."""

from __future__ import annotations

import json

import pytest

pytest.importorskip("playwright")


@pytest.fixture
def away(page):
    """Open the page."""
    page.click("#tab-take-away")
    page.wait_for_selector(".lines pre >> text=heeltoe run case.toml --model auto --out result --report")
    return page


def saved(page, button: str):
    """Fetch what a button offers."""
    with page.expect_download() as waiting:
        page.click(button)
    return waiting.value


def test_files_are_made_and_fetched(away, picture):
    away.select_option("#away-model", "rigid")
    away.check("text=animation")
    away.wait_for_selector(".lines pre >> text=heeltoe animate case.toml --model rigid")
    # What takes longest is made by the whole path.
    away.uncheck("text=animation")
    away.click("text=Make the files")
    away.wait_for_selector("text=Download all (zip)")
    picture(away, "take-away")
    found = saved(away, "[aria-label='Download result.json']")
    assert found.suggested_filename == "result.json"
    assert json.loads(found.path().read_text())["residual_slip_m"] == pytest.approx(0.171, abs=1e-3)
    assert saved(away, "[aria-label='Download report.pdf']").path().read_bytes().startswith(b"%PDF")
    assert saved(away, "text=Download all (zip)").suggested_filename == "heeltoe.zip"
    case = saved(away, "text=Download the case file").path().read_text()
    assert "friction = 1.0" in case
    # Another case: the files are marked.
    away.click("#tab-answer")
    slider = away.locator("#slider-crack-friction")
    slider.focus()
    away.keyboard.press("ArrowRight")
    away.click("#tab-take-away")
    away.wait_for_selector("text=These files are of the case as it was")


def test_words_are_copied_by_keys(away):
    away.context.grant_permissions(["clipboard-read", "clipboard-write"])
    away.focus("[aria-label='Copy: Python']")
    away.keyboard.press("Enter")
    away.wait_for_selector(".lines .faint >> text=copied")
    assert 'heeltoe.read_case("case.toml")' in away.evaluate("navigator.clipboard.readText()")


def test_making_is_cancelled(away):
    away.select_option("#away-model", "flexible")
    away.click("text=Make the files")
    away.click("#page-take-away button:text-is('Cancel')")
    away.wait_for_selector("#page-take-away >> text=cancelled")
    assert away.is_enabled("text=Make the files")


def test_looks(away, places, heard_well):
    for page in places("take-away"):
        page.wait_for_selector(".lines pre >> text=heeltoe run")
    assert not heard_well(page)
