"""What a study says that it will take: runs from all over it are tried, not the first alone."""

from __future__ import annotations

import pytest

from heeltoe import read_study
from heeltoe.study.plan.plan import plan_of
from heeltoe.study.run import run
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
