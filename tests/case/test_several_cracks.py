"""Cases with several cracks: their order, what they take from each other, and what is refused by name."""

from __future__ import annotations

import re

import pytest

from heeltoe import overturning_map, read_case, run
from heeltoe.errors.error import InputError
from heeltoe.models.rigid.many import rigid_many
from heeltoe.models.statics.joints import statics_of_sections
from shared.dams import example

CASE = example("two-cracks")


def test_cracks_stand_from_the_crest_down_and_inherit_friction_and_uplift():
    case = CASE.with_(
        {
            "crack.elevation": "40 m",
            "further_cracks": [
                {"elevation": "0 m", "uplift": "uniform"},
                {"elevation": "90 m", "friction": 0.8, "uplift_intensity": 0.5},
            ],
        }
    )
    assert [single_crack_case.crack.elevation for single_crack_case in case.single_crack_cases] == [90.0, 40.0, 0.0]
    assert case.asked == 1
    assert [single_crack_case.crack.mu_kinetic for single_crack_case in case.single_crack_cases] == [0.8, 1.2, 1.2]
    assert [single_crack_case.uplift.pattern for single_crack_case in case.single_crack_cases] == [
        "triangular",
        "triangular",
        "uniform",
    ]
    assert [single_crack_case.uplift.intensity for single_crack_case in case.single_crack_cases] == [0.5, 1.0, 1.0]
    assert all(not single_crack_case.further_cracks for single_crack_case in case.single_crack_cases)


@pytest.mark.parametrize(
    ("changes", "said"),
    [
        ({"further_cracks": [{"elevation": "0 m"}]}, "further_cracks[0].elevation: the crack at 0 m meets or crosses"),
        ({"further_cracks": [{"elevation": "120 m"}]}, "further_cracks[0].elevation: at 120 m"),
        ({"further_cracks": [{"elevation": "90 m", "static_friction": 1.0}]}, "kinetic_friction: is required"),
        (
            {"anchors": [{"distance": "5 m", "prestress": "1 MN/m"}]},
            "anchors[0].distance: an anchor placed on one crack cannot be combined with",
        ),
        (
            {"flexible.damping": "thesis"},
            'flexible.damping: options of the thesis ("thesis") cannot be combined with several cracks',
        ),
        (
            {"flexible.virtual_mass": "thesis"},
            'flexible.virtual_mass: options of the thesis ("thesis") cannot be combined with several cracks',
        ),
        (
            {"flexible.contact": "idce", "flexible.damping": "stiffness"},
            'flexible.contact: penalty contact ("idce") cannot be',
        ),
        (
            {"flexible.mesh_above": "a.msh"},
            "flexible.mesh_above: meshes from files cannot be combined with several cracks",
        ),
    ],
)
def test_what_does_not_go_together_is_refused_by_name(changes, said):
    with pytest.raises(InputError, match=re.escape(said)):
        CASE.with_(changes)


def test_inclined_cracks_that_cross_are_refused():
    with pytest.raises(InputError, match="meets or crosses"):
        CASE.with_({"further_cracks": [{"elevation": "10 m", "inclination": "-30 deg"}]})


@pytest.mark.parametrize(
    ("model", "who"),
    [
        ("decoupled", "the decoupled chain"),
        ("both", "the block beside the flexible model"),
    ],
)
def test_models_that_know_one_crack_refuse_several(model, who):
    with pytest.raises(
        InputError, match=f"further_cracks: {who} does not support several cracks.*run the flexible model"
    ):
        run(CASE, model)


def test_maps_and_tables_of_blocks_refuse_several():
    with pytest.raises(InputError, match="a map of overturning does not support several cracks"):
        overturning_map(CASE, count=2)
    with pytest.raises(InputError, match="a table of blocks does not support several cracks"):
        rigid_many([CASE], [])


def test_static_checks_judge_every_crack_as_a_section():
    result = statics_of_sections(CASE)
    assert [item.elevation_m for item in result.joints] == [90.0, 0.0]
    for joint, case in zip(result.joints, CASE.single_crack_cases, strict=True):
        assert joint.statics.to_json()["cases"] == statics_of_sections(case).joints[0].statics.to_json()["cases"]


def test_a_case_says_its_cracks():
    assert "another at 90 m" in repr(CASE)
    assert repr(read_case({**CASE.model_dump(mode="json", exclude_unset=True)})) == repr(CASE)


# The right words: a bond on one crack and kinks of another are two cracks, and the reader must know which.
def test_a_bond_and_kinks_of_another_crack_are_refused_by_their_cracks():
    bond = {
        "tensile_strength": "1 MPa",
        "cohesion": "1.5 MPa",
        "fracture_energy": "100 N/m",
        "shear_energy": "1000 N/m",
    }
    law = {"name": "slip weakening", "peak_friction": 1.1, "residual_friction": 0.8, "slip": "1 mm"}
    kinks = {"friction": 1.0, "kinks": [["10 m", "0.3 m"]]}
    fields = {
        "section": {"height": "30 m", "crest_width": "5 m", "base_width": "26 m"},
        "concrete": {"modulus": "25 GPa"},
        "cracks": [{"elevation": "12 m", "friction": 1.0, "bond": bond}, {"elevation": "0 m"} | kinks],
    }
    with pytest.raises(InputError) as refused:
        read_case(fields)
    (error,) = [one for one in (refused.value, *refused.value.others) if one.code == "combination"]
    assert error.field == "cracks[0].bond"
    assert "with kinks of another crack, at 0 m: " in str(error)
    assert "solved together" in str(error)
    # A law goes with the bond of another crack.
    assert read_case({**fields, "cracks": [fields["cracks"][0], {"elevation": "0 m", "law": law}]})
    alone = {**fields, "cracks": [{"elevation": "12 m", "bond": bond, "law": law}]}
    with pytest.raises(InputError) as refused:
        read_case(alone)
    assert "with a friction law: below the bond there is constant friction;" in str(refused.value)
