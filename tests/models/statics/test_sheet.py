"""The calculation sheet: arms, moments and sums as a checker finds them by hand."""

from __future__ import annotations

import pytest

import heeltoe
from shared.statics import CLOSE, SHAKEN, M, dam, only


def lines(sheet):
    return {line.name: line for line in sheet.lines}


def test_forces_arms_and_moments_of_the_triangle():
    # 96 MN of concrete a third of the base from the heel, 40.5 MN of water a third of its depth up, 36 MN of uplift.
    result = only(heeltoe.statics(dam()), "usual")
    at = lines(result.sheet("toe"))
    assert (at["weight"].vertical_n, at["weight"].distance_m) == pytest.approx((-96 * M, 80 / 3 - 80), **CLOSE)
    assert (at["reservoir"].horizontal_n, at["reservoir"].height_m) == pytest.approx((40.5 * M, 30.0), **CLOSE)
    assert (at["uplift"].vertical_n, at["uplift"].distance_m) == pytest.approx((36 * M, 80 / 3 - 80), **CLOSE)
    moments = [at[name].moment_nm for name in ("weight", "reservoir", "uplift")]
    assert moments == pytest.approx([5120 * M, -1215 * M, -1920 * M], **CLOSE)
    assert at["weight"].height_m is None
    assert at["reservoir"].distance_m is None
    assert str(at["weight"].source) == "4000 m² of concrete of 2400 kg/m³, at its centroid"


@pytest.mark.parametrize("slope", ["0 deg", "8 deg"])
@pytest.mark.parametrize("about", ["heel", "toe"])
def test_every_moment_is_force_times_arm_and_the_sums_are_those_of_the_checks(slope, about):
    case = dam(
        section={"polygon": [["-8 m", "0 m"], ["80 m", "0 m"], ["8 m", "90 m"], ["8 m", "100 m"], ["0 m", "100 m"]]},
        crack={"friction": 0.9, "elevation": "5 m", "inclination": slope},
        tailwater={"depth": "20 m", "follows_vertical_motion": True},
        ice={"force": "100 kN/m"},
        silt={"depth": "30 m"},
        anchors=[{"distance": "6 m", "inclination": "5 deg", "prestress": "2 MN/m"}],
        statics={**SHAKEN, "flood_depth": "98 m", "residual_slip": "0.3 m"},
    )
    section = case.cut
    for result in heeltoe.statics(case).cases:
        sheet = result.sheet(about)
        for line in (*sheet.lines, sheet.sum):
            by_arms = (line.distance_m or 0.0) * line.vertical_n - (line.height_m or 0.0) * line.horizontal_n
            assert by_arms == pytest.approx(line.moment_nm, rel=1e-9, abs=1e-3)
            assert str(line.source) or line is sheet.sum, line.name
        along, across = section.in_crack_frame(sheet.sum.horizontal_n, sheet.sum.vertical_n)
        assert along == pytest.approx(result.shear_force_n)
        assert -across == pytest.approx(result.normal_force_n)
        place = section.in_crack_frame(*sheet.point_m)[0]
        assert place - sheet.sum.moment_nm / result.normal_force_n == pytest.approx(result.resultant_from_heel_m)
    assert len(result.forces) == 7


def test_json_has_the_sheet():
    forces = heeltoe.statics(dam()).to_json()["cases"][0]["forces"]
    weight = forces[0]
    assert weight["distance_m"] == pytest.approx(80 / 3)
    assert weight["moment_about_toe_nm"] == pytest.approx(5120 * M)


def test_the_pieces_of_the_body_add_up_to_it():
    case = dam(
        section={"polygon": [["0 m", "0 m"], ["80 m", "0 m"], ["8 m", "90 m"], ["8 m", "100 m"], ["0 m", "100 m"]]},
        statics=SHAKEN,
    )
    for result in heeltoe.statics(case).cases:
        for line in result.sheet("toe").lines:
            if line.name in ("weight", "inertia"):
                assert [piece.name for piece in line.parts] == [f"{line.name} 1", f"{line.name} 2"]
                for part in ("horizontal_n", "vertical_n", "moment_nm"):
                    whole = sum(getattr(piece, part) for piece in line.parts)
                    assert whole == pytest.approx(getattr(line, part), rel=1e-9, abs=1e-3)
    sheet = only(heeltoe.statics(case), "usual").sheet()
    message = "rectangle 8 m by 100 m, concrete of 2400 kg/m³"
    assert str(lines(sheet)["weight"].parts[0].source) == message
