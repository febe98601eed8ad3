"""A result beside what the user allows."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Annotated, Any

from heeltoe.base.blocks import Block, Number

if TYPE_CHECKING:
    from heeltoe.case.options import Limits
    from heeltoe.result.response import CrackResponse, Response


#: What the fields of ``limits`` limit.
LABELS = {
    "residual_slip": "residual slip",
    "peak_slip": "largest slip",
    "opening_upstream": "opening at the upstream face",
    "opening_downstream": "opening at the downstream face",
    "cracked_length": "cracked length",
}


# How a run ends whose dam has failed.
_FAILURES = ("overturned", "unstable", "lost")


class LimitCheck(Block):
    """A result beside what the user allows."""

    name: Annotated[str, Number("Field of limits in the case.")]
    value_m: Annotated[float, Number("What the run has, without its sign.", "m")]
    allowed_m: Annotated[float, Number("How much the case allows.", "m")]
    failed: Annotated[
        bool,
        Number("Whether the dam has overturned, or does not even stand without an earthquake: it keeps no limit then."),
    ]
    uncertainty_m: Annotated[
        float, Number("How far the result may be off by its evidence; zero where there is none.", "m")
    ] = 0.0
    elevation_m: Annotated[
        float | None,
        Number("Of the crack whose result it is, where there are several: the largest of all.", "m", optional=True),
    ] = None

    @property
    def label(self) -> str:
        """What people call the result."""
        return LABELS[self.name]

    @property
    def met(self) -> bool:
        """Whether the dam holds, and the result is within the limit."""
        return not self.failed and self.value_m <= self.allowed_m

    @property
    def certain(self) -> bool:
        """Whether the limit is met, or not, wherever within its uncertainty the result lies."""
        return self.failed or abs(self.value_m - self.allowed_m) > self.uncertainty_m or not self.uncertainty_m

    def to_json(self) -> dict[str, Any]:
        """Return its fields, and whether the limit is met, and for certain."""
        return {**super().to_json(), "met": self.met, "certain": self.certain}


def check_limits(limits: Limits, response: Response) -> tuple[LimitCheck, ...]:
    """Compare the numbers of a response with the limits that the user has set.

    They are the numbers to trust: where the runs of an elastic dam scatter, the means. Without a result to trust
    nothing is compared.
    """
    if response.outcome not in ("ok", *_FAILURES):
        return ()
    failed = response.outcome in _FAILURES
    # Of several cracks any may break a limit.
    checks = [
        max((_check(name, limit, crack, failed=failed) for crack in response.cracks), key=lambda check: check.value_m)
        for name in LABELS
        if (limit := getattr(limits, name)) is not None
    ]
    return tuple(check if response.several else replace(check, elevation_m=None) for check in checks)


def _check(name: str, limit: float, crack: CrackResponse, *, failed: bool) -> LimitCheck:
    """Compare a number of one crack with what it may be."""
    numbers = crack.numbers
    assert numbers is not None
    if name == "cracked_length":
        joint = numbers.get("joint")
        evidence = numbers.get("evidence")
        worth = None if evidence is None else evidence["cracked_length_m"]
        return LimitCheck(
            name=name,
            # A crack that is no joint was there from the beginning.
            value_m=numbers["crack_width_m"] if joint is None else joint["cracked_length_m"],
            allowed_m=limit,
            failed=failed,
            uncertainty_m=0.0 if worth is None else worth.uncertainty,
            elevation_m=crack.elevation,
        )
    peak = max(("peak_slip_downstream_m", "peak_slip_upstream_m"), key=lambda key: abs(numbers[key]))
    keys = {
        "residual_slip": "residual_slip_m",
        "peak_slip": peak,
        "opening_upstream": "opening_upstream_m",
        "opening_downstream": "opening_downstream_m",
    }
    key, evidence = keys[name], numbers.get("evidence")
    uncertainty = 0.0 if evidence is None else evidence[key].uncertainty
    return LimitCheck(
        name=name,
        value_m=abs(numbers[key]),
        allowed_m=limit,
        failed=failed,
        uncertainty_m=uncertainty,
        elevation_m=crack.elevation,
    )
