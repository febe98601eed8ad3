"""A cache of the last few expensive objects, for studies that need the same ones again, from several threads."""

from __future__ import annotations

from collections.abc import Callable, Hashable
from concurrent.futures import Future
from threading import Lock
from typing import Any, Generic, TypeVar
from weakref import WeakSet

T = TypeVar("T")
_ALL: WeakSet[Kept[Any]] = WeakSet()


def forget_all() -> None:
    """Forget all objects of all caches, where no run follows."""
    for kept in list(_ALL):
        kept.clear()


class Kept(Generic[T]):
    """Keeps the objects that were used last, by everything they depend on.

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
        _ALL.add(self)

    def clear(self) -> None:
        """Forget all."""
        with self._lock:
            self._entries.clear()

    def get(self, key: Hashable, build: Callable[[], T]) -> T:
        """Return what belongs to a key, built if it is not there."""
        future: Future[T] = Future()
        try:
            with self._lock:
                entry = self._entries.pop(key, None)
                self._entries[key] = entry or future
                if len(self._entries) > self._capacity:
                    del self._entries[next(iter(self._entries))]
            if entry is None:
                future.set_result(build())
        except BaseException as error:
            # Also where it is interrupted before it builds: whoever asks next would wait for ever.
            with self._lock:
                if self._entries.get(key) is future:
                    del self._entries[key]
            if not future.done():
                future.set_exception(error)
            raise
        return (entry or future).result()
