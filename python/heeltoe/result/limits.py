"""A result beside what the user allows."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import asdict, dataclass
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
    uncertainty_m
        How far the result may be off by its evidence [m]; zero where there is none.
    elevation_m
        Of the crack whose result it is, where there are several: the largest of all.
    """

    name: str
    value_m: float
    allowed_m: float
    failed: bool
    uncertainty_m: float = 0.0
    elevation_m: float | None = None

    @property
    def label(self) -> str:
        """What people call the result."""
        return _LABELS[self.name]

    @property
    def met(self) -> bool:
        """Whether the dam holds, and the result is within the limit."""
        return not self.failed and self.value_m <= self.allowed_m

    @property
    def certain(self) -> bool:
        """Whether the limit is met, or not, wherever within its uncertainty the result lies."""
        return self.failed or abs(self.value_m - self.allowed_m) > self.uncertainty_m or not self.uncertainty_m

    def to_json(self) -> dict[str, Any]:
        """Return the contract."""
        told = asdict(self)
        if self.elevation_m is None:
            del told["elevation_m"]
        return {**told, "met": self.met, "certain": self.certain}


def check_limits(limits: Limits, summary: Mapping[str, Any], outcome: str) -> tuple[LimitCheck, ...]:
    """Compare the numbers of a summary with the limits that the user has set.

    They are the numbers to trust: where the runs of an elastic dam scatter, the means. Without a result to trust
    nothing is compared.
    """
    if outcome not in ("ok", *_FAILURES):
        return ()
    # Of several cracks any may break a limit.
    cracks = summary.get("cracks") or [summary]
    failed = outcome in _FAILURES
    checks = [
        max((_check(name, limit, crack, failed=failed) for crack in cracks), key=lambda check: check.value_m)
        for name in _LABELS
        if (limit := getattr(limits, name)) is not None
    ]
    return tuple(checks)


def _check(name: str, limit: float, summary: Mapping[str, Any], *, failed: bool) -> LimitCheck:
    """Compare a number of one crack with what it may be."""
    peak = max(("peak_slip_downstream_m", "peak_slip_upstream_m"), key=lambda key: abs(summary[key]))
    keys = {
        "residual_slip": "residual_slip_m",
        "peak_slip": peak,
        "opening_upstream": "opening_upstream_m",
        "opening_downstream": "opening_downstream_m",
    }
    key, evidence = keys[name], summary.get("evidence") or {}
    uncertainty = evidence[key]["uncertainty"] if evidence else 0.0
    return LimitCheck(name, abs(summary[key]), limit, failed, uncertainty, summary.get("elevation_m"))
