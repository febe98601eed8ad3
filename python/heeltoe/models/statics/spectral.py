"""What an earthquake asks of a section by its response spectrum: the first mode of the dam with water and rock, and a
static correction for all higher ones (Fenves and Chopra 1987)."""

from __future__ import annotations

import math
from typing import Annotated

from heeltoe.base.arrays import Floats
from heeltoe.base.blocks import Block, Number
from heeltoe.mechanics.loads import Resultant

_NEWTON = "N per metre of dam"


class Push(Block):
    """Forces on what is above a section."""

    horizontal_n: Annotated[float, Number("Push downstream.", _NEWTON)]
    vertical_n: Annotated[float, Number("Push upward.", _NEWTON)]
    moment_about_heel_nm: Annotated[
        float, Number("Moment about the heel of the crack, positive counter-clockwise.", "N m per metre of dam")
    ]
    #: What the upward push adds to the moment.
    lift_moment_nm: float

    @classmethod
    def of(cls, forces: Floats) -> Push:
        """Return a push of its four numbers (4,)."""
        across, up, moment, lift = forces.tolist()
        return cls(horizontal_n=across, vertical_n=up, moment_about_heel_nm=moment, lift_moment_nm=lift)


class SpectralDemand(Block):
    """Forces of an earthquake on what is above a section, at the first mode's largest push downstream."""

    spectrum: Annotated[str, Number("Name of the motion or of the design spectrum.")]
    period_s: Annotated[
        float, Number("Period of the first mode of the dam without a crack, with its water and its rock.", "s")
    ]
    damping_ratio: Annotated[float, Number("Effective damping ratio of that mode.")]
    pseudo_acceleration_m_s2: Annotated[float, Number("Ordinate of the spectrum at that period and damping.", "m/s²")]
    peak_ground_acceleration_m_s2: Annotated[float, Number("Ordinate of the spectrum at period zero.", "m/s²")]
    first_mode: Annotated[
        Push, Number("Push of inertia and moving water on what is above the crack, by the first mode.")
    ]
    static_correction: Annotated[Push, Number("The same of all higher modes, which follow the ground at once.")]

    @property
    def together(
        self,
    ) -> Annotated[Push, Number("Root of the sum of squares of both, with the signs of the first mode.")]:
        """Both together."""
        first, rest = vars(self.first_mode), vars(self.static_correction)
        return Push(**{name: math.copysign(math.hypot(value, rest[name]), value) for name, value in first.items()})

    def push(self) -> Resultant:
        """Return both together as a force."""
        push = self.together
        return Resultant(
            "response spectrum",
            push.horizontal_n,
            push.vertical_n,
            push.moment_about_heel_nm,
            lift_moment=push.lift_moment_nm,
        )
