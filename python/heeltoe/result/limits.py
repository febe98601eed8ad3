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


# How a run ends whose dam has failed.
_FAILURES = ("overturned", "unstable", "lost")


@dataclass(frozen=True)
class LimitCheck:
    """A result beside what the user allows.

    Attributes
    ----------
    name
        Field of ``limits`` in the case.
    value_m, allowed_m
        Magnitude of the result, and how much it may be [m].
    failed
        Whether the dam has overturned, or does not even stand without an earthquake: then it keeps no limit.
    """

    name: str
    value_m: float
    allowed_m: float
    failed: bool

    @property
    def label(self) -> str:
        """What people call the result."""
        return _LABELS[self.name]

    @property
    def met(self) -> bool:
        """Whether the dam holds, and the result is within the limit."""
        return not self.failed and self.value_m <= self.allowed_m


def check_limits(limits: Limits, summary: Mapping[str, Any], outcome: str) -> tuple[LimitCheck, ...]:
    """Compare the numbers of a summary with the limits that the user has set.

    Without a result to trust nothing is compared.
    """
    if outcome not in ("ok", *_FAILURES):
        return ()
    values = {
        "residual_slip": abs(summary["residual_slip_m"]),
        "peak_slip": max(summary["peak_slip_downstream_m"], -summary["peak_slip_upstream_m"]),
        "opening_upstream": summary["opening_upstream_m"],
        "opening_downstream": summary["opening_downstream_m"],
    }
    allowed = {name: getattr(limits, name) for name in values}
    failed = outcome in _FAILURES
    return tuple(LimitCheck(name, values[name], limit, failed) for name, limit in allowed.items() if limit is not None)
