"""Memory that is freed and goes back to the system.

glibc keeps a heap for each thread, several for each processor, and holds in each what was freed below what is still
used: a run that builds dams on threads then occupies three times what it uses. Other C libraries do not."""

from __future__ import annotations

import ctypes
import os
import sys
from typing import Any

# Names of glibc (malloc.h).
_TRIM_THRESHOLD, _MMAP_THRESHOLD, _ARENA_MAX = -1, -3, -8
# Blocks of this size or more [bytes] are no part of a heap: they go back at once, which takes time.
_LARGE = 1 << 22


def share_heaps() -> None:
    """Let the threads of this process share one heap for each processor, and large arrays go back as they are freed.

    Where the user has set the number of heaps, it stays."""
    set_option = _function("mallopt")
    if set_option is not None and "MALLOC_ARENA_MAX" not in os.environ:
        for name, value in ((_ARENA_MAX, os.cpu_count() or 1), (_MMAP_THRESHOLD, _LARGE), (_TRIM_THRESHOLD, _LARGE)):
            set_option(name, value)


def give_back() -> None:
    """Give free memory back to the system; Arrow, where it is loaded, keeps a heap of its own."""
    pool = getattr(sys.modules.get("pyarrow"), "default_memory_pool", None)
    if pool is not None:
        pool().release_unused()
    trim = _function("malloc_trim")
    if trim is not None:
        trim(ctypes.c_size_t(0))


def _function(name: str) -> Any:
    """Return a function of the C library by its name; None without one."""
    try:
        return getattr(ctypes.CDLL(None), name)
    except (AttributeError, OSError, TypeError):
        return None
