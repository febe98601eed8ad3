"""Anchors and drains in the dam's coordinates: the same as on the crack where that is, and there when it moves."""

from __future__ import annotations

import copy
import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from heeltoe import InputError, read_case
from heeltoe.case.warnings import case_warnings
from heeltoe.mechanics.block import build_block
from heeltoe.mechanics.loads import prestress, uplift, uplift_profile
from heeltoe.mechanics.many import block_columns

DAM = {
    "section": {
        "height": "45 m",
        "crest_width": "6 m",
        "upstream": [["0 m", 0.1], ["20 m", 0.0]],
        "downstream": [["0 m", 0.8], ["38 m", 0.0]],
    },
    "crack": {"elevation": "5 m", "friction": 1.0},
    "reservoir": {"depth": "42 m"},
}


def dam(**more):
    return copy.deepcopy(DAM) | more


def ends(head, foot, **more):
    names = ("head_x", "head_elevation", "foot_x", "foot_elevation")
    return {name: f"{value!r} m" for name, value in zip(names, (*head, *foot), strict=True)} | more


def codes(case):
    return [case_warning.name for case_warning in case_warnings(case)]


@given(
    elevation=st.floats(0.5, 30.0),
    tilt=st.floats(-0.3, 0.3),
    part=st.floats(0.1, 0.9),
    lean=st.floats(-1.0, 1.0),
    up=st.floats(0.5, 40.0),
    down=st.floats(0.5, 40.0),
)
def test_ends_are_the_same_as_a_place_on_the_crack(elevation, tilt, part, lean, up, down):
    crack = {"elevation": f"{elevation!r} m", "inclination": f"{tilt!r} rad", "friction": 1.0}
    try:
        section = read_case(dam(crack=crack)).cut
    except InputError:
        return
    distance = part * section.crack_width
    start = np.array(section.heel) + section.from_crack_frame(distance, 0.0)
    axis = np.array(section.from_crack_frame(math.sin(lean), math.cos(lean)))
    head, foot = (start + up * axis).tolist(), (start - down * axis).tolist()
    steel = {"prestress": "2 MN/m", "axial_stiffness": "30 MN/m/m"}
    on_crack = {"distance": f"{distance!r} m", "inclination": f"{lean!r} rad"} | steel
    there = read_case(dam(crack=crack, anchors=[on_crack]))
    for one, other in ((head, foot), (foot, head)):
        case = read_case(dam(crack=crack, anchors=[ends(one, other, **steel)]))
        result, known = case.anchors_at_crack[0], there.anchors_at_crack[0]
        assert result.distance == pytest.approx(known.distance, abs=1e-9)
        assert result.inclination == pytest.approx(known.inclination, abs=1e-9)
        assert (result.prestress, result.axial_stiffness) == (known.prestress, known.axial_stiffness)
        assert prestress(case).moment == pytest.approx(prestress(there).moment, rel=1e-9, abs=1e-3)


@given(x=st.floats(0.0, 20.0), efficiency=st.floats(0.0, 1.0))
def test_drains_are_the_same_as_a_place_on_the_crack(x, efficiency):
    drained = {"pattern": "drained", "drain_efficiency": efficiency}
    case = read_case(dam(uplift=drained | {"drain_x": f"{x!r} m"}))
    (left, _), (right, _) = case.cut.heel, case.cut.toe
    there = read_case(dam(uplift=drained | {"drain_position": (x - left) / (right - left)}))
    assert uplift_profile(case) == pytest.approx(uplift_profile(there), rel=1e-12)


def test_what_stays_where_it_is_when_the_crack_moves():
    anchor = ends((3.0, 45.0), (8.0, -10.0), prestress="1 MN/m")
    drained = {"pattern": "drained", "drain_efficiency": 0.5, "drain_x": "2 m"}
    case = read_case(dam(anchors=[anchor], uplift=drained))
    for elevation in (2.0, 10.0, 30.0):
        moved = case.with_({"crack.elevation": f"{elevation} m"})
        along = 3.0 + (45.0 - elevation) / 55.0 * 5.0
        assert moved.cut.heel[0] + moved.anchors_at_crack[0].distance == pytest.approx(along)
        assert moved.cut.heel[0] + moved.uplift_at_crack.drain_position * moved.cut.crack_width == pytest.approx(2.0)


def test_many_dams_at_once_are_the_dams():
    anchors = [ends((3.0, 45.0), (5.0, 12.0), prestress="1 MN/m"), ends((1.0, 45.0), (9.0, -10.0), prestress="2 MN/m")]
    drained = {"pattern": "drained", "drain_efficiency": 0.5, "drain_x": "7 m"}
    case = read_case(dam(anchors=anchors, uplift=drained))
    elevations = np.array([2.0, 10.0, 25.0, 40.0])
    many = block_columns(case, {"crack.elevation": elevations})
    for place, elevation in enumerate(elevations):
        one = build_block(case.with_({"crack.elevation": f"{elevation} m"}))
        assert many[place] == pytest.approx(one.parameters(), rel=1e-12, abs=1e-9)


def test_what_misses_the_crack_holds_nothing_and_is_told():
    anchor = ends((30.0, 12.0), (31.0, 6.0), prestress="1 MN/m", axial_stiffness="9 MN/m/m")
    drained = {"pattern": "drained", "drain_efficiency": 0.7, "drain_x": "-30 m"}
    case = read_case(dam(anchors=[anchor], uplift=drained))
    assert {"off-the-dam anchor", "off-the-dam drains"} <= set(codes(case))
    assert prestress(case).vertical == 0.0
    assert uplift(case).vertical == pytest.approx(uplift(read_case(dam(uplift={"pattern": "triangular"}))).vertical)


@pytest.mark.parametrize(("efficiency", "raised"), [(0.0, True), (0.19, True), (0.2, False), (0.67, False)])
def test_drains_that_raise_the_head_are_told(efficiency, raised):
    # A fifth of the way down a straight line has lost a fifth of its head.
    drained = {"pattern": "drained", "drain_position": 0.2, "drain_efficiency": efficiency}
    case = read_case(dam(uplift=drained))
    assert ("value-unusual" in codes(case)) is raised
    triangle = uplift(read_case(dam(uplift={"pattern": "triangular"}))).vertical
    assert (uplift(case).vertical > triangle * (1.0 + 1e-12)) is raised


@pytest.mark.parametrize(
    ("anchor", "said"),
    [
        (ends((3.0, 45.0), (8.0, -10.0)), []),
        (ends((0.0, 41.0), (8.0, -10.0)), ["anchor-head-wet"]),
        ({"distance": "4 m", "inclination": "-30 deg"}, ["anchor-head-wet"]),
        ({"distance": "7 m"}, []),
        (ends((3.0, 48.0), (8.0, -10.0)), ["off-the-dam anchor-head"]),
    ],
)
def test_where_the_head_is(anchor, said):
    case = read_case(dam(anchors=[anchor | {"prestress": "1 MN/m"}]))
    assert [code for code in codes(case) if "anchor" in code] == said


@pytest.mark.parametrize(
    ("more", "code", "field"),
    [
        ({"anchors": [{"prestress": "1 MN/m"}]}, "missing", "anchors[0].distance"),
        ({"anchors": [{"head_x": "1 m", "prestress": "1 MN/m"}]}, "missing", "anchors[0].head_elevation"),
        (
            {"anchors": [ends((3.0, 45.0), (8.0, -1.0), prestress="1 MN/m", inclination="0 deg")]},
            "fields-conflict",
            "anchors[0].inclination",
        ),
        ({"anchors": [ends((-1.0, 6.0), (30.0, 4.0), prestress="1 MN/m")]}, "anchor-flat", "anchors[0].foot_x"),
        (
            {"uplift": {"pattern": "drained", "drain_efficiency": 0.5, "drain_x": "1 m", "drain_position": 0.1}},
            "fields-conflict",
            "uplift.drain_position",
        ),
        ({"uplift": {"drain_x": "1 m"}}, "option-foreign", "uplift.drain_x"),
    ],
)
def test_refused(more, code, field):
    with pytest.raises(InputError) as caught:
        read_case(dam(**more))
    assert (caught.value.code, caught.value.field) == (code, field)
