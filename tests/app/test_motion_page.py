"""The page "Motion" in a browser: records are dropped, chosen, scaled, and shake the dam of the case."""

from __future__ import annotations

import math

import pytest

pytest.importorskip("playwright")

SLIP = ".card[data-details=rigid] tr[data-key=residual_slip_m] td"
FACTS = "[data-motion=horizontal] .facts"


def at2(component="090", peak=0.3, step=0.02, count=500):
    """Return a record as PEER writes one."""
    values = [
        peak * math.sin(0.4 * k) * math.sin(math.pi * k / count) * (1.0 + 0.4 * math.sin(0.011 * k))
        for k in range(count)
    ]
    rows = ["".join(f"{value:15.7E}" for value in values[k : k + 5]) for k in range(0, count, 5)]
    head = [
        "PEER NGA STRONG MOTION DATABASE RECORD",
        f"Made Up Earthquake, 1/1/2001, Somewhere, {component}",
        "ACCELERATION TIME SERIES IN UNITS OF G",
        f"NPTS= {count:6d}, DT= {step:8.4f} SEC,",
    ]
    return "\n".join([*head, *rows]).encode()


def sent(name, content):
    return {"name": name, "mimeType": "application/octet-stream", "buffer": content}


@pytest.fixture
def motion(page):
    page.wait_for_selector(SLIP, state="attached")
    page.click("#tab-motion")
    page.wait_for_selector(f"{FACTS} >> text=PGA")
    page.wait_for_selector("#page-motion .spectrum .main-svg")
    return page


def says(page, selector, text):
    page.wait_for_function(
        "([at, said]) => { const it = document.querySelector(at); return it && it.textContent.includes(said); }",
        arg=[selector, text],
    )


def test_shows_the_motion_of_the_case(motion, picture):
    says(motion, FACTS, "elcentro-1940-180-nga")
    says(motion, FACTS, "0.4 g")
    assert motion.input_value("#horizontal-pga") == "0.4 g"
    picture(motion, "motion")


@pytest.mark.path
def test_a_pair_is_dropped_and_shakes_the_dam(motion, picture):
    before = motion.text_content(SLIP)
    # Who comes from finite elements reads that no mesh has a bottom here.
    assert "do not deconvolve it" in motion.text_content("[data-way=horizontal] #motion-at")
    pair = [sent("MINE090.AT2", at2()), sent("MINEUP.AT2", at2("UP", 0.2))]
    motion.set_input_files("#record-files", pair)
    says(motion, "[data-motion=vertical] .facts", "MINEUP")
    says(motion, FACTS, "MINE090")
    assert motion.input_value("#vertical-source").startswith("record:MINEUP")
    motion.fill("#horizontal-pga", "0.5")
    says(motion, FACTS, "0.5 g")
    picture(motion, "motion-pair")
    motion.click("text=Use in this case")
    says(motion, "#motion-used", "shaken")
    motion.wait_for_function("([at, was]) => document.querySelector(at).textContent !== was", arg=[SLIP, before])
    # What is in the case is shown by the name that its sender gave it.
    motion.wait_for_function(
        "() => document.querySelector('#horizontal-source').selectedOptions[0].text.includes('MINE')"
    )
    motion.reload()
    motion.wait_for_selector(f"{FACTS} >> text=MINE090")


def test_a_file_is_dropped_on_the_page(motion, tmp_path):
    path = tmp_path / "DROP090.AT2"
    path.write_bytes(at2(step=0.01))
    assert motion.input_value("#motion-end") == "30.0 s"
    # As the browser itself tells the page of a file from elsewhere.
    hand = motion.context.new_cdp_session(motion)
    box = motion.locator(".drop").bounding_box()
    held = {"items": [], "files": [str(path)], "dragOperationsMask": 1}
    for kind in ("dragEnter", "dragOver", "drop"):
        at = {"x": box["x"] + 20, "y": box["y"] + 20, "data": held}
        hand.send("Input.dispatchDragEvent", {"type": kind, **at})
        if kind == "dragOver":
            motion.wait_for_selector(".drop.over")
    says(motion, FACTS, "DROP090")
    # The part was one of the motion before it.
    assert motion.input_value("#motion-end") == ""
    motion.wait_for_selector(".drop:not(.over)")


def test_part_of_it_and_the_other_sign(motion):
    motion.fill("#motion-start", "2")
    motion.fill("#motion-end", "12 s")
    motion.check("#horizontal-reverse")
    says(motion, FACTS, "cut to 2 s to 12 s")
    says(motion, FACTS, "sign")
    motion.fill("#motion-start", "13")
    says(motion, "[data-of='motion.processing']", "before the end")
    assert motion.is_disabled("text=Use in this case")


def test_made_to_order(motion):
    motion.select_option("#horizontal-source", label="an earthquake by magnitude and distance")
    motion.fill("#horizontal-distance", "30 km")
    says(motion, FACTS, "seed1")
    motion.fill("#horizontal-magnitude", "12")
    says(motion, "[data-of='motion.file']", "12")
    motion.select_option("#horizontal-source", label="a pulse: half-sine")
    motion.fill("#horizontal-pga", "0.3 g")
    says(motion, FACTS, "points of the case")
    motion.click("text=Use in this case")
    says(motion, "#motion-used", "shaken")


def test_what_a_file_does_not_state_is_asked_for_at_its_field(motion):
    numbers = "\n".join(f"{3.0 * math.sin(0.3 * k) * math.sin(math.pi * k / 400):.5f}" for k in range(400))
    motion.set_input_files("#record-files", [sent("bare.txt", numbers.encode())])
    says(motion, ".sent", "bare.txt")
    motion.wait_for_function(
        "() => [...document.querySelectorAll('[data-way=horizontal] .wrong')].some((e) => e.textContent)"
    )
    assert motion.is_disabled("text=Use in this case")
    # Both at once, in words, beside a field for each.
    says(motion, "[data-of='motion.unit']", "neither the unit of its numbers nor the time between two of them")
    assert motion.is_visible("#horizontal-time_step")
    motion.fill("#horizontal-unit", "m/s^2")
    motion.fill("#horizontal-time_step", "0.02")
    motion.wait_for_function("() => !document.querySelector('.motion-form button.main').disabled")
    motion.fill("#horizontal-unit", "parsec")
    says(motion, "[data-of='motion.unit']", "parsec")


STRANGE_NAMES = [
    "../../etc/passwd",
    "<img src=x onerror=alert(1)>.AT2",
    "elcentro-1940-180-nga",
    "synthetic:M7,1km,seed=1",
    "upload-1",
]


def test_names_of_strangers_are_texts(motion):
    alerts = []
    motion.on("dialog", lambda box: alerts.append(box.dismiss()))
    for count, name in enumerate(STRANGE_NAMES):
        # Each is another record: what is seen is its own.
        peak = 0.2 + 0.01 * count
        motion.set_input_files("#record-files", [sent(name, at2(peak=peak))])
        says(motion, ".sent", "PGA")
        motion.fill("#horizontal-pga", f"{peak} g")
        says(motion, FACTS, f"{peak:.4g} g")
        motion.wait_for_selector(f"{FACTS} >> text=Made Up Earthquake")
        assert motion.is_enabled("text=Use in this case")
    assert not motion.query_selector("img")
    assert not alerts


def test_what_is_no_record_is_said_at_the_file(motion):
    contents = [b"\x00\x01\x02", b"\x7fELF", b"<html></html>", b" \n"]
    motion.set_input_files("#record-files", [sent(f"strange-{n}.AT2", each) for n, each in enumerate(contents)])
    for n in range(len(contents)):
        says(motion, f".sent .bad:nth-child({n + 1})", f"strange-{n}.AT2: ")
    assert "upload-" not in motion.text_content(".sent")


def test_keys_alone(motion):
    motion.focus("#horizontal-pga")
    motion.keyboard.press("Control+a")
    motion.keyboard.type("0.25 g")
    says(motion, FACTS, "0.25 g")
    motion.focus("text=Use in this case")
    motion.keyboard.press("Enter")
    says(motion, "#motion-used", "shaken")


def test_a_sequence_is_made_ordered_and_taken_apart(motion, picture):
    motion.fill("#horizontal-pga", "0.2 g")
    says(motion, FACTS, "0.2 g")
    motion.click("text=Add as an aftershock")
    motion.wait_for_selector("text=Use as motion 2")
    assert motion.locator(".motions li").count() == 2
    motion.fill("[aria-label='Pause before motion 2']", "soon")
    motion.keyboard.press("Tab")
    says(motion, ".motions li:nth-child(2) .wrong", "soon")
    motion.fill("[aria-label='Pause before motion 2']", "20")
    motion.keyboard.press("Tab")
    motion.wait_for_function("() => document.querySelector('[data-does=\"pause 1\"]').value === '20 s'")
    picture(motion, "motion-sequence")
    # By keys: the focus goes with the motion.
    motion.focus("[aria-label='Move motion 2 up']")
    motion.keyboard.press("Enter")
    motion.wait_for_selector("text=Use as motion 1")
    says(motion, ".motions .chosen", "0.2 g")
    motion.focus("[aria-label='Remove motion 2']")
    motion.keyboard.press("Enter")
    motion.wait_for_selector(".motions", state="hidden")
    motion.wait_for_selector("text=Use in this case")
    assert motion.input_value("#horizontal-pga") == "0.2 g"


@pytest.mark.product
def test_looks(motion, places, heard_well):
    for page in places("motion"):
        page.wait_for_selector(f"{FACTS} >> text=PGA")
        page.wait_for_selector("#page-motion .spectrum .main-svg")
    assert not heard_well(page)
