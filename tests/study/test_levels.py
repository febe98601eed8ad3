"""Criteria by level: a suite for each level of earthquake, judged by the limits of that level."""

from __future__ import annotations

import json

import pytest

import heeltoe
from heeltoe.errors.error import InputError
from heeltoe.study.plan.levels import read_levels
from heeltoe.study.run.levels import run_levels
from shared.command import command
from shared.dams import ROOT, example
from shared.studies import earthquakes

TWO = """
title = "Made up"
[[levels]]
return_period = 1000
pga = "0.2 g"
records = 3
judge = "mean"
[levels.limits]
residual_slip = "0 mm"
[[levels]]
return_period = 10000
pga = "0.7 g"
records = 7
damping = 0.1
factor = 1.0
residual_friction = 0.70
[levels.limits]
residual_slip = "1.2 m"
rotation = 0.01
"""
ONE_MORE = '[[levels]]\nreturn_period = 100\npga = "0.05 g"\n'


@pytest.fixture(scope="module")
def records(tmp_path_factory):
    return earthquakes(tmp_path_factory.mktemp("levels") / "quakes")


def written(folder, text):
    path = folder / "levels.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_each_level_is_the_suite_of_its_own_case(records, tmp_path):
    dam = example("typical-base", "flexible.evidence=none")
    first, last = run_levels(dam, read_levels(written(tmp_path, TWO)), records, model="rigid").levels
    for level, case, fields in (
        (first, dam.with_("limits.residual_slip=0mm"), {"pga": "0.2 g", "judge": "mean"}),
        (last, dam.with_("limits.residual_slip=1.2m", "limits.rotation=0.01"), {"pga": "0.7 g"}),
    ):
        (answer,) = heeltoe.run_suite(case, records, model="rigid", **fields).suite["models"]
        assert level.records == len(answer["records"]) == 5
        own = [check for check in level.checks if check.unit]
        assert [check.value for check in own] == [limit["value"] for limit in answer["limits"]]
        assert [check.met for check in own] == [limit["met"] for limit in answer["limits"]]
    assert first.enough
    assert not first.met  # it slips a little, and nothing is allowed
    slip = last.checks[0].value
    case = dam.with_("statics.residual_friction=0.70")
    (after,) = (one for one in heeltoe.statics(case, slip).cases if one.name == "post-seismic")
    assert last.checks[-1].value == after.sliding_factor
    assert last.checks[-1].met == (after.sliding_factor >= 1.0)


@pytest.mark.slow
def test_the_damping_of_a_level_is_that_of_its_runs(records, tmp_path):
    dam = example("typical-base", "flexible.elements_across=4", "flexible.evidence=none", "rock=rigid")
    text = '[[levels]]\nreturn_period = 1\npga = "0.7 g"\ndamping = 0.2\n[levels.limits]\nresidual_slip = "1 m"\n'
    (level,) = run_levels(dam, read_levels(written(tmp_path, text)), records, model="flexible").levels
    alone = dam.with_("concrete.damping=0.2", "limits.residual_slip=1m")
    suite = heeltoe.run_suite(alone, records, model="flexible", pga="0.7 g").suite
    assert level.checks[0].value == suite["models"][0]["limits"][0]["value"]


def test_a_suite_too_small_says_so_on_one_page_with_a_row_for_each_level(records, tmp_path):
    path = written(tmp_path, TWO + ONE_MORE)
    case, out = ROOT / "examples" / "typical-base.toml", tmp_path / "levels.json"
    reply = command("run", case, "--model", "rigid", "--motions", records, "--levels", path, "--json", out)
    assert reply.returncode == 0, reply.stderr
    for words in ("1,000 years", "10,000 years", "100 years", "the suite has 5, the criteria ask for 7 earthquakes"):
        assert words in reply.stdout
    assert "A level is not met" in reply.stdout
    data = json.loads(out.read_text())
    assert [level["enough"] for level in data["levels"]] == [True, False, True]
    assert [level["met"] for level in data["levels"]] == [False, False, True]
    assert not data["met"]
    assert not (tmp_path / "page").exists()
    reply = command(
        "run", case, "--model", "rigid", "--motions", records, "--levels", path, "--report", "--out", tmp_path / "page"
    )
    assert reply.returncode == 0, reply.stderr
    page = (tmp_path / "page" / "report.html").read_text(encoding="utf-8")
    for words in ("1,000 years", "10,000 years", "the criteria ask for 7 earthquakes", "A level is not met"):
        assert words in page.replace("\u00a0", " ")
    assert (tmp_path / "page" / "report.pdf").is_file()


def test_a_dam_that_fails_meets_no_level(records, tmp_path):
    dam = example("typical-base", "crack.friction=0.3")
    results = run_levels(dam, read_levels(written(tmp_path, TWO)), records, model="rigid")
    assert [check.value for check in results.levels[-1].checks] == [None, None, None]
    assert not results.met
    case = ROOT / "examples" / "typical-base.toml"
    more = ("--model", "rigid", "--motions", records, "--levels", tmp_path / "levels.toml")
    reply = command("run", case, *more, "--set", "crack.friction=0.3")
    assert reply.returncode == 3
    assert "none: the dam fails" in reply.stdout


@pytest.mark.parametrize(
    ("text", "words"),
    [
        ("title = 1\n", "title"),
        ("levels = []\n", "levels"),
        ('[[levels]]\npga = "0.2 g"\n', r"levels\[0\]\.return_period"),
        ('[[levels]]\nreturn_period = 10\npga = "0.2 g"\nsa = "0.3 g"\n', "sa"),
        ('[[levels]]\nreturn_period = 10\nperiod = "0.2 s"\n', "sa"),
        ("[[levels]]\nreturn_period = 10\nresidual_friction = 0.7\n", "factor"),
        ("[[levels]]\nreturn_period = 10\ncolour = 1\n", "colour"),
    ],
)
def test_criteria_that_cannot_be_used_are_refused(text, words, tmp_path):
    with pytest.raises(InputError, match=words):
        read_levels(written(tmp_path, text))


def test_a_file_that_is_not_there_and_options_of_one_suite_are_refused(records, tmp_path):
    case = ROOT / "examples" / "typical-base.toml"
    reply = command("run", case, "--motions", records, "--levels", tmp_path / "none.toml")
    assert reply.returncode == 2
    assert "there is no such file; give the path of a file of criteria by level" in reply.stderr
    path = written(tmp_path, TWO)
    reply = command("run", case, "--motions", records, "--levels", path, "--pga", "0.2g")
    assert reply.returncode == 2
    assert "does not belong to a suite for each level" in reply.stderr
    wrong = written(tmp_path, TWO.replace('pga = "0.2 g"', 'sa = "0.2 g"'))
    reply = command("run", case, "--model", "rigid", "--levels", wrong, "--set", "concrete.modulus=none")
    assert reply.returncode == 2
    assert "levels, 1000 years" in reply.stderr


def test_the_example_of_the_page_is_a_file_that_judges_a_dam(records):
    file = ROOT / "docs" / "levels.toml"
    page = (ROOT / "docs" / "suites.md").read_text(encoding="utf-8")
    shown = "".join(f"    {line}".rstrip() + "\n" for line in file.read_text(encoding="utf-8").splitlines())
    assert shown in page
    levels = read_levels(file)
    assert [level.return_period for level in levels.levels] == [1000, 5000, 10000]
    assert [level.limits.residual_slip for level in levels.levels] == [0.0, 0.6, 1.2]
    assert {level.residual_friction for level in levels.levels[1:]} == {0.7}  # tan 35 degrees
    results = run_levels(example("typical-base"), levels, records, model="rigid").levels
    assert [level.enough for level in results] == [True, False, False]


def test_a_level_may_have_its_own_uplift(records, tmp_path):
    drains = {"pattern": "drained", "drain_position": 0.1, "drain_efficiency": 0.667}
    dam = example("typical-base").with_({"uplift": drains, "statics.drain_diameter": "50 mm"})
    text = '[[levels]]\nreturn_period = 1\npga = "0.7 g"\nfactor = 0.1\n'
    (closed,) = run_levels(dam, read_levels(written(tmp_path, text)), records, model="rigid").levels
    own = text + 'closed_drains = "linear"\nduring_shaking = "zero while open"\n'
    (linear,) = run_levels(dam, read_levels(written(tmp_path, own)), records, model="rigid").levels
    assert linear.checks[-1].value > closed.checks[-1].value
    case = dam.with_({"statics.closed_drains": "linear", "uplift.during_shaking": "zero while open"})
    slip = heeltoe.run_suite(case, records, model="rigid", pga="0.7 g").suite["models"][0]
    (after,) = (
        one
        for one in heeltoe.statics(case, slip["statistics"]["residual_slip_m"]["largest"]).cases
        if one.name == "post-seismic"
    )
    assert linear.checks[-1].value == after.sliding_factor
    wrong = read_levels(written(tmp_path, own))
    with pytest.raises(InputError, match=r"levels, 1 years: statics\.closed_drains"):
        run_levels(example("typical-base"), wrong, records, model="rigid")
