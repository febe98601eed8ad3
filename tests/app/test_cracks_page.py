"""Further cracks and friction laws on the pages "Case" and "Answer" in a browser."""

from __future__ import annotations

import pytest

pytest.importorskip("playwright")

DEPTH = "#field-reservoir-depth"
SECOND = "[data-handle='further crack 2']"


@pytest.fixture
def case(page):
    page.click("#tab-case")
    page.wait_for_selector(DEPTH)
    page.wait_for_selector("[data-handle=crack]")
    return page


def choose_example(page, name):
    page.select_option("#example", name)
    page.wait_for_function("name => document.querySelector('#example').value === name", arg=name)


def open_block(page, path):
    page.locator(f"[data-block='{path}']").evaluate("each => { each.open = true; each.scrollIntoView(); }")


def value_is(page, selector, value):
    page.wait_for_function("([at, is]) => document.querySelector(at)?.value === is", arg=[selector, value])


def sound(page):
    page.wait_for_function("() => document.querySelector('.problems').textContent === ''")


def test_cracks_are_added_dragged_edited_and_removed(case, picture):
    choose_example(case, "two-cracks")
    case.wait_for_selector("[data-handle='further crack 1']")
    open_block(case, "further_cracks")
    case.click("text=Add a further crack")
    case.wait_for_selector(SECOND)
    value_is(case, "#field-further-cracks-1-elevation", "45 m")
    assert case.evaluate("document.activeElement.id") == "field-further-cracks-1-elevation"
    assert case.locator(".of-further-crack").count() == 2
    case.focus(SECOND)
    case.keyboard.press("ArrowUp")
    value_is(case, "#field-further-cracks-1-elevation", "45.5 m")
    case.fill("#field-further-cracks-1-elevation", "90 m")
    case.wait_for_selector("#field-further-cracks-1-elevation-wrong >> text=meets or crosses")
    case.fill("#field-further-cracks-1-elevation", "30 m")
    sound(case)
    picture(case, "case-cracks")
    case.click("text=Remove further crack 2")
    case.wait_for_selector(SECOND, state="detached")
    assert case.evaluate("document.activeElement.textContent") == "Remove further crack 1"


def test_a_law_shows_its_own_fields_and_its_curve(case, picture):
    open_block(case, "crack.law")
    case.click("text=Add friction law")
    value_is(case, "#field-crack-law-peak-friction", "1")
    case.wait_for_selector(".law-curve >> text=no dam")
    assert case.input_value("#field-crack-friction") == ""
    assert case.is_visible("#field-crack-law-slip")
    assert not case.is_visible("#field-crack-law-jrc")
    picture(case, "case-law")
    case.select_option("#field-crack-law-name", "barton-bandis")
    case.wait_for_selector("#field-crack-law-jrc", state="visible")
    assert not case.is_visible("#field-crack-law-slip")
    case.wait_for_selector("svg.law >> text=normal stress [MPa]")
    case.fill("#field-crack-law-jrc", "30")
    case.wait_for_selector("#field-crack-law-jrc-wrong >> text=30")
    case.fill("#field-crack-law-jrc", "8")
    sound(case)
    case.select_option("#field-crack-law-name", "lift joint")
    value_is(case, "#field-crack-law-roughness-friction-0-1-", "0.4")
    case.click("text=Remove friction law")
    case.wait_for_selector(".law-curve", state="hidden")
    assert float(case.input_value("#field-crack-friction")) > 0.7


def test_what_is_typed_while_the_form_is_made_anew_stays(case):
    """Another unit shows another form: whoever types goes on in it."""
    case.fill(DEPTH, "90")
    value_is(case, "#units", "si")
    typed = case.evaluate(
        """async at => {
            const units = document.querySelector("#units");
            units.value = "us";
            units.dispatchEvent(new Event("change", { bubbles: true }));
            document.querySelector(at).focus();
            document.querySelector(at).select();
            const letters = [..."12345678901234567890"];
            for (const letter of letters) {
                document.execCommand("insertText", false, letter);
                await new Promise((done) => setTimeout(done, 15));
            }
            return document.querySelector(at).value;
        }""",
        DEPTH,
    )
    assert typed == "12345678901234567890"
    case.wait_for_function("at => document.querySelector(at).placeholder.includes('ft')", arg="#field-silt-depth")
    assert case.evaluate("document.activeElement.id") == DEPTH[1:]
    assert case.input_value(DEPTH) == "12345678901234567890"
    case.fill(DEPTH, "260")
    case.focus("#field-crack-friction")
    value_is(case, DEPTH, "260 ft")


@pytest.mark.product
def test_looks(case, heard_well):
    choose_example(case, "two-cracks")
    case.wait_for_selector("[data-handle='further crack 1']")
    case.evaluate("document.querySelectorAll('details').forEach(each => { each.open = true; })")
    assert not heard_well(case)


def test_each_of_several_cracks_answers(case, picture):
    choose_example(case, "two-cracks")
    case.wait_for_selector("[data-handle='further crack 1']")
    for path in ("motion", "flexible"):
        open_block(case, path)
    case.fill("#field-motion-duration", "3 s")
    case.fill("#field-flexible-elements-across", "3")
    case.select_option("#field-flexible-evidence", "none")
    sound(case)
    case.click("#tab-answer")
    case.wait_for_selector(".card[data-details=rigid] >> text=Each crack")
    # What does not know several cracks has no card.
    case.wait_for_selector(".card[data-model=decoupled]", state="hidden")
    case.wait_for_selector(".card[data-details=flexible] >> text=Each crack", timeout=120_000)
    rows = case.locator("[data-details=flexible] table[aria-label='Each crack, from the crest down'] tbody tr")
    assert [all_inner_text.split("\t")[0] for all_inner_text in rows.all_inner_texts()] == ["90 m (leads)", "0 m"]
    # Both models say it, the page once.
    case.wait_for_selector("text=/^Dotted: crack at/")
    # Each part moves by itself.
    case.wait_for_selector(".moving canvas[aria-label*='2 moving parts']")
    case.wait_for_selector("#page-answer .plot .main-svg")
    picture(case, "answer-cracks")


def test_a_law_tells_its_friction_and_what_cannot_be_run(case):
    open_block(case, "crack.law")
    case.click("text=Add friction law")
    value_is(case, "#field-crack-law-peak-friction", "1")
    case.click("#tab-answer")
    case.wait_for_selector(".card[data-details=rigid] >> text=apparent friction is 0.8, before 1")
    assert case.is_disabled("#slider-crack-friction")


def test_a_further_crack_has_a_law_and_corners_of_its_own(case, picture):
    choose_example(case, "two-cracks")
    case.wait_for_selector("[data-handle='further crack 1']")
    open_block(case, "further_cracks")
    own = "#field-further-cracks-0-law"
    assert not case.is_visible(f"{own}-jrc")
    case.click(f"{own} >> text=Add friction law")
    value_is(case, f"{own}-name", "slip weakening")
    value_is(case, "#field-further-cracks-0-friction", "")
    sound(case)
    case.select_option(f"{own}-name", "barton-bandis")
    value_is(case, f"{own}-jrc", "10")
    assert not case.is_visible(f"{own}-slip")
    case.fill(f"{own}-jrc", "8")
    sound(case)
    case.click("#field-further-cracks-0-kinks >> text=Add a row to kinks")
    case.fill("#field-further-cracks-0-kinks-0-0-", "3")
    case.fill("#field-further-cracks-0-kinks-0-1-", "0.4")
    sound(case)
    picture(case, "case-further-law")
    case.click(f"{own} >> text=Remove friction law")
    sound(case)
