"""How a run ends before its time: by Ctrl-C, which runs on other threads hear of, or by a bug of a kernel."""

from __future__ import annotations

import re
import signal
import time

import pytest

from heeltoe import run
from heeltoe.base.atomic_files import write_text
from heeltoe.cli import main as command
from heeltoe.kernel import _kernel
from heeltoe.models.flexible.body.reduced import build_flexible_dam
from heeltoe.models.flexible.evidence.trials import Trials
from heeltoe.models.flexible.model import Rested
from heeltoe.models.flexible.run.dam_runner import ShakenDam
from shared.dams import BLOCK, example


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="no timers that signal here")
def test_runs_with_evidence_end_at_once_and_say_how_far_they_have_come(monkeypatch):
    """Here they are threads; all would take half a minute."""
    prepare = Trials.prepare

    def alarmed(self, *given):
        signal.setitimer(signal.ITIMER_REAL, 0.5)
        prepare(self, *given)

    def handler(*_):
        raise KeyboardInterrupt

    monkeypatch.setattr(Trials, "prepare", alarmed)
    case = example("typical-base", "motion.duration=400s", "analysis.silence=0s", "motion.sign=recorded")

    def without(run, reach, through, most):
        """Leave out the run that shows whether the dam comes to rest."""
        return Rested(through, ShakenDam(case, build_flexible_dam(case), through.shaking), None, "ok", None)

    monkeypatch.setattr("heeltoe.models.flexible.model.until_rest", without)
    before = signal.signal(signal.SIGALRM, handler)
    try:
        begun = time.perf_counter()
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
    said = capsys.readouterr()
    assert (ended.value.code, said.out) == (1, "")
    assert said.err.startswith("heeltoe: this is a bug of its kernel: ")
    assert said.err.count("\n") == 1
    assert "please report it" in said.err
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
