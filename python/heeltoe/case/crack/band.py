"""Other frictions that a crack may have: the block ``[crack.band]``."""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from typing import Annotated, Any, Literal

from pydantic import Field, ValidationError, model_validator

from heeltoe.case.distribution import PLACES, Distribution, distributed
from heeltoe.case.fields import Fields, FrictionCoefficient
from heeltoe.case.quantities import Length, Velocity
from heeltoe.case.sentences import first_error, gathered, handed_on
from heeltoe.errors.error import InputError, shown
from heeltoe.units.parse import parse

#: Parts of a distributed friction that lie below the ends of its band.
FRACTILES = {"low": 0.05, "high": 0.95}


class SlipFall(Fields):
    """A friction that falls with the slip, from that of the crack."""

    residual_friction: FrictionCoefficient
    """Coefficient of friction that is left."""
    slip: Annotated[Length, Field(gt=0.0, le=100.0)]
    """Way, to and fro, over which it falls."""


class SpeedFall(Fields):
    """A friction that falls with the speed of the slip, from that of the crack."""

    residual_friction: FrictionCoefficient
    """Coefficient of friction that is left."""
    speed: Annotated[Velocity, Field(gt=0.0, le=100.0)]
    """Slip speed at which 1/e of the loss of friction by speed remains."""


class Band(Fields):
    """Other frictions that the crack may have; each is run beside the one that it states, the best estimate."""

    low: FrictionCoefficient | None = None
    """Lowest coefficient of friction, at rest and sliding."""
    high: FrictionCoefficient | None = None
    """Highest coefficient of friction, at rest and sliding."""
    slip_weakening: SlipFall | None = None
    """The friction of the crack, falling with the slip."""
    speed_weakening: SpeedFall | None = None
    """The friction of the crack, falling with the speed of the slip."""
    judge: Literal["best", "low", "high", "slip_weakening", "speed_weakening", "worst"] = "best"
    """Which of them the limits judge; `worst` is the one that slips farthest."""

    @model_validator(mode="before")
    @classmethod
    def _ends_of_a_distribution(cls, fields: Any) -> Any:
        """Put the ends of a distribution, written as in a study file, in its place."""
        names = {field.alias or name for name, field in Distribution.model_fields.items()} - {"count"}
        given = {name: value for name, value in fields.items() if name in names} if isinstance(fields, Mapping) else {}
        if not given:
            return fields
        rest = {name: value for name, value in fields.items() if name not in names}
        try:
            ends = _ends(given)
        except InputError as error:
            error.field = error.field.lstrip(".")
            raise handed_on(error, error.others) from None
        for name in ends:
            if rest.get(name) is not None:
                raise handed_on(InputError("fields-conflict", name, other="distribution"), ())
        return {**rest, **ends}

    @model_validator(mode="after")
    @gathered
    def _of_the_band(self) -> Iterator[InputError]:
        if self.low is not None and self.high is not None and self.low > self.high:
            yield InputError("above-other", "low", f"{self.low:g}", other="the highest friction", most=f"{self.high:g}")
        if self.judge not in ("best", "worst") and getattr(self, self.judge) is None:
            yield InputError("band-judge", "judge", f'"{self.judge}"')
        if not self.names:
            yield InputError("needs-other", "judge", other="low, high or a fall")

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the other frictions."""
        every = ("low", "high", "slip_weakening", "speed_weakening")
        return tuple(name for name in every if getattr(self, name) is not None)

    def friction(self, name: str, peak: float) -> dict[str, Any]:
        """Return the fields of a crack with one of these frictions, which falls from `peak` where it falls."""
        end = getattr(self, name)
        if isinstance(end, SlipFall):
            way = {"slip": f"{end.slip!r} m"}
        elif isinstance(end, SpeedFall):
            way = {"speed": f"{end.speed!r} m/s"}
        else:
            return {"friction": end, "law": None}
        numbers = {"peak_friction": peak, "residual_friction": end.residual_friction}
        return {"friction": None, "law": {"name": name.replace("_", " "), **numbers, **way}}


def _ends(given: Mapping[str, Any]) -> dict[str, float]:
    """Return the fractiles of a distribution of friction."""
    try:
        distribution = Distribution.model_validate(given)
    except ValidationError as error:
        raise first_error(error, Distribution) from None
    numbers = {name: parse(given[name], "number", name) for name in PLACES if given.get(name) is not None}
    law = distributed(distribution, numbers, "")
    ends = {name: float(law.ppf(share)) for name, share in FRACTILES.items()}
    if ends["low"] < 0.0:
        raise InputError("band-negative", "distribution", shown(distribution.distribution))
    return {name: round(end, 6) for name, end in ends.items()}
