"""The cost of a run, estimated before it begins: time on one core, and memory on top of that of the program.

The factors of blocks, of records and of tables were measured on one core at some 3 GHz with records of 10 to 60 minutes
and files of up to 50 MB; those of elastic parts are in :mod:`heeltoe.models.flexible.body.cost`."""

from __future__ import annotations

import os
from collections.abc import Iterable
from dataclasses import dataclass
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from heeltoe.case.model import Case

#: A run that takes longer than this is announced before it begins [s].
A_WAIT = 5.0
_TIMES = ((86400.0, "days"), (3600.0, "h"), (60.0, "min"), (1.0, "s"))
# Seconds and bytes of a sample of the motion of a rigid block, and of a second of a decoupled one, which steps by 1 ms.
_SAMPLE, _CHAIN = (2.7e-5, 3.2e3), (0.03, 8e5)
# Seconds and bytes of each number in the file of a record, how much of that is looked at for how long they are [B], and
# how many bytes one of a compressed file has.
_READ, _LOOKED_AT, _PACKED = (2.4e-6, 200.0), 1 << 16, 3.0
# Seconds and bytes of the figures and tables of a run, and of a report.
_FILES, _REPORT = (3.3, 2e8), (9.0, 5e8)


@dataclass(frozen=True)
class Cost:
    """Time on one core [s] and memory [B]."""

    seconds: float = 0.0
    memory: float = 0.0

    def __add__(self, other: Cost) -> Cost:
        """Return what both cost, one after the other."""
        return Cost(self.seconds + other.seconds, max(self.memory, other.memory))

    def within(self, case: Case) -> bool:
        """Whether a case allows that."""
        return self.seconds <= case.analysis.time_limit and self.memory <= case.analysis.memory_limit

    def times(self, count: float) -> Cost:
        """Return the cost of `count` such runs, one after the other."""
        return Cost(count * self.seconds, self.memory)

    def shown(self) -> str:
        """Return it in words."""
        factor, unit = next(item for item in _TIMES if self.seconds >= 1.5 * item[0] or item[1] == "s")
        return f"{two_digits(max(self.seconds / factor, 1.0))} {unit} and {two_digits(max(self.memory / 1e9, 0.1))} GB"


#: The cost of next to nothing.
NOTHING = Cost()


def two_digits(value: float) -> str:
    """Return a number with two digits that count."""
    return f"{float(f'{value:.2g}'):.0f}" if 10.0 <= value < 1e6 else f"{value:.2g}"


def block_cost(model: str, seconds: float, samples: float) -> Cost:
    """Return the cost of a run of a block, ``"rigid"`` or ``"decoupled"``, through a motion of given length and
    samples."""
    if model == "decoupled":
        return Cost(_CHAIN[0] * seconds, _CHAIN[1] * seconds)
    return Cost(_SAMPLE[0] * samples, _SAMPLE[1] * samples)


def writing_cost(*, files: bool, report: bool) -> Cost:
    """Return what the files of a run cost, and its report."""
    return Cost(*_REPORT) if report else Cost(*_FILES) if files else NOTHING


def reading_cost(files: Iterable[str | os.PathLike[str]]) -> Cost:
    """Return what reading records costs, by the size of their files; what is not there costs nothing."""
    cost = NOTHING
    for file in files:
        try:
            size = os.path.getsize(file) * (_PACKED if str(file).endswith((".gz", ".bz2", ".zip")) else 1.0)
            # A pipe would be empty afterwards, and a small file takes no time.
            if not os.path.isfile(file) or size < _LOOKED_AT:
                continue
            with open(file, "rb") as opened:
                head = opened.read(_LOOKED_AT)
        except OSError:
            continue
        numbers = size * len(head.split()) / len(head)
        cost += Cost(_READ[0] * numbers, _READ[1] * numbers)
    return cost
