"""The table of what goes with what: a case with both is refused or accepted as it says, and by nothing beside it."""

from __future__ import annotations

import itertools
import random

import pytest

from heeltoe import Case, InputError, read_case
from heeltoe.case.combinations import FEATURES, RULES, UNSUPPORTED, USERS, check, rules_of, supports, warned
from heeltoe.views.explain.find import explain
from shared.dams import ROOT
from shared.features import BASE as PLAIN
from shared.features import CHANGES, changes_of, same_field

BASE = read_case(PLAIN)


def with_both(one: str, other: str) -> tuple[Case | None, list[InputError]]:
    """Return the base with two features, and what reading it refuses."""
    try:
        return BASE.with_(changes_of(one, other)), []
    except InputError as error:
        return None, [error, *error.others]


def refusals(*names: str) -> set[str]:
    """Return the features that the table refuses in any case that has all of these."""
    had = set(names)
    had |= {"several cracks"} if "three cracks" in had else set()
    had |= {"kinks"} if "kinks off the straight line" in had else set()
    had |= {"a friction law"} if had & {"a law with cohesion", "a friction law by the normal stress"} else set()
    had |= {"rotation beyond small angles"} if "finite rotation" in had else set()
    return {rule.feature for rule in RULES if not rule.users and {rule.feature, rule.other} <= had}


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


def test_what_is_refused_of_a_part_of_a_feature_is_named():
    """A crack goes with the rigid model; three of them do not."""
    assert "three cracks in the rigid model" in [rule.without("cracks") for rule in rules_of("cracks")]
