"""The last few of what is dear to build: studies ask for the same again and again, from several threads."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from concurrent.futures import Future
from threading import Lock
from typing import Generic, TypeVar

T = TypeVar("T")


class Kept(Generic[T]):
    """Keeps what was asked for last, by all that it depends on.

    Threads that ask for the same at once wait for one of them to build it. What cannot be built is not kept.

    Parameters
    ----------
    capacity
        How many are kept.
    """

    def __init__(self, capacity: int) -> None:
        self._capacity = capacity
        self._lock = Lock()
        # From the one asked for longest ago to the newest.
        self._found: dict[Hashable, Future[T]] = {}

    def clear(self) -> None:
        """Forget all."""
        with self._lock:
            self._found.clear()

    def get(self, key: Hashable, build: Callable[[], T]) -> T:
        """Return what belongs to a key, built if it is not there."""
        with self._lock:
            entry = self._found.pop(key, None)
            future = entry or Future()
            self._found[key] = future
            if len(self._found) > self._capacity:
                del self._found[next(iter(self._found))]
        if entry is None:
            try:
                future.set_result(build())
            except BaseException as error:
                with self._lock:
                    if self._found.get(key) is future:
                        del self._found[key]
                future.set_exception(error)
                raise
        return future.result()
