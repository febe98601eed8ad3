"""The page "Studies" in a browser: define, look, run, cancel, continue, come back, export."""

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
    page.wait_for_function(LOOKED)
    return page


def small(page) -> None:
    """Ask for three runs."""
    page.uncheck("text=each motion both ways round")
    page.fill("[data-field='vary.crack.friction['] input", "0.9, 1.0, 1.1")
    page.click("text=Remove >> nth=1")
    page.wait_for_function("() => /^3 runs/.test(document.querySelector('.outlook').textContent)")


def ran(page) -> None:
    """Run it and wait for what it says."""
    page.click("text=Run the study")
    page.wait_for_selector(".document figure img")


def reached(page) -> int:
    """Return how many of a million runs are done."""
    message = page.wait_for_selector(".studies .state >> text=/of 1,000,000 runs/").inner_text()
    return int(message.split(" of ")[0].replace(",", ""))


def saved(page, label: str) -> bytes:
    """Fetch what a button offers."""
    with page.expect_download() as waiting:
        page.click(f"button:text-is('{label}')")
    return waiting.value.path().read_bytes()


def test_a_study_is_counted_run_exported_and_looked_at(studies, places, picture, heard_well):
    picture(studies, "studies-form")
    small(studies)
    ran(studies)
    assert "residual slip" in studies.inner_text(".document")
    picture(studies, "studies-answers")
    rows = list(csv.DictReader(io.StringIO(saved(studies, "Runs (CSV)").decode())))
    assert [float(row["crack.friction"]) for row in rows] == [0.9, 1.0, 1.1]
    names = zipfile.ZipFile(io.BytesIO(saved(studies, "All of it (zip)"))).namelist()
    parts = {name.split("/", 1)[1] for name in names}
    assert {"case.toml", "study.toml", "study/study.json"} <= parts
    assert any(part.startswith("study/runs/part-00000000-") for part in parts)
    assert any(name.startswith("study/figures/") for name in parts)
    for page in places("studies"):
        page.click(".studies button:text-is('Show')")
        page.wait_for_selector(".document figure img")
    assert not heard_well(page)


def test_what_is_wrong_is_said_at_its_field(studies):
    place = "[data-field='vary.crack.friction[']"
    studies.fill(f"{place} input", "0.9, -1")
    studies.wait_for_selector("[data-field='vary.crack.friction'] >> text=out of range")
    assert studies.is_disabled("text=Run the study")
    # Its button is in sight wherever the form stands, and what is wrong is one click away.
    studies.evaluate("scrollTo(0, 0)")
    button = studies.locator("text=Run the study").bounding_box()
    assert button["y"] >= 0
    assert button["y"] + button["height"] <= 900
    studies.click(".launch >> text=Something above cannot be used")
    assert studies.evaluate("document.activeElement.value") == "0.9, -1"
    studies.fill(f"{place} input", "0.9")
    studies.wait_for_function(LOOKED)
    assert not studies.is_visible("text=out of range")
    studies.select_option("#study-method", "sobol")
    studies.fill("#study-samples", "3")
    studies.wait_for_selector("[data-field=samples] >> text=write for example 2 or 4")
    studies.fill("#study-samples", "9999999999")
    studies.wait_for_selector("text=/too many|not a power/")
    studies.click("button:text-is('Fragility')")
    studies.fill("#study-correlation", "crack.friction, nothing, 0.4")
    studies.wait_for_selector("[data-field=correlation] .wrong:not(:empty)")
    studies.fill("#study-correlation", "")
    studies.wait_for_function("() => /^1,000 runs/.test(document.querySelector('.outlook').textContent)")


def test_a_folder_of_records_is_taken(studies, tmp_path):
    (tmp_path / "quakes").mkdir()
    for name in ("one-000", "one-090"):
        rows = "".join(f"{0.01 * k:.2f} {0.3 * (-1) ** (k // 9):.3f}\n" for k in range(60))
        (tmp_path / "quakes" / f"{name}.txt").write_text(f"# units: time [s], acceleration [g]\n{rows}")
    (tmp_path / "quakes" / "notes.txt").write_text("none")
    studies.select_option("#study-source", "records")
    studies.set_input_files("#study-folder", tmp_path / "quakes")
    studies.wait_for_selector("#study-folder-status >> text=/^2 of 3 files read; notes.txt/")
    for name in ("one-000", "one-090"):
        assert studies.is_checked(f"label:has-text('{name}.txt') input")
    studies.fill("#study-scenario-magnitude", "6.5")
    studies.wait_for_selector("[data-field=scenario] > .wrong >> text=distance")
    assert studies.is_disabled("text=Run the study")


@pytest.mark.slow
def test_a_study_is_found_again_cancelled_and_gone_on_with(context, address):
    page = context.new_page()
    page.goto(f"{address}#studies")
    page.wait_for_function(LOOKED)
    page.click("button:text-is('Fragility')")
    page.fill("#study-title", "<img src=x onerror=alert(1)>")
    # More than are done before the page is there again, on any machine.
    page.fill("#study-samples", "1000000")
    page.wait_for_function("() => /^1,000,000 runs/.test(document.querySelector('.outlook').textContent)")
    page.click("text=Run the study")
    page.wait_for_selector(".studies li")
    page.close()
    page = context.new_page()
    page.goto(f"{address}#studies")
    done = reached(page)
    page.click(".studies button:text-is('Cancel')")
    page.wait_for_selector(".studies .state >> text=cancelled")
    assert page.inner_text(".studies strong") == "<img src=x onerror=alert(1)>"
    other = context.new_page()
    other.goto(f"{address}#studies")
    other.wait_for_selector(".study-form fieldset")
    assert not other.is_visible(".studies li")  # that of the tab which is open
    other.close()
    page.click(".studies button:text-is('Go on')")
    # It does not begin anew.
    assert reached(page) >= done
    page.click(".studies button:text-is('Cancel')")
    page.wait_for_selector(".studies .state >> text=cancelled")
    page.click(".studies button:text-is('Show')")
    page.wait_for_selector(".document figure img")
    assert page.inner_text(".document h2") == "<img src=x onerror=alert(1)>"
    page.click(".studies button:text-is('Remove')")
    page.wait_for_selector(".studies li", state="detached")
    page.evaluate("localStorage.clear()")
    page.close()


@pytest.mark.path
def test_keys_alone_make_a_study(studies):
    studies.focus("#study-title")
    studies.keyboard.type("by keys")
    studies.focus("button:text-is('Add a field')")
    studies.keyboard.press("Enter")
    assert studies.evaluate("document.activeElement.tagName") == "SELECT"
    studies.focus(".varied .row:last-child button")
    studies.keyboard.press("Enter")
    studies.focus("button:text-is('Fragility')")
    studies.keyboard.press("Enter")
    # More runs than are done before the next key, on any machine.
    studies.focus("#study-samples")
    studies.keyboard.press("ControlOrMeta+A")
    studies.keyboard.type("1000000")
    studies.wait_for_function("() => /^1,000,000 runs/.test(document.querySelector('.outlook').textContent)")
    studies.wait_for_function("() => !document.querySelector('button.main:disabled')")
    studies.focus("text=Run the study")
    studies.keyboard.press("Enter")
    studies.wait_for_selector(".studies li >> text=by keys")
    studies.focus("[aria-label='Cancel: by keys']")
    studies.keyboard.press("Enter")
    studies.wait_for_selector(".studies .state >> text=cancelled")
