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
    with page.expect_download(timeout=60_000) as waiting:
        page.click(button)
    return waiting.value


def test_files_are_made_and_fetched(away, picture):
    away.select_option("#away-model", "rigid")
    away.check("text=animation")
    away.wait_for_selector(".lines pre >> text=heeltoe animate case.toml --model rigid")
    away.click("text=Make the files")
    away.wait_for_selector("text=Download all (zip)", timeout=180_000)
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


@pytest.mark.parametrize(("name", "width", "scheme"), [("telephone", 390, "dark"), ("projector", 1920, "light")])
def test_looks(chromium, address, picture, name, width, scheme):
    axe = pytest.importorskip("axe_playwright_python.sync_playwright")
    context = chromium.new_context(viewport={"width": width, "height": 900}, color_scheme=scheme)
    page = context.new_page()
    page.goto(f"{address}#take-away")
    page.wait_for_selector(".lines pre >> text=heeltoe run")
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
    picture(page, f"take-away-{name}")
    found = axe.Axe().run(page).response["violations"]
    grave = [each for each in found if each["impact"] in ("serious", "critical")]
    assert not grave, [(each["id"], each["nodes"][0]["html"]) for each in grave]
    context.close()
