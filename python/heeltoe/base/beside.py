"""Two things at once: kernels, factorisations and large arrays let go of the interpreter."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Future, ThreadPoolExecutor
from contextlib import contextmanager
from typing import Any, TypeVar

T = TypeVar("T")


@contextmanager
def beside(task: Callable[[], T], stop: Callable[[], None] | None = None) -> Iterator[Future[T]]:
    """Run a task on another thread beside the body of a ``with``, whose end waits for it.

    Parameters
    ----------
    task
        Its result or its error comes from the future that the body is given: whoever asks for the results of several
        decides whose error counts.
    stop
        Asks the task to end where the body fails or is interrupted: signals reach the main thread alone.
    """
    with ThreadPoolExecutor(1) as pool:
        future = pool.submit(task)
        try:
            yield future
        except BaseException:
            if stop is not None:
                stop()
            raise


def pass_notes(tasks: Iterable[Future[Any]], error: BaseException) -> None:
    """Note on an interruption what the first of the tasks that it has ended says of how far it has come."""
    if isinstance(error, KeyboardInterrupt):
        ended = (task.exception() for task in tasks if not task.cancelled())
        for note in next((notes for one in ended if (notes := getattr(one, "__notes__", ()))), ()):
            error.add_note(note)
