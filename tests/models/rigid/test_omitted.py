"""What a block that is rigid leaves out, in numbers."""

import pytest

import heeltoe
from heeltoe import decoupled, rigid
from heeltoe.models.decoupled.chain import bonded_chain
from heeltoe.models.decoupled.crack_motion import crack_motion_at
from heeltoe.models.run import earthquake
from shared.dams import example


def said(response, code="rigid-block"):
    return next((each for each in response.warnings if each.code == code), None)


def test_a_block_says_how_the_dam_would_swing():
    case = example("typical-base")
    warning = said(rigid(case))
    numbers = dict(warning.quantities)
    spectrum = heeltoe.response_spectrum(rigid(case).motion, numbers["periods_s"])
    assert numbers["accelerations_g"] == pytest.approx(spectrum.pseudo_acceleration / case.gravity)
    assert numbers["times"][0] > 2.0
    assert "--model auto" in str(warning)


def test_without_a_modulus_it_says_so_of_usual_ones():
    case = example("typical-base")
    case = case.model_copy(update={"concrete": case.concrete.model_copy(update={"modulus": None})})
    response = heeltoe.run(case.based_in(example("typical-base").base_directory))
    assert (response.model, response.chosen.asked) == ("rigid", "auto")
    text = str(said(response))
    assert "with 15 to 35 GPa" in text
    assert "give concrete.modulus" in text


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


def test_what_is_too_stiff_for_any_earthquake_needs_no_warning():
    assert said(rigid(example("block"))) is None


def test_the_chain_says_what_it_leaves_out():
    case = example("koyna", "motion.duration=1 s", "flexible.elements_across=3")
    assert said(decoupled(case), "rigid-top") is not None
