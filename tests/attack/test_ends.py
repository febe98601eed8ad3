"""How a run ends before its time: by Ctrl-C, which runs on other threads hear of, or by a bug of a kernel."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest

import heeltoe
from heeltoe import InputError, read_case, run
from heeltoe.base.atomic_files import write_text
from heeltoe.case.fields_file import read_fields
from heeltoe.cli import main as command
from heeltoe.kernel import _kernel
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from heeltoe.models.flexible.evidence.trials import Trials
from heeltoe.models.flexible.model import Rested
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from shared.command import command as run_command
from shared.dams import BLOCK, example
from shared.studies import DRAWN, study_file


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="no timers that signal here")
def test_runs_with_evidence_end_at_once_and_say_how_far_they_have_come(monkeypatch):
    """Here they are threads; all would take half a minute."""
    prepare = Trials.prepare

    def alarmed(self, *arguments):
        signal.setitimer(signal.ITIMER_REAL, 0.5)
        prepare(self, *arguments)

    def handler(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(Trials, "prepare", alarmed)
    case = example("typical-base", "motion.duration=400s", "analysis.silence=0s", "motion.sign=recorded")

    def without(run, reach, through, most):
        """Leave out the run that shows whether the dam comes to rest."""
        return Rested(through, ShakenDam(case, build_flexible_dam(case), through.shaking), None, "ok", None)

    monkeypatch.setattr("heeltoe.models.flexible.model.until_rest", without)
    ends_at_once(case, handler)


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="no timers that signal here")
def test_both_signs_end_at_once_and_say_how_far_they_have_come():
    def handler(*_):
        raise KeyboardInterrupt

    case = example("typical-base", "motion.duration=400s", "analysis.silence=0s", "flexible.evidence=none")
    build_flexible_dam(case)
    ends_at_once(case, handler, after=2.0)


def ends_at_once(case, handler, after=0.0):
    """Run a case that a signal ends, so many seconds `after` its start or when a test sends it."""
    before = signal.signal(signal.SIGALRM, handler)
    try:
        begun = time.perf_counter()
        signal.setitimer(signal.ITIMER_REAL, after)
        with pytest.raises(KeyboardInterrupt) as raised:
            run(case, "flexible")
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)
    (note,) = raised.value.__notes__
    assert re.fullmatch(r"the run had come to \d+\.\d\d s of the earthquake and -?\d+\.\d mm of slip", note)
    assert time.perf_counter() - begun < 15.0


PANICS = [
    _kernel.InternalError("index out of bounds (src/walk.rs:7:1)"),
    type("PanicException", (BaseException,), {})("odd"),
]


@pytest.mark.parametrize("panic", PANICS, ids=lambda panic: type(panic).__name__)
def test_a_bug_of_a_kernel_is_one_line(panic, monkeypatch, capsys, tmp_path):
    def fail(*_):
        raise panic

    write_text(tmp_path / "before.json", "{}")
    monkeypatch.setattr(_kernel, "run_rigid", fail)
    monkeypatch.setattr("sys.argv", ["heeltoe", "run", str(BLOCK), "--json", str(tmp_path / "before.json")])
    with pytest.raises(SystemExit) as ended:
        command.main()
    streams = capsys.readouterr()
    assert (ended.value.code, streams.out) == (1, "")
    assert streams.err.startswith("heeltoe: this is a bug of its kernel: ")
    assert streams.err.count("\n") == 1
    assert "please report it" in streams.err
    assert (tmp_path / "before.json").read_text() == "{}"


@pytest.mark.parametrize(
    "error",
    [MemoryError(), ImportError("lib.so: failed to map segment from shared object"), ImportError("no such library")],
    ids=["array", "library", "another reason"],
)
def test_too_little_memory_is_one_line(error, monkeypatch, capsys):
    def fail(*_):
        raise error

    monkeypatch.setattr(_kernel, "run_rigid", fail)
    monkeypatch.setattr("sys.argv", ["heeltoe", "run", str(BLOCK)])
    if "no such" in str(error):
        with pytest.raises(ImportError):
            command.main()
        return
    with pytest.raises(SystemExit) as ended:
        command.main()
    assert ended.value.code == 3
    assert capsys.readouterr().err == ("heeltoe: not enough memory; provide more memory, or request a smaller run\n")


OF_HAZARD = """
case = "case.toml"
[motions]
folder = "quakes"
[fragility]
limits = {{ residual_slip = ["1 mm"] }}
measure = "pga"
[hazard]
file = "{pipe}"
"""


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes here")
@pytest.mark.parametrize("kind", ["case", "section", "study", "criteria", "dams", "hazard"])
def test_a_pipe_without_a_writer_is_one_sentence(kind, monkeypatch, tmp_path):
    monkeypatch.setattr("heeltoe.base.input_files.PATIENCE", 0.2)
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    handle = os.open(pipe, os.O_RDWR)  # somebody who never writes
    words = {
        "case": ("run", pipe),
        "section": ("run", BLOCK, "--set", f"section={{file = '{pipe}', unit = 'm'}}"),
        "study": ("study", pipe),
        "criteria": ("statics", BLOCK, "--set", f"statics.criteria_file={pipe}"),
        "dams": ("study", study_file(tmp_path, f"case = 'case.toml'\ncases = '{pipe}'\n"), "--dry-run"),
        "hazard": ("study", study_file(tmp_path, OF_HAZARD.format(pipe=pipe), "hazard.toml"), "--dry-run"),
    }[kind]
    try:
        ended = run_command(*words)
    finally:
        os.close(handle)
    assert ended.returncode == 2
    assert "no one has written all of it within 0.2 s" in ended.stderr


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="no named pipes here")
def test_a_case_may_come_through_a_pipe(tmp_path):
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    text = Path(BLOCK).read_bytes()
    writer = threading.Thread(target=lambda: pipe.write_bytes(text))
    writer.start()
    fields = read_fields(pipe)
    writer.join()
    assert fields == read_fields(Path(BLOCK))


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(signal, "SIGHUP"), reason="no such signals here")
@pytest.mark.parametrize("name", ["SIGTERM", "SIGHUP"])
def test_a_command_that_is_asked_to_end_leaves_nothing_aside(name, tmp_path):
    number = getattr(signal, name)
    file = study_file(tmp_path, DRAWN.replace("samples = 60", "samples = 2000000"))
    words = [sys.executable, "-m", "heeltoe", "study", str(file), "--out", "out"]
    # Whoever runs the tests may have it ignored, as nohup does, and then a command does not end by it.
    before = signal.signal(number, signal.SIG_DFL)
    try:
        running = subprocess.Popen(words, cwd=tmp_path, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    finally:
        signal.signal(number, before)
    with running:
        while not list(tmp_path.glob("out/runs/part-*.parquet")) and running.poll() is None:
            time.sleep(0.02)
        running.send_signal(number)
        try:
            _, errors = running.communicate(timeout=60)
        finally:
            running.kill()
    assert running.returncode == 128 + number
    assert f"heeltoe: ended by {name}" in errors
    assert "Traceback" not in errors
    assert not [path for path in (tmp_path / "out").rglob(".*") if path.is_dir()]


def test_more_threads_than_help_are_not_started(monkeypatch):
    monkeypatch.setenv("RAYON_NUM_THREADS", "100000")
    begun = time.perf_counter()
    case = example("block")
    heeltoe.rigid_many([case] * 3, [heeltoe.rigid(case).motion], threads=0)
    assert time.perf_counter() - begun < 10.0


def test_a_hundred_thousand_unknown_keys_take_no_minute(tmp_path):
    path = tmp_path / "case.json"
    path.write_text(json.dumps({f"key_{place}": 1 for place in range(100_000)}))
    begun = time.perf_counter()
    with pytest.raises(InputError) as caught:
        read_case(path)
    assert time.perf_counter() - begun < 10.0
    assert str(caught.value.others[-1]).startswith("the file: 99,9")
