"""Static checks that once went wrong: a crash, water that vanished from an open crack, an earthquake of the wrong
rarity, the friction of a falling flank."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import heeltoe
from heeltoe import InputError, read_case
from heeltoe.models.statics.criteria import CRITERIA, chosen
from shared.dams import ROOT

THIN = {
    "section": {
        "height": "30 m", "crest_width": "1.60 m", "neck_height": "30 m", "neck_width": "1.60 m",
        "base_width": "11.27 m",
    },
    "crack": {"elevation": "8.92 m", "friction": 0.8},
    "reservoir": {"depth": "30 m"},
    "uplift": {"pattern": "triangular"},
    "statics": {"residual_slip": "0.5 m"},
}  # fmt: skip


def dam(**changes):
    fields = {
        "section": {
            "height": "100 m", "crest_width": "8 m", "neck_height": "90 m", "neck_width": "8 m", "base_width": "80 m"
        },
        "crack": {"elevation": "0 m", "friction": 1.0},
        "reservoir": {"depth": "100 m"},
        "uplift": {"pattern": "triangular"},
    }  # fmt: skip
    for path, value in changes.items():
        block, _, name = path.partition("__")
        fields.setdefault(block, {})[name] = value
    return read_case(fields)


def test_a_margin_of_a_lower_degree_has_its_turning_points():
    result = heeltoe.statics(read_case(THIN))
    assert [case.name for case in result.cases] == ["usual", "post-seismic"]


@pytest.mark.slow
@settings(deadline=None, max_examples=60)
@given(
    height=st.floats(10.0, 120.0),
    crest=st.floats(0.02, 0.3),
    base=st.floats(0.3, 0.9),
    level=st.floats(0.0, 0.7),
    full=st.floats(0.5, 1.0),
    pattern=st.sampled_from(("none", "uniform", "triangular")),
    slip=st.floats(0.0, 1.0),
)
def test_no_plain_dam_ends_in_an_exception(height, crest, base, level, full, pattern, slip):
    fields = {
        "section": {
            "height": f"{height} m",
            "crest_width": f"{crest * height} m",
            "neck_height": f"{height} m",
            "neck_width": f"{crest * height} m",
            "base_width": f"{max(base, crest + 0.05) * height} m",
        },
        "crack": {"elevation": f"{level * height} m", "friction": 0.9},
        "reservoir": {"depth": f"{full * height} m"},
        "uplift": {"pattern": pattern},
        "statics": {"residual_slip": f"{slip} m", "seismic_coefficient": 0.15, "uplift_in_earthquake": "full"},
    }
    result = heeltoe.statics(read_case(fields))
    numbers = [value for case in result.cases for value in vars(case).values() if isinstance(value, float)]
    assert np.isfinite(numbers).all()


@pytest.mark.parametrize("law", ["full", "zero", "unchanged"])
def test_an_earthquake_takes_no_water_out_of_a_crack_that_is_open_through(law):
    weak = {"section__base_width": "52 m", "statics__seismic_coefficient": 0.1, "statics__uplift_in_earthquake": law}
    cases = {case.name: case for case in heeltoe.statics(dam(**weak)).cases}
    usual, upstream = cases["usual"], cases["pseudo-static upstream"]
    assert usual.outcome == "cracks through"
    assert upstream.normal_force_n == pytest.approx(usual.normal_force_n, rel=1e-9)


@pytest.mark.slow
def test_full_uplift_never_leaves_more_normal_force_than_unchanged_uplift():
    for base in np.linspace(50.0, 80.0, 16).tolist():
        changes = {"section__base_width": f"{base} m", "statics__seismic_coefficient": 0.1}
        both = [
            {
                case.name: case.normal_force_n
                for case in heeltoe.statics(dam(**changes, statics__uplift_in_earthquake=law)).cases
            }
            for law in ("full", "unchanged")
        ]
        for name, normal in both[0].items():
            assert normal <= both[1][name] * (1.0 + 1e-9)


def test_a_toe_that_is_open_before_keeps_the_water_of_the_tailwater():
    from heeltoe.models.statics.water import StillWater, water_in_earthquake

    before = np.array([[0.0, 9e4], [6.0, 3e4], [8.0, 3e4], [10.0, 3e4]])
    water = water_in_earthquake(before, StillWater(lambda heel, toe: before, ()), (0.0, 2.0), "zero")
    assert np.array_equal(water.pressure(0.0, 2.0), before)
    profile = water.pressure(0.0, 3.0)
    assert np.interp([7.5, 9.0], *profile.T) == pytest.approx([0.0, 3e4])


def required(found, name):
    return {
        check.load_case: check.required for check in found.checks if check.name == name and "static " in check.load_case
    }


def test_an_operating_basis_earthquake_is_an_unusual_load_to_usace():
    earthquakes = [{"name": "OBE", "seismic_coefficient": 0.1}, {"name": "MDE", "seismic_coefficient": 0.2}]
    result = heeltoe.statics(dam(statics__earthquakes=earthquakes))
    usace = CRITERIA["USACE"]
    (unusual,) = [row.required for row in chosen(usace, "unusual") if row.check == "sliding"]
    (extreme,) = [row.required for row in chosen(usace, "extreme") if row.check == "sliding"]
    assert (unusual, extreme) == (1.7, 1.3)
    assert required(result, "sliding factor") == {
        "OBE, pseudo-static downstream": unusual,
        "OBE, pseudo-static upstream": unusual,
        "MDE, pseudo-static downstream": extreme,
        "MDE, pseudo-static upstream": extreme,
    }


def test_the_single_coefficient_means_what_it_meant_and_the_rarity_may_be_said():
    plain = heeltoe.statics(dam(statics__seismic_coefficient=0.2))
    named = heeltoe.statics(dam(statics__earthquakes=[{"name": "MCE", "seismic_coefficient": 0.2}]))
    bare = [{**check.to_json(), "load_case": "", "sentence": ""} for check in plain.checks]
    assert bare == [{**check.to_json(), "load_case": "", "sentence": ""} for check in named.checks]
    rare = heeltoe.statics(dam(statics__earthquakes=[{"name": "OBE", "seismic_coefficient": 0.2, "rarity": "extreme"}]))
    assert set(required(rare, "sliding factor").values()) == {1.3}


@pytest.mark.parametrize(
    ("name", "sliding"),
    [("OBE", 1.7), ("obe, 145 years", 1.7), ("Operating Basis Earthquake", 1.7), ("SEE", 1.3), ("MCE (deep)", 1.3)],
)
def test_the_usual_names_of_earthquakes_are_understood(name, sliding):
    result = heeltoe.statics(dam(statics__earthquakes=[{"name": name, "seismic_coefficient": 0.1}]))
    assert set(required(result, "sliding factor").values()) == {sliding}


def test_criteria_with_one_set_of_factors_say_so():
    result = heeltoe.statics(
        dam(statics__criteria="CDA", statics__earthquakes=[{"name": "OBE", "seismic_coefficient": 0.1}])
    )
    taken = [str(text) for case in result.cases for text in case.assumptions]
    assert "CDA has one set of factors for every earthquake" in taken


@pytest.mark.parametrize(
    ("choice", "said"),
    [
        ({"earthquakes": [{"name": "OBE", "seismic_coefficient": 0.1}], "seismic_coefficient": 0.1}, "earthquakes"),
        ({"earthquakes": [{"name": "OBE", "seismic_coefficient": 0.1}] * 2}, "is listed twice"),
        ({"earthquakes": [{"name": "design", "seismic_coefficient": 0.1}]}, "add rarity"),
        ({"earthquakes": [{"name": "OBE = MDE", "seismic_coefficient": 0.1}]}, "statics.earthquakes[0].name"),
        ({"earthquakes": [{"name": "OBE", "seismic_coefficient": 0.0}]}, "statics.earthquakes[0].seismic_coefficient"),
    ],
)
def test_earthquakes_that_cannot_be(choice, said):
    with pytest.raises(InputError, match=said.replace("[", r"\[").replace("]", r"\]")):
        dam(**{f"statics__{name}": value for name, value in choice.items()})


def test_after_a_slip_onto_a_falling_flank_friction_is_that_down_the_flank():
    rough = {"asperity_height": "10 mm", "wave_length": "200 mm"}
    angle = math.atan(2.0 * 0.010 / 0.200)
    for slip, expected in ((0.15, math.tan(math.atan(1.0) - angle)), (0.05, 1.0)):
        result = heeltoe.statics(dam(crack__roughness=rough), slip)
        after = result.cases[-1]
        assert after.friction == pytest.approx(expected, rel=1e-12)


@pytest.mark.parametrize("name", ["{0.__class__}", "$\\frac{", "}{"])
@pytest.mark.parametrize("criteria", ["USACE", "FERC"])
def test_braces_in_the_name_of_an_earthquake_are_letters(name, criteria):
    earthquakes = [{"name": name, "seismic_coefficient": 0.1, "rarity": "unusual"}]
    case = read_case(ROOT / "examples" / "typical-base.toml", [{"statics": {"criteria": criteria}}])
    result = heeltoe.statics(case.with_({"statics.earthquakes": earthquakes}), 0.01)
    sentences = [check["sentence"] for check in result.to_json()["checks"]]
    assert any(sentence.startswith(f"{name}, pseudo-static") for sentence in sentences)
