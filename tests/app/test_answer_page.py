"""The page "Answer" in a browser: sliders move, verdicts and plots follow."""

from __future__ import annotations

import json

import pytest

from shared.dams import ROOT

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


@pytest.mark.path
def test_opens_with_the_typical_dam(page, picture):
    page.wait_for_selector(f"{RIGID} .verdict")
    settled(page)
    assert "the dam slides 267.4 mm downstream" in page.inner_text(RIGID)
    assert not page.is_visible(".card[data-model=decoupled]")
    picture(page, "answer")


@pytest.mark.path
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
    page.wait_for_selector(".card[data-details=decoupled] tr")
    settled(page)
    # What takes a moment is marked while the other is newer.
    slide(page, "reservoir.depth", 93.0)
    page.wait_for_selector(".card.stale[data-model=decoupled] >> text=updating")
    settled(page)
    picture(page, "answer-height")


@pytest.mark.product
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
        plot, knob = page.locator("#page-answer .plot").first.bounding_box(), slider.bounding_box()
        assert -1 <= plot["y"] < plot["y"] + plot["height"] <= knob["y"] < 760
    # Nothing that is read below lies behind the plot.
    for part in (".moving canvas", ".card[data-details=rigid] [aria-label=Results]"):
        page.locator(part).evaluate("each => each.scrollIntoView({ block: 'start' })")
        assert page.locator(part).evaluate(
            """each => {
                const { x, y, width } = each.getBoundingClientRect();
                return each.contains(document.elementFromPoint(x + width / 2, y + 20));
            }"""
        )


ELASTIC = ".card[data-model=flexible]"
FIRST = (
    "() => [...document.querySelectorAll('#page-answer .cards .card')].find(it => it.checkVisibility()).dataset.model"
)


def test_the_elastic_dam_leads_by_itself_and_is_cancelled_by_the_next_move(page, picture):
    page.wait_for_selector(f"{ELASTIC} .headline")
    settled(page)
    assert page.evaluate(FIRST) == "flexible"
    assert "940.6 mm" in page.inner_text(f"{ELASTIC} .headline")
    page.evaluate("() => { window.heard = []; window.sent = WebSocket.prototype.send; }")
    page.evaluate(
        """() => { WebSocket.prototype.send = function (text) {
            window.heard.push(JSON.parse(text)); return window.sent.call(this, text); }; }"""
    )
    for friction in (1.2, 1.3):
        slide(page, "crack.friction", friction)
        page.wait_for_function(
            "(value) => window.heard.some(({ do: what, values }) => what === 'elastic' && values && "
            "values['crack.friction'] === value)",
            arg=friction,
        )
    settled(page)
    # The first of the two was ended, and only the last is shown.
    assert page.evaluate("() => window.heard.some(({ do: what, values }) => what === 'elastic' && values === null)")
    assert page.evaluate(FIRST) == "flexible"
    assert float(page.inner_text(f"{ELASTIC} .headline strong").split()[0]) < 940.6
    picture(page, "answer-leads")


def test_the_limit_and_a_colour_come_with_the_number(page, tmp_path):
    page.wait_for_selector(f"{ELASTIC} .headline.free >> text=no limit set")
    text = (ROOT / "examples" / "typical-base.toml").read_text() + '\n[limits]\nresidual_slip = "300 mm"\n'
    path = tmp_path / "limited.toml"
    path.write_text(text)
    page.set_input_files("#case-file", path)
    page.wait_for_selector(f"{RIGID} .headline.met >> text=within the 300.0 mm allowed")
    page.wait_for_selector(f"{ELASTIC} .headline.failed >> text=more than the 300.0 mm allowed")


def test_a_long_elastic_run_waits_for_its_button(page, tmp_path):
    text = (ROOT / "examples" / "bonded-joint.toml").read_text()
    path = tmp_path / "fine.toml"
    path.write_text(text.replace("elements_across = 16", "elements_across = 40"))
    page.wait_for_selector(SLIP)
    page.set_input_files("#case-file", path)
    page.wait_for_selector(f"{ELASTIC} >> text=/The elastic dam takes about [0-9]+ s/")
    # The button stands where the number will be.
    assert page.is_enabled(f"{ELASTIC} >> button >> text=Run the elastic dam")
    # The block below which the bond holds needs no waiting.
    page.wait_for_selector(f"{RIGID} >> text=/bond below the block/")
    assert page.is_enabled("text=Run the elastic dam with evidence")


def test_a_row_in_which_nothing_happens_is_a_line(page, tmp_path):
    text = (ROOT / "examples" / "typical-base.toml").read_text()
    path = tmp_path / "rigid.toml"
    path.write_text("\n".join(line for line in text.splitlines() if not line.startswith("modulus")))
    page.wait_for_selector(SLIP)
    page.set_input_files("#case-file", path)
    page.wait_for_selector(f"{ELASTIC}", state="hidden")
    page.wait_for_function("() => document.querySelector('#page-answer .plot')._fullLayout?.annotations.length === 1")
    rows = page.evaluate(
        "() => ['yaxis2', 'yaxis3'].map((row) => document.querySelector('#page-answer .plot')._fullLayout[row]._length)"
    )
    assert rows[1] < 0.15 * rows[0]
    assert "no rotation" in page.inner_text("#page-answer .plot")
    assert "concrete.modulus" in page.inner_text("#page-answer .controls")


def test_tables_are_read_whole(page):
    page.set_viewport_size({"width": 1440, "height": 900})
    page.wait_for_selector(SLIP)
    page.select_option("#example", "two-cracks")
    page.wait_for_selector(".card[data-details=rigid] .table")
    settled(page)
    page.click("text=Static checks of the same case")
    page.wait_for_selector("[data-checks=statics] .table")
    tables = "() => [...document.querySelectorAll('#page-answer .table')].filter(it => it.checkVisibility())"
    assert page.evaluate(f"{tables}.every(it => it.scrollWidth <= it.clientWidth)")


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


def test_an_elastic_run_that_fails_says_so_on_its_card(context, address):
    """The answer is none of the elastic dam: the card does not wait for ever, and offers to ask again."""
    page, asked = context.new_page(), []

    def between(page_side):
        server_side = page_side.connect_to_server()

        def ask(message):
            question = json.loads(message)
            if question["do"] != "elastic":
                server_side.send(message)
            elif question["values"] is not None:
                asked.append(question)
                answer = {"of": "refused", "to": "elastic", "serial": question["serial"], "text": "It failed."}
                page_side.send(json.dumps(answer))

        page_side.on_message(ask)

    page.route_web_socket("**/talk?*", between)
    page.goto(address)
    try:
        page.wait_for_selector(f"{ELASTIC} >> text=It failed.")
        page.click(f"{ELASTIC} >> text=Run the elastic dam")
        page.wait_for_selector(f"{ELASTIC} >> button:enabled")
        assert asked[-1]["long"]
    finally:
        page.evaluate("() => { localStorage.clear(); sessionStorage.clear(); }")
        page.close()
