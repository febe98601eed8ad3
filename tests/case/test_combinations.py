"""The table of what goes with what: a case with both is refused or accepted as it says, and by nothing beside it."""

from __future__ import annotations

import itertools
import random

import pytest

from heeltoe import Case, InputError, read_case
from heeltoe.case.combinations import FEATURES, RULES, UNSUPPORTED, USERS, check, rules_of, supports, warned
from heeltoe.views.explain.find import explain
from shared.dams import ROOT

STEEL = {"head_x": "3 m", "head_elevation": "99 m", "foot_x": "9 m", "foot_elevation": "-9 m", "prestress": "2 MN/m"}
LAW = {"name": "slip weakening", "peak_friction": 1.1, "residual_friction": 0.9, "slip": "20 mm"}
BOND = {"name": "cohesion", "cohesion": "0.1 MPa", "residual_friction": 0.9}
JOINT = {
    "tensile_strength": "0.5 MPa",
    "cohesion": "1 MPa",
    "fracture_energy": "100 N/m",
    "shear_energy": "500 N/m",
}
# A feature, and the changes that give it to the case.
CHANGES = {
    "several cracks": {"further_cracks": [{"elevation": "70 m"}]},
    "three cracks": {"further_cracks": [{"elevation": "70 m"}, {"elevation": "90 m"}]},
    "kinks": {"crack.kinks": [["30 m", "0 m"]]},
    "kinks off the straight line": {"crack.kinks": [["30 m", "0.5 m"]]},
    "roughness": {"crack.roughness": {"asperity_height": "2 mm", "wave_length": "50 mm"}},
    "a friction law": {"crack.law": LAW},
    "a law with cohesion": {"crack.law": BOND},
    "a bonded joint": {"crack.bond": JOINT},
    "all nodes watched twice": {"flexible.contactors": 5},
    "cohesion of the static checks": {"statics.cohesion": "0.1 MPa", "statics.bonded": 0.5},
    "uplift that changes during shaking": {"uplift.during_shaking": "zero while open"},
    "an anchor placed on one crack": {"anchors": [{"distance": "5 m", "prestress": "1 MN/m"}]},
    "an anchor with stiffness": {"anchors": [STEEL | {"axial_stiffness": "10 MN/m/m"}]},
    "aftershocks": {"aftershocks": [{"points": [["0 s", "0 g"], ["1 s", "0.1 g"]]}]},
    "drains that slip closes": {
        "uplift.pattern": "drained",
        "uplift.drain_x": "8 m",
        "uplift.drain_efficiency": 0.5,
        "statics.drain_diameter": "75 mm",
    },
    "finite rotation": {"analysis.rotation": "finite"},
    "rotation beyond small angles": {"analysis.rotation": "p-delta"},
    "penalty contact": {"flexible.contact": "idce", "flexible.damping": "stiffness"},
    "damping of free parts": {"flexible.damping": "modal"},
    "options of the thesis": {"flexible.virtual_mass": "thesis"},
    "meshes from files": {"flexible.mesh_above": "above.msh"},
    "another number of elements below": {"flexible.elements_across_below": 5},
    "virtual water that does not rotate": {"reservoir.virtual_mass_rotates": False},
    "Zangar's water pressure": {"reservoir.hydrodynamic": "zangar"},
    "compressible water": {"reservoir.compressible": True},
    "water that follows the vertical motion": {
        "reservoir.follows_vertical_motion": True,
        "motion.vertical": {"points": [["0 s", "0 g"], ["1 s", "0.05 g"]]},
    },
}
BASE = read_case(
    {
        "section": {"height": "100 m", "crest_width": "10 m", "base_width": "80 m"},
        "concrete": {"modulus": "20 GPa"},
        "crack": {"elevation": "20 m", "friction": 1.0},
        "reservoir": {"depth": "90 m"},
        "motion": {"points": [["0 s", "0 g"], ["1 s", "0.1 g"]]},
    }
)


def with_both(one: str, other: str) -> tuple[Case | None, list[InputError]]:
    """Return the base with two features, and what reading it refuses."""
    changes = CHANGES[one] | CHANGES[other]
    if {one, other} == {"damping of free parts", "penalty contact"}:
        changes["flexible.damping"] = "modal"
    try:
        return BASE.with_(changes), []
    except InputError as error:
        return None, [error, *error.others]


def refusals(*names: str) -> set[str]:
    """Return the features that the table refuses in any case that has all of these."""
    had = set(names)
    had |= {"several cracks"} if "three cracks" in had else set()
    had |= {"kinks"} if "kinks off the straight line" in had else set()
    had |= {"a friction law"} if "a law with cohesion" in had else set()
    had |= {"rotation beyond small angles"} if "finite rotation" in had else set()
    return {rule.feature for rule in RULES if not rule.users and {rule.feature, rule.other} <= had}


def same_field(one: str, other: str) -> bool:
    """Whether two features are values of one field, of which a case has one."""
    return bool(CHANGES[one].keys() & CHANGES[other].keys())


def test_every_feature_can_be_had():
    assert set(CHANGES) == set(FEATURES)
    for name, changes in CHANGES.items():
        case = BASE.with_(changes)
        assert list(FEATURES[name].find(case)), name
        assert not list(FEATURES[name].find(BASE)) or name == "damping of free parts", name


PAIRS = [pair for pair in itertools.combinations(CHANGES, 2) if not same_field(*pair)]


@pytest.mark.parametrize("pair", random.Random(28).sample(PAIRS, 100))
def test_pairs_of_features_are_refused_as_the_table_says(pair):
    _, errors = with_both(*pair)
    expected = refusals(*pair)
    assert {error.code for error in errors} <= {"combination"}, errors
    assert {FEATURES[name].name for name in expected} == {str(error.value).split(" (")[0] for error in errors}


@pytest.mark.parametrize("rule", [rule for rule in RULES if not rule.users], ids=lambda rule: rule.feature)
def test_every_refused_pair_names_field_feature_and_remedy(rule):
    _, errors = with_both(rule.feature, rule.other)
    error = next(error for error in errors if str(error.value).startswith(rule.feature))
    fields = {field.partition(".")[0] for field in FEATURES[rule.feature].fields}
    assert error.field.partition(".")[0].partition("[")[0] in fields
    assert f"cannot be combined with {rule.other}: {rule.reason}" in error.problem
    assert FEATURES[rule.feature].removal in error.remedy


@pytest.mark.parametrize(
    "rule", [rule for rule in RULES if rule.users], ids=lambda rule: f"{rule.feature}-{rule.users}"
)
def test_every_model_refuses_or_warns_as_the_table_says(rule):
    case, errors = with_both(rule.feature, rule.other or rule.feature)
    assert case is not None, errors
    for user in rule.users:
        if rule.verdict == "warned":
            assert warned(case, rule.feature, user)
            continue
        assert not supports(case, user)
        with pytest.raises(InputError, match=f"{USERS[user]} does not support") as refused:
            check(case, user)
        assert refused.value.code == UNSUPPORTED
        assert FEATURES[rule.feature].removal in refused.value.remedy


def test_the_base_is_supported_by_all():
    assert all(supports(BASE, user) for user in USERS)


def test_a_remedy_names_a_model_that_supports_the_case():
    several = BASE.with_(CHANGES["several cracks"])
    with pytest.raises(InputError, match="run the flexible model, or keep one crack"):
        check(several, "decoupled")
    with pytest.raises(InputError, match="run the rigid model, or remove roughness"):
        check(BASE.with_(CHANGES["roughness"]), "flexible")


def test_no_combination_is_refused_beside_the_table():
    places = [
        path.name
        for path in (ROOT / "python").rglob("*.py")
        if any(
            f"InputError({code}" in path.read_text(encoding="utf-8")
            for code in ('"combination"', '"unsupported"', "UNSUPPORTED")
        )
    ]
    assert places == ["combinations.py"]


def test_fields_are_explained_with_what_they_do_not_go_with():
    assert rules_of("crack.roughness.wear")
    (kinks,) = explain("crack.kinks")
    assert "penalty contact" in kinks.not_with
    assert "the rigid model" in kinks.not_with
    assert explain("cracks.roughness")[0].not_with == explain("crack.roughness")[0].not_with
