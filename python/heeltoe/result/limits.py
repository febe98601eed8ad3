"""A result beside what the user allows."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from heeltoe.case.options import Limits


# What the fields of ``limits`` limit.
_LABELS = {
    "residual_slip": "residual slip",
    "peak_slip": "largest slip",
    "opening_upstream": "opening at the upstream face",
    "opening_downstream": "opening at the downstream face",
}


@dataclass(frozen=True)
class LimitCheck:
    """A result beside what the user allows.

    Attributes
    ----------
    name
        Field of ``limits`` in the case.
    value_m, allowed_m
        Magnitude of the result, and how much it may be [m].
    """

    name: str
    value_m: float
    allowed_m: float

    @property
    def label(self) -> str:
        """What people call the result."""
        return _LABELS[self.name]

    @property
    def met(self) -> bool:
        """Whether the result is within the limit."""
        return self.value_m <= self.allowed_m


def check_limits(limits: Limits, summary: Mapping[str, Any]) -> tuple[LimitCheck, ...]:
    """Compare the numbers of a summary with the limits that the user has set."""
    values = {
        "residual_slip": abs(summary["residual_slip_m"]),
        "peak_slip": max(summary["peak_slip_downstream_m"], -summary["peak_slip_upstream_m"]),
        "opening_upstream": summary["opening_upstream_m"],
        "opening_downstream": summary["opening_downstream_m"],
    }
    allowed = {name: getattr(limits, name) for name in values}
    return tuple(LimitCheck(name, values[name], limit) for name, limit in allowed.items() if limit is not None)
