"""The page "Case" in a browser: typed, dragged, by keys alone, opened and saved; nothing typed is lost or run."""

from __future__ import annotations

import re
import tomllib

import pytest

pytest.importorskip("playwright")

WATER = "[data-handle=reservoir]"
DEPTH = "#field-reservoir-depth"
FRICTION = "#field-crack-friction"
VERDICT = ".verdict-line"


@pytest.fixture
def case(page):
    """Show the page of the case."""
    page.click("#tab-case")
    page.wait_for_selector(WATER)
    page.wait_for_selector(DEPTH)
    page.wait_for_function("at => document.querySelector(at).textContent.includes('slides')", arg=VERDICT)
    return page


def wait_for(page, selector, text):
    page.wait_for_function(
        "([at, text]) => document.querySelector(at).textContent.includes(text)", arg=[selector, text]
    )


def value_is(page, selector, value):
    page.wait_for_function("([at, is]) => document.querySelector(at).value === is", arg=[selector, value])


def place_of(page, selector):
    """Return where something is once it has stopped moving: the drawing takes its size while the page fills."""
    before = None
    while before != (now := page.locator(selector).bounding_box()):
        before = now
        page.wait_for_timeout(200)
    return now


@pytest.mark.path
def test_what_is_typed_is_checked_at_its_field(case, picture):
    picture(case, "case")
    verdict = case.inner_text(VERDICT)
    case.fill(FRICTION, "slippery")
    wait_for(case, "#field-crack-friction-wrong", "slippery")
    assert case.get_attribute(FRICTION, "aria-invalid") == "true"
    wait_for(case, ".problems", "The last sound case stays in force")
    assert case.inner_text(VERDICT) == verdict
    case.fill(DEPTH, "95 m")
    case.fill("#field-title", "Mine")
    assert case.input_value(FRICTION) == "slippery"
    picture(case, "case-wrong")
    case.fill(FRICTION, "1.2")
    wait_for(case, "#case-title", "Mine")
    case.wait_for_function("([at, was]) => document.querySelector(at).textContent !== was", arg=[VERDICT, verdict])
    assert case.inner_text(".problems") == ""
    case.fill(DEPTH, "260")
    case.select_option("#units", "us")
    case.fill(DEPTH, "260")
    case.focus(FRICTION)
    value_is(case, DEPTH, "260 ft")


def test_the_water_level_is_dragged_and_the_answer_follows(case):
    verdict = case.inner_text(VERDICT)
    box = place_of(case, f"{WATER} .knob")
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    case.mouse.move(x, y)
    case.mouse.down()
    case.mouse.move(x, y + 30)
    case.mouse.move(x, y + 80, steps=4)
    case.mouse.up()
    height = case.locator("[data-handle=base] .knob").bounding_box()["y"] - box["y"]  # of 100 m
    case.wait_for_function(
        "([at, is]) => Math.abs(parseFloat(document.querySelector(at).value) - is) < 0.6",
        arg=[DEPTH, 100.0 - 80.0 * 100.0 / height],
    )
    case.wait_for_function("([at, was]) => document.querySelector(at).textContent !== was", arg=[VERDICT, verdict])
    depth = float(case.input_value(DEPTH).removesuffix(" m"))
    assert case.get_attribute(WATER, "aria-valuetext") == case.input_value(DEPTH)
    case.click("#tab-answer")
    case.wait_for_function(
        "([at, is]) => Number(document.querySelector(at).value) === is", arg=["#slider-reservoir-depth", depth]
    )
    # And back: what a slider changes stands in the form.
    case.focus("#slider-crack-friction")
    case.keyboard.press("ArrowRight")
    wait_for(case, ".card[data-model=rigid]", "slides")
    case.click("#tab-case")
    value_is(case, FRICTION, "1.01")
    case.click("text=Undo")
    value_is(case, FRICTION, "1")
    case.click("text=Undo")
    value_is(case, DEPTH, "100 m")
    case.click("text=Redo")
    case.wait_for_function("at => parseFloat(document.querySelector(at).value) < 90", arg=DEPTH)


@pytest.fixture
def held(context, address):
    """Open a tab that hears nothing of the server while its list of what waits is not None; return both."""
    opened, waiting = context.new_page(), [None]

    def between(page_side):
        server_side = page_side.connect_to_server()

        def hear(message):
            if waiting[0] is None:
                page_side.send(message)
            else:
                waiting[0].append((page_side, message))

        server_side.on_message(hear)

    opened.route_web_socket("**/talk?*", between)
    opened.goto(address)
    yield opened, waiting
    opened.evaluate("() => { localStorage.clear(); sessionStorage.clear(); }")
    opened.close()


def let_through(waiting):
    messages, waiting[0] = waiting[0], None
    for page_side, message in messages:
        page_side.send(message)


def until_the_server_has_said_its_state(page, waiting):
    while not any('"of":"state"' in message for _, message in waiting[0]):
        page.wait_for_timeout(100)


def test_a_key_on_a_slider_before_the_case_has_arrived(held):
    """The server has changed the case, which the page does not know when a key is pressed on one of its sliders."""
    page, waiting = held
    page.click("#tab-case")
    page.wait_for_selector(DEPTH)
    page.click("#tab-answer")
    page.wait_for_selector(".card[data-model=rigid] >> text=slides")
    # The elastic dam, which restitution is nothing to, has answered.
    page.wait_for_selector(".card[data-model=flexible]:not(.stale) .headline")
    page.focus("#slider-crack-restitution")
    page.keyboard.press("ArrowRight")
    moved = page.input_value("#slider-crack-restitution")
    page.wait_for_function("() => !document.querySelector('.card.stale:not([hidden])')")
    page.click("#tab-case")
    value_is(page, "#field-crack-restitution", moved)
    waiting[0] = []
    page.fill(DEPTH, "95 m")
    until_the_server_has_said_its_state(page, waiting)
    page.click("#tab-answer")
    page.focus("#slider-crack-friction")
    page.keyboard.press("ArrowRight")
    page.keyboard.press("ArrowRight")
    page.wait_for_timeout(500)
    let_through(waiting)
    for slider, value in (("reservoir-depth", "95"), ("crack-friction", "1.02"), ("crack-restitution", moved)):
        value_is(page, f"#slider-{slider}", value)
    assert page.evaluate("() => document.activeElement.id") == "slider-crack-friction"
    page.keyboard.press("ArrowRight")
    value_is(page, "#slider-crack-friction", "1.03")
    page.click("#tab-case")
    value_is(page, FRICTION, "1.03")
    value_is(page, DEPTH, "95 m")


def test_a_key_on_a_slider_of_a_case_that_has_gone(held):
    """Another example has no use for where the sliders of the one before stood, and other units have other numbers."""
    page, waiting = held
    page.click("#tab-answer")
    page.wait_for_selector(".card[data-model=rigid] >> text=slides")
    for choose, expected in ((("#units", "us"), "328"), (("#example", "typical-height"), "311.7")):
        waiting[0] = []
        page.select_option(*choose)
        until_the_server_has_said_its_state(page, waiting)
        page.focus("#slider-reservoir-depth")
        page.keyboard.press("ArrowLeft")
        page.wait_for_timeout(500)
        let_through(waiting)
        value_is(page, "#slider-reservoir-depth", expected)


def test_a_file_that_is_too_large_is_refused_before_it_is_sent(case, tmp_path):
    path = tmp_path / "large.toml"
    with path.open("wb") as file:
        file.truncate(30_000_000)
    asked = []
    case.on("request", lambda request: asked.append(request.url))
    case.set_input_files("#case-file", path)
    case.wait_for_selector(
        "#page-case .wrong >> text=large.toml: The file has more than 20 MB; send the part that matters."
    )
    assert asked == []


def test_by_keys_alone(case):
    case.focus("#tab-case")
    for _ in range(40):
        case.keyboard.press("Tab")
        if case.evaluate("document.activeElement.dataset.handle") == "reservoir":
            break
    assert case.evaluate("document.activeElement.dataset.handle") == "reservoir"
    assert case.evaluate("document.activeElement.getAttribute('role')") == "slider"
    case.keyboard.press("ArrowDown")
    case.keyboard.press("ArrowDown")
    value_is(case, DEPTH, "99 m")
    case.keyboard.press("PageDown")
    value_is(case, DEPTH, "94 m")
    assert case.evaluate("document.activeElement.dataset.handle") == "reservoir"
    case.focus("text=Undo")
    case.keyboard.press("Enter")
    value_is(case, DEPTH, "100 m")


def test_corners_and_blocks(case, picture):
    case.click("text=Edit the section by its corners")
    case.wait_for_selector("[data-handle='corner 1']")
    rows = case.locator("#field-section-polygon tbody tr")
    assert rows.count() == 5
    case.focus("[data-handle='corner 2']")
    case.keyboard.press("ArrowRight")
    value_is(case, "#field-section-polygon-1-0-", "80.5 m")
    case.click("[aria-label='Insert a row after row 2']")
    case.wait_for_selector("[data-handle='corner 6']")
    value_is(case, "#field-section-polygon-2-0-", "44.25 m")
    case.focus("[data-handle='corner 6']")
    case.keyboard.press("Delete")
    case.wait_for_selector("[data-handle='corner 6']", state="detached")
    case.click("[data-block=tailwater] summary")
    case.click("text=Add tailwater")
    case.wait_for_selector("[data-handle=tailwater]")
    value_is(case, "#field-tailwater-depth", "10 m")
    case.click("[data-block=anchors] summary")
    case.click("text=Add an anchor")
    case.wait_for_selector("[data-handle='anchor 1']")
    case.fill("#field-anchors-0-prestress", "none")
    wait_for(case, "#field-anchors-0-prestress-wrong", "none")
    case.fill("#field-anchors-0-prestress", "2 MN/m")
    case.wait_for_function("() => document.querySelector('.problems').textContent === ''")
    picture(case, "case-corners")
    case.click("text=Remove tailwater")
    case.wait_for_selector("[data-handle=tailwater]", state="detached")


def test_a_file_is_opened_and_saved(case, tmp_path):
    path = tmp_path / "own.toml"
    path.write_text(
        'title = "<img src=x onerror=alert(1)>"\ncrak = 1\n'
        '[section]\nheight = "50 ft"\ncrest_width = "5 ft"\nbase_width = "40 ft"\n'
        '[crack]\nfriction = 0.9\n[motion]\nfile = "/etc/passwd"\n'
    )
    case.set_input_files("#case-file", path)
    wait_for(case, ".problems", "crak")
    assert "has not been sent" in case.text_content("#field-motion-file-wrong")
    case.click("text=Remove it")
    case.click("[data-block=motion] summary")
    case.fill("#field-motion-file", "elcentro-1940-180-nga")
    case.wait_for_function("() => document.querySelector('.problems').textContent === ''")
    wait_for(case, "#case-title", "<img")
    assert case.locator("img").count() == 0
    with case.expect_download() as result:
        case.click("text=Save the case file")
    assert re.fullmatch(r"[a-z0-9-]+\.toml", result.value.suggested_filename)
    saved = tomllib.loads(result.value.path().read_text())
    assert saved["section"] == {"height": "50 ft", "crest_width": "5 ft", "base_width": "40 ft"}
    assert saved["title"].startswith("<img")
    broken = tmp_path / "broken.toml"
    broken.write_text("[section\n")
    case.set_input_files("#case-file", broken)
    wait_for(case, ".seen > .wrong", "broken.toml")
    assert case.input_value("#field-section-height") == "50 ft"


def test_a_refusal_goes_with_the_next_success(case):
    case.evaluate("() => document.querySelector('#field-title').removeAttribute('maxlength')")
    case.fill("#field-title", "x" * 250_000)
    wait_for(case, "#notice", "kB")
    value_is(case, "#field-title", "x" * 250_000)  # nothing that was typed is lost
    assert case.is_visible("#notice")
    case.fill("#field-title", "short")
    wait_for(case, "#case-title", "short")
    case.wait_for_selector("#notice", state="hidden")


def test_a_screen_reader_finds_its_way(case, heard_well):
    case.evaluate("document.querySelectorAll('details').forEach(each => { each.open = true; })")
    case.fill(FRICTION, "x")
    wait_for(case, "#field-crack-friction-wrong", "x")
    assert not heard_well(case)


@pytest.mark.product
def test_looks(case, places):
    for page in places("case"):
        page.wait_for_selector(WATER)
        page.wait_for_selector(DEPTH)
        drag_by_finger(page)


def drag_by_finger(page):
    before = page.input_value(DEPTH)
    page.locator(WATER).scroll_into_view_if_needed()
    box = place_of(page, f"{WATER} .knob")
    x, y = box["x"] + box["width"] / 2, box["y"] + box["height"] / 2
    fingers = page.context.new_cdp_session(page)
    for kind, points in (("Start", [{"x": x, "y": y}]), ("Move", [{"x": x, "y": y + 25}]), ("End", [])):
        fingers.send("Input.dispatchTouchEvent", {"type": f"touch{kind}", "touchPoints": points})
    page.wait_for_function(
        "([at, was]) => parseFloat(document.querySelector(at).value) < parseFloat(was)", arg=[DEPTH, before]
    )
