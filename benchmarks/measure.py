"""Clock, memory, machine and tables: what every benchmark of this folder needs."""

from __future__ import annotations

import os
import platform
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from datetime import UTC, datetime
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path
from statistics import median, quantiles
from typing import Any

# Shorter than this [s] is mostly the clock's own grain; longer than that is not worth repeating.
SHORTEST, LONGEST = 0.02, 4.0


class NothingMeasured(Exception):
    """A benchmark whose work did not happen, or was too short to time; its numbers must not be believed."""


class Skipped(NothingMeasured):
    """A benchmark that cannot be run here, for want of a program or of records; the text says which."""


@dataclass(frozen=True)
class Timing:
    """Repeated measurements of one piece of work, per call.

    Attributes
    ----------
    wall, cpu
        Elapsed time, and processor time of all threads together, of each repetition [s].
    """

    wall: tuple[float, ...]
    cpu: tuple[float, ...]

    @property
    def median(self) -> float:
        """Median elapsed time of one call [s]."""
        return median(self.wall)

    @property
    def cpu_median(self) -> float:
        """Median processor time of one call, all threads together [s]."""
        return median(self.cpu)

    @property
    def spread(self) -> float:
        """Distance between the quartiles of the elapsed time, as a part of the median."""
        if len(self.wall) < 3:
            return float("nan")
        low, _, high = quantiles(self.wall, n=4, method="inclusive")
        return (high - low) / self.median


def repeat(work: Callable[[], Any], repetitions: int = 7, prepare: Callable[[], Any] | None = None) -> Timing:
    """Time a piece of work; where it is short, many calls make up one repetition.

    Parameters
    ----------
    work
        What is timed.
    repetitions
        How often, unless a call is so long that once must do.
    prepare
        What must be done before each call and is not timed.

    Raises
    ------
    NothingMeasured
        Where the work cannot be told from none.
    """

    def once(calls: int) -> tuple[float, float]:
        if prepare is not None:
            prepare()
        busy, start = time.process_time(), time.perf_counter()
        for _ in range(calls):
            work()
        return (time.perf_counter() - start) / calls, (time.process_time() - busy) / calls

    # The first call pays for caches and pages that later ones find ready; it counts only where it is the only one.
    first = once(1)
    # How long a call takes is seen from the second one: the first of a process can be a hundred times as long.
    warm = first if first[0] > LONGEST else once(1)
    calls = 1 if prepare is not None else max(1, int(SHORTEST / max(min(first[0], warm[0]), 1e-7)))
    pairs = [first] if first[0] > LONGEST else [once(calls) for _ in range(repetitions)]
    wall, cpu = zip(*pairs, strict=True)
    require(min(wall) * calls > 0.05 * SHORTEST, f"{calls} calls took {min(wall) * calls:g} s")
    return Timing(wall, cpu)


def require(done: bool, what: str) -> None:
    """Fail the benchmark unless its work really happened.

    Raises
    ------
    NothingMeasured
        With `what` as its message, where `done` is false.
    """
    if not done:
        raise NothingMeasured(what)


def memory(peak: bool = False) -> float:
    """Resident memory of this process, now or at its peak since `forget_peak` [MB]; Linux only."""
    key = "VmHWM:" if peak else "VmRSS:"
    for line in Path("/proc/self/status").read_text().splitlines():
        if line.startswith(key):
            return float(line.split()[1]) / 1024.0
    raise NothingMeasured("the system does not say how much memory is in use")


def forget_peak() -> None:
    """Start the peak of the resident memory anew; Linux only."""
    Path("/proc/self/clear_refs").write_text("5")


def machine() -> str:
    """Describe processor, system and interpreter."""
    model = platform.processor() or platform.machine()
    info = Path("/proc/cpuinfo")
    if info.exists():
        names = [line.split(":", 1)[1].strip() for line in info.read_text().splitlines() if "model name" in line]
        model = names[0] if names else model
    return (
        f"{os.cpu_count()} cores of a shared server, {model}; {platform.system()}, Python {platform.python_version()}"
    )


def heading(title: str, packages: Sequence[str]) -> str:
    """Markdown heading with date, machine and versions."""
    versions = ", ".join(f"{name} {_version(name)}" for name in packages)
    return f"## {title}\n\nMeasured {datetime.now(UTC):%Y-%m-%d} on {machine()}; {versions}."


def _version(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:
        return "(not installed)"


def table(columns: Sequence[str], rows: Sequence[Sequence[str]]) -> str:
    """Markdown table.

    Raises
    ------
    NothingMeasured
        Where there are no rows.
    """
    require(len(rows) > 0, "a table without rows")
    lines = [columns, ["---"] * len(columns), *rows]
    return "\n".join("| " + " | ".join(line) + " |" for line in lines)


def seconds(value: float) -> str:
    """Three digits and a fitting unit."""
    for factor, unit in ((1.0, "s"), (1e3, "ms"), (1e6, "µs")):
        if value * factor >= 1.0:
            return f"{value * factor:.3g} {unit}"
    return f"{value * 1e9:.3g} ns"


def timed(timing: Timing) -> str:
    """Median with the distance between the quartiles, or the one measurement there is."""
    if len(timing.wall) < 3:
        return f"{seconds(timing.median)} (once)"
    return f"{seconds(timing.median)} ({timing.spread:.0%})"


def times(ratio: float) -> str:
    """Return how many times as long something takes."""
    return f"{ratio:,.0f}" if ratio >= 10.0 else f"{ratio:.2g}"
