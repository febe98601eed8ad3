"""The value of a field at which a limit is just met: against a closed form, by both signs, where the curve turns."""

from __future__ import annotations

import json
from itertools import pairwise

import numpy as np
import pytest

import heeltoe
from heeltoe.case.toml_writer import case_text
from heeltoe.errors.error import InputError
from heeltoe.study.small.solve import _goes_one_way, solve
from heeltoe.study.small.solved import Point
from heeltoe.views.content.solve import solve_answer
from shared.command import command
from shared.dams import example

#: A block on a flat crack, without water, in a rectangular pulse of 0.8 g for 0.1 s: Newmark's block.
PULSE = {
    "title": "A block",
    "section": {"polygon": [["0 m", "0 m"], ["40 m", "0 m"], ["40 m", "4 m"], ["0 m", "4 m"]]},
    "concrete": {"density": "2400 kg/m^3"},
    "crack": {"friction": 0.5},
    "gravity": "9.81 m/s^2",
    "motion": {"points": [["0 s", "0.8 g"], ["0.1 s", "0.8 g"], ["0.1 s", "0 g"], ["2 s", "0 g"]]},
}


def newmark_slip(friction, peak=0.8, duration=0.1, gravity=9.81):
    """Slip of a block after a rectangular pulse: v^2 / 2 (1 / (mu g) - 1 / A), with its velocity v (Newmark 1965)."""
    velocity = peak * gravity * duration
    return velocity**2 / 2.0 * (1.0 / (friction * gravity) - 1.0 / (peak * gravity))


def test_the_friction_of_a_sliding_block_is_that_of_newmark():
    limit = newmark_slip(0.37)
    solution = solve(PULSE, "crack.friction", f"residual_slip = {limit!r} m", between=(0.2, 0.7))
    (crossing,) = solution.crossings
    assert crossing.value == pytest.approx(0.37, abs=crossing.give_or_take)
    assert crossing.give_or_take <= 2.0e-4 * 0.5
    assert crossing.met_at > crossing.missed_at
    assert crossing.last.met
    assert solution.one_way
    # Away from the crossing the curve is the closed form, too.
    for point in solution.points:
        if point.value < 0.7:
            assert point.result_m == pytest.approx(newmark_slip(point.value), rel=1e-9)


def test_the_peak_comes_from_both_signs_and_in_g():
    case = example("typical-base")
    solution = solve(case, "motion.pga", "residual_slip = 50 mm", model="rigid", between=("0.2 g", "0.5 g"))
    (crossing,) = solution.crossings
    for value, met in ((crossing.met_at, True), (crossing.missed_at, False)):
        ways = heeltoe.run(case.with_({"motion.pga": f"{value!r} m/s^2"}), "rigid").signs
        assert (max(abs(way.residual_slip_m) for way in ways) <= 0.05) == met
        assert len(ways) == 2


@pytest.mark.slow
def test_the_evidence_of_an_elastic_dam_is_carried_over():
    case = example("typical-base", "flexible.elements_across=4", "motion.duration=4 s", "flexible.evidence=step")
    solution = solve(case, "crack.friction", "residual_slip = 200 mm", between=(0.9, 1.3))
    (crossing,) = solution.crossings
    last = heeltoe.run(case.with_({"crack.friction": crossing.value}), "flexible")
    assert solution.model == "flexible"
    assert abs(last.residual_slip_m) == pytest.approx(crossing.last.result_m, rel=1e-12)
    assert crossing.last.uncertainty_m == last.evidence["residual_slip_m"]["uncertainty"] > 0.0
    assert crossing.last.result_m == pytest.approx(0.2, rel=0.02)
    slopes = [
        abs((first.result_m - second.result_m) / (first.value - second.value))
        for first, second in pairwise(p for p in solution.points if p.result_m is not None)
        if abs(first.value - second.value) > 0.02
    ]
    assert crossing.last.uncertainty_m / max(slopes) < crossing.give_or_take
    assert crossing.give_or_take < 0.02 + crossing.last.uncertainty_m / min(slope for slope in slopes if slope)


@pytest.mark.slow
def test_a_curve_that_turns_is_said_to_and_crosses_more_than_once():
    def points(*results):
        return [Point(value=k, result_m=result, met=True, sign="", outcome="ok") for k, result in enumerate(results)]

    assert _goes_one_way(points(0.0, 0.1, 0.2, None))
    assert _goes_one_way(points(0.3, 0.1, 0.1001, 0.0))
    assert not _goes_one_way(points(0.0, 0.2, 0.1))
    assert not _goes_one_way(points(0.1, None, 0.1))
    # An elastic dam that slides less may swing back less.
    case = example("typical-base", "flexible.elements_across=4", "motion.duration=4 s", "flexible.evidence=none")
    solution = solve(case, "crack.friction", "residual_slip = 145 mm", between=(0.9, 1.3))
    assert not solution.one_way
    assert [crossing.met_at > crossing.missed_at for crossing in solution.crossings] == [True, False, True]
    values = [point.value for point in solution.points]
    assert values == sorted(values)
    assert solve_answer(solution, "si")[-1].title == "Not monotonic"


def test_a_dam_that_fails_beyond_the_limit_has_no_slope():
    case = example("typical-base", "motion.pga=0.05 g", "reservoir.depth=60 m")
    solution = solve(case, "crack.friction", "residual_slip = 1 m", model="rigid", between=(0.05, 1.0))
    (crossing,) = solution.crossings
    assert crossing.give_or_take is None or crossing.give_or_take < 0.01
    assert json.loads(json.dumps(solution.to_json(), allow_nan=False))


def test_a_range_without_a_crossing_has_no_answer(tmp_path):
    (tmp_path / "dam.toml").write_text(case_text(PULSE))
    more = ("--until", "residual_slip = 10 m", "--between", "0.3,0.6", "--out", "out")
    process = command("solve", "dam.toml", "crack.friction", *more, cwd=tmp_path)
    assert process.returncode == 3
    assert "is met in the whole range, 0.3 to 0.6" in " ".join(process.stdout.split())
    names = {f"solve.{ending}" for ending in ("csv", "json", "png", "svg")}
    assert names < {path.name for path in (tmp_path / "out").iterdir()}


def test_the_command_says_value_and_give_or_take(tmp_path):
    (tmp_path / "dam.toml").write_text(case_text(PULSE))
    more = ("--until", "residual_slip = 20 mm", "--json", "-", "--details")
    process = command("solve", "dam.toml", "crack.friction", *more, cwd=tmp_path)
    assert process.returncode == 0, process.stderr
    crossing = json.loads(process.stdout)["crossings"][0]
    assert newmark_slip(crossing["value"]) == pytest.approx(0.02, rel=1e-3)
    assert " ± " in process.stderr


@pytest.mark.parametrize(
    ("field", "until", "between", "code"),
    [
        ("crack.friction", "slip = 1 m", None, "not-a-choice"),
        ("crack.friction", "residual_slip", None, "not-a-choice"),
        ("crack.friction", "residual_slip = 0 m", None, "out-of-range"),
        ("title", "residual_slip = 1 m", None, "solve-field"),
        ("crack.frictoin", "residual_slip = 1 m", None, "unknown-field"),
        ("uplift.pattern", "residual_slip = 1 m", None, "solve-field"),
        ("flexible.elements_across", "residual_slip = 1 m", None, "solve-field"),
        ("tailwater.depth", "residual_slip = 1 m", None, "solve-no-range"),
        ("crack.friction", "residual_slip = 1 m", (0.5, 0.5), "wrong-quantity"),
        ("crack.friction", "residual_slip = 1 m", (-2.0, -1.0), "solve-range"),
    ],
)
def test_what_is_wrong_with_a_question_is_said(field, until, between, code):
    with pytest.raises(InputError) as error:
        solve(PULSE, field, until, between=between)
    assert error.value.code == code


def test_its_curve_is_drawn():
    solution = solve(PULSE, "crack.friction", "residual_slip = 20 mm")
    figure = solution.plot()
    (axes,) = figure.axes
    assert axes.get_xlabel() == "crack.friction"
    assert np.isclose(max(line.get_ydata()[0] for line in axes.lines if line.get_label() == "allowed"), 20.0)
