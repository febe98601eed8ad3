"""What the flexible model refuses, and what it says of its result."""

from __future__ import annotations

import numpy as np
import pytest

from heeltoe import GroundMotion, InputError, flexible, verdict
from heeltoe.result.rest import comes_to_rest
from shared.dams import plane_case

FIELDS = {
    "section": {"height": "30 m", "crest_width": "4 m", "base_width": "24 m"},
    "concrete": {"density": "2400 kg/m^3", "modulus": "20 GPa"},
    "crack": {"friction": 1.0},
    "reservoir": {"depth": "20 m"},
    "flexible": {"elements_across": 2, "evidence": "none"},
}
TIME = np.linspace(0.0, 1.0, 101)
MOTION = GroundMotion.from_points(TIME, 4.0 * np.sin(2.0 * np.pi * 3.0 * TIME))


def changed(**blocks):
    fields = {name: dict(block) for name, block in FIELDS.items()}
    for name, block in blocks.items():
        fields[name] = fields.get(name, {}) | block
    return plane_case(fields)


def test_a_step_too_long_for_the_vibration_is_refused():
    with pytest.raises(InputError, match="too long to follow the vibration") as caught:
        flexible(changed(flexible={"time_step": "0.05 s"}), MOTION)
    assert caught.value.code == "time-step-long"


@pytest.mark.parametrize("step", [1e-5, 2.0])
def test_a_spacing_of_frames_out_of_range_is_refused(step):
    with pytest.raises(InputError) as caught:
        flexible(changed(), MOTION, output_step=step)
    assert caught.value.code == "frame-step"


def test_a_case_without_a_motion_is_refused():
    with pytest.raises(InputError) as caught:
        flexible(changed())
    assert caught.value.code == "motion-missing"


@pytest.mark.parametrize(
    ("blocks", "words"),
    [
        ({}, "flexible.evidence is none"),
        ({"concrete": {"damping": 0.0}, "reservoir": {"depth": "30 m"}}, "creeps downstream"),
        ({"concrete": {"modulus": "2 GPa"}}, "is not that of concrete"),
        ({"concrete": {"poisson": 0.45}}, "unusual for concrete"),
        ({"crack": {"friction": 0.3}, "reservoir": {"depth": "28 m"}}, "slides under its static loads alone"),
        (
            {"flexible": {"contact": "idce", "damping": "deformation", "newmark_gamma": 0.5}},
            "created energy",
        ),
    ],
    ids=["no evidence", "no damping", "modulus", "poisson", "unstable", "penalty"],
)
def test_what_a_reader_must_know_is_said(blocks, words):
    response = flexible(changed(**blocks), MOTION)
    assert any(words in text for text in map(str, response.warnings)), response.warnings


def test_both_treatments_of_contact_agree_where_the_penalty_is_damped():
    exact = flexible(changed(flexible={"damping": "deformation"}), MOTION)
    penalty = flexible(changed(flexible={"contact": "idce", "damping": "deformation"}), MOTION)
    assert exact.residual_slip_m > 1e-3
    assert penalty.residual_slip_m == pytest.approx(exact.residual_slip_m, rel=0.05)
    assert exact.energy.residual < 1e-11
    assert exact.energy.gained_j < 1e-6 * exact.energy.friction_j


def test_a_dam_is_built_once():
    one, two = flexible(changed(), MOTION), flexible(changed(), MOTION.scaled(0.5))
    assert one.crack.dam is two.crack.dam


def test_every_number_is_an_attribute_of_the_response():
    response = flexible(plane_case({**FIELDS, "anchors": [{"distance": "6 m", "prestress": "1 MN/m"}]}), MOTION)
    for name, value in response.summary.items():
        assert getattr(response, name) == value


def test_the_warning_of_a_dam_on_its_way_is_that_of_the_verdict():
    # It slides until 0.4 s. Of a run of 1.3 s both look at the second half, not at the last second.
    case = changed(crack={"friction": 0.7}, reservoir={"depth": "5 m"}, analysis={"silence": "0 s"})
    motion = GroundMotion.from_points([0.0, 0.05, 0.2, 0.25, 1.3], [0.0, -10.0, -10.0, 0.0, 0.0])
    stopped = flexible(case, motion)
    assert stopped.residual_slip_m > 0.1
    assert comes_to_rest(stopped)
    assert "still-moves" not in [warning.code for warning in stopped.warnings]
    moving = flexible(case, motion.cut(0.3))
    assert not comes_to_rest(moving)
    (text,) = [str(warning) for warning in moving.warnings if warning.code == "still-moves"]
    assert "in the last 0.15 s its slip changes" in text
    assert "in the last 0.15 s its slip changes" in verdict(moving)
