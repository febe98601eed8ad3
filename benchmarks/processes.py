"""Processes that are measured from outside: elapsed and processor time, and the memory of the largest one."""

from __future__ import annotations

import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from measure import NothingMeasured, require

HERE = Path(__file__).parent
#: Run by an interpreter without anything else: a process counts, as its own peak, the memory of the one that started
#: it. Writes what the system says of its child, all that it waited for included.
_WATCH = """
import os, sys, time
report, *command = sys.argv[1:]
began = time.perf_counter()
child = os.posix_spawnp(command[0], command, os.environ)
_, status, used = os.wait4(child, 0)
taken = time.perf_counter() - began
with open(report, "w") as file:
    file.write(f"[{os.waitstatus_to_exitcode(status)}, {taken}, {used.ru_utime + used.ru_stime}, {used.ru_maxrss}]")
"""
#: How often something is run: so often if no run takes longer than so many seconds.
_TURNS = ((1.0, 5), (4.0, 3), (8.0, 2))


@dataclass(frozen=True)
class Taken:
    """Costs of a process.

    Attributes
    ----------
    elapsed, processor
        Time [s]; that of the processor with all processes that it started and waited for.
    peak
        Memory of the largest of them at its peak [MB].
    output
        Its standard output.
    """

    elapsed: float
    processor: float
    peak: float
    output: str

    @property
    def answer(self) -> Any:
        """Its output, which is JSON."""
        return json.loads(self.output)


@dataclass(frozen=True)
class Version:
    """A heeltoe that is installed in an environment of its checkout."""

    executable: Path

    @property
    def root(self) -> Path:
        """Root of its checkout."""
        return self.executable.parents[2]

    @property
    def python(self) -> Path:
        """Interpreter of its environment."""
        return self.executable.with_name("python")

    def compile(self) -> None:
        """Keep the byte code of the package, so that no run compiles it."""
        package = str(self.root / "python" / "heeltoe")
        subprocess.run([self.python, "-m", "compileall", "-q", package], env=_environment(), check=True)

    def run(self, words: Sequence[str], exits: Sequence[int] = (0,)) -> Taken:
        """Run a command in the root of the checkout; `{out}` among its words is a folder that goes afterwards.

        Raises
        ------
        NothingMeasured
            Where it does not end with one of the codes `exits`.
        """
        return self._watched([str(self.executable), *words], exits)

    def work(self, program: str, order: dict[str, Any]) -> Taken:
        """Run a program of this folder with its order as JSON, by the interpreter of this version."""
        return self._watched([str(self.python), str(HERE / program), json.dumps(order)], (0,))

    def _watched(self, command: list[str], exits: Sequence[int]) -> Taken:
        with tempfile.TemporaryDirectory() as folder:
            seen = Path(folder) / "seen.json"
            words = [word.replace("{out}", str(Path(folder) / "out")) for word in command]
            start = [sys.executable, "-S", "-E", "-c", _WATCH, str(seen), *words]
            done = subprocess.run(start, cwd=self.root, capture_output=True, text=True, env=_environment(), check=False)
            require(seen.exists(), f"`{' '.join(command)}` does not start: {done.stderr[-500:]}")
            code, elapsed, processor, peak = json.loads(seen.read_text(encoding="utf-8"))
        require(code in exits, f"`{' '.join(command)}` ends with {code}: {done.stderr[-500:]}")
        return Taken(elapsed, processor, peak / 1024.0, done.stdout)


def mine() -> Version:
    """Return the version that runs this benchmark."""
    return Version(Path(sys.executable).with_name("heeltoe").absolute())


def least(works: Sequence[Callable[[], Taken]]) -> tuple[list[Taken], int]:
    """Do pieces of work in turn, up to five times, the longest once; return what each took in its turn of least
    processor time, and the number of turns."""
    rounds = [[work() for work in works]]
    longest = max(taken.processor for taken in rounds[0])
    turns = next((count for limit, count in _TURNS if longest <= limit), 1)
    rounds += [[work() for work in works] for _ in range(turns - 1)]
    best = [min(runs, key=lambda taken: taken.processor) for runs in zip(*rounds, strict=True)]
    return best, turns


def commit_of(version: Version) -> str:
    """Return the commit that a version's checkout is at."""
    call = ["git", "rev-parse", "HEAD"]
    try:
        return subprocess.run(call, cwd=version.root, capture_output=True, text=True, check=True).stdout.strip()
    except (OSError, subprocess.CalledProcessError) as error:
        raise NothingMeasured(f"{version.root} is no checkout: {error}") from None


def _environment() -> dict[str, str]:
    # Byte code is kept whatever the shell says, and no version sees the packages of another.
    unwanted = ("PYTHONDONTWRITEBYTECODE", "PYTHONPATH", "PYTHONHOME", "VIRTUAL_ENV")
    return {key: value for key, value in os.environ.items() if key not in unwanted}
