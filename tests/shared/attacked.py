"""An attack on the command line: many calls in this process, each judged by how it ends, and what came of all."""

from __future__ import annotations

import json
import resource
import signal
import stat
import traceback
from collections import Counter
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NoReturn

from shared.command import Reply, command

# Of computing, on any machine; times as long of waiting, on one that others share.
SECONDS, WAITED, BYTES = 10.0, 40.0, 3 * 10**9
ENDS = {0: "accepted", 2: "refused", 3: "no result"}


class TooLong(BaseException):
    """Time is up; no error, so that no one takes it for one of its own."""


class Attack:
    """How often what came of it, and what should not have."""

    def __init__(self, name: str, seconds: float = SECONDS) -> None:
        self.name, self.seconds = name, seconds
        self.ends: Counter[str] = Counter()
        self.defects: list[str] = []

    def strike(
        self,
        what: str,
        *arguments: str | Path,
        cwd: Path,
        data: bool = False,
        judge: Callable[[dict[str, Any]], list[str]] | None = None,
    ) -> str:
        """Run a command; `data` where its standard output shall be JSON, in which `judge` says what is wrong. A refusal
        leaves the directory as it was."""
        before = _files(cwd)
        try:
            with limited(self.seconds):
                reply = command(*arguments, cwd=cwd)
            wrong = faults(reply, data=data)
            if judge and not wrong and reply.returncode != 2:
                wrong = answers(reply, judge)
        except TooLong:
            reply, wrong = None, [f"computes longer than {self.seconds:g} s"]
        except BaseException as error:
            last = traceback.extract_tb(error.__traceback__)[-1]
            reply, wrong = None, [f"{type(error).__name__}: {error} ({last.filename}:{last.lineno})"]
        after = _files(cwd)
        if (reply is None or reply.returncode == 2) and after != before:
            wrong.append(f"leaves {sorted(after.keys() ^ before.keys()) or 'a changed file'}")
        wrong += [f"leaves {name}" for name in after if ".heeltoe-" in name and not name.endswith(".heeltoe-files")]
        end = "defect" if wrong or reply is None else ENDS[reply.returncode]
        self.ends[end] += 1
        self.defects += [f"{what[:160]}: {fault[:300]}" for fault in wrong]
        return end

    def report(self, record_property: Any) -> None:
        """Hand the counts to the table at the end of the test run, and fail where anything was found."""
        record_property("attack", (self.name, dict(self.ends)))
        assert not self.defects, f"{len(self.defects)} defects\n" + "\n".join(self.defects[:100])


def faults(reply: Reply, *, data: bool) -> list[str]:
    """Return what is wrong with the end of a command."""
    if reply.returncode not in ENDS:
        return [f"ends with {reply.returncode}: {reply.stderr[-200:]}"]
    wrong = []
    if reply.returncode == 2:
        # A line for each thing that is wrong, and for each field one.
        *lines, rest = reply.stderr.split("\n")
        fields = [line.removeprefix("heeltoe: ").partition(": ")[0] for line in lines]
        if rest or not lines or not all(line.startswith("heeltoe: ") for line in lines) or len({*fields}) < len(fields):
            wrong.append(f"refuses in other than a line for each field: {reply.stderr[:300]!r}")
    if reply.returncode == 2 and reply.stdout:
        wrong.append(f"refuses and says {reply.stdout[:100]!r}")
    if reply.returncode != 2 and data:
        try:
            json.loads(reply.stdout, parse_constant=_no_constant)
        except ValueError as error:
            wrong.append(f"JSON: {error}")
    for text in (reply.stderr, "" if data else reply.stdout):
        strange = {letter for letter in text if not letter.isprintable() and letter != "\n"}
        if strange:
            wrong.append(f"says {strange!r} raw")
    return wrong


def answers(reply: Reply, judge: Callable[[dict[str, Any]], list[str]]) -> list[str]:
    """Return what is wrong with the JSON of a command, and with its end beside that."""
    answer = json.loads(reply.stdout)
    trusted = answer.get("outcome") in (None, "ok", "overturned")
    ends = [] if trusted is (reply.returncode == 0) else [f"ends with {reply.returncode}: {answer['outcome']}"]
    return [*ends, *judge(answer)]


def _no_constant(name: str) -> NoReturn:
    raise ValueError(f"{name} is no JSON")


def _files(directory: Path) -> dict[str, tuple[int, int]]:
    states = {}
    for path in directory.rglob("*"):
        status = path.lstat()
        size = (status.st_size, status.st_mtime_ns) if stat.S_ISREG(status.st_mode) else (0, 0)
        states[str(path.relative_to(directory))] = size
    return states


@contextmanager
def limited(seconds: float = SECONDS, bytes_: int = BYTES) -> Iterator[None]:
    """End what computes longer, and give no more memory than so much beyond what there is."""

    def end(*_: object) -> NoReturn:
        raise TooLong

    soft, hard = resource.getrlimit(resource.RLIMIT_AS)
    used = int(Path("/proc/self/statm").read_text().split()[0]) * resource.getpagesize() if _PROC else 0
    clocks = {signal.SIGPROF: (signal.ITIMER_PROF, seconds), signal.SIGALRM: (signal.ITIMER_REAL, WAITED * seconds)}
    before = {kind: signal.signal(kind, end) for kind in clocks}
    if used:
        resource.setrlimit(resource.RLIMIT_AS, (used + bytes_, hard))
    # Again and again: what is caught by somebody who takes it for an interruption does not go on for long.
    for clock, most in clocks.values():
        signal.setitimer(clock, most, 1.0)
    try:
        yield
    finally:
        for kind, (clock, _) in clocks.items():
            signal.setitimer(clock, 0.0)
            signal.signal(kind, before[kind])
        resource.setrlimit(resource.RLIMIT_AS, (soft, hard))


_PROC = Path("/proc/self/statm").exists()
