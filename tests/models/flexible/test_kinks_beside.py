"""Cracks that are not straight through sequences, studies and spreads; steps that hold before any of them."""

from __future__ import annotations

import numpy as np
import pytest

from heeltoe import InputError, flexible, read_case, read_study
from heeltoe.models.statics.cases import usual
from heeltoe.motion.records.read import read_record
from heeltoe.study.plan.plan import plan_of
from heeltoe.study.run import batches as parts
from heeltoe.study.small.spread import with_spread
from shared.dams import plane_case
from shared.studies import study_file

PULSES = [["0 s", "0 g"], ["0.15 s", "-0.6 g"], ["0.4 s", "0.5 g"], ["0.65 s", "-0.5 g"], ["0.8 s", "0 g"]]
OTHER = [["0 s", "0 g"], ["0.2 s", "-0.5 g"], ["0.5 s", "0.5 g"], ["0.7 s", "0 g"]]
STEP = [["30 m", "0 m"], ["34 m", "1.5 m"]]
DAM = {
    "section": {"height": "110 m", "crest_width": "8 m", "base_width": "90 m"},
    "concrete": {"modulus": "20 GPa"},
    "crack": {"elevation": "20 m", "friction": 0.9, "kinks": STEP},
    "reservoir": {"depth": "105 m"},
    "motion": {"points": PULSES},
    "analysis": {"silence": "0 s"},
    "flexible": {"elements_across": 4, "evidence": "none"},
}
FILE = """
[section]
height = "110 m"
crest_width = "8 m"
base_width = "90 m"
[concrete]
modulus = "20 GPa"
[crack]
elevation = "20 m"
friction = 0.9
kinks = [["30 m", "0 m"], ["34 m", "1.5 m"]]
[reservoir]
depth = "105 m"
[flexible]
elements_across = 4
evidence = "none"
[analysis]
silence = "3 s"
"""
STUDY = """
case = "case.toml"
model = {model}
[vary]
"crack.friction" = [0.7, 0.9]
[motions]
both_signs = false
files = ["quakes/quake-a-000.txt"]
scale = {{ measure = "pga", values = ["0.4 g", "0.9 g"] }}
"""


def dam(*changes):
    return plane_case(DAM, list(changes))


def codes(response):
    return {notice.name for notice in response.warnings}


@pytest.mark.slow
def test_two_motions_do_what_the_joined_one_does():
    both = flexible(dam({"aftershocks": [{"points": OTHER, "pause": "2 s"}]}))
    later = [[f"{2.8 + float(time.split()[0])!r} s", size] for time, size in OTHER]
    joined = flexible(dam({"motion.points": [*PULSES, *later]}))
    assert both.histories["slip_m"].tobytes() == joined.histories["slip_m"].tobytes()
    first, second = both.sequence
    alone = flexible(dam())
    # Alone its histories end with the motion; in the sequence the dam comes to rest.
    there = both.histories["time_s"] <= 0.8 + 1e-9
    np.testing.assert_allclose(both.histories["slip_m"][there], alone.histories["slip_m"], rtol=0.0, atol=1e-9)
    assert first.slip_m > 0.05
    assert first.slip_m + second.slip_m == pytest.approx(both.residual_slip_m)
    # The static checks in between know the slip, and with another friction say no.
    assert first.static["ok"]
    weak = flexible(dam({"aftershocks": [{"points": OTHER, "pause": "2 s"}]}, "statics.residual_friction=0.5"))
    assert not weak.sequence[0].static["ok"]
    assert "sequence-statics" in codes(weak)


def test_drains_that_close_are_told_and_stay():
    drained = {"pattern": "drained", "drain_position": 0.1, "drain_efficiency": 0.6}
    changes = {"uplift": drained, "aftershocks": [{"points": OTHER, "pause": "1 s"}], "statics.drain_diameter": "0.2 m"}
    response = flexible(dam(changes))
    assert response.sequence[0].static["drainage"] < 0.9
    assert response.summary["drainage_by_motion"] is None
    assert "sequence-drains" in codes(response)


def test_a_dam_that_its_steps_hold_stands_before_the_earthquake():
    kinks = [["20 m", "0 m"], ["30 m", "4 m"], ["60 m", "0 m"]]
    stepped = dam({"crack.kinks": kinks}, "crack.friction=0.55")
    load_case = usual(stepped).load_case
    assert load_case.sliding_factor < 1.0 < load_case.sliding_factor_on_pieces
    held, slides = flexible(stepped), flexible(dam({"crack.kinks": []}, "crack.friction=0.55"))
    assert (held.outcome, slides.outcome) == ("ok", "unstable")
    assert "friction-not-enough steps" in codes(held)
    assert "slides away" not in held.to_json()["verdict"]
    # What its pieces do not bear goes.
    lower = stepped.with_("crack.friction=0.1")
    assert usual(lower).load_case.sliding_factor_on_pieces < 1.0
    assert flexible(lower).outcome == "unstable"


@pytest.mark.slow
def test_each_run_of_a_study_is_the_one_by_hand(tmp_path):
    """Swinging on through its silence too, where its crack has closed on two steps when the motion ends."""
    plan = plan_of(read_study(study_file(tmp_path, STUDY.format(model='"flexible"'), case=FILE)))
    table = parts.run_part(plan, 0, plan.count).to_pylist()
    assert len(table) == 4
    for run in table:
        case = read_case(tmp_path / "case.toml", {"crack.friction": run["crack.friction"]})
        response = flexible(case, read_record(tmp_path / "quakes" / f"{run['motion']}.txt").scaled(run["factor"]))
        assert run["outcome"] == response.outcome == "ok"
        assert run["residual_slip_m"] == pytest.approx(response.residual_slip_m, rel=1e-9, abs=1e-12)
    assert max(abs(run["residual_slip_m"]) for run in table) > 0.01


@pytest.mark.parametrize("model", ['"rigid"', '["flexible", "decoupled"]'])
def test_studies_of_blocks_refuse_kinks(tmp_path, model):
    with pytest.raises(InputError, match=r"crack\.kinks: a study of blocks does not support kinks"):
        plan_of(read_study(study_file(tmp_path, STUDY.format(model=model), case=FILE)))


def test_a_spread_is_of_runs_by_hand():
    case = dam()
    spread = with_spread(flexible(case), case, 3).spread
    assert spread["failed"] == 0
    weaker = [[time, f"{spread['scales'][0] * float(size.split()[0])!r} g"] for time, size in PULSES]
    weak = flexible(case.with_({"motion.points": weaker}))
    assert spread["residual_slips_m"][0] == pytest.approx(weak.residual_slip_m, rel=1e-9)
