"""Anchors through several cracks: each part feels their prestress where they leave it and enter it."""

from __future__ import annotations

import copy
import re

import pytest

from heeltoe import InputError, flexible, read_case, rigid, statics_of_sections
from heeltoe.mechanics.loads import prestress
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from shared.two_cracks import DAM

#: From the crest through both cracks into the rock.
THROUGH = {"head_x": "3 m", "head_elevation": "99 m", "foot_x": "9 m", "foot_elevation": "-9 m", "prestress": "2 MN/m"}
#: From the crest to above the base: through the neck alone.
ABOVE = THROUGH | {"foot_x": "5 m", "foot_elevation": "60 m"}


def dam(*anchors, **blocks):
    fields = copy.deepcopy(DAM) | {"flexible": {"elements_across": 4, "evidence": "none"}, "anchors": list(anchors)}
    return read_case(fields | blocks)


def test_each_crack_is_pressed_by_the_anchors_that_cross_it():
    bare, case = dam(), dam(THROUGH, ABOVE)
    for place, count in ((0, 2), (1, 1)):
        alone, pulls = (
            case.single_crack_cases[place],
            [anchor.prestress for anchor in case.single_crack_cases[place].anchors_at_crack],
        )
        assert sum(pull > 0.0 for pull in pulls) == count
        pull = prestress(alone)
        with_anchors, without = (build_flexible_dam(item).crack_forces[place].sum(axis=1) for item in (case, bare))
        assert with_anchors - without == pytest.approx([-pull.horizontal, -pull.vertical], abs=1.0)


def test_what_an_anchor_pulls_down_it_pulls_up_below():
    built = build_flexible_dam(dam(THROUGH))
    parts = [body.loads["anchors"].reshape(-1, 2).sum(axis=0) for body in built.bodies]
    # The upper part is pulled down, the middle one down at its base as it is pulled up at the neck.
    assert parts[0][1] < -1.9e6
    assert parts[1] == pytest.approx([0.0, 0.0], abs=1e-3)


def test_anchors_hold_back_both_models():
    for run in (flexible, rigid):
        bare, held = (run(case).to_json() for case in (dam(), dam(THROUGH | {"prestress": "30 MN/m"})))
        assert [crack["anchors"][0]["peak_tension_n"] for crack in held["cracks"]] == [30e6, 30e6]
        assert abs(held["residual_slip_m"]) < 0.8 * abs(bare["residual_slip_m"])


def test_two_rigid_blocks_stand_as_one_where_nothing_slides():
    """The anchor pulls both blocks together: the forces at the base are those of the whole block."""
    case = dam(THROUGH)
    whole = rigid(case.single_crack_cases[1]).static
    two = rigid(case).static
    assert two["normal_force_n"] == pytest.approx(whole["normal_force_n"], rel=1e-12)
    assert two["resultant_from_heel_m"] == pytest.approx(whole["resultant_from_heel_m"], rel=1e-12)


def test_static_checks_of_each_section_know_the_anchor():
    bare, held = (
        {joint.elevation_m: joint.statics for joint in statics_of_sections(case).joints}
        for case in (dam(), dam(THROUGH))
    )
    for elevation in (90.0, 0.0):
        one, other = (next(case for case in item[elevation].cases if case.name == "usual") for item in (bare, held))
        assert other.normal_force_n > one.normal_force_n + 1.9e6


@pytest.mark.parametrize(
    ("anchor", "said"),
    [
        ({"distance": "5 m", "prestress": "1 MN/m"}, "anchors[0].distance: an anchor placed on one crack cannot"),
        (
            THROUGH | {"head_elevation": "90.5 m", "foot_elevation": "89.5 m"},
            "anchors[0].foot_x: the line from its head",
        ),
    ],
)
def test_what_cannot_be_used_is_refused_by_name(anchor, said):
    with pytest.raises(InputError, match=re.escape(said)):
        dam(anchor)


def test_an_anchor_misses_only_where_it_crosses_no_crack():
    def missed(anchor):
        return [warning for warning in rigid(dam(anchor)).warnings if warning.name == "off-the-dam anchor"]

    assert not missed(ABOVE)
    assert missed(THROUGH | {"foot_x": "3.2 m", "foot_elevation": "95 m"})
