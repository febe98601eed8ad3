"""Processes that stop: at a word from another process, when the process stays, and with it what is dear to build; or
for good, when the process that began them has ended.

A thread listens for the numbers of what shall stop and interrupts the main thread, which the kernels, too, look out
for; signals between processes do not work wherever Python runs."""

from __future__ import annotations

import _thread
import os
import signal
from collections.abc import Callable
from contextlib import suppress
from multiprocessing import parent_process
from multiprocessing.connection import Connection, wait
from threading import Lock, Thread, main_thread
from typing import Any

# Time between two interrupts of the same work [s].
_AGAIN = 1.0


def end_with_parent() -> None:
    """End this process, with all of its group if it leads one, as soon as the process that began it has ended, however
    that ended: no one would hear what it finds."""
    parent = parent_process()
    if parent is not None:
        Thread(target=_end_after, args=(parent.sentinel,), daemon=True).start()


def _end_after(sentinel: int) -> None:
    wait([sentinel])
    if hasattr(os, "killpg") and os.getpgid(0) == os.getpid():
        os.killpg(0, signal.SIGKILL)
    os._exit(1)


class StoppedError(Exception):
    """No one waits for this computation any more."""


class _State:
    """Runs of this process, and their cancellation."""

    def __init__(self) -> None:
        self.lock = Lock()
        self.running = 0
        self.unwanted = set[int]()


_STATE = _State()


def listen(numbers: Connection) -> None:
    """Begin to listen, in the main thread of a process."""
    signal.signal(signal.SIGINT, _interrupted)
    Thread(target=_hear, args=(numbers,), daemon=True).start()


def _hear(numbers: Connection) -> None:
    with suppress(EOFError, OSError):
        while True:
            # What is raised amid a library may get lost there: it is raised again until the work has stopped.
            if numbers.poll(_AGAIN if _STATE.unwanted else None):
                _STATE.unwanted.add(numbers.recv())
            with _STATE.lock:
                if _STATE.running in _STATE.unwanted:
                    _interrupt()


def _interrupt() -> None:
    """Send the main thread a signal: a note of one does not wake it where it waits for another thread."""
    main = main_thread().ident
    if hasattr(signal, "pthread_kill") and main is not None:
        signal.pthread_kill(main, signal.SIGINT)
    else:
        _thread.interrupt_main()


def _interrupted(*_: Any) -> None:
    """Stop the run of a user who has left: Ctrl-C is for the server alone."""
    # No lock, which this thread may hold; both were written before the signal.
    if _STATE.running and _STATE.running in _STATE.unwanted:
        raise StoppedError


def stoppable(number: int, compute: Callable[..., Any], *arguments: Any) -> Any:
    """Compute, under a number by which it is stopped.

    Raises
    ------
    StoppedError
        Where it was.
    """
    try:
        with _STATE.lock:
            _STATE.running = number
            unwanted = number in _STATE.unwanted
        if unwanted:
            raise StoppedError
        return compute(*arguments)
    finally:
        _STATE.running = 0
        _STATE.unwanted.discard(number)
