"""Results of the decoupled chain beyond those of a block."""

from __future__ import annotations

from dataclasses import dataclass

from heeltoe.result.numbers import CrackLevel
from heeltoe.result.record import Of
from heeltoe.result.response import Response


@dataclass(frozen=True, eq=False, repr=False)
class DecoupledResponse(Response):
    """Result of the decoupled chain: that of its block, with the motion that has shaken it.

    Signs and attributes as in :class:`~heeltoe.result.response.Response`. `motion` and `vertical` are those of the
    ground; critical accelerations belong to the crack.
    """

    crack_level = Of[CrackLevel]()
