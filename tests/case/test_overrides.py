"""What a change of one field does to those that belong to it, and keys that stand twice."""

from __future__ import annotations

import pytest

from heeltoe import InputError, read_case, rigid
from heeltoe.case.paths import bounds_of, quantity_of, value_of
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.study.small.run_table import parse_axes, run_small
from shared.cases import DAM, dam, refusal, write
from shared.dams import BLOCK, PULSE

DRAINED = dam(
    uplift={"pattern": "drained", "drain_position": 0.1, "drain_efficiency": 0.5},
    statics={"drain_diameter": "75 mm"},
)
PAIR = dam(motion={"file": "a.txt", "pga": "0.35 g", "vertical": {"file": "a-up.txt", "unit": "g"}})


def test_a_pattern_that_is_there_already_keeps_its_options():
    same = read_case(DRAINED, ["uplift.pattern=drained"])
    assert same.model_dump() == read_case(DRAINED).model_dump()
    other = read_case(DRAINED, ["uplift.pattern=triangular"])
    assert (other.uplift.drain_position, other.uplift.drain_efficiency, other.statics.drain_diameter) == (None,) * 3
    result = run_small(DRAINED | {"motion": PULSE}, [], parse_axes(["uplift.pattern=drained,triangular,none"]), rigid)
    assert [item.outcome for item in result.responses] == ["ok"] * 3


@pytest.mark.parametrize(
    "change", ["motion.file=elcentro-1940-180-nga", 'motion.points=[["0 s", "0 g"], ["1 s", "0.1 g"]]']
)
def test_another_motion_is_refused_beside_the_vertical_one_of_the_case(change):
    error = refusal(PAIR, [change])
    assert error.code == "vertical-of-another"
    assert str(error).startswith(change.split("=")[0])
    assert refusal(PAIR, [change, "motion.vertical.pga=0.1 g"]).code == "vertical-of-another"
    assert read_case(PAIR, [change, "motion.vertical=none"]).motion.vertical is None
    whole = read_case(PAIR, [change, "motion.vertical.file=b-up.txt"]).motion
    assert (whole.vertical.file, whole.vertical.unit) == ("b-up.txt", None)


def test_a_missing_file_is_named_before_the_vertical_one():
    assert refusal(PAIR, ["motion.file=b.txt"]).code == "record-not-found"
    assert refusal(PAIR, ["motion.file=synthetic:M6.5,20km,seed=1"]).code == "vertical-of-another"


def test_what_is_no_other_motion_is_not_refused():
    assert read_case(PAIR, ["motion.file=a.txt"]).motion.vertical.file == "a-up.txt"
    assert read_case(PAIR, ["motion.pga=0.2 g"]).motion.vertical.file == "a-up.txt"
    for nothing in (None, "none"):
        case = read_case(dam(motion={"file": "a.txt", "vertical": nothing}), ["motion.file=b.txt"])
        assert (case.motion.file, case.motion.vertical) == ("b.txt", None)


def test_a_motion_from_python_comes_without_the_vertical_one_and_says_so():
    motion = GroundMotion.from_points([0.0, 0.1, 0.2], [0.0, 3.0, 0.0])
    alone, pair = (read_case(BLOCK, [f"motion.vertical={given}"]) for given in ("none", '{file = "elsewhere"}'))
    assert [warning.code for warning in rigid(alone, motion).warnings if warning.field == "motion.vertical"] == []
    response = rigid(pair, motion)
    assert [warning.code for warning in response.warnings if warning.field == "motion.vertical"] == [
        "vertical-left-out"
    ]
    assert response.residual_slip_m == rigid(alone, motion).residual_slip_m
    again = rigid(pair, response.motion)
    assert again.warnings == response.warnings


def test_a_channel_goes_with_its_file():
    record = dam(motion={"file": "a.V2", "channel": 2, "vertical": {"file": "a.V2", "channel": 3}})
    changed = read_case(record, ["motion.file=b.V2", "motion.vertical.file=c.V2"]).motion
    assert (changed.channel, changed.vertical.channel) == (None, None)


def test_a_key_that_stands_twice_is_refused_by_its_name(tmp_path):
    text = '{"crack": {"friction": 1.0, "elevation": "0 m", "friction": 0.2}}'
    with pytest.raises(InputError, match=r'not valid JSON: "friction" stands twice in one block'):
        read_case(write(tmp_path / "case.json", text))
    assert read_case(DAM).crack.friction == 1.0


def test_fields_of_a_list_of_cracks_are_known_by_their_paths():
    fields = {
        "section": {"height": "30 m", "crest_width": "5 m", "base_width": "26 m"},
        "cracks": [{"elevation": "12 m", "friction": 0.7}, {"elevation": "0 m", "friction": 0.9}],
    }
    case = read_case(fields)
    for path, value in (("cracks[0].friction", 0.7), ("cracks[1].friction", 0.9), ("cracks[0].elevation", 12.0)):
        assert value_of(case, path) == value
        assert quantity_of(path) == quantity_of(path.replace("cracks[0]", "crack").replace("cracks[1]", "crack"))
    assert value_of(case, "cracks[2].friction") is None
    assert bounds_of("cracks[1].friction") == bounds_of("crack.friction")
