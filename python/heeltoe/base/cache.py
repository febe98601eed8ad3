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
        self._entries: dict[Hashable, Future[T]] = {}

    def clear(self) -> None:
        """Forget all."""
        with self._lock:
            self._entries.clear()

    def get(self, key: Hashable, build: Callable[[], T]) -> T:
        """Return what belongs to a key, built if it is not there."""
        with self._lock:
            entry = self._entries.pop(key, None)
            future = entry or Future()
            self._entries[key] = future
            if len(self._entries) > self._capacity:
                del self._entries[next(iter(self._entries))]
        if entry is None:
            try:
                future.set_result(build())
            except BaseException as error:
                with self._lock:
                    if self._entries.get(key) is future:
                        del self._entries[key]
                future.set_exception(error)
                raise
        return future.result()
