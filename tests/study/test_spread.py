"""The spread of a result: its runs are the runs a user could make by hand."""

from __future__ import annotations

import json

import numpy as np
import pytest

from heeltoe import InputError, flexible, read_case, rigid, verdict, with_spread
from heeltoe.result.contract import HEADLINES
from heeltoe.result.numbers import EvidenceNumbers, HeadlineWorth
from heeltoe.result.write import json_text
from heeltoe.study.small.spread import _step, check_runs
from shared.dams import BASE, FAST, SLENDER, example
from shared.dams import KOYNA_TOP as KOYNA
from shared.responses import with_numbers


@pytest.mark.parametrize("changes", [[], ['motion.vertical.file="elcentro-1940-up-nga"'], ["motion.duration=60s"]])
def test_rigid_runs_are_those_of_the_scaled_motion(changes):
    case = read_case(BASE, changes)
    response = with_spread(rigid(case), case, 3)
    by_hand = [
        rigid(
            case,
            response.motion.scaled(factor, "by hand"),
            response.vertical and response.vertical.scaled(factor, "by hand"),
        )
        for factor in (0.99, 1.0, 1.01)
    ]
    spread = response.spread
    assert spread["scales"] == pytest.approx([0.99, 1.0, 1.01])
    assert spread["residual_slips_m"] == pytest.approx([item.residual_slip_m for item in by_hand], rel=1e-9)
    for name in (item.key for item in HEADLINES):
        values = [item.summary[name] for item in by_hand]
        assert spread[name]["mean"] == pytest.approx(np.mean(values), rel=1e-9, abs=1e-15), name
        assert spread[name]["std"] == pytest.approx(np.std(values, ddof=1), rel=1e-6, abs=1e-12), name
        assert (spread[name]["min"], spread[name]["max"]) == pytest.approx((min(values), max(values)), abs=1e-12), name
    assert (spread["runs"], spread["failed"]) == (3, 0)


@pytest.mark.parametrize("more", [[], ["crack.elevation=90m", "flexible.elements_across_below=3"]])
def test_flexible_runs_are_those_of_the_scaled_motion(more, typical_both):
    case = example("typical-base", *FAST, *more)
    plain = flexible(case) if more else typical_both
    seen = []
    response = with_spread(plain, case, 3, progress=lambda done, of: seen.append((done, of)))
    spread = response.spread
    assert spread["time_step_s"] == plain.time_step_s
    assert spread["residual_slips_m"][1] == pytest.approx(plain.residual_slip_m, rel=1e-9)
    strong = flexible(case, plain.motion.scaled(1.01, "by hand"))
    assert spread["residual_slips_m"][2] == pytest.approx(strong.residual_slip_m, rel=1e-6)
    assert spread["opening_upstream_m"]["max"] >= strong.opening_upstream_m * (1.0 - 1e-6) > 0.0
    # Told as it goes on, and the same as in one go.
    assert seen[0] == (0, 3)
    assert with_spread(plain, case, 3).spread == spread


def test_the_longer_step_is_taken_only_where_it_gives_the_same(typical_both):
    response = typical_both
    assert _step(response) == response.time_step_s

    def judged(change: float) -> float:
        nothing = HeadlineWorth(value=0.1, run=0.1, uncertainty=0.1, step=0.1 * change, mesh=None, shaking=None)
        evidence = EvidenceNumbers(
            asked="step",
            converged=True,
            value_is="run",
            moved_most_by="step",
            allowed_m=0.01,
            time_step_s=response.time_step_s,
            other_time_step_s=2.0 * response.time_step_s,
            elements_across=4,
            other_elements_across=None,
            third_elements_across=None,
            scales=[],
            residual_slips_m=[],
            failed=0,
            runs=2,
            work=1.5,
            budget=20.0,
            budget_spent=False,
            **{headline.key: nothing for headline in HEADLINES},
        )
        return _step(with_numbers(response, evidence=evidence))

    assert judged(0.005) == 2.0 * response.time_step_s
    assert judged(0.02) == response.time_step_s


def test_runs_without_a_result_are_counted_and_left_out():
    case = read_case(KOYNA)
    # Some of the weaker and stronger runs have more events than this one.
    tight = read_case(KOYNA, [f"analysis.event_limit={rigid(case).events}"])
    response = with_spread(rigid(tight), tight, 11)
    spread = response.spread
    assert 0 < spread["failed"] < 10
    slips = spread["residual_slips_m"]
    assert slips.count(None) == spread["failed"]
    assert spread["residual_slip_m"]["max"] == max(slip for slip in slips if slip is not None)
    assert any("ended without a result" in text for text in map(str, response.warnings))
    json.loads(json_text(response.to_json()))


def test_a_dam_that_cannot_stand_has_no_spread_but_says_so():
    case = read_case(BASE, ["crack.friction=0.2"])
    spread = with_spread(rigid(case), case, 4).spread
    assert spread["failed"] == 4
    assert spread["residual_slip_m"] is None
    json.dumps(spread.to_json(), allow_nan=False)


def test_a_result_that_hangs_on_details_is_a_warning():
    def said(path, changes):
        case = read_case(path, changes)
        return [text for text in map(str, with_spread(rigid(case), case).warnings) if "depends on details" in text]

    assert said(KOYNA, [])
    assert not said(BASE, [])
    # A slip of nothing varies by nothing.
    assert not said(BASE, ["motion.pga=0.05g"])


def test_the_verdict_has_the_range():
    case = read_case(BASE)
    response = with_spread(rigid(case), case)
    low, high = (1e3 * response.spread["residual_slip_m"][name] for name in ("min", "max"))
    assert f"({low:.1f} mm to {high:.1f} mm with the shaking varied by 1 %)" in verdict(response)
    assert response.to_json()["spread"]["runs"] == 11
    assert response.to_json()["spread"]["residual_slip_m"]["min"] < response.residual_slip_m


@pytest.mark.parametrize("runs", [1, 0, -3, 1001, "eleven", "", "2.5", 2.5, True, "١١", "9" * 5000])
def test_numbers_of_runs_that_are_none(runs):
    with pytest.raises(InputError) as refused:
        check_runs(runs, "--spread")
    assert refused.value.code == "out-of-range"


def test_numbers_of_runs():
    assert [check_runs(runs, "") for runs in (2, "11", " 1000 ")] == [2, 11, 1000]


def test_openings_of_the_spread_are_those_of_the_run():
    # Under rotations of any size the crack opens with their sine, by no more than its width: 1 m.
    case = read_case(SLENDER)
    response = with_spread(rigid(case), case, 3)
    for name, gap in (("opening_upstream_m", "gap_heel_m"), ("opening_downstream_m", "gap_toe_m")):
        assert response.spread[name]["max"] <= 1.0
        # The run as it is is one of the three.
        same = response.spread[name]
        assert same["min"] <= response.summary[name] <= same["max"]
        assert response.summary[name] == pytest.approx(response.histories[gap].max(), rel=1e-3)
