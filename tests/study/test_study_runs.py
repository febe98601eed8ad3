"""The runs of a study: each the one that a user could make by hand, the same bits whoever runs it, and none lost."""

from __future__ import annotations

import errno
import json
import shutil
from concurrent.futures import Future
from pathlib import Path

import pytest
from distributed.comm.core import CommClosedError

from heeltoe import InputError, flexible, open_study, read_case, read_study, rigid, run_study
from heeltoe.errors.error import UnfinishedError
from heeltoe.models.run import decoupled
from heeltoe.motion.records.read import read_record
from heeltoe.study.plan.plan import plan_of
from heeltoe.study.run import batches as parts
from heeltoe.study.run.schedule import run_on_workers
from heeltoe.study.run.store import Store
from shared.dams import TYPICAL_SECTION
from shared.studies import DRAWN, GRID, rows, study_file

ELASTIC = """
title = "A coarse dam"
rock = "rigid"
[section]
{section}
[concrete]
modulus = "20 GPa"
[crack]
elevation = "{level} m"
friction = 0.6
[reservoir]
depth = "90 m"
compressible = false
[flexible]
elements_across = 2
evidence = "none"
"""


def elastic(level=0):
    section = "\n".join(f'{name} = "{value}"' for name, value in TYPICAL_SECTION.items())
    return ELASTIC.format(section=section, level=level)


def by_hand(folder, run, model):
    case = read_case(folder / "case.toml", {name: run[name] for name in ("crack.friction", "crack.restitution")})
    motion = read_record(folder / "quakes" / f"{run['motion']}.txt").scaled(run["factor"])
    return model(case, motion.reversed() if run["reversed"] else motion)


def test_each_rigid_run_is_the_one_by_hand(tmp_path):
    study = run_study(study_file(tmp_path, GRID), tmp_path / "out")
    table = rows(study)
    assert len(table) == 60
    assert study.complete
    assert sum(abs(run["residual_slip_m"]) > 1e-3 for run in table) > 10
    for run in table[::7]:
        response = by_hand(tmp_path, run, rigid)
        for name in ("residual_slip_m", "peak_slip_upstream_m", "rocking_downstream_rad", "opening_downstream_m"):
            assert run[name] == pytest.approx(getattr(response, name), rel=1e-9, abs=1e-12)
        assert run["impacts"] == response.impacts
        assert run["outcome"] == response.outcome


def test_columns_and_single_cases_give_the_same(tmp_path, monkeypatch):
    plan = plan_of(read_study(study_file(tmp_path, GRID)))
    together = parts.run_part(plan, 0, 60).to_pylist()
    monkeypatch.setattr(parts, "COLUMNS", ())
    alone = parts.run_part(plan, 0, 60).to_pylist()
    for one, other in zip(together, alone, strict=True):
        assert one["residual_slip_m"] == pytest.approx(other["residual_slip_m"], rel=1e-9, abs=1e-12)


def test_blocks_that_change_as_they_move_run_one_by_one(tmp_path):
    text = GRID.replace("[0.3, 0.5]", "[0.9]").replace("[vary]", '[vary]\n"analysis.rotation" = ["small", "finite"]')
    study = run_study(study_file(tmp_path, text), tmp_path / "out")
    run = next(run for run in rows(study) if run["analysis.rotation"] == "finite" and run["impacts"] > 0)
    case = read_case(tmp_path / "case.toml", {name: run[name] for name in run if "." in name})
    motion = read_record(tmp_path / "quakes" / f"{run['motion']}.txt").scaled(run["factor"])
    assert run["residual_slip_m"] == pytest.approx(rigid(case, motion).residual_slip_m, rel=1e-9, abs=1e-12)


SMALL = """
case = "case.toml"
model = {model}
[vary]
"crack.friction" = [0.5, 0.7]
[motions]
both_signs = false
files = ["quakes/quake-a-000.txt", "quakes/quake-b-090.txt"]
scale = {{ measure = "pga", values = ["0.3 g", "0.6 g"] }}
"""


ICE = """"ice.force" = ["100 kN/m"]
"ice.depth" = ["0.5 m", "3 m"]
"reservoir.depth" = ["90 m", "2 m"]"""


def test_elastic_runs_are_those_by_hand(tmp_path):
    text = SMALL.format(model='["rigid", "decoupled", "flexible"]')
    plan = plan_of(read_study(study_file(tmp_path, text, case=elastic(level=60))))
    table = parts.run_part(plan, 0, plan.count).to_pylist()
    assert len(table) == 24
    models = {"rigid": rigid, "decoupled": decoupled, "flexible": flexible}
    for run in table[-6:]:
        case = read_case(tmp_path / "case.toml", {"crack.friction": run["crack.friction"]})
        motion = read_record(tmp_path / "quakes" / f"{run['motion']}.txt").scaled(run["factor"])
        response = models[run["model"]](case, motion)
        # Where an elastic dam by itself ends its silence earlier the rest of it moves by no more than this.
        assert run["residual_slip_m"] == pytest.approx(response.residual_slip_m, rel=1e-4, abs=1e-6)


@pytest.mark.slow
def test_the_same_bits_whatever_the_parts_and_whoever_runs_them(tmp_path):
    plan = plan_of(read_study(study_file(tmp_path, SMALL.format(model='["rigid", "flexible"]'), case=elastic())))
    whole = parts.run_part(plan, 0, plan.count, threads=0).to_pylist()
    pieces = [run for start in range(0, plan.count, 3) for run in parts.run_part(plan, start, start + 3).to_pylist()]
    assert pieces == whole
    stretches = [(number, 5 * number, min(5 * number + 5, plan.count)) for number in range(4)]
    (tmp_path / "work" / ".workers-left").mkdir(parents=True)
    worked = dict(run_on_workers(plan, stretches, tmp_path / "work"))
    assert not list((tmp_path / "work").iterdir())
    assert [run for part in sorted(worked) for run in worked[part].to_pylist()] == whole


def test_a_study_goes_on_where_it_stopped(tmp_path, monkeypatch):
    file = study_file(tmp_path, DRAWN)
    whole = rows(run_study(file, tmp_path / "whole"))
    monkeypatch.setattr("heeltoe.study.run.run.MOST_OF_PART", 7)
    out = tmp_path / "out"
    done = []

    def stop(progress):
        done.append(progress)
        if len(done) == 3:
            raise KeyboardInterrupt

    with pytest.raises(KeyboardInterrupt):
        run_study(file, out, progress=stop)
    half = open_study(out)
    assert not half.complete
    assert "parts missing" in repr(half)
    assert rows(half) == whole[: len(rows(half))]
    with pytest.raises(InputError) as refused:
        run_study(file, out)
    assert refused.value.code == "study-begun"
    ran = []
    monkeypatch.setattr("heeltoe.study.run.schedule.run_part", lambda *a, **b: ran.append(a) or parts.run_part(*a, **b))
    assert rows(run_study(file, out, resume=True)) == whole
    assert len(ran) == half.store.parts - 3
    assert rows(run_study(file, out, resume=True)) == whole
    assert len(ran) == half.store.parts - 3
    # What took how long is kept, of all that ran.
    before, after = half.manifest["seconds"], open_study(out).manifest["seconds"]
    assert set(before) == set(after) == {"sampling", "blocks", "kernel", "tables", "writing"}
    assert all(0.0 <= before[name] <= after[name] for name in before)


@pytest.mark.parametrize(
    ("change", "said"),
    [
        (lambda folder: (folder / "study.toml").write_text(DRAWN.replace("seed = 7", "seed = 8")), "the study's seed"),
        (
            lambda folder: (folder / "quakes" / "quake-a-000.txt").write_text(
                (folder / "quakes" / "quake-a-000.txt").read_text() + "0.1\n"
            ),
            "the motion quake-a-000",
        ),
        (
            lambda folder: (folder / "case.toml").write_text(
                (folder / "case.toml").read_text() + '\n[uplift]\npattern = "none"\n'
            ),
            "the case's uplift",
        ),
    ],
    ids=["study", "record", "case"],
)
def test_inputs_that_have_changed_are_noticed_and_said(tmp_path, change, said):
    file = study_file(tmp_path, DRAWN)
    run_study(file, tmp_path / "out")
    change(tmp_path)
    with pytest.raises(InputError) as refused:
        run_study(file, tmp_path / "out", resume=True)
    assert refused.value.code == "study-other"
    assert said in str(refused.value)


def test_a_full_disk_is_one_line_and_a_study_to_go_on_with(tmp_path, monkeypatch):
    file = study_file(tmp_path, DRAWN)
    whole = rows(run_study(file, tmp_path / "whole"))
    monkeypatch.setattr("heeltoe.study.run.run.MOST_OF_PART", 11)
    write, wrote = Path.write_bytes, []

    def full(path, content):
        wrote.append(path)
        if len(wrote) == 3:
            write(path, content[: len(content) // 2])
            raise OSError(errno.ENOSPC, "No space left on device")
        return write(path, content)

    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.raises(InputError, match="No space left on device"):
        run_study(file, tmp_path / "out")
    assert len(list((tmp_path / "out" / "runs").iterdir())) == 2
    monkeypatch.setattr(Path, "write_bytes", write)
    assert rows(run_study(file, tmp_path / "out", resume=True)) == whole


@pytest.mark.parametrize("model", ["rigid", "flexible"])
def test_a_dam_that_the_case_refuses_is_counted(tmp_path, model):
    # Ice that acts below the bottom of the water, in a quarter of the dams.
    text = SMALL.format(model=f'["{model}"]').replace('"crack.friction" = [0.5, 0.7]', ICE)
    plan = plan_of(read_study(study_file(tmp_path, text, case=elastic())))
    table = parts.run_part(plan, 0, plan.count).to_pylist()
    refused = [run for run in table if run["outcome"] == "refused"]
    assert len(table) == 16
    assert len(refused) == 4
    assert all(run["reservoir.depth"] == 2.0 and run["ice.depth"] == 3.0 for run in refused)
    assert all(run["residual_slip_m"] is None for run in refused)
    assert {run["outcome"] for run in table if run not in refused} <= {"ok", "unstable"}
    assert sum(run["outcome"] == "ok" for run in table) >= 4


def test_what_is_no_study_is_refused(tmp_path):
    with pytest.raises(InputError) as refused:
        open_study(tmp_path)
    assert refused.value.code == "study-not-there"
    (tmp_path / "study.json").write_text("{}")
    with pytest.raises(InputError) as refused:
        open_study(tmp_path)
    assert refused.value.code == "source-unreadable"
    (tmp_path / "study.json").write_text(json.dumps({"version": 99}))
    with pytest.raises(InputError) as refused:
        open_study(tmp_path)
    assert refused.value.code == "study-version"


def test_files_of_somebody_else_are_left_alone(tmp_path):
    file = study_file(tmp_path, GRID)
    (tmp_path / "out" / "runs").mkdir(parents=True)
    (tmp_path / "out" / "runs" / "mine.txt").write_text("mine")
    with pytest.raises(InputError) as refused:
        run_study(file, tmp_path / "out")
    assert refused.value.code == "not-ours"
    assert (tmp_path / "out" / "runs" / "mine.txt").read_text() == "mine"


def test_no_scheduler_and_no_package_are_said(tmp_path, monkeypatch):
    plan = plan_of(read_study(study_file(tmp_path, GRID)))
    with pytest.raises(InputError) as refused:
        list(run_on_workers(plan, [(0, 0, 1)], tmp_path, "nowhere://1"))
    assert refused.value.code == "study-scheduler"
    with pytest.raises(InputError, match="there is no scheduler at nowhere://1"):
        run_study(tmp_path / "study.toml", tmp_path / "out", scheduler="nowhere://1")
    assert not (tmp_path / "out").exists()
    monkeypatch.setattr("heeltoe.study.run.schedule.find_spec", lambda name: None)
    with pytest.raises(InputError) as refused:
        list(run_on_workers(plan, [(0, 0, 1)], tmp_path))
    assert refused.value.code == "package-missing"


class LostScheduler:
    """A client that has sent its work when the scheduler goes."""

    def scatter(self, plan, **_):
        return plan

    def scheduler_info(self):
        return {"workers": {}}

    def submit(self, *_, **__):
        future = Future()
        future.set_exception(CommClosedError("gone"))
        return future

    def close(self, **_):
        pass


class Completed(list):
    """What the work of :class:`LostScheduler` has come to."""

    def __init__(self, **_):
        super().__init__()

    def add(self, future):
        self.append((future, future.exception()))


def test_a_lost_scheduler_is_no_fault_of_the_input(tmp_path, monkeypatch):
    monkeypatch.setattr("heeltoe.study.run.schedule._reached", lambda address: LostScheduler())
    monkeypatch.setattr("distributed.as_completed", Completed)
    plan = plan_of(read_study(study_file(tmp_path, GRID)))
    with pytest.raises(UnfinishedError, match="CommClosedError") as lost:
        list(run_on_workers(plan, [(0, 0, 1)], tmp_path, "tcp://gone:1"))
    assert lost.value.code == "study-lost"
    assert "--resume" in str(lost.value)


class IdleScheduler(LostScheduler):
    """A client of a scheduler to which no worker comes."""

    def wait_for_workers(self, count, timeout):
        raise TimeoutError(f"{count} worker in {timeout} s")


def test_a_scheduler_without_workers_is_refused_before_anything_is_written(tmp_path, monkeypatch):
    monkeypatch.setattr("heeltoe.study.run.schedule._reached", lambda address: IdleScheduler())
    file = study_file(tmp_path, GRID)
    with pytest.raises(InputError) as refused:
        run_study(file, tmp_path / "out", scheduler="tcp://idle:1")
    assert refused.value.code == "study-no-workers"
    assert not (tmp_path / "out").exists()


def test_the_store_knows_its_stretches(tmp_path):
    store = Store(tmp_path, 10, 4, "", {}, {})
    assert [store.stretch(part) for part in range(store.parts)] == [(0, 4), (4, 8), (8, 10)]


def test_killed_before_its_first_run_a_study_begins_again(tmp_path):
    file, out = study_file(tmp_path, DRAWN), tmp_path / "out"
    (out / "runs").mkdir(parents=True)
    first = rows(run_study(file, out))
    shutil.rmtree(out / "runs")
    assert rows(run_study(file, out, resume=True)) == first


def test_a_folder_that_is_not_ours_stays(tmp_path):
    file, out = study_file(tmp_path, DRAWN), tmp_path / "out"
    (out / "runs").mkdir(parents=True)
    (out / "runs" / "mine.txt").write_text("mine")
    with pytest.raises(InputError) as caught:
        run_study(file, out)
    assert caught.value.code == "not-ours"


@pytest.mark.parametrize("damage", [lambda whole: whole[: len(whole) // 2], lambda _: b""], ids=["half", "empty"])
def test_a_damaged_part_is_computed_anew_and_said(tmp_path, damage, monkeypatch):
    monkeypatch.setattr("heeltoe.study.run.run.MOST_OF_PART", 20)
    file, out = study_file(tmp_path, DRAWN), tmp_path / "out"
    first = rows(run_study(file, out))
    part = sorted((out / "runs").glob("part-*.parquet"))[1]
    part.write_bytes(damage(part.read_bytes()))
    again = run_study(file, out, resume=True)
    assert rows(again) == first
    assert any("1 of the files in runs/ were damaged" in warning for warning in again.manifest["warnings"])
