"""Where the app computes: what is killed is told, and the app goes on."""

from __future__ import annotations

import asyncio
import os
import signal
import time

import pytest

from heeltoe.app.jobs import Job
from heeltoe.app.live import flexible
from heeltoe.app.workers import WorkerLostError, Workers
from heeltoe.models.run import run
from shared.dams import FAST, example


def followed(job, *, when, do):
    """Follow a job until its end; `do` something to it as soon as it says `when`."""
    answer = []

    async def tell(message):
        answer.append(message)
        if when(message) and not any(map(when, answer[:-1])):
            do(job)

    asyncio.run(asyncio.wait_for(job.follow(tell), 60))
    return answer


def running(message):
    return message["status"].startswith("running the flexible model")


def a_run(*changes):
    return Job("flexible", flexible, example("typical-base", *changes), {}, "si")


def test_a_run_says_how_far_it_is_and_what_comes_of_it():
    messages = followed(a_run(*FAST), when=lambda message: False, do=None)
    assert any(map(running, messages))
    assert (messages[-1]["state"], messages[-1]["result"]["model"]) == ("done", "flexible")


def test_a_cancelled_run_ends():
    job = a_run()
    messages = followed(job, when=running, do=Job.cancel)
    assert (messages[-1]["state"], messages[-1]["result"]) == ("cancelled", None)


def test_a_killed_run_is_told():
    messages = followed(a_run(), when=running, do=lambda job: os.kill(job.process_id, signal.SIGKILL))
    assert messages[-1]["state"] == "lost"
    assert "SIGKILL" in messages[-1]["status"]


def test_what_is_refused_is_told_in_its_words():
    messages = followed(
        a_run("analysis.time_limit=1s", "flexible.elements_across=100"), when=lambda message: False, do=None
    )
    assert messages[-1]["state"] == "refused"
    assert "analysis.time_limit" in messages[-1]["status"]


def test_a_killed_process_beside_is_replaced():
    workers = Workers()

    async def lose():
        first = await workers.beside(os.getpid)
        waiting = asyncio.ensure_future(workers.beside(time.sleep, 60))
        await asyncio.sleep(0.2)
        os.kill(first, signal.SIGKILL)
        with pytest.raises(WorkerLostError):
            await waiting
        assert await workers.beside(os.getpid) != first

    try:
        asyncio.run(lose())
    finally:
        workers.close()


def test_what_reads_too_long_is_ended_and_the_next_is_read():
    async def read():
        workers = Workers()
        try:
            with pytest.raises(WorkerLostError):
                await workers.read(0.5, time.sleep, 600)
            return await workers.read(60.0, abs, -3)
        finally:
            workers.close()

    assert asyncio.run(read()) == 3


# Computes for a minute and loses the first exception, as a library may.
SWALLOWING = """
import time
end = time.monotonic() + 60.0
try:
    while time.monotonic() < end: time.sleep(0.01)
except Exception:
    pass
while time.monotonic() < end: time.sleep(0.01)
"""


# As an elastic run waits for both signs, which are on threads of their own.
WAITING = """
from threading import Event
Event().wait(120.0)
"""


@pytest.mark.parametrize("work", [SWALLOWING, WAITING], ids=["a library loses the exception", "it waits for a thread"])
def test_work_stops_though(work):
    workers = Workers()

    async def cancel():
        first = await workers.until_cancelled(os.getpid)
        running = asyncio.ensure_future(workers.until_cancelled(exec, work, {}))
        await asyncio.sleep(0.5)
        running.cancel()
        assert await workers.until_cancelled(os.getpid) == first

    try:
        asyncio.run(asyncio.wait_for(cancel(), 30.0))
    finally:
        workers.close()


@pytest.mark.slow
def test_what_nobody_waits_for_stops_and_its_process_stays():
    short = example("typical-base", *FAST).without_evidence()
    case = example("typical-base", "flexible.elements_across=24", "flexible.time_step=0.01ms").without_evidence()
    workers = Workers()

    async def cancel():
        first = await workers.until_cancelled(os.getpid)
        # A process that is new first loads its libraries, which nothing interrupts.
        await workers.until_cancelled(run, short, "flexible")
        running, behind = (asyncio.ensure_future(workers.until_cancelled(run, case, "flexible")) for _ in range(2))
        await asyncio.sleep(2.0)
        assert not running.done()
        running.cancel()
        behind.cancel()
        began = time.monotonic()
        assert await workers.until_cancelled(os.getpid) == first
        return time.monotonic() - began

    try:
        # Either of them would take minutes.
        assert asyncio.run(asyncio.wait_for(cancel(), 60.0)) < 20.0
    finally:
        workers.close()
