"""What acts in several cracks beside contact: each has its own water, and an anchor has one tension in all of them."""

from __future__ import annotations

import copy

import numpy as np
import pytest

from heeltoe import InputError, flexible, rigid, run
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from shared.dams import plane_case
from shared.two_cracks import DAM, bonded, same, shaken

LAWS = ["zero while open", "full while open", "follows opening"]
#: From the crest through both cracks into the rock, with stiffness.
TENDON = {
    "head_x": "3 m",
    "head_elevation": "99 m",
    "foot_x": "9 m",
    "foot_elevation": "-9 m",
    "prestress": "2 MN/m",
    "axial_stiffness": "200 MN/m/m",
}
DOWEL = TENDON | {"shear_stiffness": "100 MN/m/m"}


def dam(**blocks):
    return plane_case(copy.deepcopy(DAM) | blocks)


def water(law, **more):
    return {"pattern": "triangular", "during_shaking": law, "opening": "0.5 mm", **more}


@pytest.mark.parametrize("law", LAWS)
def test_water_of_the_neck_alone_where_the_base_is_bonded(law):
    case = dam(uplift=water(law))
    two, alone = shaken(bonded(case, 0.0)), shaken(case.single_crack_cases[0])
    assert alone.summary.opening_upstream > 1e-3
    same(two.all_frames[0], alone.frames, 8.0)


@pytest.mark.parametrize("anchor", [TENDON, DOWEL])
def test_an_anchor_of_the_neck_alone_where_the_base_is_bonded(anchor):
    case = dam(anchors=[anchor])
    two, alone = shaken(bonded(case, 0.0)), shaken(case.single_crack_cases[0])
    assert abs(alone.summary.slip) > 1e-3
    assert alone.anchors[0][0, 0] > 2.1e6
    same(two.all_frames[0], alone.frames, 8.0)
    # The bonded crack has the tension, and no slip that a dowel could resist.
    assert two.anchors[0] == pytest.approx(alone.anchors[0], rel=1e-6)
    assert two.anchors[1][0, :2] == pytest.approx([alone.anchors[0][0, 0]] * 2, rel=1e-6)


@pytest.mark.parametrize("law", LAWS)
def test_ledger_of_two_cracks_with_water_and_anchors(law):
    free = {"elements_across": 4, "evidence": "none"}
    result = shaken(dam(uplift=water(law), anchors=[DOWEL], flexible=free))
    assert all(abs(summary.slip) > 1e-3 for summary in result.summaries)
    for summary in result.summaries:
        assert summary.energy_residual < 1e-12
        assert summary.energy_gained < 1e-5 * summary.energy_turnover
    # One tension, whatever each crack does; the resistance to slip is that of each.
    neck, base = (borne[0] for borne in result.anchors)
    assert neck[0] == base[0] > 2.1e6
    assert neck[1] != base[1]


def test_cracks_with_water_and_anchors_stand_until_they_are_shaken():
    case = dam(
        uplift=water("follows opening"),
        anchors=[DOWEL],
        flexible={"elements_across": 4, "evidence": "none"},
        motion={"points": [["0 s", "0 g"], ["1 s", "0 g"]]},
    )
    still = build_flexible_dam(case).kernel.run(np.zeros((500, 2)), 2e-4, 0.52)
    assert [summary.slip for summary in still.summaries] == [0.0, 0.0]


def slips(case):
    return [crack.of_crack.residual_slip_m for crack in flexible(case).cracks]


def test_more_pressure_while_open_lets_the_base_slide_farther():
    free = {"elements_across": 4, "evidence": "none"}
    zero, full = (slips(dam(uplift=water(law), flexible=free)) for law in ("zero while open", "full while open"))
    assert full[1] > 1.1 * zero[1]


def test_a_stiff_anchor_holds_the_base_and_bears_one_tension_at_both_cracks():
    free = {"elements_across": 4, "evidence": "none"}
    soft = {name: value for name, value in TENDON.items() if name != "axial_stiffness"}
    held = flexible(dam(anchors=[DOWEL | {"capacity": "3 MN/m"}], flexible=free))
    assert abs(held.cracks[1].of_crack.residual_slip_m) < 0.8 * abs(slips(dam(anchors=[soft], flexible=free))[1])
    neck, base = (crack["anchors"][0] for crack in held.to_json()["cracks"])
    assert neck["peak_tension_n"] == base["peak_tension_n"] > 2.1e6
    assert neck["peak_force_n"] != base["peak_force_n"]


@pytest.mark.parametrize("changes", [{}, {"further_cracks": [{"elevation": "90 m", "friction": 5.0}]}])
def test_an_anchor_is_overloaded_where_it_is_at_one_of_its_cracks(changes):
    """Its tension is the same at both; the force at the crack that slips more is larger."""

    def result(capacity):
        free = {"elements_across": 4, "evidence": "none"}
        return flexible(dam(anchors=[DOWEL | {"capacity": f"{capacity} N/m"}], flexible=free, **changes))

    forces = [crack["anchors"][0]["peak_force_n"] for crack in result(1e9).to_json()["cracks"]]
    (warning,) = (item for item in result(sum(forces) / 2).warnings if item.name == "anchor-fails overloaded")
    assert forces[0] != forces[1]
    assert f"{max(forces) / 1e6:.4g} MN/m" in str(warning)


@pytest.mark.parametrize(
    ("blocks", "name"),
    [({"anchors": [TENDON]}, "an anchor with stiffness"), ({"uplift": water(LAWS[0])}, "uplift that changes")],
)
def test_two_rigid_blocks_refuse_what_they_have_not(blocks, name):
    case = dam(**blocks)
    with pytest.raises(InputError, match=f"{name}.*with several cracks"):
        rigid(case)
    assert run(case).model == "flexible"
