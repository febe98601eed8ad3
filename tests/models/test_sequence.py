"""A dam meets a mainshock and aftershocks, each as the one before has left it."""

import json

import numpy as np
import pytest

import heeltoe
from heeltoe import InputError, read_case
from shared.command import command
from shared.dams import BASE, FAST
from shared.every_field import PULSE

POINTS = [["0 s", "0 g"], ["0.1 s", "0.9 g"], ["0.35 s", "-0.7 g"], ["0.5 s", "0 g"]]
OTHER = [["0 s", "0 g"], ["0.15 s", "-0.8 g"], ["0.4 s", "0.6 g"], ["0.6 s", "0 g"]]
DRAINS = {"uplift": {"pattern": "drained", "drain_position": 0.1, "drain_efficiency": 0.6}}


def sequence(*changes, aftershocks=({"points": OTHER, "pause": "2 s"}, {"points": POINTS, "reverse": True})):
    return read_case(
        BASE,
        [{"motion": {"points": POINTS, "pga": None, "duration": None}, "aftershocks": list(aftershocks)}, *changes],
    )


def alone(points, reverse=False, *changes):
    return heeltoe.rigid(
        read_case(BASE, [{"motion": {"points": points, "pga": None, "duration": None, "reverse": reverse}}, *changes])
    )


def test_a_block_slides_as_far_as_in_each_motion_alone():
    response = heeltoe.rigid(sequence())
    each = [alone(POINTS), alone(OTHER), alone(POINTS, True)]
    slips = [run.residual_slip_m for run in each]
    assert [stage.slip_m for stage in response.sequence] == pytest.approx(slips, abs=1e-12)
    assert max(map(abs, slips)) > 0.01
    assert response.residual_slip_m == pytest.approx(sum(slips), abs=1e-12)
    assert all(stage.at_rest for stage in response.sequence)
    assert response.energy.residual < 1e-12
    assert [stage.begins_s for stage in response.sequence] == pytest.approx([0.0, 2.5, 13.1])
    assert response.sequence[1].peak_slip_upstream_m <= response.sequence[1].residual_slip_m
    assert "Motion by motion it slides" in response.to_json()["verdict"]


def test_the_mirrored_sequence_slides_as_the_others_did():
    """All motions turned round, --reverse turns them back."""
    given = [{"points": OTHER, "pause": "2 s", "reverse": True}, {"points": POINTS}]
    turned = sequence("motion.reverse=true", aftershocks=given)
    assert turned.with_(turned.reversal()) == sequence().with_("motion.reverse=false").with_(
        {"aftershocks": [{"points": OTHER, "pause": "2 s", "reverse": False}, {"points": POINTS, "reverse": True}]}
    )
    assert read_case(BASE).model_copy(update={"motion": None}).reversal() == {}


def test_an_elastic_dam_goes_through_all_of_it():
    response = heeltoe.flexible(sequence(*FAST, "flexible.evidence=none"))
    first = heeltoe.flexible(
        read_case(
            BASE, [{"motion": {"points": POINTS, "pga": None, "duration": None}}, *FAST, "flexible.evidence=none"]
        )
    )
    assert response.sequence[0].residual_slip_m == pytest.approx(first.residual_slip_m, rel=0.01)
    assert response.sequence[-1].residual_slip_m == response.residual_slip_m
    assert sum(stage.slip_m for stage in response.sequence) == pytest.approx(response.residual_slip_m)
    assert len(response.sequence) == 3


def test_a_file_may_have_all_motions_in_one_list(tmp_path):
    fields = heeltoe.read_case(BASE).model_dump(mode="json", exclude_unset=True)
    motions = [{"points": POINTS}, {"points": OTHER, "pause": "2 s"}, {"points": POINTS, "reverse": True}]
    case = read_case({**fields, "motion": motions})
    assert case.aftershocks == sequence().aftershocks
    assert read_case({**fields, "motion": motions[:1]}).aftershocks == ()
    with pytest.raises(InputError, match='cannot stand beside "aftershocks"'):
        read_case({**fields, "motion": motions, "aftershocks": motions})
    with pytest.raises(InputError, match=r"motion\.pause"):
        read_case({**fields, "motion": [{"points": POINTS, "pause": "1 s"}]})
    with pytest.raises(InputError, match="aftershocks: has no meaning without a motion"):
        read_case({**{name: each for name, each in fields.items() if name != "motion"}, "aftershocks": motions[:1]})
    assert read_case({**fields, "motion": motions}, "motion.pga=0.5g").motion.pga is not None


def test_what_one_motion_leaves_is_judged_before_the_next():
    case = sequence({**DRAINS, "statics.drain_diameter": "50 mm"}, "crack.friction=0.8")
    response = heeltoe.rigid(case)
    message = {warning.code: dict(warning.quantities) for warning in response.warnings}
    slip = response.sequence[1].residual_slip_m
    assert message["sequence-drains-close"]["share"] == pytest.approx(max(0.0, 1.0 - abs(slip) / 0.05))
    assert response.sequence[1].static["drainage"] == message["sequence-drains-close"]["share"]
    assert "sliding factor" in message["sequence-statics"]["missed"]
    # What the checks ask for stands in the result, and is of use to it.
    assert not any("statics" in str(warning) for warning in response.warnings if warning.code == "fields-unused")
    own = heeltoe.rigid(case.with_("statics.residual_slip=1 m"))
    assert own.sequence[0].static == response.sequence[0].static


def test_a_dam_that_still_moves_is_told():
    response = heeltoe.rigid(sequence(aftershocks=[{"points": PULSE, "pause": "1 ms"}]))
    assert not response.sequence[0].at_rest
    assert "sequence-moves" in [warning.code for warning in response.warnings]


def test_a_motion_beside_the_case_comes_alone():
    case = sequence()
    motion = heeltoe.rigid(case).motion
    other = heeltoe.GroundMotion.from_points([0.0, 0.1, 0.3], [0.0, 6.0, 0.0])
    response = heeltoe.rigid(case, other)
    assert "motions-left-out" in [warning.code for warning in response.warnings]
    assert response.sequence == ()
    # The sequence itself may be handed in again.
    again = heeltoe.rigid(case, motion)
    assert again.residual_slip_m == heeltoe.rigid(case).residual_slip_m
    assert "motions-left-out" not in [warning.code for warning in again.warnings]


def test_a_spread_is_that_of_the_whole_sequence():
    case = sequence()
    response = heeltoe.with_spread(heeltoe.rigid(case), case, 3)
    assert response.spread["residual_slips_m"][1] == pytest.approx(response.residual_slip_m, rel=1e-9)


def test_a_run_that_ends_early_tells_of_what_it_has_met():
    steep = {"points": [["0 s", "0 g"], ["0.5 s", "3 g"], ["1.2 s", "3 g"], ["1.3 s", "0 g"]]}
    case = read_case("examples/slender.toml", [{"motion": {**steep, "pga": None}, "aftershocks": [{"points": POINTS}]}])
    response = heeltoe.rigid(case)
    assert response.outcome != "ok"
    assert len(response.sequence) <= 1
    assert np.isfinite([stage.slip_m for stage in response.sequence]).all()


def test_the_table_is_in_terminal_and_report(tmp_path):
    fields = sequence().model_dump(mode="json", exclude_unset=True)
    place = tmp_path / "case.json"
    place.write_text(json.dumps(fields))
    process = command("run", str(place), "--model", "rigid", "--details")
    assert "static checks" in " ".join(process.stdout.split())
    assert "2 (2.5 s)" in process.stdout


def test_a_study_runs_the_sequence_of_its_case_or_motions_of_its_own(tmp_path):
    fields = sequence().model_dump(mode="json", exclude_unset=True)
    (tmp_path / "case.json").write_text(json.dumps(fields))
    study = 'case = "case.json"\nmodel = "rigid"\n[vary]\n"crack.friction" = [0.9, 1.0]\n'
    (tmp_path / "study.toml").write_text(study)
    process = command("study", str(tmp_path / "study.toml"), "--json", "-", "--out", str(tmp_path / "out"))
    assert process.returncode == 0, process.stderr
    (tmp_path / "other.toml").write_text(f'{study}[motions]\nboth_signs = false\nfiles = ["elcentro-1940-180-nga"]\n')
    refused = command("study", str(tmp_path / "other.toml"), "--out", str(tmp_path / "out2"))
    assert refused.returncode == 2
    assert "leave [motions] out, or remove the aftershocks" in refused.stderr
