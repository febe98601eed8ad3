"""What a block that is rigid leaves out, in numbers."""

from html import unescape

import pytest

import heeltoe
from heeltoe import decoupled, rigid
from heeltoe.models.decoupled.chain import bonded_chain
from heeltoe.models.decoupled.crack_motion import crack_motion_at
from heeltoe.models.run import earthquake
from heeltoe.views.report.html import html
from heeltoe.views.report.write import build_report
from shared.command import command
from shared.dams import EXAMPLES, example
from shared.report_reader import squeezed


def said(response, code="rigid-block"):
    return next((item for item in response.warnings if item.name == code), None)


def test_a_block_says_how_the_dam_would_swing():
    case = example("typical-base")
    warning = said(rigid(case))
    numbers = dict(warning.quantities)
    spectrum = heeltoe.response_spectrum(rigid(case).motion, numbers["periods_s"])
    assert numbers["accelerations_g"] == pytest.approx(spectrum.pseudo_acceleration / case.gravity)
    assert numbers["times"][0] > 2.0


def test_without_a_modulus_it_says_so_of_usual_ones():
    case = example("typical-base")
    case = case.model_copy(update={"concrete": case.concrete.model_copy(update={"modulus": None})})
    response = heeltoe.run(case.based_in(example("typical-base").base_directory))
    assert (response.model, response.chosen.asked) == ("rigid", "auto")
    text = str(said(response))
    assert "with 15 to 35 GPa" in text
    farther = said(response, "rigid-unlike-dam slides")
    assert "give concrete.modulus" in str(farther)
    # What both moduli span.
    low, high = dict(farther.quantities)["times"]
    for modulus in ("15 GPa", "35 GPa"):
        mine = dict(
            said(
                heeltoe.run(example("typical-base", f"concrete.modulus={modulus}"), "rigid"), "rigid-unlike-dam slides"
            ).quantities
        )
        assert low <= mine["times"][0] < mine["times"][1] <= high


def test_a_crack_at_a_height_is_shaken_by_what_is_below():
    """About as the elastic dam shakes it."""
    case = example("typical-height", "flexible.elements_across=3")
    ground = earthquake(case)
    peak = crack_motion_at(bonded_chain(case), ground, 1e-3).horizontal.pga / ground.motion.pga
    text = str(said(rigid(case)))
    assert "at the crack, 90 m above the base" in text
    about = float(text.split(" times the ground")[0].rsplit(maxsplit=1)[-1])
    # Three modes of a beam, whose largest need not come together.
    assert about == pytest.approx(peak, rel=0.25)


def test_it_says_how_much_farther_such_a_dam_slides():
    """The elastic dam is in the band: 60.0 mm, and the chain 54.6 mm (docs/flexible.md), where the block slides 2.1."""
    response = rigid(example("lift-joint"))
    warning = said(response, "rigid-unlike-dam slides")
    low, high = dict(warning.quantities)["times"]
    assert low < 60.0 / 2.1 < high
    assert "run it with --model auto" in str(warning)
    assert "the decoupled chain" in str(warning)
    answer = next(
        item
        for item in response.to_json()["warnings"]
        if (item["code"], item["kind"]) == ("rigid-unlike-dam", "slides")
    )
    assert answer["quantities"]["times"] == [low, high]
    assert 0.5 < answer["quantities"]["share"] < 0.9


def test_of_a_crack_at_the_base_there_is_no_chain_to_speak_of():
    warning = said(rigid(example("typical-base")), "rigid-unlike-dam slides")
    low, high = dict(warning.quantities)["times"]
    assert 1.0 <= low < high < 10.0
    assert "chain" not in str(warning)


def test_a_block_that_holds_says_how_many_dams_like_it_do_not():
    weak, strong = (
        dict(said(rigid(example("lift-joint", f"motion.pga={pga}")), "rigid-unlike-dam holds").quantities)["shares"][0]
        for pga in ("0.12 g", "0.22 g")
    )
    assert 0.01 <= weak < 0.5 < strong <= 0.99
    text = str(said(rigid(example("lift-joint", "motion.pga=0.22 g")), "rigid-unlike-dam holds"))
    assert "its block slides less than 1 mm, but" in text
    assert "slide more than 10 mm" in text


@pytest.mark.parametrize(
    ("changes", "why"),
    [
        (["motion.vertical.file=elcentro-1940-up-nga"], "the ground moves vertically, too"),
        (["crack.inclination=3 deg"], "its crack is inclined"),
        (["uplift.during_shaking=zero while open"], "its uplift changes while it is shaken"),
        (["crack.elevation=41 m"], "height of the crack over that of the dam is 0.91, studied 0 to"),
        (["reservoir.depth=20 m"], "depth of the reservoir over the height of the dam is 0.44, studied 0.6 to 1"),
        (["crack.friction=2"], "coefficient of friction is 2, studied 0.6 to 1.2"),
        (["concrete.damping=0.01"], "damping ratio is 0.01, studied 0.03 to 0.08"),
    ],
    ids=lambda given: "",
)
def test_of_what_was_not_studied_it_says_so(changes, why):
    warning = said(rigid(example("lift-joint", *changes)), "rigid-unlike-dam unknown")
    assert why in str(warning)


def test_of_anchors_of_several_cracks_and_of_a_block_that_overturns_it_says_so_too():
    assert "it has anchors" in str(said(rigid(example("anchored")), "rigid-unlike-dam unknown"))
    assert "it has several cracks" in str(said(rigid(example("two-cracks")), "rigid-unlike-dam unknown"))
    response = rigid(example("slender", "concrete.modulus=1 GPa"))
    assert response.outcome == "overturned"
    assert "its block ended as overturned" in str(said(response, "rigid-unlike-dam unknown"))


def test_a_motion_that_jumps_has_no_mean_period():
    case = example("lift-joint")
    step = heeltoe.GroundMotion.from_points([0.0, 0.1, 0.1, 0.2, 1.0], [0.0, 0.0, 3.0, -3.0, 0.0])
    assert "its motion jumps" in str(said(rigid(case, step), "rigid-unlike-dam unknown"))


@pytest.mark.slow
def test_terminal_and_report_say_it_as_the_json_does():
    case = example("lift-joint")
    response = rigid(case)
    text = str(said(response, "rigid-unlike-dam slides"))
    assert squeezed(text) in squeezed(command("run", str(EXAMPLES / "lift-joint.toml"), "--model", "rigid").stdout)
    assert squeezed(text) in squeezed(unescape(html(build_report(case, response))))


def test_what_is_too_stiff_for_any_earthquake_needs_no_warning():
    assert said(rigid(example("block"))) is None


def test_the_chain_says_what_it_leaves_out():
    case = example("koyna", "motion.duration=1 s", "flexible.elements_across=3")
    assert said(decoupled(case), "rigid-top") is not None
