"""A result beside what the user allows."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Annotated

from heeltoe.base.blocks import Block, Number
from heeltoe.units.parse import Acceleration

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
    "rotation": "rotation",
    "crest_displacement": "crest displacement",
    "crest_acceleration": "crest acceleration",
}
#: In what they are counted that are no lengths.
UNITS = {"rotation": "rad", "crest_acceleration": "g"}
#: Those that are lengths.
LENGTHS = tuple(name for name in LABELS if name not in UNITS)
#: Those on the crest, and what each limits of its motion.
CREST = {"crest_displacement": "displacement_m", "crest_acceleration": "acceleration_g"}


# How a run ends whose dam has failed.
_FAILURES = ("overturned", "unstable", "lost")


class LimitCheck(Block):
    """A result beside what the user allows."""

    name: Annotated[str, Number("Field of limits in the case.")]
    value: Annotated[float, Number("What the run has, without its sign, in `unit`.")]
    allowed: Annotated[float, Number("How much the case allows, in `unit`.")]
    failed: Annotated[
        bool,
        Number("Whether the dam has overturned, or does not even stand without an earthquake: it keeps no limit then."),
    ]
    uncertainty: Annotated[
        float, Number("How far the result may be off by its evidence, in `unit`; zero where there is none.")
    ] = 0.0
    elevation_m: Annotated[
        float | None,
        Number(
            "Of the crack whose result it is, where there are several: the largest of all, or each bonded joint's own.",
            "m",
            optional=True,
        ),
    ] = None

    @property
    def unit(self) -> Annotated[str, Number("In what result and limit are counted: m, rad or g.")]:
        """In what it is counted."""
        return UNITS.get(self.name, "m")

    @property
    def utilisation(
        self,
    ) -> Annotated[float | None, Number("The result over what is allowed; null where nothing is allowed.")]:
        """The result over what is allowed."""
        return self.value / self.allowed if self.allowed else None

    @property
    def label(self) -> str:
        """What people call the result."""
        return LABELS[self.name]

    @property
    def met(self) -> Annotated[bool, Number("Whether the dam holds, and the result is within the limit.")]:
        """Whether the limit is kept."""
        return not self.failed and self.value <= self.allowed

    @property
    def certain(
        self,
    ) -> Annotated[bool, Number("Whether that is so wherever within its uncertainty the result lies.")]:
        """Whether the uncertainty leaves no doubt."""
        return self.failed or abs(self.value - self.allowed) > self.uncertainty or not self.uncertainty


def check_limits(limits: Limits, response: Response) -> tuple[LimitCheck, ...]:
    """Compare the numbers of a response with the limits that the user has set.

    They are the numbers to trust: where the runs of an elastic dam scatter, the means. Without a result to trust
    nothing is compared.
    """
    if response.outcome not in ("ok", *_FAILURES):
        return ()
    failed = response.outcome in _FAILURES
    checks: list[LimitCheck] = []
    for name in LABELS:
        limit = allowed_of(limits, name, response.gravity)
        if limit is None:
            continue
        if name in CREST:
            if response.crest is not None:
                checks.append(
                    LimitCheck(name=name, value=getattr(response.crest, CREST[name]), allowed=limit, failed=failed)
                )
            continue
        if name == "cracked_length":
            checks.extend(_check_joints(limit, response, failed=failed))
            continue
        # Of several cracks any may break a limit.
        cracks = [_check(name, limit, crack, failed=failed) for crack in response.cracks]
        worst = max(cracks, key=lambda check: check.value)
        checks.append(worst if response.several else replace(worst, elevation_m=None))
    return tuple(checks)


def allowed_of(limits: Limits, name: str, gravity: float) -> float | None:
    """Return what a limit allows: lengths in m, rotations in rad, accelerations in g of so many m/s2; None without."""
    limit: float | Acceleration | None = getattr(limits, name)
    return limit.si(gravity) / gravity if isinstance(limit, Acceleration) else limit


def _check_joints(limit: float, response: Response, *, failed: bool) -> Iterator[LimitCheck]:
    """Compare how far each bonded joint has cracked with what it may; a crack without a bond cracks no farther."""
    for crack in response.cracks:
        numbers = crack.numbers
        if numbers is None:
            continue
        joint, bond = numbers.get("joint"), numbers.get("bond")
        if joint is not None:
            cracked = joint["cracked_length_m"]
        elif bond is not None:
            # The bond of a block breaks all at once.
            cracked = 0.0 if bond["breaks_s"] is None else numbers["crack_width_m"]
        else:
            continue
        evidence = numbers.get("evidence")
        worth = None if evidence is None else evidence["cracked_length_m"]
        yield LimitCheck(
            name="cracked_length",
            value=cracked,
            allowed=limit,
            failed=failed,
            uncertainty=0.0 if worth is None else worth.uncertainty,
            elevation_m=crack.elevation if response.several else None,
        )


def _check(name: str, limit: float, crack: CrackResponse, *, failed: bool) -> LimitCheck:
    """Compare a number of one crack with what it may be."""
    numbers = crack.numbers
    assert numbers is not None
    turned = max(("rocking_downstream_rad", "rocking_upstream_rad"), key=lambda key: abs(numbers[key]))
    peak = max(("peak_slip_downstream_m", "peak_slip_upstream_m"), key=lambda key: abs(numbers[key]))
    keys = {
        "residual_slip": "residual_slip_m",
        "peak_slip": peak,
        "opening_upstream": "opening_upstream_m",
        "opening_downstream": "opening_downstream_m",
        "rotation": turned,
    }
    key, evidence = keys[name], numbers.get("evidence")
    uncertainty = 0.0 if evidence is None else evidence[key].uncertainty
    return LimitCheck(
        name=name,
        value=abs(numbers[key]),
        allowed=limit,
        failed=failed,
        uncertainty=uncertainty,
        elevation_m=crack.elevation,
    )
