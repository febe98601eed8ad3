"""The largest tension beside the strength of the concrete: numbers, warnings, evidence."""

from __future__ import annotations

import pytest

from heeltoe import flexible
from heeltoe.models.flexible.result.tension import share_beyond
from heeltoe.result.numbers import StressPlace
from heeltoe.result.tension import place_phrase
from shared.dams import BASE, FAST, HEIGHT, example, plane_case


def codes(response):
    return {warning.name for warning in response.warnings}


def run(*changes):
    return flexible(plane_case(HEIGHT, [*FAST, *changes]))


def test_without_a_strength_nothing_is_judged():
    response = run()
    tension = response.tension
    assert tension["stress_pa"] > 0.0
    assert tension["strength"] is None
    assert not {"tension-exceeds shaken", "tension-exceeds before"} & codes(response)


def test_a_tension_beyond_the_strength_is_warned_of():
    weak, strong = (run(f"concrete.tensile_strength={strength}") for strength in ("0.5 MPa", "20 MPa"))
    tension, strength = weak.tension, weak.tension["strength"]
    assert strength["dynamic_pa"] == 0.75e6
    assert strength["exceeds"]
    assert 0.0 < strength["share_beyond"] < 1.0
    notice = next(warning for warning in weak.warnings if warning.name == "tension-exceeds shaken")
    assert notice.time_s == tension["time_s"]
    text = notice.text()
    assert f"a tension of {tension['stress_pa'] / 1e6:.3g} MPa" in text
    assert "exceeds the 0.75 MPa" in text
    assert "the assumption that nothing cracks further does not hold" in text
    assert "psi" in notice.text("us")
    assert strong.tension["strength"]["exceeds"] is False
    assert strong.tension["strength"]["share_beyond"] == 0.0
    assert strong.tension["stress_pa"] == tension["stress_pa"]
    assert "tension-exceeds shaken" not in codes(strong)
    assert any("Raphael" in reference for reference in weak.references)
    # The static strength is what counts before the earthquake.
    assert not strength["exceeds_before_shaking"]


def test_the_factor_of_fast_loads_counts():
    response = run("concrete.tensile_strength=0.5 MPa", "concrete.dynamic_tension=2")
    assert response.tension["strength"]["dynamic_pa"] == 1e6
    assert response.tension["strength"]["static_pa"] == 0.5e6


def test_a_dam_that_is_pulled_too_hard_before_the_earthquake():
    response = run("concrete.tensile_strength=1 kPa")
    assert response.tension["strength"]["exceeds_before_shaking"]
    assert response.tension["before_shaking_pa"] > 1e3
    assert "tension-exceeds before" in codes(response)


def test_another_mesh_says_how_certain_it_is():
    response = flexible(example("typical-height", *FAST[2:], "flexible.elements_across=4"))
    mesh = response.tension["mesh"]
    across = response.evidence["elements_across"]
    assert mesh["other_elements_across"] == across // 2
    assert mesh["difference_pa"] == pytest.approx(abs(response.tension["stress_pa"] - mesh["stress_pa"]))
    assert run().tension["mesh"] is None


def test_a_dam_that_does_not_stand_has_no_tension_to_tell():
    response = flexible(plane_case(BASE, [*FAST, "crack.friction=0.3"]))
    assert response.outcome == "unstable"
    assert response.tension is None
    assert "tension-exceeds shaken" not in codes(response)


def test_how_much_of_the_section_is_beyond_a_strength():
    response = run()
    dam, parts = response.crack.dam, response.envelope
    shares = [share_beyond(dam, parts, strength) for strength in (-1e12, 0.0, 1e5, 1e6, 1e12)]
    assert shares == sorted(shares, reverse=True)
    assert 0.6 < shares[0] < 1.0
    assert shares[-1] == 0.0


@pytest.mark.parametrize(
    ("part", "place", "said"),
    [
        ("above", "downstream", "at the downstream face of the part above the crack"),
        ("below", "base", "at the base of the part below the crack"),
        ("above", "inside", "inside the part above the crack"),
    ],
)
def test_places_have_names(part, place, said):
    stress = StressPlace(stress_pa=1e6, time_s=1.0, part=part, place=place, x_m=0.0, z_m=0.0)
    assert place_phrase(stress) == said
