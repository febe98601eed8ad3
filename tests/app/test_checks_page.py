"""The page "Answer" beside its numbers: the dam in motion, spread, static checks, the elastic dam that leads."""

from __future__ import annotations

import pytest

from heeltoe.case.toml_writer import case_text
from shared.dams import FAST, example

pytest.importorskip("playwright")

SLIP = ".card[data-details=rigid] tr[data-key=residual_slip_m] td"
DAM = ".moving canvas"
TIME = ".moving input[type=range]"
NOW = ".moving .player-now"


@pytest.fixture
def answer(page):
    page.wait_for_selector(SLIP)
    page.wait_for_selector(".plot .main-svg")
    page.wait_for_selector(DAM)
    return page


def drawn(page):
    """Return the picture of the dam once it is drawn as the controls stand."""
    page.evaluate("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
    return page.evaluate("(dam) => document.querySelector(dam).toDataURL()", DAM)


def moment(page):
    return float(page.input_value(TIME))


def choose(page, label, value):
    page.select_option(f".moving label:has-text('{label}') select", value)


def test_the_dam_follows_its_slider_and_the_sliders_of_the_case(answer, picture):
    # The block alone, which nothing replaces.
    answer.wait_for_selector(".card[data-model=flexible] .headline")
    choose(answer, "Shown", "rigid")
    at_end = drawn(answer)
    answer.focus(TIME)
    answer.keyboard.press("Home")
    answer.wait_for_function("(now) => document.querySelector(now).innerText.startsWith('0.00 s')", arg=NOW)
    at_start = drawn(answer)
    assert at_start != at_end
    assert "rest" in answer.inner_text(NOW)
    assert answer.evaluate("parseFloat(document.querySelector('.plot .cursor').style.left)") > 0
    # What has not moved is where it is, however far displacements are drawn.
    choose(answer, "Displacements drawn", "100")
    assert drawn(answer) == at_start
    assert "× 100" in answer.inner_text(NOW)
    answer.keyboard.press("Tab")
    answer.uncheck(".moving label:has-text('Forces') input")
    assert drawn(answer) != at_start
    answer.focus(TIME)
    answer.keyboard.press("Shift+ArrowRight")
    drawn(answer)
    assert moment(answer) == pytest.approx(1.0)
    answer.keyboard.press("End")
    before = drawn(answer)
    answer.fill("[aria-label='Friction coefficient, exactly']", "1.3")
    answer.wait_for_function("([dam, was]) => document.querySelector(dam).toDataURL() !== was", arg=[DAM, before])
    picture(answer, "answer-moving")


def test_the_elastic_dam_moves_by_its_own_modes(answer):
    answer.wait_for_selector(".card[data-model=flexible] .headline")
    choose(answer, "Shown", "flexible")
    with_lines = drawn(answer)
    assert "relative to the ground" in answer.inner_text(NOW)
    answer.uncheck(".moving label:has-text('Elements') input")
    assert drawn(answer) != with_lines
    # A rigid block has no elements.
    choose(answer, "Shown", "rigid")
    drawn(answer)
    assert answer.is_hidden(".moving label:has-text('Elements')")


def test_plays_and_pauses(answer):
    choose(answer, "Speed", "5")
    answer.click(".moving >> text=Play")
    answer.wait_for_function(
        "(time) => { const t = Number(document.querySelector(time).value); return t > 1 && t < 29; }", arg=TIME
    )
    answer.click(".moving >> text=Pause")
    then = moment(answer)
    answer.evaluate("() => new Promise((done) => setTimeout(done, 300))")
    assert moment(answer) == then
    # Space does the same as the button.
    answer.focus(TIME)
    answer.keyboard.press("Space")
    answer.wait_for_selector(".moving >> text=Pause")
    answer.keyboard.press("Space")
    answer.wait_for_selector(".moving >> text=Play")


def test_who_wants_less_motion_sees_a_picture_now_and_then(answer):
    answer.emulate_media(reduced_motion="reduce")
    choose(answer, "Speed", "0.1")
    gaps = answer.evaluate(
        """() => new Promise((done) => {
            const times = [];
            const seen = new MutationObserver(() => times.push(performance.now()) > 3 && done(times));
            seen.observe(document.querySelector(".moving .player-now strong"), { childList: true });
            document.querySelector(".moving button").click();
        }).then((times) => times.slice(1).map((time, place) => time - times[place]))"""
    )
    assert min(gaps[1:]) > 400, gaps
    answer.click(".moving >> text=Pause")
    answer.emulate_media(reduced_motion="no-preference")


def test_static_checks_follow_while_they_are_open(answer, picture):
    answer.click("text=Static checks of the same case")
    answer.wait_for_selector("[data-checks=statics] >> text=sliding factor")
    before = answer.inner_text("[data-checks=statics] .content")
    answer.fill("[aria-label='Friction coefficient, exactly']", "1.5")
    answer.wait_for_function(
        "(was) => document.querySelector('[data-checks=statics] .content').innerText !== was", arg=before
    )
    answer.wait_for_selector("[data-checks=statics]:not(.stale)")
    picture(answer, "answer-statics")


def test_an_earthquake_by_its_response_spectrum(answer, picture):
    checks = "[data-checks=statics]"
    answer.click("text=Static checks of the same case")
    answer.select_option("#statics-spectrum", "motion")
    answer.wait_for_selector(f"{checks}:not(.stale) >> text=response spectrum downstream")
    assert "first mode" in answer.inner_text(f"{checks} .facts")
    of_motion = answer.inner_text(f"{checks} .content")
    answer.select_option("#statics-spectrum", "design")
    answer.wait_for_function(
        "(was) => document.querySelector('[data-checks=statics] .content').innerText !== was", arg=of_motion
    )
    assert "EN 1998" in answer.inner_text(f"{checks} .facts")
    picture(answer, "answer-spectrum")
    answer.fill("[aria-label='Design spectrum']", "/etc/passwd")
    answer.press("[aria-label='Design spectrum']", "Enter")
    answer.wait_for_selector(f"{checks} .bad >> text=en1998")


def test_the_crest_by_frequency_follows_while_it_is_open(answer, picture):
    card = "[data-checks=crest]"
    answer.click("text=Response of the crest by frequency")
    answer.wait_for_selector(f"{card}:not(.stale) >> text=effective damping", timeout=180_000)
    answer.wait_for_selector(f"{card} .main-svg")
    rows = answer.inner_text(f"{card} tbody")
    assert rows.count("elastic") == 3
    assert "The case has no [rock]" in answer.inner_text(card)
    answer.fill("[aria-label='Water level, exactly']", "60")
    answer.wait_for_function("(was) => document.querySelector('[data-checks=crest] tbody').innerText !== was", arg=rows)
    for width, name in ((1440, "laptop"), (390, "telephone")):
        answer.set_viewport_size({"width": width, "height": 900})
        answer.wait_for_function(
            "(wide) => Math.abs(document.querySelector('[data-checks=crest] .main-svg').clientWidth - wide) < 30",
            arg=answer.evaluate("document.querySelector('[data-checks=crest] .plot').clientWidth"),
        )
        assert answer.evaluate("document.documentElement.scrollWidth <= innerWidth"), name
        picture(answer, f"answer-crest-{name}")


def test_spread(answer, picture):
    answer.click("text=Spread: the same")
    answer.click("text=Run the spread")
    answer.wait_for_selector("[data-checks=spread] table >> text=residual slip", timeout=60_000)
    assert "11 runs" in answer.inner_text("[data-checks=spread]")
    answer.fill("[aria-label='Friction coefficient, exactly']", "1.5")
    answer.wait_for_selector("[data-checks=spread].stale >> text=of the sliders as they were")
    picture(answer, "answer-spread")


def test_a_spread_is_cancelled(answer):
    answer.click("text=Spread: the same")
    answer.select_option("#spread-model", "flexible")
    answer.click("text=Run the spread")
    answer.click("text=Cancel the spread")
    answer.wait_for_selector("[data-checks=spread] >> text=cancelled")
    assert answer.is_enabled("text=Run the spread")


def open_brief(page, folder):
    """Open a case of 3 s with an elastic dam of few elements."""
    path = folder / "brief.toml"
    path.write_text(case_text(example("typical-base", *FAST).model_dump(mode="json", exclude_unset=True)))
    before = page.inner_text(SLIP)
    page.set_input_files("#case-file", path)
    page.wait_for_function("([at, was]) => document.querySelector(at).textContent !== was", arg=[SLIP, before])


def test_evidence_is_run_with_a_button_and_the_block_stands_beside(answer, tmp_path, picture):
    open_brief(answer, tmp_path)
    answer.fill("[aria-label='Friction coefficient, exactly']", "1.2")
    answer.wait_for_selector(".card[data-model=flexible]:not(.stale) .headline")
    details = ".card[data-details=flexible]"
    answer.wait_for_selector(f"{details} >> text=run without evidence")
    answer.click("text=Run the elastic dam with evidence")
    answer.wait_for_selector(f"{details} >> text=run without evidence", state="detached")
    assert "rigid" in answer.inner_text(details).lower()
    picture(answer, "answer-elastic")


def test_static_checks_take_the_slip_of_the_elastic_dam(answer):
    answer.click("text=Static checks of the same case")
    answer.wait_for_selector("[data-checks=statics]:not(.stale) >> text=940.6 mm: flexible model")


def test_a_screen_reader_finds_its_way(answer, heard_well):
    answer.click("text=Spread: the same")
    answer.click("text=Static checks of the same case")
    answer.wait_for_selector("[data-checks=statics]:not(.stale) >> text=flexible model")
    assert not heard_well(answer)
