"""The page "Export" in a browser: files are made and fetched, and the words for them stand there."""

from __future__ import annotations

import json

import pytest

pytest.importorskip("playwright")


@pytest.fixture
def export(page):
    """Open the page."""
    page.click("#tab-export")
    page.wait_for_selector(".lines pre >> text=heeltoe run case.toml --model auto --out result --report")
    return page


def saved(page, button: str):
    """Fetch what a button offers."""
    with page.expect_download() as waiting:
        page.click(button)
    return waiting.value


@pytest.mark.path
def test_files_are_made_and_fetched(export, picture):
    export.select_option("#export-model", "rigid")
    export.check("text=animation")
    export.wait_for_selector(".lines pre >> text=heeltoe animate case.toml --model rigid")
    # What takes longest is made by the whole path.
    export.uncheck("text=animation")
    export.click("text=Make the files")
    export.wait_for_selector("text=Download all (zip)")
    picture(export, "export")
    result = saved(export, "[aria-label='Download result.json']")
    assert result.suggested_filename == "result.json"
    assert json.loads(result.path().read_text())["residual_slip_m"] == pytest.approx(0.2674, abs=1e-3)
    assert saved(export, "[aria-label='Download report.pdf']").path().read_bytes().startswith(b"%PDF")
    assert saved(export, "text=Download all (zip)").suggested_filename == "heeltoe.zip"
    case = saved(export, "text=Download the case file").path().read_text()
    assert "friction = 1.0" in case
    # Another case: the files are marked.
    export.click("#tab-answer")
    slider = export.locator("#slider-crack-friction")
    slider.focus()
    export.keyboard.press("ArrowRight")
    export.click("#tab-export")
    export.wait_for_selector("text=The case has changed since these files were made")


def test_words_are_copied_by_keys(export):
    export.context.grant_permissions(["clipboard-read", "clipboard-write"])
    export.focus("[aria-label='Copy: Python']")
    export.keyboard.press("Enter")
    export.wait_for_selector(".lines .faint >> text=copied")
    assert 'heeltoe.read_case("case.toml")' in export.evaluate("navigator.clipboard.readText()")


def test_making_is_cancelled(export):
    export.select_option("#export-model", "flexible")
    export.click("text=Make the files")
    export.click("#page-export button:text-is('Cancel')")
    export.wait_for_selector("#page-export >> text=cancelled")
    assert export.is_enabled("text=Make the files")


@pytest.mark.product
def test_looks(export, places, heard_well):
    for page in places("export"):
        page.wait_for_selector(".lines pre >> text=heeltoe run")
    assert not heard_well(page)
