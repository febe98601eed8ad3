"""The block of lift joints, which a case has as the list of its cracks."""

from __future__ import annotations

import copy
from typing import Any

import pytest

from heeltoe import InputError, read_case
from heeltoe.case.read import case_schema
from heeltoe.models.run import cost_of
from heeltoe.views.explain.find import explain

BOND = {
    "tensile_strength": "0.3 MPa",
    "cohesion": "0.6 MPa",
    "fracture_energy": "200 N/m",
    "shear_energy": "1000 N/m",
}
DAM: dict[str, Any] = {
    "section": {"height": "30 m", "crest_width": "5 m", "base_width": "26 m"},
    "concrete": {"modulus": "25 GPa"},
    "joints": {"every": "10 m", "friction": 1.0, "bond": BOND},
    "reservoir": {"depth": "26 m"},
    "motion": {"points": [["0 s", "0 g"], ["0.2 s", "0.4 g"], ["0.4 s", "0 g"]]},
    "flexible": {"elements_across": 4, "evidence": "none"},
}


def dam(**changes: Any) -> dict[str, Any]:
    fields = copy.deepcopy(DAM)
    fields["joints"] |= changes
    return fields


def test_joints_are_the_list_of_cracks():
    case = read_case(DAM)
    assert [crack.elevation for crack in case.cracks] == [20.0, 10.0, 0.0]
    cracks = [{"elevation": f"{level} m", "friction": 1.0, "bond": BOND} for level in (20.0, 10.0, 0.0)]
    listed = {name: value for name, value in DAM.items() if name != "joints"} | {"cracks": cracks}
    assert case == read_case(listed)
    assert case.with_("cracks[1].friction=0.8").cracks[1].friction == 0.8


@pytest.mark.parametrize(
    ("changes", "levels"),
    [
        ({"every": "12 m"}, [24.0, 12.0, 0.0]),
        ({"every": "16 m"}, [16.0, 0.0]),
        ({"lowest": "3 m"}, [23.0, 13.0, 3.0]),
        ({"highest": "10 m"}, [10.0, 0.0]),
        ({"lowest": "0.1 m", "every": "0.1 m", "highest": "0.3 m"}, [0.3, 0.2, 0.1]),
    ],
)
def test_joints_lie_a_lift_apart(changes, levels):
    assert [crack.elevation for crack in read_case(dam(**changes)).cracks] == pytest.approx(levels)


def test_changes_by_path_reach_the_joints():
    case = read_case(DAM, ["joints.every=6m", "joints.bond.tensile_strength=0.4MPa"])
    assert len(case.cracks) == 5
    assert all(crack.bond.tensile_strength == 0.4e6 for crack in case.cracks)


@pytest.mark.parametrize(
    ("changes", "code", "field"),
    [
        ({"every": "0.2 m"}, "too-many", "joints.every"),
        ({"lowest": "29 m"}, "above-other", "joints.lowest"),
        ({"every": "10 parsnips"}, "unit-unknown", "joints.every"),
        ({"bond": BOND | {"cohesion": "0.1 MPa"}}, "bond-apex", "joints.bond.cohesion"),
        ({"friction": None}, "missing", "joints.friction"),
        ({"elevation": "3 m"}, "unknown-field", "joints.elevation"),
    ],
)
def test_what_is_wrong_with_joints_is_one_sentence(changes, code, field):
    with pytest.raises(InputError) as wrong:
        read_case(dam(**changes))
    assert (wrong.value.code, wrong.value.field) == (code, field)


def test_joints_stand_in_place_of_cracks():
    with pytest.raises(InputError) as wrong:
        read_case(DAM | {"crack": {"friction": 1.0}})
    assert (wrong.value.code, wrong.value.field) == ("fields-conflict", "joints")
    with pytest.raises(InputError, match="joints"):
        read_case(DAM | {"joints": 3})


def test_the_schema_knows_joints():
    schema = case_schema()
    assert {"required": ["joints"]} in schema["oneOf"]
    assert set(schema["properties"]["joints"]["required"]) == {"every", "bond"}
    assert schema["properties"]["joints"]["properties"]["bond"]["$ref"].rpartition("/")[2] in schema["$defs"]
    (every,) = explain("joints.every")
    assert "joint" in every.meaning


def test_many_joints_are_said_to_take_long():
    """Their contacts are solved together: five times the joints take about the square of that."""
    few, many = (cost_of(read_case(dam(every=lift))).seconds for lift in ("10 m", "2 m"))
    assert 10.0 * few < many < 50.0 * few
