"""The pseudo-static load cases: both signs of the vertical coefficient, and the water in what the earthquake opens."""

from __future__ import annotations

import numpy as np
import pytest

import heeltoe
from heeltoe import InputError
from shared.statics import CLOSE, SHAKEN, M, check, dam, only

WAY = "pseudo-static downstream"
STRONG = {"compressive_strength": "20 MPa"}


def test_each_check_is_judged_by_the_sign_that_is_worse_for_it():
    result = heeltoe.statics(dam(statics={**SHAKEN, **STRONG}))
    lifting, pressing = only(result, f"{WAY}, lifting"), only(result, f"{WAY}, pressing")
    # 0.9 (60 -+ 4.8) over the same push
    assert lifting.sliding_factor == pytest.approx(0.9 * 55.2 / 54.825, **CLOSE)
    assert pressing.sliding_factor == pytest.approx(0.9 * 64.8 / 54.825, **CLOSE)
    # Moments about the heel 2815 + 490.1 -+ 128 over 55.2 and 64.8; 96 -+ 4.8 down over 36 up
    assert pressing.resultant_from_heel_m == pytest.approx(3433.1 / 64.8, **CLOSE)
    assert lifting.resultant_from_heel_m == pytest.approx(3177.1 / 55.2, **CLOSE)
    assert pressing.flotation_factor == pytest.approx(100.8 / 36.0, **CLOSE)
    assert lifting.flotation_factor == pytest.approx(96.0 / 40.8, **CLOSE)
    # Toe: within the middle third of nothing; 2 N over what is left in contact
    for each in (lifting, pressing):
        left = 3.0 * (80.0 - each.resultant_from_heel_m)
        assert each.toe_stress_pa == pytest.approx(2.0 * each.normal_force_n / min(left, 80.0), rel=0.2)
    assert pressing.toe_stress_pa > lifting.toe_stress_pa or "compression" in lifting.governs
    assert set(lifting.governs) | set(pressing.governs) >= {"sliding factor", "flotation factor", "resultant"}
    assert not set(lifting.governs) & set(pressing.governs)
    names = [(item.load_case, item.name) for item in result.checks if item.load_case.startswith(WAY)]
    assert sorted(name for _, name in names) == sorted(
        ["equilibrium", "sliding factor", "flotation factor", "resultant", "compression"]
    )
    assert check(result, f"{WAY}, lifting", "sliding factor").value == lifting.sliding_factor
    assert check(result, f"{WAY}, lifting", "flotation factor").value == lifting.flotation_factor


def test_the_press_governs_the_stress_of_a_dam_that_nothing_opens():
    """Neither sign hides what the other does: of a dry dam the press is the larger stress, the lift the smaller N."""
    shaken = {"seismic_coefficient": 0.02, "vertical_seismic_coefficient": 0.4}
    pressed = []
    for strength in np.linspace(1.0, 12.0, 23):
        choice = {**shaken, "compressive_strength": f"{strength:g} MPa"}
        result = heeltoe.statics(dam(reservoir=None, statics=choice))
        pressing = only(result, f"{WAY}, pressing")
        assert "compression" in pressing.governs
        pressed.append(check(result, f"{WAY}, pressing", "compression").met)
    assert pressed == sorted(pressed)
    assert set(pressed) == {False, True}


def test_without_a_vertical_coefficient_there_is_one_case_each_way():
    result = heeltoe.statics(dam(statics={"seismic_coefficient": 0.1}))
    assert [case.name for case in result.cases] == ["usual", WAY, "pseudo-static upstream"]
    assert only(result, WAY).governs is None


@pytest.mark.parametrize("name", ["USACE", "USBR"])
def test_the_water_may_be_chosen_against_the_criteria(name):
    shaken = {"seismic_coefficient": 0.1, "criteria": name}
    result = {
        law: only(heeltoe.statics(dam(statics=shaken | {"uplift_in_earthquake": law})), WAY)
        for law in ("criteria", "unchanged", "zero", "full")
    }
    same = "unchanged" if name == "USACE" else "zero"
    assert result["criteria"].cracked_length_m == result[same].cracked_length_m
    cracks = [result[law].cracked_length_m for law in ("zero", "unchanged", "full")]
    assert cracks == sorted(cracks)
    assert cracks[0] > 0.0


def test_full_pressure_enters_at_once():
    """ICOLD: p on all of the crack, straight from its tip to the toe. With W = 96 and M = 5120 - 1215 - 490.1 about the
    toe, what is left is L = 3 (M - p B^2/2) / (W - p B), p = 0.9 (equation 7)."""
    shaken = {"seismic_coefficient": 0.1, "uplift_in_earthquake": "full"}
    result = only(heeltoe.statics(dam(statics=shaken)), WAY)
    left = 3.0 * (5120.0 - 1215.0 - 490.1 - 0.9 * 3200.0) / (96.0 - 72.0)
    assert result.cracked_length_m == pytest.approx(80.0 - left, **CLOSE)
    assert result.normal_force_n == pytest.approx((96.0 - 0.9 * (80.0 - left) - 0.45 * left) * M, **CLOSE)
    assert "ICOLD" in str(result.assumptions[0])


def test_what_it_opens_matters_without_a_coefficient_to_nobody():
    with pytest.raises(InputError, match=r"statics\.uplift_in_earthquake: has no meaning without seismic_coefficient"):
        dam(statics={"uplift_in_earthquake": "full"})
