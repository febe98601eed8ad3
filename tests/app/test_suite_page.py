"""A suite of records in a browser: chosen, run, and answered by a number with its limit and a row for each record."""

from __future__ import annotations

import re

import pytest

pytest.importorskip("playwright")


@pytest.mark.path
def test_a_suite_is_chosen_run_and_answered(page, picture, heard_well):
    page.click("#tab-studies")
    page.wait_for_function("() => /runs? \\(/.test(document.querySelector('.outlook').textContent)")
    page.click("button:text-is('Suite of records')")
    # The better model, and nothing of what only a study has.
    assert page.is_checked(".study-form label:has-text('elastic dam') input")
    assert not page.is_visible("text=Fields that vary")
    assert not page.is_visible("legend:text-is('Fragility')")
    page.uncheck(".study-form label:has-text('elastic dam') input")
    page.check(".study-form label:has-text('rigid block') input >> nth=0")
    page.click("button:text-is('none')")
    for name in ("elcentro-1940-180-nga", "pacoima-1971-164-nga", "northridge-aftershock-1994-sylmar-090-nga"):
        page.check(f".records label:has-text('{name}') input")
    assert page.is_visible("text=3 chosen")
    page.select_option("#study-suite-judge", "mean")
    page.fill("#study-suite-target", "nothing")
    page.wait_for_selector("[data-field='suite.target'] .wrong:not(:empty)")
    page.fill("#study-suite-target", "en1998:0.3g,B")
    page.wait_for_function("() => /^6 runs/.test(document.querySelector('.outlook').textContent)")
    page.click("text=Run the study")
    page.wait_for_selector("figure[data-figure=suite-spectra] img")
    assert "residual slip, the mean of the records" in page.inner_text(".study-answers .headline")
    text = page.inner_text(".document")
    governs = r"pacoima-1971-164-nga, \w+, governs among 3 records, each by its worse sign, with a residual slip"
    assert re.search(governs, text), [line for line in text.splitlines() if "governs" in line]
    assert all(name in text for name in ("worse sign", "84 % stay below", "largest", "elcentro-1940-180-nga"))
    assert not heard_well(page)
    for name, width in (("suite", 1440), ("suite-telephone", 390)):
        page.set_viewport_size({"width": width, "height": 900})
        assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")
        picture(page, name)
