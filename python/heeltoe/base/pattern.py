"""Regular expressions that are compiled when they are first used: a run needs few of the hundreds that read records."""

from __future__ import annotations

import re
from typing import Any, cast


class _Late:
    """A regular expression before its first use; after it, its methods are those of the compiled one."""

    def __init__(self, text: str, flags: int) -> None:
        self._text, self._flags = text, flags

    def __getattr__(self, name: str) -> Any:
        # The compiled one is kept by `re`, or at least by its method.
        value = getattr(re.compile(self._text, self._flags), name)
        setattr(self, name, value)
        return value


def pattern(text: str, flags: int = 0) -> re.Pattern[str]:
    """Return a regular expression as :func:`re.compile` does, which is compiled at its first use."""
    return cast("re.Pattern[str]", _Late(text, int(flags)))
