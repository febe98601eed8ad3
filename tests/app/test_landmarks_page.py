"""Every page has landmarks, and headings in their order: what somebody who hears it goes by."""

from __future__ import annotations

import pytest

pytest.importorskip("playwright")

RULES = ["region", "heading-order", "page-has-heading-one", "empty-heading", "landmark-one-main", "landmark-unique"]


def test_landmarks_and_headings(page):
    axe = pytest.importorskip("axe_playwright_python.sync_playwright")
    page.wait_for_selector(".card[data-model=flexible] .headline")
    wrong = []
    for tab in ("answer", "case", "motion", "studies", "export"):
        page.click(f"#tab-{tab}")
        page.wait_for_selector(f"#page-{tab} :is(h2, h3)", state="attached")
        page.wait_for_timeout(500)
        answer = axe.Axe().run(page, options={"runOnly": {"type": "rule", "values": RULES}}).response
        wrong += [(tab, rule["id"], node["html"][:120]) for rule in answer["violations"] for node in rule["nodes"]]
    assert not wrong
    # A heading of a card is no larger than that of its page.
    page.click("#tab-motion")
    page.wait_for_selector("#page-motion .card h3")
    assert page.evaluate("parseFloat(getComputedStyle(document.querySelector('#page-motion .card h3')).fontSize)") <= 18
