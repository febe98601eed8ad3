"""Warnings that hardly any run earns: each from the numbers that make it, with what it must leave unsaid beside it."""

from __future__ import annotations

from dataclasses import replace
from types import SimpleNamespace

import pytest

import heeltoe
from heeltoe import run
from heeltoe.case.warnings import case_warnings
from heeltoe.mechanics.block import build_block, instability
from heeltoe.models.decoupled import model as decoupled
from heeltoe.models.flexible import warnings as flexible
from heeltoe.models.rigid.walk import walk
from heeltoe.models.rigid.warnings import warnings_of
from heeltoe.models.run import earthquake
from shared.dams import FAST, example
from shared.evidence import evidence_of


def codes(said):
    return {item.name for item in said}


@pytest.mark.parametrize(
    ("field", "changes"),
    [
        ("ice", ["reservoir.depth=90.5m", 'ice={depth="1 m", force="100 kN/m"}']),
        ("silt", ['silt={depth="20 m"}']),
    ],
)
def test_what_ends_below_the_crack(field, changes):
    def fields(case):
        return {notice.field for notice in case_warnings(case) if notice.name == "below-crack"}

    assert field in fields(example("typical-height", *changes))
    low = [change for change in changes if not change.startswith("reservoir")]
    assert field not in fields(example("typical-base", *low))


def test_impacts_of_a_rigid_block():
    case = example("typical-base", *FAST)
    block = heeltoe.build_block(case)
    run = walk(case, block, earthquake(case).shaking)
    both = {"restitution-lowered", "paradox-jammed"}
    assert not both & codes(warnings_of(case, block, run))
    summary = SimpleNamespace(**{**run.summary.by_name(), "energy_limited_impacts": 2.0, "jams": 1.0})
    changed = SimpleNamespace(summary=summary, outcome=run.outcome, exact=run.exact, anchors=run.anchors)
    message = {item.name: str(item) for item in warnings_of(case, block, changed)}
    assert both <= set(message)
    assert message["restitution-lowered"].startswith("2 ")
    assert message["paradox-jammed"].startswith("1 ")


@pytest.mark.parametrize(
    ("moved", "mean", "failed", "said"),
    [
        ((0.003, 0.003, 0.003), False, 0, set()),
        ((0.003, 0.003, 0.005), False, 0, {"not-converged crack"}),
        ((0.001, 0.001, 0.005), True, 0, {"runs-scatter crack"}),
        ((0.0, 0.0, 0.0), False, 1, {"not-converged crack", "evidence-failures"}),
    ],
)
def test_what_moves_the_slip_of_an_elastic_dam(typical_both, moved, mean, failed, said):
    evidence = evidence_of(moved, scatters=mean, failed=failed)
    assert codes(flexible._about_the_evidences([evidence], typical_both.crack.dam, 0)) == said


@pytest.mark.parametrize("leads", [0, 1])
def test_the_crack_whose_runs_scatter_is_named(typical_both, leads):
    """The dam of one crack lends its level to both."""
    dam = SimpleNamespace(sections=typical_both.crack.dam.sections * 2)
    evidences = [evidence_of((0.001, 0.001, 0.001)), evidence_of((0.001, 0.001, 0.005), scatters=True)]
    (notice,) = flexible._about_the_evidences(evidences, dam, leads)
    assert notice.name == "runs-scatter one-crack"
    assert str(notice).startswith("single runs scatter at the crack at 0 m: 2 of them")


@pytest.mark.parametrize(("error", "warned"), [(0.029, False), (0.031, True)])
def test_too_few_modes(typical_both, error, warned):
    dam = replace(typical_both.crack.dam, basis_error=error)
    assert ("modes-few" in codes(flexible._about_the_concrete(example("typical-base"), dam))) is warned


@pytest.mark.parametrize("warned", [False, True])
def test_sampling_of_the_motion_at_the_crack(warned):
    coarser = 0.2 if warned else 0.1
    level = run(example("koyna-top", "motion.duration=1s"), "decoupled").crack_level
    convergence = replace(level.convergence, coarser_residual_slip_m=coarser, change=decoupled._change(0.1, coarser))
    message = decoupled._warnings(replace(level, convergence=convergence))
    assert codes(message) == ({"slip-sensitive sampling"} if warned else set())


def test_a_dam_without_a_state_of_rest():
    toppling = example("typical-base", *FAST, "motion.duration=1s", "crack.friction=1.9", "section.base_width=45 m")
    response = heeltoe.flexible(toppling)
    assert response.outcome == "unstable"
    assert "no-rest" in codes(response.warnings)
    standing = heeltoe.flexible(example("typical-base", *FAST, "motion.duration=1s", "crack.friction=1.9"))
    assert "no-rest" not in codes(standing.warnings)


@pytest.mark.parametrize(
    ("unrest", "said"),
    [
        ("not found", "shows neither that the dam stands nor that it does not"),
        ("moves away", "nothing holds a part above a crack"),
    ],
)
def test_a_search_that_finds_no_rest_says_why_and_nothing_of_sliding(typical_both, unrest, said):
    """Static equilibrium of the block holds this dam: that it slides is not known."""
    dam = typical_both.crack.dam
    assert dam.kernel.unrest() is None
    restless = replace(dam, start=replace(dam.start, stands=False, unrest=unrest))
    block = build_block(example("typical-base"))
    assert instability(block) is None
    still = dict.fromkeys(("rotation_max", "rotation_min", "slip_max", "slip_min"), 0.0)
    raw = SimpleNamespace(by_name=lambda: still, end_time=0.0, slip=0.0)
    outcome, advice = flexible.judge_outcome(
        restless, block, SimpleNamespace(outcome="ok", summary=raw, summaries=(raw,))
    )
    assert outcome == "unstable"
    assert said in str(advice)
    assert "slides" not in str(advice)
