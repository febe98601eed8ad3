"""A dam on a rough crack, from the case to its result: what is told, warned of and refused."""

from __future__ import annotations

import math

import numpy as np
import pytest

from heeltoe import InputError, flexible, read_case, rigid, run, statics
from heeltoe.case.warnings import case_warnings
from heeltoe.motion.ground_motion import GroundMotion
from heeltoe.views.figures.all import all_figures
from shared.dams import TYPICAL_SECTION

ROUGH = {"asperity_height": "20 mm", "wave_length": "200 mm", "wear": "1e-5 m^2/J"}
SHAKEN = GroundMotion.from_points([0.0, 0.2, 0.3, 0.5, 3.0], [0.0, -9.0, -9.0, 0.0, 0.0], name="pulse")


def typical(roughness=None, **more):
    crack = {"restitution": 0.5, "friction": 0.7, "roughness": {**ROUGH, **(roughness or {})}} | more.pop("crack", {})
    return read_case(
        {
            "section": TYPICAL_SECTION,
            "concrete": {"density": "2650 kg/m^3"},
            "crack": crack,
            "reservoir": {"depth": "80 m"},
            **more,
        }
    )


def test_a_dam_on_a_rough_crack():
    response = rigid(typical(), SHAKEN)
    result, histories = response.roughness, response.histories
    assert response.outcome == "ok"
    assert abs(response.residual_slip_m) > 1e-3
    before = math.tan(math.atan(0.7) + math.atan(0.2))
    assert result["apparent_friction_before"] == pytest.approx(before, rel=1e-12)
    assert 0.7 < result["apparent_friction_after"] < before
    assert 0.0 < result["peak_dilation_m"] <= 0.02
    assert result["integration_error_m"] < 1e-6
    assert histories["dilation_m"][-1] == pytest.approx(result["residual_dilation_m"], rel=1e-12)
    assert histories["asperity_angle_rad"][-1] == result["asperity_angle_after_rad"]
    assert (np.diff(histories["plastic_work_j_m2"]) >= 0.0).all()
    assert {"Plesha", "Patton"} <= {word.strip(",") for source in response.references for word in source.split()}
    usual = statics(typical()).cases[0]
    assert usual.friction == pytest.approx(before, rel=1e-12)


def test_aftershocks_find_the_asperities_as_they_were_left():
    points = [["0 s", "0 g"], ["0.2 s", "-0.9 g"], ["0.4 s", "0 g"], ["3 s", "0 g"]]
    response = run(typical(motion={"points": points}, aftershocks=[{"points": points}]))
    once = run(typical(motion={"points": points}))
    assert response.roughness["plastic_work_j_m2"] > 1.5 * once.roughness["plastic_work_j_m2"]
    assert response.roughness["asperity_angle_after_rad"] < once.roughness["asperity_angle_after_rad"]


def test_the_chain_knows_a_rough_crack():
    case = typical(concrete={"density": "2650 kg/m^3", "modulus": "20 GPa"}, crack={"elevation": "20 m"})
    response = run(case, motion=SHAKEN)
    assert response.model == "decoupled"
    assert "asperities" in response.chosen.why
    assert response.roughness["peak_dilation_m"] >= 0.0


@pytest.mark.parametrize(
    ("roughness", "more", "code"),
    [
        ({}, {"analysis": {"rotation": "finite"}}, "combination"),
        ({}, {"uplift": {"pattern": "uniform", "during_shaking": "zero while open"}}, "combination"),
        ({}, {"anchors": [{"distance": "4 m", "axial_stiffness": "20 MN/m/m"}]}, "combination"),
        ({}, {"anchors": [{"distance": "4 m", "shear_stiffness": "20 MN/m/m"}]}, "combination"),
        ({"asperity_height": "0.5 m"}, {"crack": {"friction": 3.0}}, "rough-locks"),
        (
            {},
            {
                "crack": {
                    "friction": None,
                    "law": {"name": "barton-bandis", "jrc": 5, "jcs": "10 MPa", "residual_angle": "30 deg"},
                }
            },
            "combination",
        ),
        ({}, {"further_cracks": [{"elevation": "50 m"}]}, "combination"),
        ({"wear": "1 mm"}, {}, "wrong-quantity"),
    ],
)
def test_what_does_not_go_with_a_rough_crack_is_refused(roughness, more, code):
    with pytest.raises(InputError) as refused:
        typical(roughness, **more)
    assert refused.value.code == code


def test_the_flexible_model_refuses_a_rough_crack():
    case = typical(concrete={"density": "2650 kg/m^3", "modulus": "20 GPa"})
    with pytest.raises(InputError) as refused:
        flexible(case, SHAKEN)
    assert refused.value.code == "unsupported"


@pytest.mark.parametrize(
    ("roughness", "field"),
    [
        ({"asperity_height": "0.105 m", "wave_length": "0.2 m"}, ""),
        ({"asperity_height": "3 m", "wave_length": "60 m"}, ".asperity_height"),
        ({"asperity_height": "1 m", "wave_length": "90 m"}, ".wave_length"),
    ],
)
def test_what_is_no_sawtooth_that_a_block_climbs_is_warned_of(roughness, field):
    assert f"crack.roughness{field}" in [notice.field for notice in case_warnings(typical(roughness))]


def test_the_figure_of_asperities_shows_dilation_and_wear():
    response = rigid(typical(), SHAKEN)
    figures = all_figures(None, response)
    assert "asperities" in figures
    dilation, angle = (axes.lines[0].get_ydata() for axes in figures["asperities"].axes)
    assert figures["asperities"].axes[0].get_ylabel().endswith("[m]")
    assert max(dilation) == pytest.approx(response.histories["dilation_m"].max(), rel=1e-9)
    assert angle[0] == pytest.approx(math.degrees(math.atan(0.2)), rel=1e-12)
    assert (np.diff(angle) <= 0.0).all()
    assert angle[-1] < angle[0]


@pytest.mark.parametrize(("modulus", "more"), [(None, ", and with concrete.modulus"), ("20 GPa", "")])
def test_a_block_on_a_rough_crack_says_how_its_dam_is_run(modulus, more):
    # The flexible model refuses asperities, and --model auto takes the block.
    case = typical(concrete={"density": "2650 kg/m^3", **({"modulus": modulus} if modulus else {})})
    texts = [str(notice) for notice in rigid(case, SHAKEN).warnings if notice.name == "rigid-unlike-dam unknown"]
    assert len(texts) == 1
    assert f"its crack is rough): run it without crack.roughness, too{more}, and the dam is elastic" in texts[0]
