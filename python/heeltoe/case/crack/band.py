"""Other frictions that a crack may have: the block ``[crack.band]``."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Annotated, Any, Literal

from pydantic import Field, model_validator

from heeltoe.case.fields import Fields, FrictionCoefficient
from heeltoe.case.quantities import Length, Velocity
from heeltoe.case.sentences import gathered
from heeltoe.errors.error import InputError


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
    """Speed of the slip that leaves 1/e of what friction loses with it."""


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

    @model_validator(mode="after")
    @gathered
    def _of_the_band(self) -> Iterator[InputError]:
        if self.low is not None and self.high is not None and self.low > self.high:
            yield InputError("band-order", "low", f"{self.low:g}", high=f"{self.high:g}")
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
