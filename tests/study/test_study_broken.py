"""A study that is killed, and workers that are: nothing is lost, nothing is run twice, the bits are the same."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest

from heeltoe import open_study, run_study
from shared.studies import BLOCK, DRAWN, rows, study_file

pytestmark = pytest.mark.slow

HEELTOE = [sys.executable, "-m", "heeltoe"]


@pytest.mark.product
def test_ten_kills_change_nothing(tmp_path):
    text = DRAWN.replace("samples = 60", "samples = 100000").replace(
        '"crack.friction"', '"uplift.pattern" = ["none"]\n"crack.friction"'
    )
    file = study_file(tmp_path, text.split("[fragility]")[0])
    whole = open_study(run_study(file, tmp_path / "whole").store.directory).to_table()
    out, random, kills = tmp_path / "out", np.random.default_rng(1), 0
    for _ in range(60):
        running = subprocess.Popen(
            [*HEELTOE, "study", str(file), "--out", str(out), *(["--resume"] if (out / "study.json").exists() else [])],
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        try:
            # Most of it is over when the parts begin; the kills go on until there have been ten.
            running.wait(random.uniform(0.8, 3.0) if kills < 10 else None)
        except subprocess.TimeoutExpired:
            running.send_signal(signal.SIGKILL)
            running.wait()
            kills += 1
            continue
        assert running.returncode in (0, 3)
        if kills >= 10:
            break
        # It came to its end too soon: some of its parts are lost, as on a disk that loses some.
        for path in sorted((out / "runs").glob("part-*.parquet"))[1::2]:
            path.unlink()
    assert kills == 10
    study = open_study(out)
    assert study.complete
    assert study.to_table().equals(whole)
    assert not [path for path in out.rglob(".heeltoe-*") if path.is_dir()]


PLAIN = """
import heeltoe
print("once")
study = heeltoe.run_study("study.toml", "out")
print(study.complete, __file__)
"""


@pytest.mark.parametrize("words", [("script.py",), ("-m", "script")], ids=["a script", "a module"])
def test_a_plain_script_runs_an_elastic_study(tmp_path, words):
    """As docs/studies.md shows it, without a guard: workers do not run the script once more."""
    text = DRAWN.replace("samples = 60", 'model = "decoupled"\nsamples = 4').split("[fragility]")[0]
    text = text.replace(
        '"crack.restitution"', '"concrete.modulus" = { from = "20 GPa", to = "25 GPa" }\n"crack.restitution"'
    )
    case = BLOCK.replace("[crack]", '[concrete]\nmodulus = "20 GPa"\n[crack]\nelevation = "4 m"')
    study_file(tmp_path, text, case=case)
    (tmp_path / "script.py").write_text(PLAIN)
    ended = subprocess.run(
        [sys.executable, *words], capture_output=True, text=True, cwd=tmp_path, timeout=120, check=False
    )
    assert ended.stdout.split() == ["once", "True", str(tmp_path / "script.py")], ended.stderr
    assert ended.returncode == 0


def test_a_scheduler_without_workers_is_one_sentence(tmp_path):
    log = tmp_path / "log"
    with log.open("w") as file:
        scheduler = subprocess.Popen(
            [str(Path(sys.executable).with_name("dask")), "scheduler", "--port", "0", "--no-dashboard"],
            stdout=file,
            stderr=file,
            cwd=tmp_path,
        )
    try:
        address = None
        for _ in range(300):
            if match := re.search(r"Scheduler at:\s+(tcp://\S+)", log.read_text()):
                address = match[1]
                break
            time.sleep(0.1)
        assert address
        file = study_file(tmp_path, DRAWN)
        ended = subprocess.run(
            [*HEELTOE, "study", str(file), "--out", str(tmp_path / "out"), "--scheduler", address],
            capture_output=True,
            text=True,
            check=False,
            timeout=120,
        )
    finally:
        scheduler.kill()
        scheduler.wait()
    assert ended.returncode == 2
    (line,) = ended.stderr.splitlines()
    assert "has had no worker for 4 s" in line
    assert f"dask worker {address}" in line
    assert not (tmp_path / "out").exists()


@pytest.fixture
def cluster(tmp_path):
    """A scheduler and two workers, each a process that was started by hand."""
    environment = {**os.environ, "DASK_DISTRIBUTED__COMM__TIMEOUTS__CONNECT": "60s"}
    started = []

    def start(*arguments):
        path = tmp_path / f"{len(started)}.log"
        command = [str(Path(sys.executable).with_name("dask")), *arguments]
        with path.open("w") as log:
            started.append(subprocess.Popen(command, stdout=log, stderr=log, env=environment, cwd=tmp_path))
        return path

    log = start("scheduler", "--port", "0", "--no-dashboard")
    address = None
    for _ in range(300):
        match = re.search(r"Scheduler at:\s+(tcp://\S+)", log.read_text())
        if match:
            address = match[1]
            break
        time.sleep(0.1)
    assert address, log.read_text()
    for _ in range(2):
        start("worker", address, "--nthreads", "1", "--no-dashboard")
    yield address, started
    for item in started:
        item.kill()
        item.wait()


@pytest.mark.parametrize("kill", [False, True], ids=["two workers", "one of them killed"])
def test_workers_started_by_hand_give_the_same_table(tmp_path, cluster, kill, monkeypatch):
    address, started = cluster
    monkeypatch.setattr("heeltoe.study.run.run.MOST_OF_PART", 500)
    file = study_file(tmp_path, DRAWN.replace("samples = 60", "samples = 12000"))
    here = rows(run_study(file, tmp_path / "here"))
    answer = []

    def progress(each):
        answer.append(each)
        if kill and len(answer) == 4:
            started[2].kill()

    there = run_study(file, tmp_path / "there", scheduler=address, progress=progress)
    assert rows(there) == here
    assert answer[-1].done == 12000


def test_a_scheduler_that_is_lost_is_one_sentence_and_exit_3(tmp_path, cluster):
    """What is done stays, and the study goes on without it."""
    address, started = cluster
    text = DRAWN.replace("samples = 60", "samples = 200000")
    file, out = study_file(tmp_path, text), tmp_path / "out"
    running = subprocess.Popen(
        [*HEELTOE, "study", str(file), "--out", str(out), "--scheduler", address, "--no-figures"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    while not list(out.glob("runs/part-*.parquet")) and running.poll() is None:
        time.sleep(0.05)
    started[0].kill()
    _, words = running.communicate(timeout=240)
    assert running.returncode == 3, words
    assert "Traceback" not in words
    # The first line announces the time of the study.
    *_, line = [line for line in words.splitlines() if line.startswith("heeltoe:")]
    assert "the scheduler or all of its workers are gone" in line
    assert "--resume" in line
