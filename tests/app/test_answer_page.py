"""The page "Answer" in a browser: sliders move, verdicts and plots follow."""

from __future__ import annotations

import pytest

pytest.importorskip("playwright")

RIGID = ".card[data-model=rigid]"
SLIP = ".card[data-details=rigid] tr[data-key=residual_slip_m] td"


def slide(page, path: str, value: float) -> None:
    """Move a slider as a hand does: set it and let the page know."""
    page.locator(f"[id='slider-{path.replace('.', '-')}']").evaluate(
        "(slider, to) => { slider.value = to; slider.dispatchEvent(new Event('input', { bubbles: true })); }", value
    )


def settled(page) -> None:
    """Wait until the plot is there and no number is of another position of the sliders."""
    page.wait_for_selector(".plot .main-svg")
    # A function, not a text: the page's policy lets no text be run.
    page.wait_for_function("() => !document.querySelector('.card.stale:not([hidden])')")


def test_opens_with_the_typical_dam(page, picture):
    page.wait_for_selector(f"{RIGID} .verdict")
    settled(page)
    assert "the dam slides 267.4 mm downstream" in page.inner_text(RIGID)
    assert "at the base" in page.inner_text(".card[data-model=decoupled]")
    assert not page.is_visible(".card[data-model=flexible]")
    picture(page, "answer")


def test_sliders_change_the_answer(page):
    page.wait_for_selector(SLIP)
    before = page.inner_text(SLIP)
    slide(page, "crack.friction", 1.2)
    page.wait_for_function("([at, was]) => document.querySelector(at).textContent !== was", arg=[SLIP, before])
    less = float(page.inner_text(SLIP).split()[0])
    assert less < float(before.split()[0])
    slide(page, "reservoir.depth", 80.0)
    page.wait_for_function("([at, was]) => parseFloat(document.querySelector(at).textContent) < was", arg=[SLIP, less])


def test_keys_alone_move_a_slider(page):
    page.wait_for_selector(SLIP)
    before = page.inner_text(SLIP)
    page.focus("#slider-crack-friction")
    for _ in range(3):
        page.keyboard.press("ArrowRight")
    page.wait_for_function("([at, was]) => document.querySelector(at).textContent !== was", arg=[SLIP, before])
    page.focus("#tab-answer")
    page.keyboard.press("ArrowRight")
    assert page.is_visible("#page-studies")
    assert page.evaluate("document.activeElement.id") == "tab-studies"


def test_both_blocks_where_the_crack_is_at_a_height(page, picture):
    page.wait_for_selector(SLIP)
    page.select_option("#example", "typical-height")
    page.wait_for_selector(".card[data-details=decoupled] tr", timeout=30_000)
    settled(page)
    # What takes a moment is marked while the other is newer.
    slide(page, "reservoir.depth", 93.0)
    page.wait_for_selector(".card.stale[data-model=decoupled] >> text=updating")
    settled(page)
    picture(page, "answer-height")


def test_looks(places, heard_well):
    for page in places("answer"):
        page.wait_for_selector(SLIP)
        settled(page)
    assert not heard_well(page)


def test_a_telephone_shows_what_is_dragged_and_what_it_does(page):
    page.set_viewport_size({"width": 390, "height": 760})
    page.wait_for_selector(SLIP)
    settled(page)
    for path in ("crack.friction", "motion.pga"):
        slider = page.locator(f"[id='slider-{path.replace('.', '-')}']")
        slider.evaluate("each => each.scrollIntoView({ block: 'end' })")
        plot, knob = page.locator("#page-answer .plot").bounding_box(), slider.bounding_box()
        assert -1 <= plot["y"] < plot["y"] + plot["height"] <= knob["y"] < 760
    # Nothing that is read below lies behind the plot.
    for part in (".moving svg", ".card[data-details=rigid] [aria-label=Results]"):
        page.locator(part).evaluate("each => each.scrollIntoView({ block: 'start' })")
        assert page.locator(part).evaluate(
            """each => {
                const { x, y, width } = each.getBoundingClientRect();
                return each.contains(document.elementFromPoint(x + width / 2, y + 20));
            }"""
        )


def test_an_elastic_run_is_cancelled(page):
    page.wait_for_selector(SLIP)
    page.click("text=Run the elastic dam")
    page.click("text=Cancel")
    page.wait_for_selector("text=cancelled")
    assert page.is_enabled("text=Run the elastic dam")


def test_two_tabs_do_not_disturb_each_other(page, address):
    page.wait_for_selector(SLIP)
    other = page.context.new_page()
    other.goto(address)
    other.wait_for_selector(SLIP)
    before = other.inner_text(SLIP)
    slide(page, "crack.friction", 1.3)
    page.wait_for_function("([at, was]) => document.querySelector(at).textContent !== was", arg=[SLIP, before])
    settled(page)
    moved = page.inner_text(SLIP)
    slide(other, "crack.restitution", 0.4)
    settled(other)
    assert other.inner_text(SLIP) == before
    page.reload()
    page.wait_for_selector(SLIP)
    assert float(page.input_value("#slider-crack-friction")) == 1.3
    settled(page)
    assert page.inner_text(SLIP) == moved
