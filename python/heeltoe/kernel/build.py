"""Which kernels these are."""

from heeltoe import _kernel

VERSION = _kernel.VERSION
#: "release" or "debug".
PROFILE = _kernel.PROFILE
