"""Of several cracks the one that slips most leads, and the verdict says what the dam does at the others."""

import pytest

from heeltoe import flexible, verdict
from heeltoe.result.judge import leading_crack
from shared.dams import example


def test_the_largest_slip_leads_and_none_that_nobody_could_measure():
    assert leading_crack([0.2, -0.3, 0.1]) == 1
    assert leading_crack([9e-5, 0.0]) == 1


@pytest.fixture(scope="module")
def two_cracks():
    return flexible(
        example("two-cracks", "flexible.elements_across=4", "flexible.evidence=none", "motion.duration=12s")
    )


def test_a_crack_that_rocks_is_said_to_rock_whichever_leads(two_cracks):
    upper = two_cracks.cracks[0]
    times = upper.time_by_mode_s
    assert times.rocking + times.slide_rocking > 1.0
    text = verdict(two_cracks)
    assert f"rocks for {times.rocking + times.slide_rocking:.2f} s" in text or "It rocks, standing on one end" in text
    assert "At the crack at" in text


def test_the_numbers_of_the_response_are_those_of_the_worst_crack(two_cracks):
    slips = [abs(crack.residual_slip_m) for crack in two_cracks.cracks]
    assert abs(two_cracks.residual_slip_m) == max(slips)
    answer = two_cracks.to_json()
    assert abs(answer["residual_slip_m"]) == max(slips)
    assert answer["governing_crack"] == slips.index(max(slips))


def test_a_sign_without_a_result_does_not_hide_what_the_other_does(two_cracks):
    from dataclasses import replace

    from heeltoe.models.runner import numbers_of_sign

    failed = replace(two_cracks, outcome="large rotation", advice=None)
    signs = (
        numbers_of_sign("recorded", failed, (), governs=True),
        numbers_of_sign("reversed", two_cracks, (), governs=False),
    )
    text = verdict(replace(failed, signs=signs))
    assert text.startswith("No result to trust (large rotation)")
    assert "This is for the motion as recorded; reversed it slides" in text
