"""What a study says that it will take: runs from all over it are tried, not the first alone."""

from __future__ import annotations

import pytest

from heeltoe import read_study
from heeltoe.base.cache import Kept
from heeltoe.models.cost import Cost
from heeltoe.study.plan.plan import plan_of
from heeltoe.study.run import run
from heeltoe.study.run.run import Progress
from heeltoe.views.terminal.study import progress_text
from shared.studies import GRID, study_file

CLOCK = {"now": 0.0}


@pytest.fixture
def tried(monkeypatch):
    """The stretches that are tried; each run takes the longer the later its motion stands."""
    result = []
    CLOCK["now"] = 0.0

    def timed(plan, start, stop):
        result.append((start, stop))
        runs = plan.runs(start, stop)
        CLOCK["now"] += float((runs.motion + 2.0).sum()) / 100.0

    monkeypatch.setattr(run, "run_part", timed)
    monkeypatch.setattr(run, "monotonic", lambda: CLOCK["now"])
    return result


def plan(tmp_path, model):
    return plan_of(read_study(study_file(tmp_path, GRID.replace("[vary]", f"model = {model}\n[vary]"))))


def test_elastic_runs_are_tried_all_over_the_study(tmp_path, tried):
    study = plan(tmp_path, '["rigid", "flexible"]')
    expected = run.outlook(study, 1)
    _, *stretches = tried
    assert len(set(stretches)) == len(stretches) == 8
    assert all(stop - start == 2 and start % 2 == 0 and stop <= study.count for start, stop in stretches)
    runs = study.runs(0, study.count)
    assert len({int(runs.motion[start]) for start, _ in stretches}) == len(study.shakes)
    exact = float((runs.motion + 2.0).mean()) / 100.0
    assert expected.seconds_per_run == pytest.approx(exact, rel=0.25)


def test_tries_end_where_runs_are_long(tmp_path, tried, monkeypatch):
    monkeypatch.setattr(run, "_PATIENCE", 0.01)
    run.outlook(plan(tmp_path, '["flexible"]'), 1)
    assert len(tried) == 2


def test_blocks_are_tried_together(tmp_path, tried):
    study = plan(tmp_path, '["rigid"]')
    run.outlook(study, 1)
    assert tried == [(0, 1), (0, study.count)]


def test_a_form_tries_one_run_of_a_dam_and_counts_what_comes_before_the_runs(tmp_path, tried, monkeypatch):
    monkeypatch.setattr(run, "_SPEEDS", Kept(4))
    monkeypatch.setattr(
        run, "analysing", lambda case, *_: Cost(0.01 if case.flexible.evidence == "none" else 0.06, 0.0)
    )
    study = plan(tmp_path, '["flexible"]')
    first = run.quick_outlook(study, 2)
    # A run of the first motion takes 0.02 s here, twice what is estimated; all others are estimated by that.
    assert tried == [(0, 1), (0, 1)]
    assert first.seconds_per_run == pytest.approx(0.02)
    signs = sum(shake.horizontal is study.shakes[0].horizontal for shake in study.shakes)
    assert first.seconds == pytest.approx(run._START + signs * 0.12 + study.count * 0.02 / 2)
    run.quick_outlook(study, 2)
    assert len(tried) == 2
    # What is long is not tried.
    monkeypatch.setattr(run, "analysing", lambda *_: Cost(100.0, 0.0))
    assert run.quick_outlook(study, 2).seconds_per_run == 100.0
    assert len(tried) == 2


def test_slow_runs_are_counted_by_the_minute():
    assert progress_text(Progress(3, 22, 0, 0.5)) == "30 runs/min, about 38 s left"
    assert progress_text(Progress(21, 22, 0, 2.0)) == "2 runs/s, less than 1 s left"
