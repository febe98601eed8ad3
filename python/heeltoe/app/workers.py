"""Where the app computes: nothing of it may hold up the loop that listens to the tabs.

What takes milliseconds runs on threads, as the kernels let others run beside them. What factorises matrices would not,
and has a process of its own."""

from __future__ import annotations

import asyncio
import multiprocessing
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from contextlib import suppress
from itertools import count
from multiprocessing.connection import Connection
from typing import Any

from heeltoe.app.stopping import end_with_parent, listen, stoppable
from heeltoe.base.heap import share_heaps

THREADS = 4
#: What the names of its threads begin with.
WORKER_NAME = "heeltoe"
# Never a fork: the server has threads.
_SPAWN = multiprocessing.get_context("spawn")
# How far the processes beside stand back.
_NICE = 5


class WorkerLostError(Exception):
    """The process of a computation is gone: killed, or out of memory."""


class Workers:
    """Threads, and processes beside them: one for runs that follow the sliders, one for longer ones."""

    def __init__(self) -> None:
        self._threads = ThreadPoolExecutor(THREADS, thread_name_prefix=WORKER_NAME)
        # An executor starts its process when it is first asked.
        self._processes = {name: _process() for name in ("live", "aside")}
        self._stoppable = _Stoppable()
        self._reader = _process()
        self._reading = asyncio.Lock()

    async def quick(self, compute: Callable[..., Any], *arguments: Any) -> Any:
        """Compute on a thread."""
        return await asyncio.get_running_loop().run_in_executor(self._threads, compute, *arguments)

    async def beside(self, compute: Callable[..., Any], *arguments: Any) -> Any:
        """Compute in the process beside; it keeps what is dear to build.

        Raises
        ------
        WorkerLostError
            Where the process was lost on the way; the next one has a new one.
        """
        return await self._in("live", compute, *arguments)

    async def aside(self, compute: Callable[..., Any], *arguments: Any) -> Any:
        """Compute, as :meth:`beside`, a run of seconds that follows no slider."""
        return await self._in("aside", compute, *arguments)

    async def until_cancelled(self, compute: Callable[..., Any], *arguments: Any) -> Any:
        """Compute in a process of its own what stops at once where whoever waits for it is cancelled; the process stays
        warm for the next.

        Raises
        ------
        WorkerLostError
            As :meth:`beside`.
        """
        worker = self._stoppable
        number = next(worker.numbers)
        try:
            return await asyncio.get_running_loop().run_in_executor(worker.pool, stoppable, number, compute, *arguments)
        except asyncio.CancelledError:
            worker.stop(number)
            raise
        except BrokenProcessPool:
            if self._stoppable is worker:
                self._stoppable = _Stoppable()
                worker.pool.shutdown(wait=False)
            raise WorkerLostError from None

    async def _in(self, name: str, compute: Callable[..., Any], *arguments: Any) -> Any:
        process = self._processes[name]
        try:
            return await asyncio.get_running_loop().run_in_executor(process, compute, *arguments)
        except BrokenProcessPool:
            if self._processes[name] is process:
                self._processes[name] = _process()
                process.shutdown(wait=False)
            raise WorkerLostError from None

    async def read(self, seconds: float, compute: Callable[..., Any], *arguments: Any) -> Any:
        """Compute what reads files of strangers, one after the other in a process for that, which is ended where it
        takes longer than `seconds`.

        Raises
        ------
        WorkerLostError
            Where it did, or the process was lost.
        """
        async with self._reading:
            reading = asyncio.get_running_loop().run_in_executor(self._reader, compute, *arguments)
            try:
                return await asyncio.wait_for(reading, seconds)
            except (TimeoutError, BrokenProcessPool, asyncio.CancelledError) as error:
                # Whoever reads next shall not wait for it.
                _end(self._reader)
                self._reader = _process()
                if isinstance(error, asyncio.CancelledError):
                    raise
                raise WorkerLostError from None

    def close(self) -> None:
        """End all."""
        self._threads.shutdown(wait=False, cancel_futures=True)
        for pool in (*self._processes.values(), self._stoppable.pool, self._reader):
            _end(pool, wait=True)


class _Stoppable:
    """A process whose work can be stopped, by its number, without an end of the process."""

    def __init__(self) -> None:
        self.numbers = count(1)
        far_end, self._here = _SPAWN.Pipe(duplex=False)
        self.pool = ProcessPoolExecutor(1, _SPAWN, initializer=_listening, initargs=(far_end,))

    def stop(self, number: int) -> None:
        """Stop a computation, whether it runs or waits."""
        with suppress(OSError):
            self._here.send(number)


def _listening(numbers: Connection) -> None:
    _quietly()
    listen(numbers)


def _end(pool: ProcessPoolExecutor, *, wait: bool = False) -> None:
    """End a process, and with `wait` what looks after it, too, which the end of Python would meet half closed."""
    for process in (pool._processes or {}).values():
        process.terminate()
    pool.shutdown(wait=wait, cancel_futures=True)


def _process() -> ProcessPoolExecutor:
    return ProcessPoolExecutor(1, _SPAWN, initializer=_quietly)


def _quietly() -> None:
    """Leave Ctrl-C to the server, yield to it and to the browser, and end with it."""
    import os
    import signal

    end_with_parent()
    share_heaps()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if hasattr(os, "nice"):
        os.nice(_NICE)
