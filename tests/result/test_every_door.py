"""A dam whose rotation is too large has one answer by every door."""

from __future__ import annotations

import pytest

import heeltoe
from heeltoe import read_case, verdict
from heeltoe.app.response_payload import drawn
from heeltoe.case.toml_writer import case_text
from heeltoe.study.small.solve import solve
from shared.command import command

# A block of 1 m by 4 m in a pulse that turns it over: small rotations cannot say so.
BLOCK = {
    "title": "A slender block",
    "section": {"polygon": [["0 m", "0 m"], ["1 m", "0 m"], ["1 m", "4 m"], ["0 m", "4 m"]]},
    "crack": {"elevation": "0 m", "friction": 1.0, "restitution": 0.0},
    "limits": {"residual_slip": "10 mm", "rotation": 0.5},
    "motion": {"points": [["0 s", "1 g"], ["0.6 s", "1 g"], ["0.6 s", "0 g"], ["2 s", "0 g"]]},
}
STUDY = """
case = "case.toml"
method = "grid"
model = ["rigid"]
[vary]
"crack.friction" = [1.0, 1.2]
[fragility]
limits = { residual_slip = ["10 mm"], rotation = ["0.5 rad"] }
"""


@pytest.fixture(scope="module")
def case():
    return read_case(BLOCK)


def test_run_says_that_no_limit_is_met(case):
    response = heeltoe.run(case)
    assert response.outcome == "large rotation"
    assert [(check.name, check.value, check.met) for check in response.limits] == [
        ("residual_slip", None, False),
        ("rotation", None, False),
    ]
    assert verdict(response).endswith("No limit is met: the dam rotates by more than 0.1 rad, which is not small.")


def test_the_app_says_the_same(case):
    headline = drawn(heeltoe.run(case), "si")["headline"]
    assert (headline["value"], headline["state"]) == ("Large rotation", "failed")
    assert [row["state"] for row in headline["limits"]] == ["failed", "failed"]


def test_solve_finds_no_value_that_meets_the_limit(case):
    solved = solve(case, "crack.friction", "residual_slip = 10 mm", between=(0.9, 1.1))
    assert not solved.crossings
    assert {(point.outcome, point.met, point.result_m) for point in solved.points} == {("large rotation", False, None)}


@pytest.fixture(scope="module")
def study(case, tmp_path_factory):
    folder = tmp_path_factory.mktemp("doors")
    (folder / "case.toml").write_text(case_text(case.model_dump(mode="json", exclude_unset=True)), encoding="utf-8")
    (folder / "study.toml").write_text(STUDY, encoding="utf-8")
    return heeltoe.run_study(folder / "study.toml", folder / "out"), folder


def test_a_study_says_the_same(study):
    results, _ = study
    (row,) = results.summary
    assert row["outcomes"] == {"large rotation": 2}
    assert row["limits_not_met"] == {"residual_slip": 2, "rotation": 2}
    assert [(curve["exceeding"], curve["unknown"]) for curve in results.fragility] == [(2, 0), (2, 0)]


def test_the_words_of_a_study_do_not_contradict_themselves(study):
    from heeltoe.views.content.study import study_answer

    text = study_answer(study[0], "si")
    assert "None of 2 runs has a result" in repr(text)
    assert "slide more than a joint meter reads" not in repr(text)


def test_a_suite_says_the_same(case, tmp_path):
    time = [f"{0.01 * k:.2f}\t{9.81 if k <= 60 else 0.0}" for k in range(200)]
    (tmp_path / "pulse.txt").write_text("time (s)\tacceleration (m/s2)\n" + "\n".join(time), encoding="utf-8")
    (answer,) = heeltoe.run_suite(case, tmp_path, model="rigid").suite["models"]
    assert {record["outcome"] for record in answer["records"]} == {"large rotation"}
    assert [limit["met"] for limit in answer["limits"]] == [False, False]


def test_the_exit_code_is_that_of_the_outcome(study):
    assert command("run", study[1] / "case.toml").returncode == heeltoe.run(read_case(BLOCK)).outcome.exit_code == 3


@pytest.mark.parametrize("text", [0.01, "0.01", "0.01 rad", "10 mrad"])
def test_a_limit_on_rotation_has_one_grammar(text):
    from heeltoe.study.plan.file import FragilityLimits

    alone = read_case({**BLOCK, "limits": {"rotation": text}}).limits.rotation
    assert alone == pytest.approx(0.01)
    assert FragilityLimits(rotation=text).rotation == pytest.approx((0.01,))
