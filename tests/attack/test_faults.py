"""A disk that fills at any moment, names that no encoding knows, clocks that jump, two processes at one place: the old
result or the new one, never half of it, and one sentence."""

from __future__ import annotations

import builtins
import errno
import io
import itertools
import json
import os
import subprocess
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from heeltoe.base.atomic_files import files, settle
from shared.attacked import Attack
from shared.dams import BLOCK
from shared.studies import GRID, study_file

#: What of the system a command that writes calls.
CALLS = ("open", "replace", "rename", "mkdir", "fsync", "link", "unlink", "rmdir", "scandir")


class Fault:
    """Calls of the system, of which one fails."""

    def __init__(self, fails: int, code: int, place: Path) -> None:
        self.count, self.fails, self.code, self.place = 0, fails, code, str(place)
        self.failed = ""

    def step(self, name: str, path: Any) -> None:
        """Count a call about the place, and fail where it is its turn."""
        if not isinstance(path, int) and not os.fspath(path).startswith(self.place):
            return
        self.count += 1
        if self.count == self.fails:
            self.failed = f"{name} {path}"
            raise OSError(self.code, os.strerror(self.code), None if isinstance(path, int) else os.fspath(path))

    def around(self, name: str, call: Callable[..., Any]) -> Callable[..., Any]:
        def called(path: Any, *rest: Any, **named: Any) -> Any:
            self.step(name, path)
            return call(path, *rest, **named)

        return called


def armed(patch: pytest.MonkeyPatch, fault: Fault) -> None:
    for name in CALLS:
        if name != "scandir":  # who lists uses it as a context, too
            patch.setattr(os, name, fault.around(name, getattr(os, name)))
    patch.setattr(io, "open", fault.around("open", io.open))
    patch.setattr(builtins, "open", fault.around("open", builtins.open))


def attack(code: int, every: int, place: Path, record_property: Any, monkeypatch: pytest.MonkeyPatch) -> None:
    out, strikes = place / "out", Attack("calls of the system that fail")
    words = ("run", BLOCK, "--out", out, "--csv", "--set")
    assert strikes.strike("before", *words, "title=old", cwd=place) == "accepted", strikes.defects
    title_before = "old"
    for fails in itertools.count(1, every):
        title = f"run {fails}"
        with monkeypatch.context() as patch:
            fault = Fault(fails, code, place)
            armed(patch, fault)
            end = _strike(strikes, f"{fault.failed or fails}", *words, f"title={title}", cwd=place)
        settle(out)
        names = files(out)
        written = str(json.loads((out / "result.json").read_text())["title"])
        if written not in (title_before, title) or (written == title_before and end == "accepted"):
            strikes.defects.append(f"{fault.failed}: {end}, the title is {written}")
        if any(not (out / name).exists() for name in names):
            strikes.defects.append(f"{fault.failed}: {names}")
        title_before = written
        if not fault.failed:
            break
    strikes.report(record_property)


def _strike(strikes: Attack, what: str, *words: str | Path, cwd: Path) -> str:
    """Run a command that may leave half of what it began, to be settled by the next one."""
    defects = list(strikes.defects)
    end = strikes.strike(what, *words, cwd=cwd)
    new = [defect for defect in strikes.defects[len(defects) :] if ": leaves " not in defect]
    if end == "defect" and not new:
        strikes.ends["defect"] -= 1
        strikes.ends[end := "refused"] += 1
    strikes.defects = [*defects, *new]
    return end


@pytest.mark.slow
@pytest.mark.usefixtures("empty_figures")
def test_a_disk_that_is_full_at_some_moments(tmp_path, record_property, monkeypatch):
    attack(errno.ENOSPC, 12, tmp_path, record_property, monkeypatch)


@pytest.mark.product
@pytest.mark.usefixtures("empty_figures")
@pytest.mark.parametrize("code", [errno.ENOSPC, errno.EACCES])
def test_a_disk_that_fails_at_any_moment(code, tmp_path, record_property, monkeypatch):
    attack(code, 1, tmp_path, record_property, monkeypatch)


# Names

NAMES = (
    b"dam\xff",
    b"\xc3\x28",
    b"a\nb",
    b"\x1b[2Jdam",
    b"-dam",
    b"a b'\"",
    "水壩".encode(),
    b"x" * 200,
    b"[bold]",
    b"%s",
)


def named(name: bytes, ending: str) -> str:
    return os.fsdecode(name + ending.encode())


@pytest.mark.usefixtures("empty_figures")
@pytest.mark.parametrize(
    "number", [0, 2, *(pytest.param(k, marks=pytest.mark.product) for k in (1, *range(3, len(NAMES))))]
)
def test_names_of_all_kinds(number, tmp_path, record_property):
    strikes = Attack("names of files")
    for name in NAMES[number : number + 1]:
        place = tmp_path / str(number)
        place.mkdir()
        case, record = place / named(name, ".toml"), place / named(name, ".txt")
        case.write_bytes(BLOCK.read_bytes())
        record.write_text("# units: time [s], acceleration [g]\n" + "".join(f"{0.01 * k} 0.2\n" for k in range(40)))
        target = place / named(name, "-out")
        study = study_file(place, GRID.replace('"case.toml"', json.dumps(case.name, ensure_ascii=True)))
        for words in (
            ("run", case),
            ("run", case, "--json", place / named(name, ".json")),
            ("run", case, "--out", target, "--csv"),
            ("run", BLOCK, "--motion", record),
            ("motion", record),
            ("statics", case),
            ("statics", BLOCK, "--criteria", case),
            ("study", study, "--dry-run"),
            ("run", place / named(name, "-nowhere.toml")),
            ("run", BLOCK, "--motion", place / named(name, "-nowhere.txt")),
        ):
            strikes.strike(f"{name!r} {words[0]}", *words, cwd=place)
    strikes.report(record_property)


# Clocks


def jumping(steps: list[float]) -> Callable[[], float]:
    """Return a clock that jumps back and forth."""
    turns = itertools.cycle(steps)
    return lambda: next(turns)


@pytest.mark.usefixtures("empty_figures")
@pytest.mark.parametrize(
    "steps",
    [[1e9, 0.0, -1e9, 5.0], *(pytest.param(steps, marks=pytest.mark.product) for steps in ([0.0], [1e18, -1e18]))],
)
def test_clocks_that_jump(steps, tmp_path, record_property, monkeypatch):
    file, strikes = study_file(tmp_path, GRID), Attack("clocks that jump")
    before = tmp_path / "before"
    assert strikes.strike("before", "study", file, "--out", before, cwd=tmp_path) == "accepted", strikes.defects
    clocks = {time.time, time.monotonic, time.perf_counter, time.process_time}
    modules = [module for name, module in list(sys.modules.items()) if name.startswith("heeltoe")]
    for module in modules:
        for name, value in list(vars(module).items()):
            if value in clocks if callable(value) and getattr(value, "__module__", "") == "time" else False:
                monkeypatch.setattr(module, name, jumping(steps))
    strikes.strike("study", "study", file, "--out", "out", cwd=tmp_path)
    strikes.strike("run", "run", BLOCK, cwd=tmp_path)
    monkeypatch.undo()
    for path in sorted((before / "runs").glob("*.parquet")):
        if path.read_bytes() != (tmp_path / "out/runs" / path.name).read_bytes():
            strikes.defects.append(f"{path.name} differs")
    strikes.report(record_property)


# Two at one place


@pytest.mark.product
def test_two_processes_at_one_place(tmp_path, record_property):
    strikes, out = Attack("two processes at one place"), tmp_path / "out"
    words = [sys.executable, "-m", "heeltoe", "run", str(BLOCK), "--out", str(out), "--csv", "--set"]
    for turn in range(4):
        titles = [f"one {turn}", f"two {turn}"]
        pair = [
            subprocess.Popen([*words, f"title={title}"], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            for title in titles
        ]
        for running in pair:
            _, errors = running.communicate(timeout=120)
            end = {0: "accepted", 2: "refused"}.get(running.returncode, "defect")
            strikes.ends[end] += 1
            if end == "defect" or (end == "refused" and (not errors.startswith("heeltoe: ") or errors.count("\n") > 1)):
                strikes.defects.append(f"{running.returncode}: {errors[-300:]}")
        settle(out)
        if json.loads((out / "result.json").read_text())["title"] not in titles:
            strikes.defects.append(f"turn {turn}: an older result is there")
        if missing := [name for name in files(out) if not (out / name).exists()]:
            strikes.defects.append(f"turn {turn}: {missing} are missing")
    strikes.report(record_property)
