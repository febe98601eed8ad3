"""Work that can be stopped from another process: the process stays, and with it what is dear to build.

A thread listens for the numbers of what shall stop and interrupts the main thread, which the kernels, too, look out
for; signals between processes do not work wherever Python runs."""

from __future__ import annotations

import _thread
import signal
from collections.abc import Callable
from contextlib import suppress
from multiprocessing.connection import Connection
from threading import Lock, Thread, main_thread
from typing import Any

# Time between two interrupts of the same work [s].
_AGAIN = 1.0


class StoppedError(Exception):
    """Nobody waits for this computation any more."""


class _State:
    """What runs in this process, and what shall not."""

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
    """Stop what runs, if nobody waits for it: Ctrl-C is for the server alone."""
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
