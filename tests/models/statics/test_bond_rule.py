"""The bond of a joint in the static checks: one rule for all load cases, with the factor by friction alone beside."""

from __future__ import annotations

import pytest

from heeltoe import Case, read_case, run, statics
from heeltoe.models.statics.after import statics_after
from heeltoe.models.statics.model import Statics
from heeltoe.views.words.sheet import steps
from shared.dams import EXAMPLES

# A joint that holds in a weak earthquake.
WEAK = ["motion.pga=0.02 g", "analysis.silence=0 s", "motion.duration=5 s"]
EARTHQUAKE = "statics.seismic_coefficient=0.1"


def bonded(*changes: str) -> Case:
    return read_case(EXAMPLES / "bonded-joint.toml", [*WEAK, *changes])


def judged(*changes: str) -> Statics:
    case = bonded(*changes)
    return statics_after(case, run(case, "rigid"))


# By hand, from the printed forces of the dam without its bond: cohesion of 1.5 MPa on a joint of 12.77 m,
# C = 1.5e6 * 12.77 N/m, F = (C + 1.0 N) / T. Without tension nothing opens, and N and T are those with the bond.
def test_the_bond_counts_in_every_load_case():
    bare = statics(bonded("statics.bonded=0", EARTHQUAKE))
    forces = {case.name: (case.normal_force_n, abs(case.shear_force_n)) for case in bare.cases}
    result = judged(EARTHQUAKE)
    assert [case.name for case in result.cases] == list(forces)
    for case in result.cases:
        normal, shear = forces[case.name]
        width = case.contact_width_m
        assert width == pytest.approx(12.77, abs=5e-3)
        assert case.cohesive_force_n == pytest.approx(1.5e6 * width, rel=1e-9)
        if case.name != "pseudo-static downstream":  # that one opens the crack without the bond
            assert case.friction_factor == pytest.approx(normal / shear, rel=1e-6)
            assert case.sliding_factor == pytest.approx((1.5e6 * width + normal) / shear, rel=1e-6)
        assert any("crack.bond" in str(text) for text in case.assumptions), case.name
    usual, after = result.cases[0], result.cases[-1]
    assert usual.sliding_factor == pytest.approx(after.sliding_factor, rel=1e-9)


def test_what_statics_says_goes_before_the_bond_in_every_load_case():
    result = judged("statics.bonded=0.5", "statics.cohesion=0.4 MPa", EARTHQUAKE)
    for case in result.cases:
        assert case.cohesive_force_n == pytest.approx(0.4e6 * 0.5 * case.contact_width_m, rel=1e-6), case.name
    none = judged("statics.bonded=0", EARTHQUAKE)
    assert not any(case.cohesive_force_n for case in none.cases)


def test_criteria_that_ask_for_friction_alone_have_both_values():
    for criteria, paragraph, asked in (
        ("CDA", "residual sliding factor", 1.5),
        ("FERC", "section 3-5.3, table 2A", 1.5),
        ("CADAM3D", "residual sliding factor", 1.5),
    ):
        result = judged(f"statics.criteria={criteria}")
        check = next(check for check in result.checks if check.name == "sliding factor")
        alone = f"by friction alone {result.cases[0].friction_factor:.2f}, where {asked:.2f} is asked ({paragraph})"
        assert alone in check.sentence.text("si")
        assert alone in check.note
    step = {step.name: step for step in steps(result.cases[0], result.checks, "si")}["sliding, friction alone"]
    assert step.value == f"{result.cases[0].friction_factor:.4f}"


def test_without_a_run_the_joint_is_not_known_to_hold():
    after = statics(bonded()).cases[-1]
    assert after.name == "post-seismic"
    assert after.cohesive_force_n == 0.0
    assert any("not known without its run" in str(text) for text in after.assumptions)
