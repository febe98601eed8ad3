"""The end of a process that does not hear of an interruption; not on Windows."""

from __future__ import annotations

import sys

from heeltoe.kernel import _kernel

if sys.platform != "win32":
    end_if_deaf, hear_interruption = _kernel.end_if_deaf, _kernel.hear_interruption
