"""Friction laws of several cracks: those of constant friction, each alone where the other is bonded, what is told."""

from __future__ import annotations

import copy

import numpy as np
import pytest

from heeltoe import InputError, rigid, statics_of_sections
from heeltoe.case.field_usage import unused_fields
from heeltoe.mechanics.law_curve import curves_of
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from heeltoe.models.run import earthquake, flexible
from shared.dams import plane_case
from shared.two_cracks import DAM, STEP, bonded, same, shaken

WEAK = {"name": "slip weakening", "peak_friction": 0.9, "residual_friction": 0.6, "slip": "20 mm"}
BARTON = {"name": "barton-bandis", "jrc": 10, "jcs": "30 MPa", "residual_angle": "28 deg"}
COHESION = {"name": "cohesion", "residual_friction": 0.4, "cohesion": "60 kPa", "slip": "5 mm"}
SPEED = {"name": "speed weakening", "peak_friction": 0.8, "residual_friction": 0.5, "speed": "0.1 m/s"}
EXPONENTIAL = {**WEAK, "form": "exponential", "peak_friction": 0.8, "residual_friction": 0.5}
PAIRS = [(WEAK, EXPONENTIAL), (BARTON, COHESION), (SPEED, BARTON), (COHESION, SPEED)]
FREE = {"elements_across": 4, "evidence": "none"}


def dam(base, neck, **blocks):
    """Return the dam with a law, or a coefficient, of each crack."""
    given = [{"friction": item} if isinstance(item, float) else {"law": item} for item in (base, neck)]
    fields = copy.deepcopy(DAM) | {
        "crack": {"elevation": "0 m", **given[0]},
        "further_cracks": [{"elevation": "90 m", **given[1]}],
    }
    return plane_case(fields | blocks)


def constant(friction: float):
    return {**WEAK, "peak_friction": friction, "residual_friction": friction}


def test_laws_reduced_to_coulomb_give_coulombs_result():
    expected, result = (shaken(dam(*item)) for item in ((0.9, 0.8), (constant(0.9), constant(0.8))))
    for one, other in zip(expected.all_frames, result.all_frames, strict=True):
        largest = np.abs(one.slip).max()
        assert largest > 1e-4
        assert other.slip == pytest.approx(one.slip, rel=0.0, abs=1e-10 * largest)


# Not cohesion: where bonds break one by one, rounding may tell which goes first.
@pytest.mark.parametrize("law", [WEAK, EXPONENTIAL, BARTON, SPEED], ids=["linear", "exponential", "barton", "speed"])
def test_the_neck_alone_where_the_base_is_bonded(law):
    case = dam(0.9, law)
    two, alone = shaken(bonded(case, 0.0)), shaken(case.single_crack_cases[0])
    assert np.abs(alone.frames.slip).max() > 1e-3
    # While the linear law weakens, what contact leaves of its equations, 1e-10, grows with the slip: to less than 1e-6
    # on one processor and 2.6e-6 on another.
    within = 1e-5 if law is WEAK else 1e-6
    same(two.all_frames[0], alone.frames, 8.0, within)
    assert two.all_frames[0].slip_path == pytest.approx(alone.frames.slip_path, abs=within)


@pytest.mark.parametrize(("base", "neck"), PAIRS)
def test_contact_is_met_and_the_ledger_closes(base, neck):
    run = shaken(dam(base, neck, flexible=FREE))
    for item in run.summaries:
        assert item.contact_residual < 1e-9
        assert item.energy_residual < 1e-12
        assert item.energy_gained < 1e-9 * item.energy_turnover
    lost = [summary.crack_friction for summary in run.summaries]
    assert sum(lost) == pytest.approx(run.summary.energy_friction, rel=1e-9)
    assert max(abs(summary.slip) for summary in run.summaries) > 1e-3


def test_a_mirrored_dam_slides_the_other_way():
    case = dam(WEAK, BARTON, flexible=FREE)
    mirrored = [[f"{-x} m", f"{z} m"] for x, z in np.array(case.section.vertices())[::-1]]
    changes = {
        "section": {**dict.fromkeys(case.section.model_fields_set), "polygon": mirrored},
        "reservoir": None,
        "tailwater": {"depth": "100 m", "compressible": False},
        "motion.reverse": True,
    }
    for one, other in zip(shaken(case).all_frames, shaken(case.with_(changes)).all_frames, strict=True):
        assert one.slip == pytest.approx(-other.slip, abs=1e-6)


def test_a_run_has_the_same_bits_with_any_number_of_threads():
    case = dam(WEAK, BARTON, flexible=FREE)
    shaken_dam = ShakenDam(case, build_flexible_dam(case), earthquake(case).shaking)
    one, two = (shaken_dam.run_scaled_cracks(STEP, np.array([0.9, 1.0, 1.1]), threads=threads) for threads in (1, 2))
    for each, other, run in zip(one, two, shaken_dam.run(STEP).summaries, strict=True):
        assert each["slip"].tobytes() == other["slip"].tobytes()
        assert each["slip"][1] == run.slip


def test_each_crack_is_told_of():
    weak = {**BARTON, "jcs": "0.1 MPa"}
    response = flexible(dam(WEAK, weak, flexible=FREE))
    neck, base = (item["friction_law"] for item in response.to_json()["cracks"])
    assert (neck["name"], base["name"]) == ("barton-bandis", "slip weakening")
    assert response.summary["friction_law"] == base
    assert base["apparent_friction_after"] < base["apparent_friction_before"] == pytest.approx(0.9, abs=0.01)
    assert neck["apparent_friction_after"] == neck["apparent_friction_before"]
    assert [item["friction"] for item in response.cracks][1] == 0.6
    for crack in response.cracks:
        # Its last frame is a little before the end.
        assert crack.histories["slip_path_m"][-1] == pytest.approx(crack.friction_law.slip_path_m, rel=0.01)
    texts = [str(warning) for warning in response.warnings if warning.name.startswith("law-range ")]
    assert len(texts) == 1
    assert "crack at 90 m" in texts[0]
    assert any("Palmer" in reference for reference in response.references)
    assert any("Barton" in reference for reference in response.references)


def test_a_further_crack_has_the_law_of_the_first_unless_it_says_otherwise():
    case = plane_case(DAM | {"crack": {"law": WEAK}, "further_cracks": [{"elevation": "90 m"}]})
    assert [single_crack_case.crack.law for single_crack_case in case.single_crack_cases] == [case.crack.law] * 2
    rough = case.with_("further_cracks[0].friction=0.8")
    assert [single_crack_case.crack.law for single_crack_case in rough.single_crack_cases] == [None, case.crack.law]
    back = rough.with_({"further_cracks[0].law": BARTON})
    assert back.further_cracks[0].friction is None
    assert back.single_crack_cases[0].crack.law.name == "barton-bandis"


def test_what_does_not_go_together_is_refused_by_name():
    with pytest.raises(InputError, match=r"further_cracks\[0\]\.friction: .*law"):
        plane_case(DAM | {"further_cracks": [{"elevation": "90 m", "friction": 0.8, "law": WEAK}]})
    with pytest.raises(
        InputError,
        match=r'further_cracks\[0\]\.law: the rigid model does not support a friction law \("slip weakening"\)',
    ):
        rigid(dam(0.9, WEAK))


def test_static_checks_judge_each_section_by_its_law():
    result = {joint.elevation_m: joint.statics for joint in statics_of_sections(dam(0.9, WEAK)).joints}
    usual = {at: next(case for case in each.cases if case.name == "usual") for at, each in result.items()}
    assert {at: case.friction for at, case in usual.items()} == pytest.approx({90.0: 0.9, 0.0: 0.9})
    after = {at: next(case for case in each.cases if case.name == "post-seismic") for at, each in result.items()}
    assert {at: case.friction for at, case in after.items()} == pytest.approx({90.0: 0.6, 0.0: 0.9})
    answer = unused_fields(dam(0.9, SPEED, motion={"points": DAM["motion"]["points"]}), ("statics",))
    assert any("further_cracks[0].law.residual_friction" in str(item) for item in answer)


def test_each_law_of_a_case_is_drawn():
    curves = curves_of(dam(WEAK, BARTON))
    assert list(curves) == ["crack-1/law", "law"]
    assert curves["crack-1/law"].title.endswith("crack at 90 m")
    assert (curves["law"].over, curves["crack-1/law"].over) == ("slip path", "normal stress")
    assert list(curves_of(dam(0.9, BARTON))) == ["crack-1/law"]
    assert list(curves_of(dam(0.9, 0.8))) == ["law"]
