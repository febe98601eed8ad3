"""Quantities: numbers of a crack that people see in tables and limit, each one row.

The row of a number is its field in a block of :mod:`heeltoe.result.numbers`, annotated with a :class:`Quantity`. JSON,
schema, ``explain``, docs, tables, report and app walk these rows.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, replace
from functools import cache, cached_property
from typing import Any, Literal

import numpy as np

from heeltoe.base.arrays import Floats
from heeltoe.base.blocks import Block, Number, entries

#: A hundredth of a millimetre and a thousandth of a milliradian: no instrument on a dam measures less.
LEAST_M, LEAST_RAD = 1e-5, 1e-6


@dataclass(frozen=True)
class Quantity(Number):
    """A number with all that faces need to show it.

    Attributes
    ----------
    label
        Name for people.
    short
        The same above a narrow column.
    kind
        ``"slip"`` or ``"opening"`` [m], or ``"rotation"`` [rad].
    way
        -1 where the number is negative the way that its label says, and is shown turned round; else 1.
    signed
        Whether it goes both ways, positive downstream.
    column
        Name in the kernels. A block has no openings, but rotations of a base that stays straight.
    sense
        -1 where the kernels count it the other way.
    compute
        Makes it of a history: moments (k,) [s] and slips (k,) [m]; None where the kernels say it.
    key
        Its name in the JSON, that of its field.
    """

    label: str = ""
    short: str = ""
    kind: Literal["slip", "rotation", "opening"] = "slip"
    way: Literal[1, -1] = 1
    signed: bool = False
    column: str = ""
    sense: Literal[1, -1] = 1
    compute: Callable[[Floats, Floats], float] | None = None
    key: str = ""

    def of(self, crack: object) -> float:
        """Return this number of a crack, or of the crack that leads of a response."""
        return float(getattr(crack, self.key))

    @property
    def least(self) -> float:
        """Smallest value that counts, in its unit."""
        return LEAST_RAD if self.kind == "rotation" else LEAST_M

    @cached_property
    def heading(self) -> str:
        """Its short label on one line."""
        return self.short.replace("\n", " ")

    @cached_property
    def full(self) -> str:
        """Its label, with which way is positive."""
        return f"{self.label}, + downstream" if self.signed else self.label


@cache
def quantities_of(kind: type[Block]) -> tuple[Quantity, ...]:
    """Return the quantities of a block, in the order of its fields."""
    return tuple(replace(entry.number, key=entry.name) for entry in entries(kind) if isinstance(entry.number, Quantity))


def computed(kind: type[Block], time: Floats, slip: Floats) -> dict[str, Any]:
    """Return the quantities of a block that a history has, by their JSON names: moments (k,) [s] and slips (k,) [m]."""
    return {item.key: item.compute(time, slip) for item in quantities_of(kind) if item.compute is not None}


def peak_time(time: Floats, slip: Floats) -> float:
    """Return when a slip is largest either way [s], the first moment of several."""
    return float(time[np.abs(slip).argmax()])
