"""What is said of a field that is given and changes nothing: of another model, or put out of use by another choice."""

from __future__ import annotations

import pytest

from heeltoe import read_case, rigid, run, statics
from heeltoe.case.field_usage import unused_fields
from heeltoe.models.statics.criteria import CRITERIA, unread
from shared.cases import dam
from shared.dams import FAST, PULSE, TYPICAL_SECTION, example

BATTERED = {"polygon": [["0 m", "0 m"], ["80 m", "0 m"], ["10 m", "100 m"], ["4 m", "100 m"], ["4 m", "40 m"]]}
SILT = {"depth": "20 m", "vertical_density": "900 kg/m^3"}


def said(fields, *models):
    return [str(unused_field) for unused_field in unused_fields(read_case(fields), models)]


def test_fields_of_other_models_are_told_in_one_line():
    fields = dam(concrete={"modulus": "20 GPa", "damping": 0.03}, flexible={"modes": 20, "mesh_above": "nowhere.msh"})
    assert said(fields, "rigid") == [
        "no effect in the rigid model: concrete.modulus, concrete.damping, flexible.mesh_above, flexible.modes"
    ]
    assert said(fields, "decoupled") == ["no effect in the decoupled chain: flexible.modes"]
    assert said(fields, "flexible") == said(fields, "rigid", "flexible") == []
    anchored = dam(anchors=[{"distance": "5 m", "prestress": "1 MN/m", "capacity": "2 MN/m"}], motion=None)
    assert said(anchored, "statics") == ["no effect in the static checks: anchors[0].capacity"]


def test_defaults_are_not_told():
    assert said(dam(motion=None), "statics") == said(dam(), "rigid") == said(dam(), "flexible") == []


def test_what_a_reader_expects_to_matter_is_told_by_itself():
    fields = dam(crack={"friction": 1.0, "restitution": 0.3}, analysis={"rotation": "finite", "event_limit": 10})
    first, second, third = said(fields, "flexible")
    assert first.startswith('analysis.rotation = "finite" has no effect in the flexible model')
    assert second.startswith("crack.restitution = 0.3 has no effect in the flexible model")
    assert third == "no effect in the flexible model: analysis.event_limit"
    # Beside a block it is read; but the better of the two knows nothing of large rotations.
    (both,) = said(fields, "rigid", "flexible")
    assert both == first
    assert said(fields, "rigid") == []


@pytest.mark.parametrize(
    ("changes", "models", "fields", "why"),
    [
        ({"flexible": {"theta": 0.6, "penalty_factor": 500}}, ["flexible"], "flexible.penalty_factor", '"coulomb"'),
        (
            {"flexible": {"theta": 0.6, "penalty_factor": 500, "contact": "idce", "damping": "stiffness"}},
            ["flexible"],
            "flexible.theta",
            '"idce"',
        ),
        ({"flexible": {"elements_across_below": 3}}, ["flexible"], "flexible.elements_across_below", "below the crack"),
        (
            {"flexible": {"elements_across": 3, "mesh_above": "a.msh"}},
            ["rigid", "flexible"],
            "flexible.elements_across",
            "mesh_above",
        ),
        (
            {"reservoir": None, "flexible": {"virtual_mass": "thesis"}},
            ["flexible"],
            "flexible.virtual_mass",
            "no water",
        ),
        (
            {"reservoir": {"depth": "95 m", "floor_reflection": 0.8}},
            ["flexible"],
            "reservoir.floor_reflection",
            "reservoir.compressible",
        ),
        ({"silt": SILT}, ["rigid"], "silt.vertical_density", "vertical face"),
        (
            {"silt": SILT | {"depth": "60 m"}, "section": BATTERED, "crack": {"friction": 1.0, "elevation": "40 m"}},
            ["rigid"],
            "silt.vertical_density",
            "vertical face",
        ),
        (
            {"uplift": {"intensity": 0.5}, "crack": {"friction": 1.0, "elevation": "96 m"}},
            ["rigid"],
            "uplift.intensity",
            "no water stands above the crack",
        ),
        ({"uplift": {"pattern": "none", "intensity": 0.5}}, ["rigid"], "uplift.intensity", '"none"'),
        (
            {
                "tailwater": {"depth": "20 m", "virtual_mass_rotates": False},
                "crack": {"friction": 1.0, "elevation": "20 m"},
            },
            ["rigid"],
            "tailwater.virtual_mass_rotates",
            "the tailwater does not stand above the crack",
        ),
        (
            {"motion": PULSE | {"vertical": PULSE}, "decoupled": {"vertical": True}},
            ["decoupled"],
            "decoupled.vertical",
            "in any case",
        ),
        (
            {"crack": {"static_friction": 1, "kinetic_friction": 0.9}, "motion": None},
            ["statics"],
            "crack.kinetic_friction",
            "nothing slides",
        ),
        (
            {"crack": {"static_friction": 1, "kinetic_friction": 0.9}, "statics": {"residual_friction": 0.8}},
            ["statics"],
            "crack.kinetic_friction",
            "residual_friction",
        ),
        (
            {"reservoir": {"depth": "95 m", "follows_vertical_motion": True}, "motion": None},
            ["statics"],
            "reservoir.follows_vertical_motion",
            "vertical_seismic_coefficient",
        ),
    ],
)
def test_fields_put_out_of_use_by_others_are_told_with_the_reason(changes, models, fields, why):
    idle = [
        unused_field
        for unused_field in unused_fields(read_case(dam(**changes)), models)
        if unused_field.code == "fields-idle"
    ]
    (result,) = idle
    assert str(result).startswith(f"{fields}: no effect, because ")
    assert why in str(result)


@pytest.mark.parametrize(
    ("changes", "models"),
    [
        ({"silt": SILT, "section": BATTERED}, ["rigid"]),
        ({"silt": SILT, "section": BATTERED, "crack": {"friction": 1.0, "elevation": "60 m"}}, ["flexible"]),
        (
            {"flexible": {"elements_across": 3, "mesh_above": "a.msh"}, "crack": {"friction": 1, "elevation": "9 m"}},
            ["flexible"],
        ),
        ({"uplift": {"intensity": 0.5}, "reservoir": None, "tailwater": {"depth": "9 m"}}, ["rigid"]),
        ({"section": TYPICAL_SECTION, "flexible": {"virtual_mass": "thesis"}}, ["flexible"]),
        ({"reservoir": {"depth": "95 m", "virtual_mass_rotates": False}}, ["decoupled"]),
    ],
)
def test_what_has_an_effect_is_not_told(changes, models):
    assert "fields-idle" not in {unused_field.code for unused_field in unused_fields(read_case(dam(**changes)), models)}


@pytest.mark.parametrize("criteria", CRITERIA)
def test_criteria_tell_what_they_do_not_ask_for(criteria):
    asked = {"structure": "normal", "site_information": "well defined", "compressive_strength": "20 MPa"}
    plain = dam(motion=None, statics={"criteria": criteria, "bonded": 0.5, "cohesion": "1 MPa"})
    answer = []
    for name, value in asked.items():
        result = statics(read_case(dam(motion=None, statics=plain["statics"] | {name: value})))
        same = [check.to_json() for check in result.checks] == [
            check.to_json() for check in statics(read_case(plain)).checks
        ]
        idle = [warning for warning in result.warnings if warning.code == "fields-idle"]
        assert same is bool(idle), name
        answer += [name] if idle else []
    assert tuple(answer) == unread(CRITERIA[criteria])


def test_checks_after_a_run_count_what_the_run_reads():
    case = example("typical-base", *FAST)
    (alone,) = (warning for warning in statics(case).warnings if warning.code == "fields-unused")
    assert "motion.file" in str(alone)
    (beside,) = (
        warning for warning in statics(case, 0.1, beside=("rigid",)).warnings if warning.code == "fields-unused"
    )
    assert str(beside).startswith("no effect in the rigid model and the static checks: concrete.modulus")
    assert "motion" not in str(beside)


def test_every_result_tells_it():
    case = example("koyna", "motion.duration=1s", "flexible.elements_across=2", "flexible.evidence=none")
    assert "fields-unused" in {warning.code for warning in rigid(case).warnings}
    both = run(case, "decoupled,flexible")
    assert {warning.code for warning in both.warnings} & {"fields-unused", "value-unused"} == set()
    assert {warning.code for warning in both.beside.warnings} & {"fields-unused", "value-unused"} == set()


def test_pressures_that_an_elastic_dam_does_not_have_are_told():
    def fields_without_effect(value, *models):
        given = dam(reservoir={"depth": "80 m", "hydrodynamic": value})
        return [
            str(unused_field)
            for unused_field in unused_fields(read_case(given), models)
            if "hydrodynamic" in str(unused_field)
        ]

    message = ['reservoir.hydrodynamic = "zangar" has no effect on the motion of the elastic dam']
    for models in (("flexible",), ("rigid", "flexible")):
        assert [item.partition(",")[0] for item in fields_without_effect("zangar", *models)] == message
        assert fields_without_effect("westergaard", *models) == []
    assert fields_without_effect("zangar", "rigid") == []


def test_an_unusual_modulus_is_told_wherever_it_is_read():
    changes = ("concrete.modulus=20 MPa", "motion.duration=1s", "flexible.elements_across=2", "flexible.evidence=none")
    for model in ("decoupled", "flexible"):
        codes = {warning.code for warning in run(example("koyna", *changes), model).warnings}
        assert "value-unusual" in codes


def test_choices_for_what_never_happened_are_told():
    rare = {"analysis.event_limit": "1000", "analysis.paradox": "tangential impact", "motion.allow_zero": "true"}
    case = example("block", *(f"{path}={value}" for path, value in rare.items()))
    answer = {warning.field: str(warning) for warning in rigid(case).warnings if warning.code == "fields-idle"}
    assert answer.keys() == rare.keys()
    assert answer["analysis.event_limit"] == "analysis.event_limit: no effect, because the run has fewer events"
    few = rigid(example("block", "analysis.event_limit=1"))
    assert few.outcome == "event limit"
    assert "fields-idle" not in {warning.code for warning in few.warnings}
