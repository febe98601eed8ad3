"""A signal ends runs of the kernels, which look for one every 50 ms, and what they had come to is noted."""

from __future__ import annotations

import re
import signal
import time

import numpy as np
import pytest

from heeltoe.kernel.block import Limits, run_block, run_blocks
from heeltoe.kernel.shaking import Shaking, peak_responses
from shared.kernel_cases import ordinary, rows

# So much of everything that it would take seconds.
TIME = np.linspace(0.0, 4e4, 4_000_001)
ROUGH = Shaking(TIME, 8.0 * np.random.default_rng(5).standard_normal(TIME.size))
MANY = Limits(event_limit=2**62)
BLOCK = rows(ordinary())
pytestmark = pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="no timers that signal here")


class Enough(Exception):
    """What the handler raises."""


def interrupted(work):
    """Return what is noted of work that a signal interrupts 0.1 s after its start."""

    def handler(*_):
        raise Enough

    before = signal.signal(signal.SIGALRM, handler)
    try:
        signal.setitimer(signal.ITIMER_REAL, 0.1)
        with pytest.raises(Enough) as raised:
            work()
        return getattr(raised.value, "__notes__", [])
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)


def one():
    return run_block(BLOCK, ROUGH, np.array([]), MANY)


def many():
    blocks = np.tile(BLOCK, (64, 1))
    return run_blocks(blocks, [ROUGH], np.zeros(64, dtype=np.int64), np.ones((64, 2)), MANY, threads=2)


def spectrum():
    return peak_responses(TIME, ROUGH.horizontal, np.full(2000, 0.5), 0.05)


def test_a_block_says_how_far_it_has_come():
    (note,) = interrupted(one)
    assert (
        0.0
        < float(re.fullmatch(r"the run had come to (\d+\.\d+) s of the earthquake and -?\d+\.\d mm of slip", note)[1])
        < TIME[-1] / 2
    )


@pytest.mark.parametrize("work", [many, spectrum])
def test_many_runs_end_at_once(work):
    begun = time.perf_counter()
    assert interrupted(work) == []
    # They would take a minute.
    assert time.perf_counter() - begun < 10.0


def test_nothing_of_an_interruption_stays():
    """A run that no one interrupts is the same to the bit as before, and after, one that somebody has."""
    short = Shaking(TIME[:2000], ROUGH.horizontal[:2000])
    first = run_block(BLOCK, short, TIME[:20].copy())
    interrupted(one)
    again = run_block(BLOCK, short, TIME[:20].copy())
    assert first.summary == again.summary
    assert all(
        np.array_equal(column, getattr(again.histories, name)) for name, column in first.histories.by_name().items()
    )
