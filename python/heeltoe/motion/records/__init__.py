"""Strong-motion records: their names, their formats, and how they become a ground motion."""

from __future__ import annotations

from typing import Literal

#: Use of the factors in headers of several files: multiply by them, divide by them, or leave values as they
#: are that contain them.
HeaderFactor = Literal["multiply", "divide", "contain"]
