"""The page of an animation in a browser: the player that the app has, too, alone with its histories."""

from __future__ import annotations

import pytest

from heeltoe import animate, read_case, rigid
from shared.dams import BLOCK

pytest.importorskip("playwright")

TIME, NOW = "input[type=range]", ".player-now strong"


@pytest.fixture(scope="module")
def animation(tmp_path_factory):
    """Write the page of a block that slides for some seconds; return its address and the end of its run [s]."""
    case = read_case(BLOCK)
    response = rigid(case)
    path = animate(case, response, tmp_path_factory.mktemp("animation") / "block.html")
    return path.as_uri(), float(response.histories["time_s"][-1])


@pytest.fixture
def shown(chromium, animation):
    """Open the page, which must not complain."""
    page, complaints = chromium.new_page(viewport={"width": 1000, "height": 700}), []
    page.on("console", lambda said: complaints.append(said.text) if said.type == "error" else None)
    page.on("pageerror", lambda error: complaints.append(str(error)))
    page.goto(animation[0])
    yield page
    page.close()
    assert not complaints


def moment(page):
    """Return the moment that is shown once it is drawn [s]."""
    page.evaluate("() => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done)))")
    return float(page.inner_text(NOW).removesuffix(" s"))


def picture(page, canvas):
    moment(page)
    return page.evaluate("(canvas) => document.querySelector(canvas).toDataURL()", canvas)


@pytest.mark.path
def test_keys_go_to_moments(shown, animation):
    end = animation[1]
    assert moment(shown) == 0.0
    shown.keyboard.press("ArrowRight")
    assert moment(shown) == pytest.approx(0.1)
    shown.keyboard.press("Shift+ArrowRight")
    assert moment(shown) == pytest.approx(min(1.1, end), abs=0.01)
    shown.keyboard.press("End")
    assert moment(shown) == pytest.approx(end, abs=0.01)
    # The slider knows the same keys, and nothing steps twice.
    shown.focus(TIME)
    shown.keyboard.press("ArrowLeft")
    assert moment(shown) == pytest.approx(end - 0.1, abs=0.01)
    shown.keyboard.press("Home")
    assert moment(shown) == 0.0


def test_it_opens_at_the_moment_of_its_address(shown, animation):
    shown.goto(f"{animation[0]}#t=0.25")
    assert moment(shown) == 0.25


def test_a_press_on_the_histories_goes_to_its_moment(shown, animation):
    box = shown.locator("#charts").bounding_box()
    # Between the margins that player/page.js leaves.
    left, right = box["x"] + 48, box["x"] + box["width"] - 10
    shown.mouse.click((left + right) / 2, box["y"] + 60)
    assert moment(shown) == pytest.approx(animation[1] / 2, abs=0.02)


def test_it_plays_to_the_end_and_stops_or_begins_again(shown, animation):
    shown.select_option("label:has-text('Speed') select", "5")
    before = picture(shown, "#dam canvas")
    shown.keyboard.press("Space")
    shown.wait_for_selector("button >> text=Play")
    assert moment(shown) == pytest.approx(animation[1], abs=0.01)
    assert picture(shown, "#dam canvas") != before
    shown.check("label:has-text('Repeat') input")
    shown.click("button >> text=Play")
    shown.wait_for_timeout(300 + 400 * animation[1])
    assert shown.is_visible("button >> text=Pause")


def test_it_is_light_and_dark_as_the_system_is(shown):
    shown.emulate_media(color_scheme="light")
    light = picture(shown, "#charts")
    shown.emulate_media(color_scheme="dark")
    assert picture(shown, "#charts") != light
    assert shown.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(22, 24, 27)"


def test_displacements_are_drawn_as_large_as_is_chosen(shown):
    shown.keyboard.press("End")
    # The block slides so far that no more is suggested.
    suggested = picture(shown, "#dam canvas")
    assert "drawn to scale" in shown.inner_text(".drawn-size")
    shown.select_option("label:has-text('Displacements') select", "5")
    assert picture(shown, "#dam canvas") != suggested
    assert "drawn × 5" in shown.inner_text(".drawn-size")
