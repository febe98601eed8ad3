"""Which kernels these are."""

from __future__ import annotations

from importlib.metadata import version

from heeltoe.kernel import _kernel

VERSION = _kernel.VERSION
#: "release" or "debug".
PROFILE = _kernel.PROFILE


def build_info() -> dict[str, str]:
    """Return which build made a result; the version of numpy is read without loading it."""
    return {"heeltoe": VERSION, "kernel": PROFILE, "numpy": version("numpy")}
