"""Executors of the parts of a study: this process, worker processes, or a cluster."""

from __future__ import annotations

import logging
import os
import shutil
import sys
from collections.abc import Iterator, Sequence
from contextlib import ExitStack, contextmanager
from importlib.util import find_spec
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

import pyarrow as pa

from heeltoe.errors.error import STUDY_PACKAGES, InputError, UnfinishedError
from heeltoe.study.plan.plan import Plan
from heeltoe.study.run.batches import run_part

#: Parts that are under way for each worker: it need not wait for the next, and results do not pile up.
_AHEAD = 2
#: What the folders begin with in which workers of ours put aside what they do not hold.
_ASIDE = ".workers-"
#: So long a scheduler may take to answer, and then to get its first worker [s].
_PATIENCE = 4.0
Part = tuple[int, int, int]


def run_here(plan: Plan, parts: Sequence[Part]) -> Iterator[tuple[int, pa.Table]]:
    """Yield the parts, given by number, first run and end, one by one on all cores of this process."""
    for part, start, stop in parts:
        yield part, run_part(plan, start, stop, threads=0)


def run_on_workers(
    plan: Plan, parts: Sequence[Part], directory: Path, address: str | None = None
) -> Iterator[tuple[int, pa.Table]]:
    """Yield the parts as they get done by workers of Dask.

    Parameters
    ----------
    plan
        The study.
    parts
        Number, first run and end of each.
    directory
        Of the results; workers that are started here leave nothing outside of it, nor in it.
    address
        Of a scheduler that is there; one worker for each core of this machine is started where it is not given.

    Raises
    ------
    InputError
        Where Dask is not installed, or there is no scheduler at the address.
    """
    check_workers(None)
    from distributed import CancelledError, Client, KilledWorker, LocalCluster, as_completed
    from distributed.client import FutureCancelledError
    from distributed.comm.core import CommClosedError

    with ExitStack() as stack:
        if address is None:
            cores = min(os.cpu_count() or 1, len(parts))
            for left in directory.glob(f"{_ASIDE}*"):
                shutil.rmtree(left, ignore_errors=True)
            stack.enter_context(_without_script())
            aside = TemporaryDirectory(prefix=_ASIDE, dir=directory, ignore_cleanup_errors=True)
            # Workers are started anew, not forked: what the parent's threads hold would be held for ever.
            # Any port does for a server that no one asks: the usual one may be that of another study.
            cluster = stack.enter_context(
                LocalCluster(
                    n_workers=cores,
                    threads_per_worker=1,
                    dashboard_address=None,
                    scheduler_kwargs={"dashboard_address": ":0"},
                    # What ends a study is raised; a worker that loses its scheduler as both end is no news.
                    silence_logs=50,
                    local_directory=stack.enter_context(aside),
                )
            )
            client = stack.enter_context(Client(cluster))
        else:
            client = _reached(address)
            # A scheduler that is gone does not answer.
            stack.callback(client.close, timeout=2)
        everywhere = client.scatter(plan, broadcast=True, hash=False)
        waiting = iter(parts)
        workers = max(1, len(client.scheduler_info()["workers"]))
        running: Any = as_completed(with_results=True)

        def more(count: int) -> None:
            for _, (part, start, stop) in zip(range(count), waiting, strict=False):
                running.add(client.submit(_one, everywhere, part, start, stop, pure=False, retries=3))

        try:
            more(_AHEAD * workers)
            for future, result in running:
                # Of a run that is cancelled with its scheduler the result is the reason.
                if isinstance(result, Exception):
                    raise result
                future.release()
                more(1)
                yield result
        except (CancelledError, CommClosedError, FutureCancelledError, KilledWorker, TimeoutError) as error:
            raise UnfinishedError("study-lost", "--scheduler", directory, reason=type(error).__name__) from None


def check_workers(address: str | None) -> None:
    """Check that there are workers, before anything is written.

    Raises
    ------
    InputError
        Where Dask is not installed, or there is no scheduler at the address, or it has no workers.
    """
    if find_spec("distributed") is None:
        raise InputError("package-missing", "--scheduler", "dask", install=STUDY_PACKAGES)
    if address is not None:
        client = _reached(address)
        try:
            client.wait_for_workers(1, timeout=_PATIENCE)
        except TimeoutError:
            raise InputError("study-no-workers", "--scheduler", address, seconds=f"{_PATIENCE:g}") from None
        finally:
            client.close(timeout=2)


def _reached(address: str) -> Any:
    """Return a client of a scheduler."""
    from distributed import Client

    # What becomes of a study is one sentence of ours, not what its client and its tasks log as they end.
    for name in ("asyncio", *logging.root.manager.loggerDict):
        # Each of its modules has a level of its own.
        if name.partition(".")[0] in ("asyncio", "distributed", "tornado"):
            logging.getLogger(name).setLevel(logging.CRITICAL + 1)
    try:
        return Client(address, timeout=_PATIENCE)
    except (OSError, ValueError, TimeoutError) as error:
        raise InputError("study-scheduler", "--scheduler", address, reason=str(error).split("\n")[0]) from None


@contextmanager
def _without_script() -> Iterator[None]:
    """Let workers start without the script that runs here: it would run the study once more in each of them, and no
    part needs anything of it. A worker that is lost is started anew at any time."""
    script = vars(sys.modules["__main__"])
    before: dict[str, Any] = {name: script[name] for name in ("__file__", "__spec__") if name in script}
    script.pop("__file__", None)
    script["__spec__"] = None
    try:
        yield
    finally:
        script |= before


def _one(plan: Plan, part: int, start: int, stop: int) -> tuple[int, pa.Table]:
    return part, run_part(plan, start, stop)
