"""Cracks as one list: the same as the blocks of one crack and further ones, by paths that the user wrote."""

from __future__ import annotations

import re
import tomllib

import pytest

from heeltoe import InputError, read_case, run
from heeltoe.case.fields_file import read_fields
from heeltoe.case.paths import value_of
from heeltoe.case.read import case_schema
from heeltoe.case.toml_writer import case_text
from heeltoe.mechanics.block import build_block, static_state
from shared.dams import ALL_EXAMPLES, example

UPPER = {"elevation": "90 m", "friction": 0.8, "uplift_intensity": 0.5}
LOWER = {"elevation": "0 m", "friction": 1.2, "restitution": 0.3}
REST = {
    name: value
    for name, value in example("two-cracks").model_dump(mode="json", exclude_unset=True).items()
    if name not in ("crack", "further_cracks")
} | {"motion": {"points": [["0 s", "0 g"], ["0.1 s", "0.6 g"], ["0.2 s", "-0.6 g"], ["0.3 s", "0 g"]]}}
LISTED = REST | {"cracks": [UPPER, LOWER]}
BLOCKS = REST | {"crack": UPPER, "further_cracks": [LOWER]}


def test_a_list_of_cracks_is_the_same_as_blocks_to_the_last_bit():
    listed, blocks = read_case(LISTED), read_case(BLOCKS)
    assert listed.cracks == blocks.cracks
    assert [crack.elevation for crack in listed.cracks] == [90.0, 0.0]
    assert [crack.restitution for crack in listed.cracks] == [0.5, 0.3]
    assert listed.asked == 0
    assert [case.uplift.intensity for case in listed.single_crack_cases] == [0.5, 1.0]
    assert run(listed, "rigid").summary == run(blocks, "rigid").summary


def test_a_list_of_one_crack_is_the_block():
    base = {**REST, "anchors": []}
    own = {"elevation": "0 m", "friction": 1.2}
    assert read_case(base | {"cracks": [own]}).model_dump() == read_case(base | {"crack": own}).model_dump()


SEVERAL = [
    {"crack": LOWER, "further_cracks": [UPPER]},
    {"crack": UPPER, "further_cracks": [{"elevation": "0 m"}]},
    {"crack": {"elevation": "40 m", "friction": 1.1}, "further_cracks": [{"elevation": "80 m", "restitution": 0.2}]},
    {
        "crack": {"law": {"name": "cohesion", "cohesion": "1 MPa", "residual_friction": 0.9, "slip": "1 mm"}},
        "further_cracks": [{"elevation": "60 m"}, {"elevation": "80 m", "friction": 0.7}],
    },
]


def numbers_of(case):
    """Return what the blocks above the cracks are, and what the rigid model says, or why it says nothing."""
    blocks = [static_state(build_block(alone)) for alone in case.single_crack_cases]
    try:
        cracks = [crack.to_json() for crack in run(case, "rigid").cracks]
    except InputError as error:
        return blocks, error.code
    return blocks, cracks


@pytest.mark.parametrize("fields", [*map(read_fields, ALL_EXAMPLES), *(REST | cracks for cracks in SEVERAL)])
def test_what_is_written_lists_all_cracks_and_means_the_same_to_the_last_bit(fields, tmp_path):
    file = tmp_path / "case.toml"
    file.write_text(case_text(fields))
    text = file.read_text()
    assert text.count("[[cracks]]") == 1 + len(fields.get("further_cracks", ()))
    assert "[crack]" not in text
    assert "further_cracks" not in text
    blocks, listed = read_case(fields), read_case(file)
    assert listed.cracks == blocks.cracks
    assert numbers_of(listed) == numbers_of(blocks)
    assert case_text(tomllib.loads(text)) == text


def test_cracks_that_cannot_be_read_are_written_as_they_stand():
    for cracks in ({"crack": {"elevation": "x"}, "further_cracks": [{}]}, {"crack": 3, "further_cracks": "y"}):
        assert tomllib.loads(case_text(cracks)) == cracks


def test_the_schema_lists_cracks_that_are_all_alike():
    schema = case_schema()
    fields = schema["$defs"]["Crack"]["properties"]
    assert schema["properties"]["cracks"]["items"] == {"$ref": "#/$defs/Crack"}
    assert {"elevation", "friction", "law", "kinks", "uplift", "uplift_intensity"} <= fields.keys()


@pytest.mark.parametrize("fields", [LISTED, BLOCKS, REST | {"crack": LOWER, "further_cracks": [UPPER]}])
def test_paths_of_the_list_count_from_the_crest_down(fields):
    case = read_case(fields, ["cracks[0].friction=0.7", "cracks[1].restitution=0.2"])
    assert [crack.mu_kinetic for crack in case.cracks] == [0.7, 1.2]
    assert case.cracks[1].restitution == 0.2
    assert value_of(case, "cracks[0].friction") == 0.7
    assert case.with_("cracks[0].friction=0.6").cracks[0].friction == 0.6


def test_paths_of_the_blocks_hold_in_a_list():
    case = read_case(LISTED, ["crack.friction=0.7", "further_cracks[0].friction=1.1"])
    assert [crack.friction for crack in case.cracks] == [0.7, 1.1]
    assert case.with_({"cracks": [LOWER]}).further_cracks == ()


@pytest.mark.parametrize(
    ("fields", "change", "said"),
    [
        (LISTED, "cracks[1].friction=-1", "cracks[1].friction: -1 is out of range"),
        (LISTED, "crack.friction=-1", "crack.friction: -1 is out of range"),
        (LISTED, "further_cracks[0].friction=-1", "further_cracks[0].friction: -1 is out of range"),
        (BLOCKS, "cracks[1].friction=-1", "cracks[1].friction: -1 is out of range"),
        (BLOCKS, "further_cracks[0].friction=-1", "further_cracks[0].friction: -1 is out of range"),
        (LISTED, "cracks[1].elevation=95m", "cracks[0].elevation: 90 m is below the crack at cracks[1]"),
        (LISTED, "cracks[1].elevation=90m", "cracks[1].elevation: the crack at 90 m meets or crosses"),
        (LISTED, "cracks[1].colour=1", "cracks[1].colour: no such field"),
        (LISTED, "cracks[4].friction=1", "cracks[4].friction: no such field"),
        (BLOCKS, "cracks[4].friction=1", "cracks[4].friction: no such field"),
        (LISTED, "cracks=3", "cracks: 3 is of the wrong type"),
        (LISTED | {"crack": LOWER}, "title=x", 'cracks: cannot stand beside "crack"'),
    ],
)
def test_errors_name_the_path_that_was_written(fields, change, said):
    with pytest.raises(InputError, match=re.escape(said)):
        read_case(fields, change)


def test_models_name_the_list():
    case = read_case(LISTED)
    with pytest.raises(InputError, match=r"cracks: the decoupled chain does not support several cracks \(2\)"):
        run(case, "decoupled")
    weak = case.with_({"cracks[1].law": {"name": "cohesion", "cohesion": "1 MPa", "residual_friction": 0.9}})
    with pytest.raises(InputError, match=r"cracks\[1\]\.law: the rigid model does not support a friction law"):
        run(weak, "rigid")


def test_the_uplift_of_one_crack_is_that_of_the_case():
    with pytest.raises(InputError, match=r"cracks\[0\]\.uplift: has no meaning without several cracks"):
        read_case({**REST, "cracks": [{"friction": 1.0, "uplift": "none"}]})
