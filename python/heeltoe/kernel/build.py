"""Which kernels these are."""

from heeltoe.kernel import _kernel

VERSION = _kernel.VERSION
#: "release" or "debug".
PROFILE = _kernel.PROFILE
