"""Linear algebra on one thread.

On several threads the libraries add in another order, and a dam whose runs scatter amplifies the last bit to another
slip: the same dam would slide one way in the shell, which has all cores, and another in a worker, which has one. The
matrices are small, so that further threads win little.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from functools import cache
from threading import Lock

from threadpoolctl import ThreadpoolController

_LOCK = Lock()
_LIMIT = ExitStack()
_inside = 0


@cache
def _controller() -> ThreadpoolController:
    # It sees the libraries that are loaded.
    import scipy.linalg  # noqa: F401

    return ThreadpoolController()


@contextmanager
def one_blas_thread() -> Iterator[None]:
    """Limit the linear algebra of this process to one thread, as a context or a decorator.

    The limit is of the whole process: the first of several threads sets it, the last one restores what was there.
    """
    global _inside
    with _LOCK:
        if _inside == 0:
            _LIMIT.enter_context(_controller().limit(limits=1, user_api="blas"))
        _inside += 1
    try:
        yield
    finally:
        with _LOCK:
            _inside -= 1
            if _inside == 0:
                _LIMIT.close()
