"""Long runs, each in a process of its own: it says how far it is, can be cancelled, and may die without the app."""

from __future__ import annotations

import asyncio
import multiprocessing
import os
import signal
import sys
from collections.abc import Awaitable, Callable
from contextlib import suppress
from itertools import count
from multiprocessing.connection import Connection
from time import monotonic
from typing import Any

from heeltoe.app.stopping import end_with_parent
from heeltoe.base.heap import share_heaps
from heeltoe.base.payload import Json
from heeltoe.errors.error import InputError

#: What a job calls: it says what goes on, with the share that is done where it knows, and returns what a page can draw.
Work = Callable[..., Json]
Tell = Callable[[Json], Awaitable[None]]

_NUMBERS = count(1)
# A process that does not end by itself when asked to is ended after this [s]; one that has others ends them before.
_PATIENCE_S = 10.0
# The same where the whole app ends, for which somebody waits at a terminal.
_LAST_PATIENCE_S = 2.0


class Job:
    """One long run.

    Parameters
    ----------
    what
        It is, in a word, for the page.
    work
        A function of a module, called in the process with a function that says what goes on and `arguments`.
    parent
        Whether its process may have processes of its own; they end with it.
    """

    def __init__(self, what: str, work: Work, *arguments: Any, parent: bool = False) -> None:
        self.number = next(_NUMBERS)
        self.what = what
        self.state = "running"
        self.status = "starting"
        self.share: float | None = None
        self.result: dict[str, object] | None = None
        self._began = monotonic()
        self._ended: float | None = None
        context = multiprocessing.get_context("spawn")
        self._here, far_end = context.Pipe(duplex=False)
        self._process = context.Process(target=_run, args=(far_end, work, arguments), daemon=not parent)
        self._process.start()
        far_end.close()

    @property
    def process_id(self) -> int | None:
        """Number of the job's process."""
        return self._process.pid

    def payload(self) -> Json:
        """Return what a page shows of it."""
        seconds = (self._ended or monotonic()) - self._began
        payload = {"of": "job", "number": self.number, "what": self.what, "state": self.state, "seconds": seconds}
        return payload | {"status": self.status, "share": self.share, "result": self.result}

    def cancel(self, state: str = "cancelled", status: str = "cancelled") -> None:
        """End it, where it has not ended, and say why."""
        if self.state == "running":
            self.state, self.status = state, status
            self._process.terminate()

    def end(self) -> None:
        """End it and all processes that it has, and return only then: Python waits at its own end for processes that
        may have others."""
        self.cancel()
        self._process.join(_LAST_PATIENCE_S)
        self._kill()
        self._process.join(_LAST_PATIENCE_S)

    def _kill(self) -> None:
        if not self._process.is_alive():
            return
        if hasattr(os, "killpg") and not self._process.daemon and self._process.pid is not None:
            with suppress(ProcessLookupError, PermissionError):
                os.killpg(self._process.pid, signal.SIGKILL)
        self._process.kill()

    async def follow(self, tell: Tell) -> None:
        """Tell what goes on until it has ended, whatever ends it."""
        loop = asyncio.get_running_loop()
        state = await self._tell(tell)
        while True:
            ready = await loop.run_in_executor(None, self._here.poll, 0.5)
            try:
                if ready:
                    self._take(self._here.recv())
            except (EOFError, OSError):
                break
            # A result is sent once: a second one would replace what the page has marked as out of date since.
            if state == "running":
                state = await self._tell(tell)
        # A process that has processes of its own takes a while to end: no one else shall wait for it.
        await loop.run_in_executor(None, self._process.join, _PATIENCE_S)
        self._kill()
        self._here.close()
        self._ended = monotonic()
        if self.state == "running":
            self.state, self.status = "lost", _lost(self._process.exitcode)
        if self.state != state:
            await tell(self.payload())

    async def _tell(self, tell: Tell) -> str:
        """Send the progress, and return the state that was sent: a run may be cancelled meanwhile."""
        message = self.payload()
        await tell(message)
        return str(message["state"])

    def _take(self, message: tuple[str, Any]) -> None:
        kind, content = message
        if self.state != "running":
            return
        if kind == "says":
            self.status, self.share = content
        else:
            self.state, self.status, self.result = kind, "" if kind == "done" else content, None
            if kind == "done":
                self.result = content


def _lost(code: int | None) -> str:
    """Say how a process ended that did not say so itself."""
    if code is not None and code < 0:
        with suppress(ValueError):
            return (
                f"The process of this run was ended from outside ({signal.Signals(-code).name}), perhaps for want of "
                "memory. Nothing else is lost; run it again, or with fewer elements."
            )
    return "The process of this run has ended without a result. Nothing else is lost; run it again."


def _run(far_end: Connection, work: Work, arguments: tuple[Any, ...]) -> None:
    """Run in the process of a job."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    if not multiprocessing.current_process().daemon:
        # All its processes can be ended together.
        if hasattr(os, "setpgid"):
            os.setpgid(0, 0)
        # Its processes are ended, and what they share is given back, on the way out.
        signal.signal(signal.SIGTERM, lambda *_: sys.exit(1))
    end_with_parent()
    share_heaps()
    try:
        far_end.send(("done", work(lambda text, share=None: far_end.send(("says", (text, share))), *arguments)))
    except InputError as error:
        far_end.send(("refused", str(error)))
    except MemoryError:
        far_end.send(("failed", "There is not enough memory for this run."))
